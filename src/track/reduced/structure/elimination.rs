//! Elimination through the R-structure at one point: what refines and expands the path.

use super::layout::{Layout, Order};
use super::passes::{Derivative, Inverse, Lane, Row, add, invert, slices, width_for, with_width};
use crate::linalg::{LANE, Singular, Vector};
use crate::track::full::{Differences, Equations, Lengths, dot};
use std::sync::Arc;

/// What is kept from one point to the next.
#[derive(Debug, Clone)]
pub struct Maker<const D: usize> {
    order: Order<D>,
    layout: Arc<Layout>,
    /// Work space.
    candidate: Layout,
    alpha: f64,
    /// Whether a layout is chosen at the next point; otherwise that of the point before is taken.
    pub chooses: bool,
}

impl<const D: usize> Maker<D> {
    /// Nothing is chosen until the first point.
    pub fn new(order: Order<D>, alpha: f64) -> Self {
        let alpha = (SINES * alpha).min(0.5);
        Maker {
            order,
            layout: Arc::new(Layout::default()),
            candidate: Layout::default(),
            alpha,
            chooses: true,
        }
    }
}

/// Directions of distances are told apart by their sines, of which so many times α is asked: measured,
/// see docs/reduced.md.
const SINES: f64 = 2.5;

/// The factors at one point.
#[derive(Debug, Clone)]
pub struct Elimination<const D: usize> {
    pub layout: Arc<Layout>,
    /// Lanes of a row.
    pub width: usize,
    pub inverses: Vec<Inverse>,
    /// K₀ = −A⁻¹H with the identity for the key unknowns: a row per unknown and one of zeros.
    pub k: Vec<Lane>,
    /// S₀⁻¹ transposed: for each ignored equation (the normal's last) a row over key unknowns.
    pub p: Vec<Lane>,
    d: [Vector; D],
    slope: Vector,
    normal: Vector,
    /// Values of the tail's entries.
    entries: Vec<f64>,
    /// Whether det S₀ is negative.
    schur_is_negative: bool,
}

impl<const D: usize> Elimination<D> {
    /// Room for one.
    pub fn new(equations: &Equations<D>) -> Self {
        Elimination {
            layout: Arc::new(Layout::default()),
            width: 1,
            inverses: Vec::new(),
            k: Vec::new(),
            p: Vec::new(),
            d: std::array::from_fn(|_| equations.per_edge()),
            slope: equations.per_edge(),
            normal: equations.vector(),
            entries: vec![0.0; equations.tail.entries()],
            schur_is_negative: false,
        }
    }

    /// Factors [J; c] at a point, with the layout that suits it, or as it was if the maker does not
    /// choose.
    pub fn make(
        &mut self,
        maker: &mut Maker<D>,
        equations: &Equations<D>,
        at: (&Differences<D>, &Lengths, &Vector),
    ) -> Result<(), Singular> {
        if !maker.chooses {
            let layout = self.layout.clone();
            return self.make_like(&layout, equations, at);
        }
        maker
            .order
            .choose(equations, at.0, maker.alpha, &mut maker.candidate);
        if maker.candidate != *maker.layout {
            maker.layout = Arc::new(maker.candidate.clone());
        }
        self.make_like(&maker.layout, equations, at)
    }

    /// The same with a layout given, however its pivots are.
    pub fn make_like(
        &mut self,
        layout: &Arc<Layout>,
        equations: &Equations<D>,
        (d, lengths, normal): (&Differences<D>, &Lengths, &Vector),
    ) -> Result<(), Singular> {
        self.layout = layout.clone();
        for (kept, d) in self.d.iter_mut().zip(&d.axes) {
            kept.copy_from_slice(d);
        }
        self.slope.copy_from_slice(&lengths.terms[1]);
        self.normal.copy_from_slice(normal);
        equations.tail.row_values(&d.forms, &mut self.entries);
        let mut inverses = std::mem::take(&mut self.inverses);
        inverses.clear();
        let jacobian = self.jacobian(equations);
        inverses.extend(layout.blocks.iter().map(|block| invert(block, &jacobian)));
        self.inverses = inverses;
        let width = width_for(self.layout.keys()).filter(|_| self.layout.is_square());
        self.width = width.ok_or(Singular)?;
        with_width!(self.width, self.eliminate(equations))
    }

