//! Problem files with more constraints than unknowns, or fewer, and dimensions that are out of reach: what `solve` and `limits` say.

use assert_cmd::Command;
use krawl::blocks::Verdict;
use krawl::edit::{End, Ending, Session, Setting};
use krawl::problem::Problem;
use krawl::track::Control;
use serde_json::Value;
use std::fs;

/// What a verb prints of a problem, and its exit code.
fn run(verb: &str, text: &str, more: &[&str]) -> (String, i32) {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("problem.toml");
    fs::write(&file, text).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
    let output = command.arg(verb).arg(&file).args(more).output().unwrap();
    let text = [output.stdout, output.stderr].concat();
    (
        String::from_utf8(text).unwrap(),
        output.status.code().unwrap(),
    )
}

/// A robot's last link: its axis stands on two fixed points, so that the length between them is said twice.
fn link(length: &str) -> String {
    format!(
        r#"name = "link"
dimension = 2
[points]
a = [0, 0]
b = [3, 4]
c = [5.1, 0.3]
[constraints]
fixed = ["a", "b"]
distances = [["b", "c", 5], ["a", "c", 6], ["a", "b", {length}]]
"#
    )
}

/// Figures that can move, a dimension, and the least and greatest values that it has in any of them, by hand.
const LOOSE: [(&str, &str, [Option<f64>; 2]); 6] = [
    // A chain: the others laid end to end, or the longest less the others; nothing is at a place but A.
    (
        r#"dimension = 2
points = { A = [0, 0], B = [2, 1], C = [4, 0.5], D = [5, 2] }
constraints = { fixed = ["A"], distances = [["A","B",2.2],["B","C",2.1],["C","D",1.9],["A","D",5.3]] }"#,
        "A-B",
        [Some(1.3), Some(9.3)],
    ),
    // The same in space.
    (
        r#"dimension = 3
points = { A = [0, 0, 0], B = [2, 1, 0.3], C = [4, 0.5, 0.5], D = [5, 2, -0.2] }
constraints = { fixed = ["A"], distances = [["A","B",2.2],["B","C",2.1],["C","D",1.9],["A","D",5.3]] }"#,
        "B-C",
        [Some(1.2), Some(9.4)],
    ),
    // Two cranks around places that are fixed: the fixed points bear it.
    (
        r#"dimension = 2
points = { O = [0, 0], R = [5, 0], P = [0.6, 0.8], Q = [4, 1.7] }
constraints = { fixed = ["O", "R"], distances = [["O","P",1],["R","Q",2],["P","Q",3.5]] }"#,
        "P-Q",
        [Some(2.0), Some(8.0)],
    ),
    // An arm's end beside a wall: it reaches as far as the arm is long, and a bar that dangles from it is of no account.
    (
        r#"dimension = 2
points = { O = [0, 0], P = [0.6, 0.8], Q = [2, 2], R = [2.5, 1] }
constraints = { fixed = ["O"], distances = [["O","P",1],["P","Q",2],["Q","R",1.2]], dx = [["O","Q",2]] }"#,
        "dx:O-Q",
        [Some(-3.0), Some(3.0)],
    ),
    // A chain of three bars from the origin to a point on a line through it.
    (
        r#"dimension = 2
points = { O = [0, 0], U = [4, 0], P = [2, 0], Q = [1, 1], S = [0.5, 0.9] }
lines = { l = ["O", "U"] }
constraints = { fixed = ["O", "U"], on = [["P", "l"]], distances = [["O","S",1],["S","Q",0.5],["P","Q",1.4],["O","P",2]] }"#,
        "O-P",
        [None, Some(2.9)],
    ),
    // The end of an arm of 1.4 and 1.1 around X, 4 from O: the sine of the angle at O is 2.5/4 at most.
    (
        r#"dimension = 2
points = { O = [0, 0], X = [4, 0], P = [3, 1], Q = [2, 1.5] }
constraints = { fixed = ["O", "X"], distances = [["X","P",1.4],["P","Q",1.1]], angles = [["X","O","Q",36]] }"#,
        "angles:X-O-Q",
        [None, Some(38.682_187_453_489_44)],
    ),
];

