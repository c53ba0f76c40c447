//! All places of a rigid body on legs to points that stand, by a search over how the body is turned.
//!
//! Legs are distances from points of the body to points that are known (a platform of a parallel robot: Stewart and Gough). A
//! search over all coordinates knows three of the body's points by nine numbers; how the body is turned is told by three, and with
//! that known, where it is follows from linear equations ([`Legs`]). So the parts of this search are boxes of
//! rotations ([`Turn`]), with Taylor models of the second order over them, rounded outwards.
//!
//! # Why nothing is missed
//!
//! Let X be a figure. Its body is turned by some rotation, and stands at some place; that rotation is in a part at every level of the
//! search, as the charts hold all rotations and halves share their border. A part is given up only where the models prove that none of
//! its rotations leaves a place that all legs allow, or where every figure whose rotation is in it lies where a zero of the block's
//! equations that is proved is alone: its points are enclosed by the models, and its other unknowns by the equations
//! ([`contract`]). Nothing is claimed of zeros of the block's equations that are no figures.

use super::contract::contract;
use super::newton::Zero;
use super::search::{Block, Found, Run, SMALL, add};
use super::tally::Tally;
use crate::blocks::Block as Cut;
use crate::certificate::cover::coordinates::legs::{Leg, Legs, Look, SYMBOLS};
use crate::certificate::cover::coordinates::{Body, Turn};
use crate::complete::Why;
use crate::equations::Form;
use crate::interval::{Interval, ZERO, enclose, hull, point};
use crate::model::{Margin, Number};
use crate::order::InOrder;
use crate::places::{Each as _, array};
use crate::problem::{Problem, Shape};
use crate::system::{Homotopy, Term};
use rayon::prelude::*;

/// The legs that a body stands on: as many as it has freedoms.
const LEGS: usize = 6;
/// Parts that are searched each by itself.
const PIECES: usize = 256;
/// Parts that are looked at, one after the other, to make the pieces.
const LOOKED: u64 = 2000;
/// Figures are sought where no number that tells the rotation varies by more than this from its middle.
const NEAR: f64 = 0.03;
/// And surely where it varies by no more than this.
const NEARER: f64 = 1e-3;

/// Where linear equations do not tell the place in a box as small as this, a coordinate is searched.
const FINE: f64 = 1.0 / 40.0;

/// A box of rotations, and about its share of all of them.
struct Part {
    turn: Turn,
    share: f64,
}

impl Part {
    /// How far a component of the quaternion is from its middle at most.
    fn widest(&self) -> f64 {
        let widths = self.turn.ranges()[..3].iter().map(|x| 0.5 * x.wid());
        widths.fold(0.0, f64::max)
    }

    /// Two boxes that share their border and together are this one, halved in what moves most. `None`: it is too small.
    fn halves(&self, moves: &[f64; SYMBOLS]) -> Option<[Part; 2]> {
        let widths: Vec<f64> = self.turn.ranges().iter().map(|x| x.wid()).collect();
        let widest = widths.iter().copied().fold(0.0, f64::max);
        // What is narrow already is not what keeps the box from being decided.
        let wide = (0..widths.len()).filter(|&i| widths[i] > 1e-3 * widest);
        let best = wide.fold(None, |best: Option<usize>, i| match best {
            Some(b) if !(moves[i] > moves[b]) => best,
            _ => Some(i),
        });
        let share = 0.5 * self.share;
        Some(self.turn.halved(best?)?.map(|turn| Part { turn, share }))
    }
}

/// A block of a rigid body on legs.
#[derive(Debug)]
pub struct Poses {
    /// The body, and the equations of its legs.
    pub body: Body,
    /// Where the first leg stands.
    foot: [Interval; 3],
    legs: Legs,
    /// The body's points whose coordinates are unknowns of the block: where each is from the first leg's point, in the
    /// body's own coordinates, and its unknowns.
    points: Vec<([Number; 3], [usize; 3])>,
}

/// The ends of three differences, if an equation is about the sum of their squares. `zero`: the entry that is the number 0.
fn squares(terms: &[Term], zero: usize) -> Option<[[usize; 2]; 3]> {
    let &[x, y, z] = terms else { return None };
    let square = |term: Term| match term.left.map(|i| i.unwrap_or(zero)) {
        Form::Difference(a, b) if term.factor == 1 && term.left == term.right => Some([a, b]),
        _ => None,
    };
    Some([square(x)?, square(y)?, square(z)?])
}

