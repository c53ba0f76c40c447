//! Products with the Jacobian and substitution through its blocks, for all key unknowns at once.
//!
//! A row holds one number per key unknown, in W lanes. Unknowns have one row each, and a row of
//! zeros for fixed coordinates; equations have one row each, distances first, and one for the normal.
//!
//! Rows of the Jacobian are differences per axis for distances, and compressed lists of entries for
//! other equations, whose differences are zero; one comparison per row tells them apart.

use super::layout::{Block, Kind, Layout, WIDEST};
use crate::linalg::rstructure::{Row, add, invert_transposed, zeros};
use crate::linalg::{LANE, Vector, with_axes};
use crate::places::{Each as _, array};
use crate::track::full::Tail;

/// A derivative of the Jacobian along the path: differences per axis, the slopes of the right-hand sides,
/// and the entries of the tail's rows.
#[derive(Debug, Clone, Copy)]
pub struct Derivative<'a> {
    /// The ends of the distances, see [`crate::track::full::Equations::ends`].
    pub ends: &'a [Vec<[u32; 2]>],
    pub d: &'a [Vector],
    pub slope: &'a [f64],
    /// Which unknown t is.
    pub t: usize,
    pub tail: &'a Tail,
    /// Values of the tail's entries.
    pub entries: &'a [f64],
}

