//! Column-major matrices with columns padded to whole SIMD lanes, and their products.
//!
//! Columns are worked on in blocks of at most eight lanes, whose number is a constant of the
//! kernels: loops over a block are unrolled and their sums stay in registers.

use super::large::{LARGE, Workers};

/// Floats in one SIMD register (AVX).
pub const LANE: usize = 4;
/// Lanes in a block.
const BLOCK: usize = 8;

pub(super) type Lane = [f64; LANE];

/// Lanes of a column: as many as needed, beyond one block whole blocks.
fn lanes_for(len: usize) -> usize {
    let lanes = len.div_ceil(LANE);
    if lanes <= BLOCK {
        lanes
    } else {
        lanes.next_multiple_of(BLOCK)
    }
}

/// a·b, of as many numbers each, in four interleaved sums of fused products.
#[inline]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a4, a1) = a.as_chunks::<LANE>();
    let (b4, b1) = b.as_chunks::<LANE>();
    let mut sums = [0.0; LANE];
    for (a, b) in a4.iter().zip(b4) {
        for i in 0..LANE {
            sums[i] = a[i].mul_add(b[i], sums[i]);
        }
    }
    let rest: f64 = a1.iter().zip(b1).map(|(x, y)| x * y).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// A vector padded with zeros to whole lanes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Vector {
    len: usize,
    lanes: Vec<Lane>,
}

impl Vector {
    /// A vector of `len` zeros.
    pub fn zeros(len: usize) -> Self {
        Vector {
            len,
            lanes: vec![[0.0; LANE]; lanes_for(len)],
        }
    }

    /// The entries in lanes, padding included.
    pub fn lanes(&self) -> &[Lane] {
        &self.lanes
    }

    /// The entries in lanes, padding included, to write on. The padding must stay zero.
    pub fn lanes_mut(&mut self) -> &mut [Lane] {
        &mut self.lanes
    }
}

impl std::ops::Deref for Vector {
    type Target = [f64];

    #[inline]
    fn deref(&self) -> &[f64] {
        &self.lanes.as_flattened()[..self.len]
    }
}

impl std::ops::DerefMut for Vector {
    #[inline]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.lanes.as_flattened_mut()[..self.len]
    }
}

/// Calls a function generic over the number of lanes in a block of a column.
macro_rules! with_block {
    ($lanes:expr, $f:ident ( $($arg:expr),* $(,)? )) => {
        match $lanes {
            1 => $f::<1>($($arg),*),
            2 => $f::<2>($($arg),*),
            3 => $f::<3>($($arg),*),
            4 => $f::<4>($($arg),*),
            5 => $f::<5>($($arg),*),
            6 => $f::<6>($($arg),*),
            7 => $f::<7>($($arg),*),
            _ => $f::<8>($($arg),*),
        }
    };
}
pub(super) use with_block;

/// A matrix of `rows` × `columns`, column by column, each column padded with zeros.
#[derive(Debug, Clone)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    lanes: usize,
    data: Vec<Lane>,
}

impl Matrix {
    /// A matrix of zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        let lanes = lanes_for(rows);
        Matrix {
            rows,
            columns,
            lanes,
            data: vec![[0.0; LANE]; lanes * columns],
        }
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Lanes in a column.
    pub(super) fn lanes(&self) -> usize {
        self.lanes
    }

    /// All columns one after the other, padding included.
    pub(super) fn entries(&self) -> &[f64] {
        self.data.as_flattened()
    }

    pub(super) fn data_mut(&mut self) -> &mut [Lane] {
        &mut self.data
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.data.as_flattened_mut().fill(0.0);
    }

