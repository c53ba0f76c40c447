//! Unknowns that are one are made one.

use crate::constraint::{Entry, Lowered, Nonzero, Posed, Role, Unknown};
use crate::equations::Form;
use crate::interval::{Interval, Real, enclose, point as exactly};
use crate::map::Map;
use crate::order::each_once;
use crate::places::{Each as _, array};
use crate::problem::{Problem, Shape};
use crate::sets::Joined;
use crate::system::{Located, Term, locate};
use std::collections::HashMap;

/// An equation in merged unknowns, `½ Σ factor · left · right = E(t)`.
#[derive(Debug, Clone)]
pub struct Row {
    /// Which of the problem's equations it is.
    pub index: usize,
    /// The left-hand side.
    pub products: Vec<Term>,
    /// The unknowns in it.
    pub unknowns: Vec<usize>,
}

/// The equations of a problem in its own frame, in unknowns of which no two are said to be equal.
#[derive(Debug, Clone)]
pub struct System {
    /// The unknowns: coordinates of points first.
    pub unknowns: Vec<Unknown>,
    /// Their exact values in the sketch.
    pub values: Vec<Real>,
    /// For each coordinate of each point its unknown.
    pub coordinates: Vec<usize>,
    /// For each auxiliary unknown of the problem its number here.
    pub auxiliary: Vec<usize>,
    /// The equations that are left.
    pub rows: Vec<Row>,
    /// Equations of which nothing is left: they hold because unknowns are one.
    pub implied: Vec<usize>,
    /// Vectors that must not vanish along a path, in these unknowns.
    pub nonzero: Vec<Nonzero>,
    /// How many coordinates the unknowns that are coordinates stand for.
    pub merged: usize,
}

impl System {
    /// Where the objects of the problem are in a figure: its points in the problem's unit, and its unknowns, by number here, in a `unit` of length.
    pub fn locate(
        &self,
        problem: &Problem,
        (own, poses): &(Vec<Vec<Entry>>, Vec<Posed>),
        points: &[[Interval; 3]],
        unit: f64,
        unknown: &dyn Fn(usize) -> Interval,
    ) -> Vec<Located> {
        let d = problem.dimension;
        let value = |entry: Entry| match entry {
            Entry::Coordinate { point, axis } => unknown(self.coordinates[point * d + axis]),
            Entry::Unknown(k) => unknown(self.auxiliary[k]),
            Entry::Zero => exactly(0.0),
        };
        let shapes: Vec<&Shape> = problem.objects.iter().map(|o| &o.shape).collect();
        locate(&shapes, (own, poses), (d, unit), points, &value)
    }

    /// How many numbers the rows of one constraint speak of that no other row has: unknowns that are no coordinates of points, and none
    /// of an object's own (`objects`). Each takes one of its rows to say what it is.
    pub(super) fn own_numbers(
        &self,
        objects: &[Vec<Entry>],
        is_of_it: impl Fn(&Row) -> bool,
    ) -> usize {
        let of_it = self.rows.iter().filter(|row| is_of_it(row));
        let own = each_once(of_it.flat_map(|row| row.unknowns.iter().copied()));
        let is_object = |u: usize| {
            let mut entries = objects.iter().flatten();
            entries.any(|entry| matches!(entry, Entry::Unknown(k) if self.auxiliary[*k] == u))
        };
        let is_its_own = |u: &&usize| {
            let mut with = self.rows.iter().filter(|row| row.unknowns.contains(u));
            !self.coordinates.contains(u) && !is_object(**u) && with.all(&is_of_it)
        };
        own.iter().filter(is_its_own).count()
    }

    /// Ranks of the unknowns in a [choice](super::Choice) of what is held: coordinates of points come after others.
    pub fn later(&self) -> impl Fn(usize) -> u8 + use<> {
        let coordinates = each_once(self.coordinates.iter().copied());
        move |u: usize| coordinates.binary_search(&u).is_ok().into()
    }

    /// The vectors that must not vanish of which all unknowns are in a part, in the numbers that unknowns have there.
    pub fn nonzero_in(&self, dimension: usize, local: &HashMap<usize, usize>) -> Vec<Nonzero> {
        let is_here = |vector: &&Nonzero| {
            let mut of = vector.unknowns(dimension);
            of.all(|u| local.contains_key(&u))
        };
        let entry = |entry: Entry| Entry::from(entry.unknown().map(|u| local[&u]));
        let here = self.nonzero.iter().filter(is_here);
        let here = here.map(|vector| Nonzero {
            name: vector.name.clone(),
            forms: array(|axis| match axis < dimension {
                true => vector.forms[axis].map(entry),
                false => Form::Difference(Entry::Zero, Entry::Zero),
            }),
        });
        here.collect()
    }

