//! A bound on |A(s)⁻¹| along a tube, A(s) being the block lower triangular part of the Jacobian.
//!
//! Let X ≈ A₀⁻¹, block lower triangular like A, and A(s) X = I + Ñ(s). For |s| ≤ H
//!
//! ```text
//! |Ñ(s)| ≤ N + Â|X|,    N = |A₀ X − I| + H |A₁ X|,    Â = Σ_{k≥2} Hᵏ |A_k| + rounding
//! ```
//!
//! so that for A(s) v = g with v = X y the vector y solves y = g − Ñ y, and |v| ≤ |X| ŷ for any
//! ŷ ≥ |g| + (N + Â|X|) ŷ. All of it is block lower triangular: ŷ is found by substitution, and A(s) is
//! regular if the diagonal blocks of N + Â|X| are smaller than one. Only what X leaves over is
//! bounded without its signs from block to block; that is what keeps the wrapping effect small
//! (docs/reduced.md).

use super::diagonal::{bound_on_inverse, bound_on_wide_inverse};
use crate::interval::rounding::round_up;
use crate::linalg::rstructure::rows::Lane;
use crate::linalg::{LANE, Vector};
use crate::track::full::Equations;
use crate::track::reduced::structure::groups::each_entry;
use crate::track::reduced::structure::layout::{Block, Layout, WIDEST};
use crate::track::reduced::structure::passes::{Inverses, WideInverse};

/// X ≈ A₀⁻¹, N = |A₀ X − I| + H |A₁ X| and Â of a tube, from which bounds on |A(s)⁻¹ g| follow for |s| ≤ H.
#[derive(Debug, Clone)]
pub struct Resolvent<const D: usize> {
    /// Which lanes the rows of X and N are, one per row of A: padded with zeros, they reach to the
    /// end of their block, and those of a block are next to each other.
    rows: Vec<(usize, usize)>,
    x: Vec<Lane>,
    n: Vec<Lane>,
    /// Â by axis and distance, and by entry of the tail's rows.
    spread: [Vector; D],
    spread_of_tail: Vec<f64>,
    /// R for each block; nothing for those whose rows are lists, which have theirs apart.
    diagonal: Vec<[[f64; 3]; 3]>,
    listed: Vec<WideInverse>,
    /// The position in A of each unknown of A; otherwise too large.
    position: Vec<u32>,
    /// More roundings than any number in a bound goes through.
    roundings: usize,
}

impl<const D: usize> Resolvent<D> {
    /// Room for one.
    pub fn new(equations: &Equations<D>) -> Self {
        Resolvent {
            rows: Vec::new(),
            x: Vec::new(),
            n: Vec::new(),
            spread: std::array::from_fn(|_| equations.per_edge()),
            spread_of_tail: vec![0.0; equations.tail.entries()],
            diagonal: Vec::new(),
            listed: Vec::new(),
            position: Vec::new(),
            roundings: 0,
        }
    }

    /// Â, to be filled before [`Resolvent::make`].
    pub fn spread_mut(&mut self) -> (&mut [Vector; D], &mut [f64]) {
        (&mut self.spread, &mut self.spread_of_tail)
    }

    /// More roundings than any number in a bound goes through.
    pub fn roundings(&self) -> usize {
        self.roundings
    }

