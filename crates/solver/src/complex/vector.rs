//! Vectors of three complex numbers in double-doubles; products are without conjugation.

use crate::interval::DoubleDouble;
use crate::interval::complex::Complex;
pub use crate::interval::vector::{cross, dot, minus};
use crate::places::array;

/// A complex number in double-doubles.
pub type Z = Complex<DoubleDouble>;

/// a + factor b.
pub fn plus(a: &[Z; 3], factor: Z, b: &[Z; 3]) -> [Z; 3] {
    array(|k| a[k] + factor * b[k])
}
