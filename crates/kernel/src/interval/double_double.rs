//! Numbers of twice a float's precision, for the few places where 53 bits do not suffice.
//!
//! The three operations that the residual needs, as in Joldes, Muller, Popescu, *Tight and
//! rigorous error bounds for basic building blocks of double-word arithmetic*, ACM Trans. Math.
//! Softw. 44 (2017), and no more, so that the bounds proved there can be read beside them.

use super::rounding::{UNDERFLOW, UNIT_ROUNDOFF};
use crate::rational::{Rational, exact};
use std::ops::{Add, Mul, Neg, Sub};

/// The unevaluated sum of two floats, `hi` being the float nearest to it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DoubleDouble {
    /// The sum, rounded.
    pub hi: f64,
    /// What that leaves.
    pub lo: f64,
}

/// a + b exactly, whatever their sizes (Knuth; algorithm 2 there).
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    let b_part = hi - a;
    let lo = (a - (hi - b_part)) + (b - b_part);
    DoubleDouble { hi, lo }
}

/// a + b exactly where |a| ≥ |b| or a = 0 (Dekker; algorithm 1 there).
fn fast_two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    DoubleDouble {
        hi,
        lo: b - (hi - a),
    }
}

/// a b exactly, but for underflow (algorithm 3 there).
fn two_prod(a: f64, b: f64) -> DoubleDouble {
    let hi = a * b;
    DoubleDouble {
        hi,
        lo: a.mul_add(b, -hi),
    }
}

impl DoubleDouble {
    /// The sum of two floats, exactly.
    pub fn sum(a: f64, b: f64) -> Self {
        two_sum(a, b)
    }

    /// The number nearest to a ratio, or next to it, and a bound on what is left.
    pub fn near(value: &Rational) -> (Self, f64) {
        let hi = value.to_f64();
        let out = two_sum(hi, (value - exact(hi)).to_f64());
        (
            out,
            at_least(&(value - exact(out.hi) - exact(out.lo)).abs()),
        )
    }

    /// |x| as a float, up to one rounding.
    pub fn size(self) -> f64 {
        (self.hi + self.lo).abs()
    }

    /// Half of it, exactly but for underflow.
    pub fn half(self) -> Self {
        DoubleDouble {
            hi: 0.5 * self.hi,
            lo: 0.5 * self.lo,
        }
    }
}

/// A float that is not below a non-negative ratio.
pub fn at_least(value: &Rational) -> f64 {
    // The nearest float or a neighbour of it.
    value.to_f64() * (1.0 + 1e-10) + UNDERFLOW
}

impl From<f64> for DoubleDouble {
    fn from(hi: f64) -> Self {
        DoubleDouble { hi, lo: 0.0 }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        DoubleDouble {
            hi: -self.hi,
            lo: -self.lo,
        }
    }
}

/// AccurateDWPlusDW, algorithm 6: relative error at most 3u² + 13u³ (theorem 3.1).
impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let high = two_sum(self.hi, other.hi);
        let low = two_sum(self.lo, other.lo);
        let v = fast_two_sum(high.hi, high.lo + low.hi);
        fast_two_sum(v.hi, low.lo + v.lo)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

/// DWTimesDW3, algorithm 12: relative error at most 5u² (theorem 5.3).
impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let high = two_prod(self.hi, other.hi);
        let low = self.lo * other.lo;
        let middle = self.hi.mul_add(other.lo, low);
        let middle = self.lo.mul_add(other.hi, middle);
        fast_two_sum(high.hi, high.lo + middle)
    }
}

/// γ_n for operations with double-doubles, whose relative errors are all below 8u²: a value that
/// is the result of sums and products, no term passing through more than n of them, differs from
/// the exact one by at most that times the sum of the terms' sizes (Higham, section 3.1, with 8u²
/// for u), and by less than [`UNDERFLOW`].
pub fn gamma_double(n: usize) -> f64 {
    debug_assert!(n <= 1 << 30);
    n as f64 * (8.0 * UNIT_ROUNDOFF * UNIT_ROUNDOFF) * 1.0001
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn exact(x: DoubleDouble) -> Rational {
        let exact = |x: f64| Rational::from_float(x).unwrap();
        exact(x.hi) + exact(x.lo)
    }

    /// Double-doubles with sizes from 1e-8 to 1e8, low words from all to none of them.
    fn number() -> impl Strategy<Value = DoubleDouble> {
        (-1.0f64..1.0, -8i32..9, -1.0f64..1.0, 0i32..40).prop_map(|(x, size, y, shift)| {
            let hi = x * 10f64.powi(size);
            DoubleDouble::sum(hi, y * hi * UNIT_ROUNDOFF * 0.5f64.powi(shift))
        })
    }

    /// Pairs that cancel to various depths.
    fn pair() -> impl Strategy<Value = (DoubleDouble, DoubleDouble)> {
        let near = (number(), number(), 0i32..110).prop_map(|(x, y, shift)| {
            let off = y.hi * 0.5f64.powi(shift);
            (x, -(x + DoubleDouble::from(off)))
        });
        prop_oneof![(number(), number()), near]
    }

    fn within(value: DoubleDouble, exactly: &Rational, factor: f64) -> bool {
        let bound = Rational::from_float(factor * UNIT_ROUNDOFF * UNIT_ROUNDOFF).unwrap();
        value.hi == value.hi + value.lo && (exact(value) - exactly).abs() <= bound * exactly.abs()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn operations_are_as_accurate_as_the_theorems_say((x, y) in pair()) {
            let (a, b) = (exact(x), exact(y));
            prop_assert!(within(x + y, &(&a + &b), 3.01));
            prop_assert!(within(x - y, &(&a - &b), 3.01));
            prop_assert!(within(x * y, &(&a * &b), 5.0));
        }

        #[test]
        fn ratios_are_near(digits in -999_999_999_999i64..999_999_999_999, below in 1i64..999_999) {
            let value = Rational::new(digits.into(), below.into());
            let (near, left) = DoubleDouble::near(&value);
            let off = (exact(near) - &value).abs();
            prop_assert!(off <= Rational::from_float(left).unwrap());
            prop_assert!(value.is_zero() || left <= 1e-31 * near.size() + UNDERFLOW);
        }
    }
}
