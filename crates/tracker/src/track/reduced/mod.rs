//! The path through a construction plan: a few driving parameters, and points built one after the other.
//!
//! `float` follows it in the driving parameters alone, as RR 8705 does, and where there are other constraints
//! than distances in all coordinates, with the block elimination of `structure` for a preconditioner; `certified`
//! proves tubes with that.

pub mod certified;
pub mod float;
mod plans;
pub mod structure;
