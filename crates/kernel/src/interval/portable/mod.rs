//! Intervals for processors without AVX and FMA instructions, and for those that inari does not know.
//!
//! [`Interval`] is the part of inari's type of the same name that krawl uses, with the same results, made
//! of operations that round to nearest ([`round`]).

mod round;

use round::{add_down, add_up, div_down, div_up, mul_down, mul_up, sqrt_down, sqrt_up};
use std::fmt;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A closed interval of real numbers, possibly unbounded or empty.
#[derive(Clone, Copy)]
pub struct Interval {
    /// +∞ of the empty interval.
    inf: f64,
    /// −∞ of the empty interval.
    sup: f64,
}

impl Interval {
    /// No number.
    pub const EMPTY: Self = Self {
        inf: f64::INFINITY,
        sup: f64::NEG_INFINITY,
    };

    /// All real numbers.
    pub const ENTIRE: Self = Self {
        inf: f64::NEG_INFINITY,
        sup: f64::INFINITY,
    };

    /// The interval from `inf` to `sup`, where that is one: inf ≤ sup, inf < ∞ and sup > −∞.
    pub const fn new(inf: f64, sup: f64) -> Option<Self> {
        if inf <= sup && inf < f64::INFINITY && sup > f64::NEG_INFINITY {
            Some(Self { inf, sup })
        } else {
            None
        }
    }

    /// The largest number that is not above any of the interval; +∞ of the empty one.
    pub fn inf(self) -> f64 {
        if self.inf == 0.0 { -0.0 } else { self.inf }
    }

    /// The smallest number that is not below any of the interval; −∞ of the empty one.
    pub fn sup(self) -> f64 {
        if self.sup == 0.0 { 0.0 } else { self.sup }
    }

    /// The largest magnitude; NaN of the empty interval.
    pub fn mag(self) -> f64 {
        self.unless_empty(self.inf.abs().max(self.sup.abs()))
    }

    /// The smallest magnitude; NaN of the empty interval.
    pub fn mig(self) -> f64 {
        if self.contains(0.0) {
            return 0.0;
        }
        self.unless_empty(self.inf.abs().min(self.sup.abs()))
    }

    /// A float nearest to the middle; NaN of the empty interval.
    pub fn mid(self) -> f64 {
        let Self { inf: a, sup: b } = self;
        let mid = match (a == f64::NEG_INFINITY, b == f64::INFINITY) {
            (false, false) => {
                let mid = 0.5 * (a + b);
                if mid.is_infinite() {
                    0.5 * a + 0.5 * b
                } else if mid == 0.0 {
                    0.0
                } else {
                    mid
                }
            }
            (false, true) => f64::MAX,
            (true, false) => f64::MIN,
            (true, true) => 0.0,
        };
        self.unless_empty(mid)
    }

    /// The smallest float r for which [mid − r, mid + r] holds the interval; NaN of the empty one.
    pub fn rad(self) -> f64 {
        let mid = self.mid();
        self.unless_empty(add_up(mid, -self.inf).max(add_up(self.sup, -mid)))
    }

    /// The width, rounded upwards; NaN of the empty interval.
    pub fn wid(self) -> f64 {
        self.unless_empty(add_up(self.sup, -self.inf))
    }

    fn unless_empty(self, value: f64) -> f64 {
        if self.is_empty() { f64::NAN } else { value }
    }

    /// Whether the interval holds no number.
    pub fn is_empty(self) -> bool {
        self.inf > self.sup
    }

    /// Whether the interval holds all numbers.
    pub fn is_entire(self) -> bool {
        self == Self::ENTIRE
    }

    /// Whether the interval is bounded and not empty.
    pub fn is_common_interval(self) -> bool {
        self.inf.is_finite() && self.sup.is_finite()
    }

    /// Whether the interval holds exactly one number.
    pub fn is_singleton(self) -> bool {
        self.inf == self.sup
    }

    /// Whether the interval holds the finite number `x`.
    pub fn contains(self, x: f64) -> bool {
        x.is_finite() && self.inf <= x && x <= self.sup
    }

    /// Whether all numbers of the interval are in `other`.
    pub fn subset(self, other: Self) -> bool {
        self.is_empty() || (other.inf <= self.inf && self.sup <= other.sup)
    }

