//! What computes and proves in krawl: problems, the paths of their sketches, edits, sets of all solutions, and
//! certificates with their checker.
//!
//! Programs use it through the package `krawl`, which has all of this under the same paths, beside what reads, compares
//! and writes it. What is hidden here is for that package; it is no part of the interface.

#![warn(missing_docs)]

/// Lets errors print as words where programs print them with `{:?}`, as `main` does.
#[doc(hidden)]
#[macro_export]
macro_rules! debug_in_words {
    ($error:ty) => {
        impl std::fmt::Debug for $error {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                std::fmt::Display::fmt(self, f)
            }
        }
    };
}
// Tests in here and in tests/ draw the same problems.
#[cfg(test)]
extern crate self as krawl;

pub mod blocks;
pub mod certificate;
pub mod complete;
pub mod complex;
pub mod constraint;
mod decimal;
pub mod edit;
#[doc(hidden)]
pub mod elimination;
pub mod equations;
pub mod generate;
#[doc(hidden)]
pub mod hexadecimal;
pub mod interval;
#[doc(hidden)]
pub mod linalg;
pub mod motion;
#[doc(hidden)]
pub mod order;
#[doc(hidden)]
pub mod places;
#[doc(hidden)]
pub mod plan;
pub mod problem;
#[doc(hidden)]
pub mod random;
#[doc(hidden)]
pub mod remarks;
mod residues;
mod statement;
pub mod system;
pub mod tolerance;
pub mod track;

/// The library of points and motions that the interface speaks, in the version it speaks.
pub use nalgebra;