    /// The unknowns' values in the sketch in floats, in a `unit` of length.
    pub fn sketch(&self, unit: f64) -> Vec<f64> {
        let at = self.unknowns.iter().zip(&self.values);
        at.map(|(unknown, value)| value.enclose().mid() / unit.powi(unknown.power))
            .collect()
    }

    /// Merges unknowns. `is_dimension`: whether an equation, by index, has a value that edits may change; all others
    /// with zero on the right at t = 0 have it there always.
    pub fn new(problem: &Problem, lowered: &Lowered, is_dimension: impl Fn(usize) -> bool) -> Self {
        let d = problem.dimension;
        let places = d * problem.points.len();
        let count = places + lowered.tail.unknowns.len();
        let raw = |entry: Entry| match entry {
            Entry::Coordinate { point, axis } => Some(d * point + axis),
            Entry::Unknown(u) => Some(places + u),
            Entry::Zero => None,
        };
        let mut sets = Joined::new(count);
        for (index, equation) in lowered.tail.equations.iter().enumerate() {
            let [single] = equation.products.as_slice() else {
                continue;
            };
            let pair = match (single.left, single.right) {
                (Form::Difference(a, b), Form::One) | (Form::One, Form::Difference(a, b)) => [a, b],
                _ => continue,
            };
            let [Some(a), Some(b)] = pair.each(raw) else {
                continue;
            };
            if equation.right.iter().all(Real::is_zero) && !is_dimension(index) {
                let [a, b] = [a, b].each(|x| sets.of(x));
                // The one that comes first stands for both, so that coordinates do.
                sets.join([a.max(b), a.min(b)]);
            }
        }
        let mut number = vec![usize::MAX; count];
        let (mut unknowns, mut values, mut merged) = (Vec::new(), Vec::new(), 0);
        for x in 0..count {
            if sets.of(x) != x {
                continue;
            }
            number[x] = unknowns.len();
            if x < places {
                let (point, axis) = (&problem.points[x / d], x % d);
                let at = &point.sketch[axis];
                unknowns.push(Unknown {
                    name: format!("{} of {}", ["x", "y", "z"][axis], point.name),
                    role: Role::Free,
                    power: 1,
                    flips: [false; 3],
                    sketch: enclose(at),
                });
                values.push(Real::from(at.value().clone()));
                merged += 1;
            } else {
                unknowns.push(lowered.tail.unknowns[x - places].clone());
                values.push(lowered.values[x - places].clone());
            }
        }
        // A length that is merged with another stays positive if either has to.
        for x in places..count {
            if lowered.tail.unknowns[x - places].role == Role::Positive {
                unknowns[number[sets.of(x)]].role = Role::Positive;
            }
        }
        let of = |x: usize| number[sets.of(x)];
        let entry = |e: Entry| raw(e).map(of);
        let (mut rows, mut implied) = (Vec::new(), Vec::new());
        for (index, equation) in lowered.tail.equations.iter().enumerate() {
            let products = normalised(equation.products.iter().map(|p| p.map(entry)));
            if products.is_empty() {
                implied.push(index);
                continue;
            }
            let unknowns = each_once(products.iter().flat_map(|p| p.entries()).flatten());
            rows.push(Row {
                index,
                products,
                unknowns,
            });
        }
        let nonzero = lowered.tail.nonzero.iter().map(|vector| Nonzero {
            name: vector.name.clone(),
            forms: vector.forms.each(|form| form.map(|e| entry(e).into())),
        });
        System {
            nonzero: nonzero.collect(),
            unknowns,
            values,
            coordinates: (0..places).map(of).collect(),
            auxiliary: (places..count).map(of).collect(),
            rows,
            implied,
            merged: places - merged,
        }
    }
}

/// A sum of products in which equal ones are added up, without products that are zero or cancel.
fn normalised(products: impl Iterator<Item = Term>) -> Vec<Term> {
    const NONE: usize = usize::MAX;
    // What stands for the entries of a difference, the lower unknown first, and its sign; `None` where it is zero.
    let ordered = |form: Form<Option<usize>>| {
        let Form::Difference(a, b) = form else {
            return Some(([NONE; 2], 1));
        };
        let [a, b] = [a, b].each(|entry| entry.unwrap_or(NONE));
        let sign = if a < b { 1 } else { -1 };
        (a != b).then_some(([a.min(b), a.max(b)], sign))
    };
    let sums = Map::sums(products.filter_map(|p| {
        let ((left, sign), (right, other)) = (ordered(p.left)?, ordered(p.right)?);
        Some(([left.min(right), left.max(right)], p.factor * sign * other))
    }));
    let form = |ends: [usize; 2]| match ends.each(|u| (u != NONE).then_some(u)) {
        [None, None] => Form::One,
        [a, b] => Form::Difference(a, b),
    };
    let terms = sums.into_iter();
    terms
        .map(|([left, right], factor)| Term::new(factor, form(left), form(right)))
        .collect()
}
