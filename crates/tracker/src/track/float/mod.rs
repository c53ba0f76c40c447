//! Following paths in floats: the loop of steps that all float trackers share, and what a run has seen. Nothing is proved.
//!
//! A space and a way of stepping in it, krawl's or the papers', are what the loop is given: a function that tries one
//! step of a given length. It predicts and corrects a point, looks at what lies before it, and tells how long the next
//! step may be.

mod record;

pub use record::Record;

/// Steps below this end a run, in the homotopy's unit.
pub const SMALLEST_STEP: f64 = 1e-10;

/// What came of trying a step.
#[derive(Debug, Clone, Copy)]
pub enum Tried {
    /// The path has gone on, and the next step may have this length.
    Taken(f64),
    /// It is back at its start.
    Closed,
    /// It has not gone on, for this reason.
    Failed(&'static str),
    /// What it is followed with was changed; the same step is to be tried again. Whoever says so counts how often: the loop does not.
    Again,
}

/// Where no step succeeds, however short.
#[derive(Debug, Clone, Copy)]
pub struct Stuck {
    /// Why the last one failed.
    pub why: &'static str,
    /// The length that is not tried any more.
    pub step: f64,
}

/// Steps along a path, from one of the length `first` on, and halves those that fail. `attempt` is given the length, and
/// how many steps in a row have failed; its error is how the path ends. `may_try` tells whether a step of a length may
/// be tried after so many failures. `None`: the path is back at its start.
#[inline(always)]
pub fn follow<E>(
    first: f64,
    may_try: impl Fn(f64, usize) -> bool,
    mut attempt: impl FnMut(f64, usize) -> Result<Tried, E>,
) -> Result<Option<Stuck>, E> {
    let (mut step, mut failures, mut why) = (first, 0, "");
    while may_try(step, failures) {
        match attempt(step, failures)? {
            Tried::Taken(next) => (step, failures) = (next, 0),
            Tried::Closed => return Ok(None),
            Tried::Failed(reason) => {
                (step, failures, why) = (0.5 * step, failures + 1, reason);
            }
            Tried::Again => {}
        }
    }
    Ok(Some(Stuck { why, step }))
}

/// The papers' next step: twice as long as the last, where that is not too long.
pub fn doubled(step: f64, longest: f64) -> f64 {
    match 2.0 * step <= longest {
        true => 2.0 * step,
        false => step,
    }
}
