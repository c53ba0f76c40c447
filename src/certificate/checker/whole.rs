//! Matrices of whole numbers: products without any rounding.
//!
//! A Krawczyk test may use any matrices for Y and A, so the checker takes multiples of powers of
//! two. The Jacobian is such a multiple and a rest, which is bounded. Then I − Y J₀, A² − Y J₂ and
//! the like are *exact* in integers, and no error analysis has to be believed.

use crate::interval::{Interval, point};

/// Jacobians are in units of 2 to minus this.
pub const J_BITS: i32 = 40;
/// Y is in units of 2 to minus this.
const Y_BITS: i32 = 30;
/// A is in units of 2 to minus this.
const A_BITS: i32 = 24;
/// Entries of Y and J are smaller: they are floats too, and 2²⁰ products of two of them fit into
/// an `i128`.
pub const LIMIT: f64 = (1u64 << 53) as f64;
/// No row of |A| has a larger sum, 64: then all sums of products of two entries fit into an `i64`.
const A_LIMIT: i64 = 1 << (A_BITS + 6);
/// Vectors are taken to about so many bits.
const VECTOR_BITS: i32 = 50;

/// A square matrix with few entries: (row, entry) for each column.
pub type Columns = Vec<Vec<(usize, i64)>>;

/// Y: a square matrix, row by row.
pub struct Whole {
    n: usize,
    entries: Vec<i64>,
}

/// A with its norm, and those of what it approximates.
pub struct Moving {
    /// |A|.
    pub norm: Interval,
    /// |Y J₁ − A|.
    pub rest: Interval,
    /// |A² − Y J₂|.
    pub square: Interval,
    /// |Y J₂|.
    pub second: Interval,
}

