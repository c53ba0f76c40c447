//! A-priori bounds on what floating-point arithmetic may have rounded away.
//!
//! Notation of Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., chapter 3:
//! `u` is the unit roundoff and `γ_n = n u / (1 - n u)`.

/// The unit roundoff u = 2⁻⁵³ of rounding to nearest: every operation whose result is neither
/// subnormal nor infinite has a relative error of at most u (Higham, (2.4)).
pub const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// At least `γ_n = n u / (1 - n u)`, for n ≤ 2³⁰.
///
/// A sum of n products, added in any order, fused or not, differs from the exact one by at most
/// `γ_n Σ |x_i y_i|` (Higham, section 3.1). The value returned exceeds γ_n for every such n:
/// `n u` is exact, `1 / (1 - n u) < 1 + 2⁻²²`, and 1.0001 covers that and one rounding.
pub fn gamma(n: usize) -> f64 {
    debug_assert!(n <= 1 << 30);
    n as f64 * UNIT_ROUNDOFF * 1.0001
}

/// Rounds a computed sum of non-negative terms up, so that it bounds the exact sum.
///
/// `operations` counts the roundings that any one term went through (products, additions, and
/// those that came before). With `x` the exact sum and `x̂` the computed one, `x ≤ x̂ / (1 - γ_k)`
/// and `1 / (1 - γ_k) ≤ 1 + 1.001 γ_k` for `γ_k ≤ 10⁻³`; one more operation covers this product.
pub fn round_up(sum: f64, operations: usize) -> f64 {
    sum * (1.0 + 1.01 * gamma(operations + 2)) + UNDERFLOW
}

/// More than all that gradual underflow can have lost in one bound.
///
/// An operation with a subnormal result errs by at most 2⁻¹⁰⁷⁵ ≈ 2.5e-324. The kernels' inputs are
/// limited in size (see [`in_range`]), no bound is the result of more than 10¹⁰ operations, and
/// no factor that multiplies such a loss later exceeds 10⁷⁵.
pub const UNDERFLOW: f64 = 1e-230;

/// The larger of two numbers, or NaN if one of them is: a bound that could not be computed must not
/// be lost among those that could.
pub fn largest(max: f64, x: f64) -> f64 {
    if x > max || x.is_nan() { x } else { max }
}

/// The size of the largest of some numbers, or NaN if one of them is.
pub fn greatest(of: &[f64]) -> f64 {
    of.iter().fold(0.0, |max, x| largest(max, x.abs()))
}

/// Whether a number may enter the error analysis: finite and at most 1e75 in size.
pub fn in_range(x: f64) -> bool {
    x.abs() <= 1e75
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::enclose_rational;
    use crate::rational::{Rational, exact};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn sums_stay_within_gamma(terms in prop::collection::vec((-1e3f64..1e3, -1e3f64..1e3), 1..40)) {
            let (mut sum, mut size) = (0.0f64, 0.0f64);
            let (mut exact_sum, mut exact_size) = (Rational::zero(), Rational::zero());
            for &(x, y) in &terms {
                sum = x.mul_add(y, sum);
                size = x.abs().mul_add(y.abs(), size);
                exact_sum += exact(x) * exact(y);
                exact_size += exact(x.abs()) * exact(y.abs());
            }
            prop_assert!(exact(round_up(size, terms.len())) >= exact_size);
            let error = enclose_rational(&(exact_sum - exact(sum))).mag();
            prop_assert!(error <= gamma(terms.len()) * round_up(size, terms.len()));
        }
    }
}
