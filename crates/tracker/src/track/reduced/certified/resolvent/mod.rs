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
//! (docs/how/tubes.md).

mod listed;

use super::diagonal::{bound_on_inverse, bound_on_wide_inverse};
use crate::interval::rounding::round_up;
use crate::linalg::rstructure::Lane;
use crate::linalg::{LANE, Vector, with_axes};
use crate::places::{Each as _, array};
use crate::track::full::Equations;
use crate::track::reduced::structure::layout::{Block, Kind, Layout, WIDEST};
use crate::track::reduced::structure::passes::Inverses;
use listed::Lists;

/// What a bound on |A(s)⁻¹| needs of one diagonal block.
#[derive(Debug, Clone, Copy)]
struct Diagonal<const K: usize> {
    /// R ≥ (I − N − Â|X|)⁻¹.
    bound: [[f64; K]; K],
    /// Â.
    spread: [[f64; K]; K],
}

impl<const K: usize> Default for Diagonal<K> {
    fn default() -> Self {
        let [bound, spread] = [[[0.0; K]; K]; 2];
        Diagonal { bound, spread }
    }
}

/// X ≈ A₀⁻¹, N = |A₀ X − I| + H |A₁ X| and Â of a tube, from which bounds on |A(s)⁻¹ g| follow for |s| ≤ H.
#[derive(Debug, Clone)]
pub struct Resolvent {
    /// Which lanes the rows of X and N are, one per row of A: padded with zeros, they reach to the
    /// end of their block, and those of a block are next to each other.
    rows: Vec<(usize, usize)>,
    x: Vec<Lane>,
    n: Vec<Lane>,
    /// Â by axis and distance, and by entry of the tail's rows.
    spread: Vec<Vector>,
    spread_of_tail: Vec<f64>,
    /// What bounds the inverse of each diagonal block; nothing for those of more than three rows, which have theirs apart.
    diagonal: Vec<Diagonal<3>>,
    wide: Vec<Diagonal<WIDEST>>,
    lists: Lists,
    /// The position in A of each unknown of A; otherwise too large.
    position: Vec<u32>,
    /// More roundings than any number in a bound goes through.
    roundings: usize,
}

impl Resolvent {
    /// Room for one.
    pub fn new(equations: &Equations) -> Self {
        Resolvent {
            rows: Vec::new(),
            x: Vec::new(),
            n: Vec::new(),
            spread: equations.per_axis(),
            spread_of_tail: vec![0.0; equations.tail.entries()],
            diagonal: Vec::new(),
            wide: Vec::new(),
            lists: Lists::default(),
            position: Vec::new(),
            roundings: 0,
        }
    }

    /// Â, to be filled before [`Resolvent::make`].
    pub fn spread_mut(&mut self) -> (&mut [Vector], &mut [f64]) {
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
        equations: &Equations,
        layout: &Layout,
        inverses: &Inverses,
        values: ([&[Vector]; 2], [&[f64]; 2]),
        h: f64,
    ) -> bool {
        self.lay_out(equations, layout);
        self.diagonal.clear();
        self.wide.clear();
        self.lists.clear(layout.order);
        for (block, inverse) in layout.blocks.iter().zip(&inverses.points) {
            let (b, spread) = match block.kind {
                Kind::Point => with_axes!(self.spread.len(), D => {
                    self.make_point::<D>(equations, block, inverse, values.0, h)
                }),
                Kind::Listed => self.make_listed(equations, block, inverse, values, h),
                Kind::Wide(at) => {
                    let inverse = &inverses.wide[at as usize];
                    let (b, spread) = self.make_listed(equations, block, inverse, values, h);
                    let mut wide = Diagonal {
                        spread,
                        ..Diagonal::default()
                    };
                    if !bound_on_wide_inverse(&b, block.size, &mut wide.bound) {
                        return false;
                    }
                    self.wide.push(wide);
                    self.diagonal.push(Diagonal::default());
                    continue;
                }
            };
            match bound_on_inverse(&b, block.size) {
                Some(bound) => self.diagonal.push(Diagonal { bound, spread }),
                None => return false,
            }
        }
        true
    }

