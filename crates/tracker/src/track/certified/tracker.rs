//! The chain of tubes from the sketch back to the sketch.

mod arc;
mod creep;
mod crossing;
mod extension;
mod open;
mod pace;
mod parts;
mod sketch;
mod starts;
mod step;
mod step_control;
mod test;
mod two_ways;
mod words;

use super::ledger::Ledger;
use super::link::{Ball, Tube};
use super::reasons::Rejection;
use super::solution::SolutionProver;
use crate::interval::ZERO;
use crate::interval::rounding::round_up;
use crate::linalg::Vector;
use crate::system::Homotopy;
use crate::track::arc::Figure;
use crate::track::ends::size_of;
use crate::track::full::{Equations, InverseMaker};
use crate::track::{
    Control, Mode, Options, Outcome, Progress, Space, Status, Stop, StopKind, TubeSeen,
};
use arc::Arc;
use creep::Creep;
use crossing::{Beyond, Crossing, TRIALS};
use extension::Extension;
use open::{CameTo, Halt};
use pace::Pace;
use parts::{LEAST_WEIGHT, LEFT_OUT, Parts};
use std::borrow::Cow;
use std::time::Instant;
use step_control::StepControl;
use two_ways::Way;

pub use arc::Arcs;
pub use test::Test;

/// The path leaves a tube at this fraction of its half length, so that there is room behind the
/// exit for a crossing of t = 1 that falls on it.
const EXIT: f64 = 0.97;
/// Accuracy of points on the path, in the homotopy's unit: far below the tubes' radii, which is
/// all that is asked of them. Proofs do not depend on it.
const POINT_TOLERANCE: f64 = 1e-9;
/// Follows the path and proves every step by a test: from the sketch, or from a figure at t = 0 that `start` holds, the only
/// one in it.
pub fn track<const N: usize, T: Test<N>>(
    homotopy: &Homotopy,
    start: Option<&Figure>,
    options: &Options,
    control: &mut Control,
) -> Outcome {
    let clock = Instant::now();
    let mut tracker = Tracker::<N, T>::new(Cow::Borrowed(homotopy), options);
    if let Some(start) = start {
        tracker.begin(start);
    }
    tracker.crossing = Crossing::new(homotopy);
    if let Some(witness) = &mut control.witness {
        witness.begin(homotopy.unit);
    }
    if let Some(trace) = &mut control.trace {
        trace.begin(homotopy);
    }
    let result = match two_ways::is_wanted(homotopy, options, control) {
        true => tracker.run_both_ways(options, control),
        false => tracker.run(options, control),
    };
    let mut status = match result {
        Ok(()) => Status::Closed,
        Err(halt) => match tracker.path_end(halt) {
            Ok(end) => tracker.other_way(end, options, control),
            Err(halt) => Status::Stopped(tracker.with_flexibility(halt)),
        },
    };
    let checked = match status {
        Status::Closed => tracker.ledger.check_closed(homotopy),
        Status::Open(_) => tracker.ledger.lengths_are_positive(homotopy),
        Status::Stopped(_) => Ok(()),
    };
    let of_all = |stop: Stop| {
        let words = format!("{stop} (on a path of {} tubes)", tracker.steps);
        Status::Stopped(stop.in_words(words))
    };
    if let Err(stop) = checked {
        status = of_all(stop);
    }
    let solutions = match tracker.ledger.solutions(homotopy) {
        Ok(solutions) => solutions,
        Err((stop, solutions)) => {
            if !matches!(status, Status::Stopped(_)) {
                status = of_all(stop);
            }
            solutions
        }
    };
    if let Some(witness) = &mut control.witness {
        // In the order in which they were seen: those ahead, then those behind the sketch from there.
        let seen = tracker.behind..solutions.len();
        let seen = seen.chain((0..tracker.behind.min(solutions.len())).rev());
        let mut numbers = Vec::new();
        let classes: Vec<usize> = seen
            .map(|k| {
                let class = solutions[k].class;
                let known = numbers.iter().position(|&other| other == class);
                known.unwrap_or_else(|| {
                    numbers.push(class);
                    numbers.len() - 1
                })
            })
            .collect();
        witness.end(&status, &classes);
    }
    if let Some(seen) = &mut control.figures {
        seen.solutions = tracker.ledger.found().to_vec();
    }
    let (plan_changes, driving) = tracker.test.plans();
    Outcome {
        solutions,
        steps: tracker.steps,
        rejected: tracker.rejected,
        plan_changes,
        driving,
        length: tracker.ledger.length,
        t_range: tracker.ledger.t_range,
        seconds: clock.elapsed().as_secs_f64(),
        switched_on: tracker.switched_on(),
        ..Outcome::new(Mode::Certified, T::SPACE, status)
    }
}

