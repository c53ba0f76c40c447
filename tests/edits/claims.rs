//! What cannot be proved is not claimed: impossible targets, singular sketches, problems with
//! something missing, interrupted runs.

use crate::common::boxes::check;
use crate::common::{SHORT, shipped, solve, ways};
use assert_cmd::Command;
use krawl::problem::{Decimal, Problem, Target};
use krawl::track::{self, Control, Mode, Options, Outcome, Progress, Status};
use std::fs;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

fn decimal(text: &str) -> Decimal {
    text.parse().unwrap()
}

/// A run may close or stop; what it says about solutions must be true either way, and a reason
/// must be given where it stopped.
fn check_run(problem: &Problem, outcome: &Outcome) {
    if let Status::Stopped(reason) = &outcome.status {
        assert!(!reason.trim().is_empty(), "{}", problem.name);
    }
    if outcome.mode == Mode::Certified {
        assert_eq!(check(problem, &outcome.solutions), Ok(()));
    }
}

/// With one length far too long for the triangles it is in no figure meets the dimensions.
#[test]
fn where_there_is_no_figure_none_is_found() {
    for (name, _) in SHORT {
        let problem = shipped(name);
        for index in 0..problem.distances.len() {
            let mut impossible = problem.clone();
            impossible.distances[index].target = Target::Length(decimal("60"));
            for way in ways() {
                let way = Options {
                    max_steps: 20_000,
                    ..way
                };
                let outcome = solve(&impossible, &way);
                check_run(&impossible, &outcome);
                assert_eq!(outcome.solutions, [], "{name}, {index}, {way:?}");
            }
        }
    }
}

/// A triangle whose sides 1, 1, 5 violate the triangle inequality.
#[test]
fn an_impossible_triangle_closes_without_solutions() {
    let triangle = Problem::build("impossible", 2)
        .point("a", ["0", "0"])
        .point("b", ["1", "0"])
        .point("c", ["0.4", "1.1"])
        .distance("a", "b", "1")
        .distance("b", "c", "1")
        .distance("c", "a", "5")
        .finish()
        .unwrap();
    for way in ways() {
        let outcome = solve(&triangle, &way);
        assert_eq!(outcome.status, Status::Closed, "{way:?}");
        assert_eq!(outcome.solutions, []);
        assert!(outcome.t_range.1 < 1.0);
    }
}

/// The same with sides 1, 1, 2, and all lengths linear in t: the one figure is flat, and the path
/// turns back there, exactly at t = 1. In 53 bits that cannot be told from two solutions, or none.
#[test]
fn a_fold_at_the_target_is_not_claimed() {
    let triangle = Problem::build("flat", 2)
        .point("a", ["0", "0"])
        .point("b", ["1", "0"])
        .point("c", ["0.4", "1.1"])
        .distance("a", "b", "1")
        .distance("b", "c", "1")
        .distance("c", "a", "2")
        .bend_coefficient("0")
        .finish()
        .unwrap();
    for options in [Options::certified(), Options::certified().reversed()] {
        let outcome = solve(&triangle, &options);
        assert!(
            matches!(&outcome.status, Status::Stopped(reason) if reason.contains("t = 1")),
            "{:?}",
            outcome.status
        );
        assert_eq!(outcome.solutions, []);
    }
}

/// A parallelogram's bars between congruent triangles: the sketch can move without any length
/// changing, so that H⁻¹(0) is no curve there.
#[test]
fn a_sketch_that_moves_is_not_followed() {
    let mut problem = shipped("prism");
    for (point, place) in problem.points.iter_mut().zip([
        ["0", "0"],
        ["1", "0"],
        ["0.3", "0.8"],
        ["0.4", "2"],
        ["1.4", "2"],
        ["0.7", "2.8"],
    ]) {
        let [x, y] = place.map(decimal);
        point.sketch = [x, y, Decimal::from(0)];
    }
    assert_eq!(problem.check(), Ok(()));
    assert_never_closed(&problem);
}

/// All points on one line: the coordinates across it are stationary in every distance.
#[test]
fn a_collinear_sketch_is_not_followed() {
    for name in ["prism", "k33", "dodecagon"] {
        let mut problem = shipped(name);
        for (k, point) in problem.points.iter_mut().enumerate() {
            let x = i32::try_from(k * k + 2 * k).unwrap();
            point.sketch = [x, 2 * x, 0].map(Decimal::from);
        }
        assert_eq!(problem.check(), Ok(()));
        assert_never_closed(&problem);
    }
}

/// All points in one plane, in space.
#[test]
fn a_flat_sketch_is_not_followed() {
    for name in ["octahedron", "disulfide"] {
        let mut problem = shipped(name);
        for point in &mut problem.points {
            point.sketch[2] = Decimal::from(0);
        }
        assert_eq!(problem.check(), Ok(()));
        assert_never_closed(&problem);
    }
}

