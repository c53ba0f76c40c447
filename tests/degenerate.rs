//! Paths through degenerate (flat) figures at t = 1: what is claimed of them, against arithmetic of the test's own.

use krawl::certificate::{Outcome as Verdicts, Settings, Writer, verify};
use krawl::problem::Problem;
use krawl::track::{Control, Mode, Options, Outcome, Solution, Space, Status, solve};
use std::collections::BTreeSet;

/// The lengths and faces of the hexahedron, by the numbers of points.
const LENGTHS: [(usize, usize, f64); 12] = [
    (0, 1, 1.3),
    (1, 2, 1.3),
    (2, 3, 1.3),
    (3, 0, 0.5),
    (0, 6, 0.7),
    (1, 7, 0.9),
    (2, 4, 0.8),
    (3, 5, 0.8),
    (5, 6, 0.5),
    (6, 7, 1.9),
    (7, 4, 1.8),
    (4, 5, 1.5),
];
const FACES: [[usize; 4]; 6] = [
    [0, 1, 2, 3],
    [1, 2, 4, 7],
    [2, 3, 5, 4],
    [3, 0, 6, 5],
    [0, 1, 7, 6],
    [4, 5, 6, 7],
];

type Figure = Vec<[f64; 3]>;

/// The one with the longer path.
fn hexahedron() -> Problem {
    Problem::read("tests/data/hexahedron-28.toml").unwrap()
}

/// The one that is shipped, with the same lengths and faces.
fn shipped() -> Problem {
    Problem::read("problems/constraints/hexahedron.toml").unwrap()
}

fn run(problem: &Problem, options: &Options) -> Outcome {
    solve(problem, options, &mut Control::default()).unwrap()
}

