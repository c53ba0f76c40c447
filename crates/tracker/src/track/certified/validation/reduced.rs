//! What is proved of single tubes in the reduced space.

use super::disguise::every_other_disguised;
use super::precise::reduced::check_problem;
use super::precise::{Case, Ratios};
use super::*;
use crate::linalg::LANE;
use crate::places::array;

/// So many rows of right-hand sides, full or with few entries.
pub fn right_hand_sides(random: &mut Random, rows: usize) -> Vec<[f64; LANE]> {
    let sparse = random.below(2) == 0;
    let mut entry = || match sparse && random.below(4) > 0 {
        true => 0.0,
        false => random.between(-1.0, 1.0),
    };
    let row = |_| array(|_| entry());
    (0..rows).map(row).collect()
}

#[test]
fn reduced_proofs_hold_along_the_shipped_problems() {
    let (mut ratios, mut random) = (Ratios::default(), Random::new(21));
    for case in shipped().into_iter().map(Case::new) {
        for how in [(0.1, f64::INFINITY), (0.4, f64::INFINITY), (0.1, 1e-3)] {
            check_problem(&case, how, (10, 6), &mut random, &mut ratios);
        }
    }
    ratios.come_near(&[("|Φ'(0)|", 0.3), ("|Φ(0)|", 0.1)]);
}

/// So many random problems, with so many tubes at least and so many of them tightened.
fn hold_along_random_problems(rounds: usize, [least, least_tightened]: [usize; 2]) {
    let (mut ratios, mut random) = (Ratios::default(), Random::new(22));
    let [mut tubes, mut tightened] = [0; 2];
    for round in 0..effort(rounds) {
        let dimension = 2 + round % 2;
        let points = 2 + random.below(6) + usize::from(dimension == 3);
        let change = [0.1, 0.5, 1e-6][random.below(3)];
        let problem = random_problem(&mut random, dimension, points, change);
        let alpha = [0.05, 0.1, 0.2, 0.4][random.below(4)];
        let how = (alpha, [f64::INFINITY, 1e-2][random.below(2)]);
        let Some(case) = every_other_disguised(round, problem, &mut random) else {
            continue;
        };
        let counts = check_problem(&case, how, (8, 4), &mut random, &mut ratios);
        tubes += counts[0];
        tightened += counts[1];
    }
    assert!(
        tubes > least && tightened > least_tightened,
        "{tubes} {tightened}"
    );
}

#[test]
fn reduced_proofs_hold_along_random_problems() {
    hold_along_random_problems(30, [100, 25]);
}

#[test]
#[ignore = "some seconds"]
fn reduced_proofs_hold_along_many_random_problems() {
    hold_along_random_problems(60, [200, 50]);
}

/// So many problems of mixed kinds, with so many tubes at least.
fn hold_along_problems_of_mixed_kinds(rounds: usize, least: usize) {
    let (mut ratios, mut random, mut tubes) = (Ratios::default(), Random::new(24), 0);
    for round in 0..effort(rounds) {
        let case = Case::new(mixed_problem(&mut random, 2 + round % 2));
        let alpha = [0.05, 0.1, 0.2, 0.4][random.below(4)];
        let how = (alpha, [f64::INFINITY, 1e-2][random.below(2)]);
        tubes += check_problem(&case, how, (8, 4), &mut random, &mut ratios)[0];
    }
    assert!(tubes > least, "{tubes}");
}

#[test]
fn reduced_proofs_hold_along_problems_of_mixed_kinds() {
    hold_along_problems_of_mixed_kinds(24, 60);
}

#[test]
#[ignore = "some seconds"]
fn reduced_proofs_hold_along_many_problems_of_mixed_kinds() {
    hold_along_problems_of_mixed_kinds(40, 100);
}
