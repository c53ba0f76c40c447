//! Plain floating-point tracking in the full space: fast, and an observation, not a proof.

mod crossing;
mod open;
mod paper;
mod record;
mod tracker;

pub use open::follow_both_ways;
pub use paper::{LARGEST_STEP as LARGEST_STEP_OF_PAPER, track as track_paper};
pub use record::Record;
use tracker::follow;
pub use tracker::track;
