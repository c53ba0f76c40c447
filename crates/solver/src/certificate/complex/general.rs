//! Sets of complex solutions of problems with other constraints than distances: zeros of the equations that paths follow, with t = 1.
//!
//! Zeros are one if changes of signs take one to the other: of the coordinates along some axes and the auxiliary unknowns that go with
//! them, and of the directions of lines and planes of their own. Whether such a change keeps the equations is not asked: where one zero
//! is another one's image, it did; and a change too many only makes it harder for zeros to be called different.

use super::figure::number;
use super::zero::{Quadratic, Zero};
use crate::certificate::cover::coordinates::{Change, signs_changed};
use crate::constraint::symmetry;
use crate::interval::{Interval, point};
use crate::problem::Problem;
use crate::system::Homotopy;

/// The equations of a problem in complex unknowns.
pub struct General {
    system: Quadratic,
    /// For each unknown what 1 is in the problem's unit of length, a power of two.
    units: Vec<f64>,
    /// For each of these changes of signs what it changes; the first changes nothing.
    pub changes: Vec<Vec<bool>>,
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
        if homotopy.tail.twins.len() > Change::MOST_TWINS {
            return Err("there are too many lines and planes of their own".to_owned());
        }
        let m = homotopy.equations;
        let equation = |e: usize| (homotopy.terms(e), homotopy.rights[e].ball_at_target());
        let system = Quadratic::enclosing(m, (0..m).map(equation).collect());
        let unit = |i: usize| homotopy.unit.powi(homotopy.power(i));
        let units = (0..m).map(unit).collect();
        let all = Change::all(homotopy.dimension, homotopy.tail.twins.len());
        let allowed = symmetry(problem);
        let changes = all.filter_map(|by| signs_changed(&homotopy, allowed, &by));
        Ok(General {
            system,
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
