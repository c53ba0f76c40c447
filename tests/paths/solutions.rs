//! The shipped problems: what must come out, whichever way they are followed and written down.

use crate::common::boxes::{View, check, float_matching, holds, matching};
use crate::common::exact::{middle, ranges, root_near};
use crate::common::moves::{mirrored, moved, ratio, relabelled, scaled, squared};
use crate::common::random::Dice;
use crate::common::{FLOAT_SPACES, SHORT, arguments, closed, shipped, solve, ways};
use assert_cmd::Command;
use krawl::interval::hull;
use krawl::problem::Problem;
use krawl::track::{Options, Place, Solution, Status};
use serde_json::Value;

/// The proved number of solutions on the path of the icosahedron as its data are printed. The
/// published one, observed in floats, is 32 (RR 8705, table 2).
const ICOSAHEDRON: usize = 284;

fn classes(solutions: &[Solution]) -> usize {
    let mut classes: Vec<usize> = solutions.iter().map(|s| s.class).collect();
    classes.sort_unstable();
    classes.dedup();
    classes.len()
}

#[test]
fn counts_are_as_published() {
    for (name, count) in SHORT {
        for way in ways() {
            let outcome = solve(&shipped(name), &way);
            assert_eq!(outcome.status, Status::Closed, "{name}, {way:?}");
            assert_eq!(outcome.solutions.len(), count, "{name}, {way:?}");
            assert_eq!(classes(&outcome.solutions), count, "{name}, {way:?}");
            assert_eq!((outcome.mode, outcome.space), (way.mode, way.space));
            assert!(outcome.t_range.0 <= 0.0 && outcome.t_range.1 >= 1.0);
        }
    }
}

/// What the program writes as JSON, with the coordinates back in intervals.
fn through_the_program(name: &str, way: &Options) -> (Value, Vec<Solution>) {
    let run = Command::new(env!("CARGO_BIN_EXE_krawl"))
        .args(["solve", &format!("problems/{name}.toml"), "--json", "-"])
        .args(arguments(way))
        .assert()
        .code(0);
    let json: Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    let problem = shipped(name);
    let interval = |x: &Value| hull(x[0].as_f64().unwrap(), x[1].as_f64().unwrap());
    let solutions = json["solutions"].as_array().unwrap().iter();
    let solutions = solutions.map(|solution| Solution {
        points: problem
            .points
            .iter()
            .map(|p| {
                let place = solution["points"][&p.name].as_array().unwrap();
                assert_eq!(place.len(), problem.dimension);
                let zero = hull(0.0, 0.0);
                std::array::from_fn(|k| place.get(k).map_or(zero, interval))
            })
            .collect(),
        objects: Vec::new(),
        auxiliary: Vec::new(),
        class: solution["class"].as_u64().unwrap() as usize,
        width: solution["width"].as_f64().unwrap(),
        place: solution["arc"].as_f64().map(|arc| Place {
            arc,
            rising: solution["rising"].as_bool().unwrap(),
            folds: solution["folds"].as_u64().map(|n| n as usize),
        }),
        mirror_of: solution["mirror_of"].as_u64().map(|k| k as usize),
        is_degenerate: false,
    });
    let solutions = solutions.collect();
    (json, solutions)
}

#[test]
fn the_program_and_the_library_agree() {
    for (name, count) in SHORT {
        for way in ways() {
            let (json, written) = through_the_program(name, &way);
            assert_eq!(json["problem"], name);
            assert_eq!(json["status"], "closed");
            assert_eq!(json["reason"], Value::Null);
            assert_eq!(written.len(), count);
            let outcome = solve(&shipped(name), &way);
            assert_eq!(written, outcome.solutions, "{name}, {way:?}");
            assert_eq!(json["steps"], outcome.steps);
            assert_eq!(json["t_range"][1], outcome.t_range.1);
        }
    }
}

#[test]
fn boxes_pass_exact_checks() {
    for (name, _) in SHORT {
        let problem = shipped(name);
        let solutions = closed(&problem, &Options::certified());
        assert_eq!(check(&problem, &solutions), Ok(()), "{name}");
        for solution in &solutions {
            assert!(solution.width <= 1e-12, "{name}: {:e}", solution.width);
            assert!(
                solution.width >= relative_width(solution),
                "{name}: the width is understated"
            );
        }
    }
}

