//! Products with the Jacobian and substitution through its blocks, for all key unknowns at once.
//!
//! A row holds one number per key unknown, in W lanes. Unknowns have one row each, and a row of
//! zeros for fixed coordinates; equations have one row each, distances first, and one for the normal.
//!
//! Rows of the Jacobian are differences per axis for distances, and compressed lists of entries for
//! other equations, whose differences are zero; one comparison per row tells them apart.

use super::layout::{Block, Layout};
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

    /// Whether a block has rows of the tail: the last of its rows is one then.
    #[inline(always)]
    fn has_tail(&self, block: &Block) -> bool {
        block.has_tail(self.tail.first())
    }

    /// The rows of J K of a block with rows of the tail.
    #[cold]
    #[inline(never)]
    fn rows_with_tails<const W: usize>(&self, block: &Block, k: &[Row<W>]) -> [Row<W>; 3] {
        let mut sums = [zeros(); 3];
        for (sum, &e) in sums.iter_mut().zip(&block.rows[..block.size]) {
            *sum = self.any_row(e as usize, k);
        }
        sums
    }

    /// What is left of a block's right-hand side without the tail's entries of its rows in J x.
    #[cold]
    #[inline(never)]
    fn without_tails(&self, block: &Block, x: &[f64], mut rest: [f64; 3]) -> [f64; 3] {
        for (rest, &e) in rest.iter_mut().zip(&block.rows[..block.size]) {
            for (unknown, entry) in self.tail.row_with(e as usize, self.entries) {
                *rest -= entry * x[unknown];
            }
        }
        rest
    }

    /// A diagonal block with the tail's entries.
    #[cold]
    #[inline(never)]
    fn with_tail_entries(&self, block: &Block, mut out: Inverse) -> Inverse {
        for r in 0..block.size {
            let e = block.rows[r] as usize;
            if e >= self.tail.first() {
                for c in 0..block.size {
                    let entry = self.tail.entry(e, block.unknowns[c] as usize);
                    out[r][c] = entry.map_or(0.0, |entry| self.entries[entry]);
                }
            }
        }
        out
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
        inverses: &[Inverse],
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
        inverses: &[Inverse],
        k: &mut [Row<W>],
    ) {
        self.substitute_with(layout, inverses, k, |_, _| {});
    }

    #[inline(always)]
    fn substitute_with<const W: usize>(
        &self,
        layout: &Layout,
        inverses: &[Inverse],
        k: &mut [Row<W>],
        known: impl Fn(usize, &mut Row<W>),
    ) {
        for (block, inverse) in layout.blocks.iter().zip(inverses) {
            let mut sums = [[[0.0; LANE]; W]; 3];
            if self.has_tail(block) {
                sums = self.rows_with_tails(block, k);
                for r in 0..block.size {
                    known(block.rows[r] as usize, &mut sums[r]);
                }
            } else {
                for r in 0..block.size {
                    let e = block.rows[r] as usize;
                    sums[r] = self.row(e, k);
                    known(e, &mut sums[r]);
                }
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
        inverses: &[Inverse],
        t: &mut [Row<W>],
        z: &mut [Row<W>],
    ) {
        for (block, inverse) in layout.blocks.iter().zip(inverses).rev() {
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
            if self.has_tail(block) {
                // Those of its own block are not looked at again.
                for &e in &block.rows[..block.size] {
                    self.add_tail_left(e as usize, &z[e as usize], t);
                }
            }
        }
    }

    /// Sets A's unknowns in `x` so that the rows of A in `f − J x` vanish. They must be zero before; key unknowns
    /// stay as they are.
    pub fn solve(&self, layout: &Layout, inverses: &[Inverse], f: &[f64], x: &mut [f64]) {
        for (block, inverse) in layout.blocks.iter().zip(inverses) {
            let mut rest = [0.0; 3];
            for r in 0..block.size {
                let e = block.rows[r] as usize;
                rest[r] = f[e] - self.row_of(e, x);
            }
            if self.has_tail(block) {
                rest = self.without_tails(block, x, rest);
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

/// The entries of a diagonal block: `entries[row][column]`.
pub fn entries<const D: usize>(block: &Block, j: &Derivative<D>) -> Inverse {
    let mut out = [[0.0; 3]; 3];
    for r in 0..block.size {
        let e = block.rows[r] as usize;
        for c in 0..block.size {
            let axis = block.axes[c] as usize;
            out[r][c] = block.signs[r] * j.d[axis][e];
        }
    }
    if j.has_tail(block) {
        out = j.with_tail_entries(block, out);
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
