//! Construction plans of the search: in which order points are placed, from what, and which
//! parameters drive them.
//!
//! The first points, the *base*, are fixed: two joined points in the plane, three mutually joined
//! points in space. Every other point is placed by one step from points placed before. A distance
//! that no step uses *closes*: it is an equation of the search, as soon as both its ends stand.

use super::model::Number;
use super::node::MAX_SYMBOLS;
use super::pairs::Pairs;
use super::targets::{Targets, not_negative};
use crate::interval::{Interval, point};
use serde::{Deserialize, Serialize};

/// How a point is placed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Kind {
    /// In the plane, at a given distance from one point, in the direction of a driving angle.
    Arm {
        /// The point that it is joined to.
        centre: usize,
        /// The driving parameter.
        parameter: usize,
    },
    /// In space, on the circle of points at given distances from two joined points: a driving angle,
    /// between the half planes from the line through both towards the point placed and towards a
    /// third point joined to both.
    Hinge {
        /// The two points of the hinge, and the third.
        frame: [usize; 3],
        /// The driving parameter.
        parameter: usize,
    },
    /// At given distances from as many points as there are dimensions; two places, on either side of
    /// the line or plane through those points.
    Meet {
        /// The points that it is joined to.
        centres: Vec<usize>,
        /// The distances to them.
        radii: Vec<Radius>,
    },
}

/// The distance between a new point and one that it is placed from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Radius {
    /// A distance of the problem.
    Edge(usize),
    /// The square root of a driving parameter.
    Parameter(usize),
}

/// What a driving parameter is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Drive {
    /// An angle, in two halves: e^(iθ) = ± i (1 + iτ)/(1 − iτ), −1 ≤ τ ≤ 1.
    Angle,
    /// A squared distance between these bounds.
    Square([f64; 2]),
}

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
    /// The driving parameters.
    pub drives: Vec<Drive>,
}

impl Kind {
    /// The points that have to stand before.
    pub fn from(&self) -> Vec<usize> {
        match self {
            Kind::Arm { centre, .. } => vec![*centre],
            Kind::Hinge { frame, .. } => frame.to_vec(),
            Kind::Meet { centres, .. } => centres.clone(),
        }
    }

    /// The driving parameters that the place depends on by itself.
    pub fn parameters(&self) -> impl Iterator<Item = usize> {
        let (own, radii) = match self {
            Kind::Arm { parameter, .. } | Kind::Hinge { parameter, .. } => (Some(*parameter), None),
            Kind::Meet { radii, .. } => (None, Some(radii)),
        };
        let driven = |radius: &Radius| match radius {
            Radius::Edge(_) => None,
            Radius::Parameter(parameter) => Some(*parameter),
        };
        own.into_iter()
            .chain(radii.into_iter().flatten().filter_map(driven))
    }
}

impl Plan {
    /// The number k of driving parameters.
    pub fn parameters(&self) -> usize {
        self.drives.len()
    }

    /// Whether it is a plan of this problem, by which a search leaves out no figure: every point is placed once,
    /// from points that stand, by distances that are given or driven, driven ones between bounds that hold for every
    /// figure; every other distance closes where both its ends stand.
    pub fn serves(&self, targets: &Targets, pairs: &Pairs) -> bool {
        self.follow(targets, pairs).is_some()
    }

