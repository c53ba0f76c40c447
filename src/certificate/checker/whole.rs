//! Matrices of whole numbers: products without any rounding.
//!
//! A Krawczyk test may use any matrices for Y and A, so the checker takes multiples of 2⁻³⁶. The
//! Jacobian is a multiple of 2⁻³⁶ and a rest, which is bounded. Then I − Y J₀, A² − Y J₂ and the
//! like are *exact* in 128-bit integers, and no error analysis has to be believed.

use crate::interval::Interval;
use crate::interval::point;

/// Matrices are in units of 2 to minus this.
pub const BITS: i32 = 36;
/// Entries are smaller: 2¹⁶ products of two of them still fit into an `i128`.
const LIMIT: f64 = (1u64 << 55) as f64;
/// Vectors are taken to about so many bits.
const VECTOR_BITS: i32 = 50;

/// A square matrix, or the integer part of one, row by row.
#[derive(Debug, Clone)]
pub struct Whole {
    pub n: usize,
    pub entries: Vec<i64>,
}

/// A matrix with few entries: (column, entry) for each row.
pub type Rows = Vec<Vec<(usize, i64)>>;

/// Splits a number into a multiple of 2⁻³⁶ and a bound on the rest. `None`: too large.
pub fn split(x: Interval) -> Option<(i64, Interval)> {
    let whole = (x.mid() * power(BITS)).round();
    let fits = whole.abs() < LIMIT;
    fits.then(|| (whole as i64, size(x - point(whole * power(-BITS)))))
}

/// |x|, as an interval of one number or, where that is infinite, of all.
pub fn size(x: Interval) -> Interval {
    exact(x.mag())
}

/// The interval of one number; everything where it is not finite, so that no test succeeds.
pub fn exact(x: f64) -> Interval {
    if x.is_finite() {
        point(x)
    } else {
        Interval::ENTIRE
    }
}

