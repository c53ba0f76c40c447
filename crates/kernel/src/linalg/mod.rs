//! Dense kernels on square matrices, small and large, the norms that proofs are made of, and large systems
//! that fall apart but for a few unknowns ([`rstructure`]).
//!
//! The dense kernels are plain floating point; what they may have rounded away is bounded by the
//! caller with [`crate::interval::rounding`], from the operation counts stated with each kernel.

mod axes;
mod decompose;
mod definite;
mod inverse;
mod large;
mod least;
mod matrix;
mod pivots;
mod rank;
pub mod rstructure;
mod span;

pub use axes::with_axes;
pub use decompose::{Block, Blocks, LeftOver};
pub use definite::is_positive_definite;
pub use inverse::{Inverter, Singular};
pub use large::{LARGE, Workers};
pub use least::{
    Linear, damped, decomposed, linearised, nearest, nearest_zero, scaled, shortest, weakest,
};
pub use matrix::{LANE, Matrix, Sparse, Vector, dot};
pub use pivots::is_odd;
pub use rank::extreme_pivots;
pub use span::Span;
