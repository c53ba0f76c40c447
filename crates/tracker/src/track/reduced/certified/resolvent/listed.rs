//! X, N and bounds on |A(s)⁻¹| in blocks whose rows are lists of entries.

use super::{Diagonal, Resolvent};
use crate::linalg::rstructure::Lane;
use crate::linalg::{LANE, Vector};
use crate::places::{Each as _, array};
use crate::track::full::Equations;
use crate::track::reduced::structure::layout::{Block, WIDEST};

/// What such rows have.
#[derive(Debug, Clone, Default)]
pub(super) struct Lists {
    /// By row of A, where its entries of Â before its block begin in `before`, and where they end.
    ranges: Vec<[u32; 2]>,
    /// Rows of A that come before, and Â's entries for them.
    before: Vec<(u32, f64)>,
    /// Work space: the entries of a row of A₀ and A₁ before its block, and A₁ X.
    terms: Vec<Term>,
    turns: Vec<Lane>,
}

/// What a row of A₀ and A₁ has for a row of X.
#[derive(Debug, Clone, Copy)]
struct Term {
    row: u32,
    a: [f64; 2],
}

impl Lists {
    /// For as many rows of A.
    pub fn clear(&mut self, order: usize) {
        self.ranges.clear();
        self.ranges.resize(order, [0; 2]);
        self.before.clear();
    }
}

impl Resolvent {
    /// X and N in a block, from the inverse of its diagonal block, the differences of order 0 and 1 and the values of the
    /// tail's entries. Returns what N + Â|X| and Â have in it.
    #[inline(never)]
    pub(super) fn make_listed<const K: usize>(
        &mut self,
        equations: &Equations,
        block: &Block,
        inverse: &[[f64; K]; K],
        values: ([&[Vector]; 2], [&[f64]; 2]),
        h: f64,
    ) -> ([[f64; K]; K], [[f64; K]; K]) {
        let (start, size) = (block.start, block.size);
        let (first, next) = self.rows[start];
        let lanes = next - first;
        let mut lists = std::mem::take(&mut self.lists);
        lists.turns.clear();
        lists.turns.resize(size * lanes, [0.0; LANE]);
        // The entries of Â in the block, and those of A₀ and A₁.
        let mut spread = [[0.0; K]; K];
        let mut inside = [[[0.0; K]; K]; 2];
        // What rows of A₀ X − I and A₁ X have before the block.
        for (r, turns) in lists.turns.chunks_exact_mut(lanes).enumerate() {
            let of_row = inside.each_mut().map(|inside| &mut inside[r]);
            let begin = lists.before.len();
            lists.terms.clear();
            self.each_entry(
                equations,
                block.rows[r] as usize,
                values,
                |row, a, size| match (row as usize).checked_sub(start) {
                    None => {
                        lists.before.push((row, size));
                        lists.terms.push(Term { row, a });
                    }
                    Some(place) => {
                        spread[r][place] += size;
                        of_row[0][place] += a[0];
                        of_row[1][place] += a[1];
                    }
                },
            );
            lists.ranges[start + r] = [begin, lists.before.len()].each(|at| at as u32);
            let n = &mut self.n[first + r * lanes..][..lanes];
            n.fill([0.0; LANE]);
            n[(start + r) / LANE][(start + r) % LANE] = -1.0;
            add_rows(&lists.terms, (&self.rows, &self.x), (n, turns));
        }
        let rows = (&mut self.n[first..], &lists.turns[..], &mut self.x[first..]);
        match size {
            1 => fill_rows::<1, K>(lanes, (inverse, &inside), rows, h),
            2 => fill_rows::<2, K>(lanes, (inverse, &inside), rows, h),
            3 => fill_rows::<3, K>(lanes, (inverse, &inside), rows, h),
            4 => fill_rows::<4, K>(lanes, (inverse, &inside), rows, h),
            5 => fill_rows::<5, K>(lanes, (inverse, &inside), rows, h),
            WIDEST => fill_rows::<WIDEST, K>(lanes, (inverse, &inside), rows, h),
            _ => unreachable!("a block has one row at least and {WIDEST} at most"),
        }
        self.lists = lists;
        (self.in_block(block, &spread), spread)
    }

    /// Calls a function with the rows of A that an equation's entries in it belong to, those of A₀ and A₁, and those of Â.
    #[inline(always)]
    fn each_entry(
        &self,
        equations: &Equations,
        e: usize,
        (d, entries): ([&[Vector]; 2], [&[f64]; 2]),
        mut to: impl FnMut(u32, [f64; 2], f64),
    ) {
        let mut put = |unknown: usize, a: [f64; 2], size: f64| {
            let row = self.position[unknown];
            // Key unknowns and fixed coordinates have none.
            if row != u32::MAX {
                to(row, a, size);
            }
        };
        if e < equations.tail.first() {
            for axis in 0..equations.dimension() {
                let [i, j] = equations.ends[axis][e].each(|end| end as usize);
                let (a, size) = (d.each(|d| d[axis][e]), self.spread[axis][e]);
                put(i, a, size);
                put(j, a.each(|a| -a), size);
            }
        } else {
            let row = equations.tail.row(e);
            let [a0, a1] = entries.each(|entries| &entries[row.clone()]);
            let sizes = equations.tail.row_with(e, &self.spread_of_tail);
            for (((unknown, size), &a0), &a1) in sizes.zip(a0).zip(a1) {
                put(unknown, [a0, a1], size);
            }
        }
    }

