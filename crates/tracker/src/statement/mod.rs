//! A problem as it is stated: points, objects, constraints and numbers, as plain data.
//!
//! All of this is part of [`crate::problem`], which reads, builds and checks problems; what constraints mean stands between the two.

use crate::decimal::Decimal;
use crate::interval::{Interval, enclose};
use crate::places::Each as _;
use crate::rational::Rational;
use std::collections::BTreeMap;

mod formula;
mod joint;
mod names;
mod object;
mod orientation;

pub use formula::{Atom, Formula, Terms};
pub use joint::{JointSort, Pose};
pub use names::DEPENDS;
pub use names::nearest;
pub use names::{counted, either, list};
pub use object::most_along;
pub use object::{AXES, Constraint, Item, Object, Shape};
pub use orientation::Orientation;

/// A geometric problem with its sketch: points, distances between them (RR 8705, section 2.1), and
/// what else there may be: lines, planes, circles, bodies, and constraints on them.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// A short name, used in results.
    pub name: String,
    /// 2 for the plane, 3 for space.
    pub dimension: usize,
    /// Where the numbers come from.
    pub source: String,
    /// The points, with their places in the sketch.
    pub points: Vec<Point>,
    /// Lines, planes, circles, spheres, arcs and rigid bodies.
    pub objects: Vec<Object>,
    /// The distances between points to meet. Where there are no other constraints, there are as many
    /// as free coordinates.
    pub distances: Vec<Distance>,
    /// All other constraints, in the order of [`crate::constraint::KINDS`].
    pub constraints: Vec<Constraint>,
    /// The signs of figures that are asked for.
    pub orientations: Vec<Orientation>,
    /// How the sketch is led to the target dimensions.
    pub homotopy: HomotopyChoices,
    /// What dimensions and constraints are called in the program that they come from, by index:
    /// distances first, then [`Problem::constraints`].
    pub labels: BTreeMap<usize, String>,
    /// The tolerances that the file gives.
    pub tolerances: Tolerances,
    /// What the file wants measured of figures: a name, and what it is, as `--measure` takes it.
    pub measures: Vec<(String, String)>,
    /// The parameters that the file gives, by which [computed numbers](Decimal::expression) of constraints were computed.
    pub parameters: Vec<(String, Decimal)>,
    /// What is left as it is in a sketch of another program.
    pub kept: Kept,
}

/// What stays as the file of another program has it, because that says something of it which no kind of constraint or object here does.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Kept {
    /// Points and edges, as results name them.
    pub what: Vec<String>,
    /// The names of the constraints, of which none is a constraint here.
    pub constraints: Vec<String>,
    /// What krawl has no kind for, by that program's name, and how often.
    pub kinds: BTreeMap<String, usize>,
}

/// How far dimensions may be from what is given.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tolerances {
    /// Of lengths and radii that are not named: so far down and up.
    pub default: Option<[Decimal; 2]>,
    /// Of those that are, by the name that was written: so far down (a number that is mostly less than 0) and up.
    pub named: Vec<(String, [Decimal; 2])>,
}

/// A point and its place in the sketch.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The name used in constraints and results.
    pub name: String,
    /// Coordinates in the sketch; the third is zero in the plane.
    pub sketch: [Decimal; 3],
}

impl Point {
    /// Where the sketch has it, in floats.
    pub fn place(&self) -> [f64; 3] {
        self.sketch.each_ref().each(|x| x.to_f64())
    }
}

/// For each point the points joined to it, in the order of the pairs, with the index of the pair.
#[doc(hidden)]
pub fn neighbours(
    points: usize,
    pairs: impl IntoIterator<Item = [usize; 2]>,
) -> Vec<Vec<(usize, usize)>> {
    let mut joined = vec![Vec::new(); points];
    for (index, [a, b]) in pairs.into_iter().enumerate() {
        joined[a].push((b, index));
        joined[b].push((a, index));
    }
    joined
}

/// The constraint that two points are at a given distance.
#[derive(Debug, Clone, PartialEq)]
pub struct Distance {
    /// Indices into [`Problem::points`].
    pub points: [usize; 2],
    /// The distance wanted.
    pub target: Target,
}

/// A target dimension, in the form in which it is known exactly.
#[derive(Debug, Clone, PartialEq)]
pub enum Target {
    /// The length itself.
    Length(Decimal),
    /// The square of the length.
    SquaredLength(Decimal),
}

impl Target {
    /// The square of the length, exactly.
    pub fn squared(&self) -> Rational {
        match self {
            Target::Length(length) => length.value().pow(2),
            Target::SquaredLength(squared) => squared.value().clone(),
        }
    }

