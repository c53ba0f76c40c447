//! All zeros of a block in a box, by branch and prune.
//!
//! Parts are given up only where a row cannot hold ([`super::contract`]) or a linear combination of the equations cannot
//! ([`Square::step`]), where no way of a construction ends ([`super::construction`]), or where all of the part lies where a zero that is proved is alone
//! ([`Square::is_alone`]); how one is looked at is in [`super::piece`]. Halves of a part share their border, so that no zero falls between them. The answer is the same for any number of threads: the first
//! parts are made one after the other, and each of them is then searched by itself.

use super::bound::bounds;
use super::construction::Order;
use super::kept::{Kept, digest};
use super::newton::{KNOWN, Square, Zero};
use super::oriented::Oriented;
use super::piece::{How, Node, Piece};
use super::sums::sums;
use super::system::{Row, System, relative_width, volume};
use crate::certificate::cover::coordinates::Empty;
use crate::complete::outcome::open_share;
use crate::complete::search::Run as Watched;
use crate::complete::{Constructed, Part, Why};
use crate::interval::{Interval, hull, point};
use crate::order::InOrder;
use crate::random::Random;
use crate::rational::Rational;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// A search of a block among those of a run.
pub struct Run<'a> {
    /// What all share.
    pub watched: &'a Watched<'a>,
    /// The share of all searching that it is.
    pub weight: f64,
    /// Where its pieces are kept.
    pub kept: Option<&'a Kept<'a>>,
    /// Whether all pieces are worked on, or those of the share alone.
    pub is_whole: bool,
}

/// What a search found.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Found {
    /// Zeros, no two the same.
    pub zeros: Vec<Zero>,
    /// What stays undecided, with its share of what was searched.
    pub undecided: Vec<Part>,
    /// Parts looked at.
    pub boxes: u64,
    /// Parts given up as a sign is wrong all over them.
    pub cut: u64,
    /// Whether it was ended before all was looked at.
    pub is_broken_off: bool,
    /// For each zero the piece it was found in, if the search was cut into pieces.
    #[serde(skip)]
    pub pieces: Vec<Option<usize>>,
    /// For each zero the unknowns whose numbers are known exactly. (Of a search over rotations there are none.)
    #[serde(skip)]
    pub exact: Vec<Arc<Values>>,
    /// The largest construction by which it was searched, if any was.
    #[serde(skip)]
    pub constructed: Option<Constructed>,
}

/// Unknowns with their exact numbers.
pub type Values = Vec<(usize, Rational)>;

/// Parts that are searched each by itself.
const PIECES: usize = 64;
/// Parts that are looked at, one after the other, to make the pieces.
const LOOKED: u64 = 300;
/// A part whose unknowns are all known to this much is not halved any more.
pub const SMALL: f64 = 1e-9;
/// The same once that many parts of a piece are undecided.
pub const COARSE: f64 = 1e-3;
/// How many that are.
pub const MANY: usize = 300;
/// Where that many are undecided a piece is given up in which a curve of figures was seen.
pub const FEW: usize = 16;
/// Where that many are undecided a piece is given up.
pub const TOO_MANY: usize = 5000;
/// Places from which a curve of zeros is looked for, and how far they are from 0 where they may be.
const PROBES: usize = 8;
const NEAR: f64 = 4.0;
/// A length below this seems to be none.
const NONE: f64 = 1e-6;
/// An unknown that may be as large as this, and more, is not looked at any further.
const HUGE: f64 = (1u64 << 40) as f64;

/// A block and how it is contracted.
#[derive(Clone)]
pub struct Block<'a> {
    /// The equations with the unknowns.
    pub square: Square<'a>,
    /// The equations, and what follows from them.
    pub rows: Vec<&'a Row>,
    /// For each entry whether it is an unknown of the block.
    pub is_free: Vec<bool>,
    /// The entry that is the number 0.
    pub zero: usize,
    /// The unknowns, by their places in the block, that are positive in figures.
    pub positive: Vec<usize>,
    /// The vectors that vanish in no figure and of which all is known in the block, as the system has them.
    pub nonzero: Vec<&'a [[usize; 2]]>,
    /// The signs that are asked for of points of which all is known in the block.
    pub oriented: Option<Oriented>,
    /// The numbers of its equations in the system.
    pub equations: Vec<usize>,
    /// The equations that are on a side: the number of each, and that of its side.
    pub sides: Vec<[usize; 2]>,
}

