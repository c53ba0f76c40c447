//! What krawl computes with: exact numbers, enclosures of numbers, rows of equations, and linear algebra on all of them.
//!
//! Programs use it through the package `krawl`, which has all that is public of it under the same paths. What is hidden
//! here is for krawl's own packages; it is no part of the interface.

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

#[doc(hidden)]
pub mod decimal;
#[doc(hidden)]
pub mod elimination;
pub mod equations;
#[doc(hidden)]
pub mod hexadecimal;
pub mod interval;
#[doc(hidden)]
pub mod linalg;
#[doc(hidden)]
pub mod map;
#[doc(hidden)]
pub mod order;
#[doc(hidden)]
pub mod places;
#[doc(hidden)]
pub mod random;
pub mod rational;
#[doc(hidden)]
pub mod residues;
#[doc(hidden)]
pub mod sets;
