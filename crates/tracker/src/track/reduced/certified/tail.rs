//! How large the tail's rows and products are along a tube's polynomial: what `along.rs` has for distances.

use super::frame::Locals;
use super::{COEFFICIENTS, DEGREE, ORDER};
use crate::interval::rounding::gamma;
use crate::linalg::{LANE, Vector};
use crate::places::{Each as _, array};
use crate::track::full::{Equations, Forms};

/// Sizes over a tube of a length that was chosen last; nothing where there are distances only.
#[derive(Debug)]
pub struct TailSizes {
    /// By entry of the tail's rows of the Jacobian, J_k being the coefficient of sᵏ: the terms that entries are
    /// sums of, Σ_k hᵏ, without regard to signs; then bounds on Σ_{k≥j} |J_k| hᵏ for j = 2, 3, 4, 5.
    pub entries: [Vec<f64>; 5],
    /// By equation a bound on (J(ẑ + w) − J(ẑ)) w' for |w|, |w'| ≤ ω, as either factor of a product changes while
    /// the other is there; and one on (J(ẑ + w) − J(ẑ)) ẑ'.
    pub width: Vector,
    pub turn: Vector,
    /// By form, f_k being its coefficient of sᵏ: |f₀|, Σ_{k≥1} |f_k| hᵏ, the sum of these, and Σ k |f_k| hᵏ⁻¹.
    at_0: Forms,
    from1: Forms,
    all: Forms,
    slopes: Forms,
    /// By form: the sum of the sizes of the unknowns it is the difference of.
    sums: Forms,
}

impl TailSizes {
    /// Room for them.
    pub fn new(equations: &Equations) -> Self {
        let tail = &equations.tail;
        let forms = || Forms::new(tail);
        TailSizes {
            entries: std::array::from_fn(|_| vec![0.0; tail.entries()]),
            width: equations.per_edge(),
            turn: equations.per_edge(),
            at_0: forms(),
            from1: forms(),
            all: forms(),
            slopes: forms(),
            sums: forms(),
        }
    }

    /// Measures what does not depend on ω, from the tube's forms and the `values` of entries order by order.
    pub fn measure(
        &mut self,
        equations: &Equations,
        local: &Locals,
        values: &[Vec<f64>; COEFFICIENTS],
        hs: &[f64; DEGREE + 1],
    ) {
        let tail = &equations.tail;
        let lanes = local.d[0].forms.lanes().len();
        let forms: [_; COEFFICIENTS] = array(|k| &local.d[k].forms.lanes()[..lanes]);
        // Σ f_k w_k from k = 1 on, without signs.
        let weighed = |lane: usize, weights: &[f64; COEFFICIENTS]| -> [f64; LANE] {
            let mut sum = [0.0; LANE];
            for k in (1..=ORDER).rev() {
                for i in 0..LANE {
                    sum[i] = forms[k][lane][i].abs().mul_add(weights[k], sum[i]);
                }
            }
            sum
        };
        let powers = array(|k| hs[k]);
        let rates = array(|k| k as f64 * hs[k.saturating_sub(1)]);
        self.at_0
            .set_lanes(tail, |lane| forms[0][lane].each(f64::abs));
        self.from1.set_lanes(tail, |lane| weighed(lane, &powers));
        let (at_0, from1) = (self.at_0.lanes(), self.from1.lanes());
        self.all
            .set_lanes(tail, |lane| array(|i| at_0[lane][i] + from1[lane][i]));
        self.slopes.set_lanes(tail, |lane| weighed(lane, &rates));
        let [all, from2, from3, from4, from5] = &mut self.entries;
        tail.row_sizes(&self.all, all);
        // An entry is a sum of terms with signs: the computed one is off by γ times these at most, one
        // rounding for the form, one for the product, and one for each part.
        let hidden = gamma(equations.roundings().of_row_along(COEFFICIENTS));
        let count = all.len();
        let values = values.each_ref().each(|values| &values[..count]);
        let [from2, from3, from4, from5] =
            [from2, from3, from4, from5].map(|bounds| &mut bounds[..count]);
        for entry in 0..count {
            let size = |k: usize| values[k][entry].abs() * hs[k];
            let five = (5..=ORDER).rev().fold(0.0, |sum: f64, k| sum + size(k));
            let five = five + hidden * all[entry];
            let four = five + size(4);
            let three = four + size(3);
            from5[entry] = five;
            from4[entry] = four;
            from3[entry] = three;
            from2[entry] = three + size(2);
        }
    }

    /// Σ |entry| u over the row of an equation.
    pub fn times(&self, equations: &Equations, e: usize, entries: &[f64], u: &[f64]) -> f64 {
        let row = equations.tail.row_with(e, entries);
        row.fold(0.0, |sum: f64, (unknown, entry)| {
            entry.mul_add(u[unknown], sum)
        })
    }

    /// Measures what depends on the sizes ω of unknowns.
    pub fn measure_in_box(&mut self, equations: &Equations, omega: &[f64]) {
        let tail = &equations.tail;
        tail.sums(omega, &mut self.sums);
        self.width.fill(0.0);
        tail.add_squares_abs(2.0, &self.sums, &mut self.width);
        self.turn.fill(0.0);
        tail.add_products_abs(1.0, &self.sums, &self.slopes, &mut self.turn);
    }

    /// Adds bounds on the products along ẑ, the terms without regard to signs: `at_point` times those at s = 0 and
    /// `rounding` times what higher orders add to `low`, and `rounding` times their derivative by s to `slope`.
    /// They are twice as much, as in `along.rs`.
    pub fn add_terms(
        &self,
        equations: &Equations,
        (at_point, rounding): (f64, f64),
        (low, slope): (&mut Vector, &mut Vector),
    ) {
        let tail = &equations.tail;
        tail.add_squares_abs(2.0 * at_point, &self.at_0, low);
        // Of either factor the higher orders, times all of the other: no less than what they add to the product.
        tail.add_products_abs(2.0 * rounding, &self.from1, &self.all, low);
        tail.add_products_abs(2.0 * rounding, &self.slopes, &self.all, slope);
    }
}
