//! The equations q_e(X) = E_e(t) in intervals: 2 q_e is a sum of products of differences, with whole
//! factors, and E_e a polynomial in t. For a distance 2 q_e = |p_i − p_j|² and 2 E_e = a_e².

use crate::interval::{Interval, point};
use crate::system::Homotopy;

/// The problem's equations. Vectors of unknowns z = (X, t) have n = m + 1 entries, and one more,
/// always zero, which is read for fixed coordinates.
pub struct Equations {
    pub homotopy: Homotopy,
    /// The number of equations.
    pub m: usize,
    /// Differences of two entries.
    pub forms: Vec<[usize; 2]>,
    /// Per equation the products in 2 q_e.
    pub products: Vec<Vec<Product>>,
    /// Per equation the terms of 2 ∂q_e/∂x_i, for all i.
    pub gradient: Vec<Vec<Term>>,
    /// The sketch: X, and t = 0.
    pub sketch: Vec<Interval>,
}

/// `factor` times the product of two forms.
pub struct Product {
    pub factor: i64,
    pub left: usize,
    pub right: usize,
}

/// `factor` times a form, in the derivative by an unknown.
pub struct Term {
    pub factor: i64,
    pub form: usize,
    pub unknown: usize,
}

/// No equation has a larger sum of factors, so that its sums of products fit into an `i128`.
const MAX_FACTORS: i64 = 1 << 12;

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
        let mut forms = Vec::new();
        let distances = homotopy.edges.iter().map(|edge| {
            let square = |axis| {
                forms.push(edge.points.map(|p| unknown(&homotopy, p, axis)));
                let form = forms.len() - 1;
                Product {
                    factor: 1,
                    left: form,
                    right: form,
                }
            };
            (0..homotopy.dimension).map(square).collect()
        });
        let products: Vec<Vec<Product>> = distances.collect();
        let gradient = products.iter().map(|products| {
            assert!(products.iter().map(|p| p.factor.abs()).sum::<i64>() <= MAX_FACTORS);
            products
                .iter()
                .flat_map(|p| derivative(p, &forms))
                .collect()
        });
        let gradient = gradient.collect();
        let place = homotopy.gauge.place.iter().map(|&p| homotopy.sketch_box[p]);
        Equations {
            m: homotopy.equations,
            forms,
            products,
            gradient,
            sketch: place.chain([ZERO; 2]).collect(),
            homotopy,
        }
    }

    /// The coefficients of E_e(t₀ + τ) in τ.
    pub fn half_square_at(&self, e: usize, t: Interval) -> [Interval; 5] {
        let length = &self.homotopy.lengths[e];
        let mut c = *length.half_square();
        // Horner's scheme, repeated.
        for from in 0..length.degree {
            for k in (from..length.degree).rev() {
                c[k] += t * c[k + 1];
            }
        }
        if t == point(1.0) {
            // Known better than from its way there.
            c[0] = length.target_half_square();
        }
        c
    }

    /// E'' on a range of t.
    pub fn bend(&self, e: usize, t: Interval) -> Interval {
        let length = &self.homotopy.lengths[e];
        let c = length.half_square();
        match length.degree {
            2 => c[2] * point(2.0),
            _ => c[2] * point(2.0) + t * (c[3] * point(6.0) + t * (c[4] * point(12.0))),
        }
    }
}

/// The terms that a product adds to the derivatives: by the unknowns of its right form, whose factor is
/// the left form, and the other way round.
fn derivative(product: &Product, forms: &[[usize; 2]]) -> Vec<Term> {
    let (left, right) = (product.left, product.right);
    let term = |by: usize, form: usize, factor: i64| {
        let signs = forms[by].into_iter().zip([factor, -factor]);
        signs.map(move |(unknown, factor)| Term {
            factor,
            form,
            unknown,
        })
    };
    match left == right {
        true => term(left, left, 2 * product.factor).collect(),
        false => {
            let one = term(right, left, product.factor);
            one.chain(term(left, right, product.factor)).collect()
        }
    }
}
