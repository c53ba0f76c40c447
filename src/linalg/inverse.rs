//! The inverse of a small matrix, for use as a preconditioner.

use super::matrix::{LANE, Matrix, Vector, with_lanes};

/// No pivot of any size was left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Singular;

/// Gauss–Jordan exchange steps with partial pivoting, rows left where they are until the end.
///
/// n³ fused operations. Nothing is claimed about the rounding: a proof that uses the result
/// bounds `I − Y A` afterwards.
#[derive(Debug, Clone)]
pub struct Inverter {
    work: Matrix,
    multipliers: Vector,
    /// The pivot row of each column.
    pivot: Vec<usize>,
}

impl Inverter {
    /// For matrices of order `n`.
    pub fn new(n: usize) -> Self {
        Inverter {
            work: Matrix::zeros(n, n),
            multipliers: Vector::zeros(n),
            pivot: vec![0; n],
        }
    }

    /// The matrix to be inverted: fill it, then call [`Inverter::invert_into`].
    pub fn input(&mut self) -> &mut Matrix {
        &mut self.work
    }

    /// Inverts the input, which is lost, into the first columns of `out`.
    ///
    /// ```
    /// use krawl::linalg::{Inverter, Matrix};
    /// let mut inverter = Inverter::new(2);
    /// let a = inverter.input();
    /// a.set(0, 1, 4.0);
    /// a.set(1, 0, 2.0);
    /// let mut y = Matrix::zeros(2, 2);
    /// inverter.invert_into(&mut y).unwrap();
    /// assert_eq!([y.get(0, 0), y.get(0, 1), y.get(1, 0), y.get(1, 1)], [0.0, 0.5, 0.25, 0.0]);
    /// ```
    pub fn invert_into(&mut self, out: &mut Matrix) -> Result<(), Singular> {
        let n = self.work.rows();
        let lanes = self.work.lanes();
        with_lanes!(
            lanes,
            exchange(
                lanes,
                n,
                self.work.data_mut(),
                &mut self.multipliers,
                &mut self.pivot
            )
        )?;
        // Row `pivot[k]` now stands for unknown k, column k for equation `pivot[k]`.
        for k in 0..n {
            let from = self.work.column(k);
            let to = out.column_mut(self.pivot[k]);
            for (to, &row) in to.iter_mut().zip(&self.pivot) {
                *to = from[row];
            }
        }
        Ok(())
    }
}

fn exchange<const L: usize>(
    lanes: usize,
    n: usize,
    data: &mut [[f64; LANE]],
    multipliers: &mut Vector,
    pivot: &mut [usize],
) -> Result<(), Singular> {
    let lanes = if L == 0 { lanes } else { L };
    // 1 where a row has not been a pivot row yet, so that used rows lose every comparison.
    let mut free = [[0.0f64; LANE]; 8];
    let mut free_long = Vec::new();
    let free: &mut [f64] = if L == 0 {
        free_long.resize(lanes * LANE, 0.0);
        &mut free_long
    } else {
        &mut free.as_flattened_mut()[..L * LANE]
    };
    free[..n].fill(1.0);
    for k in 0..n {
        let column = data[k * lanes..(k + 1) * lanes].as_flattened_mut();
        let (mut p, mut best) = (usize::MAX, 0.0);
        for (row, (&x, &f)) in column.iter().zip(free.iter()).enumerate().take(n) {
            let size = x.abs() * f;
            if size > best {
                (p, best) = (row, size);
            }
        }
        if p == usize::MAX || !best.is_finite() {
            return Err(Singular);
        }
        pivot[k] = p;
        free[p] = 0.0;
        let inverse = 1.0 / column[p];
        column[p] = 0.0;
        for (m, x) in multipliers.iter_mut().zip(column.iter_mut()) {
            *x *= inverse;
            *m = -*x;
        }
        column[p] = inverse;
        if L == 0 {
            for j in (0..n).filter(|&j| j != k) {
                let column = data[j * lanes..(j + 1) * lanes].as_flattened_mut();
                let c = column[p];
                if c != 0.0 {
                    for (x, m) in column.iter_mut().zip(multipliers.iter()) {
                        *x = m.mul_add(c, *x);
                    }
                    column[p] = -c * inverse;
                }
            }
        } else {
            let mut m = [[0.0; LANE]; L];
            m.as_flattened_mut()[..n].copy_from_slice(multipliers);
            let (columns, _) = data.as_chunks_mut::<L>();
            for (j, column) in columns.iter_mut().enumerate().take(n) {
                let c = column.as_flattened()[p];
                if j == k || c == 0.0 {
                    continue;
                }
                for l in 0..L {
                    for i in 0..LANE {
                        column[l][i] = m[l][i].mul_add(c, column[l][i]);
                    }
                }
                column.as_flattened_mut()[p] = -c * inverse;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_times_matrix_is_the_identity() {
        for n in [1, 2, 4, 9, 19, 31, 32, 33, 50] {
            let entry = |i: usize, j: usize| {
                // Sparse, with zeros on the diagonal, so that pivoting is needed.
                if (i + 2 * j).is_multiple_of(3) && i == j {
                    0.0
                } else {
                    ((i * 29 + j * 13) as f64).sin()
                }
            };
            let mut inverter = Inverter::new(n);
            for j in 0..n {
                for i in 0..n {
                    inverter
                        .input()
                        .set(i, j, if n == 1 { 2.0 } else { entry(i, j) });
                }
            }
            let a = nalgebra::DMatrix::from_fn(n, n, |i, j| inverter.work.get(i, j));
            let mut y = Matrix::zeros(n, n + 1);
            inverter.invert_into(&mut y).unwrap();
            let y = nalgebra::DMatrix::from_fn(n, n, |i, j| y.get(i, j));
            let error = (nalgebra::DMatrix::identity(n, n) - &y * &a).abs().max();
            assert!(error < 1e-10 * y.abs().max().max(1.0), "order {n}: {error}");
        }
    }

    #[test]
    fn a_singular_matrix_is_refused() {
        let mut inverter = Inverter::new(3);
        inverter.input().set(0, 0, 1.0);
        assert_eq!(
            inverter.invert_into(&mut Matrix::zeros(3, 3)),
            Err(Singular)
        );
    }
}
