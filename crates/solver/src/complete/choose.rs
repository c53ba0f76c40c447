//! Which construction plan drives the search.
//!
//! Plans with as few driving parameters as possible come first: the work grows exponentially with their
//! number. Among those it still differs by orders of magnitude (the deeper points hang on one another,
//! and the later distances close, the more), so that samples decide.

use super::Unserved;
use super::plan::{Plan, Step};
use super::targets::Targets;
use crate::certificate::cover::Pairs;
use crate::certificate::cover::construct::{Hinge, base};
use crate::certificate::cover::{Kind, Radius};
use crate::model::Margin;
use crate::order::InOrder;

/// More driving parameters than this are hopeless.
pub const MOST_PARAMETERS: usize = 4;
/// Plans to consider at most, and choices to follow in their search.
const MOST_PLANS: usize = 4000;
const MOST_CHOICES: usize = 60_000;

/// Plans with the fewest parameters, the most promising ones first. An error: there is no base (no two joined points, or no three mutually joined
/// points in space that are surely not in line), or all plans need more parameters than can be searched.
pub fn plans(targets: &Targets, pairs: &Pairs) -> Result<Vec<Plan>, Unserved> {
    plans_within(targets, pairs, MOST_PARAMETERS)
}

/// The same, with no more than so many parameters.
pub fn plans_within(targets: &Targets, pairs: &Pairs, most: usize) -> Result<Vec<Plan>, Unserved> {
    let bases = bases(targets);
    if bases.is_empty() {
        return Err(Unserved::NoBase);
    }
    for parameters in 0..=most {
        let mut draft = Draft::new(targets, pairs);
        for base in &bases {
            draft.begin(base);
            draft.complete(parameters);
        }
        if !draft.plans.is_empty() {
            let mut plans = draft.plans;
            plans.order_by(|a, b| a.0.total_cmp(&b.0));
            return Ok(plans.into_iter().map(|(_, plan)| plan).collect());
        }
    }
    Err(Unserved::TooManyParameters)
}

fn bases(targets: &Targets) -> Vec<Vec<usize>> {
    let mut out = Vec::new();
    for &[a, b] in &targets.edges {
        if targets.dimension == 2 {
            out.push(vec![a, b]);
            continue;
        }
        for c in 0..targets.points {
            // Each triangle once; any of its corners may lie at the origin.
            if a < b && b < c || b < a && a < c {
                out.push(vec![a, b, c]);
            }
        }
    }
    out.retain(|points| base(&|a, b| targets.square(a, b), points, Margin::Some).is_some());
    out
}

struct Draft<'a> {
    targets: &'a Targets,
    pairs: &'a Pairs,
    neighbours: Vec<Vec<usize>>,
    base: Vec<usize>,
    placed: Vec<bool>,
    depth: Vec<u32>,
    steps: Vec<Step>,
    drives: Vec<Option<[f64; 2]>>,
    plans: Vec<(f64, Plan)>,
    choices: usize,
}

impl<'a> Draft<'a> {
    fn new(targets: &'a Targets, pairs: &'a Pairs) -> Self {
        let mut neighbours = vec![Vec::new(); targets.points];
        for &[a, b] in &targets.edges {
            neighbours[a].push(b);
            neighbours[b].push(a);
        }
        Draft {
            targets,
            pairs,
            neighbours,
            base: Vec::new(),
            placed: Vec::new(),
            depth: vec![0; targets.points],
            steps: Vec::new(),
            drives: Vec::new(),
            plans: Vec::new(),
            choices: 0,
        }
    }

    fn begin(&mut self, base: &[usize]) {
        self.base = base.to_vec();
        self.placed = vec![false; self.targets.points];
        for &p in base {
            self.placed[p] = true;
            self.depth[p] = 0;
        }
        self.steps.clear();
        self.drives.clear();
    }

    /// The neighbours of a point that are placed.
    fn placed_beside(&self, p: usize) -> impl Iterator<Item = usize> {
        let beside = self.neighbours[p].iter().copied();
        beside.filter(|&q| self.placed[q])
    }

