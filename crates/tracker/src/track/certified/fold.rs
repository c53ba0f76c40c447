//! A box around a fold of the path: t' = 0 with t'' ≠ 0.
//!
//! At a fold the path's tangent is (v, 0). So with the normal c of a tube's cross-sections
//!
//! ```text
//! Φ(X, t, v) = ( F(X, t),  J(X) v,  c·v − 1 ) = 0,      J = ∂F/∂X,
//! ```
//!
//! 2m + 1 equations in as many unknowns (Moore and Spence, SIAM J. Numer. Anal. 17, 1980). Its Jacobian is
//!
//! ```text
//! [ J     −E'(t)  0  ]
//! [ J(v)   0      J  ]        J(v): the derivative of J(X) v by X
//! [ 0      0      cᵀ ]
//! ```
//!
//! and is regular exactly at quadratic folds: where J loses rank by one, (J, −E') does not, and t'' ≠ 0.
//! A Krawczyk test that succeeds proves it regular in the box, one zero in it, and no other within
//! `alone_within`. In a tube with the normal c the path P(s) has c·P' = 1, so that wherever t'(s) = 0 the point
//! (P(s), X'(s)) is a zero of Φ: if it stays within `alone_within`, the fold is the only such place.

use super::link::{Frame, Tube};
use super::proof::zero_near;
use crate::interval::rounding::{gamma, greatest, in_range, largest, round_up};
use crate::interval::{around, hull, point};
use crate::linalg::{Inverter, Matrix, Sparse, Vector};
use crate::system::Homotopy;
use crate::track::arc::{Figure, Fold};
use crate::track::full::newton::{End, UNTIL, Until};
use crate::track::full::{Differences, Equations, Lengths};

/// Newton's method is done where corrections are below this, or do not shrink any more.
const ACCURACY: f64 = 1e-15;
/// Where they are below this they shrink no more because of rounding.
const NEAR: f64 = 1e-9;
/// Corrections at most.
const STEPS: usize = 30;
/// A larger one leads nowhere.
const LARGEST_STEP: f64 = 10.0;

/// Work space for proving folds.
#[derive(Debug)]
pub struct FoldProver {
    /// Of the Jacobian: columns of X, of t, of v; rows of F, of J v, of c·v − 1.
    pattern: Sparse,
    inverter: Inverter,
    y: Matrix,
    values: Vec<f64>,
    /// Values of J, and of J(v), in the equations' pattern.
    j: Vec<f64>,
    jv: Vec<f64>,
    d: Differences,
    dv: Differences,
    lengths: Lengths,
    /// X, t and a spare entry; v likewise.
    x: Vector,
    v: Vector,
    room: Vector,
    f: Vector,
    step: Vector,
    bound: Vector,
    ones: Vec<f64>,
    /// q₀ and κ of the last test.
    contraction: (f64, f64),
}

impl FoldProver {
    /// For one problem.
    pub fn new(equations: &Equations) -> Self {
        let m = equations.m;
        let plain = equations.pattern();
        let columns: Vec<Vec<usize>> = (0..2 * m + 1)
            .map(|column| match column {
                k if k < m => plain
                    .rows_of(k)
                    .chain(plain.rows_of(k).map(|e| m + e))
                    .collect(),
                k if k == m => (0..m).collect(),
                k => {
                    let mut rows: Vec<usize> = plain.rows_of(k - m - 1).map(|e| m + e).collect();
                    rows.push(2 * m);
                    rows
                }
            })
            .collect();
        let pattern = Sparse::new(&columns);
        let n = 2 * m + 1;
        FoldProver {
            inverter: Inverter::new(&pattern),
            y: Matrix::zeros(n, n),
            values: vec![0.0; pattern.entries()],
            pattern,
            j: vec![0.0; plain.entries()],
            jv: vec![0.0; plain.entries()],
            d: equations.room(),
            dv: equations.room(),
            lengths: Lengths::new(equations),
            x: equations.vector(),
            v: equations.vector(),
            room: equations.vector(),
            f: Vector::zeros(n),
            step: Vector::zeros(n),
            bound: Vector::zeros(n),
            ones: vec![1.0; n],
            contraction: (f64::NAN, f64::NAN),
        }
    }

