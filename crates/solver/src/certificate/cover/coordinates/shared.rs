//! Products of two differences with an entry in common: (x − a)(x − b) = (x − m)² − h² with m = (a + b)/2 and h = (a − b)/2.

use super::space::{Empty, Part, difference, roots};
use crate::interval::{Interval, point};

/// ±(x − a)(x − b).
pub struct Shared {
    x: usize,
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

    /// m and h².
    fn middle(&self, x: &[Interval]) -> [Interval; 2] {
        let [a, b] = self.rest;
        let half = point(0.5);
        [half * (x[a] + x[b]), (half * difference(x, [a, b])).sqr()]
    }

    /// The product.
    pub fn product(&self, x: &[Interval]) -> Interval {
        let [middle, less] = self.middle(x);
        self.signed((x[self.x] - middle).sqr() - less)
    }

    /// Narrows by the product in a range.
    pub fn narrow(&self, product: Interval, part: &mut Part) -> Result<(), Empty> {
        let [middle, less] = self.middle(part.entries());
        let square = self.signed(product) + less;
        let within = roots(square, part.entries()[self.x] - middle)?;
        match self.x < part.ranges().len() {
            true => part.narrow(self.x, middle + within),
            false => Ok(()),
        }
    }
}
