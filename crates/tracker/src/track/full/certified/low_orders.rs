//! The part of |Y F(ẑ(s))| that shorter tubes do not get rid of: orders up to ORDER, and rounding.

use crate::track::full::DEGREE;

/// Bounds for |s| ≤ H, where they were taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::track) enum LowOrders {
    /// All of it, whatever s is: enough where tubes are as long as their curvature lets them be.
    Whole(f64),
    /// Order 0 with its rounding apart from the rest, for the short tubes of extended precision.
    Split {
        /// Of F(z₀).
        constant: f64,
        /// Of all orders k ≥ 1, each k times: it gets smaller at least as fast as s.
        rest: f64,
    },
}

impl LowOrders {
    /// The bound for |s| ≤ x H, x ≤ 1. At most two roundings.
    pub fn at(self, x: f64) -> f64 {
        match self {
            LowOrders::Whole(low) => low,
            LowOrders::Split { constant, rest } => constant + rest * x,
        }
    }

    /// A bound on the derivative by s: k |s|ᵏ⁻¹ ≤ k Hᵏ/H, and only orders k ≥ 1 have one, of which
    /// none is above DEGREE. At most two roundings.
    pub fn slope(self, h: f64) -> f64 {
        match self {
            LowOrders::Whole(low) => DEGREE as f64 / h * low,
            LowOrders::Split { rest, .. } => rest / h,
        }
    }
}