    /// The same, the least deep first.
    fn standing(&self, p: usize) -> Vec<usize> {
        let mut out: Vec<usize> = Vec::with_capacity(self.neighbours[p].len());
        for q in self.placed_beside(p) {
            let before = |&other: &usize| (self.depth[other], other) < (self.depth[q], q);
            out.insert(out.partition_point(before), q);
        }
        out
    }

    /// Places all that can be placed with `left` more parameters, in all ways of choosing these.
    fn complete(&mut self, left: usize) {
        self.choices += 1;
        if self.choices > MOST_CHOICES || self.plans.len() >= MOST_PLANS {
            return;
        }
        let d = self.targets.dimension;
        let begin = self.steps.len();
        // What needs no parameter, that which closes most first.
        loop {
            let next = (0..self.targets.points)
                .filter(|&p| !self.placed[p] && self.placed_beside(p).count() >= d)
                .map(|p| (self.standing(p), p))
                .max_by_key(|(standing, p)| {
                    let deep: u32 = standing.iter().take(d).map(|&q| self.depth[q]).sum();
                    (standing.len(), std::cmp::Reverse((deep, *p)))
                });
            let Some((standing, p)) = next else { break };
            let centres = self.centres(&standing).into_iter();
            let kind = Kind::Meet(centres.map(|q| (q, Radius::Given)).collect());
            self.push(p, kind);
        }
        if self.steps.len() + d == self.targets.points {
            let plan = Plan {
                base: self.base.clone(),
                steps: self.steps.clone(),
                drives: self.drives.clone(),
            };
            self.plans.push((self.promise(), plan));
        } else if left > 0 {
            for p in 0..self.targets.points {
                let beside = self.placed_beside(p).count();
                let lacking = beside + 1 == d || d == 3 && beside == 1 && left > 1;
                if self.placed[p] || !lacking {
                    continue;
                }
                let standing = self.standing(p);
                let Some((kind, drives)) = self.driven(p, &standing) else {
                    continue;
                };
                if drives.len() > left {
                    continue;
                }
                let used = drives.len();
                self.drives.extend(drives);
                self.push(p, kind);
                self.complete(left - used);
                self.pop();
                self.drives.truncate(self.drives.len() - used);
            }
        }
        while self.steps.len() > begin {
            self.pop();
        }
    }

    fn push(&mut self, p: usize, kind: Kind) {
        let from = kind.from();
        let used = |q: usize| match &kind {
            Kind::Hinge(frame, _) => frame[..2].contains(&q),
            Kind::Meet(centres) => centres.contains(&(q, Radius::Given)),
            Kind::Arm(centre, _) => *centre == q,
        };
        let closing = self.neighbours[p]
            .iter()
            .filter(|&&q| self.placed[q] && !used(q))
            .map(|&q| self.targets.edge(p, q).expect("a neighbour"))
            .collect();
        self.depth[p] = 1 + from.iter().map(|&q| self.depth[q]).max().unwrap_or(0);
        self.placed[p] = true;
        self.steps.push(Step {
            point: p,
            kind,
            closing,
        });
    }

    fn pop(&mut self) {
        if let Some(step) = self.steps.pop() {
            self.placed[step.point] = false;
        }
    }

