//! From exact numbers to intervals.

use super::{Interval, hull};
use crate::decimal::Decimal;
use crate::rational::Rational;
use num_bigint::BigInt;
use num_traits::Float;
use std::cmp::Ordering;

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

/// The tightest interval of floats that holds a ratio of whole numbers: one float where the ratio is one,
/// otherwise the two neighbours.
///
/// # Panics
/// If the value is beyond the range of floats.
pub fn enclose_rational(value: &Rational) -> Interval {
    let near = value.to_f64();
    assert!(near.is_finite(), "a ratio beyond the floats' range");
    enclose_near(value, near)
}

/// Walks from a float near `value` to its neighbours around it; the comparisons are exact.
fn enclose_near(value: &Rational, near: f64) -> Interval {
    let (mut lo, mut hi) = (near, near);
    while compare(lo, value).is_gt() {
        lo = lo.next_down();
    }
    while compare(hi, value).is_lt() {
        hi = hi.next_up();
    }
    // Where `near` was several floats away, close in from the other side.
    while lo < hi && compare(lo.next_up(), value).is_le() {
        lo = lo.next_up();
    }
    while hi > lo && compare(hi.next_down(), value).is_ge() {
        hi = hi.next_down();
    }
    hull(lo, hi)
}

/// A float beside a ratio of whole numbers, exactly: m 2ᵉ d beside n for the ratio n/d, whose denominator is positive.
fn compare(x: f64, value: &Rational) -> Ordering {
    assert!(x.is_finite(), "a finite float");
    let (mantissa, exponent, sign) = Float::integer_decode(x);
    let left = BigInt::from(i128::from(mantissa) * i128::from(sign)) * value.denom();
    let shift = usize::from(exponent.unsigned_abs());
    match exponent >= 0 {
        true => (left << shift).cmp(value.numer()),
        false => left.cmp(&(value.numer() << shift)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn comparisons_are_those_of_ratios(bits: u64, other: u64, near: bool) {
            let (x, y) = (f64::from_bits(bits), f64::from_bits(other));
            let y = if near { x.next_up() } else { y };
            prop_assume!(x.is_finite() && y.is_finite());
            let [a, b] = [x, y].map(|x| Rational::from_float(x).unwrap());
            let third = |above: i32| Rational::new(above.into(), 3.into());
            for ratio in [&a, &b, &(&a * third(-1)), &(&b * third(7))] {
                prop_assert_eq!(compare(x, ratio), a.cmp(ratio));
            }
        }

        #[test]
        fn holds_the_decimal_and_is_tight(digits in -999_999_999_999i64..999_999_999_999, shift in -30i32..30) {
            let decimal: Decimal = format!("{digits}e{shift}").parse().unwrap();
            let box_ = enclose(&decimal);
            let exact = |x: f64| Rational::from_float(x).unwrap();
            prop_assert!(exact(box_.inf()) <= *decimal.value() && *decimal.value() <= exact(box_.sup()));
            prop_assert!(box_.sup() <= box_.inf().next_up());
            prop_assert_eq!(enclose_rational(decimal.value()), box_);
        }
    }
}
