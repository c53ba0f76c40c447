//! Paths with two ends in floats: both ways from the sketch, as certified runs go, and nothing claimed to be proved.

use crate::common::{QUADRANGLE, solve};
use assert_cmd::Command;
use krawl::problem::Problem;
use krawl::report::{to_summary, to_table};
use krawl::track::{EndKind, Options, Outcome, PathEnd, Solution, Space, Status, Stop, StopKind};
use serde_json::Value;

const SPACES: [Space; 2] = [Space::Full, Space::Reduced];

fn shipped(kind: &str) -> Problem {
    Problem::read(format!("problems/constraints/6p7d3a2c-{kind}.toml")).unwrap()
}

fn ends(outcome: &Outcome) -> &[PathEnd; 2] {
    match &outcome.status {
        Status::Open(ends) => ends,
        other => panic!("{other:?}"),
    }
}

/// How far two solutions are apart, in any coordinate of a point.
fn apart(one: &Solution, other: &Solution) -> f64 {
    let pairs = one
        .points
        .iter()
        .flatten()
        .zip(other.points.iter().flatten());
    pairs.fold(0.0, |max: f64, (x, y)| max.max((x.mid() - y.mid()).abs()))
}

#[test]
fn floats_go_both_ways_to_infinity_and_find_what_is_proved() {
    let problem = shipped("infinite");
    let proved = solve(&problem, &Options::certified());
    assert_eq!(proved.solutions.len(), 2);
    for space in SPACES {
        let seen = solve(&problem, &Options::float(space));
        assert_eq!(seen.space, space);
        let pairs = ends(&seen).iter().zip(ends(&proved));
        for (end, known) in pairs {
            assert_eq!(
                (end.kind, known.kind),
                (EndKind::Infinite, EndKind::Infinite)
            );
            assert!((end.t.0 - known.t.0).abs() < 1e-3, "{end:?}");
            let away = end.away.unwrap();
            assert_eq!(problem.points[away.point].name, "p3");
            assert!(away.distance.0 > 100.0);
            assert!(end.reason.contains("become parallel"), "{}", end.reason);
            assert!(end.reason.contains("ever farther as far as one can see"));
        }
        // Those behind the sketch first, as certified runs have them.
        assert_eq!(seen.solutions.len(), 2);
        for (one, other) in seen.solutions.iter().zip(&proved.solutions) {
            assert!(apart(one, other) < 1e-9);
        }
        assert_eq!(seen.solutions[1].mirror_of, Some(0));
        let (low, high) = seen.t_range;
        assert!(low < -0.6 && high > 1.24);
        // The other way round the ends change places.
        let back = solve(&problem, &Options::float(space).reversed());
        assert_eq!(ends(&back)[0].t, ends(&seen)[1].t);
        assert_eq!(ends(&back)[1].t, ends(&seen)[0].t);
        assert!(apart(&back.solutions[0], &seen.solutions[1]) < 1e-9);
    }
}

#[test]
fn nothing_of_it_is_called_proved() {
    let problem = shipped("infinite");
    let seen = solve(&problem, &Options::float(Space::Full));
    for text in [
        to_table(&problem, &seen, None),
        to_summary(&problem, &seen, None),
    ] {
        let first = text.lines().next().unwrap().to_lowercase();
        assert!(first.contains("open, observed"), "{first}");
        assert!(!text.contains("proved"), "{text}");
    }
    assert!(to_table(&problem, &seen, None).contains("not a proof"));
    for space in ["full", "reduced"] {
        let run = Command::new(env!("CARGO_BIN_EXE_krawl"))
            .args(["solve", "problems/constraints/6p7d3a2c-infinite.toml"])
            .args(["--mode", "float", "--space", space, "--json", "-"])
            .assert()
            .code(5);
        let json: Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
        assert_eq!(
            (&json["status"], &json["mode"]),
            (&"open".into(), &"float".into())
        );
        assert_eq!(json["ends"].as_array().unwrap().len(), 2);
        assert!(
            json["verdict"]
                .as_str()
                .unwrap()
                .starts_with("Open, observed")
        );
        let text = std::fs::read_to_string("docs/schema/result.schema.json").unwrap();
        let schema: Value = serde_json::from_str(&text).unwrap();
        let validator = jsonschema::validator_for(&schema).unwrap();
        assert!(validator.is_valid(&json));
    }
}

