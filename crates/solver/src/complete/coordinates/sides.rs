//! Blocks on each side of those of their equations that are one of two linear ones.
//!
//! What exact numbers tell of a block is told first ([`Told`]): with every such equation on one side or the other, most of a sketch that is drawn along axes
//! is linear. Each choice of sides that is not contradictory is then searched by itself, with the linear equations in the place of the others, or beside them
//! where they do not say all that the others do ([`Side`]). Every zero is on some side of each equation, so that nothing is lost.

use super::contract::contract;
use super::search::{About, Block, Found, Run, leave};
use super::system::{Form, Product, Row};
use crate::complete::Why;
use crate::interval::Interval;
use crate::order::InOrder;
use crate::system::Homotopy;
use crate::system::told::{self, Flat, Side, Told, View};
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// Blocks of more unknowns are not looked at in exact numbers.
pub const MOST: usize = 60;

/// A row that says what a flat equation says. `zero`: the entry that is the number 0.
pub fn row(flat: &Flat, zero: usize) -> Row {
    let value = |u: usize| Form::Difference(u, zero);
    let terms = flat.terms.iter();
    let terms =
        terms.map(|&(factor, u, v)| Product::new(factor, value(u), v.map_or(Form::One, value)));
    Row::new(terms.collect(), -flat.constant, zero)
}

/// A search of a block on all sides.
pub struct Sides<'s, 'a> {
    /// The block as it is.
    pub whole: &'s Block<'a>,
    /// Its equations, exactly.
    pub homotopy: &'s Homotopy,
    /// The search.
    pub run: &'s Run<'s>,
}

impl Sides<'_, '_> {
    /// Searches a box. `told`: what is known exactly of blocks before.
    pub fn search(&self, told: Told, x: Vec<Interval>) -> Found {
        let mut found = Found::default();
        self.each(self.whole, (told, &mut Vec::new()), (x, 1.0), &mut found);
        let zeros = found.zeros.into_iter().zip(found.pieces).zip(found.exact);
        let mut zeros: Vec<_> = zeros.collect();
        zeros.order_by(|((a, _), _), ((b, _), _)| a.order(b));
        let (zeros, exact): (Vec<_>, Vec<_>) = zeros.into_iter().unzip();
        let (zeros, pieces) = zeros.into_iter().unzip();
        Found {
            zeros,
            pieces,
            exact,
            ..found
        }
    }

