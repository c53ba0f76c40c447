//! The Krawczyk test in extended precision (double-double): for tubes where 53 bits do not suffice.
//!
//! Only F at a point needs more digits: at the middle z₀ of a tube, at its exit, at a solution.
//! Points are then sums of two floats, `high + low`. Jacobians, preconditioners, norms and all higher
//! orders bear relative errors of 2⁻⁵³, as they multiply what is small.

use super::low_orders::LowOrders;
use super::norms::Norms;
use super::tube::{KrawczykTest, norm_of};
use crate::interval::rounding::{gamma, round_up};
use crate::linalg::Vector;
use crate::track::certified::proof::powers_of;
use crate::track::full::{DEGREE, Equations, Local, ORDER};

impl KrawczykTest {
    /// The bounds as they are in the precision of the point. `None`: out of range.
    #[inline(always)]
    pub(in crate::track) fn in_precision(
        &mut self,
        equations: &Equations,
        local: &Local,
        norms: Norms,
    ) -> Option<Norms> {
        let norms = if local.is_extended {
            self.precision.plain = Some(norms);
            let low = self.split_low_orders(equations, local, norms.h);
            Norms { low, ..norms }
        } else {
            norms
        };
        self.precision.last = Some((norms, self.u[equations.m]));
        norms.is_in_range().then_some(norms)
    }

    /// |Y F(ẑ(s))| for |s| ≤ H = `h` as far as it is of orders up to ORDER, and the rounding of all
    /// orders: order 0 as it is in extended precision.
    ///
    /// The other orders are computed from differences and lengths at the middle that carry four roundings
    /// more than in 53 bits: those of double-doubles to floats.
    fn split_low_orders(&mut self, equations: &Equations, local: &Local, h: f64) -> LowOrders {
        let (m, n) = (equations.m, equations.n());
        let hs: [f64; DEGREE + 1] = powers_of(h);
        let z = (&local.z[0][..], &local.low[..]);
        let (constant, rest) = (&mut self.hidden, &mut self.rest);
        let extended = equations.in_extended();
        extended.residual(equations, z, &mut self.coefficient, Some(constant));
        for (constant, f) in constant[..m].iter_mut().zip(self.coefficient.iter()) {
            *constant += f.abs();
        }
        // What t can be along the tube, and Σ k |t_k| sᵏ.
        let t_of = |k: usize| local.z[k][m].abs() * hs[k];
        let t = (0..=ORDER).map(t_of).sum();
        let t_rate: f64 = (1..=ORDER).map(|k| k as f64 * t_of(k)).sum();
        let per_term = gamma(equations.roundings().of_coefficient(ORDER));
        for (e, rest) in rest[..m].iter_mut().enumerate() {
            // Of Σ_k f_k sᵏ in absolute values throughout, Σ_k k f_k sᵏ is the derivative times s; that of
            // ½ (Σ |d_k| sᵏ)² for the differences, of E(Σ |t_k| sᵏ) for the lengths.
            let mut rate = 0.0;
            for axis in 0..equations.dimension() {
                let d_of = |k: usize| local.d[k][axis][e].abs() * hs[k];
                let size: f64 = (0..=ORDER).map(d_of).sum();
                rate += size * (1..=ORDER).map(|k| k as f64 * d_of(k)).sum::<f64>();
            }
            let (slope_size, slope_radius) = equations.slope_of_length(e, t);
            // Either factor of a product of the tail has its rate.
            for (half, [left, right]) in equations.tail.products(e) {
                let d_of = |form: usize, k: usize| local.d[k].forms[form].abs() * hs[k];
                let size = |form| (0..=ORDER).map(|k| d_of(form, k)).sum::<f64>();
                let rate_of = |form| (1..=ORDER).map(|k| k as f64 * d_of(form, k)).sum::<f64>();
                rate += half.abs() * (size(left) * rate_of(right) + size(right) * rate_of(left));
            }
            *rest = per_term * (rate + slope_size * t_rate) + slope_radius * t_rate;
        }
        for k in 1..=2 * ORDER {
            local.coefficient(equations, k, 0, &mut self.coefficient);
            // Higher orders may be multiplied with Y before absolute values are taken: then they are fused
            // sums of m products.
            let share = if k <= ORDER { 1.0 } else { gamma(n + 2) };
            for (rest, c) in rest[..m].iter_mut().zip(self.coefficient.iter()) {
                *rest += share * k as f64 * c.abs() * hs[k];
            }
        }
        let roundings = equations.roundings().of_norm_along();
        let mut bound = |g: &Vector| {
            local.y.multiply_abs(&g[..m], &mut self.v);
            round_up(norm_of(&self.v, &self.u, n), roundings)
        };
        LowOrders::Split {
            constant: bound(&self.hidden),
            rest: bound(&self.rest),
        }
    }
}