/// The widest coordinate's width over the largest coordinate.
fn relative_width(solution: &Solution) -> f64 {
    let coordinates = || solution.points.iter().flatten();
    // Rounded down: `wid` rounds up.
    let widest = coordinates().fold(0.0f64, |a, x| a.max(x.wid().next_down()));
    widest / coordinates().fold(0.0f64, |a, x| a.max(x.mag())) * (1.0 - 1e-15)
}

#[test]
fn the_icosahedron_closes_with_more_than_published() {
    let problem = shipped("icosahedron");
    let outcome = solve(&problem, &Options::certified());
    assert_eq!(outcome.status, Status::Closed);
    assert_eq!(outcome.solutions.len(), ICOSAHEDRON);
    assert_eq!(classes(&outcome.solutions), ICOSAHEDRON);
    assert!(outcome.solutions.iter().all(|s| s.width <= 1e-12));
}

#[test]
#[ignore = "takes long: 284 boxes in exact arithmetic, and four ways round the longest path"]
fn the_icosahedron_s_boxes_pass_exact_checks() {
    let problem = shipped("icosahedron");
    let certified = closed(&problem, &Options::certified());
    assert_eq!(check(&problem, &certified), Ok(()));
    let view = View::same(&problem);
    for options in [
        Options::certified().reversed(),
        Options::certified().with_max_step(0.5),
    ] {
        let other = closed(&problem, &options);
        assert!(matching(&certified, &view, &other).is_ok(), "{options:?}");
    }
    for space in FLOAT_SPACES {
        let float = closed(&problem, &Options::float(space));
        assert!(float_matching(&problem, &certified, &float).is_ok());
    }
}

#[test]
fn the_step_does_not_matter() {
    for (name, _) in SHORT {
        let problem = shipped(name);
        let solutions = closed(&problem, &Options::certified());
        let size = solve(&problem, &Options::certified()).length;
        let in_order: Vec<usize> = (0..solutions.len()).collect();
        for fraction in [200.0, 1500.0] {
            let small = Options::certified().with_max_step(size / fraction);
            let outcome = solve(&problem, &small);
            assert_eq!(outcome.status, Status::Closed, "{name}");
            assert!(
                outcome.steps as f64 >= fraction,
                "{name}: the step is bounded"
            );
            let pairs = matching(&solutions, &View::same(&problem), &outcome.solutions);
            assert_eq!(pairs, Ok(in_order.clone()), "{name}");
        }
    }
}

#[test]
fn reversal_gives_the_same_solutions_in_reverse() {
    for (name, _) in SHORT {
        let problem = shipped(name);
        let solutions = closed(&problem, &Options::certified());
        let reversed: Vec<usize> = (0..solutions.len()).rev().collect();
        let back = closed(&problem, &Options::certified().reversed());
        let pairs = matching(&solutions, &View::same(&problem), &back);
        assert_eq!(pairs, Ok(reversed.clone()), "{name}");
        for space in FLOAT_SPACES {
            let back = closed(&problem, &Options::float(space).reversed());
            let pairs = float_matching(&problem, &solutions, &back);
            assert_eq!(pairs, Ok(reversed.clone()), "{name}, {space:?}");
        }
    }
}

#[test]
fn float_solutions_are_those_in_the_boxes() {
    for (name, _) in SHORT {
        let problem = shipped(name);
        let solutions = closed(&problem, &Options::certified());
        let in_order: Vec<usize> = (0..solutions.len()).collect();
        for space in FLOAT_SPACES {
            let length = solve(&problem, &Options::certified()).length;
            let options = Options::float(space);
            for options in [options.clone(), options.with_max_step(length / 1000.0)] {
                let float = closed(&problem, &options);
                let points = float.iter().flat_map(|s| s.points.iter().flatten());
                assert!(points.clone().all(|x| x.is_singleton()));
                let pairs = float_matching(&problem, &solutions, &float);
                assert_eq!(pairs, Ok(in_order.clone()), "{name}, {options:?}");
            }
        }
    }
}

/// Follows the path of a problem that was written down differently, and compares.
fn compare(name: &str, problem: &Problem, other: &Problem, view: &View) {
    assert_eq!(other.check(), Ok(()));
    let solutions = closed(problem, &Options::certified());
    let others = closed(other, &Options::certified());
    let in_order: Vec<usize> = (0..solutions.len()).collect();
    assert_eq!(matching(&solutions, view, &others), Ok(in_order), "{name}");
    assert_eq!(check(other, &others), Ok(()), "{name}");
    for space in FLOAT_SPACES {
        let float = closed(other, &Options::float(space));
        let pairs = float_matching(other, &others, &float);
        assert!(pairs.is_ok(), "{name}, {space:?}: {pairs:?}");
    }
}

