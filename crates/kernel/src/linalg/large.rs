//! Products of large dense matrices, by the crate matrixmultiply.
//!
//! Up to [`LARGE`] rows the kernels beside this file are used, and nothing here. From there on most of a
//! run's time in the full space is spent on one product of dense matrices per test, which needs blocking for
//! the caches. (Inverses are made in an order that keeps them sparse for long, `inverse.rs`, which for structures whose
//! distances join few points takes fewer operations than a dense factorization.)
//!
//! These products are the classical ones, of no recursive (Strassen's) kind: every entry is a sum of products of
//! entries, in an order that depends on the processor, with fused operations where it has them. Bounds of the form
//! γ_n Σ |x_i y_i| hold for every such order (Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed.,
//! section 3.1; Rump, Acta Numerica 2010, section 10): the proofs need no others. What changes with the
//! processor are last digits, and so the lengths of tubes.

use super::matrix::{LANE, Matrix, Sparse, Vector};
use rayon::prelude::*;
use std::sync::Arc;

/// Matrices of so many rows and more are large.
pub const LARGE: usize = 128;

/// Columns of a product that are made at a time.
const WIDTH: usize = 64;

/// The rows of a matrix that are worked on at a time where they are multiplied with a sparse one.
const ROWS: usize = 32;

/// Room for products of large matrices, and the threads that make them. It takes no memory where matrices are small.
#[derive(Debug, Clone)]
pub struct Workers {
    parts: Vec<Part>,
    /// `None`: all is done on the caller's thread.
    pool: Option<Arc<rayon::ThreadPool>>,
}

/// Some columns of A² − Y S, and what they add to the results.
#[derive(Debug, Clone)]
struct Part {
    columns: Matrix,
    square: Vector,
    other: Vector,
}

impl Workers {
    /// For matrices of n rows, on `threads` threads; 0 means one for each processor.
    ///
    /// Results are the same to the last bit for any number of threads. Where threads cannot be started, the
    /// work is done without them.
    pub fn new(n: usize, threads: usize) -> Self {
        if n < LARGE {
            return Workers {
                parts: Vec::new(),
                pool: None,
            };
        }
        let pool = (threads != 1)
            .then(|| {
                rayon::ThreadPoolBuilder::new()
                    .num_threads(threads)
                    .build()
                    .ok()
            })
            .flatten();
        let count = pool.as_ref().map_or(1, |pool| pool.current_num_threads());
        let part = Part {
            columns: Matrix::zeros(n, WIDTH),
            square: Vector::zeros(n),
            other: Vector::zeros(n),
        };
        Workers {
            parts: vec![part; count],
            pool: pool.map(Arc::new),
        }
    }

    /// [`Matrix::square_minus_sparse_abs`] for a large A. Each entry of Y S is a fused sum over the entries of a
    /// column of S; that of the difference has n products more, in any order, and one addition; then come
    /// sums of n products in blocks, of no more than n roundings each.
    pub(super) fn square_minus_sparse_abs(
        &mut self,
        a: &Matrix,
        of: (&Matrix, &Sparse, &[f64]),
        u: &[f64],
        square: &mut Vector,
        other: &mut Vector,
    ) {
        square.fill(0.0);
        other.fill(0.0);
        let n = a.columns();
        let mut start = 0;
        while start < n {
            let Workers { parts, pool } = self;
            let make = |(k, part): (usize, &mut Part)| part.make(a, of, u, start + k * WIDTH);
            match pool {
                Some(pool) => pool.install(|| parts.par_iter_mut().enumerate().for_each(make)),
                None => parts.iter_mut().enumerate().for_each(make),
            }
            // In the columns' order, however many parts there are.
            for part in self.parts.iter().take((n - start).div_ceil(WIDTH)) {
                add(square, &part.square);
                add(other, &part.other);
            }
            start += WIDTH * self.parts.len();
        }
    }
}

/// `sums += terms`.
fn add(sums: &mut Vector, terms: &Vector) {
    for (sum, term) in sums.iter_mut().zip(terms.iter()) {
        *sum += term;
    }
}

impl Part {
    /// The columns from `start` on, if there are any, and their sums with the weights u.
    fn make(
        &mut self,
        a: &Matrix,
        (y, s, values): (&Matrix, &Sparse, &[f64]),
        u: &[f64],
        start: usize,
    ) {
        let n = a.rows();
        if start >= n {
            return;
        }
        let range = start..n.min(start + WIDTH);
        minus_sparse(y, s, values, range.clone(), &mut self.columns);
        sum_abs(&self.columns, &u[range.clone()], &mut self.other);
        add_product(a, range.clone(), &mut self.columns);
        sum_abs(&self.columns, &u[range], &mut self.square);
    }
}

