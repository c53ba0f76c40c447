//! The homotopy in 256 bits, from the problem's decimals.

use super::big::{Big, Rows, dot, exact, solve};
use crate::equations::{Form, Halved as _, left_side, slopes};
use crate::problem::{Problem, Target};
use crate::system::{Homotopy, Term};
use nalgebra::{DMatrix, DVector};

pub struct Figure {
    pub m: usize,
    pub n: usize,
    /// What 2 q is the sum of, by equation.
    terms: Vec<Vec<Term>>,
    /// The coefficients of E(t), by equation.
    pub e: Vec<[Big; 5]>,
}

/// The values of entries of terms.
fn at(z: &[Big]) -> impl Fn(Option<usize>) -> Big {
    |entry| entry.map_or(Big::of(0.0), |i| z[i].clone())
}

impl Figure {
    /// Of a problem, lengths being measured in the homotopy's unit.
    pub fn new(problem: &Problem, homotopy: &Homotopy) -> Self {
        Self::of(problem, homotopy, |from, to, c| {
            let slope = to - &from + &c;
            [from, slope, -c]
        })
    }

    /// The same with the target lengths at every t.
    pub fn at_target(problem: &Problem, homotopy: &Homotopy) -> Self {
        let nothing = Big::of(0.0);
        Self::of(problem, homotopy, |_, to, _| {
            [to, nothing.clone(), nothing.clone()]
        })
    }

    /// With lengths a₀ + a₁ t + a₂ t² made of those in the sketch, at the target, and the coefficient of the bend.
    fn of(
        problem: &Problem,
        homotopy: &Homotopy,
        length: impl Fn(Big, Big, Big) -> [Big; 3],
    ) -> Self {
        let unit = Big::of(homotopy.unit);
        let lengths = problem.distances.iter().enumerate().map(|(e, distance)| {
            let squared = problem.squared_in_sketch(distance.points);
            let a0 = Big::ratio(&squared).sqrt() / &unit;
            let target = match &distance.target {
                Target::Length(length) => Big::ratio(length.value()),
                Target::SquaredLength(squared) => Big::ratio(squared.value()).sqrt(),
            };
            let c = if e == problem.homotopy.bend {
                Big::ratio(problem.homotopy.bend_coefficient.value()) / &unit
            } else {
                Big::of(0.0)
            };
            let [a0, a1, a2] = length(a0, target / &unit, c);
            let half = Big::of(0.5);
            [
                &half * &(&a0 * &a0),
                &a0 * &a1,
                &half * &(&a1 * &a1) + &a0 * &a2,
                &a1 * &a2,
                &half * &(&a2 * &a2),
            ]
        });
        let constraints = homotopy.tail.equations.iter().map(|equation| {
            let unit = Big::of(homotopy.unit.powi(equation.power));
            std::array::from_fn(|k| match equation.right.get(k) {
                Some(coefficient) => Big::ratio(&coefficient.ball().middle) / &unit,
                None => Big::of(0.0),
            })
        });
        Figure::with(homotopy, lengths.chain(constraints).collect())
    }

    /// Of a homotopy's left-hand sides, with `e` for the coefficients of E(t) by equation, in the homotopy's unit.
    pub fn with(homotopy: &Homotopy, e: Vec<[Big; 5]>) -> Self {
        let m = homotopy.equations;
        Figure {
            m,
            n: m + 1,
            terms: (0..m).map(|e| homotopy.terms(e)).collect(),
            e,
        }
    }

    /// F.
    pub fn residual(&self, z: &[Big]) -> Vec<Big> {
        let t = &z[self.m];
        let row = |e: usize| {
            let left = left_side(&self.terms[e], at(z));
            let c = &self.e[e];
            let right = (0..4).rev().fold(c[4].clone(), |sum, k| &sum * t + &c[k]);
            left - right
        };
        (0..self.m).map(row).collect()
    }

    /// What the terms of one left-hand side add up to without their signs.
    pub fn size(&self, e: usize, z: &[Big]) -> Big {
        let terms = self.terms[e].iter();
        terms
            .map(|term| term.value(at(z)).halves(term.factor).abs())
            .sum()
    }

    /// J.
    pub fn jacobian(&self, z: &[Big]) -> Rows {
        let t = &z[self.m];
        let row = |e: usize| {
            let mut row = vec![Big::of(0.0); self.n];
            slopes(&self.terms[e], at(z), |entry, slope| {
                entry.into_iter().for_each(|i| row[i] += slope.clone());
            });
            let slope = (1..5).rev().fold(Big::of(0.0), |sum, k| {
                &sum * t + Big::of(k as f64) * &self.e[e][k]
            });
            row[self.m] = -slope;
            row
        };
        (0..self.m).map(row).collect()
    }

