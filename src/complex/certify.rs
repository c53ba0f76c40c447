//! Sets of solutions as certificates.

use super::lower::Lowered;
use super::solve::{Solutions, Status};
use crate::certificate::complex::ComplexSet;
use crate::problem::Problem;

/// The solutions of a problem of distances, to be checked by [`verify_complex_set`]. `None`: there are other constraints,
/// or the reference has no place of its own, and no certificate is defined.
///
/// [`verify_complex_set`]: crate::certificate::complex::verify_complex_set
pub fn to_certificate(
    problem: &Problem,
    lowered: &Lowered,
    solutions: &Solutions,
) -> Option<ComplexSet> {
    let fixed = lowered.placed.as_ref()?;
    let system = &lowered.system;
    let figure = |one: &super::boxes::SolutionBox| {
        let part = |i: usize| one.figure.centre[i] * system.unit;
        let place = |unknowns: &[Option<usize>; 3]| {
            let axes = unknowns[..problem.dimension].iter();
            axes.map(|u| u.map_or([0.0; 2], |u| [part(2 * u), part(2 * u + 1)]))
                .collect()
        };
        system.points.iter().map(place).collect()
    };
    let is_cited = lowered.bound.as_ref().is_some_and(|bound| bound.is_cited);
    Some(ComplexSet {
        problem: problem.to_toml(),
        fixed: fixed
            .iter()
            .map(|&p| problem.points[p].name.clone())
            .collect(),
        solutions: solutions.boxes.boxes().iter().map(figure).collect(),
        // The checker knows neither the bound in the plane nor figures at infinity.
        complete: solutions.status == Status::Complete
            && !is_cited
            && problem.dimension == 3
            && solutions.departures.is_empty(),
    })
}