fn middle(solution: &Solution) -> Figure {
    let of = |p: &[krawl::interval::Interval; 3]| p.map(|x| x.mid());
    solution.points.iter().map(of).collect()
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn volume(figure: &Figure, [a, b, c, d]: [usize; 4]) -> f64 {
    let [u, v, w] = [b, c, d].map(|p| minus(figure[p], figure[a]));
    u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
        + u[2] * (v[0] * w[1] - v[1] * w[0])
}

fn length(figure: &Figure, i: usize, j: usize) -> f64 {
    minus(figure[i], figure[j])
        .iter()
        .map(|x| x * x)
        .sum::<f64>()
        .sqrt()
}

fn is_flat(figure: &Figure) -> bool {
    figure.iter().all(|p| p[2].abs() < 1e-9)
}

/// The coefficients of the conditions on heights of a flat figure, over those of p3 to p7: heights w over 1 − t satisfy
/// D w = the faces' volumes in the sketch.
fn conditions(figure: &Figure) -> Vec<[f64; 5]> {
    let lifted = |p: usize| {
        let mut figure = figure.clone();
        figure[p][2] += 1.0;
        figure
    };
    let of_face = |&face: &[usize; 4]| {
        std::array::from_fn(|k| volume(&lifted(3 + k), face) - volume(figure, face))
    };
    FACES.iter().map(of_face).collect()
}

/// What the best heights leave of the conditions: least squares by Gram and Schmidt.
fn left_over(figure: &Figure, volumes: &[f64]) -> f64 {
    let rows = conditions(figure);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut rest = volumes.to_vec();
    for k in 0..5 {
        let mut column: Vec<f64> = rows.iter().map(|row| row[k]).collect();
        for _ in 0..2 {
            for b in &basis {
                let along = dot(&column, b);
                column.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
            }
        }
        let size = dot(&column, &column).sqrt();
        assert!(size > 1e-6, "the heights are not determined");
        column.iter_mut().for_each(|x| *x /= size);
        let along = dot(&rest, &column);
        rest.iter_mut()
            .zip(&column)
            .for_each(|(x, y)| *x -= along * y);
        basis.push(column);
    }
    dot(&rest, &rest).sqrt() / dot(volumes, volumes).sqrt()
}

/// The volumes of the faces in the sketch as the reference sees it: which a rigid motion does not change. The problem
/// leads p3's height instead of its face's volume, to the same zero.
fn volumes_in_sketch(problem: &Problem, flat: &Figure) -> Vec<f64> {
    let decimal = |x: &krawl::problem::Decimal| x.to_string().parse::<f64>().unwrap();
    let place = |p: &krawl::problem::Point| p.sketch.each_ref().map(decimal);
    let sketch: Figure = problem.points.iter().map(place).collect();
    let mut volumes: Vec<f64> = FACES.iter().map(|&face| volume(&sketch, face)).collect();
    // The height of p3 in the sketch, as the flat figure's base makes a volume of it.
    let normal = |figure: &Figure| {
        let (u, v) = (minus(figure[1], figure[0]), minus(figure[2], figure[0]));
        [
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ]
    };
    let size = normal(&sketch).iter().map(|x| x * x).sum::<f64>().sqrt();
    volumes[0] *= normal(flat)[2] / size;
    volumes
}

/// What holds of solutions, whoever lists them.
fn check(problem: &Problem, outcome: &Outcome) -> (usize, usize) {
    let mut degenerate = 0;
    for solution in &outcome.solutions {
        let figure = middle(solution);
        for (i, j, l) in LENGTHS {
            assert!((length(&figure, i, j) - l).abs() < 1e-8);
        }
        for face in FACES {
            assert!(volume(&figure, face).abs() < 1e-8);
        }
        assert_eq!(is_flat(&figure), solution.is_degenerate);
        if !solution.is_degenerate {
            continue;
        }
        degenerate += 1;
        assert!(solution.points.iter().all(|p| p[2].mag() == 0.0));
        // It is the one on its curve of flat figures in which heights over 1 − t have limits, and its neighbours
        // on that curve are not.
        let volumes = volumes_in_sketch(problem, &figure);
        let here = left_over(&figure, &volumes);
        assert!(here < 1e-7, "{here:e}");
        let mut found = 0;
        for step in [1e-3, -1e-3] {
            let other = along_the_curve(&figure, step);
            let there = left_over(&other, &volumes);
            assert!(there > 100.0 * here.max(1e-9), "{there:e} at {step}");
            found += 1;
        }
        assert_eq!(found, 2);
    }
    (outcome.solutions.len(), degenerate)
}

/// Another flat figure of the same lengths: a step along their curve, corrected by Newton's method with minimal
/// corrections.
fn along_the_curve(figure: &Figure, step: f64) -> Figure {
    // Unknowns: x of p1, x and y of p2 to p7.
    let free: Vec<(usize, usize)> = std::iter::once((1, 0))
        .chain((2..8).flat_map(|p| [(p, 0), (p, 1)]))
        .collect();
    let row = |figure: &Figure, (i, j, _): (usize, usize, f64)| -> Vec<f64> {
        let d = minus(figure[i], figure[j]);
        let entry = |&(p, k): &(usize, usize)| d[k] * (f64::from(p == i) - f64::from(p == j));
        free.iter().map(entry).collect()
    };
    // The kernel of 12 rows in 13 unknowns: what is left of a vector behind an orthonormal basis of the rows.
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let orthonormal = |figure: &Figure| {
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for l in LENGTHS {
            let mut r = row(figure, l);
            for _ in 0..2 {
                for b in &basis {
                    let along = dot(&r, b);
                    r.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
                }
            }
            let size = dot(&r, &r).sqrt();
            assert!(size > 1e-6, "the lengths are dependent");
            r.iter_mut().for_each(|x| *x /= size);
            basis.push(r);
        }
        basis
    };
    let basis = orthonormal(figure);
    let mut kernel: Vec<f64> = (0..13).map(|k| 1.0 + (k as f64).sin()).collect();
    for _ in 0..2 {
        for b in &basis {
            let along = dot(&kernel, b);
            kernel.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
        }
    }
    let size = dot(&kernel, &kernel).sqrt();
    let mut other = figure.clone();
    for (&(p, k), x) in free.iter().zip(&kernel) {
        other[p][k] += step * x / size;
    }
    // Kaczmarz's method: one length after the other.
    for _ in 0..4000 {
        for (i, j, l) in LENGTHS {
            let r = row(&other, (i, j, l));
            let excess = 0.5 * (length(&other, i, j).powi(2) - l * l);
            let by = excess / dot(&r, &r);
            for (&(p, k), x) in free.iter().zip(&r) {
                other[p][k] -= by * x;
            }
        }
    }
    for (i, j, l) in LENGTHS {
        assert!((length(&other, i, j) - l).abs() < 1e-10);
    }
    other
}

/// Solutions on the path, and degenerate ones among them: what a tracker of another make and other coordinates, with
/// steps over t = 1, counts too.
const SOLUTIONS: (usize, usize) = (28, 4);
/// The same of the shipped one: what the float and the certified tracker count alike.
const SHIPPED: (usize, usize) = (8, 2);

/// The path closes, through its flat figures, in floats and with proof.
#[test]
fn the_hexahedron_closes_through_flat_figures() {
    closes(&hexahedron(), SOLUTIONS);
}

/// The shipped one has 7 solutions up to reflection, as the paper's first path, and an even number of flat ones, as every
/// closed path that meets flat figures at t = 1 alone (docs/degenerate.md).
#[test]
fn the_shipped_hexahedron_has_seven_solutions_up_to_reflection() {
    let problem = shipped();
    closes(&problem, SHIPPED);
    for options in [
        Options::certified(),
        Options::certified().reversed(),
        Options::float(Space::Full),
        Options::float(Space::Full).reversed(),
    ] {
        let outcome = run(&problem, &options);
        assert_eq!(outcome.status, Status::Closed, "{options:?}");
        assert_eq!(check(&problem, &outcome), SHIPPED, "{options:?}");
        let classes = |flat: bool| -> BTreeSet<usize> {
            let solutions = outcome.solutions.iter();
            let wanted = solutions.filter(|s| s.is_degenerate == flat);
            wanted.map(|s| s.class).collect()
        };
        assert_eq!((classes(false).len(), classes(true).len()), (5, 2));
    }
}

/// A problem's path closes in both modes, with so many solutions and flat ones among them, which are the same in both.
fn closes(problem: &Problem, counts: (usize, usize)) {
    let [certified, float] = [Options::certified(), Options::float(Space::Full)].map(|options| {
        let outcome = run(problem, &options);
        assert_eq!(outcome.status, Status::Closed, "{:?}", outcome.mode);
        assert_eq!(check(problem, &outcome), counts, "{:?}", outcome.mode);
        outcome
    });
    for (proved, seen) in certified.solutions.iter().zip(&float.solutions) {
        assert_eq!(proved.is_degenerate, seen.is_degenerate);
        for (proved, seen) in proved.points.iter().zip(&seen.points) {
            for (proved, seen) in proved.iter().zip(seen) {
                assert!((proved.mid() - seen.mid()).abs() < 1e-7);
                assert!(proved.wid() < 1e-6);
            }
        }
    }
    let says = |outcome: &Outcome, what: &str| outcome.switched_on.iter().any(|s| s.contains(what));
    assert!(says(&certified, "heights divided by 1 − t"));
}

/// Both ways round it is the same path.
#[test]
fn the_other_way_round_meets_the_same() {
    for options in [Options::certified(), Options::float(Space::Full)] {
        let there = run(&hexahedron(), &options);
        let back = run(&hexahedron(), &options.clone().reversed());
        assert_eq!(back.status, Status::Closed);
        assert_eq!(there.solutions.len(), back.solutions.len());
        for (one, other) in there.solutions.iter().zip(back.solutions.iter().rev()) {
            assert_eq!(one.is_degenerate, other.is_degenerate);
            let mut pairs = one
                .points
                .iter()
                .flatten()
                .zip(other.points.iter().flatten());
            assert!(pairs.all(|(a, b)| (a.mid() - b.mid()).abs() < 1e-7));
            if options.mode == Mode::Certified {
                let mut pairs = one
                    .points
                    .iter()
                    .flatten()
                    .zip(other.points.iter().flatten());
                assert!(pairs.all(|(a, b)| !a.disjoint(*b)));
            }
        }
    }
}

/// Where flat figures are no continua nothing is divided, and flat solutions are solutions like others.
#[test]
fn flat_figures_of_other_problems_are_not_degenerate() {
    let problem = Problem::read("problems/constraints/pentahedron.toml").unwrap();
    for options in [Options::certified(), Options::float(Space::Full)] {
        let outcome = solve(&problem, &options, &mut Control::default()).unwrap();
        assert!(outcome.solutions.iter().any(|s| is_flat(&middle(s))));
        assert!(outcome.solutions.iter().all(|s| !s.is_degenerate));
        let mut switched_on = outcome.switched_on.iter();
        assert!(switched_on.all(|what| !what.contains("heights divided")));
    }
}

/// A certificate has no records for the divided equations: it ends before the first such figure, says so, and claims
/// no more than is there.
#[test]
fn a_certificate_ends_at_the_first_flat_figure() {
    let problem = hexahedron();
    let mut writer = Writer::new(Vec::new(), &problem);
    let mut control = Control {
        witness: Some(&mut writer),
        ..Control::default()
    };
    let outcome = solve(&problem, &Options::certified(), &mut control).unwrap();
    assert_eq!(outcome.status, Status::Closed);
    let bytes = writer.finish().unwrap();
    let verdict = verify(&bytes[..], &Settings::default(), &mut |_| ()).unwrap();
    let Verdicts::Partial(reason) = &verdict.outcome else {
        panic!("{:?}", verdict.outcome);
    };
    assert!(reason.contains("degenerate (flat) figure"), "{reason}");
    let before = outcome.solutions.iter().take_while(|s| !s.is_degenerate);
    assert_eq!(verdict.solutions.len(), before.count());
}
