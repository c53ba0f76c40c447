//! R-structured matrices that are stored as such: dense diagonal blocks of any sizes, and panels of columns
//! left of them.
//!
//! [`krawl::linalg::rstructure`] says what an R-structure is (Barki, Fang, Michelucci and Foufou, CAD 70, 2016;
//! "002" for short), finds one, and eliminates with it as krawl's trackers do. Here,
//!
//! - [`RMatrix`] stores what such a matrix has, and nothing else,
//! - [`Factors`] solves with it, by the seven steps of 002, section 5,
//! - [`Enclosure`] encloses solutions for interval right-hand sides (section 7, eq. 21),
//! - [`hensel`] lifts roots modulo a prime to roots modulo its powers (section 6),
//! - [`backward_error`] says how good a float solution is.
//!
//! ```
//! use krawl::linalg::rstructure::Ordering;
//! use krawl_lab::rstructure::{Factors, RMatrix, Structure, backward_error};
//!
//! // Figure 1 of 002, without u (remark 1): triangle ABC held by bars AA', BB', CC', where A'B'C'
//! // is fixed. Unknowns xA, yA, xB, yB, xC, yC; the equations of AA', BB', AB, AC, BC, CC'.
//! let equations = [
//!     vec![0, 1], vec![2, 3], vec![0, 1, 2, 3], vec![0, 1, 4, 5], vec![2, 3, 4, 5], vec![4, 5],
//! ];
//! // If xA were known, the length of CC' would be redundant.
//! let ordering = Ordering::new(6, &equations, &[0], &[5]).unwrap();
//! assert_eq!(ordering.block_sizes(), [1, 2, 2]);
//!
//! // A matrix with this pattern, and a system with it.
//! let value = |i: usize, j: usize| ((3 * i + 5 * j) as f64).sin();
//! let mut matrix = RMatrix::zeros(Structure::of(&ordering, &equations));
//! for (i, unknowns) in equations.iter().enumerate() {
//!     for &j in unknowns {
//!         matrix.set(ordering.row_of(i), ordering.column_of(j), value(i, j));
//!     }
//! }
//! let b = [1.0; 6];
//! let x = Factors::new(&matrix).unwrap().solve(&b);
//! assert!(backward_error(&matrix, &x, &b) < 1e-15);
//! ```

mod enclosure;
mod factors;
pub mod hensel;
mod kernel;
mod matrix;
mod scalar;
mod structure;
#[cfg(test)]
mod tests;

pub use enclosure::Enclosure;
pub use factors::{Factors, Singular};
pub use krawl::linalg::rstructure::Scalar;
pub use matrix::{RMatrix, backward_error};
pub use scalar::Residue;
pub use structure::{Structure, StructureError};
