//! A part of a search that goes on by itself, and how one of its parts is looked at.

use super::construction::{Leaf, Order, walk};
use super::contract::{contract, contract_near};
use super::far::far;
use super::search::{Block, Run};
use super::system::{Row, relative_width};
use super::tally::Tally;
use crate::certificate::cover::coordinates::Empty;
use crate::complete::Why;
use crate::interval::{Interval, halves};

/// The rows that narrow parts, the block's equations and sums of these among them, and in which order its unknowns are constructed,
/// if they are.
pub type How<'s> = (&'s [&'s Row], Option<&'s Order>);

/// A part of the space.
#[derive(Debug, Clone)]
pub struct Node {
    /// The ranges of all entries.
    pub x: Vec<Interval>,
    /// Its share.
    pub share: f64,
    fresh: Fresh,
}

/// What became narrower since rows were gone through.
#[derive(Debug, Clone, Copy)]
enum Fresh {
    All,
    One(usize),
    None,
}

/// What is worth another round: where a part of the box as large as this is gone, by the logarithm of its volume.
const WORTH: f64 = 0.7;
/// How often a part is narrowed before it is halved.
const ROUNDS: usize = 6;
/// Unknowns that are constructed are looked at together where all are known to this much, beside their size.
const NEAR: f64 = 0.03;
/// After so many parts of a piece its unknowns are not constructed any more.
const PATIENCE: u64 = 20_000;
/// An unknown is not halved where its range is this part of the widest.
const NARROW: f64 = 1e-6;

impl Node {
    /// All of a space.
    pub fn whole(x: Vec<Interval>) -> Self {
        Node {
            x,
            share: 1.0,
            fresh: Fresh::All,
        }
    }
}

/// A part of a search that goes on by itself.
pub struct Piece<'s, 'a> {
    block: &'s Block<'a>,
    rows: &'s [&'s Row],
    order: Option<&'s Order>,
    /// What was found in it.
    pub tally: Tally<'s>,
    /// Why the last part that a curve of zeros was seen in stays undecided: nothing is gained by small parts there.
    curve: Option<Why>,
    /// How many unknowns were variables at once in the parts before, where unknowns are constructed.
    symbols: usize,
}

impl<'s, 'a> Piece<'s, 'a> {
    /// Nothing was looked at.
    pub fn new(block: &'s Block<'a>, (rows, order): How<'s>, run: &'s Run<'s>) -> Self {
        Piece {
            block,
            rows,
            order,
            tally: Tally::new(run, block.square.has_ranges),
            curve: None,
            symbols: 0,
        }
    }

    /// Notes that a curve of zeros was seen.
    pub fn has_curve(&mut self) {
        self.curve = Some(Why::Flexible);
        self.tally.is_flexible = true;
    }

    /// Looks at a part: it is given up, decided, left undecided, or what it is parted into comes to the others.
    pub fn visit(&mut self, mut node: Node, others: &mut Vec<Node>) {
        if !self.tally.begin(node.share) {
            return;
        }
        let order = self.order.filter(|_| self.tally.found.boxes <= PATIENCE);
        if let Some(order) = order {
            self.construct(order, node, others);
        } else if self.decide(&mut node.x).is_err() {
            self.tally.done(node.share);
        } else {
            self.halve(node.x, node.share, None, others);
        }
    }

    /// Halves a part in an unknown, where one is named, or in that which moves the equations most; or leaves it undecided.
    fn halve(
        &mut self,
        mut x: Vec<Interval>,
        share: f64,
        named: Option<usize>,
        others: &mut Vec<Node>,
    ) {
        if self
            .block
            .oriented
            .as_ref()
            .is_some_and(|signs| signs.is_wrong(&x))
        {
            self.tally.found.cut += 1;
            return self.tally.done(share);
        }
        let least = self.tally.least(self.curve.is_some());
        let Some((which, widest)) = self.block.widest(&x) else {
            return self.tally.leave(Why::Unbounded, share);
        };
        if widest < least {
            let why = match self.curve {
                Some(Why::Flexible) => Why::Flexible,
                _ => self.block.curve(&x).unwrap_or(Why::Small),
            };
            if why != Why::Small {
                self.curve = Some(why);
                self.tally.is_flexible |= why == Why::Flexible;
            }
            self.tally.leave(why, share);
            return;
        }
        let is_wide = |u: &usize| relative_width(x[*u]) > NARROW * widest;
        let mut wanted = named.filter(is_wide).into_iter().chain([which]);
        let parts = wanted.find_map(|u| Some((u, halves(x[u])?)));
        let Some((which, [low, high])) = parts else {
            self.tally.leave(Why::Small, share);
            return;
        };
        assert!(self.block.square.own.contains(&which));
        let mut other = x.clone();
        x[which] = low;
        other[which] = high;
        others.extend([x, other].map(|x| Node {
            x,
            share: 0.5 * share,
            fresh: Fresh::One(which),
        }));
    }

