//! From bounds over a tube of reference length to the longest tube that they prove.

use crate::interval::rounding::{in_range, round_up};
use crate::track::certified::proof::{Contraction, Proof, longest};
use crate::track::certified::shortfall::Shortfall;

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
    /// Of the operator's derivative by s at the middle: what does not get smaller.
    pub low_slope: f64,
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
            self.low_slope,
            self.turn,
            self.slope,
            self.h,
        ]
        .into_iter()
        .all(in_range)
    }

    /// The largest provable h with polynomials of N coefficients.
    pub fn longest<const N: usize>(&self) -> Option<Proof> {
        longest(self.h, 0.7, |h| self.proof::<N>(h).ok())
    }

    /// Why there is none of the half length `h`.
    pub fn shortfall<const N: usize>(&self) -> Option<Shortfall> {
        self.proof::<N>(self.h).err()
    }

    pub fn proof<const N: usize>(&self, h: f64) -> Result<Proof, Shortfall> {
        let x = h / self.h;
        let contraction = round_up(self.constant + self.cubic * (x * x * x), 20);
        let power = x.powi(N as i32);
        let defect = round_up(self.low + self.high * power, 40);
        let found = Contraction::new((contraction, self.width, defect), 1.0, self.radius)?;
        // w' solves [J; c] w' = −[F(ẑ)' + (J(ẑ + w) − J(ẑ)) ẑ'; 0]. The powers sᵏ of F that
        // get smaller gain a factor k/h, of which `high` counts k/N already; the derivative of the rest
        // was bounded by itself, as most of that is rounding in F(z₀), which has none.
        let high = N as f64 / h * (self.high * power);
        let slope = (self.low_slope + high + found.distance * self.turn) / (1.0 - found.nearer_q);
        let slope_distance = round_up(slope, 80);
        found.proof(h, slope_distance, (self.slope, 0.0), self.normal)
    }
}
