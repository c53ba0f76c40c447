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

use super::diagonal::bound_on_inverse;
use super::layout::{Block, Layout};
use super::passes::{Inverse, Lane};
use crate::interval::rounding::round_up;
use crate::linalg::{LANE, Vector};
use crate::track::full::Equations;

/// See above.
#[derive(Debug, Clone)]
pub struct Resolvent<const D: usize> {
    /// Which lanes the rows of X and N are, one per row of A: padded with zeros, they reach to the
    /// end of their block, and those of a block are next to each other.
    rows: Vec<(usize, usize)>,
    x: Vec<Lane>,
    n: Vec<Lane>,
    /// Â by axis and distance.
    spread: [Vector; D],
    /// R for each block.
    diagonal: Vec<[[f64; 3]; 3]>,
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
            diagonal: Vec::new(),
            position: Vec::new(),
            roundings: 0,
        }
    }

    /// Â, to be filled before [`Resolvent::make`].
    pub fn spread_mut(&mut self) -> &mut [Vector; D] {
        &mut self.spread
    }

    /// More roundings than any number in a bound goes through.
    pub fn roundings(&self) -> usize {
        self.roundings
    }

    /// Computes X and N for |s| ≤ `h`, the differences of order 0 and 1 being given. False: the bound
    /// does not exist for such a long tube.
    pub fn make(
        &mut self,
        equations: &Equations<D>,
        layout: &Layout,
        inverses: &[Inverse],
        d: [&[Vector; D]; 2],
        h: f64,
    ) -> bool {
        self.lay_out(equations, layout);
        self.diagonal.clear();
        for (block, inverse) in layout.blocks.iter().zip(inverses) {
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
            let mut b = [[0.0; 3]; 3];
            for r in 0..size {
                for j in start..start + size {
                    let (l, i) = (j / LANE, j % LANE);
                    let mut entry = self.n[first + r * lanes + l][i];
                    for c in 0..size {
                        let spread = self.spread[block.axes[c] as usize][block.rows[r] as usize];
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
        let one = block.start + r;
        for (l, n) in self.n[at..end].iter_mut().enumerate() {
            let mut sums = [[0.0; LANE]; 2];
            for (x, [a0, a1]) in &terms[..count] {
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
        let largest = layout.order + D + 10;
        self.roundings = (layout.blocks.len() + 4) * 2 * largest + 200;
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
            let mut rest = [[0.0; LANE]; 3];
            let mut near = [[0.0; LANE]; 3];
            for r in 0..size {
                let (at, end) = self.rows[start + r];
                let rows = [&self.n, &self.x].map(|rows| &rows[at..end].as_flattened()[..start]);
                let (mut sum, mut through) = (g[start + r], [0.0; LANE]);
                for ((n, x), y) in rows[0].iter().zip(rows[1]).zip(&y[..start]) {
                    let x = x.abs();
                    for i in 0..LANE {
                        sum[i] = y[i].mul_add(*n, sum[i]);
                        through[i] = y[i].mul_add(x, through[i]);
                    }
                }
                (rest[r], near[r]) = (sum, through);
            }
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
                    let spread = self.spread[block.axes[c] as usize][e];
                    for i in 0..LANE {
                        rest[r][i] = near[c][i].mul_add(spread, rest[r][i]);
                    }
                }
            }
            for r in 0..size {
                let mut sum = [0.0; LANE];
                for (bound, rest) in bounds[r][..size].iter().zip(&rest) {
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
