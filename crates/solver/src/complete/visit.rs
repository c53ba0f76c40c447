//! One part of the search space looked at: points are placed one after the other until an equation excludes the
//! part, a figure is proved, or the part has to be parted.

use super::coordinates::{leave, leave_all};
use super::cover::Marks;
use super::newton::prove;
use super::node::{MAX_SYMBOLS, Node, Sign};
use super::outcome::Part;
use super::place::{Placed, place};
use super::search::Search;
use crate::certificate::cover::Figure;
use crate::certificate::cover::construct::{Place, beside, determinant, squared_distance};
use crate::certificate::cover::{Left, Mark};
use crate::model::{Margin, Model, Range, contract};
use crate::places::Each as _;
use crate::track::Stand;
use serde::{Deserialize, Serialize};
use std::any::Any;

/// Why a part stays undecided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Why {
    /// A curve of figures goes through it, as far as floats see.
    Flexible,
    /// It is as small as parts may be: a figure that is singular or nearly so, or points in line.
    Small,
    /// The search was ended before.
    Unfinished,
    /// Too many parts near it stay undecided.
    GivenUp,
    /// Figures in it are not told apart.
    Apart,
    /// It goes on without an end: an unknown may be as large as it likes.
    Unbounded,
    /// A figure of which a sign that is asked for cannot be told.
    Sign,
    /// Whether a figure has a vector that must not vanish, or a length that must be positive, is not certain.
    Vanishing,
    /// A solution at the end of a range that an unknown is to be in, or so near to it that it may be out of it.
    Border,
}

/// What visits find.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Found {
    /// Figures proved, maybe several times.
    pub figures: Vec<Figure>,
    /// Parts undecided, by reasons.
    pub undecided: Vec<Part>,
    /// Parts looked at.
    pub boxes: u64,
    /// Parts given up as a sign is wrong all over them.
    pub cut: u64,
    /// The cover, if it is wanted.
    pub marks: Marks,
}

/// Coordinates must be known to this much of the unit of length before figures are looked for.
const NEAR: f64 = 3e-3;
/// A point whose remainder exceeds this is not known well enough to go on from it.
const BLURRED: f64 = 0.2;
/// A height becomes a symbol if the two places are at most this far apart.
const FOLD: f64 = 0.35;
/// A part is looked at anew where the equations leave less than this of it.
const SHRUNK: f64 = 0.3;

impl Found {
    /// Nothing was found so far; with the cover, if it is wanted.
    pub fn begun(cover: bool) -> Self {
        let mut found = Found::default();
        if cover {
            found.marks = Marks::wanted();
        }
        found
    }

    /// Nothing was looked at, of such a share.
    pub fn missing(cover: bool, share: f64) -> Self {
        let mut found = Found::begun(cover);
        found.leave(share, Why::Unfinished);
        found
    }

    /// Notes a part that stays undecided.
    pub fn leave(&mut self, share: f64, why: Why) {
        self.marks.put(Mark::Undecided, 0);
        leave(&mut self.undecided, why, 1, share);
    }

    /// What was found in parts, one after the other.
    pub fn together(parts: Vec<Found>) -> Found {
        let mut parts = parts.into_iter();
        let mut found = parts.next().unwrap_or_default();
        parts.for_each(|part| found.append(part));
        found
    }

    /// Adds what was found in parts that come after.
    pub fn append(&mut self, mut other: Found) {
        self.figures.append(&mut other.figures);
        leave_all(&mut self.undecided, &other.undecided, 1.0);
        self.boxes += other.boxes;
        self.cut += other.cut;
        self.marks.append(other.marks);
    }
}

/// What visits keep from one to the next: for each number of symbols the part that was looked at last, with the points
/// that stand in it.
///
/// Parts that are looked at one after the other have much in common: where one is halved in the symbol of a later
/// step, the points before stand as they did. Where a point stands depends on the ranges of the symbols and the signs that
/// its step and those before use, and on nothing else, so that what is kept is what would be computed again.
#[derive(Default)]
pub struct Rooms([Option<Box<dyn Any + Send>>; MAX_SYMBOLS + 1]);

/// What is kept of parts with up to S symbols.
struct Room<const S: usize, const M: usize> {
    /// The part.
    node: Node,
    /// So many steps of the plan stand in it, each in one place, and excluded nothing.
    standing: usize,
    points: Vec<Place<S, M>>,
    /// The equations of the steps that stand.
    equations: Vec<Model<S, M>>,
    /// How many of them come before each step.
    before: Vec<usize>,
    /// Room for the elimination.
    rows: Vec<Model<S, M>>,
}

