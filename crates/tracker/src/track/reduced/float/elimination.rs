//! The small linear systems of the reduced space.

use crate::plan::Lanes;

/// Gaussian elimination with complete pivoting of a d × (d + 1) matrix J, columns scaled.
///
/// The column that is left over is the parameter that moves most along the path: it stays fixed
/// when residuals are corrected, and its unit vector's completion spans the null space. Storage is
/// reused: no allocation once the largest d has been seen.
#[derive(Debug, Clone, Default)]
pub(super) struct Elimination {
    d: usize,
    /// Row-major, `d + 1` to a row; unit lower factor below the diagonal.
    lu: Vec<f64>,
    rows: Vec<usize>,
    columns: Vec<usize>,
    /// One over the size of each column, by original column.
    scale: Vec<f64>,
    per_pivot: Vec<f64>,
    work: Vec<f64>,
    parity: f64,
}

impl Elimination {
    /// Factorizes. `jacobian` has `chunks` groups of four to a row, `sizes` the squares of the
    /// columns' scales. False where the matrix has not full rank.
    pub fn factorize(&mut self, d: usize, jacobian: &[Lanes], sizes: &[Lanes]) -> bool {
        let (width, chunks) = (d + 1, sizes.len());
        self.d = d;
        self.lu.resize(d * width, 0.0);
        self.per_pivot.resize(d, 0.0);
        self.work.resize(width, 0.0);
        self.rows.clear();
        self.rows.extend(0..d);
        self.columns.clear();
        self.columns.extend(0..width);
        self.scale.clear();
        self.scale
            .extend((0..width).map(|j| 1.0 / sizes[j / 4].0[j % 4].sqrt()));
        for (row, jacobian) in self
            .lu
            .chunks_exact_mut(width)
            .zip(jacobian.chunks_exact(chunks))
        {
            for (j, (x, scale)) in row.iter_mut().zip(&self.scale).enumerate() {
                *x = jacobian[j / 4].0[j % 4] * scale;
            }
        }
        self.parity = 1.0;
        for k in 0..d {
            let (mut best, mut at) = (0.0, (k, k));
            for i in k..d {
                for (j, x) in self.lu[i * width..][..width].iter().enumerate().skip(k) {
                    if x.abs() > best {
                        best = x.abs();
                        at = (i, j);
                    }
                }
            }
            if !(best > 1e-14 && best.is_finite()) {
                return false;
            }
            if at.0 != k {
                let (upper, lower) = self.lu.split_at_mut(at.0 * width);
                upper[k * width..][..width].swap_with_slice(&mut lower[..width]);
                self.rows.swap(k, at.0);
                self.parity = -self.parity;
            }
            if at.1 != k {
                for row in self.lu.chunks_exact_mut(width) {
                    row.swap(k, at.1);
                }
                self.columns.swap(k, at.1);
                self.parity = -self.parity;
            }
            let (upper, lower) = self.lu.split_at_mut((k + 1) * width);
            let pivot_row = &upper[k * width..];
            let per_pivot = 1.0 / pivot_row[k];
            self.parity = self.parity.copysign(self.parity * per_pivot);
            self.per_pivot[k] = per_pivot;
            for row in lower.chunks_exact_mut(width) {
                let factor = row[k] * per_pivot;
                row[k] = factor;
                for (x, &p) in row[k + 1..].iter_mut().zip(&pivot_row[k + 1..]) {
                    *x = (-factor).mul_add(p, *x);
                }
            }
        }
        true
    }

    /// The parameter that is left over.
    pub fn free(&self) -> usize {
        self.columns[self.d]
    }

    /// Solves J δ = right with the left-over parameter fixed; δ is written into lanes.
    pub fn solve(&mut self, right: &[f64], out: &mut [Lanes]) {
        let width = self.d + 1;
        for k in 0..self.d {
            let mut sum = right[self.rows[k]];
            for (l, x) in self.lu[k * width..][..k].iter().zip(&self.work) {
                sum = (-l).mul_add(*x, sum);
            }
            self.work[k] = sum;
        }
        self.work[self.d] = 0.0;
        self.back(out);
    }

    /// A vector of the null space, and the sign of the determinant of J with it as last row.
    ///
    /// Along a regular curve J = 0 the determinant does not change its sign if the vector always
    /// points the same way: this tells directions apart where the angle to an earlier tangent,
    /// across a hairpin, does not.
    pub fn null(&mut self, out: &mut [Lanes]) -> f64 {
        let width = self.d + 1;
        for k in 0..self.d {
            self.work[k] = -self.lu[k * width + self.d];
        }
        self.work[self.d] = 1.0;
        self.back(out);
        self.parity
    }

    fn back(&mut self, out: &mut [Lanes]) {
        let width = self.d + 1;
        for k in (0..self.d).rev() {
            let mut sum = self.work[k];
            for (u, x) in self.lu[k * width + k + 1..][..self.d - k - 1]
                .iter()
                .zip(&self.work[k + 1..])
            {
                sum = (-u).mul_add(*x, sum);
            }
            self.work[k] = sum * self.per_pivot[k];
        }
        out.fill(Lanes::ZERO);
        for (x, &column) in self.work.iter().zip(&self.columns) {
            out[column / 4].0[column % 4] = x * self.scale[column];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_and_spans_the_null_space() {
        let jacobian = [Lanes([1.0, 2.0, -1.0, 0.0]), Lanes([0.5, 0.0, 4.0, 0.0])];
        let sizes = [Lanes([1.0, 4.0, 9.0, 0.0])];
        let mut elimination = Elimination::default();
        assert!(elimination.factorize(2, &jacobian, &sizes));
        let mut out = [Lanes::ZERO];
        let product = |x: Lanes| jacobian.map(|row| Lanes::ZERO.plus_product(row, x).sum());
        let sign = elimination.null(&mut out);
        assert!(product(out[0]).iter().all(|x| x.abs() < 1e-14));
        let rows = [jacobian[0].0, jacobian[1].0, out[0].0].map(|x| [x[0], x[1], x[2]]);
        let minor = |i: usize, j: usize| rows[1][i] * rows[2][j] - rows[1][j] * rows[2][i];
        let determinant =
            rows[0][0] * minor(1, 2) - rows[0][1] * minor(0, 2) + rows[0][2] * minor(0, 1);
        assert_eq!(sign, determinant.signum());
        elimination.solve(&[3.0, -2.0], &mut out);
        let y = product(out[0]);
        assert!((y[0] - 3.0).abs() < 1e-14 && (y[1] + 2.0).abs() < 1e-14);
        assert!(!elimination.factorize(2, &[Lanes::UNIT[0], Lanes::UNIT[0]], &sizes));
    }
}
