//! Construction plans of the search: in which order points are placed, from what, and which
//! parameters drive them.
//!
//! The first points, the *base*, are fixed: two joined points in the plane, three mutually joined
//! points in space. Every other point is placed by one step from points placed before. A distance
//! that no step uses *closes*: it is an equation of the search, as soon as both its ends stand.

use super::krawczyk::Figure;
use super::model::Number;
use super::targets::{Targets, not_negative};
use crate::certificate::cover::{Cover, Kind, Radius, closing};
use crate::interval::{Interval, point};
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
            problem: problem.to_toml(),
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

/// The coordinates of the base, none if no such base exists, or it may be degenerate.
pub fn base_coordinates(targets: &Targets, base: &[usize]) -> Option<Vec<[Interval; 3]>> {
    let zero = point(0.0);
    let square = |a: usize, b: usize| targets.square(a, b);
    let ab = targets.lengths[targets.edge(base[0], base[1])?];
    let mut out = vec![[zero; 3], [ab, zero, zero]];
    if let Some(&c) = base.get(2) {
        let (r1, r2) = (square(base[0], c)?, square(base[1], c)?);
        let x = (r1 - r2 + square(base[0], base[1])?) / (point(2.0) * ab);
        let height = r1 - x.sqr();
        if height.inf() <= 1e-9 {
            return None;
        }
        out.push([x, height.sqrt(), zero]);
    }
    Some(out)
}

/// The constants of a hinge: the new point lies at
/// `c₁ + along (c₂ − c₁) + cos θ · side · v + sin θ · up · (c₂ − c₁) × v`, where
/// `v = (q − c₁) − foot (c₂ − c₁)` is perpendicular to the hinge.
#[derive(Debug, Clone, Copy)]
pub struct HingeNumbers {
    /// Where the new point's foot lies on the hinge, as a part of it.
    pub along: Number,
    /// Where the third point's foot lies.
    pub foot: Number,
    /// The new point's distance from the hinge over that of the third point.
    pub side: Number,
    /// That over the length of the hinge.
    pub up: Number,
}

impl HingeNumbers {
    /// For a new point on a hinge. `None` if the third point may lie in line with the hinge; `Err` if
    /// no point has the distances wanted.
    pub fn new(
        targets: &Targets,
        new: usize,
        [c1, c2, q]: [usize; 3],
    ) -> Option<Result<HingeNumbers, ()>> {
        let a = targets.square(c1, c2)?;
        let part = |p: usize| -> Option<(Interval, Interval)> {
            let (r1, r2) = (targets.square(c1, p)?, targets.square(c2, p)?);
            let part = (r1 - r2 + a) / (point(2.0) * a);
            // The squared distance from the hinge.
            Some((part, r1 - part.sqr() * a))
        };
        let ((along, new_height), (foot, height)) = (part(new)?, part(q)?);
        if height.inf() <= 1e-9 {
            return None;
        }
        if new_height.sup() < 0.0 {
            return Some(Err(()));
        }
        let side = (not_negative(new_height) / height).sqrt();
        Some(Ok(HingeNumbers {
            along: Number::new(along),
            foot: Number::new(foot),
            side: Number::new(side),
            up: Number::new(side / targets.lengths[targets.edge(c1, c2)?]),
        }))
    }
}

/// The constants of a meeting of spheres (or circles) whose centres have given distances from each other:
/// the new point lies at `c₁ + first (c₂ − c₁) + second (c₃ − c₁) ± over n`, n = (c₂ − c₁) × (c₃ − c₁) or
/// (c₂ − c₁) turned by a right angle.
#[derive(Debug, Clone, Copy)]
pub struct MeetNumbers {
    /// The multiple of c₂ − c₁ in the new point.
    pub first: Number,
    /// The multiple of c₃ − c₁ in the new point.
    pub second: Number,
    /// The multiple of n in the new point, up to its sign.
    pub over: Number,
}

/// What is known in advance of a meeting.
#[derive(Debug, Clone, Copy)]
pub enum Meeting {
    /// Nothing: the centres move, or the new point may lie between them.
    Moving,
    /// All but the place of the centres.
    Rigid(MeetNumbers),
    /// There is no such point.
    Empty,
}

impl Meeting {
    /// Of a new point and its centres.
    pub fn new(targets: &Targets, new: usize, centres: &[(usize, Radius)]) -> Self {
        Self::of(targets, new, centres).unwrap_or(Meeting::Moving)
    }

    fn of(targets: &Targets, new: usize, centres: &[(usize, Radius)]) -> Option<Self> {
        let radius = |k: usize| match centres[k] {
            (centre, Radius::Given) => targets.square(new, centre),
            (_, Radius::Parameter(_)) => None,
        };
        let square = |a: usize, b: usize| targets.square(centres[a].0, centres[b].0);
        let (a, r1, r2) = (square(0, 1)?, radius(0)?, radius(1)?);
        let half = point(0.5);
        let q1 = (r1 - r2 + a) * half;
        let (first, second, delta, n) = if centres.len() == 2 {
            (q1, point(0.0), a, r1 * a - q1.sqr())
        } else {
            let (b, d, r3) = (square(0, 2)?, square(1, 2)?, radius(2)?);
            let c = (a + b - d) * half;
            let q2 = (r1 - r3 + b) * half;
            let delta = a * b - c.sqr();
            let (first, second) = (q1 * b - q2 * c, q2 * a - q1 * c);
            (
                first,
                second,
                delta,
                r1 * delta - (first * q1 + second * q2),
            )
        };
        if delta.inf() <= 1e-9 {
            return None;
        }
        if n.sup() < -1e-9 {
            return Some(Meeting::Empty);
        }
        if n.inf() <= 1e-9 {
            return None;
        }
        Some(Meeting::Rigid(MeetNumbers {
            first: Number::new(first / delta),
            second: Number::new(second / delta),
            over: Number::new(n.sqrt() / delta),
        }))
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
    use super::super::pairs::Pairs;
    use super::*;
    use crate::complete::choose;

    #[test]
    fn a_parameter_that_ranges_over_less_than_it_must_does_not_serve() {
        let problem = Problem::read("../../problems/octahedron.toml").unwrap();
        let targets = Targets::new(&problem);
        let pairs = Pairs::new(&targets);
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
