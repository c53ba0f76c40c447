//! Where the path leaves a tube.

use super::tube::{KrawczykTest, norm_of};
use crate::interval::rounding::{gamma, round_up};
use crate::linalg::{Vector, dot};
use crate::places::array;
use crate::track::certified::link::{Ball, Tube, from_middle};
use crate::track::certified::proof::Proof;
use crate::track::full::newton::{UNTIL, Until};
use crate::track::full::{Equations, Local, shift};

/// Corrections with a proved tube's preconditioner, which shrink as far as precision goes.
fn until(goal: f64) -> Until {
    Until {
        goal,
        // Those that shrink by less are at the limit of floats.
        ratio: 0.98,
        // More than enough where the contraction is that of a proved tube.
        steps: 200,
        ..UNTIL
    }
}

impl KrawczykTest {
    /// Encloses the path's tangent T at the exit, c·T = 1, into `tube.exit_slope`; returns its
    /// radius in |·|_u. The bound over the whole tube can be too wide where the next is narrow.
    ///
    /// T solves [J(P); c] T = e_n. As |I − Ỹ [J(P); c]|_u ≤ q for the path's point P, which is in the
    /// tube, the solution is at most |Ỹ([J(P); c] v − e_n)|_u / (1 − q) from any v.
    pub(super) fn enclose_tangent(&mut self, equations: &Equations, tube: &mut Tube) -> f64 {
        let (m, n) = (equations.m, equations.n());
        let (local, proof, u, s) = (&tube.local, &tube.proof, &tube.weights, tube.exit_at);
        let (exit, v) = (&tube.exit, &mut tube.exit_slope);
        let c = &local.normal[..n];
        // Differences at the exit, of v, and sums of the exit's radii.
        if exit.is_extended() {
            let z = (&exit.centre[..], &exit.low[..]);
            let extended = equations.in_extended();
            extended.differences(equations, z, &mut self.near);
        } else {
            equations.differences(&exit.centre, &mut self.near);
        }
        equations.sums(&exit.radius, &mut self.sums);
        equations.expand_lengths(exit.centre[m], &mut self.lengths);
        local.slope(s, v);
        let until = Until {
            makes_last: false,
            ..until(0.0)
        };
        until.correct(
            &mut (&mut *self, &mut *v),
            |(test, v)| {
                test.tangent_defect(equations, v, c);
                local.y.multiply(&test.f[..n], &mut test.v);
                norm_of(&test.v, u, n)
            },
            |(test, v), _| {
                test.a.multiply(&test.v[..n], &mut test.f);
                for i in 0..n {
                    v[i] -= test.v[i] - s * test.f[i];
                }
            },
        );
        // The defect of the v reached, with what rounding and the exit's radius may hide of it.
        self.tangent_defect(equations, v, c);
        let hidden = &mut self.hidden;
        // The lengths are those at the upper word of t.
        let radius_of_t = round_up(exit.radius[m] + exit.low[m].abs(), 1);
        equations.jacobian_times_error(
            (&self.near, exit.centre[m]),
            (&self.sums, radius_of_t),
            (&self.far, v[m]),
            hidden,
        );
        let size: f64 = c.iter().zip(&v[..n]).map(|(c, v)| (c * v).abs()).sum();
        hidden[m] = round_up(gamma(n + 4) * (size + 1.0), n + 4);
        self.radius_from_defect(local, proof, u, s)
    }

    /// [J; c] v − e_n in floats, into `f`, J being that of the differences `near` and the lengths at hand.
    fn tangent_defect(&mut self, equations: &Equations, v: &Vector, c: &[f64]) {
        let (m, n) = (equations.m, equations.n());
        equations.directions(v, &mut self.far);
        equations.jacobian_times(&self.near, &self.lengths, &self.far, v[m], &mut self.f);
        self.f[m] = dot(c, &v[..n]) - 1.0;
    }

