//! Numbers along a curve: what they are, and how fast they change.

use super::Interval;
use super::vector::dot;
use crate::equations::Ring;
use crate::places::{Each as _, array};
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

impl Ring for Along {
    fn whole(number: i32) -> Self {
        Along::constant(number.into())
    }
}

/// What quantities are made of: enclosures, alone or along a curve.
pub trait Quantifiable:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// A constant that is somewhere in here.
    fn fixed(x: Interval) -> Self;

    /// A constant.
    fn constant(x: f64) -> Self {
        Self::fixed(super::point(x))
    }

    /// The enclosure of the number.
    fn value(&self) -> Interval;

    /// The enclosure of its slope: 0 of one that is alone.
    fn slope(&self) -> Interval;

    /// The square root.
    fn sqrt(self) -> Self;

    /// What is left of the sign.
    fn abs(self) -> Self;

    /// The length of a vector.
    fn length(v: [Self; 3]) -> Self;
}

impl Quantifiable for Interval {
    fn fixed(x: Interval) -> Self {
        x
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

    fn length(v: [Self; 3]) -> Self {
        dot(v, v).sqrt()
    }
}

impl Quantifiable for Along {
    fn fixed(value: Interval) -> Self {
        let slope = super::point(0.0);
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

    fn length(v: [Self; 3]) -> Self {
        let values = v.each(|x| x.value);
        let cosines = array(|axis| cosine(values, axis));
        Along {
            value: dot(values, values).sqrt(),
            slope: dot(cosines, v.each(|x| x.slope)),
        }
    }
}

/// v_k / |v|, as sharp as can be: it grows with v_k, and with the others towards 0 in size.
fn cosine(v: [Interval; 3], axis: usize) -> Interval {
    let others = v.each(|x| x.sqr());
    let rest = others[(axis + 1) % 3] + others[(axis + 2) % 3];
    let at = |x: f64, rest: f64| {
        let (x, rest) = (super::point(x), super::point(rest));
        let size = (x.sqr() + rest).sqrt();
        match size.inf() > 0.0 {
            true => (x / size).intersection(super::hull(-1.0, 1.0)),
            false => super::hull(-1.0, 1.0),
        }
    };
    let (near, far) = (rest.inf().max(0.0), rest.sup());
    let x = v[axis];
    let low = at(x.inf(), if x.inf() < 0.0 { near } else { far });
    let high = at(x.sup(), if x.sup() < 0.0 { far } else { near });
    low.convex_hull(high)
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

        /// A length changes by its slope times the way, and the slope of a vector that only grows is 1.
        #[test]
        fn lengths_have_sharp_slopes(v in [-3.0..3.0f64, -3.0..3.0, -3.0..3.0], w in [-1.0..1.0f64, -1.0..1.0, -1.0..1.0], way in 0.0..0.5f64) {
            let along = array(|k| Along {
                value: hull(v[k].min(v[k] + way * w[k]), v[k].max(v[k] + way * w[k])),
                slope: point(w[k]),
            });
            let there = array(|k| point(v[k] + way * w[k]));
            let change = Interval::length(there) - Interval::length(v.map(point));
            let bound = Along::length(along).slope * point(way) + hull(-1e-12, 1e-12);
            prop_assert!(bound.contains(change.mid()), "{bound:?} {change:?}");
            let straight = [Along { value: hull(1.0, 7.0), slope: point(1.0) }, Along::constant(0.0), Along::constant(0.0)];
            prop_assert!(Along::length(straight).slope.wid() < 1e-15);
        }
    }
}