/// The limits of a dimension of a figure that can move, with nothing held, are what they are by hand, and figures of random numbers
/// keep within them near there.
#[test]
fn limits_with_nothing_held_are_those_of_all_figures() {
    for (text, name, right) in LOOSE {
        let problem =
            Problem::parse_loosely(&format!("name = \"loose\"\n{text}"), "loose.toml").unwrap();
        let mut session = Session::open(&problem).unwrap();
        let index = Setting::find(&problem, name).unwrap();
        let range = session.range(index, &mut Control::default());
        assert!(!range.account.held.is_empty(), "{name}");
        for (found, right) in range.extremes.iter().zip(right) {
            let Some(right) = right else { continue };
            let found = found.as_ref().unwrap_or_else(|| panic!("{name}: {right}"));
            assert!(
                found.value.contains(right) || (found.value.mid() - right).abs() < 1e-12,
                "{name}: {:?}, {right}",
                found.value
            );
            assert!(found.value.wid() < 1e-9, "{name}: {:?}", found.value);
        }
    }
}

/// A rectangle of which more is said than needed, in no place of its own: it moves as a whole and in no other way.
#[test]
fn a_whole_that_floats_does_not_move_in_itself() {
    let text = "dimension = 2\n[points]\nA = [0,0]\nB = [4,0]\nC = [4,3]\nD = [0,3]\n[lines]\nab = [\"A\",\"B\"]\nbc = [\"B\",\"C\"]\n\
                cd = [\"C\",\"D\"]\nda = [\"D\",\"A\"]\n[constraints]\nperpendicular = [[\"ab\",\"bc\"],[\"bc\",\"cd\"],[\"cd\",\"da\"]]\n\
                parallel = [[\"ab\",\"cd\"]]\ndistances = [[\"A\",\"B\",4],[\"B\",\"C\",3],[\"A\",\"C\",5],[\"C\",\"D\",4]]\n";
    let (text, _) = run("edit", text, &["--set", "A-B=5"]);
    assert!(!text.contains("seems to move"), "{text}");
}

/// One constraint of which one equation is left out is left out in part.
#[test]
fn a_part_that_is_left_out_is_called_one() {
    let text = "dimension = 2\n[points]\nA = [0,0]\nB = [4,0]\nC = [6,0]\nD = [9,0]\nE = [2,3]\n[lines]\nab = [\"A\",\"B\"]\n[constraints]\n\
                collinear = [[\"A\",\"B\",\"C\",\"D\"]]\non = [[\"C\",\"ab\"]]\nparallel = [[\"A\",\"D\",\"B\",\"C\"]]\n\
                distances = [[\"A\",\"B\",4],[\"A\",\"E\",4],[\"B\",\"E\",4],[\"B\",\"C\",2],[\"C\",\"D\",3]]\n";
    let (text, _) = run("edit", text, &["--set", "C-D=4"]);
    // D is on the line by one of the two alone.
    assert!(text.contains("a part of `collinear: A, B, C, D`"), "{text}");
}