/// The point of which three differences have the coordinates, in order, and the entries at their other ends.
fn stand(pairs: &[[usize; 2]; 3], own: &[Option<[usize; 3]>]) -> Option<(usize, [usize; 3])> {
    own.iter().enumerate().find_map(|(k, of)| {
        let of = of.as_ref()?;
        let mut outer = [0; 3];
        for ((&[a, b], &u), outer) in pairs.iter().zip(of).zip(&mut outer) {
            *outer = match (a == u, b == u) {
                (true, false) => b,
                (false, true) => a,
                _ => return None,
            };
        }
        Some((k, outer))
    })
}

impl Poses {
    /// The body on legs that a block is, if it is one. `x`: what is known of the unknowns.
    pub fn of(problem: &Problem, homotopy: &Homotopy, block: &Cut, x: &[Interval]) -> Option<Self> {
        if homotopy.dimension != 3 {
            return None;
        }
        let is_own = |u: usize| block.unknowns.contains(&u);
        let unknowns = |p: usize| -> Option<[usize; 3]> {
            let all = [0, 1, 2].each(|axis| homotopy.coordinate(p, axis).filter(|&u| is_own(u)));
            let [Some(a), Some(b), Some(c)] = all else {
                return None;
            };
            Some([a, b, c])
        };
        // Where a leg stands that the block does not move, by entries of the equations.
        let place = |entries: [usize; 3]| -> Option<[Interval; 3]> {
            let mut at = [ZERO; 3];
            for (at, u) in at.iter_mut().zip(entries) {
                if u < homotopy.equations {
                    if is_own(u) || !x[u].is_common_interval() {
                        return None;
                    }
                    *at = x[u];
                }
            }
            Some(at)
        };
        let per_unit = point(1.0 / homotopy.unit);
        problem
            .objects
            .iter()
            .enumerate()
            .find_map(|(number, object)| {
                let Shape::Body {
                    points,
                    local,
                    place: None,
                } = &object.shape
                else {
                    return None;
                };
                let own = points.iter().map(|&p| unknowns(p));
                let own: Vec<Option<[usize; 3]>> = own.collect();
                let mut found = Vec::new();
                for &e in &block.equations {
                    let leg = squares(&homotopy.terms(e), homotopy.equations + 1)
                        .and_then(|pairs| stand(&pairs, &own));
                    let Some((inner, outer)) = leg else { continue };
                    let Some(foot) = place(outer) else { continue };
                    // The equation is ½|p − q|² = right.
                    let square = homotopy.rights[e].at_target() * point(2.0);
                    found.push((e, inner, foot, square));
                }
                if found.len() != LEGS {
                    return None;
                }
                let (_, first, foot, first_square) = found[0];
                // From the first leg's point, in the body's coordinates.
                let from = |k: usize| -> [Interval; 3] {
                    array(|axis| {
                        let at = |k: usize| enclose(&local[k][axis]);
                        match k == first {
                            true => ZERO,
                            false => (at(k) - at(first)) * per_unit,
                        }
                    })
                };
                let leg = |&(_, k, at, square): &(usize, usize, [Interval; 3], Interval)| {
                    let stands = array(|axis| at[axis] - foot[axis]);
                    Leg::new(from(k), stands, square, first_square)
                };
                let free = points.iter().enumerate();
                let free =
                    free.filter_map(|(k, &p)| Some((from(k).each(Number::new), unknowns(p)?)));
                Some(Poses {
                    body: Body {
                        object: number,
                        legs: found.iter().map(|leg| leg.0).collect(),
                    },
                    foot,
                    legs: Legs::new(found[1..].iter().map(leg), first_square)
                        .filter(|legs| legs.reach < 1e30)?,
                    points: free.collect(),
                })
            })
    }