/// Certified runs prove that the length is still positive, and less than 6e-4, at t = 0.90325: it vanishes behind that.
/// Floats once told the last point before it, t = 0.8553.
#[test]
fn a_vanishing_length_is_located() {
    let problem = shipped("undefined");
    let proved = solve(&problem, &Options::certified());
    let mut places = Vec::new();
    for space in SPACES {
        for options in [
            Options::float(space),
            Options::float(space).with_max_step(0.3),
        ] {
            let seen = solve(&problem, &options);
            assert!(seen.solutions.is_empty());
            for (end, known) in ends(&seen).iter().zip(ends(&proved)) {
                assert_eq!(end.kind, EndKind::Undefined);
                assert!(
                    end.reason.contains("the length of p3-p2 goes to zero"),
                    "{}",
                    end.reason
                );
                assert!(end.t.0 <= end.t.1 && end.t.1 - end.t.0 < 1e-7);
                assert!(end.t.0 > known.t.0 && end.t.0 < known.t.0 + 2e-4, "{end:?}");
                places.push(end.t.0);
            }
        }
    }
    // By symmetry it is the same t at both ends.
    let least = places.iter().copied().fold(f64::INFINITY, f64::min);
    let most = places.iter().copied().fold(0.0, f64::max);
    assert!(most - least < 1e-7, "{places:?}");
}

/// The leg a-d has a given length, a(t) = −2t² + (2.9 − a₀ + 2) t + a₀ with a₀ = √(0.5² + 3²): its zeros are the ends.
#[test]
fn a_given_length_that_vanishes_is_located() {
    let problem = Problem::parse(QUADRANGLE, "test.toml").unwrap();
    let a0 = 9.25f64.sqrt();
    let slope = 4.9 - a0;
    let root = (slope * slope + 8.0 * a0).sqrt();
    let zeros = [(slope - root) / 4.0, (slope + root) / 4.0];
    for space in SPACES {
        let seen = solve(&problem, &Options::float(space));
        for (end, zero) in ends(&seen).iter().zip(zeros) {
            assert_eq!(end.kind, EndKind::Undefined);
            // The equations lose rank as the length vanishes: steps die when less than 1e-6 of it is left.
            assert!((end.t.0 - zero).abs() < 1e-6, "{end:?} {zero}");
            assert!(end.reason.contains("a-d"), "{}", end.reason);
        }
        assert_eq!(seen.solutions.len(), 1);
    }
}

/// b is on the line a-e and sees a and c under a right angle: where b falls on a the equation holds, and there is no angle.
#[test]
fn floats_end_where_a_vector_vanishes() {
    let problem = Problem::parse(
        r#"
        dimension = 2
        [points]
        a = [0, 0]
        e = [4, 0]
        c = [2, 2.5]
        b = [1.1, 0]
        [lines]
        l = ["a", "e"]
        [constraints]
        distances = [["a", "e", 4.2], ["a", "c", 3.3], ["c", "e", 3.1]]
        perpendicular = [["a", "b", "b", "c"]]
        on = [["b", "l"]]
        [homotopy]
        bend = ["a", "e"]
        bend_coefficient = 2
        "#,
        "test.toml",
    )
    .unwrap();
    let proved = solve(&problem, &Options::certified());
    for space in SPACES {
        let seen = solve(&problem, &Options::float(space));
        for (end, known) in ends(&seen).iter().zip(ends(&proved)) {
            assert_eq!(
                (end.kind, known.kind),
                (EndKind::Undefined, EndKind::Undefined)
            );
            assert!((end.t.0 - 1.0).abs() < 1e-6, "{end:?}");
        }
        assert_eq!(seen.solutions.len(), proved.solutions.len());
        for (one, other) in seen.solutions.iter().zip(&proved.solutions) {
            assert!(apart(one, other) < 1e-8);
        }
    }
}

/// A run that is told to stop stops, and says of the other way what it saw.
#[test]
fn limits_are_no_ends() {
    let problem = shipped("infinite");
    for (most, seen_end) in [(10, false), (40, true)] {
        let options = Options {
            max_steps: most,
            ..Options::float(Space::Full)
        };
        let outcome = solve(&problem, &options);
        let Status::Stopped(Stop { kind, text }) = &outcome.status else {
            // Which way is shorter is not known beforehand.
            panic!("{:?}", outcome.status);
        };
        assert_eq!(*kind, StopKind::Limit);
        assert_eq!(text.contains("the path has an end"), seen_end, "{text}");
    }
}

/// Circles about one centre, as they should be: t goes on without end, and floats do not follow it to the limit of steps.
#[test]
fn where_nothing_moves_t_goes_on() {
    let problem = Problem::parse(
        "dimension = 2\n[points]\na = [0, 0]\n[circles]\nc = { center = \"a\", radius = 3 }\nd = { center = \"a\", radius = 4 }\n\
         [constraints]\nfixed = [\"a\"]\nradii = [[\"c\", 3]]\ndistances = [[\"c\", \"d\", 1]]\n",
        "rings.toml",
    )
    .unwrap();
    for space in SPACES {
        let outcome = solve(&problem, &Options::float(space));
        let [behind, ahead] = ends(&outcome);
        assert_eq!(
            (behind.kind, ahead.kind),
            (EndKind::Infinite, EndKind::Infinite)
        );
        assert!(
            behind.t.1 < -1e10 && ahead.t.0 > 1e10,
            "{behind:?} {ahead:?}"
        );
        assert_eq!(outcome.solutions.len(), 1);
        assert!(outcome.steps < 1000, "{}", outcome.steps);
    }
}
