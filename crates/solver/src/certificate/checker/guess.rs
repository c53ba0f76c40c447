//! Guesses in floats, which nobody has to trust: the proofs hold whatever these are.

use super::equations::{Equations, Product};
use super::krawczyk::{Curve, MANY, ORDER, Section, weights};
use super::matrix::{Columns, Matrix, add};
use super::sparse::Sparse;
use crate::certificate::format::{FoldClaim, TubeClaim};
use crate::certificate::verdict::Fault;
use crate::elimination;
use nalgebra::DMatrixView;

/// More Newton's steps than any place needs.
const STEPS: usize = 50;

/// A matrix Y near the inverse of M = [J(z₀); c] U.
pub struct Inverse {
    pub y: Matrix,
    u: Vec<f64>,
    /// M, if it has few entries.
    sparse: Option<Sparse>,
}

impl Inverse {
    pub fn new(at: &Section) -> Result<Inverse, Fault> {
        let (n, u) = (at.u.len(), at.u.clone());
        let sparse = (n >= MANY).then(|| Sparse::new(&at.j0)).flatten();
        let y = match &sparse {
            Some(sparse) => Some(sparse.inverse()),
            None => invert(&at.j0),
        };
        let is_finite = |y: &Matrix| y.entries.iter().all(|x| x.is_finite());
        let y = y.filter(is_finite);
        let y = y.ok_or(Fault::because("its Jacobian is singular"))?;
        Ok(Inverse { y, u, sparse })
    }

    /// (M⁻¹ B)ᵀ from Bᵀ.
    pub fn solve(&self, b: &Matrix) -> Matrix {
        let n = b.n;
        if let Some(sparse) = &self.sparse {
            return sparse.solve(b);
        }
        let y = DMatrixView::from_slice(&self.y.entries, n, n).transpose();
        let product = DMatrixView::from_slice(&b.entries, n, n) * y;
        let entries = product.data.into();
        Matrix { n, entries }
    }

    /// U Y f.
    pub fn times(&self, f: &[f64]) -> Vec<f64> {
        let v = self.image(f);
        v.iter().zip(&self.u).map(|(v, u)| v * u).collect()
    }

    /// Y f, or M⁻¹ f where that is less work.
    fn image(&self, f: &[f64]) -> Vec<f64> {
        match &self.sparse {
            Some(sparse) => sparse.solve_one(f),
            None => product(&self.y, f),
        }
    }
}

/// A matrix times a vector.
fn product(matrix: &Matrix, v: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; matrix.n];
    for (column, v) in matrix.entries.chunks(matrix.n).zip(v) {
        add(&mut out, column, |y| y * v);
    }
    out
}

/// Makes a curve of degree 5 whose F(ẑ(σ)) has small coefficients; `advance` is c·z₁.
pub fn expand(curve: &mut Curve, inverse: &Inverse, advance: f64) -> Result<(), Fault> {
    for k in 1..=ORDER {
        let mut f: Vec<f64> = curve.residual(k).iter().map(|f| -f.mid()).collect();
        f.push(if k == 1 { advance } else { 0.0 });
        curve.push(inverse.times(&f))?;
    }
    Ok(())
}

/// The constant curve at a zero of F near a point, in the cross-section with normal `c` through that
/// point, with an inverse near there.
pub fn newton<'a>(
    eq: &'a Equations,
    (near, extended): (&[f64], bool),
    c: &[f64],
    u: &[f64],
) -> Result<(Curve<'a>, Inverse), Fault> {
    let mut curve = Curve::at(eq, near)?;
    let inverse = Inverse::new(&curve.section(c, u))?;
    let (mut z, mut last) = (near.to_vec(), f64::INFINITY);
    let step_at = |curve: &Curve| {
        let mut f: Vec<f64> = curve.value().iter().map(|f| f.mid()).collect();
        f.push(0.0);
        let mut step = inverse.times(&f);
        // Where the cross-section is that of one t, rounding does not lead out of it.
        if c[..eq.m].iter().all(|&c| c == 0.0) {
            step[eq.m] = 0.0;
        }
        step
    };
    for _ in 0..if extended { 0 } else { STEPS } {
        let step = step_at(&curve);
        z.iter_mut().zip(&step).for_each(|(z, step)| *z -= step);
        curve = Curve::at(eq, &z)?;
        let size = step.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        if !(0.0 < size && size < 0.5 * last) {
            break;
        }
        last = size;
    }
    if extended {
        curve = refined(eq, &z, step_at)?;
    }
    Ok((curve, inverse))
}

