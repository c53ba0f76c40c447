//! How a run talks to its caller: progress out, a request to stop in.

use super::Witness;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Where a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// The current t.
    pub t: f64,
    /// Steps so far.
    pub steps: usize,
    /// Solutions so far.
    pub solutions: usize,
    /// Path length so far.
    pub length: f64,
}

/// Where to give up a run, as if it were cancelled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// When the path followed is longer than this.
    pub length: f64,
    /// When the clock shows this; looked at every [`Control::EVERY`] steps.
    pub deadline: Instant,
}

/// Hooks for a run.
#[derive(Default)]
pub struct Control<'a> {
    /// Set from outside (Ctrl-C) to end the run after the current step.
    pub cancel: Option<&'a AtomicBool>,
    /// Where to give up.
    pub limit: Option<Limit>,
    /// Called now and then, every [`Control::EVERY`] steps.
    pub progress: Option<&'a mut dyn FnMut(Progress)>,
    /// Sees the proof of a certified run.
    pub witness: Option<&'a mut dyn Witness>,
}

impl Control<'_> {
    /// Steps between two calls of `progress`.
    pub const EVERY: usize = 64;

    /// To be called after each step: reports, and tells whether the run must end.
    pub fn is_cancelled(&mut self, now: Progress) -> bool {
        if now.steps.is_multiple_of(Self::EVERY)
            && let Some(progress) = &mut self.progress
        {
            progress(now);
        }
        let passed = |limit: &Limit| {
            now.length > limit.length
                || now.steps.is_multiple_of(Self::EVERY) && Instant::now() > limit.deadline
        };
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
            || self.limit.as_ref().is_some_and(passed)
    }
}
