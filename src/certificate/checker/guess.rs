//! Guesses in floats, which nobody has to trust: the proofs hold whatever these are.

use super::equations::{Equations, ZERO};
use super::krawczyk::{Curve, Fault, LARGE, ORDER};
use super::whole::{J_BITS, Whole, power};
use crate::certificate::format::WEIGHT_UNIT;

/// More Newton's steps than any place needs.
const STEPS: usize = 50;

/// A matrix near the inverse of [J(z₀); c] U.
pub struct Inverse {
    pub whole: Whole,
    /// U Y: in the unknowns' own units.
    unscaled: Vec<f64>,
}

impl Inverse {
    /// At the first coefficient of a curve.
    pub fn new(curve: &Curve, c: &[f64], u: &[u16]) -> Result<Inverse, Fault> {
        let n = curve.eq.m + 1;
        let mut rests = vec![ZERO; n];
        let j0 = curve.bordered(c, u, &mut rests)?;
        let mut matrix = vec![0.0; n * n];
        for (i, column) in j0.iter().enumerate() {
            column
                .iter()
                .for_each(|&(e, x)| matrix[e * n + i] = x as f64 * power(-J_BITS));
        }
        let floats = invert(n, matrix).ok_or("its Jacobian is singular")?;
        let entries = floats.iter().enumerate();
        let unscaled = entries
            .map(|(k, y)| y * WEIGHT_UNIT * f64::from(u[k / n]))
            .collect();
        Ok(Inverse {
            whole: Whole::nearest(n, &floats).ok_or(LARGE)?,
            unscaled,
        })
    }

    /// U Y f, in floats.
    pub fn times(&self, f: &[f64]) -> Vec<f64> {
        let rows = self.unscaled.chunks(f.len());
        rows.map(|row| row.iter().zip(f).map(|(y, f)| y * f).sum())
            .collect()
    }
}

/// Makes a curve of degree 5 whose F(ẑ(σ)) has small coefficients; `advance` is c·z₁.
pub fn expand(curve: &mut Curve, inverse: &Inverse, advance: f64) -> Result<(), Fault> {
    for k in 1..=ORDER {
        let mut f: Vec<f64> = curve.residual(k).iter().map(|f| -f.mid()).collect();
        f.push(if k == 1 { advance } else { 0.0 });
        curve.push(&inverse.times(&f))?;
    }
    Ok(())
}

/// The constant curve at a zero of F near a point, in the cross-section through that point. The
/// steps, with one inverse for all, end below `enough`, or where they do not shrink any more.
pub fn newton<'a>(
    eq: &'a Equations,
    near: &[f64],
    c: &[f64],
    u: &[u16],
    enough: f64,
) -> Result<(Curve<'a>, Inverse), Fault> {
    let mut curve = Curve::at(eq, near)?;
    let inverse = Inverse::new(&curve, c, u)?;
    let (mut z, mut last) = (near.to_vec(), f64::INFINITY);
    for _ in 0..STEPS {
        let mut f: Vec<f64> = curve.residual(0).iter().map(|f| f.mid()).collect();
        f.push(0.0);
        let step = inverse.times(&f);
        z.iter_mut().zip(&step).for_each(|(z, step)| *z -= step);
        curve = Curve::at(eq, &z)?;
        let size = step.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        if !(enough < size && size < 0.5 * last) {
            break;
        }
        last = size;
    }
    Ok((curve, inverse))
}

/// A float inverse, or nothing where there is none: Gauss and Jordan in place, with row pivots.
fn invert(n: usize, mut a: Vec<f64>) -> Option<Vec<f64>> {
    let mut pivots = Vec::with_capacity(n);
    for k in 0..n {
        let size = |i: &usize| a[i * n + k].abs();
        let pivot = (k..n).max_by(|i, j| size(i).total_cmp(&size(j)))?;
        pivots.push(pivot);
        (0..n).for_each(|j| a.swap(k * n + j, pivot * n + j));
        let scale = 1.0 / a[k * n + k];
        if !scale.is_finite() {
            return None;
        }
        a[k * n + k] = 1.0;
        let row: Vec<f64> = a[k * n..(k + 1) * n].iter().map(|x| x * scale).collect();
        for (i, other) in a.chunks_mut(n).enumerate() {
            if i == k {
                other.copy_from_slice(&row);
                continue;
            }
            let factor = std::mem::take(&mut other[k]);
            if factor != 0.0 {
                other
                    .iter_mut()
                    .zip(&row)
                    .for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    for (k, &pivot) in pivots.iter().enumerate().rev() {
        (0..n).for_each(|i| a.swap(i * n + k, i * n + pivot));
    }
    Some(a)
}
