//! What a result says of its problem, so that its figures can be drawn without the problem file.

use super::{At, JSON_VERSION, Named, Objects, Points, all, middle};
use crate::interval::enclose;
use crate::problem::{self, Decimal, Problem, Target};
use crate::system::{Gauge, Placement};
use serde::{Deserialize, Serialize};

keys! {
    /// The keys that results of all verbs with figures have in common (docs/using/programs.md, "The problem"), where results are in the
    /// coordinates of the problem file, whatever the reference is. The problem need not have as many equations as unknowns.
    Drawing(verb: &str, problem: &Problem) {
        /// Of the format.
        version: u32 = JSON_VERSION,
        /// The version of the program that wrote it.
        #[serde(default)]
        krawl: String = env!("CARGO_PKG_VERSION").into(),
        /// The verb that wrote it.
        #[serde(default)]
        verb: String = verb.into(),
        /// The name of the problem.
        problem: String = problem.name.clone(),
        /// 2 or 3; of a sweep the name of the dimension that is driven.
        dimension: Dimension = Dimension::Space(problem.dimension),
        /// The names of the points.
        names: Vec<String> = all_names(problem),
        /// The points from which figures are seen; none where they are in the coordinates of the file.
        #[serde(default)]
        reference: Vec<String> = Vec::new(),
        /// Where these are in the sketch.
        frame: Option<Frame> = None,
        /// The sketch.
        sketch: Points<f64> = Named::of(problem, &problem.points, |p| {
            all(&p.sketch[..problem.dimension], |x| middle(&enclose(x)))
        }),
        /// The constraints.
        constraints: Vec<Constraint> = constraints_of(problem),
    } or nothing {
        /// Where the problem is from.
        source: String = problem.source.clone(),
        /// The objects of the sketch.
        sketch_objects: Objects<f64> = At::in_sketch(problem),
        /// The objects.
        objects: Vec<Object> = all(&problem.objects, |object| Object::new(problem, object)),
    }
}

/// What stands under `dimension`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Dimension {
    /// That of the plane or of space.
    Space(usize),
    /// The name of what is driven.
    Driven(String),
}

keys! {
    /// Coordinates of their own, as they lie in the sketch.
    Frame(placement: &Placement, dimension: usize) {
        /// Where they begin.
        origin: Vec<f64> = all(&placement.origin[..dimension], middle),
        /// The directions of the axes.
        axes: Vec<Vec<f64>> = all(&placement.axes[..dimension], |axis| all(&axis[..dimension], middle)),
    }
}

keys! {
    /// A constraint.
    Constraint(kind: &str, items: Vec<String>, name: Option<String>, value: Option<&Decimal>) {
        /// What it says.
        kind: String = kind.into(),
        /// Of what.
        items: Vec<String> = items,
    } or nothing {
        /// By what name its value can be set.
        name: Option<String> = name,
        /// A decimal as a text, so that it stays exact.
        value: Option<String> = value.map(Decimal::to_string),
    }
}

keys! {
    /// An object.
    Object(problem: &Problem, object: &problem::Object) {
        /// Its name.
        name: String = object.name.clone(),
        /// What it is.
        kind: String = object.kind(problem.dimension).into(),
        /// The points that it goes through.
        points: Vec<String> = names(problem, &object.points()),
    }
}

impl Drawing {
    /// What is to be said of a problem in a result of `verb`, in the gauge.
    pub(crate) fn in_gauge(verb: &str, problem: &Problem) -> Self {
        let placement = Gauge::new(problem).placement(problem).ok();
        Drawing {
            reference: names(problem, &problem.homotopy.reference),
            frame: placement.map(|placement| Frame::new(&placement, problem.dimension)),
            ..Self::new(verb, problem)
        }
    }

    /// What is to be said where results are seen from points that may not be the problem's reference.
    pub(crate) fn seen_from(verb: &str, problem: &Problem, reference: &[usize]) -> Self {
        let drawing = Self::in_gauge(verb, problem);
        match reference == problem.homotopy.reference {
            true => drawing,
            false => Drawing {
                reference: names(problem, reference),
                frame: None,
                ..drawing
            },
        }
    }
}

/// The names of points, by number.
pub(crate) fn names(problem: &Problem, points: &[usize]) -> Vec<String> {
    points
        .iter()
        .map(|&p| problem.points[p].name.clone())
        .collect()
}

/// The names of all points.
pub(crate) fn all_names(problem: &Problem) -> Vec<String> {
    problem.points.iter().map(|p| p.name.clone()).collect()
}

fn constraints_of(problem: &Problem) -> Vec<Constraint> {
    // Only what has a value can be set by its name.
    let name = |index: usize, has_value: bool| has_value.then(|| problem.dimension_name(index));
    let distances = problem.distances.iter().enumerate();
    let distances = distances.map(|(index, distance)| {
        let (kind, value) = match &distance.target {
            Target::Length(value) => ("distance", value),
            Target::SquaredLength(value) => ("squared distance", value),
        };
        let items = names(problem, &distance.points);
        Constraint::new(kind, items, name(index, true), Some(value))
    });
    let others = problem.constraints.iter().enumerate();
    let others = others.map(|(index, constraint)| {
        let name = match &constraint.formula {
            Some(formula) => Some(formula.text.clone()),
            None => name(problem.distances.len() + index, constraint.value.is_some()),
        };
        let items = all(&constraint.items, |&item| {
            problem.item_name(item).to_owned()
        });
        Constraint::new(&constraint.kind, items, name, constraint.value.as_ref())
    });
    distances.chain(others).collect()
}
