//! Following the path in the driving parameters of a construction plan (RR 8705, sections 3 to 7).
//!
//! The unknowns are the driving parameters and t; figures come from evaluating the plan, and the
//! equations are the removed constraints. Prediction looks at the figures, whose path is smooth
//! whatever the plan: it is the cubic through the last two points, seen by the plan through
//! ϕ' (RR 8705, (4)). So a change of plan costs no history, and the step control measures what
//! happens to the figure. That is for distances; `structured` is for other constraints.

mod corrector;
mod cubic;
mod elimination;
mod events;
mod paper;
mod path_point;
mod steps;
mod structured;
#[cfg(test)]
mod tests;

use crate::plan::{Differences, Evaluation, Lanes, Plan, Situation};
use crate::system::Homotopy;
use crate::track::float::Record;
use crate::track::reduced::plans::Plans;
use crate::track::{Control, Options, Outcome, Space, Status, Stop, StopKind};
use corrector::Corrector;
pub use paper::LONGEST_STEP as LARGEST_STEP_OF_PAPER;
use path_point::{PathPoint, Piece, distance};

/// Figures are taken for congruent if their distances agree to this, relative to their size.
const CONGRUENT: f64 = 1e-8;

/// Follows the path through the sketch in the reduced space.
///
/// For the preset of the paper the homotopy should be in the problem's own unit
/// ([`Homotopy::with_unit`] with 1). What comes out is an observation: nothing is proved. A run
/// that cannot go on ends [`Status::Stopped`], with what it has found.
pub fn track(homotopy: &Homotopy, options: &Options, control: &mut Control) -> Outcome {
    if !homotopy.tail.is_empty() {
        return structured::track(homotopy, options, control);
    }
    Tracker::new(homotopy, options).run(control)
}

/// What moves while the path is followed.
struct Tracker<'a> {
    homotopy: &'a Homotopy,
    options: &'a Options,
    record: Record,
    plan: Plan,
    evaluation: Evaluation,
    corrector: Corrector,
    start: PathPoint,
    /// The point before the current one and the arc length from it, once there is one.
    previous: PathPoint,
    behind: Option<f64>,
    current: PathPoint,
    next: PathPoint,
    predicted: Vec<f64>,
    /// Changes of plan since the current point because of what is ahead.
    looks: usize,
    /// For derivatives as in the paper.
    differences: Differences,
    /// a(t) of all distances, for changes of plan.
    lengths: Vec<f64>,
    plans: Plans,
}

impl<'a> Tracker<'a> {
    fn new(homotopy: &'a Homotopy, options: &'a Options) -> Self {
        let record = Record::new();
        let plan = Plan::derive(homotopy);
        let evaluation = Evaluation::new(homotopy, &plan, options.alpha);
        let places = homotopy.sketch.len();
        let point = PathPoint::new(places);
        Tracker {
            homotopy,
            options,
            record,
            corrector: Corrector::new(places, options.tolerance_in(homotopy.unit)),
            evaluation,
            plan,
            start: point.clone(),
            previous: point.clone(),
            behind: None,
            current: point.clone(),
            next: point,
            predicted: vec![0.0; places + 1],
            looks: 0,
            differences: Differences::default(),
            lengths: vec![0.0; homotopy.edges.len()],
            plans: Plans::default(),
        }
    }

    fn run(mut self, control: &mut Control) -> Outcome {
        let status = match self.set_off().and_then(|()| self.follow(control)) {
            Ok(()) => Status::Closed,
            Err(stop) => Status::Stopped(stop),
        };
        Outcome {
            space: Space::Reduced,
            plan_changes: self.plans.changes,
            driving: self.plans.driving(),
            ..self.record.into_outcome(self.homotopy, status, CONGRUENT)
        }
    }

