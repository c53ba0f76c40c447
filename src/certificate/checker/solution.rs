//! The boxes around the figures with t = 1.

use super::equations::{Equations, ZERO};
use super::tube::{magnitudes, upper};
use super::whole::{Whole, exact, invert, size};
use crate::certificate::format::{SolutionClaim, WEIGHT_UNIT};
use crate::interval::{Interval, point};

/// A box that holds exactly one solution of F(X, a(1)) = 0.
pub struct Solution {
    /// The box: X, then t = 1, and a zero.
    pub figure: Vec<Interval>,
    centre: Vec<Interval>,
    /// At most so far from the middle, in every entry, there is no other solution.
    alone_within: Interval,
    /// 1 − q − η/r of Krawczyk's test.
    pub margin: f64,
}

impl Solution {
    /// Proves a box: with the norm max |w_i|, |I − Y J(x + w)| ≤ q₀ + κ |w|, so that where
    /// |Y F(x)| < (1 − q) a for q = q₀ + κ a there is exactly one solution at most a from x.
    pub fn prove(eq: &Equations, claim: &SolutionClaim) -> Result<Solution, &'static str> {
        const LARGE: &str = "its numbers are too large for the test";
        let (m, n) = (eq.m, eq.m + 1);
        let one = point(1.0);
        let centre = claim.centre.iter().map(|&x| point(x));
        let centre: Vec<Interval> = centre.chain([one, ZERO]).collect();
        let ones = vec![1u16; n];
        let mut u = vec![one; n];
        u.push(ZERO);

        // The last row asks for t = 1, so that the entries of t do not count.
        let d = eq.differences(&centre);
        let mut last = vec![0.0; n];
        last[m] = 1.0;
        let time = vec![ZERO; m];
        let y = invert(n, eq.float_matrix(&d, &time, &last)).ok_or("its Jacobian is singular")?;
        let y = Whole::nearest(n, &y).ok_or(LARGE)?;
        let (mut rows, mut rests) = eq.whole_rows(&d, &time).ok_or(LARGE)?;
        rows.push(vec![(m, 1 << super::whole::BITS)]);
        rests.push(ZERO);
        // All weights are 1, which is 2¹⁶ times the unit of weights.
        let norm = |v: &[Interval]| y.norm_of(v, &ones).map(|x| x * point(WEIGHT_UNIT));
        let q0 = y.defect(&rows, &ones).ok_or(LARGE)? + norm(&magnitudes(&rests)).ok_or(LARGE)?;
        let width = (0..m).map(|e| {
            let squares = |sum, w: &Interval| sum + w.sqr();
            eq.weight(e, &u).iter().fold(ZERO, squares)
        });
        let width: Vec<Interval> = width.chain([ZERO]).collect();
        let kappa = norm(&magnitudes(&width)).ok_or(LARGE)?;
        let alone = exact((0.9 * (0.9 - q0.sup()) / kappa.sup()).min(1e30));
        let q = upper(q0 + kappa * alone);

        let mut f = eq.residual(&d, |e| eq.homotopy.lengths[e].target_half_square());
        f.push(ZERO);
        let step = y.bounds(&f).ok_or(LARGE)?;
        let largest = exact(step.iter().fold(0.0, |max: f64, x| max.max(x.sup())));
        let margin = (one - q - largest / alone).inf();
        if !(alone.inf() > 0.0 && q.sup() < 1.0 && margin > 0.0) {
            return Err("the Krawczyk test fails");
        }
        // |x* − x| ≤ |Y F(x)| + |M| |x* − x|, entry by entry, with |M| that near.
        let all = upper(largest / (one - q));
        let near = (q0 + kappa * all) * all;
        for (step, &radius) in step.iter().zip(&claim.radius) {
            let radius = f64::from(radius);
            if !((*step + near).sup() < radius && radius < alone.inf()) {
                return Err("the solution near it does not lie in it for certain");
            }
        }
        let radii = claim
            .radius
            .iter()
            .map(|&r| super::tube::around(point(r.into())));
        let radii = radii.chain([ZERO; 2]);
        Ok(Solution {
            figure: centre.iter().zip(radii).map(|(&x, r)| x + r).collect(),
            centre,
            alone_within: alone,
            margin,
        })
    }

    /// Whether the boxes have no point in common.
    pub fn is_apart(&self, other: &Solution) -> bool {
        let pairs = self.figure.iter().zip(&other.figure);
        pairs.into_iter().any(|(a, b)| !(*a - *b).contains(0.0))
    }

    /// Whether the two boxes' different solutions are congruent up to reflection. `None`: it
    /// cannot be told.
    ///
    /// The isometries that keep the gauge change signs of coordinates. The second reference
    /// point's first coordinate and the third's second tell which signs one of them has to change
    /// to make the figures equal; that of the last coordinate is free.
    pub fn is_congruent(&self, other: &Solution, eq: &Equations) -> Option<bool> {
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
            // Without any change of sign they differ: their boxes are disjoint.
            if turned != [false; 3] && self.is_image(other, turned, eq)? {
                return Some(true);
            }
        }
        Some(false)
    }

    /// Whether the other box holds this one's solution with signs changed along some axes.
    fn is_image(&self, other: &Solution, turned: [bool; 3], eq: &Equations) -> Option<bool> {
        let (mut apart, mut same) = (false, true);
        for i in 0..eq.m {
            let axis = eq.homotopy.gauge.place[i] % eq.homotopy.dimension;
            let x = if turned[axis] {
                -self.figure[i]
            } else {
                self.figure[i]
            };
            apart |= !(x - other.figure[i]).contains(0.0);
            same &= size(x - other.centre[i]).sup() < other.alone_within.inf();
        }
        // The image is a solution too, and the other is the only one that near.
        if same {
            Some(true)
        } else {
            apart.then_some(false)
        }
    }
}
