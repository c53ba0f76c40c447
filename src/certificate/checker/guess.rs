//! Guesses in floats, which nobody has to trust: the proofs hold whatever these are.

use super::equations::{Equations, ZERO};
use super::krawczyk::{Curve, LARGE, ORDER, Section};
use super::whole::{J_BITS, Whole, power};
use crate::certificate::format::WEIGHT_UNIT;
use crate::certificate::verdict::Fault;
use crate::interval::point;

/// More Newton's steps than any place needs.
const STEPS: usize = 50;

/// A matrix near the inverse of [J(z₀); c] U, its rows scaled.
pub struct Inverse {
    pub whole: Whole,
    /// U Y with columns scaled: the inverse of [J(z₀); c].
    unscaled: Vec<f64>,
}

impl Inverse {
    /// At the first coefficient of a curve.
    pub fn new(curve: &Curve, at: &Section) -> Result<Inverse, Fault> {
        let n = curve.eq.m + 1;
        let mut rests = vec![ZERO; n];
        let j0 = curve.bordered(at, &mut rests)?;
        let mut matrix = vec![0.0; n * n];
        for (i, column) in j0.iter().enumerate() {
            column
                .iter()
                .for_each(|&(e, x)| matrix[e * n + i] += x as f64 * power(-J_BITS));
        }
        let floats = invert(n, matrix).ok_or(Fault::because("its Jacobian is singular"))?;
        let scale: Vec<f64> = at.scale.iter().map(|&e| power(-e)).collect();
        let entry = |(k, y): (usize, &f64)| y * WEIGHT_UNIT * f64::from(at.u[k / n]) * scale[k % n];
        Ok(Inverse {
            whole: Whole::nearest(n, &floats).ok_or(LARGE)?,
            unscaled: floats.iter().enumerate().map(entry).collect(),
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

/// The constant curve at a zero of F near a point, in the cross-section with normal `c` through that
/// point, with its section and inverse.
pub fn newton<'a>(
    eq: &'a Equations,
    near: &[f64],
    c: &[f64],
    u: &[u16],
) -> Result<(Curve<'a>, Section, Inverse), Fault> {
    let mut curve = Curve::at(eq, near)?;
    let at = curve.section(c, u);
    let inverse = Inverse::new(&curve, &at)?;
    let (mut z, mut last) = (near.to_vec(), f64::INFINITY);
    for _ in 0..STEPS {
        let mut f: Vec<f64> = curve.residual(0).iter().map(|f| f.mid()).collect();
        f.push(0.0);
        let step = inverse.times(&f);
        z.iter_mut().zip(&step).for_each(|(z, step)| *z -= step);
        curve = Curve::at(eq, &z)?;
        let size = step.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        if !(0.0 < size && size < 0.5 * last) {
            break;
        }
        last = size;
    }
    Ok((curve, at, inverse))
}

/// The preconditioner that moves along a curve, in floats.
pub struct Moving<'a> {
    pub curve: &'a Curve<'a>,
    pub at: &'a Section,
    pub inverse: &'a Inverse,
}

impl Moving<'_> {
    /// U Ỹ(s) f.
    fn times(&self, f: &[f64], s: f64) -> Vec<f64> {
        let mut v = self.inverse.times(f);
        let mut change = directional(self.curve.eq, &self.middle(1), &v);
        let (m, t) = (self.curve.eq.m, self.curve.z[0][self.curve.eq.m]);
        for (e, change) in change.iter_mut().enumerate() {
            *change -= self.curve.eq.bend(e, t).mid() * self.curve.z[1][m].mid() * v[m];
        }
        change.push(0.0);
        let back = self.inverse.times(&change);
        v.iter_mut().zip(back).for_each(|(v, x)| *v -= s * x);
        v
    }

    fn middle(&self, k: usize) -> Vec<f64> {
        self.curve.z[k].iter().map(|z| z.mid()).collect()
    }

    /// A point near the zero of F in the cross-section through ẑ(s): with steps, in the norm, below
    /// `enough`, or that do not shrink any more.
    pub fn zero(&self, s: f64, enough: f64) -> Vec<f64> {
        let (eq, n) = (self.curve.eq, self.at.c.len());
        let along = |i: usize| {
            self.curve
                .z
                .iter()
                .rev()
                .fold(0.0, |sum, z| sum * s + z[i].mid())
        };
        let start: Vec<f64> = (0..n).map(along).collect();
        let (mut z, mut last) = (start.clone(), f64::INFINITY);
        for _ in 0..STEPS {
            let mut f = value(eq, &z);
            let ahead = z.iter().zip(&start).zip(&self.at.c);
            f.push(ahead.map(|((z, start), c)| c * (z - start)).sum());
            let step = self.times(&f, s);
            z.iter_mut().zip(&step).for_each(|(z, step)| *z -= step);
            let size = self.norm(&step);
            if !(enough < size && size < 0.9 * last) {
                break;
            }
            last = size;
        }
        z
    }

    /// A vector T near the curve's direction at a point near ẑ(s), with c·T = 1.
    pub fn tangent(&self, near: &[f64], s: f64) -> Vec<f64> {
        let (eq, n) = (self.curve.eq, self.at.c.len());
        let slope = |i: usize| {
            let terms = (1..self.curve.z.len()).rev();
            terms.fold(0.0, |sum, k| sum * s + k as f64 * self.curve.z[k][i].mid())
        };
        let mut v: Vec<f64> = (0..n).map(slope).collect();
        let dot = |v: &[f64]| v.iter().zip(&self.at.c).map(|(v, c)| v * c).sum::<f64>();
        let advance = dot(&v);
        v.iter_mut().for_each(|v| *v /= advance);
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let mut f = directional(eq, near, &v);
            for (e, f) in f.iter_mut().enumerate() {
                *f -= eq.half_square_at(e, point(near[eq.m]))[1].mid() * v[eq.m];
            }
            f.push(dot(&v) - 1.0);
            let step = self.times(&f, s);
            v.iter_mut().zip(&step).for_each(|(v, step)| *v -= step);
            let size = self.norm(&step);
            if !(0.0 < size && size < 0.9 * last) {
                break;
            }
            last = size;
        }
        v
    }

