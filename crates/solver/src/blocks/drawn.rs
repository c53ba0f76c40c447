//! Drawings that are singular by chance: flat, at a dead centre, three bars through one point.
//!
//! At such a drawing constraints depend on each other that do not at figures near it, so nothing can be told from it of
//! which constraints say something new, which contradict others, or whether there are figures. All of this is looked at in
//! floats, and nothing that is proved rests on it: a drawing that is found to be singular is moved off that place, and led to
//! its dimensions from there, by proof as from any other. The constraints stay what they are.

use super::tried::Tried;
use super::{Choice, FINE, System};
use crate::constraint::{Equation, Role};
use crate::equations::Form;
use crate::interval::{Real, point};
use crate::linalg::{Linear, decomposed, linearised, nearest, nearest_zero, scaled, shortest};
use crate::order::each_once;
use crate::random::Random;
use crate::rational::Rational;
use nalgebra::DVector;

/// A row of which less is new, as a part of it, does not clearly say something new.
pub(super) const CLEAR: f64 = 1e-4;
/// More unknowns are not looked at: it would take seconds.
pub(crate) const MANY: usize = 250;
/// How far the drawing is moved before it is led back to what is no dimension, as a part of its unit.
pub(super) const MOVED: f64 = 0.02;
/// Ways to move it that are tried before it is taken for regular.
pub(super) const SEEDS: u64 = 3;
/// A figure that misses its equations by less meets them.
pub(super) const MET: f64 = 1e-9;

/// Rows that are combinations of others, each with those others and their parts in it.
pub(super) type Circuits = Vec<(usize, Vec<(usize, f64)>)>;

/// The equations of a sketch in floats, with its unknowns in a unit in which it is of size about 1.
pub(crate) struct Floats<'a> {
    system: &'a System,
    /// For each row what its left-hand side has to be.
    target: Vec<f64>,
}

/// What was seen near a drawing at which constraints depend on each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seen {
    /// At figures near it that meet all constraints they do not depend on each other.
    Regular,
    /// At figures near it they do, though one of them at least does not follow from the others.
    FirstOrder,
    /// At figures near it they do, and follow from each other: they are too many.
    TooMany,
    /// No figure was found near it. At places that meet what is no dimension they do not.
    NoFigure,
}

/// A drawing, as it was found.
pub(crate) enum Drawn {
    /// As much depends on each other as at figures near it that meet what is no dimension, it is a figure and what depends on
    /// others there follows from them, or it is too large to be looked at.
    Regular,
    /// It is singular.
    Singular {
        /// The rows that depend on each other there.
        rows: Vec<usize>,
        /// What was seen of them near it.
        seen: Seen,
        /// A place near it, for each unknown, that is not singular, and meets what is no dimension; `None`: the drawing meets
        /// its dimensions, or figures near it that do are singular too.
        off: Option<Vec<f64>>,
    },
}

impl<'a> Floats<'a> {
    /// Of a system with these equations, of which the rows are, in a `unit` of length.
    pub fn new(system: &'a System, equations: &[Equation], unit: f64) -> Self {
        let target = system.rows.iter().map(|row| {
            let equation = &equations[row.index];
            equation.target().enclose().mid() / unit.powi(equation.power)
        });
        Floats {
            target: target.collect(),
            system,
        }
    }

    /// The Jacobian of some rows, each scaled to length 1, and by how much their left-hand sides, scaled, are too large.
    pub fn linearise(&self, rows: &[usize], at: &[f64]) -> Linear {
        scaled(linearised((rows.len(), at.len()), &|r, slope| {
            self.system.rows[rows[r]].evaluate(at, slope) - self.target[rows[r]]
        }))
    }