#[derive(Debug)]
struct Tracker<'a, const N: usize, T: Test<N>> {
    homotopy: Cow<'a, Homotopy>,
    equations: Equations,
    /// For the direction at the sketch and for boxes around solutions.
    inverter: InverseMaker,
    test: T,
    ledger: Ledger,
    now: Tube<N, T::Frame>,
    next: Tube<N, T::Frame>,
    /// The point of the tube before, if there is one.
    previous: Vector,
    has_previous: bool,
    sketch: Ball,
    /// The direction of travel at the sketch.
    first_normal: Vector,
    steps: usize,
    rejected: usize,
    shortened: usize,
    extension: Extension,
    /// What a run keeps whose end is t = 1; those whose end is the sketch again have none.
    arc: Option<Arc>,
    /// What it keeps if it may meet flat figures at t = 1.
    crossing: Option<Crossing>,
    /// Where it ends if it is a piece of another run.
    beyond: Option<Beyond>,
    /// Whether the tube around the sketch was proved.
    has_set_out: bool,
    /// [`Options::both_ways`].
    goes_both_ways: bool,
    /// How far the last tubes lead.
    creep: Creep,
    /// How many tubes it takes to get twice as far.
    pace: Pace,
    /// Proves figures with t = 0, once somebody wants them.
    at_start: Option<Box<SolutionProver>>,
    /// How many of the solutions were found the other way from the sketch: the first ones.
    behind: usize,
    /// The run that goes the other way at the same time, if there is one.
    way: Option<Way>,
    /// The tubes of both if they met.
    ways: Option<[usize; 2]>,
    /// The largest coordinate of the sketch (of an arc's first figure), or 1 if that is more.
    size_of_sketch: f64,
    /// h |z_ORDER|^(1/(ORDER − 1)) of the last tube, which is nearly the same for all; NaN where h was cut
    /// short, where the test does not foresee it, and after the first attempt: what is foreseen may be wrong.
    typical: f64,
}

impl<'a, const N: usize, T: Test<N>> Tracker<'a, N, T> {
    fn new(homotopy: Cow<'a, Homotopy>, options: &Options) -> Self {
        let equations = Equations::new(&homotopy);
        let vector = || equations.vector();
        let mut sketch = Ball::new(&equations);
        sketch.hold(&Figure::of_sketch(&homotopy), ZERO);
        let size_of_sketch = size_of(&homotopy, &sketch.centre[..]);
        Tracker {
            inverter: equations.inverter(),
            test: T::new(&homotopy, &equations, options),
            ledger: Ledger::new(&homotopy, &equations),
            homotopy,
            now: Tube::new(&equations),
            next: Tube::new(&equations),
            previous: vector(),
            has_previous: false,
            sketch,
            first_normal: vector(),
            steps: 0,
            rejected: 0,
            shortened: 0,
            extension: Extension::default(),
            arc: None,
            crossing: None,
            beyond: None,
            has_set_out: false,
            goes_both_ways: options.both_ways,
            creep: Creep::default(),
            pace: Pace::default(),
            at_start: None,
            behind: 0,
            way: None,
            ways: None,
            size_of_sketch,
            typical: f64::NAN,
            equations,
        }
    }

