//! What may be removed where constraints are too many.

use super::System;
use super::choose::PIVOT;
use super::cut::straight_apart;
use super::drawn::Floats;
use super::whose::Whose;
use crate::problem::{Decimal, Problem};
use crate::system::typical_length;

/// Whether a problem without a constraint has no more freedom than so much, with which it is at this place, as far as floats
/// tell: from there it is led to a figure that meets the rest, or as much of that as can be. `None`: none was found.
pub(super) fn cures(
    problem: &Problem,
    owner: Whose,
    (system, at): (&System, &[f64]),
    freedom: usize,
) -> Option<bool> {
    let (d, unit) = (problem.dimension, typical_length(problem));
    let mut rest = problem.clone();
    match owner {
        Whose::Constraint(c) => drop(rest.constraints.remove(c)),
        Whose::Distance(e) => drop(rest.distances.remove(e)),
        Whose::Object(_) | Whose::Pin => return Some(false),
    }
    rest.labels.clear();
    for (point, of) in rest.points.iter_mut().zip(system.coordinates.chunks(d)) {
        for (x, &u) in point.sketch.iter_mut().zip(of) {
            *x = Decimal::try_from(at[u] * unit).ok()?;
        }
    }
    let (rest, lowered) = straight_apart(&rest).ok()?;
    let system = System::new(&rest, &lowered, |_| true);
    let unit = typical_length(&rest);
    let floats = Floats::new(&system, &lowered.tail.equations, unit);
    let rows: Vec<usize> = (0..system.rows.len()).collect();
    let from = system.sketch(unit);
    let most = || floats.meet(&floats.independent(&rows, &from, PIVOT).0, from.clone());
    let at = floats.meet(&rows, from.clone()).or_else(most)?;
    let rank = floats.independent(&rows, &at, PIVOT).0.len();
    Some(system.unknowns.len() - rank == freedom)
}
