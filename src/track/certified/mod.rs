//! Every step a theorem: tubes proved by a Krawczyk test, linked without a gap.

mod link;
mod solution;
mod tracker;
mod tube;

pub use tracker::track;
