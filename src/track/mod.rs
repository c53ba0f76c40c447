//! Following the path: predictor, corrector, step control, events.

pub mod certified;
mod control;
pub mod full;
mod options;
mod outcome;

pub use control::{Control, Progress};
pub use options::{Options, Preset};
pub use outcome::{Driving, Mode, Outcome, Solution, Space, Status};

use crate::problem::Problem;
use crate::system::{GaugeError, Homotopy};

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
pub fn solve(
    problem: &Problem,
    options: &Options,
    control: &mut Control,
) -> Result<Outcome, StartError> {
    let homotopy = Homotopy::new(problem)?;
    match (options.mode, options.space, problem.dimension) {
        (Mode::Certified, Space::Full, 2) => Ok(certified::track::<2>(&homotopy, options, control)),
        (Mode::Certified, Space::Full, _) => Ok(certified::track::<3>(&homotopy, options, control)),
        _ => Err(StartError::Unsupported("not built yet".into())),
    }
}