    /// The length, as a float.
    pub fn to_f64(&self) -> f64 {
        match self {
            Target::Length(length) => length.to_f64(),
            Target::SquaredLength(squared) => squared.to_f64().sqrt(),
        }
    }

    /// An enclosure of the length.
    pub fn enclose(&self) -> Interval {
        match self {
            Target::Length(length) => enclose(length),
            Target::SquaredLength(squared) => enclose(squared).sqrt(),
        }
    }

    /// An enclosure of its square.
    pub fn enclose_squared(&self) -> Interval {
        match self {
            Target::Length(length) => enclose(length).sqr(),
            Target::SquaredLength(squared) => enclose(squared),
        }
    }
}

/// What defines the homotopy beside points and distances (RR 8705, sections 2.2 and 3.1).
#[derive(Debug, Clone, PartialEq)]
pub struct HomotopyChoices {
    /// Indices of the reference points, two in the plane and three in space: the first at the
    /// origin, the second on the positive x axis, the third in the upper half of the xy plane. Empty
    /// where the problem is in the user's own frame ([`Problem::is_absolute`]).
    pub reference: Vec<usize>,
    /// Index of the distance whose length is interpolated by `-c t² + (a_so - a_sk + c) t + a_sk`;
    /// the number of distances where none is ([`Problem::bend`]).
    pub bend: usize,
    /// The coefficient c.
    pub bend_coefficient: Decimal,
    /// Constraints without a value that the sketch meets exactly (coplanar, parallel, ...) hold all
    /// along the path where this is zero. Otherwise they are led off and back, by `δ t (1 - t)` with this
    /// δ: Imbach, Mathis, Schreck, section 5.2 of the article on tracking with coplanarities, do so to
    /// stay clear of figures that are flat as a whole.
    pub detour: Decimal,
}

impl Problem {
    /// The number m of free coordinates of points: `2n - 3` in the plane, `3n - 6` in space, or all of
    /// them where the problem is in the user's own frame.
    pub fn free_coordinates(&self) -> usize {
        if self.is_absolute() {
            return self.dimension * self.points.len();
        }
        free_coordinates(self.dimension, self.points.len())
    }

    /// The distance as people read it, `p1-p2`.
    pub fn distance_name(&self, index: usize) -> String {
        let [a, b] = self.distances[index].points;
        format!("{}-{}", self.points[a].name, self.points[b].name)
    }

    /// The dimensions: the distances, and the constraints with a number, counted after the distances.
    pub fn dimensions(&self) -> impl Iterator<Item = usize> + '_ {
        let head = self.distances.len();
        let rest = self.constraints.iter().enumerate();
        let rest = rest.filter(|(_, c)| c.value.is_some());
        (0..head).chain(rest.map(move |(index, _)| head + index))
    }

    /// A dimension as people read it: its label if it has one, `p1-p2` for a distance, and the kind and
    /// what is named for all others, `angles:a-b-c`.
    pub fn dimension_name(&self, index: usize) -> String {
        match self.labels.get(&index) {
            Some(label) => label.clone(),
            None => self.derived_name(index),
        }
    }

    /// The name of a dimension that has no label: its points joined by `-`, or its kind and what it is about.
    #[doc(hidden)]
    pub fn derived_name(&self, index: usize) -> String {
        let Some(c) = index.checked_sub(self.distances.len()) else {
            return self.distance_name(index);
        };
        let constraint = &self.constraints[c];
        if let Some(formula) = &constraint.formula {
            return formula.text.clone();
        }
        let items: Vec<&str> = constraint
            .items
            .iter()
            .map(|&item| self.item_name(item))
            .collect();
        format!("{}:{}", constraint.kind, items.join("-"))
    }

    /// The square of how far apart two points are in the sketch.
    pub fn squared_in_sketch(&self, points: [usize; 2]) -> Rational {
        let [a, b] = points.each(|p| &self.points[p].sketch);
        let squares = (0..3).map(|k| (a[k].value() - b[k].value()).pow(2));
        squares.sum()
    }

    /// Whether two points are joined by a distance.
    pub fn are_joined(&self, a: usize, b: usize) -> bool {
        self.distances
            .iter()
            .any(|d| d.points == [a, b] || d.points == [b, a])
    }
}

/// Coordinates left free for `points` points once rigid motions are taken out.
///
/// ```
/// assert_eq!(krawl::problem::free_coordinates(2, 6), 9);
/// assert_eq!(krawl::problem::free_coordinates(3, 6), 12);
/// ```
pub fn free_coordinates(dimension: usize, points: usize) -> usize {
    (dimension * points).saturating_sub(dimension * (dimension + 1) / 2)
}
