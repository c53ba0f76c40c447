//! When extended precision comes on along a path, when it goes off, and what is said of it.

use super::{EXIT, Test, Tracker};
use crate::order::each_once;
use crate::problem::counted;
use crate::track::certified::reasons::Rejection;
use crate::track::full::{Local, Preconditioner, RefineError};

/// Steps below this, relative to the size of the figure, end the run, or switch extended precision on.
const SMALLEST_STEP: f64 = 1e-11;
/// In extended precision. Predictions are made in 53 bits, and would not get any further.
const SMALLEST_EXTENDED_STEP: f64 = 1e-15;
/// Whenever it was switched on again it stays on for twice as many needless tubes, up to this: in 53
/// bits it takes some forty trials to find that they do not suffice.
const MAX_PATIENCE: usize = 64;

/// Where extended precision is on along a path, and since when: on, off, on…
#[derive(Debug, Default)]
pub(super) struct Extension {
    stretches: Vec<Stretch>,
    /// Whether it is on.
    pub on: bool,
    /// Tubes since, in a row, for which 53 bits would have done.
    needless: usize,
    /// Whether the point of the tube before the last one was found in extended precision.
    pub before_last: bool,
}

/// Tubes in extended precision, one after the other.
#[derive(Debug)]
struct Stretch {
    tubes: usize,
    /// The least and the largest t at their middles.
    t: (f64, f64),
    /// What 53 bits could not do.
    why: &'static str,
}

impl Extension {
    /// On, as 53 bits could not do something.
    fn switch_on(&mut self, why: &'static str) {
        self.on = true;
        self.needless = 0;
        self.stretches.push(Stretch {
            tubes: 0,
            t: (f64::INFINITY, f64::NEG_INFINITY),
            why,
        });
    }

    /// Counts a tube, around a point with this t, for which 53 bits would have been enough or not.
    /// Tells whether that was the last, extended precision being off from here.
    fn count(&mut self, t: f64, enough: bool) -> bool {
        let switched = self.stretches.len();
        if let Some(stretch) = self.stretches.last_mut() {
            stretch.tubes += 1;
            stretch.t = (stretch.t.0.min(t), stretch.t.1.max(t));
        }
        self.needless = if enough { self.needless + 1 } else { 0 };
        let patience = 1usize << (switched - 1).min(MAX_PATIENCE.ilog2() as usize);
        self.on = self.needless < patience;
        !self.on
    }

    /// Whether the point of the tube before may guide the prediction at `advance` from this one: points
    /// are as accurate as the tubes where they were found are wide, so that those of 53 bits would lead
    /// those in extended precision astray, and near ones would bring their rounding only.
    pub fn trusts<const N: usize, Y: Preconditioner>(
        &self,
        before: &[f64],
        now: &Local<N, Y>,
        advance: f64,
    ) -> bool {
        match (self.on, now.is_extended) {
            (false, false) => true,
            (true, true) => {
                self.before_last && advance.abs() <= 2.0 * now.parameter_of(before).abs()
            }
            _ => false,
        }
    }

    /// For people: how many tubes, where, and why.
    pub fn in_words(&self) -> Vec<String> {
        let of = |why: &'static str| {
            let stretches: Vec<_> = self.stretches.iter().filter(|s| s.why == why).collect();
            let tubes: usize = stretches.iter().map(|s| s.tubes).sum();
            let ends = stretches.iter().map(|s| s.t);
            let (from, to) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), t| {
                (lo.min(t.0), hi.max(t.1))
            });
            let place = match (tubes, stretches.len()) {
                (0, _) => String::new(),
                (_, 1) => format!(", t from {from:.12} to {to:.12}"),
                (_, n) => format!(" in {n} stretches, t from {from:.12} to {to:.12}"),
            };
            format!(
                "extended precision (double-double), {}{place}: 53 bits could not {why}",
                counted(tubes, "tube")
            )
        };
        let reasons = each_once(self.stretches.iter().map(|s| s.why));
        reasons.into_iter().map(of).collect()
    }
}

impl<const N: usize, T: Test<N>> Tracker<'_, N, T> {
    /// Switches extended precision on where that may help: where 53 bits stop at the smallest step, and
    /// nothing but rounding keeps the test from proving a tube; or a tube is proved, but it is rounding
    /// that hides whether it meets t = 1, or how it joins the one before, as tubes so short have no
    /// other error; or no point can be refined, though the prediction is as good as rounding lets it be.
    pub(super) fn extend(&mut self, rejection: Rejection) -> bool {
        let rounding = match rejection {
            Rejection::Unproved => self.test.is_limited_by_rounding(),
            Rejection::Refine(RefineError::Singular) => false,
            Rejection::Refine(RefineError::Diverged) => true,
            Rejection::Undecided(_) | Rejection::Short(_) | Rejection::Unlinked => true,
        };
        if self.extension.on || !rounding || !self.test.set_extended(true) {
            return false;
        }
        self.equations.extend(&self.homotopy);
        self.extension.switch_on(rejection.in_short());
        // It can be enclosed more tightly now.
        self.now.exit_is_tight = false;
        true
    }

    /// Notes the tube that was added last, and switches extended precision off where 53 bits would
    /// have done.
    pub(super) fn account_for_precision(&mut self) {
        if !self.extension.on {
            return;
        }
        let tube = &self.now;
        let enough = self.test.in_53_bits().is_some_and(|proof| {
            // As long a tube, and as sure of t = 1.
            let (from, to) = (tube.entry.0.max(-proof.h), proof.h);
            let time = tube.time_if(&proof);
            proof.h >= 0.5 * tube.proof.h
                && time.crossings(from, EXIT * to, &mut Vec::new()).is_ok()
        });
        let t = tube.local.z[0][self.equations.m];
        if self.extension.count(t, enough) {
            self.test.set_extended(false);
        }
    }

    pub(super) fn smallest_step(&self) -> f64 {
        let relative = if self.extension.on {
            SMALLEST_EXTENDED_STEP
        } else {
            SMALLEST_STEP
        };
        relative * self.figure_size()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stays_on_longer_each_time() {
        let mut extension = Extension::default();
        assert!(!extension.on && extension.in_words().is_empty());
        for stay in [1, 2, 4] {
            extension.switch_on("prove a tube");
            assert!(!extension.count(0.5, false));
            for k in 1..=stay {
                assert_eq!(extension.count(0.25 * stay as f64, true), k == stay);
            }
        }
        let words = extension.in_words();
        assert_eq!(words.len(), 1);
        assert!(
            words[0].contains("10 tubes in 3 stretches, t from 0.25"),
            "{words:?}"
        );
    }
}
