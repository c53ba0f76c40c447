//! The problem and the plan, and where the plan's steps put their points.

use super::format::{Cover, Kind, Radius};
use super::model::Model;
use super::pairs::Pairs;
use crate::interval::{Interval, point};
use crate::problem::Problem;

/// A point, or a difference of points.
pub type Place = [Model; 3];

/// The problem in the unit of the cover, and the plan, found to be in order.
pub struct Plan<'a> {
    /// 2 or 3.
    pub dimension: usize,
    /// The number of points.
    pub points: usize,
    /// The distances.
    pub edges: Vec<[usize; 2]>,
    /// Their squares.
    pub squares: Vec<Interval>,
    /// What the file says (without its marks).
    pub cover: &'a Cover,
    /// The coordinates of the base.
    pub base: Vec<[Interval; 3]>,
    /// Bounds of all distances.
    pub pairs: Pairs,
    /// The distances that close at each step.
    pub closing: Vec<Vec<usize>>,
}

/// A part of the search space.
#[derive(Debug, Clone)]
pub struct Node {
    /// Ranges of the driving parameters (of τ for angles), then of the folds' symbols.
    pub ranges: Vec<[f64; 2]>,
    /// For each angle, whether it is in its second half.
    pub halves: Vec<bool>,
    /// For each step with two places so far: 1, −1, or 0 for a fold.
    pub signs: Vec<i8>,
}

impl Node {
    /// A number in the middle of a symbol's range, and at least how far the others are from it.
    pub fn middle(&self, i: usize) -> (f64, f64) {
        let [lo, hi] = self.ranges[i];
        let middle = 0.5 * lo + 0.5 * hi;
        // A difference is rounded once.
        let reach = (hi - middle).max(middle - lo);
        (middle, if reach > 0.0 { reach.next_up() } else { 0.0 })
    }
}

/// What placing a point in general comes to: the point is at `middle` ± `normal` √`square`.
pub struct Meeting {
    /// The middle between the two places.
    pub middle: Option<Place>,
    /// The normal over its squared length.
    pub normal: Option<Place>,
    /// The squared height times the squared length of the normal.
    pub square: Model,
}

impl<'a> Plan<'a> {
    /// Checks that the plan places every point once, from points that stand, by distances that are given.
    pub fn new(problem: &Problem, cover: &'a Cover) -> Result<Self, String> {
        let d = problem.dimension;
        // Steps have a byte in marks. (And bounds of pairs take the cube of this.)
        if problem.points.len() > 256 {
            return Err("a plan with more than 256 points".to_owned());
        }
        let per_unit = point(2f64.powi(-i32::from(cover.unit_exponent)));
        let squares = problem.distances.iter();
        let squares = squares.map(|e| e.target.enclose_squared() * per_unit * per_unit);
        let squares: Vec<Interval> = squares.collect();
        // Bounds of pairs rest on it (`pairs`).
        if !squares.iter().all(|s| s.sup() < 1e60) {
            return Err("in the cover's unit a length is larger than 1e30".to_owned());
        }
        let edges: Vec<[usize; 2]> = problem.distances.iter().map(|e| e.points).collect();
        let mut plan = Plan {
            dimension: d,
            points: problem.points.len(),
            pairs: Pairs::new(problem.points.len(), &edges, &squares),
            edges,
            squares,
            cover,
            base: Vec::new(),
            closing: Vec::new(),
        };
        plan.fix_base()
            .ok_or("the base is not one, or may be degenerate")?;
        plan.follow().ok_or("the plan is not one of this problem")?;
        Ok(plan)
    }

    /// The squared distance wanted between two points.
    pub fn square(&self, a: usize, b: usize) -> Option<Interval> {
        let found = self
            .edges
            .iter()
            .position(|&e| e == [a, b] || e == [b, a])?;
        Some(self.squares[found])
    }

    fn fix_base(&mut self) -> Option<()> {
        let base = &self.cover.base;
        if base.len() != self.dimension || base.iter().any(|&p| p >= self.points) {
            return None;
        }
        let zero = point(0.0);
        let a = self.square(base[0], base[1])?;
        self.base = vec![[zero; 3], [a.sqrt(), zero, zero]];
        if let Some(&c) = base.get(2) {
            let (r1, r2) = (self.square(base[0], c)?, self.square(base[1], c)?);
            let x = (r1 - r2 + a) / (point(2.0) * a.sqrt());
            let height = r1 - x.sqr();
            if !(height.inf() > 0.0) {
                return None;
            }
            self.base.push([x, height.sqrt(), zero]);
        }
        (a.inf() > 0.0).then_some(())
    }