    /// How the columns of J that belong to X change as X moves in the direction v: the derivative of J v by X.
    pub fn change_of_jacobian(&self, v: &[Big]) -> Rows {
        let row = |e: usize| {
            let mut row = vec![Big::of(0.0); self.n];
            // The number 1 does not move.
            let terms = self.terms[e].iter();
            let terms = terms.filter(|term| !term.forms().contains(&Form::One));
            slopes(terms, at(v), |entry, slope| {
                entry.into_iter().for_each(|i| row[i] += slope.clone());
            });
            row
        };
        (0..self.m).map(row).collect()
    }

    /// J with the row c below.
    pub fn bordered(&self, z: &[Big], c: &[f64]) -> Rows {
        let mut rows = self.jacobian(z);
        rows.push(exact(&c[..self.n]));
        rows
    }

    /// The zero of F in the cross-section c·(z − through) = 0 that Newton's method finds from there, and
    /// the x with J x = 0, c·x = 1 there. `None`: it does not converge.
    pub fn point_near(&self, through: &[Big], c: &[f64]) -> Option<(Vec<Big>, Vec<Big>)> {
        self.point_within(NEAR, through, c)
    }

    /// The same, where the last step is shorter than `within`.
    pub fn point_within(
        &self,
        within: f64,
        through: &[Big],
        c: &[f64],
    ) -> Option<(Vec<Big>, Vec<Big>)> {
        let mut z = through.to_vec();
        let normal = exact(&c[..self.n]);
        let (mut near, mut is_short) = (None, false);
        for round in 0..40 {
            let mut g = self.residual(&z);
            let away: Vec<Big> = z.iter().zip(through).map(|(z, x)| z - x).collect();
            g.push(dot(&normal, &away));
            // An inverse in floats is quick, and good enough for all but what is nearly singular. Where z moves by less than it is
            // rounded it stays the same.
            let step = if round < IN_FLOATS {
                if !is_short {
                    near = inverse(&self.bordered(&z, c));
                }
                times(near.as_ref()?, &g)?
            } else {
                solved(self.bordered(&z, c), g)?
            };
            let size = greatest(&step);
            for (z, step) in z.iter_mut().zip(step) {
                *z -= step;
            }
            if size < Big::of(within) {
                let mut right = vec![Big::of(0.0); self.n];
                right[self.m] = Big::of(1.0);
                let rows = self.bordered(&z, c);
                let x = refined(within, &rows, near.as_ref()?, &right)
                    .or_else(|| solved(rows, right))?;
                return Some((z, x));
            }
            is_short = size < Big::of(f64::EPSILON);
        }
        None
    }
}

/// So many of Newton's steps are made with inverses in floats.
const IN_FLOATS: usize = 16;
/// Steps that are shorter are the last.
const NEAR: f64 = 1e-60;

/// A⁻¹ g.
fn solved(a: Rows, g: Vec<Big>) -> Option<Vec<Big>> {
    let columns = g.into_iter().map(|g| vec![g]).collect();
    let x = solve(a, columns)?.into_iter();
    Some(x.map(|mut row| row.swap_remove(0)).collect())
}

/// About the inverse, in floats.
fn inverse(a: &Rows) -> Option<DMatrix<f64>> {
    let n = a.len();
    let inverse = DMatrix::from_fn(n, n, |i, j| a[i][j].to_f64()).try_inverse()?;
    let is_finite = inverse.iter().all(|x| x.is_finite());
    is_finite.then_some(inverse)
}

/// About A⁻¹ g, to as many digits as floats have. `None`: it is beyond them.
fn times(inverse: &DMatrix<f64>, g: &[Big]) -> Option<Vec<Big>> {
    let step = inverse * DVector::from_iterator(g.len(), g.iter().map(Big::to_f64));
    let is_finite = step.iter().all(|x| x.is_finite());
    is_finite.then(|| exact(step.as_slice()))
}

/// A⁻¹ g by an inverse in floats, and what it leaves again and again. `None`: it does not come near enough.
fn refined(within: f64, a: &Rows, inverse: &DMatrix<f64>, g: &[Big]) -> Option<Vec<Big>> {
    let mut x = vec![Big::of(0.0); g.len()];
    for _ in 0..IN_FLOATS {
        let left = a.iter().zip(g).map(|(row, g)| g - dot(row, &x));
        let step = times(inverse, &left.collect::<Vec<_>>())?;
        let size = greatest(&step);
        for (x, step) in x.iter_mut().zip(step) {
            *x += step;
        }
        if size < Big::of(within) {
            return Some(x);
        }
    }
    None
}

fn greatest(step: &[Big]) -> Big {
    let sizes = step.iter().map(Big::abs);
    sizes.fold(Big::of(0.0), Big::max)
}
