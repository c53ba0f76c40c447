//! Numbers along a curve: what they are, and how fast they change.

use super::Interval;
use std::ops::{Add, Mul, Neg, Sub};

/// An enclosure of a number along a stretch of a curve, and of its derivative by the curve's parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Along {
    /// The number.
    pub value: Interval,
    /// Its derivative.
    pub slope: Interval,
}

impl Along {
    /// What `f` makes of the number, whose derivative there is `slope`.
    fn map(self, value: Interval, slope: Interval) -> Self {
        Along {
            value,
            slope: slope * self.slope,
        }
    }
}

impl Add for Along {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Along {
            value: self.value + other.value,
            slope: self.slope + other.slope,
        }
    }
}

impl Sub for Along {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Along {
    type Output = Self;

    fn neg(self) -> Self {
        Along {
            value: -self.value,
            slope: -self.slope,
        }
    }
}

impl Mul for Along {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Along {
            value: self.value * other.value,
            slope: self.slope * other.value + self.value * other.slope,
        }
    }
}

/// What quantities are made of: enclosures, alone or along a curve.
pub trait Quantifiable:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// A constant.
    fn constant(x: f64) -> Self;

    /// The enclosure of the number.
    fn value(&self) -> Interval;

    /// The enclosure of its slope: 0 of one that is alone.
    fn slope(&self) -> Interval;

    /// The square root.
    fn sqrt(self) -> Self;

    /// What is left of the sign.
    fn abs(self) -> Self;
}

impl Quantifiable for Interval {
    fn constant(x: f64) -> Self {
        super::point(x)
    }

    fn value(&self) -> Interval {
        *self
    }

    fn slope(&self) -> Interval {
        super::point(0.0)
    }

    fn sqrt(self) -> Self {
        Interval::sqrt(self)
    }

    fn abs(self) -> Self {
        Interval::abs(self)
    }
}

impl Quantifiable for Along {
    fn constant(x: f64) -> Self {
        let [value, slope] = [x, 0.0].map(super::point);
        Along { value, slope }
    }

    fn value(&self) -> Interval {
        self.value
    }

    fn slope(&self) -> Interval {
        self.slope
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        // At 0 it has none.
        let slope = match root.inf() > 0.0 {
            true => super::point(0.5) / root,
            false => Interval::ENTIRE,
        };
        self.map(root, slope)
    }

    fn abs(self) -> Self {
        let sign = match (self.value.inf() >= 0.0, self.value.sup() <= 0.0) {
            (true, _) => super::point(1.0),
            (_, true) => super::point(-1.0),
            _ => super::hull(-1.0, 1.0),
        };
        self.map(self.value.abs(), sign)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::{hull, point};
    use proptest::prelude::*;

    proptest! {
        /// The mean value theorem: what an expression changes by between two places is its slope in between times the way.
        #[test]
        fn slopes_hold_what_changes(at in -3.0..3.0f64, way in 0.0..0.5f64, k in -2.0..2.0f64) {
            fn expression<T: Quantifiable>(x: T, k: f64) -> T {
                let k = T::constant(k);
                let square = x * x + T::constant(1.0);
                (square.sqrt() - k * x).abs() * square - -x
            }
            let there = at + way;
            let along = expression(Along { value: hull(at, there), slope: point(1.0) }, k);
            let [here, there] = [at, there].map(|x| expression(point(x), k));
            let change = there - here;
            let bound = along.slope * point(way) + hull(-1e-12, 1e-12);
            prop_assert!(bound.contains(change.mid()), "{bound:?} {change:?}");
            prop_assert!(along.value.contains(here.mid()) && along.value.contains(there.mid()));
        }
    }
}