    fn norm(&self, v: &[f64]) -> f64 {
        let sizes = v.iter().zip(&self.at.u);
        sizes.fold(0.0, |max, (v, &u)| {
            max.max(v.abs() / (WEIGHT_UNIT * f64::from(u)))
        })
    }
}

/// F, in floats.
fn value(eq: &Equations, z: &[f64]) -> Vec<f64> {
    let form = |form: usize| form_of(eq, z, form);
    let residual = |e: usize| {
        let products = eq.products[e].iter();
        let q: f64 = products
            .map(|p| 0.5 * p.factor as f64 * form(p.left) * form(p.right))
            .sum();
        q - eq.half_square_at(e, point(z[eq.m]))[0].mid()
    };
    (0..eq.m).map(residual).collect()
}

/// The derivatives of all q_e at a point in a direction, in floats.
fn directional(eq: &Equations, z: &[f64], v: &[f64]) -> Vec<f64> {
    let term = |p: &super::equations::Product| {
        let [(a, b), (c, d)] = [p.left, p.right].map(|f| (form_of(eq, z, f), form_of(eq, v, f)));
        0.5 * p.factor as f64 * (a * d + b * c)
    };
    let products = eq.products.iter();
    products
        .map(|products| products.iter().map(term).sum())
        .collect()
}

/// A difference of two entries, in floats.
fn form_of(eq: &Equations, z: &[f64], form: usize) -> f64 {
    let [i, j] = eq.forms[form].map(|i| if i < eq.m { z[i] } else { 0.0 });
    i - j
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
