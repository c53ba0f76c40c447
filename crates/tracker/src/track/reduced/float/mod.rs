//! Following the path in the driving parameters of a construction plan (RR 8705, sections 3 to 7).
//!
//! The unknowns are the driving parameters and t; figures come from evaluating the plan, and the
//! equations are the removed constraints. Prediction looks at the figures, whose path is smooth
//! whatever the plan: it is the cubic through the last two points, seen by the plan through
//! ϕ' (RR 8705, (4)). So a change of plan costs no history, and the step control measures what
//! happens to the figure. That is for distances; `structured` is for other constraints.

use crate::places::array;

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

use crate::plan::{Evaluation, Lanes, Plan, Situation};
use crate::system::Homotopy;
use crate::track::{
    Control, Driving, Mode, Options, Outcome, Preset, Progress, Space, Status, Stop, StopKind,
    observed_solutions,
};
use corrector::Corrector;
pub use paper::LONGEST_STEP as LARGEST_STEP_OF_PAPER;
use path_point::{PathPoint, Piece, distance};
use std::time::Instant;

/// Steps below this end the run.
const SMALLEST_STEP: f64 = 1e-10;

/// Why a run ends where even the smallest step leaves open what lies within it.
const UNCLEAR: &str = "a solution or the sketch cannot be isolated, as if it were singular,";

/// Figures are taken for congruent if their distances agree to this, relative to their size.
const CONGRUENT: f64 = 1e-8;

/// Follows the path through the sketch in the reduced space.
///
/// For [`Preset::Paper`] the homotopy should be in the problem's own unit
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
    started: Instant,
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
    /// a(t) of all distances, for changes of plan.
    lengths: Vec<f64>,
    t_range: (f64, f64),
    length: f64,
    steps: usize,
    rejected: usize,
    plan_changes: usize,
    driving_sum: usize,
    driving_max: usize,
    solutions: Vec<Vec<f64>>,
}

impl<'a> Tracker<'a> {
    fn new(homotopy: &'a Homotopy, options: &'a Options) -> Self {
        let started = Instant::now();
        let plan = Plan::derive(homotopy);
        let evaluation = Evaluation::new(homotopy, &plan, options.alpha);
        let places = homotopy.sketch.len();
        let point = PathPoint::new(places);
        Tracker {
            homotopy,
            options,
            started,
            corrector: Corrector::new(places, options.tolerance_in(homotopy.unit)),
            evaluation,
            plan,
            start: point.clone(),
            previous: point.clone(),
            behind: None,
            current: point.clone(),
            next: point,
            predicted: vec![0.0; places + 1],
            lengths: vec![0.0; homotopy.edges.len()],
            t_range: (0.0, 0.0),
            length: 0.0,
            steps: 0,
            rejected: 0,
            plan_changes: 0,
            driving_sum: 0,
            driving_max: 0,
            solutions: Vec::new(),
        }
    }

    fn run(mut self, control: &mut Control) -> Outcome {
        let status = match self.set_off() {
            Ok(()) if self.options.preset == Preset::Paper => self.follow_as_in_the_paper(control),
            Ok(()) => self.follow(control),
            Err(status) => status,
        };
        self.finish(status)
    }

    /// Algorithm 1, steps 1 and 2, and the orientation: t increases first, or decreases first.
    fn set_off(&mut self) -> Result<(), Status> {
        let places = self.homotopy.sketch.len();
        self.current.z[..places].copy_from_slice(&self.homotopy.sketch);
        self.current.tangent[places] = if self.options.reverse { -1.0 } else { 1.0 };
        // The sketch may well present a boundary configuration of the plan.
        if !self.change_plan(false, 1.0)? {
            self.settle()?;
        }
        self.plan_changes = 0;
        self.start.clone_from(&self.current);
        Ok(())
    }

    /// Algorithm 2 at the current point, with a look at what is ahead if wanted. Original
    /// instructions come back where their γ is more than `restore` times alpha. Returns whether
    /// the plan changed.
    fn change_plan(&mut self, look_ahead: bool, restore: f64) -> Result<bool, Status> {
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
            self.plan_changes += 1;
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
    fn settle(&mut self) -> Result<(), Status> {
        self.evaluation.recover_branch(self.current.figure());
        let PathPoint { z, tangent } = &mut self.current;
        let room = &mut self.next.tangent;
        match self
            .corrector
            .settle(&mut self.evaluation, z, tangent, room)
        {
            true => Ok(()),
            false => {
                let why = "the construction plan has no figure or no tangent";
                Err(self.stopped(StopKind::NoStep, why))
            }
        }
    }

    fn progress(&self) -> Progress {
        Progress {
            t: self.current.t(),
            steps: self.steps,
            solutions: self.solutions.len(),
            length: self.length,
        }
    }

    /// Makes `next`, which is `h` away, the current point. The path is measured up to the arc
    /// length `s`, less than `h` only where it ends.
    fn advance(&mut self, h: f64, s: f64) {
        let piece = Piece::new(&self.current, &self.next, h);
        self.length += piece.length(s, self.homotopy.unit);
        let t = piece.t();
        let (turns, count) = t.turning_points();
        for at in turns[..count]
            .iter()
            .copied()
            .filter(|&at| at < s)
            .chain([s])
        {
            let t = t.value(at);
            self.t_range = (self.t_range.0.min(t), self.t_range.1.max(t));
        }
        std::mem::swap(&mut self.previous, &mut self.current);
        std::mem::swap(&mut self.current, &mut self.next);
        self.behind = Some(h);
        self.steps += 1;
        let d = self.evaluation.driving();
        self.driving_sum += d;
        self.driving_max = self.driving_max.max(d);
    }

    /// The arc length from the current point to the next, from chord and turn.
    fn arc_length(&self) -> f64 {
        let chord = distance(&self.current.z, &self.next.z);
        let turn = distance(&self.current.tangent, &self.next.tangent);
        chord * (1.0 + turn * turn / 24.0)
    }

    fn no_step(&self) -> Status {
        let smallest = SMALLEST_STEP * self.homotopy.unit;
        let why = format!("no step succeeds, even of {smallest:.1e},");
        self.stopped(StopKind::NoStep, &why)
    }

    fn stopped(&self, kind: StopKind, why: &str) -> Status {
        let words = format!(
            "{why} at t = {:.9} after {} steps{}",
            self.current.t(),
            self.steps,
            self.homotopy.remark_on_lengths(self.current.t())
        );
        Status::Stopped(Stop::new(kind, words))
    }

    fn finish(self, status: Status) -> Outcome {
        let unit = self.homotopy.unit;
        let figures: Vec<Vec<[f64; 3]>> = self
            .solutions
            .iter()
            .map(|figure| {
                let points = figure.chunks_exact(self.homotopy.dimension);
                points
                    .map(|p| array(|k| p.get(k).map_or(0.0, |x| x * unit)))
                    .collect()
            })
            .collect();
        Outcome {
            signed: None,
            mode: Mode::Float,
            space: Space::Reduced,
            status,
            solutions: observed_solutions(figures, CONGRUENT),
            steps: self.steps,
            rejected: self.rejected,
            plan_changes: self.plan_changes,
            driving: Driving {
                average: self.driving_sum as f64 / self.steps.max(1) as f64,
                max: self.driving_max,
            },
            length: self.length,
            t_range: self.t_range,
            seconds: self.started.elapsed().as_secs_f64(),
            switched_on: Vec::new(),
        }
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