    /// Computes X and N for |s| ≤ `h`, the differences of order 0 and 1 and the values of the tail's entries
    /// being given. False: the bound does not exist for such a long tube.
    pub fn make(
        &mut self,
        equations: &Equations<D>,
        layout: &Layout,
        inverses: &Inverses,
        (d, entries): ([&[Vector; D]; 2], [&[f64]; 2]),
        h: f64,
    ) -> bool {
        self.lay_out(equations, layout);
        self.diagonal.clear();
        self.listed.clear();
        for (block, inverse) in layout.blocks.iter().zip(&inverses.points) {
            if let Some(listed) = block.listed {
                let inverse = &inverses.listed[listed as usize];
                self.diagonal.push([[0.0; 3]; 3]);
                if !self.make_listed(equations, block, inverse, (d, entries), h) {
                    return false;
                }
                continue;
            }
            let (start, size) = (block.start, block.size);
            let (first, next) = self.rows[start];
            let lanes = next - first;
            let (before, x) = self.x.split_at_mut(first);
            let n = &mut self.n[first..first + size * lanes];
            // I − (what is left of the block) X, in the rows of N for the time being.
            for (r, n) in n.chunks_exact_mut(lanes).enumerate() {
                let (e, sign) = (block.rows[r] as usize, block.signs[r]);
                n.fill([0.0; LANE]);
                n[(start + r) / LANE][(start + r) % LANE] = 1.0;
                for axis in 0..D {
                    if let Some(row) = other(&self.position, equations, axis, e, sign) {
                        let factor = sign * d[0][axis][e];
                        let (from, to) = self.rows[row];
                        for (sum, x) in n.iter_mut().zip(&before[from..to]) {
                            for i in 0..LANE {
                                sum[i] = x[i].mul_add(factor, sum[i]);
                            }
                        }
                    }
                }
            }
            for (x, inverse) in x.chunks_exact_mut(lanes).zip(&inverse[..size]) {
                for (l, x) in x.iter_mut().enumerate() {
                    let mut sum = [0.0; LANE];
                    for r in 0..size {
                        for i in 0..LANE {
                            sum[i] = n[r * lanes + l][i].mul_add(inverse[r], sum[i]);
                        }
                    }
                    *x = sum;
                }
            }
            for r in 0..size {
                self.make_row(equations, block, r, d, h);
            }
            let spreads = self.spreads(block);
            let mut b = [[0.0; 3]; 3];
            for r in 0..size {
                for j in start..start + size {
                    let (l, i) = (j / LANE, j % LANE);
                    let mut entry = self.n[first + r * lanes + l][i];
                    for c in 0..size {
                        let spread = spreads[r][c];
                        entry += spread * self.x[first + c * lanes + l][i].abs();
                    }
                    b[r][j - start] = round_up(entry, self.roundings);
                }
            }
            match bound_on_inverse(&b, size) {
                Some(bound) => self.diagonal.push(bound),
                None => return false,
            }
        }
        true
    }

    /// Row r of a block in N: |A₀ X − I| + H |A₁ X|.
    fn make_row(
        &mut self,
        equations: &Equations<D>,
        block: &Block,
        r: usize,
        d: [&[Vector; D]; 2],
        h: f64,
    ) {
        let (at, end) = self.rows[block.start + r];
        let (e, sign) = (block.rows[r] as usize, block.signs[r]);
        let mut terms: [(&[Lane], [f64; 2]); 6] = [(&[], [0.0; 2]); 6];
        let mut count = 0;
        let mut add = |row: usize, factors: [f64; 2]| {
            let (from, to) = self.rows[row];
            terms[count] = (&self.x[from..to], factors);
            count += 1;
        };
        for c in 0..block.size {
            let axis = block.axes[c] as usize;
            add(block.start + c, d.map(|d| sign * d[axis][e]));
        }
        for axis in 0..D {
            if let Some(row) = other(&self.position, equations, axis, e, sign) {
                add(row, d.map(|d| -sign * d[axis][e]));
            }
        }
        sum_row(&mut self.n[at..end], &terms[..count], block.start + r, h);
    }

