//! All zeros of a block in a box, by branch and prune.
//!
//! Parts are given up only where a row cannot hold ([`contract`]) or a linear combination of the equations cannot
//! ([`Square::step`]), or where all of the part lies where a zero that is proved is alone ([`Square::is_alone`]). Halves of a part
//! share their border, so that no zero falls between them. The answer is the same for any number of threads: the first
//! parts are made one after the other, and each of them is then searched by itself.

use super::bound::bounds;
use super::contract::{Empty, contract};
use super::newton::{KNOWN, Square, Zero};
use super::system::{Row, System};
use crate::complete::{Part, Why};
use crate::interval::Interval;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// What all searches of a run share.
pub struct Run<'a> {
    /// Set from outside to end the search.
    pub stop: &'a AtomicBool,
    /// Parts looked at.
    pub boxes: &'a AtomicU64,
    /// No more parts than this.
    pub most_boxes: u64,
}

/// What a search found.
#[derive(Debug, Clone, Default)]
pub struct Found {
    /// Zeros, no two the same.
    pub zeros: Vec<Zero>,
    /// What stays undecided, with its share of what was searched.
    pub undecided: Vec<Part>,
}

/// Parts that are searched each by itself.
const PIECES: usize = 64;
/// A part whose unknowns are all known to this much is not halved any more.
pub const SMALL: f64 = 1e-9;
/// The same once that many parts of a piece are undecided.
pub const COARSE: f64 = 1e-3;
/// How many that are.
pub const MANY: usize = 300;
/// Where that many are undecided a piece is given up.
const TOO_MANY: usize = 5000;
/// An unknown that may be as large as this, and more, is not looked at any further.
const HUGE: f64 = (1u64 << 40) as f64;

/// A block and how it is contracted.
pub struct Block<'a> {
    /// The equations with the unknowns.
    pub square: Square<'a>,
    /// The equations, and what follows from them.
    rows: Vec<&'a Row>,
    is_free: Vec<bool>,
}

/// A part of the space, with its share.
type Node = (Vec<Interval>, f64);

impl<'a> Block<'a> {
    /// The block of some equations and unknowns of a system. `is_known`: entries that blocks before have determined.
    pub fn new(
        system: &'a System,
        equations: &[usize],
        own: &[usize],
        is_known: impl Fn(usize) -> bool,
    ) -> Self {
        let mut place = vec![KNOWN; system.unknowns + 1];
        let mut is_free = vec![false; system.unknowns + 1];
        for (k, &u) in own.iter().enumerate() {
            place[u] = k;
            is_free[u] = true;
        }
        let follow = system.rows[system.unknowns..].iter().filter(|row| {
            let mut entries = row.entries.iter();
            entries.clone().any(|&e| is_free[e]) && entries.all(|&e| is_free[e] || is_known(e))
        });
        let own_rows: Vec<&Row> = equations.iter().map(|&e| &system.rows[e]).collect();
        let rows = own_rows.iter().copied().chain(follow).collect();
        Block {
            square: Square {
                rows: own_rows,
                own: own.to_vec(),
                place,
            },
            rows,
            is_free,
        }
    }

