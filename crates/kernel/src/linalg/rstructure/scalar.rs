//! What R-structured matrices are made of.

/// A number that elimination works with.
///
/// Elimination needs no more than this, so that one code serves the trackers' floats and, in `crates/lab`,
/// intervals and residues (002, the remark at the end of section 4).
pub trait Scalar: Copy + PartialEq + std::fmt::Debug + 'static {
    /// 0.
    fn zero() -> Self;

    /// 1.
    fn one() -> Self;

    /// `−self`.
    fn negated(self) -> Self;

    /// Whether this is known to be below 0; residues have no sign.
    fn is_negative(self) -> bool;

    /// `self + b`.
    fn plus(self, b: Self) -> Self;

    /// `self + a b`.
    fn plus_product(self, a: Self, b: Self) -> Self;

    /// `self b`.
    fn times(self, b: Self) -> Self;

    /// `1 / self`, for a number with [`pivot_size`](Scalar::pivot_size) > 0.
    fn inverse(self) -> Self;

    /// How welcome this number is as a pivot; not greater than zero where it cannot be one.
    fn pivot_size(self) -> f64;
}

impl Scalar for f64 {
    fn zero() -> Self {
        0.0
    }

    fn one() -> Self {
        1.0
    }

    #[inline(always)]
    fn negated(self) -> Self {
        -self
    }

    fn is_negative(self) -> bool {
        self < 0.0
    }

    #[inline(always)]
    fn plus(self, b: Self) -> Self {
        self + b
    }

    #[inline(always)]
    fn plus_product(self, a: Self, b: Self) -> Self {
        a.mul_add(b, self)
    }

    #[inline(always)]
    fn times(self, b: Self) -> Self {
        self * b
    }

    fn inverse(self) -> Self {
        1.0 / self
    }

    /// The absolute value; a subnormal number, whose reciprocal may overflow, is no pivot.
    #[inline(always)]
    fn pivot_size(self) -> f64 {
        let size = self.abs();
        if (f64::MIN_POSITIVE..=f64::MAX).contains(&size) {
            size
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_that_cannot_be_pivots() {
        for x in [0.0, -0.0, f64::NAN, f64::INFINITY, 1e-310] {
            assert_eq!(x.pivot_size(), 0.0);
        }
        assert_eq!((-2.0).pivot_size(), 2.0);
    }
}
