//! The default way of stepping: adaptive, cubic predictor, exact derivatives.

use super::events::Events;
use super::path_point::{Piece, distance};
use super::{SMALLEST_STEP, Tracker, UNCLEAR};
use crate::track::{Control, Status, StopKind};

/// The first step from the sketch, while there is no history.
const FIRST_STEP: f64 = 0.01;

/// A point may be off its prediction by this part of the step. (With this and [`TURN`] both four
/// times larger, the results on the shipped problems are the same: there is room.)
const ERROR: f64 = 0.05;

/// The step is chosen so that the corrector's second correction is this part of the first. (At
/// 0.3 it gives up.)
const CONTRACTION: f64 = 0.1;

/// The tangent may turn by this angle in a step, in radians.
const TURN: f64 = 0.3;

/// Changes of plan in one step because of what is ahead, at most.
const LOOKS_AHEAD: usize = 3;

/// Original instructions come back when their γ is this many times alpha: some more than it, or
/// plans go back and forth.
const RESTORE: f64 = 2.0;

/// After so many failures in a row the current tangent is computed anew.
const RENEW_AFTER: usize = 4;

/// Steps between two looks for instructions to restore.
const RESTORE_EVERY: usize = 4;

/// How the stepping goes.
struct Pace {
    h: f64,
    longest: f64,
    /// Changes of plan since the last point.
    looks: usize,
    /// Failures since the last point.
    failures: usize,
}

enum Attempt {
    /// `next` is a point, `length` away, `error` from its prediction, with the tangent turned
    /// by the angle `turn`.
    Point { length: f64, error: f64, turn: f64 },
    /// The predicted figure is near or beyond a boundary configuration.
    Boundary,
    /// No point found, or one that cannot be trusted.
    Failed,
}

impl Tracker<'_> {
    /// Algorithm 1 with adaptive steps.
    pub(super) fn follow(&mut self, control: &mut Control) -> Status {
        let longest = self
            .options
            .step_in(self.homotopy.unit)
            .unwrap_or(f64::INFINITY);
        let mut pace = Pace {
            h: FIRST_STEP.min(longest),
            longest,
            looks: 0,
            failures: 0,
        };
        loop {
            if let Err(status) = self.step(&mut pace, control) {
                return status;
            }
        }
    }

    /// One attempt at a step, and what follows from it. The error is how the run ends.
    fn step(&mut self, pace: &mut Pace, control: &mut Control) -> Result<(), Status> {
        if self.steps >= self.options.max_steps {
            return Err(self.stopped(StopKind::Limit, "the limit on steps is reached"));
        }
        let (length, error, turn) = match self.attempt(pace.h) {
            Attempt::Point {
                length,
                error,
                turn,
            } => (length, error, turn),
            Attempt::Boundary if pace.looks < LOOKS_AHEAD => {
                pace.looks += 1;
                let changed = self.change_plan(true, f64::INFINITY)?;
                return if changed { Ok(()) } else { self.reject(pace) };
            }
            Attempt::Boundary | Attempt::Failed => return self.reject(pace),
        };
        // Looking between the points evaluates the plan elsewhere.
        let contraction = self.corrector.contraction;
        let near = self.evaluation.is_near_boundary() || self.evaluation.is_out_of_order();
        match self.look_between(length, 0.25 * error + 1e-9) {
            Events::None => self.advance(length, length),
            Events::Closed(s) => {
                self.advance(length, s);
                return Err(Status::Closed);
            }
            Events::Unclear => {
                return self
                    .reject(pace)
                    .map_err(|_| self.stopped(StopKind::Undecided, UNCLEAR));
            }
        }
        if near || self.steps.is_multiple_of(RESTORE_EVERY) && self.plan_is_restorable(RESTORE) {
            self.change_plan(false, RESTORE)?;
        }
        if control.is_cancelled(self.progress()) {
            return Err(self.stopped(StopKind::Interrupted, "interrupted"));
        }
        // The predictor's error grows like h⁴, and with it what the corrector's contraction is
        // lacking; the turn like h.
        let by_error = (0.5 * ERROR * length / error.max(1e-300)).sqrt().sqrt();
        let by_contraction = (CONTRACTION / contraction.max(1e-300)).sqrt().sqrt();
        let growth = by_error
            .min(by_contraction)
            .min(0.8 * TURN / turn.max(1e-300))
            .clamp(0.5, 2.0);
        pace.h = (pace.h * growth).min(pace.longest);
        (pace.looks, pace.failures) = (0, 0);
        Ok(())
    }

    fn reject(&mut self, pace: &mut Pace) -> Result<(), Status> {
        self.rejected += 1;
        pace.failures += 1;
        pace.h *= 0.5;
        if pace.h < SMALLEST_STEP {
            return Err(self.no_step());
        }
        if pace.failures == RENEW_AFTER {
            // The point's own tangent may be what is wrong.
            self.settle()?;
        }
        Ok(())
    }

    fn attempt(&mut self, h: f64) -> Attempt {
        match self.behind {
            Some(behind) => Piece::new(&self.previous, &self.current, behind)
                .at(behind + h, &mut self.predicted),
            None => {
                let point = self.current.z.iter().zip(&self.current.tangent);
                for (out, (z, u)) in self.predicted.iter_mut().zip(point) {
                    *out = h.mul_add(*u, *z);
                }
            }
        }
        let (t, figure) = self.predicted.split_last().expect("a figure and t");
        self.evaluation
            .parameters(figure, *t, &mut self.corrector.q);
        if !self.evaluation.evaluate(&self.corrector.q) || self.evaluation.is_near_boundary() {
            return Attempt::Boundary;
        }
        if !self
            .corrector
            .correct(&mut self.evaluation, h, &mut self.next)
        {
            return Attempt::Failed;
        }
        let error = distance(&self.next.z, &self.predicted);
        let turn = distance(&self.next.tangent, &self.current.tangent);
        if error <= ERROR * h && turn <= TURN {
            Attempt::Point {
                length: self.arc_length(),
                error,
                turn,
            }
        } else {
            Attempt::Failed
        }
    }
}
