//! How far F and J v may be from what is computed of them.

use super::{Bend, Differences, Equations};
use crate::interval::rounding::{gamma, round_up};
use crate::interval::{Interval, point};
use crate::linalg::{LANE, Vector};
use crate::places::Each as _;
use crate::track::full::Tail;

impl Equations {
    /// The left-hand side of an equation at a point of floats, and its derivative along another, in intervals.
    pub fn enclose_left(&self, e: usize, z: &[f64], along: &[f64]) -> (Interval, Interval) {
        let (mut squared, mut moved) = (point(0.0), point(0.0));
        for ends in &self.ends {
            let [i, j] = ends[e].each(|end| end as usize);
            let d = point(z[i]) - point(z[j]);
            squared += d.sqr();
            moved += d * (point(along[i]) - point(along[j]));
        }
        // The number 1 does not move.
        let form = |form: usize, z: &[f64], one: f64| match form {
            Tail::ONE => point(one),
            _ => {
                let [i, j] = self.tail.ends(form).each(|end| point(z[end]));
                i - j
            }
        };
        let mut value = squared * point(0.5);
        for (half, forms) in self.tail.products(e) {
            let [l, r] = forms.each(|k| form(k, z, 1.0));
            let [dl, dr] = forms.each(|k| form(k, along, 0.0));
            value += point(half) * l * r;
            moved += point(half) * (l * dr + dl * r);
        }
        (value, moved)
    }

    /// Of an equation at a point with these differences: `from` and the sizes of all parts of its derivative by X together,
    /// and how much these change at most per |w|, the largest change of an unknown.
    pub fn sizes_at(&self, e: usize, d: &Differences, from: f64) -> (f64, f64) {
        let is_free = |end: usize| (end < self.m) as usize as f64;
        let (mut size, mut change) = (from, 0.0);
        for (ends, d) in self.ends.iter().zip(&d.axes) {
            let free = ends[e].each(|end| is_free(end as usize));
            let free = free[0] + free[1];
            size += d[e].abs() * free;
            // |w_i − w_j| times the row sum of the entry's two columns.
            change += free * free;
        }
        for (half, forms) in self.tail.products(e) {
            // The same for a product of two factors.
            let free = forms.each(|form| self.tail.ends(form).each(is_free));
            let [left, right] = free.each(|ends| ends[0] + ends[1]);
            let [l, r] = forms.each(|form| d.forms[form].abs());
            size += half.abs() * (l * right + r * left);
            change += 2.0 * half.abs() * left * right;
        }
        (size, change)
    }

    /// How far F may be from the value that [`Equations::residual`] computes: rounding and the
    /// radii of the coefficients.
    pub fn residual_error(&self, d: &Differences, t: f64, out: &mut Vector) {
        let t = t.abs();
        let count = self.roundings();
        let (per_term, roundings) = (gamma(count.of_residual()), count.of_residual_bound());
        let [e0, e1, e2] = self.e.each_ref().each(|e| e.lanes());
        let [r0, r1, r2] = self.e_radius.each_ref().each(|r| r.lanes());
        let lanes = out.lanes_mut().iter_mut().take(e0.len());
        for (l, out) in lanes.enumerate() {
            let squared = d.lane_of_products(d, l);
            for k in 0..LANE {
                let size = e0[l][k].abs() + t * (e1[l][k].abs() + t * e2[l][k].abs());
                let radius = r0[l][k] + t * (r1[l][k] + t * r2[l][k]);
                out[k] = round_up(per_term * (0.5 * squared[k] + size) + radius, roundings);
            }
        }
        let cube = t * t * t;
        for bend in &self.bends {
            let (c, r) = (&bend.e, &bend.e_radius);
            let size = cube * (c[3].abs() + t * c[4].abs());
            let radius = cube * (r[3] + t * r[4]);
            let more = per_term * size + radius;
            out[bend.edge] = round_up(out[bend.edge] + more, roundings);
        }
        for e in self.tail.first()..self.m {
            let size = self.tail.half_products_abs(e, &d.forms, &d.forms);
            out[e] = round_up(out[e] + per_term * size, count.of_product_bound());
        }
    }

    /// How far J v may be from what [`Equations::jacobian_times`] computes, J being taken anywhere
    /// within the given radii (as differences' sums, and of t) of the point.
    pub fn jacobian_times_error(
        &self,
        (d, t): (&Differences, f64),
        (spread, t_radius): (&Differences, f64),
        (dv, vt): (&Differences, f64),
        out: &mut [f64],
    ) {
        let (t, vt) = (t.abs() + t_radius, vt.abs());
        let count = self.roundings();
        let per_term = gamma(count.of_jacobian_times());
        for (e, out) in out[..self.m].iter_mut().enumerate() {
            let (mut size, mut moved) = (0.0, 0.0);
            for axis in 0..self.dimension() {
                size += (d[axis][e] * dv[axis][e]).abs();
                moved += spread[axis][e] * dv[axis][e].abs();
            }
            if !self.tail.is_empty() {
                let both = |a, b| self.tail.half_products_abs(e, a, b);
                let of_v = &dv.forms;
                size += both(&d.forms, of_v) + both(of_v, &d.forms);
                moved += both(&spread.forms, of_v) + both(of_v, &spread.forms);
            }
            let (slope_size, slope_radius) = self.slope_of_length(e, t);
            let mut curvature = 2.0 * (self.e[2][e].abs() + self.e_radius[2][e]);
            if let Some(bend) = self.bend_of(e) {
                let (c, r) = (bend.e.each(f64::abs), &bend.e_radius);
                curvature += t * (6.0 * (c[3] + r[3]) + 12.0 * t * (c[4] + r[4]));
            }
            let time = slope_radius + curvature * t_radius;
            let bound = per_term * (size + slope_size * vt) + moved + time * vt;
            *out = round_up(bound, count.of_jacobian_times_bound());
        }
    }

    /// Σ j |e_j| tʲ⁻¹ of E's coefficients e_j for one distance, and of their radii, for t ≥ 0: bounds on
    /// E' at |t|, and on how far it may be from that of the coefficients. At most twelve roundings.
    pub fn slope_of_length(&self, edge: usize, t: f64) -> (f64, f64) {
        let slope = |e: [f64; 5]| {
            let [_, e1, e2, e3, e4] = e.each(f64::abs);
            e1 + t * (2.0 * e2 + t * (3.0 * e3 + t * (4.0 * e4)))
        };
        if let Some(bend) = self.bend_of(edge) {
            (slope(bend.e), slope(bend.e_radius))
        } else {
            let of = |c: &[Vector; 3]| [c[0][edge], c[1][edge], c[2][edge], 0.0, 0.0];
            (slope(of(&self.e)), slope(of(&self.e_radius)))
        }
    }

    /// What an equation has beyond degree 2 in t.
    #[inline(always)]
    fn bend_of(&self, equation: usize) -> Option<&Bend> {
        // They are in order.
        let found = self.bends.binary_search_by_key(&equation, |bend| bend.edge);
        found.ok().map(|b| &self.bends[b])
    }
}