    /// X and N in a block whose rows are lists. False: the bound does not exist.
    #[inline(never)]
    fn make_listed(
        &mut self,
        equations: &Equations<D>,
        block: &Block,
        inverse: &WideInverse,
        (d, entries): ([&[Vector; D]; 2], [&[f64]; 2]),
        h: f64,
    ) -> bool {
        let (start, size) = (block.start, block.size);
        let (first, next) = self.rows[start];
        let lanes = next - first;
        let of = (&equations.ends, &equations.tail);
        let [d0, d1] = d.map(|d| d.each_ref().map(|d| &d[..]));
        let (before, x) = self.x.split_at_mut(first);
        let n = &mut self.n[first..first + size * lanes];
        // I − (what is left of the block) X, in the rows of N for the time being.
        for (r, n) in n.chunks_exact_mut(lanes).enumerate() {
            n.fill([0.0; LANE]);
            n[(start + r) / LANE][(start + r) % LANE] = 1.0;
            let e = block.rows[r] as usize;
            each_entry(of, e, (d0, entries[0]), -1.0, |unknown, entry| {
                let row = self.position[unknown] as usize;
                // Neither key nor of this block.
                if row < start {
                    let (from, to) = self.rows[row];
                    for (sum, x) in n.iter_mut().zip(&before[from..to]) {
                        for i in 0..LANE {
                            sum[i] = x[i].mul_add(-entry, sum[i]);
                        }
                    }
                }
            });
        }
        for (x, inverse) in x.chunks_exact_mut(lanes).zip(&inverse[..size]) {
            for (l, x) in x.iter_mut().enumerate() {
                let mut sum = [0.0; LANE];
                for r in 0..size {
                    for i in 0..LANE {
                        sum[i] = n[r * lanes + l][i].mul_add(inverse[r], sum[i]);
                    }
                }
                *x = sum;
            }
        }
        for r in 0..size {
            // |A₀ X − I| + H |A₁ X|. Room for all but very long rows.
            let mut room: [(&[Lane], [f64; 2]); 24] = [(&[], [0.0; 2]); 24];
            let (mut count, mut more) = (0, Vec::new());
            let e = block.rows[r] as usize;
            let mut put = |unknown: usize, entries: [f64; 2]| {
                if let Some(&(from, to)) = self.rows.get(self.position[unknown] as usize) {
                    let term = (&self.x[from..to], entries);
                    match room.get_mut(count) {
                        Some(room) => *room = term,
                        None => more.push(term),
                    }
                    count += 1;
                }
            };
            if e < equations.tail.first() {
                for axis in 0..D {
                    let ends = equations.ends[axis][e].map(|end| end as usize);
                    let at = [d0[axis][e], d1[axis][e]];
                    put(ends[0], at);
                    put(ends[1], at.map(|d| -d));
                }
            } else {
                for entry in equations.tail.row(e) {
                    let at = entries.map(|entries| entries[entry]);
                    put(equations.tail.unknown(entry), at);
                }
            }
            let (at, end) = self.rows[start + r];
            let n = &mut self.n[at..end];
            if count <= room.len() {
                sum_row(n, &room[..count], start + r, h);
            } else {
                let all: Vec<_> = room.into_iter().chain(more).collect();
                sum_row(n, &all, start + r, h);
            }
        }
        let spreads = self.wide_spreads(equations, block);
        let mut b = [[0.0; WIDEST]; WIDEST];
        for r in 0..size {
            for j in start..start + size {
                let (l, i) = (j / LANE, j % LANE);
                let mut entry = self.n[first + r * lanes + l][i];
                for c in 0..size {
                    entry += spreads[r][c] * self.x[first + c * lanes + l][i].abs();
                }
                b[r][j - start] = round_up(entry, self.roundings);
            }
        }
        match bound_on_wide_inverse(&b, size) {
            Some(bound) => {
                self.listed.push(bound);
                true
            }
            None => false,
        }
    }

    /// Â in a block.
    #[inline(always)]
    fn spreads(&self, block: &Block) -> [[f64; 3]; 3] {
        let mut out = [[0.0; 3]; 3];
        for r in 0..block.size {
            for c in 0..block.size {
                out[r][c] = self.spread[block.axes[c] as usize][block.rows[r] as usize];
            }
        }
        out
    }

