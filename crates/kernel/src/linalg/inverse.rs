//! Inverses of sparse matrices of one pattern, for use as preconditioners.

use super::matrix::{LANE, Lane, Matrix, Sparse, Vector, with_block};
use super::pivots::{Pivots, Room};
use crate::places::{Each as _, array};

/// No pivot of any size was left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Singular;

/// Where a pivot falls below this fraction of the largest entry that could have been it, new
/// pivots are chosen. It only guards the quality of the inverse.
const WEAK_PIVOT: f64 = 1e-5;

/// Gauss–Jordan exchange steps in an order of pivots that keeps the matrix sparse for long. The
/// order is kept from one matrix to the next as long as its pivots are not too small: matrices
/// along a path change little, and a change of pivots is what a change of construction plan is
/// to the linear algebra (DESIGN.md).
///
/// At most n³ fused operations. Nothing is claimed about the rounding: a proof that uses the
/// result bounds `I − Y A` afterwards.
#[derive(Debug, Clone)]
pub struct Inverter {
    pattern: Sparse,
    pivots: Pivots,
    room: Room,
    /// For each entry of the pattern its place in `work`, rows being permuted so that the pivot
    /// of column k is in row k.
    places: Vec<usize>,
    work: Matrix,
    multipliers: Vector,
    /// 1 for rows that have not been pivot rows yet, otherwise 0.
    free: Vector,
    /// How often pivots were chosen.
    choices: usize,
    /// The sign of the last determinant.
    negative: bool,
}

impl Inverter {
    /// For matrices of a square pattern.
    pub fn new(pattern: &Sparse) -> Self {
        let n = pattern.columns();
        Inverter {
            pattern: pattern.clone(),
            pivots: Pivots::default(),
            room: Room::default(),
            places: vec![0; pattern.entries()],
            work: Matrix::zeros(n, n),
            multipliers: Vector::zeros(n),
            free: Vector::zeros(n),
            choices: 0,
            negative: false,
        }
    }

    /// How often an order of pivots was chosen so far.
    pub fn choices(&self) -> usize {
        self.choices
    }

    /// Whether the determinant of the matrix inverted last is negative, as floats see it.
    pub fn is_negative(&self) -> bool {
        self.negative
    }

    /// Inverts the matrix with the given values into `out`.
    ///
    /// ```
    /// use krawl::linalg::{Inverter, Matrix, Sparse};
    /// // Column 0 has an entry in row 1, column 1 in row 0.
    /// let mut inverter = Inverter::new(&Sparse::new(&[vec![1], vec![0]]));
    /// let mut y = Matrix::zeros(2, 2);
    /// inverter.invert(&[2.0, 4.0], &mut y).unwrap();
    /// assert_eq!([y.get(0, 0), y.get(0, 1), y.get(1, 0), y.get(1, 1)], [0.0, 0.5, 0.25, 0.0]);
    /// ```
    pub fn invert(&mut self, values: &[f64], out: &mut Matrix) -> Result<(), Singular> {
        let kept = !self.pivots.order.is_empty() && self.exchange_all(values).is_ok();
        if !kept {
            self.choose(values)?;
            if let Err(singular) = self.exchange_all(values) {
                // Pivots chosen for such a matrix are no good for the next one either.
                self.pivots.order.clear();
                return Err(singular);
            }
        }
        for (column, &row) in self.pivots.row_of.iter().enumerate() {
            // Column k of the result stands for the equation that was its pivot.
            out.column_mut(row)
                .copy_from_slice(self.work.column(column));
        }
        Ok(())
    }

    fn choose(&mut self, values: &[f64]) -> Result<(), Singular> {
        self.choices += 1;
        let chosen = self.pivots.choose(&self.pattern, values, &mut self.room);
        if chosen.is_none() {
            self.pivots.order.clear();
            return Err(Singular);
        }
        let stride = self.work.lanes() * LANE;
        let mut next = 0;
        for column in 0..self.pattern.columns() {
            for (row, _) in self.pattern.column(values, column) {
                self.places[next] = column * stride + self.pivots.column_of[row];
                next += 1;
            }
        }
        Ok(())
    }

    fn exchange_all(&mut self, values: &[f64]) -> Result<(), Singular> {
        self.work.clear();
        let data = self.work.data_mut().as_flattened_mut();
        for (&place, &value) in self.places.iter().zip(values) {
            data[place] = value;
        }
        self.free.fill(1.0);
        let lanes = self.work.lanes();
        self.negative = with_block!(
            lanes,
            exchange(
                lanes,
                self.work.data_mut(),
                &self.pivots,
                &mut self.multipliers,
                &mut self.free
            )
        )?;
        Ok(())
    }
}

