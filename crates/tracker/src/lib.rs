//! Problems, their equations, and the trackers that follow the paths of their sketches, in krawl.
//!
//! Programs use it through the package `krawl`, which has all that is public of it under the same paths. What is hidden
//! here is for krawl's own packages; it is no part of the interface.

#![warn(missing_docs)]

// Tests in here and in tests/ draw the same problems.
#[cfg(test)]
extern crate self as krawl;

#[doc(hidden)]
pub use krawl_kernel::{
    debug_in_words, decimal, elimination, hexadecimal, linalg, map, model, named, order, places,
    random, residues, sets,
};
pub use krawl_kernel::{equations, interval, rational};

pub mod constraint;
pub mod generate;
#[doc(hidden)]
pub mod plan;
pub mod problem;
#[doc(hidden)]
pub mod statement;
pub mod system;
pub mod track;