/// What the search of a block on some sides depends on, beside its rows and its box.
pub struct About<'s, 'a> {
    /// The block without any sides.
    pub whole: &'s Block<'a>,
    /// What is known exactly, told in whole numbers.
    pub told: Vec<usize>,
}

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
        let positive = system.positive.iter().map(|&u| place[u]);
        let positive = positive.filter(|&k| k != KNOWN).collect();
        let nonzero = system.nonzero.iter().filter(|vector| {
            let mut entries = vector.iter().flatten();
            entries.all(|&e| is_free[e] || is_known(e))
        });
        let oriented = system.oriented.as_ref();
        let oriented = oriented.map(|signs| signs.of(|e| is_free[e] || is_known(e)));
        let own_rows: Vec<&Row> = equations.iter().map(|&e| &system.rows[e]).collect();
        let rows = own_rows.iter().copied().chain(follow).collect();
        Block {
            nonzero: nonzero.map(Vec::as_slice).collect(),
            oriented,
            square: Square {
                rows: own_rows,
                own: own.to_vec(),
                place,
                has_ranges: system.has_ranges,
            },
            rows,
            is_free,
            zero: system.unknowns,
            positive,
            equations: equations.to_vec(),
            sides: Vec::new(),
        }
    }

    /// Narrows a box to the bounds of the unknowns.
    pub(super) fn bound(&self, x: &mut [Interval]) -> Result<(), Empty> {
        for (&u, range) in self.square.own.iter().zip(bounds(&self.square, x)?) {
            let both = x[u].intersection(range);
            if both.is_empty() {
                return Err(Empty);
            }
            x[u] = both;
        }
        Ok(())
    }

    /// Searches a box, with every equation as it is. `more`: what follows from the equations beside.
    pub(super) fn search_all(
        &self,
        about: &About,
        mut more: Vec<Row>,
        x: Vec<Interval>,
        run: &Run,
    ) -> Found {
        more.extend(sums(&about.whole.square, self.zero, &x));
        let rows: Vec<&Row> = self.rows.iter().copied().chain(&more).collect();
        let order = Order::new(&self.square, self.zero);
        let how = (rows.as_slice(), order.as_ref());
        let (first, nodes) = self.begin(how, x, run);
        if run.kept.is_some() {
            // Looked at in every run.
            let open: f64 = nodes.iter().map(|node| node.share).sum();
            run.watched.add_before(run.weight * (1.0 - open).max(0.0));
        }
        let is_flexible = !nodes.is_empty() && self.seems_flexible(&nodes);
        let own = self.square.own.iter();
        let mut all = Together {
            ranges: nodes
                .iter()
                .map(|node| own.clone().map(|&u| node.x[u]).collect())
                .collect(),
            zeros: Vec::new(),
        };
        let mut found: Vec<Found> = nodes
            .into_par_iter()
            .enumerate()
            .map(|(piece, node)| {
                let from = (first.zeros.as_slice(), is_flexible);
                self.piece(about, (piece, node), from, how, run)
            })
            .collect();
        all.add(first.zeros, None);
        all.find(&mut found);
        let mut whole = Found {
            undecided: first.undecided,
            boxes: first.boxes,
            cut: first.cut,
            is_broken_off: first.is_broken_off,
            constructed: how.1.map(|order| Constructed {
                unknowns: self.square.own.len(),
                parameters: order.drives,
            }),
            ..Found::default()
        };
        found.iter().for_each(|one| whole.append(one, 1.0));
        (whole.zeros, whole.pieces) = all.in_order();
        whole
    }

    /// The first parts of a search, one after the other, and the pieces that they leave.
    fn begin(&self, how: How, x: Vec<Interval>, run: &Run) -> (Found, Vec<Node>) {
        let mut first = Piece::new(self, how, run);
        let mut nodes = vec![Node::whole(x)];
        // Breadth first until there are enough pieces, or few remain however far it goes.
        while !nodes.is_empty() && nodes.len() < PIECES && first.tally.found.boxes < LOOKED {
            let mut next = Vec::new();
            for node in nodes {
                first.visit(node, &mut next);
            }
            nodes = next;
            if run.watched.boxes.load(Ordering::Relaxed) >= run.watched.most_boxes {
                break;
            }
        }
        (first.tally.found, nodes)
    }

    /// Searches one of the pieces, or takes what was found in it before.
    fn piece(
        &self,
        about: &About,
        (number, node): (usize, Node),
        (zeros, is_flexible): (&[Zero], bool),
        how: How,
        run: &Run,
    ) -> Found {
        let searched = |node: Node| {
            let mut piece = Piece::new(self, how, run);
            if is_flexible {
                piece.has_curve();
            }
            piece.tally.found.zeros.extend_from_slice(zeros);
            let mut stack = vec![node];
            while let Some(node) = stack.pop() {
                piece.visit(node, &mut stack);
            }
            piece.tally.found
        };
        let Some(kept) = run.kept else {
            return searched(node);
        };
        let share = node.share;
        let name = self.name(about, &node.x, zeros);
        if let Some(found) = kept.known(&name) {
            run.watched.boxes.fetch_add(found.boxes, Ordering::Relaxed);
            run.watched.add_done_before(run.weight * share);
            return found;
        }
        if !run.is_whole && !kept.keep.is_mine(number) {
            return Found::missing(share);
        }
        let found = searched(node);
        if found.is_broken_off {
            let open = open_share(&found.undecided);
            run.watched.add_lost(run.weight * (share - open));
        }
        kept.put(&name, &found);
        found
    }

    /// The name of a piece in a store: a digest of all that its search depends on.
    fn name(&self, about: &About, x: &[Interval], zeros: &[Zero]) -> String {
        // Of the block without any sides: what stands in the place of an equation has ranges of these in its numbers.
        let rows = about.whole.rows.iter();
        let entries = rows.flat_map(|row| row.entries.iter().copied());
        let entries: BTreeSet<usize> = entries.collect();
        let ranges: Vec<Interval> = entries.iter().map(|&e| x[e]).collect();
        let own = self.square.own.iter().copied();
        let sides = self.sides.iter().flatten().copied();
        // No unknown has this number.
        let parted = own.chain([usize::MAX]).chain(sides).chain([usize::MAX]);
        digest(parted.chain(about.told.iter().copied()), ranges, zeros)
    }

    /// Whether a curve of zeros goes through one of these parts, as Newton's method in floats sees from places in them. Of figures that is told where it is met.
    fn seems_flexible(&self, nodes: &[Node]) -> bool {
        let mut random = Random::new(1);
        let is_of_numbers = self.positive.is_empty() && self.nonzero.is_empty();
        is_of_numbers
            && nodes.iter().cycle().take(PROBES).any(|node| {
                let mut place = |&u: &usize| {
                    let near = node.x[u].intersection(hull(-NEAR, NEAR));
                    let within = if near.is_empty() { node.x[u] } else { near };
                    point(within.mid() + 0.5 * random.symmetric() * within.wid().min(NEAR))
                };
                let from: Vec<Interval> = self.square.own.iter().map(&mut place).collect();
                let zero = self
                    .square
                    .on_a_curve(&self.square.with(&node.x, |k| from[k]));
                let is_in = |node: &Node, zero: &[f64]| {
                    let mut own = self.square.own.iter().zip(zero);
                    own.all(|(&u, &x)| node.x[u].contains(x))
                };
                zero.is_some_and(|zero| nodes.iter().any(|node| is_in(node, &zero)))
            })
    }

    /// The logarithm of the product of all widths.
    pub fn volume(&self, x: &[Interval]) -> f64 {
        volume(x, &self.square.own)
    }

    /// Why a part stays undecided, if a curve of zeros seems to go through it.
    pub fn curve(&self, x: &[Interval]) -> Option<Why> {
        let zero = self.square.on_a_curve(x)?;
        // A curve along which a leg has no length, whatever its heading is, or another vector vanishes that must not, is none of figures.
        let at = |entry: usize| match self.square.place[entry] {
            KNOWN => x[entry].mid(),
            k => zero[k],
        };
        let vanishes =
            |vector: &&[[usize; 2]]| vector.iter().all(|&[a, b]| (at(a) - at(b)).abs() < NONE);
        let is_none =
            self.positive.iter().any(|&k| zero[k] < NONE) || self.nonzero.iter().any(vanishes);
        Some(if is_none {
            Why::Vanishing
        } else {
            Why::Flexible
        })
    }

    /// The unknown to be halved: the one that moves the equations most, each beside what all others move it; and how wide the widest range
    /// is, beside its size. `None`: an unknown may be as large as it likes.
    pub fn widest(&self, x: &[Interval]) -> Option<(usize, f64)> {
        let square = &self.square;
        let (mut widest, mut unbounded): (f64, Option<usize>) = (0.0, None);
        for &u in &square.own {
            if !x[u].is_common_interval() {
                unbounded.get_or_insert(u);
            } else {
                widest = widest.max(relative_width(x[u]));
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
                    true => None,
                    false => Some((u, f64::INFINITY)),
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
            x.is_common_interval() && relative_width(x) > 1e-3 * widest
        });
        let best = best.max_by(|&a, &b| smear[a].total_cmp(&smear[b]));
        Some(match (best, unbounded) {
            (Some(k), _) => (square.own[k], widest),
            (None, Some(u)) => (u, f64::INFINITY),
            (None, None) => (square.own[0], 0.0),
        })
    }
}

