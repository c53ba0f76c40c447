//! A certified run's answer is a property of the path: it does not depend on how the path is
//! followed or written down. Random problems to ten points, shrunk where one fails.

use crate::common::boxes::{View, check, matching};
use crate::common::moves::{mirrored, moved, ratio, relabelled, scaled};
use crate::common::random::{Recipe, recipe, same_each_time};
use crate::common::{SHORT, shipped};
use krawl::problem::Problem;
use krawl::track::{self, Control, Options, Outcome, Solution, Space, Status};
use nalgebra::DMatrix;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseError, TestError, TestRng, TestRunner};
use std::cell::Cell;

fn limited(options: Options) -> Options {
    Options {
        max_steps: 20_000,
        ..options
    }
}

fn closed(problem: &Problem, options: Options) -> Option<Outcome> {
    let outcome = track::solve(problem, &limited(options), &mut Control::default()).ok()?;
    crate::common::no_bug(problem, &outcome);
    (outcome.status == Status::Closed).then_some(outcome)
}

/// The ways to follow the same path, with the same problem or one that means the same, and how
/// solutions of the first look as solutions of the second.
fn others(problem: &Problem, step: f64) -> Vec<(&'static str, Problem, Options, View)> {
    let certified = Options::certified;
    let same = || View::same(problem);
    let (labels, place) = relabelled(problem);
    let unit = ratio(3, 8);
    let mut list = vec![
        (
            "other direction",
            problem.clone(),
            certified().reversed(),
            same(),
        ),
        (
            "bounded steps",
            problem.clone(),
            certified().with_max_step(step),
            same(),
        ),
        (
            // Certified tracking in the reduced space, where there is one.
            "reduced space",
            problem.clone(),
            Options {
                space: Space::Reduced,
                ..certified()
            },
            same(),
        ),
        ("rigid motion", moved(problem), certified(), same()),
        (
            "other unit",
            scaled(problem, &unit),
            certified(),
            View {
                factors: [unit.clone(), unit.clone(), unit.clone()],
                ..same()
            },
        ),
        (
            "other labels",
            labels,
            certified(),
            View {
                point: place,
                ..same()
            },
        ),
    ];
    // The gauge keeps the first coordinates positive: a mirror image changes the last one only.
    let minus = ratio(-1, 1);
    let mut factors = same().factors;
    factors[problem.dimension - 1] = minus;
    list.push((
        "mirror image",
        mirrored(problem),
        certified(),
        View { factors, ..same() },
    ));
    list
}

/// As many solutions, and as many of them congruent, whatever the reference: figures look different
/// from another one, so that these are all that can be compared in the open.
fn other_reference(problem: &Problem, first: &Outcome) -> Result<bool, String> {
    let mut other = problem.clone();
    other.homotopy.reference.reverse();
    if other.check().is_err() {
        return Ok(false);
    }
    let Some(outcome) = closed(&other, Options::certified()) else {
        return Ok(false);
    };
    let classes = |outcome: &Outcome| {
        let classes = outcome.solutions.iter().map(|s| s.class + 1);
        (outcome.solutions.len(), classes.max().unwrap_or(0))
    };
    if classes(first) == classes(&outcome) {
        Ok(true)
    } else {
        Err(format!(
            "another reference: {:?} and {:?}",
            classes(first),
            classes(&outcome)
        ))
    }
}

/// The sign of det ∂F/∂X at every solution, in the order of the path; F has a row ½ (|p_i − p_j|² − a²)
/// for every distance. `None`: floats cannot tell one of them.
///
/// The path's tangent solves J τ = 0, so that by Cramer's rule it is the vector of J's minors times one
/// factor, which never vanishes on a regular path and so keeps its sign; the minor of t is this one. So
/// t rises at the solutions of one sign and falls at those of the other.
fn signs(problem: &Problem, solutions: &[Solution]) -> Option<Vec<bool>> {
    let d = problem.dimension;
    let mut column = vec![[None; 3]; problem.points.len()];
    let mut count = 0;
    for (p, column) in column.iter_mut().enumerate() {
        let fixed = problem.homotopy.reference.iter().position(|&r| r == p);
        for axis in 0..fixed.unwrap_or(d).min(d) {
            column[axis] = Some(count);
            count += 1;
        }
    }
    assert_eq!(count, problem.distances.len(), "as many as equations");
    let sign = |solution: &Solution| {
        let mut jacobian = DMatrix::<f64>::zeros(count, count);
        for (e, distance) in problem.distances.iter().enumerate() {
            let [p, q] = distance.points;
            for axis in 0..d {
                let away = solution.points[p][axis].mid() - solution.points[q][axis].mid();
                for (end, away) in [(p, away), (q, -away)] {
                    if let Some(k) = column[end][axis] {
                        jacobian[(e, k)] = away;
                    }
                }
            }
        }
        let factors = jacobian.full_piv_lu();
        let pivots: Vec<f64> = factors.u().diagonal().iter().map(|u| u.abs()).collect();
        let largest = pivots.iter().copied().fold(0.0, f64::max);
        let safe = pivots.iter().all(|&u| u > 1e-9 * largest);
        safe.then(|| factors.determinant() > 0.0)
    };
    solutions.iter().map(sign).collect()
}

