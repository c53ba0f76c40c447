//! Following the path in the driving parameters of a construction plan (RR 8705, sections 3 to 7).
//!
//! The unknowns are the driving parameters and t; figures come from evaluating the plan, and the
//! equations are the removed constraints. Prediction looks at the figures, whose path is smooth
//! whatever the plan: it is the cubic through the last two stations, seen by the plan through
//! ϕ' (RR 8705, (4)). So a change of plan costs no history, and the step control measures what
//! happens to the figure.

mod corrector;
mod cubic;
mod elimination;
mod events;
mod paper;
mod station;
mod steps;

use super::congruence_classes;
use super::{Control, Driving, Mode, Options, Outcome, Preset, Progress, Solution, Space, StartError, Status};
use crate::interval::point;
use crate::plan::{Evaluation, Lanes, Lookout, Plan};
use crate::system::Homotopy;
use corrector::Corrector;
use station::Station;
use std::time::Instant;

/// Steps below this end the run.
const SMALLEST_STEP: f64 = 1e-10;

/// Figures are taken for congruent if their distances agree to this, relative to their size.
const CONGRUENT: f64 = 1e-8;

/// Follows the path through the sketch in the reduced space.
///
/// For [`Preset::Paper`] the homotopy should be in the problem's own unit
/// ([`Homotopy::with_unit`] with 1). What comes out is an observation: nothing is proved. A run
/// that cannot go on ends [`Status::Stopped`], with what it has found.
pub fn track(homotopy: &Homotopy, options: &Options, control: &mut Control) -> Result<Outcome, StartError> {
    match homotopy.dimension {
        2 => Ok(Tracker::<2>::new(homotopy, options).run(control)),
        3 => Ok(Tracker::<3>::new(homotopy, options).run(control)),
        other => Err(StartError::Unsupported(format!("no construction plans in dimension {other}"))),
    }
}

/// What moves while the path is followed.
struct Tracker<'a, const D: usize> {
    homotopy: &'a Homotopy,
    options: &'a Options,
    started: Instant,
    plan: Plan,
    evaluation: Evaluation<D>,
    corrector: Corrector,
    start: Station,
    /// The station before the current one and the arc length from it, once there is one.
    previous: Station,
    behind: Option<f64>,
    current: Station,
    next: Station,
    predicted: Vec<f64>,
    /// a(t) of all distances, for changes of plan.
    lengths: Vec<f64>,
    t_range: (f64, f64),
    length: f64,
    steps: usize,
    rejected: usize,
    /// Rejected steps since the last accepted one.
    failures: usize,
    plan_changes: usize,
    driving_sum: usize,
    driving_max: usize,
    solutions: Vec<Vec<f64>>,
}

impl<'a, const D: usize> Tracker<'a, D> {
    fn new(homotopy: &'a Homotopy, options: &'a Options) -> Self {
        let started = Instant::now();
        let plan = Plan::derive(homotopy);
        let evaluation = Evaluation::new(homotopy, &plan, options.alpha);
        let places = homotopy.sketch.len();
        let station = Station::new(places);
        Tracker {
            homotopy,
            options,
            started,
            corrector: Corrector::new(places),
            evaluation,
            plan,
            start: station.clone(),
            previous: station.clone(),
            behind: None,
            current: station.clone(),
            next: station,
            predicted: vec![0.0; places + 1],
            lengths: vec![0.0; homotopy.edges.len()],
            t_range: (0.0, 0.0),
            length: 0.0,
            steps: 0,
            rejected: 0,
            failures: 0,
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
            Err(reason) => Status::Stopped(reason),
        };
        self.finish(status)
    }

    /// Algorithm 1, steps 1 and 2, and the orientation: t increases first, or decreases first.
    fn set_off(&mut self) -> Result<(), String> {
        let places = self.homotopy.sketch.len();
        self.current.z[..places].copy_from_slice(&self.homotopy.sketch);
        self.change_plan(false, self.options.alpha);
        self.plan_changes = 0;
        self.current.tangent[places] = if self.options.reverse { -1.0 } else { 1.0 };
        if !self.settle() {
            return Err("the path has no tangent at the sketch, or the plan no figure".into());
        }
        self.start.clone_from(&self.current);
        Ok(())
    }

    /// Algorithm 2 at the current station, and what is ahead if that is to be looked at. Returns
    /// whether the plan changed; [`Tracker::settle`] is then due.
    fn change_plan(&mut self, look_ahead: bool, restore: f64) -> bool {
        let t = self.current.t();
        for (out, length) in self.lengths.iter_mut().zip(&self.homotopy.lengths) {
            *out = length.value(t);
        }
        let places = self.homotopy.sketch.len();
        let at = Lookout {
            figure: self.current.figure(),
            ahead: look_ahead.then(|| &self.predicted[..places]),
            lengths: &self.lengths,
            alpha: self.options.alpha,
            restore,
        };
        let changed = self.plan.change(&at);
        self.plan_changes += changed as usize;
        changed
    }

    /// Takes over the plan at the current station: parameters, branch, tangent.
    fn settle(&mut self) -> bool {
        self.evaluation.rebuild(self.homotopy, &self.plan);
        self.evaluation.recover_branch(self.current.figure());
        let Station { z, tangent } = &mut self.current;
        self.corrector.settle(&mut self.evaluation, z, tangent, &mut self.next.tangent)
    }

    fn progress(&self) -> Progress {
        Progress {
            t: self.current.t(),
            steps: self.steps,
            solutions: self.solutions.len(),
            length: self.length,
        }
    }

    /// Makes `next` the current station.
    fn advance(&mut self, h: f64) {
        std::mem::swap(&mut self.previous, &mut self.current);
        std::mem::swap(&mut self.current, &mut self.next);
        self.behind = Some(h);
        self.steps += 1;
        let d = self.evaluation.driving();
        self.driving_sum += d;
        self.driving_max = self.driving_max.max(d);
    }

    fn place(&self) -> String {
        format!("at t = {}, step {}", self.current.t(), self.steps)
    }

    fn finish(self, status: Status) -> Outcome {
        let unit = self.homotopy.unit;
        let figures: Vec<Vec<[f64; 3]>> = self
            .solutions
            .iter()
            .map(|figure| {
                let points = figure.as_chunks::<D>().0.iter();
                points.map(|p| std::array::from_fn(|k| if k < D { p[k] * unit } else { 0.0 })).collect()
            })
            .collect();
        let classes = congruence_classes(&figures, CONGRUENT);
        let solutions = figures
            .into_iter()
            .zip(classes)
            .map(|(figure, class)| Solution {
                points: figure.into_iter().map(|p| p.map(point)).collect(),
                class,
                width: 0.0,
            })
            .collect();
        Outcome {
            mode: Mode::Float,
            space: Space::Reduced,
            status,
            solutions,
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

/// Where a group of four has parameter `j`.
fn lane(x: &[Lanes], j: usize) -> f64 {
    x[j / 4].0[j % 4]
}
