//! The search: depth first, its parts on all threads, the answer the same for any number of them.

use super::Options;
use super::node::{MAX_SIGNED, MAX_SYMBOLS, Node};
use super::plan::Plan;
use super::targets::Targets;
use super::visit::{Found, Rooms, Why, visit};
use crate::certificate::cover::Pairs;
use crate::certificate::cover::construct::{Known, base};
use crate::certificate::cover::{Figure, Frame};
use crate::linalg::damped;
use crate::model::{Margin, Number};
use crate::places::Each as _;
use crate::track::Signs;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use rayon::prelude::*;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// One plan's search.
pub struct Search {
    /// The problem.
    pub targets: Targets,
    /// The plan.
    pub plan: Plan,
    /// The coordinates of the base.
    pub base: Vec<[Number; 3]>,
    /// What is known of each step.
    pub known: Vec<Known>,
    /// Which of the steps with two places each step is, or `usize::MAX`.
    pub signed: Vec<usize>,
    /// The squares of the distances wanted.
    pub squares: Vec<Number>,
    /// For each step the signs that are asked for of its point and those before alone, as soon as there are two of them: mirror images are on no other
    /// footing.
    pub signs: Vec<Signs>,
    /// For each step, the points that stand before and have no given distance from the new one, with bounds of the
    /// squared distance.
    pub pairs: Vec<Vec<(usize, [f64; 2])>>,
    /// The test in all coordinates.
    pub frame: Frame,
    /// Symbols' ranges narrower than this are not halved.
    pub least_width: f64,
    /// Most symbols, folds included.
    pub most_symbols: usize,
}

/// Why a plan cannot be searched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unfit {
    /// The base may be degenerate.
    Base,
    /// More points than the search's records hold.
    Large,
    /// A hinge may be degenerate.
    Hinge,
    /// No figure exists: these points cannot have their distances.
    Empty(usize),
}

/// What runs share.
pub struct Run<'a> {
    /// Set from outside to end the search.
    pub stop: &'a AtomicBool,
    /// Parts looked at.
    pub boxes: AtomicU64,
    /// No more parts than this.
    pub most_boxes: u64,
    /// The share that is done, in units of 2⁻⁶⁰.
    pub done: AtomicU64,
    /// What of that was done before this run.
    pub before: AtomicU64,
    /// What of it was done in vain.
    pub lost: AtomicU64,
    /// Whether the cover is wanted.
    pub cover: bool,
    /// Whether what is done is kept in a store, and nothing else is.
    pub is_stored: bool,
    /// Now and then, farther and farther apart: the seconds since the search began, and the share that was done since, for good.
    pub history: Mutex<Vec<[f64; 2]>>,
}

/// Below this depth a subtree is one task.
const TASK_DEPTH: usize = 22;
/// Parts between two looks at the clock.
const PAUSE: u64 = 256;
const SHARE_UNIT: f64 = (1u64 << 60) as f64;

impl Search {
    /// Prepares the search by a plan.
    pub fn new(targets: &Targets, pairs: &Pairs, plan: Plan) -> Result<Self, Unfit> {
        if targets.points > 250 || plan.steps.iter().filter(|s| s.is_signed()).count() > MAX_SIGNED
        {
            return Err(Unfit::Large);
        }
        let square = |a: usize, b: usize| targets.square(a, b);
        let base = base(&square, &plan.base, Margin::Some).ok_or(Unfit::Base)?;
        let mut known = Vec::new();
        let mut signed = Vec::new();
        let mut count = 0;
        for step in &plan.steps {
            signed.push(usize::MAX);
            if step.is_signed() {
                *signed.last_mut().expect("just pushed") = count;
                count += 1;
            }
            known.push(
                match Known::new(&square, step.point, &step.kind, Margin::Some) {
                    Some(Ok(known)) => known,
                    Some(Err(())) => return Err(Unfit::Empty(step.point)),
                    None => return Err(Unfit::Hinge),
                },
            );
        }
        let mut standing = plan.base.clone();
        let signs = signs(&targets.signs, &plan);
        let bounded = plan.steps.iter().map(|step| {
            let others = standing
                .iter()
                .filter(|&&q| targets.edge(step.point, q).is_none());
            let bounds = others.map(|&q| (q, pairs.squares(step.point, q))).collect();
            standing.push(step.point);
            bounds
        });
        Ok(Search {
            signs,
            pairs: bounded.collect(),
            frame: targets.frame(&plan.base),
            squares: targets.squares.iter().map(|&s| Number::new(s)).collect(),
            base: base.into_iter().map(|p| p.each(Number::new)).collect(),
            known,
            signed,
            least_width: 2f64.powi(-38),
            most_symbols: MAX_SYMBOLS,
            targets: targets.clone(),
            plan,
        })
    }

