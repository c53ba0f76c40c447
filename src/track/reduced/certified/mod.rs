//! Tubes proved through the R-structure of a construction plan: see `test.rs` for the theorem.

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
pub use {crate::track::reduced::structure::layout::Block, bounds::Bounds};

/// The tubes' polynomials have so many coefficients.
pub const COEFFICIENTS: usize = 9;
/// Their degree.
const ORDER: usize = COEFFICIENTS - 1;
/// The largest power of s in F(ẑ(s)).
const DEGREE: usize = MAX_DEGREE * ORDER;
