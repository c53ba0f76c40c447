//! Boxes around points of curves of F = 0, and the figures with t = 1.

use super::equations::{Equations, ZERO};
use super::guess::newton;
use super::krawczyk::{Section, around};
use super::matrix::{along, enclosed, exact, halves, lost, size};
use super::refute;
use crate::certificate::format::WEIGHT_UNIT;
use crate::certificate::format::{SolutionClaim, TubeClaim};
use crate::certificate::verdict::Fault;
use crate::interval::rounding::round_up;
use crate::interval::{Interval, point};

/// An enclosure of a point of a curve of F = 0, in n entries: exactly known floats, and what has to be
/// added to them.
#[derive(Clone)]
pub struct Spot {
    pub near: Vec<f64>,
    pub rest: Vec<Interval>,
}

impl Spot {
    /// An enclosure, entry by entry.
    pub fn around(z: &[Interval]) -> Spot {
        Spot {
            near: z.iter().map(|x| x.mid()).collect(),
            rest: z.iter().map(|&x| x - point(x.mid())).collect(),
        }
    }

    /// All of its entries.
    pub fn entries(&self) -> Vec<Interval> {
        (0..self.near.len()).map(|i| self.at(i)).collect()
    }

    /// One of its entries.
    pub fn at(&self, i: usize) -> Interval {
        exact(self.near[i]) + self.rest[i]
    }

    /// Its difference from a point.
    pub fn minus(&self, other: &[f64], i: usize) -> Interval {
        (exact(self.near[i]) - exact(other[i])) + self.rest[i]
    }

    /// Whether its first entries are certainly no further from a claimed figure than this. Boxes as intervals would not tell: their
    /// ends are rounded outwards.
    pub fn is_within(&self, centre: &[f64], radius: f32) -> bool {
        let off = |i: usize| size(self.minus(centre, i)).sup();
        (0..centre.len()).all(|i| off(i) <= radius.into())
    }

    /// [J; c] v − e_n at this point.
    pub fn off_direction(&self, eq: &Equations, at: &Section, v: &[f64]) -> Vec<Interval> {
        let t = self.at(eq.m);
        let near = eq.differences(&self.near, [0.0, 1.0]);
        let rest = |i: usize| if i < eq.m { self.rest[i].mag() } else { 0.0 };
        let row = |e: usize| {
            let (mut sum, mut sizes, mut errors) = (0.0, 0.0, 0.0);
            for &(i, factor, form) in &eq.gradient[e] {
                let (by, [from, to]) = (0.5 * factor as f64 * v[i], eq.forms[form]);
                sum += by * near[form];
                sizes += (by * near[form]).abs();
                errors += by.abs() * (rest(from) + rest(to));
            }
            let time = eq.right_at(e, t)[1] * exact(v[eq.m]);
            // A difference, its product with factor and direction, and the sums.
            enclosed(sum, lost(sizes, eq.longest + 3, errors)) - time
        };
        let along = along(v, &at.c) - point(1.0);
        (0..eq.m).map(row).chain([along]).collect()
    }
}

/// The component of the vectors in a box along another one.
pub fn component(direction: &[Interval], normal: &[f64]) -> Interval {
    let (middles, radii): (Vec<f64>, Vec<f64>) = direction.iter().map(|&x| halves(x)).unzip();
    let radii = radii.iter().zip(normal).map(|(r, c)| r * c.abs()).sum();
    along(&middles, normal) + around(exact(round_up(radii, normal.len() + 1)))
}

/// A figure with t = 1, the only one in its box; or a point where other equations and a cross-section meet.
pub struct Place {
    /// Where it is.
    pub spot: Spot,
    /// Where the test was made.
    middle: Vec<Interval>,
    /// The box that was claimed, in m entries, rounded outwards; of a fold none.
    pub claimed: Vec<Interval>,
    /// At most so far from `middle`, entry by entry, there is no other one.
    alone_within: Vec<f64>,
    pub margin: f64,
}

/// Solutions are tested with the weight ½ for coordinates, and next to none for t.
pub const HALF: f64 = 0.5;
/// The distance, in weights, up to which a test can see.
const SIGHT: f64 = 1.0;

impl Place {
    /// Proves that a box holds exactly one solution of F(X, a(1)) = 0, in the precision of the tube that comes there, or a finer one.
    pub fn solution(eq: &Equations, claim: &SolutionClaim, at: &TubeClaim) -> Result<Place, Fault> {
        let radius = around(point(claim.radius.into()));
        let claimed: Vec<Interval> = claim.centre.iter().map(|&x| point(x) + radius).collect();
        let prove = |extended| Place::at_target(eq, (&claim.centre, extended), claimed.clone());
        let held = |p: &Place| p.spot.is_within(&claim.centre, claim.radius) && p.covers(&claimed);
        // Where some unknowns are large, others small, 53 bits of the largest may tell a point less well than the claim.
        let place = match prove(!at.low.is_empty()) {
            Ok(place) if held(&place) => Ok(place),
            coarse => prove(true).or(coarse),
        };
        if refute::empty(eq, &claimed, place.as_ref().ok()) {
            return Err(Fault::proof("there is none in it"));
        }
        let wrong =
            "it is too narrow to hold the one near it, or so wide that it may hold another one";
        place.and_then(|place| held(&place).then_some(place).ok_or(Fault::because(wrong)))
    }

