//! How near to singular a matrix is.

use super::matrix::Sparse;
use nalgebra::DMatrix;

/// The smallest and the largest pivot, in absolute value, of Gaussian elimination with complete pivoting,
/// for a matrix of `rows` rows and no fewer columns. In floating point a matrix does not have full rank
/// where their ratio is of the size of rounding (Golub and Van Loan, Matrix Computations, 3.4.9). Both
/// are NaN where an entry is no finite number.
///
/// At most rows² columns operations, in room for a dense matrix: this is to explain, not to compute with.
///
/// ```
/// use krawl::linalg::{Sparse, extreme_pivots};
/// let pattern = Sparse::new(&[vec![0, 1], vec![0, 1]]);
/// assert_eq!(extreme_pivots(&pattern, &[1.0, 2.0, 2.0, 4.0], 2), (0.0, 4.0));
/// ```
///
/// # Panics
///
/// Where the pattern has entries below, or fewer columns.
pub fn extreme_pivots(pattern: &Sparse, values: &[f64], rows: usize) -> (f64, f64) {
    let columns = pattern.columns();
    assert!(rows <= columns, "full rank is that of all rows");
    if !values.iter().all(|x| x.is_finite()) {
        return (f64::NAN, f64::NAN);
    }
    let mut a = DMatrix::zeros(rows, columns);
    for column in 0..columns {
        for (row, value) in pattern.column(values, column) {
            a[(row, column)] = value;
        }
    }
    let upper = a.full_piv_lu().u();
    let pivots = || (0..rows).map(|k| upper[(k, k)].abs());
    (
        pivots().fold(f64::INFINITY, f64::min),
        pivots().fold(0.0, f64::max),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between the pivots' ratio and that of the singular values there is no more than a modest factor.
    #[test]
    fn small_pivots_are_small_singular_values() {
        for (rows, columns) in [(1, 1), (3, 4), (8, 8), (12, 13), (20, 20)] {
            let pattern = Sparse::new(&vec![(0..rows).collect(); columns]);
            let entry = |i: usize, j: usize| ((i * 29 + j * 13) as f64 * 1.3 + 0.5).sin();
            let regular = DMatrix::from_fn(rows, columns, |i, j| {
                entry(i, j) + if i == j { 2.0 } else { 0.0 }
            });
            for distance in [1.0, 1e-6, 1e-12, 0.0] {
                // The last row is that near to a combination of the others.
                let mut matrix = regular.clone();
                if rows > 1 {
                    let last = matrix.row(0) * 0.7 + distance * matrix.row(rows - 1);
                    matrix.set_row(rows - 1, &last);
                }
                let singular = matrix.singular_values();
                let (least, largest) = extreme_pivots(&pattern, matrix.as_slice(), rows);
                let (ratio, wanted) = (least / largest, singular.min() / singular.max());
                let rounding = 1e-15 * rows as f64;
                assert!(
                    ratio <= 100.0 * wanted + rounding && wanted <= 100.0 * ratio + rounding,
                    "{rows} × {columns}, {distance}: {ratio:e}, {wanted:e}"
                );
            }
        }
    }

    #[test]
    fn what_is_no_number_has_no_pivots() {
        let pattern = Sparse::new(&[vec![0], vec![0]]);
        assert_eq!(extreme_pivots(&pattern, &[-3.0, 2.0], 1), (3.0, 3.0));
        let (least, largest) = extreme_pivots(&pattern, &[1.0, f64::INFINITY], 1);
        assert!(least.is_nan() && largest.is_nan());
    }
}
