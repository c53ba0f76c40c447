//! A homotopy in which everything stands still at its target but for the dimensions that are edited.

use super::{ExactLength, Homotopy, Length, Right};
use crate::constraint::{self, Record, Tail};
use crate::interval::{Interval, point};
use crate::places::Each as _;
use crate::problem::{Problem, Target};

impl Homotopy {
    /// Makes distance `index` stay at `target` for all t.
    pub fn hold(&mut self, index: usize, target: &Target) {
        let length = Length::constant(self.enclose_target(target));
        self.set_length(index, length, target, target);
    }

    /// Gives the equations that are not distances the right-hand sides of another lowering of the same problem. False, and
    /// nothing is changed: that one has other left-hand sides.
    #[doc(hidden)]
    pub fn set_constraints(&mut self, other: &Tail) -> bool {
        let (now, then) = (&self.tail.equations, &other.equations);
        let mut pairs = now.iter().zip(then);
        if now.len() != then.len() || pairs.any(|(a, b)| a.products != b.products) {
            return false;
        }
        let head = self.edges.len();
        for (after, right) in then.iter().zip(&mut self.rights[head..]) {
            *right = Right::polynomial(&after.right, self.unit.powi(after.power));
        }
        // Which changes of sign keep the equations depends on what is zero in the end.
        self.tail.twins.clone_from(&other.twins);
        self.tail.mirrors = other.mirrors;
        true
    }

    /// Leads distance `index` from one length at t = 0 to another at t = 1, in proportion to t.
    pub fn lead(&mut self, index: usize, from: &Target, to: &Target) {
        let [start, end] = [from, to].each(|target| self.enclose_target(target));
        self.set_length(index, Length::new(start, end, None), from, to);
    }

    /// Leads every dimension from what `from` has, whose constraints were led to `record`, to what `to` has, in
    /// proportion to t, while everything else stays. What the constraints of `to` are led to comes back; `None`, and
    /// nothing is changed: `to` has a value out of its range, or is another problem.
    ///
    /// # Panics
    /// If this is not the homotopy of `from` for edits, [`constraint::try_lower_editable`].
    #[doc(hidden)]
    pub fn lead_all(
        &mut self,
        record: &Record,
        (from, to): (&Problem, &Problem),
    ) -> Option<Record> {
        let lowered = constraint::try_lower_editable(to, Some(record)).ok()?;
        if !self.set_constraints(&lowered.tail) {
            return None;
        }
        for (index, (now, then)) in from.distances.iter().zip(&to.distances).enumerate() {
            match now.target == then.target {
                true => self.hold(index, &now.target),
                false => self.lead(index, &now.target, &then.target),
            }
        }
        Some(lowered.record)
    }

    /// A target's length in the homotopy's unit.
    fn enclose_target(&self, target: &Target) -> Interval {
        target.enclose() * point(1.0 / self.unit)
    }

    fn set_length(&mut self, index: usize, length: Length, from: &Target, to: &Target) {
        let exact = ExactLength {
            sketch_squared: from.squared(),
            target: to.clone(),
            bend: None,
            unit: self.unit,
        };
        self.rights[index] = Right::half_square(&length, exact);
        self.lengths[index] = length;
    }
}

/// Whether the sketch of a problem meets one of its distances, exactly.
pub fn is_met(problem: &Problem, index: usize) -> bool {
    let distance = &problem.distances[index];
    problem.squared_in_sketch(distance.points) == distance.target.squared()
}
