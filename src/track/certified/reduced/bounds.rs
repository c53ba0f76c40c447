//! From bounds over a tube of reference length to the longest tube that they prove.

use crate::interval::rounding::{in_range, round_up};
use crate::track::certified::norms::{MAX_CONTRACTION, Proof};
use crate::track::full::MAX_DEGREE;

/// Bounds in the norm |v|_ρ = max |v_i|/ρ_i of a box of size ρ, taken for |s| ≤ `h`.
#[derive(Debug, Clone, Copy, Default)]
pub struct Bounds {
    /// Of the operator's derivative at the middle: what does not get smaller with s, and what does
    /// like s³.
    pub constant: f64,
    pub cubic: f64,
    /// Its change over the box, of size 1.
    pub width: f64,
    /// Of the operator at the middle: what does not get smaller, and what does like s^N.
    pub low: f64,
    pub high: f64,
    /// What |w|_ρ ≤ 1 adds to the right-hand side of the path's derivative.
    pub turn: f64,
    /// |ẑ'(s)|_ω, in the norm of the weights ω.
    pub slope: f64,
    /// Σ |c_i| ω_i.
    pub normal: f64,
    pub h: f64,
    /// Tubes are refused whose path may be further than this from the middle, in the box's size.
    pub radius: f64,
}

impl Bounds {
    pub fn is_in_range(&self) -> bool {
        [
            self.constant,
            self.cubic,
            self.width,
            self.low,
            self.high,
            self.turn,
            self.slope,
            self.h,
        ]
        .into_iter()
        .all(in_range)
    }

    /// The largest provable h with polynomials of N coefficients: by bisection on a logarithmic
    /// scale, as any h that passes will do.
    pub fn longest<const N: usize>(&self) -> Option<Proof> {
        if let Some(proof) = self.proof::<N>(self.h) {
            return Some(proof);
        }
        let (mut lo, mut hi) = (0.0, self.h);
        let mut best = None;
        for _ in 0..40 {
            let h = if lo == 0.0 {
                0.7 * hi
            } else {
                (lo * hi).sqrt()
            };
            match self.proof::<N>(h) {
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

    fn proof<const N: usize>(&self, h: f64) -> Option<Proof> {
        let x = h / self.h;
        let contraction = round_up(self.constant + self.cubic * (x * x * x), 20);
        let power = x.powi(N as i32);
        let defect = round_up(self.low + self.high * power, 40);
        let room = 1.0 - contraction;
        if !(contraction <= MAX_CONTRACTION && 8.0 * defect * self.width <= room * room) {
            return None;
        }
        let r = (0.5 * room / self.width).min(1.0);
        let q = round_up(contraction + self.width * r, 4);
        // The path is nearer than r: again with the width that is really needed, |v|_ρ ≤ η/(1 − q).
        let near = round_up(defect / (1.0 - q), 60);
        let nearer_q = round_up(contraction + self.width * near.min(r), 4);
        let distance = round_up(defect / (1.0 - nearer_q), 60);
        if !(q < 1.0 && round_up(defect + q * r, 4) < r && distance < r && distance <= self.radius)
        {
            return None;
        }
        // w' solves [J; c] w' = −[F(ẑ)' + (J(ẑ + w) − J(ẑ)) ẑ'; 0]. A power sᵏ of F gains a factor
        // k/h: in `high` k/N is counted already; in `low`, k ≤ MAX_DEGREE (N − 1) and the bound was
        // taken at H.
        let low = (MAX_DEGREE * N) as f64 / self.h * self.low;
        let high = N as f64 / h * (self.high * power);
        let slope = (low + high + distance * self.turn) / (1.0 - nearer_q);
        let slope_distance = round_up(slope, 80);
        // Otherwise no tube after this one could be proved to go the same way.
        if slope_distance * self.normal > 0.5 {
            return None;
        }
        Some(Proof {
            h,
            r,
            distance,
            slope_distance,
            q,
            slope: self.slope,
            moving: 0.0,
        })
    }
}
