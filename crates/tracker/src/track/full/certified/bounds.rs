//! What a tube's test bounds equation by equation, before the preconditioner makes norms of it.

use super::tube::KrawczykTest;
use crate::interval::rounding::gamma;
use crate::linalg::{LANE, Vector};
use crate::places::{Each as _, array};
use crate::track::full::{DEGREE, Differences, Equations, Local, MAX_DEGREE, ORDER};

/// Bounds by equation along a tube.
#[derive(Debug, Clone)]
pub(super) struct Bounds {
    /// The rounding of the Jacobian's products.
    pub rounding: Vector,
    /// The Jacobian's terms of order ≥ 3 in s.
    pub higher: Vector,
    /// Its change over the width.
    pub width: Vector,
    /// F's orders ≤ ORDER, with all of its rounding.
    pub low: Vector,
    /// F's orders > ORDER + 1.
    pub high: Vector,
}

impl Bounds {
    /// Room for them.
    pub fn new(equations: &Equations) -> Self {
        let vector = || equations.vector();
        Bounds {
            rounding: vector(),
            higher: vector(),
            width: vector(),
            low: vector(),
            high: vector(),
        }
    }
}

impl KrawczykTest {
    /// Makes the bounds. Order ORDER + 1 of F, with its sign, into `f`.
    pub(super) fn bound_equations(
        &mut self,
        equations: &Equations,
        local: &Local,
        hs: &[f64; DEGREE + 1],
        per_entry: f64,
    ) {
        let (m, n) = (equations.m, equations.n());
        let u = &self.u;
        equations.sums(u, &mut self.sums);
        for axis in 0..equations.dimension() {
            let d = std::array::from_fn::<_, { ORDER + 1 }, _>(|k| local.d[k][axis].lanes());
            let (near, far) = (self.near[axis].lanes_mut(), self.far[axis].lanes_mut());
            for l in 0..near.len() {
                for i in 0..LANE {
                    let size = |k: usize| d[k][l][i].abs();
                    near[l][i] = size(0) + (size(1) * hs[1] + size(2) * hs[2]);
                    far[l][i] = (3..=ORDER).fold(0.0, |sum: f64, k| size(k).mul_add(hs[k], sum));
                }
            }
        }
        // What t can be along the tube, and its higher terms.
        let ut = u[m];
        let reach: f64 = (1..=ORDER).map(|k| local.z[k][m].abs() * hs[k]).sum();
        let t = local.z[0][m].abs() + reach;
        let t_higher: f64 = (3..=ORDER).map(|k| local.z[k][m].abs() * hs[k]).sum();
        let of_right = gamma(equations.roundings().of_coefficient(ORDER));
        let bounds = &mut self.bounds;
        let [e0, e1, e2] = equations.e.each_ref().each(|e| e.lanes());
        let [r0, r1, r2] = equations.e_radius.each_ref().each(|r| r.lanes());
        for l in 0..e0.len() {
            let (mut j_near, mut j_far) = ([0.0; LANE], [0.0; LANE]);
            let (mut j_width, mut size) = ([0.0; LANE], [0.0; LANE]);
            for axis in 0..equations.dimension() {
                let of = |vectors: &Differences| vectors[axis].lanes()[l];
                let (sum, near, far) = (of(&self.sums), of(&self.near), of(&self.far));
                for i in 0..LANE {
                    j_near[i] += near[i] * sum[i];
                    j_far[i] += far[i] * sum[i];
                    j_width[i] += sum[i] * sum[i];
                    size[i] += (near[i] + far[i]) * (near[i] + far[i]);
                }
            }
            let [e0, e1, e2] = [e0[l], e1[l], e2[l]].each(|e| e.each(f64::abs));
            let (r0, r1, r2) = (r0[l], r1[l], r2[l]);
            bounds.rounding.lanes_mut()[l] = array(|i| {
                let slope_size = e1[i] + 2.0 * t * e2[i];
                let slope_radius = r1[i] + 2.0 * t * r2[i];
                per_entry * (j_near[i] + slope_size * ut) + slope_radius * ut
            });
            bounds.higher.lanes_mut()[l] = array(|i| j_far[i] + 2.0 * e2[i] * t_higher * ut);
            bounds.width.lanes_mut()[l] = array(|i| j_width[i] + 2.0 * (e2[i] + r2[i]) * (ut * ut));
            bounds.low.lanes_mut()[l] = array(|i| {
                let length_size = e0[i] + t * (e1[i] + t * e2[i]);
                let length_radius = r0[i] + t * (r1[i] + t * r2[i]);
                of_right * (size[i] + length_size) + length_radius
            });
        }
        for b in 0..equations.bends.len() {
            self.bound_bend(b, local, equations, (t, ut), hs, per_entry);
        }
        if !equations.tail.is_empty() {
            self.bound_tail(equations, local, hs, per_entry);
        }

        // The coefficients of F along the tube.
        let Bounds { low, high, .. } = &mut self.bounds;
        high.fill(0.0);
        for k in 0..=2 * ORDER {
            if k == ORDER + 1 {
                local.coefficient(equations, k, 0, &mut self.f);
                continue;
            }
            local.coefficient(equations, k, 0, &mut self.coefficient);
            // With k/(ORDER + 2) ≥ 1 above, so that it bounds the derivative by s too, see `proof`.
            let (sum, factor) = if k <= ORDER {
                (&mut *low, hs[k])
            } else {
                (&mut *high, hs[k] * (k as f64 / (ORDER + 2) as f64))
            };
            for (sum, c) in sum.lanes_mut().iter_mut().zip(self.coefficient.lanes()) {
                for i in 0..LANE {
                    sum[i] = c[i].abs().mul_add(factor, sum[i]);
                }
            }
        }
        for (b, bend) in equations.bends.iter().enumerate() {
            let beyond = 2 * ORDER + 1..=DEGREE;
            high[bend.edge] += beyond
                .map(|k| {
                    local.bend_excess(equations, b, k).abs()
                        * hs[k]
                        * (k as f64 / (ORDER + 2) as f64)
                })
                .sum::<f64>();
        }
        // Rounding in Y f_{ORDER + 1}, a fused sum of m products; relative to its terms.
        for (low, f) in low[..m].iter_mut().zip(self.f.iter()) {
            *low += gamma(n + 2) * f.abs() * hs[ORDER + 1];
        }
        let rounding = &mut self.bounds.rounding;
        let normal: f64 = local.normal[..n]
            .iter()
            .zip(&self.u[..n])
            .map(|(c, u)| c.abs() * u)
            .sum();
        rounding[m] = per_entry * normal;
    }

