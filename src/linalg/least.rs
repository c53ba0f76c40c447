//! Newton's method for equations that may depend on each other, in floats.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// (JᵀJ + ε)⁻¹, for the steps of Levenberg and Marquardt. `None`: J is not finite, or ε is below rounding.
pub fn damped(j: &DMatrix<f64>, epsilon: f64) -> Option<Cholesky<f64, Dyn>> {
    let mut normal = j.tr_mul(j);
    for k in 0..j.ncols() {
        normal[(k, k)] += epsilon;
    }
    normal.cholesky()
}

/// A zero near a point, by at most 60 of Gauss and Newton's steps, which change least: singular values up to `zero` count as
/// zero. `linearise`: the Jacobian and the values at a point. `None`: there is none, or it is far away.
pub fn nearest_zero(
    mut x: Vec<f64>,
    zero: f64,
    linearise: impl Fn(&[f64]) -> (DMatrix<f64>, DVector<f64>),
) -> Option<Vec<f64>> {
    const STEPS: usize = 60;
    const FAR: f64 = 1e3;
    for _ in 0..STEPS {
        let (jacobian, off) = linearise(&x);
        let size = x.iter().fold(1.0, |max: f64, x| max.max(x.abs()));
        if off.amax() < 1e-13 * size {
            return Some(x);
        }
        // Of others there is no decomposition.
        if !jacobian.iter().chain(&off).all(|x| x.is_finite()) {
            return None;
        }
        let step = jacobian.svd(true, true).solve(&off, zero).ok()?;
        x.iter_mut().zip(step.iter()).for_each(|(x, s)| *x -= s);
        if !x.iter().all(|x| x.abs() <= FAR * size) {
            return None;
        }
    }
    None
}