    /// Searches everything.
    pub fn run(&self, run: &Run) -> Found {
        Found::together(self.each(run, Node::roots(&self.plan), 0))
    }

    fn each(&self, run: &Run, nodes: Vec<Node>, depth: usize) -> Vec<Found> {
        if rayon::current_num_threads() == 1 || nodes.len() < 2 {
            nodes
                .into_iter()
                .map(|node| self.descend(run, node, depth))
                .collect()
        } else {
            nodes
                .into_par_iter()
                .map(|node| self.descend(run, node, depth))
                .collect()
        }
    }

    /// All below a part, which is so deep in what is searched.
    pub fn descend(&self, run: &Run, node: Node, depth: usize) -> Found {
        if depth >= TASK_DEPTH || rayon::current_num_threads() == 1 {
            let mut found = Found::begun(run.cover);
            self.subtree(run, node, &mut found);
            return found;
        }
        if run.stop.load(Ordering::Relaxed) || run.boxes.load(Ordering::Relaxed) > run.most_boxes {
            return Found::missing(run.cover, node.share);
        }
        let (mut found, children) = self.one(run, node);
        for part in self.each(run, children, depth + 1) {
            found.append(part);
        }
        found
    }

    /// All below a node, one part after the other.
    fn subtree(&self, run: &Run, node: Node, found: &mut Found) {
        let (mut stack, mut children) = (vec![node], Vec::new());
        let mut rooms = Rooms::default();
        let mut count = 0;
        let mut ended = false;
        while let Some(node) = stack.pop() {
            count += 1;
            if count % PAUSE == 0 || stack.is_empty() {
                let all = run.boxes.fetch_add(count, Ordering::Relaxed) + count;
                count = 0;
                ended = run.stop.load(Ordering::Relaxed) || all > run.most_boxes;
            }
            if ended {
                found.leave(node.share, Why::Unfinished);
                continue;
            }
            self.look_at(node, run, &mut rooms, found, &mut children);
            stack.extend(children.drain(..).rev());
        }
        run.boxes.fetch_add(count, Ordering::Relaxed);
    }

    /// One part, and those that it is parted into.
    pub fn one(&self, run: &Run, node: Node) -> (Found, Vec<Node>) {
        let (mut found, mut children) = (Found::begun(run.cover), Vec::new());
        self.look_at(node, run, &mut Rooms::default(), &mut found, &mut children);
        run.boxes.fetch_add(1, Ordering::Relaxed);
        (found, children)
    }

    fn look_at(
        &self,
        node: Node,
        run: &Run,
        rooms: &mut Rooms,
        found: &mut Found,
        children: &mut Vec<Node>,
    ) {
        let share = node.share;
        visit(self, node, rooms, found, children);
        let open: f64 = children.iter().map(|c| c.share).sum();
        run.add_done((share - open).max(0.0));
    }

