//! Where lines, planes, circles, spheres and arcs are in a figure.

use super::Homotopy;
use crate::constraint::{Entry, Form, Posed};
use crate::interval::along::Quantifiable;
use crate::interval::angle::direction;
use crate::interval::vector::{cross, dot, minus, out_of};
use crate::interval::{Interval, enclose, hull, point};
use crate::places::{Each as _, array};
use crate::problem::{Decimal, JointSort, Pose, Shape};
use std::collections::HashMap;

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
    /// A body with joints: its frame.
    Pose {
        /// The origin.
        at: [Interval; 3],
        /// Its axes, unit vectors.
        axes: [[Interval; 3]; 3],
    },
    /// A joint.
    Joint {
        /// By how many degrees the second body's x axis is turned from the first one's, counter-clockwise as seen from the tip of z; of joints with
        /// one axis.
        turn: Option<Interval>,
        /// How far the origin of the second body's frame of the joint is along z of the first one's, in the plane along x.
        travel: Option<Interval>,
    },
    /// An unknown number.
    Number(Interval),
}

/// What numbers an object has, in the unit of the problem: enclosures, alone or along a curve.
#[derive(Debug, Clone, Copy)]
pub struct Numbers<T> {
    /// The radius of a circle, sphere or arc, or the value of an unknown number.
    pub number: Option<T>,
    /// Of a joint that turns about one axis a vector in the direction of its turn.
    pub turn: Option<[T; 2]>,
    /// How far a joint is drawn out.
    pub travel: Option<T>,
}

impl<T> Numbers<T> {
    fn one(number: Option<T>) -> Self {
        Numbers {
            number,
            turn: None,
            travel: None,
        }
    }
}

impl Located {
    /// The radius of a circle, sphere or arc, or the value of an unknown number.
    pub fn number(&self) -> Option<Interval> {
        match *self {
            Located::Round { radius: number, .. } | Located::Number(number) => Some(number),
            _ => None,
        }
    }

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

    /// A body with joints whose frame is given.
    pub fn posed(pose: &Pose) -> Self {
        let three = |v: &[Decimal; 3]| v.each_ref().each(enclose);
        Located::Pose {
            at: three(&pose.at),
            axes: axes_of(pose),
        }
    }

    /// The plane through a place, along two vectors.
    pub fn plane_along(point: [Interval; 3], u: [Interval; 3], v: [Interval; 3]) -> Self {
        Located::plane(point, cross(u, v))
    }
}

impl Homotopy {
    /// Where the problem's objects are in a figure: its points in the unit of the problem, and its unknowns in the
    /// homotopy's own, as `unknown` gives them.
    pub fn locate(
        &self,
        points: &[[Interval; 3]],
        unknown: &dyn Fn(usize) -> Interval,
    ) -> Vec<Located> {
        let value = |entry: Entry| self.entry(entry).map_or(point(0.0), unknown);
        let told = (&self.tail.objects[..], &self.tail.poses[..]);
        let shapes: Vec<&Shape> = self.shapes.iter().collect();
        locate(&shapes, told, (self.dimension, self.unit), points, &value)
    }

    /// What numbers an object has where its unknowns are these, in the homotopy's own unit.
    pub fn numbers<T: Quantifiable>(
        &self,
        object: usize,
        unknown: &dyn Fn(usize) -> T,
    ) -> Numbers<T> {
        let value = |entry: Entry| self.entry(entry).map_or(T::constant(0.0), unknown);
        let (unit, own) = (T::constant(self.unit), &self.tail.objects[object]);
        match &self.shapes[object] {
            Shape::Round { .. } | Shape::Arc { .. } => Numbers::one(Some(value(own[0]) * unit)),
            Shape::Number { .. } => Numbers::one(Some(value(own[0]))),
            Shape::Joint {
                sort,
                bodies,
                frames,
            } => {
                let posed = |&body: &usize| self.tail.poses.iter().find(|of| of.body == body);
                let [Some(first), Some(second)] = [posed(&bodies[0]), posed(&bodies[1])] else {
                    return Numbers::one(None);
                };
                let bodies = [first, second].map(|posed| pose_of(posed, unit, &value));
                joint_of(self.dimension, *sort, bodies.each_ref(), frames)
            }
            _ => Numbers::one(None),
        }
    }
}