/// A point of more than 53 bits, to which Newton's steps lead from one of 53.
fn refined<'a>(
    eq: &'a Equations,
    near: &[f64],
    step: impl Fn(&Curve) -> Vec<f64>,
) -> Result<Curve<'a>, Fault> {
    let mut curve = Curve::at_sum(eq, near, &vec![0.0; near.len()])?;
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let step = step(&curve);
        let low = step.iter().enumerate();
        let low: Vec<f64> = low.map(|(i, x)| curve.low_of(i).mid() - x).collect();
        curve = Curve::at_sum(eq, &curve.z[0].clone(), &low)?;
        let size = step.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        if !(0.0 < size && size < 0.9 * last) {
            break;
        }
        last = size;
    }
    Ok(curve)
}

/// A point (X, v, t) near a fold in a box, where the path comes in a tube; t's derivative is as good as zero.
pub fn fold(eq: &Equations, claim: &FoldClaim, tube: &TubeClaim) -> Result<Vec<f64>, Fault> {
    let mut z: Vec<f64> = claim.figure.centre.clone();
    z.push(claim.t);
    let c: Vec<f64> = tube.normal.iter().map(|&c| c.into()).collect();
    let curve = Curve::at(eq, &z)?;
    let at = curve.section(&c, &weights(&tube.weights));
    let mut last = vec![0.0; eq.m + 1];
    last[eq.m] = 1.0;
    let tangent = Inverse::new(&at)?.times(&last);
    z.splice(eq.m..eq.m, tangent[..eq.m].iter().copied());
    Ok(z)
}

/// The preconditioner that moves along a curve, in floats.
pub struct Moving<'a> {
    curve: &'a Curve<'a>,
    at: &'a Section,
    inverse: &'a Inverse,
    a: &'a Matrix,
    /// The coefficients of E.
    right: Vec<[f64; 5]>,
}

impl<'a> Moving<'a> {
    pub fn new(curve: &'a Curve<'a>, at: &'a Section, inverse: &'a Inverse, a: &'a Matrix) -> Self {
        let rights = curve.eq.homotopy.rights.iter();
        Moving {
            curve,
            at,
            inverse,
            a,
            right: rights.map(|right| right.e).collect(),
        }
    }

    /// U (I − sA) Y f.
    fn times(&self, f: &[f64], s: f64) -> Vec<f64> {
        let v = self.inverse.image(f);
        let change = product(self.a, &v);
        let all = v.iter().zip(change).zip(&self.at.u);
        all.map(|((v, x), u)| (v - s * x) * u).collect()
    }

