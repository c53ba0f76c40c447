//! The equations q_e(X) = E_e(t) in intervals: 2 q_e is a sum of products of differences, with whole
//! factors, and E_e a polynomial in t. For a distance 2 q_e = |p_i − p_j|² and 2 E_e = a_e².

use crate::interval::{Interval, point};
use crate::system::Homotopy;

/// A factor, and the two forms that it multiplies.
pub type Product = (i64, [usize; 2]);

/// The problem's equations. Vectors of unknowns z = (X, t) have n = m + 1 entries.
pub struct Equations {
    pub homotopy: Homotopy,
    /// The number of equations.
    pub m: usize,
    /// Differences of two unknowns; one that is not below m stands for zero.
    pub forms: Vec<[usize; 2]>,
    /// Per equation the products in 2 q_e.
    pub products: Vec<Vec<Product>>,
    /// Per equation the terms of all 2 ∂q_e/∂x_i: i, a factor, and the form that it multiplies.
    pub gradient: Vec<Vec<(usize, i64, usize)>>,
    /// The coefficients of E_e, and its degree.
    pub right: Vec<([Interval; 5], usize)>,
}

/// No equation has a larger sum of factors, so that its sums of products fit into an `i128`.
const MAX_FACTORS: i64 = 1 << 12;

pub const ZERO: Interval = inari::const_interval!(0.0, 0.0);

/// The unknown that a point's coordinate is, or m.
pub fn unknown(homotopy: &Homotopy, point: usize, axis: usize) -> usize {
    let place = point * homotopy.dimension + axis;
    let free = homotopy.gauge.variable.get(place);
    free.filter(|_| axis < homotopy.dimension)
        .map_or(homotopy.equations, |&i| i)
}

impl Equations {
    pub fn new(homotopy: Homotopy) -> Self {
        let (m, d) = (homotopy.equations, homotopy.dimension);
        let (mut forms, mut products) = (Vec::new(), Vec::new());
        for edge in &homotopy.edges {
            let first = forms.len();
            forms.extend((0..d).map(|axis| edge.points.map(|p| unknown(&homotopy, p, axis))));
            products.push((first..first + d).map(|f| (1, [f, f])).collect());
        }
        let gradient = products.iter().map(|products: &Vec<Product>| {
            assert!(products.iter().map(|p| p.0.abs()).sum::<i64>() <= MAX_FACTORS);
            let mut terms = Vec::new();
            for &(factor, [left, right]) in products {
                let halves = [(left, right), (right, left)];
                let (factor, halves) = match left == right {
                    true => (2 * factor, &halves[..1]),
                    false => (factor, &halves[..]),
                };
                for &(by, form) in halves {
                    let [plus, minus] = forms[by];
                    terms.extend([(plus, factor, form), (minus, -factor, form)]);
                }
            }
            terms.retain(|term| term.0 < m);
            terms
        });
        let right = homotopy
            .lengths
            .iter()
            .map(|l| (*l.half_square(), l.degree));
        Equations {
            m,
            gradient: gradient.collect(),
            right: right.collect(),
            forms,
            products,
            homotopy,
        }
    }

    /// The coefficients of E_e(t₀ + τ) in τ.
    pub fn right_at(&self, e: usize, t: Interval) -> [Interval; 5] {
        let (mut c, degree) = self.right[e];
        // Horner's scheme, repeated.
        for from in 0..degree {
            for k in (from..degree).rev() {
                c[k] += t * c[k + 1];
            }
        }
        if t == point(1.0) {
            // Known better than from its way there.
            c[0] = self.homotopy.lengths[e].target_half_square();
        }
        c
    }

    /// E'' on a range of t.
    pub fn bend(&self, e: usize, t: Interval) -> Interval {
        let (c, degree) = self.right[e];
        match degree {
            ..=2 => c[2] * point(2.0),
            _ => c[2] * point(2.0) + t * (c[3] * point(6.0) + t * (c[4] * point(12.0))),
        }
    }
}
