//! Problem files: what is read, and what is refused with which message.

use assert_cmd::Command;
use krawl::problem::{Decimal, Problem, Target};
use proptest::prelude::*;
use std::fs;

/// The names of the files in `problems/`.
fn shipped_names() -> Vec<String> {
    let files = fs::read_dir("problems")
        .unwrap()
        .map(|file| file.unwrap().path());
    let mut names: Vec<String> = files
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "toml")
        })
        .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    names.sort_unstable();
    assert!(names.len() >= 5);
    names
}

fn shipped(name: &str) -> String {
    fs::read_to_string(format!("problems/{name}.toml")).unwrap()
}

fn krawl() -> Command {
    Command::new(env!("CARGO_BIN_EXE_krawl"))
}

fn decimal(text: &str) -> Decimal {
    text.parse().unwrap()
}

/// A braced square: 4 points, 5 distances, in the plane.
const SQUARE: &str = r#"name = "square"
dimension = 2
source = "made up"

[points]
a = [0.0, 0.0]
b = [1.0, 0.0]
c = [1.0, 1.0]
d = [0.0, 1.0]

[constraints]
distances = [
    ["a", "b", 1.1],
    ["b", "c", 1.2],
    ["c", "d", 1.3],
    ["d", "a", 1.4],
    ["a", "c", 1.5],
]

[homotopy]
reference = ["a", "b"]
bend = ["c", "d"]
bend_coefficient = 2.0
"#;

#[test]
fn the_shipped_problems_are_in_order() {
    for name in shipped_names() {
        let problem = Problem::read(format!("problems/{name}.toml")).unwrap();
        assert_eq!(problem.name, name);
        assert_eq!(problem.distances.len(), problem.free_coordinates());
        assert_eq!(problem.check(), Ok(()));
        let check = krawl()
            .args(["check", &format!("problems/{name}.toml")])
            .assert()
            .success();
        let text = String::from_utf8(check.get_output().stdout.clone()).unwrap();
        assert!(text.starts_with(&name), "{text}");
        assert!(text.contains(&format!(
            "free coordinates    {}\n",
            problem.free_coordinates()
        )));
        assert!(text.contains("(mutually constrained)"), "{text}");
    }
}

#[test]
fn decimals_are_exact() {
    let octahedron = Problem::read("problems/octahedron.toml").unwrap();
    assert_eq!(
        octahedron.distances[0].target,
        Target::Length(decimal("112e-2"))
    );
    let disulfide = Problem::read("problems/disulfide.toml").unwrap();
    assert_eq!(
        disulfide.distances[0].target,
        Target::SquaredLength(decimal("2.105"))
    );
    let text = SQUARE
        .replace("1.1]", "1_0.000_000_000_000_000_000_000_000_1]")
        .replace("1.2]", "+12e-1]")
        .replace("1.3]", "9_007_199_254_740_993]");
    let square = Problem::parse(&text, "square.toml").unwrap();
    let target = |index: usize| square.distances[index].target.clone();
    assert_eq!(
        target(0),
        Target::Length(decimal("10.0000000000000000000000001"))
    );
    assert_eq!(target(1), Target::Length(decimal("1.2")));
    // One more than a float can tell from its neighbour.
    assert_eq!(target(2), Target::Length(decimal("9007199254740993")));
}