    /// Calls a function with the unknowns of an equation and Â's entries for them.
    #[inline(always)]
    fn each_spread(&self, equations: &Equations<D>, e: usize, to: impl FnMut(usize, f64)) {
        let of = (&equations.ends, &equations.tail);
        let spread = self.spread.each_ref().map(|spread| &spread[..]);
        each_entry(of, e, (spread, &self.spread_of_tail), 1.0, to);
    }

    /// Â in a block whose rows are lists.
    fn wide_spreads(&self, equations: &Equations<D>, block: &Block) -> WideInverse {
        let mut out = [[0.0; WIDEST]; WIDEST];
        for (out, &e) in out.iter_mut().zip(&block.rows[..block.size]) {
            self.each_spread(equations, e as usize, |unknown, spread| {
                let place = (self.position[unknown] as usize).wrapping_sub(block.start);
                if place < block.size {
                    out[place] += spread;
                }
            });
        }
        out
    }

    /// What [`Resolvent::bound`] does for a block whose rows are lists.
    #[inline(never)]
    fn bound_listed(
        &self,
        equations: &Equations<D>,
        block: &Block,
        bounds: &WideInverse,
        g: &[Lane],
        (y, v): (&mut [Lane], &mut [Lane]),
    ) {
        let (start, size) = (block.start, block.size);
        let mut rest = [[0.0; LANE]; WIDEST];
        let mut near = [[0.0; LANE]; WIDEST];
        for r in 0..size {
            (rest[r], near[r]) = self.before(start + r, start, g[start + r], y);
        }
        let spreads = self.wide_spreads(equations, block);
        for r in 0..size {
            let rest = &mut rest[r];
            self.each_spread(equations, block.rows[r] as usize, |unknown, spread| {
                let from = self.position[unknown] as usize;
                // Neither key nor of this block.
                if from < start {
                    for i in 0..LANE {
                        rest[i] = v[from][i].mul_add(spread, rest[i]);
                    }
                }
            });
            for c in 0..size {
                for i in 0..LANE {
                    rest[i] = near[c][i].mul_add(spreads[r][c], rest[i]);
                }
            }
        }
        self.close((start, size), bounds, (&rest, &mut near), (y, v));
    }

    /// y and v in a block: y from what is left of its rows, and v from that and from what is near of its columns.
    #[inline(always)]
    fn close<const K: usize>(
        &self,
        (start, size): (usize, usize),
        bounds: &[[f64; K]; K],
        (rest, near): (&[Lane; K], &mut [Lane; K]),
        (y, v): (&mut [Lane], &mut [Lane]),
    ) {
        for r in 0..size {
            let mut sum = [0.0; LANE];
            for (bound, rest) in bounds[r][..size].iter().zip(rest) {
                for i in 0..LANE {
                    sum[i] = rest[i].mul_add(*bound, sum[i]);
                }
            }
            y[start + r] = sum;
        }
        for c in 0..size {
            let (at, end) = self.rows[start + c];
            let x = &self.x[at..end].as_flattened()[start..];
            for r in 0..size {
                let x = x[r].abs();
                for i in 0..LANE {
                    near[c][i] = y[start + r][i].mul_add(x, near[c][i]);
                }
            }
            v[start + c] = near[c];
        }
    }

    /// Of a row, g + N y and |X| y from the columns before `start`.
    #[inline(always)]
    fn before(&self, row: usize, start: usize, g: Lane, y: &[Lane]) -> (Lane, Lane) {
        let (at, end) = self.rows[row];
        let rows = [&self.n, &self.x].map(|rows| &rows[at..end].as_flattened()[..start]);
        let (mut sum, mut through) = (g, [0.0; LANE]);
        for ((n, x), y) in rows[0].iter().zip(rows[1]).zip(&y[..start]) {
            let x = x.abs();
            for i in 0..LANE {
                sum[i] = y[i].mul_add(*n, sum[i]);
                through[i] = y[i].mul_add(x, through[i]);
            }
        }
        (sum, through)
    }

