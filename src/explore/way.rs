//! Ways: which plan makes sketches, which length bends, and by how much.

use super::construction::Construction;
use crate::interval::vector::distance;
use crate::problem::{Decimal, Distance, Problem};

/// A way to make sketches from solutions and to follow them.
#[derive(Debug, Clone, PartialEq)]
pub struct Way {
    /// Its number: 0 has the problem's own bend.
    pub number: usize,
    /// Which of the plans.
    pub plan: usize,
    /// Which distance bends.
    pub bend: usize,
    /// By how much.
    pub coefficient: Decimal,
    /// Points of new sketches are moved by so many typical lengths at most. Where there are constraints other than
    /// distances a sketch should not meet them: a coplanarity that holds all along makes paths degenerate (the
    /// same paper, section 5.2).
    pub shake: f64,
}

/// Coefficients beside the problem's own.
const FACTORS: [f64; 3] = [1.0, 4.0, 0.25];

impl Way {
    /// The way of a number.
    pub fn new(problem: &Problem, plans: &[Construction], number: usize) -> Self {
        let (distances, own) = (problem.distances.len(), &problem.homotopy);
        // Of a problem whose file names none it is the number of distances.
        let bend = if own.bend < distances {
            own.bend
        } else {
            distances - 1
        };
        let coefficient = if own.bend_coefficient == Decimal::from(0) && number > 0 {
            crate::problem::default_bend(&problem.distances)
        } else {
            own.bend_coefficient.clone()
        };
        // Each round through the distances begins with another factor.
        let factor = FACTORS[(number + number / distances) % FACTORS.len()];
        let coefficient = match factor {
            1.0 => coefficient,
            _ => {
                let text = format!("{:.5e}", factor * coefficient.to_f64());
                text.parse().unwrap_or(coefficient)
            }
        };
        Way {
            number,
            plan: number % plans.len(),
            bend: (bend + number) % distances,
            coefficient,
            shake: match problem.is_distances_only() {
                true => 0.0,
                false => 0.05,
            },
        }
    }

    /// Whether paths of the other way are those of the same lengths a(t), from the same sketch.
    pub fn bends_like(&self, other: &Way) -> bool {
        self.bend == other.bend && self.coefficient == other.coefficient
    }

    /// The problem with another sketch, or its own, and this way's bend.
    pub fn problem(&self, problem: &Problem, sketch: Option<&[[f64; 3]]>) -> Problem {
        bent(problem, sketch, (self.bend, &self.coefficient))
    }
}

/// The problem with its own sketch or another one, in which this length bends by this coefficient.
pub fn bent(
    problem: &Problem,
    sketch: Option<&[[f64; 3]]>,
    (bend, coefficient): (usize, &Decimal),
) -> Problem {
    let mut of = problem.clone();
    let decimal = |x: f64| Decimal::try_from(x).unwrap_or_else(|_| Decimal::from(0));
    for (point, place) in of.points.iter_mut().zip(sketch.into_iter().flatten()) {
        point.sketch = place.map(decimal);
    }
    of.homotopy.bend = bend;
    of.homotopy.bend_coefficient = coefficient.clone();
    of
}

/// Whether a path can set out from a sketch: joined points are apart, the reference is not in line, and the
/// checks of files find nothing. In floats, as sketches are rough anyway.
pub fn is_usable(of: &Problem) -> bool {
    let places = of.places();
    let length = |a: usize, b: usize| distance(places[a], places[b]);
    let typical = of
        .distances
        .iter()
        .map(|d: &Distance| length(d.points[0], d.points[1]))
        .fold(0.0, f64::max);
    let apart = |a: usize, b: usize| length(a, b) > 1e-6 * typical;
    of.distances
        .iter()
        .all(|d| apart(d.points[0], d.points[1]))
        // Of distances alone nothing that is checked depends on the sketch.
        && (of.is_distances_only() || of.check().is_ok())
}