    /// Proves that near these unknowns there is exactly one solution of F(X, a(1)) = 0.
    pub fn at_target(
        eq: &Equations,
        (near, extended): (&[f64], bool),
        claimed: Vec<Interval>,
    ) -> Result<Place, Fault> {
        let near: Vec<f64> = near.iter().copied().chain([1.0]).collect();
        let (mut c, mut u) = (vec![0.0; eq.m + 1], vec![HALF; eq.m + 1]);
        (c[eq.m], u[eq.m]) = (1.0, WEIGHT_UNIT);
        let mut place = Place::prove(eq, (&near, extended), (&c, &u), claimed)?;
        // In this cross-section t is what it is in the middle.
        place.spot.rest[eq.m] = ZERO;
        // F(X) is quadratic: between two zeros, in the middle, J is singular, and no such place is within these distances. So another zero
        // is twice as far away, less what this one is off.
        for (i, alone) in place.alone_within.iter_mut().enumerate().take(eq.m) {
            let off = size(place.spot.at(i) - place.middle[i]);
            *alone = alone.max((point(2.0) * exact(*alone) - off).inf());
        }
        let other = Fault::because("its cross-section is not t = 1");
        let is_there = place.middle[eq.m] == point(1.0) && place.spot.near[eq.m] == 1.0;
        is_there.then_some(place).ok_or(other)
    }

    /// Proves that near a point there is a zero of F in a cross-section with this normal.
    pub fn prove(
        eq: &Equations,
        (near, extended): (&[f64], bool),
        (c, u): (&[f64], &[f64]),
        claimed: Vec<Interval>,
    ) -> Result<Place, Fault> {
        let (curve, inverse) = newton(eq, (near, extended), c, u)?;
        let at = curve.section(c, u);
        let test = curve.test(&inverse, &at, point(SIGHT));
        // The test holds for ρ with stiff + width ρ below 1: nine tenths of the largest one.
        let alone = 0.9 * (0.9 - test.stiff.sup()) / test.width.sup();
        let alone = point(if alone > 0.0 { alone.min(SIGHT) } else { SIGHT });
        let proof = test.within(alone)?;
        let near = curve.z[0].clone();
        let weights = || u.iter().map(|&u| point(u));
        let low = || (0..near.len()).map(|i| curve.low_of(i));
        let rest = weights().zip(low());
        let rest = rest.map(|(u, low)| low + around(proof.distance * u));
        Ok(Place {
            middle: near.iter().zip(low()).map(|(&x, y)| exact(x) + y).collect(),
            spot: Spot {
                rest: rest.collect(),
                near: near.clone(),
            },
            claimed,
            alone_within: weights().map(|u| (alone * u).inf()).collect(),
            margin: proof.margin,
        })
    }

    /// The same point in other unknowns, in which other solutions may be as near as one likes: what `carry` makes of a box.
    pub fn carried(&self, carry: impl Fn(&[Interval]) -> Vec<Interval>) -> Place {
        let with_time = [&self.claimed[..], &[point(1.0)]].concat();
        let mut claimed = carry(&with_time);
        claimed.pop();
        let spot = Spot::around(&carry(&self.spot.entries()));
        Place {
            middle: spot.near.iter().map(|&x| exact(x)).collect(),
            alone_within: vec![0.0; spot.near.len()],
            claimed,
            margin: self.margin,
            spot,
        }
    }

    /// Whether a box of coordinates lies where this figure is the only one with t = 1.
    pub fn covers(&self, z: &[Interval]) -> bool {
        (0..z.len()).all(|i| self.covers_at(i, z[i]))
    }

    /// The same of one of its entries.
    pub fn covers_at(&self, i: usize, x: Interval) -> bool {
        size(x - self.middle[i]).sup() < self.alone_within[i]
    }

    /// Whether the claimed boxes have no point in common.
    pub fn is_apart(&self, other: &Place) -> bool {
        let mut pairs = self.claimed.iter().zip(&other.claimed);
        pairs.any(|(a, b)| a.disjoint(*b))
    }

