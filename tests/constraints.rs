//! Shipped problems with other constraints than distances: what their paths provably hold.

use krawl::problem::Problem;
use krawl::track::{Control, Options, Outcome, Space, Status, solve};

fn shipped(name: &str) -> Problem {
    Problem::read(format!("problems/constraints/{name}.toml")).unwrap()
}

fn run(problem: &Problem, options: &Options) -> Outcome {
    solve(problem, options, &mut Control::default()).unwrap()
}

/// Solutions, how many there are up to congruence and reflection, and how many of those are flat: all
/// heights over the plane of the reference are zero, as far as the boxes tell.
fn counts(outcome: &Outcome) -> (usize, usize, usize) {
    let mut flat = std::collections::BTreeMap::new();
    for solution in &outcome.solutions {
        let is_flat = solution.points.iter().all(|p| p[2].mag() < 1e-10);
        assert_eq!(*flat.entry(solution.class).or_insert(is_flat), is_flat);
    }
    let flats = flat.values().filter(|&&flat| flat).count();
    (outcome.solutions.len(), flat.len(), flats)
}

/// The paper's first path: 9 solutions up to reflection, 6 of them flat.
#[test]
fn pentahedron() {
    let problem = shipped("pentahedron");
    for options in [Options::certified(), Options::float(Space::Full)] {
        let outcome = run(&problem, &options);
        assert_eq!(outcome.status, Status::Closed);
        let (solutions, classes, flat) = counts(&outcome);
        assert_eq!((solutions, classes, flat), (22, 9, 6));
    }
    // What is not flat is not nearly so.
    let outcome = run(&problem, &Options::certified());
    for solution in &outcome.solutions {
        let height = solution
            .points
            .iter()
            .fold(0.0, |h: f64, p| h.max(p[2].mig()));
        assert!(height == 0.0 || height > 0.1, "{height:e}");
    }
}

/// Three points and three lines, a constraint between any two.
#[test]
fn points_and_lines() {
    for name in ["3p3l", "3p3l-orthogonal"] {
        let problem = shipped(name);
        for options in [Options::certified(), Options::float(Space::Full)] {
            let outcome = run(&problem, &options);
            assert_eq!(outcome.status, Status::Closed, "{name}");
            assert_eq!(outcome.solutions.len(), 4, "{name}");
        }
    }
}

/// A problem with constraints is refused by what has distances only, never solved without them.
#[test]
fn what_has_distances_only_refuses() {
    let problem = shipped("pentahedron");
    for options in [
        Options::float(Space::Reduced),
        Options::paper(Space::Full),
        Options {
            space: Space::Reduced,
            ..Options::certified()
        },
    ] {
        let refused = solve(&problem, &options, &mut Control::default());
        assert!(refused.is_err());
    }
}
