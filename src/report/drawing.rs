//! What a result says of its problem, so that its figures can be drawn without the problem file.

use super::json::{Points, value};
use super::objects::Objects;
use crate::interval::Interval;
use crate::places::Each as _;
use crate::problem::{Decimal, Problem, Target};
use crate::system::{Gauge, Placement};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// The keys that results of all verbs with figures have in common (docs/using/programs.md, "The problem").
#[derive(Serialize)]
pub(super) struct Drawing<'a> {
    version: u32,
    krawl: &'static str,
    verb: &'static str,
    problem: &'a str,
    dimension: usize,
    #[serde(skip_serializing_if = "str::is_empty")]
    source: &'a str,
    names: Vec<&'a str>,
    reference: Vec<&'a str>,
    frame: Option<Value>,
    sketch: Points<'a, [f64; 3]>,
    #[serde(skip_serializing_if = "Objects::is_empty")]
    sketch_objects: Objects<'a, f64>,
    constraints: Vec<Constraint<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    objects: Vec<Object<'a>>,
}

/// A constraint.
#[derive(Serialize, Deserialize)]
pub(super) struct Constraint<'a> {
    pub kind: &'a str,
    pub items: Vec<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// A decimal as a text, so that it stays exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
}

/// An object: the points that it goes through.
#[derive(Serialize, Deserialize)]
pub(super) struct Object<'a> {
    pub name: &'a str,
    pub kind: &'a str,
    pub points: Vec<&'a str>,
}

impl<'a> Drawing<'a> {
    /// What is to be said of a problem in a result of `verb`, in the gauge.
    pub fn new(verb: &'static str, problem: &'a Problem) -> Self {
        let placement = Gauge::new(problem).placement(problem).ok();
        Drawing {
            reference: names(problem, &problem.homotopy.reference),
            frame: placement.map(|placement| frame(&placement, problem.dimension)),
            ..Self::in_place(verb, problem)
        }
    }

    /// What is to be said where results are in the coordinates of the problem file, whatever the reference is. The problem
    /// need not have as many equations as unknowns.
    pub fn in_place(verb: &'static str, problem: &'a Problem) -> Self {
        Drawing {
            version: super::JSON_VERSION,
            krawl: env!("CARGO_PKG_VERSION"),
            verb,
            problem: &problem.name,
            dimension: problem.dimension,
            source: &problem.source,
            names: all_names(problem),
            reference: Vec::new(),
            frame: None,
            sketch: Points(problem, sketch_of(problem)),
            sketch_objects: Objects::in_sketch(problem),
            constraints: constraints_of(problem),
            objects: objects_of(problem),
        }
    }

    /// What is to be said where results are seen from points that may not be the problem's reference.
    pub fn seen_from(verb: &'static str, problem: &'a Problem, reference: &[usize]) -> Self {
        let drawing = Self::new(verb, problem);
        match reference == problem.homotopy.reference {
            true => drawing,
            false => Drawing {
                reference: names(problem, reference),
                frame: None,
                ..drawing
            },
        }
    }

    /// A value with all of these keys besides its own.
    ///
    /// # Panics
    /// If it is no object.
    pub fn with(&self, own: Value) -> Value {
        let mut value = value(self);
        let Value::Object(own) = own else {
            panic!("results are objects");
        };
        let keys = value.as_object_mut().expect("a struct is an object");
        keys.extend(own);
        value
    }
}

fn frame(placement: &Placement, d: usize) -> Value {
    let middles = |v: &[Interval; 3]| v[..d].iter().map(|x| x.mid() + 0.0).collect();
    let axes: Vec<Vec<f64>> = placement.axes[..d].iter().map(middles).collect();
    json!({"origin": middles(&placement.origin), "axes": axes})
}

/// The names of points, by number.
pub(crate) fn names<'a>(problem: &'a Problem, points: &[usize]) -> Vec<&'a str> {
    points
        .iter()
        .map(|&p| problem.points[p].name.as_str())
        .collect()
}

/// The names of all points.
pub(super) fn all_names(problem: &Problem) -> Vec<&str> {
    problem.points.iter().map(|p| p.name.as_str()).collect()
}

/// The sketch in the problem's own coordinates.
fn sketch_of(problem: &Problem) -> Vec<[f64; 3]> {
    let middle = |x: &Decimal| crate::interval::enclose(x).mid();
    let points = problem.points.iter();
    points
        .map(|point| point.sketch.each_ref().each(middle))
        .collect()
}

fn constraints_of(problem: &Problem) -> Vec<Constraint<'_>> {
    // Only what has a value can be set by its name.
    let name = |index: usize, has_value: bool| has_value.then(|| problem.dimension_name(index));
    let distances = problem.distances.iter().enumerate();
    let distances = distances.map(|(index, distance)| {
        let (kind, value) = match &distance.target {
            Target::Length(value) => ("distance", value),
            Target::SquaredLength(value) => ("squared distance", value),
        };
        Constraint {
            kind,
            items: names(problem, &distance.points),
            name: name(index, true),
            value: Some(value.to_string()),
        }
    });
    let others = problem.constraints.iter().enumerate();
    let others = others.map(|(index, constraint)| {
        let items = constraint.items.iter();
        Constraint {
            kind: &constraint.kind,
            items: items.map(|&item| problem.item_name(item)).collect(),
            name: match &constraint.formula {
                Some(formula) => Some(formula.text.clone()),
                None => name(problem.distances.len() + index, constraint.value.is_some()),
            },
            value: constraint.value.as_ref().map(Decimal::to_string),
        }
    });
    distances.chain(others).collect()
}

fn objects_of(problem: &Problem) -> Vec<Object<'_>> {
    let objects = problem.objects.iter();
    objects
        .map(|object| Object {
            name: &object.name,
            kind: object.kind(problem.dimension),
            points: names(problem, &object.points()),
        })
        .collect()
}
