//! `krawl compare`: tables, JSON, CSV, pictures, and what it says of wrong answers.

use assert_cmd::Command;
use krawl::compare::{Effort, Fault, Knob, Method, Row, Verdict, compare};
use krawl::problem::Problem;
use krawl::report::{Compared, comparison_to_table, comparisons_to_csv, comparisons_to_json};
use krawl::track::Space;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command as Process, Stdio};
use std::time::Duration;

const K33: &str = "problems/k33.toml";
const DODECAGON: &str = "problems/dodecagon.toml";

fn krawl() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
    command.arg("compare");
    command
}

fn names(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).unwrap();
    entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect()
}

/// Parses, and has the size and the colour of paper.
fn is_picture(path: &Path) {
    let text = fs::read_to_string(path).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let root = document.root_element();
    assert_eq!(root.tag_name().name(), "svg");
    for size in ["width", "height"] {
        let size: u32 = root.attribute(size).unwrap().parse().unwrap();
        assert!(size > 400);
    }
    assert!(
        !text.contains("NaN") && !text.contains("inf"),
        "{}",
        path.display()
    );
    let lines = document
        .descendants()
        .filter(|n| n.tag_name().name() == "polyline");
    assert!(lines.count() > 3);
}

#[test]
fn one_table_per_problem_with_the_published_rows() {
    let run = krawl()
        .args([DODECAGON, K33, "--repeat", "3"])
        .assert()
        .code(0);
    let text = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    let mut tables = text.split("\n\n");
    let (dodecagon, k33) = (tables.next().unwrap(), tables.next().unwrap());
    assert!(tables.next().is_none());
    assert!(dodecagon.starts_with("dodecagon\n") && k33.starts_with("k33\n"));
    let heading: Vec<&str> = dodecagon
        .lines()
        .nth(1)
        .unwrap()
        .split_whitespace()
        .collect();
    for column in [
        "mode",
        "space",
        "steps",
        "rejected",
        "ms",
        "ratio",
        "solutions",
        "status",
        "widths",
        "residual",
        "published:",
    ] {
        assert!(heading.contains(&column), "{column} in {heading:?}");
    }
    let row = |table: &str, mode: &str, space: &str| {
        let lines = table
            .lines()
            .map(|line| line.split_whitespace().collect::<Vec<&str>>());
        let mut rows =
            lines.filter(|cells| cells.len() > 2 && cells[0] == mode && cells[1] == space);
        rows.next().map(|cells| cells.join(" ")).unwrap()
    };
    assert!(row(dodecagon, "certified", "full").contains(" 2 closed "));
    assert!(row(dodecagon, "paper", "full").ends_with("42, 70.0, 2"));
    assert!(row(dodecagon, "paper", "reduced").ends_with("46, 10.0, 2"));
    assert!(dodecagon.contains("published: HOM4PS-2.0"));
    assert!(row(k33, "float", "reduced").contains(" 8 closed "));
    assert!(!k33.contains("published"));
}

