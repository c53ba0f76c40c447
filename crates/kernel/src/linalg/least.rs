//! Newton's method for equations that may depend on each other, in floats.
//!
//! Nothing here is generic, so that what it uses of nalgebra is built once, and not again in each package that calls it.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix3, SVD};

/// The Jacobian of equations at a point, and by how much each is not met there.
pub type Linear = (DMatrix<f64>, DVector<f64>);

/// So many equations in so many unknowns, where `each` tells the derivatives of one, those of an unknown to be added, and by how
/// much it is not met.
pub fn linearised(
    (rows, columns): (usize, usize),
    each: &dyn Fn(usize, &mut dyn FnMut(usize, f64)) -> f64,
) -> Linear {
    let (mut jacobian, mut off) = (DMatrix::zeros(rows, columns), DVector::zeros(rows));
    for row in 0..rows {
        off[row] = each(row, &mut |i, slope| jacobian[(row, i)] += slope);
    }
    (jacobian, off)
}

/// The same equations, the derivatives of each scaled to length 1.
pub fn scaled((mut jacobian, mut off): Linear) -> Linear {
    for (mut row, off) in jacobian.row_iter_mut().zip(&mut off) {
        let size = row.norm();
        if size > 0.0 {
            row.scale_mut(1.0 / size);
            *off /= size;
        }
    }
    (jacobian, off)
}

/// A matrix decomposed into singular values, with the vectors to the left and to the right if they are wanted.
pub fn decomposed(matrix: DMatrix<f64>, [left, right]: [bool; 2]) -> SVD<f64, Dyn, Dyn> {
    matrix.svd(left, right)
}

/// The shortest vector that a decomposed matrix takes as near to another as it can, singular values up to `zero` counting as
/// zero. `None`: the vectors to one side are not known.
pub fn shortest(
    matrix: &SVD<f64, Dyn, Dyn>,
    image: &DVector<f64>,
    zero: f64,
) -> Option<DVector<f64>> {
    matrix.solve(image, zero).ok()
}

/// The greatest coordinate of the vector that a symmetric matrix shortens most.
pub fn weakest(matrix: Matrix3<f64>) -> usize {
    let eigen = matrix.symmetric_eigen();
    let least = eigen.eigenvectors.column(eigen.eigenvalues.imin());
    least.iamax()
}

const STEPS: usize = 60;

/// (JᵀJ + ε)⁻¹, for the steps of Levenberg and Marquardt. `None`: J is not finite, or ε is below rounding.
pub fn damped(j: &DMatrix<f64>, epsilon: f64) -> Option<Cholesky<f64, Dyn>> {
    let mut normal = j.tr_mul(j);
    for k in 0..j.ncols() {
        normal[(k, k)] += epsilon;
    }
    normal.cholesky()
}

/// Where equations in unknowns of this `size` are met as nearly as can be reached from a point, by at most 60 steps of Levenberg and
/// Marquardt: those that are off by less than `met` are met.
pub fn nearest(
    mut x: DVector<f64>,
    [met, size]: [f64; 2],
    linearise: &dyn Fn(&[f64]) -> Linear,
) -> DVector<f64> {
    let (mut damping, mut here) = (1e-3, linearise(x.as_slice()));
    for _ in 0..STEPS {
        let (jacobian, off) = &here;
        if off.amax() < met || damping > 1e6 {
            break;
        }
        let Some(normal) = damped(jacobian, damping * size * size) else {
            break;
        };
        let next = &x - normal.solve(&jacobian.tr_mul(off));
        let there = linearise(next.as_slice());
        match there.1.norm() < off.norm() {
            true => (x, here, damping) = (next, there, f64::max(damping * 0.1, 1e-14)),
            false => damping *= 10.0,
        }
    }
    x
}

/// A zero near a point, by at most 60 of Gauss and Newton's steps, which change least: singular values up to `zero` count as
/// zero. `linearise`: the Jacobian and the values at a point. `None`: there is none, or it is far away.
pub fn nearest_zero(
    mut x: Vec<f64>,
    zero: f64,
    linearise: &dyn Fn(&[f64]) -> Linear,
) -> Option<Vec<f64>> {
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
        let step = shortest(&decomposed(jacobian, [true, true]), &off, zero)?;
        x.iter_mut().zip(step.iter()).for_each(|(x, s)| *x -= s);
        if !x.iter().all(|x| x.abs() <= FAR * size) {
            return None;
        }
    }
    None
}
