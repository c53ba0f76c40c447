//! What accuracy costs: a problem in all modes and spaces, timed, judged against the certified run.
//!
//! ```
//! use krawl::compare::{Effort, Verdict, compare};
//! use krawl::problem::Problem;
//! let problem = Problem::read("problems/k33.toml")?;
//! let effort = Effort { repeats: 1, ..Effort::default() };
//! let comparison = compare(&problem, &effort, &mut Default::default())?;
//! let certified = &comparison.rows[0];
//! assert_eq!(certified.measured().unwrap().outcome.solutions.len(), 8);
//! let mut measured = comparison.rows.iter().filter(|row| row.measured().is_some());
//! assert!(measured.all(|row| row.verdict == Verdict::Right));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! - `ways`: the modes and spaces that there are, and the settings of a sweep
//! - `measure`: runs taking turns, medians
//! - `judge`: the solutions of a run beside the boxes of the certified one
//! - `matching`: whether two runs report the same figure
//! - `residual`: how well reported figures meet the constraints
//! - `path`: the path as the certified run sees it, for pictures

mod judge;
mod matching;
mod measure;
mod path;
mod residual;
mod ways;

pub use judge::{Fault, Verdict};
pub use measure::{Effort, Measured};
pub use path::{PathPoint, RecordedPath, record_path};
pub use ways::{Knob, Method, Setting, Way};

use crate::problem::Problem;
use crate::system::{GaugeError, Homotopy};
use crate::track::Control;
use judge::Reference;
use matching::Matching;
use measure::Session;

/// One line of a comparison: a way, at its usual settings or at one of a sweep.
#[derive(Debug, Clone)]
pub struct Row {
    /// The mode and the space.
    pub way: Way,
    /// What was set, if anything.
    pub setting: Option<Setting>,
    /// What came of it, or why this way cannot take the problem.
    pub result: Result<Measured, String>,
    /// What it is worth beside the certified run.
    pub verdict: Verdict,
}

impl Row {
    /// The measurement, where there is one.
    pub fn measured(&self) -> Option<&Measured> {
        self.result.as_ref().ok()
    }
}

/// All that was measured on a problem.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// The problem's name.
    pub problem: String,
    /// The length that settings are multiples of.
    pub typical_length: f64,
    /// Each way at its usual settings, in the order of [`Way::all`].
    pub rows: Vec<Row>,
    /// The sweep, if there was one.
    pub sweep: Vec<Row>,
    /// Whether the runs were broken off from outside: what is here is then not all.
    pub interrupted: bool,
}

impl Comparison {
    /// The least median among the rows that closed or ended open, or, where none did, among all.
    pub fn fastest(&self) -> Option<f64> {
        let least = |only_closed: bool| {
            let measured = self.rows.iter().filter_map(Row::measured);
            measured
                .filter(|m| m.came_to_an_end() || !only_closed)
                .map(|m| m.median)
                .min_by(f64::total_cmp)
        };
        least(true).or_else(|| least(false))
    }

    /// Whether what others are judged by is the arc between two ends of a path that a certified run proved, not a closed
    /// path.
    pub fn reference_is_arc(&self) -> bool {
        let is_open = |row: &Row| row.measured().is_some_and(|m| !m.is_closed());
        self.has_reference() && self.certified().all(is_open)
    }

    /// Whether a certified run closed or ended open, so that others can be judged.
    pub fn has_reference(&self) -> bool {
        self.certified().next().is_some()
    }

    /// The certified runs by which others are judged.
    fn certified(&self) -> impl Iterator<Item = &Row> {
        let rows = self.rows.iter();
        rows.filter(|row| row.way.method == Method::Certified && row.verdict == Verdict::Right)
    }
}

/// Runs a problem in all modes and spaces, each several times, and if wanted at the settings of a
/// sweep. A way that cannot take the problem, as it has too many coordinates, is a row that says so.
///
/// Fails where the sketch cannot be seen from the reference, which no way could mend.
pub fn compare(
    problem: &Problem,
    effort: &Effort,
    control: &mut Control,
) -> Result<Comparison, GaugeError> {
    let homotopy = Homotopy::new(problem)?;
    let typical_length = homotopy.unit;
    let matching = Matching::new(&homotopy);
    let mut session = Session::new((problem, &homotopy), effort);
    let mut rows = session.run(Way::all().map(|way| (way, None)), control);
    let reference = Reference::among(&rows, &matching);
    judge::all(&mut rows, reference.as_ref());
    let mut sweep = Vec::new();
    if effort.sweep && !control.is_interrupted() {
        session.limit_length(reference.as_ref().and_then(Reference::length));
        let settings = rows
            .iter()
            .filter(|row| row.result.is_ok())
            .flat_map(|row| {
                let settings = ways::settings(row.way, typical_length);
                settings.map(|setting| (row.way, Some(setting)))
            });
        sweep = session.run(settings, control);
        judge::all(&mut sweep, reference.as_ref());
    }
    Ok(Comparison {
        problem: problem.name.clone(),
        typical_length,
        rows,
        sweep,
        interrupted: control.is_interrupted(),
    })
}
