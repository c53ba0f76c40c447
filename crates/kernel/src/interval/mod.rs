//! Enclosures: sets of floats that provably hold an exact number.
//!
//! [`Interval`] is inari's where the program is built for a processor that inari knows: x86-64 with AVX and
//! FMA instructions, and AArch64. Elsewhere, and everywhere with the feature `portable`, it is
//! [`portable::Interval`], with the same results from operations that round to nearest.
//!
//! Intervals serve where there are few numbers and their width matters: decimals, polynomial
//! coefficients, solution boxes. The loops over whole matrices use plain floats with a-priori
//! error bounds instead; those are in [`rounding`].

pub mod along;
pub mod angle;
pub mod complex;
mod digits;
mod double_double;
mod enclosure;
mod halves;
#[cfg(any(test, not(hardware_intervals), feature = "portable"))]
mod portable;
mod real;
pub mod rounding;
pub mod vector;

#[doc(hidden)]
pub use digits::{Bound, certain_digits};
pub use double_double::{DoubleDouble, at_least, gamma_double};
pub use enclosure::{enclose, enclose_rational};
#[doc(hidden)]
pub use halves::{halves, is_narrower, upper_half};
#[cfg(all(hardware_intervals, not(feature = "portable")))]
pub use inari::Interval;
#[cfg(any(not(hardware_intervals), feature = "portable"))]
pub use portable::Interval;
pub use real::{Ball, Real, root};

use crate::elimination::Field;
use crate::equations::{Halved, Ring};

impl Ring for Interval {
    fn whole(number: i32) -> Self {
        point(number.into())
    }
}

impl Field for Interval {
    fn size(&self) -> f64 {
        self.mig()
    }
}

impl Halved for Interval {
    fn halves(self, count: i32) -> Self {
        point(0.5 * f64::from(count)) * self
    }
}

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
    checked(lo, hi).expect("an interval's lower bound must not exceed its upper bound")
}

/// The interval of a radius around a float.
#[doc(hidden)]
pub fn around(x: f64, radius: f64) -> Interval {
    hull((x - radius).next_down(), (x + radius).next_up())
}

/// The interval from `lo` to `hi`, which may be infinite, where these are an interval's bounds.
#[cfg(all(hardware_intervals, not(feature = "portable")))]
#[doc(hidden)]
pub fn checked(lo: f64, hi: f64) -> Option<Interval> {
    inari::interval!(lo, hi).ok()
}

/// The interval from `lo` to `hi`, which may be infinite, where these are an interval's bounds.
#[cfg(any(not(hardware_intervals), feature = "portable"))]
#[doc(hidden)]
pub fn checked(lo: f64, hi: f64) -> Option<Interval> {
    Interval::new(lo, hi)
}

/// The interval that holds just 0.
#[cfg(all(hardware_intervals, not(feature = "portable")))]
pub const ZERO: Interval = inari::const_interval!(0.0, 0.0);
/// The interval that holds just 0.
#[cfg(any(not(hardware_intervals), feature = "portable"))]
pub const ZERO: Interval = Interval::new(0.0, 0.0).unwrap();

/// From −1 to 1.
#[cfg(all(hardware_intervals, not(feature = "portable")))]
pub const UNIT: Interval = inari::const_interval!(-1.0, 1.0);
/// From −1 to 1.
#[cfg(any(not(hardware_intervals), feature = "portable"))]
pub const UNIT: Interval = Interval::new(-1.0, 1.0).unwrap();
