//! The choice of a space, and what to do where a run in it stops.

use super::{Control, Mode, Options, Outcome, Space, StartError, Status, Trace, solve};
use crate::problem::Problem;
use crate::system::Homotopy;

/// Follows the path through the sketch of `problem`, with proof and all else as it comes: the short way
/// to [`solve_in_best_space`].
///
/// ```
/// use krawl::problem::Problem;
/// use krawl::track::{Status, prove};
///
/// # std::env::set_current_dir("../..").unwrap();
/// let outcome = prove(&Problem::read("problems/octahedron.toml")?)?;
/// assert_eq!(outcome.status, Status::Closed);
/// assert_eq!(outcome.solutions.len(), 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn prove(problem: &Problem) -> Result<Outcome, StartError> {
    solve_in_best_space(problem, &Options::certified(), &mut Control::default())
}

/// Follows the path in the space that suits the mode and the size of the problem, whatever
/// `options.space` says; a certified run that stops in the reduced space is made again in the full
/// space, which has extended precision. [`Outcome::switched_on`] tells of it.
///
/// Errors are those of [`solve`].
pub fn solve_in_best_space(
    problem: &Problem,
    options: &Options,
    control: &mut Control,
) -> Result<Outcome, StartError> {
    let space = match options.mode {
        // Plans in closed form are for distances; without one the full space is faster at most sizes.
        _ if !problem.is_distances_only() => Space::Full,
        Mode::Float => Space::Reduced,
        // A run that stops is made again, which a certificate that is being written cannot be.
        Mode::Certified if control.witness.is_some() => Space::Full,
        Mode::Certified => Space::for_certified(problem.distances.len()),
    };
    let in_space = |space| Options {
        space,
        ..options.clone()
    };
    let outcome = solve(problem, &in_space(space), control)?;
    let Status::Stopped(reason) = &outcome.status else {
        return Ok(outcome);
    };
    if options.mode == Mode::Float || space == Space::Full || control.is_interrupted() {
        return Ok(outcome);
    }
    let remark = format!("full space: in the reduced space the run stopped, {reason}");
    // Where the full space is not to be had, the first run is the result.
    match solve(problem, &in_space(Space::Full), control) {
        Ok(mut second) => {
            second.switched_on.push(remark);
            Ok(second)
        }
        Err(_) => Ok(outcome),
    }
}

/// So far may the path be from the middle of a tube in [`trace_path`], in typical lengths.
const FINE: f64 = 1e-6;

/// Follows the path once more, in tubes so narrow that a picture of their middles is a picture of the path
/// and that its folds are enclosed tightly, and keeps it. The run's own results come with it: they are
/// about the same path, and tell more about folds.
///
/// `options` are those of a certified run; its tubes' radius may be smaller still. Errors are those of
/// [`solve`].
pub fn trace_path(
    problem: &Problem,
    options: &Options,
    control: &mut Control,
) -> Result<(Outcome, Trace), StartError> {
    let fine = FINE * Homotopy::new(problem)?.unit;
    let options = Options {
        mode: Mode::Certified,
        tube_radius: Some(options.tube_radius.map_or(fine, |radius| radius.min(fine))),
        ..options.clone()
    };
    let mut trace = Trace::default();
    let mut control = Control {
        cancel: control.cancel,
        limit: control.limit,
        progress: control
            .progress
            .as_mut()
            .map(|progress| &mut **progress as _),
        pause: control.pause,
        trace: Some(&mut trace),
        ..Control::default()
    };
    let outcome = solve_in_best_space(problem, &options, &mut control)?;
    Ok((outcome, trace))
}
