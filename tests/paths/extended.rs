//! Extended precision: it comes on where 53 bits do not suffice, says so, and changes nothing elsewhere.

use crate::common::boxes::check;
use crate::common::hard::{Answer, families};
use crate::common::{shipped, solve};
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

/// Closed means verified, for tubes in extended precision too: also where t comes within 1e-24 of 1 at a fold, which the bounds
/// of a tube as long as the path's do not tell from 1.
#[test]
fn certificates_are_verified() {
    let mut tried = 0;
    let mut check = |name: &str, k: i32| {
        let problem = families().find(|f| f.name == name).unwrap().problem(k);
        let (outcome, checked) = checked(&problem);
        assert_eq!(
            checked,
            Checked::Verified,
            "{name}-{k}: {:?}",
            words(&outcome)
        );
        tried += 1;
    };
    for name in ["fold", "fold-missed", "peak"] {
        (4..=12).for_each(|k| check(name, k));
    }
    for name in ["flaps-apart", "flaps-split", "tents-apart", "tents-split"] {
        (6..=11).for_each(|k| check(name, k));
    }
    for name in [
        "parallelogram-crank",
        "parallelogram-coupler",
        "graze",
        "graze-stopped",
    ] {
        (6..=10).for_each(|k| check(name, k));
    }
    check("crowd", 7);
    check("lengths", 3);
    assert!(tried > 70, "{tried}");
}