/// Where objects are in a figure, of which `points` are in the unit of the problem and `value` has the unknowns in a `unit` of length; by the
/// unknowns that each has of its own ([`crate::constraint::Tail`]).
pub fn locate(
    shapes: &[&Shape],
    (own, poses): (&[Vec<Entry>], &[Posed]),
    (dimension, unit): (usize, f64),
    points: &[[Interval; 3]],
    value: &dyn Fn(Entry) -> Interval,
) -> Vec<Located> {
    let unit = point(unit);
    let three = |entries: &[Entry]| -> [Interval; 3] {
        array(|k| entries.get(k).map_or(point(0.0), |&entry| value(entry)))
    };
    let poses: HashMap<usize, [[Interval; 3]; 4]> = poses
        .iter()
        .map(|posed| (posed.body, pose_of(posed, unit, value)))
        .collect();
    let objects = shapes.iter().zip(own).enumerate();
    objects
        .map(|(index, (shape, own))| match shape {
            Shape::Line([a, b]) => Located::line(points[*a], minus(points[*b], points[*a])),
            Shape::FreeLine { .. } => {
                let (base, along) = own.split_at(dimension);
                Located::line(three(base).map(|x| x * unit), three(along))
            }
            Shape::Plane([a, b, c]) => {
                let [u, v] = [b, c].map(|&p| minus(points[p], points[*a]));
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
            Shape::Body { .. } => match poses.get(&index) {
                Some(&[at, x, y, z]) => Located::Pose {
                    at,
                    axes: [x, y, z],
                },
                None => Located::Body,
            },
            Shape::Joint {
                sort,
                bodies,
                frames,
            } => {
                let bodies = bodies.map(|body| &poses[&body]);
                let of = joint_of(dimension, *sort, bodies, frames);
                Located::Joint {
                    turn: of.turn.map(|[x, y]| direction(x, y)),
                    travel: of.travel,
                }
            }
            Shape::Number { .. } => Located::Number(value(own[0])),
        })
        .collect()
}

/// The origin of a body with joints and its axes. `value`: of an unknown.
fn pose_of<T: Quantifiable>(posed: &Posed, unit: T, value: &dyn Fn(Entry) -> T) -> [[T; 3]; 4] {
    let form = |form: &Form| match *form {
        Form::One => T::constant(1.0),
        Form::Difference(a, b) => value(a) - value(b),
    };
    let at = match posed.origin {
        Ok(entries) => entries.each(|entry| value(entry) * unit),
        Err(at) => at.each(T::fixed),
    };
    let along: Vec<[T; 3]> = posed
        .along
        .iter()
        .map(|forms| forms.each_ref().each(form))
        .collect();
    let [zero, one] = [0.0, 1.0].map(T::constant);
    let basis = match along[..] {
        [] => [[one, zero, zero], [zero, one, zero], [zero, zero, one]],
        [e] => [e, [-e[1], e[0], zero], [zero, zero, one]],
        [e, f, ..] => [e, f, cross(e, f)],
    };
    let axes = posed.axes.each_ref();
    let [x, y, z] = axes.map(|axis| out_of(&basis, &axis.each(T::fixed)));
    [at, x, y, z]
}

/// The axes of a frame.
fn axes_of(pose: &Pose) -> [[Interval; 3]; 3] {
    let [z, x] = [&pose.z, &pose.x].map(|v| v.each_ref().each(enclose));
    let y = cross(z, x);
    [cross(y, z), y, z].map(unit_vector)
}

/// What a joint measures, by the poses of its bodies.
fn joint_of<T: Quantifiable>(
    dimension: usize,
    sort: JointSort,
    bodies: [&[[T; 3]; 4]; 2],
    frames: &[Pose; 2],
) -> Numbers<T> {
    let [first, second] = [0, 1].map(|side| {
        let (&[at, x, y, z], frame) = (bodies[side], &frames[side]);
        let from = out_of(
            &[x, y, z],
            &frame.at.each_ref().each(|x| T::fixed(enclose(x))),
        );
        let origin: [T; 3] = array(|k| at[k] + from[k]);
        let axes = axes_of(frame);
        (
            origin,
            axes.map(|axis| out_of(&[x, y, z], &axis.each(T::fixed))),
        )
    });
    let [x, y, z] = first.1;
    let other = second.1[0];
    let along = if dimension == 2 { x } else { z };
    Numbers {
        number: None,
        turn: sort.turns().then(|| [dot(x, other), dot(y, other)]),
        travel: sort.travels().then(|| dot(minus(second.0, first.0), along)),
    }
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
