//! The equations in intervals: F_e = ½|p_i − p_j|² − E_e(t), E_e = ½ a_e².

use super::whole::{Rows, exact, size, split};
use crate::interval::{Interval, point};
use crate::system::Homotopy;

/// The problem's equations. Vectors of unknowns z = (X, t) have n = m + 1 entries, and one more,
/// always zero, which is read for fixed coordinates.
pub struct Equations {
    pub homotopy: Homotopy,
    /// The number of equations.
    pub m: usize,
    /// Per distance and axis the unknowns of its two points.
    pub ends: Vec<[[usize; 2]; 3]>,
    /// The sketch: X, and t = 0.
    pub sketch: Vec<Interval>,
}

/// p_i − p_j per distance and axis.
pub type Differences = Vec<[Interval; 3]>;
pub const ZERO: Interval = inari::const_interval!(0.0, 0.0);

impl Equations {
    pub fn new(homotopy: Homotopy) -> Self {
        let (m, d) = (homotopy.equations, homotopy.dimension);
        let unknown = |point: usize, axis: usize| match homotopy.gauge.variable[point * d + axis] {
            fixed if fixed == m => m + 1,
            free => free,
        };
        let ends = homotopy.edges.iter().map(|edge| {
            std::array::from_fn(|axis| {
                edge.points
                    .map(|p| if axis < d { unknown(p, axis) } else { m + 1 })
            })
        });
        let place = homotopy.gauge.place.iter();
        Equations {
            m,
            ends: ends.collect(),
            sketch: place
                .map(|&p| homotopy.sketch_box[p])
                .chain([ZERO; 2])
                .collect(),
            homotopy,
        }
    }

    pub fn differences(&self, z: &[Interval]) -> Differences {
        let ends = self.ends.iter();
        ends.map(|e| e.map(|[i, j]| if i == j { ZERO } else { z[i] - z[j] }))
            .collect()
    }

    /// F(X, t) with the differences of X.
    pub fn residual(
        &self,
        d: &Differences,
        half_square: impl Fn(usize) -> Interval,
    ) -> Vec<Interval> {
        let square = |d: &[Interval; 3]| (d[0].sqr() + d[1].sqr() + d[2].sqr()) * HALF;
        d.iter()
            .enumerate()
            .map(|(e, d)| square(d) - half_square(e))
            .collect()
    }

    /// The same in floats, roughly.
    pub fn float_residual(&self, z: &[f64]) -> Vec<f64> {
        let lengths = self.ends.iter().zip(&self.homotopy.lengths);
        let value = lengths.map(|(ends, length)| {
            let square: f64 = ends.iter().map(|[i, j]| (z[*i] - z[*j]).powi(2)).sum();
            0.5 * square
                - length
                    .e
                    .iter()
                    .rev()
                    .fold(0.0, |sum, e| sum * z[self.m] + e)
        });
        value.collect()
    }

    /// The coefficients of E_e(t₀ + τ) in τ.
    pub fn half_square_at(&self, e: usize, t: Interval) -> [Interval; 5] {
        let length = &self.homotopy.lengths[e];
        let mut c = *length.half_square();
        // Horner's scheme, repeated.
        for from in 0..length.degree {
            for k in (from..length.degree).rev() {
                c[k] += t * c[k + 1];
            }
        }
        c
    }

    /// |E''| for all t in a range.
    pub fn bend_of(&self, e: usize, t: Interval) -> Interval {
        let c = self.homotopy.lengths[e].half_square();
        size(c[2] * point(2.0) + t * (c[3] * point(6.0) + t * (c[4] * point(12.0))))
    }

    /// The rows of a derivative: coordinates' entries from differences, those of t from `time`.
    fn row(
        &self,
        e: usize,
        d: &[Interval; 3],
        time: Interval,
    ) -> impl Iterator<Item = (usize, Interval)> {
        let (n, m) = (self.m + 1, self.m);
        let ends = self.ends[e];
        let signed = (0..3)
            .flat_map(move |axis| [(ends[axis][0], axis, false), (ends[axis][1], axis, true)]);
        let d = *d;
        signed
            .filter(move |&(i, ..)| i < n)
            .map(move |(i, axis, minus)| (i, if minus { -d[axis] } else { d[axis] }))
            .chain([(m, time)])
    }

    /// Rows as whole numbers, and Σ |rest| u ≤ Σ |rest| per row: no weight exceeds 1.
    pub fn whole_rows(&self, d: &Differences, time: &[Interval]) -> Option<(Rows, Vec<Interval>)> {
        let mut rests = Vec::with_capacity(self.m + 1);
        let rows = (0..self.m).map(|e| {
            let mut rest_sum = ZERO;
            let row = self.row(e, &d[e], time[e]).map(|(i, x)| {
                let (whole, rest) = split(x)?;
                rest_sum += rest;
                Some((i, whole))
            });
            let row = row.collect::<Option<Vec<_>>>();
            rests.push(rest_sum);
            row
        });
        let rows = rows.collect::<Option<Rows>>()?;
        Some((rows, rests))
    }

    /// The rows in floats, with `last` for the last of the square matrix.
    pub fn float_matrix(&self, d: &Differences, time: &[Interval], last: &[f64]) -> Vec<f64> {
        let n = self.m + 1;
        let mut out = vec![0.0; n * n];
        for e in 0..self.m {
            for (i, x) in self.row(e, &d[e], time[e]) {
                out[e * n + i] = x.mid();
            }
        }
        out[self.m * n..].copy_from_slice(&last[..n]);
        out
    }

    /// Σ u_j over the coordinates of a distance's ends, per axis.
    pub fn weight(&self, e: usize, u: &[Interval]) -> [Interval; 3] {
        self.ends[e].map(|[i, j]| u[i] + u[j])
    }
}

pub const HALF: Interval = inari::const_interval!(0.5, 0.5);

/// The same for one row of floats.
pub fn whole_row(row: &[f64]) -> Option<(Vec<(usize, i64)>, Interval)> {
    let mut rest_sum = ZERO;
    let whole = row.iter().enumerate().map(|(i, &x)| {
        let (whole, rest) = split(exact(x))?;
        rest_sum += rest;
        Some((i, whole))
    });
    Some((whole.collect::<Option<Vec<_>>>()?, rest_sum))
}
