//! Elimination in matrices of complex numbers, as fast as processors can.

use crate::interval::complex::{Complex, Number};

/// A square matrix of complex numbers and its elimination with pivots of rows, real and imaginary parts apart.
#[derive(Debug)]
pub struct Matrix<N> {
    n: usize,
    re: Vec<N>,
    im: Vec<N>,
    /// Which row stands at each place.
    order: Vec<usize>,
    /// Inverses of the pivots.
    pivots: Vec<Complex<N>>,
    work: Vec<Complex<N>>,
}

impl<N: Number> Matrix<N> {
    /// Zero, with n rows.
    pub fn new(n: usize) -> Self {
        Matrix {
            n,
            re: vec![N::default(); n * n],
            im: vec![N::default(); n * n],
            order: (0..n).collect(),
            pivots: vec![Complex::default(); n],
            work: vec![Complex::default(); n],
        }
    }

    /// Makes it zero.
    pub fn clear(&mut self) {
        self.re.fill(N::default());
        self.im.fill(N::default());
        for (k, row) in self.order.iter_mut().enumerate() {
            *row = k;
        }
    }

    /// Adds to an entry, before the elimination.
    #[inline(always)]
    pub fn add(&mut self, row: usize, column: usize, value: Complex<N>) {
        let at = row * self.n + column;
        self.re[at] = self.re[at] + value.re;
        self.im[at] = self.im[at] + value.im;
    }

    /// L and U in place. False where a pivot is zero or no number.
    pub fn eliminate(&mut self) -> bool {
        let n = self.n;
        for k in 0..n {
            let mut best = (k, -1.0);
            for place in k..n {
                let at = self.order[place] * n + k;
                let size = Complex::new(self.re[at], self.im[at]).norm_sqr();
                if size > best.1 {
                    best = (place, size);
                }
            }
            if best.1 <= 0.0 || !best.1.is_finite() {
                return false;
            }
            self.order.swap(k, best.0);
            let top = self.order[k] * n;
            let inverse = Complex::new(self.re[top + k], self.im[top + k]).inverse();
            self.pivots[k] = inverse;
            for place in k + 1..n {
                let row = self.order[place] * n;
                let here = Complex::new(self.re[row + k], self.im[row + k]);
                if here.re.rough() == 0.0 && here.im.rough() == 0.0 {
                    continue;
                }
                let factor = here * inverse;
                subtract(&mut self.re, &mut self.im, [row, top], k + 1, n, factor);
                self.re[row + k] = factor.re;
                self.im[row + k] = factor.im;
            }
        }
        true
    }

    /// Puts the solution in place of the right-hand side.
    pub fn solve(&mut self, right: &mut [Complex<N>]) {
        let n = self.n;
        let dot = |row: usize, from: usize, to: usize, x: &[Complex<N>]| -> Complex<N> {
            let (re, im) = (
                &self.re[row + from..row + to],
                &self.im[row + from..row + to],
            );
            let mut sum = Complex::default();
            for ((&a, &b), z) in re.iter().zip(im).zip(&x[from..to]) {
                sum.re = N::fused(a, z.re, N::fused(-b, z.im, sum.re));
                sum.im = N::fused(a, z.im, N::fused(b, z.re, sum.im));
            }
            sum
        };
        let mut work = std::mem::take(&mut self.work);
        for k in 0..n {
            let row = self.order[k];
            work[k] = right[row] - dot(row * n, 0, k, &work);
        }
        for k in (0..n).rev() {
            work[k] = (work[k] - dot(self.order[k] * n, k + 1, n, &work)) * self.pivots[k];
        }
        right.copy_from_slice(&work);
        self.work = work;
    }
}

/// Subtracts a multiple of one row from another, from a column on.
fn subtract<N: Number>(
    re: &mut [N],
    im: &mut [N],
    [row, top]: [usize; 2],
    from: usize,
    n: usize,
    factor: Complex<N>,
) {
    let (row_re, top_re) = two_rows(re, row, top, from, n);
    let (row_im, top_im) = two_rows(im, row, top, from, n);
    for (((a, b), &c), &d) in row_re.iter_mut().zip(row_im).zip(top_re).zip(top_im) {
        *a = N::fused(factor.im, d, N::fused(-factor.re, c, *a));
        *b = N::fused(-factor.im, c, N::fused(-factor.re, d, *b));
    }
}

/// One row to write and another to read, from a column on.
fn two_rows<N>(all: &mut [N], row: usize, top: usize, from: usize, n: usize) -> (&mut [N], &[N]) {
    if row < top {
        let (low, high) = all.split_at_mut(top);
        (&mut low[row + from..row + n], &high[from..n])
    } else {
        let (low, high) = all.split_at_mut(row);
        (&mut high[from..n], &low[top + from..top + n])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::DoubleDouble;

    /// With Hilbert's matrix of 14 rows floats lose all digits, and double-doubles keep ten.
    #[test]
    fn double_doubles_solve_what_floats_cannot() {
        let n = 6;
        let entry = |i: usize, j: usize| -> Complex<DoubleDouble> {
            // Its rows are turned by powers of i.
            let value = DoubleDouble::from((i + j + 1) as f64).inverse();
            match i % 4 {
                0 => Complex::new(value, 0.0.into()),
                1 => Complex::new(0.0.into(), value),
                2 => Complex::new(-value, 0.0.into()),
                _ => Complex::new(0.0.into(), -value),
            }
        };
        fn worst<N: Number>(
            n: usize,
            entry: &dyn Fn(usize, usize) -> Complex<DoubleDouble>,
        ) -> f64 {
            let mut matrix = Matrix::<N>::new(n);
            let mut right = vec![Complex::<N>::default(); n];
            for (i, right) in right.iter_mut().enumerate() {
                let mut sum = Complex::<DoubleDouble>::default();
                for j in 0..n {
                    let value = entry(i, j);
                    sum = sum + value;
                    matrix.add(i, j, Complex::new(N::near(value.re), N::near(value.im)));
                }
                *right = Complex::new(N::near(sum.re), N::near(sum.im));
            }
            assert!(matrix.eliminate());
            matrix.solve(&mut right);
            let off = right.iter().map(|&x| (x - Complex::real(1.0)).norm_sqr());
            off.fold(0.0, f64::max).sqrt()
        }
        assert!(worst::<f64>(n, &entry) < 1e-8);
        assert!(worst::<DoubleDouble>(n, &entry) < 1e-22);
        assert!(worst::<f64>(14, &entry) > 1e-3);
        assert!(worst::<DoubleDouble>(14, &entry) < 1e-10);
    }
}