    fn follow(&self, targets: &Targets, pairs: &Pairs) -> Option<()> {
        let d = targets.dimension;
        let sized = self.base.len() == d && self.steps.len() + d == targets.points;
        if !sized || self.drives.len() > MAX_SYMBOLS {
            return None;
        }
        let mut stands = vec![false; targets.points];
        for (k, &p) in self.base.iter().enumerate() {
            let joined = |&q: &usize| targets.edge(p, q).is_some();
            if *stands.get(p)? || !self.base[..k].iter().all(joined) {
                return None;
            }
            stands[p] = true;
        }
        let mut drives = self.drives.iter().enumerate();
        for step in &self.steps {
            let new = step.point;
            let from = step.kind.from();
            let stood = |p: &usize| stands.get(*p).copied().unwrap_or(false);
            let different = (0..from.len()).all(|k| !from[..k].contains(&from[k]));
            if stands.get(new) != Some(&false) || !from.iter().all(stood) || !different {
                return None;
            }
            let mut used = Vec::new();
            match &step.kind {
                Kind::Arm { centre, parameter } => {
                    let right = d == 2 && drives.next()? == (*parameter, &Drive::Angle);
                    right.then_some(())?;
                    used.push(*centre);
                }
                Kind::Hinge { frame, parameter } => {
                    let [c1, c2, q] = *frame;
                    let joined = |a, b| targets.edge(a, b).is_some();
                    let right = d == 3 && drives.next()? == (*parameter, &Drive::Angle);
                    (right && joined(c1, c2) && joined(c1, q) && joined(c2, q)).then_some(())?;
                    used.extend([c1, c2]);
                }
                Kind::Meet { centres, radii } => {
                    (centres.len() == d && radii.len() == d).then_some(())?;
                    for (&centre, radius) in centres.iter().zip(radii) {
                        match *radius {
                            Radius::Edge(edge) => {
                                (targets.edge(new, centre) == Some(edge)).then_some(())?;
                                used.push(centre);
                            }
                            Radius::Parameter(parameter) => {
                                let (next, &Drive::Square([least, most])) = drives.next()? else {
                                    return None;
                                };
                                let [low, high] = pairs.squares(new, centre);
                                (next == parameter && least <= low && high <= most).then_some(())?;
                            }
                        }
                    }
                }
            }
            let given = |&p: &usize| targets.edge(new, p).is_some();
            let closes = |&p: &usize| stands[p] && !used.contains(&p);
            let closing = (0..targets.points).filter(closes);
            let mut closing: Vec<usize> = closing.filter_map(|p| targets.edge(new, p)).collect();
            let mut said = step.closing.clone();
            closing.sort_unstable();
            said.sort_unstable();
            (used.iter().all(given) && closing == said).then_some(())?;
            stands[new] = true;
        }
        drives.next().is_none().then_some(())
    }
}

/// The coordinates of the base, none if no such base exists, or it may be degenerate.
pub fn base_coordinates(targets: &Targets, base: &[usize]) -> Option<Vec<[Interval; 3]>> {
    let zero = point(0.0);
    let length = |a: usize, b: usize| Some(targets.lengths[targets.edge(a, b)?]);
    let square = |a: usize, b: usize| Some(targets.squares[targets.edge(a, b)?]);
    let ab = length(base[0], base[1])?;
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
        let square = |a: usize, b: usize| Some(targets.squares[targets.edge(a, b)?]);
        let a = square(c1, c2)?;
        let part = |p: usize| -> Option<(Interval, Interval)> {
            let (r1, r2) = (square(c1, p)?, square(c2, p)?);
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
    pub fn new(targets: &Targets, centres: &[usize], radii: &[Radius]) -> Self {
        Self::of(targets, centres, radii).unwrap_or(Meeting::Moving)
    }

    fn of(targets: &Targets, centres: &[usize], radii: &[Radius]) -> Option<Self> {
        let radius = |k: usize| match radii[k] {
            Radius::Edge(edge) => Some(targets.squares[edge]),
            Radius::Parameter(_) => None,
        };
        let square =
            |a: usize, b: usize| Some(targets.squares[targets.edge(centres[a], centres[b])?]);
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
        matches!(self.kind, Kind::Meet { .. })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complete::choose;
    use crate::problem::Problem;

    #[test]
    fn a_parameter_that_ranges_over_less_than_it_must_does_not_serve() {
        let problem = Problem::read("../../problems/octahedron.toml").unwrap();
        let targets = Targets::new(&problem);
        let pairs = Pairs::new(&targets);
        let plans = choose::plans(&targets, &pairs).unwrap();
        assert!(plans.iter().all(|plan| plan.serves(&targets, &pairs)));
        // The distance from the third point of the hinge drives its point, in place of the angle.
        let mut plan = plans[0].clone();
        let new = plan.steps[0].point;
        let Kind::Hinge { frame, parameter } = plan.steps[0].kind else {
            panic!("{plan:?}");
        };
        let edge = |p: usize| Radius::Edge(targets.edge(new, p).unwrap());
        plan.steps[0].kind = Kind::Meet {
            centres: frame.to_vec(),
            radii: vec![edge(frame[0]), edge(frame[1]), Radius::Parameter(parameter)],
        };
        let [low, high] = pairs.squares(new, frame[2]);
        assert!(low < high);
        let mut serves = |range: [f64; 2]| {
            plan.drives[parameter] = Drive::Square(range);
            plan.serves(&targets, &pairs)
        };
        assert!(serves([low, high]) && serves([0.0, 100.0]));
        assert!(!serves([low.next_up(), high]) && !serves([low, high.next_down()]));
        assert!(!serves([f64::NAN, high]) && !serves([high, low]));
    }
}
