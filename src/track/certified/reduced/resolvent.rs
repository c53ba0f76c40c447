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
    /// Where the rows of X and N start and end, one per row of A: padded to whole lanes, they
    /// reach to the end of their block.
    rows: Vec<(usize, usize)>,
    x: Vec<f64>,
    n: Vec<f64>,
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
            let end = start + size;
            // I − (what is left of the block) X, in the rows of N for the time being.
            for r in 0..size {
                let at = self.rows[start + r].0;
                let (e, sign) = (block.rows[r] as usize, block.signs[r]);
                self.n[at..at + end].fill(0.0);
                self.n[at + start + r] = 1.0;
                for axis in 0..D {
                    let other = self.other(equations, axis, e, sign);
                    if let Some(from) = other {
                        let factor = sign * d[0][axis][e];
                        let (from, to) = self.rows[from];
                        let (row, other) = (&mut self.n[at..at + to - from], &self.x[from..to]);
                        for (sum, x) in row.iter_mut().zip(other) {
                            *sum = x.mul_add(factor, *sum);
                        }
                    }
                }
            }
            for c in 0..size {
                let to = self.rows[start + c].0;
                let row = &mut self.x[to..to + end];
                row.fill(0.0);
                for r in 0..size {
                    let at = self.rows[start + r].0;
                    for (x, sum) in row.iter_mut().zip(&self.n[at..at + end]) {
                        *x = inverse[c][r].mul_add(*sum, *x);
                    }
                }
            }
            for r in 0..size {
                self.make_row(equations, block, r, d, h);
            }
            let mut b = [[0.0; 3]; 3];
            for r in 0..size {
                let at = self.rows[start + r].0;
                for j in start..end {
                    let mut entry = self.n[at + j];
                    for c in 0..size {
                        let spread = self.spread[block.axes[c] as usize][block.rows[r] as usize];
                        entry += spread * self.x[self.rows[start + c].0 + j].abs();
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
        let end = block.start + block.size;
        let at = self.rows[block.start + r].0;
        let (e, sign) = (block.rows[r] as usize, block.signs[r]);
        let mut terms = [(0usize, 0usize, 0.0, 0.0); 6];
        let mut count = 0;
        for c in 0..block.size {
            let axis = block.axes[c] as usize;
            let factors = d.map(|d| sign * d[axis][e]);
            terms[count] = (self.rows[block.start + c].0, end, factors[0], factors[1]);
            count += 1;
        }
        for axis in 0..D {
            if let Some(from) = self.other(equations, axis, e, sign) {
                let factors = d.map(|d| -sign * d[axis][e]);
                let (from, to) = self.rows[from];
                terms[count] = (from, to - from, factors[0], factors[1]);
                count += 1;
            }
        }
        let mut sums = [[0.0; LANE]; 2];
        for chunk in (0..end).step_by(LANE) {
            sums[0] = [0.0; LANE];
            sums[1] = [0.0; LANE];
            for &(from, len, a0, a1) in &terms[..count] {
                if chunk >= len {
                    continue;
                }
                // Rows are padded with zeros to whole lanes.
                let x: &[f64; LANE] = self.x[from + chunk..from + chunk + LANE]
                    .try_into()
                    .expect("a lane");
                for i in 0..LANE {
                    sums[0][i] = x[i].mul_add(a0, sums[0][i]);
                    sums[1][i] = x[i].mul_add(a1, sums[1][i]);
                }
            }
            for i in 0..LANE {
                let one = if chunk + i == block.start + r {
                    1.0
                } else {
                    0.0
                };
                self.n[at + chunk + i] = (sums[0][i] - one).abs() + h * sums[1][i].abs();
            }
        }
    }

    /// The row of X of the unknown at the other end of a distance, if it is one of A.
    #[inline(always)]
    fn other(&self, equations: &Equations<D>, axis: usize, e: usize, sign: f64) -> Option<usize> {
        let [i, j] = equations.ends[axis][e];
        let other = if sign > 0.0 { j } else { i };
        let position = self.position[other as usize] as usize;
        (position < self.rows.len()).then_some(position)
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
                let next = at + end.next_multiple_of(LANE);
                self.rows.push((at, next));
                at = next;
            }
        }
        self.x.clear();
        self.x.resize(at, 0.0);
        self.n.clear();
        self.n.resize(at, 0.0);
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
                let at = self.rows[start + r].0;
                let rows = self.n[at..at + start].iter().zip(&self.x[at..at + start]);
                let (mut sum, mut through) = (g[start + r], [0.0; LANE]);
                for ((n, x), y) in rows.zip(&y[..start]) {
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
                    if let Some(from) = self.other(equations, axis, e, sign) {
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
                let at = self.rows[start + c].0 + start;
                for r in 0..size {
                    let x = self.x[at + r].abs();
                    for i in 0..LANE {
                        near[c][i] = y[start + r][i].mul_add(x, near[c][i]);
                    }
                }
                v[start + c] = near[c];
            }
        }
    }
}