    /// A bound on |Ỹ(s) g|_u / (1 − q) for any g within `hidden` of `f`, entry by entry.
    pub(in crate::track) fn radius_from_defect(
        &mut self,
        local: &Local,
        proof: &Proof,
        u: &Vector,
        s: f64,
    ) -> f64 {
        let n = u.len() - 1;
        let hidden = &mut self.hidden;
        for i in 0..n {
            // Rounding in Y f, fused sums of n products.
            hidden[i] += gamma(n + 2) * self.f[i].abs();
        }
        local.y.multiply(&self.f[..n], &mut self.v);
        let computed = norm_of(&self.v, u, n);
        local.y.multiply_abs(&hidden[..n], &mut self.v);
        let hidden = norm_of(&self.v, u, n);
        let moving = 1.0 + s.abs() * proof.moving;
        let defect = round_up((computed + hidden) * moving, 2 * n + 20);
        round_up(defect / (1.0 - proof.q), 400)
    }

    /// A few steps w ← w − Ỹ(s) G_s(w), until they are below `accuracy` times r or do not shrink
    /// any more. As that map is a contraction by q, the zero is at most |Ỹ(s) G_s(w)|_u / (1 − q)
    /// from any w in the box. The test must have the A of the tube.
    pub(super) fn enclose(
        &mut self,
        equations: &Equations,
        tube: &mut Tube,
        accuracy: f64,
    ) -> Option<()> {
        let extended = self.precision.extended || tube.local.is_extended;
        let (m, n) = (equations.m, equations.n());
        let (local, proof, u, s) = (&tube.local, &tube.proof, &tube.weights, tube.exit_at);
        let out = &mut tube.exit;
        // It could be anywhere until it is proved.
        out.radius[..n].fill(f64::INFINITY);
        local.at(s, &mut out.centre);
        out.low.fill(0.0);
        until(accuracy * proof.r).correct(
            &mut (&mut *self, &mut *out),
            |(test, out)| {
                test.residual_at(equations, out, extended, false);
                let rows = if extended {
                    // ẑ(s) was rounded to floats: that may have moved it out of the cross-section.
                    test.f[m] = from_middle(local, &u[..n], s, out, |_| 0.0).0;
                    n
                } else {
                    m
                };
                local.y.multiply(&test.f[..rows], &mut test.v);
                test.a.multiply(&test.v[..n], &mut test.f);
                // Beyond n all of these are zero.
                for (v, f) in test.v.lanes_mut().iter_mut().zip(test.f.lanes()) {
                    let step = *v;
                    *v = array(|i| step[i] - s * f[i]);
                }
                norm_of(&test.v, u, n)
            },
            |(test, out), _| {
                if extended {
                    let v = &test.v;
                    return shift(&mut out.centre[..n], &mut out.low[..n], |i| -v[i]);
                }
                for (centre, v) in out.centre.lanes_mut().iter_mut().zip(test.v.lanes()) {
                    let from = *centre;
                    *centre = array(|i| from[i] - v[i]);
                }
            },
        );
        debug_assert!(out.centre[n] == 0.0 || out.centre[n].is_nan());
        // The defect at the point reached, with what rounding may hide of it.
        self.residual_at(equations, out, extended, true);
        self.conclude(tube)
    }

    /// F at the middle of a box, into `f`, and if wanted how far the exact value may be, into `hidden`.
    #[inline(always)]
    fn residual_at(&mut self, equations: &Equations, at: &Ball, extended: bool, with_error: bool) {
        equations.residual_at(
            (&at.centre, extended.then_some(&at.low[..])),
            (&mut self.near, &mut self.lengths),
            &mut self.f,
            with_error.then_some(&mut self.hidden),
        );
    }

    /// Encloses the path's point at the exit, F at the middle of whose box, `f`, is known up to `hidden`.
    fn conclude(&mut self, tube: &mut Tube) -> Option<()> {
        let (local, proof, u, s) = (&tube.local, &tube.proof, &tube.weights, tube.exit_at);
        let n = u.len() - 1;
        let (along, error, extent) = from_middle(local, &u[..n], s, &tube.exit, |_| 0.0);
        // The last equation is that of the cross-section.
        self.f[n - 1] = along;
        self.hidden[n - 1] = error;
        let radius = self.radius_from_defect(local, proof, u, s);
        tube.hold_exit(extent, radius)
    }
}
