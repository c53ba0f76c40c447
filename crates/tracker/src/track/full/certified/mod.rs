//! The Krawczyk test in all free coordinates: `tube` has the theorem, `bounds` what it
//! bounds equation by equation, `norms` (with `low_orders`) the
//! longest tube that its bounds prove, `exit` where the path leaves a tube, `extended` the test where 53 bits
//! fail, `precision` in which of the two a run is.

mod bounds;
mod exit;
mod extended;
mod low_orders;
pub(in crate::track) mod norms;
mod precision;
mod tube;

pub use tube::KrawczykTest;
