//! Edits against the truth by fine steps.

use crate::common::edits::{Case, Random, Truth, case, invariants, lengths, truth};
use assert_cmd::Command;
use krawl::edit::{Edited, Ending, OpenError, Session, Setting};
use krawl::problem::Problem;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;

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

const FOUR_BAR: &str = "problems/mechanisms/four-bar.toml";

fn krawl() -> Command {
    Command::new(env!("CARGO_BIN_EXE_krawl"))
}

/// The JSON of an edit of the four-bar linkage, which must end with this exit code.
fn edit_four_bar(set: &str, code: i32) -> Value {
    let run = krawl()
        .args(["edit", FOUR_BAR, "--set", set, "--json", "-"])
        .assert()
        .code(code)
        .get_output()
        .clone();
    serde_json::from_slice(&run.stdout).unwrap()
}

#[test]
fn exit_codes_and_json_tell_how_it_ended() {
    let reached = edit_four_bar("B-D=4.5", 0);
    assert_eq!(reached["status"], "reached");
    assert_eq!(reached["t"], serde_json::json!([1.0, 1.0]));
    assert_eq!(reached["dimensions"]["B-D"], serde_json::json!([4.5, 4.5]));
    assert_eq!(reached["points"]["C"].as_array().unwrap().len(), 2);
    assert_eq!(reached["kept"].as_array().unwrap().len(), 8);
    assert_eq!(reached["limit"], Value::Null);

    // The names' order does not matter. B, C and D are on one line where B-D is 2.5 + 3.5, A, B and D where it
    // is 5 − 3.
    for (set, value, flat) in [
        ("D-B=7", 6.0, ["B", "C", "D"]),
        ("B-D=1", 2.0, ["A", "B", "D"]),
    ] {
        let limit = edit_four_bar(set, 3);
        assert_eq!(limit["status"], "limit");
        let (lo, hi) = (
            &limit["dimensions"]["B-D"][0],
            &limit["dimensions"]["B-D"][1],
        );
        let (lo, hi) = (lo.as_f64().unwrap(), hi.as_f64().unwrap());
        assert!(lo <= value && value <= hi && hi - lo < 1e-12, "{lo} {hi}");
        let mut found: Vec<&str> = limit["limit"]["flat"][0]
            .as_array()
            .unwrap()
            .iter()
            .map(|name| name.as_str().unwrap())
            .collect();
        found.sort_unstable();
        assert_eq!(found, flat);
    }
}

#[test]
fn the_users_file_is_written_in_the_users_way() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.toml");
    let set = [
        "edit", FOUR_BAR, "--set", "B-D=4.5", "--set", "B-P=1.9", "--quiet", "--out",
    ];
    krawl().args(set).arg(&file).assert().code(0).stdout("");
    let (old, new) = (
        fs::read_to_string(FOUR_BAR).unwrap(),
        fs::read_to_string(&file).unwrap(),
    );
    let other = old.lines().zip(new.lines()).filter(|(old, new)| old != new);
    // The first point stays, and the second one to the last digit or so.
    assert!((3..=6).contains(&other.count()), "{new}");
    assert!(new.contains("A = [0.0, 0.0]\n") && new.contains("[\"B\", \"D\", 4.5]"));
    assert_eq!(old.lines().count(), new.lines().count());
    let session = Session::open(&Problem::read(&file).unwrap()).unwrap();
    assert!(session.moved().distance < 1e-13);

    // Nothing is written where nothing was reached.
    let file = folder.path().join("none.toml");
    let set = ["edit", FOUR_BAR, "--set", "B-D=7", "--quiet", "--out"];
    krawl().args(set).arg(&file).assert().code(3);
    assert!(!file.exists());
}

#[test]
fn bad_settings_are_bad_input() {
    for (set, said) in [
        ("B-E=4", "there is no dimension `B-E`; there are A-D, A-B"),
        ("B-D", "write NAME=VALUE, such as A-D=5.2"),
        ("B-D=0", "a length must be greater than 0"),
        ("B-D=-1", "a length must be greater than 0"),
        ("B-D=x", "is not a decimal number"),
    ] {
        let run = krawl()
            .args(["edit", FOUR_BAR, "--set", set])
            .assert()
            .code(2);
        let message = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert!(
            message.contains(said) && message.contains(FOUR_BAR),
            "{message}"
        );
    }
    // A constraint is named in sentences with a space behind its kind.
    let bracket = Problem::read("docs/examples/bracket.toml").unwrap();
    for name in ["radii:hole", "radii: hole", "hole"] {
        let found = Setting::find(&bracket, name).unwrap();
        assert_eq!(bracket.dimension_name(found), "radii:hole");
    }
    let twice = ["edit", FOUR_BAR, "--set", "B-D=4", "--set", "D-B=5"];
    krawl().args(twice).assert().code(2);
}