#[test]
fn what_is_optional_has_defaults() {
    let start = SQUARE.find("[homotopy]").unwrap();
    let problem = Problem::parse(&SQUARE[..start], "square.toml").unwrap();
    assert_eq!(problem.homotopy.bend, 4);
    // A twentieth of the mean target length, whatever the unit.
    let lengths = problem.distances.iter().map(|d| match &d.target {
        Target::Length(x) => x.to_f64(),
        Target::SquaredLength(x) => x.to_f64().sqrt(),
    });
    let mean = lengths.sum::<f64>() / problem.distances.len() as f64;
    let c = problem.homotopy.bend_coefficient.to_f64();
    assert!((c - 0.05 * mean).abs() < 1e-5 * mean, "{c}");
    // The longest edge, the diagonal a-c, is the bend: the first of the sides is taken instead.
    assert_eq!(problem.homotopy.reference, [0, 1]);
    for line in [
        "reference = [\"a\", \"b\"]\n",
        "bend = [\"c\", \"d\"]\n",
        "bend_coefficient = 2.0\n",
    ] {
        assert!(Problem::parse(&SQUARE.replace(line, ""), "square.toml").is_ok());
    }
    let unnamed = SQUARE
        .replace("name = \"square\"\n", "")
        .replace("source = \"made up\"\n", "");
    assert_eq!(
        Problem::parse(&unnamed, "some/box.toml").unwrap().name,
        "box"
    );
    // Bends may be written either way round, and both kinds of lengths stand side by side.
    let reversed = SQUARE.replace("bend = [\"c\", \"d\"]", "bend = [\"d\", \"c\"]");
    assert_eq!(
        Problem::parse(&reversed, "square.toml")
            .unwrap()
            .homotopy
            .bend,
        2
    );
    let mixed = SQUARE.replace(
        "    [\"a\", \"c\", 1.5],\n]",
        "]\nsquared_distances = [[\"a\", \"c\", 2.25]]",
    );
    let mixed = Problem::parse(&mixed, "square.toml").unwrap();
    assert_eq!(
        mixed.distances[4].target,
        Target::SquaredLength(decimal("2.25"))
    );
}

#[test]
fn default_references_are_mutually_constrained() {
    for name in shipped_names() {
        let text = shipped(&name);
        let kept = text.lines().filter(|line| !line.starts_with("reference"));
        let text = kept.collect::<Vec<_>>().join("\n");
        let problem = Problem::parse(&text, "file.toml").unwrap();
        let reference = &problem.homotopy.reference;
        assert_eq!(reference.len(), problem.dimension);
        for (k, &a) in reference.iter().enumerate() {
            for &b in &reference[..k] {
                assert!(problem.are_joined(a, b), "{name}: {reference:?}");
                let bend = problem.distances[problem.homotopy.bend].points;
                assert!(!(bend == [a, b] || bend == [b, a]), "{name}: {reference:?}");
            }
        }
    }
}

#[test]
fn without_a_triangle_the_reference_has_as_many_edges_as_there_are() {
    // K4,6 is rigid in space and has no triangle.
    let mut builder = Problem::build("k46", 3);
    let place = |k: i32| [k * k % 7, k * k * k % 11, k * 5 % 13];
    for k in 0..10 {
        builder = builder.point(&format!("p{k}"), place(k + 1));
    }
    for a in 0..4 {
        for b in 4..10 {
            builder = builder.distance(&format!("p{a}"), &format!("p{b}"), 3);
        }
    }
    let problem = builder.finish().unwrap();
    let [a, b, c] = problem.homotopy.reference[..] else {
        panic!()
    };
    assert!(problem.are_joined(a, b));
    assert!(problem.are_joined(a, c) || problem.are_joined(b, c));
}

/// Name, what to replace by what in [`SQUARE`], the line that the message names, what else it says.
type Case = (
    &'static str,
    &'static str,
    &'static str,
    usize,
    &'static [&'static str],
);

