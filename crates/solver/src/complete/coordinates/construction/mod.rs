//! Blocks whose unknowns are constructed, step by step, as functions of a few of them.
//!
//! [`order`] says which unknowns are found from which equations, and [`walk`] what comes of that in a part of the space, as Taylor models
//! in a few unknowns. Parts stay boxes of all unknowns, so that which of them are variables, and on which side of a plane a point is, is
//! decided anew in each part: the plan of a part may differ from its neighbour's.

mod order;
#[cfg(test)]
mod tests;
mod walk;

pub use order::Order;
pub use walk::{Leaf, walk};
