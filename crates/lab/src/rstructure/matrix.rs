//! R-structured matrices.

use super::Scalar;
use super::structure::{DIAGONAL, LEFT, Structure, StructureError};
use krawl::linalg::LANE;
use krawl::linalg::rstructure::Lane;
use std::sync::Arc;

/// A matrix `[[H, A], [C, L]]` with an [R-structure](Structure): A is block lower triangular, its
/// blocks left of the diagonal are sparse. Nothing is stored of the rest of A.
#[derive(Debug, Clone)]
pub struct RMatrix<T> {
    pub(super) structure: Arc<Structure>,
    /// Its numbers: see [`H`](super::structure::H) and those behind it.
    pub(super) parts: [Vec<Lane<T>>; 5],
}

impl<T: Scalar> RMatrix<T> {
    /// A matrix of zeros. Matrices of one Newton iteration share the structure.
    pub fn zeros(structure: Arc<Structure>) -> Self {
        let zeros = |lanes: usize| vec![[T::zero(); LANE]; lanes];
        RMatrix {
            parts: structure.parts().map(zeros),
            structure,
        }
    }

    /// The matrix with the given entries (row, column, value), with a structure of its own.
    pub fn from_entries(
        keys: usize,
        blocks: &[usize],
        entries: &[(usize, usize, T)],
    ) -> Result<Self, StructureError> {
        let pattern = entries.iter().map(|&(row, column, _)| (row, column));
        let mut matrix = Self::zeros(Arc::new(Structure::new(keys, blocks, pattern)?));
        for &(row, column, value) in entries {
            matrix.set(row, column, value);
        }
        Ok(matrix)
    }

    /// An entry; zero where none is stored.
    pub fn get(&self, row: usize, column: usize) -> T {
        let place = self.structure.place(row, column);
        place.map_or(T::zero(), |(part, at)| self.parts[part].as_flattened()[at])
    }

    /// Sets an entry.
    ///
    /// # Panics
    /// If the structure has no place for it.
    pub fn set(&mut self, row: usize, column: usize, value: T) {
        let Some((part, at)) = self.structure.place(row, column) else {
            panic!("entry ({row}, {column}) is not in the structure");
        };
        self.parts[part].as_flattened_mut()[at] = value;
    }

    /// The matrix over other scalars, `f` applied to each entry: `f` must take zero to zero.
    pub fn map<U: Scalar>(&self, f: impl Fn(T) -> U) -> RMatrix<U> {
        let all = |lanes: &Vec<Lane<T>>| lanes.iter().map(|lane| lane.map(&f)).collect();
        RMatrix {
            structure: self.structure.clone(),
            parts: self.parts.each_ref().map(all),
        }
    }

    /// Calls `f` with row, column and value of every entry that is stored, zeros included.
    pub fn for_each(&self, mut f: impl FnMut(usize, usize, T)) {
        let structure = &*self.structure;
        let (n, k) = (structure.order, structure.keys);
        for block in &structure.blocks {
            let rows = block.start..block.start + block.size;
            for row in rows.clone() {
                for key in 0..k {
                    f(row, key, self.get(row, key));
                }
            }
            let data = self.parts[LEFT].as_flattened();
            for (first, width, range) in block.tiles() {
                let tile = data[range.start * LANE..range.end * LANE].chunks_exact(width * LANE);
                for (&column, entries) in block.columns.iter().zip(tile) {
                    for (row, &value) in rows.clone().skip(first * LANE).zip(entries) {
                        f(row, k + column as usize, value);
                    }
                }
            }
            let start = block.diagonal * LANE;
            let columns = self.parts[DIAGONAL].as_flattened()[start..].chunks(block.lanes * LANE);
            for (column, entries) in rows.clone().zip(columns) {
                for (row, &value) in rows.clone().zip(entries) {
                    f(row, k + column, value);
                }
            }
        }
        for row in n..n + k {
            for column in 0..n + k {
                f(row, column, self.get(row, column));
            }
        }
    }
}

/// The componentwise backward error of a solution of `M x = b` (002's section 8 gives none):
/// the least ω for which x solves exactly a system whose entries differ from those of M and b by
/// at most ω times their size, `max |b − M x| / (|M| |x| + |b|)` (Oettli and Prager; Higham,
/// Accuracy and Stability, theorem 7.3). A good solver reaches a few units of roundoff.
///
/// Residuals are summed in twice the precision (Ogita, Rump and Oishi, Accurate sum and dot
/// product, algorithm 5.3), so that what is measured is the solution's error, not this function's.
/// Infinite where a row's residual is not zero, but its size is.
///
/// # Panics
/// If `x` or `b` is not as long as the matrix has columns.
pub fn backward_error(matrix: &RMatrix<f64>, x: &[f64], b: &[f64]) -> f64 {
    let size = matrix.structure.size();
    assert_eq!((x.len(), b.len()), (size, size));
    // For each row the sum, what it rounded away, and the sum of sizes.
    let mut rows: Vec<[f64; 3]> = b.iter().map(|&b| [b, 0.0, b.abs()]).collect();
    matrix.for_each(|row, column, value| {
        let [sum, rest, size] = &mut rows[row];
        let product = -value * x[column];
        let error = (-value).mul_add(x[column], -product);
        let next = *sum + product;
        let part = next - *sum;
        *rest += (*sum - (next - part)) + (product - part) + error;
        *sum = next;
        *size += product.abs();
    });
    rows.iter().fold(0.0, |worst: f64, &[sum, rest, size]| {
        let residual = (sum + rest).abs();
        if residual == 0.0 {
            worst
        } else {
            let error = residual / size;
            if error.is_nan() {
                f64::INFINITY
            } else {
                worst.max(error)
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_structures_are_refused() {
        let new = |entry| Structure::new(1, &[1, 2], [entry]).unwrap_err();
        assert_eq!(new((0, 2)), StructureError::Above(0, 2, 0));
        assert_eq!(new((4, 0)), StructureError::Outside(4, 0));
        let empty = Structure::new(1, &[1, 0], []).unwrap_err();
        assert_eq!(empty, StructureError::EmptyBlock(1));
    }

    #[test]
    fn the_backward_error_is_that_of_the_worst_row() {
        let entries = [(0, 0, 1.0), (0, 1, 2.0), (1, 0, 3.0), (1, 1, 4.0)];
        let matrix = RMatrix::from_entries(1, &[1], &entries).unwrap();
        assert_eq!(backward_error(&matrix, &[1.0, 1.0], &[3.0, 7.0]), 0.0);
        // Row 0: |4 − 3| / (3 + 4); row 1: |8 − 7| / (7 + 8).
        assert_eq!(backward_error(&matrix, &[1.0, 1.0], &[4.0, 8.0]), 1.0 / 7.0);
        assert_eq!(
            backward_error(&matrix, &[f64::NAN, 1.0], &[3.0, 7.0]),
            f64::INFINITY
        );
    }
}
