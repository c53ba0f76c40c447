//! Sets of solutions as certificates.

use super::boxes::SolutionBox;
use super::infinity;
use super::lower::Lowered;
use super::solve::{Solutions, Status};
use crate::certificate::complex::{ComplexSet, Departure};
use crate::problem::{Distance, Problem};

/// The solutions of a problem, to be checked by [`verify_complex_set`]. `None`: of distances, the reference has no place of its own,
/// and no certificate is defined.
///
/// [`verify_complex_set`]: crate::certificate::complex::verify_complex_set
pub fn to_certificate(
    problem: &Problem,
    lowered: &Lowered,
    solutions: &Solutions,
) -> Option<ComplexSet> {
    let is_cited = lowered.bound.as_ref().is_some_and(|bound| bound.is_cited);
    if !problem.is_distances_only() {
        let cited = lowered
            .bound
            .as_ref()
            .filter(|_| lowered.system.is_absolute);
        return Some(ComplexSet {
            problem: problem.unsigned().without_limits().to_toml(),
            fixed: Vec::new(),
            solutions: Vec::new(),
            unknowns: super::unknowns::of(problem, &lowered.system, &solutions.boxes)?,
            cited: cited.and_then(|bound| bound.count.try_into().ok()),
            at_infinity: Vec::new(),
            complete: false,
        });
    }
    let fixed = lowered.placed.as_ref()?;
    let system = &lowered.system;
    let figure = |one: &SolutionBox| {
        let number = numbers(one);
        let place = |unknowns: &[Option<usize>; 3]| {
            let axes = unknowns[..problem.dimension].iter();
            axes.map(|u| u.map_or(vec![0.0; 2], |u| number(u, system.unit)))
                .collect()
        };
        system.points.iter().map(place).collect()
    };
    let departures = solutions.departures.iter();
    Some(ComplexSet {
        problem: problem.unsigned().without_limits().to_toml(),
        fixed: names(problem, fixed),
        solutions: solutions.boxes.boxes().iter().map(figure).collect(),
        unknowns: Vec::new(),
        cited: None,
        at_infinity: departures
            .map(|one| departure(problem, one, system.unit))
            .collect(),
        // The checker does not know the bound in the plane.
        complete: solutions.status == Status::Complete && !is_cited && problem.dimension == 3,
    })
}

fn names(problem: &Problem, points: &[usize]) -> Vec<String> {
    let name = |&p: &usize| problem.points[p].name.clone();
    points.iter().map(name).collect()
}

/// The middle of a box: for an unknown, and what its unit is in the problem's, the real and the imaginary part. Where the equations
/// are not nearly linear as far as that is from the exact middle, what is left of both follows.
pub(super) fn numbers(one: &SolutionBox) -> impl Fn(usize, f64) -> Vec<f64> + '_ {
    let (high, low) = (&one.figure.centre, &one.figure.low);
    let is_near = low.iter().all(|low| low.abs() < 0.01 * one.alone_within);
    move |unknown, unit| {
        let parts = [2 * unknown, 2 * unknown + 1];
        let mut numbers: Vec<f64> = parts.iter().map(|&i| high[i] * unit).collect();
        if !is_near {
            numbers.extend(parts.iter().map(|&i| low[i] * unit));
        }
        numbers
    }
}

/// Figures at infinity, in the problem's unit.
fn departure(problem: &Problem, departure: &infinity::Departure, unit: f64) -> Departure {
    let split = &departure.split;
    let rise = |distance: &Distance| {
        let [a, b] = distance.points;
        let ends = match split.height(a)? < split.height(b)? {
            true => [a, b],
            false => [b, a],
        };
        Some(ends.map(|p| problem.points[p].name.clone()))
    };
    // λ σ is a square of a length, as is Λ τ; σ and Λ are numbers.
    let of = |numbers: &[usize], p: usize| match numbers.contains(&p) {
        true => 1.0,
        false => unit * unit,
    };
    let units = |p: usize| [of(&split.inside, p), unit, of(&split.outside, p)];
    let figure = |one: &SolutionBox| {
        let number = numbers(one);
        let place = |p: usize| {
            let units = units(p).into_iter().enumerate();
            units.map(|(k, unit)| number(3 * p + k, unit)).collect()
        };
        (0..problem.points.len()).map(place).collect()
    };
    Departure {
        away: names(problem, &split.inside),
        rises: problem.distances.iter().filter_map(rise).collect(),
        figures: departure.figures.boxes().iter().map(figure).collect(),
    }
}
