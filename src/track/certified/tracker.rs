//! The chain of tubes from the sketch back to the sketch.

use super::ledger::Ledger;
use super::link::{Ball, Tube};
use super::tube::KrawczykTest;
use crate::linalg::{Inverter, Vector};
use crate::system::Homotopy;
use crate::track::full::{Equations, RefineError, first_normal};
use crate::track::{Control, Driving, Mode, Options, Outcome, Progress, Space, Status, TubeSeen};
use std::time::Instant;

/// The path leaves a tube at this fraction of its half length, so that there is room behind the
/// exit for a crossing of t = 1 that falls on it.
const EXIT: f64 = 0.97;
/// The next tube is expected to reach back over this fraction of its predicted half length.
const REACH: f64 = 0.85;
/// How a rejection changes what is expected, and each accepted tube after it.
const DISTRUST: f64 = 0.8;
const RECOVERY: f64 = 1.02;
/// Accuracy of points on the path, in the homotopy's unit: far below the tubes' radii, which is
/// all that is asked of them. Proofs do not depend on it.
const POINT_TOLERANCE: f64 = 1e-9;
/// Steps below this, relative to the size of the figure, end the run.
const SMALLEST_STEP: f64 = 1e-11;

/// Follows the path in the full space and proves every step.
pub fn track<const D: usize>(
    homotopy: &Homotopy,
    options: &Options,
    control: &mut Control,
) -> Outcome {
    let clock = Instant::now();
    let mut tracker = Tracker::<D>::new(homotopy);
    if let Some(witness) = &mut control.witness {
        witness.begin(homotopy.unit);
    }
    let mut status = match tracker.run(options, control) {
        Ok(()) => Status::Closed,
        Err(reason) => Status::Stopped(reason),
    };
    if status == Status::Closed
        && let Err(reason) = tracker.ledger.check_closed()
    {
        status = Status::Stopped(format!("{reason} (on a loop of {} tubes)", tracker.steps));
    }
    let solutions = match tracker.ledger.solutions() {
        Ok(solutions) => solutions,
        Err((reason, solutions)) => {
            if status == Status::Closed {
                status =
                    Status::Stopped(format!("{reason} (on a loop of {} tubes)", tracker.steps));
            }
            solutions
        }
    };
    if let Some(witness) = &mut control.witness {
        let classes: Vec<usize> = solutions.iter().map(|s| s.class).collect();
        witness.end(&status, &classes);
    }
    Outcome {
        mode: Mode::Certified,
        space: Space::Full,
        status,
        solutions,
        steps: tracker.steps,
        rejected: tracker.rejected,
        plan_changes: 0,
        driving: Driving::default(),
        length: tracker.ledger.length,
        t_range: tracker.ledger.t_range,
        seconds: clock.elapsed().as_secs_f64(),
        switched_on: tracker.switched_on(),
    }
}

/// Why a tube could not be added to the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Rejection {
    Refine(RefineError),
    Unproved,
    Unlinked,
    Undecided,
}

impl Rejection {
    fn in_words(self) -> &'static str {
        match self {
            Rejection::Refine(RefineError::Singular) => "the Jacobian is singular in 53 bits",
            Rejection::Refine(RefineError::Diverged) => "the corrector does not converge",
            Rejection::Unproved => "the Krawczyk test fails however short the tube",
            Rejection::Unlinked => "the tube could not be linked to what comes before it",
            Rejection::Undecided => {
                "it could not be decided whether the path meets t = 1: a fold is too near, or two \
                 solutions are"
            }
        }
    }
}

struct Tracker<'a, const D: usize> {
    homotopy: &'a Homotopy,
    equations: Equations<D>,
    inverter: Inverter,
    test: KrawczykTest<D>,
    ledger: Ledger<'a, D>,
    now: Tube<D>,
    next: Tube<D>,
    /// Weights for the next proof, and those to return to if it is rejected.
    weights: Vector,
    kept_weights: Vector,
    /// The point of the tube before, if there is one.
    previous: Option<Vector>,
    sketch: Ball,
    /// The direction of travel at the sketch.
    first_normal: Vector,
    steps: usize,
    rejected: usize,
    shortened: usize,
}