/// 2 to a power between −1022 and 1023, exactly.
fn power(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// At least x 2^−bits / `over`: every operation rounds to nearest, and one step up covers it.
fn above(x: i128, over: u16, bits: i32) -> f64 {
    let ratio = (x as f64).next_up() / f64::from(over);
    (ratio.next_up() * power(-bits)).next_up()
}

/// At least max_i Σ_j |b_ij| u_j / u_i, for a matrix in units of 2^−`bits`.
fn norm(n: usize, u: &[u16], bits: i32, entry: impl Fn(usize) -> i128) -> Option<Interval> {
    let mut largest = 0.0f64;
    for i in 0..n {
        let mut sum = 0i128;
        for j in 0..n {
            let term = entry(i * n + j).checked_abs()?;
            sum = sum.checked_add(term.checked_mul(u[j].into())?)?;
        }
        largest = largest.max(above(sum, u[i], bits));
    }
    Some(exact(largest))
}

impl Whole {
    /// The matrix nearest to one of floats.
    pub fn nearest(n: usize, floats: &[f64]) -> Option<Self> {
        let entries = floats.iter().map(|&x| {
            let whole = (x * power(BITS)).round();
            (whole.abs() < LIMIT).then_some(whole as i64)
        });
        let entries = entries.collect::<Option<Vec<_>>>()?;
        Some(Whole { n, entries })
    }

    /// An entry as a float.
    pub fn float(&self, k: usize) -> f64 {
        self.entries[k] as f64 * power(-BITS)
    }

    /// The product with a sparse matrix, in units of 2⁻⁷².
    fn times(&self, rows: &Rows) -> Vec<i128> {
        let n = self.n;
        let mut out = vec![0i128; n * n];
        for (y, out) in self.entries.chunks(n).zip(out.chunks_mut(n)) {
            for (&y, row) in y.iter().zip(rows) {
                for &(j, x) in row {
                    out[j] += i128::from(y) * i128::from(x);
                }
            }
        }
        out
    }

    /// |I − Y J|_u.
    pub fn defect(&self, rows: &Rows, u: &[u16]) -> Option<Interval> {
        let (n, product) = (self.n, self.times(rows));
        let one = |k: usize| {
            if k.is_multiple_of(n + 1) {
                1i128 << (2 * BITS)
            } else {
                0
            }
        };
        norm(n, u, 2 * BITS, |k| one(k) - product[k])
    }

    /// The whole matrix A nearest to Y J, and |Y J − A|_u.
    pub fn moving(&self, rows: &Rows, u: &[u16]) -> Option<(Whole, Interval)> {
        let (n, product) = (self.n, self.times(rows));
        let nearest = |&x: &i128| {
            let whole = (x + (1 << (BITS - 1))) >> BITS;
            (whole.unsigned_abs() < LIMIT as u128).then_some(whole as i64)
        };
        let entries = product.iter().map(nearest).collect::<Option<Vec<_>>>()?;
        let a = Whole { n, entries };
        let rest = norm(n, u, 2 * BITS, |k| {
            product[k] - (i128::from(a.entries[k]) << BITS)
        })?;
        Some((a, rest))
    }

    /// |A|_u.
    pub fn norm(&self, u: &[u16]) -> Option<Interval> {
        norm(self.n, u, BITS, |k| self.entries[k].into())
    }

    /// |A² − Y J|_u and |Y J|_u, A being this matrix.
    pub fn square_minus(&self, y: &Whole, rows: &Rows, u: &[u16]) -> Option<[Interval; 2]> {
        let (n, product) = (self.n, y.times(rows));
        let mut square = vec![0i128; n * n];
        for (a, out) in self.entries.chunks(n).zip(square.chunks_mut(n)) {
            for (&a, row) in a.iter().zip(self.entries.chunks(n)) {
                for (out, &b) in out.iter_mut().zip(row) {
                    *out += i128::from(a) * i128::from(b);
                }
            }
        }
        Some([
            norm(n, u, 2 * BITS, |k| square[k] - product[k])?,
            norm(n, u, 2 * BITS, |k| product[k])?,
        ])
    }

    /// Bounds of |Y v|_i for every v in a box.
    pub fn bounds(&self, v: &[Interval]) -> Option<Vec<Interval>> {
        self.rows_times(v, |sum, bits| exact(above(sum, 1, bits)))
    }

    /// |Y v|_u for every v in a box.
    pub fn norm_of(&self, v: &[Interval], u: &[u16]) -> Option<Interval> {
        let mut i = 0;
        let ratios = self.rows_times(v, |sum, bits| {
            i += 1;
            above(sum, u[i - 1], bits - 16)
        })?;
        Some(exact(ratios.into_iter().fold(0.0, f64::max)))
    }

    /// The integer that bounds |Y v|_i, and its unit's exponent, for every row.
    fn rows_times<T>(
        &self,
        v: &[Interval],
        mut result: impl FnMut(i128, i32) -> T,
    ) -> Option<Vec<T>> {
        if !v.iter().all(|x| x.mag() <= 1e60) {
            return None;
        }
        let largest = v.iter().fold(0.0f64, |max, x| max.max(x.mag()));
        let bits = VECTOR_BITS - largest.max(1e-200).log2().ceil() as i32;
        // Scaling by a power of two is exact, or below the smallest normal number, where the
        // step to the neighbour covers it.
        let scaled = |x: f64| x * power(bits);
        let split: Vec<(i64, i64)> = v
            .iter()
            .map(|x| {
                let low = scaled(x.inf()).next_down().floor() as i64;
                let high = scaled(x.sup()).next_up().ceil() as i64;
                let middle = (low + high) / 2;
                (middle, (high - middle).max(middle - low))
            })
            .collect();
        let rows = self.entries.chunks(self.n);
        let sums = rows.map(|row| {
            let (mut middle, mut radius) = (0i128, 0i128);
            for (&y, &(x, r)) in row.iter().zip(&split) {
                middle += i128::from(y) * i128::from(x);
                radius += i128::from(y.unsigned_abs()) * i128::from(r);
            }
            result(middle.abs() + radius, BITS + bits)
        });
        Some(sums.collect())
    }
}

/// A float inverse, or nothing where there is none: Gauss and Jordan, with row pivots.
pub fn invert(n: usize, mut a: Vec<f64>) -> Option<Vec<f64>> {
    let mut y = vec![0.0; n * n];
    (0..n).for_each(|i| y[i * n + i] = 1.0);
    for k in 0..n {
        let size = |i: &usize| a[i * n + k].abs();
        let pivot = (k..n).max_by(|i, j| size(i).total_cmp(&size(j)))?;
        for j in 0..n {
            a.swap(k * n + j, pivot * n + j);
            y.swap(k * n + j, pivot * n + j);
        }
        let scale = 1.0 / a[k * n + k];
        if !scale.is_finite() {
            return None;
        }
        for matrix in [&mut a, &mut y] {
            matrix[k * n..(k + 1) * n]
                .iter_mut()
                .for_each(|x| *x *= scale);
        }
        let (row_a, row_y) = (
            a[k * n..(k + 1) * n].to_vec(),
            y[k * n..(k + 1) * n].to_vec(),
        );
        for i in (0..n).filter(|&i| i != k) {
            let factor = a[i * n + k];
            if factor != 0.0 {
                for (matrix, row) in [(&mut a, &row_a), (&mut y, &row_y)] {
                    for (x, r) in matrix[i * n..(i + 1) * n].iter_mut().zip(row) {
                        *x -= factor * r;
                    }
                }
            }
        }
    }
    Some(y)
}
