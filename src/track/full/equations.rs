//! H(X, t) laid out for the inner loops.

use crate::interval::rounding::{gamma, round_up};
use crate::linalg::{Matrix, Vector};
use crate::system::Homotopy;

/// The largest degree of F along a curve of degree `order`: 2 in X, 4 in t (the bend).
pub const MAX_DEGREE: usize = 4;

/// One distance: which entries of z it depends on, and E(t) = ½ a(t)².
#[derive(Debug, Clone)]
pub struct EdgeTerm<const D: usize> {
    /// Entries of z for the coordinates of either point. Fixed coordinates are read from the
    /// spare entry n, which is always zero.
    pub at: [[usize; D]; 2],
    /// Coefficients of E and how far the exact ones may be away.
    pub e: [f64; 5],
    /// Radii of the coefficients' enclosures.
    pub e_radius: [f64; 5],
    /// Whether E is of degree 4 rather than 2.
    pub bend: bool,
}

/// The m equations in n = m + 1 unknowns, t last, of a problem in D dimensions.
#[derive(Debug, Clone)]
pub struct Equations<const D: usize> {
    /// The number m of equations.
    pub m: usize,
    /// The distances.
    pub edges: Vec<EdgeTerm<D>>,
}

impl<const D: usize> Equations<D> {
    /// Lays out a homotopy.
    pub fn new(homotopy: &Homotopy) -> Self {
        assert_eq!(homotopy.dimension, D);
        let m = homotopy.equations;
        let entry = |point: usize, axis: usize| match homotopy.gauge.variable[point * D + axis] {
            fixed if fixed == m => m + 1,
            free => free,
        };
        let edges = homotopy
            .edges
            .iter()
            .zip(&homotopy.lengths)
            .map(|(edge, length)| EdgeTerm {
                at: edge
                    .points
                    .map(|p| std::array::from_fn(|axis| entry(p, axis))),
                e: length.e,
                e_radius: length.e_radius,
                bend: length.degree > 2,
            })
            .collect();
        Equations { m, edges }
    }

    /// The number n of unknowns.
    pub fn n(&self) -> usize {
        self.m + 1
    }

    /// A vector of n entries and the spare one.
    pub fn vector(&self) -> Vector {
        Vector::zeros(self.m + 2)
    }

    /// p_i − p_j for the vector `z`, for every distance.
    #[inline(always)]
    pub fn differences(&self, z: &[f64], out: &mut [[f64; D]]) {
        for (edge, out) in self.edges.iter().zip(out) {
            let [i, j] = edge.at;
            for k in 0..D {
                out[k] = z[i[k]] - z[j[k]];
            }
        }
    }

    /// The Taylor coefficients E⁽ʲ⁾(t)/j! of every distance.
    #[inline(always)]
    pub fn expand_lengths(&self, t: f64, out: &mut [[f64; 5]]) {
        for (edge, out) in self.edges.iter().zip(out) {
            let e = &edge.e;
            if edge.bend {
                let e4t = e[4] * t;
                *out = [
                    e[0] + t * (e[1] + t * (e[2] + t * (e[3] + e4t))),
                    e[1] + t * (2.0 * e[2] + t * (3.0 * e[3] + 4.0 * e4t)),
                    e[2] + t * (3.0 * e[3] + 6.0 * e4t),
                    e[3] + 4.0 * e4t,
                    e[4],
                ];
            } else {
                *out = [
                    e[0] + t * (e[1] + t * e[2]),
                    e[1] + 2.0 * t * e[2],
                    e[2],
                    0.0,
                    0.0,
                ];
            }
        }
    }

    /// F(z) in floats.
    pub fn residual(&self, z: &[f64], out: &mut [f64]) {
        let t = z[self.m];
        for (edge, f) in self.edges.iter().zip(out) {
            let [i, j] = edge.at;
            let squared: f64 = (0..D).map(|k| (z[i[k]] - z[j[k]]).powi(2)).sum();
            let e = &edge.e;
            *f = 0.5 * squared - (e[0] + t * (e[1] + t * (e[2] + t * (e[3] + t * e[4]))));
        }
    }

    /// F(z) in floats, and how far the exact value may be from it: rounding, and the radii of
    /// the coefficients. No term goes through more than 20 roundings.
    pub fn residual_with_error(&self, z: &[f64], out: &mut [f64], error: &mut [f64]) {
        self.residual(z, out);
        let t = z[self.m].abs();
        for (edge, error) in self.edges.iter().zip(error) {
            let [i, j] = edge.at;
            let squared: f64 = (0..D).map(|k| (z[i[k]] - z[j[k]]).powi(2)).sum();
            let (e, r) = (edge.e.map(f64::abs), &edge.e_radius);
            let size = 0.5 * squared + (e[0] + t * (e[1] + t * (e[2] + t * (e[3] + t * e[4]))));
            let radius = r[0] + t * (r[1] + t * (r[2] + t * (r[3] + t * r[4])));
            *error = round_up(gamma(20) * size + radius, 24);
        }
    }

    /// Writes the Jacobian at the given differences, and `normal` as its last row.
    pub fn jacobian(
        &self,
        differences: &[[f64; D]],
        lengths: &[[f64; 5]],
        normal: &[f64],
        out: &mut Matrix,
    ) {
        let (m, n) = (self.m, self.n());
        out.clear();
        for (e, ((edge, d), length)) in self.edges.iter().zip(differences).zip(lengths).enumerate()
        {
            for k in 0..D {
                let [i, j] = edge.at.map(|at| at[k]);
                if i < n {
                    out.set(e, i, d[k]);
                }
                if j < n {
                    out.set(e, j, -d[k]);
                }
            }
            out.set(e, m, -length[1]);
        }
        for (column, &c) in normal[..n].iter().enumerate() {
            out.set(m, column, c);
        }
    }
}