    fn eliminate<const W: usize>(&mut self, equations: &Equations<D>) -> Result<(), Singular> {
        let (n, keys) = (equations.n(), self.layout.keys());
        let mut k = std::mem::take(&mut self.k);
        k.clear();
        k.resize((n + 1) * W, [0.0; LANE]);
        let (rows, _) = k.as_chunks_mut::<W>();
        for (at, &key) in self.layout.keys.iter().enumerate() {
            rows[key as usize][at / LANE][at % LANE] = 1.0;
        }
        let jacobian = self.jacobian(equations);
        jacobian.substitute_alone(&self.layout, &self.inverses, rows);
        // S₀: the ignored equations' rows of J K, and the normal's.
        let mut schur = [[[[0.0; LANE]; W]; LANE]; W];
        let s = schur.as_flattened_mut();
        for (s, &e) in s.iter_mut().zip(&self.layout.ignored) {
            *s = jacobian.any_row(e as usize, rows);
        }
        for (c, row) in self.normal[..n].iter().zip(rows.iter()) {
            add(&mut s[keys - 1], *c, row);
        }
        self.k = k;
        self.p.resize(keys * W, [0.0; LANE]);
        let inverted = invert_transposed(&mut s[..keys], self.p.as_chunks_mut::<W>().0);
        self.schur_is_negative = inverted.ok_or(Singular)?;
        Ok(())
    }

    /// Why none could be made last, where that is not because the matrix is singular.
    pub fn obstacle(&self) -> Option<String> {
        let keys = self.layout.keys();
        (keys > MAX_KEYS).then(|| {
            format!(
                "the construction plan has {keys} key unknowns, more than the {MAX_KEYS} that the reduced \
                 space has room for"
            )
        })
    }

    /// Whether det [J; c] is negative, as floats see it: A's blocks times S₀, and the order of rows and
    /// columns.
    pub fn is_negative(&self, equations: &Equations<D>) -> bool {
        let layout = &*self.layout;
        let mut negative = self.schur_is_negative;
        for (block, inverse) in layout.blocks.iter().zip(&self.inverses) {
            negative ^= determinant(inverse, block.size) < 0.0;
        }
        let blocks = || layout.blocks.iter();
        let rows = blocks().flat_map(|b| b.rows[..b.size].iter().copied());
        let rows = rows.chain(layout.ignored.iter().copied());
        let columns = blocks().flat_map(|b| b.unknowns[..b.size].iter().copied());
        let columns = columns.chain(layout.keys.iter().copied());
        let normal = equations.m as u32;
        negative ^ is_odd(rows.chain([normal])) ^ is_odd(columns)
    }

    /// The Jacobian at this point.
    pub fn jacobian<'a>(&'a self, equations: &'a Equations<D>) -> Derivative<'a, D> {
        Derivative {
            ends: &equations.ends,
            d: slices(&self.d),
            slope: &self.slope,
            t: equations.m,
            tail: &equations.tail,
            entries: &self.entries,
        }
    }

    /// `x = [J; c]⁻¹ f`; entries of `f` beyond its end are zero.
    pub fn solve(&self, equations: &Equations<D>, f: &[f64], x: &mut Vector) {
        with_width!(self.width, self.solve_in(equations, f, x))
    }

