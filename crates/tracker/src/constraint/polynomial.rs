//! Right-hand sides: polynomials in t with exact coefficients, of t⁰ first.

use crate::interval::Real;

/// A polynomial in t.
pub type Polynomial = Vec<Real>;

/// From `start` at t = 0 to `end` at t = 1, linearly.
pub fn ramp(start: Real, end: Real) -> Polynomial {
    if start == end {
        return vec![start];
    }
    let change = &end - &start;
    vec![start, change]
}

/// The product of two polynomials.
pub fn multiply(a: &[Real], b: &[Real]) -> Polynomial {
    let mut out = vec![Real::zero(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            out[i + j] = &out[i + j] + &(x * y);
        }
    }
    out
}

/// The sum of two polynomials.
pub fn add(a: &[Real], b: &[Real]) -> Polynomial {
    let (long, short) = if a.len() < b.len() { (b, a) } else { (a, b) };
    let mut out = long.to_vec();
    for (x, y) in out.iter_mut().zip(short) {
        *x = &*x + y;
    }
    out
}
