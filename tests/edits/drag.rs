//! Points dragged to other places: dimensions stay, the way is one path, and what is out of reach is come near to.

use assert_cmd::Command;
use krawl::edit::{Drag, Session};
use krawl::problem::Problem;
use krawl::track::{Control, Options};
use proptest::prelude::*;
use std::fs;
use std::io::Write as _;
use std::process::Stdio;

fn open(text: &str) -> (Problem, Session) {
    let problem = Problem::parse_loosely(text, "drag.toml").unwrap();
    let session =
        Session::open_to_drag(&problem, &Options::certified(), &mut Control::default()).unwrap();
    (problem, session)
}

fn chain(points: &[[f64; 2]]) -> String {
    let names: Vec<String> = (0..points.len()).map(|k| format!("P{k}")).collect();
    let mut text = "name = \"chain\"\ndimension = 2\n[points]\n".to_owned();
    for (name, [x, y]) in names.iter().zip(points) {
        text += &format!("{name} = [{x}, {y}]\n");
    }
    text += "[constraints]\nfixed = [\"P0\"]\ndistances = [\n";
    for pair in names.windows(2).zip(points.windows(2)) {
        let (names, [a, b]) = (pair.0, [pair.1[0], pair.1[1]]);
        let length = (a[0] - b[0]).hypot(a[1] - b[1]);
        text += &format!("[\"{}\", \"{}\", {length:.6}],\n", names[0], names[1]);
    }
    text + "]\n"
}

fn length(figure: &[[f64; 3]], a: usize, b: usize) -> f64 {
    (figure[a][0] - figure[b][0]).hypot(figure[a][1] - figure[b][1])
}

/// Two bars of length 5 from the origin: the joint is where two circles meet, on the side where it was.
#[test]
fn the_tip_of_an_arm_goes_where_it_is_wanted() {
    let (problem, mut session) = open(&chain(&[[0.0, 0.0], [3.0, 4.0], [8.0, 4.0]]));
    let drag = Drag::parse(&problem, "P2=0,8").unwrap();
    let edited = session.drag(&[drag], &mut Control::default());
    let dragged = edited.dragged.as_ref().unwrap();
    assert!(dragged.is_there && dragged.stop.is_none(), "{dragged:?}");
    let [p1, p2] = [edited.points[1], edited.points[2]];
    assert!(p2[0].contains(0.0) && p2[1].contains(8.0) && p2[1].wid() < 1e-12);
    // The old one turned left-hand to right: P1 above the line from P0 to P2, so now it is to its left.
    assert!(
        (p1[0].mid() + 3.0).abs() < 1e-9 && (p1[1].mid() - 4.0).abs() < 1e-9,
        "{p1:?}"
    );
    assert_eq!(session.figure()[2][1], 8.0);
    assert!(edited.account.held.is_empty() && edited.account.left_out.is_empty());
}