    /// What [`Resolvent::bound`] does for such a block.
    #[inline(never)]
    pub(super) fn bound_listed<const K: usize>(
        &self,
        block: &Block,
        diagonal: &Diagonal<K>,
        g: &[Lane],
        (y, v): (&mut [Lane], &mut [Lane]),
    ) {
        let (start, size) = (block.start, block.size);
        let (mut rest, mut near) = self.before::<K>((start, size), g, y);
        for (r, rest) in rest[..size].iter_mut().enumerate() {
            let [begin, end] = self.lists.ranges[start + r].each(|at| at as usize);
            for &(from, spread) in &self.lists.before[begin..end] {
                let v = &v[from as usize];
                for i in 0..LANE {
                    rest[i] = v[i].mul_add(spread, rest[i]);
                }
            }
            for (near, spread) in near[..size].iter().zip(&diagonal.spread[r]) {
                for i in 0..LANE {
                    rest[i] = near[i].mul_add(*spread, rest[i]);
                }
            }
        }
        self.close((start, size), &diagonal.bound, (&rest, &mut near), (y, v));
    }
}

/// Adds the products of entries of A₀ and A₁ with their rows of X to a row of A₀ X and one of A₁ X.
fn add_rows(
    terms: &[Term],
    (rows, x): (&[(usize, usize)], &[Lane]),
    (sums, turns): (&mut [Lane], &mut [Lane]),
) {
    /// So many rows are added at a time.
    const AT_ONCE: usize = 8;
    for terms in terms.chunks(AT_ONCE) {
        let mut of_terms: [(&[Lane], [f64; 2]); AT_ONCE] = [(&[], [0.0; 2]); AT_ONCE];
        for (place, term) in of_terms.iter_mut().zip(terms) {
            let (from, to) = rows[term.row as usize];
            *place = (&x[from..to], term.a);
        }
        let of_terms = &of_terms[..terms.len()];
        for (l, (sum, turn)) in sums.iter_mut().zip(turns.iter_mut()).enumerate() {
            let mut both = [*sum, *turn];
            for (x, [a0, a1]) in of_terms {
                if let Some(x) = x.get(l) {
                    for i in 0..LANE {
                        both[0][i] = x[i].mul_add(*a0, both[0][i]);
                        both[1][i] = x[i].mul_add(*a1, both[1][i]);
                    }
                }
            }
            [*sum, *turn] = both;
        }
    }
}

/// The S rows of X and N = |A₀ X − I| + H |A₁ X| in a block, from what A₀ X − I (in the rows of N) and A₁ X have before it,
/// the inverse of the block in A₀, and what A₀ and A₁ have in it.
///
/// The sums of A₀ X − I go on where those that X was computed from stopped, and begin with −1 in the diagonal. So, with γ for as many
/// roundings as a row has terms, they are off by γ (1 + |A₀||X|) at most, and 1 ≤ |A₀||X| + |A₀ X − I|. That is twice
/// γ |A₀||X|, which is in Â (`Counts::of_reduced_entry`), and γ |A₀ X − I|, by which bounds are rounded up (`Counts::of_inverse`).
#[inline(always)]
fn fill_rows<const S: usize, const K: usize>(
    lanes: usize,
    (inverse, [inside0, inside1]): (&[[f64; K]; K], &[[[f64; K]; K]; 2]),
    (n, turns, x): (&mut [Lane], &[Lane], &mut [Lane]),
    h: f64,
) {
    assert!(S <= K, "a block has more rows than blocks of its kind");
    for l in 0..lanes {
        let left: [Lane; S] = array(|r| n[r * lanes + l]);
        let found: [Lane; S] = array(|c| {
            let mut sum = [0.0; LANE];
            for r in 0..S {
                for i in 0..LANE {
                    sum[i] = left[r][i].mul_add(-inverse[c][r], sum[i]);
                }
            }
            sum
        });
        for c in 0..S {
            x[c * lanes + l] = found[c];
        }
        for r in 0..S {
            let (mut sum, mut turn) = (left[r], turns[r * lanes + l]);
            for c in 0..S {
                for i in 0..LANE {
                    sum[i] = found[c][i].mul_add(inside0[r][c], sum[i]);
                    turn[i] = found[c][i].mul_add(inside1[r][c], turn[i]);
                }
            }
            n[r * lanes + l] = array(|i| sum[i].abs() + h * turn[i].abs());
        }
    }
}
