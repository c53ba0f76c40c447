//! The cover of the space of coordinates, for the check.
//!
//! The search's own parts are not written down: the space is parted once more, with what the check does to a part, so that what is
//! said of each part is what the check will find. The search before has found the figures, and says which unknown to halve.

use super::newton::Square;
use super::search::{Block as Searched, Choice, SMALL};
use super::system::System;
use crate::blocks::Block as Cut;
use crate::certificate::cover::coordinates::{
    Block, Change, CoordinateCover, Half, Image, Mark, Part, Space,
};
use crate::interval::{Interval, ZERO};
use crate::problem::Problem;
use crate::system::Homotopy;
use std::sync::atomic::{AtomicBool, Ordering};

/// Where that many parts are undecided, parts are not halved any more below [`COARSE`].
const MANY: usize = 300;
/// How well all unknowns are known then.
const COARSE: f64 = 1e-3;
/// A block that narrows a part by less than this, in the logarithm of its volume, is not worth a mark.
const WORTH: f64 = 0.7;

/// The same where the block has one zero in the part.
const SLOW: f64 = 0.01;
/// Images by more changes of sign of lines and planes of their own, in all sums, are not looked for.
const MOST_TWINS: usize = 8;

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
    /// For each block those that it needs, directly or not.
    pub needs: Vec<Vec<usize>>,
    /// The parts of the search.
    pub boxes: u64,
}

/// The cover, as a file; `None` where the check's test proves a figure less than the search's did.
pub fn file(
    problem: &Problem,
    (homotopy, system): (&Homotopy, &System),
    results: Results,
    stop: &AtomicBool,
) -> Option<Vec<u8>> {
    let block = |block: &Cut| Block {
        equations: block.equations.clone(),
        unknowns: block.unknowns.clone(),
    };
    let mut cover = CoordinateCover {
        unit_exponent: homotopy.unit.log2() as i32,
        problem: problem.to_toml(),
        halves: results.halves,
        blocks: results.blocks.iter().map(block).collect(),
        figures: results.figures,
        images: Vec::new(),
        others: results.others,
        marks: Vec::new(),
    };
    let counts = [homotopy.equations, cover.figures.len(), cover.others.len()];
    if counts.iter().any(|&count| count > Mark::MOST) {
        return None;
    }
    // As the check reads it.
    let problem = Problem::parse(&cover.problem, "").ok()?;
    let mut space = Space::new(&problem, &cover).ok()?;
    let blocks = results.blocks.iter().zip(&results.needs);
    let blocks = blocks.map(|(block, needs)| {
        let known: Vec<usize> = needs
            .iter()
            .flat_map(|&need| &results.blocks[need].unknowns)
            .copied()
            .collect();
        Searched::new(system, &block.equations, &block.unknowns, |u| {
            known.contains(&u) || u == system.unknowns
        })
    });
    let whole = space.whole();
    let mut writer = Writer {
        homotopy,
        space: &mut space,
        cover: &mut cover,
        blocks: blocks.collect(),
        marks: Vec::new(),
        left: 0,
        parts: 0,
        // The check's rules are about as strong as the search's.
        most: 4 * results.boxes + 10_000,
        stop,
    };
    let mut stack = vec![(whole, 0)];
    while let Some((mut part, block)) = stack.pop() {
        writer.parts += 1;
        if writer.space.narrow(&mut part).is_ok() {
            writer.go(part, block, &mut stack);
        }
    }
    let marks = writer.marks;
    cover.marks = marks;
    Some(cover.to_bytes())
}

struct Writer<'a> {
    homotopy: &'a Homotopy,
    space: &'a mut Space,
    cover: &'a mut CoordinateCover,
    blocks: Vec<Searched<'a>>,
    marks: Vec<u8>,
    /// Parts undecided, and all.
    left: usize,
    parts: u64,
    most: u64,
    stop: &'a AtomicBool,
}