#[test]
fn what_is_out_of_reach_is_come_near_to() {
    let text = chain(&[[0.0, 0.0], [3.0, 4.0], [8.0, 4.0]]);
    let (problem, mut session) = open(&text);
    let drag = Drag::parse(&problem, "P2=9,12").unwrap();
    let edited = session.drag(&[drag], &mut Control::default());
    let dragged = edited.dragged.as_ref().unwrap();
    // The arm reaches 10, and the place is 15 away.
    assert!(!dragged.is_there);
    let off = dragged.places[0].1;
    assert!(off.inf() > 4.999 && off.sup() < 5.001, "{off:?}");
    let tip = edited.points[2].map(|x| x.mid());
    assert!(
        (tip[0] - 6.0).abs() < 0.1 && (tip[1] - 8.0).abs() < 0.1,
        "{tip:?}"
    );
    // A crank can only turn: the nearest place is on its ray, past where its own coordinates turn back.
    let (problem, mut session) = open(&chain(&[[0.0, 0.0], [5.0, 0.0]]));
    for (to, at) in [
        ("P1=-8,6", [-4.0, 3.0]),
        ("P1=0,-20", [0.0, -5.0]),
        ("P1=1,0", [5.0, 0.0]),
    ] {
        let drag = Drag::parse(&problem, to).unwrap();
        let edited = session.drag(&[drag], &mut Control::default());
        let there = edited.points[1].map(|x| x.mid());
        assert!(
            (there[0] - at[0]).abs() + (there[1] - at[1]).abs() < 1e-4,
            "{to}: {there:?}"
        );
        assert!(edited.points[1][0].sqr().sup() + edited.points[1][1].sqr().sup() > 24.999);
    }
    // And what cannot move stands.
    let (problem, mut session) =
        open(&chain(&[[0.0, 0.0], [5.0, 0.0]]).replace("\"P0\"]", "\"P0\", \"P1\"]"));
    let drag = Drag::parse(&problem, "P1=0,5").unwrap();
    let edited = session.drag(&[drag], &mut Control::default());
    assert!(edited.points[1][0].contains(5.0) && !edited.dragged.unwrap().is_there);
}

#[test]
fn the_program_drags_and_writes_what_it_came_to() {
    let directory = tempfile::tempdir().unwrap();
    let (file, out) = (
        directory.path().join("arm.toml"),
        directory.path().join("out.toml"),
    );
    fs::write(&file, chain(&[[0.0, 0.0], [3.0, 4.0], [8.0, 4.0]])).unwrap();
    let run = |more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
        let output = command.arg("edit").arg(&file).args(more).output().unwrap();
        let text = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
        (text, output.status.code().unwrap())
    };
    let (text, code) = run(&["--drag", "P2=-3,4.5", "--out", out.to_str().unwrap()]);
    assert_eq!(code, 0, "{text}");
    assert!(text.contains("P2 is where it was wanted"), "{text}");
    let written = Problem::parse_loosely(&fs::read_to_string(&out).unwrap(), "out.toml").unwrap();
    assert_eq!(written.points[2].sketch[1].to_f64(), 4.5);
    let (text, code) = run(&["--drag", "P2=0,30", "--json", "-"]);
    assert_eq!(code, 3, "{text}");
    let value: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(value["dragged"]["is_there"], false);
    assert!((value["dragged"]["places"]["P2"]["off"][0].as_f64().unwrap() - 20.0).abs() < 1e-3);
    for (wrong, words) in [
        ("Q=1,2", "no point `Q`"),
        ("P1=1", "2 coordinates"),
        ("P1=1,x", "x"),
        ("P1", "P=x,y"),
        ("P1=,2", "a coordinate is missing"),
    ] {
        let (text, code) = run(&["--drag", wrong]);
        assert!(code == 2 && text.contains(words), "{text}");
    }
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_krawl"))
        .args(["edit", "--serve"])
        .arg(&file)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let lines =
        "{\"drag\": {\"P2\": [0, \"8\"]}}\n{\"set\": {\"P0-P1\": 4}}\n{\"drag\": {\"P2\": [1]}}\n";
    child
        .stdin
        .take()
        .unwrap()
        .write_all(lines.as_bytes())
        .unwrap();
    let output = String::from_utf8(child.wait_with_output().unwrap().stdout).unwrap();
    let answers: Vec<serde_json::Value> = output
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(answers[0]["committed"], true);
    assert_eq!(answers[0]["points"]["P2"][1][0], 8.0);
    assert_eq!(answers[1]["status"], "reached");
    assert_eq!(answers[2]["status"], "error");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Bars keep their lengths, the tip of a chain comes to where it is wanted if that is well within reach, and back; and the rest is moved
    /// little: not by more than a few times as far as the tip.
    #[test]
    fn dragging_keeps_dimensions(
        turns in proptest::collection::vec(0.3..1.2f64, 3..6),
        to in [-1.0..1.0f64, -1.0..1.0],
    ) {
        let mut points = vec![[0.0, 0.0]];
        let mut angle = 0.0;
        for turn in &turns {
            angle += turn;
            let [x, y] = points[points.len() - 1];
            points.push([x + angle.cos(), y + angle.sin()]);
        }
        let (problem, mut session) = open(&chain(&points));
        let tip = points.len() - 1;
        let before = session.figure();
        let goal = [before[tip][0] + 0.3 * to[0], before[tip][1] + 0.3 * to[1]];
        let reach: f64 = tip as f64;
        prop_assume!(goal[0].hypot(goal[1]) < reach - 0.3 && goal[0].hypot(goal[1]) > 0.3);
        let drag = |goal: [f64; 2]| Drag::parse(&problem, &format!("P{tip}={:.9},{:.9}", goal[0], goal[1])).unwrap();
        let edited = session.drag(&[drag(goal)], &mut Control::default());
        let dragged = edited.dragged.as_ref().unwrap();
        prop_assert!(dragged.is_there, "{dragged:?}");
        let after = session.figure();
        let way = length(&[before[tip], after[tip]], 0, 1);
        for k in 1..=tip {
            prop_assert!((length(&before, k - 1, k) - length(&after, k - 1, k)).abs() < 1e-9);
            prop_assert!(length(&[before[k], after[k]], 0, 1) <= 4.0 * way + 1e-9);
        }
        let back = session.drag(&[drag([before[tip][0], before[tip][1]])], &mut Control::default());
        prop_assert!(back.dragged.unwrap().is_there);
    }
}

