//! Products with the Jacobian and substitution through its blocks, for all key unknowns at once.
//!
//! A row holds one number per key unknown, in W lanes. Unknowns have one row each, and a row of
//! zeros for fixed coordinates; equations have one row each, distances first, and one for the normal.
//!
//! Rows of the Jacobian are differences per axis for distances, and compressed lists of entries for
//! other equations, whose differences are zero; one comparison per row tells them apart.

use super::groups::each_entry;
use super::layout::{Block, Layout, WIDEST};
use crate::linalg::rstructure::rows::{Row, add, zeros};
use crate::linalg::{LANE, Vector};
use crate::track::full::Tail;

/// A derivative of the Jacobian along the path: differences per axis, the slopes of the right-hand sides,
/// and the entries of the tail's rows.
#[derive(Debug, Clone, Copy)]
pub struct Derivative<'a, const D: usize> {
    /// The ends of the distances, see [`crate::track::full::Equations::ends`].
    pub ends: &'a [Vec<[u32; 2]>; D],
    pub d: [&'a [f64]; D],
    pub slope: &'a [f64],
    /// Which unknown t is.
    pub t: usize,
    pub tail: &'a Tail,
    /// Values of the tail's entries.
    pub entries: &'a [f64],
}

impl<const D: usize> Derivative<'_, D> {
    /// Row e of J K, but for the tail's entries.
    #[inline(always)]
    fn row<const W: usize>(&self, e: usize, k: &[Row<W>]) -> Row<W> {
        let mut sum = [[0.0; LANE]; W];
        for axis in 0..D {
            let [i, j] = self.ends[axis][e];
            let (a, b, d) = (&k[i as usize], &k[j as usize], self.d[axis][e]);
            for w in 0..W {
                for l in 0..LANE {
                    sum[w][l] = d.mul_add(a[w][l] - b[w][l], sum[w][l]);
                }
            }
        }
        add(&mut sum, -self.slope[e], &k[self.t]);
        sum
    }

    /// Row e of J K for any equation.
    pub fn any_row<const W: usize>(&self, e: usize, k: &[Row<W>]) -> Row<W> {
        match e < self.tail.first() {
            true => self.row(e, k),
            false => self.tail_row(e, k, zeros()),
        }
    }

    /// The row of J K of one of the tail's equations, added to `sum`.
    #[inline(always)]
    fn tail_row<const W: usize>(&self, e: usize, k: &[Row<W>], mut sum: Row<W>) -> Row<W> {
        for (unknown, entry) in self.tail.row_with(e, self.entries) {
            add(&mut sum, entry, &k[unknown]);
        }
        add(&mut sum, -self.slope[e], &k[self.t]);
        sum
    }

    /// Adds the tail's entries in a row of J, times a row, to the rows of their unknowns.
    #[cold]
    #[inline(never)]
    fn add_tail_left<const W: usize>(&self, e: usize, z: &Row<W>, out: &mut [Row<W>]) {
        for (unknown, entry) in self.tail.row_with(e, self.entries) {
            add(&mut out[unknown], entry, z);
        }
    }

    /// Sets the rows of a block's unknowns whose rows are lists so that its rows of J K + what is `known` vanish.
    #[inline(never)]
    fn substitute_listed<const W: usize>(
        &self,
        block: &Block,
        inverse: &WideInverse,
        k: &mut [Row<W>],
        known: &impl Fn(usize, &mut Row<W>),
    ) {
        let mut sums = [zeros(); WIDEST];
        for (sum, &e) in sums.iter_mut().zip(&block.rows[..block.size]) {
            *sum = self.any_row(e as usize, k);
            known(e as usize, sum);
        }
        for c in 0..block.size {
            let row = &mut k[block.unknowns[c] as usize];
            for r in 0..block.size {
                add(row, -inverse[c][r], &sums[r]);
            }
        }
    }

    /// Sets the rows of the equations of a block whose rows are lists so that its columns in T + Zᵀ J vanish.
    #[inline(never)]
    fn substitute_left_listed<const W: usize>(
        &self,
        block: &Block,
        inverse: &WideInverse,
        t: &mut [Row<W>],
        z: &mut [Row<W>],
    ) {
        for r in 0..block.size {
            let mut sum = zeros();
            for c in 0..block.size {
                add(&mut sum, -inverse[c][r], &t[block.unknowns[c] as usize]);
            }
            z[block.rows[r] as usize] = sum;
        }
        // Those of its own block are not looked at again.
        for &e in &block.rows[..block.size] {
            self.add_left(e as usize, &z[e as usize], t);
        }
    }

    /// Sets the unknowns of a block whose rows are lists so that its rows in `f − J x` vanish.
    #[inline(never)]
    fn solve_listed(&self, block: &Block, inverse: &WideInverse, f: &[f64], x: &mut [f64]) {
        let mut rest = [0.0; WIDEST];
        for (rest, &e) in rest.iter_mut().zip(&block.rows[..block.size]) {
            *rest = f[e as usize] - self.any_row_of(e as usize, x);
        }
        for c in 0..block.size {
            x[block.unknowns[c] as usize] = (0..block.size).map(|r| inverse[c][r] * rest[r]).sum();
        }
    }

    /// `out += J K`.
    pub fn times<const W: usize>(&self, k: &[Row<W>], out: &mut [Row<W>]) {
        let (m, first) = (self.slope.len(), self.tail.first());
        let (ends, d) = (
            self.ends.each_ref().map(|ends| &ends[..first]),
            self.d.map(|d| &d[..first]),
        );
        let last = k[self.t];
        for ((e, out), slope) in out[..first].iter_mut().enumerate().zip(self.slope) {
            let mut sum = *out;
            for axis in 0..D {
                let [i, j] = ends[axis][e];
                let (a, b, d) = (&k[i as usize], &k[j as usize], d[axis][e]);
                for w in 0..W {
                    for l in 0..LANE {
                        sum[w][l] = d.mul_add(a[w][l] - b[w][l], sum[w][l]);
                    }
                }
            }
            add(&mut sum, -slope, &last);
            *out = sum;
        }
        for e in first..m {
            out[e] = self.tail_row(e, k, out[e]);
        }
    }

    /// `out += Zᵀ J`, without t: rows per equation times J, one row per unknown.
    pub fn times_left<const W: usize>(&self, z: &[Row<W>], out: &mut [Row<W>]) {
        let first = self.tail.first();
        for axis in 0..D {
            for ((ends, d), z) in self.ends[axis][..first].iter().zip(self.d[axis]).zip(z) {
                let [i, j] = ends.map(|end| end as usize);
                add(&mut out[i], *d, z);
                add(&mut out[j], -*d, z);
            }
        }
        for e in first..z.len() {
            self.add_tail_left(e, &z[e], out);
        }
    }

    /// `out += Zᵀ J` for one equation.
    #[inline(always)]
    pub fn add_left<const W: usize>(&self, e: usize, z: &Row<W>, out: &mut [Row<W>]) {
        for axis in 0..D {
            let [i, j] = self.ends[axis][e].map(|end| end as usize);
            add(&mut out[i], self.d[axis][e], z);
            add(&mut out[j], -self.d[axis][e], z);
        }
        if e >= self.tail.first() {
            self.add_tail_left(e, z, out);
        }
    }

    /// Sets the rows of A's unknowns so that the rows of A in J K + G vanish. They must be zero
    /// before; those of key unknowns stay as they are.
    pub fn substitute<const W: usize>(
        &self,
        layout: &Layout,
        inverses: &Inverses,
        g: &[Row<W>],
        k: &mut [Row<W>],
    ) {
        self.substitute_with(layout, inverses, k, |e, sum| add(sum, 1.0, &g[e]));
    }

    /// Sets the rows of A's unknowns so that the rows of A in J K vanish. They must be zero before; those of key
    /// unknowns stay as they are.
    pub fn substitute_alone<const W: usize>(
        &self,
        layout: &Layout,
        inverses: &Inverses,
        k: &mut [Row<W>],
    ) {
        self.substitute_with(layout, inverses, k, |_, _| {});
    }

    #[inline(always)]
    fn substitute_with<const W: usize>(
        &self,
        layout: &Layout,
        inverses: &Inverses,
        k: &mut [Row<W>],
        known: impl Fn(usize, &mut Row<W>),
    ) {
        for (block, inverse) in layout.blocks.iter().zip(&inverses.points) {
            if let Some(listed) = block.listed {
                self.substitute_listed(block, &inverses.listed[listed as usize], k, &known);
                continue;
            }
            let mut sums = [[[0.0; LANE]; W]; 3];
            for r in 0..block.size {
                let e = block.rows[r] as usize;
                sums[r] = self.row(e, k);
                known(e, &mut sums[r]);
            }
            for c in 0..block.size {
                let row = &mut k[block.unknowns[c] as usize];
                for r in 0..block.size {
                    add(row, -inverse[c][r], &sums[r]);
                }
            }
        }
    }

    /// Sets the rows of A's equations so that A's columns in T + Zᵀ J vanish, `t` being changed to
    /// what is left when those after a block are in.
    pub fn substitute_left<const W: usize>(
        &self,
        layout: &Layout,
        inverses: &Inverses,
        t: &mut [Row<W>],
        z: &mut [Row<W>],
    ) {
        for (block, inverse) in layout.blocks.iter().zip(&inverses.points).rev() {
            if let Some(listed) = block.listed {
                self.substitute_left_listed(block, &inverses.listed[listed as usize], t, z);
                continue;
            }
            for r in 0..block.size {
                let mut sum = [[0.0; LANE]; W];
                for c in 0..block.size {
                    add(&mut sum, -inverse[c][r], &t[block.unknowns[c] as usize]);
                }
                let e = block.rows[r] as usize;
                z[e] = sum;
                for axis in 0..D {
                    let [i, j] = self.ends[axis][e].map(|end| end as usize);
                    let other = if block.signs[r] > 0.0 { j } else { i };
                    add(&mut t[other], -block.signs[r] * self.d[axis][e], &sum);
                }
            }
        }
    }

    /// Sets A's unknowns in `x` so that the rows of A in `f − J x` vanish. They must be zero before; key unknowns
    /// stay as they are.
    pub fn solve(&self, layout: &Layout, inverses: &Inverses, f: &[f64], x: &mut [f64]) {
        for (block, inverse) in layout.blocks.iter().zip(&inverses.points) {
            if let Some(listed) = block.listed {
                self.solve_listed(block, &inverses.listed[listed as usize], f, x);
                continue;
            }
            let mut rest = [0.0; 3];
            for r in 0..block.size {
                let e = block.rows[r] as usize;
                rest[r] = f[e] - self.row_of(e, x);
            }
            for c in 0..block.size {
                x[block.unknowns[c] as usize] =
                    (0..block.size).map(|r| inverse[c][r] * rest[r]).sum();
            }
        }
    }

    /// Row e of J x, but for the tail's entries.
    #[inline(always)]
    fn row_of(&self, e: usize, x: &[f64]) -> f64 {
        let mut sum = -self.slope[e] * x[self.t];
        for axis in 0..D {
            let [i, j] = self.ends[axis][e];
            sum = self.d[axis][e].mul_add(x[i as usize] - x[j as usize], sum);
        }
        sum
    }

    /// Row e of J x for any equation.
    #[inline(always)]
    pub fn any_row_of(&self, e: usize, x: &[f64]) -> f64 {
        let head = self.row_of(e, x);
        if e < self.tail.first() {
            head
        } else {
            head + self.tail_row_of(e, x)
        }
    }

    #[cold]
    #[inline(never)]
    fn tail_row_of(&self, e: usize, x: &[f64]) -> f64 {
        let row = self.tail.row_with(e, self.entries);
        row.map(|(unknown, entry)| entry * x[unknown]).sum()
    }
}

