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

/// An enum of which each variant has a name, which `name` tells; `ALL` lists those of one whose variants have nothing in them.
#[doc(hidden)]
#[macro_export]
macro_rules! named {
    ($(#[$about:meta])* $vis:vis enum $sort:ident { $($(#[$what:meta])* $variant:ident = $name:literal,)* }) => {
        $(#[$about])*
        $vis enum $sort {
            $($(#[$what])* $variant,)*
        }

        impl $sort {
            /// All of them.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$variant),*];

            /// Its name in files and tables, and where it can be chosen on the command line.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }
        }
    };
    ($(#[$about:meta])* $vis:vis enum $sort:ident { $($(#[$what:meta])* $variant:ident $(($inside:ty))? = $name:literal,)* }) => {
        $(#[$about])*
        $vis enum $sort {
            $($(#[$what])* $variant $(($inside))?,)*
        }

        impl $sort {
            /// Its name in files and tables.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant { .. } => $name,)*
                }
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
pub mod model;
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
