//! Whether symmetric matrices are positive definite, proved.

use crate::interval::{Interval, point};
use nalgebra::DMatrix;

/// Whether every symmetric matrix of these ranges, of n rows, one after the other, is positive definite: proved. `false`: it is not known.
///
/// With R the inverse of a factor of Cholesky's of the middles, in floats, R M Rᵀ is symmetric and differs from the identity by less than 1 in the
/// greatest sum of a row, so that all its eigenvalues are above 0; and so are those of M then (Sylvester's law of inertia).
///
/// ```
/// use krawl::interval::point;
/// use krawl::linalg::is_positive_definite;
/// let of = |b: f64| [point(1.0), point(b), point(b), point(1.0)];
/// assert!(is_positive_definite(2, &of(0.5)) && !is_positive_definite(2, &of(1.5)));
/// ```
pub fn is_positive_definite(n: usize, matrix: &[Interval]) -> bool {
    let middles = DMatrix::from_row_iterator(n, n, matrix.iter().map(|x| x.mid()));
    if n == 0 {
        return true;
    }
    if !middles.iter().all(|x| x.is_finite()) {
        return false;
    }
    let Some(factor) = middles.cholesky() else {
        return false;
    };
    let identity = DMatrix::identity(n, n);
    let Some(inverse) = factor.l_dirty().solve_lower_triangular(&identity) else {
        return false;
    };
    let of = |row: usize, column: usize| point(inverse[(row, column)]);
    let sum = |terms: &mut dyn Iterator<Item = Interval>| terms.fold(point(0.0), |sum, x| sum + x);
    // R M.
    let cells = (0..n * n).map(|cell| (cell / n, cell % n));
    let half =
        cells.map(|(row, column)| sum(&mut (0..=row).map(|k| of(row, k) * matrix[k * n + column])));
    let half: Vec<Interval> = half.collect();
    (0..n).all(|row| {
        let off = (0..n).map(|column| {
            let entry = sum(&mut (0..=column).map(|k| half[row * n + k] * of(column, k)));
            (entry - point(f64::from(u8::from(row == column)))).abs()
        });
        sum(&mut off.into_iter()).sup() < 1.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// Against determinants of all leading parts, in floats, of matrices that are far from singular.
    #[test]
    fn sides_with_leading_determinants() {
        let mut random = Random::new(7);
        let (mut yes, mut no) = (0, 0);
        for _ in 0..300 {
            let mut matrix = DMatrix::from_fn(4, 4, |_, _| random.symmetric());
            matrix = &matrix + matrix.transpose() + 1.5 * DMatrix::identity(4, 4);
            let leading = (1..=4).map(|k| matrix.view((0, 0), (k, k)).into_owned().determinant());
            let leading: Vec<f64> = leading.collect();
            if leading.iter().any(|x| x.abs() < 1e-3) {
                continue;
            }
            let is = leading.iter().all(|x| *x > 0.0);
            let ranges: Vec<Interval> = matrix.transpose().iter().map(|x| point(*x)).collect();
            assert_eq!(is_positive_definite(4, &ranges), is);
            if is { yes += 1 } else { no += 1 }
        }
        assert!(yes > 20 && no > 20, "{yes} {no}");
    }
}
