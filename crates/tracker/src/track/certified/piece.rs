//! Where the path is between two parameters of a tube, to first order, and what is computed from that.

use super::link::{Frame, Tube};
use crate::equations::Ring;
use crate::interval::rounding::{gamma, round_up};
use crate::linalg::Vector;
use crate::track::arc::Figure;
use std::ops::{Add, Mul, Sub};

/// A piece of path: each entry is `middle` + θ `slope`, −1 ≤ θ ≤ 1, and something of at most `radius`.
#[derive(Debug)]
pub struct Piece {
    middle: Vector,
    slope: Vector,
    radius: Vector,
    /// Work space.
    curvature: Vector,
    size: Vector,
}

impl Piece {
    /// Room for vectors like this one.
    pub fn new(spare: &Vector) -> Self {
        Piece {
            middle: spare.clone(),
            slope: spare.clone(),
            radius: spare.clone(),
            curvature: spare.clone(),
            size: spare.clone(),
        }
    }

    /// The figure that a path sets out from; nothing is said of t.
    pub fn stand(&mut self, figure: &Figure) {
        let m = figure.centre.len();
        self.middle[..m].copy_from_slice(&figure.centre);
        for i in 0..m {
            self.radius[i] = round_up(figure.radius[i] + figure.low[i].abs(), 1);
        }
        self.slope.fill(0.0);
    }

    /// An entry: an unknown by its number, then t, then the number 0.
    #[inline]
    pub fn at(&self, i: usize) -> Along {
        Along {
            value: self.middle[i],
            slope: self.slope[i],
            rest: self.radius[i],
        }
    }

    /// t.
    pub fn time(&self) -> Along {
        self.at(self.middle.len() - 2)
    }

    /// Whether an entry is the last one, the number 0.
    pub fn is_last(&self, i: usize) -> bool {
        i + 1 == self.middle.len()
    }

    /// Encloses the path between two parameters of a tube: with c in the middle and r the largest parameter in size, the tube's
    /// polynomial p(s) differs from p(c) + p'(c)(s − c) by at most the sum of k(k − 1)/2 |p_k| rᵏ⁻² times (s − c)².
    pub fn look<const N: usize, Y: Frame>(&mut self, tube: &Tube<N, Y>, a: f64, b: f64) {
        // All unknowns, and t.
        let n = tube.weights.len() - 1;
        let (z, proof) = (&tube.local.z, &tube.proof);
        let middle = 0.5 * (a + b);
        let half = round_up((b - middle).max(middle - a), 4);
        let reach = a.abs().max(b.abs());
        // A coefficient goes through at most 2N roundings in Horner's scheme for the slope.
        let rounding = gamma(4 * N);
        // One order after the other of all entries together. `radius` is the sum of the sizes of the slope's terms at first.
        let values = &mut self.middle[..n];
        let slopes = &mut self.slope[..n];
        let changes = &mut self.radius[..n];
        let curvatures = &mut self.curvature[..n];
        let sizes = &mut self.size[..n];
        values.fill(0.0);
        slopes.fill(0.0);
        changes.fill(0.0);
        curvatures.fill(0.0);
        sizes.fill(0.0);
        for k in (0..N).rev() {
            let sums = values.iter_mut().zip(&mut *slopes).zip(&mut *changes);
            let sums = sums.zip(&mut *curvatures).zip(&mut *sizes);
            for (((((value, slope), change), curvature), size), &z) in sums.zip(&z[k][..n]) {
                *slope = slope.mul_add(middle, *value);
                *value = value.mul_add(middle, z);
                *curvature = curvature.mul_add(reach, *change);
                *change = change.mul_add(reach, *size);
                *size = size.mul_add(reach, z.abs());
            }
        }
        let (weights, low) = (&tube.weights[..n], &tube.local.low[..n]);
        for i in 0..n {
            slopes[i] *= half;
            let bent = curvatures[i] * half * half + proof.distance * weights[i];
            // The last one is of the product above.
            let rounded =
                rounding * (sizes[i] + changes[i] * half) + f64::EPSILON * slopes[i].abs();
            changes[i] = round_up(bent + rounded + low[i].abs(), 8 * N);
        }
    }
}

/// A number on a piece of the path: `value` + θ `slope`, −1 ≤ θ ≤ 1, and something of at most `rest`, which holds the roundings of
/// the other two; its own, relative ones, are for the reader to count.
#[derive(Debug, Clone, Copy)]
pub struct Along {
    /// In the middle of the piece.
    pub value: f64,
    slope: f64,
    rest: f64,
}

impl Along {
    /// A number that is the same all along, up to a radius.
    pub fn constant(value: f64, radius: f64) -> Self {
        Along {
            value,
            slope: 0.0,
            rest: radius,
        }
    }

    /// How far it may be from `value`, where a term of `rest` went through at most so many roundings.
    pub fn reach(self, roundings: usize) -> f64 {
        round_up(self.slope.abs() + self.rest, roundings)
    }
}

impl Ring for Along {
    fn whole(number: i32) -> Self {
        Along::constant(number.into(), 0.0)
    }
}

impl Add for Along {
    type Output = Self;

    #[inline]
    fn add(self, other: Along) -> Along {
        let (value, slope) = (self.value + other.value, self.slope + other.slope);
        let rounded = f64::EPSILON * (value.abs() + slope.abs());
        Along {
            value,
            slope,
            rest: self.rest + other.rest + rounded,
        }
    }
}

impl Sub for Along {
    type Output = Self;

    #[inline]
    fn sub(self, other: Along) -> Along {
        self + Along {
            value: -other.value,
            slope: -other.slope,
            ..other
        }
    }
}

impl Mul for Along {
    type Output = Self;

    /// With x = v + θs + e and y = v' + θs' + e': xy − vv' − θ(sv' + vs') is at most (|s| + |e|)(|s'| + |e'|) + |v e'| + |e v'|.
    #[inline]
    fn mul(self, other: Along) -> Along {
        let (v, s, e) = (self.value, self.slope, self.rest);
        let (w, t, f) = (other.value, other.slope, other.rest);
        let (value, one, two) = (v * w, s * w, v * t);
        // Three roundings to nearest at most in the slope, one in the value, each half an epsilon.
        let rounded = f64::EPSILON * (value.abs() + one.abs() + two.abs());
        let product = (s.abs() + e) * (t.abs() + f) + (v.abs() * f + e * w.abs());
        Along {
            value,
            slope: one + two,
            rest: product + rounded,
        }
    }
}