    /// Whether all numbers of the interval are inside of `other`, off its ends.
    pub fn interior(self, other: Self) -> bool {
        self.is_empty()
            || ((other.inf < self.inf || other.inf == f64::NEG_INFINITY)
                && (self.sup < other.sup || other.sup == f64::INFINITY)
                && !other.is_empty())
    }

    /// Whether the intervals have no number in common.
    pub fn disjoint(self, other: Self) -> bool {
        self.is_empty() || other.is_empty() || self.sup < other.inf || other.sup < self.inf
    }

    /// The numbers that both hold.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        if self.disjoint(other) {
            return Self::EMPTY;
        }
        Self {
            inf: self.inf.max(other.inf),
            sup: self.sup.min(other.sup),
        }
    }

    /// The smallest interval that holds both.
    #[must_use]
    pub fn convex_hull(self, other: Self) -> Self {
        Self {
            inf: self.inf.min(other.inf),
            sup: self.sup.max(other.sup),
        }
    }

    /// The magnitudes of its numbers.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.is_empty() {
            return self;
        }
        Self {
            inf: self.mig(),
            sup: self.mag(),
        }
    }

    /// The larger ones of all pairs.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        if self.is_empty() || other.is_empty() {
            return Self::EMPTY;
        }
        Self {
            inf: self.inf.max(other.inf),
            sup: self.sup.max(other.sup),
        }
    }

    /// The smaller ones of all pairs.
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        if self.is_empty() || other.is_empty() {
            return Self::EMPTY;
        }
        Self {
            inf: self.inf.min(other.inf),
            sup: self.sup.min(other.sup),
        }
    }

    /// The squares of its numbers.
    #[must_use]
    pub fn sqr(self) -> Self {
        if self.is_empty() {
            return self;
        }
        let (a, b) = (self.mig(), self.mag());
        Self {
            inf: mul_down(a, a),
            sup: mul_up(b, b),
        }
    }

    /// The square roots of its numbers that are not negative.
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.is_empty() || self.sup < 0.0 {
            return Self::EMPTY;
        }
        Self {
            inf: sqrt_down(self.inf.max(0.0)),
            sup: sqrt_up(self.sup.max(0.0)),
        }
    }

    /// The reciprocals of its numbers.
    #[must_use]
    pub fn recip(self) -> Self {
        Self { inf: 1.0, sup: 1.0 } / self
    }
}

impl PartialEq for Interval {
    fn eq(&self, other: &Self) -> bool {
        self.inf == other.inf && self.sup == other.sup
    }
}

impl Eq for Interval {}

impl fmt::Debug for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "Interval {{ inf: {:?}, sup: {:?} }}",
            self.inf(),
            self.sup()
        )
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            inf: -self.sup,
            sup: -self.inf,
        }
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if self.is_empty() || other.is_empty() {
            return Self::EMPTY;
        }
        Self {
            inf: add_down(self.inf, other.inf),
            sup: add_up(self.sup, other.sup),
        }
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if self.is_empty() || other.is_empty() {
            return Self::EMPTY;
        }
        let Self { inf: a, sup: b } = self;
        let Self { inf: c, sup: d } = other;
        // The ends of the factors whose products are the ends of the result, by the factors' signs.
        let (low, high) = if a >= 0.0 {
            (
                (if c >= 0.0 { a } else { b }, c),
                (if d >= 0.0 { b } else { a }, d),
            )
        } else if b <= 0.0 {
            (
                (if d >= 0.0 { a } else { b }, d),
                (if c >= 0.0 { b } else { a }, c),
            )
        } else if c >= 0.0 {
            ((a, d), (b, d))
        } else if d <= 0.0 {
            ((b, c), (a, c))
        } else {
            return Self {
                inf: mul_down(a, d).min(mul_down(b, c)),
                sup: mul_up(a, c).max(mul_up(b, d)),
            };
        };
        Self {
            inf: mul_down(low.0, low.1),
            sup: mul_up(high.0, high.1),
        }
    }
}

