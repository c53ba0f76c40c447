//! The equations q_e(X) = E_e(t) in intervals: 2 q_e is a sum of products of differences, with whole
//! factors, and E_e a polynomial in t. For a distance 2 q_e = |p_i − p_j|² and 2 E_e = a_e².

use crate::equations::Form;
use crate::interval::{DoubleDouble, Interval, point};
use crate::system::Homotopy;
use std::ops::Sub;
use std::sync::OnceLock;

/// A factor, and the two forms that it multiplies.
pub type Product = (i64, [usize; 2]);

/// The problem's equations. Vectors of unknowns z = (X, t) have n = m + 1 entries.
pub struct Equations {
    /// Its right-hand sides are E_e; those of equations that it does not have are 0.
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
    /// No equation has more of these.
    pub longest: usize,
    doubles: OnceLock<Vec<Doubles>>,
}

/// Coefficients of E_e(t) to twice a float's digits, and how far the exact ones may be from that.
type Doubles = [(DoubleDouble, f64); 5];

/// No equation has a larger sum of factors, so that its sums of products fit into an `i128`.
const MAX_FACTORS: i64 = 1 << 12;

pub use crate::interval::ZERO;

/// The two of which a form is the difference, where there are m unknowns. The number 1 has an index of its own.
pub fn ends(form: Form<Option<usize>>, m: usize) -> [usize; 2] {
    match form.map(|entry| entry.unwrap_or(m + 1)) {
        Form::Difference(a, b) => [a, b],
        Form::One => [m + 2, m + 1],
    }
}

impl Equations {
    pub fn new(homotopy: Homotopy) -> Self {
        let m = homotopy.equations;
        let (mut forms, mut products) = (Vec::new(), Vec::new());
        for e in 0..m {
            let mut all = Vec::new();
            for term in homotopy.terms(e) {
                let left = forms.len();
                forms.push(ends(term.left, m));
                if term.left != term.right {
                    forms.push(ends(term.right, m));
                }
                all.push((i64::from(term.factor), [left, forms.len() - 1]));
            }
            assert!(all.iter().map(|p: &Product| p.0.abs()).sum::<i64>() <= MAX_FACTORS);
            products.push(all);
        }
        Self::of(homotopy, m, forms, products)
    }

    fn of(
        homotopy: Homotopy,
        m: usize,
        forms: Vec<[usize; 2]>,
        products: Vec<Vec<Product>>,
    ) -> Self {
        let gradient: Vec<Vec<_>> = products
            .iter()
            .map(|products| {
                let terms = products.iter().flat_map(|&(factor, [left, right])| {
                    let (same, halves) = (left == right, [(left, right), (right, left)]);
                    let (count, factor) = if same { (1, 2 * factor) } else { (2, factor) };
                    halves.into_iter().take(count).flat_map({
                        let forms = &forms;
                        move |(by, form)| [0, 1].map(|k| (forms[by][k], [factor, -factor][k], form))
                    })
                });
                terms.filter(|term| term.0 < m).collect()
            })
            .collect();
        Equations {
            positive: homotopy.positive_unknowns(),
            nonzero: homotopy.nonzero_vectors(),
            m,
            longest: gradient.iter().map(Vec::len).max().unwrap_or(0),
            gradient,
            forms,
            products,
            homotopy,
            doubles: OnceLock::new(),
        }
    }

    /// The coefficients of all E_e(t), for points of more than 53 bits.
    pub fn doubles(&self) -> &[Doubles] {
        let rights = || self.homotopy.rights.iter().map(|right| right.doubles());
        self.doubles.get_or_init(|| rights().collect())
    }

    /// The equations F(X, t) = 0 and J v = 0, J = ∂F/∂X, in the unknowns (X, v) and t.
    pub fn of_folds(&self) -> Equations {
        let (m, count) = (self.m, self.forms.len());
        // The number 1 does not move.
        let moved = |by: usize, one: usize| {
            move |i: usize| match i {
                i if i < m => by + i,
                i if i == m + 2 => one,
                _ => 2 * m + 1,
            }
        };
        let of = |by, one| self.forms.iter().map(move |f| f.map(moved(by, one)));
        let forms = of(0, 2 * m + 2).chain(of(m, 2 * m + 1)).collect();
        let moves = self.products.iter().map(|products| {
            let halves = products
                .iter()
                .flat_map(|&(f, [l, r])| [(f, [count + l, r]), (f, [l, count + r])]);
            halves.collect()
        });
        let products = self.products.iter().cloned().chain(moves).collect();
        Self::of(self.homotopy.clone(), 2 * m, forms, products)
    }

    /// All forms of unknowns, of which t is none, for these values of 0 and 1.
    pub fn differences<T: Copy + Sub<Output = T>>(&self, x: &[T], [zero, one]: [T; 2]) -> Vec<T> {
        let mut all = x[..self.m].to_vec();
        all.extend([zero, zero, one]);
        self.forms.iter().map(|&[i, j]| all[i] - all[j]).collect()
    }

    /// The coefficients of E_e(t₀ + τ) in τ.
    pub fn right_at(&self, e: usize, t: Interval) -> [Interval; 5] {
        let Some(right) = self.homotopy.rights.get(e) else {
            return [ZERO; 5];
        };
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
        match self.homotopy.rights.get(e) {
            None => ZERO,
            Some(right) if right.degree <= 2 => right.enclosures()[2] * point(2.0),
            Some(right) => right.enclose_curvature(t),
        }
    }

    /// The degree of E_e.
    pub fn degree(&self, e: usize) -> usize {
        self.homotopy.rights.get(e).map_or(2, |right| right.degree)
    }
}
