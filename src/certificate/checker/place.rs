//! Boxes around points of curves of F = 0, and the figures with t = 1.

use super::equations::{Equations, ZERO};
use super::guess::newton;
use super::krawczyk::{Section, around, scaled, weight};
use super::whole::{Whole, exact, size};
use crate::certificate::format::SolutionClaim;
use crate::certificate::verdict::Fault;
use crate::interval::{Interval, point};

/// An enclosure of a point of a curve of F = 0, in n entries: exactly known floats, and what has to be
/// added to them.
#[derive(Clone)]
pub struct Spot {
    pub near: Vec<f64>,
    pub rest: Vec<Interval>,
}

impl Spot {
    /// The point in intervals.
    pub fn at(&self, i: usize) -> Interval {
        exact(self.near[i]) + self.rest[i]
    }

    /// Its difference from another one.
    pub fn minus(&self, other: &Spot, i: usize) -> Interval {
        (exact(self.near[i]) - exact(other.near[i])) + (self.rest[i] - other.rest[i])
    }

    /// One of the forms of the equations.
    fn form(&self, eq: &Equations, form: usize) -> Interval {
        let [i, j] = eq.forms[form];
        let of = |i: usize| {
            if i < eq.m {
                (exact(self.near[i]), self.rest[i])
            } else {
                (ZERO, ZERO)
            }
        };
        let ((a, da), (b, db)) = (of(i), of(j));
        (a - b) + (da - db)
    }

    /// [J; c] v − e_n at the point, scaled.
    pub fn off_direction(&self, eq: &Equations, at: &Section, v: &[f64]) -> Vec<Interval> {
        let t = self.at(eq.m);
        let entry = |i: usize| v.get(i).filter(|_| i < eq.m).map_or(ZERO, |&x| exact(x));
        let row = |e: usize| {
            let terms = eq.gradient[e].iter();
            let sum = terms.fold(ZERO, |sum, term| {
                let factor = point(0.5 * term.factor as f64);
                sum + factor * self.form(eq, term.form) * entry(term.unknown)
            });
            sum - eq.half_square_at(e, t)[1] * exact(v[eq.m])
        };
        let rows = (0..eq.m).map(row).collect();
        let along = v.iter().zip(&at.c);
        let along = along.fold(point(-1.0), |sum, (&v, &c)| sum + exact(v) * point(c));
        scaled(rows, along, at)
    }
}

