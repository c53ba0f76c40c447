//! Matrices of whole numbers: products without any rounding.
//!
//! A Krawczyk test may use any matrices for Y and A, so the checker takes multiples of powers of
//! two. The Jacobian is such a multiple and a rest, which is bounded. Then I − Y J₀, A² − Y J₂ and
//! the like are *exact* in integers, and no error analysis has to be believed.

use crate::interval::{Interval, point};
use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};

/// Jacobians, whose rows are scaled so that entries are about 1, are in units of 2 to minus this.
pub const J_BITS: i32 = 44;
/// Y is in units of 2 to minus some number between these.
const Y_BITS: [i32; 2] = [8, 60];
/// A is in units of 2 to minus some number between these.
const A_BITS: [i32; 2] = [16, 24];
/// Entries of Y and J are smaller: they are floats too, and 2²⁰ products of two of them fit into
/// an `i128`.
pub const LIMIT: f64 = (1u64 << 53) as f64;
/// A square matrix with few entries: (row, entry) for each column.
pub type Columns = Vec<Vec<(usize, i64)>>;

/// Y: a square matrix, row by row, in units of 2^−bits. It is multiplied with values of equations that are
/// divided by powers of two, those to the exponents in `scale`.
pub struct Whole {
    n: usize,
    bits: i32,
    scale: Vec<i32>,
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

/// x in units of 2⁻⁴⁴, rounded, and a bound on the rest. `None`: too large.
pub fn split(x: Interval) -> Option<(i64, Interval)> {
    let whole = (x.mid() * power(J_BITS)).round();
    let fits = whole.abs() < LIMIT;
    fits.then(|| (whole as i64, size(x - point(whole * power(-J_BITS)))))
}

/// From a to b; everything where that is no interval.
pub fn between(a: f64, b: f64) -> Interval {
    crate::interval::checked(a, b).unwrap_or(Interval::ENTIRE)
}

/// At least x 2^−bits: the conversion rounds to nearest, and one step up covers it.
pub fn above(x: u128, bits: i32) -> Interval {
    exact(((x as f64).next_up() * power(-bits)).next_up())
}

/// At least the largest sum of a row's sizes, for n × n entries in units of 2^−`bits`.
///
/// Nothing overflows, whatever is in the file: entries are below 2¹²⁷, as they fit into an `i128`, and below 2¹¹¹ without
/// their last 16 bits, so that rows of fewer than 2¹⁶ of them do not reach 2¹²⁸. What is dropped is less than the one
/// that is added.
fn norm(n: usize, bits: i32, entries: impl Iterator<Item = i128>) -> Interval {
    let mut sums = vec![0u128; n];
    for (k, entry) in entries.enumerate() {
        sums[k / n] += (entry.unsigned_abs() >> 16) + 1;
    }
    above(sums.into_iter().max().unwrap_or(0), bits - 16)
}

impl Whole {
    /// The matrix nearest to one of floats, in units in which its largest entry has 52 bits.
    pub fn nearest(floats: &[f64], scale: &[i32]) -> Option<Self> {
        let largest = floats.iter().fold(0.0f64, |max, x| max.max(x.abs()));
        let bits = 51 - largest.clamp(1e-9, 1e18).log2().ceil() as i32;
        let bits = bits.clamp(Y_BITS[0], Y_BITS[1]);
        let entries = floats.iter().map(|&x| {
            let whole = (x * power(bits)).round();
            (whole.abs() < LIMIT).then_some(whole as i64)
        });
        let entries = entries.collect::<Option<Vec<_>>>()?;
        let (n, scale) = (scale.len(), scale.to_vec());
        Some(Whole {
            n,
            bits,
            scale,
            entries,
        })
    }

    /// The units of Y J are 2 to minus this.
    fn product_bits(&self) -> i32 {
        self.bits + J_BITS
    }

    /// Y J.
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
        let bits = self.product_bits();
        let one = |k: usize| i128::from(k.is_multiple_of(self.n + 1)) << bits;
        let entries = self.times(j).enumerate().map(|(k, x)| one(k) - x);
        norm(self.n, bits, entries)
    }

    /// A is Y J₁, rounded.
    pub fn moving(&self, j1: &Columns, j2: &Columns) -> Option<Moving> {
        let (n, bits) = (self.n, self.product_bits());
        let product: Vec<i128> = self.times(j1).collect();
        // Sums of sizes in rows of Y J₁ are below 2^(25 − b), however the logarithm is rounded, so that in units of 2^−b those
        // of A's entries are below 2²⁵ + n/2 < 2²⁶. Then all sums of products of entries in a row and a column
        // are whole numbers below 2⁵², in any order: floats are exact, fused or not.
        let largest = norm(n, bits, product.iter().copied()).sup();
        let b = (25 - largest.max(1.0).log2().ceil() as i32 - 1).min(A_BITS[1]);
        if b < A_BITS[0] {
            return None;
        }
        let shift = bits - b;
        let nearest = |x: &i128| ((x + (1 << (shift - 1))) >> shift) as f64;
        let a: Vec<f64> = product.iter().map(nearest).collect();
        let mut square = vec![0.0; n * n];
        // Row by row as column by column: of the transposed matrices, whose product is the square's.
        let factor = MatRef::from_column_major_slice(&a, n, n);
        let out = MatMut::from_column_major_slice_mut(&mut square, n, n);
        matmul(out, Accum::Replace, factor, factor, 1.0, Par::Seq);
        let second: Vec<i128> = self.times(j2).collect();
        let again = |a: &f64| i128::from(*a as i64) << shift;
        let squares = square.iter().zip(&second);
        let squares = squares.map(|(&x, y)| (i128::from(x as i64) << (bits - 2 * b)) - y);
        Some(Moving {
            norm: norm(n, bits, a.iter().map(again)),
            rest: norm(n, bits, product.iter().zip(&a).map(|(x, a)| x - again(a))),
            square: norm(n, bits, squares),
            second: norm(n, bits, second.iter().copied()),
        })
    }

