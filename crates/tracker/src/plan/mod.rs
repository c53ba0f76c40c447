//! Construction plans: figures built point by point, some of them from driving parameters.
//!
//! A [`Plan`] is data: an ordered list of [`Instruction`]s, of which some use *driving parameters*
//! (added distances, measured from reference points that stand still) in place of distances of
//! the problem; those that are left over are the *removed constraints* (RR 8705, sections 2.3
//! and 6). Its parts each have their own file:
//!
//! - [`Plan::derive`] finds a plan with few driving parameters in the constraint graph,
//! - [`Evaluation`] evaluates a plan on a branch, with exact derivatives,
//! - [`boundary`] measures how far a figure is from where two intersections merge,
//! - [`Plan::change`] replaces instructions that come near such a place (Algorithms 2 to 4).
//!
//! Read as linear algebra, a plan orders points and distances so that the Jacobian is block
//! triangular with one small block per point, but for the removed constraints' rows and the
//! driving parameters' columns: [`Plan::jacobian`].

mod arms;
pub mod boundary;
mod change;
mod derive;
mod describe;
mod differences;
mod evaluation;
mod instruction;
mod jacobian;
mod lanes;
mod shift;
#[cfg(test)]
pub mod testing;
mod vector;

pub use change::Situation;
pub use differences::Differences;
pub use evaluation::Evaluation;
pub use instruction::{Arm, Instruction, Plan};
pub use jacobian::Jacobian;
pub use lanes::Lanes;
