//! On several threads a path is followed both ways from the sketch until these meet: the theorem is the same.

use crate::common::random::problems;
use crate::common::{SHORT, shipped, solve};
use krawl::interval::Interval;
use krawl::problem::Problem;
use krawl::track::{Options, Outcome, Solution, Space, Status};

fn overlap(one: &Solution, other: &Solution) -> bool {
    let meet = |(a, b): (&Interval, &Interval)| !a.disjoint(*b);
    let entries = |s: &Solution| s.points.iter().flatten().copied().collect::<Vec<_>>();
    entries(one).iter().zip(&entries(other)).all(meet)
}

/// Whether the two ways met.
fn has_met(outcome: &Outcome) -> bool {
    outcome
        .switched_on
        .iter()
        .any(|what| what.contains("both ways"))
}

/// The same solutions in the same order, each in boxes that overlap.
fn assert_same(one: &Outcome, two: &Outcome) {
    assert_eq!(two.status, one.status);
    assert_eq!(two.solutions.len(), one.solutions.len());
    for (k, (a, b)) in one.solutions.iter().zip(&two.solutions).enumerate() {
        assert!(overlap(a, b), "solution {}", k + 1);
        assert_eq!((b.class, b.mirror_of), (a.class, a.mirror_of));
        let [a, b] = [a, b].map(|s| s.place.unwrap());
        assert_eq!(b.rising, a.rising, "solution {}", k + 1);
        // Zero folds are a claim, and so are some.
        if let (Some(a), Some(b)) = (a.folds, b.folds) {
            assert_eq!(a == 0, b == 0, "solution {}", k + 1);
            assert_eq!(a % 2, b % 2, "solution {}", k + 1);
        }
        assert!(
            (a.arc - b.arc).abs() < 1e-3 * one.length,
            "solution {}",
            k + 1
        );
    }
    // A quadrature over tubes, which are others.
    assert!(
        (one.length - two.length).abs() < 1e-3 * one.length,
        "{} and {}, {} tubes",
        one.length,
        two.length,
        one.steps
    );
}

#[test]
fn both_ways_find_what_one_way_finds() {
    let short = SHORT.into_iter().map(|(name, _)| shipped(name));
    let problems: Vec<Problem> = short.chain(problems(60)).collect();
    for problem in &problems {
        for space in [Space::Full, Space::Reduced] {
            let options = Options {
                space,
                max_steps: 20_000,
                ..Options::certified()
            };
            let one = solve(problem, &options);
            if one.status != Status::Closed {
                continue;
            }
            // Where threads meet depends on how they run, and on short paths whether they do.
            for threads in [2, 3, 0] {
                assert_same(
                    &one,
                    &solve(problem, &options.clone().with_threads(threads)),
                );
            }
        }
    }
}

/// Long enough for a second thread to begin, however busy the machine is, in one of these runs.
#[test]
fn on_long_paths_they_meet() {
    let problem = shipped("icosahedron");
    let options = Options::certified();
    let one = solve(&problem, &options);
    let met = (0..5).filter(|_| {
        let two = solve(&problem, &options.clone().with_threads(2));
        assert_same(&one, &two);
        has_met(&two)
    });
    assert!(met.count() > 0);
}

#[test]
fn the_other_direction_is_the_reverse() {
    let problem = shipped("disulfide");
    let options = Options::certified().with_threads(2);
    let ahead = solve(&problem, &options);
    let back = solve(&problem, &options.reversed());
    assert_eq!(ahead.solutions.len(), back.solutions.len());
    for (a, b) in ahead.solutions.iter().zip(back.solutions.iter().rev()) {
        assert!(overlap(a, b));
    }
}

/// What is kept in the order of the path is not kept on two threads.
#[test]
fn a_certificate_is_of_one_way() {
    let problem = shipped("k33");
    let options = Options::certified();
    let of = |options: &Options| crate::common::certificate::of(&problem, options);
    let (one, two) = (of(&options), of(&options.clone().with_threads(2)));
    assert!(!has_met(&two.0));
    assert_eq!(one.1, two.1);
}
