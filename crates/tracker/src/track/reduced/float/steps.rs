//! Algorithm 1, and the default way of stepping in it: adaptive, cubic predictor, exact derivatives.

use super::Tracker;
use super::paper::LONGEST_STEP;
use super::path_point::{Piece, distance};
use crate::track::float::{self, SMALLEST_STEP, Tried};
use crate::track::{Control, Preset, Stop, StopKind};

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

/// Why a step fails where no point is found,
const FAILED: &str = "no step succeeds";
/// and where what lies before it is left open.
const UNCLEAR: &str = "a solution or the sketch cannot be isolated, as if it were singular,";

/// What came of predicting and correcting a point.
pub(super) enum Attempt {
    /// `next` is a point, `length` away; the piece up to it is off its cubic by at most about `margin`. The step after
    /// it may be `then` long.
    Point { length: f64, margin: f64, then: f64 },
    /// The predicted figure is near or beyond a boundary configuration.
    Boundary,
    /// No point found, or one that cannot be trusted.
    Failed,
}

impl Tracker<'_> {
    /// Algorithm 1, with steps as the preset says.
    pub(super) fn follow(&mut self, control: &mut Control) -> Result<(), Stop> {
        let longest = self.options.step_in(self.homotopy.unit);
        let (first, longest) = match self.options.preset {
            Preset::Default => (FIRST_STEP, longest.unwrap_or(f64::INFINITY)),
            Preset::Paper => (f64::INFINITY, longest.unwrap_or(LONGEST_STEP)),
        };
        let may_try = |h: f64, failures| failures == 0 || h >= SMALLEST_STEP;
        let stuck = float::follow(first.min(longest), may_try, |h, failures| {
            self.step(h, longest, failures, control)
        })?;
        let Some(stuck) = stuck else {
            return Ok(());
        };
        let stop = self.record.stuck(self.homotopy, self.current.t(), stuck);
        Err(match stuck.why {
            UNCLEAR => Stop {
                kind: StopKind::Undecided,
                ..stop
            },
            _ => stop,
        })
    }

    /// One attempt at a step, and what follows from it. The error is why the run ends.
    fn step(
        &mut self,
        h: f64,
        longest: f64,
        failures: usize,
        control: &mut Control,
    ) -> Result<Tried, Stop> {
        let is_ours = self.options.preset == Preset::Default;
        if is_ours && failures == RENEW_AFTER {
            // The point's own tangent may be what is wrong.
            self.settle()?;
        }
        let attempt = match is_ours {
            true => self.attempt(h),
            false => self.attempt_as_in_the_paper(h, longest),
        };
        let (length, margin, then) = match attempt {
            Attempt::Point {
                length,
                margin,
                then,
            } => (length, margin, then),
            Attempt::Boundary if self.looks < LOOKS_AHEAD => {
                self.looks += 1;
                return match self.change_plan(true, f64::INFINITY)? {
                    true => Ok(Tried::Again),
                    false => self.failed(FAILED),
                };
            }
            Attempt::Boundary | Attempt::Failed => return self.failed(FAILED),
        };
        // Looking between the points evaluates the plan elsewhere.
        let near = self.evaluation.is_near_boundary() || self.evaluation.is_out_of_order();
        let Ok(end) = self.look_between(length, margin) else {
            return self.failed(UNCLEAR);
        };
        self.advance(length, end.unwrap_or(length));
        if end.is_some() {
            return Ok(Tried::Closed);
        }
        let restore = if is_ours { RESTORE } else { 1.0 };
        let is_due = is_ours && self.record.steps.is_multiple_of(RESTORE_EVERY);
        if near || is_due && self.plan_is_restorable(restore) {
            self.change_plan(false, restore)?;
        }
        self.record.go_on(self.current.t(), self.options, control)?;
        self.looks = 0;
        Ok(Tried::Taken(then.min(longest)))
    }

    fn failed(&mut self, why: &'static str) -> Result<Tried, Stop> {
        self.record.rejected += 1;
        Ok(Tried::Failed(why))
    }

    /// A point on the cubic through the last two, corrected with exact derivatives.
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
        // Whatever is no number is none.
        if !(error <= ERROR * h && turn <= TURN) {
            return Attempt::Failed;
        }
        // The predictor's error grows like h⁴, and with it what the corrector's contraction is
        // lacking; the turn like h.
        let length = self.arc_length();
        let by_error = (0.5 * ERROR * length / error.max(1e-300)).sqrt().sqrt();
        let contraction = self.corrector.contraction;
        let by_contraction = (CONTRACTION / contraction.max(1e-300)).sqrt().sqrt();
        let growth = by_error
            .min(by_contraction)
            .min(0.8 * TURN / turn.max(1e-300))
            .clamp(0.5, 2.0);
        Attempt::Point {
            length,
            margin: 0.25 * error + 1e-9,
            then: h * growth,
        }
    }
}
