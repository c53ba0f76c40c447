//! Where lines, planes, circles, spheres and arcs are, for programs.

use super::json::Coordinate;
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
    all: Vec<(&'a str, At<C>)>,
}

/// Bodies with joints and joints alone, each number as `number` has it. `None`: there are none.
pub(super) fn joints_to_value<C: Coordinate>(
    problem: &Problem,
    objects: &[Located],
    number: impl Fn(&Interval) -> C,
) -> Option<Value> {
    let joints = objects.iter().map(|at| match at {
        Located::Pose { .. } | Located::Joint { .. } => *at,
        _ => Located::Body,
    });
    let joints: Vec<Located> = joints.collect();
    let joints = Objects::new(problem, &joints, number);
    let value = || serde_json::to_value(&joints).expect("names and numbers have a form in JSON");
    (!joints.is_empty()).then(value)
}

enum At<C> {
    Line { point: [C; 3], direction: [C; 3] },
    Plane { point: [C; 3], normal: [C; 3] },
    Round { center: [C; 3], radius: C },
    Number(C),
    Pose { at: [C; 3], axes: [[C; 3]; 3] },
    Joint { turn: Option<C>, travel: Option<C> },
}

impl<'a, C: Coordinate> Objects<'a, C> {
    /// The objects of a problem in a figure, each number of theirs as `number` has it.
    pub fn new(problem: &'a Problem, objects: &[Located], number: impl Fn(&Interval) -> C) -> Self {
        let three = |x: &[Interval; 3]| x.each_ref().map(&number);
        let at = |located: &Located| {
            Some(match located {
                Located::Line { point, direction } => At::Line {
                    point: three(point),
                    direction: three(direction),
                },
                Located::Plane { point, normal } => At::Plane {
                    point: three(point),
                    normal: three(normal),
                },
                Located::Round { center, radius } => At::Round {
                    center: three(center),
                    radius: number(radius),
                },
                Located::Number(value) => At::Number(number(value)),
                Located::Pose { at, axes } => At::Pose {
                    at: three(at),
                    axes: axes.each_ref().map(three),
                },
                Located::Joint { turn, travel } => At::Joint {
                    turn: turn.as_ref().map(&number),
                    travel: travel.as_ref().map(&number),
                },
                Located::Body => return None,
            })
        };
        let objects = problem.objects.iter().zip(objects);
        Objects {
            dimension: problem.dimension,
            all: objects
                .filter_map(|(object, located)| Some((object.name.as_str(), at(located)?)))
                .collect(),
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
            map.serialize_entry(name, &Written(self.dimension, at))?;
        }
        map.end()
    }
}

struct Written<'a, C>(usize, &'a At<C>);

impl<C: Coordinate> Serialize for Written<'_, C> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let place = |x: &[C; 3]| -> Vec<C::Written> {
            x[..self.0].iter().map(Coordinate::written).collect()
        };
        let mut map = serializer.serialize_map(Some(2))?;
        match self.1 {
            At::Line { point, direction } => {
                map.serialize_entry("point", &place(point))?;
                map.serialize_entry("direction", &place(direction))?;
            }
            At::Plane { point, normal } => {
                map.serialize_entry("point", &place(point))?;
                map.serialize_entry("normal", &place(normal))?;
            }
            At::Pose { at, axes } => {
                map.serialize_entry("at", &place(at))?;
                for (name, axis) in ["x", "y", "z"].into_iter().zip(axes).take(self.0) {
                    map.serialize_entry(name, &place(axis))?;
                }
            }
            At::Joint { turn, travel } => {
                if let Some(turn) = turn {
                    map.serialize_entry("turn", &turn.written())?;
                }
                if let Some(travel) = travel {
                    map.serialize_entry("travel", &travel.written())?;
                }
            }
            At::Number(value) => map.serialize_entry("value", &value.written())?,
            At::Round { center, radius } => {
                map.serialize_entry("center", &place(center))?;
                map.serialize_entry("radius", &radius.written())?;
            }
        }
        map.end()
    }
}
