//! The solution to which the sketch moves without a fold, and nothing beyond it.

use super::arc::{ArcEnd, ArcRun, Figure};
use super::certified::arcs;
use super::{
    Control, LARGEST_SQUARE, Mode, Options, Outcome, Place, Solution, Space, StartError, Status,
    Stop, StopKind, relative_width,
};
use crate::interval::point;
use crate::problem::Problem;
use crate::system::Homotopy;
use std::time::Instant;

/// What comes of a run that ends at the first solution.
#[derive(Debug, Clone, PartialEq)]
pub struct First {
    /// The run: it holds that solution, reached with dt/ds > 0 all the way, or none.
    pub outcome: Outcome,
    /// Where it holds none because the path turns back before t = 1: bounds on t there, proved.
    pub turns_at: Option<(f64, f64)>,
}

/// Follows the path from the sketch as long as t rises, with proof, up to t = 1 or to where it turns back: only the first
/// arc of the path that [`solve`](super::solve) follows as a whole. It is made in the space that suits the size of the
/// problem, or in `space`.
///
/// # Errors
/// The errors of [`solve`](super::solve).
///
/// ```
/// use krawl::problem::Problem;
/// use krawl::track::{Control, Options, first};
/// # std::env::set_current_dir("../..").unwrap();
/// let problem = Problem::read("problems/octahedron.toml")?;
/// let found = first(&problem, None, &Options::certified(), &mut Control::default())?;
/// assert_eq!(found.outcome.solutions.len(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn first(
    problem: &Problem,
    space: Option<Space>,
    options: &Options,
    control: &mut Control,
) -> Result<First, StartError> {
    let clock = Instant::now();
    let homotopy = Homotopy::new(problem)?;
    if homotopy.equations > LARGEST_SQUARE {
        return Err(StartError::Unsupported(format!(
            "there are {} free coordinates, more than the {LARGEST_SQUARE} of which proofs keep square matrices",
            homotopy.equations
        )));
    }
    let best = match (problem.is_distances_only(), space) {
        (false, _) => Space::Full,
        (true, Some(space)) => space,
        (true, None) => Space::for_certified(problem.distances.len()),
    };
    let run_in = |space: Space, control: &mut Control| {
        let options = Options {
            mode: Mode::Certified,
            space,
            reverse: false,
            ..options.clone()
        };
        let mut arcs = arcs(homotopy.clone(), &options);
        arcs.follow(&Figure::of_sketch(&homotopy), control)
    };
    let mut run = run_in(best, control);
    let mut used = best;
    if let (ArcEnd::Passes(reason) | ArcEnd::Stopped(reason), Space::Reduced, None) =
        (&run.end, best, space)
        && !control.is_interrupted()
    {
        let remark = format!("full space: in the reduced space the run stopped, {reason}");
        run = run_in(Space::Full, control);
        used = Space::Full;
        run.switched_on.push(remark);
    }
    Ok(account(&homotopy, used, run, clock))
}

fn account(homotopy: &Homotopy, space: Space, run: ArcRun, clock: Instant) -> First {
    let (mut turns_at, mut solutions) = (None, Vec::new());
    let reason = match &run.end {
        ArcEnd::Reached(figure) => {
            solutions.push(solution(homotopy, figure, run.length));
            Stop::new(
                StopKind::Enough,
                "only the first solution was asked for, and the run ended there",
            )
        }
        ArcEnd::Limit(_) => {
            turns_at = Some(run.t);
            Stop::new(
                StopKind::TurnsBack,
                format!(
                    "the path turns back at t = {:.9}, before t = 1, and no more than its first arc was asked for",
                    0.5 * (run.t.0 + run.t.1)
                ),
            )
        }
        ArcEnd::Passes(reason) => {
            let words = format!("branches of figures seem to meet there ({reason})");
            Stop::new(reason.kind, words)
        }
        ArcEnd::Stopped(reason) => reason.clone(),
    };
    First {
        turns_at,
        outcome: Outcome {
            solutions,
            steps: run.steps,
            rejected: run.rejected,
            length: run.length,
            t_range: (0.0, run.t.1),
            seconds: clock.elapsed().as_secs_f64(),
            switched_on: run.switched_on,
            ..Outcome::new(Mode::Certified, space, Status::Stopped(reason))
        },
    }
}

fn solution(homotopy: &Homotopy, figure: &Figure, arc: f64) -> Solution {
    let unit = point(homotopy.unit);
    let mut points = figure.points(homotopy);
    for x in points.iter_mut().flatten() {
        *x *= unit;
    }
    let unknown = |i: usize| figure.enclosure(i);
    let objects = homotopy.locate(&points, &unknown);
    Solution {
        width: relative_width(&points, &objects),
        objects,
        auxiliary: homotopy.auxiliary_unknowns().map(unknown).collect(),
        points,
        class: 0,
        place: Some(Place {
            arc,
            rising: true,
            folds: Some(0),
        }),
        mirror_of: None,
        is_degenerate: false,
    }
}