#[test]
fn what_is_said_twice_is_tested_at_the_figures() {
    let (text, code) = run("solve", &link("5"), &[]);
    assert_eq!(code, 0, "{text}");
    assert!(text.contains("2 figures meet all constraints"), "{text}");
    // c = (x, y) with x² + y² = 36 and (x − 3)² + (y − 4)² = 25: 3x + 4y = 18.
    assert!(text.contains("  c  6"), "{text}");
    assert!(text.contains("-1.68"), "{text}");
    // And where it says otherwise there is no figure.
    let (text, code) = run("solve", &link("5.25"), &[]);
    assert_eq!(code, 0, "{text}");
    assert!(text.contains("None, proved"), "{text}");
    assert!(!text.contains("were left out and are met"), "{text}");
    let (text, _) = run("solve", &link("5.25"), &["--json", "-"]);
    assert!(!text.contains(r#""verdict":"met""#), "{text}");
}

#[test]
fn a_figure_that_moves_says_what_is_held() {
    let loose = link("5")
        .replace("[\"b\", \"c\", 5], ", "")
        .replace(", [\"a\", \"b\", 5]", "");
    let (text, code) = run("solve", &loose, &[]);
    assert_eq!(code, 0, "{text}");
    assert!(text.contains("of c held where it is drawn"), "{text}");
    // What a path of the whole is asked for needs as many equations as unknowns.
    let (text, code) = run("solve", &loose, &["--mode", "float"]);
    assert_eq!(code, 2, "{text}");
    assert!(text.contains("under-constrained"), "{text}");
}

/// Up to rigid motions nothing is held for it: such problems are refused as before, and where `all` has an answer it is named.
#[test]
fn figures_up_to_motions_that_miss_a_distance_are_struck_out() {
    let braced = r#"name = "braced"
dimension = 2
[points]
a = [0, 0]
b = [4, 0.1]
c = [4.1, 3]
d = [0, 3.1]
[constraints]
distances = [["a","b",4],["b","c",3],["c","d",4],["d","a",3],["a","c",5],["b","d",5]]
"#;
    let (text, code) = run("solve", braced, &["--json", "-"]);
    assert_eq!(code, 0, "{text}");
    let result: Value = serde_json::from_str(text.lines().next().unwrap()).unwrap();
    let tested = &result["tested"];
    assert_eq!(tested["left_out"], serde_json::json!(["b-d"]));
    let number = |key: &str| tested[key].as_u64().unwrap();
    assert!(number("missed") > 0 && number("met") > 0, "{tested}");
    assert_eq!(number("found"), number("met") + number("missed"));
    assert!(tested["missed_by"].as_f64().unwrap() > 0.1);
    let verdict = result["verdict"].as_str().unwrap();
    assert!(
        verdict.starts_with("Closed, proved: with 5 of the 6 constraints the path"),
        "{verdict}"
    );
    assert!(
        verdict.contains("meet b-d within") && verdict.contains("are no solutions, proved"),
        "{verdict}"
    );
    // What is listed is the rectangle, either way round.
    let listed = result["solutions"].as_array().unwrap();
    assert_eq!(listed.len() as u64, number("met"));
    let middle = |solution: &Value, name: &str, axis: usize| {
        let bounds = &solution["points"][name][axis];
        0.5 * (bounds[0].as_f64().unwrap() + bounds[1].as_f64().unwrap())
    };
    for solution in listed {
        let apart = |a: &str, b: &str| {
            let along = |axis| middle(solution, a, axis) - middle(solution, b, axis);
            along(0).hypot(along(1))
        };
        for (a, b, length) in [
            ("a", "b", 4.0),
            ("b", "c", 3.0),
            ("a", "c", 5.0),
            ("b", "d", 5.0),
        ] {
            assert!((apart(a, b) - length).abs() < 1e-12);
        }
        let other = solution["mirror_of"].as_u64();
        assert!(other.is_none_or(|other| (other as usize) < listed.len()));
    }
    let (text, code) = run(
        "solve",
        &braced.replace(",[\"a\",\"c\",5],[\"b\",\"d\",5]", ""),
        &[],
    );
    assert_eq!(code, 2, "{text}");
    assert!(
        text.contains("1 is missing") && text.contains("krawl motion"),
        "{text}"
    );
}

/// A certificate is about the constraints used, and says so; that of the whole set too.
#[test]
fn certificates_of_figures_with_a_distance_too_many_are_about_their_file() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (file, proof) = (at("braced.toml"), at("proof.krawl"));
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0.1]\nc = [4.1, 3]\nd = [0, 3.1]\n[constraints]\n\
                distances = [[\"a\",\"b\",4],[\"b\",\"c\",3],[\"c\",\"d\",4],[\"d\",\"a\",3],[\"a\",\"c\",5],[\"b\",\"d\",5]]\n";
    fs::write(&file, text).unwrap();
    let krawl = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_krawl"))
            .args(arguments)
            .output()
            .unwrap();
        (
            output.status.code(),
            String::from_utf8(output.stdout).unwrap(),
        )
    };
    for verb in ["solve", "all"] {
        assert_eq!(krawl(&[verb, &file, "--cert", &proof]).0, Some(0), "{verb}");
        let (code, text) = krawl(&["verify", &proof, &file]);
        assert_eq!(code, Some(0), "{verb}: {text}");
        assert!(
            text.contains("`b-d` was left out, and nothing is proved of it"),
            "{verb}: {text}"
        );
    }
    // With another way there it is about another path.
    let way = format!("{text}[homotopy]\nbend = [\"a\", \"b\"]\nbend_coefficient = 1.5\n");
    fs::write(&file, &way).unwrap();
    assert_eq!(
        krawl(&["solve", &file, "--cert", &proof, "--quiet"]).0,
        Some(0)
    );
    let (code, text_of) = krawl(&["solve", &file, "--json", "-"]);
    let led: Value = serde_json::from_str(&text_of).unwrap();
    assert_eq!(code, Some(0));
    assert_eq!(led["options"]["bend"], serde_json::json!(["a", "b"]));
    assert_eq!(led["options"]["bend_coefficient"], "1.5");
    assert_eq!(krawl(&["verify", &proof, &file]).0, Some(0));
    fs::write(&file, way.replace("1.5", "2.5")).unwrap();
    assert_eq!(krawl(&["verify", &proof, &file]).0, Some(1));
    fs::write(&file, text.replace("\"c\",5]", "\"c\",5.01]")).unwrap();
    assert_eq!(krawl(&["verify", &proof, &file]).0, Some(1));
}

/// Of a molecule as many distances are used as are needed: every verb says what was left out, and how what it prints stands to that.
#[test]
fn what_was_left_out_of_a_molecule_is_said_by_every_verb() {
    let folder = tempfile::tempdir().unwrap();
    let proof = folder.path().join("proof.krawl");
    let proof = proof.to_str().unwrap();
    let norbornane = "tests/data/norbornane.sdf";
    let left_out = "`C3-C5`, `C1-C3`, `C1-C5` and `C2-C4` were left out";
    let unseen = format!("{left_out}, and nothing is proved of them");
    let (set, vary) = (
        "C1-C2=1.5361",
        ["--vary", "C1-C2", "--from", "1.536", "--to", "1.537"],
    );
    let ways: [(&[&str], &str); 7] = [
        (
            &["solve", norbornane],
            "with 15 of the 19 constraints the path through the sketch has exactly",
        ),
        (
            &["solve", norbornane, "--first"],
            "Left out: C3-C5, C1-C3, C1-C5, C2-C4",
        ),
        (
            &["edit", norbornane, "--set", set],
            "in the 15 equations used",
        ),
        (&["limits", norbornane, "--only", "C1-C2"], &unseen),
        (
            &[&["sweep", norbornane], &vary[..], &["--frames", "3"]].concat(),
            "was left out and is missed by at least",
        ),
        (&["tolerance", norbornane, "--default", "1e-4"], &unseen),
        (
            &["edit", norbornane, "--set", set, "--cert", proof],
            "in the 15 equations used",
        ),
    ];
    for (arguments, words) in ways {
        let output = Command::new(env!("CARGO_BIN_EXE_krawl"))
            .args(arguments)
            .output()
            .unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(text.contains(words), "{arguments:?}: {text}");
    }
    let output = Command::new(env!("CARGO_BIN_EXE_krawl"))
        .args(["verify", proof, norbornane])
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains(&unseen), "{text}");
}

