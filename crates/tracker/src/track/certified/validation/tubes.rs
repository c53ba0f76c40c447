//! What is proved of single tubes and of their links.

use super::disguise::every_other_disguised;
use super::precise::full::{check_exit, check_path};
use super::precise::{Case, Ratios, spread};
use super::*;

/// What was checked, and how near the proofs' bounds the true values came.
#[derive(Debug, Default)]
struct Tally {
    tubes: usize,
    shortened: usize,
    refused: usize,
    ratios: Ratios,
}

fn check_problem(
    case: &Case,
    max_h: f64,
    (tubes, rounds): (usize, usize),
    random: &mut Random,
    tally: &mut Tally,
) {
    let (homotopy, figure) = (&case.homotopy, &case.figure);
    let mut workshop = Workshop::new(homotopy, max_h);
    let chain = workshop.chain(homotopy, 1000);
    for k in spread(&chain, tubes) {
        let sample = &chain[k];
        tally.tubes += 1;
        for _ in 0..rounds {
            check_path(figure, sample, random, &mut tally.ratios).expect("a regular point");
        }
        let exits = (sample, chain.get(k + 1));
        check_exit(&mut workshop, figure, exits, &mut tally.ratios).expect("a regular point");

        // What is provable is provable for shorter tubes, unless so short that rounding drowns
        // the direction.
        for factor in [0.999, 0.5, 0.01, 1e-4] {
            let mut tube = sample.tube.clone();
            let (weights, h) = (tube.weights.clone(), factor * tube.proof.h);
            tally.shortened += 1;
            if !workshop.prove_as_it_is(&mut tube, weights, h) {
                tally.refused += 1;
                continue;
            }
            assert!(tube.proof.h <= h);
            let kept = workshop.test.kept();
            let shorter = Sample { tube, kept };
            check_path(figure, &shorter, random, &mut tally.ratios).expect("a regular point");
        }
    }
}

#[test]
fn proofs_hold_along_the_shipped_problems() {
    let mut tally = Tally::default();
    let mut random = Random::new(1);
    for case in shipped().into_iter().map(Case::new) {
        for max_h in [f64::INFINITY, 1e-2, 1e-5] {
            check_problem(&case, max_h, (12, 4), &mut random, &mut tally)
        }
    }
    println!("{tally:?}");
    assert!(tally.refused == 0, "short tubes are not proved: {tally:?}");
    tally.ratios.come_near(&[("q", 0.5), ("distance", 0.1)]);
}

#[test]
fn proofs_hold_along_random_problems() {
    let mut tally = Tally::default();
    let mut random = Random::new(2);
    for round in 0..effort(60) {
        let dimension = 2 + round % 2;
        let points = dimension + 1 + random.below(4);
        let change = [0.1, 0.5, 1e-6][random.below(3)];
        let problem = random_problem(&mut random, dimension, points, change);
        let max_h = [f64::INFINITY, 1e-3][random.below(2)];
        if let Some(case) = every_other_disguised(round, problem, &mut random) {
            check_problem(&case, max_h, (8, 4), &mut random, &mut tally)
        }
    }
    println!("{tally:?}");
    assert!(
        tally.refused * 100 < tally.shortened,
        "short tubes are not proved: {tally:?}"
    );
    assert!(tally.tubes > 200, "too few cases: {tally:?}");
}

/// Constraints of all kinds, each with its own auxiliary unknowns.
#[test]
fn proofs_hold_along_problems_of_mixed_kinds() {
    let mut tally = Tally::default();
    let mut random = Random::new(4);
    for round in 0..effort(40) {
        let case = Case::new(mixed_problem(&mut random, 2 + round % 2));
        let max_h = [f64::INFINITY, 1e-3][random.below(2)];
        check_problem(&case, max_h, (8, 4), &mut random, &mut tally)
    }
    println!("{tally:?}");
    assert!(tally.tubes > 120, "too few cases: {tally:?}");
}