impl<const S: usize, const M: usize> Room<S, M> {
    fn new(search: &Search, node: &Node) -> Self {
        let mut points = vec![[Model::ZERO; 3]; search.targets.points];
        for (&p, place) in search.plan.base.iter().zip(&search.base) {
            points[p] = [0, 1, 2].each(|k| Model::constant(place[k]));
        }
        Room {
            node: node.clone(),
            standing: 0,
            points,
            equations: Vec::with_capacity(8),
            before: vec![0; search.plan.steps.len() + 1],
            rows: Vec::new(),
        }
    }

    /// How many steps put their points in this part where they stand already.
    fn shared(&self, search: &Search, node: &Node) -> usize {
        let symbol = |i: usize| {
            let half = |node: &Node| (node.halves >> i) & 1;
            let old = &self.node;
            (old.lo[i], old.hi[i], half(old)) == (node.lo[i], node.hi[i], half(node))
        };
        let same = |step: &usize| {
            let driven = search.plan.steps[*step].kind.parameters().all(symbol);
            let index = search.signed[*step];
            let sided = index == usize::MAX || {
                let sign = node.sign(index);
                let folded = || symbol(node.fold_symbol(search.plan.parameters(), index));
                sign == self.node.sign(index) && (sign != Some(Sign::Fold) || folded())
            };
            driven && sided
        };
        (0..self.standing).take_while(same).count()
    }
}

/// A part being looked at, of up to S symbols.
struct Visit<'a, const S: usize, const M: usize> {
    search: &'a Search,
    node: Node,
    room: &'a mut Room<S, M>,
    /// Whether a point has two places at present.
    branched: bool,
    found: &'a mut Found,
    children: &'a mut Vec<Node>,
}

/// Looks at a part and adds to `children` those that it is parted into. The `rooms` are of the same search.
pub fn visit(
    search: &Search,
    node: Node,
    rooms: &mut Rooms,
    found: &mut Found,
    children: &mut Vec<Node>,
) {
    found.boxes += 1;
    let run = match node.symbols {
        0 | 1 => Visit::<1, 3>::run,
        2 => Visit::<2, 6>::run,
        3 => Visit::<3, 10>::run,
        4 => Visit::<4, 15>::run,
        _ => Visit::<6, 28>::run,
    };
    run(search, node, rooms, found, children);
}

impl<'a, const S: usize, const M: usize> Visit<'a, S, M> {
    fn run(
        search: &'a Search,
        node: Node,
        rooms: &'a mut Rooms,
        found: &'a mut Found,
        children: &'a mut Vec<Node>,
    ) {
        let room = rooms.0[S].get_or_insert_with(|| Box::new(Room::<S, M>::new(search, &node)));
        let room: &mut Room<S, M> = room.downcast_mut().expect("the size is that of the place");
        room.standing = room.shared(search, &node);
        room.node = node.clone();
        let step = room.standing;
        let mut visit = Visit {
            search,
            node,
            room,
            branched: false,
            found,
            children,
        };
        visit.go(step);
    }

    /// How many symbols there are.
    fn symbols(&self) -> usize {
        self.node.symbols as usize
    }

    /// Notes what is found of the part.
    fn mark(&mut self, mark: Mark) {
        let symbols = self.symbols();
        self.found.marks.put(mark, symbols);
    }

    /// Places the points from `step` on, the signs of the steps before being decided.
    fn go(&mut self, step: usize) {
        let search = self.search;
        if !self.branched {
            self.room.standing = step;
        }
        if step == search.plan.steps.len() {
            return self.finish();
        }
        match place(search, &self.node, step, &self.room.points) {
            Placed::Here(here) => self.stand(step, here, None),
            Placed::Folded(here, equation) => self.stand(step, here, Some(equation)),
            Placed::None => self.mark(Mark::NoPlace(step)),
            Placed::Either(places, height) => {
                self.mark(Mark::Sides(step));
                self.node.share *= 0.5;
                let already = std::mem::replace(&mut self.branched, true);
                for sign in [Sign::Plus, Sign::Minus] {
                    self.node.decide(sign);
                    let factor = if sign == Sign::Plus { 1.0 } else { -1.0 };
                    let here = beside(search.targets.dimension, &places, factor, &height);
                    self.stand(step, here, None);
                    self.node.forget();
                }
                self.branched = already;
                self.node.share *= 2.0;
            }
            Placed::Near {
                height,
                far,
                square,
            } => {
                let index = search.signed[step];
                let room = (self.node.symbols as usize) < MAX_SYMBOLS.min(search.most_symbols);
                if far < FOLD && room {
                    let range = match self.node.sign(index) {
                        Some(Sign::Plus) => [0.0, height],
                        Some(Sign::Minus) => [-height, 0.0],
                        _ => [-height, height],
                    };
                    self.mark(Mark::Fold(step, range));
                    let k = search.plan.parameters();
                    self.children.push(self.node.folded(k, index, range));
                } else {
                    self.part(step, false, movers(&[square]));
                }
            }
            Placed::Degenerate(width) => self.part(step, false, movers(&[width])),
        }
    }

