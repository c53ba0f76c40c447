//! Every step a theorem: tubes proved by a Krawczyk test, linked without a gap.

mod exit;
mod ledger;
mod link;
mod norms;
mod solution;
mod tracker;
mod tube;
#[cfg(test)]
mod validation;

pub use tracker::track;