    /// Whether two different solutions are congruent up to reflection. `None`: it cannot be told.
    ///
    /// The isometries that keep the gauge reverse axes. The second reference point's first coordinate
    /// and the third's second tell which axes one of them has to reverse to make the figures equal; the
    /// last axis is free, unless constraints say which way round the figure is. Where they fix the figure in
    /// its frame, no isometry is left.
    pub fn is_congruent(&self, other: &Place, eq: &Equations) -> Option<bool> {
        let (gauge, d) = (&eq.homotopy.gauge, eq.homotopy.dimension);
        let twins = eq.homotopy.twins()?;
        let mut turned = [false; 3];
        for (axis, &p) in gauge.reference.iter().skip(1).enumerate() {
            let i = gauge.variable[p * d + axis];
            let sides = self.spot.at(i) * other.spot.at(i);
            if sides.contains(0.0) {
                return None;
            }
            turned[axis] = sides.sup() < 0.0;
        }
        for last in [false, true].into_iter().take(1 + gauge.reference.len()) {
            turned[d - 1] = last;
            let axes: Vec<usize> = (0..d).filter(|&axis| turned[axis]).collect();
            if axes.len() % 2 == 1 && !eq.homotopy.tail.mirrors {
                continue;
            }
            let image = |i: usize, twin: bool| {
                let flips = axes.iter().filter(|&&axis| eq.homotopy.flips(i, axis));
                let x = self.spot.at(i);
                [x, -x][usize::from((flips.count() % 2 == 1) ^ twin)]
            };
            let apart = |i: usize, twin: bool| image(i, twin).disjoint(other.spot.at(i));
            for twin in &twins {
                // Without any change of sign they differ: their boxes are disjoint.
                if axes.is_empty() && !twin.contains(&true) {
                    continue;
                }
                let image: Vec<Interval> = (0..eq.m).map(|i| image(i, twin[i])).collect();
                // The image is a solution too.
                if other.covers(&image) {
                    return Some(true);
                }
                if !(0..eq.m).any(|i| apart(i, twin[i])) {
                    return None;
                }
            }
            if eq.homotopy.may_be_reversed(&twins, apart) {
                return None;
            }
        }
        Some(false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::hull;
    use crate::problem::Problem;
    use crate::system::Homotopy;

    /// With b at (1.00000000000000003, 0) and c at (0.5, 0.5).
    fn triangle() -> Equations {
        let problem = Problem::parse(
            "dimension = 2\n[points]\na = [0, 0]\nb = [1, 0]\nc = [0.5, 0.6]\n[constraints]\n\
             distances = [[\"a\", \"b\", 1.00000000000000003]]\n\
             squared_distances = [[\"a\", \"c\", 0.5], [\"b\", \"c\", 0.5000000000000000300000000000000009]]\n\
             [homotopy]\nreference = [\"a\", \"b\"]\n",
            "test.toml",
        );
        Equations::new(Homotopy::with_unit(&problem.unwrap(), 1.0).unwrap())
    }

    fn solution(eq: &Equations, radius: f32) -> Result<Place, Fault> {
        let tube = TubeClaim {
            centre: vec![0.0; eq.m + 1],
            low: vec![0.0; eq.m + 1],
            normal: vec![1.0; eq.m + 1],
            weights: vec![1; eq.m + 1],
            h: 1.0,
            r: 1.0,
            exit: 0.0,
        };
        let centre = vec![1.0, 0.5, 0.5];
        Place::solution(eq, &SolutionClaim { centre, radius }, &tube)
    }

    /// 1 + radius is below b's coordinate, but not when it is rounded upwards to a float.
    #[test]
    fn rounding_does_not_make_a_box_wider() {
        let eq = triangle();
        for radius in [1e-18, 1e-17, 2.9e-17] {
            assert!(point(1.0) + around(exact(radius.into())) != point(1.0));
            assert!(solution(&eq, radius).is_err(), "{radius:e}");
        }
        for radius in [3.1e-17, 1e-16, 1e-10] {
            assert!(solution(&eq, radius).is_ok(), "{radius:e}");
        }
    }

    /// Of two figures that are each other's mirror images, 2 c_y apart, either is alone twice as far as J is seen to be regular, and not up to the other.
    #[test]
    fn the_other_zero_is_twice_as_far_away_as_a_singular_place() {
        let eq = triangle();
        let place = Place::at_target(&eq, (&[1.0, 0.5, 0.5], false), Vec::new()).unwrap();
        let other = [1.0, 0.5, -0.5].map(exact);
        // |I − Y J| < 1 is proved up to 0.11.
        assert!(!place.covers(&other) && place.alone_within[2] > 0.2);
    }

    /// Boxes that touch after rounding may be apart.
    #[test]
    fn boxes_overlap_where_they_do_before_rounding() {
        let eq = triangle();
        let mut pair = [1e-10; 2].map(|radius| solution(&eq, radius).unwrap());
        let mut found = |from: f64| {
            pair[0].claimed.fill(hull(0.0, 1.0));
            pair[1].claimed.fill(hull(from, 2.0));
            let [a, b] = &pair;
            (a.is_apart(b), refute::overlap(a, b))
        };
        assert_eq!(found(0.5), (false, true));
        assert_eq!(found(1.0), (false, false));
        assert_eq!(found(1.0f64.next_down()), (false, false));
        assert_eq!(found(1.5), (true, false));
    }
}