    fn run(&mut self, options: &Options, control: &mut Control) -> Result<(), Halt> {
        // Many short runs one after the other, as those of a sweep, end here.
        if control.is_interrupted() {
            let words = "interrupted before the first tube";
            return Err(Stop::new(StopKind::Interrupted, words).into());
        }
        let max_h = self.longest(options);
        let is_done = self.start(options, max_h)?;
        self.show_tube(control, 0, false);
        self.note_starts(control);
        match is_done {
            true => Ok(()),
            false => self.go_on(options, max_h, control),
        }
    }

    /// The longest half length of a tube.
    fn longest(&self, options: &Options) -> f64 {
        let max_h = options
            .step_in(self.homotopy.unit)
            .map_or(f64::INFINITY, |step| 0.5 * step);
        match self.arc {
            Some(_) => max_h.min(arc::LONGEST),
            None => max_h,
        }
    }

    /// Adds tubes to the last one until the path ends.
    fn go_on(&mut self, options: &Options, max_h: f64, control: &mut Control) -> Result<(), Halt> {
        let mut steps_ahead = StepControl::new(&self.equations);
        // What could not be told of this tube when it was longer.
        let mut doubt = None;
        // A bound on the half length where t = 1 is hard to separate; it grows back.
        let mut limit = max_h;
        loop {
            let h = self.now.proof.h;
            let reach = steps_ahead.reach(&self.now, limit);
            self.typical = if T::FORESEES && steps_ahead.is_first() && limit > h {
                h * self.now.local.last_root()
            } else {
                f64::NAN
            };
            let known = self.ledger.found().len();
            match self.step(self.now.exit_at + reach, limit) {
                Ok(is_done) => {
                    self.steps += 1;
                    self.show_tube(control, known, is_done);
                    self.note_starts(control);
                    if is_done {
                        return Ok(());
                    }
                    if let Some(tubes) = self.creep.add(h)
                        && tubes.leads_nowhere(self.figure_size())
                    {
                        return Err(self.creeps(tubes));
                    }
                    if let Some(what) = self.gets_nowhere() {
                        return Err(self.halt(StopKind::Infinite, what, CameTo::Endless));
                    }
                    doubt = None;
                    steps_ahead.accept(h);
                    limit = (2.0 * limit).min(max_h);
                    self.account_for_precision();
                    let (homotopy, local) = (&self.homotopy, &self.now.local);
                    if let Some(crossing) = &mut self.crossing
                        && TRIALS.is_due(homotopy, local, &mut crossing.failed)
                        && self.cross(options, control)
                    {
                        steps_ahead = StepControl::new(&self.equations);
                        limit = max_h;
                    }
                }
                Err(rejection) => {
                    self.rejected += 1;
                    self.test.reject();
                    steps_ahead.reject(rejection, &self.now, &self.next, reach);
                    if let Rejection::Undecided(_) = rejection {
                        doubt = Some(rejection);
                        self.shortened += 1;
                        limit = 0.25 * self.next.proof.h.min(limit);
                    }
                    let smallest = self.smallest_step();
                    if limit < smallest || steps_ahead.is_below(smallest) {
                        if !(options.extended && self.extend(rejection)) {
                            return Err(self.stuck(doubt.unwrap_or(rejection), reach, limit));
                        }
                        // That was in 53 bits.
                        (doubt, limit) = (None, max_h);
                        steps_ahead.forget();
                    }
                }
            }
            if let Some(halt) = self.sees_end() {
                return Err(halt);
            }
            if self.way.as_ref().is_some_and(Way::is_over) {
                return Err(Stop::new(StopKind::Interrupted, two_ways::OVER).into());
            }
            if self.steps >= options.max_steps {
                let words = format!(
                    "the limit of {} tubes was reached, the last of which is {:.1e} long",
                    options.max_steps,
                    2.0 * self.now.proof.h * self.homotopy.unit
                );
                return Err(self.halt(StopKind::Limit, words, CameTo::Nothing));
            }
            let progress = Progress {
                t: self.now.local.z[0][self.equations.m],
                steps: self.steps,
                solutions: self.ledger.found().len(),
                length: self.ledger.length,
            };
            if control.is_cancelled(progress) {
                let words = format!("interrupted {}", self.place());
                return Err(Stop::new(StopKind::Interrupted, words).into());
            }
        }
    }