    /// Samples of how many parts a search would look at: random ways down the tree, each part weighted
    /// with the number of choices on the way to it (Knuth, *Estimating the efficiency of backtrack
    /// programs*, Math. Comp. 29, 1975). The mean is right but rarely meets what is deep and narrow, so that
    /// of four samples the largest counts. The seed makes it the same each time.
    pub fn sample(&self, ways: usize) -> f64 {
        let roots = Node::roots(&self.plan);
        let mut state = 0x9e37_79b9_7f4a_7c15u64;
        let mut choose = |count: usize| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 33) as usize % count
        };
        let mut found = Found::default();
        let (mut children, mut rooms) = (Vec::new(), Rooms::default());
        let mut largest = 0.0f64;
        for _ in 0..4 {
            let mut total = 0.0;
            // A curve of figures is met again and again, at great cost: so much is enough.
            let (mut looked, most) = (0, 100 * ways);
            for _ in 0..ways / 4 {
                let mut weight = roots.len() as f64;
                let mut node = roots[choose(roots.len())].clone();
                loop {
                    total += weight;
                    looked += 1;
                    children.clear();
                    visit(self, node, &mut rooms, &mut found, &mut children);
                    if children.is_empty() || looked > most {
                        break;
                    }
                    weight *= children.len() as f64;
                    node = children.swap_remove(choose(children.len()));
                }
            }
            largest = largest.max(total / (ways / 4) as f64);
        }
        largest
    }

    /// Whether floats see a curve of figures through (or very near) this one: a small step along the
    /// direction in which the equations do not change, corrected, does not lead back.
    pub fn flexes(&self, guess: &[[f64; 3]]) -> bool {
        let m = self.frame.m;
        let mut x = guess.to_vec();
        if m == 0 || !self.settle(&mut x, 1e-11) {
            return false;
        }
        let Some(direction) = self.weakest(&x) else {
            return false;
        };
        for sign in [1.0, -1.0] {
            let mut y = x.clone();
            self.frame.moved(&mut y, direction.as_slice(), sign * 1e-2);
            let moved = |y: &[[f64; 3]]| {
                let all = y.iter().flatten().zip(x.iter().flatten());
                all.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            let start = moved(&y);
            if self.settle(&mut y, 1e-11) && moved(&y) > 0.5 * start {
                return true;
            }
        }
        false
    }

    /// The Jacobian, with (JᵀJ + ε)⁻¹.
    fn linearise(&self, x: &[[f64; 3]]) -> Option<(DMatrix<f64>, Cholesky<f64, Dyn>)> {
        let (m, mut j) = (self.frame.m, Vec::new());
        self.frame.jacobian(x, &mut j);
        let j = DMatrix::from_row_slice(m, m, &j);
        damped(&j, 1e-12).map(|normal| (j, normal))
    }

    /// Moves a figure to the nearest solution, or says that it does not get there.
    fn settle(&self, x: &mut [[f64; 3]], wanted: f64) -> bool {
        let mut f = DVector::zeros(self.frame.m);
        for _ in 0..25 {
            self.frame.residual(x, f.as_mut_slice());
            let size = f.amax();
            if size < wanted {
                return true;
            }
            if !(size < 1.0) {
                return false;
            }
            let Some((j, normal)) = self.linearise(x) else {
                return false;
            };
            let step = normal.solve(&j.tr_mul(&f));
            self.frame.moved(x, step.as_slice(), -1.0);
        }
        false
    }

    /// A unit vector that the Jacobian nearly maps to 0, if there is one.
    fn weakest(&self, x: &[[f64; 3]]) -> Option<DVector<f64>> {
        let (j, normal) = self.linearise(x)?;
        let start = |i: usize, _| ((i * 7919 + 13) % 101) as f64 / 50.0 - 1.0;
        let mut v = DVector::from_fn(self.frame.m, start);
        for _ in 0..6 {
            // By inverse iteration.
            v = normal.solve(&v).normalize();
        }
        ((&j * &v).norm() < 1e-4).then_some(v)
    }
}

/// For each step of a plan the signs to be looked at once its point stands.
fn signs(all: &Signs, plan: &Plan) -> Vec<Signs> {
    let mut standing = plan.base.clone();
    let steps = plan.steps.iter().map(|step| {
        standing.push(step.point);
        let stand = |points: &[usize]| points.iter().all(|p| standing.contains(p));
        let known = all.all.iter().filter(|one| stand(&one.points));
        let known: Vec<_> = known.cloned().collect();
        let is_new = known.iter().any(|one| one.points.contains(&step.point));
        Signs {
            all: if is_new && known.len() > 1 {
                known
            } else {
                Vec::new()
            },
            mirrors: all.mirrors,
        }
    });
    steps.collect()
}

