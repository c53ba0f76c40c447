//! Certificates of motions: verified as they are written, about the figure that moves, refused where they are damaged.

use crate::common::certificate::{Certificate, of_motion};
use krawl::certificate::{Ending, Outcome, Record, Settings, Verdict, verify};
use krawl::problem::Problem;

const SLIDER: &str = r#"
    name = "slider-crank"
    dimension = 2
    [points]
    O = [0, 0]
    P = [1, 0]
    B = [0.6, 0.8]
    S = [3.5, 0]
    [constraints]
    fixed = ["O", "P"]
    y = [["S", 0]]
    distances = [["O", "B", 1], ["B", "S", 3]]
"#;

/// It stops where it is folded flat.
const PARALLELOGRAM: &str = r#"
    name = "parallelogram"
    dimension = 2
    [points]
    A = [0, 0]
    D = [2.5, 0]
    B = [0.81045345880221, 1.2622064772118448]
    C = [3.31045345880221, 1.2622064772118448]
    [constraints]
    distances = [["A", "D", 2.5], ["A", "B", 1.5], ["B", "C", 2.5], ["C", "D", 1.5]]
"#;

fn check(bytes: &[u8]) -> Verdict {
    verify(bytes, &Settings::default(), &mut |_| ()).unwrap()
}

fn read(text: &str) -> Problem {
    Problem::parse_loosely(text, "motion.toml").unwrap()
}

#[test]
fn motions_are_verified() {
    let crank = std::fs::read_to_string("problems/mechanisms/crank.toml").unwrap();
    let slider = std::fs::read_to_string("docs/examples/slider-crank.toml").unwrap();
    let cases: [(&str, &[&str], bool); 4] = [
        (&crank, &["turns:D-A-B"], true),
        (&slider, &["turns:O"], true),
        (SLIDER, &[], true),
        (PARALLELOGRAM, &[], false),
    ];
    for (text, free, is_loop) in cases {
        let problem = read(text);
        let (motion, bytes) = of_motion(&problem, free);
        assert_eq!((motion.is_loop(), motion.is_told()), (is_loop, true));
        let verdict = check(&bytes);
        assert_eq!(verdict.outcome, Outcome::Verified, "{text}");
        assert_eq!(verdict.is_open, !is_loop);
        let (missing, _) = verdict.is_motion_of(&problem).unwrap();
        assert_eq!(missing, free);
        // A figure with one length changed is another one.
        let mut other = problem.clone();
        match other.distances.first_mut() {
            Some(distance) => {
                distance.target = krawl::problem::Target::Length("1.75".parse().unwrap())
            }
            None => other.points[1].name += "x",
        }
        assert!(
            verdict
                .is_motion_of(&other)
                .is_none_or(|(missing, _)| missing.len() > free.len())
        );
        assert!(!verdict.is_about(&problem));
        // Distances mean the same wherever they are drawn, other constraints need not.
        let mut other = problem.clone();
        other.points[1].sketch[1] = "0.0625".parse().unwrap();
        let off = verdict.is_motion_of(&other).map(|(_, off)| off);
        assert_eq!(off.is_some(), verdict.problem.is_distances_only());
        assert!(off.is_none_or(|off| off > 0.06 && off < 0.07), "{off:?}");
    }
}

/// What is led elsewhere, begins elsewhere or does not come back is not verified.
#[test]
fn damaged_motions_are_refused() {
    let problem = Problem::read("problems/mechanisms/four-bar.toml").unwrap();
    let good = Certificate::read(&of_motion(&problem, &["B-D"]).1);
    let is_motion = |record: &Record| matches!(record, Record::Motion(_));
    let at = good.records.iter().position(is_motion).unwrap();
    let motion = |c: &mut Certificate, change: &dyn Fn(&mut krawl::certificate::ArcClaim)| {
        let Record::Motion(claim) = &mut c.records[at] else {
            panic!("a motion");
        };
        change(claim);
    };
    let refused = |damage: &dyn Fn(&mut Certificate)| {
        let mut bad = good.clone();
        damage(&mut bad);
        bad.recount();
        let verdict = verify(&bad.bytes()[..], &Settings::default(), &mut |_| ());
        assert!(
            verdict.is_err()
                || verdict.is_ok_and(|v| {
                    matches!(v.outcome, Outcome::Refuted(_) | Outcome::NotProved(_))
                })
        );
    };
    assert_eq!(check(&good.bytes()).outcome, Outcome::Verified);
    refused(&|c| motion(c, &|claim| claim.dimensions[0].1 = "5.9".parse().unwrap()));
    refused(&|c| motion(c, &|claim| claim.dimensions[0].0 = 0));
    refused(&|c| motion(c, &|claim| claim.dimensions.clear()));
    refused(&|c| motion(c, &|claim| claim.kept.push((vec![0, 1, 2], true))));
    // Two that are led, a motion first that leads none, another edit before it.
    refused(&|c| {
        motion(c, &|claim| {
            claim.dimensions.push((1, "4.1".parse().unwrap()))
        })
    });
    refused(&|c| {
        motion(c, &|claim| claim.dimensions.clear());
        c.records.drain(..at).for_each(drop);
    });
    refused(&|c| {
        let Record::Arc(claim) = &mut c.records[0] else {
            panic!("the way to its dimensions");
        };
        claim.dimensions.push((0, "3.1".parse().unwrap()));
    });
    // Without the way to its dimensions the sketch is no figure of it.
    refused(&|c| c.records.drain(..at).for_each(drop));
    refused(&|c| c.records.swap(at, at - 1));
    for gone in [1, 3, good.tubes() - 1] {
        refused(&|c| c.keep_tubes(|k| k != gone));
    }
    // Half of the loop is none.
    refused(&|c| c.keep_tubes(|k| k < good.tubes() / 2));
    refused(&|c| {
        let Some(Record::End(end)) = c.records.last_mut() else {
            panic!("an end");
        };
        end.ending = Ending::Open([String::new(), String::new()]);
    });
}
