//! From bounds in the norm |·|_u to the longest tube that they prove (see `tube.rs`).

use super::low_orders::LowOrders;
use super::shortfall::{MAX_CONTRACTION, Shortfall};
use crate::interval::rounding::{in_range, round_up};
use crate::track::full::{MAX_DEGREE, ORDER};

/// What is proved of a tube.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Proof {
    /// The tube reaches over |s| ≤ h.
    pub h: f64,
    /// In the box |w|_u ≤ `r` around ẑ(s) the path is the only zero of the cross-section.
    pub r: f64,
    /// The path is at most that far from ẑ(s).
    pub distance: f64,
    /// The path's derivative by s is at most that far from ẑ'(s).
    pub slope_distance: f64,
    /// The bound on |M|_u.
    pub q: f64,
    /// |ẑ'(s)|_u on the tube.
    pub slope: f64,
    /// |A|_u.
    pub moving: f64,
}

/// Bounds in the norm |·|_u, up to the factors that depend on h.
#[derive(Debug, Clone, Copy)]
pub(super) struct Norms {
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
    pub(super) fn at(&self, h: f64) -> (f64, f64, f64) {
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

    pub(super) fn proof(&self, h: f64, weight_of_t: f64) -> Result<Proof, Shortfall> {
        let (contraction, width, defect) = self.at(h);
        let Contraction {
            r,
            q,
            nearer_q,
            distance,
        } = Contraction::new((contraction, width, defect), 0.5 / weight_of_t, self.radius)?;
        // w' solves [J; c] w' = −[J(ẑ + w) ẑ'; 0], and J(ẑ + w) ẑ' = F(ẑ)' + J(ẑ)' w + ½ E⁽³⁾ w_t² ẑ_t'.
        // A power sᵏ gains a factor k/h, with k ≤ (MAX_DEGREE − 1) ORDER in J_k. For the low orders of F
        // with all rounding see `LowOrders::slope`.
        // In the last term, of the bend alone, ½ |E⁽³⁾| is below the curvature that `width` counts.
        let moving = 1.0 + h * self.a;
        let orders = [ORDER + 1, ORDER + 2, (MAX_DEGREE - 1) * ORDER].map(|k| k as f64 / h);
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
        let slope_distance = round_up(slope / (1.0 - nearer_q), 400);
        // Otherwise no tube after this one could be proved to go the same way.
        let direction = slope_distance * self.normal;
        let is_known = direction <= 0.5;
        if !is_known {
            return Err(Shortfall::Direction(direction));
        }
        Ok(Proof {
            h,
            r,
            distance,
            slope_distance,
            q,
            slope: self.slope,
            moving: self.a,
        })
    }
}

/// What follows where a map is bounded on the box |w| ≤ r, in any norm, by its defect |Φ(0)| and by
/// |Φ'| ≤ contraction + width · r.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contraction {
    /// In a box of this size the fixed point is the only one.
    pub r: f64,
    /// The bound on |Φ'| there, and as far out as the fixed point may be.
    pub q: f64,
    pub nearer_q: f64,
    /// It is at most that far out.
    pub distance: f64,
}

impl Contraction {
    /// The largest box that leaves room, at most of size `largest`. The error: there is none, or the fixed
    /// point might be further out than `radius`.
    pub fn new(
        (contraction, width, defect): (f64, f64, f64),
        largest: f64,
        radius: f64,
    ) -> Result<Self, Shortfall> {
        let room = 1.0 - contraction;
        // Beyond this the box would be too narrow to be linked, or the proof too close to call.
        if contraction.is_nan() || contraction > MAX_CONTRACTION {
            return Err(Shortfall::Contraction(contraction));
        }
        let room_for = |room: f64| Shortfall::Defect { defect, room };
        let is_enough = 8.0 * defect * width <= room * room;
        if !is_enough {
            return Err(room_for(room * room / (8.0 * width)));
        }
        let r = (0.5 * room / width).min(largest);
        let q = round_up(contraction + width * r, 4);
        // The fixed point is nearer than r: again with the width that is really needed, η/(1 − q).
        let near = round_up(defect / (1.0 - q), 400);
        let nearer_q = round_up(contraction + width * near.min(r), 4);
        let distance = round_up(defect / (1.0 - nearer_q), 400);
        if !(q < 1.0 && round_up(defect + q * r, 4) < r && distance < r) {
            return Err(room_for((1.0 - q) * r));
        }
        let is_near = distance <= radius;
        if !is_near {
            return Err(Shortfall::Distance { distance, radius });
        }
        Ok(Contraction {
            r,
            q,
            nearer_q,
            distance,
        })
    }
}

/// [`longest`] tries so many lengths.
const ATTEMPTS: i32 = 40;

/// The longest tube of at most the half length `h` that is proved: by bisection on a logarithmic
/// scale, as any that passes will do. `shrink`: what is tried next while none has passed.
pub(super) fn longest(h: f64, shrink: f64, proof: impl Fn(f64) -> Option<Proof>) -> Option<Proof> {
    if let Some(proof) = proof(h) {
        return Some(proof);
    }
    let (mut lo, mut hi) = (0.0, h);
    let mut best = None;
    for _ in 0..ATTEMPTS {
        let h = if lo == 0.0 {
            shrink * hi
        } else {
            (lo * hi).sqrt()
        };
        match proof(h) {
            Some(proof) => {
                best = Some(proof);
                lo = h;
                if hi / lo < 1.02 {
                    break;
                }
            }
            None => hi = h,
        }
    }
    best
}

/// 1, h, h², …: the last with as many roundings as its power.
pub(super) fn powers_of<const POWERS: usize>(h: f64) -> [f64; POWERS] {
    let mut powers = [1.0; POWERS];
    for k in 1..POWERS {
        powers[k] = powers[k - 1] * h;
    }
    powers
}
