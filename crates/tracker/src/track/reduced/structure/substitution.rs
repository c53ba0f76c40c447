//! Substitution through A's blocks for one right-hand side after another, where rows are lists.

use super::layout::{Block, Kind, Layout};
use super::passes::{Derivative, Inverses};
use crate::places::Each as _;

/// The entries that A's rows have before their blocks, as floats: those of unknowns that are found before.
#[derive(Debug, Clone, Default)]
pub struct Substitution {
    /// By row of A, where its entries end.
    ends: Vec<u32>,
    entries: Vec<(u32, f64)>,
    /// Work space: by unknown, its place in the block that is looked at; [`BEFORE`] or [`LATER`] for others.
    places: Vec<u8>,
}

/// An unknown of a block before.
const BEFORE: u8 = u8::MAX;
/// A key unknown, or one of a later block.
const LATER: u8 = BEFORE - 1;

impl Substitution {
    /// Lists the entries of A's rows at a point, and inverts its diagonal blocks.
    pub fn make(&mut self, layout: &Layout, j: &Derivative, inverses: &mut Inverses) {
        self.places.clear();
        self.places.resize(j.t + 2, LATER);
        self.ends.clear();
        self.entries.clear();
        inverses.clear();
        for block in &layout.blocks {
            let unknowns = &block.unknowns[..block.size];
            for (c, &unknown) in unknowns.iter().enumerate() {
                self.places[unknown as usize] = c as u8;
            }
            match block.kind {
                Kind::Wide(_) => inverses.push_wide(&self.list_block(block, j), block.size),
                _ => inverses.push(&self.list_block(block, j), block.size),
            }
            for &unknown in unknowns {
                self.places[unknown as usize] = BEFORE;
            }
        }
    }

    /// Lists the entries of a block's rows before it. Returns those in it, `entries[row][column]`.
    fn list_block<const K: usize>(&mut self, block: &Block, j: &Derivative) -> [[f64; K]; K] {
        let mut near = [[0.0; K]; K];
        for (near, &e) in near.iter_mut().zip(&block.rows[..block.size]) {
            each_entry(j, e as usize, |unknown, entry| match self.places[unknown] {
                BEFORE => self.entries.push((unknown as u32, entry)),
                LATER => {}
                place => near[place as usize] += entry,
            });
            self.ends.push(self.entries.len() as u32);
        }
        near
    }

    /// Sets A's unknowns in `x` so that the rows of A in `f − J x` vanish, key unknowns being zero.
    pub fn solve(&self, layout: &Layout, inverses: &Inverses, f: &[f64], x: &mut [f64]) {
        let mut begin = 0;
        for (block, inverse) in layout.blocks.iter().zip(&inverses.points) {
            begin = match block.kind {
                Kind::Wide(at) => {
                    self.solve_block(block, &inverses.wide[at as usize], (f, x), begin)
                }
                _ => self.solve_block(block, inverse, (f, x), begin),
            };
        }
    }

    /// The unknowns of one block, whose entries begin there. Tells where the next one's do.
    #[inline(always)]
    fn solve_block<const K: usize>(
        &self,
        block: &Block,
        inverse: &[[f64; K]; K],
        (f, x): (&[f64], &mut [f64]),
        mut begin: usize,
    ) -> usize {
        let mut rest = [0.0; K];
        let ends = &self.ends[block.start..block.start + block.size];
        for ((rest, &e), &end) in rest.iter_mut().zip(&block.rows).zip(ends) {
            let entries = &self.entries[begin..end as usize];
            begin = end as usize;
            let rows = entries.iter();
            *rest = rows.fold(f[e as usize], |sum, &(unknown, entry)| {
                (-entry).mul_add(x[unknown as usize], sum)
            });
        }
        for (column, &unknown) in inverse[..block.size].iter().zip(&block.unknowns) {
            let products = column[..block.size].iter().zip(&rest);
            x[unknown as usize] = products.fold(0.0, |sum: f64, (a, b)| a.mul_add(*b, sum));
        }
        begin
    }
}

/// Calls a function with the unknowns of an equation's row of the Jacobian and their entries, t left out.
#[inline(always)]
fn each_entry(j: &Derivative, e: usize, mut to: impl FnMut(usize, f64)) {
    if e < j.tail.first() {
        for (ends, d) in j.ends.iter().zip(j.d) {
            let [plus, minus] = ends[e].each(|end| end as usize);
            to(plus, d[e]);
            to(minus, -d[e]);
        }
    } else {
        for (unknown, entry) in j.tail.row_with(e, j.entries) {
            to(unknown, entry);
        }
    }
}