    /// Shows the tube that was added last, and the solutions in it that were not `known` before. The `last` one of a closed
    /// path leads to the sketch.
    fn show_tube(&self, control: &mut Control, known: usize, is_last: bool) {
        if let Some(trace) = &mut control.trace {
            trace.add(&self.now, self.ledger.last_stretch);
        }
        let Some(witness) = &mut control.witness else {
            return;
        };
        let (n, tube) = (self.equations.n(), &self.now);
        // Weights for a checker are at most 1.
        let top = tube.weights[..n]
            .iter()
            .fold(0.0, |max: f64, &u| max.max(u));
        let least = match T::SPACE {
            Space::Full => 0.0,
            Space::Reduced => LEAST_WEIGHT,
        };
        let weights = tube.weights[..n].iter();
        let weights: Vec<f64> = weights.map(|u| (u / top).max(least)).collect();
        let seen = TubeSeen {
            centre: &tube.local.z[0][..n],
            low: tube.local.is_extended.then_some(&tube.local.low[..n]),
            normal: &tube.local.normal[..n],
            weights: &weights,
            h: tube.proof.h,
            r: top * tube.proof.r,
            exit: tube.exit_at,
        };
        let found = self.ledger.found()[known..].iter();
        let solutions = found.map(|found| (&found.figure.centre[..], found.radius_of_centre()));
        if T::SPACE == Space::Full {
            witness.tube(seen);
            solutions.for_each(|(centre, radius)| witness.solution(centre, &radius));
            return;
        }
        let leads_to_sketch = is_last && self.arc.is_none() && self.beyond.is_none();
        let to = match leads_to_sketch {
            true => tube.parameter_near(&self.sketch),
            false => tube.exit_at,
        };
        let mut parts = Parts {
            tube: seen,
            at: &|s, centre| tube.local.at(s, centre),
            centre: self.equations.vector(),
            solutions: solutions.collect(),
        };
        parts.tell(
            &mut **witness,
            (tube.entry.0, to),
            &tube.local.z[LEFT_OUT][..n],
        );
    }

    /// Sets out from the figure that another run set out from.
    fn stands_where(&mut self, other: &Self) {
        self.sketch = other.sketch.clone();
        self.size_of_sketch = other.size_of_sketch;
    }

    /// Begins anew: from another figure, or with other lengths in the homotopy.
    fn begin(&mut self, start: &Figure) {
        self.equations.set_rights(&self.homotopy);
        self.ledger.begin(&self.homotopy);
        if self.extension.on {
            self.test.set_extended(false);
        }
        self.extension = Extension::default();
        self.sketch.hold(start, ZERO);
        if let Some(arc) = &mut self.arc {
            arc.begin(start);
            if !self.homotopy.tail.is_empty() {
                self.size_of_sketch = size_of(&self.homotopy, &start.centre);
            }
        }
        (self.steps, self.rejected, self.shortened) = (0, 0, 0);
        (self.has_previous, self.has_set_out) = (false, false);
        self.typical = f64::NAN;
    }

    /// Bounds on t where the last tube ends, all up to there being proved.
    fn reached(&self) -> (f64, f64) {
        if !self.has_set_out {
            return (0.0, 0.0);
        }
        let (m, exit) = (self.equations.m, &self.now.exit);
        let radius = round_up(exit.radius[m] + exit.low[m].abs(), 2);
        let t = exit.centre[m];
        ((t - radius).next_down(), (t + radius).next_up())
    }

    fn figure_size(&self) -> f64 {
        self.now.local.z[0]
            .iter()
            .fold(1.0, |max: f64, x| max.max(x.abs()))
    }
}
