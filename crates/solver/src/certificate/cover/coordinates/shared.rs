//! Products of two differences with an entry in common: (x − a)(x − b) = (x − m)² − h² with m = (a + b)/2 and h = (a − b)/2.

use super::space::{Empty, Part, difference, roots};
use crate::interval::{Interval, point};

/// ±(x − a)(x − b).
///
/// A right angle at a point that is sought has such products. However wide the range of x is, the square is not negative, which the product
/// of two ranges does not know.
pub struct Shared {
    /// x.
    pub x: usize,
    rest: [usize; 2],
    is_opposite: bool,
}

impl Shared {
    /// Of i − j and k − l.
    pub fn of([i, j]: [usize; 2], [k, l]: [usize; 2]) -> Option<Shared> {
        let (x, rest, is_opposite) = match () {
            () if i == k => (i, [j, l], false),
            () if j == l => (j, [i, k], false),
            () if i == l => (i, [j, k], true),
            () if j == k => (j, [i, l], true),
            () => return None,
        };
        Some(Shared {
            x,
            rest,
            is_opposite,
        })
    }

    fn signed(&self, x: Interval) -> Interval {
        if self.is_opposite { -x } else { x }
    }

    /// m.
    pub fn middle(&self, x: &[Interval]) -> Interval {
        let [a, b] = self.rest;
        point(0.5) * (x[a] + x[b])
    }

    /// h².
    fn less(&self, x: &[Interval]) -> Interval {
        (point(0.5) * difference(x, self.rest)).sqr()
    }

    /// The product.
    pub fn product(&self, x: &[Interval]) -> Interval {
        self.signed((x[self.x] - self.middle(x)).sqr() - self.less(x))
    }

    /// (x − m)², if the product is in a range.
    pub fn square(&self, product: Interval, x: &[Interval]) -> Interval {
        self.signed(product) + self.less(x)
    }

    /// Narrows by the product in a range.
    pub fn narrow(&self, product: Interval, part: &mut Part) -> Result<(), Empty> {
        let x = part.entries();
        let (square, middle) = (self.square(product, x), self.middle(x));
        let within = roots(square, x[self.x] - middle)?;
        match self.x < part.ranges().len() {
            true => part.narrow(self.x, middle + within),
            false => Ok(()),
        }
    }
}