/// A toggle clamp whose handle cannot open its arm by 100 degrees.
#[test]
fn the_dimension_that_is_out_of_reach_is_named() {
    let toggle = r#"name = "toggle"
dimension = 2
[points]
A = [0, 0]
B = [10, 28]
C = [55, 42]
D = [80, 5]
J = [100, 60]
[constraints]
fixed = ["A", "D"]
distances = [["A","B",30],["B","C",50],["C","D",45],["C","J",48],["D","J",58]]
angles = [["A","D","C",100]]
"#;
    let (text, code) = run("solve", toggle, &[]);
    assert_eq!(code, 0, "{text}");
    assert!(
        text.contains("the path through the sketch has no point with t = 1"),
        "{text}"
    );
    // A, B and C are on one line there: |AC| = 80, and by the law of cosines from |AD|² = 6425 and |CD| = 45
    // cos = (6425 + 2025 − 6400)/(2·45·√6425).
    let cosine = (6425.0_f64 + 2025.0 - 6400.0) / (90.0 * 6425.0_f64.sqrt());
    let degrees = cosine.acos().to_degrees();
    // That is the angle at D.
    let shown = format!("angles:A-D-C can grow to {degrees:.8}");
    assert!(text.contains(&shown), "{shown}\n{text}");
    // Within reach there is nothing to say.
    let (text, _) = run("solve", &toggle.replace("100]]", "73]]"), &[]);
    assert!(!text.contains("Led to all dimensions but one"), "{text}");
}

