//! What is found and proved with krawl's trackers: edits, motions, sets of all solutions, and certificates with their
//! checker.
//!
//! Programs use it through the package `krawl`, which has all that is public of it under the same paths. What is hidden
//! here is for krawl's own packages; it is no part of the interface.

#![warn(missing_docs)]

// Tests in here and in tests/ draw the same problems.
#[cfg(test)]
extern crate self as krawl;

pub use krawl_tracker::{
    constraint, equations, generate, interval, problem, rational, system, track,
};
#[doc(hidden)]
pub use krawl_tracker::{
    debug_in_words, decimal, elimination, hexadecimal, linalg, map, model, named, order, places,
    plan, random, residues, sets, statement,
};

pub mod blocks;
pub mod certificate;
pub mod complete;
pub mod complex;
pub mod digits;
pub mod edit;
#[doc(hidden)]
pub mod journal;
pub mod motion;
#[doc(hidden)]
pub mod remarks;
pub mod tolerance;

/// The library of points and motions that the interface speaks, in the version it speaks.
pub use nalgebra;
