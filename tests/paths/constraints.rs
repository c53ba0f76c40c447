//! Shipped problems with other constraints than distances: what their paths provably hold.

use crate::common::solve;
use krawl::problem::Problem;
use krawl::track::{self, Control, EndKind, Options, Outcome, PathEnd, Space, Status};

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
        let outcome = solve(&problem, &options);
        assert_eq!(outcome.status, Status::Closed);
        let (solutions, classes, flat) = counts(&outcome);
        assert_eq!((solutions, classes, flat), (22, 9, 6));
    }
    // What is not flat is not nearly so.
    let outcome = solve(&problem, &Options::certified());
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
            let outcome = solve(&problem, &options);
            assert_eq!(outcome.status, Status::Closed, "{name}");
            assert_eq!(outcome.solutions.len(), 4, "{name}");
        }
    }
}

/// The ends of a path that does not close, either way round the same.
fn ends(problem: &Problem, solutions: usize) -> [PathEnd; 2] {
    let options = Options::certified();
    let [one, back] = [options.clone(), options.reversed()].map(|options| {
        let outcome = solve(problem, &options);
        assert_eq!(outcome.solutions.len(), solutions, "{}", problem.name);
        match outcome.status {
            Status::Open(ends) => *ends,
            status => panic!("{}: {status:?}", problem.name),
        }
    });
    for (end, same) in one.iter().zip(back.iter().rev()) {
        assert_eq!(end.kind, same.kind);
        assert!((end.t.0 - same.t.0).abs() < 1e-4);
    }
    one
}

/// The paper's first valuation closes, with four solutions.
#[test]
fn angles_and_faces_close() {
    let problem = shipped("6p7d3a2c-closed");
    for options in [Options::certified(), Options::float(Space::Full)] {
        let outcome = solve(&problem, &options);
        assert_eq!(outcome.status, Status::Closed);
        assert_eq!(outcome.solutions.len(), 4);
    }
}

/// The second goes to infinity where the cosine, linear in t, becomes 1.
#[test]
fn angles_and_faces_go_to_infinity() {
    let at = 0.4 / (23f64.to_radians().cos() - 0.6);
    for end in ends(&shipped("6p7d3a2c-infinite"), 2) {
        assert_eq!(end.kind, EndKind::Infinite);
        let away = end.away.expect("a point goes away");
        assert!(away.point == 3 && away.distance.0 > 100.0);
        assert!(away.distance.0 <= away.distance.1 && away.distance.1 < 1.001 * away.distance.0);
        let [x, y, z] = end.points[3];
        let distance = (x * x + y * y + z * z).sqrt();
        assert!((distance / away.distance.0 - 1.0).abs() < 0.1);
        assert!(end.t.0 <= end.t.1 && (end.t.1 - at).abs() < 1e-3, "{end:?}");
        let legs = "the legs of the angle at p3 between p2 and p0 become parallel";
        assert!(end.reason.contains(legs), "{}", end.reason);
    }
}

/// The third ends where p3 falls on p2: the angle at p0 has then become that of p1, p0, p2.
#[test]
fn angles_and_faces_lose_a_leg() {
    for end in ends(&shipped("6p7d3a2c-undefined"), 0) {
        assert_eq!(end.kind, EndKind::Undefined);
        assert!(end.reason.contains("the length of p3-p2"), "{}", end.reason);
        assert!((end.t.0 - 0.90325).abs() < 1e-4, "{end:?}");
        let [p2, p3] = [2, 3].map(|p: usize| end.points[p]);
        assert!((0..3).all(|k| (p2[k] - p3[k]).abs() < 1e-2));
    }
}

/// The paper's preset has distances only, and refuses; it never solves without the other constraints.
#[test]
fn what_has_distances_only_refuses() {
    let problem = shipped("pentahedron");
    for space in [Space::Full, Space::Reduced] {
        let refused = track::solve(&problem, &Options::paper(space), &mut Control::default());
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
                    solve(&problem, &options)
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