/// A slider P on the x axis at the end of two bars of 6 and 4, so that it reaches 10; and a point Q beside the axis.
const SLIDER: &str = r#"name = "slider"
dimension = 2
[points]
O = [0, 0]
Q = [6.5, 1]
B = [3.5, 4.873397]
P = [3, 0]
[constraints]
fixed = ["O", "Q"]
y = [["P", 0]]
distances = [["O", "B", 6], ["B", "P", 4]]
x = [["P", 3]]
"#;

/// With a distance from Q that is right at 3 and at 10 and nowhere else.
#[test]
fn a_range_does_not_run_over_figures_that_miss_a_constraint() {
    let problem = |text: &str| Problem::parse_loosely(text, "slider.toml").unwrap();
    let x_of = |problem: &Problem| {
        let mut dimensions = problem.dimensions();
        dimensions
            .find(|&index| problem.dimension_name(index).starts_with("x:"))
            .unwrap()
    };
    let alone = problem(SLIDER);
    let range = Session::open(&alone)
        .unwrap()
        .range(x_of(&alone), &mut Default::default());
    assert!(matches!(range.high, End::Limit(value, _) if (value.mid() - 10.0).abs() < 1e-9));
    // √(3.5² + 1) to the last digit that counts.
    let beside = SLIDER.replace(
        "[\"B\", \"P\", 4]]",
        "[\"B\", \"P\", 4], [\"Q\", \"P\", 3.640054944640259]]",
    );
    let both = problem(&beside);
    let mut session = Session::open(&both).unwrap();
    let names = session.account().names_left_out();
    assert_eq!(names.len(), 1, "{names:?}");
    let range = session.range(x_of(&both), &mut Default::default());
    assert!(
        matches!(&range.high, End::Unknown(value, _) if value.mid() < 4.0),
        "{:?}",
        range.high
    );
}

/// The same at the other end of its way, where branches meet at 0: the proof ends there without a limit, and Q-P is missed all along but at 6.
#[test]
fn a_range_without_a_limit_does_not_run_over_them_either() {
    let text = r#"name = "between"
dimension = 2
[points]
O = [0, 0]
B = [3, 4]
P = [6, 0]
Q = [3, 1]
[constraints]
fixed = ["O", "Q"]
y = [["P", 0]]
x = [["P", 6]]
distances = [["O", "B", 5], ["B", "P", 5], ["Q", "P", 3.1622776601683795]]
"#;
    let (text, _) = run("limits", text, &["--json", "-"]);
    let result: serde_json::Value = serde_json::from_str(&text).unwrap();
    let low = result["ranges"]["x:P"]["low"].to_string();
    assert!(low.contains("miss `Q-P`"), "{low}");
}

