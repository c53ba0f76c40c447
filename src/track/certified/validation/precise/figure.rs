//! The homotopy in 256 bits, from the problem's decimals.

use super::big::{Big, Rows, dot, exact, solve};
use crate::problem::{Problem, Target};
use crate::system::Homotopy;
use num_rational::BigRational;

pub struct Figure {
    pub dimension: usize,
    pub m: usize,
    pub n: usize,
    /// The unknowns behind either end of a distance, by axis.
    ends: Vec<Vec<[Option<usize>; 2]>>,
    /// The coefficients of E(t) = ½ a(t)², by distance.
    pub e: Vec<[Big; 5]>,
}

impl Figure {
    /// Of a problem, lengths being measured in the homotopy's unit.
    pub fn new(problem: &Problem, homotopy: &Homotopy) -> Self {
        let unit = Big::of(homotopy.unit);
        let lengths = problem.distances.iter().enumerate().map(|(e, distance)| {
            let [a, b] = distance.points.map(|p| &problem.points[p].sketch);
            let squared = (0..3).fold(BigRational::from_integer(0.into()), |sum, k| {
                let d = a[k].value() - b[k].value();
                sum + &d * &d
            });
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
            let a1 = target / &unit - &a0 + &c;
            let a2 = -c;
            let half = Big::of(0.5);
            [
                &half * &(&a0 * &a0),
                &a0 * &a1,
                &half * &(&a1 * &a1) + &a0 * &a2,
                &a1 * &a2,
                &half * &(&a2 * &a2),
            ]
        });
        Figure::with(homotopy, lengths.collect())
    }

    /// The same with other coefficients of E.
    pub fn with(homotopy: &Homotopy, e: Vec<[Big; 5]>) -> Self {
        let (d, m) = (homotopy.dimension, homotopy.equations);
        let unknown = |p: usize, axis: usize| {
            let v = homotopy.gauge.variable[p * d + axis];
            (v < m).then_some(v)
        };
        let ends = homotopy.edges.iter().map(|edge| {
            let of_axis = |axis: usize| edge.points.map(|p| unknown(p, axis));
            (0..d).map(of_axis).collect()
        });
        Figure {
            dimension: d,
            m,
            n: m + 1,
            ends: ends.collect(),
            e,
        }
    }

    fn difference(&self, z: &[Big], e: usize, axis: usize) -> Big {
        match self.ends[e][axis] {
            [Some(i), Some(j)] => &z[i] - &z[j],
            [Some(i), None] => z[i].clone(),
            [None, Some(j)] => -z[j].clone(),
            [None, None] => Big::of(0.0),
        }
    }

    /// F.
    pub fn residual(&self, z: &[Big]) -> Vec<Big> {
        let (t, half) = (&z[self.m], Big::of(0.5));
        let row = |e: usize| {
            let squared: Big = (0..self.dimension)
                .map(|axis| {
                    let d = self.difference(z, e, axis);
                    &d * &d
                })
                .sum();
            let c = &self.e[e];
            let length = (0..4).rev().fold(c[4].clone(), |sum, k| &sum * t + &c[k]);
            &half * &squared - length
        };
        (0..self.m).map(row).collect()
    }

    /// J.
    pub fn jacobian(&self, z: &[Big]) -> Rows {
        let t = &z[self.m];
        let row = |e: usize| {
            let mut row = vec![Big::of(0.0); self.n];
            for axis in 0..self.dimension {
                let d = self.difference(z, e, axis);
                let [i, j] = self.ends[e][axis];
                if let Some(i) = i {
                    row[i] += d.clone();
                }
                if let Some(j) = j {
                    row[j] -= d;
                }
            }
            let slope = (1..5).rev().fold(Big::of(0.0), |sum, k| {
                &sum * t + Big::of(k as f64) * &self.e[e][k]
            });
            row[self.m] = -slope;
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
        let mut z = through.to_vec();
        let normal = exact(&c[..self.n]);
        for _ in 0..40 {
            let mut g = self.residual(&z);
            let away: Vec<Big> = z.iter().zip(through).map(|(z, x)| z - x).collect();
            g.push(dot(&normal, &away));
            let mut right: Rows = g.into_iter().map(|g| vec![g, Big::of(0.0)]).collect();
            right[self.m][1] = Big::of(1.0);
            let step = solve(self.bordered(&z, c), right)?;
            let mut size = Big::of(0.0);
            for (z, step) in z.iter_mut().zip(&step) {
                *z -= step[0].clone();
                size = size.max(step[0].abs());
            }
            if size < Big::of(1e-60) {
                // The Jacobian of the last step was at a point nearer than 1e-30.
                let mut right: Rows = vec![vec![Big::of(0.0)]; self.n];
                right[self.m][0] = Big::of(1.0);
                let x = solve(self.bordered(&z, c), right)?;
                return Some((z, x.into_iter().map(|mut row| row.swap_remove(0)).collect()));
            }
        }
        None
    }
}