#[test]
fn writes_json_csv_and_pictures_into_a_new_directory() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("a/b");
    for _ in 0..2 {
        let run = krawl()
            .args([K33, "--sweep", "--repeat", "1", "--output"])
            .arg(&out)
            .assert()
            .code(0);
        let text = String::from_utf8(run.get_output().stdout.clone()).unwrap();
        assert!(text.contains("tube-radius") && text.contains("max-step"));
    }
    let wanted = [
        "comparison.csv",
        "comparison.json",
        "k33-cost.svg",
        "k33-path.svg",
        "k33-time.svg",
    ];
    assert_eq!(names(&out), wanted.map(str::to_owned).into());
    for picture in &wanted[2..] {
        is_picture(&out.join(picture));
    }

    let json: Value =
        serde_json::from_str(&fs::read_to_string(out.join("comparison.json")).unwrap()).unwrap();
    let problem = &json["problems"][0];
    assert_eq!(problem["problem"], "k33");
    assert_eq!(
        (&problem["interrupted"], &problem["reference"]),
        (&false.into(), &true.into())
    );
    let rows = problem["rows"].as_array().unwrap();
    let sweep = problem["sweep"].as_array().unwrap();
    let mut ways = BTreeSet::new();
    for row in rows.iter().chain(sweep) {
        let keys: Vec<&str> = row
            .as_object()
            .unwrap()
            .keys()
            .map(String::as_str)
            .collect();
        let mut wanted = vec![
            "mode",
            "space",
            "setting",
            "value",
            "relative",
            "status",
            "reason",
            "steps",
            "rejected",
            "runs",
            "seconds",
            "ratio",
            "solutions",
            "widest",
            "narrowest",
            "residual",
            "length",
            "stopped_kind",
            "switched_on",
            "verdict",
            "faults",
            "published",
        ];
        wanted.sort_unstable();
        assert_eq!(keys, wanted);
    }
    for row in rows {
        ways.insert((
            row["mode"].as_str().unwrap(),
            row["space"].as_str().unwrap(),
        ));
        if row["status"] == "unsupported" {
            assert!(row["reason"].is_string() && row["steps"].is_null());
            continue;
        }
        assert_eq!(
            (&row["solutions"], &row["verdict"]),
            (&8.into(), &"right".into())
        );
        assert_eq!(row["runs"].as_array().unwrap().len(), 1);
        assert!(row["residual"].as_f64().unwrap() < 1e-12);
        let is_certified = row["mode"] == "certified";
        assert_eq!(row["narrowest"].as_f64().unwrap() > 0.0, is_certified);
        assert!(row["ratio"].as_f64().unwrap() >= 1.0);
    }
    assert_eq!(ways.len(), rows.len());
    assert!(ways.contains(&("certified", "full")) && ways.contains(&("paper", "reduced")));
    // Each way that there is has as many settings.
    let there = rows
        .iter()
        .filter(|row| row["status"] != "unsupported")
        .count();
    assert_eq!(sweep.len() % there, 0);
    assert!(sweep.iter().all(|row| row["value"].as_f64().unwrap() > 0.0));

    // CSV has the same rows below a heading.
    let text = fs::read_to_string(out.join("comparison.csv")).unwrap();
    assert_eq!(text.lines().count(), 1 + rows.len() + sweep.len());
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let column = reader
        .headers()
        .unwrap()
        .iter()
        .position(|name| name == "verdict")
        .unwrap();
    let records = reader.records().map(Result::unwrap);
    for (record, row) in records.zip(rows.iter().chain(sweep)) {
        assert_eq!(&record[column], row["verdict"].as_str().unwrap());
    }
}

#[test]
fn standard_output_is_for_one_thing() {
    let run = krawl()
        .args([K33, "--repeat", "1", "--json", "-"])
        .assert()
        .code(0);
    let json: Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    assert_eq!(json["problems"].as_array().unwrap().len(), 1);
    let run = krawl()
        .args([K33, "--repeat", "1", "--csv", "-"])
        .assert()
        .code(0);
    assert!(run.get_output().stdout.starts_with(b"problem,mode,space,"));
    krawl()
        .args([K33, "--csv", "-", "--json", "-"])
        .assert()
        .code(2);
}

#[test]
fn bad_files_are_refused_before_anything_runs() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let bad = folder.path().join("bad.toml");
    fs::write(&bad, "dimension = 2\n").unwrap();
    let run = krawl()
        .args([K33])
        .arg(&bad)
        .arg("--output")
        .arg(&out)
        .assert()
        .code(2);
    assert!(run.get_output().stdout.is_empty());
    assert!(String::from_utf8_lossy(&run.get_output().stderr).contains("bad.toml"));
    assert!(!out.exists());
    krawl()
        .arg(folder.path().join("missing.toml"))
        .assert()
        .code(2);
    krawl().assert().code(2);
    krawl().args([K33, "--repeat", "0"]).assert().code(2);
    // A directory that cannot be made, and results over a problem.
    krawl()
        .args([K33, "--output"])
        .arg(bad.join("below"))
        .assert()
        .code(2);
    let copy = folder.path().join("copy.toml");
    fs::copy(K33, &copy).unwrap();
    krawl().arg(&copy).arg("--json").arg(&copy).assert().code(2);
    assert_eq!(fs::read(&copy).unwrap(), fs::read(K33).unwrap());
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_what_was_done() {
    let folder = tempfile::tempdir().unwrap();
    let mut run = Process::new(env!("CARGO_BIN_EXE_krawl"))
        .args([
            "compare",
            K33,
            "problems/icosahedron.toml",
            "--repeat",
            "2000",
            "--limit",
            "60",
            "--output",
        ])
        .arg(folder.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(1500));
    let sent = Process::new("kill")
        .args(["-INT", &run.id().to_string()])
        .status()
        .unwrap();
    assert!(sent.success());
    let mut text = String::new();
    std::io::Read::read_to_string(&mut run.stdout.take().unwrap(), &mut text).unwrap();
    assert_eq!(run.wait().unwrap().code(), Some(1));
    assert!(
        text.starts_with("k33\n") && text.contains("interrupted: rows may be missing"),
        "{text}"
    );
    let json: Value =
        serde_json::from_str(&fs::read_to_string(folder.path().join("comparison.json")).unwrap())
            .unwrap();
    let problems = json["problems"].as_array().unwrap();
    assert_eq!(problems.last().unwrap()["interrupted"], true);
    assert!(!problems[0]["rows"].as_array().unwrap().is_empty());
    assert!(
        !names(folder.path())
            .iter()
            .any(|name| name.ends_with(".tmp"))
    );
}

