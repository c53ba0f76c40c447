//! The same path under other settings: runs that close must find the same solutions.

use super::solutions::check_solutions;
use super::*;
use crate::places::Each as _;
use crate::problem::Target;
use crate::track::{Control, Options, Outcome, Status, solve};

/// What does not depend on settings: the number of solutions, and the figures as sorted lists of
/// their distances, each with how many solutions show it.
fn figures(outcome: &Outcome) -> (usize, Vec<(Vec<f64>, usize)>) {
    let mut figures: Vec<(Vec<f64>, usize)> = Vec::new();
    for solution in &outcome.solutions {
        let p: Vec<[f64; 3]> = solution
            .points
            .iter()
            .map(|p| p.each(|x| x.mid()))
            .collect();
        let mut shape = Vec::new();
        for i in 0..p.len() {
            for j in 0..i {
                shape.push(
                    (0..3)
                        .map(|k| (p[i][k] - p[j][k]).powi(2))
                        .sum::<f64>()
                        .sqrt(),
                );
            }
        }
        if solution.class < figures.len() {
            figures[solution.class].1 += 1;
        } else {
            figures.push((shape, 1));
        }
    }
    figures.sort_by(|a, b| a.partial_cmp(b).expect("finite distances"));
    (outcome.solutions.len(), figures)
}

fn agree(a: &Outcome, b: &Outcome, scale: f64) -> bool {
    let ((m, a), (n, b)) = (figures(a), figures(b));
    // Sorting may exchange figures that differ by less than the boxes' widths: match them freely.
    let close = |x: &[f64], y: &[f64]| {
        let size = y.iter().fold(0.0f64, |max, v| max.max(*v));
        x.iter()
            .zip(y)
            .all(|(x, y)| (x * scale - y).abs() < 1e-6 * size)
    };
    m == n
        && a.len() == b.len()
        && a.iter()
            .all(|(x, k)| b.iter().any(|(y, l)| k == l && close(x, y)))
}

fn run(
    problem: &Problem,
    max_step: Option<f64>,
    reverse: bool,
    max_steps: usize,
) -> Option<Outcome> {
    let options = Options {
        max_step,
        reverse,
        max_steps,
        ..Options::certified()
    };
    let outcome = solve(problem, &options, &mut Control::default()).ok()?;
    (outcome.status == Status::Closed).then_some(outcome)
}

/// Sketches with much symmetry, all of whose targets are nearly equal.
fn symmetrical(random: &mut Random) -> Problem {
    let tiny = 10f64.powf(random.between(-12.0, -1.0));
    let builder = Problem::build("symmetrical", 2)
        .point("a", [0.0, 0.0])
        .point("b", [2.0, 0.0])
        .point("c", [2.0, 2.0])
        .point("d", [0.0, 2.0])
        .point(
            "e",
            [
                1.0,
                1.0 + if random.below(2) == 0 {
                    0.0
                } else {
                    rounded(tiny, 12)
                },
            ],
        );
    let mut length = |base: f64| base + random.sign() * rounded(tiny * random.unit(), 13);
    let (s, r) = (2.0, 1.5);
    builder
        .distance("a", "b", length(s))
        .distance("b", "c", length(s))
        .distance("c", "d", length(s))
        .distance("a", "e", length(r))
        .distance("b", "e", length(r))
        .distance("c", "e", length(r))
        .distance("d", "e", length(r))
        .bend(["c", "d"])
        .bend_coefficient(1.0)
        .reference(["a", "b"])
        .finish()
        .unwrap()
}

