//! All real solutions: against what is published, against the path, against Newton's method from many
//! starts, and under changes that must not matter.

use crate::common::boxes::check;
use crate::common::moves::relabelled;
use crate::common::random::{recipe, same_each_time};
use crate::common::{shipped, solve};
use krawl::complete::{Complete, Options, Status, all};
use krawl::problem::{Problem, Target};
use krawl::track::{Options as PathOptions, Solution};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use std::cell::RefCell;
use std::time::Duration;

fn searched(problem: &Problem) -> Complete {
    all(problem, &Options::default()).unwrap()
}

/// The squared distances of all pairs of points, as bounds.
fn pairs(solution: &Solution) -> Vec<[f64; 2]> {
    let p = &solution.points;
    let mut out = Vec::new();
    for a in 0..p.len() {
        for b in 0..a {
            let s = (0..3).fold(krawl::interval::point(0.0), |sum, k| {
                sum + (p[a][k] - p[b][k]).sqr()
            });
            out.push([s.inf(), s.sup()]);
        }
    }
    out
}

/// Which solutions of the set are congruent to a figure given by the squared distances of its points, with a
/// tolerance for figures that are floats.
fn congruent(result: &Complete, pairs_of_one: &[[f64; 2]], tolerance: f64) -> Vec<usize> {
    let meets = |a: &[f64; 2], b: &[f64; 2]| {
        a[0] <= b[1] + tolerance * (1.0 + b[1]) && b[0] <= a[1] + tolerance * (1.0 + a[1])
    };
    (0..result.solutions.len())
        .filter(|&i| {
            let other = pairs(&result.solutions[i]);
            other.iter().zip(pairs_of_one).all(|(a, b)| meets(a, b))
        })
        .collect()
}

/// Every solution on the path is one of the set.
fn holds_the_path(problem: &Problem, result: &Complete) -> Result<usize, String> {
    let options = PathOptions {
        max_steps: 5000,
        ..PathOptions::certified()
    };
    let path = solve(problem, &options);
    for solution in &path.solutions {
        let found = congruent(result, &pairs(solution), 0.0);
        if found.len() != 1 {
            return Err(format!("a solution on the path is that of {found:?}"));
        }
    }
    Ok(path.solutions.len())
}

#[test]
fn shipped_problems_are_complete() {
    let counts = [
        ("octahedron", 4),
        ("disulfide", 18),
        ("dodecagon", 2),
        ("k33", 8),
        ("prism", 12),
    ];
    for (name, count) in counts {
        let problem = shipped(name);
        let result = searched(&problem);
        assert_eq!(
            (result.status, result.solutions.len()),
            (Status::Complete, count),
            "{name}"
        );
        assert_eq!(result.reference, problem.homotopy.reference);
        check(&problem, &result.solutions).unwrap();
        assert!(holds_the_path(&problem, &result).unwrap() > 0);
        assert!(result.undecided.is_empty() && result.solutions.iter().all(|s| s.width < 1e-10));
    }
}

/// Counts published with the instances (the file names the sources).
#[test]
fn published_counts_are_met() {
    let text = std::fs::read_to_string("tests/data/embeddings.json").unwrap();
    let instances: Vec<serde_json::Value> = serde_json::from_str(&text).unwrap();
    assert!(instances.len() >= 12);
    for instance in instances {
        let name = instance["name"].as_str().unwrap();
        let dimension = instance["dimension"].as_u64().unwrap() as usize;
        let points = instance["points"].as_u64().unwrap() as usize;
        let mut builder = Problem::build(name, dimension);
        for p in 1..=points {
            let at = |k: usize| format!("{:.3}", ((p * (7 + 5 * k)) as f64).sin() * 3.0);
            builder = builder.point(
                &format!("p{p}"),
                (0..dimension).map(|k| at(k).parse::<f64>().unwrap()),
            );
        }
        for edge in instance["edges"].as_array().unwrap() {
            let p = |k: usize| format!("p{}", edge[k].as_u64().unwrap());
            builder = builder.distance(&p(0), &p(1), edge[2].as_str().unwrap());
        }
        let problem = builder.finish().unwrap();
        let result = searched(&problem);
        let count = instance["solutions"].as_u64().unwrap() as usize;
        assert_eq!(
            (result.status, result.solutions.len()),
            (Status::Complete, count),
            "{name}"
        );
        check(&problem, &result.solutions).unwrap();
    }
}

