//! R-structured linear systems: few key unknowns, and without them a block triangular rest.
//!
//! A well-constrained system of equations that cannot be decomposed may fall apart once the
//! values of k *key unknowns* are known: then k of its equations, the *ignored* ones, are left
//! over, and the others can be solved block by block. Its Jacobian has the *R-structure* of
//! Barki, Fang, Michelucci and Foufou, *Re-parameterization reduces irreducible geometric
//! constraint systems* (CAD 70, 2016; "002" for short), sections 2 and 5:
//!
//! ```text
//!   key   others
//! [  H  |  A  ]   A block lower triangular, n × n
//! [  C  |  L  ]   ignored equations, k of them
//! ```
//!
//! and systems H U + A X = R, C U + L X = S cost little more than one pass over A's entries for
//! each key unknown, instead of O(n³). Here,
//!
//! - [`Ordering`] finds the blocks, given equations, unknowns, key unknowns and ignored equations,
//! - [`RMatrix`] stores what such a matrix has, and nothing else,
//! - [`Factors`] solves with it, by the seven steps of 002, section 5 (the crate's trackers take these steps
//!   with Jacobians of their own),
//! - [`Enclosure`] encloses solutions for interval right-hand sides (section 7, eq. 21),
//! - [`hensel`] lifts roots modulo a prime to roots modulo its powers (section 6),
//! - [`backward_error`] says how good a float solution is.
//!
//! ```
//! use krawl::linalg::rstructure::{Factors, Ordering, RMatrix, backward_error};
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
//! let mut matrix = RMatrix::zeros(ordering.structure(&equations));
//! for (i, unknowns) in equations.iter().enumerate() {
//!     for &j in unknowns {
//!         matrix.set(ordering.row_of(i), ordering.column_of(j), value(i, j));
//!     }
//! }
//! let b = [1.0; 6];
//! let x = Factors::new(&matrix).unwrap().solve(&b);
//! assert!(backward_error(&matrix, &x, &b) < 1e-15);
//! ```

pub(crate) mod elimination;
mod enclosure;
mod factors;
pub mod hensel;
mod kernel;
mod matrix;
mod ordering;
pub(crate) mod rows;
mod scalar;
mod structure;
#[cfg(test)]
mod tests;

pub use enclosure::Enclosure;
pub use factors::{Factors, Singular};
pub use matrix::{RMatrix, backward_error};
pub use ordering::{Ordering, OrderingError};
pub use scalar::{Residue, Scalar};
pub use structure::{Structure, StructureError};
