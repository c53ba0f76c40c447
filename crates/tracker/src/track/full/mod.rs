//! The path in all free coordinates (RR 8705, section 2.2: "tracking S").
//!
//! A point of the path is a vector z = (X, t) of n = m + 1 numbers. Around one, [`Local`] holds
//! what both trackers need: a preconditioner, and the Taylor expansion of the path. `float` follows it
//! in plain floating point; `certified` has the test that proves tubes around it.

pub mod certified;
mod equations;
mod extended;
pub mod float;
mod local;
pub(in crate::track) mod newton;
mod preconditioner;
mod refine;
mod roundings;
mod singular;
mod singularity;
mod start;
mod tail;

pub use equations::{Differences, Equations, Lengths, MAX_DEGREE};
pub use extended::shift;
pub(in crate::track) use local::MAX_ORDER;
pub use local::{DEGREE, Local, ORDER, condition};
pub use preconditioner::{InverseMaker, Preconditioner};
pub use refine::{CrossingRoom, RefineError};
pub use start::{LARGEST_TANGENT, first_normal, path_length, sketch};
#[cfg(test)]
pub use tail::Part;
pub use tail::{Forms, Tail};