    /// The fewest of some rows that depend on each other at a place, of which the others say what this one does: with it.
    pub fn circuit(&self, others: &[usize], row: usize, at: &[f64]) -> Vec<usize> {
        const PART: f64 = 1e-6;
        let (jacobian, _) = self.linearise(others, at);
        let wanted = self.linearise(&[row], at).0.row(0).transpose();
        let turned = decomposed(jacobian.transpose(), [true, true]);
        let parts = shortest(&turned, &wanted, 1e-9).map_or(Vec::new(), |sum| sum.data.into());
        let all = others.iter().zip(parts);
        let taken = all.filter(|(_, part)| part.abs() > PART);
        let mut rows: Vec<usize> = taken.map(|(&row, _)| row).collect();
        rows.push(row);
        rows
    }

    /// Of rows in this order those that say something new after those before, more than `pivot` of each, and each other one with
    /// the rows of which it is a combination, all rows scaled to length 1: by the method of Gram and Schmidt, each row twice.
    pub fn independent(&self, order: &[usize], at: &[f64], pivot: f64) -> (Vec<usize>, Circuits) {
        const PART: f64 = 1e-6;
        let (jacobian, _) = self.linearise(order, at);
        // Directions of length 1 at right angles to each other, and of which of the rows taken each is a combination.
        let mut basis: Vec<(DVector<f64>, Vec<f64>)> = Vec::new();
        let (mut taken, mut circuits) = (Vec::new(), Vec::new());
        for (k, &row) in order.iter().enumerate() {
            let mut rest: DVector<f64> = jacobian.row(k).transpose();
            let mut of = vec![0.0; taken.len()];
            for _ in 0..2 {
                for (direction, parts) in &basis {
                    let along = direction.dot(&rest);
                    if along != 0.0 {
                        rest.axpy(-along, direction, 1.0);
                        for (sum, part) in of.iter_mut().zip(parts) {
                            *sum -= along * part;
                        }
                    }
                }
            }
            let size = rest.norm();
            if size > pivot {
                of.push(1.0);
                of.iter_mut().for_each(|part| *part /= size);
                basis.push((rest / size, of));
                taken.push(row);
            } else {
                let all = taken.iter().zip(&of);
                let circuit = all
                    .filter(|(_, part)| part.abs() > PART)
                    .map(|(&row, &part)| (row, part));
                circuits.push((row, circuit.collect()));
            }
        }
        (taken, circuits)
    }

    /// By how much a place misses some rows at most, about as far as unknowns would have to move.
    pub fn missed(&self, rows: &[usize], at: &[f64]) -> f64 {
        self.linearise(rows, at).1.amax()
    }

    /// The unknowns of a row.
    pub fn unknowns_of(&self, row: usize) -> &[usize] {
        &self.system.rows[row].unknowns
    }

    /// By how much the left-hand side of a row, as it stands, is too large at a place.
    pub fn value(&self, row: usize, at: &[f64]) -> f64 {
        self.system.rows[row].evaluate(at, |_, _| {}) - self.target[row]
    }

    /// The length of a row's gradient at a place.
    pub fn steepness(&self, row: usize, at: &[f64]) -> f64 {
        self.system.rows[row].steepness(at).1
    }

    /// Whether a place misses a row.
    pub fn misses(&self, row: usize, at: &[f64]) -> bool {
        self.value(row, at).abs() > MET * self.steepness(row, at).max(1.0)
    }

    /// Whether lengths and radii are positive at a place.
    pub fn is_proper(&self, at: &[f64]) -> bool {
        let mut all = self.system.unknowns.iter().zip(at);
        all.all(|(unknown, &x)| unknown.role != Role::Positive || x > 0.0)
    }

    /// Which rows say something new at a place.
    pub fn choice(&self, at: &[f64]) -> Choice {
        Choice::new(self.system, at, |_| 0, |_| 0, FINE)
    }

    /// A place that meets some rows, by Newton's method with least changes; lengths and radii are positive there.
    pub fn meet(&self, rows: &[usize], at: Vec<f64>) -> Option<Vec<f64>> {
        if rows.is_empty() {
            return Some(at);
        }
        self.zero(at, &|at| self.linearise(rows, at))
    }

