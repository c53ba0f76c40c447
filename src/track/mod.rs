//! Following the path: predictor, corrector, step control, events.

mod congruence;
mod control;
mod options;
mod outcome;
pub mod reduced;

pub use congruence::congruence_classes;
pub use control::{Control, Progress};
pub use options::{Options, Preset};
pub use outcome::{Driving, Mode, Outcome, Solution, Space, Status};

use crate::problem::Problem;
use crate::system::GaugeError;

/// Why a run could not even start.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StartError {
    /// The reference is degenerate.
    #[error(transparent)]
    Gauge(#[from] GaugeError),
    /// Certified mode has no reduced space yet, and the like.
    #[error("{0}")]
    Unsupported(String),
}

/// Follows the path through the sketch of `problem`.
///
/// Never panics on a checked problem; a run that cannot go on ends [`Status::Stopped`].
pub fn solve(problem: &Problem, options: &Options, control: &mut Control) -> Result<Outcome, StartError> {
    let _ = (problem, options, control);
    Err(StartError::Unsupported("not built yet".into()))
}
