//! The chain of tubes from the sketch back to the sketch.

mod arc;
mod crossing;
mod extension;
mod open;
mod starts;
mod step_control;
mod two_ways;

use super::figures::FigureBox;
use super::ledger::Ledger;
use super::link::{Ball, Frame, Tube};
use super::proof::Proof;
use super::reasons::{
    Doubt, Rejection, no_direction, precision, undecided, unlinked, unproved, unrefined,
};
use super::shortfall::Shortfall;
use super::solution::SolutionProver;
use crate::interval::rounding::round_up;
use crate::linalg::Vector;
use crate::system::Homotopy;
use crate::track::arc::Figure;
use crate::track::ends::{Away, EndKind, PathEnd};
use crate::track::flexible;
use crate::track::full::{Equations, InverseMaker, Local, RefineError, condition, first_normal};
use crate::track::{Control, Driving, Mode, Options, Outcome, Progress, Space, Status, TubeSeen};
use arc::{Arc, Joining};
use crossing::{Beyond, Crossing};
use extension::Extension;
use std::borrow::Cow;
use std::time::Instant;
use step_control::StepControl;
use two_ways::Way;

pub use arc::Arcs;

/// The path leaves a tube at this fraction of its half length, so that there is room behind the
/// exit for a crossing of t = 1 that falls on it.
const EXIT: f64 = 0.97;
/// Accuracy of points on the path, in the homotopy's unit: far below the tubes' radii, which is
/// all that is asked of them. Proofs do not depend on it.
const POINT_TOLERANCE: f64 = 1e-9;
/// Where the Jacobian with the normal has a larger condition, in floats, a run that is stuck is near a place
/// where it loses rank: where branches meet.
const SINGULAR: f64 = 1e7;

/// A way of proving tubes: with polynomials of N coefficients, in frames of its own.
pub trait Test<const D: usize, const N: usize>: Sized + Send + std::fmt::Debug {
    /// The preconditioner of a tube, which also describes its box.
    type Frame: Frame<D> + Send + std::fmt::Debug;
    /// The space in which it works.
    const SPACE: Space;
    /// Whether the last coefficient of the expansion tells how long the tube will be.
    const FORESEES: bool;

    /// Room for the tubes of a problem.
    fn new(homotopy: &Homotopy, equations: &Equations<D>, options: &Options) -> Self;

    /// Brings a predicted point onto the path.
    fn refine(
        &mut self,
        equations: &Equations<D>,
        local: &mut Local<D, N, Self::Frame>,
        tolerance: f64,
    ) -> Result<(), RefineError>;

    /// Expands the path there.
    fn expand(
        &mut self,
        equations: &Equations<D>,
        local: &mut Local<D, N, Self::Frame>,
    ) -> Result<(), RefineError>;

    /// Before the first tube is proved: finds what later ones take over from those before.
    fn prepare(&mut self, equations: &Equations<D>, tube: &mut Tube<D, N, Self::Frame>, max_h: f64);

    /// Proves the longest tube it can, at most `max_h` to either side, around a refined point: sets
    /// its proof and weights. False: nothing could be proved, however short.
    fn prove(
        &mut self,
        equations: &Equations<D>,
        tube: &mut Tube<D, N, Self::Frame>,
        max_h: f64,
    ) -> bool;

    /// Why the last tube could not be proved: which condition fails for one as short as that is tried.
    /// `None`: none of them, but its exit could not be enclosed.
    fn shortfall(
        &mut self,
        equations: &Equations<D>,
        tube: &mut Tube<D, N, Self::Frame>,
        max_h: f64,
    ) -> Option<Shortfall>;

    /// What was proved last is in the chain.
    fn accept(&mut self, tube: &Tube<D, N, Self::Frame>);

    /// What was tried last is given up.
    fn reject(&mut self);

    /// Encloses the path's point at `exit_at` of the tube that was proved last, as tightly as most
    /// links need.
    fn enclose_exit(
        &mut self,
        equations: &Equations<D>,
        tube: &mut Tube<D, N, Self::Frame>,
    ) -> Option<()>;

    /// Encloses the path's point at `exit_at` of a tube proved earlier, and the path's tangent there, as tightly
    /// as floats allow.
    fn tighten_exit(
        &mut self,
        equations: &Equations<D>,
        tube: &mut Tube<D, N, Self::Frame>,
    ) -> Option<()>;

