//! Sets of complex solutions of problems with other constraints than distances: zeros of the equations that paths follow, with t = 1.
//!
//! Zeros that differ by signs alone are one: by changes that keep every equation, of the coordinates along some axes and the auxiliary
//! unknowns that go with them, and of the directions of lines and planes of their own.

use super::figure::{number, square};
use super::zero::{Quadratic, Zero};
use crate::certificate::checker::equations::Equations;
use crate::certificate::cover::coordinates::{Change, changes};
use crate::constraint::symmetry;
use crate::interval::{Ball, Interval, Real, point};
use crate::problem::Problem;
use crate::system::Homotopy;
use num_rational::BigRational;

/// More lines and planes of their own are not served: all sums of changes of sign are tried.
const MOST_TWINS: usize = 8;

/// The equations of a problem in complex unknowns.
pub struct General {
    system: Quadratic,
    /// For each unknown what 1 is in the problem's unit of length, a power of two.
    units: Vec<f64>,
    /// For each change of signs that keeps the equations what it changes; the first changes nothing.
    changes: Vec<Vec<bool>>,
}

impl General {
    /// For a problem in which no unknown has to be positive.
    pub fn new(problem: &Problem) -> Result<Self, String> {
        let homotopy = Homotopy::new(problem).map_err(|error| error.to_string())?;
        if let Some(&first) = homotopy.positive_unknowns().first() {
            let name = &homotopy.tail.unknowns[first - homotopy.gauge.place.len()].name;
            return Err(format!(
                "complex solutions have no signs, and {name} has to be positive"
            ));
        }
        if homotopy.tail.twins.len() > MOST_TWINS {
            return Err("there are too many lines and planes of their own".to_owned());
        }
        let (m, head) = (homotopy.equations, homotopy.edges.len());
        let equation = |e: usize| {
            let right = match e < head {
                // ½ d².
                true => Ball::exactly(
                    square(&problem.distances[e].target) / BigRational::from_integer(2.into()),
                ),
                false => {
                    let coefficients = homotopy.tail.equations[e - head].right.iter();
                    let sum = coefficients.fold(Real::zero(), |sum, c| &sum + c);
                    sum.ball()
                }
            };
            let power = match e < head {
                true => 2,
                false => homotopy.tail.equations[e - head].power,
            };
            let per_unit = homotopy.unit.powi(-power);
            let per_unit = BigRational::from_float(per_unit).ok_or("a unit that is no number")?;
            let right = Ball {
                middle: right.middle * &per_unit,
                radius: right.radius * per_unit,
            };
            Ok((homotopy.terms(e), right))
        };
        let equations = (0..m).map(equation).collect::<Result<Vec<_>, String>>()?;
        let places = homotopy.gauge.place.len();
        let power = |i: usize| match i < places {
            true => 1,
            false => homotopy.tail.unknowns[i - places].power,
        };
        let units = (0..m).map(|i| homotopy.unit.powi(power(i))).collect();
        let (axes, twins) = (homotopy.dimension, homotopy.tail.twins.len());
        let eq = Equations::new(homotopy);
        let bits = |mask: usize, count: usize| -> Vec<usize> {
            (0..count).filter(|k| mask >> k & 1 == 1).collect()
        };
        let changes = (0..1usize << (axes + twins)).filter_map(|mask| {
            let by = Change {
                axes: bits(mask, axes),
                twins: bits(mask >> axes, twins),
            };
            changes(&eq, (symmetry(problem), &[]), &by)
        });
        Ok(General {
            system: Quadratic::enclosing(m, equations),
            units,
            changes: changes.collect(),
        })
    }

    /// Proves that there is exactly one zero near these numbers, unknown by unknown.
    pub fn prove(&self, unknowns: &[Vec<f64>]) -> Option<Zero> {
        if unknowns.len() != self.units.len() {
            return None;
        }
        let near = unknowns.iter().zip(&self.units).map(|(parts, unit)| {
            let parts: Vec<f64> = parts.iter().map(|x| x / unit).collect();
            number(&parts)
        });
        self.system.prove(&near.collect::<Option<Vec<_>>>()?)
    }

    /// Whether a zero is real: the conjugate, which is a zero too, is the same. `None`: that is not clear.
    pub fn is_real(&self, zero: &Zero) -> Option<bool> {
        zero.is_same(&zero.image(|_| false, true))
    }

    /// Whether two zeros are the same but for signs. `None`: that is not clear.
    pub fn are_one(&self, one: &Zero, other: &Zero) -> Option<bool> {
        let mut clear = Some(false);
        for changes in &self.changes {
            match one.is_same(&other.image(|k| changes[k], false)) {
                Some(false) => {}
                Some(true) => return Some(true),
                None => clear = None,
            }
        }
        clear
    }

    /// A number that changes of signs do not change: where those of two zeros are disjoint they are not one.
    pub fn key(&self, zero: &Zero) -> Interval {
        // Any weights would do.
        (0..self.units.len()).fold(point(0.0), |sum, k| {
            let [re, im] = zero.part(k);
            let weight = point(1.0 + (k as f64 * 0.618_034) % 1.0);
            sum + weight * (re.sqr() - im.sqr())
        })
    }
}