impl<'a, const D: usize> Tracker<'a, D> {
    fn new(homotopy: &'a Homotopy) -> Self {
        let equations = Equations::<D>::new(homotopy);
        let n = equations.n();
        let vector = || equations.vector();
        let mut sketch = Ball::new(&equations);
        for (i, &place) in homotopy.gauge.place.iter().enumerate() {
            let x = homotopy.sketch_box[place];
            sketch.centre[i] = x.mid();
            sketch.radius[i] = x.rad();
        }
        let mut weights = vector();
        weights[..n].fill(1.0);
        Tracker {
            homotopy,
            inverter: equations.inverter(),
            test: KrawczykTest::new(&equations),
            ledger: Ledger::new(homotopy, &equations),
            now: Tube::new(&equations),
            next: Tube::new(&equations),
            kept_weights: weights.clone(),
            weights,
            previous: None,
            sketch,
            first_normal: vector(),
            steps: 0,
            rejected: 0,
            shortened: 0,
            equations,
        }
    }

    fn run(&mut self, options: &Options, control: &mut Control) -> Result<(), String> {
        let max_h = options
            .max_step
            .map_or(f64::INFINITY, |step| 0.5 * step / self.homotopy.unit);
        self.test.radius = options
            .tube_radius
            .map_or(f64::INFINITY, |radius| radius / self.homotopy.unit);
        self.start(options.reverse, max_h)?;
        self.show_tube(control, 0);
        // How far back the next tube is expected to reach, from the half lengths of the last two.
        let mut before = self.now.proof.h;
        // How much of the expectation to believe: less after a rejection, then more again.
        let mut trust = 1.0;
        // What a rejection taught about this tube.
        let mut shorter = f64::INFINITY;
        // A bound on the half length where t = 1 is hard to separate; it grows back.
        let mut limit = max_h;
        loop {
            let h = self.now.proof.h;
            let estimate = h * (h / before).sqrt().clamp(0.5, 1.5);
            let reach = (REACH * trust * estimate.min(limit)).min(shorter);
            let known = self.ledger.solutions_so_far();
            match self.step(self.now.exit_at + reach, limit) {
                Ok(closed) => {
                    self.steps += 1;
                    self.show_tube(control, known);
                    if closed {
                        return Ok(());
                    }
                    before = h;
                    shorter = f64::INFINITY;
                    trust = (RECOVERY * trust).min(1.0);
                    limit = (2.0 * limit).min(max_h);
                }
                Err(rejection) => {
                    self.rejected += 1;
                    self.weights.copy_from_slice(&self.kept_weights);
                    if shorter.is_infinite() {
                        trust *= DISTRUST;
                    }
                    match rejection {
                        Rejection::Undecided => {
                            self.shortened += 1;
                            limit = 0.25 * self.next.proof.h.min(limit);
                        }
                        // The tube is known but for a little shift of its middle.
                        Rejection::Unlinked => {
                            shorter = (REACH * self.next.proof.h).min(0.6 * reach)
                        }
                        Rejection::Refine(_) | Rejection::Unproved => shorter = 0.5 * reach,
                    }
                    let smallest = SMALLEST_STEP * self.figure_size();
                    if limit < smallest || shorter < smallest {
                        return Err(self.stuck(rejection));
                    }
                }
            }
            if self.steps >= options.max_steps {
                return Err(format!(
                    "the limit of {} tubes was reached {}",
                    options.max_steps,
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
        let Some(witness) = &mut control.witness else {
            return;
        };
        let (n, tube) = (self.equations.n(), &self.now);
        witness.tube(TubeSeen {
            centre: &tube.local.z[0][..n],
            normal: &tube.local.normal[..n],
            weights: &tube.weights[..n],
            h: tube.proof.h,
            r: tube.proof.r,
            exit: tube.exit_at,
        });
        for found in &self.ledger.found()[known..] {
            witness.solution(&found.centre[..n - 1], &found.radius[..n - 1]);
        }
    }

    /// Proves the tube around the sketch.
    fn start(&mut self, reverse: bool, max_h: f64) -> Result<(), String> {
        let equations = &self.equations;
        let local = &mut self.now.local;
        local.z[0].copy_from_slice(&self.sketch.centre);
        first_normal(equations, &mut self.inverter, local, reverse)
            .map_err(|_| "the sketch is a singular point of its path: no direction of travel could be computed".to_owned())?;
        local.z[0].copy_from_slice(&self.sketch.centre);
        local
            .refine(equations, &mut self.inverter, POINT_TOLERANCE, 8)
            .map_err(|e| format!("at the sketch, {}", Rejection::Refine(e).in_words()))?;
        local.expand(equations);
        self.first_normal.copy_from_slice(&local.normal);
        // The first rounds find the weights.
        for _ in 0..3 {
            self.test
                .prove(equations, &self.now.local, &mut self.weights, max_h);
        }
        let mut limit = max_h;
        loop {
            match self.first_tube(limit) {
                Ok(()) => return Ok(()),
                // Where t = 1 is hard to separate, shorter tubes do it.
                Err(Rejection::Undecided)
                    if self.now.proof.h > SMALLEST_STEP * self.figure_size() =>
                {
                    self.shortened += 1;
                    limit = 0.25 * self.now.proof.h;
                }
                Err(rejection) => {
                    return Err(format!(
                        "at the sketch, {}{}",
                        rejection.in_words(),
                        self.condition()
                    ));
                }
            }
        }
    }

    /// Proves the tube around the sketch, at most `limit` to either side, and that the sketch is in it.
    fn first_tube(&mut self, limit: f64) -> Result<(), Rejection> {
        let equations = &self.equations;
        self.now.proof = self
            .test
            .prove(equations, &self.now.local, &mut self.weights, limit)
            .ok_or(Rejection::Unproved)?;
        self.now.weights.copy_from_slice(self.test.weights());
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
        self.kept_weights.copy_from_slice(&self.weights);
        self.ledger
            .enter(&self.equations, &mut self.inverter, &self.now, None)
            .map_err(|_| Rejection::Undecided)
    }

    /// Adds the tube that is `advance` further on. Tells whether it closes the loop.
    fn step(&mut self, advance: f64, limit: f64) -> Result<bool, Rejection> {
        let equations = &self.equations;
        let next = &mut self.next;
        self.now.local.predict(
            advance,
            self.previous.as_deref(),
            &mut next.local.z[0],
            &mut next.local.normal,
        );
        next.local
            .refine(equations, &mut self.inverter, POINT_TOLERANCE, 8)
            .map_err(Rejection::Refine)?;
        #[cfg(test)]
        super::validation::inject_fault(
            equations,
            &mut self.inverter,
            &self.now.local,
            advance,
            &mut next.local,
        );
        next.local.expand(equations);
        self.kept_weights.copy_from_slice(&self.weights);
        next.proof = self
            .test
            .prove(equations, &next.local, &mut self.weights, limit)
            .ok_or(Rejection::Unproved)?;
        next.weights.copy_from_slice(self.test.weights());
        next.exit_at = EXIT * next.proof.h;
        self.test
            .enclose_exit(equations, next)
            .ok_or(Rejection::Unproved)?;
        next.entry = match self.now.leads_to(next) {
            Some(entry) => entry,
            None if self.now.exit_is_tight => return Err(Rejection::Unlinked),
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
        let closing = self.closes(&self.next)?;
        self.ledger
            .enter(&self.equations, &mut self.inverter, &self.next, closing)
            .map_err(|_| Rejection::Undecided)?;
        match &mut self.previous {
            Some(previous) => previous.copy_from_slice(&self.now.local.z[0]),
            None => self.previous = Some(self.now.local.z[0].clone()),
        }
        std::mem::swap(&mut self.now, &mut self.next);
        Ok(closing.is_some())
    }

    /// Whether the sketch lies ahead of the entry in a tube, travelled in the same direction as
    /// at the start: where, if so.
    fn closes(&self, tube: &Tube<D>) -> Result<Option<(f64, f64)>, Rejection> {
        let m = self.equations.m;
        let (h, z) = (tube.proof.h, &tube.local.z[0]);
        // Most tubes are nowhere near: |z − z₀| ≤ 2 h is generous for a tube that holds z.
        if z[m].abs() > 2.0 * h || (0..m).any(|i| (z[i] - self.sketch.centre[i]).abs() > 2.0 * h) {
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
                    Err(Rejection::Undecided)
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
        match self.now.local.condition(&self.equations) {
            Some(condition) => format!(" (condition of the Jacobian about {condition:.1e})"),
            None => String::new(),
        }
    }

    fn stuck(&self, rejection: Rejection) -> String {
        let t = self.now.local.z[0][self.equations.m];
        let remark = self.homotopy.remark_on_lengths(t);
        format!(
            "{} at the smallest step, {}{remark}",
            rejection.in_words(),
            self.place()
        )
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
        list
    }
}