#[rustfmt::skip] // one case a line
const BAD: &[Case] = &[
    ("not TOML", "dimension = 2", "dimension 2", 2, &[]),
    ("no value", "dimension = 2", "dimension =", 2, &[]),
    ("dimension 4", "dimension = 2", "dimension = 4", 2, &["dimension", "4", "2 (plane) or 3"]),
    ("dimension text", "dimension = 2", "dimension = \"2\"", 2, &["dimension", "2 or 3"]),
    ("no dimension", "dimension = 2\n", "", 0, &["dimension", "missing"]),
    ("no points", "[points]", "[point]", 5, &["point", "did you mean `points`"]),
    ("constraint outside of its table", "[points]", "[fixed]\n[points]", 5, &["fixed", "`constraints.fixed`"]),
    ("unknown key", "distances =", "distance =", 12, &["constraints.distance", "`distances`"]),
    ("unknown homotopy key", "bend_coefficient", "bend_coeficient", 23, &["homotopy.bend_coeficient", "`bend_coefficient`"]),
    ("repeated point", "c = [1.0, 1.0]", "a = [1.0, 1.0]", 8, &["`a`", "twice"]),
    ("unknown point", "[\"c\", \"d\", 1.3]", "[\"c\", \"x\", 1.3]", 15, &["constraints.distances", "c-x", "no point `x`"]),
    ("similar point", "c = [1.0", "elbow = [1.0", 14, &["no point `c`"]),
    ("too few coordinates", "c = [1.0, 1.0]", "c = [1.0]", 8, &["`c`", "1 coordinate, ", "needs 2"]),
    ("too many coordinates", "c = [1.0, 1.0]", "c = [1.0, 1.0, 0.0]", 8, &["`c`", "3 coordinates", "needs 2"]),
    ("coordinates no list", "c = [1.0, 1.0]", "c = 1.0", 8, &["points.c", "1.0"]),
    ("coordinate text", "c = [1.0, 1.0]", "c = [1.0, \"1.0\"]", 8, &["points.c", "without quotes"]),
    ("coordinate infinite", "c = [1.0, 1.0]", "c = [1.0, inf]", 8, &["points.c", "`inf`", "finite"]),
    ("coordinate nan", "c = [1.0, 1.0]", "c = [-nan, 1.0]", 8, &["points.c", "`-nan`", "finite"]),
    ("coordinate hexadecimal", "c = [1.0, 1.0]", "c = [0x10, 1.0]", 8, &["points.c", "0x10", "decimal"]),
    ("coordinate huge", "c = [1.0, 1.0]", "c = [1e70, 1.0]", 8, &["points.c", "1e70", "out of range"]),
    ("whole number beyond 64 bits", "1.3]", "12345678901234567890]", 15, &["12345678901234567890.0"]),
    ("coordinate beyond floats", "c = [1.0, 1.0]", "c = [1e999, 1.0]", 8, &["1e999"]),
    ("length infinite", "1.3]", "+inf]", 15, &["c-d", "inf", "finite"]),
    ("length zero", "1.3]", "0.0]", 15, &["c-d", "greater than zero"]),
    ("length negative", "1.3]", "-1.3]", 15, &["c-d", "-1.3", "greater than zero"]),
    ("length missing", ", 1.3]", "]", 15, &["constraints.distances", "a list of 2"]),
    ("length text", "1.3]", "\"1.3\"]", 15, &["c-d", "without quotes"]),
    ("limits the wrong way round", "1.3]", "[1.4, 1.3]]", 15, &["c-d", "the lower one first", "[1.4, 1.3]"]),
    ("one limit", "1.3]", "[1.4]]", 15, &["c-d", "limits"]),
    ("a limit in quotes", "1.3]", "[1.2, \"1.4\"]]", 15, &["c-d", "without quotes"]),
    ("a limit below zero", "1.3]", "[-0.5, 1.3]]", 15, &["a limit of the distance c-d is -0.5"]),
    ("a tolerance below zero", "1.3]", "\"1.3 ± -0.1\"]", 15, &["c-d", "limits"]),
    ("a tolerance of words", "1.3]", "\"1.3 ± some\"]", 15, &["c-d", "limits"]),
    ("a tolerance too large", "1.3]", "\"1.3 +- 2\"]", 15, &["a limit of the distance c-d is -0.7"]),
    ("limits or an expression", "[constraints]", "[parameters]\nw = 1\n[constraints]\ndx = [[\"a\", \"b\", \"90 +0.1 -0.2\"]]", 14, &["dx: a-b", "as the file has parameters"]),
    ("a computed number with limits", "[constraints]", "[parameters]\nw = 1\n[constraints]\ndx = [[\"a\", \"b\", \"w ± 0.1\"]]", 14, &["dx: a-b", "[tolerances]"]),
    ("an angle with a limit beyond 180", "[constraints]", "[constraints]\nangles = [[\"a\", \"b\", \"c\", \"179 ± 2\"]]", 12, &["a limit is 181", "180"]),
    ("point no text", "\"d\", 1.3]", "4, 1.3]", 15, &["constraints.distances", "`4`"]),
    ("distances no list", "distances = [", "squared_distances = 3\ndistances = [", 12, &["constraints.squared_distances", "`3`"]),
    ("self distance", "[\"c\", \"d\", 1.3]", "[\"c\", \"c\", 1.3]", 15, &["c-c", "itself"]),
    ("repeated distance", "[\"c\", \"d\", 1.3]", "[\"a\", \"b\", 1.3]", 15, &["a-b", "twice"]),
    ("reversed distance", "[\"c\", \"d\", 1.3]", "[\"b\", \"a\", 1.3]", 15, &["b-a", "twice"]),
    ("repeated as square", "]\n\n[homotopy]", "]\nsquared_distances = [[\"c\", \"a\", 2.0]]\n\n[homotopy]", 19, &["constraints.squared_distances", "c-a", "twice"]),
    ("squared length negative", "    [\"a\", \"c\", 1.5],\n]", "]\nsquared_distances = [[\"c\", \"a\", -2.0]]", 18, &["squared distance c-a", "greater than zero"]),
    ("one missing", "    [\"b\", \"c\", 1.2],\n", "", 11, &["2·4 − 3 = 5", "there are 4", "1 is missing", "the point b", "a, c, d"]),
    ("two missing", "    [\"b\", \"c\", 1.2],\n    [\"a\", \"c\", 1.5],\n", "", 0, &[]),
    ("one too many", "    [\"a\", \"c\", 1.5],\n", "    [\"a\", \"c\", 1.5],\n    [\"b\", \"d\", 1.5],\n", 11, &["there are 6", "1 is too many", "b-d", "c-d", "remove one"]),
    ("no distances", "distances = [", "squared_distances = []\n[homotopy]\n#", 0, &[]),
    ("lonely point", "d = [0.0, 1.0]", "d = [0.0, 1.0]\ne = [3.0, 3.0]", 12, &["2 are missing", "the point e"]),
    ("coincident", "d = [0.0, 1.0]", "d = [1.0, 1.00]", 15, &["c-d", "coincide"]),
    ("reference unknown", "reference = [\"a\", \"b\"]", "reference = [\"a\", \"z\"]", 21, &["homotopy.reference", "no point `z`"]),
    ("reference too short", "reference = [\"a\", \"b\"]", "reference = [\"a\"]", 21, &["homotopy.reference", "1 point, ", "needs 2"]),
    ("reference too long", "reference = [\"a\", \"b\"]", "reference = [\"a\", \"b\", \"c\"]", 21, &["3 points", "needs 2"]),
    ("reference repeated", "reference = [\"a\", \"b\"]", "reference = [\"a\", \"a\"]", 21, &["`a` twice"]),
    ("reference numbers", "reference = [\"a\", \"b\"]", "reference = [1, 2]", 21, &["homotopy.reference", "`1`"]),
    ("bend unknown", "bend = [\"c\", \"d\"]", "bend = [\"c\", \"z\"]", 22, &["homotopy.bend", "no point `z`"]),
    ("bend no distance", "bend = [\"c\", \"d\"]", "bend = [\"b\", \"d\"]", 22, &["homotopy.bend", "b-d", "not one of the distances"]),
    ("bend of three", "bend = [\"c\", \"d\"]", "bend = [\"b\", \"d\", \"a\"]", 22, &["homotopy.bend", "3 points"]),
    ("coefficient nan", "bend_coefficient = 2.0", "bend_coefficient = nan", 23, &["homotopy.bend_coefficient", "finite"]),
    ("coefficient text", "bend_coefficient = 2.0", "bend_coefficient = true", 23, &["homotopy.bend_coefficient", "true"]),
    ("empty name", "name = \"square\"", "name = \"\"", 1, &["name"]),
    ("empty point name", "d = [0.0", "\"\" = [0.0", 9, &["name"]),
    ("source a number", "source = \"made up\"", "source = 1", 3, &["source"]),
    ("constraints no table", "[constraints]", "constraints = 1\n[x]", 0, &[]),
];

