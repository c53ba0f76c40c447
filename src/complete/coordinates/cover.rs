//! The cover of the space of coordinates, for the check.
//!
//! The search's own parts are not written down: the space is parted once more, with what the check does to a part, so that what is
//! said of each part is what the check will find. The search before has found the figures, and says which unknown to halve.

use super::newton::Square;
use super::search::{Block as Searched, COARSE, Choice, MANY, SMALL};
use crate::blocks::Block as Cut;
use crate::certificate::cover::coordinates::{
    Block, Change, CoordinateCover, Half, Mark, Part, Space,
};
use crate::interval::{Interval, ZERO};
use crate::problem::Problem;
use crate::system::Homotopy;
use std::sync::atomic::{AtomicBool, Ordering};

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
    /// The same, as the search has them.
    pub searched: Vec<Searched<'a>>,
    /// The parts of the search.
    pub boxes: u64,
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
    let mut stack = vec![(space.whole(), 0)];
    let mut writer = Writer {
        homotopy,
        space: &mut space,
        cover: &mut cover,
        blocks: results.searched,
        left: 0,
        parts: 0,
        // The check's rules are about as strong as the search's.
        most: 4 * results.boxes + 10_000,
        stop,
    };
    while let Some((mut part, block)) = stack.pop() {
        writer.parts += 1;
        if writer.space.narrow(&mut part).is_ok() {
            writer.go(part, block, &mut stack);
        }
    }
    Some(cover.to_bytes())
}

struct Writer<'a> {
    homotopy: &'a Homotopy,
    space: &'a mut Space,
    cover: &'a mut CoordinateCover,
    blocks: Vec<Searched<'a>>,
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
                    return Mark::Bound(b).put(&mut self.cover.marks);
                }
                if is_bounded(&ranges(&part)) {
                    Mark::Bound(b).put(&mut self.cover.marks);
                    continue;
                }
                part = saved;
            }
            if is_bounded(&before) {
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

    /// Lists the zero in a part as an image of a solution, if it is one.
    fn image_in(&mut self, part: &Part) -> Option<Mark> {
        let axes = self.homotopy.dimension;
        let twins = self.homotopy.tail.twins.len();
        let place = self.cover.images.len();
        if twins > MOST_TWINS || place == Mark::MOST {
            return None;
        }
        let bits = |mask: usize, count: usize| -> Vec<usize> {
            (0..count).filter(|k| mask >> k & 1 == 1).collect()
        };
        let image = (0..1usize << (axes + twins)).find_map(|mask| {
            let by = Change {
                axes: bits(mask, axes),
                twins: bits(mask >> axes, twins),
            };
            self.space.image_in(&by, part)
        })?;
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
