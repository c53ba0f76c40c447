//! Column-major matrices with columns padded to whole SIMD lanes.

/// Floats in one SIMD register (AVX).
pub const LANE: usize = 4;

/// A length rounded up to whole lanes.
pub const fn padded(n: usize) -> usize {
    n.div_ceil(LANE) * LANE
}

/// A vector padded with zeros to whole lanes.
#[derive(Debug, Clone, PartialEq)]
pub struct Vector {
    len: usize,
    lanes: Vec<[f64; LANE]>,
}

impl Vector {
    /// A vector of `len` zeros.
    pub fn zeros(len: usize) -> Self {
        Vector {
            len,
            lanes: vec![[0.0; LANE]; len.div_ceil(LANE)],
        }
    }
}

impl std::ops::Deref for Vector {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.lanes.as_flattened()[..self.len]
    }
}

impl std::ops::DerefMut for Vector {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.lanes.as_flattened_mut()[..self.len]
    }
}

/// Calls a function generic over the number of lanes in a column, so that the loops over a
/// column are unrolled and their accumulators stay in registers.
macro_rules! with_lanes {
    ($lanes:expr, $f:ident ( $($arg:expr),* $(,)? )) => {
        match $lanes {
            1 => $f::<1>($($arg),*),
            2 => $f::<2>($($arg),*),
            3 => $f::<3>($($arg),*),
            4 => $f::<4>($($arg),*),
            5 => $f::<5>($($arg),*),
            6 => $f::<6>($($arg),*),
            7 => $f::<7>($($arg),*),
            8 => $f::<8>($($arg),*),
            // Longer columns are worked on in pieces of eight lanes.
            _ => $f::<0>($($arg),*),
        }
    };
}
pub(super) use with_lanes;

/// A matrix of `rows` × `columns`, column by column, each column padded with zeros.
#[derive(Debug, Clone)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    lanes: usize,
    data: Vec<[f64; LANE]>,
}

impl Matrix {
    /// A matrix of zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        let lanes = rows.div_ceil(LANE);
        Matrix {
            rows,
            columns,
            lanes,
            data: vec![[0.0; LANE]; lanes * columns],
        }
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Lanes in a column.
    pub(super) fn lanes(&self) -> usize {
        self.lanes
    }

    pub(super) fn data_mut(&mut self) -> &mut [[f64; LANE]] {
        &mut self.data
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.data.as_flattened_mut().fill(0.0);
    }

    /// An entry.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        self.column(column)[row]
    }

    /// Sets an entry.
    pub fn set(&mut self, row: usize, column: usize, value: f64) {
        self.column_mut(column)[row] = value;
    }

    /// A column, without its padding.
    pub fn column(&self, column: usize) -> &[f64] {
        let start = column * self.lanes;
        &self.data[start..start + self.lanes].as_flattened()[..self.rows]
    }

    /// A column, to write on.
    pub fn column_mut(&mut self, column: usize) -> &mut [f64] {
        let start = column * self.lanes;
        &mut self.data[start..start + self.lanes].as_flattened_mut()[..self.rows]
    }

    /// `y = A x`, each entry a fused sum of `x.len()` products, x being no longer than a row.
    pub fn multiply(&self, x: &[f64], y: &mut Vector) {
        with_lanes!(
            self.lanes,
            combine(self.lanes, &self.data, x, &mut y.lanes, |a| a)
        );
    }

    /// `y = |A| x`, the same with the entries' absolute values.
    pub fn multiply_abs(&self, x: &[f64], y: &mut Vector) {
        with_lanes!(
            self.lanes,
            combine(self.lanes, &self.data, x, &mut y.lanes, f64::abs)
        );
    }

    /// Adds `factor` times a column of `source` to one of this matrix's columns.
    #[inline(always)]
    pub fn add_column(&mut self, column: usize, factor: f64, source: &Matrix, from: usize) {
        let lanes = self.lanes;
        let to = &mut self.data[column * lanes..(column + 1) * lanes];
        let from = &source.data[from * lanes..(from + 1) * lanes];
        for (to, from) in to.iter_mut().zip(from) {
            for k in 0..LANE {
                to[k] = factor.mul_add(from[k], to[k]);
            }
        }
    }

    /// `y = |A A − B| u`, the matrices square of the same size. Each entry of A A is a fused sum of n products,
    /// then one subtraction, one product and n sums.
    pub fn square_minus_abs(&self, b: &Matrix, u: &[f64], y: &mut Vector) {
        with_lanes!(
            self.lanes,
            square_minus(self.lanes, self.rows, &self.data, &b.data, u, &mut y.lanes)
        );
    }
}

