//! Sketches fall apart: the equations of a problem, merged, chosen, and cut into blocks.
//!
//! Most constraints of real sketches say that two coordinates are one: coincident, horizontal, vertical. [`System`]
//! takes those away first, so that they are no equations at all. What remains need not have as many equations as
//! unknowns: [`Choice`] finds equations that follow from others at the figure, and coordinates that nothing
//! determines, which then stay put. The square system that is left is cut into [`Block`]s (the fine part of the
//! decomposition of Dulmage and Mendelsohn: a perfect matching of equations with unknowns, and the strongly connected
//! components of what depends on what), each of which needs only blocks before it.
//!
//! # What a proof of some blocks says
//!
//! Let U be a union of blocks with all blocks that they need. Its equations have no other unknowns, and the Jacobian
//! of all is block triangular. If for every t from 0 to 1 the equations of U have exactly one zero in a tube around a
//! curve, with a regular Jacobian, and so have those of U', each beginning at the same figure, then on the unknowns that
//! both have the curves are the same (both continue the same regular zero), and together they are one curve of the
//! union, regular too. So the parts of a sketch can be followed each for itself, along the same t, and what is
//! proved of all together is what would be proved of the whole: there is exactly one continuation.

mod account;
mod choose;
mod clusters;
mod combine;
mod cure;
mod cut;
mod drawn;
mod figures;
mod follows;
mod formula;
mod freedom;
mod local;
mod merge;
mod near;
mod number;
mod path;
mod pinned;
mod row;
mod singular;
mod surplus;
mod tried;
mod whose;

pub use crate::linalg::{Block, Blocks};
pub use account::{Account, Held, LEAST_PART, LeftOut, Verdict, Why, rounded_down, rounded_up};
pub(crate) use account::{Ruler, list_of};
pub use choose::Choice;
pub(crate) use choose::{COARSE, FINE, FREE_FIRST, LAST};
pub use clusters::{MOST_POINTS, clusters};
pub(crate) use combine::seen;
pub use combine::{Choice as CombinedChoice, Combined};
pub(crate) use cut::{Cut, Used, blocks_of, in_words, is_exact, square, straight};
pub(crate) use drawn::Floats;
pub use drawn::Seen;
pub use figures::{BlockAccount, Chosen, Comparison, Figures, First, Sense, Way, WithSenses};
pub use follows::{Combination, Given, combination};
pub use freedom::Freedom;
pub use merge::{Row, System};
pub use pinned::pinned;
pub use singular::Singular;
pub use surplus::{Census, Finding, Surplus, surplus};
pub(crate) use whose::Whose;
