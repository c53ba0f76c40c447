//! The cover of the space of coordinates, for the check.
//!
//! The search's own parts are not written down: the space is parted once more, with what the check does to a part, so that what is
//! said of each part is what the check will find. The search before has found the figures, and says which unknown to halve.

use super::newton::Square;
use super::search::{Block as Searched, COARSE, MANY, SMALL};
use super::sides::MOST as MOST_REDUCED;
use crate::blocks::Block as Cut;
use crate::certificate::cover::coordinates::{
    Block, Body, Case, Change, CoordinateCover, Half, Mark, Part, Space, Turn, Turned,
};
use crate::interval::{Interval, ZERO};
use crate::model::Margin;
use crate::problem::Problem;
use crate::system::Homotopy;
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A block that narrows a part by less than this, in the logarithm of its volume, is not worth a mark.
const WORTH: f64 = 0.7;
/// The same where the block has one zero in the part.
const SLOW: f64 = 0.01;
/// Boxes of rotations of which no range is wider are looked at for one figure.
const NEAR: f64 = 0.06;
/// In boxes of rotations as narrow as this in which linear equations do not tell the body's place a coordinate of that is halved, too.
const FINE: f64 = 0.05;

/// What the search found.
pub struct Results<'a> {
    /// About where each figure is.
    pub figures: Vec<Vec<f64>>,
    /// Zeros that are no figures, exactly.
    pub others: Vec<Vec<f64>>,
    /// What may be taken as not negative.
    pub halves: Vec<Half>,
    /// The blocks, each of which needs only blocks before it.
    pub blocks: &'a [Cut],
    /// The same, as the search has them.
    pub searched: Vec<Searched<'a>>,
    /// For each block the body on legs that it is, if it was searched over how that is turned.
    pub bodies: Vec<Option<Body>>,
    /// The unknowns that parts have in common, where the equations fall apart.
    pub base: Vec<usize>,
    /// What the equations fall apart into, for each zero of the base that figures have; none where they do not.
    pub cases: Vec<Case>,
    /// The parts of the search.
    pub boxes: u64,
}

/// What is still to be looked at.
enum Open {
    /// A part, the block that is next in it, and whether that block's body was turned.
    Part(Part, usize, bool),
    /// A box of rotations of the body of a block, for the figures in a part.
    Turn(Rc<Part>, usize, Turn),
}

/// The cover, as a file; `None` where the check's test is too coarse for a figure.
pub fn file(
    problem: &Problem,
    homotopy: &Homotopy,
    results: Results,
    stop: &AtomicBool,
) -> Option<Vec<u8>> {
    let block = |block: &Cut| Block {
        equations: block.equations.clone(),
        unknowns: block.unknowns.clone(),
    };
    let mut cover = CoordinateCover {
        unit_exponent: homotopy.unit.log2() as i16,
        problem: problem.without_limits().to_toml(),
        halves: results.halves,
        blocks: results.blocks.iter().map(block).collect(),
        figures: results.figures,
        bodies: results.bodies.iter().flatten().cloned().collect(),
        images: Vec::new(),
        others: results.others,
        base: results.base,
        cases: results.cases,
        marks: Vec::new(),
    };
    let counts = [homotopy.equations, cover.figures.len(), cover.others.len()];
    if counts.iter().any(|&count| count > Mark::MOST) {
        return None;
    }
    // As the check reads it.
    let problem = Problem::parse(&cover.problem, "").ok()?;
    let mut space = Space::new(&problem, &cover).ok()?;
    let mut number = 0;
    let bodies = results.bodies.iter().map(|body| {
        body.as_ref()?;
        number += 1;
        Some(number - 1)
    });
    let mut writer = Writer {
        homotopy,
        space: &mut space,
        cover: &mut cover,
        blocks: results.searched,
        bodies: bodies.collect(),
        left: 0,
        parts: 0,
        // The check does not construct unknowns, and may need ten times as many parts.
        most: 40 * results.boxes + 20_000,
        stop,
    };
    for slice in writer.space.slices() {
        writer.space.look_at(slice);
        let mut stack = vec![Open::Part(writer.space.whole(), 0, false)];
        while let Some(open) = stack.pop() {
            writer.parts += 1;
            match open {
                Open::Part(mut part, block, is_turned) => {
                    if writer.space.narrow(&mut part).is_ok() {
                        writer.go(part, (block, is_turned), &mut stack);
                    }
                }
                Open::Turn(part, block, turn) => writer.turn(part, block, turn, &mut stack),
            }
        }
    }
    Some(cover.to_bytes())
}

