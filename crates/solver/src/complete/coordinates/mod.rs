//! All figures of any problem, over all coordinates: for other constraints than distances, and where no plan serves.
//!
//! The equations are the kernel's ([`Homotopy`]) with t = 1: as many as unknowns, all quadratic. They are cut into blocks that
//! need only blocks before ([`crate::blocks::Blocks`]); each block is searched on every side of its equations ([`sides`]) by branch and prune ([`search`]) for
//! each choice of zeros of those before, whose numbers are known up to small ranges: what is proved holds for all numbers in these. What
//! comes of all blocks is proved to be a figure in all unknowns at once, by the test that runs along paths use, and told apart
//! from the others as solutions of a path are.
//!
//! # Why nothing is missed
//!
//! A figure is what `solve` calls one: a zero of the equations with t = 1 at which lengths and radii are positive and no vector
//! vanishes that must not. Let X be one. Some image of it under the symmetries of the problem has no negative pivot
//! ([`symmetry`]); take that for X. Its numbers in the first block are a zero of the block's equations, so they are in a part of the
//! search that is never given up: in the end in one that is undecided, or they are the zero proved there. In that case the numbers of
//! the next block are a zero of its equations with the numbers before in their ranges; and so on. Where all blocks have come to zeros,
//! the box of these holds X and no other zero, and lies where the figure proved is alone: X is that figure.

mod bound;
mod construction;
mod contract;
mod cover;
mod expanded;
mod far;
mod independent;
mod kept;
mod newton;
mod oriented;
mod piece;
mod poses;
mod ranged;
mod scaled;
mod search;
mod sides;
mod sums;
mod symmetry;
mod system;
mod tally;
mod test;

use super::outcome::{Method, too_long};
use super::search::Run as Watched;
use super::spare::make_square;
use super::store::{Keep, Store};
use super::targets::Targets;
use super::{Complete, Constructed, Options, Part, Status, Unserved, Why, emptiness};
use crate::blocks::{Block as Cut, Blocks, LeftOut};
use crate::certificate::cover::coordinates::{Body, Empty, Half};
use crate::interval::{Interval, ZERO, hull, point, upper_half};
use crate::order::InOrder;
use crate::places::Each as _;
use crate::problem::Problem;
use crate::system::told::{self, Told};
use crate::system::{GaugeError, Held, Homotopy, typical_length};
use crate::track::certified::{Relation, prove_figure};
use crate::track::{FigureBox, Signed, Signs, Solution};
use contract::contract;
use independent::Parts;
use kept::Kept;
use oriented::Oriented;
use poses::Poses;
pub use ranged::ranged;
use search::{Block, Found, Run, ranges};
pub(super) use search::{leave, leave_all};
use sides::Sides;
use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;
use system::System;
use test::Test;

/// Bounds of the distances of all pairs are taken where there are no more points than this.
const MOST_POINTS: usize = 60;
/// Figures that are looked at, at most.
const MOST_FIGURES: usize = 5000;
/// A bound of a distance beyond this is none.
const FAR: f64 = 1e30;

/// Searches for all figures of a problem, up to its symmetries.
pub fn all(problem: &Problem, options: &Options) -> Result<Complete, Unserved> {
    let begin = Instant::now();
    let homotopy =
        square(problem).map_err(|error| Unserved::Refused(format!("not served: {error}")))?;
    if !homotopy.spare.is_empty() && (options.cover || options.store.is_some()) {
        let what = "not served: of more equations than unknowns there is no certificate, and no store (--cert, --store)";
        return Err(Unserved::Refused(what.to_owned()));
    }
    let system = System::new(&homotopy);
    let held = homotopy.held(problem).map_err(|object| {
        Unserved::Refused(format!(
            "not served: in which direction `{}` is fixed is not certain (name two fixed points of it instead)",
            problem.objects[object].name
        ))
    })?;
    let stop = AtomicBool::new(false);
    let run = Watched::new(&stop, options, false);
    let store = options.opened(problem, false)?;
    let result = options.watched(&run, begin, || {
        searched(
            problem,
            (&homotopy, system, held),
            (&run, store),
            options,
            begin,
        )
    });
    result.map_err(Unserved::Store)
}

/// Whether a problem, which need not be well constrained, has more equations than unknowns and enough that say something new, so that
/// [`all`](super::all) searches those that do and tests the figures against the others.
pub fn has_equations_to_spare(problem: &Problem) -> bool {
    square(problem).is_ok_and(|homotopy| !homotopy.spare.is_empty())
}

