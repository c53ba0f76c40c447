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
use super::{Complete, Options, Status, Unserved};
use crate::complex::{self, Filling, Lowered, Nature, Template, Ways};
use crate::interval::DoubleDouble;
use crate::problem::Problem;
use crate::system::Homotopy;
use crate::track::certified::{Relation, prove_figure};
use crate::track::{FigureBox, Solution};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Parts looked at by the search that comes first.
const FIRST: u64 = 4000;
/// More complex solutions are not looked for.
const MOST: u128 = 5000;

/// All real solutions, by a short search, by all complex solutions, or else by a search of the rest of the time. `None`: this is no
/// such problem.
pub(super) fn all(problem: &Problem, options: &Options) -> Option<Result<Complete, Unserved>> {
    // Each constraint is one equation, beside those of what it is made of.
    if !problem.points.is_empty() || problem.constraints.len() != problem.objects.len() {
        return None;
    }
    let begin = Instant::now();
    let lowered = complex::lower(problem).ok()?;
    let bound = lowered.bound.as_ref()?;
    (bound.count <= MOST && bound.counts_curves).then_some(())?;
    let left = || {
        let time = options.time;
        time.map(|time| time.saturating_sub(begin.elapsed()))
    };
    let search = |most_boxes: u64| {
        let within = Options {
            time: left(),
            most_boxes,
            ..options.clone()
        };
        coordinates::all(problem, &within)
    };
    let first = match search(options.most_boxes.min(FIRST)) {
        Ok(first) if first.status != Status::Complete => first,
        decided => return Some(decided),
    };
    let stop = AtomicBool::new(false);
    // What is told of a search of boxes is not told of paths.
    let untold = Options {
        progress: None,
        ..options.clone()
    };
    let run = Run::new(&stop, &untold, false);
    let real = untold.watched(&run, begin, || {
        let (near, count) = real(problem, &lowered, options, begin)?;
        Some((proved_near(problem, &near)?, count))
    });
    let is_cancelled = || options.cancel.is_some_and(|c| c.load(Ordering::Relaxed));
    let mut result = match real {
        Some((solutions, count)) => Complete {
            reason: solutions.is_empty().then(|| {
                match problem.objects.iter().any(|of| of.shape.range().is_some()) {
                    true => "none of the complex solutions is real and in these ranges",
                    false => "none of the complex solutions is real",
                }
                .to_owned()
            }),
            method: Method::Complex,
            symmetry: first.symmetry,
            driving: first.driving,
            complex: Some(count),
            count: Some(solutions.len() as u64),
            solutions,
            ..Complete::empty(problem, String::new(), begin)
        },
        // There is nothing left to search, or no time.
        None if !first.was_ended() || options.most_boxes <= FIRST => first,
        None if is_cancelled() || left().is_some_and(|left| left.is_zero()) => first,
        None => match search(options.most_boxes) {
            Ok(result) => result,
            refused => return Some(refused),
        },
    };
    result.seconds = begin.elapsed().as_secs_f64();
    Some(Ok(result))
}

/// Points near all real solutions, and the number of complex ones; `None` where that these are all is not proved.
fn real(
    problem: &Problem,
    lowered: &Lowered,
    options: &Options,
    begin: Instant,
) -> Option<(Vec<Vec<f64>>, usize)> {
    // The claim rests on the number of solutions, each proved, and not on how they were come to.
    let within = Ways {
        proved: false,
        cancel: options.cancel,
        deadline: options.time.map(|time| begin + time),
        ..Ways::default()
    };
    let filling = Filling {
        enough: lowered.enough(),
        // Where paths from known solutions do not come to all, the search of boxes does.
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

/// The zeros near points that are in the ranges of all unknowns, each proved and all different; `None` where that cannot be proved, or where zeros need not
/// be solutions.
fn proved_near(problem: &Problem, near: &[Vec<f64>]) -> Option<Vec<Solution>> {
    let homotopy = Homotopy::new(problem).ok()?;
    if !homotopy.positive_unknowns().is_empty() || !homotopy.nonzero_vectors().is_empty() {
        return None;
    }
    let held = homotopy.held(problem).ok()?;
    let mut found: Vec<FigureBox> = Vec::with_capacity(near.len());
    for near in near {
        let one = prove_figure(&homotopy, near, false).ok()?;
        let is_new = |other: &FigureBox| one.relation(other, &homotopy) == Relation::Different;
        if !found.iter().all(is_new) {
            return None;
        }
        found.push(one);
    }
    // All of them are compared, also where a range has a few.
    let is_in = |one: &FigureBox| {
        let mut held = held.iter();
        held.try_fold(true, |all, held| {
            Some(all & held.admits(one.figure.enclosure(held.unknown))?)
        })
    };
    let is_in: Vec<bool> = found.iter().map(is_in).collect::<Option<_>>()?;
    let mut is_in = is_in.into_iter();
    found.retain(|_| is_in.next().unwrap_or(true));
    Some(coordinates::solutions(&homotopy, &found))
}
