//! What is proved of a tube, and how it follows from a contraction, in either space.

use super::shortfall::{MAX_CONTRACTION, Shortfall};
use crate::interval::rounding::round_up;

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

/// What follows where a map is bounded on the box |w| ≤ r, in any norm, by its defect |Φ(0)| and by
/// |Φ'| ≤ contraction + width · r.
#[derive(Debug, Clone, Copy)]
pub struct Contraction {
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
pub const ATTEMPTS: i32 = 40;

/// The longest tube of at most the half length `h` that is proved: by bisection on a logarithmic
/// scale, as any that passes will do. `shrink`: what is tried next while none has passed.
pub fn longest(h: f64, shrink: f64, proof: impl Fn(f64) -> Option<Proof>) -> Option<Proof> {
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
pub fn powers_of<const POWERS: usize>(h: f64) -> [f64; POWERS] {
    let mut powers = [1.0; POWERS];
    for k in 1..POWERS {
        powers[k] = powers[k - 1] * h;
    }
    powers
}