/// A figure with its dimensions, to be edited.
fn open(
    points: &[(&str, [&str; 2])],
    lengths: &[(&str, &str, &str)],
) -> Result<Session, OpenError> {
    let mut problem = Problem::build("figure", 2);
    for (name, place) in points {
        problem = problem.point(name, *place);
    }
    for (a, b, length) in lengths {
        problem = problem.distance(a, b, *length);
    }
    Session::open(&problem.finish().unwrap())
}

#[test]
fn a_sketch_too_far_from_its_dimensions_is_refused() {
    // No triangle has these sides.
    let refused = open(
        &[("a", ["0", "0"]), ("b", ["4", "0"]), ("c", ["0", "3"])],
        &[("a", "b", "9"), ("b", "c", "5"), ("c", "a", "3")],
    );
    let message = refused.unwrap_err().to_string();
    assert!(message.contains("comes to a limit"), "{message}");
}

#[test]
fn branches_that_meet_are_no_continuation() {
    // A kite: where a-c grows to 2 both triangles collapse at once.
    let mut kite = open(
        &[
            ("a", ["0", "0"]),
            ("b", ["0.6", "0.8"]),
            ("c", ["1.2", "0"]),
            ("d", ["0.6", "-0.8"]),
        ],
        &[
            ("a", "b", "1"),
            ("b", "c", "1"),
            ("c", "d", "1"),
            ("d", "a", "1"),
            ("a", "c", "1.2"),
        ],
    )
    .unwrap();
    let problem = kite.problem().clone();
    let set = |text: &str| [Setting::parse(&problem, text).unwrap()];
    let edited = kite.edit(&set("a-c=2.5"));
    assert!(
        matches!(edited.ending, Ending::Passes(_)),
        "{:?}",
        edited.ending
    );
    let value = edited.dimensions[0].value;
    assert!(value.inf() <= 2.0 && value.sup() > 1.999, "{value:?}");
    // The figure has not changed, and other edits go on.
    assert!(kite.length(4).contains(1.2));
    assert_eq!(kite.edit(&set("a-c=1.9")).ending, Ending::Reached);
}

#[test]
fn a_new_length_at_the_very_limit_is_the_limit() {
    let mut triangle = open(
        &[("a", ["0", "0"]), ("b", ["4", "0"]), ("c", ["0", "3"])],
        &[("a", "b", "4"), ("b", "c", "5"), ("c", "a", "3")],
    )
    .unwrap();
    let problem = triangle.problem().clone();
    let edited = triangle.edit(&[Setting::parse(&problem, "a-b=8").unwrap()]);
    assert!(
        matches!(edited.ending, Ending::Limit(_)),
        "{:?}",
        edited.ending
    );
    assert!(edited.t.0 <= 1.0 && edited.t.1 >= 1.0);
    // A hair before it is reached, a hair behind it is not.
    let before = triangle.probe(
        &[Setting::parse(&problem, "a-b=7.999999999").unwrap()],
        &mut krawl::track::Control::default(),
    );
    assert_eq!(before.ending, Ending::Reached);
    let behind = triangle.edit(&[Setting::parse(&problem, "a-b=8.000000001").unwrap()]);
    assert!(matches!(behind.ending, Ending::Limit(_)));
    assert!(behind.t.1 < 1.0);
}

#[test]
fn the_way_does_not_matter() {
    // There and back again, in one step or in many, is the same figure.
    let problem = Problem::read(FOUR_BAR).unwrap();
    let mut session = Session::open(&problem).unwrap();
    let set = |text: &str| [Setting::parse(&problem, text).unwrap()];
    let first = session.points();
    for length in ["4.3", "5.9", "4.1", "2.2", "3.7", "4"] {
        let edited = session.edit(&set(&format!("B-D={length}")));
        assert_eq!(edited.ending, Ending::Reached);
    }
    for (one, other) in first
        .iter()
        .flatten()
        .zip(session.points().iter().flatten())
    {
        assert!(!one.intersection(*other).is_empty(), "{one:?} {other:?}");
    }
    // An edit to what it is already.
    let edited = session.edit(&set("B-D=4"));
    assert_eq!((edited.ending, edited.tubes), (Ending::Reached, 1));
}