    /// Algorithm 1, steps 1 and 2, and the orientation: t increases first, or decreases first.
    fn set_off(&mut self) -> Result<(), Stop> {
        self.record.meet(0.0);
        let places = self.homotopy.sketch.len();
        self.current.z[..places].copy_from_slice(&self.homotopy.sketch);
        self.current.tangent[places] = if self.options.reverse { -1.0 } else { 1.0 };
        // The sketch may well present a boundary configuration of the plan.
        if !self.change_plan(false, 1.0)? {
            self.settle()?;
        }
        self.plans.changes = 0;
        self.start.clone_from(&self.current);
        Ok(())
    }

    /// Algorithm 2 at the current point, with a look at what is ahead if wanted. Original
    /// instructions come back where their γ is more than `restore` times alpha. Returns whether
    /// the plan changed.
    fn change_plan(&mut self, look_ahead: bool, restore: f64) -> Result<bool, Stop> {
        measure_lengths(self.homotopy, self.current.t(), &mut self.lengths);
        let alpha = self.options.alpha;
        let changed = self.plan.change(&Situation {
            figure: self.current.figure(),
            ahead: look_ahead.then(|| &self.predicted[..self.homotopy.sketch.len()]),
            lengths: &self.lengths,
            alpha,
            restore: restore * alpha,
        });
        if changed {
            self.plans.changes += 1;
            self.evaluation.rebuild(self.homotopy, &self.plan);
            self.settle()?;
        }
        Ok(changed)
    }

    /// Whether Algorithm 2 would restore an original instruction.
    fn plan_is_restorable(&mut self, restore: f64) -> bool {
        if self.plan.is_original() {
            return false;
        }
        measure_lengths(self.homotopy, self.current.t(), &mut self.lengths);
        let alpha = self.options.alpha;
        self.plan.restorable(&Situation {
            figure: self.current.figure(),
            ahead: None,
            lengths: &self.lengths,
            alpha,
            restore: restore * alpha,
        })
    }

    /// Takes over the plan at the current point: branch, parameters, tangent.
    fn settle(&mut self) -> Result<(), Stop> {
        self.evaluation.recover_branch(self.current.figure());
        let PathPoint { z, tangent } = &mut self.current;
        let room = &mut self.next.tangent;
        match self
            .corrector
            .settle(&mut self.evaluation, z, tangent, room)
        {
            true => Ok(()),
            false => {
                let t = self.current.t();
                let words = format!(
                    "the construction plan has no figure or no tangent {}{}",
                    self.record.place(t),
                    self.homotopy.remark_on_lengths(t)
                );
                Err(Stop::new(StopKind::NoStep, words))
            }
        }
    }

    /// Makes `next`, which is `h` away, the current point. The path is measured up to the arc
    /// length `s`, less than `h` only where it ends.
    fn advance(&mut self, h: f64, s: f64) {
        let piece = Piece::new(&self.current, &self.next, h);
        self.record.length += piece.length(s, self.homotopy.unit);
        let t = piece.t();
        let (turns, count) = t.turning_points();
        for at in turns[..count]
            .iter()
            .copied()
            .filter(|&at| at < s)
            .chain([s])
        {
            self.record.meet(t.value(at));
        }
        std::mem::swap(&mut self.previous, &mut self.current);
        std::mem::swap(&mut self.current, &mut self.next);
        self.behind = Some(h);
        self.record.steps += 1;
        self.plans.count(self.evaluation.driving());
    }

    /// The arc length from the current point to the next, from chord and turn.
    fn arc_length(&self) -> f64 {
        let chord = distance(&self.current.z, &self.next.z);
        let turn = distance(&self.current.tangent, &self.next.tangent);
        chord * (1.0 + turn * turn / 24.0)
    }
}

/// a(t) of all distances.
fn measure_lengths(homotopy: &Homotopy, t: f64, out: &mut [f64]) {
    for (out, length) in out.iter_mut().zip(&homotopy.lengths) {
        *out = length.value(t);
    }
}

/// Where a group of four has parameter `j`.
fn lane(x: &[Lanes], j: usize) -> f64 {
    x[j / 4].0[j % 4]
}
