//! A certified run's answer is a property of the path: it does not depend on how the path is
//! followed or written down. Random problems to ten points, shrunk where one fails.

mod common;

use common::boxes::{View, check, matching};
use common::moves::{mirrored, moved, ratio, relabelled, scaled};
use common::random::{Recipe, recipe, same_each_time};
use krawl::problem::Problem;
use krawl::track::{self, Control, Options, Outcome, Space, Status};
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

fn agree(problem: &Problem, step: f64, compared: &Cell<usize>) -> Result<(), String> {
    let Some(first) = closed(problem, Options::certified()) else {
        return Ok(());
    };
    check(problem, &first.solutions)?;
    if !first.solutions.len().is_multiple_of(2) {
        return Err("t = 1 is crossed more often one way than the other".to_owned());
    }
    for (what, other, options, view) in others(problem, step) {
        if let Some(outcome) = closed(&other, options) {
            matching(&first.solutions, &view, &outcome.solutions)
                .map_err(|e| format!("{what}: {e}"))?;
            compared.set(compared.get() + 1);
        }
    }
    if other_reference(problem, &first)? {
        compared.set(compared.get() + 1);
    }
    Ok(())
}

fn try_all(strategy: impl Strategy<Value = Recipe>, cases: u32, rng: Option<TestRng>) {
    let compared = Cell::new(0);
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
        agree(&problem, step, &compared).map_err(TestCaseError::fail)
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
    println!("{} runs compared for {cases} problems", compared.get());
    assert!(compared.get() > 5 * cases as usize, "{}", compared.get());
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
