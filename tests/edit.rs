//! Edits against the truth by fine steps.

mod common;

use common::edits::{Case, Random, Truth, case, invariants, lengths, truth};
use krawl::edit::{Edited, Ending, Session, Setting};
use std::collections::BTreeMap;

fn flat(points: &[[krawl::interval::Interval; 3]], dimension: usize) -> Vec<f64> {
    let places = points.iter().map(|p| &p[..dimension]);
    places.flatten().map(|x| x.mid()).collect()
}

/// What krawl says of a case, and what fine steps say.
fn both(case: &Case) -> (Edited, Truth) {
    let mut session = Session::open(&case.problem).unwrap();
    assert_eq!(session.moved().tubes, 0, "the sketch meets its dimensions");
    let setting = Setting::new(&case.problem, case.index, case.length.parse().unwrap()).unwrap();
    let edited = session.edit(&[setting]);
    let from = lengths(&case.problem);
    let mut to = from.clone();
    to[case.index] = case.length.parse().unwrap();
    (edited, truth(&case.problem, &from, &to))
}

fn compare(cases: usize, seed: u64, dimension: usize) -> BTreeMap<&'static str, usize> {
    let mut random = Random(seed);
    let mut counts = BTreeMap::new();
    for _ in 0..cases {
        let points = 5 + random.below(8);
        let case = case(&mut random, dimension, points, (0.7, 1.4));
        let (edited, truth) = both(&case);
        *counts.entry(edited.ending.name()).or_default() += 1;
        let about = || {
            let name = case.problem.distance_name(case.index);
            format!(
                "--set {name}={}\n{}{edited:?}",
                case.length,
                case.problem.to_toml()
            )
        };
        match (&edited.ending, truth) {
            (Ending::Reached, Truth::Reached(x)) => {
                let found = invariants(dimension, &flat(&edited.points, dimension));
                let wanted = invariants(dimension, &x);
                let off = found.iter().zip(&wanted).map(|(a, b)| (a - b).abs());
                assert!(off.fold(0.0, f64::max) < 1e-7, "{}", about());
                // What is kept has the same sign in both.
                for (points, sign) in &edited.orientations.kept {
                    let at = |p: usize, k: usize| x[p * dimension + k];
                    let side = |p: usize, k: usize| at(points[p], k) - at(points[0], k);
                    let value = if dimension == 2 {
                        side(1, 0) * side(2, 1) - side(1, 1) * side(2, 0)
                    } else {
                        (0..3)
                            .map(|k| {
                                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                                side(1, k) * (side(2, i) * side(3, j) - side(2, j) * side(3, i))
                            })
                            .sum()
                    };
                    assert_eq!(value > 0.0, *sign > 0, "{points:?} {}", about());
                }
            }
            (Ending::Limit(_), Truth::Folded(t)) => {
                let (lo, hi) = edited.t;
                assert!(t <= hi + 1e-9 && t > lo - 1e-5, "{t} {}", about());
                assert!(hi - lo < 1e-9, "{}", about());
            }
            (Ending::Passes(_) | Ending::Stopped(_), _) => println!("{}", about()),
            (_, truth) => panic!("{truth:?} {}", about()),
        }
    }
    counts
}

#[test]
fn edits_are_the_continuation_or_a_limit_in_the_plane() {
    let counts = compare(150, 1, 2);
    assert!(counts["reached"] > 60 && counts["limit"] > 30, "{counts:?}");
    assert_eq!(counts.len(), 2, "{counts:?}");
}

#[test]
fn edits_are_the_continuation_or_a_limit_in_space() {
    let counts = compare(60, 2, 3);
    assert!(counts["reached"] > 15 && counts["limit"] > 10, "{counts:?}");
    assert_eq!(counts.len(), 2, "{counts:?}");
}

#[test]
#[ignore = "minutes"]
fn edits_are_the_continuation_or_a_limit_many_times() {
    println!("{:?}", compare(2000, 3, 2));
    println!("{:?}", compare(1000, 4, 3));
}