/// Of cranks that are one too many the others follow; a point without any length is where it is wanted at every scale; twice is once too often.
#[test]
fn odd_figures_are_dragged_too() {
    let cranks = r#"
        dimension = 2
        [points]
        A = [0, 0]
        B = [4, 0]
        M = [2, 1]
        P1 = [0.6, 0.8]
        P2 = [4.6, 0.8]
        PM = [2.6, 1.8]
        [constraints]
        fixed = ["A", "B", "M"]
        squared_distances = [["P1", "PM", 5], ["PM", "P2", 5]]
        distances = [["P1", "P2", 4], ["A", "P1", 1], ["B", "P2", 1], ["M", "PM", 1]]
    "#;
    let (problem, mut session) = open(cranks);
    let drag = Drag::parse(&problem, "P1=5,5").unwrap();
    let edited = session.drag(&[drag], &mut Control::default());
    let p1 = edited.points[3].map(|x| x.mid());
    assert!(
        (p1[0] - p1[1]).abs() < 1e-2 && (p1[0].hypot(p1[1]) - 1.0).abs() < 1e-6,
        "{p1:?}"
    );
    for scale in [1e-8, 1.0, 1e8] {
        let free = format!(
            "dimension = 2\n[points]\nP = [{}, {}]\nQ = [0, 0]\n[constraints]\nfixed = [\"Q\"]\n",
            3.0 * scale,
            scale
        );
        let (problem, mut session) = open(&free);
        let (x, y) = (1.23456789 * scale, -0.3 * scale);
        let drag = Drag::parse(&problem, &format!("P={x},{y}")).unwrap();
        let edited = session.drag(&[drag], &mut Control::default());
        assert!(edited.dragged.unwrap().is_there);
        assert!((edited.points[0][0].mid() - x).abs() <= 1e-12 * scale);
    }
    let twice = ["P=0,1", "P=1,0"].map(|text| Drag::parse(&problem_of_two(), text).unwrap());
    assert!(
        Drag::check(&problem_of_two(), &twice)
            .unwrap_err()
            .contains("two places")
    );
}

fn problem_of_two() -> Problem {
    let text = "dimension = 2\n[points]\nP = [1, 1]\nQ = [0, 0]\n[constraints]\nfixed = [\"Q\"]\n";
    Problem::parse_loosely(text, "two.toml").unwrap()
}