fn compare(problem: &Problem, random: &mut Random, runs: &mut [usize; 3]) {
    let Some(first) = run(problem, None, false, 2500) else {
        runs[2] += 1;
        return;
    };
    check_solutions(problem, &first);
    let mut again = |what: &str, problem: &Problem, max_step: Option<f64>, reverse, scale| {
        let Some(outcome) = run(problem, max_step, reverse, 20_000) else {
            runs[1] += 1;
            return;
        };
        runs[0] += 1;
        assert!(
            agree(&first, &outcome, scale),
            "{what}: {} solutions at first, then {}\n{problem:#?}",
            first.solutions.len(),
            outcome.solutions.len()
        );
    };
    again("reversed", problem, None, true, 1.0);
    let short = Some(random.between(0.02, 0.3));
    again("small steps", problem, short, false, 1.0);
    // Another reference, of joined points or of any: the path cannot tell them apart, unless the
    // reference degenerates on the way, which at best ends the run.
    let any = random.below(2) == 0;
    let joined = |reference: &[usize]| {
        (0..reference.len()).all(|i| (0..i).all(|j| problem.are_joined(reference[i], reference[j])))
    };
    let mut other = problem.clone();
    for _ in 0..20 {
        let mut reference: Vec<usize> = Vec::new();
        while reference.len() < problem.dimension {
            let p = random.below(problem.points.len());
            if !reference.contains(&p) {
                reference.push(p);
            }
        }
        if (any || joined(&reference)) && reference != problem.homotopy.reference {
            other.homotopy.reference = reference;
            if other.check().is_ok() {
                let reverse = random.below(2) == 0;
                again("another reference", &other, None, reverse, 1.0);
                break;
            }
            other = problem.clone();
        }
    }
    // Another size: exact, as decimals are shifted.
    let exponent = [-40, -7, 5, 40][random.below(4)];
    if let Some(scaled) = scaled(problem, exponent) {
        let scale = 10f64.powi(exponent);
        again(&format!("10^{exponent}"), &scaled, None, false, scale);
    }
}

#[test]
fn closed_runs_agree() {
    let mut random = Random::new(8);
    let mut runs = [0; 3];
    for round in 0..effort(90) {
        let problem = match round % 3 {
            0 => symmetrical(&mut random),
            k => {
                let points = k + 3 + random.below(4);
                let change = [0.3, 0.05, 1e-4][random.below(3)];
                random_problem(&mut random, k + 1, points, change)
            }
        };
        compare(&problem, &mut random, &mut runs);
    }
    println!("{runs:?} agree, did not close, and problems that did not close at all");
    assert!(runs[0] > 120);
}

/// Sizes, steps and bends that nobody would choose: no panic, and nothing false.
#[test]
fn wild_settings_end_well() {
    let mut random = Random::new(10);
    let mut closed = 0;
    for round in 0..effort(120) {
        let dimension = 2 + round % 2;
        let points = dimension + random.below(4);
        let mut problem = random_problem(&mut random, dimension, points, 0.1);
        let bends = [
            "0", "1e-60", "-1e-30", "1e-9", "1e3", "1e12", "1e60", "-1e60", "-5",
        ];
        if random.below(3) > 0 {
            problem.homotopy.bend_coefficient = bends[random.below(bends.len())].parse().unwrap();
        }
        problem.homotopy.bend = random.below(problem.distances.len());
        if random.below(3) == 0 {
            // One length, or all of them, of another size than the sketch.
            let exponent = [-57, -20, -9, -3, 3, 9, 20, 55][random.below(8)];
            let all = random.below(2) == 0;
            for d in &mut problem.distances {
                if let Target::Length(x) = &d.target
                    && (all || random.below(4) == 0)
                {
                    d.target = Target::Length(times_ten_to(x, exponent).unwrap());
                }
            }
        }
        let steps = [
            0.0,
            -1.0,
            f64::NAN,
            1e-300,
            1e-13,
            1e-9,
            0.1,
            1e3,
            1e300,
            f64::INFINITY,
        ];
        let max_step = (random.below(2) == 0).then(|| steps[random.below(steps.len())]);
        if let Some(outcome) = run(&problem, max_step, random.below(2) == 0, 400) {
            closed += 1;
            check_solutions(&problem, &outcome);
            if let Some(other) = run(&problem, Some(0.2), random.below(2) == 0, 20_000) {
                assert!(agree(&outcome, &other, 1.0), "{problem:#?}");
            }
        }
    }
    println!("{closed} closed");
    assert!(closed > 20);
}

#[test]
fn closed_runs_of_the_shipped_problems_agree() {
    let mut random = Random::new(9);
    let mut runs = [0; 3];
    for problem in shipped() {
        compare(&problem, &mut random, &mut runs);
    }
    println!("{runs:?} agree, did not close, and problems that did not close at all");
    assert!(runs[0] >= 8);
}