fn assert_never_closed(problem: &Problem) {
    for options in [Options::certified(), Options::certified().reversed()] {
        let outcome = solve(problem, &options);
        check_run(problem, &outcome);
        assert_ne!(outcome.status, Status::Closed, "{}", problem.name);
    }
}

/// A regular figure to be led to another regular one: its path runs through figures of the same
/// symmetry, where branches may meet.
#[test]
fn what_is_said_about_symmetric_sketches_is_true() {
    let octahedron = [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
        [0, 0, -1],
        [0, -1, 0],
        [-1, 0, 0],
    ];
    let mut problem = shipped("octahedron");
    // Opposite points are those not joined: 1-4, 2-5, 3-6.
    for (k, point) in problem.points.iter_mut().enumerate() {
        let place = octahedron[[0, 1, 2, 5, 4, 3][k]];
        point.sketch = place.map(Decimal::from);
    }
    for length in ["1.2", "1.41", "2"] {
        for distance in &mut problem.distances {
            distance.target = Target::Length(decimal(length));
        }
        assert_eq!(problem.check(), Ok(()));
        for way in ways() {
            let way = Options {
                max_steps: 20_000,
                ..way
            };
            check_run(&problem, &solve(&problem, &way));
        }
    }
}

/// Each distance left out in turn, and each written twice: exit code 2, no results.
#[test]
fn mutilated_problems_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (name, _) in SHORT {
        let problem = shipped(name);
        for index in 0..problem.distances.len() {
            let mut less = problem.clone();
            less.distances.remove(index);
            less.homotopy.bend = 0;
            assert!(less.check().is_err(), "{name}, {index}");
        }
        let text = fs::read_to_string(format!("problems/{name}.toml")).unwrap();
        let row = text.lines().find(|line| line.starts_with("    [")).unwrap();
        for (what, mutilated) in [
            ("less", text.replacen(row, "", 1)),
            ("more", text.replacen(row, &format!("{row}\n{row}"), 1)),
            ("cut", text[..text.len() / 2].to_owned()),
        ] {
            let file = folder.path().join(format!("{name}-{what}.toml"));
            let json = folder.path().join("out.json");
            fs::write(&file, mutilated).unwrap();
            let run = Command::new(env!("CARGO_BIN_EXE_krawl"))
                .arg("solve")
                .arg(&file)
                .arg("--json")
                .arg(&json)
                .assert()
                .code(2);
            assert!(run.get_output().stdout.is_empty());
            assert!(!json.exists());
        }
    }
}

/// Wherever a run is cut off it says so, and what it had found by then is true.
#[test]
fn runs_that_are_cut_off_say_so() {
    let problem = shipped("disulfide");
    for way in ways() {
        let all = solve(&problem, &way);
        let mut most = 0;
        for max_steps in [1, 10, all.steps / 2, all.steps - 1] {
            let outcome = solve(
                &problem,
                &Options {
                    max_steps,
                    ..way.clone()
                },
            );
            assert!(
                matches!(&outcome.status, Status::Stopped(reason) if !reason.is_empty()),
                "{way:?}, {max_steps} of {}: {:?}",
                all.steps,
                outcome.status
            );
            assert!(outcome.steps <= max_steps);
            assert!(outcome.solutions.len() >= most);
            most = outcome.solutions.len();
            check_run(&problem, &outcome);
        }
        assert!(most > 0);
    }
}

#[test]
fn cancelled_runs_stop() {
    let problem = shipped("icosahedron-c1");
    for way in ways() {
        let cancel = AtomicBool::new(false);
        let mut last = None;
        let mut after = |now: Progress| {
            last = Some(now);
            cancel.store(now.steps >= 64, Ordering::Relaxed);
        };
        let mut control = Control {
            cancel: Some(&cancel),
            progress: Some(&mut after),
            pause: Some(Duration::ZERO),
            ..Control::default()
        };
        let outcome = track::solve(&problem, &way, &mut control).unwrap();
        assert!(
            matches!(&outcome.status, Status::Stopped(reason) if reason.contains("interrupted")),
            "{way:?}: {:?}",
            outcome.status
        );
        assert_eq!(last.unwrap().steps, outcome.steps);
        check_run(&problem, &outcome);
    }
}

/// Three points in space: on the path the triangle turns over, and what was above the x axis is
/// below it. The mirror image is no other figure.
#[test]
fn a_triangle_that_turns_over_is_the_same_triangle() {
    let problem = crate::common::turning_triangle();
    let outcome = solve(&problem, &Options::certified());
    assert_eq!(outcome.status, Status::Closed);
    let classes: Vec<usize> = outcome.solutions.iter().map(|s| s.class).collect();
    assert_eq!(classes, [0, 0]);
    // The same figure moved, not its mirror image.
    assert!(outcome.solutions.iter().all(|s| s.mirror_of.is_none()));
}