    /// An entry.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        self.column(column)[row]
    }

    /// Sets an entry.
    pub fn set(&mut self, row: usize, column: usize, value: f64) {
        self.column_mut(column)[row] = value;
    }

    /// A column, without its padding.
    pub fn column(&self, column: usize) -> &[f64] {
        let start = column * self.lanes;
        &self.data[start..start + self.lanes].as_flattened()[..self.rows]
    }

    /// A column, to write on.
    pub fn column_mut(&mut self, column: usize) -> &mut [f64] {
        let start = column * self.lanes;
        &mut self.data[start..start + self.lanes].as_flattened_mut()[..self.rows]
    }

    /// `y = A x`, each entry a fused sum of `x.len()` products, x being no longer than a row.
    pub fn multiply(&self, x: &[f64], y: &mut Vector) {
        with_block!(
            self.lanes,
            combine(self.lanes, &self.data, x, &mut y.lanes, |a| a)
        );
    }

    /// `y = |A| x`, the same with the entries' absolute values.
    pub fn multiply_abs(&self, x: &[f64], y: &mut Vector) {
        with_block!(
            self.lanes,
            combine(self.lanes, &self.data, x, &mut y.lanes, f64::abs)
        );
    }

    /// `out = A S`. Each entry is a fused sum over the entries of a column of S.
    pub fn multiply_sparse(&self, s: &Sparse, values: &[f64], out: &mut Matrix) {
        debug_assert_eq!((self.lanes, s.columns()), (out.lanes, out.columns));
        with_block!(
            self.lanes,
            sparse(self.lanes, &self.data, s, values, &mut out.data)
        );
    }

    /// `y = |I − A S| u`. Each entry of the difference is a fused sum over the entries of a
    /// column of S and 1; then a fused sum of n products.
    pub fn identity_minus_sparse_abs(&self, s: &Sparse, values: &[f64], u: &[f64], y: &mut Vector) {
        with_block!(
            self.lanes,
            identity_minus(self.lanes, &self.data, s, values, u, &mut y.lanes)
        );
    }

    /// `square = |A A − Y S| u` and `other = |Y S| u`, the matrices square of the same size. Each
    /// entry of Y S is a fused sum over the entries of a column of S; that of the difference
    /// a sum of n products more, fused or not and in any order; then sums of n products.
    ///
    /// `workers` are for matrices of this size.
    pub fn square_minus_sparse_abs(
        &self,
        of: (&Matrix, &Sparse, &[f64]),
        u: &[f64],
        (square, other): (&mut Vector, &mut Vector),
        workers: &mut Workers,
    ) {
        if self.rows >= LARGE {
            workers.square_minus_sparse_abs(self, of, u, square, other);
        } else {
            self.square_minus_by_small_kernels(of, u, square, other);
        }
    }

    /// `square = |A A − Y S| u` and `other = |Y S| u` for square matrices A and Y of any size, every sum fused and
    /// in the columns' order.
    pub(super) fn square_minus_by_small_kernels(
        &self,
        (y, s, values): (&Matrix, &Sparse, &[f64]),
        u: &[f64],
        square: &mut Vector,
        other: &mut Vector,
    ) {
        with_block!(
            self.lanes,
            square_minus(
                (self.lanes, self.rows),
                &self.data,
                (&y.data, s, values),
                u,
                &mut square.lanes,
                &mut other.lanes,
            )
        );
    }
}

/// The pattern of a sparse matrix, column by column. Its values are kept outside, so that
/// matrices of the same pattern share it.
#[derive(Debug, Clone, Default)]
pub struct Sparse {
    /// Where each column starts in `rows`, and where the last ends.
    starts: Vec<usize>,
    rows: Vec<u32>,
}

impl Sparse {
    /// From the rows of the entries in each column.
    pub fn new(columns: &[Vec<usize>]) -> Self {
        let mut pattern = Sparse {
            starts: vec![0],
            rows: Vec::new(),
        };
        for column in columns {
            pattern.rows.extend(column.iter().map(|&row| row as u32));
            pattern.starts.push(pattern.rows.len());
        }
        pattern
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.starts.len() - 1
    }

    /// The number of entries.
    pub fn entries(&self) -> usize {
        self.rows.len()
    }

    /// The number of entries of a column.
    pub fn entries_of(&self, column: usize) -> usize {
        self.starts[column + 1] - self.starts[column]
    }

    /// The rows of a column's entries.
    pub fn rows_of(&self, column: usize) -> impl Iterator<Item = usize> + '_ {
        self.rows[self.starts[column]..self.starts[column + 1]]
            .iter()
            .map(|&row| row as usize)
    }

    /// The sum of absolute values in each row.
    pub fn row_sums_abs(&self, values: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        for (&row, value) in self.rows.iter().zip(values) {
            out[row as usize] += value.abs();
        }
    }

    /// The rows and values of a column's entries.
    #[inline(always)]
    pub(super) fn column<'a>(
        &'a self,
        values: &'a [f64],
        column: usize,
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        let range = self.starts[column]..self.starts[column + 1];
        self.rows[range.clone()]
            .iter()
            .zip(&values[range])
            .map(|(&row, &value)| (row as usize, value))
    }
}

/// One block of a column.
#[inline(always)]
fn block<const L: usize>(data: &[Lane], start: usize) -> &[Lane; L] {
    data[start..start + L].try_into().expect("L lanes")
}

/// `sums += x a`.
#[inline(always)]
fn add<const L: usize>(sums: &mut [Lane; L], a: &[Lane; L], x: f64) {
    for l in 0..L {
        for k in 0..LANE {
            sums[l][k] = a[l][k].mul_add(x, sums[l][k]);
        }
    }
}

/// `sums += x |a|`.
#[inline(always)]
fn add_abs<const L: usize>(sums: &mut [Lane; L], a: &[Lane; L], x: f64) {
    for l in 0..L {
        for k in 0..LANE {
            sums[l][k] = a[l][k].abs().mul_add(x, sums[l][k]);
        }
    }
}

/// `y = Σ_j f(A_j) x_j` over the columns.
fn combine<const L: usize>(
    lanes: usize,
    data: &[Lane],
    x: &[f64],
    y: &mut [Lane],
    f: impl Fn(f64) -> f64 + Copy,
) {
    for offset in (0..lanes).step_by(L) {
        let mut sums = [[0.0; LANE]; L];
        for (column, &x) in data.chunks_exact(lanes).zip(x) {
            let a = block::<L>(column, offset);
            for l in 0..L {
                for k in 0..LANE {
                    sums[l][k] = f(a[l][k]).mul_add(x, sums[l][k]);
                }
            }
        }
        y[offset..offset + L].copy_from_slice(&sums);
    }
}

