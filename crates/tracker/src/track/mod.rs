//! Following the path: predictor, corrector, step control, events.

pub mod arc;
#[doc(hidden)]
pub mod certified;
mod choice;
mod control;
mod ends;
mod events;
mod first;
mod flat;
#[doc(hidden)]
pub mod flexible;
mod float;
#[doc(hidden)]
pub mod full;
mod options;
mod outcome;
#[doc(hidden)]
pub mod reduced;
mod signs;
mod stop;
mod turns;
mod witness;

#[doc(hidden)]
pub use certified::prove_figure;
pub use certified::{FigureBox, FiguresSeen, Fold, Relation, Sample, Trace, TubePart};
pub use choice::{prove, solve_in_best_space, trace_path};
pub use control::{Control, Limit, Progress};
pub use ends::{Away, EndKind, PathEnd};
pub use first::{First, first};
pub use options::{Options, Preset};
pub use outcome::{Driving, Mode, Outcome, Place, Solution, Space, Status};
pub use signs::{Signed, Signs, Stand};
pub use stop::{Stop, StopKind};
pub use witness::{TubeSeen, Witness};

use crate::problem::Problem;
use crate::system::{GaugeError, Homotopy};
use outcome::relative_width;

/// Why a run could not even start.
#[derive(Clone, PartialEq, thiserror::Error)]
pub enum StartError {
    /// The reference is degenerate.
    #[error(transparent)]
    Gauge(#[from] GaugeError),
    /// What was asked for cannot be done for this problem.
    #[error("{0}")]
    Unsupported(String),
}

crate::debug_in_words!(StartError);

/// Follows the path through the sketch of `problem`.
///
/// Never panics on a checked problem; a run that cannot go on ends [`Status::Stopped`].
pub fn solve(
    problem: &Problem,
    options: &Options,
    control: &mut Control,
) -> Result<Outcome, StartError> {
    let homotopy = match options.preset {
        Preset::Default => Homotopy::new(problem)?,
        Preset::Paper => Homotopy::for_the_paper(problem)?,
    };
    if !homotopy.tail.is_empty() && options.preset == Preset::Paper {
        return Err(StartError::Unsupported(
            "the paper's preset follows distances between points only, and there are other constraints; \
             leave out the preset"
                .to_owned(),
        ));
    }
    let (what, other) = match (options.mode, options.space) {
        (Mode::Float, Space::Full) => ("the full space keeps", "--space reduced"),
        (Mode::Certified, _) => ("proofs keep", "--mode float --space reduced"),
        (Mode::Float, Space::Reduced) => ("", ""),
    };
    if !what.is_empty() && homotopy.equations > LARGEST_SQUARE {
        return Err(StartError::Unsupported(format!(
            "there are {} free coordinates, more than the {LARGEST_SQUARE} of which {what} square \
             matrices; use {other}",
            homotopy.equations
        )));
    }
    if let Some(step) = options.max_step
        && step < SMALLEST_MAX_STEP * homotopy.unit
    {
        return Err(StartError::Unsupported(format!(
            "the longest step allowed, {step:e}, is too short: at least {:e} is needed to get anywhere",
            SMALLEST_MAX_STEP * homotopy.unit
        )));
    }
    let track = match (options.mode, options.space, options.preset) {
        (Mode::Certified, ..) => certified::track,
        (Mode::Float, Space::Full, Preset::Default) => full::float::track,
        (Mode::Float, Space::Full, Preset::Paper) => full::float::track_paper,
        (Mode::Float, Space::Reduced, _) => reduced::float::track,
    };
    let mut outcome = track(&homotopy, options, control);
    // A run that ends at the sketch has seen that only.
    if outcome.t_range.0 > outcome.t_range.1 {
        outcome.t_range = (0.0, 0.0);
    }
    if let Status::Stopped(reason) = &mut outcome.status {
        let wish = match options.mode {
            Mode::Certified => options
                .tube_radius
                .map(|r| format!("tubes of radius {r:e}")),
            Mode::Float => options.tolerance.map(|x| format!("points good to {x:e}")),
        };
        if options.preset == Preset::Paper {
            let longest = options.max_step.unwrap_or(
                homotopy.unit
                    * match options.space {
                        Space::Full => full::float::LARGEST_STEP_OF_PAPER,
                        Space::Reduced => reduced::float::LARGEST_STEP_OF_PAPER,
                    },
            );
            reason.text += &format!(
                " (the paper's preset takes steps of up to {longest:e} in the lengths of the file)"
            );
        }
        if let Some(wish) = wish {
            reason.text += &format!(" ({wish} were asked for)");
        }
    }
    if let Status::Open(ends) = &mut outcome.status {
        for end in ends.iter_mut() {
            for remark in ends::remarks(problem, &end.points) {
                end.reason = format!("{remark}; {}", end.reason);
            }
        }
    }
    Ok(outcome)
}

/// Most free coordinates but for float runs in the reduced space: the others keep half a dozen dense
/// matrices with as many rows and columns, 288 MB each here (certified ones in the reduced space, as many
/// triangular ones, of two numbers per entry).
#[doc(hidden)]
pub const LARGEST_SQUARE: usize = 6000;

/// Bounds on the step below this, in units of the problem's typical length, are refused: no path
/// would end.
const SMALLEST_MAX_STEP: f64 = 1e-8;
