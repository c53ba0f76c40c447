//! How near to singular a Jacobian is, and how far a prediction was off: for the reasons of stopped runs.

use super::{Equations, Local, Preconditioner};
use crate::interval::rounding::greatest;
use crate::linalg::extreme_pivots;

impl<const N: usize, Y: Preconditioner> Local<N, Y> {
    /// The smallest pivot of [J; c] at `z[0]` over the largest, as far as floats tell.
    pub fn pivot_ratio(&mut self, equations: &Equations) -> f64 {
        self.look(equations);
        let pattern = equations.bordered_pattern();
        let mut values = vec![0.0; pattern.entries()];
        equations.bordered_values(&self.d[0], &self.lengths, &self.normal, &mut values);
        let (least, largest) = extreme_pivots(pattern, &values, equations.n());
        least / largest
    }

    /// The smallest pivot of J itself as a part of its largest: zero where the path is singular.
    pub fn pivot_ratio_of_jacobian(&mut self, equations: &Equations) -> f64 {
        self.look(equations);
        let pattern = equations.pattern();
        let mut values = vec![0.0; pattern.entries()];
        let time = &self.lengths.terms[1];
        equations.pattern_values(&self.d[0], time, &mut values);
        let (least, largest) = extreme_pivots(pattern, &values, equations.m);
        least / largest
    }

    /// The largest entry of the residual from which the last correction was computed.
    pub fn largest_residual(&self, equations: &Equations) -> f64 {
        greatest(&self.f[..equations.m])
    }
}