impl Writer<'_> {
    fn put(&mut self, mark: Mark) {
        mark.put(&mut self.marks);
    }

    fn leave(&mut self) {
        self.left += 1;
        self.put(Mark::Undecided);
    }

    /// Says why a part holds no figure but those listed, all blocks before this one being known well in it.
    fn go(&mut self, mut part: Part, mut b: usize, stack: &mut Vec<(Part, usize)>) {
        loop {
            if let Some(mark) = self.space.zero_of(&part) {
                return self.put(mark);
            }
            let is_over = self.parts > self.most || self.stop.load(Ordering::Relaxed);
            let Some(block) = self.blocks.get(b).filter(|_| !is_over) else {
                return match self.image_in(&part).filter(|_| !is_over) {
                    Some(mark) => self.put(mark),
                    None => self.leave(),
                };
            };
            let square = &block.square;
            let before = ranges(&part);
            let is_bounded = |x: &[Interval]| square.own.iter().all(|&u| x[u].is_common_interval());
            if !is_bounded(&before) {
                let saved = part.clone();
                if self.space.bound(b, &mut part).is_err() {
                    return Mark::Bound(b).put(&mut self.marks);
                }
                if is_bounded(&ranges(&part)) {
                    Mark::Bound(b).put(&mut self.marks);
                    continue;
                }
                part = saved;
            }
            if is_bounded(&before) {
                let (mark, saved) = (self.marks.len(), part.clone());
                Mark::Block(b).put(&mut self.marks);
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
                self.marks.truncate(mark);
                if is_known {
                    b += 1;
                    continue;
                }
            }
            let least = if self.left > MANY { COARSE } else { SMALL };
            let halves = match block.widest(&before) {
                Choice::Halve(u, widest) if widest >= least => {
                    part.halved(u).map(|parts| (u, parts))
                }
                _ => None,
            };
            let Some((u, [low, high])) = halves else {
                return self.leave();
            };
            self.put(Mark::Halves(u));
            stack.extend([(high, b), (low, b)]);
            return;
        }
    }
}

impl Writer<'_> {
    /// Lists the zero in a part as an image of a solution, if it is one.
    fn image_in(&mut self, part: &Part) -> Option<Mark> {
        let m = self.homotopy.equations;
        let first = self.homotopy.gauge.place.len();
        let twins = &self.homotopy.tail.twins;
        if twins.len() > MOST_TWINS {
            return None;
        }
        let bits = |mask: usize, count: usize| -> Vec<usize> {
            (0..count).filter(|k| mask >> k & 1 == 1).collect()
        };
        let near: Vec<f64> = part.ranges().iter().map(|x| x.mid()).collect();
        let size = near.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        for axes in 0..1usize << self.homotopy.dimension {
            for mask in 0..1usize << twins.len() {
                let by = Change {
                    axes: bits(axes, self.homotopy.dimension),
                    twins: bits(mask, twins.len()),
                };
                let turned = |i: usize| {
                    let of_axes = by.axes.iter().filter(|&&k| self.homotopy.flips(i, k));
                    let of_twins = by.twins.iter();
                    let of_twins = of_twins.filter(|&&k| i >= first && twins[k][i - first]);
                    (of_axes.count() + of_twins.count()) % 2 == 1
                };
                let image: Vec<f64> = (0..m)
                    .map(|i| if turned(i) { -near[i] } else { near[i] })
                    .collect();
                let is_near = |at: &Vec<f64>| {
                    let mut pairs = at.iter().zip(&image);
                    pairs.all(|(a, b)| (a - b).abs() <= 1e-6 * size)
                };
                for figure in 0..self.cover.figures.len() {
                    if !is_near(&self.cover.figures[figure]) {
                        continue;
                    }
                    let image = Image {
                        figure,
                        by: by.clone(),
                    };
                    let is_new = self.cover.images.len() < Mark::MOST;
                    if is_new && self.space.see(&image).is_ok() {
                        self.cover.images.push(image);
                    }
                    // What was added is of use, or not.
                    if let Some(mark) = self.space.zero_of(part) {
                        return Some(mark);
                    }
                }
            }
        }
        None
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