/// A triangle with two sides and the angle between them, up to motions: the third side is known in closed form.
#[test]
fn an_angle_of_a_figure_up_to_motions_can_be_edited() {
    let triangle = Problem::build("triangle", 2)
        .point("a", [4, 0])
        .point("b", [0, 0])
        .point("c", [0, 3])
        .distance("a", "b", 4)
        .distance("b", "c", 3)
        .dimension("angles", ["a", "b", "c"], 90)
        .finish()
        .unwrap();
    let mut session = Session::open(&triangle).unwrap();
    let apart = |points: &[[krawl::interval::Interval; 3]]| {
        let d: [_; 2] = [0, 1].map(|k| points[0][k] - points[2][k]);
        d[0].sqr() + d[1].sqr()
    };
    for degrees in ["60", "120", "35.5", "90"] {
        let setting = Setting::parse(&triangle, &format!("a-b-c={degrees}")).unwrap();
        let edited = session.edit(&[setting]);
        assert_eq!(edited.ending, Ending::Reached, "{edited:?}");
        let cosine = degrees.parse::<f64>().unwrap().to_radians().cos();
        let wanted = 25.0 - 24.0 * cosine;
        let squared = apart(&edited.points);
        assert!((squared.mid() - wanted).abs() < 1e-12 && squared.wid() < 1e-11);
        assert_eq!(edited.orientations.kept.len(), 1, "{edited:?}");
    }
    // A side and the angle at once; what is not reached changes nothing.
    let both = ["a-b=5", "angles:a-b-c=45"].map(|text| Setting::parse(&triangle, text).unwrap());
    let edited = session.probe(&both, &mut krawl::track::Control::default());
    assert_eq!(edited.ending, Ending::Reached);
    assert!((apart(&edited.points).mid() - (34.0 - 15.0 * 2f64.sqrt())).abs() < 1e-12);
    assert!((session.length(2).mid() - 90.0).abs() < 1e-12);
}

/// With a third side given instead of the second, the angle at c has a limit: where a is in the way of no circle any more.
#[test]
fn the_limit_of_an_angle_is_enclosed() {
    let triangle = Problem::build("triangle", 2)
        .point("a", [4, 0])
        .point("b", [0, 0])
        .point("c", [4, 3])
        .distance("a", "b", 4)
        .distance("a", "c", 3)
        .dimension(
            "angles",
            ["a", "b", "c"],
            "36.86989764584402"
                .parse::<krawl::problem::Decimal>()
                .unwrap(),
        )
        .finish()
        .unwrap();
    let mut session = Session::open(&triangle).unwrap();
    let setting = Setting::parse(&triangle, "a-b-c=80").unwrap();
    let edited = session.edit(&[setting]);
    let Ending::Limit(_) = &edited.ending else {
        panic!("{edited:?}")
    };
    // The sine is at most 3/4.
    let most = 0.75f64.asin().to_degrees();
    let value = edited.dimensions[0].value;
    assert!(
        (value.mid() - most).abs() < 1e-9 && value.wid() < 1e-9,
        "{value:?} {most}"
    );
}

/// Two lines become parallel on the way and their point runs away: the reason names it, after few tubes, in both frames.
#[test]
fn a_figure_that_grows_without_end_is_named() {
    for frame in ["", "fixed = [\"a\"]\nhorizontal = [[\"a\", \"b\"]]\n"] {
        for scale in ["e-5", "", "e5"] {
            let text = format!(
                "dimension = 2\n[points]\na = [0, 0]\nb = [4{scale}, 0]\nc = [2{scale}, 3.4{scale}]\n[constraints]\n\
                 {frame}distances = [[\"a\", \"b\", 4{scale}]]\nangles = [[\"b\", \"a\", \"c\", 60], [\"a\", \"b\", \"c\", 60]]\n"
            );
            let problem = Problem::parse(&text, "test.toml").unwrap();
            let mut session = Session::open(&problem).unwrap();
            let edited = session.edit(&[Setting::parse(&problem, "a-b-c=130").unwrap()]);
            let Ending::Stopped(reason) = &edited.ending else {
                panic!("{edited:?}")
            };
            assert!(reason.contains("grow without end: c is"), "{reason}");
            assert!(edited.tubes < 100, "{}", edited.tubes);
            // Parallel at 120 degrees.
            let angle = edited.dimensions[0].value;
            assert!(angle.sup() < 120.0 && angle.inf() > 117.0, "{angle:?}");
            // Beside that all is reached.
            let edited = session.edit(&[Setting::parse(&problem, "a-b-c=119.9").unwrap()]);
            assert_eq!(edited.ending, Ending::Reached);
            let edited = session.edit(&[Setting::parse(&problem, "a-b-c=30").unwrap()]);
            assert_eq!(edited.ending, Ending::Reached);
        }
    }
}