/// The equations of a problem, without those that are more than unknowns.
fn square(problem: &Problem) -> Result<Homotopy, GaugeError> {
    let unit = typical_length(problem);
    Homotopy::for_sets_without(problem, unit, |lowered, gauge, sketch| {
        make_square(lowered, problem, gauge, sketch, unit)
    })
}

fn searched(
    problem: &Problem,
    (homotopy, mut system, held): (&Homotopy, System, Vec<Held>),
    (run, store): (&Watched, Option<(&Keep, Store<Found>)>),
    options: &Options,
    begin: Instant,
) -> Result<Complete, String> {
    let mut reason = None;
    // Bounds that follow from distances are those of figures that have them all.
    let has_all = homotopy.spare.is_empty();
    if has_all && !problem.distances.is_empty() && problem.points.len() <= MOST_POINTS {
        let targets = Targets::new(problem);
        reason = emptiness::too_long(&targets).map(|(edge, way)| too_long(problem, edge, &way));
        bound_pairs(&mut system, homotopy, &targets);
    }
    let mut result = Complete::empty(problem, String::new(), begin);
    result.reason = reason.clone();
    result.method = Method::Coordinates;
    result.driving = homotopy.equations;
    result.symmetry = crate::constraint::symmetry(problem);
    result.both_ways = both_ways(problem, homotopy);
    if reason.is_some() {
        return Ok(result);
    }
    if !problem.orientations.is_empty() {
        let wanted = Signs::of(problem);
        system.oriented = Some(Oriented::new(
            wanted,
            &system,
            homotopy,
            problem.points.len(),
        ));
    }
    let blocks = blocks(&system);
    let halves = symmetry::halves(problem, (homotopy, &held), &blocks);
    let pivots: Vec<usize> = halves.iter().map(|half| half.unknown).collect();
    let positive = pivots.iter().copied().chain(homotopy.positive_unknowns());
    let positive = positive.map(|i| (i, upper_half()));
    let (x, space) = space(&system, positive.chain(ranges_of(&held)));
    let kept = match store {
        Some((keep, store)) => Some(Kept::new(store, keep, (problem, &x), run.stop)?),
        None => None,
    };
    let mut figures = Figures::new(
        problem,
        (homotopy, held),
        (&system, blocks),
        run,
        kept.as_ref(),
    );

    if space.is_ok() {
        let done = run.done.load(Ordering::Relaxed);
        // Signs are of the figure as a whole.
        if problem.orientations.is_empty() {
            figures.parts = figures.fall_apart(&x, &pivots);
        }
        match &figures.parts {
            Some(parts) => figures.found.clone_from(&parts.listed),
            None => {
                // What is known by now is counted where it is asked for again.
                if kept.is_none() && !run.stop.load(Ordering::Relaxed) {
                    run.done.store(done, Ordering::Relaxed);
                }
                let begin = State {
                    x,
                    told: Told::default(),
                    chosen: Vec::new(),
                };
                figures.go(0, begin, 1.0);
            }
        }
    }
    result.solutions = solutions(homotopy, &figures.found);
    result.signed = Signed::cut(figures.cut);
    let bodies = figures.bodies.iter().flatten();
    result.turned = bodies
        .map(|body| problem.objects[body.object].name.clone())
        .collect();
    result.boxes = run.boxes.load(Ordering::Relaxed);
    result.constructed = figures.constructed;
    if options.cover {
        result.cover = figures.cover(problem, halves);
    }
    let undecided = figures.undecided;
    result.status = Status::of(&undecided);
    result.undecided = undecided;
    for part in &mut result.undecided {
        // But for roundings.
        part.share = part.share.min(1.0);
    }
    result.undecided.order_by_key(|part| part.why);
    if result.status == Status::Complete && result.solutions.is_empty() {
        result.reason = Some(
            "no figure meets the constraints: every part of the space of coordinates is excluded"
                .to_owned(),
        );
    }
    result.count = match &figures.parts {
        Some(parts) => {
            result.first_choice = parts.first_choice(problem, homotopy);
            result.choices = parts.choices(problem, homotopy);
            parts.count
        }
        None => Some(result.solutions.len() as u64),
    };
    if !homotopy.spare.is_empty() {
        let test = Test {
            problem,
            homotopy,
            tolerance: options.redundant_tolerance,
        };
        let accounts = figures.found.iter().map(|figure| test.account(figure));
        let accounts: Vec<Vec<LeftOut>> = accounts.collect();
        result.strike_out(
            problem,
            [homotopy.equations, homotopy.spare.len()],
            test.names(),
            accounts,
        );
        if let Some(tested) = &mut result.tested {
            tested.what = "equations";
        }
    }
    kept.map_or(Ok(()), Kept::end)?;
    result.seconds = begin.elapsed().as_secs_f64();
    result.tell_what_is_left(run);
    Ok(result)
}

