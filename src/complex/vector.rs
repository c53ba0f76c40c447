//! Vectors of three complex numbers in double-doubles.

use crate::interval::DoubleDouble;
use crate::interval::complex::Complex;
use crate::places::array;

/// A complex number in double-doubles.
pub type Z = Complex<DoubleDouble>;

/// a · b, without conjugation.
pub fn dot(a: &[Z; 3], b: &[Z; 3]) -> Z {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b.
pub fn cross(a: &[Z; 3], b: &[Z; 3]) -> [Z; 3] {
    let part = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [part(1, 2), part(2, 0), part(0, 1)]
}

/// a + factor b.
pub fn plus(a: &[Z; 3], factor: Z, b: &[Z; 3]) -> [Z; 3] {
    array(|k| a[k] + factor * b[k])
}