    fn lay_out(&mut self, equations: &Equations<D>, layout: &Layout) {
        self.position.clear();
        self.position.resize(equations.n() + 1, u32::MAX);
        self.rows.clear();
        let mut at = 0;
        for block in &layout.blocks {
            let end = block.start + block.size;
            for c in 0..block.size {
                self.position[block.unknowns[c] as usize] = (block.start + c) as u32;
                let next = at + end.div_ceil(LANE);
                self.rows.push((at, next));
                at = next;
            }
        }
        // All of them are computed.
        self.x.resize(at, [0.0; LANE]);
        self.n.resize(at, [0.0; LANE]);
        let widest = layout
            .blocks
            .iter()
            .fold(D, |max, block| max.max(block.size));
        let count = equations.roundings();
        self.roundings = count.of_inverse(layout.blocks.len(), layout.order, widest);
    }

    /// `v ≥ |A(s)⁻¹| g` for four right-hand sides g ≥ 0 at once: `g` and `y` (work space) per row of A,
    /// `v` per column. To be rounded up by the caller, see [`Resolvent::roundings`].
    pub fn bound(
        &self,
        equations: &Equations<D>,
        layout: &Layout,
        g: &[Lane],
        y: &mut [Lane],
        v: &mut [Lane],
    ) {
        for (block, bounds) in layout.blocks.iter().zip(&self.diagonal) {
            let (start, size) = (block.start, block.size);
            if let Some(listed) = block.listed {
                let bounds = &self.listed[listed as usize];
                self.bound_listed(equations, block, bounds, g, (y, v));
                continue;
            }
            let mut rest = [[0.0; LANE]; 3];
            let mut near = [[0.0; LANE]; 3];
            for r in 0..size {
                (rest[r], near[r]) = self.before(start + r, start, g[start + r], y);
            }
            let spreads = self.spreads(block);
            for r in 0..size {
                let (e, sign) = (block.rows[r] as usize, block.signs[r]);
                for axis in 0..D {
                    if let Some(from) = other(&self.position, equations, axis, e, sign) {
                        let spread = self.spread[axis][e];
                        for i in 0..LANE {
                            rest[r][i] = v[from][i].mul_add(spread, rest[r][i]);
                        }
                    }
                }
                for c in 0..size {
                    let spread = spreads[r][c];
                    for i in 0..LANE {
                        rest[r][i] = near[c][i].mul_add(spread, rest[r][i]);
                    }
                }
            }
            self.close((start, size), bounds, (&rest, &mut near), (y, v));
        }
    }
}

/// |Σ a₀ x − 1| + H |Σ a₁ x| over rows x of X, the 1 in one place.
#[inline(always)]
fn sum_row(n: &mut [Lane], terms: &[(&[Lane], [f64; 2])], one: usize, h: f64) {
    for (l, n) in n.iter_mut().enumerate() {
        let mut sums = [[0.0; LANE]; 2];
        for (x, [a0, a1]) in terms {
            if let Some(x) = x.get(l) {
                for i in 0..LANE {
                    sums[0][i] = x[i].mul_add(*a0, sums[0][i]);
                    sums[1][i] = x[i].mul_add(*a1, sums[1][i]);
                }
            }
        }
        if l == one / LANE {
            sums[0][one % LANE] -= 1.0;
        }
        for i in 0..LANE {
            n[i] = sums[0][i].abs() + h * sums[1][i].abs();
        }
    }
}

/// The row of X of the unknown at the other end of a distance, if it is one of A.
#[inline(always)]
fn other<const D: usize>(
    position: &[u32],
    equations: &Equations<D>,
    axis: usize,
    e: usize,
    sign: f64,
) -> Option<usize> {
    let [i, j] = equations.ends[axis][e];
    let other = if sign > 0.0 { j } else { i };
    let position = position[other as usize];
    (position != u32::MAX).then_some(position as usize)
}