    /// Searches a box of a block some of whose equations are on a side. `elsewhere`: what is 0 on the other sides of those equations that are in the block as
    /// they are.
    fn each(
        &self,
        block: &Block,
        (mut told, elsewhere): (Told, &mut Vec<Row>),
        (mut x, share): (Vec<Interval>, f64),
        found: &mut Found,
    ) {
        let run = self.run;
        let watched = run.watched;
        let nothing = || watched.add_done(run.weight * share);
        if !block.sides.is_empty() {
            found.boxes += 1;
            let boxes = watched.boxes.fetch_add(1, Ordering::Relaxed);
            if watched.stop.load(Ordering::Relaxed) || boxes >= watched.most_boxes {
                found.is_broken_off = true;
                return leave(&mut found.undecided, Why::Unfinished, 1, share);
            }
        }
        if block.bound(&mut x).is_err() {
            return nothing();
        }
        let own = &block.square.own;
        let mut more = Vec::new();
        if own.len() <= MOST {
            let Some(rows) = self.reduced(block, &mut told, &mut x) else {
                return nothing();
            };
            let Some(rows) = rows else {
                nothing();
                return leave(&mut found.undecided, Why::Flexible, 1, share);
            };
            more = rows;
            let next = block.equations.iter().enumerate();
            let view = self.view(block, &x);
            let mut next = next.filter(|(_, e)| !block.sides.iter().any(|side| side[0] == **e));
            let next = next.find_map(|(place, &e)| Some((place, e, told.sides(&view, e)?)));
            if let Some((place, e, all)) = next {
                let share = share / all.len() as f64;
                let rows = all.iter().map(|side| row(&side.says, block.zero));
                let rows: Vec<Row> = rows.collect();
                for (side, Side { told, is_whole, .. }) in all.into_iter().enumerate() {
                    let before = elsewhere.len();
                    let mut row = &rows[side];
                    if !is_whole {
                        let others = rows.iter().enumerate().filter(|(k, _)| *k != side);
                        elsewhere.extend(others.map(|(_, other)| other.clone()));
                        row = block.square.rows[place];
                    }
                    let sided = on_side(block, (place, [e, side]), row);
                    self.each(&sided, (told, elsewhere), (x.clone(), share), found);
                    elsewhere.truncate(before);
                }
                return;
            }
        }
        let own = Run {
            weight: run.weight * share,
            ..*run
        };
        let about = About {
            whole: self.whole,
            told: told.in_numbers(),
        };
        let here = block.search_all(&about, more, x.clone(), &own);
        found.append(&here, share);
        let unknowns = &self.whole.square.own;
        let values = told.values().filter(|(i, _)| unknowns.contains(i));
        let values = Arc::new(values.map(|(i, x)| (i, x.clone())).collect());
        for (zero, piece) in here.zeros.into_iter().zip(here.pieces) {
            let zero = match block.sides.is_empty() {
                true => Some(zero),
                // How far around it there is no other zero on any side.
                false => self.whole.square.again(&zero, &x),
            };
            let Some(zero) = zero else {
                leave(&mut found.undecided, Why::Small, 1, 0.0);
                continue;
            };
            // Newton's method may have left the side for another one, where values are others.
            let at = self.whole.square.with(&x, |k| zero.range(k));
            let is_here = !elsewhere.iter().any(|row| row.value(&at).contains(0.0));
            let values = match is_here {
                true => Arc::clone(&values),
                false => Arc::default(),
            };
            match found.zeros.iter().position(|known| known.is_same(&zero)) {
                Some(known) if found.exact[known].is_empty() => found.exact[known] = values,
                Some(_) => {}
                None => {
                    found.zeros.push(zero);
                    found.pieces.push(piece);
                    found.exact.push(values);
                }
            }
        }
    }

    fn view<'v>(&'v self, block: &'v Block, x: &'v [Interval]) -> View<'v> {
        View {
            homotopy: self.homotopy,
            equations: &block.equations,
            unknowns: &block.square.own,
            ranges: x,
        }
    }

    /// What follows from the equations in exact numbers, as rows, by which the box is narrowed: `None` if they contradict each other, `Some(None)` if what
    /// they leave is a line.
    fn reduced(
        &self,
        block: &Block,
        told: &mut Told,
        x: &mut [Interval],
    ) -> Option<Option<Vec<Row>>> {
        let view = self.view(block, x);
        let reduced = told.reduced(&view).ok()?;
        let mut rows = Vec::new();
        for equation in &reduced.rows {
            let flat = told.flat(&view, equation);
            if !flat.terms.is_empty() {
                rows.push(row(&flat, block.zero));
            } else if !flat.constant.contains(0.0) {
                return None;
            }
        }
        for (i, value) in told.values() {
            x[i] = x[i].intersection(told::range(value));
            if x[i].is_empty() {
                return None;
            }
        }
        let all: Vec<&Row> = block.rows.iter().copied().chain(&rows).collect();
        contract(&all, &block.is_free, x).ok()?;
        Some((!reduced.is_curve).then_some(rows))
    }
}

/// A block with an equation, by its place, on a side, where a row says what it says.
fn on_side<'b, 'a: 'b>(
    block: &Block<'a>,
    (place, side): (usize, [usize; 2]),
    row: &'b Row,
) -> Block<'b> {
    let mut sided: Block<'b> = block.clone();
    sided.square.rows[place] = row;
    // The equations come first there, too.
    sided.rows[place] = row;
    sided.sides.push(side);
    sided
}
