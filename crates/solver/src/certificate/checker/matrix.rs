//! Products with matrices of floats, and bounds on what they may have rounded away.
//!
//! A Krawczyk test may use any matrices for Y and A, so those are what floats say they are. What products with
//! them lose is bounded a priori: a sum of k products, added in any order, fused or not, is off by at most
//! γ_k Σ |x y| (Higham, *Accuracy and Stability of Numerical Algorithms*, section 3.1). Results below the smallest
//! normal number may lose 2⁻¹⁰⁷⁵ each, and all of these together less than `UNDERFLOW`, which every bound here is larger
//! by. What overflows becomes infinite or no number, and so do the bounds, with which no test succeeds.

use crate::interval::Interval;
use crate::interval::rounding::{gamma, largest, round_up};

/// A matrix with few entries: (row, entry) for each column. A row may occur again: such entries are added.
pub type Columns = Vec<Vec<(usize, f64)>>;

/// A square matrix, column by column.
#[derive(Debug)]
pub struct Matrix {
    pub n: usize,
    pub entries: Vec<f64>,
}

/// 2 to a power between −1022 and 1023, exactly.
pub fn power(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// The interval of one number; everything where it is not finite, so that no test succeeds.
pub fn exact(x: f64) -> Interval {
    between(x, x)
}

/// |x|, as an interval of one number or, where that is infinite, of all.
pub fn size(x: Interval) -> Interval {
    exact(x.mag())
}

/// From a to b; everything where that is no interval.
pub fn between(a: f64, b: f64) -> Interval {
    crate::interval::checked(a, b).unwrap_or(Interval::ENTIRE)
}

/// At least what a sum has lost of which each term went through no more than so many roundings, from the sum of its terms'
/// sizes, where terms may be off by `errors` besides.
pub fn lost(sizes: f64, roundings: usize, errors: f64) -> f64 {
    round_up(gamma(roundings) * sizes + errors, roundings + 2)
}

/// A number in the middle of an interval, and at least how far the others are from it.
pub fn halves(x: Interval) -> (f64, f64) {
    let middle = 0.5 * (x.inf() + x.sup());
    let radius = (x.sup() - middle).max(middle - x.inf());
    // A step up covers the rounding of a difference, of which none is 0 by rounding.
    (middle, if radius == 0.0 { 0.0 } else { radius.next_up() })
}

/// The component of a vector along another one.
pub fn along(direction: &[f64], normal: &[f64]) -> Interval {
    let products = direction.iter().zip(normal).map(|(x, c)| x * c);
    let sums = products.fold((0.0, 0.0), |(sum, sizes), x| (sum + x, sizes + x.abs()));
    enclosed(sums.0, lost(sums.1, normal.len() + 1, 0.0))
}

/// Everything that is no further from a number than this.
pub fn enclosed(value: f64, error: f64) -> Interval {
    between((value - error).next_down(), (value + error).next_up())
}

/// Adds a term for each entry of a column to sums: four at a time, as processors do.
pub fn add(sums: &mut [f64], column: &[f64], term: impl Fn(f64) -> f64) {
    let ((sums, last_sums), (column, last)) = (sums.as_chunks_mut::<4>(), column.as_chunks::<4>());
    for (sums, column) in sums.iter_mut().zip(column) {
        (0..4).for_each(|k| sums[k] += term(column[k]));
    }
    let both = last_sums.iter_mut().zip(last);
    both.for_each(|(sum, &x)| *sum += term(x));
}

impl Matrix {
    /// This matrix times one with few entries. Each of the products' entries went through no more roundings than its column
    /// of the other has entries, and one.
    pub fn times(&self, other: &Columns) -> Matrix {
        let (n, mut entries) = (self.n, vec![0.0; self.n * self.n]);
        for (sums, column) in entries.chunks_mut(n).zip(other) {
            self.add_image(sums, column);
        }
        Matrix { n, entries }
    }

    /// Adds this matrix times a column with few entries.
    fn add_image(&self, sums: &mut [f64], column: &[(usize, f64)]) {
        for &(e, x) in column {
            let at = e * self.n;
            add(sums, &self.entries[at..at + self.n], |y| y * x);
        }
    }

    /// At least the norm of this matrix times one with few entries, less so many times the identity, as `times` and a
    /// rounding on the diagonal leave it.
    pub fn norm_of_product(&self, other: &Columns, less: f64) -> Interval {
        let (mut column, mut sums) = (vec![0.0; self.n], vec![0.0; self.n]);
        for (i, entries) in other.iter().enumerate() {
            column.fill(0.0);
            self.add_image(&mut column, entries);
            column[i] -= less;
            add(&mut sums, &column, f64::abs);
        }
        self.largest_of(sums)
    }

    /// At least the largest of these sums of n non-negative products, also where each factor lacks a rounding.
    fn largest_of(&self, sums: Vec<f64>) -> Interval {
        let most = sums.into_iter().fold(0.0, largest);
        exact(round_up(most, self.n + 2))
    }

    /// At least |A² − B|: of n products and an entry of B, summed one after the other, each goes through n + 1
    /// roundings at most.
    pub fn square_distance(&self, other: &Matrix) -> Interval {
        let (n, norm) = (self.n, self.norm());
        let mut entries: Vec<f64> = other.entries.iter().map(|x| -x).collect();
        for (sums, column) in entries.chunks_mut(n).zip(self.entries.chunks(n)) {
            for (factor, &x) in self.entries.chunks(n).zip(column) {
                add(sums, factor, |y| y * x);
            }
        }
        Matrix { n, entries }.norm() + exact(gamma(n + 1)) * (norm * norm + other.norm())
    }

    /// At least the norm, the largest sum of a row's sizes, also where each entry lacks a rounding.
    pub fn norm(&self) -> Interval {
        self.bound(&vec![1.0; self.n])
    }

    /// At least |Y v|, also where each entry of Y lacks a rounding, for every v whose entries are no larger than these.
    pub fn bound(&self, v: &[f64]) -> Interval {
        let mut sums = vec![0.0; self.n];
        for (column, v) in self.entries.chunks(self.n).zip(v) {
            add(&mut sums, column, |y| y.abs() * v);
        }
        self.largest_of(sums)
    }

    /// |Y v|, the largest size of an entry: no less than the lower end for any v in a box, and no more than the upper
    /// end.
    pub fn image(&self, v: &[Interval]) -> Interval {
        let (n, mut sums, mut errors) = (self.n, vec![0.0; self.n], vec![0.0; self.n]);
        for (column, v) in self.entries.chunks(n).zip(v) {
            let (middle, radius) = halves(*v);
            let error = lost(middle.abs(), n + 1, radius);
            add(&mut sums, column, |y| y * middle);
            add(&mut errors, column, |y| y.abs() * error);
        }
        let (mut least, mut most) = (0.0f64, 0.0f64);
        for (sum, error) in sums.iter().zip(errors) {
            let error = round_up(error, n + 1);
            least = least.max((sum.abs() - error).next_down());
            most = largest(most, (sum.abs() + error).next_up());
        }
        between(least, most)
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::rational::Rational;
    pub use crate::rational::exact as ratio;
    use proptest::prelude::*;

    /// Floats of any size up to 1e60, subnormal ones and zero.
    fn any_float() -> impl Strategy<Value = f64> {
        let scaled = (-1.0f64..1.0, -190i32..190).prop_map(|(x, e)| x * power(e));
        prop_oneof![4 => -1.0f64..1.0, 4 => scaled, 1 => Just(0.0), 1 => (1u64..1 << 52).prop_map(f64::from_bits)]
    }

    pub fn matrix(n: usize) -> impl Strategy<Value = Matrix> {
        let entries = prop::collection::vec(any_float(), n * n);
        entries.prop_map(move |entries| Matrix { n, entries })
    }

    pub fn at(matrix: &Matrix, i: usize, j: usize) -> Rational {
        ratio(matrix.entries[j * matrix.n + i])
    }

    /// The largest sum of a row's sizes.
    pub fn norm(n: usize, entry: impl Fn(usize, usize) -> Rational) -> Rational {
        let row = |i: usize| {
            (0..n)
                .map(|j| entry(i, j).abs())
                .fold(Rational::zero(), |a, b| a + b)
        };
        (0..n).map(row).max().unwrap()
    }

    pub fn sum(terms: impl Iterator<Item = Rational>) -> Rational {
        terms.fold(Rational::zero(), |a, b| a + b)
    }

    pub const N: usize = 5;

    proptest! {
        #[test]
        fn images_hold_exact_ones(y in matrix(N), v in prop::collection::vec((any_float(), any_float()), N)) {
            let boxes: Vec<Interval> = v.iter().map(|&(a, b)| between(a.min(b), a.max(b))).collect();
            let image = y.image(&boxes);
            // Any corner of the box.
            for corner in 0..1 << N {
                let of = |e: usize| ratio(if corner >> e & 1 == 0 { v[e].0 } else { v[e].1 });
                let entry = |i: usize| sum((0..N).map(|e| at(&y, i, e) * of(e))).abs();
                let largest = (0..N).map(entry).max().unwrap();
                prop_assert!(ratio(image.inf()) <= largest && largest <= ratio(image.sup()));
            }
            let sizes: Vec<f64> = boxes.iter().map(|v| v.mag()).collect();
            let entry = |i: usize| sum((0..N).map(|e| at(&y, i, e).abs() * ratio(sizes[e])));
            let most = (0..N).map(entry).max().unwrap();
            let bound = ratio(y.bound(&sizes).sup());
            prop_assert!(most <= bound && bound <= most * ratio(1.0 + 1e-14) + ratio(1e-229));
        }

        /// |I − Y J| with all that was rounded away.
        #[test]
        fn norms_hold_exact_ones(y in matrix(N), j in matrix(N), twice in 0..N * N) {
            // One entry in two parts.
            let mut columns: Columns = j.entries.chunks(N).map(|c| c.iter().copied().enumerate().collect()).collect();
            let (i, e) = (twice / N, twice % N);
            let x = columns[i][e].1;
            columns[i][e].1 = 0.75 * x;
            columns[i].push((e, 0.25 * x));
            let j = |e: usize, i: usize| sum(columns[i].iter().filter(|x| x.0 == e).map(|x| ratio(x.1)));
            let one = |i: usize, k: usize| ratio(f64::from(u8::from(i == k)));
            let product = |i: usize, k: usize| sum((0..N).map(|e| at(&y, i, e) * j(e, k)));
            let sizes: Vec<f64> = (0..N)
                .map(|e| columns.iter().flatten().filter(|x| x.0 == e).map(|x| gamma(N + 2) * x.1.abs()).sum())
                .map(|size: f64| round_up(size, 2 * N))
                .collect();
            let found = y.norm_of_product(&columns, 1.0) + y.bound(&sizes);
            prop_assert!(norm(N, |i, k| one(i, k) - product(i, k)) <= ratio(found.sup()));

            let rounded = y.times(&columns);
            let lost = norm(N, |i, k| at(&rounded, i, k) - product(i, k));
            prop_assert!(lost <= ratio(y.bound(&sizes).sup()) + ratio(1e-300));
        }

        #[test]
        fn middles_and_radii_hold_intervals(x in any_float(), y in any_float()) {
            let (middle, radius) = halves(between(x.min(y), x.max(y)));
            let far = |x: f64| (ratio(x) - ratio(middle)).abs() <= ratio(radius);
            prop_assert!(far(x) && far(y));
        }

        #[test]
        fn sums_are_enclosed(terms in prop::collection::vec((any_float(), any_float()), 1..20)) {
            let (value, sizes) = terms.iter().fold((0.0, 0.0), |(sum, sizes), (x, y)| (sum + x * y, sizes + (x * y).abs()));
            let whole = sum(terms.iter().map(|&(x, y)| ratio(x) * ratio(y)));
            let enclosed = enclosed(value, lost(sizes, terms.len() + 1, 0.0));
            prop_assert!(ratio(enclosed.inf()) <= whole && whole <= ratio(enclosed.sup()));
        }
    }

    /// n products that are each too small to change the 1 that their sum begins with.
    #[test]
    fn squares_beside_large_entries_hold_exact_ones() {
        for n in [2, 7, 32, 95] {
            let e = (0.4995 * f64::EPSILON).sqrt();
            let mut a = vec![0.0; n * n];
            for i in 0..n {
                (a[i], a[i * n]) = (e, e);
            }
            let mut b = vec![0.0; n * n];
            b[0] = -1.0;
            let matrix = |entries| Matrix { n, entries };
            let found = matrix(a).square_distance(&matrix(b)).sup();
            // The first row of A² − B: n e² + 1, and e² in all other places.
            let square = ratio(e) * ratio(e);
            let whole = ratio(1.0) + square * ratio((2 * n - 1) as f64);
            assert!(whole <= ratio(found), "{n}");
        }
    }

    /// Not even those that a maximum leaves out.
    #[test]
    fn nothing_that_overflows_passes() {
        for bad in [f64::NAN, f64::INFINITY, 1e300] {
            let y = Matrix {
                n: 2,
                entries: vec![1.0, bad, 0.0, 1.0],
            };
            let j: Columns = vec![vec![(0, 1.0), (1, 1e300)], vec![(0, bad), (1, 1.0)]];
            let passes = |x: Interval| x.sup() < 1e299;
            assert!(!passes(y.norm()) && !passes(y.bound(&[1.0, 0.0])));
            assert!(
                !passes(y.image(&[point(1.0), ZERO]))
                    && !passes(y.image(&[Interval::ENTIRE, ZERO]))
            );
            assert!(!passes(y.norm_of_product(&j, 1.0)) && !passes(y.norm_of_product(&j, 0.0)));
            assert!(!passes(enclosed(bad, lost(bad.abs(), 3, 0.0))));
        }
    }

    use crate::interval::{ZERO, point};
}