#[test]
fn where_the_sketch_lies_does_not_matter() {
    for (name, _) in SHORT {
        let problem = shipped(name);
        compare(name, &problem, &moved(&problem), &View::same(&problem));
    }
}

#[test]
fn the_mirror_image_of_the_sketch_leads_to_mirror_images() {
    for (name, _) in SHORT {
        let problem = shipped(name);
        let mut view = View::same(&problem);
        // In the gauge it is the last axis that a mirror image turns round.
        view.factors[problem.dimension - 1] = ratio(-1, 1);
        compare(name, &problem, &mirrored(&problem), &view);
    }
}

#[test]
fn names_and_order_do_not_matter() {
    for (name, _) in SHORT {
        let problem = shipped(name);
        let (other, point) = relabelled(&problem);
        let view = View {
            point,
            ..View::same(&problem)
        };
        compare(name, &problem, &other, &view);
    }
}

#[test]
fn the_unit_of_length_does_not_matter() {
    for (name, _) in SHORT {
        let problem = shipped(name);
        for factor in [ratio(1, 1000), ratio(1000, 1)] {
            let factors = [factor.clone(), factor.clone(), factor.clone()];
            let view = View {
                factors,
                ..View::same(&problem)
            };
            compare(name, &problem, &scaled(&problem, &factor), &view);
        }
    }
}

#[test]
fn lengths_and_their_squares_mean_the_same() {
    for (name, _) in SHORT {
        let problem = shipped(name);
        // Through the text of a file, as users write them.
        let text = squared(&problem).to_toml();
        assert!(!text.contains("\ndistances"));
        let other = Problem::parse(&text, "squared.toml").unwrap();
        compare(name, &problem, &other, &View::same(&problem));
    }
}

/// Whichever gauge is chosen, the same figures are found.
#[test]
fn the_reference_does_not_matter() {
    let problem = shipped("prism");
    let solutions = closed(&problem, &Options::certified());
    for reference in [[1, 0], [3, 4], [2, 5]] {
        let mut other = problem.clone();
        other.homotopy.reference = reference.to_vec();
        let found = closed(&other, &Options::certified());
        assert_eq!(check(&other, &found), Ok(()));
        assert_eq!(found.len(), solutions.len());
        for (a, b) in solutions.iter().zip(&found) {
            let (a, b) = (middle(a), middle(b));
            for p in 0..6 {
                for q in 0..p {
                    let length = |f: &[[f64; 3]]| (f[p][0] - f[q][0]).hypot(f[p][1] - f[q][1]);
                    // Boxes are at most 1e-12 wide, relative to figures of size 3.
                    assert!((length(&a) - length(&b)).abs() < 1e-11);
                }
            }
        }
    }
}

/// The paths of the prism and of K3,3 carry all solutions that their graphs can have: what
/// Newton's method finds from anywhere is in a box, up to reflection.
#[test]
fn newton_s_method_from_random_figures_finds_nothing_else() {
    for name in ["prism", "k33"] {
        let problem = shipped(name);
        let solutions = closed(&problem, &Options::certified());
        let boxes: Vec<_> = solutions.iter().map(ranges).collect();
        let [first, second] = problem.homotopy.reference[..] else {
            panic!()
        };
        let mut met = vec![0; boxes.len()];
        let mut dice = Dice(1);
        let mut random = || 8.0 * dice.uniform() - 4.0;
        for _ in 0..600 {
            let mut start: Vec<[f64; 3]> = (0..6).map(|_| [random(), random(), 0.0]).collect();
            start[first] = [0.0; 3];
            start[second][1] = 0.0;
            let Some(root) = root_near(&problem, &start) else {
                continue;
            };
            let place = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
                .into_iter()
                .find_map(|(x, y)| {
                    let turned: Vec<_> = root
                        .iter()
                        .map(|p| [&p[0] * ratio(x, 1), &p[1] * ratio(y, 1), p[2].clone()])
                        .collect();
                    boxes.iter().position(|b| holds(b, &turned))
                });
            met[place.unwrap_or_else(|| panic!("{name}: {root:?} is in no box"))] += 1;
        }
        assert!(met.iter().all(|&times| times > 0), "{name}: {met:?}");
    }
}