    /// A place near this one that meets rows of which some may depend on others wherever they are met. There Newton's method leaps, so that damped steps lead to
    /// where they are nearly met; and from there those rows alone do that say something new, as all of them get no nearer than about 1e-7.
    pub(super) fn figure(&self, rows: &[usize], at: Vec<f64>) -> Option<Vec<f64>> {
        let near = nearest(DVector::from_vec(at), [1e-13, 1.0], &|at| {
            self.linearise(rows, at)
        });
        let near: Vec<f64> = near.data.into();
        let own = self.independent(rows, &near, CLEAR).0;
        let near = self.meet(&own, near)?;
        (self.missed(rows, &near) < MET).then_some(near)
    }

    /// The Jacobian of some rows by some unknowns alone, as [`Floats::linearise`] has them.
    pub(super) fn linearise_in(&self, rows: &[usize], unknowns: &[usize], at: &[f64]) -> Linear {
        let (jacobian, off) = self.linearise(rows, at);
        (jacobian.select_columns(unknowns), off)
    }

    /// A place that meets some rows, as [`Floats::meet`] has it, and differs from this one in some unknowns alone.
    pub fn meet_in(&self, rows: &[usize], unknowns: &[usize], at: Vec<f64>) -> Option<Vec<f64>> {
        let whole = |own: &[f64]| {
            let mut whole = at.clone();
            unknowns.iter().zip(own).for_each(|(&u, &x)| whole[u] = x);
            whole
        };
        let own = unknowns.iter().map(|&u| at[u]).collect();
        let linearise = |own: &[f64]| self.linearise_in(rows, unknowns, &whole(own));
        let own = match rows.is_empty() {
            true => Some(own),
            false => nearest_zero(own, 1e-10, &linearise),
        };
        own.map(|own| whole(&own)).filter(|at| self.is_proper(at))
    }

    /// The same of rows that are linearised so.
    pub fn zero(&self, at: Vec<f64>, linearise: &dyn Fn(&[f64]) -> Linear) -> Option<Vec<f64>> {
        nearest_zero(at, 1e-10, linearise).filter(|at| self.is_proper(at))
    }
}

/// A place with some unknowns moved, in one of the ways to do so, two and two in opposite directions.
pub(super) fn moved(at: &[f64], unknowns: impl Iterator<Item = usize>, way: u64) -> Vec<f64> {
    let mut random = Random::new(way / 2 + 1);
    let size = if way.is_multiple_of(2) { MOVED } else { -MOVED };
    let mut moved = at.to_vec();
    for u in unknowns {
        moved[u] += size * random.symmetric();
    }
    moved
}