/// For a profiler: prints a digest of all results, which a change for speed must not change. `KRAWL_EDIT_COST` is the
/// dimension, the number of points and how often each edit is done that is reached.
#[test]
#[ignore = "for a profiler"]
fn cost() {
    let text = std::env::var("KRAWL_EDIT_COST").unwrap_or("3 12 5".to_owned());
    let [dimension, points, times] = text
        .split(' ')
        .map(|n| n.parse().unwrap())
        .collect::<Vec<usize>>()[..]
    else {
        panic!("three numbers")
    };
    let (mut random, mut digest) = (Random(4), 0u64);
    let mut counts = [0; 4];
    for _ in 0..60 {
        let case = case(&mut random, dimension, points, (0.95, 1.05));
        let setting = Setting::new(&case.problem, case.index, case.length.parse().unwrap());
        let setting = [setting.unwrap()];
        let mut session = Session::open(&case.problem).unwrap();
        for _ in 0..times {
            let edited = session.probe(&setting, &mut krawl::track::Control::default());
            for x in edited.points.iter().flatten() {
                for bits in [x.inf().to_bits(), x.sup().to_bits()] {
                    digest = digest.rotate_left(7) ^ bits.wrapping_mul(0x9e37_79b9_7f4a_7c15);
                }
            }
            let kept = edited.orientations.kept.len() + 1000 * edited.tubes;
            digest = digest.rotate_left(7) ^ kept as u64;
            counts[["reached", "limit", "passes", "stopped"]
                .iter()
                .position(|name| *name == edited.ending.name())
                .unwrap()] += 1;
            if edited.ending != Ending::Reached {
                break;
            }
        }
    }
    println!("digest {digest:016x}, reached, limit, passes, stopped: {counts:?}");
}

/// The range of an angle goes up to nearly 180 degrees, from wherever it is.
#[test]
fn the_range_of_an_angle_stays_below_180_degrees() {
    for degrees in ["1", "53", "145", "179", "179.9999"] {
        let text = format!(
            "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [{}, {}]\n[constraints]\n\
             distances = [[\"a\", \"b\", 4], [\"a\", \"c\", 3]]\nangles = [[\"b\", \"a\", \"c\", {degrees}]]\n",
            3.0 * degrees.parse::<f64>().unwrap().to_radians().cos(),
            3.0 * degrees.parse::<f64>().unwrap().to_radians().sin(),
        );
        let problem = Problem::parse(&text, "test.toml").unwrap();
        let mut session = Session::open(&problem).unwrap();
        let range = session.range(2, &mut krawl::track::Control::default());
        let (low, high) = (range.low.value(), range.high.value());
        let now: f64 = degrees.parse().unwrap();
        for end in [&range.low, &range.high] {
            assert!(
                matches!(end, krawl::edit::End::Beyond(_)),
                "{degrees}: {end:?}"
            );
        }
        assert!(
            low.sup() < 0.01 * now
                && high.inf() > 180.0 - 0.01 * (180.0 - now)
                && high.sup() < 180.0
        );
    }
}

/// The right-hand side of an angle between two bars has degree 3 in t where both lengths and the angle are led at once, and
/// less where some are not: a session takes both kinds in turn.
#[test]
fn two_lengths_and_the_angle_between_them_are_led_together() {
    let text = r#"
        name = "corner"
        dimension = 2
        [points]
        a = [0, 0]
        b = [3, 0]
        c = [3, 4]
        d = [5, 5]
        [constraints]
        horizontal = [["a", "b"]]
        distances = [["a", "b", 3], ["b", "c", 4], ["c", "d", 2.2], ["a", "d", 7]]
        angles = [["a", "b", "c", 90]]
    "#;
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("corner.toml");
    fs::write(&file, text).unwrap();
    for settings in [&["b-c=4.2"][..], &["a-b=3.3", "b-c=4.5", "angles:a-b-c=80"]] {
        let mut command = Command::cargo_bin("krawl").unwrap();
        command
            .arg("edit")
            .arg(&file)
            .args(["--json", "-", "--quiet"]);
        for setting in settings {
            command.args(["--set", setting]);
        }
        // Reached, proved.
        command.assert().code(0);
    }
}