    fn follow(&mut self) -> Option<()> {
        let cover = self.cover;
        let mut stands = vec![false; self.points];
        cover.base.iter().for_each(|&p| stands[p] = true);
        let mut driven = 0;
        if cover.steps.len() + self.dimension != self.points
            || cover.drives.len() > super::format::MAX_SYMBOLS
        {
            return None;
        }
        for (new, kind) in &cover.steps {
            let stood = |p: usize| p < self.points && stands[p];
            if *new >= self.points || stands[*new] {
                return None;
            }
            let mut used = Vec::new();
            let mut drive = |parameter: usize, angle: bool| {
                let right = parameter == driven && cover.drives.get(driven)?.is_none() == angle;
                driven += 1;
                right.then_some(())
            };
            match kind {
                Kind::Arm(centre, parameter) => {
                    drive(*parameter, true)?;
                    used.push(*centre);
                    if self.dimension != 2 || !stood(*centre) {
                        return None;
                    }
                }
                Kind::Hinge(frame, parameter) => {
                    drive(*parameter, true)?;
                    used.extend(&frame[..2]);
                    let [c1, c2, q] = *frame;
                    if self.dimension != 3
                        || !frame.iter().all(|&p| stood(p))
                        || c1 == c2
                        || q == c1
                        || q == c2
                    {
                        return None;
                    }
                }
                Kind::Meet(centres) => {
                    if centres.len() != self.dimension || !centres.iter().all(|c| stood(c.0)) {
                        return None;
                    }
                    for (k, (centre, radius)) in centres.iter().enumerate() {
                        if centres[..k].iter().any(|other| other.0 == *centre) {
                            return None;
                        }
                        match radius {
                            Radius::Given => used.push(*centre),
                            Radius::Parameter(parameter) => {
                                drive(*parameter, false)?;
                                // No figure's distance is outside.
                                let [least, most] = cover.drives[*parameter]?;
                                let square = self.pairs.square(*new, *centre);
                                if !(least <= square.inf() && square.sup() <= most) {
                                    return None;
                                }
                            }
                        }
                    }
                }
            }
            if used.iter().any(|&p| self.square(*new, p).is_none()) {
                return None;
            }
            let closes = |e: &[usize; 2]| {
                let other = if e[0] == *new { e[1] } else { e[0] };
                e.contains(new) && stands[other] && !used.contains(&other)
            };
            let closing = (0..self.edges.len())
                .filter(|&e| closes(&self.edges[e]))
                .collect();
            self.closing.push(closing);
            stands[*new] = true;
        }
        (driven == cover.drives.len()).then_some(())
    }

    /// Whether a point stands before a step.
    pub fn stands(&self, p: usize, step: usize) -> bool {
        let before = &self.cover.steps[..step];
        self.cover.base.contains(&p) || before.iter().any(|(placed, _)| *placed == p)
    }

    /// Whether a step's point has two places.
    pub fn is_signed(&self, step: usize) -> bool {
        let kind = self.cover.steps.get(step).map(|step| &step.1);
        matches!(kind, Some(Kind::Meet(_)))
    }

    /// The parts that all figures lie in, up to reflection: all angles and, if the first step has two places,
    /// one of them; otherwise one half of the first angle.
    pub fn roots(&self) -> Vec<Node> {
        let drives = &self.cover.drives;
        let signed = !self.cover.steps.is_empty() && self.is_signed(0);
        let angles: Vec<usize> = (0..drives.len()).filter(|&i| drives[i].is_none()).collect();
        let free = if signed || self.cover.steps.is_empty() {
            &angles[..]
        } else {
            &angles[1..]
        };
        let root = |choice: usize| Node {
            ranges: drives.iter().map(|d| d.unwrap_or([-1.0, 1.0])).collect(),
            halves: (0..drives.len())
                .map(|i| {
                    free.iter()
                        .position(|&f| f == i)
                        .is_some_and(|k| (choice >> k) & 1 == 1)
                })
                .collect(),
            signs: if signed { vec![1] } else { Vec::new() },
        };
        (0..1usize << free.len()).map(root).collect()
    }

    fn angle(&self, node: &Node, parameter: usize) -> [Model; 2] {
        let (middle, radius) = node.middle(parameter);
        let sign = if node.halves[parameter] { -1.0 } else { 1.0 };
        Model::rotation(node.ranges.len(), parameter, middle, radius).map(|x| x.by(point(sign)))
    }

    /// The place of an arm's or hinge's point.
    pub fn driven(&self, step: usize, node: &Node, points: &[Place]) -> Option<Place> {
        let (new, kind) = &self.cover.steps[step];
        match kind {
            Kind::Arm(centre, parameter) => {
                let length = self.square(*new, *centre)?.sqrt();
                let [cos, sin] = self.angle(node, *parameter);
                let c = &points[*centre];
                Some([c[0].plus(length, &cos), c[1].plus(length, &sin), c[2]])
            }
            Kind::Hinge([c1, c2, q], parameter) => {
                let a2 = self.square(*c1, *c2)?;
                let foot = |p: usize| -> Option<(Interval, Interval)> {
                    let (r1, r2) = (self.square(*c1, p)?, self.square(*c2, p)?);
                    let part = (r1 - r2 + a2) / (point(2.0) * a2);
                    Some((part, r1 - part.sqr() * a2))
                };
                let ((along, height), (third, third_height)) = (foot(*new)?, foot(*q)?);
                if !(third_height.inf() > 0.0 && height.sup() >= 0.0) {
                    return None;
                }
                let height = crate::interval::hull(height.inf().max(0.0), height.sup());
                let side = (height / third_height).sqrt();
                let a = minus(&points[*c2], &points[*c1]);
                let v = plus(&minus(&points[*q], &points[*c1]), -third, &a);
                let [cos, sin] = self.angle(node, *parameter);
                let up = cross(&a, &v);
                let here = plus(&points[*c1], along, &a);
                Some(std::array::from_fn(|k| {
                    here[k]
                        .plus(side, &v[k].times(&cos))
                        .plus(side / a2.sqrt(), &up[k].times(&sin))
                }))
            }
            Kind::Meet(_) => None,
        }
    }

