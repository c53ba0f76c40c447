//! Where lines, planes, circles, spheres and arcs are, for programs.

use super::{Named, middle};
use crate::interval::{Interval, enclose, point};
use crate::places::Each as _;
use crate::problem::{Decimal, Problem, Shape};
use crate::system::Located;
use serde::{Deserialize, Serialize};

/// The objects of a figure by name. Rigid bodies are none of them: they are where their points are.
pub type Objects<C> = Named<At<C>>;

/// The numbers that say where an object is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
#[allow(missing_docs)]
pub enum At<C> {
    Line {
        point: Vec<C>,
        direction: Vec<C>,
    },
    Plane {
        point: Vec<C>,
        normal: Vec<C>,
    },
    /// A body with joints: where it is, and its axes.
    Pose {
        at: Vec<C>,
        x: Vec<C>,
        y: Vec<C>,
        #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
        z: Vec<C>,
    },
    Round {
        center: Vec<C>,
        radius: C,
    },
    Number {
        value: C,
    },
    /// By how much a joint is turned, and how far it has travelled.
    Joint {
        #[serde(skip_serializing_if = "Option::is_none")]
        turn: Option<C>,
        #[serde(skip_serializing_if = "Option::is_none")]
        travel: Option<C>,
    },
}

impl<C> At<C> {
    /// Where an object is, each number as `number` has it. `None`: it is a rigid body.
    fn new(dimension: usize, at: &Located, number: fn(&Interval) -> C) -> Option<Self> {
        let place = |x: &[Interval; 3]| x[..dimension].iter().map(number).collect();
        Some(match at {
            Located::Line { point, direction } => At::Line {
                point: place(point),
                direction: place(direction),
            },
            Located::Plane { point, normal } => At::Plane {
                point: place(point),
                normal: place(normal),
            },
            Located::Pose {
                at,
                axes: [x, y, z],
            } => At::Pose {
                at: place(at),
                x: place(x),
                y: place(y),
                z: if dimension == 3 { place(z) } else { Vec::new() },
            },
            Located::Round { center, radius } => At::Round {
                center: place(center),
                radius: number(radius),
            },
            Located::Joint { turn, travel } => At::Joint {
                turn: turn.as_ref().map(number),
                travel: travel.as_ref().map(number),
            },
            Located::Number(value) => At::Number {
                value: number(value),
            },
            Located::Body => return None,
        })
    }

    /// The objects of a problem in a figure.
    pub(crate) fn all(
        problem: &Problem,
        objects: &[Located],
        number: fn(&Interval) -> C,
    ) -> Objects<C> {
        let all = problem.objects.iter().zip(objects);
        let all = all.filter_map(|(object, at)| {
            let at = At::new(problem.dimension, at, number)?;
            Some((object.name.clone(), at))
        });
        Named(all.collect())
    }

    /// Bodies with joints and joints alone.
    pub(crate) fn joints(
        problem: &Problem,
        objects: &[Located],
        number: fn(&Interval) -> C,
    ) -> Objects<C> {
        let mut all = At::all(problem, objects, number);
        all.0
            .retain(|(_, at)| matches!(at, At::Pose { .. } | At::Joint { .. }));
        all
    }
}

impl At<f64> {
    /// The objects of a sketch, in the coordinates of the file.
    pub(crate) fn in_sketch(problem: &Problem) -> Objects<f64> {
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
            Shape::Number { sketch, .. } => Located::Number(enclose(sketch)),
        });
        let objects: Vec<Located> = objects.collect();
        At::all(problem, &objects, middle)
    }
}
