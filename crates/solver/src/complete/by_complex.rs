//! All real solutions of equations without points, as the real ones of all complex solutions.
//!
//! Where as many complex solutions are proved as the product of the degrees says, there is no other: by Bézout's theorem the degrees of
//! all components of the set of complex zeros, isolated or not, add up to that product at most (Fulton, *Intersection Theory*,
//! 1984, example 8.4.6). A zero is real where the box of its conjugate lies where it is alone, and it is not where the boxes are apart. So
//! the number of real zeros is known, and as many different ones, each proved in a box of its own, are all.
//!
//! A search of boxes comes first, for as long as it takes to see that a system is a small one: it needs no bound, and what it tells
//! of curves of solutions this does not.

use super::coordinates;
use super::outcome::Method;
use super::search::Run;
use super::{Complete, Options};
use crate::complex::{self, Filling, Lowered, Nature, Template, Ways};
use crate::interval::DoubleDouble;
use crate::problem::Problem;
use crate::system::Homotopy;
use crate::track::certified::{Relation, prove_figure};
use crate::track::{FigureBox, Solution};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Parts looked at by the search that comes first.
const FIRST: u64 = 4000;
/// More complex solutions are not looked for.
const MOST: u128 = 5000;

/// All real solutions, where a short search or the complex solutions tell them.
pub(super) fn all(problem: &Problem, options: &Options) -> Option<Complete> {
    if !problem.points.is_empty() {
        return None;
    }
    let lowered = complex::lower(problem).ok()?;
    lowered.bound.as_ref().filter(|bound| bound.count <= MOST)?;
    let begin = Instant::now();
    let short = Options {
        cancel: options.cancel,
        time: options.time,
        threads: options.threads,
        redundant_tolerance: options.redundant_tolerance,
        most_boxes: options.most_boxes.min(FIRST),
        ..Options::default()
    };
    let first = coordinates::all(problem, &short).ok()?;
    if !first.was_ended() {
        return Some(first);
    }
    let stop = AtomicBool::new(false);
    let run = Run::new(&stop, options, false);
    let (near, count) = options.watched(&run, begin, || real(problem, &lowered, options, begin))?;
    let solutions = proved_near(problem, &near)?;
    let mut result = Complete::empty(problem, String::new(), begin);
    result.reason = solutions
        .is_empty()
        .then(|| "none of the complex solutions is real".to_owned());
    result.method = Method::Complex;
    result.symmetry = first.symmetry;
    result.driving = first.driving;
    result.boxes = first.boxes;
    result.complex = Some(count);
    result.count = Some(solutions.len() as u64);
    result.solutions = solutions;
    result.seconds = begin.elapsed().as_secs_f64();
    Some(result)
}

/// Points near all real solutions, and the number of complex ones; `None` where that these are all is not proved.
fn real(
    problem: &Problem,
    lowered: &Lowered,
    options: &Options,
    begin: Instant,
) -> Option<(Vec<Vec<f64>>, usize)> {
    let within = Ways {
        cancel: options.cancel,
        deadline: options.time.map(|time| begin + time),
        ..Ways::default()
    };
    let filling = Filling {
        enough: lowered.enough(),
        // Where paths from powers of the unknowns do not come to all, the search of boxes does.
        patience: 0,
        ways: within,
        ..Filling::default()
    };
    let fibre = complex::fill(&lowered.system, &filling).ok()?;
    if lowered.enough() != Some(fibre.solutions.len()) {
        return None;
    }
    let template = Template::new(&problem.name, fibre);
    let found = complex::solve(lowered, &template, &within);
    let is_told = |nature: &Nature| !matches!(nature, Nature::Unknown | Nature::Alone);
    if found.status != complex::Status::Complete || !found.natures.iter().all(is_told) {
        return None;
    }
    let real_parts = |x: &[DoubleDouble]| x.iter().step_by(2).map(|x| x.hi).collect();
    let near = found
        .real()
        .map(|k| real_parts(&found.boxes.boxes()[k].middle()));
    Some((near.collect(), found.boxes.len()))
}

/// The zeros near points, each proved and all different; `None` where that cannot be proved, or where zeros need not be solutions.
fn proved_near(problem: &Problem, near: &[Vec<f64>]) -> Option<Vec<Solution>> {
    let homotopy = Homotopy::new(problem).ok()?;
    if !homotopy.positive_unknowns().is_empty() || !homotopy.nonzero_vectors().is_empty() {
        return None;
    }
    let mut found: Vec<FigureBox> = Vec::with_capacity(near.len());
    for near in near {
        let one = prove_figure(&homotopy, near, false).ok()?;
        let is_new = |other: &FigureBox| one.relation(other, &homotopy) == Relation::Different;
        if !found.iter().all(is_new) {
            return None;
        }
        found.push(one);
    }
    Some(coordinates::solutions(&homotopy, &found))
}
