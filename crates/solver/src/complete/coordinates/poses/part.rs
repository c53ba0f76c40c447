//! Boxes of rotations.
//!
//! A rotation is told by a quaternion q ≠ 0, up to a factor. Divided by one of its greatest components it has a 1 there and
//! numbers from −1 to 1 elsewhere: four charts, each a cube, hold all rotations.

use crate::complete::contract::contract;
use crate::complete::model::{Model, Range};
use crate::interval::rounding::{UNDERFLOW, UNIT_ROUNDOFF};

/// A box of rotations, and perhaps of one coordinate of the body's place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// The component of the quaternion that is 1.
    pub chart: usize,
    /// The middle of the other components, in order, and of the coordinate.
    pub middle: [f64; 4],
    /// How far each may be from it.
    pub radius: [f64; 4],
    /// The axis of the coordinate of the body's place that is searched, where linear equations do not tell it.
    pub height: Option<usize>,
    /// The part's share of all rotations, about.
    pub share: f64,
}

/// Where linear equations do not tell the place in a part as small as this, a coordinate is searched.
const FINE: f64 = 1.0 / 40.0;

impl Part {
    /// All rotations.
    pub fn all() -> Vec<Part> {
        let chart = |chart| Part {
            chart,
            middle: [0.0; 4],
            radius: [1.0, 1.0, 1.0, 0.0],
            height: None,
            share: 0.25,
        };
        (0..4).map(chart).collect()
    }

    /// Whether it is as small as parts get before a coordinate of the place is searched.
    pub fn is_small(&self) -> bool {
        self.height.is_none() && self.widest() <= FINE
    }

    /// How far a component of the quaternion is from its middle at most.
    pub fn widest(&self) -> f64 {
        self.radius[..3].iter().fold(0.0, |max, &r| r.max(max))
    }

    /// The part with the coordinate of the place along an axis, which is at most `reach` in size.
    pub fn with_height(mut self, axis: usize, reach: f64) -> Part {
        self.middle[3] = 0.0;
        self.radius[3] = reach;
        self.height = Some(axis);
        self
    }

    /// A component of the quaternion, or the coordinate (3), by its symbol.
    pub fn symbol<const S: usize, const M: usize>(&self, i: usize) -> Model<S, M> {
        Model::symbol(i, self.middle[i], self.radius[i])
    }

    /// Narrows the part to where the equations can hold; and what is left of its volume. `None`: nothing.
    pub fn contract<const S: usize, const M: usize>(
        &mut self,
        equations: &[Model<S, M>],
    ) -> Option<f64> {
        let mut u = [Range { lo: -1.0, hi: 1.0 }; S];
        contract(equations, &mut Vec::new(), &mut u).ok()?;
        let mut volume = 1.0;
        for (i, u) in u.iter().enumerate() {
            let (lo, hi) = (u.lo.max(-1.0), u.hi.min(1.0));
            if !(lo > -1.0 || hi < 1.0) {
                continue;
            }
            volume *= 0.5 * (hi - lo);
            let (middle, radius) = (self.middle[i], self.radius[i]);
            let (low, high) = (middle + radius * lo, middle + radius * hi);
            let new = 0.5 * low + 0.5 * high;
            // Two roundings in each end, one in each difference; none is of more than |middle| + radius.
            let off = (high - new).max(new - low);
            let rounded = 8.0 * UNIT_ROUNDOFF * (middle.abs() + radius) + UNDERFLOW;
            self.radius[i] = off + rounded;
            self.middle[i] = new;
        }
        Some(volume)
    }

    /// Two parts that share their border and together are the part, halved in what moves most. `None`: it is too small.
    pub fn halves<const S: usize>(&self, moves: &[f64; S]) -> Option<[Part; 2]> {
        let widest = self.radius[..S].iter().fold(0.0, |max: f64, &r| max.max(r));
        let mut best: Option<usize> = None;
        for i in 0..S {
            // What is narrow already is not what keeps the part from being decided.
            if self.radius[i] > 1e-3 * widest && best.is_none_or(|b| moves[i] > moves[b]) {
                best = Some(i);
            }
        }
        let i = best?;
        let half = 0.5 * self.radius[i];
        if !(half > 8.0 * UNIT_ROUNDOFF * self.middle[i].abs() && half > 1e-200) {
            return None;
        }
        let make = |side: f64| {
            let mut part = *self;
            let middle = self.middle[i] + side * half;
            // The middle is rounded once: the half is as much wider, and what is rounded here.
            let rounded = 4.0 * UNIT_ROUNDOFF * middle.abs() + UNDERFLOW;
            part.middle[i] = middle;
            part.radius[i] = half * (1.0 + 8.0 * UNIT_ROUNDOFF) + rounded;
            part.share *= 0.5;
            part
        };
        Some([make(-1.0), make(1.0)])
    }
}