    /// Searches all rotations.
    pub fn search(&self, block: &Block, x: &[Interval], run: &Run) -> Found {
        let new = || Piece {
            poses: self,
            block,
            x,
            tally: Tally::new(run, block.square.has_ranges),
            is_flexible: false,
        };
        let mut first = new();
        let all = Turn::all().into_iter();
        let mut parts: Vec<Part> = all.map(|turn| Part { turn, share: 0.25 }).collect();
        // Breadth first until there are enough pieces.
        while !parts.is_empty() && parts.len() < PIECES && first.tally.found.boxes < LOOKED {
            let mut next = Vec::new();
            for part in parts {
                first.visit(part, &mut next);
            }
            parts = next;
        }
        let pieces: Vec<Found> = parts
            .into_par_iter()
            .map(|part| {
                let mut piece = new();
                let mut stack = vec![part];
                while let Some(part) = stack.pop() {
                    piece.visit(part, &mut stack);
                }
                piece.tally.found
            })
            .collect();
        let mut whole = first.tally.found;
        for mut piece in pieces {
            for zero in piece.zeros.drain(..) {
                add(&mut whole.zeros, zero);
            }
            whole.append(&piece, 1.0);
        }
        whole.zeros.order_by(Zero::order);
        whole.pieces = vec![None; whole.zeros.len()];
        whole
    }

    /// The ranges of all unknowns of the block for figures whose rotation is in a part: `None` if there are none.
    fn ranges(&self, block: &Block, x: &[Interval], look: &Look) -> Option<Vec<Interval>> {
        let mut x = x.to_vec();
        let range = look.ranges(self.foot);
        for (from, unknowns) in &self.points {
            for (axis, &u) in unknowns.iter().enumerate() {
                x[u] = x[u].intersection(range(from, axis));
                if x[u].is_empty() {
                    return None;
                }
            }
        }
        contract(&block.rows, &block.is_free, &mut x).ok()?;
        Some(x)
    }
}

/// A part of the search that goes on by itself.
struct Piece<'s, 'a> {
    poses: &'s Poses,
    block: &'s Block<'a>,
    /// What is known of all unknowns.
    x: &'s [Interval],
    tally: Tally<'s>,
    is_flexible: bool,
}

impl Piece<'_, '_> {
    /// Looks at a part: it is given up, decided, left undecided, or its halves come to the others.
    fn visit(&mut self, mut part: Part, others: &mut Vec<Part>) {
        loop {
            if !self.tally.begin(part.share) {
                return;
            }
            let Some(look) = self.poses.legs.look(&part.turn) else {
                return self.tally.done(part.share);
            };
            let before = part.widest();
            if !look.is_told() {
                if part.turn.height.is_some() && before < SMALL {
                    return self.tally.leave(Why::Small, part.share);
                }
                return self.halve(part, &look, others);
            }
            let Some(left) = look.left(Margin::Some) else {
                return self.tally.done(part.share);
            };
            let volume: f64 = left.iter().map(|u| 0.5 * (u.hi - u.lo)).product();
            part.turn = part.turn.within(&left).unwrap_or(part.turn);
            let is_near = before < NEAR && (volume < 0.1 || before < NEARER);
            let mut why = Why::Small;
            if is_near {
                let Some(x) = self.poses.ranges(self.block, self.x, &look) else {
                    return self.tally.done(part.share);
                };
                if self.is_known(&x) {
                    return self.tally.done(part.share);
                }
                if before < SMALL
                    && (self.is_flexible || self.block.square.on_a_curve(&x).is_some())
                {
                    why = Why::Flexible;
                    self.is_flexible = true;
                }
            }
            if part.widest() < self.tally.least(self.is_flexible) {
                return self.tally.leave(why, part.share);
            }
            // Worth another look where a good part of it is gone.
            if volume > 0.3 {
                return self.halve(part, &look, others);
            }
        }
    }

    /// Whether a zero is the only one that a box may hold: one that is known, or one that is proved now.
    fn is_known(&mut self, x: &[Interval]) -> bool {
        let square = &self.block.square;
        self.tally.is_known(square, x) || square.is_bounded(x) && self.tally.prove(square, x)
    }

    /// The halves of a part come to the others; or, where linear equations do not tell the body's place however small the part is,
    /// the part with the coordinate that they do not tell.
    fn halve(&mut self, part: Part, look: &Look, others: &mut Vec<Part>) {
        let reach = self.poses.legs.reach;
        if let Some(axis) = look.untold
            && part.widest() <= FINE
            && let Some(turn) = part.turn.with_height(axis, hull(-reach, reach))
        {
            return others.push(Part { turn, ..part });
        }
        match part.halves(&look.moves) {
            Some(halves) => others.extend(halves),
            None => self.tally.leave(Why::Small, part.share),
        }
    }
}