#[test]
fn bad_input_is_refused_with_place_and_names() {
    for &(what, from, to, line, says) in BAD {
        // Two cases replace lines that are not neighbours.
        let text = if from.matches('\n').count() > 1 && !SQUARE.contains(from) {
            from.lines().fold(SQUARE.to_owned(), |text, line| {
                text.replace(&format!("{line}\n"), to)
            })
        } else {
            assert!(SQUARE.contains(from), "{what}");
            SQUARE.replacen(from, to, 1)
        };
        let message = match Problem::parse(&text, "dir/square.toml") {
            Ok(_) => panic!("{what}: accepted"),
            Err(error) => error.to_string(),
        };
        let place = match line {
            0 => "dir/square.toml:".to_owned(),
            line => format!("dir/square.toml:{line}: "),
        };
        assert!(message.starts_with(&place), "{what}: {message}");
        assert!(!message.contains('\n'), "{what}: {message}");
        for part in says {
            assert!(message.contains(part), "{what}: `{part}` not in: {message}");
        }
    }
}

/// A number with limits is their middle, or what it is written with; and it is written so again.
#[test]
fn numbers_have_limits() {
    for (written, number, low, high, again) in [
        ("[1.2, 1.35]", "1.275", "1.2", "1.35", "\"1.275 ± 0.075\""),
        ("[1, 1]", "1", "1", "1", "\"1 ± 0\""),
        ("\"1.3 ± 0.05\"", "1.3", "1.25", "1.35", "\"1.3 ± 0.05\""),
        ("\"1.3±0.05\"", "1.3", "1.25", "1.35", "\"1.3 ± 0.05\""),
        ("\"1.3 +- 5e-2\"", "1.3", "1.25", "1.35", "\"1.3 ± 5e-2\""),
        ("\"1.3 +/- 0.05\"", "1.3", "1.25", "1.35", "\"1.3 ± 0.05\""),
        (
            "\"1.3 +0.1 -0.2\"",
            "1.3",
            "1.1",
            "1.4",
            "\"1.3 +0.1 -0.2\"",
        ),
        (
            "\"1.3 −0.2 +0.1\"",
            "1.3",
            "1.1",
            "1.4",
            "\"1.3 +0.1 -0.2\"",
        ),
        ("\"1.3 0 -0.2\"", "1.3", "1.1", "1.3", "\"1.3 +0 -0.2\""),
        (
            "\"1.3 +0.2 +0.1\"",
            "1.3",
            "1.4",
            "1.5",
            "\"1.3 +0.2 +0.1\"",
        ),
    ] {
        let text = SQUARE.replacen("1.3]", &format!("{written}]"), 1);
        let problem = Problem::parse(&text, "square.toml").unwrap();
        let index = problem.distances.iter().position(
            |d| matches!(&d.target, Target::Length(number) if number.tolerance().is_some()),
        );
        let Target::Length(length) = &problem.distances[index.unwrap()].target else {
            unreachable!("it is a length")
        };
        assert_eq!(*length, decimal(number), "{written}");
        assert_eq!(length.limits(), Some([low, high].map(decimal)), "{written}");
        let once = problem.to_toml();
        assert!(once.contains(&format!("\"d\", {again}]")), "{once}");
        let back = Problem::parse(&once, "again.toml").unwrap();
        assert_eq!(once, back.to_toml());
    }
}

