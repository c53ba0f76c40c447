//! What bounds the inverse of one diagonal block of A(s) X.

use crate::interval::rounding::round_up;
use crate::track::reduced::structure::passes::by_adjugate;

/// R is made larger by this factor than I + B R asks for: far above rounding where R is at most [`LARGEST`].
const MORE: f64 = 1e-9;
/// A larger R is of no use.
const LARGEST: f64 = 1e4;

/// R ≥ (I − B)⁻¹ for B ≥ 0 of the given size: R ≥ I + B R, verified. `None`: there is none, or it
/// is of no use.
pub fn bound_on_inverse(b: &[[f64; 3]; 3], size: usize) -> Option<[[f64; 3]; 3]> {
    // I − B, completed by the identity.
    let mut a = [[0.0; 3]; 3];
    for r in 0..3 {
        for c in 0..3 {
            let entry = if r < size && c < size { b[r][c] } else { 0.0 };
            a[r][c] = if r == c { 1.0 - entry } else { -entry };
        }
    }
    let mut bound = by_adjugate(&a);
    // A little more than the inverse: with x = (I − B)⁻¹ 1, x − B x = 1.
    for row in &mut bound {
        let sum: f64 = row.iter().sum();
        for entry in row {
            *entry += MORE * (*entry + sum);
        }
    }
    let mut holds = true;
    for r in 0..size {
        for c in 0..size {
            let one = if r == c { 1.0 } else { 0.0 };
            let sum: f64 = (0..size).map(|k| b[r][k] * bound[k][c]).sum();
            let x = bound[r][c];
            holds &= (0.0..LARGEST).contains(&x) && round_up(one + sum, 8) <= x;
        }
    }
    holds.then_some(bound)
}
