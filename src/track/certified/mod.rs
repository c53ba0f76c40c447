//! Every step a theorem: tubes proved by a Krawczyk test, linked without a gap.

mod exit;
mod ledger;
mod link;
mod norms;
mod reduced;
mod solution;
mod tracker;
mod tube;
#[cfg(test)]
mod validation;

use crate::system::Homotopy;
use crate::track::full::ORDER;
use crate::track::{Control, Options, Outcome, Space};

/// Follows the path and proves every step.
pub fn track<const D: usize>(
    homotopy: &Homotopy,
    options: &Options,
    control: &mut Control,
) -> Outcome {
    match options.space {
        Space::Full => {
            tracker::track::<D, { ORDER + 1 }, tube::KrawczykTest<D>>(homotopy, options, control)
        }
        Space::Reduced => tracker::track::<D, { reduced::COEFFICIENTS }, reduced::ReducedTest<D>>(
            homotopy, options, control,
        ),
    }
}
