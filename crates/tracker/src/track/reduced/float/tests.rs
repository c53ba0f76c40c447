use super::track;
use crate::places::Each as _;
use crate::plan::testing::{rigid, shipped};
use crate::problem::Problem;
use crate::system::Homotopy;
use crate::track::{Control, Options, Outcome, Preset, Space, Status};
use proptest::prelude::*;
use std::sync::atomic::AtomicBool;

const PUBLISHED: [(&str, usize); 5] = [
    ("octahedron", 4),
    ("disulfide", 8),
    ("dodecagon", 2),
    ("icosahedron-c1", 8),
    ("icosahedron", 284),
];

fn options() -> Options {
    Options::float(Space::Reduced)
}

fn run_with(problem: &Problem, options: &Options, control: &mut Control) -> Outcome {
    let homotopy = match options.preset {
        Preset::Default => Homotopy::new(problem).unwrap(),
        Preset::Paper => Homotopy::with_unit(problem, 1.0).unwrap(),
    };
    track(&homotopy, options, control)
}

fn run(problem: &Problem, options: &Options) -> Outcome {
    run_with(problem, options, &mut Control::default())
}

/// The solutions as places, in an order that does not depend on the way round.
fn figures(outcome: &Outcome) -> Vec<Vec<f64>> {
    let mut figures: Vec<Vec<f64>> = outcome
        .solutions
        .iter()
        .map(|s| s.points.iter().flatten().map(|x| x.mid()).collect())
        .collect();
    figures.sort_by(|a, b| a.partial_cmp(b).unwrap());
    figures
}

/// Whether every figure of `a` is among those of `b`.
fn contained(a: &[Vec<f64>], b: &[Vec<f64>]) -> bool {
    let near = |x: &[f64], y: &[f64]| x.iter().zip(y).all(|(x, y)| (x - y).abs() < 1e-8);
    a.iter().all(|x| b.iter().any(|y| near(x, y)))
}

fn same_set(a: &Outcome, b: &Outcome) -> bool {
    let (a, b) = (figures(a), figures(b));
    a.len() == b.len() && contained(&a, &b) && contained(&b, &a)
}

/// The largest difference of a distance from its target.
fn off_target(problem: &Problem, outcome: &Outcome) -> f64 {
    let mut worst = 0.0f64;
    for solution in &outcome.solutions {
        for distance in &problem.distances {
            let [a, b] = distance.points.each(|p| solution.points[p]);
            let length = (0..3)
                .map(|k| (a[k].mid() - b[k].mid()).powi(2))
                .sum::<f64>()
                .sqrt();
            worst = worst.max((length - distance.target.to_f64()).abs());
        }
    }
    worst
}

#[test]
fn finds_what_is_on_the_path() {
    for (name, count) in PUBLISHED {
        let problem = shipped(name);
        let outcome = run(&problem, &options());
        assert_eq!(outcome.status, Status::Closed, "{name}");
        assert_eq!(outcome.solutions.len(), count, "{name}");
        // All different up to reflection.
        assert_eq!(
            outcome.solutions.iter().map(|s| s.class).max(),
            Some(count - 1),
            "{name}"
        );
        assert!(off_target(&problem, &outcome) < 1e-10, "{name}");
        let back = run(&problem, &options().reversed());
        assert!(
            back.status == Status::Closed && same_set(&outcome, &back),
            "{name} reversed"
        );
        assert!((outcome.length / back.length - 1.0).abs() < 1e-4, "{name}");
    }
}

#[test]
fn short_steps_find_the_same() {
    for (name, _) in &PUBLISHED[..4] {
        let problem = shipped(name);
        let outcome = run(&problem, &options());
        for longest in [0.1, 0.01] {
            let careful = run(&problem, &options().with_max_step(longest));
            assert!(
                careful.status == Status::Closed && same_set(&outcome, &careful),
                "{name} {longest}"
            );
        }
    }
}

#[test]
fn any_alpha_finds_the_same() {
    for (name, count) in &PUBLISHED[..4] {
        for alpha in [0.03, 0.2, 0.35] {
            let outcome = run(&shipped(name), &Options { alpha, ..options() });
            assert_eq!(
                (outcome.status, outcome.solutions.len()),
                (Status::Closed, *count),
                "{name} {alpha}"
            );
        }
    }
}

#[test]
fn stepping_as_in_the_paper_finds_the_same() {
    for (name, _) in &PUBLISHED[..4] {
        let problem = shipped(name);
        let outcome = run(&problem, &Options::paper(Space::Reduced));
        assert_eq!(outcome.status, Status::Closed, "{name}");
        assert!(same_set(&outcome, &run(&problem, &options())), "{name}");
    }
}

#[test]
fn stops_when_told_to() {
    let problem = shipped("icosahedron");
    let limited = run(
        &problem,
        &Options {
            max_steps: 3000,
            ..options()
        },
    );
    assert!(
        matches!(&limited.status, Status::Stopped(why) if why.contains("the limit of 3000 steps"))
    );
    assert!(limited.steps == 3000 && !limited.solutions.is_empty());

    let flag = AtomicBool::new(true);
    let mut control = Control {
        cancel: Some(&flag),
        ..Control::default()
    };
    let cancelled = run_with(&problem, &options(), &mut control);
    assert!(
        matches!(&cancelled.status, Status::Stopped(why) if why.starts_with("interrupted")),
        "{:?}",
        cancelled.status
    );
    assert_eq!(cancelled.steps, 1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn random_problems_of_the_plane(problem in rigid(2, 4..9)) {
        check(&problem)?;
    }

    #[test]
    fn random_problems_of_space(problem in rigid(3, 5..8)) {
        check(&problem)?;
    }
}

/// Both ways round give the same solutions wherever both runs close, and all meet the dimensions.
fn check(problem: &Problem) -> Result<(), TestCaseError> {
    let limited = Options {
        max_steps: 20_000,
        ..options()
    };
    let outcome = run(problem, &limited);
    prop_assert!(off_target(problem, &outcome) < 1e-9);
    let back = run(problem, &limited.clone().reversed());
    if outcome.status == Status::Closed && back.status == Status::Closed {
        prop_assert!(same_set(&outcome, &back));
    }
    Ok(())
}