/// The inverse of a diagonal block: `inverse[column][row]`.
pub type Inverse = [[f64; 3]; 3];

/// That of a block whose rows are lists.
pub type WideInverse = [[f64; WIDEST]; WIDEST];

/// The inverses of all diagonal blocks.
#[derive(Debug, Clone, Default)]
pub struct Inverses {
    /// By block; nothing for those whose rows are lists.
    pub points: Vec<Inverse>,
    /// Of those.
    pub listed: Vec<WideInverse>,
}

impl Inverses {
    /// Inverts all diagonal blocks.
    pub fn make<const D: usize>(&mut self, layout: &Layout, j: &Derivative<D>) {
        self.points.clear();
        self.listed.clear();
        for block in &layout.blocks {
            if block.listed.is_some() {
                self.points.push([[0.0; 3]; 3]);
                self.listed.push(invert_listed(block, j));
            } else {
                self.points.push(invert(block, j));
            }
        }
    }

    /// Whether the determinant of a block's inverse is negative.
    pub fn is_negative(&self, at: usize, block: &Block) -> bool {
        match block.listed {
            Some(listed) => {
                let mut a = self.listed[listed as usize];
                reduce(&mut a, block.size)
            }
            None => determinant(&self.points[at], block.size) < 0.0,
        }
    }
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

/// The inverse of a block whose rows are lists, as [`invert`] has it.
fn invert_listed<const D: usize>(block: &Block, j: &Derivative<D>) -> WideInverse {
    let mut a = [[0.0; WIDEST]; WIDEST];
    let unknowns = &block.unknowns[..block.size];
    for (a, &e) in a.iter_mut().zip(&block.rows[..block.size]) {
        let of = (j.ends, j.tail);
        each_entry(of, e as usize, (j.d, j.entries), -1.0, |unknown, entry| {
            if let Some(c) = unknowns.iter().position(|&u| u as usize == unknown) {
                a[c] += entry;
            }
        });
    }
    inverse_of(&a, block.size)
}

/// The inverse of `a[row][column]` by Gauss's and Jordan's elimination in floats, as `inverse[column][row]`: whoever
/// uses it finds out what it is worth.
pub fn inverse_of(a: &WideInverse, size: usize) -> WideInverse {
    let mut a = *a;
    let mut out = [[0.0; WIDEST]; WIDEST];
    (0..size).for_each(|k| out[k][k] = 1.0);
    for k in 0..size {
        let best = largest_below(&a, k, size);
        a.swap(k, best);
        out.swap(k, best);
        let scale = 1.0 / a[k][k];
        for c in 0..size {
            a[k][c] *= scale;
            out[k][c] *= scale;
        }
        let (row, solved) = (a[k], out[k]);
        for r in (0..size).filter(|&r| r != k) {
            let factor = a[r][k];
            for c in 0..size {
                a[r][c] -= factor * row[c];
                out[r][c] -= factor * solved[c];
            }
        }
    }
    out
}

/// Where the largest entry of a column is, from the diagonal on.
fn largest_below(a: &WideInverse, k: usize, size: usize) -> usize {
    let mut best = k;
    for r in k..size {
        if a[r][k].abs() > a[best][k].abs() {
            best = r;
        }
    }
    best
}

/// Makes a matrix triangular, and tells whether its determinant is negative, as floats see it.
fn reduce(a: &mut WideInverse, size: usize) -> bool {
    let mut negative = false;
    for k in 0..size {
        let best = largest_below(a, k, size);
        a.swap(k, best);
        negative ^= (best != k) != (a[k][k] < 0.0);
        let row = a[k];
        for other in &mut a[k + 1..size] {
            let factor = other[k] / row[k];
            (k..size).for_each(|c| other[c] -= factor * row[c]);
        }
    }
    negative
}

/// The inverse of `a[row][column]` by its adjugate, as `inverse[column][row]`: whoever uses it finds
/// out what it is worth.
#[inline]
pub fn by_adjugate(a: &[[f64; 3]; 3]) -> Inverse {
    let minor = |r: usize, c: usize| {
        let (r1, r2, c1, c2) = ((r + 1) % 3, (r + 2) % 3, (c + 1) % 3, (c + 2) % 3);
        a[r1][c1] * a[r2][c2] - a[r1][c2] * a[r2][c1]
    };
    let determinant: f64 = (0..3).map(|c| a[0][c] * minor(0, c)).sum();
    let scale = 1.0 / determinant;
    let mut out = [[0.0; 3]; 3];
    for c in 0..3 {
        for r in 0..3 {
            out[c][r] = minor(r, c) * scale;
        }
    }
    out
}

/// The entries of a diagonal block whose rows are distances: `entries[row][column]`.
pub fn entries<const D: usize>(block: &Block, j: &Derivative<D>) -> Inverse {
    let mut out = [[0.0; 3]; 3];
    for r in 0..block.size {
        let e = block.rows[r] as usize;
        for c in 0..block.size {
            let axis = block.axes[c] as usize;
            out[r][c] = block.signs[r] * j.d[axis][e];
        }
    }
    out
}

/// The inverse of a diagonal block by its adjugate; what it is worth is found out elsewhere.
pub fn invert<const D: usize>(block: &Block, j: &Derivative<D>) -> Inverse {
    let a = entries(block, j);
    let mut out = [[0.0; 3]; 3];
    match block.size {
        1 => out[0][0] = 1.0 / a[0][0],
        2 => {
            let scale = 1.0 / (a[0][0] * a[1][1] - a[0][1] * a[1][0]);
            out[0] = [a[1][1] * scale, -a[0][1] * scale, 0.0];
            out[1] = [-a[1][0] * scale, a[0][0] * scale, 0.0];
        }
        _ => out = by_adjugate(&a),
    }
    out
}

/// Views of d as slices.
pub fn slices<const D: usize>(d: &[Vector; D]) -> [&[f64]; D] {
    d.each_ref().map(|d| &d[..])
}