/// Adds these columns of A A to the first columns of `out`, the matrix A being square.
fn add_product(a: &Matrix, range: std::ops::Range<usize>, out: &mut Matrix) {
    let (n, stride) = (a.rows(), a.lanes() * LANE);
    let entries = a.entries();
    let factor = &entries[range.start * stride..range.end * stride];
    let out = &mut out.data_mut().as_flattened_mut()[..range.len() * stride];
    assert!(entries.len() == n * stride && n <= stride);
    let (rows, columns) = (1, stride as isize);
    // SAFETY: by the assertion and the slices above, each matrix has n rows and as many columns as are told of it, one after the other
    // at this stride; what is written is borrowed alone.
    unsafe {
        matrixmultiply::dgemm(
            n,
            n,
            range.len(),
            1.0,
            entries.as_ptr(),
            rows,
            columns,
            factor.as_ptr(),
            rows,
            columns,
            1.0,
            out.as_mut_ptr(),
            rows,
            columns,
        );
    }
}

/// Some columns of −Y S, into the first columns of `out`.
fn minus_sparse(
    y: &Matrix,
    s: &Sparse,
    values: &[f64],
    range: std::ops::Range<usize>,
    out: &mut Matrix,
) {
    let stride = y.lanes() * LANE;
    for offset in (0..stride).step_by(ROWS) {
        for (to, j) in range.clone().enumerate() {
            let mut sums = [0.0; ROWS];
            for (row, x) in s.column(values, j) {
                let from = row * stride + offset;
                for (sum, y) in sums.iter_mut().zip(&y.entries()[from..from + ROWS]) {
                    *sum = y.mul_add(-x, *sum);
                }
            }
            let to = to * stride + offset;
            out.data_mut().as_flattened_mut()[to..to + ROWS].copy_from_slice(&sums);
        }
    }
}

/// `y = |A| u` for the first columns of A, as many as there are weights.
fn sum_abs(a: &Matrix, u: &[f64], y: &mut Vector) {
    a.multiply_abs(u, y);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::matrix::tests::filled as dense;

    /// A matrix with few entries, and its values.
    fn sparse(n: usize, seed: f64) -> (Sparse, Vec<f64>) {
        let columns: Vec<Vec<usize>> = (0..n)
            .map(|j| {
                (0..n)
                    .filter(|&i| i == j || (i * 7 + j * 3) % 41 == 5)
                    .collect()
            })
            .collect();
        let pattern = Sparse::new(&columns);
        let values = (0..pattern.entries()).map(|k| (k as f64 * 1.3 + seed).sin() + 0.1);
        let values = values.collect();
        (pattern, values)
    }

    /// Against the kernels of small matrices, within the bounds that proofs use; and the same to the last bit
    /// for any number of threads.
    #[test]
    fn products_are_those_of_the_small_kernels() {
        use crate::interval::rounding::{gamma, round_up};
        for n in [128, 131, 200] {
            let (a, y) = (dense(n, 0.1), dense(n, 0.7));
            let (s, values) = sparse(n, 0.3);
            let u: Vec<f64> = (0..n).map(|i| 1.0 + i as f64 / 70.0).collect();
            let vectors = || (Vector::zeros(n), Vector::zeros(n));
            let (mut square, mut other) = vectors();
            a.square_minus_by_small_kernels((&y, &s, &values), &u, &mut square, &mut other);
            let (mut size, mut first) = vectors();
            a.multiply_abs(&u, &mut first);
            a.multiply_abs(&first, &mut size);
            let mut seen = None;
            for threads in [1, 2, 3] {
                let (mut square2, mut other2) = vectors();
                let mut workers = Workers::new(n, threads);
                for _ in 0..2 {
                    workers.square_minus_sparse_abs(
                        &a,
                        (&y, &s, &values),
                        &u,
                        &mut square2,
                        &mut other2,
                    );
                }
                for i in 0..n {
                    let bound = gamma(4 * n + 40) * round_up(size[i] + other[i], 4 * n);
                    let off = (square[i] - square2[i]).abs();
                    assert!(off <= bound, "{n}: {off:e} {bound:e}");
                    assert!((other[i] - other2[i]).abs() <= bound);
                }
                let same = seen.get_or_insert((square2.clone(), other2.clone()));
                assert!(same.0 == square2 && same.1 == other2, "{n}, {threads}");
            }
        }
    }
}
