//! Certificates of runs in the reduced space, and of structures so large that the checker's test follows their zeros:
//! those of closed runs verify, and false claims about them do not.

use crate::common::certificate::{Certificate, of};
use krawl::certificate::{Outcome, Record, Settings, Verdict, verify};
use krawl::generate::{Family, Recipe};
use krawl::problem::Problem;
use krawl::track::{Options, Space, Status};

fn verdict(bytes: &[u8]) -> Verdict {
    verify(bytes, &Settings::default(), &mut |_| ()).unwrap()
}

fn options(space: Space) -> Options {
    Options {
        space,
        ..Options::certified()
    }
}

/// A closed run's certificate, which verifies and lists the run's solutions.
fn closed(problem: &Problem, space: Space) -> Certificate {
    let (run, bytes) = of(problem, &options(space));
    assert_eq!(run.status, Status::Closed, "{}", problem.name);
    assert_eq!(run.space, space);
    let verdict = verdict(&bytes);
    assert_eq!(verdict.outcome, Outcome::Verified, "{}", problem.name);
    assert!(verdict.is_about(problem));
    assert_eq!(verdict.solutions.len(), run.solutions.len());
    let classes: Vec<usize> = verdict.classes.iter().map(|&c| c as usize).collect();
    assert_eq!(
        classes.iter().max(),
        run.solutions.iter().map(|s| &s.class).max()
    );
    if space == Space::Reduced {
        assert!(verdict.tubes >= 2 * run.steps as u64);
    }
    Certificate::read(&bytes)
}

#[test]
fn shipped_problems_are_proved_in_the_reduced_space() {
    for name in ["octahedron", "dodecagon", "k33", "prism", "disulfide"] {
        closed(
            &Problem::read(format!("problems/{name}.toml")).unwrap(),
            Space::Reduced,
        );
    }
}

/// Of structures in the plane and in space with a hundred unknowns, in either space.
#[test]
fn large_structures_are_proved() {
    for family in [Family::Strip, Family::Tetrahedra, Family::Chain] {
        let problem = Recipe::new(family, 100).problem().unwrap();
        for space in [Space::Reduced, Space::Full] {
            closed(&problem, space);
        }
    }
}

/// What is false does not pass the test that follows the zeros either.
#[test]
fn false_claims_about_large_structures_do_not_pass() {
    let problem = Recipe::new(Family::Strip, 100).problem().unwrap();
    let good = closed(&problem, Space::Reduced);
    let is_refused = |what: &str, bad: &Certificate| {
        let outcome = verdict(&bad.bytes()).outcome;
        assert!(
            matches!(outcome, Outcome::Refuted(_) | Outcome::NotProved(_)),
            "{what}: {outcome:?}"
        );
    };
    let (tubes, solutions) = (good.tubes(), good.solutions());
    assert!(tubes > 40 && solutions > 0);
    for k in [0, 1, tubes / 2, tubes - 1] {
        for i in [0, 7, 50, 99] {
            let mut bad = good.clone();
            bad.tube_mut(k).centre[i] += 0.01;
            is_refused("a centre beside the path", &bad);
        }
        let mut bad = good.clone();
        bad.tube_mut(k).r *= 1e4;
        is_refused("a radius within which there may be more", &bad);
        let mut bad = good.clone();
        let tube = bad.tube_mut(k);
        (tube.h, tube.exit) = (30.0 * tube.h, 30.0 * tube.exit);
        is_refused("a tube that is too long", &bad);
    }
    for k in [5, tubes / 2] {
        let mut bad = good.clone();
        bad.keep_tubes(|at| !(k..k + 3).contains(&at));
        is_refused("tubes left out", &bad);
    }
    let mut bad = good.clone();
    bad.keep_tubes(|at| at + 3 < tubes);
    is_refused("a chain that does not come back", &bad);
    for k in 0..solutions {
        let mut bad = good.clone();
        let at = bad.solution_at(k);
        bad.records.remove(at);
        bad.classes_mut().pop();
        is_refused("a solution left out", &bad);
        let mut bad = good.clone();
        bad.solution_mut(k).centre[40] += 1e-3;
        is_refused("a solution moved", &bad);
    }
    let mut bad = good.clone();
    let at = bad.solution_at(0);
    let Record::Solution(mut twice) = bad.records[at].clone() else {
        unreachable!()
    };
    twice.centre[99] += 0.25;
    bad.records.insert(at, Record::Solution(twice));
    bad.classes_mut().push(solutions as u32);
    is_refused("a solution more", &bad);
}
