//! Every step a theorem: tubes proved by a Krawczyk test, linked without a gap.
//!
//! What both spaces have in common; their tests are in `full/certified` and `reduced/certified`. From the bottom
//! up: `shortfall` (which condition of a test fails), `proof` (from a contraction to a tube), `link` (tubes, and
//! that one leads to the next), `solution` (boxes around points with t = 1), `reasons` (why runs stop),
//! `ledger` (what has been proved so far), `trace` (the path, kept to be drawn), `piece` (where the path is between two
//! parameters of a tube), `orientation` and `beside` (what is told from that: signs that are kept, equations that are met), `tracker`
//! (the chain of tubes, in whichever space).

mod beside;
mod figures;
mod fold;
mod ledger;
pub(in crate::track) mod link;
mod orientation;
mod piece;
pub(in crate::track) mod proof;
mod reasons;
pub(in crate::track) mod shortfall;
mod solution;
mod trace;
pub(in crate::track) mod tracker;
#[cfg(test)]
mod validation;

pub use figures::{FigureBox, FiguresSeen, Relation, prove_figure};
pub(in crate::track) use ledger::{Congruence, classes, is_congruent};
pub use solution::Same;
pub use trace::{Fold, Sample, Trace, TubePart};

use crate::system::Homotopy;
use crate::track::arc::{ArcRun, Figure};
use crate::track::full::ORDER;
use crate::track::full::certified::KrawczykTest;
use crate::track::reduced::certified::{COEFFICIENTS, ReducedTest};
use crate::track::{Control, Options, Outcome, Space};

/// A follower of arcs from t = 0 to t = 1 in one space, for problems in 2 or 3 dimensions.
pub trait FollowArcs: std::fmt::Debug + Send {
    /// The homotopy.
    fn homotopy(&self) -> &Homotopy;

    /// The homotopy, whose lengths may be changed between two arcs.
    fn homotopy_mut(&mut self) -> &mut Homotopy;

    /// Follows the arc from the figure that the box `start` holds, the only one in it that meets the
    /// lengths at t = 0, proving every step and that t rises.
    fn follow(&mut self, start: &Figure, control: &mut Control) -> ArcRun;

    /// Says that the equations are those of the real and imaginary parts of complex ones in complex unknowns: then
    /// a path that a tube proves to be regular cannot turn back in t, and no tube has to be so short as to show it.
    ///
    /// Proofs are wrong if the equations are not of this kind.
    fn set_complex(&mut self);

    /// Proves a box around the figure with t = 1 near a point (one entry per unknown): it holds exactly one,
    /// and within the distance that comes with it from the box's middle, in every entry, there is no other.
    fn prove_at_end(&mut self, near: &[f64]) -> Result<(Figure, f64), String>;
}

/// What follows arcs of a homotopy's equations in the space that `options` say.
pub fn arcs(homotopy: Homotopy, options: &Options) -> Box<dyn FollowArcs> {
    match options.space {
        Space::Full => Box::new(tracker::Arcs::<{ ORDER + 1 }, KrawczykTest>::new(
            homotopy, options,
        )),
        Space::Reduced => Box::new(tracker::Arcs::<{ COEFFICIENTS }, ReducedTest>::new(
            homotopy, options,
        )),
    }
}

/// Follows the path through the sketch and proves every step.
pub fn track(homotopy: &Homotopy, options: &Options, control: &mut Control) -> Outcome {
    track_from(homotopy, None, options, control)
}

/// Follows the path through a figure at t = 0 that a box holds, the only one in it, or else through the sketch, and proves
/// every step.
pub fn track_from(
    homotopy: &Homotopy,
    start: Option<&Figure>,
    options: &Options,
    control: &mut Control,
) -> Outcome {
    let track = match options.space {
        Space::Full => tracker::track::<{ ORDER + 1 }, KrawczykTest>,
        Space::Reduced => tracker::track::<{ COEFFICIENTS }, ReducedTest>,
    };
    track(homotopy, start, options, control)
}