#[test]
fn a_sweep_marks_the_settings_that_jump() {
    let problem = crate::common::shipped("icosahedron-c1");
    let effort = Effort {
        repeats: 1,
        sweep: true,
        ..Effort::default()
    };
    let comparison = compare(&problem, &effort, &mut Default::default()).unwrap();
    assert!(comparison.has_reference());
    let at = |method: Method, knob: Knob, relative: f64| -> &Row {
        let mut rows = comparison.sweep.iter();
        rows.find(|row| {
            let setting = row.setting.unwrap();
            row.way.method == method
                && row.way.space == Space::Full
                && setting.knob == knob
                && setting.relative == relative
        })
        .unwrap()
    };
    // With long steps the paper's tracker jumps. It is floating point without any randomness, so it
    // does so each time: it meets figures that are solutions, but of other paths.
    let Verdict::Wrong(faults) = &at(Method::Paper, Knob::MaxStep, 1.0).verdict else {
        panic!("long steps were right");
    };
    assert!(
        faults
            .iter()
            .any(|fault| matches!(fault, Fault::Jumped(n) if *n > 8)),
        "{faults:?}"
    );
    assert_eq!(
        at(Method::Paper, Knob::MaxStep, 0.02).verdict,
        Verdict::Right
    );
    // A certified run is right or stops, whatever is asked of it.
    let certified = comparison
        .sweep
        .iter()
        .filter(|row| row.way.method == Method::Certified);
    for row in certified {
        assert!(
            matches!(row.verdict, Verdict::Right | Verdict::Stopped),
            "{row:?}"
        );
    }
    let narrow = at(Method::Certified, Knob::TubeRadius, 1e-8)
        .measured()
        .unwrap();
    let wide = at(Method::Certified, Knob::TubeRadius, 1e-4)
        .measured()
        .unwrap();
    assert!(narrow.is_closed() && narrow.outcome.steps > 2 * wide.outcome.steps);
    // Narrower than 53 bits can prove.
    assert_eq!(
        at(Method::Certified, Knob::TubeRadius, 1e-14).verdict,
        Verdict::Stopped
    );

    let compared = Compared {
        comparison: comparison.clone(),
        published: Vec::new(),
    };
    let table = comparison_to_table(&compared);
    assert!(
        table.contains("WRONG: ") && table.contains("of other paths"),
        "{table}"
    );
    assert!(comparisons_to_csv(std::slice::from_ref(&compared)).contains(",wrong,"));
    assert!(comparisons_to_json(&[compared]).contains("{\"fault\":\"jumped\""));
}

#[test]
fn without_a_closed_certified_run_nothing_is_judged() {
    // A path too long for the time allowed.
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("short.toml");
    fs::copy("problems/icosahedron.toml", &file).unwrap();
    let run = krawl()
        .arg(&file)
        .args(["--sweep", "--repeat", "1", "--limit", "0.02", "--json", "-"])
        .assert()
        .code(1);
    let json: Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    let problem = &json["problems"][0];
    assert_eq!(problem["reference"], false);
    assert_eq!(problem["rows"][0]["status"], "stopped");
    assert!(
        problem["rows"][0]["reason"]
            .as_str()
            .unwrap()
            .starts_with("given up")
    );
    for row in problem["sweep"].as_array().unwrap() {
        assert_eq!(row["verdict"], "unjudged");
    }
}