    /// A point near the zero of F in the cross-section through ẑ(s): with steps, in the norm, below
    /// `enough`, or that do not shrink any more.
    pub fn zero(&self, s: f64, enough: f64) -> Result<Curve<'a>, Fault> {
        let (eq, z, n) = (self.curve.eq, &self.curve.z, self.at.c.len());
        let way = |i: usize| s * z[1..].iter().rev().fold(0.0, |sum, z| sum * s + z[i]);
        let start: Vec<f64> = (0..n).map(|i| z[0][i] + way(i)).collect();
        if self.curve.low.is_none() {
            let mut near = start.clone();
            self.improve(&mut near, s, enough, |z| {
                let right = |c: &[f64; 5]| c.iter().rev().fold(0.0, |sum, c| sum * z[eq.m] + c);
                let left = value(eq, z).into_iter().zip(&self.right);
                let ahead = z.iter().zip(&start).zip(&self.at.c);
                let ahead = ahead.map(|((z, start), c)| c * (z - start)).sum();
                left.map(|(f, e)| f - right(e)).chain([ahead]).collect()
            });
            return Curve::at(eq, &near);
        }
        refined(eq, &start, |there| {
            let mut f: Vec<f64> = there.value().iter().map(|f| f.mid()).collect();
            let low = |i: usize| (there.low_of(i) - self.curve.low_of(i)).mid();
            let off = |i: usize| (there.z[0][i] - z[0][i]) + low(i) - way(i);
            f.push((0..n).map(|i| self.at.c[i] * off(i)).sum());
            self.times(&f, s)
        })
    }

    /// A vector T near the curve's direction at a point near ẑ(s), with c·T = 1.
    pub fn tangent(&self, near: &[f64], s: f64) -> Vec<f64> {
        let (eq, n, z) = (self.curve.eq, self.at.c.len(), &self.curve.z);
        let slope = |i: usize| {
            let terms = (1..z.len()).rev();
            terms.fold(0.0, |sum, k| sum * s + k as f64 * z[k][i])
        };
        let mut v: Vec<f64> = (0..n).map(slope).collect();
        let along = |v: &[f64]| v.iter().zip(&self.at.c).map(|(v, c)| v * c).sum::<f64>();
        let advance = along(&v);
        v.iter_mut().for_each(|v| *v /= advance);
        let slope_of = |e: &[f64; 5]| {
            let terms = (1..5).rev();
            terms.fold(0.0, |sum, k| sum * near[eq.m] + k as f64 * e[k])
        };
        let slopes: Vec<f64> = self.right.iter().map(slope_of).collect();
        let (enough, forms) = (1e-6 * self.norm(&v), eq.differences(near, [0.0, 1.0]));
        self.improve(&mut v, s, enough, |v| {
            let left = eq.gradient.iter().map(|terms| {
                let terms = terms.iter();
                let terms = terms.map(|&(i, factor, form)| factor as f64 * forms[form] * v[i]);
                0.5 * terms.sum::<f64>()
            });
            let left = left.zip(&slopes);
            left.map(|(f, e)| f - e * v[eq.m])
                .chain([along(v) - 1.0])
                .collect()
        });
        v
    }

    /// Newton's steps, as far as they shrink and are not below `enough`.
    fn improve(&self, v: &mut [f64], s: f64, enough: f64, f: impl Fn(&[f64]) -> Vec<f64>) {
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let step = self.times(&f(v), s);
            v.iter_mut().zip(&step).for_each(|(v, step)| *v -= step);
            let size = self.norm(&step);
            if !(enough < size && size < 0.9 * last) {
                break;
            }
            last = size;
        }
    }

    fn norm(&self, v: &[f64]) -> f64 {
        let ratios = v.iter().zip(&self.at.u);
        ratios.fold(0.0, |max, (v, u)| max.max(v.abs() / u))
    }
}

/// All q_e at a point, in floats.
fn value(eq: &Equations, z: &[f64]) -> Vec<f64> {
    let forms = eq.differences(z, [0.0, 1.0]);
    let term =
        |&(factor, [left, right]): &Product| 0.5 * factor as f64 * forms[left] * forms[right];
    let products = eq.products.iter();
    products
        .map(|products| products.iter().map(term).sum())
        .collect()
}

/// A float inverse, or nothing where there is none.
pub fn invert(columns: &Columns) -> Option<Matrix> {
    let n = columns.len();
    // Row by row as column by column: the inverse of the transposed matrix is that of the matrix, transposed.
    let mut matrix = vec![0.0; n * n];
    for (row, column) in matrix.chunks_mut(n).zip(columns) {
        column.iter().for_each(|&(e, x)| row[e] += x);
    }
    let entries = elimination::invert(&mut matrix, n).then_some(matrix)?;
    Some(Matrix { n, entries })
}
