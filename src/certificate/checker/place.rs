//! Boxes around points of curves of F = 0: where one tube leads to the next, and the figures with t = 1.

use super::equations::{Equations, ZERO};
use super::guess::newton;
use super::krawczyk::{Fault, around, upper, weight};
use super::whole::size;
use crate::certificate::format::SolutionClaim;
use crate::interval::{Interval, point};

/// A box that holds a regular zero of F, the only one near it in its cross-section.
pub struct Place {
    /// The box: X, t, and a zero.
    pub figure: Vec<Interval>,
    /// A point in it.
    centre: Vec<Interval>,
    /// At most so far from that point, entry by entry, there is no other zero in the cross-section.
    alone_within: Vec<f64>,
    /// A vector along the curve, c·T = 1, at the zero or any other one within [`NEAR`] of that.
    pub tangent: Vec<Interval>,
    pub margin: f64,
}

/// Solutions are tested with the weight ½ for coordinates, and next to none for t.
const HALF: u16 = 1 << 15;
/// The distance, in weights, up to which a test can see.
const SIGHT: f64 = 1.0;
/// The part of that distance in which the direction of curves is known.
pub const NEAR: f64 = 1e-4;
impl Place {
    /// Proves that there is a zero near a point, in a cross-section c·z = const. Newton's steps
    /// towards it end below `enough`.
    pub fn prove(
        eq: &Equations,
        near: &[f64],
        c: &[f64],
        u: &[u16],
        enough: f64,
    ) -> Result<Place, Fault> {
        let (mut curve, inverse) = newton(eq, near, c, u, enough)?;
        let test = curve.test(&inverse.whole, c, u, point(SIGHT))?;
        // The test holds for ρ with stiff + width ρ below 1: nine tenths of the largest one.
        let alone = 0.9 * (0.9 - test.stiff.sup()) / test.width.sup();
        let alone = point(if alone > 0.0 { alone.min(SIGHT) } else { SIGHT });
        let proof = test.within(alone)?;
        // [J; c] U T = e_n, and with |I − Y [J; c] U| ≤ q, T is near the last column of Y, for J at any
        // point within `reach`.
        let column = inverse.whole.last_column();
        let largest = column.iter().fold(0.0, |max: f64, x| max.max(x.mag()));
        let reach = alone * point(2.0 * NEAR);
        let q = upper(test.stiff + test.width * reach);
        let off = match proof.distance.sup() < reach.inf() {
            true => around(q / (point(1.0) - q) * point(largest)),
            false => Interval::ENTIRE,
        };
        let weights = || u.iter().map(|&u| weight(u));
        let centre = curve.z.swap_remove(0);
        let radii = weights().map(|u| around(proof.distance * u)).chain([ZERO]);
        Ok(Place {
            figure: centre.iter().zip(radii).map(|(&x, r)| x + r).collect(),
            alone_within: weights().map(|u| (alone * u).inf()).collect(),
            tangent: column
                .iter()
                .zip(weights())
                .map(|(&x, u)| (x + off) * u)
                .collect(),
            centre,
            margin: proof.margin,
        })
    }

    /// Proves that a box holds exactly one solution of F(X, a(1)) = 0.
    pub fn solution(eq: &Equations, claim: &SolutionClaim) -> Result<Place, Fault> {
        let near: Vec<f64> = claim.centre.iter().copied().chain([1.0]).collect();
        let (mut c, mut u) = (vec![0.0; eq.m + 1], vec![HALF; eq.m + 1]);
        (c[eq.m], u[eq.m]) = (1.0, 1);
        let mut place = Place::prove(eq, &near, &c, &u, 0.0)?;
        let radius = around(point(claim.radius.into()));
        for i in 0..eq.m {
            let figure = point(near[i]) + radius;
            if !place.figure[i].interior(figure) {
                return Err("the solution near it does not lie in it for certain");
            }
            if !(size(figure - place.centre[i]).sup() < place.alone_within[i]) {
                return Err("it is so wide that it may hold another one");
            }
            place.figure[i] = figure;
        }
        if place.centre[eq.m] != point(1.0) {
            return Err("its cross-section is not t = 1");
        }
        place.figure[eq.m] = point(1.0);
        Ok(place)
    }

    /// Whether a box lies within a part of the distance in which this zero is alone: all zeros of
    /// F in it that lie in this place's cross-section are this one; if the part is [`NEAR`], the
    /// direction is known at all zeros in it.
    pub fn covers(&self, z: &[Interval], part: f64) -> bool {
        let near = |i: usize| size(z[i] - self.centre[i]).sup() < part * self.alone_within[i];
        (0..self.alone_within.len()).all(near)
    }

    /// Whether the curve, in the direction in which it leaves the cross-section, goes through
    /// another cross-section in its direction.
    pub fn goes_along(&self, normal: &[f64]) -> bool {
        let terms = self.tangent.iter().zip(normal);
        terms.fold(ZERO, |sum, (&x, &c)| sum + x * point(c)).inf() > 0.0
    }

    /// Whether the boxes have no point in common.
    pub fn is_apart(&self, other: &Place) -> bool {
        let pairs = self.figure.iter().zip(&other.figure);
        pairs.into_iter().any(|(a, b)| !(*a - *b).contains(0.0))
    }

    /// Whether two different solutions are congruent up to reflection. `None`: it cannot be told.
    ///
    /// The isometries that keep the gauge change signs of coordinates. The second reference
    /// point's first coordinate and the third's second tell which signs one of them has to change
    /// to make the figures equal; that of the last coordinate is free.
    pub fn is_congruent(&self, other: &Place, eq: &Equations) -> Option<bool> {
        let (gauge, d) = (&eq.homotopy.gauge, eq.homotopy.dimension);
        let mut turned = [false; 3];
        for (axis, &p) in gauge.reference.iter().skip(1).enumerate() {
            let i = gauge.variable[p * d + axis];
            let sides = self.figure[i] * other.figure[i];
            if sides.contains(0.0) {
                return None;
            }
            turned[axis] = sides.sup() < 0.0;
        }
        for last in [false, true] {
            turned[d - 1] = last;
            let image = (0..=eq.m).map(|i| match gauge.place.get(i) {
                Some(place) if turned[place % d] => -self.figure[i],
                _ => self.figure[i],
            });
            let image: Vec<Interval> = image.collect();
            // Without any change of sign they differ: their boxes are disjoint.
            if turned == [false; 3] {
                continue;
            }
            // The image is a solution too.
            if other.covers(&image, 1.0) {
                return Some(true);
            }
            let mut pairs = image.iter().zip(&other.figure);
            if pairs.all(|(a, b)| (*a - *b).contains(0.0)) {
                return None;
            }
        }
        Some(false)
    }
}
