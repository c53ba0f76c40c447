//! From exact numbers to intervals.

use super::{Interval, hull};
use crate::problem::Decimal;
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// The tightest interval of floats that holds the decimal: one float where the decimal is one,
/// otherwise the two neighbours.
///
/// ```
/// use krawl::interval::enclose;
/// assert_eq!(enclose(&"0.5".parse().unwrap()).wid(), 0.0);
/// let a = enclose(&"0.1".parse().unwrap());
/// assert!(a.inf() < a.sup() && a.sup() == a.inf().next_up());
/// ```
pub fn enclose(decimal: &Decimal) -> Interval {
    enclose_near(decimal.value(), decimal.to_f64())
}

/// The same for a ratio of whole numbers.
///
/// # Panics
/// If the value is beyond the range of floats.
pub fn enclose_rational(value: &BigRational) -> Interval {
    let near = value
        .to_f64()
        .filter(|x| x.is_finite())
        .expect("a ratio within the floats' range");
    enclose_near(value, near)
}

/// Walks from a float near `value` to its neighbours around it; the comparisons are exact.
fn enclose_near(value: &BigRational, near: f64) -> Interval {
    let exact = |x: f64| BigRational::from_float(x).expect("a finite float");
    let (mut lo, mut hi) = (near, near);
    while exact(lo) > *value {
        lo = lo.next_down();
    }
    while exact(hi) < *value {
        hi = hi.next_up();
    }
    // Where `near` was several floats away, close in from the other side.
    while lo < hi && exact(lo.next_up()) <= *value {
        lo = lo.next_up();
    }
    while hi > lo && exact(hi.next_down()) >= *value {
        hi = hi.next_down();
    }
    hull(lo, hi)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn holds_the_decimal_and_is_tight(digits in -999_999_999_999i64..999_999_999_999, shift in -30i32..30) {
            let decimal: Decimal = format!("{digits}e{shift}").parse().unwrap();
            let box_ = enclose(&decimal);
            let exact = |x: f64| BigRational::from_float(x).unwrap();
            prop_assert!(exact(box_.inf()) <= *decimal.value() && *decimal.value() <= exact(box_.sup()));
            prop_assert!(box_.sup() <= box_.inf().next_up());
            prop_assert_eq!(enclose_rational(decimal.value()), box_);
        }
    }
}
