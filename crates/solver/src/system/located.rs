//! Where lines, planes, circles, spheres and arcs are in a figure.

use super::Homotopy;
use crate::constraint::Entry;
use crate::interval::{Interval, hull, point};
use crate::places::{Each as _, array};
use crate::problem::Shape;

/// Where an object is in a figure, enclosed: in the coordinates and the unit of the figure's points. In the plane third
/// coordinates are zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Located {
    /// A line.
    Line {
        /// A place on it: the first of its two points, or, of a line of its own, the place nearest to the origin.
        point: [Interval; 3],
        /// A unit vector along it, from the first point to the second. That of a line of its own may as well be the
        /// opposite one.
        direction: [Interval; 3],
    },
    /// A plane.
    Plane {
        /// A place in it: the first of its three points, or, of a plane of its own, the place nearest to the origin.
        point: [Interval; 3],
        /// A unit normal, that of the first three points counter-clockwise. That of a plane of its own may as well be
        /// the opposite one.
        normal: [Interval; 3],
    },
    /// A circle, sphere or arc.
    Round {
        /// Its centre.
        center: [Interval; 3],
        /// Its radius.
        radius: Interval,
    },
    /// A rigid body, which is where its points are.
    Body,
    /// An unknown number.
    Number(Interval),
}

impl Located {
    /// The line through a place, along a vector.
    pub fn line(point: [Interval; 3], along: [Interval; 3]) -> Self {
        Located::Line {
            point,
            direction: unit_vector(along),
        }
    }

    /// The plane through a place, at a right angle to a vector.
    pub fn plane(point: [Interval; 3], normal: [Interval; 3]) -> Self {
        Located::Plane {
            point,
            normal: unit_vector(normal),
        }
    }

    /// The plane through a place, along two vectors.
    pub fn plane_along(point: [Interval; 3], u: [Interval; 3], v: [Interval; 3]) -> Self {
        Located::plane(point, cross(&u, &v))
    }
}

impl Homotopy {
    /// Where the problem's objects are in a figure: its points in the unit of the problem, and its unknowns in the
    /// homotopy's own, as `unknown` gives them.
    pub fn locate(
        &self,
        points: &[[Interval; 3]],
        unknown: impl Fn(usize) -> Interval,
    ) -> Vec<Located> {
        let unit = point(self.unit);
        let value = |entry: Entry| self.entry(entry).map_or(point(0.0), &unknown);
        let three = |entries: &[Entry]| -> [Interval; 3] {
            array(|k| entries.get(k).map_or(point(0.0), |&entry| value(entry)))
        };
        let objects = self.shapes.iter().zip(&self.tail.objects);
        objects
            .map(|(shape, own)| match shape {
                Shape::Line([a, b]) => Located::line(points[*a], minus(&points[*b], &points[*a])),
                Shape::FreeLine { .. } => {
                    let (base, along) = own.split_at(self.dimension);
                    Located::line(three(base).map(|x| x * unit), three(along))
                }
                Shape::Plane([a, b, c]) => {
                    let [u, v] = [b, c].map(|&p| minus(&points[p], &points[*a]));
                    Located::plane_along(points[*a], u, v)
                }
                Shape::FreePlane { .. } => {
                    let normal = three(&own[..3]);
                    let square = normal.iter().fold(point(0.0), |sum, x| sum + x.sqr());
                    let level = value(own[3]) / square;
                    Located::plane(normal.map(|x| x * level * unit), normal)
                }
                Shape::Round { center, .. } | Shape::Arc { center, .. } => Located::Round {
                    center: points[*center],
                    radius: value(own[0]) * unit,
                },
                Shape::Body { .. } => Located::Body,
                Shape::Number { .. } => Located::Number(value(own[0])),
            })
            .collect()
    }
}

fn minus(a: &[Interval; 3], b: &[Interval; 3]) -> [Interval; 3] {
    array(|k| a[k] - b[k])
}

fn cross(a: &[Interval; 3], b: &[Interval; 3]) -> [Interval; 3] {
    array(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

/// A vector divided by its length; where that may be zero, nothing is known of its coordinates but that they are between
/// −1 and 1.
fn unit_vector(v: [Interval; 3]) -> [Interval; 3] {
    let length = v.iter().fold(point(0.0), |sum, x| sum + x.sqr()).sqrt();
    let all = hull(-1.0, 1.0);
    v.each(|x| match length.inf() > 0.0 {
        true => (x / length).intersection(all),
        false if x == point(0.0) => x,
        false => all,
    })
}