fn exchange<const L: usize>(
    lanes: usize,
    data: &mut [Lane],
    pivots: &Pivots,
    multipliers: &mut Vector,
    free: &mut Vector,
) -> Result<bool, Singular> {
    let mut negative = pivots.odd;
    // A column is so many blocks of L lanes.
    let (blocks, per_column) = (data.as_chunks_mut::<L>().0, lanes / L);
    for (step, &k) in pivots.order.iter().enumerate() {
        let touched = &pivots.touched[pivots.starts[step]..pivots.starts[step + 1]];
        let (block_of_k, lane, at) = (k / (L * LANE), k / LANE % L, k % LANE);
        let column = &mut blocks[k * per_column..(k + 1) * per_column];
        let pivot = column[block_of_k][lane][at];
        let largest = largest(column.as_flattened(), free.lanes());
        // Also refuses a NaN and an infinity.
        let strong = pivot.abs() >= WEAK_PIVOT * largest && pivot != 0.0 && largest.is_finite();
        if !strong {
            return Err(Singular);
        }
        negative ^= pivot < 0.0;
        free[k] = 0.0;
        let inverse = 1.0 / pivot;
        column[block_of_k][lane][at] = 0.0;
        let column_lanes = column.as_flattened_mut().iter_mut();
        for (m, x) in multipliers.lanes_mut().iter_mut().zip(column_lanes) {
            let scaled = x.each(|x| x * inverse);
            *x = scaled;
            *m = scaled.each(|x| -x);
        }
        column[block_of_k][lane][at] = inverse;
        // The block of the pivot's row last, as all the others read it.
        let others = (0..per_column).filter(|&at| at != block_of_k);
        for block in others.chain([block_of_k]) {
            let m = multipliers.lanes().as_chunks::<L>().0[block];
            for &j in touched {
                let from = j as usize * per_column;
                let c = blocks[from + block_of_k][lane][at];
                let entries = &mut blocks[from + block];
                for (entry, m) in entries.iter_mut().zip(&m) {
                    let sum = *entry;
                    *entry = array(|i| m[i].mul_add(c, sum[i]));
                }
                if block == block_of_k {
                    // Its multiplier was zero.
                    entries[lane][at] = c * -inverse;
                }
            }
        }
    }
    Ok(negative)
}

/// The largest entry among the free rows.
fn largest(column: &[Lane], free: &[Lane]) -> f64 {
    let mut best = [0.0; LANE];
    for (x, f) in column.iter().zip(free) {
        for i in 0..LANE {
            let size = x[i].abs() * f[i];
            // A NaN wins every comparison, and is refused by the caller.
            best[i] = if size <= best[i] { best[i] } else { size };
        }
    }
    best.into_iter()
        .fold(0.0f64, |max, x| if x <= max { max } else { x })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_times_matrix_is_the_identity() {
        for n in [1usize, 2, 4, 9, 19, 31, 32, 33, 50, 70] {
            let columns: Vec<Vec<usize>> = (0..n)
                .map(|j| {
                    (0..n)
                        .filter(|&i| n < 3 || (i * i + 3 * j) % 4 < 2 || i == (j + 1) % n)
                        .collect()
                })
                .collect();
            let pattern = Sparse::new(&columns);
            let mut inverter = Inverter::new(&pattern);
            // The second matrix is inverted with the pivots of the first; the third needs others.
            for seed in [0.0, 0.01, 2.0] {
                let mut dense = nalgebra::DMatrix::<f64>::zeros(n, n);
                let mut values = Vec::new();
                for (j, column) in columns.iter().enumerate() {
                    for &i in column {
                        let value = ((i * 29 + j * 13) as f64 * 1.3 + seed + 0.5).sin()
                            + if i == (j + 1) % n { 2.0 } else { 0.0 };
                        dense[(i, j)] = value;
                        values.push(value);
                    }
                }
                let mut y = Matrix::zeros(n, n);
                inverter.invert(&values, &mut y).unwrap();
                assert_eq!(inverter.is_negative(), dense.determinant() < 0.0);
                let y = nalgebra::DMatrix::from_fn(n, n, |i, j| y.get(i, j));
                let error = (nalgebra::DMatrix::identity(n, n) - &y * &dense)
                    .abs()
                    .max();
                assert!(error < 1e-9 * y.abs().max().max(1.0), "order {n}: {error}");
            }
        }
    }

    #[test]
    fn a_singular_matrix_is_refused() {
        let pattern = Sparse::new(&[vec![0, 1], vec![0, 1]]);
        let mut inverter = Inverter::new(&pattern);
        let mut y = Matrix::zeros(2, 2);
        assert_eq!(
            inverter.invert(&[1.0, 2.0, 2.0, 4.0], &mut y),
            Err(Singular)
        );
        assert_eq!(
            inverter.invert(&[f64::NAN, 2.0, 2.0, 4.0], &mut y),
            Err(Singular)
        );
        assert_eq!(inverter.invert(&[1.0, 2.0, 2.0, 3.0], &mut y), Ok(()));
        assert_eq!(inverter.choices(), 3);
    }
}