#[test]
fn published_rows_are_checked_like_the_rest_of_a_file() {
    let text = fs::read_to_string(K33).unwrap();
    let parse = |more: &str| krawl::problem::Problem::parse(&format!("{text}\n{more}"), "k33.toml");
    assert!(parse("[[published]]\nmethod = \"by hand\"\nseconds = 3\n").is_ok());
    let lines = text.lines().count();
    for (more, line, said) in [
        (
            "[[published]]\nseconds = 3\n",
            None,
            "published.method: is missing",
        ),
        (
            "[[published]]\nmethod = \"a\"\nsteps = -1\n",
            Some(4),
            "published.steps: must be a whole number",
        ),
        (
            "[[published]]\nmethod = \"a\"\nspace = \"half\"\n",
            Some(4),
            "published.space: must be",
        ),
        (
            "[[published]]\nmethod = \"a\"\nsecond = 1.0\n",
            Some(4),
            "did you mean `seconds`",
        ),
        (
            "[[published]]\nmethod = \"a\"\nseconds = 0.0\n",
            Some(4),
            "published.seconds: must be",
        ),
        (
            "[published]\nmethod = \"a\"\n",
            None,
            "published: must be tables",
        ),
    ] {
        let error = parse(more).unwrap_err();
        assert!(error.to_string().contains(said), "{error}");
        if let Some(line) = line {
            assert_eq!(error.line, Some(lines + line), "{error}");
        }
    }
}

#[test]
fn settings_are_those_of_solve() {
    let solve = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
        command.args(["solve", K33, "--json", "-"]).args(arguments);
        let output = command.output().unwrap();
        let json: Option<Value> = serde_json::from_slice(&output.stdout).ok();
        (output.status.code(), json)
    };
    let (code, usual) = solve(&[]);
    let (other, narrow) = solve(&["--tube-radius", "1e-9"]);
    assert_eq!((code, other), (Some(0), Some(0)));
    let steps = |json: Option<Value>| json.unwrap()["steps"].as_u64().unwrap();
    assert!(steps(narrow) > 2 * steps(usual));
    let (code, stopped) = solve(&["--tube-radius", "1e-18"]);
    assert_eq!(code, Some(1));
    let reason = stopped.unwrap()["reason"].as_str().unwrap().to_owned();
    assert!(reason.contains("1e-18"), "{reason}");
    assert_eq!(
        solve(&["--mode", "float", "--tolerance", "1e-5"]).0,
        Some(0)
    );
    for wrong in [
        &["--tolerance", "1e-5"][..],
        &["--mode", "float", "--tube-radius", "1e-5"],
        &["--tube-radius", "0"],
        &["--tube-radius", "-1"],
        &["--mode", "float", "--tolerance", "nan"],
    ] {
        assert_eq!(solve(wrong).0, Some(2), "{wrong:?}");
    }
}

#[test]
fn the_papers_steps_work_at_any_scale() {
    use krawl::rational::Rational;
    let octahedron = crate::common::shipped("octahedron");
    for power in [8, -8] {
        let factor = Rational::from_integer(10.into()).pow(power);
        let problem = crate::common::moves::scaled(&octahedron, &factor);
        for space in crate::common::FLOAT_SPACES {
            let found = crate::common::closed(&problem, &krawl::track::Options::paper(space));
            assert_eq!(found.len(), 4, "{power}, {space:?}");
        }
    }
}

#[test]
fn what_was_switched_on_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let run = krawl()
        .args(["problems/hard/flaps-split-8.toml", K33])
        .args(["--repeat", "1", "--limit", "0.5", "--output"])
        .arg(folder.path())
        .assert();
    let text = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    let (flaps, k33) = text.split_once("\n\n").unwrap();
    const SAID: &str = "certified, full: switched on: extended precision (double-double)";
    assert!(flaps.contains(SAID), "{text}");
    assert!(!k33.contains("extended precision"), "{text}");

    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    let json: Value = serde_json::from_str(&read("comparison.json")).unwrap();
    let problems = json["problems"].as_array().unwrap();
    let rows = problems.iter().flat_map(|p| p["rows"].as_array().unwrap());
    let text = read("comparison.csv");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let headers = reader.headers().unwrap();
    let column = headers.iter().position(|name| name == "switched_on");
    let mut extended = 0;
    for (row, record) in rows.zip(reader.records().map(Result::unwrap)) {
        let list = row["switched_on"].as_array().unwrap().iter();
        let list: Vec<&str> = list.map(|text| text.as_str().unwrap()).collect();
        assert_eq!(record[column.unwrap()], list.join("; "));
        if list
            .iter()
            .any(|text| text.starts_with("extended precision"))
        {
            assert_eq!(
                (&row["mode"], &row["space"]),
                (&"certified".into(), &"full".into())
            );
            assert_eq!(row["status"], "closed");
            extended += 1;
        }
    }
    assert_eq!(extended, 1);
}

