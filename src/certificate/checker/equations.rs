//! The equations in intervals: F_e = ½|p_i − p_j|² − E_e(t), E_e = ½ a_e².

use crate::interval::{Interval, point};
use crate::system::Homotopy;

/// The problem's equations. Vectors of unknowns z = (X, t) have n = m + 1 entries, and one more,
/// always zero, which is read for fixed coordinates.
pub struct Equations {
    pub homotopy: Homotopy,
    /// The number of equations.
    pub m: usize,
    /// Per distance and axis the unknowns of its two points.
    pub ends: Vec<[[usize; 2]; 3]>,
    /// The sketch: X, and t = 0.
    pub sketch: Vec<Interval>,
}

pub const ZERO: Interval = inari::const_interval!(0.0, 0.0);

/// The unknown that a point's coordinate is, or the entry that is always zero.
pub fn unknown(homotopy: &Homotopy, point: usize, axis: usize) -> usize {
    let (m, d) = (homotopy.equations, homotopy.dimension);
    match homotopy.gauge.variable.get(point * d + axis) {
        Some(&free) if axis < d && free < m => free,
        _ => m + 1,
    }
}

impl Equations {
    pub fn new(homotopy: Homotopy) -> Self {
        let ends = homotopy.edges.iter().map(|edge| {
            std::array::from_fn(|axis| edge.points.map(|p| unknown(&homotopy, p, axis)))
        });
        let place = homotopy.gauge.place.iter().map(|&p| homotopy.sketch_box[p]);
        Equations {
            m: homotopy.equations,
            ends: ends.collect(),
            sketch: place.chain([ZERO; 2]).collect(),
            homotopy,
        }
    }

    /// The coefficients of E_e(t₀ + τ) in τ.
    pub fn half_square_at(&self, e: usize, t: Interval) -> [Interval; 5] {
        let right = &self.homotopy.rights[e];
        let mut c = *right.enclosures();
        // Horner's scheme, repeated.
        for from in 0..right.degree {
            for k in (from..right.degree).rev() {
                c[k] += t * c[k + 1];
            }
        }
        if t == point(1.0) {
            // Known better than from its way there.
            c[0] = right.at_target();
        }
        c
    }

    /// E'' on a range of t.
    pub fn bend(&self, e: usize, t: Interval) -> Interval {
        let right = &self.homotopy.rights[e];
        let c = right.enclosures();
        match right.degree {
            2 => c[2] * point(2.0),
            _ => c[2] * point(2.0) + t * (c[3] * point(6.0) + t * (c[4] * point(12.0))),
        }
    }
}
