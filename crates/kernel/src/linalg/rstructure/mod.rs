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
//! - [`Elimination`] takes the seven steps of 002, section 5, for any matrix that can substitute through
//!   its diagonal blocks ([`Blocks`]), as the trackers' Jacobians can.
//!
//! `crates/lab` has matrices that are stored as such, and measures these steps against dense elimination.

mod elimination;
mod ordering;
mod rows;
mod scalar;

pub use elimination::invert_transposed;
pub use elimination::{Blocks, Elimination, Solves};
pub use ordering::{Ordering, OrderingError};
pub use rows::{Lane, MAX_KEYS, Row, add, zeros};
pub use rows::{width_for, with_width};
pub use scalar::Scalar;
