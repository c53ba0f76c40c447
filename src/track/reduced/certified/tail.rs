//! How large the tail's rows and products are along a tube's polynomial: what `along.rs` has for distances.

use super::frame::Locals;
use super::{COEFFICIENTS, DEGREE, ORDER};
use crate::interval::rounding::gamma;
use crate::track::full::Equations;

/// Sizes over a tube of a length that was chosen last; nothing where there are distances only.
#[derive(Debug)]
pub struct TailSizes {
    /// By entry of the tail's rows of the Jacobian, J_k being the coefficient of sᵏ: the terms that entries are
    /// sums of, Σ_k hᵏ, without regard to signs; then bounds on Σ_{k≥j} |J_k| hᵏ for j = 2, 3, 4, 5.
    pub entries: [Vec<f64>; 5],
    /// By form, f_k being its coefficient of sᵏ: |f₀|, Σ_{k≥1} |f_k| hᵏ, the sum of these, and Σ k |f_k| hᵏ⁻¹.
    at_0: Vec<f64>,
    from1: Vec<f64>,
    all: Vec<f64>,
    slopes: Vec<f64>,
    /// By form: the sum of the sizes of the unknowns it is the difference of.
    sums: Vec<f64>,
}

impl TailSizes {
    /// Room for them.
    pub fn new<const D: usize>(equations: &Equations<D>) -> Self {
        let tail = &equations.tail;
        let forms = || vec![0.0; tail.forms()];
        TailSizes {
            entries: std::array::from_fn(|_| vec![0.0; tail.entries()]),
            at_0: forms(),
            from1: forms(),
            all: forms(),
            slopes: forms(),
            sums: forms(),
        }
    }

    /// Measures all but `sums`, from the tube's forms and the `values` of entries order by order.
    pub fn measure<const D: usize>(
        &mut self,
        equations: &Equations<D>,
        local: &Locals<D>,
        values: &[Vec<f64>; COEFFICIENTS],
        hs: &[f64; DEGREE + 1],
    ) {
        let tail = &equations.tail;
        for form in 0..tail.forms() {
            let size = |k: usize| local.d[k].forms[form].abs();
            self.at_0[form] = size(0);
            self.from1[form] = (1..=ORDER).rev().map(|k| size(k) * hs[k]).sum();
            self.all[form] = self.at_0[form] + self.from1[form];
            let slope = |k: usize| k as f64 * size(k) * hs[k - 1];
            self.slopes[form] = (1..=ORDER).rev().map(slope).sum();
        }
        let [all, from2, from3, from4, from5] = &mut self.entries;
        tail.row_sizes(&self.all, all);
        // An entry is a sum of terms with signs: the computed one is off by γ times these at most, one
        // rounding for the form, one for the product, and one for each part.
        let hidden = gamma(equations.roundings_of_row(2 * COEFFICIENTS));
        for entry in 0..tail.entries() {
            let size = |k: usize| values[k][entry].abs() * hs[k];
            let five = (5..=ORDER).rev().map(size).sum::<f64>() + hidden * all[entry];
            from5[entry] = five;
            from4[entry] = five + size(4);
            from3[entry] = five + size(4) + size(3);
            from2[entry] = five + size(4) + size(3) + size(2);
        }
    }

    /// Σ |entry| u over the row of an equation.
    pub fn times<const D: usize>(
        &self,
        equations: &Equations<D>,
        e: usize,
        entries: &[f64],
        u: &[f64],
    ) -> f64 {
        let tail = &equations.tail;
        let row = tail.row(e);
        row.map(|entry| entries[entry] * u[tail.unknown(entry)])
            .sum()
    }

    /// Takes the sizes of unknowns.
    pub fn set_sums<const D: usize>(&mut self, equations: &Equations<D>, omega: &[f64]) {
        for (form, sum) in self.sums.iter_mut().enumerate() {
            *sum = equations.tail.sum_of(form, omega);
        }
    }

    /// A bound on (J(ẑ + w) − J(ẑ)) w' for |w|, |w'| ≤ ω, as either factor of a product changes while the other
    /// is there.
    pub fn width<const D: usize>(&self, equations: &Equations<D>, e: usize) -> f64 {
        2.0 * equations.tail.half_products_abs(e, &self.sums, &self.sums)
    }

    /// A bound on (J(ẑ + w) − J(ẑ)) ẑ'.
    pub fn turn<const D: usize>(&self, equations: &Equations<D>, e: usize) -> f64 {
        let both = |x, y| equations.tail.half_products_abs(e, x, y);
        both(&self.sums, &self.slopes) + both(&self.slopes, &self.sums)
    }

    /// Of one equation's products along ẑ, the terms without regard to signs: at s = 0; what those of higher
    /// orders add; and their derivative by s. They are twice as much, as in `along.rs`.
    pub fn terms<const D: usize>(&self, equations: &Equations<D>, e: usize) -> (f64, f64, f64) {
        let both = |x, y| 2.0 * equations.tail.half_products_abs(e, x, y);
        (
            both(&self.at_0, &self.at_0),
            both(&self.from1, &self.all) + both(&self.at_0, &self.from1),
            both(&self.slopes, &self.all) + both(&self.all, &self.slopes),
        )
    }
}
