//! How a run talks to its caller: progress out, a request to stop in.

use super::{FiguresSeen, Trace, Witness};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

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
    /// When the clock shows this.
    pub deadline: Instant,
}

/// Hooks for a run.
#[derive(Default)]
pub struct Control<'a> {
    /// Set from outside (Ctrl-C) to end the run after the current step.
    pub cancel: Option<&'a AtomicBool>,
    /// Where to give up.
    pub limit: Option<Limit>,
    /// Called after the first step, and then after the first one when so much time has passed since.
    pub progress: Option<&'a mut dyn FnMut(Progress)>,
    /// The time between two calls of `progress`; `None`: [`Control::PAUSE`]. With zero it is called
    /// after each step.
    pub pause: Option<Duration>,
    /// When it was called last.
    pub reported: Option<Instant>,
    /// Sees the proof of a certified run.
    pub witness: Option<&'a mut dyn Witness>,
    /// Keeps the path of a certified run, to be drawn.
    pub trace: Option<&'a mut Trace>,
    /// Keeps the boxes of a certified run's solutions, and of the figures with t = 0 on its path.
    pub figures: Option<&'a mut FiguresSeen>,
}

impl Control<'_> {
    /// Time between two calls of `progress` where nothing else is said.
    pub const PAUSE: Duration = Duration::from_millis(100);

    /// Whether the run is to end, from outside.
    pub fn is_interrupted(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// To be called after each step: reports, and tells whether the run must end.
    pub fn is_cancelled(&mut self, now: Progress) -> bool {
        // The clock is looked at only for whom it matters.
        if self.progress.is_some() || self.limit.is_some() {
            let clock = Instant::now();
            let pause = self.pause.unwrap_or(Self::PAUSE);
            let is_due = |last: Instant| clock.duration_since(last) >= pause;
            if let Some(progress) = &mut self.progress
                && self.reported.is_none_or(is_due)
            {
                self.reported = Some(clock);
                progress(now);
            }
            if let Some(limit) = &self.limit
                && (now.length > limit.length || clock > limit.deadline)
            {
                return true;
            }
        }
        self.is_interrupted()
    }
}