    fn solve_in<const W: usize>(&self, equations: &Equations<D>, f: &[f64], x: &mut Vector) {
        let (m, n) = (equations.m, equations.n());
        let jacobian = self.jacobian(equations);
        x.fill(0.0);
        jacobian.solve(&self.layout, &self.inverses, f, x);
        let mut values = [[0.0; LANE]; W];
        let (rows, last) = self.p.as_chunks::<W>().0.split_at(self.layout.keys() - 1);
        for (row, &e) in rows.iter().zip(&self.layout.ignored) {
            let e = e as usize;
            add(&mut values, f[e] - jacobian.any_row_of(e, x), row);
        }
        let rest = f.get(m).copied().unwrap_or(0.0) - dot(&self.normal[..n], &x[..n]);
        add(&mut values, rest, &last[0]);
        // The key unknowns' own rows are the identity.
        for (x, row) in x[..n].iter_mut().zip(self.k.as_chunks::<W>().0) {
            let mut sums = [0.0; LANE];
            for w in 0..W {
                for l in 0..LANE {
                    sums[l] = row[w][l].mul_add(values[w][l], sums[l]);
                }
            }
            *x += (sums[0] + sums[1]) + (sums[2] + sums[3]);
        }
    }
}

/// More key unknowns than that are not supported.
pub const MAX_KEYS: usize = 8 * LANE;

/// The inverse's transpose of the square matrix with these rows, padded with zeros to whole lanes.
/// They are overwritten. Tells whether the determinant is negative; `None`: singular.
fn invert_transposed<const W: usize>(a: &mut [Row<W>], out: &mut [Row<W>]) -> Option<bool> {
    let n = a.len();
    let mut negative = false;
    // Gauss and Jordan in place; `from[k]` is the row that became row k.
    let mut from: [usize; MAX_KEYS] = std::array::from_fn(|k| k);
    for k in 0..n {
        let (w, l) = (k / LANE, k % LANE);
        let best = (k..n)
            .max_by(|&i, &j| a[i][w][l].abs().total_cmp(&a[j][w][l].abs()))
            .unwrap_or(k);
        a.swap(k, best);
        from.swap(k, best);
        let pivot = a[k][w][l];
        if pivot == 0.0 || !pivot.is_finite() {
            return None;
        }
        negative ^= (best != k) != (pivot < 0.0);
        let scale = 1.0 / pivot;
        a[k][w][l] = 1.0;
        for lane in &mut a[k] {
            *lane = lane.map(|x| x * scale);
        }
        let row = a[k];
        for (i, other) in a.iter_mut().enumerate() {
            if i != k {
                let factor = -other[w][l];
                other[w][l] = 0.0;
                add(other, factor, &row);
            }
        }
    }
    // Column k of the result belongs to the row that was brought there.
    for (i, a) in a.iter().enumerate() {
        for (a, &from) in a.as_flattened().iter().zip(&from[..n]) {
            out[from][i / LANE][i % LANE] = *a;
        }
    }
    Some(negative)
}

/// Of a diagonal block's inverse.
fn determinant(a: &Inverse, size: usize) -> f64 {
    let minor = |r: usize, c: usize| a[1][r] * a[2][c] - a[1][c] * a[2][r];
    match size {
        1 => a[0][0],
        2 => a[0][0] * a[1][1] - a[0][1] * a[1][0],
        _ => a[0][0] * minor(1, 2) - a[0][1] * minor(0, 2) + a[0][2] * minor(0, 1),
    }
}

/// Whether a permutation of 0, 1, … is odd.
fn is_odd(permutation: impl Iterator<Item = u32>) -> bool {
    let mut next: Vec<u32> = permutation.collect();
    let mut odd = false;
    for k in 0..next.len() {
        // Each exchange brings one number to its place.
        while next[k] as usize != k {
            let to = next[k] as usize;
            next.swap(k, to);
            odd = !odd;
        }
    }
    odd
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn permutations_are_even_or_odd() {
        assert!(!is_odd([0, 1, 2, 3].into_iter()));
        assert!(is_odd([1, 0, 2, 3].into_iter()));
        assert!(!is_odd([1, 2, 0, 3].into_iter()));
        assert!(is_odd([1, 2, 3, 0].into_iter()));
        assert!(!is_odd([1, 0, 3, 2].into_iter()));
    }
}
