//! A homotopy whose lengths stand still at their targets but for those that are edited.

use super::{ExactLength, Homotopy, Length, Right};
use crate::interval::{Interval, enclose, point};
use crate::problem::Target;
use num_rational::BigRational;

impl Homotopy {
    /// Makes distance `index` stay at `target` for all t.
    pub fn hold(&mut self, index: usize, target: &Target) {
        let (length, half_square) = self.enclose_target(target);
        let exact = self.exact(target, target);
        self.lengths[index] = Length::constant(length);
        self.rights[index] = Right::constant_half_square(half_square, exact);
    }

    /// Leads distance `index` from one length at t = 0 to another at t = 1, in proportion to t.
    pub fn lead(&mut self, index: usize, from: &Target, to: &Target) {
        let [from_length, to_length] = [from, to].map(|target| self.enclose_target(target).0);
        let length = Length::new(from_length, to_length, None);
        self.rights[index] = Right::half_square(&length, self.exact(from, to));
        self.lengths[index] = length;
    }

    /// A target's length and half of its square, in the homotopy's unit.
    fn enclose_target(&self, target: &Target) -> (Interval, Interval) {
        let per_unit = point(1.0 / self.unit);
        let half = point(0.5);
        match target {
            Target::Length(length) => {
                let length = enclose(length) * per_unit;
                (length, length.sqr() * half)
            }
            Target::SquaredLength(squared) => {
                let squared = enclose(squared);
                let half_square = squared * per_unit * per_unit * half;
                (squared.sqrt() * per_unit, half_square)
            }
        }
    }

    fn exact(&self, from: &Target, to: &Target) -> ExactLength {
        ExactLength {
            sketch_squared: squared(from),
            target: to.clone(),
            bend: None,
            unit: self.unit,
        }
    }
}

fn squared(target: &Target) -> BigRational {
    match target {
        Target::Length(length) => length.value().pow(2),
        Target::SquaredLength(squared) => squared.value().clone(),
    }
}
