//! Enclosures: sets of floats that provably hold an exact number (on inari).
//!
//! Intervals serve where there are few numbers and their width matters: decimals, polynomial
//! coefficients, solution boxes. The loops over whole matrices use plain floats with a-priori
//! error bounds instead; those are in [`rounding`].

mod double_double;
mod enclosure;
mod real;
pub mod rounding;
pub mod vector;

pub use double_double::{DoubleDouble, at_least, gamma_double};
pub use enclosure::{enclose, enclose_rational};
pub use inari::Interval;
pub use real::{Ball, Real, root};

/// The interval that holds just `value`.
///
/// # Panics
/// If `value` is not finite.
pub fn point(value: f64) -> Interval {
    hull(value, value)
}

/// The interval from `lo` to `hi`.
///
/// # Panics
/// If the bounds are not finite or in the wrong order: no proof may go on with an empty or an
/// undefined interval.
pub fn hull(lo: f64, hi: f64) -> Interval {
    assert!(
        lo.is_finite() && hi.is_finite(),
        "an interval's bounds must be finite: [{lo}, {hi}]"
    );
    inari::interval!(lo, hi).expect("an interval's lower bound must not exceed its upper bound")
}
