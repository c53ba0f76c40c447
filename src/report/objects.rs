//! Where lines, planes, circles, spheres and arcs are, for programs.

use super::json::{Coordinate, value};
use crate::interval::{Interval, enclose, point};
use crate::places::Each as _;
use crate::problem::{Decimal, Problem, Shape};
use crate::system::Located;
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};
use serde_json::Value;

/// The objects of a figure by name, each in the numbers that say where it is. Rigid bodies have none: they are where
/// their points are.
pub(super) struct Objects<'a, C> {
    dimension: usize,
    all: Vec<(&'a str, Located)>,
    number: fn(&Interval) -> C,
}

/// Bodies with joints and joints alone, each number as `number` has it. `None`: there are none.
pub(super) fn joints_to_value<C: Coordinate>(
    problem: &Problem,
    objects: &[Located],
    number: fn(&Interval) -> C,
) -> Option<Value> {
    let mut joints = Objects::new(problem, objects, number);
    joints
        .all
        .retain(|(_, at)| matches!(at, Located::Pose { .. } | Located::Joint { .. }));
    (!joints.is_empty()).then(|| value(&joints))
}

impl<'a, C: Coordinate> Objects<'a, C> {
    /// The objects of a problem in a figure, each number of theirs as `number` has it.
    pub fn new(problem: &'a Problem, objects: &[Located], number: fn(&Interval) -> C) -> Self {
        let objects = problem.objects.iter().zip(objects);
        let objects = objects.filter(|(_, at)| !matches!(at, Located::Body));
        Objects {
            dimension: problem.dimension,
            all: objects
                .map(|(object, at)| (object.name.as_str(), *at))
                .collect(),
            number,
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }
}

impl<'a> Objects<'a, f64> {
    /// The objects of a sketch, in the coordinates of the file.
    pub fn in_sketch(problem: &'a Problem) -> Self {
        let three = |x: &[Decimal; 3]| x.each_ref().each(enclose);
        let at = |p: usize| three(&problem.points[p].sketch);
        let from = |a: usize, b: usize| {
            let (a, b) = (at(a), at(b));
            std::array::from_fn(|k| b[k] - a[k])
        };
        let objects = problem.objects.iter().map(|object| match &object.shape {
            Shape::Line([a, b]) => Located::line(at(*a), from(*a, *b)),
            Shape::FreeLine { point, direction } => Located::line(three(point), three(direction)),
            Shape::Plane([a, b, c]) => Located::plane_along(at(*a), from(*a, *b), from(*a, *c)),
            Shape::FreePlane { point, normal } => Located::plane(three(point), three(normal)),
            Shape::Round { center, radius } => Located::Round {
                center: at(*center),
                radius: enclose(radius),
            },
            Shape::Arc { center, start, .. } => {
                let across: [Interval; 3] = from(*center, *start);
                let square = across.iter().fold(point(0.0), |sum, x| sum + x.sqr());
                Located::Round {
                    center: at(*center),
                    radius: square.sqrt(),
                }
            }
            Shape::Body {
                place: Some(pose), ..
            } => Located::posed(pose),
            // What it measures there the sketch does not say.
            Shape::Body { .. } | Shape::Joint { .. } => Located::Body,
            Shape::Number { sketch } => Located::Number(enclose(sketch)),
        });
        let objects: Vec<Located> = objects.collect();
        Objects::new(problem, &objects, |x| x.mid())
    }
}

impl<C: Coordinate> Serialize for Objects<'_, C> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.all.len()))?;
        for (name, at) in &self.all {
            map.serialize_entry(name, &Written(self, at))?;
        }
        map.end()
    }
}

struct Written<'a, C>(&'a Objects<'a, C>, &'a Located);

impl<C: Coordinate> Serialize for Written<'_, C> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Written(objects, at) = self;
        let number = |x: &Interval| (objects.number)(x).written();
        let place =
            |x: &[Interval; 3]| -> Vec<_> { x[..objects.dimension].iter().map(number).collect() };
        let mut map = serializer.serialize_map(None)?;
        match at {
            Located::Line { point, direction } => {
                map.serialize_entry("point", &place(point))?;
                map.serialize_entry("direction", &place(direction))?;
            }
            Located::Plane { point, normal } => {
                map.serialize_entry("point", &place(point))?;
                map.serialize_entry("normal", &place(normal))?;
            }
            Located::Pose { at, axes } => {
                map.serialize_entry("at", &place(at))?;
                for (name, axis) in ["x", "y", "z"]
                    .into_iter()
                    .zip(axes)
                    .take(objects.dimension)
                {
                    map.serialize_entry(name, &place(axis))?;
                }
            }
            Located::Joint { turn, travel } => {
                for (name, value) in [("turn", turn), ("travel", travel)] {
                    if let Some(value) = value {
                        map.serialize_entry(name, &number(value))?;
                    }
                }
            }
            Located::Number(value) => map.serialize_entry("value", &number(value))?,
            Located::Round { center, radius } => {
                map.serialize_entry("center", &place(center))?;
                map.serialize_entry("radius", &number(radius))?;
            }
            Located::Body => {}
        }
        map.end()
    }
}