/// An edit keeps the tolerances of a file, and nothing else of it changes.
#[test]
fn edits_keep_limits() {
    let folder = tempfile::tempdir().unwrap();
    let [file, out] = ["in.toml", "out.toml"].map(|name| folder.path().join(name));
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [0, 3]\n[constraints]\n\
                distances = [[\"a\", \"b\", [3.9, 4.1]], [\"a\", \"c\", \"3 +0.1 -0.2\"]] # two\n\
                angles = [[\"b\", \"a\", \"c\", \"90 +- 0.5\"]]\n";
    fs::write(&file, text).unwrap();
    let run = |set: &[&str]| {
        let arguments = set.iter().flat_map(|one| ["--set", one]);
        let mut command = krawl();
        command.arg("edit").arg(&file).args(arguments);
        command.arg("--out").arg(&out).output().unwrap()
    };
    let done = run(&["a-b=5", "a-c=2", "angles:b-a-c=80"]);
    assert_eq!(done.status.code(), Some(0), "{done:?}");
    let written = fs::read_to_string(&out).unwrap();
    for part in [
        "[\"a\", \"b\", [4.9, 5.1]], [\"a\", \"c\", \"2 +0.1 -0.2\"]] # two",
        "[\"b\", \"a\", \"c\", \"80 ± 0.5\"]",
    ] {
        assert!(written.contains(part), "{written}");
    }
    // What could not be read again is not written.
    let done = run(&["a-c=0.15"]);
    let error = String::from_utf8_lossy(&done.stderr).into_owned();
    assert!(
        done.status.code() == Some(2) && error.contains("narrower"),
        "{done:?}"
    );
}

#[test]
fn the_program_refuses_bad_input_with_code_2_and_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let (file, json) = (
        folder.path().join("bad.toml"),
        folder.path().join("out.json"),
    );
    for &(what, from, to, _, _) in BAD {
        fs::write(&file, SQUARE.replacen(from, to, 1)).unwrap();
        if Problem::read(&file).is_ok() {
            continue; // one of the two cases that need more than one replacement
        }
        for verb in ["check", "solve"] {
            if (what, verb) == ("one too many", "solve") {
                continue; // it is left out, and the figures are tested for it
            }
            let mut command = krawl();
            command.arg(verb).arg(&file);
            if verb == "solve" {
                command.arg("--json").arg(&json);
            }
            let output = command.output().unwrap();
            let over = String::from_utf8_lossy(&output.stdout).contains("\ntoo many\n");
            assert_eq!(
                output.status.code(),
                Some(if over { 6 } else { 2 }),
                "{what}"
            );
            let message = String::from_utf8(output.stderr).unwrap();
            assert_eq!(message.lines().count(), 1, "{what}: {message}");
            assert!(message.contains("bad.toml:"), "{what}: {message}");
            assert!(!message.contains("panicked"), "{what}: {message}");
            // Of what has too few constraints, or too many, `check` says what it understood, and what is free.
            let said = String::from_utf8(output.stdout).unwrap();
            let is_loose = said.contains(": not in order: ")
                && said.contains("\n  source ")
                && said.contains("\nblocks\n");
            assert!(
                said.is_empty() || (verb == "check" && is_loose),
                "{what}: {said}"
            );
            assert!(!json.exists(), "{what}");
        }
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn structure_is_checked_in_the_plane_and_in_space() {
    // A square braced twice with a bar hanging off: as many distances as needed.
    let text = SQUARE
        .replace("d = [0.0, 1.0]", "d = [0.0, 1.0]\ne = [2.0, 2.0]")
        .replace(
            "1.5],\n",
            "1.5],\n    [\"b\", \"d\", 1.5],\n    [\"c\", \"e\", 1.5],\n",
        );
    let message = Problem::parse(&text, "f.toml").unwrap_err().to_string();
    for part in [
        "f.toml:19: ",
        "over-constrained among the points a, b, c, d",
        "any of the 6 distances a-b, b-c, c-d, d-a, a-c, b-d",
        "the point e can move against the rigid part a, b, c, d",
    ] {
        assert!(message.contains(part), "{part}: {message}");
    }

    // The double banana, whose every count is right.
    let mut builder = Problem::build("bananas", 3)
        .point("top", [0, 0, 9])
        .point("bottom", [0, 0, 0]);
    for (side, x) in [("l", -3), ("r", 3)] {
        let name = |k: i32| format!("{side}{k}");
        for k in 0..3 {
            builder = builder
                .point(&name(k), [x + k, k * k, 4 + k])
                .distance("top", &name(k), 5)
                .distance("bottom", &name(k), 5)
                .distance(&name(k), &name((k + 1) % 3), 2);
        }
    }
    let message = builder.finish().unwrap_err().to_string();
    assert!(
        message.contains(
            "the points r0, r1, r2 can move against the rigid part top, bottom, l0, l1, l2"
        ),
        "{message}"
    );
    assert!(message.contains("any of the 18 distances"), "{message}");
}

#[test]
fn degenerate_references_in_space_are_refused() {
    let text = shipped("octahedron");
    let with = |p4: &str| {
        text.replace("p4 = [1.2, 0.5, 1.5]", p4).replace(
            "reference = [\"p1\", \"p2\", \"p3\"]",
            "reference = [\"p1\", \"p3\", \"p4\"]",
        )
    };
    assert!(Problem::parse(&with("p4 = [1.2, 0.5, 1.5]"), "o.toml").is_ok());
    // On the line p1-p3 exactly, although 3 · 1.3 is not 3.9 in floats.
    let message = Problem::parse(&with("p4 = [1.5, 3.9, 0.0]"), "o.toml")
        .unwrap_err()
        .to_string();
    for part in ["homotopy.reference", "`p1`, `p3` and `p4`", "one line"] {
        assert!(message.contains(part), "{message}");
    }
    let message = Problem::parse(&with("p4 = [0, 0, 0]"), "o.toml")
        .unwrap_err()
        .to_string();
    assert!(message.contains("`p1` and `p4` coincide"), "{message}");
    let flat = Problem::build("flat", 3)
        .point("a", [0, 0, 0])
        .point("b", [1, 0, 0])
        .point("c", [2, 0, 0])
        .distance("a", "b", 1)
        .distance("b", "c", 1)
        .distance("c", "a", 1);
    assert!(flat.finish().unwrap_err().to_string().contains("one line"));
}

#[test]
fn unreadable_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    };
    let many: String = (0..1001).map(|k| format!("p{k} = [{k}, 1]\n")).collect();
    let many = format!("dimension = 2\n[points]\n{many}[constraints]\n");
    let deep = format!("a = {}", "[".repeat(100_000));
    for (path, says) in [
        (folder.path().join("missing.toml"), "cannot be read"),
        (folder.path().to_owned(), "cannot be read"),
        (
            file("large.toml", &vec![b'#'; (1 << 20) + 1]),
            "larger than",
        ),
        (
            file("latin.toml", b"# one\n# caf\xe9\n"),
            "latin.toml:2: is not a text in UTF-8",
        ),
        (file("many.toml", many.as_bytes()), "1001 points"),
        (file("deep.toml", deep.as_bytes()), "deep.toml:1: "),
        (file("empty.toml", b""), "dimension: is missing"),
        (file("zeros.toml", &[0; 100]), "zeros.toml:1: "),
    ] {
        let output = krawl()
            .arg("solve")
            .arg(&path)
            .assert()
            .code(2)
            .get_output()
            .clone();
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.contains(says), "{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
    }
}

#[test]
fn bad_arguments_are_refused() {
    let octahedron = "problems/octahedron.toml";
    for arguments in [
        vec!["solve"],
        vec!["solve", octahedron, "--alpha", "0"],
        vec!["solve", octahedron, "--alpha", "0.5"],
        vec!["solve", octahedron, "--alpha", "nan"],
        vec!["solve", octahedron, "--max-step", "0"],
        vec!["solve", octahedron, "--max-step", "inf"],
        vec!["solve", octahedron, "--max-step=-1"],
        vec!["solve", octahedron, "--mode", "exact"],
        vec!["solve", octahedron, "--preset", "paper"],
        vec!["solve", octahedron, "--json", "missing/folder/out.json"],
        vec!["solve", octahedron, "--json", "problems"],
        vec!["draw", octahedron],
    ] {
        let output = krawl()
            .args(&arguments)
            .assert()
            .code(2)
            .get_output()
            .clone();
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(
            !message.is_empty() && !message.contains("panicked"),
            "{arguments:?}: {message}"
        );
    }
    krawl().arg("--help").assert().code(0);
    krawl().args(["solve", "--help"]).assert().code(0);
}

/// A random problem: a triangle or tetrahedron, to which points are added one by one, each joined
/// to as many others as there are dimensions (Henneberg's first step).
fn random_problem() -> impl Strategy<Value = Problem> {
    let number =
        || (-999_999i64..999_999, 0u32..7).prop_map(|(digits, shift)| format!("{digits}e-{shift}"));
    let length = || (1i64..999_999, 0u32..7, any::<bool>());
    let point = move || {
        (
            prop::array::uniform3(number()),
            prop::collection::vec(length(), 3),
            any::<u64>(),
        )
    };
    (
        2usize..4,
        "[ -~é]{0,12}",
        prop::collection::vec(point(), 3..12),
        0..99i32,
    )
        .prop_filter_map("points coincide", |(dimension, text, points, c)| {
            let name = |k: usize| {
                format!(
                    "p{k} {}",
                    &text[..text.len().min(if text.is_ascii() { k } else { 0 })]
                )
            };
            let mut builder = Problem::build("random", dimension).source(&text);
            for (k, (coordinates, lengths, seed)) in points.iter().enumerate() {
                builder = builder.point(
                    &name(k),
                    coordinates.iter().take(dimension).map(String::as_str),
                );
                // `dimension` different ones of the points before.
                let first = *seed as usize % k.max(1);
                for (j, (digits, shift, squared)) in
                    lengths.iter().enumerate().take(dimension.min(k))
                {
                    let other = name((first + j) % k);
                    let value = format!("{digits}e-{shift}");
                    builder = if *squared {
                        builder.squared_distance(&name(k), &other, value.as_str())
                    } else {
                        builder.distance(&other, &name(k), value.as_str())
                    };
                }
            }
            builder.bend_coefficient(c).finish().ok()
        })
}

proptest! {
    #[test]
    fn what_is_written_reads_back_equal(problem in random_problem()) {
        let text = problem.to_toml();
        let again = Problem::parse(&text, "again.toml");
        prop_assert!(again.is_ok(), "{}\n{}", again.unwrap_err(), text);
        prop_assert_eq!(again.unwrap(), problem);
    }

    #[test]
    fn mutilated_files_never_panic(
        which in any::<prop::sample::Index>(),
        wounds in prop::collection::vec((0..3u8, any::<prop::sample::Index>(), 1usize..40, any::<u8>()), 1..4),
    ) {
        let names = shipped_names();
        let mut bytes = shipped(&names[which.index(names.len())]).into_bytes();
        for (kind, at, length, byte) in wounds {
            if bytes.is_empty() {
                break;
            }
            let at = at.index(bytes.len());
            let end = (at + length).min(bytes.len());
            match kind {
                0 => drop(bytes.drain(at..end)),
                1 => {
                    let piece = bytes[at..end].to_vec();
                    bytes.splice(at..at, piece);
                }
                _ => bytes[at] ^= byte,
            }
        }
        match Problem::parse(&String::from_utf8_lossy(&bytes), "hurt.toml") {
            // Where the damage left a problem (a digit changed, say), it is one that checks.
            Ok(problem) => prop_assert_eq!(problem.check(), Ok(())),
            Err(error) => prop_assert!(error.to_string().starts_with("hurt.toml:")),
        }
    }
}

#[test]
fn a_body_is_the_frame_of_what_hangs_on_it() {
    let text = "dimension = 3\n[points]\n\
        b1 = [0, 0, 0]\nb2 = [4, 0, 0]\nb3 = [2, 3, 0]\nb4 = [2, 1, 0]\n\
        p1 = [1, 1, 3]\np2 = [3, 1, 3.2]\np3 = [2, 2, 3.1]\n\
        [bodies]\nbase = { b1 = [0, 0, 0], b2 = [4, 0, 0], b3 = [2, 3, 0], b4 = [2, 1, 0] }\n\
        [constraints]\ndistances = [[\"p1\", \"p2\", 2], [\"p2\", \"p3\", 1.5], [\"p3\", \"p1\", 1.4], \
        [\"b1\", \"p1\", 3], [\"b2\", \"p2\", 3.1], [\"b3\", \"p3\", 3.2], [\"b2\", \"p1\", 4.1], \
        [\"b3\", \"p2\", 3.9], [\"b1\", \"p3\", 3.8]]\n";
    let problem = Problem::parse(text, "robot").unwrap();
    // Its roundest triangle, in the order of the file.
    assert_eq!(problem.homotopy.reference, [0, 1, 2]);
}
