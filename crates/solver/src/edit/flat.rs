//! What is special about the figure at a limit: points on one line or in one plane.

use super::ending::Limit;
use crate::interval::vector::{cross, dot, length, minus};
use crate::interval::{Interval, point};
use crate::places::Each as _;
use crate::track::arc::Orientation;

/// Points are said to be on one line, or in one plane, where the sine of the angle is at most this. What is said is
/// [`Limit::flat_within`], a bound.
const FLAT: f64 = 1e-9;

impl Limit {
    /// From the places of points, what was followed on the way, and how fast points move, on any scale.
    pub(super) fn new(
        places: &[[Interval; 3]],
        orientations: &[Orientation],
        mut motion: Vec<[f64; 3]>,
    ) -> Self {
        let (mut flat, mut flat_within) = (Vec::new(), 0.0f64);
        for orientation in orientations.iter().filter(|o| o.sign != 0) {
            let sine = sine(places, &orientation.points);
            if sine <= FLAT {
                flat.push(orientation.points.clone());
                flat_within = flat_within.max(sine);
            }
        }
        let largest = motion
            .iter()
            .copied()
            .map(length)
            .fold(f64::MIN_POSITIVE, f64::max);
        for v in &mut motion {
            *v = v.each(|x| x / largest);
        }
        Limit {
            flat,
            flat_within,
            motion,
        }
    }
}

/// A bound on the determinant of the differences of some points from the first, over the product of their
/// lengths: in the plane the sine of the angle at the first point. 1 where it cannot be told.
fn sine(places: &[[Interval; 3]], points: &[usize]) -> f64 {
    let [first, others @ ..] = points else {
        return 1.0;
    };
    let others = others.iter();
    let sides: Vec<[Interval; 3]> = others.map(|&p| minus(places[p], places[*first])).collect();
    let determinant = match *sides.as_slice() {
        [u, v] => cross(u, v)[2],
        [u, v, w] => dot(u, cross(v, w)),
        _ => return 1.0,
    };
    let size = |u: &[Interval; 3]| (u[0].sqr() + u[1].sqr() + u[2].sqr()).sqrt();
    let product = sides
        .iter()
        .fold(point(1.0), |product, u| product * size(u));
    if product.inf() > 0.0 {
        (determinant / product).mag()
    } else {
        1.0
    }
}