/// Figures that Newton's method finds from random starts, in floats of its own.
fn newton(problem: &Problem, starts: usize, seed: u64) -> Vec<Vec<[f64; 3]>> {
    let (d, n, m) = (
        problem.dimension,
        problem.points.len(),
        problem.distances.len(),
    );
    let squares: Vec<f64> = problem
        .distances
        .iter()
        .map(|e| match &e.target {
            Target::Length(x) => x.to_f64().powi(2),
            Target::SquaredLength(x) => x.to_f64(),
        })
        .collect();
    let scale = squares.iter().map(|s| s.sqrt()).sum::<f64>() / m as f64;
    let mut state = seed | 1;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64 * 2.0 - 1.0
    };
    let mut out = Vec::new();
    for _ in 0..starts {
        let mut x: Vec<[f64; 3]> = (0..n)
            .map(|_| std::array::from_fn(|k| if k < d { 1.2 * scale * random() } else { 0.0 }))
            .collect();
        for _ in 0..60 {
            let mut f = DVector::<f64>::zeros(m);
            let mut j = DMatrix::zeros(m, d * n);
            for (e, distance) in problem.distances.iter().enumerate() {
                let [a, b] = distance.points;
                for k in 0..d {
                    let w = x[a][k] - x[b][k];
                    f[e] += w * w;
                    j[(e, d * a + k)] = 2.0 * w;
                    j[(e, d * b + k)] = -2.0 * w;
                }
                f[e] -= squares[e];
            }
            if f.amax() < 1e-12 * scale * scale {
                out.push(x);
                break;
            }
            let mut normal = &j * j.transpose();
            let damping = 1e-12 * scale * scale + 1e-3 * f.amax().min(scale * scale * 0.01);
            for e in 0..m {
                normal[(e, e)] += damping;
            }
            let Some(y) = normal.lu().solve(&f) else {
                break;
            };
            let step = j.transpose() * y;
            for p in 0..n {
                for k in 0..d {
                    x[p][k] -= step[d * p + k];
                }
            }
        }
    }
    out
}

fn holds_newtons(problem: &Problem, result: &Complete, starts: usize) -> Result<usize, String> {
    let figures = newton(problem, starts, 0x5eed);
    for figure in &figures {
        let points = figure.iter().map(|p| p.map(krawl::interval::point));
        let solution = Solution::placed(points.collect(), 0);
        // Floats are good for 1e-6 where the figure is not nearly singular.
        let found = congruent(result, &pairs(&solution), 1e-5);
        if found.is_empty() {
            return Err(format!("Newton's method finds another: {figure:?}"));
        }
    }
    Ok(figures.len())
}

#[derive(Default, Debug)]
struct Tally {
    complete: usize,
    partial: usize,
    unserved: usize,
    solutions: usize,
    newton: usize,
    path: usize,
}