    /// Puts the point of `step` in its place, with the equation of its fold, and looks at what that means for the equations.
    fn stand(&mut self, step: usize, here: Place<S, M>, fold: Option<Model<S, M>>) {
        let search = self.search;
        let (now, d) = (&search.plan.steps[step], search.targets.dimension);
        let blur = here
            .iter()
            .map(|x| x.rest())
            .fold(0.0, crate::interval::rounding::largest);
        if !(blur <= BLURRED) {
            return self.part(step, true, movers(&here));
        }
        let room = &mut *self.room;
        room.points[now.point] = here;
        let before = room.before[step];
        room.equations.truncate(before);
        room.equations.extend(fold);
        for (place, &e) in now.closing.iter().enumerate() {
            let [a, b] = search.targets.edges[e];
            let square = squared_distance(d, &room.points[a], &room.points[b]);
            let equation = square.shifted(search.squares[e].negative());
            if equation.range().misses_zero(1.0) {
                return self.mark(Mark::WrongDistance(step, place));
            }
            room.equations.push(equation);
        }
        room.before[step + 1] = room.equations.len();
        if let Some(other) = self.wrong_pair(step) {
            return self.mark(Mark::WrongPair(step, other));
        }
        if self.has_wrong_sign(step) {
            self.found.cut += 1;
            return;
        }
        if self.room.equations.len() > before {
            let mut u = [Range::SYMBOL; S];
            let room = &mut *self.room;
            if contract(&room.equations, &mut room.rows, &mut u, Margin::Some).is_err() {
                return self.mark(Mark::Excluded(step));
            }
            let last = step + 1 == search.plan.steps.len();
            if self.shrink(step, &u, if last { 0.5 } else { SHRUNK }, last) {
                return;
            }
        }
        self.go(step + 1);
    }

    /// A point that all over the part is nearer to or farther from the one of `step` than they are in any figure.
    fn wrong_pair(&self, step: usize) -> Option<usize> {
        let d = self.search.targets.dimension;
        let here = &self.room.points[self.search.plan.steps[step].point];
        let wrong = |&&(other, [least, most]): &&(usize, [f64; 2])| {
            let there = &self.room.points[other];
            // Where the middle of the part is in order, the whole is not wrong.
            let off = (0..d).map(|k| (here[k].middle() - there[k].middle()).powi(2));
            let middle: f64 = off.sum();
            if least <= middle && middle <= most {
                return false;
            }
            let range = squared_distance(d, here, there).range();
            range.lo > most + 1e-9 || range.hi < least - 1e-9
        };
        let found = self.search.pairs[step].iter().find(wrong);
        found.map(|pair| pair.0)
    }

    /// Whether all figures in the part have a wrong sign, as far as their points stand.
    fn has_wrong_sign(&self, step: usize) -> bool {
        let points = &self.room.points;
        let d = self.search.targets.dimension;
        let sign = |simplex: &[usize]| determinant(d, points, simplex).range().sign(1.0);
        self.search.signs[step].stand(sign) == Stand::Wrong
    }

    /// Goes on with a smaller part, if what the equations leave is small enough.
    fn shrink(&mut self, step: usize, u: &[Range; S], enough: f64, last: bool) -> bool {
        let left: f64 = u.iter().map(|x| 0.5 * (x.hi - x.lo)).product();
        // A part this small is for the proof of a figure.
        if !(left < enough) || last && self.reach() < NEAR {
            return false;
        }
        let mut child = self.node.clone();
        let mut all = [Left::default(); MAX_SYMBOLS];
        for i in 0..self.symbols() {
            let (middle, reach) = self.node.middle(i);
            // A little more than what is left, so that who checks it comes to less.
            let at = |x: f64, out: f64| middle + reach * (x + out * 1e-6);
            let low = at(u[i].lo, -1.0).next_down().next_down();
            let high = at(u[i].hi, 1.0).next_up().next_up();
            all[i] = Left::holding([child.lo[i], child.hi[i]], [low, high]);
            [child.lo[i], child.hi[i]] = all[i].range;
        }
        child.depth = child.depth.saturating_add(1);
        self.mark(Mark::Within(step, all));
        self.children.push(child);
        true
    }