    /// Proves a box around the fold near the point `x` (X and t) with the tangent `v`, scaled by c·v = 1.
    /// `None`: no such proof.
    pub fn prove(
        &mut self,
        equations: &Equations,
        homotopy: &Homotopy,
        (x, v): (&[f64], &[f64]),
        normal: &[f64],
    ) -> Option<Fold> {
        let m = equations.m;
        let n = 2 * m + 1;
        let c = &normal[..m];
        self.x.copy_from_slice(x);
        self.v.copy_from_slice(v);
        self.v[m] = 0.0;
        self.look(equations, c);
        self.invert()?;
        let until = Until {
            goal: ACCURACY,
            ratio: 0.5,
            settled: NEAR,
            largest: LARGEST_STEP,
            steps: STEPS,
            ..UNTIL
        };
        let mut is_stale = false;
        let mut state = (&mut *self, &mut is_stale);
        let seen = until.correct(
            &mut state,
            |(prover, is_stale)| {
                if std::mem::take(*is_stale) && prover.invert().is_none() {
                    return f64::NAN;
                }
                prover.residual(equations, c);
                prover.y.multiply(&prover.f[..n], &mut prover.step);
                greatest(&prover.step[..n])
            },
            |(prover, is_stale), ratio| {
                for k in 0..=m {
                    prover.x[k] -= prover.step[k];
                }
                for k in 0..m {
                    prover.v[k] -= prover.step[m + 1 + k];
                }
                prover.look(equations, c);
                // A guess too far away for the matrix that was made there.
                **is_stale = ratio > 0.25;
            },
        );
        if seen.end == End::Away {
            return None;
        }
        self.invert()?;
        self.conclude(equations, homotopy, c)
    }

    /// The Jacobian at (X, t, v).
    fn look(&mut self, equations: &Equations, c: &[f64]) {
        let m = equations.m;
        equations.differences(&self.x, &mut self.d);
        equations.directions(&self.v, &mut self.dv);
        equations.expand_lengths(self.x[m], &mut self.lengths);
        equations.pattern_values(&self.d, &self.lengths.terms[1], &mut self.j);
        equations.pattern_values(&self.dv, &self.lengths.terms[1], &mut self.jv);
        let plain = equations.pattern();
        let mut next = 0;
        let mut put = |value: f64| {
            self.values[next] = value;
            next += 1;
        };
        let mut start = 0;
        for column in 0..m {
            let entries = start..start + plain.entries_of(column);
            self.j[entries.clone()].iter().for_each(|&x| put(x));
            self.jv[entries.clone()].iter().for_each(|&x| put(x));
            start = entries.end;
        }
        self.j[start..].iter().for_each(|&x| put(x));
        let mut start = 0;
        for column in 0..m {
            let entries = start..start + plain.entries_of(column);
            self.j[entries.clone()].iter().for_each(|&x| put(x));
            put(c[column]);
            start = entries.end;
        }
    }

    /// Its approximate inverse.
    fn invert(&mut self) -> Option<()> {
        self.inverter.invert(&self.values, &mut self.y).ok()
    }

    /// Φ in floats.
    fn residual(&mut self, equations: &Equations, c: &[f64]) {
        let m = equations.m;
        equations.residual(&self.d, &self.lengths, &mut self.room);
        self.f[..m].copy_from_slice(&self.room[..m]);
        let (d, dv) = (&self.d, &self.dv);
        equations.jacobian_times(d, &self.lengths, dv, 0.0, &mut self.room);
        self.f[m..2 * m].copy_from_slice(&self.room[..m]);
        let along: f64 = c.iter().zip(&self.v[..m]).map(|(c, v)| c * v).sum();
        self.f[2 * m] = along - 1.0;
    }