/// Figures without repetitions: mirror images in the base are one. `Err` if two of them cannot be told
/// apart or together.
pub fn different(figures: &[Figure], dimension: usize) -> Result<Vec<Figure>, usize> {
    let mut out: Vec<Figure> = Vec::new();
    'next: for figure in figures {
        let image = figure.mirrored(dimension);
        for known in &out {
            for one in [figure, &image] {
                if one.is_same(known) || known.is_same(one) {
                    continue 'next;
                }
                // Boxes that are apart hold different figures.
                if one.distance(known) <= 1.01 * (one.radius + known.radius) {
                    return Err(out.len());
                }
            }
        }
        out.push(figure.clone());
    }
    Ok(out)
}

impl<'a> Run<'a> {
    /// Nothing is done yet.
    pub fn new(stop: &'a AtomicBool, options: &Options, cover: bool) -> Self {
        Run {
            stop,
            boxes: AtomicU64::new(0),
            most_boxes: options.most_boxes,
            done: AtomicU64::new(0),
            before: AtomicU64::new(0),
            lost: AtomicU64::new(0),
            cover,
            is_stored: options.store.is_some(),
            history: Mutex::default(),
        }
    }

    /// Notes that a share of the parameter space is done.
    pub fn add_done(&self, share: f64) {
        let units = (share * SHARE_UNIT) as u64;
        self.done.fetch_add(units, Ordering::Relaxed);
    }

    /// Notes that an earlier run has done a share of the parameter space.
    pub fn add_done_before(&self, share: f64) {
        self.add_done(share);
        self.add_before(share);
    }

    /// Notes that what was noted as done is no work that counts: an earlier run did it, or every run does.
    pub fn add_before(&self, share: f64) {
        let units = (share * SHARE_UNIT) as u64;
        self.before.fetch_add(units, Ordering::Relaxed);
    }

    /// Notes what was done before the search as such: what a store had, and what is looked at in every run.
    pub fn all_before(&self) {
        let done = self.done.load(Ordering::Relaxed);
        self.before.store(done, Ordering::Relaxed);
    }

    /// Notes that a share was done in vain: it is of a piece that was not finished, of which a store keeps nothing.
    pub fn add_lost(&self, share: f64) {
        let units = (share.max(0.0) * SHARE_UNIT) as u64;
        self.lost.fetch_add(units, Ordering::Relaxed);
    }

    /// Notes how much was done after so many seconds.
    pub fn note(&self, seconds: f64) {
        if let Ok(mut history) = self.history.lock()
            && history.last().is_none_or(|last| seconds > 1.02 * last[0])
        {
            history.push([seconds, self.fresh()]);
        }
    }

    /// What this run did for good, of all.
    fn fresh(&self) -> f64 {
        self.share_done() - self.lost() - self.share_before()
    }

    fn lost(&self) -> f64 {
        self.lost.load(Ordering::Relaxed) as f64 / SHARE_UNIT
    }

    /// How many seconds the rest may take after so many, if it goes on as it did in the second half of them; infinity where a store keeps
    /// nothing of what was done. `None`: in that half less than a thousandth of the rest was done, so that nothing can be said.
    pub fn seconds_left(&self, seconds: f64) -> Option<f64> {
        // Shares add up but for roundings.
        const NOTHING: f64 = 1e-12;
        // Of less than this part of the rest nothing is told about it.
        const LEAST: f64 = 1e-3;
        let fresh = self.fresh();
        if !(fresh > NOTHING) {
            return self.is_stored.then_some(f64::INFINITY);
        }
        // What is easy is done at once, and says nothing of what is not.
        let history = self.history.lock().ok()?;
        let half = history.iter().rev().find(|[then, _]| 2.0 * then <= seconds);
        let [then, before] = half.copied().unwrap_or_default();
        let left = (1.0 - self.share_done() + self.lost()).max(0.0);
        let gained = fresh - before;
        (gained > LEAST * left).then(|| (seconds - then) * left / gained)
    }

    /// The share that was done before this run.
    pub fn share_before(&self) -> f64 {
        self.before.load(Ordering::Relaxed) as f64 / SHARE_UNIT
    }

    /// The share of the parameter space that is done.
    pub fn share_done(&self) -> f64 {
        // But for roundings, and for what was looked at again for another figure.
        (self.done.load(Ordering::Relaxed) as f64 / SHARE_UNIT).min(1.0)
    }
}