impl Div for Interval {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let zero = other.inf == 0.0 && other.sup == 0.0;
        if self.is_empty() || other.is_empty() || zero {
            return Self::EMPTY;
        }
        let Self { inf: a, sup: b } = self;
        if a == 0.0 && b == 0.0 {
            return self;
        }
        if other.inf < 0.0 && other.sup > 0.0 {
            return Self::ENTIRE;
        }
        if other.sup <= 0.0 {
            return -self / -other;
        }
        // The divisor is positive now, possibly down to 0 and up to ∞.
        let Self { inf: c, sup: d } = other;
        let from_zero = c == 0.0;
        Self {
            inf: match (a >= 0.0, from_zero) {
                (true, _) => below(a, d),
                (false, true) => f64::NEG_INFINITY,
                (false, false) => div_down(a, c),
            },
            sup: match (b <= 0.0, from_zero) {
                (true, _) => -below(-b, d),
                (false, true) => f64::INFINITY,
                (false, false) => div_up(b, c),
            },
        }
    }
}

/// A lower bound of a / d for a ≥ 0 and d > 0, both possibly infinite.
fn below(a: f64, d: f64) -> f64 {
    if d.is_infinite() { 0.0 } else { div_down(a, d) }
}

macro_rules! assigned {
    ($($assign:ident $method:ident $operator:tt),*) => {$(
        impl $assign for Interval {
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )*};
}

assigned!(AddAssign add_assign +, SubAssign sub_assign -, MulAssign mul_assign *, DivAssign div_assign /);

#[cfg(all(test, hardware_intervals))]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn both((a, b): (f64, f64)) -> (Interval, inari::Interval) {
        let (a, b) = if a <= b { (a, b) } else { (b, a) };
        (
            Interval::new(a, b).unwrap(),
            inari::interval!(a, b).unwrap(),
        )
    }

    fn same(ours: Interval, theirs: inari::Interval, what: &str) {
        assert_eq!(ours.is_empty(), theirs.is_empty(), "{what}");
        assert_eq!(
            (ours.inf().to_bits(), ours.sup().to_bits()),
            (theirs.inf().to_bits(), theirs.sup().to_bits()),
            "{what}: {ours:?} {theirs:?}"
        );
        if ours.is_empty() {
            return;
        }
        assert_eq!(ours.mid().to_bits(), theirs.mid().to_bits(), "{what}");
        assert_eq!(ours.rad(), theirs.rad(), "{what}");
        assert_eq!(ours.wid(), theirs.wid(), "{what}");
        assert_eq!(ours.mag(), theirs.mag(), "{what}");
        assert_eq!(ours.mig(), theirs.mig(), "{what}");
    }

    // Far from where krawl's is one float further out (`round`).
    fn end() -> impl Strategy<Value = f64> {
        let float = (any::<i64>(), -60i32..40).prop_map(|(digits, e)| digits as f64 * 2f64.powi(e));
        prop_oneof![
            6 => float,
            3 => (-4i32..5).prop_map(f64::from),
            1 => Just(1e60),
            1 => Just(-1e60),
        ]
    }

    proptest! {
        #[test]
        fn agrees_with_inari_bit_for_bit(x in (end(), end()), y in (end(), end())) {
            let ((a, p), (b, q)) = (both(x), both(y));
            same(a, p, "itself");
            same(a + b, p + q, "sum");
            same(a - b, p - q, "difference");
            same(a * b, p * q, "product");
            same(a / b, p / q, "quotient");
            same(-a, -p, "negative");
            same(a.abs(), p.abs(), "abs");
            same(a.sqr(), p.sqr(), "square");
            same(a.sqrt(), p.sqrt(), "root");
            same(a.recip(), p.recip(), "reciprocal");
            same(a.max(b), p.max(q), "max");
            same(a.min(b), p.min(q), "min");
            same(a.convex_hull(b), p.convex_hull(q), "hull");
            same(a.intersection(b), p.intersection(q), "intersection");
            same((a / b) * a + b, (p / q) * p + q, "with unbounded ones");
            prop_assert_eq!(a.subset(b), p.subset(q));
            prop_assert_eq!(a.interior(b), p.interior(q));
            prop_assert_eq!(a.disjoint(b), p.disjoint(q));
            prop_assert_eq!(a.contains(x.0), p.contains(x.0));
            prop_assert_eq!(a.is_common_interval(), p.is_common_interval());
            prop_assert_eq!(a.is_singleton(), p.is_singleton());
            prop_assert_eq!((a / b).is_entire(), (p / q).is_entire());
            prop_assert_eq!(a == b, p == q);
        }
    }
}
