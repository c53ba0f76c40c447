//! H(X, t) laid out for the inner loops: one vector over all equations for each quantity.
//!
//! Distances are the *head*: their differences stand in lanes, one vector for each axis. All other
//! equations are the *tail*, a list of products of differences (`tail.rs`). Equations of the tail have a place
//! in the head's vectors too, where their differences are zero, so that one loop serves the right-hand sides
//! of all; what the tail adds costs one branch where there is none.

use super::extended::Extended;
use super::preconditioner::InverseMaker;
use super::tail::{Forms, Tail};
use crate::interval::rounding::{gamma, round_up};
use crate::linalg::{Inverter, LANE, Sparse, Vector};
use crate::system::Homotopy;
use std::ops::{Deref, DerefMut};

pub use crate::constraint::MAX_DEGREE;

/// E(t) of an equation in which it is of degree 4, as for a distance that bends.
#[derive(Debug, Clone, Copy)]
pub struct Bend {
    /// Which equation.
    pub edge: usize,
    /// The coefficients of E.
    pub e: [f64; 5],
    /// How far the exact ones may be away.
    pub e_radius: [f64; 5],
}

/// The m equations in n = m + 1 unknowns, t last, of a problem in D dimensions.
///
/// A vector of unknowns has a spare entry n more, always zero, from which fixed coordinates are read.
#[derive(Debug, Clone)]
pub struct Equations<const D: usize> {
    /// The number m of equations.
    pub m: usize,
    /// The entries of z for either point's coordinates, per axis and distance; for other equations the spare
    /// one.
    pub ends: [Vec<[u32; 2]>; D],
    /// The equations that are no distances.
    pub tail: Tail,
    /// The coefficients of E up to t², per equation (those of degree 4 too), and their radii.
    pub e: [Vector; 3],
    /// See `e`.
    pub e_radius: [Vector; 3],
    /// The equations with an E of degree 4: the distance that bends, if there is one, and more in the tail.
    pub bends: Vec<Bend>,
    /// The lengths in extended precision, once that was asked for.
    extended: Option<Box<Extended>>,
    /// The pattern of a derivative of the Jacobian.
    pattern: Sparse,
    /// The pattern of the Jacobian with the normal for its last row.
    bordered: Sparse,
    /// For each axis, which entries of these its differences are.
    sources: [Vec<Source>; D],
}

