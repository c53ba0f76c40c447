//! Plain floating-point tracking in the full space: fast, and an observation, not a proof.

mod crossing;
mod open;
mod paper;
mod tracker;

pub use open::follow_both_ways;
pub use paper::{LARGEST_STEP as LARGEST_STEP_OF_PAPER, track as track_paper};
use tracker::follow;
pub use tracker::track;

/// Lengths of congruent figures agree to that, relative to the figure's size.
pub const SAME_LENGTH: f64 = 1e-9;
