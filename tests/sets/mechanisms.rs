//! Ranges of dimensions, sweeps of mechanisms, streams of edits.

use assert_cmd::Command;
use krawl::edit::{End, Ending, Session};
use krawl::problem::Problem;
use krawl::track::Control;
use serde_json::Value;

fn krawl() -> Command {
    Command::new(env!("CARGO_BIN_EXE_krawl"))
}

fn open(name: &str) -> Session {
    let problem = Problem::read(format!("problems/mechanisms/{name}.toml")).unwrap();
    Session::open(&problem).unwrap()
}

#[test]
fn ranges_of_a_four_bar_linkage() {
    let mut session = open("four-bar");
    let ranges = session.ranges(&mut Control::default());
    let mut seen = 0;
    // By the triangles A B D, B C D and B C P, whose other sides stand still.
    for (name, low, high) in [
        ("B-D", 2.0, 6.0),
        ("A-D", 1.0, 7.0),
        ("A-B", 1.0, 9.0),
        ("B-C", 0.5, 4.0),
        ("C-D", 1.5, 6.5),
        ("B-P", 0.5, 4.5),
        ("C-P", 0.5, 4.5),
    ] {
        let range = ranges
            .iter()
            .find(|range| session.problem().distance_name(range.index) == name)
            .unwrap();
        for (end, wanted) in [(&range.low, low), (&range.high, high)] {
            let End::Limit(value, limit) = end else {
                panic!("{name}: {end:?}")
            };
            assert!(
                value.contains(wanted) && value.wid() < 1e-12,
                "{name} {value:?}"
            );
            assert!(!limit.flat.is_empty());
            seen += 1;
        }
    }
    assert_eq!(seen, 2 * ranges.len());
}

#[test]
fn sweeps_stay_on_their_branch() {
    for (name, vary, from, to) in [
        ("four-bar", "B-D", "2.01", "5.99"),
        ("crank-rocker", "B-D", "3.01", "4.99"),
        ("jansen", "M-F", "24", "53.5"),
    ] {
        let mut session = open(name);
        let problem = session.problem().clone();
        let index = krawl::edit::Setting::find(&problem, vary).unwrap();
        let ends = (&from.parse().unwrap(), &to.parse().unwrap());
        let sweep = session.sweep(index, ends, 50, &mut Control::default());
        assert_eq!((sweep.frames.len(), &sweep.end), (50, &None), "{name}");
        let (first, last) = (&sweep.frames[0], &sweep.frames[49]);
        assert!(first.value.contains(ends.0.to_f64()) && last.value.contains(ends.1.to_f64()));
        for frame in &sweep.frames {
            assert!(frame.points.iter().flatten().all(|x| x.wid() < 1e-9));
            // All dimensions but the one that is driven are met.
            for (k, distance) in problem.distances.iter().enumerate() {
                let [a, b] = distance.points.map(|p| frame.points[p]);
                let squared = (a[0] - b[0]).sqr() + (a[1] - b[1]).sqr();
                let wanted = if k == index {
                    frame.value
                } else {
                    session.length(k)
                };
                assert!(!squared.sqrt().intersection(wanted).is_empty(), "{name}");
            }
        }
        // From frame to frame nothing jumps.
        for pair in sweep.frames.windows(2) {
            let size = ends.1.to_f64();
            let jump = pair[0]
                .points
                .iter()
                .flatten()
                .zip(pair[1].points.iter().flatten());
            let jump = jump
                .map(|(a, b)| (a.mid() - b.mid()).abs())
                .fold(0.0, f64::max);
            assert!(jump < 0.5 * size, "{name}: {jump}");
        }
    }
}

#[test]
fn a_sweep_ends_at_the_limit() {
    let mut session = open("four-bar");
    let index = krawl::edit::Setting::find(session.problem(), "B-D").unwrap();
    let ends = (&"5".parse().unwrap(), &"7".parse().unwrap());
    let sweep = session.sweep(index, ends, 21, &mut Control::default());
    // 5, 5.1 … 5.9; at 6 the bars B-C and C-D are on one line.
    assert_eq!(sweep.frames.len(), 10);
    let end = sweep.end.unwrap();
    assert!(matches!(end.ending, Ending::Limit(_)));
    assert!(end.dimensions[0].value.contains(6.0));
}

