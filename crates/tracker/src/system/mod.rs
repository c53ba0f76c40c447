//! The equations: H(X, t) = F(X, a(t)), their interpolation in t and their derivatives.
//!
//! Distances are taken squared, `F_e = ½(|p_i − p_j|² − a_e(t)²)`: the same zeros while a_e > 0,
//! no square roots, and second derivatives in X that do not depend on X. All other constraints are
//! quadratic equations too ([`crate::constraint`]).

mod edit;
mod exact;
mod follows;
mod gauge;
mod heights;
mod homotopy;
mod interpolation;
mod located;
mod part;
mod quantity;
mod reversed;
pub use reversed::Held;
mod right;
mod segment;
mod simplices;
pub mod told;

pub use edit::is_met;
pub use exact::ExactLength;
pub use gauge::{Gauge, GaugeError, Placement};
pub use heights::Heights;
#[doc(hidden)]
pub use homotopy::typical_length;
pub use homotopy::{Edge, Homotopy, Term};
pub use interpolation::Length;
pub use located::{Located, Numbers, locate};
pub use part::{Beside, Part};
pub use quantity::{Quantity, Seen, WHOLE_TURN};
pub use right::Right;
pub use segment::{Extent, Segment};
pub use simplices::{determinant, orientation, sign_of, simplices};
