//! Elimination through the R-structure of the Jacobian, for any equations: `layout` splits unknowns and
//! equations at a point (in the order of a plan; where there are other equations than distances `groups` does so in
//! the order of `sequence`; `pivots` has what both do for one group), `passes` goes through the blocks, `elimination` solves.

pub mod elimination;
pub mod groups;
pub mod layout;
pub mod passes;
mod pivots;
mod sequence;
mod substitution;
