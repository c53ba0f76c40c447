//! The seven steps of 002, section 5, for any matrix that can substitute through its diagonal blocks.
//!
//! Written once for all: the trackers' Jacobians, whose rows are distances and short lists and whose blocks
//! are points (`track/reduced`), and matrices stored as such (`crates/lab`).
//!
//! K = −A⁻¹H is kept, with the identity for the key unknowns' rows. So steps 6 and 7, X = A⁻¹(R − H U), are one
//! product, X = Z + K U with the Z = A⁻¹R of step 1, and a solution passes through A once.

use super::Scalar;
use super::rows::{Lane, Row, add, width_for, with_width, zeros};
use crate::linalg::{LANE, Singular};
use crate::places::Each as _;

/// What elimination reads of a matrix [[H, A], [C, L]] whose diagonal blocks are factored. Unknowns have any
/// numbers; the ignored equations are counted from 0 to k − 1.
pub trait Blocks<T> {
    /// The number k of key unknowns.
    fn keys(&self) -> usize;

    /// The number of unknowns, which have the first rows of K.
    fn unknowns(&self) -> usize;

    /// The number of rows of K; those beyond the unknowns' are zero.
    fn rows(&self) -> usize {
        self.unknowns()
    }

    /// Which unknown a key unknown is.
    fn key(&self, at: usize) -> usize;

    /// Steps 1 and 2: sets the rows of A's unknowns, zero before, so that A's equations hold for every column.
    fn substitute<const W: usize>(&self, rows: &mut [Row<W, T>]);

    /// Step 3: an ignored equation's row of [C, L] times the rows of all unknowns.
    fn ignored_row<const W: usize>(&self, at: usize, rows: &[Row<W, T>]) -> Row<W, T>;
}

/// A matrix that also solves for right-hand sides given later.
pub trait Solves<T>: Blocks<T> {
    /// Step 1: sets A's unknowns, zero before as are the key unknowns, so that A's equations hold with the
    /// right-hand side `f`.
    fn substitute_one(&self, f: &[T], x: &mut [T]);

    /// Step 4: what is left of an ignored equation's right-hand side.
    fn ignored_rest(&self, at: usize, f: &[T], x: &[T]) -> T;
}

/// What elimination leaves for the key unknowns.
#[derive(Debug, Clone)]
pub struct Elimination<T = f64> {
    /// Lanes of a row.
    pub width: usize,
    /// K = −A⁻¹H with the identity for the key unknowns: a row per unknown.
    pub k: Vec<Lane<T>>,
    /// S⁻¹ transposed, S = C − L A⁻¹ H: for each ignored equation a row over key unknowns.
    pub p: Vec<Lane<T>>,
    /// Whether det S is negative, where numbers have signs.
    pub is_negative: bool,
    /// Work space: S, and where its rows came from.
    schur: Vec<Lane<T>>,
    from: Vec<u32>,
    /// The key unknowns' values for the columns beyond theirs.
    solved: Vec<T>,
}

impl<T> Default for Elimination<T> {
    fn default() -> Self {
        Elimination {
            width: 1,
            k: Vec::new(),
            p: Vec::new(),
            is_negative: false,
            schur: Vec::new(),
            from: Vec::new(),
            solved: Vec::new(),
        }
    }
}

impl<T: Scalar> Elimination<T> {
    /// Factors a matrix whose blocks are; there is no room for more than [`MAX_KEYS`](super::MAX_KEYS) columns. Columns beyond the key unknowns' are right-hand sides: there may be
    /// one, and [`Blocks::substitute`] and [`Blocks::ignored_row`] take it, with a minus, for one more column of
    /// H and C.
    pub fn make(&mut self, matrix: &impl Blocks<T>, right_sides: usize) -> Result<(), Singular> {
        let keys = matrix.keys();
        self.width = width_for(keys + right_sides).ok_or(Singular)?;
        with_width!(self.width, self.make_in(matrix, right_sides))
    }