/// The table of a comparison of one file, and its JSON.
fn compared(file: &str) -> (String, Value) {
    let folder = tempfile::tempdir().unwrap();
    let json = folder.path().join("out.json");
    let run = krawl()
        .args([file, "--repeat", "1", "--json"])
        .arg(&json)
        .assert()
        .code(0);
    let text = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    let document: Value = serde_json::from_str(&fs::read_to_string(json).unwrap()).unwrap();
    let schema = fs::read_to_string("docs/schema/comparison.schema.json").unwrap();
    let schema: Value = serde_json::from_str(&schema).unwrap();
    assert!(
        jsonschema::validator_for(&schema)
            .unwrap()
            .is_valid(&document)
    );
    (text, document["problems"][0].clone())
}

/// Certified and float runs, in both spaces: all but the paper's.
fn rows(problem: &Value) -> Vec<&Value> {
    let rows = problem["rows"].as_array().unwrap().iter();
    let rows: Vec<&Value> = rows.filter(|row| row["mode"] != "paper").collect();
    assert_eq!(rows.len(), 4);
    rows
}

/// Solutions that differ in lines alone were once taken for one: all ways were called wrong.
#[test]
fn figures_are_matched_by_their_lines_too() {
    for name in ["3p3l", "3p3l-orthogonal"] {
        let (text, problem) = compared(&format!("problems/constraints/{name}.toml"));
        assert!(!text.contains("WRONG"), "{text}");
        assert_eq!(
            (&problem["reference"], &problem["reference_is_arc"]),
            (&true.into(), &false.into())
        );
        for row in rows(&problem) {
            assert_eq!(row["verdict"], "right", "{row}");
            // Over all constraints: more than the three distances of points have.
            let residual = row["residual"].as_f64().unwrap();
            assert!(residual > 0.0 && residual < 1e-12, "{row}");
        }
    }
}

/// A certified run that ends open proves the solutions of its arc, and others are judged by these.
#[test]
fn an_open_certified_run_is_a_reference() {
    for (name, solutions) in [("infinite", 2), ("undefined", 0)] {
        let (text, problem) = compared(&format!("problems/constraints/6p7d3a2c-{name}.toml"));
        assert!(
            text.contains("judged by the solutions on the arc that it proved"),
            "{text}"
        );
        assert!(!text.contains("WRONG"), "{text}");
        assert_eq!(
            (&problem["reference"], &problem["reference_is_arc"]),
            (&true.into(), &true.into())
        );
        for row in rows(&problem) {
            assert_eq!(
                (&row["status"], &row["verdict"]),
                (&"open".into(), &"right".into())
            );
            assert_eq!(row["solutions"], solutions);
        }
    }
}

/// A certified run that ended before the one that others are judged by is told from one that came as far.
#[test]
fn a_certified_run_that_ended_earlier_is_told() {
    let problem = Problem::read(K33).unwrap();
    let effort = Effort {
        repeats: 1,
        ..Effort::default()
    };
    let mut comparison = compare(&problem, &effort, &mut Default::default()).unwrap();
    let is_reduced =
        |row: &&mut Row| row.way.method == Method::Certified && row.way.space == Space::Reduced;
    let row = comparison.rows.iter_mut().find(is_reduced).unwrap();
    row.verdict = Verdict::Earlier(2);
    let compared = Compared {
        comparison,
        published: Vec::new(),
    };
    let table = comparison_to_table(&compared);
    let words =
        "certified, reduced: it ended earlier: 2 solutions of the arc proved are beyond its ends";
    assert!(table.contains(words), "{table}");
    let document: Value = serde_json::from_str(&comparisons_to_json(&[compared])).unwrap();
    let rows = document["problems"][0]["rows"].as_array().unwrap();
    let earlier = rows.iter().filter(|row| row["verdict"] == "earlier");
    assert_eq!(earlier.count(), 1);
    assert!(
        rows.iter()
            .all(|row| row["faults"] == serde_json::json!([]))
    );
}