/// What is not out of reach is not said to be: a dimension just met at its limit; one that can be met with other coordinates held is no figure of
/// a sketch whose figures there are none of with those held.
#[test]
fn what_one_dimension_can_do_alone_is_said_of_that_alone() {
    let just = SLIDER.replace("\"P\", 3", "\"P\", 10");
    let (text, _) = run("solve", &just, &[]);
    assert!(!text.contains("Led to all"), "{text}");
    let (text, _) = run("solve", &just.replace("\"P\", 10", "\"P\", 12"), &[]);
    assert!(text.contains("x:P can grow to 10.0000"), "{text}");
    let held = "name = \"held\"\ndimension = 2\n[points]\na = [0, 0]\nb = [6, 1]\n[constraints]\nfixed = [\"a\"]\n\
                distances = [[\"a\", \"b\", 0.5]]\n";
    let (text, _) = run("solve", held, &[]);
    assert!(
        text.contains("None, proved") && !text.contains("can be met"),
        "{text}"
    );
}

/// What came of one file is not lost with what is wrong with another.
#[test]
fn other_files_keep_their_results() {
    let directory = tempfile::tempdir().unwrap();
    let [good, bad, out] =
        ["good.toml", "bad.toml", "out.json"].map(|name| directory.path().join(name));
    fs::write(&good, link("5")).unwrap();
    let twins = "name = \"twins\"\ndimension = 3\n[points]\na = [0, 0, 0]\n[planes]\np = { point = [0, 0, 0], normal = [0, 1, 0] }\n\
                 [constraints]\nfixed = [\"a\", \"p\"]\non = [[\"a\", \"p\"]]\n";
    fs::write(&bad, twins).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
    command
        .arg("solve")
        .args([&bad, &good])
        .arg("--json")
        .arg(&out);
    assert_eq!(command.output().unwrap().status.code(), Some(2));
    assert!(fs::read_to_string(&out).unwrap().contains("\"link\""));
}

/// A constraint that is left out is met where the edit begins and where it would end, as it is measured from a point as far from either
/// place of p, and is missed on the way: the limit is none of the figure.
#[test]
fn no_limit_is_reached_through_figures_that_miss_what_was_left_out() {
    let bars = "[\"a\", \"b\", 3], [\"b\", \"c\", 2.5], [\"c\", \"d\", 3.5], [\"b\", \"p\", 2], [\"c\", \"p\", 2], [\"b\", \"d\", 4]";
    let text = |q: [f64; 2], fixed: &str, more: &str| {
        format!(
            "name = \"f\"\ndimension = 2\n[points]\na = [0, 0]\nd = [5, 0]\nb = [1.8, 2.4]\nc = [4.1, 3.38]\np = [2.34, 4.33]\n\
             q = [{:.9}, {:.9}]\n[constraints]\nfixed = [\"a\", \"d\"{fixed}]\ndistances = [{bars}{more}]\n",
            q[0], q[1]
        )
    };
    let open = |text: &str| {
        let problem = Problem::parse_loosely(text, "f.toml").unwrap();
        let setting = Setting::parse(&problem, "b-d=7").unwrap();
        (Session::open(&problem).unwrap(), setting)
    };
    let (mut session, setting) = open(&text([9.0, 9.0], "", ""));
    let p = session.figure()[4];
    let limit = session.edit(std::slice::from_ref(&setting));
    assert!(matches!(limit.ending, Ending::Limit(_)));
    let there = limit.points[4].map(|x| x.mid());
    let (middle, way) = (
        [0, 1].map(|k| (p[k] + there[k]) / 2.0),
        [0, 1].map(|k| there[k] - p[k]),
    );
    let q = [middle[0] - way[1], middle[1] + way[0]];
    let far = (q[0] - p[0]).hypot(q[1] - p[1]);
    let (mut session, setting) = open(&text(q, ", \"q\"", &format!(", [\"p\", \"q\", {far:.4}]")));
    assert_eq!(session.account().left_out.len(), 1);
    let edited = session.edit(&[setting]);
    let Ending::Stopped(stop) = &edited.ending else {
        panic!("{:?}", edited.ending)
    };
    assert!(stop.text.contains("p-q"), "{}", stop.text);
    assert!(edited.t.1 < limit.t.0 && edited.points == session.points());
}

