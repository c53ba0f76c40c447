//! Extended precision: it comes on where 53 bits do not suffice, says so, and changes nothing elsewhere.

mod common;

use common::boxes::check;
use common::hard::{Answer, families};
use common::{shipped, solve};
use krawl::certificate::{Outcome as Checked, Settings, Writer, verify};
use krawl::problem::Problem;
use krawl::track::{self, Control, Options, Outcome, Status};

/// What is said of extended precision.
fn words(outcome: &Outcome) -> Vec<&String> {
    let list = outcome.switched_on.iter();
    list.filter(|s| s.contains("extended precision")).collect()
}

fn without_the_clock(outcome: Outcome) -> Outcome {
    Outcome {
        seconds: 0.0,
        ..outcome
    }
}

#[test]
fn changes_nothing_where_53_bits_suffice() {
    let mut problems = ["octahedron", "disulfide", "dodecagon", "k33", "prism"]
        .map(shipped)
        .to_vec();
    for family in families() {
        problems.extend((1..=family.proved_in_53_bits.min(3)).map(|k| family.problem(k)));
    }
    let mut same = 0;
    for problem in problems {
        for options in [Options::certified(), Options::certified().reversed()] {
            let plain = solve(&problem, &options.clone().without_extended());
            if plain.status != Status::Closed {
                continue;
            }
            let outcome = solve(&problem, &options);
            assert!(words(&outcome).is_empty(), "{:?}", outcome.switched_on);
            // Every float of every box.
            let (plain, outcome) = (without_the_clock(plain), without_the_clock(outcome));
            assert_eq!(plain, outcome, "{}", problem.name);
            same += 1;
        }
    }
    assert!(same > 60, "{same}");
}

#[test]
fn reaches_further() {
    let mut further = 0;
    // The exact answer of the crowd takes seconds.
    for family in families().filter(|f| f.name != "crowd") {
        let name = family.name;
        // What 53 bits cannot do there, where that is always the same.
        let why = match name {
            "fold" | "fold-missed" | "peak" => "t = 1",
            _ => "",
        };
        for k in (family.proved_in_53_bits + 2).max(4)..=family.proved {
            let problem = family.problem(k);
            let plain = solve(&problem, &Options::certified().without_extended());
            assert_ne!(
                plain.status,
                Status::Closed,
                "{name}-{k} needs nothing more"
            );
            let outcome = solve(&problem, &Options::certified());
            assert_eq!(outcome.status, Status::Closed, "{name}-{k}");
            check(&problem, &outcome.solutions).unwrap();
            if let Answer::Path { solutions, .. } = family.answer(k) {
                assert_eq!(outcome.solutions.len(), solutions, "{name}-{k}");
            }
            let words = words(&outcome);
            assert!(!words.is_empty(), "{name}-{k}");
            assert!(
                words
                    .iter()
                    .any(|w| w.contains("tube") && w.contains(", t from "))
            );
            assert!(words.iter().any(|w| w.contains(why)), "{words:?}");
            // On where it is needed only: most tubes are in 53 bits.
            let tubes: usize = words.iter().map(|w| tubes_in(w)).sum();
            assert!(
                (1..outcome.steps).contains(&tubes),
                "{tubes} of {}",
                outcome.steps
            );
            further += 1;
        }
    }
    assert!(further > 70, "{further}");
}

/// The number before the word.
fn tubes_in(words: &str) -> usize {
    let before = words.split(" tube").next().unwrap();
    before.rsplit(' ').next().unwrap().parse().unwrap()
}

#[test]
fn stopped_runs_name_the_number() {
    for name in [
        "crossing",
        "tangent",
        "tangent-circles",
        "regular-octahedron",
    ] {
        let family = families().find(|f| f.name == name).unwrap();
        let outcome = solve(&family.problem(0), &Options::certified());
        let Status::Stopped(reason) = &outcome.status else {
            panic!("{name} closed");
        };
        assert!(reason.contains("even in extended precision"), "{reason}");
        assert!(reason.contains("e-"), "{reason}");
    }
}

/// How many certificates the checker is too coarse for.
const COARSE: usize = 4;

fn checked(problem: &Problem) -> (Outcome, Checked) {
    let mut writer = Writer::new(Vec::new(), problem);
    let mut control = Control {
        witness: Some(&mut writer),
        ..Control::default()
    };
    let outcome = track::solve(problem, &Options::certified(), &mut control).unwrap();
    assert_eq!(outcome.status, Status::Closed, "{}", problem.name);
    let bytes = writer.finish().unwrap();
    let verdict = verify(&bytes[..], &Settings::default(), &mut |_| ()).unwrap();
    (outcome, verdict.outcome)
}

/// Tubes in extended precision are proved again by the checker. Where t comes within some 1e-16 of 1 at a fold its
/// bounds, which do not tell t from the coordinates, are too coarse; it says so.
#[test]
fn certificates_are_verified() {
    let mut coarse = Vec::new();
    for name in ["fold", "fold-missed", "peak"] {
        for k in 4..=9 {
            let problem: Problem = families().find(|f| f.name == name).unwrap().problem(k);
            let (outcome, checked) = checked(&problem);
            println!("{name}-{k}: {checked:?} {:?}", words(&outcome));
            match checked {
                Checked::Verified => {}
                Checked::NotProved(_) => coarse.push(format!("{name}-{k}")),
                other => panic!("{name}-{k}: {other:?}"),
            }
        }
    }
    for name in ["flaps-apart", "tents-split", "graze", "crowd", "lengths"] {
        let family = families().find(|f| f.name == name).unwrap();
        let problem = family.problem(if name == "lengths" { 3 } else { 7 });
        let (outcome, checked) = checked(&problem);
        println!("{name}: {checked:?} {:?}", words(&outcome));
        match checked {
            Checked::Verified => {}
            Checked::NotProved(_) => coarse.push(name.to_owned()),
            other => panic!("{name}: {other:?}"),
        }
    }
    println!("{coarse:?}");
    assert!(coarse.len() <= COARSE, "{coarse:?}");
}