    /// X and N in a block of distances, from the inverse of its diagonal block and the differences of order 0 and 1. Returns
    /// what N + Â|X| and Â have in it.
    #[inline(always)]
    fn make_point<const D: usize>(
        &mut self,
        equations: &Equations,
        block: &Block,
        inverse: &[[f64; 3]; 3],
        d: [&[Vector]; 2],
        h: f64,
    ) -> ([[f64; 3]; 3], [[f64; 3]; 3]) {
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
            self.make_row::<D>(equations, block, r, d, h);
        }
        let spread = self.spreads(block);
        (self.in_block(block, &spread), spread)
    }

    /// What N + Â|X| has in a block, from Â's entries there, once its rows of X and N are made.
    #[inline(always)]
    fn in_block<const K: usize>(&self, block: &Block, spread: &[[f64; K]; K]) -> [[f64; K]; K] {
        let (start, size) = (block.start, block.size);
        let (first, next) = self.rows[start];
        let lanes = next - first;
        let mut b = [[0.0; K]; K];
        for r in 0..size {
            for j in start..start + size {
                let (l, i) = (j / LANE, j % LANE);
                let mut entry = self.n[first + r * lanes + l][i];
                for c in 0..size {
                    entry += spread[r][c] * self.x[first + c * lanes + l][i].abs();
                }
                b[r][j - start] = round_up(entry, self.roundings);
            }
        }
        b
    }

    /// Row r of a block in N: |A₀ X − I| + H |A₁ X|.
    fn make_row<const D: usize>(
        &mut self,
        equations: &Equations,
        block: &Block,
        r: usize,
        d: [&[Vector]; 2],
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
            add(block.start + c, d.each(|d| sign * d[axis][e]));
        }
        for axis in 0..D {
            if let Some(row) = other(&self.position, equations, axis, e, sign) {
                add(row, d.each(|d| -sign * d[axis][e]));
            }
        }
        sum_row(&mut self.n[at..end], &terms[..count], block.start + r, h);
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

    /// Of each row of a block, g + N y and |X| y from the columns before the block.
    #[inline(always)]
    fn before<const K: usize>(
        &self,
        (start, size): (usize, usize),
        g: &[Lane],
        y: &[Lane],
    ) -> ([Lane; K], [Lane; K]) {
        let (mut rest, mut near) = ([[0.0; LANE]; K], [[0.0; LANE]; K]);
        let mut r = 0;
        // Several rows at once, so that no sum waits for another; five or six are three and the rest.
        while r < size {
            let at = start + r;
            r += match size - r {
                1 => self.rows_before::<1>((at, start), g, y, (&mut rest[r..], &mut near[r..])),
                2 => self.rows_before::<2>((at, start), g, y, (&mut rest[r..], &mut near[r..])),
                4 => self.rows_before::<4>((at, start), g, y, (&mut rest[r..], &mut near[r..])),
                _ => self.rows_before::<3>((at, start), g, y, (&mut rest[r..], &mut near[r..])),
            };
        }
        (rest, near)
    }

    /// The same for S rows, from row `at` of A on. Returns S, by how many `at` moves on.
    #[inline(always)]
    fn rows_before<const S: usize>(
        &self,
        (at, start): (usize, usize),
        g: &[Lane],
        y: &[Lane],
        (rest, near): (&mut [Lane], &mut [Lane]),
    ) -> usize {
        let y = &y[..start];
        let n: [&[f64]; S] = array(|r| self.row(&self.n, at + r, start));
        let x: [&[f64]; S] = array(|r| self.row(&self.x, at + r, start));
        let mut sums: [Lane; S] = array(|r| g[at + r]);
        let mut through = [[0.0; LANE]; S];
        for (column, y) in y.iter().enumerate() {
            for r in 0..S {
                let (n, x) = (n[r][column], x[r][column].abs());
                for i in 0..LANE {
                    sums[r][i] = y[i].mul_add(n, sums[r][i]);
                    through[r][i] = y[i].mul_add(x, through[r][i]);
                }
            }
        }
        rest[..S].copy_from_slice(&sums);
        near[..S].copy_from_slice(&through);
        S
    }

    /// The first entries of a row of X or N.
    #[inline(always)]
    fn row<'a>(&self, of: &'a [Lane], row: usize, count: usize) -> &'a [f64] {
        let (at, end) = self.rows[row];
        &of[at..end].as_flattened()[..count]
    }

    fn lay_out(&mut self, equations: &Equations, layout: &Layout) {
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
            .fold(equations.dimension(), |max, block| max.max(block.size));
        let count = equations.roundings();
        self.roundings = count.of_inverse(layout.blocks.len(), layout.order, widest);
    }

    /// `v ≥ |A(s)⁻¹| g` for four right-hand sides g ≥ 0 at once: `g` and `y` (work space) per row of A,
    /// `v` per column. To be rounded up by the caller, see [`Resolvent::roundings`].
    pub fn bound(
        &self,
        equations: &Equations,
        layout: &Layout,
        g: &[Lane],
        y: &mut [Lane],
        v: &mut [Lane],
    ) {
        for (block, diagonal) in layout.blocks.iter().zip(&self.diagonal) {
            match block.kind {
                Kind::Point => self.bound_point(equations, block, diagonal, g, (y, v)),
                Kind::Listed => self.bound_listed(block, diagonal, g, (y, v)),
                Kind::Wide(at) => self.bound_listed(block, &self.wide[at as usize], g, (y, v)),
            }
        }
    }

    /// The same for a block of distances.
    #[inline(always)]
    fn bound_point(
        &self,
        equations: &Equations,
        block: &Block,
        diagonal: &Diagonal<3>,
        g: &[Lane],
        (y, v): (&mut [Lane], &mut [Lane]),
    ) {
        let (start, size) = (block.start, block.size);
        let (mut rest, mut near) = self.before::<3>((start, size), g, y);
        for r in 0..size {
            let (e, sign) = (block.rows[r] as usize, block.signs[r]);
            for axis in 0..equations.dimension() {
                if let Some(from) = other(&self.position, equations, axis, e, sign) {
                    let spread = self.spread[axis][e];
                    for i in 0..LANE {
                        rest[r][i] = v[from][i].mul_add(spread, rest[r][i]);
                    }
                }
            }
            for c in 0..size {
                let spread = diagonal.spread[r][c];
                for i in 0..LANE {
                    rest[r][i] = near[c][i].mul_add(spread, rest[r][i]);
                }
            }
        }
        self.close((start, size), &diagonal.bound, (&rest, &mut near), (y, v));
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
fn other(
    position: &[u32],
    equations: &Equations,
    axis: usize,
    e: usize,
    sign: f64,
) -> Option<usize> {
    let [i, j] = equations.ends[axis][e];
    let other = if sign > 0.0 { j } else { i };
    let position = position[other as usize];
    (position != u32::MAX).then_some(position as usize)
}