/// 2 to a power between −1022 and 1023, exactly.
pub fn power(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// The interval of one number; everything where it is not finite, so that no test succeeds.
pub fn exact(x: f64) -> Interval {
    if x.is_finite() {
        point(x)
    } else {
        Interval::ENTIRE
    }
}

/// |x|, as an interval of one number or, where that is infinite, of all.
pub fn size(x: Interval) -> Interval {
    exact(x.mag())
}

/// x in units of 2⁻⁴⁰, rounded, and a bound on the rest. `None`: too large.
pub fn split(x: Interval) -> Option<(i64, Interval)> {
    let whole = (x.mid() * power(J_BITS)).round();
    let fits = whole.abs() < LIMIT;
    fits.then(|| (whole as i64, size(x - point(whole * power(-J_BITS)))))
}

/// At least x 2^−bits: the conversion rounds to nearest, and one step up covers it.
pub fn above(x: u128, bits: i32) -> Interval {
    exact(((x as f64).next_up() * power(-bits)).next_up())
}

/// At least the largest sum of a row's sizes, for n × n entries in units of 2^−`bits`.
///
/// Nothing overflows, whatever is in the file. Entries of A fit into an `i32`; all others are below
/// 2¹²⁷, as they fit into an `i128`, and below 2¹¹¹ without their last 16 of 70 bits, so that rows of fewer
/// than 2¹⁶ of them do not reach 2¹²⁸. What is dropped is less than the one that is added.
fn norm(n: usize, bits: i32, entries: impl Iterator<Item = i128>) -> Interval {
    let dropped = if bits == A_BITS { 0 } else { 16 };
    let mut sums = vec![0u128; n];
    for (k, entry) in entries.enumerate() {
        sums[k / n] += (entry.unsigned_abs() >> dropped) + 1;
    }
    above(sums.into_iter().max().unwrap_or(0), bits - dropped)
}

impl Whole {
    /// The matrix nearest to one of floats.
    pub fn nearest(n: usize, floats: &[f64]) -> Option<Self> {
        let entries = floats.iter().map(|&x| {
            let whole = (x * power(Y_BITS)).round();
            (whole.abs() < LIMIT).then_some(whole as i64)
        });
        let entries = entries.collect::<Option<Vec<_>>>()?;
        Some(Whole { n, entries })
    }

    /// The last column, as exact numbers.
    pub fn last_column(&self) -> Vec<Interval> {
        let rows = self.entries.chunks(self.n);
        rows.map(|row| point(row[self.n - 1] as f64 * power(-Y_BITS)))
            .collect()
    }

    /// Y J in units of 2⁻⁷⁰.
    fn times<'a>(&'a self, j: &'a Columns) -> impl Iterator<Item = i128> + 'a {
        let entry = |y: &[i64], column: &[(usize, i64)]| {
            let products = column
                .iter()
                .map(|&(e, x)| i128::from(y[e]) * i128::from(x));
            products.sum::<i128>()
        };
        let rows = self.entries.chunks(self.n);
        rows.flat_map(move |y| j.iter().map(move |column| entry(y, column)))
    }

    /// |I − Y J|.
    pub fn defect(&self, j: &Columns) -> Interval {
        let one = |k: usize| i128::from(k.is_multiple_of(self.n + 1)) << (Y_BITS + J_BITS);
        let entries = self.times(j).enumerate().map(|(k, x)| one(k) - x);
        norm(self.n, Y_BITS + J_BITS, entries)
    }

    /// A is Y J₁, rounded.
    pub fn moving(&self, j1: &Columns, j2: &Columns) -> Option<Moving> {
        const SHIFT: i32 = Y_BITS + J_BITS - A_BITS;
        const BITS: i32 = Y_BITS + J_BITS;
        let n = self.n;
        let product: Vec<i128> = self.times(j1).collect();
        let nearest = |&x: &i128| i32::try_from((x + (1 << (SHIFT - 1))) >> SHIFT).ok();
        let a = product.iter().map(nearest).collect::<Option<Vec<i32>>>()?;
        // Every partial sum is below 2³⁰ 2³¹: the row that multiplies is checked first, and the entries of
        // the others fit into an `i32`.
        let mut square = vec![0i64; n * n];
        for (row, out) in a.chunks(n).zip(square.chunks_mut(n)) {
            if row.iter().map(|&x| i64::from(x).abs()).sum::<i64>() > A_LIMIT {
                return None;
            }
            for (&x, row) in row.iter().zip(a.chunks(n)) {
                for (out, &y) in out.iter_mut().zip(row) {
                    *out += i64::from(x) * i64::from(y);
                }
            }
        }
        let second: Vec<i128> = self.times(j2).collect();
        let rests = product
            .iter()
            .zip(&a)
            .map(|(x, &a)| x - (i128::from(a) << SHIFT));
        let squares = square.iter().zip(&second);
        let squares = squares.map(|(&x, y)| (i128::from(x) << (BITS - 2 * A_BITS)) - y);
        Some(Moving {
            norm: norm(n, A_BITS, a.iter().map(|&a| a.into())),
            rest: norm(n, BITS, rests),
            square: norm(n, BITS, squares),
            second: norm(n, BITS, second.iter().copied()),
        })
    }

    /// At least |Y v|, the largest entry, for every v in a box.
    pub fn image(&self, v: &[Interval]) -> Interval {
        let largest = v.iter().fold(0.0f64, |max, x| max.max(x.mag()));
        if !v.iter().all(|x| x.mag() <= 1e60) {
            return Interval::ENTIRE;
        }
        let bits = VECTOR_BITS - largest.max(1e-200).log2().ceil() as i32;
        // Scaling by a power of two is exact, or below the smallest normal number, where the
        // step to the neighbour covers it.
        let scaled = |x: f64| x * power(bits);
        let split = v.iter().map(|x| {
            let low = scaled(x.inf()).next_down().floor() as i64;
            let high = scaled(x.sup()).next_up().ceil() as i64;
            let middle = (low + high) / 2;
            (middle, (high - middle).max(middle - low))
        });
        let split: Vec<(i64, i64)> = split.collect();
        let sums = self.entries.chunks(self.n).map(|row| {
            let (mut middle, mut radius) = (0i128, 0i128);
            for (&y, &(x, r)) in row.iter().zip(&split) {
                middle += i128::from(y) * i128::from(x);
                radius += i128::from(y.abs()) * i128::from(r);
            }
            middle.unsigned_abs() + radius.unsigned_abs()
        });
        above(sums.max().unwrap_or(0), Y_BITS + bits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::iter::repeat_n;

    /// A row of the largest entries there are, in the largest problem: with overflow checks on, as tests have.
    #[test]
    fn norms_of_extreme_matrices_are_bounds() {
        let n = crate::certificate::format::MAX_FREE_COORDINATES + 1;
        for entry in [i128::MIN, i128::MAX] {
            let bound = norm(n, Y_BITS + J_BITS, repeat_n(entry, n)).sup();
            let exact = n as f64 * power(127 - Y_BITS - J_BITS);
            assert!((exact..1.001 * exact).contains(&bound), "{bound:e}");
        }
        let bound = norm(n, A_BITS, repeat_n(i32::MIN.into(), n)).sup();
        let exact = n as f64 * power(31 - A_BITS);
        assert!((exact..1.001 * exact).contains(&bound), "{bound:e}");
    }

    /// The sum of the second row's sizes, 3 · 2⁴⁰ + 2, in units of 2⁻⁷⁰, and 7 in units of 2⁻²⁴.
    #[test]
    fn norms_are_those_of_the_largest_row() {
        let large = 1i128 << 40;
        let bound = norm(2, 70, [1, -1, 1 - 2 * large, large + 1].into_iter());
        let exact = (3 * large) as f64 * power(-70);
        assert!(exact < bound.inf() && bound.sup() < 1.001 * exact);
        let bound = norm(2, A_BITS, [1, -1, -3, 4].into_iter()).sup();
        assert!((7.0 * power(-24)..=10.0 * power(-24)).contains(&bound));
    }
}
