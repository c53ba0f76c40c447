//! The problem and the plan, found to be in order.

use super::construct::{self, Ahead, Known};
use super::format::{Cover, Kind, Radius};
use super::pairs::Pairs;
use crate::interval::{Interval, point};
use crate::model::{self, Margin, Number, SYMBOLS};
use crate::problem::Problem;

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
    /// What is known of each step: nothing, where a hinge may be degenerate or its point has no place.
    pub known: Vec<Option<Known>>,
}

/// A function of as many symbols as there may be.
pub type Model = model::Model<SYMBOLS, 28>;
/// A point.
pub type Place = construct::Place<SYMBOLS, 28>;
/// A point with two places.
pub type Meeting<'p> = construct::Meeting<'p, SYMBOLS, 28>;

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

    /// A symbol.
    pub fn symbol(&self, i: usize) -> Model {
        let (middle, reach) = self.middle(i);
        Model::symbol(i, middle, reach)
    }
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
            known: Vec::new(),
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
        self.base = construct::base(&|a, b| self.square(a, b), base, Margin::None)?;
        Some(())
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
            let known = Known::new(&|a, b| self.square(a, b), *new, kind, Margin::None);
            self.known.push(known.and_then(Result::ok));
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

    /// The place of an arm's or hinge's point.
    pub fn driven(&self, step: usize, node: &Node, points: &[Place]) -> Option<Place> {
        let angle = |i: usize| construct::angle(i, node.middle(i), node.halves[i]);
        let kind = &self.cover.steps[step].1;
        self.known[step].as_ref()?.driven(kind, points, angle)
    }

    /// The middle and the normal of the two places of a step's point, and its height over the middle.
    pub fn places(
        &self,
        step: usize,
        node: &Node,
        points: &[Place],
    ) -> Option<([Place; 2], Model)> {
        if let Some(Known::Meeting(Ahead::Rigid(numbers))) = self.known.get(step)?
            && let Kind::Meet(centres) = &self.cover.steps[step].1
        {
            return Some(numbers.places(centres, points));
        }
        let meeting = self.meet(step, node, points)?;
        let height = meeting.square.square_root(meeting.square.range());
        Some((meeting.places(&meeting.over()), height))
    }

    /// Where the point of a step with two places is.
    pub fn meet<'p>(&self, step: usize, node: &Node, points: &'p [Place]) -> Option<Meeting<'p>> {
        let (new, Kind::Meet(centres)) = self.cover.steps.get(step)? else {
            return None;
        };
        let square = |a: usize, b: usize| self.square(a, b).map(Number::new);
        Meeting::new(square, *new, centres, points, |i| node.symbol(i))
    }
}