    /// With A = |a|², B = |b|², C = a·b of the centres' differences, q₁ = a·(p − c₁), q₂ = b·(p − c₁):
    /// p = c₁ + ((q₁B − q₂C) a + (q₂A − q₁C) b ± √N n)/Δ, Δ = AB − C², N = r₁²Δ − (q₁²B − 2q₁q₂C + q₂²A), n = a × b;
    /// in the plane Δ = A, N = r₁²A − q₁², n = a turned by a right angle.
    pub fn meet(&self, step: usize, node: &Node, points: &[Place]) -> Option<Meeting> {
        let (new, Kind::Meet(centres)) = self.cover.steps.get(step)? else {
            return None;
        };
        let s = node.ranges.len();
        let radius = |k: usize| -> Option<Model> {
            Some(match centres[k].1 {
                Radius::Given => Model::constant(s, self.square(*new, centres[k].0)?),
                Radius::Parameter(i) => {
                    let (middle, reach) = node.middle(i);
                    Model::symbol(s, i, middle, reach)
                }
            })
        };
        let at = |k: usize| &points[centres[k].0];
        let given = |i: usize, j: usize| {
            self.square(centres[i].0, centres[j].0)
                .map(|x| Model::constant(s, x))
        };
        let (minus_one, half) = (point(-1.0), point(0.5));
        let a = minus(at(1), at(0));
        let (r1, big_a) = (radius(0)?, given(0, 1).unwrap_or_else(|| dot(&a, &a)));
        let q1 = r1
            .plus(minus_one, &radius(1)?)
            .plus(point(1.0), &big_a)
            .by(half);
        if self.dimension == 2 {
            let square = r1.times(&big_a).plus(minus_one, &q1.times(&q1));
            let over = big_a.reciprocal();
            let turned = [a[1].by(minus_one), a[0], a[2]];
            let middle = over.map(|over| {
                let along = q1.times(&over);
                std::array::from_fn(|k| at(0)[k].plus(point(1.0), &a[k].times(&along)))
            });
            let normal = over.map(|over| turned.map(|x| x.times(&over)));
            return Some(Meeting {
                middle,
                normal,
                square,
            });
        }
        let b = minus(at(2), at(0));
        let big_b = given(0, 2).unwrap_or_else(|| dot(&b, &b));
        let c = match given(1, 2) {
            Some(third) => big_a
                .plus(point(1.0), &big_b)
                .plus(minus_one, &third)
                .by(half),
            None => dot(&a, &b),
        };
        let q2 = r1
            .plus(minus_one, &radius(2)?)
            .plus(point(1.0), &big_b)
            .by(half);
        let delta = big_a.times(&big_b).plus(minus_one, &c.times(&c));
        let first = q1.times(&big_b).plus(minus_one, &q2.times(&c));
        let second = q2.times(&big_a).plus(minus_one, &q1.times(&c));
        let square = r1
            .times(&delta)
            .plus(minus_one, &first.times(&q1))
            .plus(minus_one, &second.times(&q2));
        let over = delta.reciprocal();
        let n = cross(&a, &b);
        let middle = over.map(|over| {
            let (x, y) = (first.times(&over), second.times(&over));
            std::array::from_fn(|k| {
                at(0)[k]
                    .plus(point(1.0), &a[k].times(&x))
                    .plus(point(1.0), &b[k].times(&y))
            })
        });
        let normal = over.map(|over| n.map(|x| x.times(&over)));
        Some(Meeting {
            middle,
            normal,
            square,
        })
    }
}

/// a − b.
pub fn minus(a: &Place, b: &Place) -> Place {
    plus(a, point(-1.0), b)
}

/// a + k b.
fn plus(a: &Place, factor: Interval, b: &Place) -> Place {
    std::array::from_fn(|k| a[k].plus(factor, &b[k]))
}

/// a · b.
pub fn dot(a: &Place, b: &Place) -> Model {
    let one = point(1.0);
    a[0].times(&b[0])
        .plus(one, &a[1].times(&b[1]))
        .plus(one, &a[2].times(&b[2]))
}

fn cross(a: &Place, b: &Place) -> Place {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i].times(&b[j]).plus(point(-1.0), &a[j].times(&b[i]))
    })
}
