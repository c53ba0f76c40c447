//! Tubes proved through the R-structure of a construction plan. `test` has the theorem.
//!
//! What a tube keeps: `frame` (the box, in coordinates in which the key unknowns stand apart), `shape` (how large
//! that box is for each unknown), `series` (the eliminating transformation K(s) and the preconditioner Z(s)).
//!
//! How it is proved: `along` says how large everything is along the tube's polynomial (`tail`: the same for equations
//! that are no distances), `resolvent` bounds |A(s)⁻¹| (`diagonal`: of one of its blocks), `sides` what that and the
//! preconditioner make of right-hand sides, `left_over` what the key unknowns' rows leave over; `rounds` puts the
//! bounds together, `bounds` finds the longest tube that they prove, `speed` how fast points move through the box.
//! `exit` encloses the point where the path leaves a tube.

mod along;
mod bounds;
mod diagonal;
mod exit;
mod frame;
mod left_over;
mod resolvent;
mod rounds;
mod series;
mod shape;
mod sides;
mod speed;
mod tail;
mod test;

use crate::track::full::MAX_DEGREE;

pub use test::ReducedTest;
#[cfg(test)]
pub use {crate::track::reduced::structure::layout::Block, bounds::Bounds, frame::Reduction};

/// The tubes' polynomials have so many coefficients.
pub const COEFFICIENTS: usize = 9;
/// Their degree.
const ORDER: usize = COEFFICIENTS - 1;
/// The largest power of s in F(ẑ(s)).
const DEGREE: usize = MAX_DEGREE * ORDER;