impl Found {
    /// Adds what was looked at in a part of such a share, but no zeros.
    pub fn append(&mut self, other: &Found, share: f64) {
        leave_all(&mut self.undecided, &other.undecided, share);
        self.boxes += other.boxes;
        self.cut += other.cut;
        self.is_broken_off |= other.is_broken_off;
        self.constructed = self.constructed.max(other.constructed);
    }

    /// Nothing was looked at.
    pub fn missing(share: f64) -> Found {
        let mut found = Found {
            is_broken_off: true,
            ..Found::default()
        };
        leave(&mut found.undecided, Why::Unfinished, 1, share);
        found
    }
}

/// Adds a zero that is new.
pub fn add(zeros: &mut Vec<Zero>, zero: Zero) {
    if !zeros.iter().any(|known| known.is_same(&zero)) {
        zeros.push(zero);
    }
}

/// The zeros that were found in pieces, put together.
struct Together {
    /// The ranges of the pieces.
    ranges: Vec<Vec<Interval>>,
    /// The zeros, with the piece that each is of.
    zeros: Vec<(Zero, Option<usize>)>,
}

impl Together {
    /// Adds zeros that are new. `finder`: the piece they were found in. One that is not of that piece but of another is of that other.
    fn add(&mut self, zeros: Vec<Zero>, finder: Option<usize>) {
        for zero in zeros {
            if self.zeros.iter().any(|(known, _)| known.is_same(&zero)) {
                continue;
            }
            let place = self.zeros.len();
            let is_in = |k: &usize| self.has(*k, &zero);
            let piece = (0..self.ranges.len()).find(is_in).or(finder);
            // What was found before there were pieces is shared by its place.
            let is_cut = !self.ranges.is_empty();
            self.zeros.push((zero, piece.or(is_cut.then_some(place))));
        }
    }

