//! What is proved of single tubes in the reduced space, and of their links.

use super::super::tracker::Test;
use super::disguise::every_other_disguised;
use super::precise::reduced::check_problem;
use super::precise::{Figure, Ratios, with_homotopies};
use super::*;
use crate::linalg::LANE;
use crate::places::array;
use crate::track::reduced::certified::{Bounds, COEFFICIENTS, ReducedTest};
use crate::track::{Options, Space};

pub type ReducedFrame = <ReducedTest as Test<COEFFICIENTS>>::Frame;
pub type ReducedTube = Tube<COEFFICIENTS, ReducedFrame>;

/// A proved tube, the bounds that its proof was made of, and what bounds Φ(0) row by row.
pub struct Proved {
    pub tube: ReducedTube,
    pub bounds: Bounds,
    pub defect: Vec<f64>,
}

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

pub struct Shop {
    pub equations: Equations,
    inverter: InverseMaker,
    pub test: ReducedTest,
    max_h: f64,
}

impl Shop {
    pub fn new(homotopy: &Homotopy, alpha: f64, max_h: f64) -> Self {
        let equations = Equations::new(homotopy);
        let options = Options {
            space: Space::Reduced,
            alpha,
            ..Options::certified()
        };
        Shop {
            inverter: equations.inverter(),
            test: ReducedTest::new(homotopy, &equations, &options),
            equations,
            max_h,
        }
    }

    pub fn tube(&mut self, z: &[f64], normal: &[f64], first: bool) -> Option<Proved> {
        let n = self.equations.n();
        let mut tube = Tube::new(&self.equations);
        tube.local.z[0][..n].copy_from_slice(&z[..n]);
        tube.local.normal[..n].copy_from_slice(&normal[..n]);
        let (test, equations) = (&mut self.test, &self.equations);
        test.refine(equations, &mut tube.local, 1e-9).ok()?;
        test.expand(equations, &mut tube.local).ok()?;
        if first {
            test.prepare(equations, &mut tube, self.max_h);
        }
        if !test.prove(equations, &mut tube, self.max_h) {
            return None;
        }
        let (bounds, defect) = (*test.stated(), test.defect().to_vec());
        tube.exit_at = 0.97 * tube.proof.h;
        test.enclose_exit(equations, &mut tube)?;
        test.accept(&tube);
        Some(Proved {
            tube,
            bounds,
            defect,
        })
    }

    /// Linked tubes from the sketch on, at most `count`.
    pub fn chain(&mut self, homotopy: &Homotopy, count: usize) -> Vec<Proved> {
        let first = at_sketch(homotopy, &self.equations, &mut self.inverter)
            .and_then(|local| self.tube(&local.z[0], &local.normal, true));
        let Some(first) = first else {
            return Vec::new();
        };
        let room = self.equations.vector();
        chain(
            first,
            (count, 0.85),
            room,
            |sample| &sample.tube,
            |last, z, normal| {
                let next = self.tube(z, normal, false).and_then(|mut next| {
                    next.tube.entry = last.tube.leads_to(&next.tube)?;
                    Some(next)
                });
                if next.is_none() {
                    self.test.reject();
                }
                next
            },
        )
    }
}

#[test]
fn reduced_proofs_hold_along_the_shipped_problems() {
    let (mut ratios, mut random) = (Ratios::default(), Random::new(21));
    for (problem, homotopy) in with_homotopies(shipped()) {
        for how in [(0.1, f64::INFINITY), (0.4, f64::INFINITY), (0.1, 1e-3)] {
            let given = (&problem, &homotopy);
            check_problem(given, how, (10, 6), &mut random, &mut ratios);
        }
    }
    ratios.come_near(&[("|Φ'(0)|", 0.3), ("|Φ(0)|", 0.1)]);
}

#[test]
fn reduced_proofs_hold_along_random_problems() {
    let (mut ratios, mut random) = (Ratios::default(), Random::new(22));
    let [mut tubes, mut tightened] = [0; 2];
    for round in 0..effort(60) {
        let dimension = 2 + round % 2;
        let points = 2 + random.below(6) + usize::from(dimension == 3);
        let change = [0.1, 0.5, 1e-6][random.below(3)];
        let problem = random_problem(&mut random, dimension, points, change);
        let alpha = [0.05, 0.1, 0.2, 0.4][random.below(4)];
        let how = (alpha, [f64::INFINITY, 1e-2][random.below(2)]);
        let given = every_other_disguised(round, problem, &mut random);
        let Some((problem, homotopy)) = given else {
            continue;
        };
        let given = (&problem, &homotopy);
        let counts = check_problem(given, how, (8, 4), &mut random, &mut ratios);
        tubes += counts[0];
        tightened += counts[1];
    }
    assert!(tubes > 200 && tightened > 50, "{tubes} {tightened}");
}

#[test]
fn reduced_proofs_hold_along_problems_of_mixed_kinds() {
    let (mut ratios, mut random, mut tubes) = (Ratios::default(), Random::new(24), 0);
    for round in 0..effort(40) {
        let problem = mixed_problem(&mut random, 2 + round % 2);
        let homotopy = Homotopy::new(&problem).unwrap();
        let alpha = [0.05, 0.1, 0.2, 0.4][random.below(4)];
        let how = (alpha, [f64::INFINITY, 1e-2][random.below(2)]);
        let given = (&problem, &homotopy);
        tubes += check_problem(given, how, (8, 4), &mut random, &mut ratios)[0];
    }
    assert!(tubes > 100, "{tubes}");
}

#[test]
fn false_links_are_refused_in_the_reduced_space() {
    fn sabotage(problem: &Problem, random: &mut Random, tally: &mut [usize; 4]) {
        let homotopy = Homotopy::new(problem).unwrap();
        let figure = Figure::new(problem, &homotopy);
        let mut shop = Shop::new(&homotopy, 0.1, f64::INFINITY);
        let chain = shop.chain(&homotopy, 400);
        let n = figure.n;
        let stride = (chain.len() / 20).max(1);
        for k in (0..chain.len() - 1).step_by(stride) {
            let (from, next) = (&chain[k], &chain[k + 1]);
            assert!(link_is_true(
                &figure,
                &from.tube,
                &next.tube,
                next.tube.entry
            ));
            let (z, normal) = (&next.tube.local.z[0], &next.tube.local.normal);
            let flip = |v: &[f64]| mirrored(&homotopy, v);
            let back: Vec<f64> = normal[..n].iter().map(|c| -c).collect();
            let mut others = vec![(0, z[..n].to_vec(), back), (1, flip(z), flip(normal))];
            for spread in [1e-3, 0.1, 0.5, 1.0] {
                let shifted = z[..n]
                    .iter()
                    .map(|z| z + spread * random.between(-1.0, 1.0));
                others.push((2, shifted.collect(), normal[..n].to_vec()));
            }
            for (kind, z, normal) in others {
                let Some(other) = shop.tube(&z, &normal, false) else {
                    shop.test.reject();
                    continue;
                };
                tally[kind] += 1;
                let is_linked = leads_truly(&figure, &from.tube, &other.tube);
                assert!(
                    kind != 0 || !is_linked,
                    "a link to a tube that runs backwards"
                );
            }
            let others = chain.iter();
            tally[3] += others
                .filter(|other| leads_truly(&figure, &from.tube, &other.tube))
                .count();
        }
    }
    let (mut tally, mut random) = ([0; 4], Random::new(23));
    for problem in shipped() {
        sabotage(&problem, &mut random, &mut tally)
    }
    println!("{tally:?}");
    assert!(tally.iter().all(|&count| count > 30), "{tally:?}");
}
