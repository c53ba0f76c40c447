//! Tubes proved through the R-structure of a construction plan: see `test.rs` for the theorem.

mod bounds;
mod elimination;
mod exit;
mod frame;
mod layout;
mod passes;
mod resolvent;
mod series;
mod test;

pub use test::{COEFFICIENTS, ReducedTest};
#[cfg(test)]
pub use {bounds::Bounds, layout::Block};