fn laws(problem: &Problem, tally: &mut Tally) -> Result<(), String> {
    let options = Options {
        time: Some(Duration::from_secs(20)),
        ..Options::default()
    };
    let Ok(result) = all(problem, &options) else {
        tally.unserved += 1;
        return Ok(());
    };
    if result.reference == problem.homotopy.reference {
        check(problem, &result.solutions)?;
    }
    if result.status != Status::Complete {
        tally.partial += 1;
        println!(
            "{:?} {:?}\n{}",
            result.status,
            result.undecided,
            problem.to_toml()
        );
        return Ok(());
    }
    tally.complete += 1;
    tally.solutions += result.solutions.len();
    tally.newton += holds_newtons(problem, &result, 40)?;
    tally.path += holds_the_path(problem, &result)?;
    // Other names and another order of the points and distances: the same figures.
    let (other, place) = relabelled(problem);
    let again = all(&other, &options).map_err(|e| e.to_string())?;
    if again.status == Status::Complete && again.solutions.len() != result.solutions.len() {
        return Err(format!(
            "{} and {} relabelled",
            result.solutions.len(),
            again.solutions.len()
        ));
    }
    for solution in &again.solutions {
        let mut back = solution.clone();
        for (p, &at) in place.iter().enumerate() {
            back.points[p] = solution.points[at];
        }
        if congruent(&result, &pairs(&back), 0.0).len() != 1 {
            return Err("a relabelled figure is not in the set".to_owned());
        }
    }
    Ok(())
}

fn random_problems(dimension: usize, points: std::ops::RangeInclusive<usize>, cases: u32) -> Tally {
    let tally = RefCell::new(Tally::default());
    let config = Config {
        cases,
        max_global_rejects: 100_000,
        failure_persistence: None,
        ..Config::default()
    };
    let mut runner = TestRunner::new_with_rng(config, same_each_time());
    let result = runner.run(&recipe(dimension, points), |recipe| {
        let Ok(problem) = recipe.build() else {
            return Err(TestCaseError::reject("not a problem"));
        };
        laws(&problem, &mut tally.borrow_mut())
            .map_err(|e| TestCaseError::fail(format!("{e}\n{}", problem.to_toml())))
    });
    if let Err(error) = result {
        panic!("{error}");
    }
    println!("{:?}", tally.borrow());
    tally.into_inner()
}

#[test]
fn random_problems_in_the_plane() {
    let tally = random_problems(2, 4..=9, 30);
    assert!(
        tally.complete >= 28 && tally.solutions > 20 && tally.newton > 100 && tally.path > 5,
        "{tally:?}"
    );
}

#[test]
fn random_problems_in_space() {
    let tally = random_problems(3, 4..=8, 30);
    assert!(
        tally.complete >= 28 && tally.solutions > 20 && tally.newton > 100 && tally.path > 5,
        "{tally:?}"
    );
}

#[test]
#[ignore = "long"]
fn many_random_problems() {
    for (dimension, points) in [(2, 4..=9), (3, 4..=9), (2, 4..=6), (3, 4..=6)] {
        let tally = random_problems(dimension, points, 1000);
        assert!(tally.complete >= 950, "{tally:?}");
    }
}

#[test]
fn the_answer_does_not_depend_on_the_number_of_threads() {
    for name in ["disulfide", "dodecagon"] {
        let problem = shipped(name);
        let with = |threads: usize| {
            all(
                &problem,
                &Options {
                    threads,
                    ..Options::default()
                },
            )
            .unwrap()
        };
        let (one, three) = (with(1), with(3));
        assert_eq!(one.solutions, three.solutions);
        assert_eq!(one.boxes, three.boxes);
    }
}

#[test]
fn an_empty_set_is_a_result_with_a_reason() {
    // A path is shorter than the distance between its ends.
    let problem = Problem::build("long", 2)
        .point("a", ["0", "0"])
        .point("b", ["1", "0"])
        .point("c", ["0", "1"])
        .distance("a", "b", "4")
        .distance("b", "c", "1.5")
        .distance("c", "a", "2")
        .finish()
        .unwrap();
    let result = searched(&problem);
    assert_eq!(
        (result.status, result.solutions.len()),
        (Status::Complete, 0)
    );
    let reason = result.reason.unwrap();
    assert!(reason.contains("a-b is longer than"), "{reason}");
    // All triangles close, and the four faces do not fit together.
    let problem = Problem::build("flat", 3)
        .point("a", ["0", "0", "0"])
        .point("b", ["1", "0", "0"])
        .point("c", ["0", "1", "0"])
        .point("d", ["0", "0", "1"])
        .distance("a", "b", "1")
        .distance("b", "c", "1")
        .distance("c", "a", "1")
        .distance("a", "d", "0.52")
        .distance("b", "d", "0.52")
        .distance("c", "d", "0.52")
        .finish()
        .unwrap();
    let result = searched(&problem);
    assert_eq!(
        (result.status, result.solutions.len()),
        (Status::Complete, 0)
    );
    assert!(result.reason.is_some());
}