/// An entry that is a difference, or minus one.
#[derive(Debug, Clone, Copy)]
struct Source {
    edge: u32,
    /// Its place among the values of the pattern, and of the bordered one.
    plain: u32,
    bordered: u32,
    sign: f64,
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
        let ends: [Vec<[u32; 2]>; D] = std::array::from_fn(|axis| {
            homotopy
                .half_squares()
                .map(|edge| edge.points.map(|p| entry(p, axis) as u32))
                .collect()
        });
        let ends = ends.map(|mut ends| {
            ends.resize(m, [m as u32 + 1; 2]);
            ends
        });
        let rights = &homotopy.rights;
        let coefficient = |pick: &dyn Fn(usize) -> f64| {
            let mut out = Vector::zeros(m);
            (0..m).for_each(|e| out[e] = pick(e));
            out
        };
        let mut tail = Tail::new(homotopy);
        // The edges of each column's entries, with axes and signs.
        let mut columns = vec![Vec::new(); m];
        for axis in 0..D {
            for (edge, &end) in ends[axis].iter().enumerate() {
                for (end, sign) in end.into_iter().zip([1.0, -1.0]) {
                    if (end as usize) < m {
                        columns[end as usize].push((edge, axis, sign));
                    }
                }
            }
        }
        let mut sources: [Vec<Source>; D] = std::array::from_fn(|_| Vec::new());
        let mut plain = 0;
        for (column, entries) in columns.iter().enumerate() {
            for &(edge, axis, sign) in entries {
                sources[axis].push(Source {
                    edge: edge as u32,
                    plain,
                    // The normal has one entry in each column before.
                    bordered: plain + column as u32,
                    sign,
                });
                plain += 1;
            }
            plain += tail.place_column(column, plain);
        }
        let rows = |(column, entries): (usize, &Vec<(usize, usize, f64)>)| {
            let head = entries.iter().map(|entry| entry.0);
            head.chain(tail.rows_of_column(column)).collect()
        };
        let mut plain: Vec<Vec<usize>> = columns.iter().enumerate().map(rows).collect();
        plain.push((0..m).collect());
        let bordered: Vec<Vec<usize>> = plain
            .iter()
            .map(|column| column.iter().copied().chain([m]).collect())
            .collect();
        Equations {
            m,
            ends,
            e: std::array::from_fn(|k| coefficient(&|e| rights[e].e[k])),
            e_radius: std::array::from_fn(|k| coefficient(&|e| rights[e].e_radius[k])),
            bends: bends(homotopy).collect(),
            tail,
            extended: None,
            pattern: Sparse::new(&plain),
            bordered: Sparse::new(&bordered),
            sources,
        }
    }

    /// Takes the right-hand sides of another homotopy of the same equations, with no more of degree 4 than
    /// there were at first.
    pub fn set_rights(&mut self, homotopy: &Homotopy) {
        let rights = &homotopy.rights;
        for k in 0..3 {
            for (e, right) in rights.iter().enumerate() {
                self.e[k][e] = right.e[k];
                self.e_radius[k][e] = right.e_radius[k];
            }
        }
        self.bends.clear();
        self.bends.extend(bends(homotopy));
        self.extended = None;
    }

    /// Makes room for extended precision.
    pub fn extend(&mut self, homotopy: &Homotopy) {
        if self.extended.is_none() {
            self.extended = Some(Box::new(Extended::new(homotopy)));
        }
    }

    /// F in extended precision.
    ///
    /// # Panics
    /// If [`Equations::extend`] was not called before.
    pub fn in_extended(&self) -> &Extended {
        self.extended.as_deref().expect("extended precision")
    }

    /// F in extended precision, to be written on by tests that put errors into it.
    ///
    /// # Panics
    /// If [`Equations::extend`] was not called before.
    #[cfg(test)]
    pub fn in_extended_mut(&mut self) -> &mut Extended {
        self.extended.as_deref_mut().expect("extended precision")
    }

    /// The number n of unknowns.
    pub fn n(&self) -> usize {
        self.m + 1
    }

    /// A vector of n unknowns and the spare entry.
    pub fn vector(&self) -> Vector {
        Vector::zeros(self.m + 2)
    }

    /// A vector of one entry per distance.
    pub fn per_edge(&self) -> Vector {
        Vector::zeros(self.m)
    }

    /// Room for the differences of a vector of unknowns.
    pub fn room(&self) -> Differences<D> {
        Differences {
            axes: std::array::from_fn(|_| self.per_edge()),
            forms: Forms::new(&self.tail),
        }
    }

    /// p_i − p_j for the point `z`, per axis and distance, and the tail's forms.
    #[inline(always)]
    pub fn differences(&self, z: &[f64], out: &mut Differences<D>) {
        self.head_differences(z, out);
        if !self.tail.is_empty() {
            self.tail.differences(z, 1.0, &mut out.forms);
        }
    }

    /// v_i − v_j for a direction `v`, per axis and distance, and the tail's forms: the one that is the number 1 at
    /// every point is zero, as it does not change along `v`.
    #[inline(always)]
    pub fn directions(&self, v: &[f64], out: &mut Differences<D>) {
        self.head_differences(v, out);
        if !self.tail.is_empty() {
            self.tail.differences(v, 0.0, &mut out.forms);
        }
    }

    #[inline(always)]
    fn head_differences(&self, v: &[f64], out: &mut Differences<D>) {
        for (ends, out) in self.ends.iter().zip(&mut out.axes) {
            for (&[i, j], d) in ends.iter().zip(out.iter_mut()) {
                *d = v[i as usize] - v[j as usize];
            }
        }
    }

    /// z_i + z_j likewise, for sizes of directions.
    pub fn sums(&self, z: &[f64], out: &mut Differences<D>) {
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
        let [e0, e1, e2] = self.e.each_ref().map(|e| e.lanes());
        let [t0, t1] = &mut out.terms;
        let (t0, t1) = (t0.lanes_mut(), t1.lanes_mut());
        for l in 0..e0.len() {
            for k in 0..LANE {
                let slope = e2[l][k] * t;
                t0[l][k] = t.mul_add(e1[l][k] + slope, e0[l][k]);
                t1[l][k] = 2.0f64.mul_add(slope, e1[l][k]);
            }
        }
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
    pub fn residual(&self, differences: &Differences<D>, lengths: &Lengths, out: &mut Vector) {
        let d = differences.each_ref().map(|d| d.lanes());
        let t0 = lengths.terms[0].lanes();
        let lanes = out.lanes_mut();
        for l in 0..t0.len() {
            for k in 0..LANE {
                let squared: f64 = (0..D).map(|axis| d[axis][l][k] * d[axis][l][k]).sum();
                lanes[l][k] = 0.5f64.mul_add(squared, -t0[l][k]);
            }
        }
        if !self.tail.is_empty() {
            self.tail.add_squares(&differences.forms, out);
        }
    }

    /// How far F may be from the value that [`Equations::residual`] computes: rounding and the
    /// radii of the coefficients. No term of a distance goes through more than 20 roundings.
    pub fn residual_error(&self, d: &Differences<D>, t: f64, out: &mut Vector) {
        let t = t.abs();
        let (per_term, roundings) = (gamma(self.roundings(20)), self.roundings(24));
        let axes = d.each_ref().map(|d| d.lanes());
        let [e0, e1, e2] = self.e.each_ref().map(|e| e.lanes());
        let [r0, r1, r2] = self.e_radius.each_ref().map(|r| r.lanes());
        let lanes = out.lanes_mut().iter_mut().take(e0.len());
        for (l, out) in lanes.enumerate() {
            for k in 0..LANE {
                let squared: f64 = (0..D).map(|axis| axes[axis][l][k] * axes[axis][l][k]).sum();
                let size = e0[l][k].abs() + t * (e1[l][k].abs() + t * e2[l][k].abs());
                let radius = r0[l][k] + t * (r1[l][k] + t * r2[l][k]);
                out[k] = round_up(per_term * (0.5 * squared + size) + radius, roundings);
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
            out[e] = round_up(out[e] + per_term * size, self.roundings_of_bound(24));
        }
    }

    /// F at the point z, or z + low in extended precision if there is a `low`, and if wanted how far the exact
    /// value may be from that. `at` is work space: in 53 bits the point's differences and lengths.
    #[inline(always)]
    pub fn residual_at(
        &self,
        (z, low): (&[f64], Option<&[f64]>),
        (d, lengths): (&mut Differences<D>, &mut Lengths),
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
        d: &Differences<D>,
        lengths: &Lengths,
        dv: &Differences<D>,
        vt: f64,
        out: &mut [f64],
    ) {
        for (e, out) in out[..self.m].iter_mut().enumerate() {
            let product: f64 = (0..D).map(|axis| d[axis][e] * dv[axis][e]).sum();
            *out = product - lengths.terms[1][e] * vt;
        }
        if !self.tail.is_empty() {
            self.tail.add_products(1.0, &d.forms, &dv.forms, out);
        }
    }

    /// How far J v may be from what [`Equations::jacobian_times`] computes, J being taken anywhere
    /// within the given radii (as differences' sums, and of t) of the point: no term of a distance goes
    /// through more than 20 roundings.
    pub fn jacobian_times_error(
        &self,
        (d, t): (&Differences<D>, f64),
        (spread, t_radius): (&Differences<D>, f64),
        (dv, vt): (&Differences<D>, f64),
        out: &mut [f64],
    ) {
        let (t, vt) = (t.abs() + t_radius, vt.abs());
        // Either factor of a product passes through one sum more than a distance's difference does.
        let per_term = gamma(self.roundings_of_derivative(20));
        for (e, out) in out[..self.m].iter_mut().enumerate() {
            let (mut size, mut moved) = (0.0, 0.0);
            for axis in 0..D {
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
                let (c, r) = (bend.e.map(f64::abs), &bend.e_radius);
                curvature += t * (6.0 * (c[3] + r[3]) + 12.0 * t * (c[4] + r[4]));
            }
            let time = slope_radius + curvature * t_radius;
            let bound = per_term * (size + slope_size * vt) + moved + time * vt;
            *out = round_up(bound, self.roundings_of_bound(40));
        }
    }

    /// Σ j |e_j| tʲ⁻¹ of E's coefficients e_j for one distance, and of their radii, for t ≥ 0: bounds on
    /// E' at |t|, and on how far it may be from that of the coefficients. At most twelve roundings.
    pub fn slope_of_length(&self, edge: usize, t: f64) -> (f64, f64) {
        let slope = |e: [f64; 5]| {
            let [_, e1, e2, e3, e4] = e.map(f64::abs);
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

    /// An inverter for the Jacobian with its last row, and room for that matrix's values.
    pub fn inverter(&self) -> InverseMaker {
        (
            Inverter::new(&self.bordered),
            vec![0.0; self.bordered.entries()],
        )
    }

    /// The pattern of the Jacobian's derivatives along a curve, whose last row is zero.
    pub fn pattern(&self) -> &Sparse {
        &self.pattern
    }

    /// The pattern of the Jacobian with its last row.
    pub fn bordered_pattern(&self) -> &Sparse {
        &self.bordered
    }

    /// Values for [`Equations::pattern`]: the differences, and minus `time` in the column of t.
    #[inline(always)]
    pub fn pattern_values(&self, d: &Differences<D>, time: &[f64], out: &mut [f64]) {
        for (sources, d) in self.sources.iter().zip(&d.axes) {
            for source in sources {
                out[source.plain as usize] = source.sign * d[source.edge as usize];
            }
        }
        if !self.tail.is_empty() {
            self.tail.values(&d.forms, |at| at.plain as usize, out);
        }
        let last = self.pattern.entries() - self.m;
        for (out, time) in out[last..].iter_mut().zip(time) {
            *out = -time;
        }
    }

    /// Values for [`Equations::bordered_pattern`].
    pub fn bordered_values(
        &self,
        d: &Differences<D>,
        lengths: &Lengths,
        normal: &[f64],
        out: &mut [f64],
    ) {
        for (sources, d) in self.sources.iter().zip(&d.axes) {
            for source in sources {
                out[source.bordered as usize] = source.sign * d[source.edge as usize];
            }
        }
        if !self.tail.is_empty() {
            self.tail.values(&d.forms, |at| at.bordered as usize, out);
        }
        let mut last = 0;
        for (column, normal) in normal[..self.m].iter().enumerate() {
            last += self.bordered.entries_of(column);
            out[last - 1] = *normal;
        }
        let of_time = lengths.terms[1].iter().map(|slope| -slope);
        for (out, value) in out[last..].iter_mut().zip(of_time.chain([normal[self.m]])) {
            *out = value;
        }
    }
}

/// The right-hand sides of degree 4.
fn bends(homotopy: &Homotopy) -> impl Iterator<Item = Bend> + '_ {
    let rights = homotopy.rights.iter().enumerate();
    rights
        .filter(|(_, right)| right.degree > 2)
        .map(|(edge, right)| Bend {
            edge,
            e: right.e,
            e_radius: right.e_radius,
        })
}

/// Differences of a vector of unknowns.
#[derive(Debug, Clone)]
pub struct Differences<const D: usize> {
    /// p_i − p_j, per axis and distance.
    pub axes: [Vector; D],
    /// The factors of the tail's products.
    pub forms: Forms,
}

impl<const D: usize> Deref for Differences<D> {
    type Target = [Vector; D];

    fn deref(&self) -> &[Vector; D] {
        &self.axes
    }
}

impl<const D: usize> DerefMut for Differences<D> {
    fn deref_mut(&mut self) -> &mut [Vector; D] {
        &mut self.axes
    }
}

/// Taylor coefficients of the right-hand sides E at some t.
#[derive(Debug, Clone)]
pub struct Lengths {
    /// E and E' of all equations.
    pub terms: [Vector; 2],
    /// All five coefficients of those of degree 4.
    pub bends: Vec<[f64; 5]>,
}

impl Lengths {
    /// Room for the right-hand sides of a problem.
    pub fn new<const D: usize>(equations: &Equations<D>) -> Self {
        Lengths {
            terms: [equations.per_edge(), equations.per_edge()],
            bends: vec![[0.0; 5]; equations.bends.len()],
        }
    }
}