/// P at x = 3 and at x = −3 is 5 from (0, 4), and between them nearer: an edit from one to the other reaches its figure and says so, a
/// sweep stops where it sets out, and no range goes through it.
#[test]
fn what_is_met_at_both_ends_is_looked_at_on_the_way() {
    // Driven by its coordinate, which is known exactly all the way, and by a length, which is followed.
    let drives = [
        ("x = [[\"P\", 3]]", "", "x:P", [3, -3]),
        ("", "[\"P\", \"A\", 13], ", "P-A", [13, 7]),
    ];
    for (x, more, name, [from, to]) in drives {
        let text = format!(
            "name = \"f\"\ndimension = 2\n[points]\nP = [3, 0]\nA = [-10, 0]\nQ = [0, 4]\n[constraints]\nfixed = [\"A\", \"Q\"]\n{x}\n\
             distances = [{more}[\"P\", \"Q\", 5]]\ny = [[\"P\", 0]]\n"
        );
        let set = format!("{name}={to}");
        let (said, code) = run("edit", &text, &["--set", &set]);
        assert_eq!(code, 0, "{said}");
        assert!(said.contains("other figures on the way"), "{said}");
        assert!(said.contains("miss `P-Q`"), "{said}");
        assert!(said.contains("`P-Q` was left out and is met"), "{said}");
        let [from, to] = [from, to].map(|x: i32| x.to_string());
        let all = [
            "--vary", name, "--from", &from, "--to", &to, "--frames", "2",
        ];
        let (said, code) = run("sweep", &text, &all);
        assert_eq!(code, 1, "{said}");
        assert!(said.contains("miss `P-Q`"), "{said}");
        let problem = Problem::parse_loosely(&text, "f.toml").unwrap();
        let mut session = Session::open(&problem).unwrap();
        let setting = Setting::parse(&problem, &set).unwrap();
        let range = session.range(setting.index, &mut Control::default());
        // |P − Q| is 5 + 0.6 (x − 3) near x = 3, and what counts as met is the ten-millionth part of about 10.
        for (end, sign) in [(&range.low, -1.0), (&range.high, 1.0)] {
            let End::Unknown(value, _) = end else {
                panic!("{end:?}")
            };
            let beyond = sign * (value.mid() - range.value.mid());
            assert!((1e-8..1e-5).contains(&beyond), "{value:?}");
        }
    }
}

/// What is left out of Bennett's loop follows from the rest on its own branch of figures alone, where no identity tells it: that it is met is
/// enclosed all along the way from one limit to the other.
#[test]
fn what_was_left_out_of_a_bennett_loop_is_met_everywhere_between_its_limits() {
    let text = fs::read_to_string("tests/data/bennett.toml").unwrap();
    let problem = Problem::parse_loosely(&text, "bennett.toml").unwrap();
    let mut session = Session::open(&problem).unwrap();
    let setting = Setting::parse(&problem, "P1-P3=1").unwrap();
    let range = session.range(setting.index, &mut Control::default());
    for (end, wanted) in [(&range.low, 0.5), (&range.high, 2.5)] {
        let End::Limit(value, _) = end else {
            panic!("{end:?}")
        };
        assert!((value.mid() - wanted).abs() < 1e-9, "{value:?}");
    }
    assert!(!range.account.left_out.is_empty() && !range.account.meets_all());
    for one in &range.account.left_out {
        let Verdict::Met { within } = one.verdict else {
            panic!("{one:?}")
        };
        // Of tubes, not of single figures.
        assert!(within > 1e-10 && within < 2e-7, "{one:?}");
    }
    let mut frames = session.sweep(
        setting.index,
        (&"0.51".parse().unwrap(), &"2.49".parse().unwrap()),
        20,
        &mut Control::default(),
    );
    assert!(frames.end.is_none() && frames.frames.len() == 20);
    frames
        .account
        .left_out
        .retain(|one| !matches!(one.verdict, Verdict::Met { .. }));
    assert!(frames.account.left_out.is_empty(), "{:?}", frames.account);
}