#[test]
fn sweeps_and_limits_on_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("curve.csv");
    let file = "problems/mechanisms/four-bar.toml";
    let sweep = [
        "sweep", file, "--vary", "B-D", "--from", "3", "--to", "5", "--frames", "5",
    ];
    let run = krawl().args(sweep).arg("--csv").arg(&csv).assert().code(0);
    let text = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    assert!(
        text.starts_with("four-bar: 5 frames of B-D from 3 to 5, each proved"),
        "{text}"
    );
    let csv = std::fs::read_to_string(csv).unwrap();
    assert!(
        csv.starts_with("B-D,A.x,A.y,D.x,D.y,B.x,B.y,C.x,C.y,P.x,P.y\n3,0,0,5,0,"),
        "{csv}"
    );
    assert_eq!(csv.lines().count(), 6);
    let beyond = [
        "sweep", file, "--vary", "B-D", "--from", "5", "--to", "7", "--frames", "5",
    ];
    let run = krawl().args(beyond).args(["--json", "-"]).assert().code(3);
    let json: Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    assert_eq!(
        (&json["status"], json["frames"].as_array().unwrap().len()),
        (&"limit".into(), 2)
    );
    assert_eq!(json["end"]["status"], "limit");

    let run = krawl()
        .args(["limits", file, "--only", "D-B", "--json", "-"])
        .assert()
        .code(0);
    let json: Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    let range = &json["ranges"]["B-D"];
    assert!((range["low"]["value"][0].as_f64().unwrap() - 2.0).abs() < 1e-12);
    assert!((range["high"]["value"][1].as_f64().unwrap() - 6.0).abs() < 1e-12);
    let run = krawl().args(["limits", file]).assert().code(0);
    let text = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    assert!(text.contains("B-D grows to 6.000000"), "{text}");
    krawl()
        .args(["limits", file, "--only", "B-E"])
        .assert()
        .code(2);
    krawl()
        .args(["sweep", file, "--vary", "B-D", "--from", "0", "--to", "1"])
        .assert()
        .code(2);
}

#[test]
fn a_stream_of_edits() {
    let input = concat!(
        r#"{"set": {"B-D": 4.5}, "id": 1}"#,
        "\n",
        r#"{"set": {"B-D": 7}, "id": "two"}"#,
        "\n",
        r#"{"set": {"B-D": "5", "C-D": 3.4}, "probe": true}"#,
        "\n\n",
        r#"{"set": {"X-Y": 5}}"#,
        "\n",
        r#"{"sets": {}}"#,
        "\nnonsense\n",
        r#"{"set": {"B-D": 0.1000000000000000000000001}}"#,
        "\n",
        "{}\n",
    );
    let run = krawl()
        .args(["edit", "problems/mechanisms/four-bar.toml", "--serve"])
        .write_stdin(input)
        .assert()
        .code(0);
    let text = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    let answers: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let status: Vec<&str> = answers
        .iter()
        .map(|a| a["status"].as_str().unwrap())
        .collect();
    let wanted = [
        "reached", "limit", "reached", "error", "error", "error", "limit", "figure",
    ];
    assert_eq!(status, wanted, "{text}");
    assert_eq!(
        (&answers[0]["id"], &answers[1]["id"]),
        (&1.into(), &"two".into())
    );
    let committed = |k: usize| answers[k]["committed"].as_bool().unwrap();
    assert!(committed(0) && !committed(1) && !committed(2));
    // Only the first edit has changed the figure.
    assert_eq!(
        answers[7]["dimensions"]["B-D"],
        serde_json::json!([4.5, 4.5])
    );
    assert_eq!(answers[7]["points"], answers[0]["points"]);
}
