//! What bounds the inverse of one diagonal block of A(s) X.

use crate::interval::rounding::round_up;

/// How much more: far above rounding where R is not larger than this.
const MORE: f64 = 1e-9;
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
    let minor = |r: usize, c: usize| {
        let (r1, r2, c1, c2) = ((r + 1) % 3, (r + 2) % 3, (c + 1) % 3, (c + 2) % 3);
        a[r1][c1] * a[r2][c2] - a[r1][c2] * a[r2][c1]
    };
    let scale = 1.0 / (0..3).map(|c| a[0][c] * minor(0, c)).sum::<f64>();
    let mut bound = [[0.0; 3]; 3];
    let mut sums = [0.0; 3];
    for r in 0..3 {
        for c in 0..3 {
            bound[r][c] = minor(c, r) * scale;
            sums[r] += bound[r][c];
        }
    }
    // A little more than the inverse: with x = (I − B)⁻¹ 1, x − B x = 1.
    for r in 0..3 {
        for c in 0..3 {
            bound[r][c] += MORE * (bound[r][c] + sums[r]);
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
