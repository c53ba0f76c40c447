//! The part of |Y F(ẑ(s))| that shorter tubes do not get rid of: orders up to ORDER, and rounding.

use super::norms::Norms;
use crate::track::full::DEGREE;

/// Bounds for |s| ≤ H, where they were taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum LowOrders {
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

impl Norms {
    /// Whether rounding, and what is left of F at the middle, are all that keeps tubes from being
    /// proved: without them one could be. A tube that is wanted narrower than it can be proved is none.
    pub fn is_limited_by_rounding(&self, weight_of_t: f64) -> bool {
        let with = Norms {
            radius: f64::INFINITY,
            ..*self
        };
        let without = Norms {
            low: LowOrders::Whole(0.0),
            ..with
        };
        let only_wanted = self.radius.is_finite() && with.longest(weight_of_t).is_some();
        !only_wanted && without.longest(weight_of_t).is_some()
    }
}