/// A closed curve crosses t = 1 upwards and downwards in turn, as often the one as the other.
fn crossings_alternate(rising: &[bool]) -> Result<(), String> {
    let ups = rising.iter().filter(|&&up| up).count();
    let in_turn = rising.windows(2).all(|pair| pair[0] != pair[1]);
    if in_turn && 2 * ups == rising.len() {
        Ok(())
    } else {
        Err(format!("t = 1 is crossed in these directions: {rising:?}"))
    }
}

fn agree(problem: &Problem, step: f64, tally: &Tally) -> Result<(), String> {
    let Some(first) = closed(problem, Options::certified()) else {
        return Ok(());
    };
    check(problem, &first.solutions)?;
    match signs(problem, &first.solutions) {
        Some(rising) => {
            crossings_alternate(&rising)?;
            tally.crossings.set(tally.crossings.get() + rising.len());
        }
        None if first.solutions.len().is_multiple_of(2) => {}
        None => return Err("t = 1 is crossed more often one way than the other".to_owned()),
    }
    for (what, other, options, view) in others(problem, step) {
        if let Some(outcome) = closed(&other, options) {
            matching(&first.solutions, &view, &outcome.solutions)
                .map_err(|e| format!("{what}: {e}"))?;
            tally.compared.set(tally.compared.get() + 1);
        }
    }
    if other_reference(problem, &first)? {
        tally.compared.set(tally.compared.get() + 1);
    }
    Ok(())
}

#[derive(Debug, Default)]
struct Tally {
    /// Runs compared with another.
    compared: Cell<usize>,
    /// Crossings of t = 1 of which the direction was found.
    crossings: Cell<usize>,
}

fn try_all(strategy: impl Strategy<Value = Recipe>, cases: u32, rng: Option<TestRng>) {
    let tally = Tally::default();
    let config = Config {
        cases,
        failure_persistence: None,
        ..Config::default()
    };
    let mut runner = match rng {
        Some(rng) => TestRunner::new_with_rng(config, rng),
        None => TestRunner::new(config),
    };
    let result = runner.run(&(strategy, 0.01f64..0.5), |(recipe, step)| {
        let problem = recipe
            .build()
            .map_err(|e| TestCaseError::reject(e.to_string()))?;
        agree(&problem, step, &tally).map_err(TestCaseError::fail)
    });
    match result {
        Ok(()) => {}
        Err(TestError::Fail(reason, (recipe, step))) => {
            let text = recipe
                .build()
                .map_or_else(|e| e.to_string(), |p| p.to_toml());
            panic!("{reason}, step {step}\n\n{text}");
        }
        Err(error) => panic!("{error}"),
    }
    println!("{tally:?} for {cases} problems");
    let cases = cases as usize;
    assert!(tally.compared.get() > 5 * cases, "{tally:?}");
    // Many paths turn back before t = 1.
    assert!(4 * tally.crossings.get() > cases, "{tally:?}");
}

#[test]
fn crossings_of_shipped_problems_alternate() {
    for (name, count) in SHORT {
        let problem = shipped(name);
        for options in [Options::certified(), Options::certified().reversed()] {
            let outcome = closed(&problem, options).expect(name);
            let rising = signs(&problem, &outcome.solutions).expect("regular solutions");
            assert_eq!(rising.len(), count, "{name}");
            crossings_alternate(&rising).unwrap_or_else(|e| panic!("{name}: {e}"));
            // With any of them lost it would not hold.
            for lost in 0..count {
                let mut rest = rising.clone();
                rest.remove(lost);
                assert!(crossings_alternate(&rest).is_err());
            }
        }
    }
}

#[test]
fn answers_in_the_plane_depend_on_the_path_alone() {
    try_all(recipe(2, 3..=10), 120, Some(same_each_time()));
}

#[test]
fn answers_in_space_depend_on_the_path_alone() {
    try_all(recipe(3, 4..=10), 120, Some(same_each_time()));
}

#[test]
#[ignore = "takes long, and tries other problems each time"]
fn many_answers_in_the_plane() {
    try_all(recipe(2, 3..=10), 3000, None);
}

#[test]
#[ignore = "takes long, and tries other problems each time"]
fn many_answers_in_space() {
    try_all(recipe(3, 4..=10), 2000, None);
}
