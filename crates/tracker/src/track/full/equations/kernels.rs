//! F, and J v, in floats.

use super::{Differences, Equations, Lengths};
use crate::linalg::{LANE, Vector};
use crate::places::Each as _;

impl Equations {
    /// p_i − p_j for the point `z`, per axis and distance, and the tail's forms.
    #[inline(always)]
    pub fn differences(&self, z: &[f64], out: &mut Differences) {
        self.head_differences(z, out);
        if !self.tail.is_empty() {
            self.tail.differences(z, 1.0, &mut out.forms);
        }
    }

    /// v_i − v_j for a direction `v`, per axis and distance, and the tail's forms: the one that is the number 1 at
    /// every point is zero, as it does not change along `v`.
    #[inline(always)]
    pub fn directions(&self, v: &[f64], out: &mut Differences) {
        self.head_differences(v, out);
        if !self.tail.is_empty() {
            self.tail.differences(v, 0.0, &mut out.forms);
        }
    }

    #[inline(always)]
    fn head_differences(&self, v: &[f64], out: &mut Differences) {
        for (ends, out) in self.ends.iter().zip(&mut out.axes) {
            for (&[i, j], d) in ends.iter().zip(out.iter_mut()) {
                *d = v[i as usize] - v[j as usize];
            }
        }
    }

    /// z_i + z_j likewise, for sizes of directions.
    pub fn sums(&self, z: &[f64], out: &mut Differences) {
        for (ends, out) in self.ends.iter().zip(&mut out.axes) {
            for (&[i, j], d) in ends.iter().zip(out.iter_mut()) {
                *d = z[i as usize] + z[j as usize];
            }
        }
        if !self.tail.is_empty() {
            self.tail.sums(z, &mut out.forms);
        }
    }

    /// The Taylor coefficients E⁽ʲ⁾(t)/j!: for all distances up to j = 2, for the bend to j = 4.
    #[inline(always)]
    pub fn expand_lengths(&self, t: f64, out: &mut Lengths) {
        let [e0, e1, e2] = self.e.each_ref().each(|e| e.lanes());
        let [t0, t1] = &mut out.terms;
        let (t0, t1) = (t0.lanes_mut(), t1.lanes_mut());
        for l in 0..e0.len() {
            for k in 0..LANE {
                let slope = e2[l][k] * t;
                t0[l][k] = t.mul_add(e1[l][k] + slope, e0[l][k]);
                t1[l][k] = 2.0f64.mul_add(slope, e1[l][k]);
            }
        }
        // Other right-hand sides may have another number of them: an edit of two lengths and of the angle between them.
        out.bends.resize(self.bends.len(), [0.0; 5]);
        for (bend, out_of_bend) in self.bends.iter().zip(&mut out.bends) {
            let e = &bend.e;
            let e4t = e[4] * t;
            *out_of_bend = [
                e[0] + t * (e[1] + t * (e[2] + t * (e[3] + e4t))),
                e[1] + t * (2.0 * e[2] + t * (3.0 * e[3] + 4.0 * e4t)),
                e[2] + t * (3.0 * e[3] + 6.0 * e4t),
                e[3] + 4.0 * e4t,
                e[4],
            ];
            out.terms[0][bend.edge] = out_of_bend[0];
            out.terms[1][bend.edge] = out_of_bend[1];
        }
    }

    /// F from differences and lengths.
    #[inline(always)]
    pub fn residual(&self, differences: &Differences, lengths: &Lengths, out: &mut Vector) {
        let t0 = lengths.terms[0].lanes();
        let lanes = out.lanes_mut();
        for l in 0..t0.len() {
            let squared = differences.lane_of_products(differences, l);
            for k in 0..LANE {
                lanes[l][k] = 0.5f64.mul_add(squared[k], -t0[l][k]);
            }
        }
        if !self.tail.is_empty() {
            self.tail.add_squares(&differences.forms, out);
        }
    }

    /// F at the point z, or z + low in extended precision if there is a `low`, and if wanted how far the exact
    /// value may be from that. `at` is work space: in 53 bits the point's differences and lengths.
    #[inline(always)]
    pub fn residual_at(
        &self,
        (z, low): (&[f64], Option<&[f64]>),
        (d, lengths): (&mut Differences, &mut Lengths),
        f: &mut Vector,
        error: Option<&mut Vector>,
    ) {
        if let Some(low) = low {
            return self.in_extended().residual(self, (z, low), f, error);
        }
        self.differences(z, d);
        self.expand_lengths(z[self.m], lengths);
        self.residual(d, lengths, f);
        if let Some(error) = error {
            self.residual_error(d, z[self.m], error);
        }
    }

    /// J v at the given differences and lengths, `dv` being the differences of v and `vt` its t.
    pub fn jacobian_times(
        &self,
        d: &Differences,
        lengths: &Lengths,
        dv: &Differences,
        vt: f64,
        out: &mut [f64],
    ) {
        for (e, out) in out[..self.m].iter_mut().enumerate() {
            let product: f64 = d.iter().zip(&dv.axes).map(|(d, dv)| d[e] * dv[e]).sum();
            *out = product - lengths.terms[1][e] * vt;
        }
        if !self.tail.is_empty() {
            self.tail.add_products(1.0, &d.forms, &dv.forms, out);
        }
    }
}