    fn make_in<const W: usize>(
        &mut self,
        matrix: &impl Blocks<T>,
        right_sides: usize,
    ) -> Result<(), Singular> {
        let keys = matrix.keys();
        self.k.clear();
        self.k.resize(matrix.rows() * W, [T::zero(); LANE]);
        let rows = self.k.as_chunks_mut::<W>().0;
        for at in 0..keys {
            rows[matrix.key(at)][at / LANE][at % LANE] = T::one();
        }
        matrix.substitute(rows);
        self.schur.resize(keys * W, [T::zero(); LANE]);
        let schur = self.schur.as_chunks_mut::<W>().0;
        for (at, row) in schur.iter_mut().enumerate() {
            *row = matrix.ignored_row(at, rows);
        }
        self.p.resize(keys * W, [T::zero(); LANE]);
        let p = self.p.as_chunks_mut::<W>().0;
        self.from.clear();
        self.from.extend(0..keys as u32);
        let inverted = invert_transposed(schur, &mut self.from, p);
        self.is_negative = inverted.ok_or(Singular)?;
        // Elimination has made S⁻¹ times the columns beyond.
        self.solved.clear();
        for column in keys..keys + right_sides {
            let values = schur.iter().map(|row| row.as_flattened()[column]);
            self.solved.extend(values.map(|x| x.negated()));
        }
        Ok(())
    }

    /// The solution for the right-hand side that was there in [`Elimination::make`].
    pub fn solution(&self, keys: usize, x: &mut [T]) {
        with_width!(self.width, self.solution_in(keys, x))
    }

    fn solution_in<const W: usize>(&self, keys: usize, x: &mut [T]) {
        let mut values = zeros::<W, T>();
        let flat = values.as_flattened_mut();
        flat[..keys].copy_from_slice(&self.solved);
        flat[keys] = T::one();
        x.fill(T::zero());
        self.add_combination(&values, x);
    }

    /// Solves for the right-hand side `f`; `x` has room for one number in each row of K.
    pub fn solve(&self, matrix: &impl Solves<T>, f: &[T], x: &mut [T]) {
        with_width!(self.width, self.solve_in(matrix, f, x))
    }

    fn solve_in<const W: usize>(&self, matrix: &impl Solves<T>, f: &[T], x: &mut [T]) {
        x.fill(T::zero());
        matrix.substitute_one(f, x);
        let mut values = zeros::<W, T>();
        for (at, row) in self.p.as_chunks::<W>().0.iter().enumerate() {
            add(&mut values, matrix.ignored_rest(at, f, x), row);
        }
        self.add_combination(&values, &mut x[..matrix.unknowns()]);
    }

    /// Adds K times the columns' values.
    #[inline(always)]
    fn add_combination<const W: usize>(&self, values: &Row<W, T>, x: &mut [T]) {
        for (x, row) in x.iter_mut().zip(self.k.as_chunks::<W>().0) {
            let mut sums = [T::zero(); LANE];
            for w in 0..W {
                for l in 0..LANE {
                    sums[l] = sums[l].plus_product(row[w][l], values[w][l]);
                }
            }
            *x = x.plus(sums[0].plus(sums[1]).plus(sums[2].plus(sums[3])));
        }
    }
}

/// The inverse's transpose of the square matrix with these rows, padded to whole lanes, by Gauss's and Jordan's
/// elimination in place: they are overwritten, and what is beyond the matrix in them is multiplied with its
/// inverse. `from` is 0, 1, … before. Tells whether the determinant is negative; `None`: singular.
pub fn invert_transposed<const W: usize, T: Scalar>(
    a: &mut [Row<W, T>],
    from: &mut [u32],
    out: &mut [Row<W, T>],
) -> Option<bool> {
    let n = a.len();
    let mut negative = false;
    // `from[k]` is the row that became row k.
    for k in 0..n {
        let (w, l) = (k / LANE, k % LANE);
        let (mut best, mut most) = (k, a[k][w][l].pivot_size());
        for (i, row) in a.iter().enumerate().skip(k + 1) {
            let size = row[w][l].pivot_size();
            // Of equal ones the last; a pivot that is not a number has no size.
            if size >= most {
                (best, most) = (i, size);
            }
        }
        if most <= 0.0 {
            return None;
        }
        a.swap(k, best);
        from.swap(k, best);
        let pivot = a[k][w][l];
        negative ^= (best != k) != pivot.is_negative();
        let scale = pivot.inverse();
        a[k][w][l] = T::one();
        for lane in &mut a[k] {
            *lane = lane.each(|x| x.times(scale));
        }
        let row = a[k];
        for (i, other) in a.iter_mut().enumerate() {
            if i != k {
                let factor = other[w][l].negated();
                other[w][l] = T::zero();
                add(other, factor, &row);
            }
        }
    }
    // Column k of the result belongs to the row that was brought there.
    for (i, a) in a.iter().enumerate() {
        for (a, &from) in a.as_flattened().iter().zip(&from[..n]) {
            out[from as usize][i / LANE][i % LANE] = *a;
        }
    }
    Some(negative)
}
