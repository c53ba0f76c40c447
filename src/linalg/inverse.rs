//! The inverse of a small matrix, for use as a preconditioner.

use super::matrix::{LANE, Lane, Matrix, Vector, with_block};

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
    /// 1 for rows that have not been pivot rows yet, otherwise 0.
    free: Vector,
    /// The pivot row of each column.
    pivot: Vec<usize>,
}

impl Inverter {
    /// For matrices of order `n`.
    pub fn new(n: usize) -> Self {
        Inverter {
            work: Matrix::zeros(n, n),
            multipliers: Vector::zeros(n),
            free: Vector::zeros(n),
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
        with_block!(
            lanes,
            exchange((lanes, n), self.work.data_mut(), &mut self.multipliers, &mut self.free, &mut self.pivot)
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
    (lanes, n): (usize, usize),
    data: &mut [Lane],
    multipliers: &mut Vector,
    free: &mut Vector,
    pivot: &mut [usize],
) -> Result<(), Singular> {
    free.fill(1.0);
    for k in 0..n {
        let column = &mut data[k * lanes..(k + 1) * lanes];
        let p = largest(column, free.lanes()).ok_or(Singular)?;
        pivot[k] = p;
        free[p] = 0.0;
        let inverse = 1.0 / column[p / LANE][p % LANE];
        column[p / LANE][p % LANE] = 0.0;
        for (m, x) in multipliers.lanes_mut().iter_mut().zip(column.iter_mut()) {
            for i in 0..LANE {
                x[i] *= inverse;
                m[i] = -x[i];
            }
        }
        column[p / LANE][p % LANE] = inverse;
        for offset in (0..lanes).step_by(L) {
            let m: [Lane; L] = multipliers.lanes()[offset..offset + L].try_into().expect("L lanes");
            for (j, column) in data.chunks_exact_mut(lanes).enumerate().take(n) {
                let c = column[p / LANE][p % LANE];
                // The Jacobians are sparse, and stay so for a while.
                if j == k || c == 0.0 {
                    continue;
                }
                let block: &mut [Lane; L] = (&mut column[offset..offset + L]).try_into().expect("L lanes");
                for l in 0..L {
                    for i in 0..LANE {
                        block[l][i] = m[l][i].mul_add(c, block[l][i]);
                    }
                }
            }
        }
        // The pivot's row last, as all blocks read it; its multiplier was zero.
        for (j, column) in data.chunks_exact_mut(lanes).enumerate().take(n) {
            if j != k {
                column[p / LANE][p % LANE] *= -inverse;
            }
        }
    }
    Ok(())
}

/// The row of the largest entry among the free ones; none if they are zero or not finite.
fn largest(column: &[Lane], free: &[Lane]) -> Option<usize> {
    let mut best = [0.0; LANE];
    for (x, f) in column.iter().zip(free) {
        for i in 0..LANE {
            // A NaN loses every comparison.
            let size = x[i].abs() * f[i];
            best[i] = if size > best[i] { size } else { best[i] };
        }
    }
    let best = best.into_iter().fold(0.0f64, f64::max);
    if best == 0.0 || !best.is_finite() {
        return None;
    }
    column.as_flattened().iter().zip(free.as_flattened()).position(|(x, f)| x.abs() * f == best)
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