    /// The test at the point reached, with the norm max |w_i|: |I − Y Φ'(x + w)| ≤ q₀ + κ |w|.
    fn conclude(&mut self, equations: &Equations, homotopy: &Homotopy, c: &[f64]) -> Option<Fold> {
        let m = equations.m;
        let n = 2 * m + 1;
        // |I − Y Φ'| as computed; the rounding of that product and of the Jacobian's entries, which are
        // differences (one rounding) or sums of them, but for E', of at most twelve.
        self.y
            .identity_minus_sparse_abs(&self.pattern, &self.values, &self.ones, &mut self.step);
        let defect = greatest(&self.step[..n]);
        let t = self.x[m].abs();
        // All entries of a row, twice for those that come from X and from v.
        let per_entry = gamma(equations.roundings().of_entry_at_fold());
        let mut width = Vector::zeros(n);
        for e in 0..m {
            let (size, change) = equations.sizes_at(e, &self.d, 0.0);
            let (size_v, _) = equations.sizes_at(e, &self.dv, 0.0);
            let (slope, slope_radius) = equations.slope_of_length(e, t);
            // |E''| for |t| below this t and 1 more: the box is no wider (`alone_within` ≤ 1).
            let curvature = homotopy.rights[e].enclose_curvature(hull(-t - 1.0, t + 1.0));
            self.bound[e] = per_entry * (size + slope) + slope_radius;
            self.bound[m + e] = per_entry * (size + size_v);
            let roundings = equations.roundings().of_width_at_fold();
            width[e] = round_up(change + curvature.mag(), roundings);
            width[m + e] = round_up(2.0 * change, roundings);
        }
        let normal: f64 = c.iter().map(|c| c.abs()).sum();
        self.bound[2 * m] = per_entry * normal;
        self.y.multiply_abs(&self.bound[..n], &mut self.step);
        let rounding = greatest(&self.step[..n]);
        // The ones of I pass through as many sums as the products that they are added to.
        let q0 = round_up(
            defect + rounding + gamma(n + 4),
            equations.roundings().of_contraction_at_fold(),
        );
        self.y.multiply_abs(&width[..n], &mut self.step);
        let kappa = round_up(greatest(&self.step[..n]), n + 30);
        self.contraction = (q0, kappa);
        if !(q0 < 0.5 && in_range(kappa)) {
            return None;
        }
        self.bound_residual(equations, homotopy, c);
        self.y.multiply_abs(&self.f[..n], &mut self.step);
        let step = &self.step[..n];
        let (alone_within, radius) = zero_near((q0, kappa, 1.0), step, |all| all).ok()?;
        let radius = |k: usize| radius(step[k]);
        let t = around(self.x[m], radius(m));
        Some(Fold {
            figure: Figure::around(self.x[..m].to_vec(), (0..m).map(radius).collect()),
            t,
            velocity: self.v[..m].to_vec(),
            velocity_radius: (0..m).map(|k| radius(m + 1 + k)).collect(),
            normal: c.to_vec(),
            alone_within,
        })
    }

    /// The inverse Y of the last test, with its q₀ and κ.
    #[cfg(test)]
    pub fn test(&self) -> (&Matrix, (f64, f64)) {
        (&self.y, self.contraction)
    }

    /// |Φ| at the point reached, with all that is not known of it, into `f`.
    fn bound_residual(&mut self, equations: &Equations, homotopy: &Homotopy, c: &[f64]) {
        let m = equations.m;
        let t = point(self.x[m]);
        for e in 0..m {
            let (value, moved) = equations.enclose_left(e, &self.x, &self.v);
            self.f[e] = (value - homotopy.rights[e].enclose(t)).mag();
            self.f[m + e] = moved.mag();
        }
        let terms = c.iter().zip(&self.v[..m]);
        let along = terms.fold(point(-1.0), |sum, (&c, &v)| sum + point(c) * point(v));
        self.f[2 * m] = along.mag();
    }
}

/// Proves that between two parameters of a tube, in whose cross-sections it was sought, the fold is the
/// only point with t' = 0 of the path, if it is there at all.
pub fn is_alone<const N: usize, Y: Frame>(
    fold: &Fold,
    tube: &Tube<N, Y>,
    (a, b): (f64, f64),
) -> bool {
    let m = tube.weights.len() - 2;
    let (local, proof) = (&tube.local, &tube.proof);
    let middle = 0.5 * (a + b);
    // From the middle to either end, rounded up.
    let half = round_up(largest(b - middle, middle - a), 4);
    let reach = largest(a.abs(), b.abs());
    let ball_t = (fold.t.mid(), fold.t.rad());
    (0..=m).all(|i| {
        let (mut value, mut slope) = (0.0f64, 0.0f64);
        let (mut size, mut size_of_slope, mut size_of_turn) = (0.0f64, 0.0f64, 0.0f64);
        for k in (0..N).rev() {
            let z = local.z[k][i];
            slope = slope.mul_add(middle, value);
            value = value.mul_add(middle, z);
            size_of_turn = size_of_turn.mul_add(reach, 2.0 * size_of_slope);
            size_of_slope = size_of_slope.mul_add(reach, size);
            size = size.mul_add(reach, z.abs());
        }
        value += local.low[i];
        let rounding = gamma(8 * N);
        let (target, target_radius) = match i {
            i if i == m => ball_t,
            i => (fold.figure.centre[i], fold.figure.radius[i]),
        };
        let away = (value - target).abs()
            + target_radius
            + half * size_of_slope
            + proof.distance * tube.weights[i]
            + rounding * (size + target.abs() + local.low[i].abs());
        // Where t' = 0 the velocity is X', in the entry of t it is none.
        let turned = if i == m {
            0.0
        } else {
            (slope - fold.velocity[i]).abs()
                + fold.velocity_radius[i]
                + half * size_of_turn
                + proof.slope_distance * tube.weights[i]
                + rounding * (size_of_slope + fold.velocity[i].abs())
        };
        // NaN is no proof.
        round_up(away, 8 * N) < fold.alone_within && round_up(turned, 8 * N) < fold.alone_within
    })
}
