//! What is proved of a tube, and how it follows from a contraction, in either space.

use super::reasons::Doubt;
use super::shortfall::{MAX_CONTRACTION, Shortfall};
use crate::interval::rounding::{greatest, round_up};

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

    /// What is proved of a tube of the half length `h` in whose box this holds: the path's derivative is that near to ẑ', of
    /// which, and of A, the sizes are known. `normal`: Σ |c_i| u_i.
    pub fn proof(
        self,
        h: f64,
        slope_distance: f64,
        (slope, moving): (f64, f64),
        normal: f64,
    ) -> Result<Proof, Shortfall> {
        // Otherwise no tube after this one could be proved to go the same way.
        let direction = slope_distance * normal;
        let is_known = direction <= 0.5;
        if !is_known {
            return Err(Shortfall::Direction(direction));
        }
        Ok(Proof {
            h,
            r: self.r,
            distance: self.distance,
            slope_distance,
            q: self.q,
            slope,
            moving,
        })
    }
}

/// The end of Krawczyk's test at a point x with the norm max |w_i|: with |I − Y Φ'(x + w)| ≤ q₀ + κ |w| and a bound on |Y Φ(x)|,
/// entry by entry, how far around x there is no more than one zero (at most `most`), and how far one is in an entry,
/// by that bound for it. `reach`: what is to be within that distance if the zero is so far from x.
pub fn zero_near(
    (q0, kappa, most): (f64, f64, f64),
    step: &[f64],
    reach: impl FnOnce(f64) -> f64,
) -> Result<(f64, impl Fn(f64) -> f64), Doubt> {
    let n = step.len();
    let alone = (0.9 * (0.9 - q0) / kappa).min(most);
    let q = round_up(q0 + kappa * alone, 4);
    let all = round_up(round_up(greatest(step), n + 2) / (1.0 - q), 60);
    let radius = reach(all);
    if !(q < 1.0 && radius < 0.99 * alone) {
        return Err(Doubt::Wide { radius, alone });
    }
    // |x* − x| ≤ |Y Φ(x)| + |M| |x* − x|, entry by entry, with |M| at the distance just proved.
    let near = round_up((q0 + kappa * all) * all, 6);
    Ok((alone, move |step: f64| round_up(step + near, n + 8)))
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
