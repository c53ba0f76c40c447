//! Elimination in dense matrices over any field.

use crate::equations::Ring;
use std::ops::Div;

/// Numbers to eliminate with: floats, residues modulo a prime, complex numbers of such.
pub trait Field: Ring + PartialEq + Div<Output = Self> {
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
/// use krawl::elimination::invert;
/// let mut matrix = [0.0, 2.0, 4.0, 0.0];
/// assert!(invert(&mut matrix, 2));
/// assert_eq!(matrix, [0.0, 0.25, 0.5, 0.0]);
/// ```
pub fn invert<F: Field>(a: &mut [F], n: usize) -> bool {
    let [zero, one] = [0, 1].map(F::whole);
    let (mut pivots, mut top) = (Vec::with_capacity(n), Vec::with_capacity(n));
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
        let over = one.clone() / std::mem::replace(&mut row[k], one.clone());
        row.iter_mut().for_each(|x| *x = x.clone() * over.clone());
        top.clear();
        top.extend_from_slice(row);
        for (_, other) in a.chunks_mut(n).enumerate().filter(|(i, _)| *i != k) {
            let factor = std::mem::replace(&mut other[k], zero.clone());
            if factor != zero {
                for (x, y) in other.iter_mut().zip(&top) {
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

/// Rows in row echelon form, taken one after the other, of numbers that are not rounded.
pub struct Echelon<F> {
    /// For each column the row that begins there: columns, ascending, and entries that are not 0; the first is 1.
    pivots: Vec<Option<Vec<(usize, F)>>>,
    /// How many rows there are.
    pub rank: usize,
}

impl<F: Field> Echelon<F> {
    /// No rows of a matrix of so many columns.
    pub fn new(columns: usize) -> Self {
        Echelon {
            pivots: vec![None; columns],
            rank: 0,
        }
    }

    /// So many rows of a matrix of so many columns, which are added to rows of zeros, with those that depend on each other, the
    /// last of which is the first that adds nothing to those before it.
    pub fn of(
        (rows, columns): (usize, usize),
        add: impl Fn(usize, &mut [F]),
    ) -> (Self, Option<Vec<usize>>) {
        // Beyond the columns of the matrix stand those of the identity, which record the combination of rows that a row has
        // become. They are costly to carry along, so that happens only where they are needed.
        let eliminate = |combine: bool| {
            let (mut out, [zero, one]) = (Echelon::new(columns), [0, 1].map(F::whole));
            let mut work = vec![zero.clone(); columns + if combine { rows } else { 0 }];
            let mut circuit = None;
            for index in 0..rows {
                work.fill(zero.clone());
                add(index, &mut work);
                if combine {
                    work[columns + index] = one.clone();
                }
                if !out.take(&mut work) && circuit.is_none() {
                    let used = (0..rows).filter(|&row| combine && work[columns + row] != zero);
                    circuit = Some(used.collect());
                    if combine {
                        break;
                    }
                }
            }
            (out, circuit)
        };
        let (out, circuit) = eliminate(false);
        (out, circuit.and_then(|_: Vec<usize>| eliminate(true).1))
    }

    /// Subtracts multiples of the rows that there are until the row begins in another column than all of them,
    /// and takes it. False if nothing is left of it. Entries of `row` beyond the columns go along.
    pub fn take(&mut self, row: &mut [F]) -> bool {
        let [zero, one] = [0, 1].map(F::whole);
        for column in 0..self.pivots.len() {
            if row[column] == zero {
                continue;
            }
            let factor = row[column].clone();
            let Some(pivot) = &self.pivots[column] else {
                let over = one / factor;
                let entries = row.iter().enumerate().filter(|(_, entry)| **entry != zero);
                let scaled = entries.map(|(at, entry)| (at, over.clone() * entry.clone()));
                self.pivots[column] = Some(scaled.collect());
                self.rank += 1;
                return true;
            };
            for (at, entry) in pivot {
                row[*at] = row[*at].clone() - factor.clone() * entry.clone();
            }
        }
        false
    }

    /// The vector that all rows map to zero and that has these entries where no row begins, asked for from the last one on.
    pub fn null_vector(&self, mut free: impl FnMut(usize) -> F) -> Vec<F> {
        let mut out = vec![F::whole(0); self.pivots.len()];
        for (column, pivot) in self.pivots.iter().enumerate().rev() {
            out[column] = match pivot {
                None => free(column),
                Some(row) => row[1..]
                    .iter()
                    .filter(|(at, _)| *at < self.pivots.len())
                    .fold(F::whole(0), |sum, (at, entry)| {
                        sum - entry.clone() * out[*at].clone()
                    }),
            };
        }
        out
    }

    /// A basis of the vectors that all rows map to zero.
    pub fn null_space(&self) -> impl Iterator<Item = Vec<F>> + '_ {
        let free = (0..self.pivots.len()).filter(|&column| self.pivots[column].is_none());
        free.map(|one| self.null_vector(|column| F::whole((column == one).into())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::residues::{Residue, Residues};

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

    #[test]
    fn ranks_and_null_vectors() {
        let mut residues = Residues::new(5);
        let mut echelon = Echelon::new(6);
        let mut rows: Vec<Vec<Residue>> = (0..4)
            .map(|_| (0..6).map(|_| residues.draw()).collect())
            .collect();
        for row in &rows {
            assert!(echelon.take(&mut row.clone()));
        }
        // A sum of rows adds nothing.
        let mut sum: Vec<Residue> = (0..6).map(|k| rows[0][k] + rows[3][k]).collect();
        assert!(!echelon.take(&mut sum));
        assert_eq!(sum, [Residue::whole(0); 6]);
        assert_eq!((echelon.rank, echelon.null_space().count()), (4, 2));
        rows.push(sum);
        let random = echelon.null_vector(|_| residues.draw());
        for v in echelon.null_space().chain([random]) {
            assert_ne!(v, [Residue::whole(0); 6]);
            for row in &rows {
                let products = row.iter().zip(&v).map(|(&a, &b)| a * b);
                let sum = products.fold(Residue::whole(0), |sum, x| sum + x);
                assert_eq!(sum, Residue::whole(0));
            }
        }
    }
}