/// The unknowns that are held, and where.
fn ranges_of(held: &[Held]) -> impl Iterator<Item = (usize, Interval)> {
    held.iter().map(|held| (held.unknown, held.range))
}

/// The ranges of all unknowns, and the number 0, in which figures are searched of which some unknowns are in these.
fn space(
    system: &System,
    ranges: impl Iterator<Item = (usize, Interval)>,
) -> (Vec<Interval>, Result<(), Empty>) {
    let m = system.unknowns;
    let mut x = vec![Interval::ENTIRE; m + 1];
    x[m] = ZERO;
    for (i, range) in ranges {
        x[i] = x[i].intersection(range);
    }
    let mut is_free = vec![true; m + 1];
    is_free[m] = false;
    let rows: Vec<_> = system.rows.iter().collect();
    let space = contract(&rows, &is_free, &mut x);
    (x, space)
}

/// The lines and planes of their own, by name, whose two directions constraints tell apart.
fn both_ways(problem: &Problem, homotopy: &Homotopy) -> Vec<String> {
    let is_fixed = |object: &usize| problem.fixed_directions().any(|fixed| fixed == *object);
    let directed = homotopy.directed(|_| true).into_iter();
    let names = directed.filter(|object| !is_fixed(object));
    names
        .map(|object| problem.objects[object].name.clone())
        .collect()
}

/// The blocks of a system, each of which needs only blocks before it.
fn blocks(system: &System) -> Vec<Cut> {
    let m = system.unknowns;
    let rows = system.rows[..m].iter();
    let equations: Vec<Vec<usize>> = rows.map(|row| row.entries.clone()).collect();
    match Blocks::new(&equations, m) {
        Ok(blocks) => blocks.blocks,
        // Singular whatever the numbers are: one block, of which nothing will be proved.
        Err(_) => vec![Cut {
            equations: (0..m).collect(),
            unknowns: (0..m).collect(),
            needs: Vec::new(),
        }],
    }
}

/// Adds the bounds of the distances of all pairs that follow from the distances given.
fn bound_pairs(system: &mut System, homotopy: &Homotopy, targets: &Targets) {
    let pairs = targets.pairs();
    // Both units are powers of two.
    let scale = targets.unit / homotopy.unit;
    let scale = scale * scale;
    let entry = system.coordinates(homotopy);
    for a in 0..targets.points {
        for b in 0..a {
            let [least, most] = pairs.squares(a, b).each(|x| x * scale);
            if targets.edge(a, b).is_none() && most < FAR {
                let ends = (0..homotopy.dimension).map(|axis| [entry(a, axis), entry(b, axis)]);
                system.bound(&ends.collect::<Vec<_>>(), hull(least, most));
            }
        }
    }
}

/// The figures, block by block.
struct Figures<'a> {
    problem: &'a Problem,
    homotopy: &'a Homotopy,
    /// What figures have a sign of from the sketch, and the ranges in which unknowns are sought.
    held: Vec<Held>,
    /// For each block the body on legs that it is, if it was searched over how that is turned.
    bodies: Vec<Option<Body>>,
    system: &'a System,
    run: &'a Watched<'a>,
    /// Where pieces of the search are kept.
    kept: Option<&'a Kept<'a>>,
    blocks: Vec<Cut>,
    /// For each block those that it needs, directly or not.
    ancestors: Vec<BTreeSet<usize>>,
    /// What was found of a block, by the zeros of its ancestors.
    known: HashMap<(usize, Vec<(usize, usize)>), Rc<Found>>,
    found: Vec<FigureBox>,
    /// Zeros in which a vector vanishes that must not, exactly.
    others: Vec<Vec<f64>>,
    undecided: Vec<Part>,
    /// Parts given up as a sign is wrong all over them.
    cut: u64,
    /// Where the equations fall apart, what comes of that.
    parts: Option<Parts>,
    /// The largest construction by which a block was searched.
    constructed: Option<Constructed>,
}

