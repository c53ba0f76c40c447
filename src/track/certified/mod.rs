//! Every step a theorem: tubes proved by a Krawczyk test, linked without a gap.
//!
//! From the bottom up: `shortfall` (which condition of the test fails), `low_orders` and `norms` (from
//! bounds to the longest tube they prove), `precision`, `link` (tubes, and that one leads to the
//! next), `tube`, `extended` and `exit` (the test in the full space), `reduced` (that through a
//! construction plan), `solution` (boxes around points with t = 1), `reasons` (why runs stop), `ledger`
//! (what has been proved so far), `trace` (the path, kept to be drawn), `tracker` (the chain of tubes, in whichever space).

mod exit;
mod extended;
mod ledger;
mod link;
mod low_orders;
mod norms;
mod precision;
mod reasons;
mod reduced;
mod shortfall;
mod solution;
mod trace;
mod tracker;
mod tube;
#[cfg(test)]
mod validation;

pub use trace::{Fold, Sample, Trace};

use crate::system::Homotopy;
use crate::track::full::ORDER;
use crate::track::{Control, Options, Outcome, Space};

/// Follows the path and proves every step.
pub fn track<const D: usize>(
    homotopy: &Homotopy,
    options: &Options,
    control: &mut Control,
) -> Outcome {
    let full = tracker::track::<D, { ORDER + 1 }, tube::KrawczykTest<D>>;
    match (options.space, control.witness.is_some()) {
        (Space::Full, _) => full(homotopy, options, control),
        (Space::Reduced, false) => {
            tracker::track::<D, { reduced::COEFFICIENTS }, reduced::ReducedTest<D>>(
                homotopy, options, control,
            )
        }
        // A certificate's tubes are boxes in the full space.
        (Space::Reduced, true) => {
            let mut outcome = full(homotopy, options, control);
            outcome.switched_on.push(
                "full space: a certificate was asked for, and its tubes are those of the full space"
                    .to_owned(),
            );
            outcome
        }
    }
}