/// Looks at a drawing of which a choice of equations has been made. `structural`: for each row whether it is no dimension.
/// `way`: of the ways to move off a singular drawing this one, two and two in opposite directions.
pub(crate) fn look(
    floats: &Floats,
    structural: &[bool],
    (at, choice): (&[f64], &Choice),
    way: u64,
) -> Drawn {
    if choice.redundant.is_empty() || at.len() > MANY {
        return Drawn::Regular;
    }
    let rank = |at: &[f64]| floats.choice(at).used.len();
    let here = choice.used.len();
    let all: Vec<usize> = (0..structural.len()).collect();
    let kept: Vec<usize> = all.iter().copied().filter(|&r| structural[r]).collect();
    let circuit = |row: usize| floats.circuit(&choice.used, row, at);
    let mut rows = each_once(choice.redundant.iter().copied().flat_map(circuit));
    let of = |row: &usize| &floats.system.rows[*row].unknowns;
    let unknowns = each_once(rows.iter().flat_map(of).copied());
    let beside = |way: u64| {
        let moved = moved(at, unknowns.iter().copied(), way);
        floats.meet(&kept, moved).filter(|at| rank(at) > here)
    };
    let Some(off) = [way].into_iter().chain(0..2 * SEEDS).find_map(beside) else {
        return Drawn::Regular;
    };
    let is_met = floats.missed(&all, at) < MET;
    let ways = (0..2 * SEEDS).filter_map(beside);
    let figures: Vec<Vec<f64>> = ways.filter_map(|at| floats.figure(&all, at)).collect();
    let clear = |at: &[f64]| floats.independent(&all, at, CLEAR).0.len();
    let clear_here = clear(at);
    let seen = match figures.first() {
        _ if figures.iter().any(|figure| clear(figure) > clear_here) => Seen::Regular,
        None => Seen::NoFigure,
        Some(figure) => {
            // Those that do not follow from the others at figures near it.
            let mut kept = all.clone();
            let single = choice.redundant.iter().copied().filter(|&row| {
                kept.retain(|&other| other != row);
                let follows = matches!(floats.tried(row, &kept, figure), Tried::Holds);
                if !follows {
                    kept.push(row);
                }
                !follows
            });
            let single: Vec<usize> = single.collect();
            match single.is_empty() {
                true => Seen::TooMany,
                false => {
                    rows = each_once(single.into_iter().flat_map(circuit));
                    Seen::FirstOrder
                }
            }
        }
    };
    if is_met && seen == Seen::TooMany {
        return Drawn::Regular;
    }
    // Where dimensions themselves make equations depend on each other, they do so at the figures that meet them, too.
    let as_singular = figures.iter().all(|figure| rank(figure) <= here) && !figures.is_empty();
    Drawn::Singular {
        rows,
        seen,
        off: (!is_met && !as_singular).then_some(off),
    }
}

impl System {
    /// How far a place of the unknowns, in a unit, is from where points are, at most.
    pub(crate) fn moved(&self, at: &[f64], dimension: usize, unit: f64) -> f64 {
        let off = |&u: &usize| at[u] * unit - self.values[u].enclose().mid();
        let points = self.coordinates.chunks(dimension);
        let apart = points.map(|of| of.iter().map(|u| off(u).powi(2)).sum::<f64>().sqrt());
        apart.fold(0.0, f64::max)
    }

    /// Takes another place for that of the sketch: the right-hand sides of the equations, by index, that go from what they are
    /// there to what they have to be. What has hardly moved stays where it is.
    pub(crate) fn set_off(
        &mut self,
        at: &[f64],
        unit: f64,
        target: impl Fn(usize) -> Real,
    ) -> Vec<(usize, Vec<Real>)> {
        const HARDLY: f64 = 1e-9;
        let mut has_moved = vec![false; at.len()];
        for (u, unknown) in self.unknowns.iter_mut().enumerate() {
            let place = at[u] * unit.powi(unknown.power);
            let before = self.values[u].enclose().mid() / unit.powi(unknown.power);
            let exact = Rational::from_float(place);
            if let (true, Some(exact)) = ((at[u] - before).abs() > HARDLY, exact) {
                (self.values[u], unknown.sketch) = (Real::from(exact), point(place));
                has_moved[u] = true;
            }
        }
        let values = &self.values;
        let value = |entry: Option<usize>| entry.map_or_else(Real::zero, |u| values[u].clone());
        let form = |form: Form<Option<usize>>| match form {
            Form::One => Real::whole(1),
            Form::Difference(a, b) => &value(a) - &value(b),
        };
        let rows = self.rows.iter();
        let rows = rows.filter(|row| row.unknowns.iter().any(|&u| has_moved[u]));
        rows.map(|row| {
            let half = Real::from(Rational::new(1.into(), 2.into()));
            let from = row.products.iter().fold(Real::zero(), |sum, p| {
                let factor = &half * &Real::whole(p.factor.into());
                &sum + &(&factor * &(&form(p.left) * &form(p.right)))
            });
            let target = target(row.index);
            let way = &target - &from;
            (row.index, vec![from, way])
        })
        .collect()
    }
}
