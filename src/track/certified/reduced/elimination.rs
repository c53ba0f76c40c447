//! Elimination through the R-structure at one point: what refines and expands the path.

use super::layout::{Layout, Order};
use super::passes::{Derivative, Inverse, Lane, add, invert, slices, width_for, with_width};
use crate::linalg::{LANE, Singular, Vector};
use crate::track::full::{Equations, Lengths, dot};
use std::sync::Arc;

/// What is kept from one point to the next.
#[derive(Debug, Clone)]
pub struct Maker<const D: usize> {
    order: Order<D>,
    layout: Arc<Layout>,
    alpha: f64,
}

impl<const D: usize> Maker<D> {
    /// Nothing is chosen until the first point.
    pub fn new(order: Order<D>, alpha: f64) -> Self {
        let alpha = (SINES * alpha).min(0.5);
        Maker {
            order,
            layout: Arc::new(Layout::default()),
            alpha,
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
        }
    }

    /// Factors [J; c] at a point, with the layout that suits it.
    pub fn make(
        &mut self,
        maker: &mut Maker<D>,
        equations: &Equations<D>,
        at: (&[Vector; D], &Lengths, &Vector),
    ) -> Result<(), Singular> {
        let layout = maker.order.layout(at.0, maker.alpha);
        if layout != *maker.layout {
            maker.layout = Arc::new(layout);
        }
        self.make_like(&maker.layout, equations, at)
    }

    /// The same with a layout given, however its pivots are.
    pub fn make_like(
        &mut self,
        layout: &Arc<Layout>,
        equations: &Equations<D>,
        (d, lengths, normal): (&[Vector; D], &Lengths, &Vector),
    ) -> Result<(), Singular> {
        self.layout = layout.clone();
        let entries = slices(d);
        self.inverses.clear();
        let inverses = layout.blocks.iter().map(|block| invert(block, &entries));
        self.inverses.extend(inverses);
        let width = width_for(self.layout.keys()).filter(|_| self.layout.is_square());
        self.width = width.ok_or(Singular)?;
        for (kept, d) in self.d.iter_mut().zip(d) {
            kept.copy_from_slice(d);
        }
        self.slope.copy_from_slice(&lengths.terms[1]);
        self.normal.copy_from_slice(normal);
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
        let mut schur = Schur::new(keys);
        for (l, &e) in self.layout.ignored.iter().enumerate() {
            schur.set(l, jacobian.row(e as usize, rows).as_flattened());
        }
        let mut last = [[0.0; LANE]; W];
        for (c, row) in self.normal[..n].iter().zip(rows.iter()) {
            add(&mut last, *c, row);
        }
        schur.set(keys - 1, last.as_flattened());
        self.k = k;
        self.p.clear();
        self.p.resize(keys * W, [0.0; LANE]);
        let inverted = schur.invert(self.p.as_flattened_mut(), W * LANE);
        inverted.then_some(()).ok_or(Singular)
    }

    /// The Jacobian at this point.
    pub fn jacobian<'a>(&'a self, equations: &'a Equations<D>) -> Derivative<'a, D> {
        Derivative {
            ends: &equations.ends,
            d: slices(&self.d),
            slope: &self.slope,
            t: equations.m,
        }
    }

    /// `x = [J; c]⁻¹ f`; entries of `f` beyond its end are zero.
    pub fn solve(&self, equations: &Equations<D>, f: &[f64], x: &mut Vector) {
        let (m, n) = (equations.m, equations.n());
        let jacobian = self.jacobian(equations);
        x.fill(0.0);
        jacobian.solve(&self.layout, &self.inverses, f, x);
        let mut values = [0.0; MAX_KEYS];
        let mut set = |row: &[Lane], rest: f64| {
            for (value, p) in values.iter_mut().zip(row.as_flattened()) {
                *value = p.mul_add(rest, *value);
            }
        };
        let rows = self.p.chunks_exact(self.width);
        for (row, &e) in rows.clone().zip(&self.layout.ignored) {
            let e = e as usize;
            set(row, f[e] - jacobian.row_of(e, x));
        }
        let last = f.get(m).copied().unwrap_or(0.0) - dot(&self.normal[..n], &x[..n]);
        rows.last().into_iter().for_each(|row| set(row, last));
        // The key unknowns' own rows are the identity.
        for (x, row) in x[..n].iter_mut().zip(self.k.chunks_exact(self.width)) {
            let products = row.as_flattened().iter().zip(&values);
            *x += products.map(|(k, value)| k * value).sum::<f64>();
        }
    }
}

/// More key unknowns than that are not supported.
pub const MAX_KEYS: usize = 8 * LANE;

/// Work space: a small dense matrix.
struct Schur {
    n: usize,
    a: [[f64; MAX_KEYS]; MAX_KEYS],
}

impl Schur {
    fn new(n: usize) -> Self {
        Schur {
            n,
            a: [[0.0; MAX_KEYS]; MAX_KEYS],
        }
    }

    fn set(&mut self, row: usize, from: &[f64]) {
        self.a[row][..self.n].copy_from_slice(&from[..self.n]);
    }

    /// The inverse's transpose, into rows of the given stride. False: singular.
    fn invert(&mut self, out: &mut [f64], stride: usize) -> bool {
        let n = self.n;
        let a = &mut self.a;
        // Gauss and Jordan in place; `from[k]` is the row that became row k.
        let mut from = [0usize; MAX_KEYS];
        for (k, from) in from.iter_mut().enumerate() {
            *from = k;
        }
        for k in 0..n {
            let best = (k..n)
                .max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))
                .unwrap_or(k);
            a.swap(k, best);
            from.swap(k, best);
            let pivot = a[k][k];
            if pivot == 0.0 || !pivot.is_finite() {
                return false;
            }
            let scale = 1.0 / pivot;
            a[k][k] = 1.0;
            for x in &mut a[k][..n] {
                *x *= scale;
            }
            let row = a[k];
            for i in (0..n).filter(|&i| i != k) {
                let factor = a[i][k];
                a[i][k] = 0.0;
                for j in 0..n {
                    a[i][j] -= factor * row[j];
                }
            }
        }
        // Column k of the result belongs to the row that was brought there.
        for i in 0..n {
            for k in 0..n {
                out[from[k] * stride + i] = a[i][k];
            }
        }
        true
    }
}
