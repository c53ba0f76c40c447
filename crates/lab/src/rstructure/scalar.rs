//! What the matrices are made of beside floats: intervals, residues modulo a prime power.

use krawl::interval::{Interval, point};
use krawl::linalg::rstructure::Scalar;

/// Products that are taken away.
pub(super) trait Subtract: Scalar {
    /// `self − a b`.
    #[inline(always)]
    fn minus_product(self, a: Self, b: Self) -> Self {
        self.plus_product(a.negated(), b)
    }
}

impl<T: Scalar> Subtract for T {}

/// An interval, of which every operation encloses the exact results for all members of its operands.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Enclosing(pub Interval);

impl Scalar for Enclosing {
    fn zero() -> Self {
        Enclosing(point(0.0))
    }

    fn one() -> Self {
        Enclosing(point(1.0))
    }

    #[inline]
    fn negated(self) -> Self {
        Enclosing(-self.0)
    }

    fn is_negative(self) -> bool {
        self.0.sup() < 0.0
    }

    #[inline]
    fn plus(self, b: Self) -> Self {
        Enclosing(self.0 + b.0)
    }

    #[inline]
    fn plus_product(self, a: Self, b: Self) -> Self {
        Enclosing(self.0 + a.0 * b.0)
    }

    #[inline]
    fn times(self, b: Self) -> Self {
        Enclosing(self.0 * b.0)
    }

    fn inverse(self) -> Self {
        Enclosing(point(1.0) / self.0)
    }

    /// The smallest absolute value of a member.
    fn pivot_size(self) -> f64 {
        if self.0.is_common_interval() {
            self.0.mig()
        } else {
            0.0
        }
    }
}

/// An integer modulo `M`, a power of a prime below 2⁶³ (002, section 6).
///
/// Modulo a power of p the units are the numbers that p does not divide, and elimination with
/// units for pivots succeeds wherever the matrix can be inverted. For other moduli, what is
/// computed is right, but a matrix may be called singular that is not.
///
/// ```
/// use krawl_lab::rstructure::{Residue, Scalar};
/// type Z = Residue<{ 7u64.pow(3) }>;
/// assert_eq!(Z::new(-1).value(), 342);
/// assert_eq!(Z::new(5).times(Z::new(5).inverse()), Z::new(1));
/// assert_eq!(Z::new(14).pivot_size(), 0.0);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Residue<const M: u64>(u64);

impl<const M: u64> Residue<M> {
    const MODULUS_IN_RANGE: () = assert!(M > 1 && M < 1 << 63);

    /// The residue of an integer.
    pub fn new(value: i64) -> Self {
        let () = Self::MODULUS_IN_RANGE;
        Residue(i128::from(value).rem_euclid(i128::from(M)) as u64)
    }

    /// The representative from 0 to M − 1.
    pub fn value(self) -> u64 {
        self.0
    }

    /// The inverse, if there is one (Euclid's algorithm).
    fn checked_inverse(self) -> Option<Self> {
        let (mut r, mut next) = (i128::from(M), i128::from(self.0));
        let (mut s, mut s_next) = (0i128, 1i128);
        while next != 0 {
            let q = r / next;
            (r, next) = (next, r - q * next);
            (s, s_next) = (s_next, s - q * s_next);
        }
        (r == 1).then(|| Residue(s.rem_euclid(i128::from(M)) as u64))
    }
}

impl<const M: u64> Scalar for Residue<M> {
    fn zero() -> Self {
        Residue(0)
    }

    fn one() -> Self {
        Residue(1)
    }

    #[inline]
    fn negated(self) -> Self {
        Residue(if self.0 == 0 { 0 } else { M - self.0 })
    }

    fn is_negative(self) -> bool {
        false
    }

    #[inline]
    fn plus_product(self, a: Self, b: Self) -> Self {
        self.plus(a.times(b))
    }

    #[inline]
    fn plus(self, b: Self) -> Self {
        let sum = self.0 + b.0;
        Residue(if sum >= M { sum - M } else { sum })
    }

    #[inline]
    fn times(self, b: Self) -> Self {
        Residue((u128::from(self.0) * u128::from(b.0) % u128::from(M)) as u64)
    }

    fn inverse(self) -> Self {
        self.checked_inverse().expect("a pivot is a unit")
    }

    /// 1 for units, 0 for the others.
    fn pivot_size(self) -> f64 {
        if self.0 != 0 && self.checked_inverse().is_some() {
            1.0
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use krawl::interval::hull;

    #[test]
    fn residues_form_a_ring_with_inverses_of_units() {
        const M: u64 = 4_611_686_018_427_387_847; // the largest prime below 2⁶²
        type Z = Residue<M>;
        for x in [1i64, 2, 3, -1, i64::MAX, i64::MIN, 123_456_789_012] {
            let z = Z::new(x);
            assert_eq!(z.times(z.inverse()), Z::new(1));
            assert_eq!(z.minus_product(z, Z::new(1)), Z::zero());
            assert_eq!(
                Z::zero().minus_product(z, z).value(),
                (M - (i128::from(x).rem_euclid(i128::from(M)).pow(2) % i128::from(M)) as u64) % M
            );
        }
        assert_eq!(Residue::<9>::new(6).pivot_size(), 0.0);
        assert_eq!(Residue::<9>::new(4).inverse(), Residue::new(7));
    }

    #[test]
    fn intervals_that_cannot_be_pivots() {
        assert_eq!(Enclosing(hull(-1.0, 2.0)).pivot_size(), 0.0);
        assert_eq!(Enclosing(hull(1.0, 2.0)).pivot_size(), 1.0);
        assert_eq!(Enclosing(Interval::ENTIRE).pivot_size(), 0.0);
        assert_eq!(Enclosing(Interval::EMPTY).pivot_size(), 0.0);
    }
}
