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
    /// Differences of two unknowns; see [`Equations::entry`].
    pub forms: Vec<[usize; 2]>,
    /// Per equation the products in 2 q_e.
    pub products: Vec<Vec<Product>>,
    /// The unknowns that have to be positive along the path: radii, and lengths that are unknown.
    pub positive: Vec<usize>,
    /// The vectors that must not vanish along the path: differences of unknowns (from m on: of zero).
    pub nonzero: Vec<Vec<[usize; 2]>>,
    /// Per equation the terms of all 2 ∂q_e/∂x_i: i, a factor, and the form that it multiplies.
    pub gradient: Vec<Vec<(usize, i64, usize)>>,
}

/// No equation has a larger sum of factors, so that its sums of products fit into an `i128`.
const MAX_FACTORS: i64 = 1 << 12;

pub use crate::interval::ZERO;

impl Equations {
    pub fn new(homotopy: Homotopy) -> Self {
        let m = homotopy.equations;
        let (mut forms, mut products, mut gradient) = (Vec::new(), Vec::new(), Vec::new());
        for e in 0..m {
            let (mut all, mut terms) = (Vec::new(), Vec::new());
            for term in homotopy.terms(e) {
                // The number 1 has an index of its own.
                let mut form = |form: Option<[usize; 2]>| {
                    forms.push(form.unwrap_or([m + 2, m + 1]));
                    forms.len() - 1
                };
                let (left, same) = (form(term.left), term.left == term.right);
                let right = if same { left } else { form(term.right) };
                let factor = i64::from(term.factor);
                all.push((factor, [left, right]));
                let halves = [(left, right), (right, left)];
                for &(by, form) in if same { &halves[..1] } else { &halves } {
                    let [plus, minus] = forms[by];
                    let factor = if same { 2 * factor } else { factor };
                    terms.extend([(plus, factor, form), (minus, -factor, form)]);
                }
            }
            assert!(all.iter().map(|p: &Product| p.0.abs()).sum::<i64>() <= MAX_FACTORS);
            terms.retain(|term| term.0 < m);
            products.push(all);
            gradient.push(terms);
        }
        Equations {
            positive: homotopy.positive_unknowns(),
            nonzero: homotopy.nonzero_vectors(),
            m,
            forms,
            products,
            gradient,
            homotopy,
        }
    }

    /// What an index in a form stands for: an unknown other than t, the number 1, or 0.
    pub fn entry<T>(&self, i: usize, unknown: impl FnOnce(usize) -> T, [zero, one]: [T; 2]) -> T {
        match i {
            i if i < self.m => unknown(i),
            i if i == self.m + 2 => one,
            _ => zero,
        }
    }

    /// The coefficients of E_e(t₀ + τ) in τ.
    pub fn right_at(&self, e: usize, t: Interval) -> [Interval; 5] {
        let right = &self.homotopy.rights[e];
        let (mut c, degree) = (*right.enclosures(), right.degree);
        // Horner's scheme, repeated.
        for from in 0..degree {
            for k in (from..degree).rev() {
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
        let c = self.homotopy.rights[e].enclosures();
        match self.degree(e) {
            ..=2 => c[2] * point(2.0),
            _ => c[2] * point(2.0) + t * (c[3] * point(6.0) + t * (c[4] * point(12.0))),
        }
    }

    /// The degree of E_e.
    pub fn degree(&self, e: usize) -> usize {
        self.homotopy.rights[e].degree
    }
}