/// What a derivative has of distances, for inner loops over the axes.
#[derive(Clone, Copy)]
struct Head<'a, const D: usize> {
    ends: [&'a [[u32; 2]]; D],
    d: [&'a [f64]; D],
    slope: &'a [f64],
    t: usize,
}

impl<const D: usize> Head<'_, D> {
    /// Adds row e of J K to `sum`.
    #[inline(always)]
    fn row<const W: usize>(&self, e: usize, k: &[Row<W>], mut sum: Row<W>) -> Row<W> {
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

    /// Row e of J x.
    #[inline(always)]
    fn row_of(&self, e: usize, x: &[f64]) -> f64 {
        let mut sum = -self.slope[e] * x[self.t];
        for axis in 0..D {
            let [i, j] = self.ends[axis][e];
            sum = self.d[axis][e].mul_add(x[i as usize] - x[j as usize], sum);
        }
        sum
    }

    /// Sets the rows of a point's unknowns so that its rows of J K + what is `known` vanish.
    #[inline(always)]
    fn substitute<const W: usize>(
        &self,
        block: &Block,
        inverse: &Inverse,
        k: &mut [Row<W>],
        known: &impl Fn(usize, &mut Row<W>),
    ) {
        let mut sums = [zeros(); 3];
        for r in 0..block.size {
            let e = block.rows[r] as usize;
            sums[r] = self.row(e, k, zeros());
            known(e, &mut sums[r]);
        }
        for c in 0..block.size {
            let row = &mut k[block.unknowns[c] as usize];
            for r in 0..block.size {
                add(row, -inverse[c][r], &sums[r]);
            }
        }
    }

    /// Adds row e of J, times a row, to the rows of its unknowns.
    #[inline(always)]
    fn add_left<const W: usize>(&self, e: usize, z: &Row<W>, out: &mut [Row<W>]) {
        for axis in 0..D {
            let [i, j] = self.ends[axis][e].each(|end| end as usize);
            add(&mut out[i], self.d[axis][e], z);
            add(&mut out[j], -self.d[axis][e], z);
        }
    }

    /// Sets the rows of a point's equations so that its columns in T + Zᵀ J vanish.
    #[inline(always)]
    fn substitute_left<const W: usize>(
        &self,
        block: &Block,
        inverse: &Inverse,
        t: &mut [Row<W>],
        z: &mut [Row<W>],
    ) {
        for r in 0..block.size {
            let mut sum = [[0.0; LANE]; W];
            for c in 0..block.size {
                add(&mut sum, -inverse[c][r], &t[block.unknowns[c] as usize]);
            }
            let e = block.rows[r] as usize;
            z[e] = sum;
            for axis in 0..D {
                let [i, j] = self.ends[axis][e].each(|end| end as usize);
                let other = if block.signs[r] > 0.0 { j } else { i };
                add(&mut t[other], -block.signs[r] * self.d[axis][e], &sum);
            }
        }
    }

    /// Sets A's unknowns in `x` so that the rows of A in `f − J x` vanish.
    fn solve(&self, layout: &Layout, inverses: &Inverses, f: &[f64], x: &mut [f64]) {
        for (block, inverse) in layout.blocks.iter().zip(&inverses.points) {
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
}

impl<'a> Derivative<'a> {
    #[inline(always)]
    fn head<const D: usize>(&self) -> Head<'a, D> {
        let first = self.tail.first();
        Head {
            ends: array(|axis| &self.ends[axis][..first]),
            d: array(|axis| &self.d[axis][..first]),
            slope: &self.slope[..first],
            t: self.t,
        }
    }

    /// Row e of J K for any equation.
    pub fn any_row<const W: usize>(&self, e: usize, k: &[Row<W>]) -> Row<W> {
        match e < self.tail.first() {
            true => with_axes!(self.d.len(), D => self.head::<D>().row(e, k, zeros())),
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
    #[inline(always)]
    fn add_tail_left<const W: usize>(&self, e: usize, z: &Row<W>, out: &mut [Row<W>]) {
        for (unknown, entry) in self.tail.row_with(e, self.entries) {
            add(&mut out[unknown], entry, z);
        }
    }

    /// Sets the rows of a block's unknowns whose rows are lists so that its rows of J K + what is `known` vanish.
    #[inline(never)]
    fn substitute_listed<const W: usize, const K: usize>(
        &self,
        block: &Block,
        inverse: &[[f64; K]; K],
        k: &mut [Row<W>],
        known: &impl Fn(usize, &mut Row<W>),
    ) {
        let mut sums = [zeros(); K];
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
    fn substitute_left_listed<const W: usize, const K: usize>(
        &self,
        block: &Block,
        inverse: &[[f64; K]; K],
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

    /// `out += J K`.
    pub fn times<const W: usize>(&self, k: &[Row<W>], out: &mut [Row<W>]) {
        let first = self.tail.first();
        with_axes!(self.d.len(), D => {
            let head = self.head::<D>();
            for (e, out) in out[..first].iter_mut().enumerate() {
                *out = head.row(e, k, *out);
            }
        });
        for e in first..self.slope.len() {
            out[e] = self.tail_row(e, k, out[e]);
        }
    }

    /// `out += Zᵀ J`, without t: rows per equation times J, one row per unknown.
    pub fn times_left<const W: usize>(&self, z: &[Row<W>], out: &mut [Row<W>]) {
        let first = self.tail.first();
        for (ends, d) in self.ends.iter().zip(self.d) {
            for ((ends, d), z) in ends[..first].iter().zip(&d[..]).zip(z) {
                let [i, j] = ends.each(|end| end as usize);
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
        if e >= self.tail.first() {
            return self.add_tail_left(e, z, out);
        }
        with_axes!(self.d.len(), D => self.head::<D>().add_left(e, z, out));
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
        let known = |e: usize, sum: &mut Row<W>| add(sum, 1.0, &g[e]);
        with_axes!(self.d.len(), D => self.substitute_with::<D, W>(layout, inverses, k, &known));
    }

    /// Sets the rows of A's unknowns so that the rows of A in J K vanish. They must be zero before; those of key
    /// unknowns stay as they are.
    pub fn substitute_alone<const W: usize>(
        &self,
        layout: &Layout,
        inverses: &Inverses,
        k: &mut [Row<W>],
    ) {
        let known = |_, _: &mut Row<W>| {};
        with_axes!(self.d.len(), D => self.substitute_with::<D, W>(layout, inverses, k, &known));
    }

    #[inline(always)]
    fn substitute_with<const D: usize, const W: usize>(
        &self,
        layout: &Layout,
        inverses: &Inverses,
        k: &mut [Row<W>],
        known: &impl Fn(usize, &mut Row<W>),
    ) {
        let head = self.head::<D>();
        for (block, inverse) in layout.blocks.iter().zip(&inverses.points) {
            match block.kind {
                Kind::Point => head.substitute(block, inverse, k, known),
                Kind::Listed => self.substitute_listed(block, inverse, k, known),
                Kind::Wide(at) => {
                    self.substitute_listed(block, &inverses.wide[at as usize], k, known)
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
        with_axes!(self.d.len(), D => self.substitute_left_with::<D, W>(layout, inverses, t, z));
    }

    #[inline(always)]
    fn substitute_left_with<const D: usize, const W: usize>(
        &self,
        layout: &Layout,
        inverses: &Inverses,
        t: &mut [Row<W>],
        z: &mut [Row<W>],
    ) {
        let head = self.head::<D>();
        for (block, inverse) in layout.blocks.iter().zip(&inverses.points).rev() {
            match block.kind {
                Kind::Point => head.substitute_left(block, inverse, t, z),
                Kind::Listed => self.substitute_left_listed(block, inverse, t, z),
                Kind::Wide(at) => {
                    self.substitute_left_listed(block, &inverses.wide[at as usize], t, z)
                }
            }
        }
    }

    /// Where all rows are distances (see [`Substitution`](super::substitution::Substitution) for others), sets A's unknowns
    /// in `x` so that the rows of A in `f − J x` vanish. They must be zero before; key unknowns stay as they are.
    pub fn solve(&self, layout: &Layout, inverses: &Inverses, f: &[f64], x: &mut [f64]) {
        debug_assert!(self.tail.is_empty());
        with_axes!(self.d.len(), D => self.head::<D>().solve(layout, inverses, f, x));
    }

    /// Row e of J x for any equation.
    #[inline(always)]
    pub fn any_row_of(&self, e: usize, x: &[f64]) -> f64 {
        if e < self.tail.first() {
            with_axes!(self.d.len(), D => self.head::<D>().row_of(e, x))
        } else {
            self.tail_row_of(e, x)
        }
    }

    #[inline(always)]
    fn tail_row_of(&self, e: usize, x: &[f64]) -> f64 {
        let row = self.tail.row_with(e, self.entries);
        let time = -self.slope[e] * x[self.t];
        row.fold(time, |sum, (unknown, entry)| entry.mul_add(x[unknown], sum))
    }
}

/// The inverse of a diagonal block: `inverse[column][row]`.
pub type Inverse = [[f64; 3]; 3];

/// That of a block of more than three rows.
pub type WideInverse = [[f64; WIDEST]; WIDEST];

/// The inverses of all diagonal blocks.
#[derive(Debug, Clone, Default)]
pub struct Inverses {
    /// By block; nothing for those of more than three rows.
    pub points: Vec<Inverse>,
    /// Of those, and whether their determinants are negative.
    pub wide: Vec<WideInverse>,
    negative: Vec<bool>,
}

impl Inverses {
    /// Inverts all diagonal blocks where all rows are distances.
    pub fn make(&mut self, layout: &Layout, j: &Derivative) {
        debug_assert!(j.tail.is_empty());
        self.clear();
        for block in &layout.blocks {
            self.points.push(invert(block, j));
        }
    }

    /// None any more.
    pub fn clear(&mut self) {
        self.points.clear();
        self.wide.clear();
        self.negative.clear();
    }

    /// The inverse of the next block, of three rows at most.
    pub fn push(&mut self, entries: &[[f64; 3]; 3], size: usize) {
        self.points.push(inverse_of_small(entries, size));
    }

    /// The inverse of the next block, of more rows.
    pub fn push_wide(&mut self, entries: &WideInverse, size: usize) {
        self.points.push([[0.0; 3]; 3]);
        self.wide.push([[0.0; WIDEST]; WIDEST]);
        let inverse = self.wide.last_mut().expect("pushed");
        self.negative.push(invert_wide(entries, size, inverse));
    }

    /// Whether the determinant of a block's inverse is negative.
    pub fn is_negative(&self, at: usize, block: &Block) -> bool {
        match block.kind {
            Kind::Wide(wide) => self.negative[wide as usize],
            _ => determinant(&self.points[at], block.size) < 0.0,
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

/// The inverse of `a[row][column]` in floats, into `out[column][row]`, and whether its determinant is negative: whoever uses
/// it finds out what it is worth. Not finite where the determinant, or a pivot, is zero in floats.
pub fn invert_wide(a: &WideInverse, size: usize, out: &mut WideInverse) -> bool {
    match size {
        4 => by_minors(a, out),
        _ => by_elimination(a, size, out),
    }
}

/// By Gauss's and Jordan's elimination.
fn by_elimination(a: &WideInverse, size: usize, out: &mut WideInverse) -> bool {
    const LANES: usize = WIDEST.div_ceil(LANE);
    let mut rows = [zeros::<LANES, f64>(); WIDEST];
    for (row, a) in rows.iter_mut().zip(a) {
        for (c, entry) in a.iter().enumerate() {
            row[c / LANE][c % LANE] = *entry;
        }
    }
    let mut from = std::array::from_fn::<u32, WIDEST, _>(|k| k as u32);
    let mut transposed = [zeros::<LANES, f64>(); WIDEST];
    let inverted = invert_transposed(&mut rows[..size], &mut from[..size], &mut transposed);
    for (r, row) in transposed[..size].iter().enumerate() {
        for (c, out) in out[..size].iter_mut().enumerate() {
            out[r] = match inverted {
                Some(_) => row[c / LANE][c % LANE],
                None => f64::NAN,
            };
        }
    }
    inverted.unwrap_or(false)
}

/// Of four rows, from the minors of the first two and of the last two: one division, and no pivots to wait for.
fn by_minors(a: &WideInverse, out: &mut WideInverse) -> bool {
    let minor = |r: usize, i: usize, j: usize| a[r][i] * a[r + 1][j] - a[r + 1][i] * a[r][j];
    let of = |r: usize| {
        [
            minor(r, 0, 1),
            minor(r, 0, 2),
            minor(r, 0, 3),
            minor(r, 1, 2),
            minor(r, 1, 3),
            minor(r, 2, 3),
        ]
    };
    let ([s0, s1, s2, s3, s4, s5], [c0, c1, c2, c3, c4, c5]) = (of(0), of(2));
    let determinant = (s0 * c5 - s1 * c4 + s2 * c3) + (s3 * c2 - s4 * c1 + s5 * c0);
    let scale = 1.0 / determinant;
    let [a0, a1, a2, a3] = [a[0], a[1], a[2], a[3]];
    // A row for each column of `a`, over its rows.
    let adjugate = [
        [
            a1[1] * c5 - a1[2] * c4 + a1[3] * c3,
            a0[2] * c4 - a0[1] * c5 - a0[3] * c3,
            a3[1] * s5 - a3[2] * s4 + a3[3] * s3,
            a2[2] * s4 - a2[1] * s5 - a2[3] * s3,
        ],
        [
            a1[2] * c2 - a1[0] * c5 - a1[3] * c1,
            a0[0] * c5 - a0[2] * c2 + a0[3] * c1,
            a3[2] * s2 - a3[0] * s5 - a3[3] * s1,
            a2[0] * s5 - a2[2] * s2 + a2[3] * s1,
        ],
        [
            a1[0] * c4 - a1[1] * c2 + a1[3] * c0,
            a0[1] * c2 - a0[0] * c4 - a0[3] * c0,
            a3[0] * s4 - a3[1] * s2 + a3[3] * s0,
            a2[1] * s2 - a2[0] * s4 - a2[3] * s0,
        ],
        [
            a1[1] * c1 - a1[0] * c3 - a1[2] * c0,
            a0[0] * c3 - a0[1] * c1 + a0[2] * c0,
            a3[1] * s1 - a3[0] * s3 - a3[2] * s0,
            a2[0] * s3 - a2[1] * s1 + a2[2] * s0,
        ],
    ];
    for (out, row) in out.iter_mut().zip(adjugate) {
        for (out, minor) in out.iter_mut().zip(row) {
            *out = minor * scale;
        }
    }
    determinant < 0.0
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
fn entries(block: &Block, j: &Derivative) -> Inverse {
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
fn invert(block: &Block, j: &Derivative) -> Inverse {
    inverse_of_small(&entries(block, j), block.size)
}

/// The inverse of `a[row][column]`, of three rows at most, by its adjugate, as `inverse[column][row]`.
#[inline]
fn inverse_of_small(a: &[[f64; 3]; 3], size: usize) -> Inverse {
    let mut out = [[0.0; 3]; 3];
    match size {
        1 => out[0][0] = 1.0 / a[0][0],
        2 => {
            let scale = 1.0 / (a[0][0] * a[1][1] - a[0][1] * a[1][0]);
            out[0] = [a[1][1] * scale, -a[0][1] * scale, 0.0];
            out[1] = [-a[1][0] * scale, a[0][0] * scale, 0.0];
        }
        _ => out = by_adjugate(a),
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// A · A⁻¹ = I, and the sign of the determinant turns when two rows are exchanged.
    #[test]
    fn wide_blocks_are_inverted() {
        let mut random = Random::new(29);
        for size in 4..=WIDEST {
            for _ in 0..200 {
                let mut a = [[0.0; WIDEST]; WIDEST];
                for row in &mut a[..size] {
                    row[..size].fill_with(|| random.symmetric());
                }
                let mut inverse = [[0.0; WIDEST]; WIDEST];
                let negative = invert_wide(&a, size, &mut inverse);
                let most = inverse
                    .as_flattened()
                    .iter()
                    .fold(1.0, |max: f64, x| max.max(x.abs()));
                for r in 0..size {
                    for c in 0..size {
                        let product: f64 = (0..size).map(|k| a[r][k] * inverse[k][c]).sum();
                        let one = f64::from(r == c);
                        assert!((product - one).abs() <= 1e-13 * most * most, "{product}");
                    }
                }
                a.swap(0, size - 1);
                assert_ne!(negative, invert_wide(&a, size, &mut inverse));
            }
        }
        let mut inverse = [[0.0; WIDEST]; WIDEST];
        for size in 4..=WIDEST {
            // Ones everywhere: singular.
            invert_wide(&[[1.0; WIDEST]; WIDEST], size, &mut inverse);
            let entries = inverse[..size].iter().flat_map(|row| &row[..size]);
            assert!(entries.into_iter().any(|x| !x.is_finite()), "{size}");
        }
    }

    /// Diagonal matrices say what the sign is.
    #[test]
    fn determinants_have_signs() {
        for size in 4..=WIDEST {
            for sign in [1.0, -1.0] {
                let mut a = [[0.0; WIDEST]; WIDEST];
                (0..size).for_each(|k| a[k][k] = 1.0 + k as f64);
                a[1][1] *= sign;
                let mut inverse = [[0.0; WIDEST]; WIDEST];
                assert_eq!(invert_wide(&a, size, &mut inverse), sign < 0.0);
                assert_eq!(inverse[1][1], sign / 2.0);
            }
        }
    }
}
