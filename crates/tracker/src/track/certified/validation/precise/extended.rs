//! What is proved in extended precision near singular places: tubes, exits, links, t, boxes of solutions.

use super::full::{check_exit, check_path};
use super::*;
use crate::track::certified::solution::SolutionProver;
use crate::track::{Control, Options, Status, solve};

const NAMES: [&str; 8] = [
    "hard/flaps-split-8",
    "hard/fold-8",
    "hard/triple-3",
    "hard/crowd-2",
    "hard/graze-4",
    "hard/tents-split-4",
    "hard/fold-missed-5",
    "hard/sliver-3",
];

/// How many tubes there were, and the least distance that was proved.
#[derive(Debug)]
struct Tally {
    chains: usize,
    short: usize,
    /// Those of a chain with a middle that is no float.
    low: usize,
    least: f64,
}

fn check_tubes(
    problem: Problem,
    (tubes, rounds): (usize, usize),
    random: &mut Random,
    (ratios, tally): (&mut Ratios, &mut Tally),
) {
    let Case {
        problem,
        homotopy,
        figure,
    } = Case::new(problem);
    let mut workshop = Workshop::new(&homotopy, f64::INFINITY);
    workshop.equations.extend(&homotopy);
    workshop.test.precision.extended = true;
    let chain = workshop.chain(&homotopy, 400);
    println!("{}: {} tubes", problem.name, chain.len());
    assert!(!chain.is_empty(), "{}", problem.name);
    for k in spread(&chain, tubes) {
        let local = &chain[k].tube.local;
        assert!(local.is_extended);
        tally.low += usize::from(local.low.iter().any(|&x| x != 0.0));
        let exits = (&chain[k], chain.get(k + 1));
        check_exit(&mut workshop, &figure, exits, ratios).expect("a regular point");
        for _ in 0..rounds {
            check_path(&figure, &chain[k], random, ratios).expect("a regular point");
        }
        tally.chains += 1;
        // The same point in shorter tubes, where order 0 and its rounding are most of what is left.
        let mut sample = chain[k].clone();
        let max_h = sample.tube.proof.h * 10f64.powf(random.between(-8.0, -1.0));
        let (tube, weights) = (&mut sample.tube, chain[k].tube.weights.clone());
        if !workshop.prove_as_it_is(tube, weights, max_h) {
            continue;
        }
        let (test, equations) = (&mut workshop.test, &workshop.equations);
        if test.enclose_exit(equations, tube).is_none() {
            continue;
        }
        sample.kept = test.kept();
        check_exit(&mut workshop, &figure, (&sample, None), ratios).expect("a regular point");
        for _ in 0..rounds {
            check_path(&figure, &sample, random, ratios).expect("a regular point");
        }
        tally.short += 1;
        tally.least = tally.least.min(sample.tube.proof.distance);
    }
}

/// Extended precision is on from the sketch on, wherever 53 bits would do.
#[test]
fn extended_tubes_dominate_exact_values_near_singular_places() {
    let (mut ratios, mut random) = (Ratios::default(), Random::new(47));
    let mut tally = Tally {
        chains: 0,
        short: 0,
        low: 0,
        least: f64::INFINITY,
    };
    for problem in problems(&NAMES) {
        let (counts, out) = ((effort(12), 2), (&mut ratios, &mut tally));
        check_tubes(problem, counts, &mut random, out)
    }
    println!("{tally:?}");
    // Far below what 53 bits can tell.
    assert!(
        tally.low > 50 && tally.short > 50 && tally.least < 1e-22,
        "{tally:?}"
    );
    ratios.come_near(&[("distance", 0.2), ("slope_distance", 0.2)]);
}

/// Boxes of a problem's solutions, from guesses that are off by so much: the greatest of their radii.
fn check_boxes(problem: &Problem, off: f64, ratios: &mut Ratios) -> f64 {
    let homotopy = Homotopy::new(problem).expect("a gauge");
    let figure = Figure::new(problem, &homotopy);
    let mut equations = Equations::new(&homotopy);
    equations.extend(&homotopy);
    let mut inverter = equations.inverter();
    let mut prover = SolutionProver::new(&homotopy, &equations);
    let outcome = solve(problem, &Options::certified(), &mut Control::default()).unwrap();
    assert_eq!(outcome.status, Status::Closed, "{}", problem.name);
    let (n, m) = (figure.n, figure.m);
    let mut normal = vec![0.0; n];
    normal[m] = 1.0;
    let (unit, mut widest) = (Big::of(homotopy.unit), 0.0f64);
    for solution in &outcome.solutions {
        let mut guess = equations.vector();
        for (v, &place) in homotopy.gauge.place.iter().enumerate() {
            let (point, axis) = (place / homotopy.dimension, place % homotopy.dimension);
            guess[v] = solution.points[point][axis].mid() / homotopy.unit + off;
        }
        guess[m] = 1.0;
        let found = prover
            .prove(&equations, &mut inverter, &guess, true)
            .expect("a box");
        let middle = |i: usize| Big::of(found.figure.centre[i]) + Big::of(found.figure.low[i]);
        let mut through: Vec<Big> = (0..m).map(middle).collect();
        through.push(Big::of(1.0));
        let (z, _) = figure
            .point_near(&through, &normal)
            .unwrap_or_else(|| panic!("no solution near a box of {}", problem.name));
        for (i, z) in z[..m].iter().enumerate() {
            ratios.check("solution", &(z - &through[i]).abs(), found.figure.radius[i]);
            widest = widest.max(found.figure.radius[i]);
        }
        for (p, point) in found.points(&homotopy).iter().enumerate() {
            for (x, box_) in homotopy.place(p, |i| &z[i] * &unit).iter().zip(point) {
                assert!(Big::of(box_.inf()) <= *x && *x <= Big::of(box_.sup()));
            }
        }
    }
    widest
}

#[test]
fn extended_boxes_hold_exact_solutions() {
    for problem in shipped().iter().filter(|p| p.dimension == 3).take(2) {
        let widest = check_boxes(problem, 1e-9, &mut Ratios::default());
        assert!(0.0 < widest && widest < 1e-26, "{widest:e}");
    }
}

#[test]
fn extended_boxes_hold_exact_solutions_near_singular_places() {
    let mut ratios = Ratios::default();
    for problem in problems(&NAMES) {
        check_boxes(&problem, 0.0, &mut ratios);
    }
    assert!(ratios.count("solution") > 100);
    ratios.come_near(&[("solution", 1e-3)]);
}
