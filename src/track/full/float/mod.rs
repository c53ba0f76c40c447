//! Plain floating-point tracking in the full space: fast, and an observation, not a proof.

mod crossing;
mod paper;
mod record;
mod tracker;

pub use paper::{LARGEST_STEP as LARGEST_STEP_OF_PAPER, track as track_paper};
pub use record::Record;
pub use tracker::{follow, track};