    /// |Y v|, the largest size of an entry: no less than the lower end for any v in a box, and no more
    /// than the upper end. In floats: of fewer than 4 n roundings each is at most 2⁻⁵² of Σ |Y| |v|.
    pub fn image(&self, v: &[Interval]) -> Interval {
        let split = v.iter().zip(&self.scale).map(|(x, &e)| {
            // Scaling is exact, or below the smallest normal number, where the step to the neighbour covers it.
            let [low, high] = [x.inf(), x.sup()].map(|x| x * power(-e));
            let middle = 0.5 * (low + high);
            let radius = (high - middle).max(middle - low);
            (middle, radius.next_up())
        });
        let split: Vec<(f64, f64)> = split.collect();
        if !split.iter().all(|(x, r)| x.abs() < 1e60 && *r < 1e60) {
            return between(0.0, f64::INFINITY);
        }
        let (mut least, mut most) = (0.0f64, 0.0f64);
        let share = 4.0 * self.n as f64 * power(-52);
        for row in self.entries.chunks(self.n) {
            let (mut sum, mut size, mut radius) = (0.0, 0.0, 0.0);
            for (&y, &(x, r)) in row.iter().zip(&split) {
                let y = y as f64;
                sum += y * x;
                size += y.abs() * x.abs();
                radius += y.abs() * r;
            }
            let error = (size + radius) * share + radius;
            least = least.max(sum.abs() - error);
            most = most.max(sum.abs() + error);
        }
        // A sum and a scaling more.
        let unit = power(-self.bits);
        between(
            least * unit * (1.0 - power(-50)),
            (most * unit * (1.0 + power(-50))).next_up(),
        )
    }

    /// At least |Y v|, for every v whose entries are no larger than the upper ends of these.
    pub fn bound(&self, v: &[Interval]) -> Interval {
        let sizes: Vec<Interval> = v.iter().map(|x| between(-x.sup(), x.sup())).collect();
        exact(self.image(&sizes).sup())
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
            let bound = norm(n, 70, repeat_n(entry, n)).sup();
            let exact = n as f64 * power(127 - 70);
            assert!((exact..1.001 * exact).contains(&bound), "{bound:e}");
        }
    }

    /// With entries as large as they may be, and where the unit has to be coarser for that.
    #[test]
    fn squares_are_exact() {
        let n = 70;
        let entries = |seed: i64, bits: u32| -> Vec<i64> {
            let mut x = seed;
            let mut next = || {
                x = x
                    .wrapping_mul(6364136223846793005)
                    .wrapping_add(1442695040888963407);
                (x >> 11) >> (53 - bits)
            };
            (0..n * n).map(|_| next()).collect()
        };
        for size in [1.0, 30.0, 200.0] {
            // Y is a diagonal matrix nearly, J₁ and J₂ are full.
            let mut floats = vec![1e-3; n * n];
            (0..n).for_each(|i| floats[i * n + i] = 1.0 - 0.01 * i as f64);
            let y = Whole::nearest(&floats, &vec![0; n]).unwrap();
            let columns = |seed| -> Columns {
                let all = entries(seed, 40);
                let scale = size / n as f64 * 32.0;
                let column = |k: usize| {
                    let entry = |e: usize| (e, (all[k * n + e] as f64 * scale) as i64);
                    (0..n).map(entry).collect()
                };
                (0..n).map(column).collect()
            };
            let (j1, j2) = (columns(1), columns(2));
            let Some(moving) = y.moving(&j1, &j2) else {
                panic!("{size} is no reason to give up");
            };
            // The square of Y J₁ with all of its digits but sixty, in an i128.
            let product: Vec<i128> = y.times(&j1).map(|x| x >> (y.product_bits() - 40)).collect();
            let second: Vec<i128> = y.times(&j2).map(|x| x >> (y.product_bits() - 40)).collect();
            let row = |i: usize| -> f64 {
                let entry = |j: usize| {
                    let terms = (0..n).map(|k| product[i * n + k] * product[k * n + j]);
                    let sum = terms.sum::<i128>() >> 40;
                    (sum - second[i * n + j]).unsigned_abs() as f64 * power(-40)
                };
                (0..n).map(entry).sum()
            };
            let exact = (0..n).map(row).fold(0.0, f64::max);
            let norm = moving.norm.sup();
            let error = 2.0 * norm * moving.rest.sup() + n as f64 * norm * 1e-10;
            assert!(
                (moving.square.sup() - exact).abs() <= error,
                "{size}: {exact} {error}"
            );
            assert!(error < 1e-2 * exact, "{size}: {error}");
        }
    }

    /// The sum of the second row's sizes, 3 · 2⁴⁰ + 2, in units of 2⁻⁷⁰.
    #[test]
    fn norms_are_those_of_the_largest_row() {
        let large = 1i128 << 40;
        let bound = norm(2, 70, [1, -1, 1 - 2 * large, large + 1].into_iter());
        let exact = (3 * large) as f64 * power(-70);
        assert!(exact < bound.inf() && bound.sup() < 1.001 * exact);
    }
}