    /// Adds to the bounds what the tail's products bring: as for distances, whose two factors are alike.
    fn bound_tail(
        &mut self,
        equations: &Equations,
        local: &Local,
        hs: &[f64; DEGREE + 1],
        per_entry: f64,
    ) {
        let tail = &equations.tail;
        let per_term = gamma(equations.roundings().of_coefficient(ORDER));
        let bounds = &mut self.bounds;
        let lanes = local.d[0].forms.lanes().len();
        let forms: [_; ORDER + 1] = array(|k| &local.d[k].forms.lanes()[..lanes]);
        let (near, far) = (&mut self.near.forms, &mut self.far.forms);
        near.set_lanes(tail, |lane| {
            let size = |k: usize, i: usize| forms[k][lane][i].abs() * hs[k];
            array(|i| size(0, i) + size(1, i) + size(2, i))
        });
        far.set_lanes(tail, |lane| {
            let size = |k: usize, i: usize| forms[k][lane][i].abs() * hs[k];
            array(|i| (3..=ORDER).fold(0.0, |sum: f64, k| sum + size(k, i)))
        });
        let sums = &self.sums.forms;
        // |J_k| u and |J'(w)| u: either factor changes while the other is there.
        tail.add_products_abs(per_entry, near, sums, &mut bounds.rounding);
        tail.add_products_abs(1.0, far, sums, &mut bounds.higher);
        tail.add_products_abs(1.0, sums, sums, &mut bounds.width);
        let coefficients = &mut self.tail_sizes;
        let (near, far) = (near.lanes(), far.lanes());
        coefficients.set_lanes(tail, |lane| array(|i| near[lane][i] + far[lane][i]));
        tail.add_squares_abs(2.0 * per_term, coefficients, &mut bounds.low);
    }

    /// Adds to the bounds of an equation of degree 4 in t what its terms of degree > 2 in t bring.
    fn bound_bend(
        &mut self,
        b: usize,
        local: &Local,
        equations: &Equations,
        (t, ut): (f64, f64),
        hs: &[f64; DEGREE + 1],
        per_entry: f64,
    ) {
        let bounds = &mut self.bounds;
        let bend = &equations.bends[b];
        let (e, r, at) = (bend.e.each(f64::abs), &bend.e_radius, bend.edge);
        let cube = t * t * t;
        let of_right = gamma(equations.roundings().of_coefficient(ORDER));
        bounds.low[at] += of_right * (cube * (e[3] + t * e[4])) + cube * (r[3] + t * r[4]);
        let slope_size = t * t * (3.0 * e[3] + 4.0 * t * e[4]);
        let slope_radius = t * t * (3.0 * r[3] + 4.0 * t * r[4]);
        bounds.rounding[at] += per_entry * slope_size * ut + slope_radius * ut;
        // The width may add its share to t: |w_t| ≤ r u_t ≤ 1, as `proof` takes care.
        let wide = t + 1.0;
        bounds.width[at] += wide * (6.0 * (e[3] + r[3]) + 12.0 * wide * (e[4] + r[4])) * (ut * ut);
        // All of the bend's terms, though the ones of e₂ are counted already.
        let terms: f64 = (3..=(MAX_DEGREE - 1) * ORDER)
            .map(|k| local.bend_slope(b, k).abs() * hs[k])
            .sum();
        bounds.higher[at] += terms * ut;
    }
}
