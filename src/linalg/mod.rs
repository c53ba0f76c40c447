//! Dense kernels on small square matrices, and the norms that proofs are made of.
//!
//! Everything here is plain floating point; what it may have rounded away is bounded by the
//! caller with [`crate::interval::rounding`], from the operation counts stated with each kernel.

mod inverse;
mod matrix;
mod pivots;
pub mod rstructure;

pub use inverse::{Inverter, Singular};
pub use matrix::{LANE, Matrix, Sparse, Vector};