struct Writer<'a> {
    homotopy: &'a Homotopy,
    space: &'a mut Space,
    cover: &'a mut CoordinateCover,
    blocks: Vec<Searched<'a>>,
    /// For each block the number of its body in the cover.
    bodies: Vec<Option<usize>>,
    /// Parts undecided, and all.
    left: usize,
    parts: u64,
    most: u64,
    stop: &'a AtomicBool,
}

impl Writer<'_> {
    fn put(&mut self, mark: Mark) {
        mark.put(&mut self.cover.marks);
    }

    fn leave(&mut self) {
        self.left += 1;
        self.put(Mark::Undecided);
    }

    /// Says why a part holds no figure but those listed, all blocks before this one being known well in it.
    fn go(&mut self, mut part: Part, (mut b, mut is_turned): (usize, bool), stack: &mut Vec<Open>) {
        loop {
            if let Some(mark) = self.space.zero_of(&part) {
                return self.put(mark);
            }
            let is_over = self.is_over();
            if let Some(&Some(body)) = self.bodies.get(b)
                && !is_turned
                && !is_over
                && self.space.stands(body, &part)
            {
                self.put(Mark::Body(body));
                let part = Rc::new(part);
                let charts = Turn::all().into_iter().rev();
                stack.extend(charts.map(|turn| Open::Turn(Rc::clone(&part), b, turn)));
                return;
            }
            if !is_turned && !is_over && !part.is_reduced(b) && self.is_reducible(b) {
                self.put(Mark::Reduced(b));
                if self.space.reduce(b, &mut part).is_err() {
                    return;
                }
                let mut equations = self.blocks[b].equations.iter();
                let sides = equations.find_map(|&e| Some((e, self.space.sides(e, &part)?)));
                let Some((e, parts)) = sides else { continue };
                self.put(Mark::Sides(e));
                let parts = parts.into_iter().rev();
                stack.extend(parts.map(|part| Open::Part(part, b, is_turned)));
                return;
            }
            let Some(block) = self.blocks.get(b).filter(|_| !is_over) else {
                return match self.image_in(&part).filter(|_| !is_over) {
                    Some(mark) => self.put(mark),
                    None => self.leave(),
                };
            };
            let square = &block.square;
            let before = ranges(&part);
            let unbounded = |x: &[Interval]| {
                let own = square.own.iter();
                own.filter(|&&u| !x[u].is_common_interval()).count()
            };
            if unbounded(&before) > 0 {
                let saved = part.clone();
                if self.space.bound(b, &mut part).is_err() {
                    return Mark::Bound(b).put(&mut self.cover.marks);
                }
                if unbounded(&ranges(&part)) < unbounded(&before) {
                    Mark::Bound(b).put(&mut self.cover.marks);
                    continue;
                }
                part = saved;
            }
            if unbounded(&before) == 0 {
                let (mark, saved) = (self.cover.marks.len(), part.clone());
                Mark::Block(b).put(&mut self.cover.marks);
                if self.space.narrow_together(b, &mut part).is_err() {
                    return;
                }
                let gained = block.volume(&before) - block.volume(&ranges(&part));
                let is_known = gained < WORTH && is_known(square, &before);
                // Near a zero the ranges become narrow ever faster.
                if gained > if is_known { SLOW } else { WORTH } {
                    continue;
                }
                part = saved;
                self.cover.marks.truncate(mark);
                if is_known {
                    (b, is_turned) = (b + 1, false);
                    continue;
                }
            }
            let least = if self.left > MANY { COARSE } else { SMALL };
            let halves = match block.widest(&before) {
                Some((u, widest)) if widest >= least => part.halved(u).map(|parts| (u, parts)),
                _ => None,
            };
            let Some((u, [low, high])) = halves else {
                return self.leave();
            };
            self.put(Mark::Halves(u));
            stack.extend([high, low].map(|part| Open::Part(part, b, is_turned)));
            return;
        }
    }

    /// Whether a block is looked at in exact numbers.
    fn is_reducible(&self, b: usize) -> bool {
        let block = self.blocks.get(b);
        block.is_some_and(|block| block.square.own.len() <= MOST_REDUCED)
    }

    fn is_over(&self) -> bool {
        self.parts > self.most || self.stop.load(Ordering::Relaxed)
    }

    /// Says why a box of rotations of a block's body holds no figure but those listed.
    fn turn(&mut self, part: Rc<Part>, b: usize, mut turn: Turn, stack: &mut Vec<Open>) {
        let Some(&Some(body)) = self.bodies.get(b) else {
            return self.leave_turned();
        };
        while let Some(look) = self.space.look(body, &part, &turn) {
            let Some(left) = look.left(Margin::None) else {
                return;
            };
            let widths = turn.ranges().iter().map(|x| x.wid());
            let widest = widths.clone().take(3).fold(0.0, f64::max);
            let least = if self.left > MANY { COARSE } else { SMALL };
            if self.is_over() || widest < least {
                return self.leave_turned();
            }
            if widest < NEAR && look.is_told() {
                let placed = self.space.placed(body, &part, &look);
                let Some(Ok(mut near)) = placed else {
                    return self.put_turned(Turned::Part);
                };
                let given = near.clone();
                let is_clear = self.space.narrow(&mut near).is_err()
                    || self.space.zero_of(&near).is_some()
                    || is_known(&self.blocks[b].square, &ranges(&near));
                if is_clear {
                    self.put_turned(Turned::Part);
                    return stack.push(Open::Part(given, b, true));
                }
            }
            let kept: f64 = turn
                .ranges()
                .iter()
                .zip(&left)
                .map(|(_, u)| 0.5 * (u.hi - u.lo))
                .product();
            if kept < 0.3
                && let Some(narrowed) = turn.within(&left)
            {
                self.put_turned(Turned::Narrowed);
                turn = narrowed;
                continue;
            }
            if let Some(axis) = look.untold
                && widest < FINE
                && let Some(higher) = self.space.with_height(body, &turn, axis)
            {
                self.put_turned(Turned::Height(axis));
                turn = higher;
                continue;
            }
            // The coordinate of the place beside its size at the most.
            let size = |i: usize| if i == 3 { self.space.reach(body) } else { 1.0 };
            let sizes: Vec<f64> = widths.enumerate().map(|(i, x)| x / size(i)).collect();
            let i = (0..sizes.len()).max_by(|&i, &j| sizes[i].total_cmp(&sizes[j]));
            let halves = i.and_then(|i| Some((i, turn.halved(i)?)));
            let Some((i, [low, high])) = halves else {
                return self.leave_turned();
            };
            self.put_turned(Turned::Halves(i));
            let halves = [high, low].map(|turn| Open::Turn(Rc::clone(&part), b, turn));
            stack.extend(halves);
            return;
        }
    }

    fn put_turned(&mut self, mark: Turned) {
        mark.put(&mut self.cover.marks);
    }

    fn leave_turned(&mut self) {
        self.left += 1;
        self.put_turned(Turned::Undecided);
    }

    /// Lists the zero in a part as an image of a solution, if it is one.
    fn image_in(&mut self, part: &Part) -> Option<Mark> {
        let axes = self.homotopy.dimension;
        let twins = self.homotopy.tail.twins.len();
        let place = self.cover.images.len();
        if twins > Change::MOST_TWINS || place == Mark::MOST {
            return None;
        }
        let image = Change::all(axes, twins).find_map(|by| self.space.image_in(&by, part))?;
        self.space.see(&image).ok()?;
        self.cover.images.push(image);
        Some(Mark::Image(place))
    }
}

/// Whether a block has one zero in a part, and all of the part lies where that is alone.
fn is_known(square: &Square, x: &[Interval]) -> bool {
    let zero = square.prove(x);
    zero.is_some_and(|zero| square.is_alone(&zero, x))
}

/// The ranges of a part as the search has them: the unknowns, and the number 0.
fn ranges(part: &Part) -> Vec<Interval> {
    part.ranges().iter().copied().chain([ZERO]).collect()
}
