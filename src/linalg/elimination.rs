//! Elimination in dense matrices over any field.

use num_traits::{One, Zero};
use std::ops::{Div, Sub};

/// Numbers to eliminate with: floats, residues modulo a prime, complex numbers of such.
pub trait Field: Clone + Zero + One + Sub<Output = Self> + Div<Output = Self> {
    /// About its absolute value: the entry for which this is greatest is the pivot.
    fn size(&self) -> f64;
}

impl Field for f64 {
    fn size(&self) -> f64 {
        self.abs()
    }
}

/// Pivots below this count as zero.
const LEAST: f64 = 1e-200;

/// Inverts a square matrix in place, row by row or column by column, by Gauss–Jordan elimination with the largest pivots of
/// their columns. Whether there were such; nothing is claimed about the rounding.
///
/// ```
/// use krawl::linalg::invert;
/// let mut matrix = [0.0, 2.0, 4.0, 0.0];
/// assert!(invert(&mut matrix, 2));
/// assert_eq!(matrix, [0.0, 0.25, 0.5, 0.0]);
/// ```
pub fn invert<F: Field>(a: &mut [F], n: usize) -> bool {
    let mut pivots = Vec::with_capacity(n);
    for k in 0..n {
        let size = |row: usize| a[row * n + k].size();
        let larger = |best: usize, row: usize| if size(row) > size(best) { row } else { best };
        let pivot = (k + 1..n).fold(k, larger);
        // What is no number is not.
        let is_regular = size(pivot) > LEAST;
        if !is_regular {
            return false;
        }
        pivots.push(pivot);
        if pivot > k {
            let (above, below) = a.split_at_mut(pivot * n);
            above[k * n..(k + 1) * n].swap_with_slice(&mut below[..n]);
        }
        let row = &mut a[k * n..(k + 1) * n];
        let over = F::one() / std::mem::replace(&mut row[k], F::one());
        row.iter_mut().for_each(|x| *x = x.clone() * over.clone());
        let row = row.to_vec();
        for (_, other) in a.chunks_mut(n).enumerate().filter(|(i, _)| *i != k) {
            let factor = std::mem::replace(&mut other[k], F::zero());
            if !factor.is_zero() {
                for (x, y) in other.iter_mut().zip(&row) {
                    *x = x.clone() - factor.clone() * y.clone();
                }
            }
        }
    }
    for (k, &pivot) in pivots.iter().enumerate().rev() {
        a.chunks_mut(n).for_each(|row| row.swap(k, pivot));
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_times_matrix_is_the_identity() {
        for n in [1, 2, 5, 20] {
            let entry = |i: usize, j: usize| ((i * i * 29 + j * 13) as f64 * 1.3 + 0.5).sin();
            let matrix = nalgebra::DMatrix::from_fn(n, n, |i, j| {
                entry(i, j) + if (i + 1) % n == j { 2.0 } else { 0.0 }
            });
            let mut inverse = matrix.clone();
            assert!(invert(inverse.as_mut_slice(), n));
            assert!((matrix * inverse).is_identity(1e-9), "order {n}");
        }
        assert!(!invert(&mut [1.0, 2.0, 2.0, 4.0], 2));
        assert!(!invert(&mut [f64::NAN, 2.0, 2.0, 4.0], 2));
    }
}