/// Where blocks are.
#[derive(Clone)]
struct State {
    /// Their unknowns' ranges, and the number 0.
    x: Vec<Interval>,
    /// What is known exactly.
    told: Told,
    /// The blocks that were solved, and which zero each has.
    chosen: Vec<(usize, usize)>,
}

/// What a zero of all equations is.
enum Judged {
    /// A figure.
    Figure(Box<FigureBox>),
    /// None, as a vector vanishes that must not, or a length is not positive; and where exactly it is, if that is known.
    Other(Option<Vec<f64>>),
    /// Neither is certain.
    Undecided(Why),
}

impl<'a> Figures<'a> {
    fn new(
        problem: &'a Problem,
        (homotopy, held): (&'a Homotopy, Vec<Held>),
        (system, blocks): (&'a System, Vec<Cut>),
        run: &'a Watched<'a>,
        kept: Option<&'a Kept<'a>>,
    ) -> Self {
        let mut ancestors: Vec<BTreeSet<usize>> = Vec::new();
        for block in &blocks {
            let mut all: BTreeSet<usize> = block.needs.iter().copied().collect();
            for &need in &block.needs {
                all.extend(&ancestors[need]);
            }
            ancestors.push(all);
        }
        Figures {
            problem,
            homotopy,
            held,
            bodies: vec![None; blocks.len()],
            system,
            run,
            kept,
            blocks,
            ancestors,
            known: HashMap::new(),
            found: Vec::new(),
            others: Vec::new(),
            undecided: Vec::new(),
            cut: 0,
            parts: None,
            constructed: None,
        }
    }

    /// All figures of the blocks from this one on, with those before where they are. `share`: of what is searched.
    fn go(&mut self, b: usize, state: State, share: f64) {
        if self.found.len() >= MOST_FIGURES {
            leave(&mut self.undecided, Why::GivenUp, 1, share);
            return;
        }
        if self.run.stop.load(Ordering::Relaxed) {
            // Thousands of figures are put together of few parts.
            leave(&mut self.undecided, Why::Unfinished, 1, share);
            return;
        }
        let is_wrong = |signs: &Oriented| signs.is_wrong(&state.x);
        if b > 0 && self.system.oriented.as_ref().is_some_and(is_wrong) {
            self.cut += 1;
            let after = self.blocks[b..].iter().map(|block| self.weight(block));
            return self.run.add_done(share * after.sum::<f64>());
        }
        if b == self.blocks.len() {
            self.finish(&state.x, share);
            return;
        }
        let found = self.solve(b, &state, share);
        let each = self.share_out(&found, share);
        if found.zeros.is_empty() {
            // Nor is anything to be searched after.
            let after = self.blocks[b + 1..].iter().map(|block| self.weight(block));
            self.run.add_done(each * after.sum::<f64>());
        }
        for k in 0..found.zeros.len() {
            let mut state = state.clone();
            self.take(b, (&found, k), &mut state);
            self.go(b + 1, state, each);
        }
    }

    /// Leaves open what a block's search left so, of a share of what is searched; what of the share comes to each of its zeros, in equal parts.
    fn share_out(&mut self, found: &Found, share: f64) -> f64 {
        leave_all(&mut self.undecided, &found.undecided, share);
        let open: f64 = found.undecided.iter().map(|part| part.share).sum();
        share * (1.0 - open).max(0.0) / found.zeros.len().max(1) as f64
    }

    /// Narrows a state to a zero of a block.
    fn take(&self, b: usize, (found, k): (&Found, usize), state: &mut State) {
        let own = self.blocks[b].unknowns.iter();
        for (&u, range) in own.zip(ranges(&found.zeros[k])) {
            state.x[u] = range;
        }
        if let Some(values) = found.exact.get(k) {
            let mut ranges = state.x.clone();
            for (u, value) in values.iter() {
                ranges[*u] = ranges[*u].intersection(told::range(value));
            }
            // What is not in the zero's box is not its value.
            if !ranges.iter().any(|range| range.is_empty()) {
                state.told.learn(values.iter().cloned());
                state.x = ranges;
            }
        }
        state.chosen.push((b, k));
    }

    /// For each entry whether the blocks that a block needs have determined it.
    fn is_known(&self, b: usize) -> Vec<bool> {
        let m = self.system.unknowns;
        let mut is_known = vec![false; m + 1];
        is_known[m] = true;
        for &a in &self.ancestors[b] {
            for &u in &self.blocks[a].unknowns {
                is_known[u] = true;
            }
        }
        is_known
    }

    /// A block, with what those that it needs have determined.
    fn block(&self, b: usize) -> Block<'a> {
        let is_known = self.is_known(b);
        let block = &self.blocks[b];
        Block::new(self.system, &block.equations, &block.unknowns, |u| {
            is_known[u]
        })
    }

    /// What a block is of all searching, about.
    fn weight(&self, block: &Cut) -> f64 {
        block.unknowns.len() as f64 / self.system.unknowns as f64
    }

    /// The zeros of a block with those before chosen. `share`: of what is searched.
    fn solve(&mut self, b: usize, State { x, told, chosen }: &State, share: f64) -> Rc<Found> {
        let weight = share * self.weight(&self.blocks[b]);
        let before = chosen.iter().copied();
        let before: Vec<(usize, usize)> = before
            .filter(|(c, _)| self.ancestors[b].contains(c))
            .collect();
        let key = (b, before);
        if let Some(found) = self.known.get(&key) {
            self.run.add_done(weight);
            return Rc::clone(found);
        }
        let found = match self.whose(&key.1) {
            Some(is_whole) => {
                let run = Run {
                    watched: self.run,
                    weight,
                    kept: self.kept,
                    is_whole,
                };
                let block = self.block(b);
                let poses = Poses::of(self.problem, self.homotopy, &self.blocks[b], x);
                let mut found = match poses {
                    Some(poses) => {
                        self.bodies[b] = Some(poses.body.clone());
                        poses.search(&block, x, &run)
                    }
                    None => {
                        let (whole, homotopy) = (&block, self.homotopy);
                        let sides = Sides {
                            whole,
                            homotopy,
                            run: &run,
                        };
                        let is_known = self.is_known(b);
                        sides.search(told.of(|u| is_known[u]), x.clone())
                    }
                };
                if is_whole {
                    found.pieces.fill(None);
                }
                found
            }
            None => Found::missing(1.0),
        };
        self.constructed = self.constructed.max(found.constructed);
        self.cut += found.cut;
        let found = Rc::new(found);
        self.known.insert(key, Rc::clone(&found));
        found
    }

    /// How a block that needs these zeros is searched where others share the search: all of it, if a piece of this share had one of
    /// them; the pieces of this share, if all who share the search find them; not at all (`None`), if others do it.
    fn whose(&self, before: &[(usize, usize)]) -> Option<bool> {
        if self.kept.is_none_or(|kept| kept.keep.is_all()) {
            return Some(false);
        }
        let mut is_whole = false;
        for (k, &(c, zero)) in before.iter().enumerate() {
            // What a block needs comes before it, and is needed by all that need it.
            let needed = before[..k].iter().copied();
            let needed: Vec<(usize, usize)> = needed
                .filter(|(a, _)| self.ancestors[c].contains(a))
                .collect();
            let found = self.known.get(&(c, needed))?;
            match (found.pieces[zero], self.kept) {
                (Some(piece), Some(kept)) if kept.keep.is_mine(piece) => is_whole = true,
                (Some(_), Some(_)) => return None,
                _ => {}
            }
        }
        Some(is_whole)
    }

    /// The box of one zero of all equations: what figure it is.
    fn judge(&self, x: &[Interval]) -> Judged {
        let m = self.system.unknowns;
        let near: Vec<f64> = x[..m].iter().map(|x| x.mid()).collect();
        let Ok(figure) = prove_figure(self.homotopy, &near, false) else {
            return Judged::Undecided(Why::Small);
        };
        let is_it = (0..m).all(|i| {
            let middle = point(figure.figure.centre[i]) + point(figure.figure.low[i]);
            (x[i] - middle).mag() < figure.alone_within
        });
        if !is_it {
            return Judged::Undecided(Why::Small);
        }
        match self.is_proper(&figure) {
            Some(true) => Judged::Figure(Box::new(figure)),
            Some(false) => Judged::Other(self.exact(&figure).map(|mut exact| {
                exact.pop();
                exact
            })),
            None => {
                let mut held = self.held.iter();
                let is_border = held.any(|held| {
                    let x = figure.figure.enclosure(held.unknown);
                    held.admits(x).is_none()
                });
                Judged::Undecided(if is_border {
                    Why::Border
                } else {
                    Why::Vanishing
                })
            }
        }
    }

    /// Adds what comes of one zero of all equations.
    fn finish(&mut self, x: &[Interval], share: f64) {
        let figure = match self.judge(x) {
            Judged::Figure(figure) => *figure,
            Judged::Other(exact) => return self.others.extend(exact),
            Judged::Undecided(why) => return leave(&mut self.undecided, why, 1, share),
        };
        for known in &self.found {
            match figure.relation(known, self.homotopy) {
                Relation::Different => {}
                Relation::Congruent => return,
                Relation::Unknown => {
                    leave(&mut self.undecided, Why::Apart, 1, share);
                    return;
                }
            }
        }
        self.found.push(figure);
    }

    /// The cover of the space, for the check.
    fn cover(&self, problem: &Problem, halves: Vec<Half>) -> Option<Vec<u8>> {
        let parts = self.parts.as_ref();
        let figures = parts.map_or(&self.found, |parts| &parts.representatives);
        let figures = figures.iter();
        let results = cover::Results {
            figures: figures.map(|found| found.figure.centre.clone()).collect(),
            base: parts.map(|parts| parts.base.clone()).unwrap_or_default(),
            cases: parts.map(Parts::told).unwrap_or_default(),
            others: self.others.clone(),
            halves,
            blocks: &self.blocks,
            bodies: self.bodies.clone(),
            searched: (0..self.blocks.len()).map(|b| self.block(b)).collect(),
            boxes: self.run.boxes.load(Ordering::Relaxed),
        };
        cover::file(problem, self.homotopy, results, self.run.stop)
    }

    /// The unknowns of a figure, and the number 0, if numbers of few digits in its box meet all equations exactly, without any
    /// rounding: then the figure, of which the box has one, is they.
    fn exact(&self, figure: &FigureBox) -> Option<Vec<f64>> {
        const PARTS: f64 = (1u64 << 20) as f64;
        let m = self.system.unknowns;
        let mut near: Vec<f64> = Vec::with_capacity(m + 1);
        for i in 0..m {
            let x = (figure.figure.centre[i] * PARTS).round() / PARTS;
            near.push(figure.figure.enclosure(i).contains(x).then_some(x)?);
        }
        near.push(0.0);
        let at: Vec<Interval> = near.iter().map(|&x| point(x)).collect();
        let mut rows = self.system.rows[..m].iter();
        rows.all(|row| row.value(&at) == ZERO).then_some(near)
    }

    /// Whether lengths and radii are positive, what is fixed has its sign, unknowns are in their ranges and no vector vanishes that must not, if that is certain.
    fn is_proper(&self, figure: &FigureBox) -> Option<bool> {
        let at = |i: usize| match i < self.system.unknowns {
            true => figure.figure.enclosure(i),
            false => ZERO,
        };
        let mut is_certain = true;
        for held in &self.held {
            match held.admits(at(held.unknown)) {
                Some(false) => return Some(false),
                is_in => is_certain &= is_in.is_some(),
            }
        }
        for i in self.homotopy.positive_unknowns() {
            if at(i).sup() <= 0.0 {
                return Some(false);
            }
            is_certain &= at(i).inf() > 0.0;
        }
        if let Some(exact) = self.exact(figure) {
            // All is known exactly.
            let at = |i: usize| exact[i];
            let positive = self.homotopy.positive_unknowns();
            let vectors = self.homotopy.nonzero_vectors();
            let is_there = |vector: &Vec<[usize; 2]>| {
                let end = |i: usize| i.min(self.system.unknowns);
                vector.iter().any(|&[i, j]| at(end(i)) != at(end(j)))
            };
            let mut held = self.held.iter();
            let is_held = held.try_fold(true, |all, held| {
                Some(all & held.admits(point(at(held.unknown)))?)
            });
            let is_positive = positive.iter().all(|&i| at(i) > 0.0);
            return match is_positive && vectors.iter().all(is_there) {
                true => is_held,
                false => Some(false),
            };
        }
        for vector in self.homotopy.nonzero_vectors() {
            let coordinates = || {
                vector.iter().map(|&[i, j]| match i == j {
                    true => ZERO,
                    false => at(i) - at(j),
                })
            };
            if coordinates().all(|x| x == ZERO) {
                return Some(false);
            }
            is_certain &= coordinates().any(|x| !x.contains(0.0));
        }
        is_certain.then_some(true)
    }
}

/// Figures in the order in which they were found, each a class of its own.
pub(super) fn solutions(homotopy: &Homotopy, found: &[FigureBox]) -> Vec<Solution> {
    let figures = found.iter().enumerate();
    let figures = figures.map(|(class, figure)| {
        let points = figure.points(homotopy);
        let objects = homotopy.locate(&points, &|i| figure.figure.enclosure(i));
        Solution::located(points, objects, class)
    });
    figures.collect()
}
