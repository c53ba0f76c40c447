//! What is special about the figure at a limit: points on one line or in one plane.

use super::ending::Limit;
use crate::interval::vector::length;
use crate::interval::{Interval, point};
use crate::places::{Each as _, array};
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
    let from_first = |p: &usize| -> [Interval; 3] { array(|k| places[*p][k] - places[*first][k]) };
    let sides: Vec<[Interval; 3]> = others.iter().map(from_first).collect();
    let minor =
        |v: &[Interval; 3], w: &[Interval; 3], i: usize, j: usize| v[i] * w[j] - v[j] * w[i];
    let determinant = match sides.as_slice() {
        [u, v] => minor(u, v, 0, 1),
        [u, v, w] => u[0] * minor(v, w, 1, 2) + u[1] * minor(v, w, 2, 0) + u[2] * minor(v, w, 0, 1),
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