    /// Looks at a part by constructing the unknowns.
    fn construct(&mut self, order: &Order, mut node: Node, others: &mut Vec<Node>) {
        let Ok(is_bounded) = self.narrow(&mut node) else {
            return self.tally.done(node.share);
        };
        if !is_bounded {
            return self.halve(node.x, node.share, None, others);
        }
        let leaves = loop {
            match walk(self.symbols, order, &self.block.square.rows, &node.x) {
                Some(leaves) => break leaves,
                None => self.symbols += 1,
            }
        };
        if leaves.is_empty() {
            return self.tally.done(node.share);
        }
        let share = node.share / leaves.len() as f64;
        let before = self.block.volume(&node.x);
        for mut leaf in leaves {
            if self.settle(&mut leaf).is_err() {
                self.tally.done(share);
            } else if self.block.volume(&leaf.x) < before - WORTH {
                others.push(Node {
                    x: leaf.x,
                    share,
                    fresh: Fresh::None,
                });
            } else {
                self.halve(leaf.x, share, leaf.halve, others);
            }
        }
    }

    /// Narrows a part by one row after the other before its unknowns are constructed: whether all of them are bounded. Where one was halved, only rows near it,
    /// and no sums of rows: that is what costs most. It is empty, too, where a zero that is known is the only one.
    fn narrow(&mut self, node: &mut Node) -> Result<bool, Empty> {
        let block = self.block;
        let (square, x) = (&block.square, &mut node.x);
        match node.fresh {
            Fresh::All => contract(self.rows, &block.is_free, x)?,
            Fresh::One(u) => contract_near(&block.rows, &block.is_free, u, x)?,
            Fresh::None => {}
        }
        for _ in 0..ROUNDS {
            if self.tally.is_known(square, x) {
                return Err(Empty);
            }
            if square.is_bounded(x) {
                return Ok(true);
            }
            contract(self.rows, &block.is_free, x)?;
            if !far(self.rows, &block.is_free, x)? {
                break;
            }
        }
        Ok(square.is_bounded(x))
    }

    /// Narrows a leaf by all equations together, where it is small or is all that is left. It is empty, too, where it has no zeros but such as are known.
    fn settle(&mut self, leaf: &mut Leaf) -> Result<(), Empty> {
        let own = self.block.square.own.iter();
        let widths = own.map(|&u| relative_width(leaf.x[u]));
        let is_near = widths.fold(0.0, f64::max) < NEAR;
        let is_all = leaf.is_whole && leaf.halve.is_none();
        for _ in 0..ROUNDS {
            if !(is_near || is_all) || !self.together(&mut leaf.x)? {
                break;
            }
        }
        Ok(())
    }

    /// Narrows a part by one row after the other and by all equations together. It is empty, too, where nothing is left of it but zeros that are known.
    fn decide(&mut self, x: &mut [Interval]) -> Result<(), Empty> {
        let block = self.block;
        let square = &block.square;
        for _ in 0..ROUNDS {
            contract(self.rows, &block.is_free, x)?;
            if self.tally.is_known(square, x) {
                return Err(Empty);
            }
            let goes_on = match square.is_bounded(x) {
                true => self.together(x)?,
                false => far(self.rows, &block.is_free, x)?,
            };
            if !goes_on {
                break;
            }
        }
        Ok(())
    }

    /// Narrows a part by all equations together, and proves a zero in it, if it can: whether another round is worth it. It is empty, too, where
    /// the zero is the only one.
    fn together(&mut self, x: &mut [Interval]) -> Result<bool, Empty> {
        let square = &self.block.square;
        let before = self.block.volume(x);
        let defect = square.step(x)?;
        if defect < 2.0 && self.tally.prove(square, x) {
            return Err(Empty);
        }
        Ok(self.block.volume(x) <= before - WORTH)
    }
}
