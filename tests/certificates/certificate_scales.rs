//! Closed means verified: the certificate of every closed run passes the checker, in whatever unit of
//! length a problem is written, whatever the bend, and however near the path comes to a singular place.

use crate::common::hard::families;
use crate::common::moves::scaled;
use crate::common::random::{recipe, same_each_time};
use krawl::certificate::{Outcome, Settings, verify};
use krawl::problem::Problem;
use krawl::rational::Rational;
use krawl::track::{Options, Status};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

/// What became of the runs of a test.
#[derive(Debug, Default)]
struct Tally {
    closed: usize,
    stopped: usize,
    faults: Vec<String>,
}

impl Tally {
    fn add(&mut self, what: &str, problem: &Problem) {
        let options = Options {
            max_steps: 5000,
            ..Options::certified()
        };
        let (run, bytes) = crate::common::certificate::of(problem, &options);
        let verdict = verify(&bytes[..], &Settings::default(), &mut |_| ()).unwrap();
        let right = match &run.status {
            Status::Open(_) => panic!("distances alone have no open paths"),
            Status::Closed => {
                self.closed += 1;
                verdict.outcome == Outcome::Verified
                    && verdict.solutions.len() == run.solutions.len()
            }
            Status::Stopped(_) => {
                self.stopped += 1;
                matches!(verdict.outcome, Outcome::Partial(_))
            }
        };
        if !right {
            self.faults.push(format!(
                "{what}: run {:?}, {} solutions, {:?}; verdict {:?}, {} solutions, {} tubes",
                run.status,
                run.solutions.len(),
                run.switched_on,
                verdict.outcome,
                verdict.solutions.len(),
                verdict.tubes
            ));
        }
    }

    /// Prints it, and fails if there is a fault, or if too few runs closed to say anything.
    fn conclude(&self, what: &str, least_closed: usize) {
        println!("{what}: {} closed, {} stopped", self.closed, self.stopped);
        assert!(
            self.faults.is_empty(),
            "{what}:\n{}",
            self.faults.join("\n")
        );
        assert!(self.closed >= least_closed, "{what}: {self:?}");
    }
}

/// A power of ten.
fn ten_to(exponent: i32) -> Rational {
    let ten = Rational::from_integer(10.into());
    match exponent < 0 {
        true => (0..-exponent).fold(Rational::from_integer(1.into()), |x, _| x / &ten),
        false => (0..exponent).fold(Rational::from_integer(1.into()), |x, _| x * &ten),
    }
}

/// In another unit, the bend's coefficient as it was: in the homotopy's own unit it is then the larger
/// the smaller the figure.
fn resized(problem: &Problem, exponent: i32) -> Problem {
    let mut other = scaled(problem, &ten_to(exponent));
    other.homotopy.bend_coefficient = problem.homotopy.bend_coefficient.clone();
    other
}

#[test]
fn at_every_scale() {
    let mut tally = Tally::default();
    for name in ["octahedron", "dodecagon", "k33", "prism", "disulfide"] {
        let problem = crate::common::shipped(name);
        for exponent in [-8, -6, -4, -3, -2, -1, 1, 2, 3, 4, 6, 8] {
            tally.add(
                &format!("{name} × 1e{exponent}"),
                &resized(&problem, exponent),
            );
        }
    }
    tally.conclude("scales", 40);
}

#[test]
fn with_every_bend() {
    let mut tally = Tally::default();
    for name in ["octahedron", "dodecagon", "k33", "prism"] {
        for bend in ["30000", "1e6", "-1e4", "100", "0.01", "0"] {
            let mut problem = crate::common::shipped(name);
            problem.homotopy.bend_coefficient = bend.parse().unwrap();
            tally.add(&format!("{name}, c = {bend}"), &problem);
        }
    }
    tally.conclude("bends", 12);
}

#[test]
fn of_random_problems_at_random_scales() {
    let tally = std::cell::RefCell::new(Tally::default());
    for dimension in [2, 3] {
        let config = Config {
            failure_persistence: None,
            ..Config::with_cases(60)
        };
        let mut runner = TestRunner::new_with_rng(config, same_each_time());
        let any = (recipe(dimension, 4..=7), -8i32..=8, any::<bool>());
        let run = runner.run(&any, |(recipe, exponent, with_bend)| {
            if let Ok(problem) = recipe.build() {
                let problem = match with_bend {
                    true => scaled(&problem, &ten_to(exponent)),
                    false => resized(&problem, exponent),
                };
                let what = format!("× 1e{exponent}, {with_bend}:\n{}", problem.to_toml());
                tally.borrow_mut().add(&what, &problem);
            }
            Ok(())
        });
        run.unwrap();
    }
    tally.borrow().conclude("random problems", 60);
}

/// Every so many-th of the nine first members of each family, from another one on in each.
fn of_families(stride: usize, least_closed: usize) {
    let mut tally = Tally::default();
    for (number, family) in families().enumerate() {
        for k in (1..=9).skip(number % stride).step_by(stride) {
            let problem = family.problem(k);
            tally.add(&problem.name, &problem);
        }
    }
    tally.conclude("families", least_closed);
}

#[test]
fn of_paths_that_narrowly_miss_a_singular_place() {
    of_families(3, 20);
}

#[test]
#[ignore = "a quarter of a minute"]
fn of_all_paths_that_narrowly_miss_a_singular_place() {
    of_families(1, 60);
}
