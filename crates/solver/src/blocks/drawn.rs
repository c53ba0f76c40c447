//! Drawings that are singular by chance: flat, at a dead centre, three bars through one point.
//!
//! At such a drawing constraints depend on each other that do not at figures near it, so nothing can be told from it of
//! which constraints say something new, which contradict others, or whether there are figures. All of this is looked at in
//! floats, and nothing that is proved rests on it: a drawing that is found to be singular is moved off that place, and led to
//! its dimensions from there, by proof as from any other. The constraints stay what they are.

use super::{Choice, FINE, Row, System};
use crate::constraint::{Equation, Role};
use crate::equations::{Form, left_side, slopes};
use crate::interval::{Real, point};
use crate::linalg::{Linear, decomposed, linearised, nearest_zero, scaled, shortest};
use crate::map::Map;
use crate::order::each_once;
use crate::random::Random;
use crate::rational::Rational;

/// More unknowns are not looked at: it would take seconds.
pub(crate) const MANY: usize = 250;
/// How far the drawing is moved before it is led back to what is no dimension, as a part of its unit.
const MOVED: f64 = 0.02;
/// Ways to move it that are tried before it is taken for regular.
const SEEDS: u64 = 3;
/// A figure that misses its equations by less meets them.
const MET: f64 = 1e-9;

/// The equations of a sketch in floats, with its unknowns in a unit in which it is of size about 1.
pub(crate) struct Floats<'a> {
    system: &'a System,
    /// For each row what its left-hand side has to be.
    target: Vec<f64>,
}

/// A drawing, as it was found.
pub(crate) enum Drawn {
    /// As much depends on each other as at figures near it, or it is too large to be looked at.
    Regular,
    /// It is singular.
    Singular {
        /// The rows that depend on each other there, though not at figures near it.
        rows: Vec<usize>,
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

    /// By how much a place misses some rows at most, about as far as unknowns would have to move.
    pub fn missed(&self, rows: &[usize], at: &[f64]) -> f64 {
        self.linearise(rows, at).1.amax()
    }

    /// A place that meets some rows, by Newton's method with least changes; lengths and radii are positive there.
    pub fn meet(&self, rows: &[usize], at: Vec<f64>) -> Option<Vec<f64>> {
        if rows.is_empty() {
            return Some(at);
        }
        self.zero(at, &|at| self.linearise(rows, at))
    }

    /// The same of rows that are linearised so.
    pub fn zero(&self, at: Vec<f64>, linearise: &dyn Fn(&[f64]) -> Linear) -> Option<Vec<f64>> {
        let at = nearest_zero(at, 1e-10, linearise)?;
        let all = self.system.unknowns.iter().zip(&at);
        let mut positive = all.filter(|(unknown, _)| unknown.role == Role::Positive);
        positive.all(|(_, &x)| x > 0.0).then_some(at)
    }
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
    let rank = |at: &[f64]| {
        Choice::new(floats.system, at, |_| 0, |_| 0, FINE)
            .used
            .len()
    };
    let here = choice.used.len();
    let all: Vec<usize> = (0..structural.len()).collect();
    let kept: Vec<usize> = all.iter().copied().filter(|&r| structural[r]).collect();
    let circuits = choice.redundant.iter();
    let rows = circuits.flat_map(|&row| floats.circuit(&choice.used, row, at));
    let rows = each_once(rows);
    let of = |row: &usize| &floats.system.rows[*row].unknowns;
    let unknowns = each_once(rows.iter().flat_map(of).copied());
    let beside = |way: u64| {
        let mut random = Random::new(way / 2 + 1);
        let sign = if way.is_multiple_of(2) { MOVED } else { -MOVED };
        let mut moved = at.to_vec();
        for &u in &unknowns {
            moved[u] += sign * random.symmetric();
        }
        floats.meet(&kept, moved).filter(|at| rank(at) > here)
    };
    let Some(off) = [way].into_iter().chain(0..2 * SEEDS).find_map(beside) else {
        return Drawn::Regular;
    };
    let rows: Vec<usize> = rows.into_iter().collect();
    if floats.missed(&all, at) < MET {
        return Drawn::Singular { rows, off: None };
    }
    // Where dimensions themselves make equations depend on each other, they do so at the figures that meet them, too.
    let figures = (0..2 * SEEDS).filter_map(|way| floats.meet(&all, beside(way)?));
    let ranks: Vec<usize> = figures.map(|figure| rank(&figure)).collect();
    let as_singular = ranks.iter().all(|&rank| rank <= here) && !ranks.is_empty();
    Drawn::Singular {
        rows,
        off: (!as_singular).then_some(off),
    }
}

impl Row {
    /// The largest derivative of the left-hand side at a place, and the length of its gradient.
    pub(crate) fn steepness(&self, at: &[f64]) -> (f64, f64) {
        let mut slopes = Vec::new();
        self.evaluate(at, |u, slope| slopes.push((u, slope)));
        let slopes = Map::sums(slopes);
        let slopes = slopes.iter().map(|(_, slope)| slope);
        let steepest = slopes.clone().fold(0.0, |max: f64, s| max.max(s.abs()));
        let squares: f64 = slopes.map(|slope| slope * slope).sum();
        let least = f64::MIN_POSITIVE;
        (steepest.max(least), squares.sqrt().max(least))
    }

    /// The value of the left-hand side at a place, and its derivatives, one by one.
    pub(crate) fn evaluate(&self, at: &[f64], mut slope: impl FnMut(usize, f64)) -> f64 {
        let value = |entry: Option<usize>| entry.map_or(0.0, |u| at[u]);
        slopes(&self.products, value, |entry, by| {
            entry.into_iter().for_each(|u| slope(u, by));
        });
        left_side(&self.products, value)
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