    /// How far any coordinate may be from the middle of the models.
    fn reach(&self) -> f64 {
        let all = self.room.points.iter().flatten().map(|x| x.reach());
        all.fold(0.0, crate::interval::rounding::largest)
    }

    /// All points stand.
    fn finish(&mut self) {
        let search = self.search;
        let step = search.plan.steps.len().wrapping_sub(1);
        let reach = self.reach();
        if reach < NEAR || self.symbols() == 0 {
            let guess: Vec<[f64; 3]> = self
                .room
                .points
                .iter()
                .map(|p| [0, 1, 2].each(|k| p[k].middle()))
                .collect();
            match prove(&search.frame, &guess) {
                Some(figure) if self.is_alone(&figure) => {
                    self.mark(Mark::Figure);
                    self.found.figures.push(figure);
                    return;
                }
                None if self.node.depth.is_multiple_of(4) && search.flexes(&guess) => {
                    return self.found.leave(self.node.share, Why::Flexible);
                }
                _ => {}
            }
        }
        let weights = movers(self.room.points.iter().flatten());
        self.part(step, true, weights);
    }

    /// Whether all figures of this part lie where this one is alone.
    fn is_alone(&self, figure: &Figure) -> bool {
        // Of the same figure, found once more, the check may know a little less, or more.
        let limit = 0.8 * figure.alone;
        let points = self.room.points.iter();
        let near = |p: &Model<S, M>, at: f64| (p.middle() - at).abs() + p.reach() < limit;
        points
            .zip(&figure.centre)
            .all(|(p, at)| (0..self.search.targets.dimension).all(|k| near(&p[k], at[k])))
    }

    /// Parts this part in the symbol of the greatest weight, the signs of the steps up to this one
    /// being kept (`with` it or without).
    fn part(&mut self, step: usize, with: bool, weights: [f64; S]) {
        let search = self.search;
        let mut best: Option<(usize, f64)> = None;
        for i in 0..self.symbols() {
            let width = self.node.hi[i] - self.node.lo[i];
            let least = search.least_width * (1.0 + self.node.lo[i].abs());
            let weight = if weights[i].is_finite() {
                weights[i]
            } else {
                width
            };
            if width > least && best.is_none_or(|(_, w)| weight > w) {
                best = Some((i, weight));
            }
        }
        let Some((symbol, _)) = best else {
            return self.found.leave(self.node.share, Why::Small);
        };
        self.mark(Mark::Halves(step, with, symbol));
        self.children.extend(self.node.parted(symbol));
    }
}

/// How much each symbol bends these functions, and a little of how much it moves them.
fn movers<'m, const S: usize, const M: usize>(
    models: impl IntoIterator<Item = &'m Model<S, M>>,
) -> [f64; S] {
    let mut weights = [0.0; S];
    for model in models {
        model.weigh(&mut weights);
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A part that the search did not come to has no boxes, and must not be lost among those that have.
    #[test]
    fn what_is_undecided_stays_so_beside_what_is_done() {
        let part = |undecided: bool| {
            let mut found = Found::begun(true);
            if undecided {
                found.leave(0.5, Why::Unfinished);
            } else {
                found.boxes = 7;
                found.marks.put(Mark::Excluded(0), 0);
            }
            found
        };
        for order in [[true, false], [false, true]] {
            let found = Found::together(order.map(part).into());
            let undecided = Part {
                why: Why::Unfinished,
                count: 1,
                share: 0.5,
            };
            assert_eq!((found.undecided, found.boxes), (vec![undecided], 7));
            assert_eq!(found.marks.bytes(), Some(2));
        }
    }

    /// What a search that is ended leaves comes after thousands of small parts, and is nearly all of the space.
    #[test]
    fn no_share_and_no_reason_is_lost_among_thousands_of_parts() {
        const MANY: u64 = 12_288;
        let mut found = Found::default();
        for _ in 0..MANY {
            found.leave(1e-9, Why::Small);
        }
        found.leave(0.5, Why::Unfinished);
        let mut more = Found::default();
        more.leave(0.25, Why::Unfinished);
        found.append(more);
        let [small, unfinished] = &found.undecided[..] else {
            panic!("{found:?}")
        };
        assert_eq!((unfinished.count, unfinished.share), (2, 0.75));
        assert!((small.share - 1e-9 * MANY as f64).abs() < 1e-12);
        assert_eq!(small.count, MANY);
    }
}
