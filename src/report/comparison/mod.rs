//! A comparison as a table, as JSON and as CSV.

#[cfg(feature = "cli")]
mod csv;
mod table;

#[cfg(feature = "cli")]
pub use csv::comparisons_to_csv;
pub use table::comparison_to_table;

use crate::compare::{Comparison, Fault, Measured, Method, Row, Verdict};
use crate::problem::{Published, counted, either};
use crate::report::document::{Comparisons, ended, text};
use crate::track::StopKind;

/// A comparison and what was published about its problem.
#[derive(Debug, Clone)]
pub struct Compared {
    /// What was measured.
    pub comparison: Comparison,
    /// What was published.
    pub published: Vec<Published>,
}

/// Comparisons as one line of JSON (docs/schema/comparison.schema.json).
pub fn comparisons_to_json(compared: &[Compared]) -> String {
    text(&Comparisons::new(compared))
}

impl Compared {
    /// The published run that belongs beside a row: the paper's, in the same space.
    pub(super) fn beside(&self, row: &Row) -> Option<&Published> {
        let space = row.way.space.name();
        let wanted = row.way.method == Method::Paper && row.setting.is_none();
        let mut published = self.published.iter();
        published.find(|p| wanted && p.space.as_deref() == Some(space))
    }

    /// Published runs that belong beside no row.
    pub(super) fn others(&self) -> impl Iterator<Item = &Published> {
        self.published.iter().filter(|p| p.space.is_none())
    }

    /// A row's median time over the fastest one's.
    pub(super) fn ratio(&self, measured: &Measured) -> Option<f64> {
        Some(measured.median / self.comparison.fastest()?)
    }
}

/// `closed`, `open`, `stopped` or `unsupported`, the reason, and what it is for programs.
pub(super) fn status(row: &Row) -> (&'static str, Option<&str>, Option<StopKind>) {
    match &row.result {
        Err(reason) => ("unsupported", Some(reason), None),
        Ok(measured) => {
            let (word, stop) = ended(&measured.outcome.status);
            (
                word,
                stop.map(|stop| &stop.text[..]),
                stop.map(|stop| stop.kind),
            )
        }
    }
}

/// What was switched on beyond the plain run, and why.
pub(super) fn switched_on(row: &Row) -> &[String] {
    row.measured().map_or(&[], |m| &m.outcome.switched_on)
}

/// What there is to say of a certified run that ended before the one that others are judged by.
fn earlier(beyond: usize) -> String {
    let (solutions, are) = (counted(beyond, "solution"), either(beyond, "is", "are"));
    format!("it ended earlier: {solutions} of the arc proved {are} beyond its ends")
}

/// What is wrong, in words.
fn faults(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Wrong(faults) => {
            let faults: Vec<String> = faults.iter().map(Fault::to_string).collect();
            faults.join(", ")
        }
        _ => String::new(),
    }
}
