//! From bounds in the norm |·|_u to the longest tube that they prove (see `tube.rs`).

use super::low_orders::LowOrders;
use crate::interval::rounding::{in_range, round_up};
use crate::places::Each as _;
use crate::track::certified::proof::{ATTEMPTS, Contraction, Proof, longest};
use crate::track::certified::shortfall::Shortfall;
use crate::track::full::{MAX_DEGREE, ORDER};

/// Bounds in the norm |·|_u, up to the factors that depend on h.
#[derive(Debug, Clone, Copy)]
pub(in crate::track) struct Norms {
    /// |A|, |A₂|, |A² − A₂|.
    pub a: f64,
    pub a2: f64,
    pub square: f64,
    /// |R₀|, and rounding of all of the computed products.
    pub r0: f64,
    /// |Σ_{k≥3} sᵏ Y J_k| at |s| = `h`.
    pub higher: f64,
    /// |Y J'(w)| per |w|_u.
    pub width: f64,
    /// |Y F(ẑ(s))| at |s| = `h`: orders up to ORDER with rounding, ORDER + 1, and above.
    pub low: LowOrders,
    pub middle: f64,
    pub high: f64,
    /// |ẑ'(s)|_u for |s| ≤ `h`, and the bound on |ẑ_t'(s)| in it.
    pub slope: f64,
    pub slope_of_t: f64,
    /// Σ |c_i| u_i.
    pub normal: f64,
    /// Where the bounds that depend on s were taken; they hold below.
    pub h: f64,
    /// The path is wanted nearer than this to ẑ(s); not a bound, but a wish.
    pub radius: f64,
}

impl Norms {
    pub fn is_in_range(&self) -> bool {
        [
            self.a,
            self.a2,
            self.square,
            self.r0,
            self.higher,
            self.width,
            self.low.at(1.0),
            self.middle,
            self.high,
            self.slope,
            self.slope_of_t,
            self.h,
        ]
        .into_iter()
        .all(in_range)
    }

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

    /// The contraction without the width, the factor of the width, and the defect, at `h`.
    /// Sums of fewer than 60 roundings, covered by the factor.
    pub(in crate::track) fn at(&self, h: f64) -> (f64, f64, f64) {
        let moving = 1.0 + h * self.a;
        let x = h / self.h;
        let x3 = x * x * x;
        let x6 = x3 * x3;
        let contraction =
            moving * (self.r0 + self.higher * x3) + h * h * (self.square + h * (self.a * self.a2));
        let defect = moving * (self.low.at(x) + self.middle * x6 + self.high * (x6 * x));
        (
            round_up(contraction, 60),
            round_up(moving * self.width, 60),
            round_up(defect, 60),
        )
    }

    /// The largest provable h.
    pub fn longest(&self, weight_of_t: f64) -> Option<Proof> {
        const {
            assert!(
                ORDER + 1 == 6,
                "the powers in `at` are those of the Taylor order"
            )
        };
        longest(self.h, 0.5, |h| self.proof(h, weight_of_t).ok())
    }

    /// Why there is none, at the length that comes nearest.
    pub fn shortfall(&self, weight_of_t: f64) -> Option<Shortfall> {
        let lengths = (0..=ATTEMPTS).map(|k| self.h * 0.5f64.powi(k));
        Shortfall::least(lengths.map(|h| self.proof(h, weight_of_t).err()))
    }

    pub(in crate::track) fn proof(&self, h: f64, weight_of_t: f64) -> Result<Proof, Shortfall> {
        let (contraction, width, defect) = self.at(h);
        let found = Contraction::new((contraction, width, defect), 0.5 / weight_of_t, self.radius)?;
        let distance = found.distance;
        // w' solves [J; c] w' = −[J(ẑ + w) ẑ'; 0], and J(ẑ + w) ẑ' = F(ẑ)' + J(ẑ)' w + ½ E⁽³⁾ w_t² ẑ_t'.
        // A power sᵏ gains a factor k/h, with k ≤ (MAX_DEGREE − 1) ORDER in J_k. For the low orders of F
        // with all rounding see `LowOrders::slope`.
        // In the last term, of the bend alone, ½ |E⁽³⁾| is below the curvature that `width` counts.
        let moving = 1.0 + h * self.a;
        let orders = [ORDER + 1, ORDER + 2, (MAX_DEGREE - 1) * ORDER].each(|k| k as f64 / h);
        let x = h / self.h;
        let x3 = x * x * x;
        let defect_slope = self.low.slope(self.h)
            + x3 * x3 * (orders[0] * self.middle + orders[1] * self.high * x);
        // Y J₁ and Y J₂ are A and A₂ up to rounding, which `r0` counts with that of all orders, at H.
        let rounding_slope = ((MAX_DEGREE - 1) * ORDER) as f64 / self.h * self.r0;
        let jacobian_slope =
            self.a + 2.0 * h * self.a2 + orders[2] * self.higher * x3 + rounding_slope;
        let slope = moving
            * (defect_slope
                + distance * (jacobian_slope + self.width * distance * self.slope_of_t));
        let slope_distance = round_up(slope / (1.0 - found.nearer_q), 400);
        found.proof(h, slope_distance, (self.slope, self.a), self.normal)
    }
}
