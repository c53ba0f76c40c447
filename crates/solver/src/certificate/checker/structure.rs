//! What keeps the test's cost near that of the structure: a bound on the product of two dense matrices that are both known by
//! ones with few entries, without making it.

use super::matrix::{Columns, Matrix, add, exact};
use crate::interval::Interval;
use crate::interval::rounding::{gamma, largest, round_up};

/// At least |Y (J A − K)|, where J, K and M have few entries, from a bound on |I − Y M|: with any X this is
/// |X − (I − Y M) X + Y (J A − K − M X)|. `solve` guesses the transposed X, near M⁻¹ (J A − K), from the transposed J A − K.
pub fn image_of_product(
    (y, away): (&Matrix, Interval),
    [j, k, m]: [&Columns; 3],
    a: &Matrix,
    solve: impl Fn(&Matrix) -> Matrix,
) -> Interval {
    let n = y.n;
    let entries = vec![0.0; n * n];
    let (mut left, mut sizes, mut terms) = (Matrix { n, entries }, vec![0.0; n], vec![2; n]);
    for (i, column) in k.iter().enumerate() {
        for &(e, x) in column {
            left.entries[e * n + i] -= x;
            (sizes[e], terms[e]) = (sizes[e] + x.abs(), terms[e] + 1);
        }
    }
    // Adds a matrix times another, transposed; the largest sum of a row's sizes of that one.
    let mut add_product = |left: &mut Matrix, sign: f64, columns: &Columns, other: &Matrix| {
        let of_rows = sizes_of_columns(other);
        for ((row, column), size) in other.entries.chunks(n).zip(columns).zip(&of_rows) {
            for &(e, x) in column {
                add(&mut left.entries[e * n..(e + 1) * n], row, |y| sign * x * y);
                (sizes[e], terms[e]) = (sizes[e] + x.abs() * size, terms[e] + 1);
            }
        }
        of_rows.into_iter().fold(0.0, largest)
    };
    add_product(&mut left, 1.0, j, &transposed(a));
    let x = solve(&left);
    assert!(x.n == n && x.entries.len() == n * n);
    let norm = exact(add_product(&mut left, -1.0, m, &x));
    // Each entry is a sum of so many products.
    let lost = |e: usize| gamma(terms[e]) * sizes[e];
    let rows = sizes_of_columns(&left).into_iter().enumerate();
    let rows: Vec<f64> = rows
        .map(|(e, x)| round_up(x + lost(e), n + terms[e]))
        .collect();
    norm + away * norm + y.bound(&rows)
}

/// The other way round.
fn transposed(matrix: &Matrix) -> Matrix {
    // So many rows at a time: their parts of a column lie side by side.
    const ROWS: usize = 16;
    let (n, mut entries) = (matrix.n, vec![0.0; matrix.n * matrix.n]);
    for first in (0..n).step_by(ROWS) {
        for (j, column) in matrix.entries.chunks(n).enumerate() {
            let rows = column.iter().enumerate().skip(first).take(ROWS);
            rows.for_each(|(i, &x)| entries[i * n + j] = x);
        }
    }
    Matrix { n, entries }
}

/// Of each column at least the sum of its entries' sizes.
fn sizes_of_columns(matrix: &Matrix) -> Vec<f64> {
    let size = |column: &[f64]| round_up(column.iter().map(|x| x.abs()).sum(), matrix.n);
    matrix.entries.chunks(matrix.n).map(size).collect()
}

#[cfg(test)]
mod tests {
    use super::super::matrix::tests::{N, at, matrix, norm, ratio, sum};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// |Y (J A − K)| with any Y and any guess of the solution, be it as good as it may.
        #[test]
        fn images_of_products_hold_exact_ones(
            (y, a, guess) in (matrix(N), matrix(N), matrix(N)),
            (j, k, m) in (matrix(N), matrix(N), matrix(N)),
            good in any::<bool>(),
        ) {
            let few = |m: &Matrix| -> Columns {
                m.entries.chunks(N).map(|c| c.iter().copied().enumerate().collect()).collect()
            };
            let columns = [few(&j), few(&k), few(&m)];
            let one = |i: usize, k: usize| ratio(f64::from(u8::from(i == k)));
            let product = |x: &Matrix, y: &Matrix, i: usize, k: usize| sum((0..N).map(|e| at(x, i, e) * at(y, e, k)));
            let away = 1.000001 * norm(N, |i, k| one(i, k) - product(&y, &m, i, k)).to_f64() + 1e-300;
            let whole = |e: usize, i: usize| product(&j, &a, e, i) - at(&k, e, i);
            let image = |i: usize, c: usize| sum((0..N).map(|e| at(&y, i, e) * whole(e, c)));
            let solve = |_: &Matrix| match good {
                true => {
                    let entries = (0..N * N).map(|at| image(at % N, at / N).to_f64());
                    transposed(&Matrix { n: N, entries: entries.collect() })
                }
                false => Matrix { n: N, entries: guess.entries.clone() },
            };
            let [j, k, m] = columns.each_ref();
            let found = image_of_product((&y, exact(away)), [j, k, m], &a, solve);
            prop_assert!(norm(N, image) <= ratio(found.sup().min(f64::MAX)));
        }
    }

    #[test]
    fn nothing_that_overflows_passes() {
        for bad in [f64::NAN, f64::INFINITY, 1e300] {
            let y = Matrix {
                n: 2,
                entries: vec![1.0, bad, 0.0, 1.0],
            };
            let j: Columns = vec![vec![(0, 1.0), (1, 1e300)], vec![(0, bad), (1, 1.0)]];
            let solve = |b: &Matrix| Matrix {
                n: 2,
                entries: b.entries.clone(),
            };
            let none = crate::interval::ZERO;
            let bound = image_of_product((&y, none), [&j, &j, &j], &y, solve);
            assert!(bound.sup() >= 1e299);
        }
    }
}
