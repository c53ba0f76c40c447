//! Comparisons for programs.

use super::{Compared, status, switched_on, verdict};
use crate::compare::{Fault, Row, Verdict};
use crate::problem::Published;
use crate::report::json::{JSON_VERSION, text};
use crate::track::StopKind;
use serde::Serialize;
use serde_json::{Value, json};

/// Comparisons as one line of JSON:
///
/// ```json
/// {"version": 1, "verb": "compare", "program": "krawl 0.1.0", "problems": [
///   {"problem": "...", "typical_length": 1.0, "interrupted": false, "reference": true, "reference_is_arc": false,
///    "rows": [{"mode": "certified", "space": "full", "setting": null, "value": null,
///      "relative": null, "status": "closed", "reason": null, "steps": 0, "rejected": 0,
///      "runs": [0.0], "seconds": 0.0, "ratio": 1.0, "solutions": 0, "widest": 0.0,
///      "narrowest": 0.0, "residual": 0.0, "length": 0.0, "switched_on": [], "verdict": "right", "faults": [],
///      "published": {"method": "...", "steps": 0, "seconds": 0.0, "solutions": 0}}],
///    "sweep": [],
///    "published": [{"method": "...", "steps": null, "seconds": 0.0, "solutions": 0}]}]}
/// ```
///
/// `sweep` has rows of the same form, with the name of the option that was set and its value in the
/// problem's lengths and in typical lengths. `seconds` is the median of `runs`. `status` is
/// `closed`, `open`, `stopped` or `unsupported`; `verdict` is `right`, `wrong`, `stopped`, `earlier`
/// (a certified run that ended open without all solutions of the arc that is proved) or `unjudged`,
/// and `faults` has entries like `{"fault": "lost", "amount": 3.0}` with `lost`, `jumped`, `invented`, `order`, `length`, `not_closed`, `open`. Where `reference_is_arc` the certified run that the
/// others are judged by ended open, and what it proves is the arc between its ends. Where there is nothing to say stands `null`.
pub fn comparisons_to_json(compared: &[Compared]) -> String {
    let document = Document {
        version: JSON_VERSION,
        verb: "compare",
        program: concat!("krawl ", env!("CARGO_PKG_VERSION")),
        problems: compared.iter().map(problem).collect(),
    };
    text(&document)
}

#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    verb: &'static str,
    program: &'static str,
    problems: Vec<ProblemEntry<'a>>,
}

#[derive(Serialize)]
struct ProblemEntry<'a> {
    problem: &'a str,
    typical_length: f64,
    interrupted: bool,
    reference: bool,
    reference_is_arc: bool,
    rows: Vec<RowEntry<'a>>,
    sweep: Vec<RowEntry<'a>>,
    published: Vec<Value>,
}

#[derive(Serialize)]
pub(super) struct RowEntry<'a> {
    pub mode: &'static str,
    pub space: &'static str,
    pub setting: Option<&'static str>,
    pub value: Option<f64>,
    pub relative: Option<f64>,
    pub status: &'static str,
    pub reason: Option<&'a str>,
    pub stopped_kind: Option<&'static str>,
    pub steps: Option<usize>,
    pub rejected: Option<usize>,
    pub runs: &'a [f64],
    pub seconds: Option<f64>,
    pub ratio: Option<f64>,
    pub solutions: Option<usize>,
    pub widest: Option<f64>,
    pub narrowest: Option<f64>,
    pub residual: Option<f64>,
    pub length: Option<f64>,
    pub switched_on: &'a [String],
    pub verdict: &'static str,
    faults: Vec<FaultEntry>,
    published: Option<Value>,
}

#[derive(Serialize)]
struct FaultEntry {
    fault: &'static str,
    amount: Option<f64>,
}

fn problem(compared: &Compared) -> ProblemEntry<'_> {
    let comparison = &compared.comparison;
    ProblemEntry {
        problem: &comparison.problem,
        typical_length: comparison.typical_length,
        interrupted: comparison.interrupted,
        reference: comparison.has_reference(),
        reference_is_arc: comparison.reference_is_arc(),
        rows: comparison
            .rows
            .iter()
            .map(|row| entry(compared, row))
            .collect(),
        sweep: comparison
            .sweep
            .iter()
            .map(|row| entry(compared, row))
            .collect(),
        published: compared.others().map(published).collect(),
    }
}

pub(super) fn entry<'a>(compared: &'a Compared, row: &'a Row) -> RowEntry<'a> {
    let measured = row.measured();
    let outcome = measured.map(|m| &m.outcome);
    let (status, reason, kind) = status(row);
    let widths = measured.and_then(|m| m.widths());
    RowEntry {
        mode: row.way.method.name(),
        space: row.way.space.name(),
        setting: row.setting.map(|s| s.knob.name()),
        value: row.setting.map(|s| s.value),
        relative: row.setting.map(|s| s.relative),
        status,
        reason,
        stopped_kind: kind.map(StopKind::name),
        steps: outcome.map(|o| o.steps),
        rejected: outcome.map(|o| o.rejected),
        runs: measured.map_or(&[], |m| &m.seconds),
        seconds: measured.map(|m| m.median),
        ratio: measured.and_then(|m| compared.ratio(m)),
        solutions: outcome.map(|o| o.solutions.len()),
        widest: widths.map(|w| w.0),
        narrowest: widths.map(|w| w.1),
        residual: measured.and_then(|m| m.residual),
        length: outcome.map(|o| o.length),
        switched_on: switched_on(row),
        verdict: verdict(&row.verdict),
        faults: match &row.verdict {
            Verdict::Wrong(faults) => faults.iter().map(fault).collect(),
            _ => Vec::new(),
        },
        published: compared.beside(row).map(published),
    }
}

fn fault(fault: &Fault) -> FaultEntry {
    let (fault, amount) = match *fault {
        Fault::Lost(n) => ("lost", Some(n as f64)),
        Fault::Jumped(n) => ("jumped", Some(n as f64)),
        Fault::Invented(n) => ("invented", Some(n as f64)),
        Fault::Order => ("order", None),
        Fault::Length(x) => ("length", Some(x)),
        Fault::NotClosed(x) => ("not_closed", Some(x)),
        Fault::Open => ("open", None),
    };
    FaultEntry { fault, amount }
}

fn published(published: &Published) -> Value {
    json!({
        "method": published.method,
        "steps": published.steps,
        "seconds": published.seconds,
        "solutions": published.solutions,
    })
}