    fn has(&self, piece: usize, zero: &Zero) -> bool {
        let mut pairs = self.ranges[piece].iter().zip(&zero.centre);
        pairs.all(|(range, &x)| range.contains(x))
    }

    /// Adds what was found in pieces: first what each found in its own ranges. Of a zero that several found, that of the piece it
    /// is in stays, however many of the others are there.
    fn find(&mut self, found: &mut [Found]) {
        for inside in [true, false] {
            for (piece, one) in found.iter_mut().enumerate() {
                let zeros = std::mem::take(&mut one.zeros);
                let (now, later) = zeros
                    .into_iter()
                    .partition(|zero| self.has(piece, zero) == inside);
                one.zeros = later;
                self.add(now, Some(piece));
            }
        }
    }

    /// In an order that does not depend on who found them. Zeros that are neither the same nor apart stay, and are told apart, or
    /// not, as figures.
    fn in_order(mut self) -> (Vec<Zero>, Vec<Option<usize>>) {
        self.zeros.order_by(|(a, _), (b, _)| a.order(b));
        self.zeros.into_iter().unzip()
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

/// Adds all that is undecided in a part of such a share.
pub fn leave_all(undecided: &mut Vec<Part>, parts: &[Part], share: f64) {
    for part in parts {
        leave(undecided, part.why, part.count, share * part.share);
    }
}

/// The range that a zero has, made a little wider than its box by rounding.
pub fn ranges(zero: &Zero) -> impl Iterator<Item = Interval> + '_ {
    (0..zero.centre.len()).map(|k| zero.range(k))
}