    /// Searches a box.
    pub fn search(&self, mut x: Vec<Interval>, run: &Run) -> Found {
        if let Some(ranges) = bounds(&self.square, &x) {
            for (&u, range) in self.square.own.iter().zip(ranges) {
                let both = x[u].intersection(range);
                if both.is_empty() {
                    return Found::default();
                }
                x[u] = both;
            }
        }
        let mut first = Piece::new(self, run);
        let mut nodes: Vec<Node> = vec![(x, 1.0)];
        // Breadth first until there are enough pieces.
        while !nodes.is_empty() && nodes.len() < PIECES {
            let mut next = Vec::new();
            for node in nodes {
                first.visit(node, &mut next);
            }
            nodes = next;
            if run.boxes.load(Ordering::Relaxed) >= run.most_boxes {
                break;
            }
        }
        let searched: Vec<Found> = nodes
            .into_par_iter()
            .map(|node| {
                let mut piece = Piece::new(self, run);
                piece.found.zeros.clone_from(&first.found.zeros);
                let mut stack = vec![node];
                while let Some(node) = stack.pop() {
                    piece.visit(node, &mut stack);
                }
                piece.found
            })
            .collect();
        let mut all = first.found;
        for found in searched {
            for zero in found.zeros {
                add(&mut all.zeros, zero);
            }
            for part in found.undecided {
                leave(&mut all.undecided, part.why, part.count, part.share);
            }
        }
        // Zeros that are neither the same nor apart stay, and are told apart, or not, as figures.
        all.zeros.sort_by(|a, b| {
            let pairs = a.centre.iter().zip(&b.centre);
            let order = pairs.map(|(x, y)| x.total_cmp(y));
            order
                .into_iter()
                .find(|o| o.is_ne())
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        all
    }

    /// The logarithm of the product of all widths.
    pub fn volume(&self, x: &[Interval]) -> f64 {
        let own = self.square.own.iter();
        own.map(|&u| x[u].wid().max(1e-300).ln()).sum()
    }

    /// The unknown to be halved: the one that moves the equations most, each beside what all others move it.
    pub fn widest(&self, x: &[Interval]) -> Choice {
        let square = &self.square;
        let (mut widest, mut unbounded): (f64, Option<usize>) = (0.0, None);
        for &u in &square.own {
            if !x[u].is_common_interval() {
                unbounded.get_or_insert(u);
            } else {
                widest = widest.max(x[u].wid() / (1.0f64).max(x[u].mag()));
            }
        }
        if let Some(u) = unbounded {
            let near = if x[u].inf().is_finite() {
                x[u].inf()
            } else if x[u].sup().is_finite() {
                x[u].sup()
            } else {
                0.0
            };
            // Near first; what is far is looked at only where all others are known well.
            if widest * near.abs() < 1.0 {
                return match near.abs() > HUGE {
                    true => Choice::Huge,
                    false => Choice::Halve(u, f64::INFINITY),
                };
            }
        }
        let mut smear = vec![0.0; square.own.len()];
        for row in &square.rows {
            let mut of = vec![0.0; square.own.len()];
            row.derivatives(x, |entry, slope| {
                if square.place[entry] != KNOWN {
                    of[square.place[entry]] += slope.mag().min(1e6);
                }
            });
            for (k, of) in of.iter_mut().enumerate() {
                let u = square.own[k];
                *of *= match x[u].is_common_interval() {
                    true => x[u].wid(),
                    false => 0.0,
                };
            }
            let sum: f64 = of.iter().sum();
            if sum > 0.0 {
                let pairs = smear.iter_mut().zip(&of);
                pairs.for_each(|(total, of)| *total += of / sum);
            }
        }
        let best = (0..smear.len()).filter(|&k| {
            let x = x[square.own[k]];
            // What is narrow already is not what keeps the part from being decided.
            x.is_common_interval() && x.wid() / (1.0f64).max(x.mag()) > 1e-3 * widest
        });
        let best = best.max_by(|&a, &b| smear[a].total_cmp(&smear[b]));
        match best {
            Some(k) => Choice::Halve(square.own[k], widest),
            None => match unbounded {
                Some(u) => Choice::Halve(u, f64::INFINITY),
                None => Choice::Halve(square.own[0], 0.0),
            },
        }
    }
}

fn add(zeros: &mut Vec<Zero>, zero: Zero) {
    if !zeros.iter().any(|known| known.is_same(&zero)) {
        zeros.push(zero);
    }
}

/// Adds to what is undecided for a reason.
pub fn leave(undecided: &mut Vec<Part>, why: Why, count: u64, share: f64) {
    match undecided.iter_mut().find(|part| part.why == why) {
        Some(part) => {
            part.count += count;
            part.share += share;
        }
        None => undecided.push(Part { why, count, share }),
    }
}

/// A part of a search that goes on by itself.
struct Piece<'s, 'a> {
    block: &'s Block<'a>,
    run: &'s Run<'s>,
    found: Found,
    left: usize,
    is_flexible: bool,
}

impl<'s, 'a> Piece<'s, 'a> {
    fn new(block: &'s Block<'a>, run: &'s Run<'s>) -> Self {
        Piece {
            block,
            run,
            found: Found::default(),
            left: 0,
            is_flexible: false,
        }
    }

    fn leave(&mut self, why: Why, share: f64) {
        self.left += 1;
        leave(&mut self.found.undecided, why, 1, share);
    }

    /// Looks at a part: it is given up, decided, left undecided, or its halves come to the others.
    fn visit(&mut self, (mut x, share): Node, others: &mut Vec<Node>) {
        let run = self.run;
        if run.stop.load(Ordering::Relaxed)
            || self.left > TOO_MANY
            || run.boxes.fetch_add(1, Ordering::Relaxed) >= run.most_boxes
        {
            self.leave(Why::Unfinished, share);
            return;
        }
        if self.decided(&mut x) {
            return;
        }
        let own = &self.block.square.own;
        let least = match self.left > MANY || self.is_flexible {
            true => COARSE,
            false => SMALL,
        };
        let (which, widest) = match self.block.widest(&x) {
            Choice::Halve(u, widest) => (u, widest),
            Choice::Huge => {
                self.leave(Why::Unbounded, share);
                return;
            }
        };
        if widest < least {
            let why = match self.is_flexible || self.block.square.seems_flexible(&x) {
                true => Why::Flexible,
                false => Why::Small,
            };
            self.is_flexible |= why == Why::Flexible;
            self.leave(why, share);
            return;
        }
        debug_assert!(own.contains(&which));
        let Some([low, high]) = halves(x[which]) else {
            self.leave(Why::Small, share);
            return;
        };
        let mut other = x.clone();
        x[which] = low;
        other[which] = high;
        others.push((x, 0.5 * share));
        others.push((other, 0.5 * share));
    }

    /// Whether nothing is left of a part but zeros that are known.
    fn decided(&mut self, x: &mut [Interval]) -> bool {
        let block = self.block;
        let square = &block.square;
        for _ in 0..6 {
            if contract(&block.rows, &block.is_free, x) == Err(Empty) {
                return true;
            }
            if self.found.zeros.iter().any(|zero| square.is_alone(zero, x)) {
                return true;
            }
            let is_bounded = square.own.iter().all(|&u| x[u].is_common_interval());
            if !is_bounded {
                return false;
            }
            let before = block.volume(x);
            let Ok(step) = square.step(x) else {
                return true;
            };
            if step.defect < 2.0
                && let Some(zero) = square.prove(x)
            {
                let is_it = square.is_alone(&zero, x);
                add(&mut self.found.zeros, zero);
                if is_it {
                    return true;
                }
            }
            // Worth another round where a good part of the box is gone.
            if block.volume(x) > before - 0.7 {
                return false;
            }
        }
        false
    }
}

/// What is done with a part that is not decided.
pub enum Choice {
    /// This unknown is halved; and how wide the widest range is, beside its size.
    Halve(usize, f64),
    /// An unknown may be as large as it likes.
    Huge,
}

/// Two ranges that share a border and together are the range.
fn halves(x: Interval) -> Option<[Interval; 2]> {
    use crate::interval::checked;
    let middle = match (x.inf().is_finite(), x.sup().is_finite()) {
        (true, true) => x.mid(),
        (true, false) => (2.0 * x.inf()).max(1.0),
        (false, true) => (2.0 * x.sup()).min(-1.0),
        (false, false) => 0.0,
    };
    if !(x.inf() < middle && middle < x.sup()) {
        return None;
    }
    Some([checked(x.inf(), middle)?, checked(middle, x.sup())?])
}

/// The range that a zero has, made a little wider than its box by rounding.
pub fn ranges(zero: &Zero) -> impl Iterator<Item = Interval> + '_ {
    (0..zero.centre.len()).map(|k| zero.range(k))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::hull;

    #[test]
    fn halves_leave_nothing_out() {
        use super::super::contract::{entire, upper_half};
        for x in [entire(), upper_half(), hull(-1.0, 3.0), -upper_half()] {
            let [low, high] = halves(x).unwrap();
            assert_eq!(low.sup(), high.inf());
            assert_eq!(low.convex_hull(high), x);
        }
        assert!(halves(hull(1.0, 1.0f64.next_up())).is_none());
    }
}
