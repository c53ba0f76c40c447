//! What `krawl compare` writes.

use super::{JSON_VERSION, all};
use crate::compare::{Fault, Row, Verdict};
use crate::problem::Published;
use crate::report::Compared;
use crate::report::comparison::{status, switched_on};
use crate::track::StopKind;

keys! {
    /// Runs of problems beside each other.
    Comparisons(compared: &[Compared]) {
        /// Of the format.
        version: u32 = JSON_VERSION,
        /// `compare`.
        verb: String = "compare".into(),
        /// The program that wrote it.
        program: String = concat!("krawl ", env!("CARGO_PKG_VERSION")).into(),
        /// The problems.
        problems: Vec<Comparison> = all(compared, Comparison::new),
    }
}

keys! {
    /// Runs of a problem.
    Comparison(compared: &Compared) {
        /// Its name.
        problem: String = compared.comparison.problem.clone(),
        /// A length as there are in it.
        typical_length: f64 = compared.comparison.typical_length,
        /// Whether it was interrupted.
        interrupted: bool = compared.comparison.interrupted,
        /// Whether there is a certified run by which the others are judged.
        reference: bool = compared.comparison.has_reference(),
        /// Whether that ended open: what it proves is the arc between its ends.
        reference_is_arc: bool = compared.comparison.reference_is_arc(),
        /// The runs.
        rows: Vec<RowOf> = all(&compared.comparison.rows, |row| RowOf::new(compared, row)),
        /// Runs with another value of an option.
        sweep: Vec<RowOf> = all(&compared.comparison.sweep, |row| RowOf::new(compared, row)),
        /// What others published.
        published: Vec<PublishedRun> = all(compared.others(), PublishedRun::new),
    }
}

keys! {
    /// A run, or several that are the same.
    RowOf(compared: &Compared, row: &Row) {
        /// How it was followed.
        mode: String = row.way.method.name().into(),
        /// In which space.
        space: String = row.way.space.name().into(),
        /// The option that was set.
        setting: Option<String> = row.setting.map(|s| s.knob.name().into()),
        /// Its value, in the problem's lengths.
        value: Option<f64> = row.setting.map(|s| s.value),
        /// Its value, in typical lengths.
        relative: Option<f64> = row.setting.map(|s| s.relative),
        /// `closed`, `open`, `stopped` or `unsupported`.
        status: String = status(row).0.into(),
        /// Why.
        reason: Option<String> = status(row).1.map(str::to_owned),
        /// That for programs.
        stopped_kind: Option<String> = status(row).2.map(|kind: StopKind| kind.name().into()),
        /// How many steps were made.
        steps: Option<usize> = row.measured().map(|m| m.outcome.steps),
        /// How many were rejected.
        rejected: Option<usize> = row.measured().map(|m| m.outcome.rejected),
        /// How long each run took.
        runs: Vec<f64> = row.measured().map_or(Vec::new(), |m| m.seconds.clone()),
        /// The median of these.
        seconds: Option<f64> = row.measured().map(|m| m.median),
        /// That over the fastest one's.
        ratio: Option<f64> = row.measured().and_then(|m| compared.ratio(m)),
        /// How many solutions it found.
        solutions: Option<usize> = row.measured().map(|m| m.outcome.solutions.len()),
        /// The widest enclosure.
        widest: Option<f64> = row.measured().and_then(|m| m.widths()).map(|w| w.0),
        /// The narrowest.
        narrowest: Option<f64> = row.measured().and_then(|m| m.widths()).map(|w| w.1),
        /// By how much a solution misses its equations.
        residual: Option<f64> = row.measured().and_then(|m| m.residual),
        /// How long the path is.
        length: Option<f64> = row.measured().map(|m| m.outcome.length),
        /// What was switched on.
        switched_on: Vec<String> = switched_on(row).to_vec(),
        /// `right`, `wrong`, `stopped`, `unjudged`, or `earlier`: it ended open without all solutions of the arc that is proved.
        verdict: String = row.verdict.name().into(),
        /// What is wrong.
        faults: Vec<FaultOf> = match &row.verdict {
            Verdict::Wrong(faults) => all(faults, FaultOf::new),
            _ => Vec::new(),
        },
        /// What others published of the same.
        published: Option<PublishedRun> = compared.beside(row).map(PublishedRun::new),
    }
}

keys! {
    /// A fault.
    FaultOf(fault: &Fault) {
        /// `lost`, `jumped`, `invented`, `order`, `length`, `not_closed` or `open`.
        fault: String = fault.name().into(),
        /// Of how many solutions, or by how much.
        amount: Option<f64> = match *fault {
            Fault::Lost(n) | Fault::Jumped(n) | Fault::Invented(n) => Some(n as f64),
            Fault::Length(x) | Fault::NotClosed(x) => Some(x),
            Fault::Order | Fault::Open => None,
        },
    }
}

keys! {
    /// A run that others published.
    PublishedRun(published: &Published) {
        /// By what method.
        method: String = published.method.clone(),
        /// How many steps it made.
        steps: Option<usize> = published.steps,
        /// How long it took.
        seconds: Option<f64> = published.seconds,
        /// How many solutions it found.
        solutions: Option<usize> = published.solutions,
    }
}