/// Whether vectors in a box have a positive (`Some(true)`), or a negative, component along another.
pub fn goes_along(direction: &[Interval], normal: &[f64]) -> Option<bool> {
    let terms = direction.iter().zip(normal);
    let along = terms.fold(ZERO, |sum, (&x, &c)| sum + x * point(c));
    match (along.inf() > 0.0, along.sup() < 0.0) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

/// A figure with t = 1, the only one in its box.
pub struct Place {
    /// Where it is.
    pub spot: Spot,
    /// The box that was claimed: n entries.
    pub claimed: Vec<Interval>,
    /// At most so far from the middle of `spot`, entry by entry, there is no other figure with t = 1.
    alone_within: Vec<f64>,
    pub margin: f64,
}

/// Solutions are tested with the weight ½ for coordinates, and next to none for t.
const HALF: u16 = 1 << 15;
/// The distance, in weights, up to which a test can see.
const SIGHT: f64 = 1.0;

impl Place {
    /// Proves that a box holds exactly one solution of F(X, a(1)) = 0.
    pub fn solution(eq: &Equations, claim: &SolutionClaim) -> Result<Place, Fault> {
        let m = eq.m;
        let near: Vec<f64> = claim.centre.iter().copied().chain([1.0]).collect();
        let radius = around(point(claim.radius.into()));
        let claimed: Vec<Interval> = (0..m)
            .map(|i| point(near[i]) + radius)
            .chain([point(1.0)])
            .collect();
        let nothing = Fault::proof("there is none in it");
        let excluded = |e: usize| {
            let value = |i: usize| claimed.get(i).filter(|_| i < m).map_or(ZERO, |&x| x);
            let form = |f: usize| value(eq.forms[f][0]) - value(eq.forms[f][1]);
            let square = |p: &super::equations::Product| match p.left == p.right {
                true => form(p.left).sqr(),
                false => form(p.left) * form(p.right),
            };
            let products = eq.products[e].iter();
            let sum = products.fold(ZERO, |sum, p| {
                sum + point(0.5 * p.factor as f64) * square(p)
            });
            !(sum - eq.half_square_at(e, point(1.0))[0]).contains(0.0)
        };
        let proved = Place::prove(eq, &near, claimed.clone());
        let place = match proved {
            Err(_) if (0..m).any(excluded) => return Err(nothing),
            proved => proved?,
        };
        let mut inside = true;
        for i in 0..m {
            let (figure, claimed) = (place.spot.at(i), place.claimed[i]);
            let reach = size(claimed - exact(place.spot.near[i]));
            inside &= figure.interior(claimed) && reach.sup() < place.alone_within[i];
        }
        // All of the claimed box is in sight, and what is there is somewhere else; or so are all solutions.
        let apart = |i: usize| !(place.claimed[i] - place.spot.at(i)).contains(0.0);
        let sees = |i: usize| {
            size(place.claimed[i] - exact(place.spot.near[i])).sup() < place.alone_within[i]
        };
        if (0..m).all(sees) && (0..m).any(apart) || (0..m).any(excluded) {
            return Err(nothing);
        }
        match inside {
            true => Ok(place),
            false => Err(Fault::because(
                "it is too narrow to hold the one near it, or so wide that it may hold another one",
            )),
        }
    }

    /// Proves that there is a figure near a point, in the cross-section t = 1.
    fn prove(eq: &Equations, near: &[f64], claimed: Vec<Interval>) -> Result<Place, Fault> {
        let (mut c, mut u) = (vec![0.0; eq.m + 1], vec![HALF; eq.m + 1]);
        (c[eq.m], u[eq.m]) = (1.0, 1);
        let (curve, at, inverse) = newton(eq, near, &c, &u)?;
        let y: &Whole = &inverse.whole;
        let test = curve.test(y, &at, point(SIGHT))?;
        // The test holds for ρ with stiff + width ρ below 1: nine tenths of the largest one.
        let alone = 0.9 * (0.9 - test.stiff.sup()) / test.width.sup();
        let alone = point(if alone > 0.0 { alone.min(SIGHT) } else { SIGHT });
        let proof = test.within(alone)?;
        if curve.z[0][eq.m] != point(1.0) {
            return Err(Fault::because("its cross-section is not t = 1"));
        }
        let weights = || u.iter().map(|&u| weight(u));
        let mut rest: Vec<Interval> = weights().map(|u| around(proof.distance * u)).collect();
        rest[eq.m] = ZERO;
        let spot = Spot {
            near: curve.z[0][..=eq.m].iter().map(|z| z.mid()).collect(),
            rest,
        };
        Ok(Place {
            spot,
            claimed,
            alone_within: weights().map(|u| (alone * u).inf()).collect(),
            margin: proof.margin,
        })
    }

    /// Whether a box lies where this figure is the only one with t = 1.
    fn covers(&self, z: &[Interval]) -> bool {
        let near = |i: usize| size(z[i] - exact(self.spot.near[i])).sup() < self.alone_within[i];
        (0..z.len()).all(near)
    }

    /// Whether the claimed boxes have no point in common.
    pub fn is_apart(&self, other: &Place) -> bool {
        let mut pairs = self.claimed.iter().zip(&other.claimed);
        pairs.any(|(a, b)| a.disjoint(*b))
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
            let sides = self.spot.at(i) * other.spot.at(i);
            if sides.contains(0.0) {
                return None;
            }
            turned[axis] = sides.sup() < 0.0;
        }
        for last in [false, true] {
            turned[d - 1] = last;
            let image = gauge.place.iter().enumerate();
            let image = image.map(|(i, place)| match turned[place % d] {
                true => -self.spot.at(i),
                false => self.spot.at(i),
            });
            let image: Vec<Interval> = image.collect();
            // Without any change of sign they differ: their boxes are disjoint.
            if turned == [false; 3] {
                continue;
            }
            // The image is a solution too.
            if other.covers(&image) {
                return Some(true);
            }
            let mut pairs = image.iter().enumerate();
            if pairs.all(|(i, a)| (*a - other.spot.at(i)).contains(0.0)) {
                return None;
            }
        }
        Some(false)
    }
}