fn sparse<const L: usize>(lanes: usize, a: &[Lane], s: &Sparse, values: &[f64], out: &mut [Lane]) {
    for offset in (0..lanes).step_by(L) {
        for j in 0..s.columns() {
            let mut sums = [[0.0; LANE]; L];
            for (row, x) in s.column(values, j) {
                add(&mut sums, block::<L>(a, row * lanes + offset), x);
            }
            let start = j * lanes + offset;
            out[start..start + L].copy_from_slice(&sums);
        }
    }
}

fn identity_minus<const L: usize>(
    lanes: usize,
    a: &[Lane],
    s: &Sparse,
    values: &[f64],
    u: &[f64],
    y: &mut [Lane],
) {
    for offset in (0..lanes).step_by(L) {
        let mut sums = [[0.0; LANE]; L];
        for (j, &u) in u.iter().enumerate().take(s.columns()) {
            let mut difference = [[0.0; LANE]; L];
            if (offset * LANE..(offset + L) * LANE).contains(&j) {
                difference.as_flattened_mut()[j - offset * LANE] = 1.0;
            }
            for (row, x) in s.column(values, j) {
                add(&mut difference, block::<L>(a, row * lanes + offset), -x);
            }
            add_abs(&mut sums, &difference, u);
        }
        y[offset..offset + L].copy_from_slice(&sums);
    }
}

fn square_minus<const L: usize>(
    (lanes, n): (usize, usize),
    a: &[Lane],
    (y, s, values): (&[Lane], &Sparse, &[f64]),
    u: &[f64],
    square: &mut [Lane],
    other: &mut [Lane],
) {
    for offset in (0..lanes).step_by(L) {
        let (mut squares, mut others) = ([[0.0; LANE]; L], [[0.0; LANE]; L]);
        for j in 0..n {
            let mut product = [[0.0; LANE]; L];
            for (row, x) in s.column(values, j) {
                add(&mut product, block::<L>(y, row * lanes + offset), -x);
            }
            add_abs(&mut others, &product, u[j]);
            let column = a[j * lanes..(j + 1) * lanes].as_flattened();
            for (from, &x) in a.chunks_exact(lanes).zip(&column[..n]) {
                add(&mut product, block::<L>(from, offset), x);
            }
            add_abs(&mut squares, &product, u[j]);
        }
        square[offset..offset + L].copy_from_slice(&squares);
        other[offset..offset + L].copy_from_slice(&others);
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    pub fn filled(n: usize, seed: f64) -> Matrix {
        let mut a = Matrix::zeros(n, n);
        for j in 0..n {
            for i in 0..n {
                a.set(i, j, ((i * 31 + j * 17) as f64 * 0.37 + seed).sin());
            }
        }
        a
    }

    #[test]
    fn products_agree_with_another_library() {
        for n in [1, 3, 4, 7, 13, 31, 32, 33, 47, 70] {
            let (a, b) = (filled(n, 0.1), filled(n, 0.7));
            let dense = |m: &Matrix| DMatrix::from_fn(n, n, |i, j| m.get(i, j));
            let u: Vec<f64> = (0..n).map(|i| 1.0 + i as f64 / 7.0).collect();
            let x = DVector::from_column_slice(&u);
            let (mut y, mut z) = (Vector::zeros(n), Vector::zeros(n));
            let close = |y: &Vector, expected: DVector<f64>| {
                for (got, want) in y.iter().zip(expected.iter()) {
                    assert!(
                        (got - want).abs() <= 1e-12 * (1.0 + want.abs()),
                        "{n}: {got} {want}"
                    );
                }
            };
            a.multiply(&u, &mut y);
            close(&y, dense(&a) * &x);
            a.multiply_abs(&u, &mut y);
            close(&y, dense(&a).abs() * &x);

            let columns: Vec<Vec<usize>> = (0..n)
                .map(|j| (0..n).filter(|i| (i + j) % 3 != 1).collect())
                .collect();
            let pattern = Sparse::new(&columns);
            let values: Vec<f64> = (0..pattern.entries()).map(|k| (k as f64).cos()).collect();
            let mut s = DMatrix::zeros(n, n);
            let mut next = values.iter();
            for (j, column) in columns.iter().enumerate() {
                for &i in column {
                    s[(i, j)] = *next.next().unwrap();
                }
            }
            let mut product = Matrix::zeros(n, n);
            a.multiply_sparse(&pattern, &values, &mut product);
            product.multiply(&u, &mut y);
            close(&y, dense(&a) * &s * &x);
            a.identity_minus_sparse_abs(&pattern, &values, &u, &mut y);
            close(&y, (DMatrix::identity(n, n) - dense(&a) * &s).abs() * &x);
            let mut workers = Workers::new(n, 1);
            a.square_minus_sparse_abs((&b, &pattern, &values), &u, (&mut y, &mut z), &mut workers);
            close(&y, (dense(&a) * dense(&a) - dense(&b) * &s).abs() * &x);
            close(&z, (dense(&b) * &s).abs() * &x);
        }
    }
}
