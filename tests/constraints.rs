//! Shipped problems with other constraints than distances: what their paths provably hold.

use krawl::problem::Problem;
use krawl::track::{Control, Options, Outcome, Space, Status, solve};

fn shipped(name: &str) -> Problem {
    Problem::read(format!("problems/constraints/{name}.toml")).unwrap()
}

/// Certified and in floats, in both spaces.
fn ways() -> [Options; 4] {
    [
        Options::certified(),
        Options {
            space: Space::Reduced,
            ..Options::certified()
        },
        Options::float(Space::Full),
        Options::float(Space::Reduced),
    ]
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
    for options in ways() {
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
        for options in ways() {
            let outcome = run(&problem, &options);
            assert_eq!(outcome.status, Status::Closed, "{name}");
            assert_eq!(outcome.solutions.len(), 4, "{name}");
        }
    }
}

/// The paper's preset has distances only, and refuses; it never solves without the other constraints.
#[test]
fn what_has_distances_only_refuses() {
    let problem = shipped("pentahedron");
    for space in [Space::Full, Space::Reduced] {
        let refused = solve(&problem, &Options::paper(space), &mut Control::default());
        assert!(refused.is_err());
    }
}

/// Certified runs in the reduced space find the full space's solutions, in the same order and with the same
/// classes, and end where those end.
#[test]
fn both_spaces_agree() {
    let mut runs = 0;
    for folder in ["constraints", "mechanisms"] {
        for file in std::fs::read_dir(format!("problems/{folder}")).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_none_or(|e| e != "toml") {
                continue;
            }
            let problem = Problem::read(&path).unwrap();
            for reverse in [false, true] {
                let [full, reduced] = [Space::Full, Space::Reduced].map(|space| {
                    let options = Options {
                        space,
                        reverse,
                        ..Options::certified()
                    };
                    run(&problem, &options)
                });
                agree(&full, &reduced).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
                runs += 1;
            }
        }
    }
    assert!(runs >= 12);
}

fn agree(full: &Outcome, reduced: &Outcome) -> Result<(), String> {
    match (&full.status, &reduced.status) {
        (Status::Closed, Status::Closed) => {}
        (Status::Open(a), Status::Open(b)) => {
            if a.each_ref().map(|end| end.kind) != b.each_ref().map(|end| end.kind) {
                return Err("the ends differ".to_owned());
            }
        }
        // How far a run gets that does not prove all depends on the space.
        (Status::Stopped(_), _) => return Ok(()),
        (a, b) => return Err(format!("{a:?} and {b:?}")),
    }
    if full.solutions.len() != reduced.solutions.len() {
        return Err(format!(
            "{} and {} solutions",
            full.solutions.len(),
            reduced.solutions.len()
        ));
    }
    for (k, (a, b)) in full.solutions.iter().zip(&reduced.solutions).enumerate() {
        let mut pairs = a.points.iter().flatten().zip(b.points.iter().flatten());
        if a.class != b.class || pairs.any(|(a, b)| a.disjoint(*b)) {
            return Err(format!("solution {k} differs"));
        }
    }
    Ok(())
}
