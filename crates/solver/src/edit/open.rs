//! From a sketch to a figure that meets its dimensions.

use super::ending::Ending;
use super::segments::{self, first_lost, in_narrower_tubes};
use super::whole::narrower;
use crate::interval::{Interval, point};
use crate::problem::Problem;
use crate::system::{GaugeError, is_met};
use crate::track::arc::{ArcEnd, ArcRun, Figure};
use crate::track::certified::FollowArcs;
use crate::track::{Control, Options, StartError, Stop, StopKind};

/// Why a file holds no figure to edit.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// The path cannot even be set up.
    #[error(transparent)]
    Start(#[from] StartError),
    /// The sketch cannot be led to its own dimensions.
    #[error(
        "the sketch does not meet its own dimensions, and could not be led to them: {what}. An edit begins with a \
         figure that meets its dimensions, at least nearly: take one of the figures that `krawl solve` finds, or see there \
         which dimension is out of reach"
    )]
    Correction {
        /// How that ended, in words.
        what: String,
        /// How the path that was to lead the sketch to its dimensions ended, as a value to be matched on.
        ending: Box<Ending>,
    },
}

impl OpenError {
    /// Of a sketch on whose way to its dimensions the proof ended.
    pub(super) fn stopped(stop: Stop) -> Self {
        OpenError::Correction {
            what: stop.text.clone(),
            ending: Box::new(Ending::Stopped(stop)),
        }
    }
}

impl From<GaugeError> for OpenError {
    fn from(error: GaugeError) -> Self {
        OpenError::Start(error.into())
    }
}

/// How far the sketch was from a figure that meets its dimensions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moved {
    /// No point was moved further than this from where the sketch has it (its reference standing still).
    pub distance: f64,
    /// Tubes that it took; 0 where the sketch meets its dimensions exactly.
    pub tubes: usize,
}

/// Leads the sketch to its own dimensions; distances then stand still in the homotopy of `arcs`, and what is said of other
/// constraints has to be set anew. The homotopy must be that of the problem without a bend.
pub(super) fn correct(
    problem: &Problem,
    (arcs, options): (&mut dyn FollowArcs, &Options),
    control: &mut Control,
) -> Result<(Figure, Moved), OpenError> {
    let homotopy = arcs.homotopy_mut();
    let start = Figure::of_sketch(homotopy);
    // What other constraints say of the sketch is not looked at.
    let mut all_met = homotopy.edges.len() == homotopy.equations;
    for (index, distance) in problem.distances.iter().enumerate() {
        if is_met(problem, index) {
            homotopy.hold(index, &distance.target);
        } else {
            all_met = false;
        }
    }
    let unit = homotopy.unit;
    if all_met {
        return Ok((start, Moved::default()));
    }
    if let Some(witness) = &mut control.witness {
        witness.begin_arc(&[]);
    }
    let mut run = arcs.follow(&start, control);
    if let Some(witness) = &mut control.witness {
        witness.end_arc(&run);
    }
    let mut control = Control {
        cancel: control.cancel,
        limit: control.limit,
        ..Control::default()
    };
    let is_lost = |(): &(), run: &ArcRun| first_lost(&run.segments, run.t, |_| false).is_some();
    in_narrower_tubes(&mut (), &mut run, is_lost, |(), radius| {
        narrower(arcs.homotopy(), options, radius).follow(&start, &mut control)
    });
    if let Some((kept, _)) = first_lost(&run.segments, run.t, |_| false) {
        return Err(OpenError::stopped(segments::stop(problem, kept)));
    }
    let figure = reached(run.end, run.t)?;
    let homotopy = arcs.homotopy_mut();
    for (index, distance) in problem.distances.iter().enumerate() {
        homotopy.hold(index, &distance.target);
    }
    let distance = furthest(&start.points(homotopy), &figure.points(homotopy)) * unit;
    Ok((
        figure,
        Moved {
            distance,
            tubes: run.steps,
        },
    ))
}

/// The figure that meets the dimensions of a sketch, or why the way there ends before, at `t`.
pub(super) fn reached(end: ArcEnd, t: (f64, f64)) -> Result<Figure, OpenError> {
    match end {
        ArcEnd::Reached(figure) => Ok(figure),
        ArcEnd::Limit(_) => {
            let what = format!(
                "on the way there, at t = {:.6}, the figure comes to a limit and turns back",
                t.0
            );
            Err(OpenError::stopped(Stop::new(StopKind::TurnsBack, what)))
        }
        ArcEnd::Passes(reason) => Err(OpenError::Correction {
            what: format!("on the way there branches seem to meet ({reason})"),
            ending: Box::new(Ending::Passes(reason)),
        }),
        ArcEnd::Stopped(reason) => Err(OpenError::stopped(reason)),
    }
}

/// A bound on the distance of any point in one figure from the same in the other.
pub(super) fn furthest(a: &[[Interval; 3]], b: &[[Interval; 3]]) -> f64 {
    let distances = a.iter().zip(b).map(|(a, b)| {
        let sum = (0..3).fold(point(0.0), |sum, k| sum + (a[k] - b[k]).sqr());
        sum.sqrt().sup()
    });
    distances.fold(0.0, f64::max)
}
