//! The path through a construction plan: a few driving parameters, and points built one after the other.
//!
//! `float` follows it in the driving parameters alone, as RR 8705 does; `certified` proves tubes in all
//! coordinates, with the plan's block elimination for a preconditioner.

pub mod certified;
pub mod float;