/// Lengths that grow past what counts as met on the way, and come back to it at the end or at a limit: Q-P is longest where P is above Q.
#[test]
fn what_grows_past_its_tolerance_on_the_way_is_not_met_there() {
    let text = |q: &str, p: &str, x: &str, length: &str| {
        format!(
            "name = \"f\"\ndimension = 2\n[points]\nO = [0, 0]\nQ = {q}\nP = {p}\n[constraints]\nfixed = [\"O\", \"Q\"]\nx = [[\"P\", {x}]]\n\
             distances = [[\"O\", \"P\", 3], [\"Q\", \"P\", {length}]]\n"
        )
    };
    let back = text("[0, -2]", "[-1, 2.8284271247461903]", "-1", "4.93");
    for tolerance in ["5e-3", "1e-3", "0.01", "0.03", "0.05", "0.06"] {
        let more = ["--set", "x:P=1", "--redundant-tolerance", tolerance];
        let (said, code) = run("edit", &back, &more);
        assert_eq!(code, 0, "{said}");
        assert!(
            said.contains("other figures on the way"),
            "{tolerance}: {said}"
        );
        let more = [
            "--vary",
            "x:P",
            "--from",
            "-1",
            "--to",
            "1",
            "--frames",
            "2",
            "--redundant-tolerance",
            tolerance,
        ];
        assert_eq!(run("sweep", &back, &more).1, 1);
    }
    let (said, _) = run(
        "edit",
        &back,
        &["--set", "x:P=1", "--redundant-tolerance", "0.071"],
    );
    assert!(
        !said.contains("other figures") && said.contains("met within"),
        "{said}"
    );
    // It is 5 at P = (1.5, 2.598), and the path turns back at x = 3.
    let limit = text(
        "[-1, -1.7320508]",
        "[-1.4999999999999993, 2.598076211353316]",
        "-1.5",
        "4.36",
    );
    let (said, code) = run("edit", &limit, &["--set", "x:P=4"]);
    assert!(code == 1 && said.contains("miss `Q-P`"), "{said}");
    let (said, _) = run("limits", &limit, &[]);
    assert!(
        said.contains("x:P grows to -1.4") && said.contains("at least: there figures"),
        "{said}"
    );
}

/// Where the figure that would be reached is none, what was left out is told of the figure that is printed, which is the old one; by how much the
/// other misses it stands in the reason.
#[test]
fn what_was_left_out_is_told_of_the_figure_that_is_printed() {
    let text = "dimension = 2\n[points]\nA = [0, 0]\nB = [4, 0]\nC = [5, 2]\nD = [1, 2]\n[constraints]\nfixed = [\"A\", \"B\"]\n\
                distances = [[\"B\", \"C\", 2.23606797749979], [\"C\", \"D\", 4], [\"A\", \"D\", 2.23606797749979]]\n\
                parallel = [[\"A\", \"D\", \"B\", \"C\"], [\"A\", \"B\", \"D\", \"C\"]]\n";
    let (said, _) = run("edit", text, &["--set", "C-D=5"]);
    assert!(
        said.contains("the figure that meets them misses it by at least 1, proved"),
        "{said}"
    );
    assert!(
        !said.contains("left out and is missed") && !said.contains("left out and are missed"),
        "{said}"
    );
    assert!(said.contains("left out and are met within"), "{said}");
}