    /// Switches extended precision on or off, for the tubes and exits to come. False: there is none.
    fn set_extended(&mut self, _on: bool) -> bool {
        false
    }

    /// What 53 bits would prove of the tube that was proved last in extended precision.
    fn in_53_bits(&self) -> Option<Proof> {
        None
    }

    /// Whether nothing but rounding, and F at the middle, kept the last tube from being proved.
    fn is_limited_by_rounding(&self) -> bool {
        false
    }

    /// Changes of plan, and the numbers of driving parameters.
    fn plans(&self) -> (usize, Driving);
}

/// Follows the path and proves every step by a test.
pub fn track<const D: usize, const N: usize, T: Test<D, N>>(
    homotopy: &Homotopy,
    options: &Options,
    control: &mut Control,
) -> Outcome {
    let clock = Instant::now();
    let mut tracker = Tracker::<D, N, T>::new(Cow::Borrowed(homotopy), options);
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
        Err(reason) => match tracker.path_end(reason) {
            Ok(end) => tracker.other_way(end, options, control),
            Err(reason) => Status::Stopped(tracker.with_flexibility(reason)),
        },
    };
    let checked = match status {
        Status::Closed => tracker.ledger.check_closed(homotopy),
        Status::Open(_) => tracker.ledger.check_open(homotopy),
        Status::Stopped(_) => Ok(()),
    };
    if let Err(reason) = checked {
        status = Status::Stopped(format!("{reason} (on a path of {} tubes)", tracker.steps));
    }
    let solutions = match tracker.ledger.solutions(homotopy) {
        Ok(solutions) => solutions,
        Err((reason, solutions)) => {
            if !matches!(status, Status::Stopped(_)) {
                status =
                    Status::Stopped(format!("{reason} (on a path of {} tubes)", tracker.steps));
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
        seen.solutions = tracker.ledger.found().iter().map(FigureBox::of).collect();
    }
    let (plan_changes, driving) = tracker.test.plans();
    Outcome {
        mode: Mode::Certified,
        space: T::SPACE,
        status,
        solutions,
        steps: tracker.steps,
        rejected: tracker.rejected,
        plan_changes,
        driving,
        length: tracker.ledger.length,
        t_range: tracker.ledger.t_range,
        seconds: clock.elapsed().as_secs_f64(),
        switched_on: tracker.switched_on(),
    }
}

#[derive(Debug)]
struct Tracker<'a, const D: usize, const N: usize, T: Test<D, N>> {
    homotopy: Cow<'a, Homotopy>,
    equations: Equations<D>,
    /// For the direction at the sketch and for boxes around solutions.
    inverter: InverseMaker,
    test: T,
    ledger: Ledger<D>,
    now: Tube<D, N, T::Frame>,
    next: Tube<D, N, T::Frame>,
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
    arc: Option<Arc<D>>,
    /// What it keeps if it may meet flat figures at t = 1.
    crossing: Option<Crossing>,
    /// Where it ends if it is a piece of another run.
    beyond: Option<Beyond>,
    /// Whether the tube around the sketch was proved.
    has_set_out: bool,
    /// Whether the run is stuck near a place where the Jacobian loses rank.
    is_singular: bool,
    /// The point that goes to infinity, if the run ended because of one.
    away: Option<Away>,
    /// Whether it ended because a length goes to zero.
    loses: bool,
    /// Whether it ended because no step could be proved, however short.
    is_stuck: bool,
    /// Proves figures with t = 0, once somebody wants them.
    at_start: Option<Box<SolutionProver<D>>>,
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

/// The largest coordinate of a figure, or 1 if that is more.
fn size_of(homotopy: &Homotopy, figure: &[f64]) -> f64 {
    open::farthest(homotopy, figure).map_or(1.0, |(_, size)| size.max(1.0))
}

impl<'a, const D: usize, const N: usize, T: Test<D, N>> Tracker<'a, D, N, T> {
    fn new(homotopy: Cow<'a, Homotopy>, options: &Options) -> Self {
        let equations = Equations::<D>::new(&homotopy);
        let vector = || equations.vector();
        let mut sketch = Ball::new(&equations);
        for (i, x) in homotopy.sketch_of_unknowns().enumerate() {
            sketch.centre[i] = x.mid();
            sketch.radius[i] = x.rad();
        }
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
            is_singular: false,
            away: None,
            loses: false,
            is_stuck: false,
            at_start: None,
            behind: 0,
            way: None,
            ways: None,
            size_of_sketch,
            typical: f64::NAN,
            equations,
        }
    }

    fn run(&mut self, options: &Options, control: &mut Control) -> Result<(), String> {
        let max_h = self.longest(options);
        let is_done = self.start(options, max_h)?;
        self.show_tube(control, 0);
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
    fn go_on(
        &mut self,
        options: &Options,
        max_h: f64,
        control: &mut Control,
    ) -> Result<(), String> {
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
            let known = self.ledger.solutions_so_far();
            match self.step(self.now.exit_at + reach, limit) {
                Ok(is_done) => {
                    self.steps += 1;
                    self.show_tube(control, known);
                    self.note_starts(control);
                    if is_done {
                        return Ok(());
                    }
                    doubt = None;
                    steps_ahead.accept(h);
                    limit = (2.0 * limit).min(max_h);
                    self.account_for_precision();
                    if self.crossing.is_some()
                        && self.is_at_crossing()
                        && self.cross(options, control)
                    {
                        self.show_tube(control, self.ledger.solutions_so_far());
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
            self.away = self.goes_away();
            if let Some(Away { point, distance }) = self.away {
                let name = self.homotopy.point_names.get(point);
                let what = match self.arc {
                    Some(_) => "the figure seems to grow without end: ",
                    None => "",
                };
                return Err(format!(
                    "{what}{} is {:.4} away and moves away, ever farther as far as one can see, {}",
                    name.map_or("a point", String::as_str),
                    distance.0,
                    self.place()
                ));
            }
            if let Some(what) = self.loses_leg() {
                self.loses = true;
                return Err(format!("{what}, {}", self.place()));
            }
            if self.way.as_ref().is_some_and(Way::is_over) {
                return Err(two_ways::OVER.to_owned());
            }
            if self.steps >= options.max_steps {
                return Err(format!(
                    "the limit of {} tubes was reached, the last of which is {:.1e} long, {}",
                    options.max_steps,
                    2.0 * self.now.proof.h * self.homotopy.unit,
                    self.place()
                ));
            }
            let progress = Progress {
                t: self.now.local.z[0][self.equations.m],
                steps: self.steps,
                solutions: self.ledger.solutions_so_far(),
                length: self.ledger.length,
            };
            if control.is_cancelled(progress) {
                return Err(format!("interrupted {}", self.place()));
            }
        }
    }

    /// Shows the tube that was added last, and the solutions in it that were not `known` before.
    fn show_tube(&self, control: &mut Control, known: usize) {
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
        let weights: Vec<f64> = tube.weights[..n].iter().map(|u| u / top).collect();
        witness.tube(TubeSeen {
            centre: &tube.local.z[0][..n],
            low: tube.local.is_extended.then_some(&tube.local.low[..n]),
            normal: &tube.local.normal[..n],
            weights: &weights,
            h: tube.proof.h,
            r: top * tube.proof.r,
            exit: tube.exit_at,
        });
        for found in &self.ledger.found()[known..] {
            witness.solution(&found.centre[..n - 1], &found.radius_of_centre()[..n - 1]);
        }
    }

    /// Proves the tube around the sketch. Tells whether the path ends in it.
    fn start(&mut self, options: &Options, max_h: f64) -> Result<bool, String> {
        let equations = &self.equations;
        let mut at_sketch = Local::<D>::new(equations);
        at_sketch.z[0].copy_from_slice(&self.sketch.centre);
        let reverse = options.reverse;
        if first_normal(equations, &mut self.inverter, &mut at_sketch, reverse).is_err() {
            self.is_singular = true;
            let pivots = at_sketch.pivot_ratio_of_jacobian(equations);
            return Err(no_direction(pivots));
        }
        self.first_normal.copy_from_slice(&at_sketch.normal);
        loop {
            match self.tube_at_sketch(max_h) {
                Ok(is_done) => {
                    self.has_set_out = true;
                    if let Some(way) = &self.way
                        && self.now.goes_along(self.now.entry, &self.first_normal)
                    {
                        way.sets_out(&self.first_normal);
                    }
                    self.account_for_precision();
                    return Ok(is_done);
                }
                Err((rejection, _)) if options.extended && self.extend(rejection) => {}
                Err((rejection, limit)) => return Err(self.stuck_at_sketch(rejection, limit)),
            }
        }
    }

    /// Proves the tube around the sketch, as short as it takes.
    /// Otherwise tells how long it could have been at last.
    fn tube_at_sketch(&mut self, max_h: f64) -> Result<bool, (Rejection, f64)> {
        let equations = &self.equations;
        let local = &mut self.now.local;
        local.z[0].copy_from_slice(&self.sketch.centre);
        local.normal.copy_from_slice(&self.first_normal);
        self.test
            .refine(equations, local, POINT_TOLERANCE)
            .and_then(|()| self.test.expand(equations, local))
            .map_err(|e| (Rejection::Refine(e), max_h))?;
        self.test.prepare(equations, &mut self.now, max_h);
        let mut limit = max_h;
        loop {
            match self.first_tube(limit) {
                // Where t = 1 is hard to separate, shorter tubes do it.
                Err(Rejection::Undecided(_)) if self.now.proof.h > self.smallest_step() => {
                    self.shortened += 1;
                    limit = 0.25 * self.now.proof.h;
                }
                done => return done.map_err(|rejection| (rejection, limit)),
            }
        }
    }

    /// Proves the tube around the sketch, at most `limit` to either side, and that the sketch is in it.
    fn first_tube(&mut self, limit: f64) -> Result<bool, Rejection> {
        let equations = &self.equations;
        if !self.test.prove(equations, &mut self.now, limit) {
            return Err(Rejection::Unproved);
        }
        self.now.exit_at = EXIT * self.now.proof.h;
        self.test
            .enclose_exit(equations, &mut self.now)
            .ok_or(Rejection::Unproved)?;
        // Before the exit: what lies between is to be searched, and the loop to close behind it.
        self.now.entry = self
            .now
            .locate(&self.sketch)
            .filter(|entry| entry.1 < self.now.exit_at)
            .ok_or(Rejection::Unlinked)?;
        let is_done = self.enter(true)?;
        self.test.accept(&self.now);
        Ok(is_done)
    }

    /// Takes the linked tube into account, the `first` one or the next. Tells whether the path ends in it.
    fn enter(&mut self, first: bool) -> Result<bool, Rejection> {
        let extended = self.extension.is_on();
        let tube = if first { &self.now } else { &self.next };
        if let Some(arc) = &mut self.arc {
            let joining = Joining {
                equations: &self.equations,
                homotopy: &self.homotopy,
                tube,
                is_first: first,
                extended,
            };
            return arc.enter(&joining, &mut self.inverter, &mut self.ledger);
        }
        let closing = match first || self.beyond.is_some() {
            true => None,
            false => self.closes(tube)?,
        };
        let between = closing.map_or((tube.exit_at, tube.exit_at), |at| {
            (at.1.max(tube.exit_at), at.1)
        });
        let (equations, inverter) = (&self.equations, &mut self.inverter);
        let mut account = |ledger: &mut Ledger<D>, between| {
            let entered = ledger.enter(equations, inverter, tube, between, extended);
            entered.map_err(Rejection::Undecided)
        };
        let before = self.way.is_some().then(|| self.ledger.mark());
        account(&mut self.ledger, between)?;
        if let (Some(way), Some(before), None) = (&self.way, before, closing) {
            let steps = self.steps + usize::from(!first);
            if let Some(meeting) = way.meets(tube, (self.ledger.mark(), steps)) {
                // What lies beyond is the other's.
                self.ledger.return_to(before);
                let until = meeting.at.1;
                if account(&mut self.ledger, (until, until)).is_ok() && way.decide(meeting) {
                    return Ok(true);
                }
                // The other's account may count on all of it.
                self.ledger.return_to(before);
                account(&mut self.ledger, between)?;
            }
        }
        if let Some(beyond) = &self.beyond {
            return Ok(beyond.is_reached(tube, tube.exit_at));
        }
        Ok(closing.is_some())
    }

    /// Begins anew: from another figure, or with other lengths in the homotopy.
    fn begin(&mut self, start: &Figure) {
        let m = self.equations.m;
        self.equations.set_rights(&self.homotopy);
        self.ledger.begin(&self.homotopy);
        if self.extension.is_on() {
            self.test.set_extended(false);
        }
        self.extension = Extension::default();
        self.sketch.centre[..m].copy_from_slice(&start.centre);
        self.sketch.low[..m].copy_from_slice(&start.low);
        self.sketch.radius[..m].copy_from_slice(&start.radius);
        if let Some(arc) = &mut self.arc {
            arc.begin(start);
            if !self.homotopy.tail.is_empty() {
                self.size_of_sketch = size_of(&self.homotopy, &start.centre);
            }
        }
        (self.steps, self.rejected, self.shortened) = (0, 0, 0);
        (self.has_previous, self.has_set_out) = (false, false);
        (self.is_singular, self.is_stuck) = (false, false);
        (self.away, self.loses) = (None, false);
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

    /// Adds the tube that is `advance` further on. Tells whether the path ends in it.
    fn step(&mut self, advance: f64, limit: f64) -> Result<bool, Rejection> {
        let equations = &self.equations;
        let next = &mut self.next;
        let previous = self.has_previous.then_some(&self.previous[..]);
        let previous = previous.filter(|z| self.extension.trusts(z, &self.now.local, advance));
        self.now.local.predict(
            advance,
            previous,
            &mut next.local.z[0],
            &mut next.local.normal,
        );
        self.test
            .refine(equations, &mut next.local, POINT_TOLERANCE)
            .map_err(Rejection::Refine)?;
        #[cfg(test)]
        if super::validation::inject_fault(
            equations,
            &mut self.inverter,
            &self.now.local,
            advance,
            &mut next.local,
        ) {
            // Its preconditioner as well is that of the other point.
            self.test
                .refine(equations, &mut next.local, POINT_TOLERANCE)
                .map_err(Rejection::Refine)?;
        }
        self.test
            .expand(equations, &mut next.local)
            .map_err(Rejection::Refine)?;
        let expected = self.typical / next.local.last_root();
        if expected < -next.local.parameter_of(&self.now.exit.centre) {
            return Err(Rejection::Short(expected));
        }
        if !self.test.prove(equations, next, limit) {
            return Err(Rejection::Unproved);
        }
        next.exit_at = EXIT * next.proof.h;
        self.test
            .enclose_exit(equations, next)
            .ok_or(Rejection::Unproved)?;
        next.entry = match self.now.leads_to(next) {
            Some(entry) => entry,
            None if self.now.exit_is_tight || !next.reaches(&self.now.exit) => {
                return Err(Rejection::Unlinked);
            }
            // The next tube may be too narrow for what is known of the exit.
            None => {
                self.test
                    .tighten_exit(equations, &mut self.now)
                    .ok_or(Rejection::Unlinked)?;
                self.now.leads_to(next).ok_or(Rejection::Unlinked)?
            }
        };
        if next.entry.1 >= next.exit_at {
            return Err(Rejection::Unlinked);
        }
        let is_done = self.enter(false)?;
        self.test.accept(&self.next);
        self.previous.copy_from_slice(&self.now.local.z[0]);
        self.has_previous = true;
        self.extension.before_last = self.now.local.is_extended;
        std::mem::swap(&mut self.now, &mut self.next);
        Ok(is_done)
    }

    /// Whether the sketch lies ahead of the entry in a tube, travelled in the same direction as
    /// at the start: where, if so.
    fn closes(&self, tube: &Tube<D, N, T::Frame>) -> Result<Option<(f64, f64)>, Rejection> {
        let m = self.equations.m;
        let (h, z) = (tube.proof.h, &tube.local.z[0]);
        // Most tubes are nowhere near: |z − z₀| ≤ 2 h is generous for a tube that holds z. (Where this
        // errs the path is followed once more round, and the sketch is met again.)
        let away = |i: usize| (z[i] - self.sketch.centre[i]).abs() - self.sketch.radius[i];
        if z[m].abs() > 2.0 * h || (0..m).any(|i| away(i) > 2.0 * h) {
            return Ok(None);
        }
        match tube.locate(&self.sketch) {
            Some(at) if at.0 > tube.entry.1 => {
                // A regular curve comes back in the direction in which it left. What cannot be
                // proved here is proved in a shorter tube.
                let same_way = tube.goes_along(at, &self.first_normal);
                if same_way {
                    Ok(Some(at))
                } else {
                    Err(Rejection::Undecided(Doubt::Direction(
                        tube.proof.slope_distance,
                    )))
                }
            }
            _ => Ok(None),
        }
    }

    fn figure_size(&self) -> f64 {
        self.now.local.z[0]
            .iter()
            .fold(1.0, |max: f64, x| max.max(x.abs()))
    }

    fn place(&self) -> String {
        let t = self.now.local.z[0][self.equations.m];
        format!(
            "at t = {t:.9} after {} tubes{}",
            self.steps,
            self.condition()
        )
    }

    fn condition(&self) -> String {
        match condition(
            &self.equations,
            &self.now.local.z[0],
            &self.now.local.normal,
        ) {
            Some(condition) => format!(" (condition of the Jacobian about {condition:.1e})"),
            None => String::new(),
        }
    }

    /// Why the run ends here, a tube of about the half length `reach` being the last that was tried.
    fn stuck(&mut self, rejection: Rejection, reach: f64, limit: f64) -> String {
        let now = &self.now.local;
        let condition = condition(&self.equations, &now.z[0], &now.normal);
        self.is_singular = condition.is_none_or(|condition| condition > SINGULAR);
        self.is_stuck = true;
        let t = self.now.local.z[0][self.equations.m];
        let remark = self.homotopy.remark_on_lengths(t);
        format!(
            "{}, at the smallest step, {:.1e}{}, {}{remark}",
            self.why(rejection, false, limit),
            reach * self.homotopy.unit,
            precision(self.extension.is_on()),
            self.place()
        )
    }

    /// The reason why a run ends where no step can be proved, after the words for a figure that is not rigid at t = 1,
    /// if that is what the path comes to.
    fn with_flexibility(&self, reason: String) -> String {
        if !self.is_stuck || self.arc.is_some() {
            return reason;
        }
        let (z, m) = (&self.now.local.z[0], self.equations.m);
        match flexible::in_words(&self.homotopy, z, z[m]) {
            Some(words) => format!("{words}; {reason}"),
            None => reason,
        }
    }

    /// Why it ends at the sketch.
    fn stuck_at_sketch(&mut self, rejection: Rejection, limit: f64) -> String {
        format!(
            "at the sketch{}, {}{}",
            precision(self.extension.is_on()),
            self.why(rejection, true, limit),
            self.condition()
        )
    }

    /// In words, with numbers of what was tried last: `first`, the tube around the sketch.
    fn why(&mut self, rejection: Rejection, first: bool, limit: f64) -> String {
        let (equations, unit) = (&self.equations, self.homotopy.unit);
        let (tube, before) = match first {
            true => (&mut self.now, None),
            false => (&mut self.next, Some(&self.now)),
        };
        match rejection {
            Rejection::Refine(e) => unrefined(e, equations, &mut tube.local, POINT_TOLERANCE, unit),
            Rejection::Unproved => {
                unproved(self.test.shortfall(equations, tube, limit), tube, unit)
            }
            Rejection::Short(_) | Rejection::Unlinked => match before {
                None => unlinked("the sketch", &self.sketch, 0.0, tube, unit),
                Some(before) => {
                    let direction = match before.exit_is_tight {
                        true => before.exit_slope_radius,
                        false => before.proof.slope_distance,
                    };
                    unlinked("that one's end", &before.exit, direction, tube, unit)
                }
            },
            Rejection::Undecided(doubt) => undecided(doubt, self.extension.is_on(), &self.homotopy),
        }
    }

    fn switched_on(&self) -> Vec<String> {
        let mut list = Vec::new();
        if self.shortened > 0 {
            let times = match self.shortened {
                1 => "once".to_owned(),
                n => format!("{n} times"),
            };
            list.push(format!(
                "shorter tubes, {times}: t = 1 could not be separated from a fold or another \
                 solution in the longer ones"
            ));
        }
        if let Some([ahead, back]) = self.ways {
            list.push(format!(
                "two threads: the path was followed both ways from the sketch at once, {ahead} tubes ahead and \
                 {back} back, until these met (several threads were asked for)"
            ));
        }
        list.extend(self.extension.in_words());
        list.extend(self.crossing.iter().filter_map(Crossing::in_words));
        list
    }
}
