//! Krawczyk's test where numbers are anywhere in ranges: each unknown in a unit of its own, as the ranges move one much more than another.

use super::newton::{KNOWN, Square, Zero};
use crate::certificate::cover::alone_within;
use crate::equations::Form;
use crate::interval::rounding::largest;
use crate::interval::{Interval, ZERO, point};

/// How often the units are made anew from what they come to.
const ROUNDS: usize = 3;
/// No unit is less than this part of the largest.
const LEAST: f64 = 1e-6;

impl Square<'_> {
    /// The zero near `own` for all values of the right-hand sides and of known entries, with about the inverse Jacobian `y` there.
    ///
    /// With w = x − c and Y F(c + w) = Y F(c) + Y J(c) w + ½ Y H(w, w), F being quadratic, line i of I − Y J(c + w) is at most q₀ + κ |w| where |w| is
    /// the greatest |wᵢ| / sᵢ, and the test is that of [`alone_within`] in this norm.
    pub(super) fn test_in_ranges(&self, x: &[Interval], own: Vec<f64>, y: &[f64]) -> Option<Zero> {
        let n = self.own.len();
        let is_known = |numbers: &[f64]| numbers.iter().all(|x| x.is_finite());
        if !is_known(y) {
            return None;
        }
        let at = self.with(x, |k| point(own[k]));
        let f: Vec<Interval> = self.rows.iter().map(|row| row.value(&at)).collect();
        let jacobian = self.derivatives(&at);
        let hessians: Vec<Vec<(usize, usize, Interval)>> =
            (0..n).map(|e| self.hessian(e)).collect();
        let mut off = vec![ZERO; n * n];
        let mut moved = vec![0.0; n];
        let mut second = vec![vec![ZERO; n * n]; n];
        for i in 0..n {
            let mut sum = ZERO;
            off[i * n + i] = point(1.0);
            for e in (0..n).filter(|e| y[i * n + e] != 0.0) {
                let by = point(y[i * n + e]);
                sum += by * f[e];
                for j in 0..n {
                    off[i * n + j] -= by * jacobian[e * n + j];
                }
                for &(j, k, h) in &hessians[e] {
                    second[i][j * n + k] += by * h;
                }
            }
            moved[i] = sum.mag();
        }
        let curved = |i: usize, scale: &[f64]| {
            let rows = second[i].chunks(n).zip(scale);
            rows.fold(ZERO, |sum, (row, &one)| {
                let along = row.iter().zip(scale);
                let along = along.fold(ZERO, |sum, (h, &s)| sum + h.abs() * point(s));
                sum + along * point(one)
            })
        };
        let mut scale = moved.clone();
        for round in 0..ROUNDS {
            if !is_known(&scale) {
                return None;
            }
            let most = scale.iter().copied().fold(f64::MIN_POSITIVE, largest);
            scale.iter_mut().for_each(|s| *s = s.max(LEAST * most));
            if round + 1 < ROUNDS {
                scale = (0..n).map(|i| moved[i] + curved(i, &scale).sup()).collect();
            }
        }
        let [mut q0, mut kappa, mut step]: [f64; 3] = [0.0; 3];
        for i in 0..n {
            let unit = point(scale[i]);
            let linear = (0..n).fold(ZERO, |sum, j| sum + off[i * n + j].abs() * point(scale[j]));
            q0 = largest(q0, (linear / unit).sup());
            kappa = largest(kappa, (curved(i, &scale) / unit).sup());
            step = largest(step, (point(moved[i]) / unit).sup());
        }
        let [radius, alone] = alone_within([q0, kappa, step], 1e30)?;
        Some(Zero {
            centre: own,
            radius,
            alone,
            scale,
        })
    }

    /// The second derivatives of an equation by its unknowns: each place and what is added there.
    fn hessian(&self, e: usize) -> Vec<(usize, usize, Interval)> {
        let mut out = Vec::new();
        for p in &self.rows[e].products {
            for (i, a) in self.signed(p.left) {
                for (j, b) in self.signed(p.right) {
                    let by = if a == b { p.factor } else { -p.factor };
                    out.extend([(i, j, by), (j, i, by)]);
                }
            }
        }
        out
    }

    /// The unknowns of a form by their places, and whether they are added.
    fn signed(&self, form: super::system::Form) -> impl Iterator<Item = (usize, bool)> {
        let entries = match form {
            Form::One => None,
            Form::Difference(a, b) => Some([(a, true), (b, false)]),
        };
        let entries = entries.into_iter().flatten();
        entries
            .map(|(entry, is_added)| (self.place[entry], is_added))
            .filter(|(place, _)| *place != KNOWN)
    }
}