/// `y = Σ_j f(A_j) x_j` over the columns.
fn combine<const L: usize>(
    lanes: usize,
    data: &[[f64; LANE]],
    x: &[f64],
    y: &mut [[f64; LANE]],
    f: impl Fn(f64) -> f64 + Copy,
) {
    if L == 0 {
        y.as_flattened_mut().fill(0.0);
        for (column, &x) in data.chunks_exact(lanes).zip(x) {
            for (y, a) in y.iter_mut().zip(column) {
                for k in 0..LANE {
                    y[k] = f(a[k]).mul_add(x, y[k]);
                }
            }
        }
        return;
    }
    let mut sums = [[0.0; LANE]; L];
    let (columns, _) = data.as_chunks::<L>();
    for (column, &x) in columns.iter().zip(x) {
        for l in 0..L {
            for k in 0..LANE {
                sums[l][k] = f(column[l][k]).mul_add(x, sums[l][k]);
            }
        }
    }
    y[..L].copy_from_slice(&sums);
}

fn square_minus<const L: usize>(
    lanes: usize,
    n: usize,
    a: &[[f64; LANE]],
    b: &[[f64; LANE]],
    u: &[f64],
    y: &mut [[f64; LANE]],
) {
    if L == 0 {
        y.as_flattened_mut().fill(0.0);
        let mut product = [[0.0; LANE]; 8];
        for j in 0..n {
            let column = a[j * lanes..(j + 1) * lanes].as_flattened();
            for start in (0..lanes).step_by(8) {
                let width = (lanes - start).min(8);
                for l in 0..width {
                    product[l] = b[j * lanes + start + l].map(|x| -x);
                }
                for (k, &x) in column[..n].iter().enumerate() {
                    let from = &a[k * lanes + start..k * lanes + start + width];
                    for (p, a) in product[..width].iter_mut().zip(from) {
                        for i in 0..LANE {
                            p[i] = a[i].mul_add(x, p[i]);
                        }
                    }
                }
                for (y, p) in y[start..start + width].iter_mut().zip(&product) {
                    for i in 0..LANE {
                        y[i] = p[i].abs().mul_add(u[j], y[i]);
                    }
                }
            }
        }
        return;
    }
    let (a, _) = a.as_chunks::<L>();
    let (b, _) = b.as_chunks::<L>();
    let mut sums = [[0.0; LANE]; L];
    for j in 0..n {
        let mut product = b[j];
        for lane in &mut product {
            for x in lane {
                *x = -*x;
            }
        }
        let column = a[j].as_flattened();
        for (from, &x) in a.iter().zip(&column[..n]) {
            for l in 0..L {
                for i in 0..LANE {
                    product[l][i] = from[l][i].mul_add(x, product[l][i]);
                }
            }
        }
        for l in 0..L {
            for i in 0..LANE {
                sums[l][i] = product[l][i].abs().mul_add(u[j], sums[l][i]);
            }
        }
    }
    y[..L].copy_from_slice(&sums);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(n: usize, seed: f64) -> Matrix {
        let mut a = Matrix::zeros(n, n);
        for j in 0..n {
            for i in 0..n {
                a.set(i, j, ((i * 31 + j * 17) as f64 * 0.37 + seed).sin());
            }
        }
        a
    }

    #[test]
    fn products_agree_with_another_library() {
        for n in [1, 3, 4, 7, 13, 31, 32, 33, 47, 70] {
            let (a, b) = (filled(n, 0.1), filled(n, 0.7));
            let dense = |m: &Matrix| nalgebra::DMatrix::from_fn(n, n, |i, j| m.get(i, j));
            let u: Vec<f64> = (0..n).map(|i| 1.0 + i as f64 / 7.0).collect();
            let x = nalgebra::DVector::from_column_slice(&u);
            let mut y = Vector::zeros(n);
            let close = |y: &Vector, expected: nalgebra::DVector<f64>| {
                for (got, want) in y.iter().zip(expected.iter()) {
                    assert!(
                        (got - want).abs() <= 1e-12 * (1.0 + want.abs()),
                        "{n}: {got} {want}"
                    );
                }
            };
            a.multiply(&u, &mut y);
            close(&y, dense(&a) * &x);
            a.multiply_abs(&u, &mut y);
            close(&y, dense(&a).abs() * &x);
            a.square_minus_abs(&b, &u, &mut y);
            close(&y, (dense(&a) * dense(&a) - dense(&b)).abs() * &x);
        }
    }
}
