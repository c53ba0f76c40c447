//! H(X, t) laid out for the inner loops: one vector over all distances for each quantity.

use super::extended::Extended;
use super::preconditioner::InverseMaker;
use crate::interval::rounding::{gamma, round_up};
use crate::linalg::{Inverter, LANE, Sparse, Vector};
use crate::system::Homotopy;

/// The degree of F in t: 4 for the bend, otherwise 2. In X it is 2.
pub const MAX_DEGREE: usize = 4;

/// E(t) = ½ a(t)² of the one distance that bends, a polynomial of degree 4.
#[derive(Debug, Clone, Copy)]
pub struct Bend {
    /// Which distance.
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
    /// The entries of z for either point's coordinates, per axis and distance.
    pub ends: [Vec<[u32; 2]>; D],
    /// The coefficients of E up to t², per distance (the bend's too), and their radii.
    pub e: [Vector; 3],
    /// See `e`.
    pub e_radius: [Vector; 3],
    /// The distance that bends.
    pub bend: Bend,
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
            let edges = homotopy.edges.iter();
            edges
                .map(|edge| edge.points.map(|p| entry(p, axis) as u32))
                .collect()
        });
        let lengths = &homotopy.lengths;
        let coefficient = |pick: &dyn Fn(usize) -> f64| {
            let mut out = Vector::zeros(m);
            (0..m).for_each(|e| out[e] = pick(e));
            out
        };
        let bend = homotopy.bend;
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
        }
        let rows = |column: &Vec<(usize, usize, f64)>| column.iter().map(|c| c.0).collect();
        let mut plain: Vec<Vec<usize>> = columns.iter().map(rows).collect();
        plain.push((0..m).collect());
        let bordered: Vec<Vec<usize>> = plain
            .iter()
            .map(|column| column.iter().copied().chain([m]).collect())
            .collect();
        Equations {
            m,
            ends,
            e: std::array::from_fn(|k| coefficient(&|e| lengths[e].e[k])),
            e_radius: std::array::from_fn(|k| coefficient(&|e| lengths[e].e_radius[k])),
            bend: Bend {
                edge: bend,
                e: lengths[bend].e,
                e_radius: lengths[bend].e_radius,
            },
            extended: None,
            pattern: Sparse::new(&plain),
            bordered: Sparse::new(&bordered),
            sources,
        }
    }

    /// Takes the lengths of another homotopy between the same points.
    pub fn set_lengths(&mut self, homotopy: &Homotopy) {
        let lengths = &homotopy.lengths;
        for k in 0..3 {
            for (e, length) in lengths.iter().enumerate() {
                self.e[k][e] = length.e[k];
                self.e_radius[k][e] = length.e_radius[k];
            }
        }
        let bend = &lengths[self.bend.edge];
        (self.bend.e, self.bend.e_radius) = (bend.e, bend.e_radius);
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

    /// The same, for sabotage.
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

    /// p_i − p_j for the vector `z`, per axis and distance.
    #[inline(always)]
    pub fn differences(&self, z: &[f64], out: &mut [Vector; D]) {
        for (ends, out) in self.ends.iter().zip(out) {
            for (&[i, j], d) in ends.iter().zip(out.iter_mut()) {
                *d = z[i as usize] - z[j as usize];
            }
        }
    }

    /// z_i + z_j likewise.
    pub fn sums(&self, z: &[f64], out: &mut [Vector; D]) {
        for (ends, out) in self.ends.iter().zip(out) {
            for (&[i, j], d) in ends.iter().zip(out.iter_mut()) {
                *d = z[i as usize] + z[j as usize];
            }
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
        let e = &self.bend.e;
        let e4t = e[4] * t;
        out.bend = [
            e[0] + t * (e[1] + t * (e[2] + t * (e[3] + e4t))),
            e[1] + t * (2.0 * e[2] + t * (3.0 * e[3] + 4.0 * e4t)),
            e[2] + t * (3.0 * e[3] + 6.0 * e4t),
            e[3] + 4.0 * e4t,
            e[4],
        ];
        out.terms[0][self.bend.edge] = out.bend[0];
        out.terms[1][self.bend.edge] = out.bend[1];
    }

    /// F from differences and lengths.
    #[inline(always)]
    pub fn residual(&self, d: &[Vector; D], lengths: &Lengths, out: &mut Vector) {
        let d = d.each_ref().map(|d| d.lanes());
        let t0 = lengths.terms[0].lanes();
        let out = out.lanes_mut();
        for l in 0..t0.len() {
            for k in 0..LANE {
                let squared: f64 = (0..D).map(|axis| d[axis][l][k] * d[axis][l][k]).sum();
                out[l][k] = 0.5f64.mul_add(squared, -t0[l][k]);
            }
        }
    }

    /// How far F may be from the value that [`Equations::residual`] computes: rounding and the
    /// radii of the coefficients. No term goes through more than 20 roundings.
    pub fn residual_error(&self, d: &[Vector; D], t: f64, out: &mut Vector) {
        let t = t.abs();
        for (e, out) in out[..self.m].iter_mut().enumerate() {
            let squared: f64 = (0..D).map(|axis| d[axis][e].powi(2)).sum();
            let value = |c: &[Vector; 3]| c[0][e].abs() + t * (c[1][e].abs() + t * c[2][e].abs());
            let (mut size, mut radius) = (value(&self.e), value(&self.e_radius));
            if e == self.bend.edge {
                let (c, r) = (&self.bend.e, &self.bend.e_radius);
                let cube = t * t * t;
                size += cube * (c[3].abs() + t * c[4].abs());
                radius += cube * (r[3] + t * r[4]);
            }
            *out = round_up(gamma(20) * (0.5 * squared + size) + radius, 24);
        }
    }

    /// J v at the given differences and lengths, `dv` being the differences of v and `vt` its t.
    pub fn jacobian_times(
        &self,
        d: &[Vector; D],
        lengths: &Lengths,
        dv: &[Vector; D],
        vt: f64,
        out: &mut [f64],
    ) {
        for (e, out) in out[..self.m].iter_mut().enumerate() {
            let product: f64 = (0..D).map(|axis| d[axis][e] * dv[axis][e]).sum();
            *out = product - lengths.terms[1][e] * vt;
        }
    }

    /// How far J v may be from what [`Equations::jacobian_times`] computes, J being taken anywhere
    /// within the given radii (as differences' sums, and of t) of the point: no term goes through
    /// more than 20 roundings.
    pub fn jacobian_times_error(
        &self,
        (d, t): (&[Vector; D], f64),
        (spread, t_radius): (&[Vector; D], f64),
        (dv, vt): (&[Vector; D], f64),
        out: &mut [f64],
    ) {
        let (t, vt) = (t.abs() + t_radius, vt.abs());
        for (e, out) in out[..self.m].iter_mut().enumerate() {
            let (mut size, mut moved) = (0.0, 0.0);
            for axis in 0..D {
                size += (d[axis][e] * dv[axis][e]).abs();
                moved += spread[axis][e] * dv[axis][e].abs();
            }
            let (slope_size, slope_radius) = self.slope_of_length(e, t);
            let mut curvature = 2.0 * (self.e[2][e].abs() + self.e_radius[2][e]);
            if e == self.bend.edge {
                let (c, r) = (self.bend.e.map(f64::abs), &self.bend.e_radius);
                curvature += t * (6.0 * (c[3] + r[3]) + 12.0 * t * (c[4] + r[4]));
            }
            let time = slope_radius + curvature * t_radius;
            *out = round_up(gamma(20) * (size + slope_size * vt) + moved + time * vt, 40);
        }
    }

    /// Σ j |e_j| tʲ⁻¹ of E's coefficients e_j for one distance, and of their radii, for t ≥ 0: bounds on
    /// E' at |t|, and on how far it may be from that of the coefficients. At most twelve roundings.
    pub fn slope_of_length(&self, edge: usize, t: f64) -> (f64, f64) {
        let slope = |e: [f64; 5]| {
            let [_, e1, e2, e3, e4] = e.map(f64::abs);
            e1 + t * (2.0 * e2 + t * (3.0 * e3 + t * (4.0 * e4)))
        };
        if edge == self.bend.edge {
            (slope(self.bend.e), slope(self.bend.e_radius))
        } else {
            let of = |c: &[Vector; 3]| [c[0][edge], c[1][edge], c[2][edge], 0.0, 0.0];
            (slope(of(&self.e)), slope(of(&self.e_radius)))
        }
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
    pub fn pattern_values(&self, d: &[Vector; D], time: &[f64], out: &mut [f64]) {
        for (sources, d) in self.sources.iter().zip(d) {
            for source in sources {
                out[source.plain as usize] = source.sign * d[source.edge as usize];
            }
        }
        let last = self.pattern.entries() - self.m;
        for (out, time) in out[last..].iter_mut().zip(time) {
            *out = -time;
        }
    }

    /// Values for [`Equations::bordered_pattern`].
    pub fn bordered_values(
        &self,
        d: &[Vector; D],
        lengths: &Lengths,
        normal: &[f64],
        out: &mut [f64],
    ) {
        for (sources, d) in self.sources.iter().zip(d) {
            for source in sources {
                out[source.bordered as usize] = source.sign * d[source.edge as usize];
            }
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

/// Taylor coefficients of the lengths' half squares at some t.
#[derive(Debug, Clone)]
pub struct Lengths {
    /// E and E' of all distances.
    pub terms: [Vector; 2],
    /// All five coefficients of the bend.
    pub bend: [f64; 5],
}

impl Lengths {
    /// Room for `m` distances.
    pub fn new(m: usize) -> Self {
        Lengths {
            terms: [Vector::zeros(m), Vector::zeros(m)],
            bend: [0.0; 5],
        }
    }
}
