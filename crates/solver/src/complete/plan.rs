//! Construction plans of the search: in which order points are placed, from what, and which
//! parameters drive them.
//!
//! The first points, the *base*, are fixed: two joined points in the plane, three mutually joined
//! points in space. Every other point is placed by one step from points placed before. A distance
//! that no step uses *closes*: it is an equation of the search, as soon as both its ends stand.

use crate::certificate::cover::Figure;
use crate::certificate::cover::{Cover, Kind, Radius, closing};
use crate::problem::Problem;
use serde::{Deserialize, Serialize};

/// One point placed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Step {
    /// Which point.
    pub point: usize,
    /// How.
    pub kind: Kind,
    /// The distances that close when it stands.
    pub closing: Vec<usize>,
}

/// A construction plan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// The base: the first point lies at the origin, the second on the positive x axis, in space the
    /// third in the xy plane above it.
    pub base: Vec<usize>,
    /// The points that are not in the base, in the order in which they are placed.
    pub steps: Vec<Step>,
    /// The driving parameters: an angle θ, in two halves, e^(iθ) = ± i (1 + iτ)/(1 − iτ) with −1 ≤ τ ≤ 1, or a squared distance between
    /// these bounds.
    pub drives: Vec<Option<[f64; 2]>>,
}

impl Kind {
    /// The points that have to stand before.
    pub fn from(&self) -> Vec<usize> {
        match self {
            Kind::Arm(centre, _) => vec![*centre],
            Kind::Hinge(frame, _) => frame.to_vec(),
            Kind::Meet(centres) => centres.iter().map(|centre| centre.0).collect(),
        }
    }

    /// The driving parameters that the place depends on by itself.
    pub fn parameters(&self) -> impl Iterator<Item = usize> {
        let (own, centres) = match self {
            Kind::Arm(_, parameter) | Kind::Hinge(_, parameter) => (Some(*parameter), &[][..]),
            Kind::Meet(centres) => (None, &centres[..]),
        };
        let driven = |centre: &(usize, Radius)| match centre.1 {
            Radius::Given => None,
            Radius::Parameter(parameter) => Some(parameter),
        };
        own.into_iter().chain(centres.iter().filter_map(driven))
    }
}

impl Plan {
    /// The number k of driving parameters.
    pub fn parameters(&self) -> usize {
        self.drives.len()
    }

    /// The cover of a problem by it, before anything is known of its parts, in the unit of the search.
    pub fn cover(&self, problem: &Problem, unit: f64, figures: &[Figure]) -> Cover {
        let steps = self.steps.iter();
        Cover {
            problem: problem.without_limits().to_toml(),
            base: self.base.clone(),
            steps: steps.map(|step| (step.point, step.kind.clone())).collect(),
            drives: self.drives.clone(),
            figures: figures.iter().map(|figure| figure.centre.clone()).collect(),
            unit_exponent: unit.log2() as i16,
            marks: Vec::new(),
        }
    }

    /// Whether it is a plan of this problem, by which a search leaves out no figure, as the check of covers sees it: every point is placed
    /// once, from points that stand, by distances that are given or driven, driven ones between bounds that hold for every figure; every
    /// other distance closes where both its ends stand.
    pub fn serves(&self, problem: &Problem, unit: f64) -> bool {
        let closing = closing(problem, &self.cover(problem, unit, &[]));
        let own = self.steps.iter().map(|step| &step.closing);
        closing.is_some_and(|closing| closing.iter().eq(own))
    }
}

impl Step {
    /// Whether the point has two places.
    pub fn is_signed(&self) -> bool {
        matches!(self.kind, Kind::Meet(_))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complete::choose;
    use crate::complete::targets::Targets;

    #[test]
    fn a_parameter_that_ranges_over_less_than_it_must_does_not_serve() {
        let problem = Problem::read("../../problems/octahedron.toml").unwrap();
        let targets = Targets::new(&problem);
        let pairs = targets.pairs();
        let plans = choose::plans(&targets, &pairs).unwrap();
        let serves = |plan: &Plan| plan.serves(&problem, targets.unit);
        assert!(plans.iter().all(serves));
        // The distance from the third point of the hinge drives its point, in place of the angle.
        let mut plan = plans[0].clone();
        let new = plan.steps[0].point;
        let Kind::Hinge([a, b, c], parameter) = plan.steps[0].kind else {
            panic!("{plan:?}");
        };
        let driven = (c, Radius::Parameter(parameter));
        plan.steps[0].kind = Kind::Meet(vec![(a, Radius::Given), (b, Radius::Given), driven]);
        let [low, high] = pairs.squares(new, c);
        assert!(low < high);
        let mut serves = |range: [f64; 2]| {
            plan.drives[parameter] = Some(range);
            plan.serves(&problem, targets.unit)
        };
        // Of the check's bounds and these all but the last digits are the same.
        let (less, more) = (1.0 - 1e-12, 1.0 + 1e-12);
        assert!(serves([less * low, more * high]) && serves([0.0, 100.0]));
        assert!(!serves([more * low, high]) && !serves([low, less * high]));
        assert!(!serves([f64::NAN, high]) && !serves([high, low]));
    }
}