/// A ring of six equal bars with equal angles flexes: the boat. The chair is isolated.
fn cyclohexane() -> Problem {
    let mut problem = Problem::build("cyclohexane", 3);
    let up = ["0.4", "-0.3", "0.5", "-0.45", "0.35", "-0.4"];
    for p in 0..6 {
        let angle = p as f64 * std::f64::consts::FRAC_PI_3;
        let (x, y) = (
            format!("{:.2}", 1.4 * angle.cos()),
            format!("{:.2}", 1.4 * angle.sin()),
        );
        problem = problem.point(&format!("c{p}"), [x.as_str(), y.as_str(), up[p]]);
    }
    for p in 0..6 {
        let name = |k: usize| format!("c{}", (p + k) % 6);
        problem =
            problem
                .distance(&name(0), &name(1), "1.526")
                .distance(&name(0), &name(2), "2.492");
    }
    problem.finish().unwrap()
}

/// Bricard's first kind: an octahedron with an axis of symmetry, opposite edges being equal.
fn bricard() -> Problem {
    let mut problem = Problem::build("bricard", 3);
    let sketch = [
        ["0", "0", "0"],
        ["1.3", "0.2", "0"],
        ["0.3", "1.4", "0.2"],
        ["1.1", "1.2", "0.9"],
        ["0.2", "-0.3", "1.2"],
        ["1.5", "0.7", "-0.8"],
    ];
    for (p, at) in sketch.iter().enumerate() {
        problem = problem.point(&format!("p{p}"), *at);
    }
    // a and a', b and b', c and c' change places under the half turn.
    for (a, b, length) in [
        (0, 1, "1.5"),
        (3, 4, "1.5"),
        (0, 4, "1.9"),
        (3, 1, "1.9"),
        (0, 2, "1.7"),
        (3, 5, "1.7"),
        (0, 5, "2.1"),
        (3, 2, "2.1"),
        (1, 2, "1.6"),
        (4, 5, "1.6"),
        (1, 5, "1.8"),
        (4, 2, "1.8"),
    ] {
        problem = problem.distance(&format!("p{a}"), &format!("p{b}"), length);
    }
    problem.finish().unwrap()
}

#[test]
fn flexible_figures_are_not_called_complete() {
    for problem in [cyclohexane(), bricard()] {
        let options = Options {
            time: Some(Duration::from_secs(120)),
            ..Options::default()
        };
        let result = all(&problem, &options).unwrap();
        assert_eq!(
            result.status,
            Status::Flexible,
            "{}: {:?}",
            problem.name,
            result.undecided
        );
        assert!(result.seconds < 120.0);
        let unfinished = |p: &krawl::complete::Part| p.why == krawl::complete::Why::Unfinished;
        assert!(
            !result.undecided.iter().any(unfinished),
            "{:?}",
            result.undecided
        );
    }
}

#[test]
fn ended_early_is_partial() {
    let problem = shipped("dodecagon");
    let result = all(
        &problem,
        &Options {
            most_boxes: 700,
            threads: 1,
            ..Options::default()
        },
    )
    .unwrap();
    assert_eq!(result.status, Status::Partial);
    let share: f64 = result.undecided.iter().map(|part| part.share).sum();
    assert!(share > 0.0 && share <= 1.0);
    // What is left is told by what was done; of what is through nothing is.
    let open = share * result.seconds / (1.0 - share);
    let left = result.seconds_left.unwrap();
    assert!((left - open).abs() < 1e-6 * open, "{left} and {open}");
    let whole = all(&problem, &Options::default()).unwrap();
    assert_eq!(whole.seconds_left, None);
}
