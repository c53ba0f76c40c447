//! How a run talks to its caller: progress out, a request to stop in.

use super::Witness;
use std::sync::atomic::{AtomicBool, Ordering};

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

/// Hooks for a run.
#[derive(Default)]
pub struct Control<'a> {
    /// Set from outside (Ctrl-C) to end the run after the current step.
    pub cancel: Option<&'a AtomicBool>,
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
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }
}