    /// Which of the placed neighbours a point is placed from: mutually joined ones, not deep ones.
    fn centres(&self, standing: &[usize]) -> Vec<usize> {
        let joined = |a: usize, b: usize| self.targets.edge(a, b).is_some() as u32;
        if self.targets.dimension == 2 {
            let cost =
                |&[a, b]: &[usize; 2]| 1 + self.depth[a] + self.depth[b] + 2 * (1 - joined(a, b));
            let all = standing.iter().enumerate();
            let pairs = all.flat_map(|(i, &a)| standing[..i].iter().map(move |&b| [a, b]));
            return pairs
                .min_by_key(cost)
                .map_or(Vec::new(), |[a, b]| vec![b, a]);
        }
        let mut best = (0, Vec::new());
        for (i, &a) in standing.iter().enumerate() {
            for (j, &b) in standing[..i].iter().enumerate() {
                for &c in &standing[..j] {
                    let pairs = [joined(a, b), joined(b, c), joined(c, a)];
                    let cost = self.depth[a]
                        + self.depth[b]
                        + self.depth[c]
                        + 2 * (3 - pairs.iter().sum::<u32>());
                    if best.1.is_empty() || cost < best.0 {
                        // The one that the others are joined to comes first.
                        let order = match pairs {
                            [1, 1, _] => vec![b, a, c],
                            [_, 1, 1] => vec![c, a, b],
                            [1, _, 1] => vec![a, b, c],
                            [1, _, _] => vec![a, b, c],
                            [_, 1, _] => vec![b, c, a],
                            _ => vec![c, a, b],
                        };
                        best = (cost, order);
                    }
                }
            }
        }
        best.1
    }

    /// How a point is placed with driving parameters of its own.
    fn driven(&self, p: usize, standing: &[usize]) -> Option<(Kind, Vec<Option<[f64; 2]>>)> {
        let parameter = self.drives.len();
        if self.targets.dimension == 2 {
            return Some((Kind::Arm(standing[0], parameter), vec![None]));
        }
        if let [c1, c2] = standing[..]
            && self.targets.edge(c1, c2).is_some()
        {
            let square = |a: usize, b: usize| self.targets.square(a, b);
            let third = (0..self.targets.points)
                .filter(|&q| {
                    self.placed[q]
                        && self.targets.edge(c1, q).is_some()
                        && self.targets.edge(c2, q).is_some()
                        && matches!(
                            Hinge::new(&square, p, [c1, c2, q], Margin::Some),
                            Some(Ok(_))
                        )
                })
                .min_by_key(|&q| (self.depth[q], q));
            if let Some(q) = third {
                return Some((Kind::Hinge([c1, c2, q], parameter), vec![None]));
            }
        }
        // Distances that are not given take the place of those that are missing.
        let given = standing.iter().map(|&q| (q, Radius::Given));
        let mut centres: Vec<(usize, Radius)> = given.collect();
        let mut others: Vec<usize> = (0..self.targets.points)
            .filter(|&q| self.placed[q] && q != p && !standing.contains(&q))
            .collect();
        others.order_by_key(|&q| (self.depth[q], q));
        let mut drives = Vec::new();
        for q in others.into_iter().take(3 - standing.len()) {
            let [least, most] = self.pairs.squares(p, q);
            centres.push((q, Radius::Parameter(parameter + drives.len())));
            // A little more, so that who bounds it with other roundings comes to less.
            drives.push(Some([least * (1.0 - 1e-9), most * (1.0 + 1e-9)]));
        }
        (centres.len() == 3).then_some((Kind::Meet(centres), drives))
    }

    /// A guess at how much work the plan is; the samples know more.
    fn promise(&self) -> f64 {
        let mut out = 0.0;
        let mut open = 0.0;
        for step in &self.steps {
            let deep = f64::from(self.depth[step.point]);
            let moving = match &step.kind {
                Kind::Meet(centres) => {
                    let pair = |a: usize, b: usize| {
                        self.targets.edge(centres[a].0, centres[b].0).is_none()
                    };
                    let pairs = match centres.len() {
                        2 => [pair(0, 1), false, false],
                        _ => [pair(0, 1), pair(1, 2), pair(2, 0)],
                    };
                    pairs.iter().filter(|&&moves| moves).count() as f64
                }
                _ => 0.0,
            };
            // While parameters are open, every step costs.
            open += if step.is_signed() { 0.0 } else { 1.0 };
            out += deep * (0.5 + moving) * (0.2f64 + open).max(0.2);
            open = (open - step.closing.len() as f64).max(0.0);
        }
        out
    }
}
