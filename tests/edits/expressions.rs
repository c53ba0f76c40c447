//! Expressions of FreeCAD's files: what they compute follows where dimensions and cells are set, and what does not is said.

use crate::real_files::freecad::{archive, constraint, line, sketch};
use assert_cmd::Command;
use krawl::edit::{Session, Setting};
use krawl::import::{self, Followed, Imported};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

/// A corner at the origin: `wide` to the right, `high` up from its end, and an angle `turn` from the x axis to a line of the length `long`
/// from the origin; with these numbers and expressions, and the cells of a spreadsheet `Sheet`.
fn corner(
    numbers: [f64; 4],
    expressions: &[(&str, &str)],
    cells: &[(&str, &str, &str)],
) -> Vec<u8> {
    let cells: String = cells
        .iter()
        .map(|(address, alias, text)| {
            format!(
                "<Cell address=\"{address}\" content=\"{}\" alias=\"{alias}\"/>",
                escaped(text)
            )
        })
        .collect();
    let label = "<Property name=\"Label\"><String value=\"my sizes\"/></Property>";
    let cells = format!("{label}<Property name=\"cells\"><Cells>{cells}</Cells></Property>");
    let sheet = ("Spreadsheet::Sheet", "Sheet", &cells[..]);
    beside(
        numbers,
        expressions,
        &[sheet, ("PartDesign::Pad", "Pad", "")],
    )
}

fn escaped(text: &str) -> String {
    text.replace('<', "&lt;").replace('"', "&quot;")
}

/// The corner, with other objects: their kinds, names and properties.
fn beside(
    [wide, high, long, turn]: [f64; 4],
    expressions: &[(&str, &str)],
    others: &[(&str, &str, &str)],
) -> Vec<u8> {
    let (sin, cos) = turn.to_radians().sin_cos();
    let constraints = [
        constraint("", 1, 0.0, &[(0, 1), (-1, 1)]),
        constraint("", 2, 0.0, &[(0, 0)]),
        constraint("", 1, 0.0, &[(0, 2), (1, 1)]),
        constraint("", 3, 0.0, &[(1, 0)]),
        constraint("wide", 6, wide, &[(0, 0)]),
        constraint("high", 8, high, &[(1, 1), (1, 2)]),
        constraint("", 1, 0.0, &[(2, 1), (-1, 1)]),
        constraint("long", 6, long, &[(2, 0)]),
        constraint("turn", 9, turn.to_radians(), &[(0, 1), (2, 1)]),
    ];
    let geometry = line([0.0, 0.0, wide, 0.0])
        + &line([wide, 0.0, wide, high])
        + &line([0.0, 0.0, long * cos, long * sin]);
    let expressions: String = expressions
        .iter()
        .map(|(path, text)| {
            format!(
                "<Expression path=\"{path}\" expression=\"{}\"/>",
                escaped(text)
            )
        })
        .collect();
    let sketch = sketch(&constraints.concat(), &geometry, &expressions);
    archive(&[&[("Sketcher::SketchObject", "Sketch", &sketch[..])], others].concat())
}

fn read(bytes: &[u8]) -> Imported {
    import::read("corner.FCStd", bytes, None).unwrap()
}

/// A property of a `VarSet`, as FreeCAD 1.0 writes it.
fn property(kind: &str, name: &str, value: &str) -> String {
    format!(
        "<Property name=\"{name}\" type=\"App::Property{kind}\" group=\"Base\" doc=\"\" attr=\"0\" ro=\"0\" hide=\"0\">{value}</Property>"
    )
}

/// Variables of a `VarSet` are named, computed from one another and set.
#[test]
fn variables_are_read_and_set() {
    let number = |kind: &str, name: &str, value: &str| {
        property(kind, name, &format!("<Float value=\"{value}\"/>"))
    };
    let variables = [
        property("String", "Label", "<String value=\"sizes\"/>"),
        number("Length", "width", "20.0000000000000000"),
        number("Distance", "low", "12.0000000000000000"),
        property("Integer", "n", "<Integer value=\"2\"/>"),
        number("Area", "area", "7.0"),
        property(
            "ExpressionEngine",
            "ExpressionEngine",
            "<ExpressionEngine count=\"1\"><Expression path=\"low\" expression=\"width / 2 + 2 mm\"/></ExpressionEngine>",
        ),
    ];
    let expressions = [
        ("Constraints.wide", "VarSet.width"),
        ("Constraints.high", "<<sizes>>.low"),
        ("Constraints.long", "VarSet.n * VarSet.width"),
    ];
    let variables = variables.concat();
    let bytes = beside(
        [20.0, 12.0, 40.0, 30.0],
        &expressions,
        &[("App::VarSet", "VarSet", &variables)],
    );
    let directory = tempfile::tempdir().unwrap();
    let [file, out] = ["a.FCStd", "b.FCStd"].map(|name| directory.path().join(name));
    fs::write(&file, bytes).unwrap();
    let set =
        |file: &Path, to: &str| run(file, &["edit", "--set", to, "--out", out.to_str().unwrap()]);
    let (code, text) = set(&file, "VarSet.width=30");
    for words in [
        "wide to 30, computed",
        "high to 17, computed",
        "long to 60, computed",
    ] {
        assert!(code == 0 && text.contains(words), "{words}: {text}");
    }
    let edited = read(&fs::read(&out).unwrap());
    // What is computed there is written, too.
    assert!(
        edited.tied.iter().all(|tied| tied.fault.is_none()),
        "{:?}",
        edited.tied
    );
    let (code, text) = set(&out.clone(), "VarSet.n=3");
    assert!(code == 0 && text.contains("long to 90, computed"), "{text}");
    let twice = ["--set", "VarSet.n=3", "--set", "VarSet.n=4"];
    let (code, text) = run(&file, &[&["edit"], &twice[..]].concat());
    assert!(
        code == 2 && text.contains("VarSet.n is set twice"),
        "{text}"
    );
    for (to, words) in [
        ("VarSet.n=2.5", "is a whole number in the file"),
        ("VarSet.low=3", "is computed, by `width / 2 + 2 mm`"),
        ("VarSet.area=3", "VarSet.area"),
        ("VarSet.width=wide", "no number"),
    ] {
        let (code, text) = set(&file, to);
        assert!(code == 2 && text.contains(words), "{words}: {text}");
    }
}

/// A whole number that would come to a part of one is not followed.
#[test]
fn a_whole_variable_stays_whole() {
    let variables = [
        property("Length", "width", "<Float value=\"20.0\"/>"),
        property("Integer", "n", "<Integer value=\"2\"/>"),
        property(
            "ExpressionEngine",
            "ExpressionEngine",
            "<ExpressionEngine><Expression path=\"n\" expression=\"width / 10 mm\"/></ExpressionEngine>",
        ),
    ];
    let variables = variables.concat();
    let bytes = beside(
        [20.0, 12.0, 40.0, 30.0],
        &[("Constraints.long", "VarSet.n * 20 mm")],
        &[("App::VarSet", "VarSet", &variables)],
    );
    for (to, led, warned) in [("30", 1, 0), ("25", 0, 1)] {
        let mut imported = read(&bytes);
        assert_eq!(imported.set_cell("VarSet.width", to), Some(Ok(())));
        let (set, warnings) = followed(&imported, &[]);
        assert_eq!(
            (set.len(), warnings.len()),
            (led, warned),
            "{set:?} {warnings:?}"
        );
        assert!(
            warnings
                .iter()
                .all(|text| text.contains("VarSet.n is a whole number in the file, and 2.5 by it")),
            "{warnings:?}"
        );
    }
}

/// What follows where dimensions are set: names and numbers, and the warnings.
fn followed(imported: &Imported, set: &[&str]) -> (Vec<(String, String)>, Vec<String>) {
    let problem = &imported.problem;
    let set = set
        .iter()
        .map(|text| Setting::parse(problem, text).unwrap());
    let set: Vec<Setting> = set.collect();
    let Followed { set, warnings } = imported.followed(problem, &set);
    let named = |f: &import::Follower| (problem.dimension_name(f.index), f.value.to_string());
    (set.iter().map(named).collect(), warnings)
}

fn numbers(of: &[(&str, &str)]) -> Vec<(String, String)> {
    let both = |(name, number): &(&str, &str)| ((*name).to_owned(), (*number).to_owned());
    of.iter().map(both).collect()
}

/// Runs the program on the file: its exit code, and all that it says.
fn run(file: &Path, arguments: &[&str]) -> (i32, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
    let output = command.arg(arguments[0]).arg(file).args(&arguments[1..]);
    let output = output.output().unwrap();
    let text = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    (output.status.code().unwrap(), text)
}

#[test]
fn what_is_tied_follows() {
    // Names with and without the object, its label or the point before it, by number, and through one another.
    let bytes = corner(
        [20.0, 12.0, 26.0, 30.0],
        &[
            ("Constraints.high", "Constraints.wide / 2 + 2 mm"),
            (
                ".Constraints[7]",
                "Sketch.Constraints.high * 2 + .Constraints[4] / 10",
            ),
            ("Constraints.turn", "Constraints.wide.Value * 1.5"),
        ],
        &[],
    );
    let imported = read(&bytes);
    let (set, warnings) = followed(&imported, &["wide=90"]);
    let wanted = [("long", "103"), ("turn", "135"), ("high", "47")];
    let mut wanted = numbers(&wanted);
    wanted.sort();
    let mut found = set.clone();
    found.sort();
    assert_eq!((found, warnings.len()), (wanted, 0), "{warnings:?}");
    // An angle that is set moves nothing; what has an expression is set back there, and what is tied to it goes with it here.
    assert_eq!(followed(&imported, &["long=27"]).0, []);
    let (set, warnings) = followed(&imported, &["high=14"]);
    assert_eq!(set, numbers(&[("long", "30")]));
    assert!(warnings[0].starts_with("high has the expression `Constraints.wide / 2 + 2 mm`"));
    // Both are set: what is tied to both follows from both.
    let (set, _) = followed(&imported, &["high=14", "wide=40"]);
    assert!(
        set.contains(&("long".to_owned(), "32".to_owned())),
        "{set:?}"
    );
}

#[test]
fn the_file_has_what_followed() {
    let directory = tempfile::tempdir().unwrap();
    let (file, out) = (
        directory.path().join("a.FCStd"),
        directory.path().join("b.FCStd"),
    );
    let expressions = [
        ("Constraints.high", "-Constraints.wide / 2"),
        ("Constraints.long", "max(26 mm; Constraints.wide)"),
        (
            "Constraints.turn",
            "30 deg + (Constraints.wide - 20 mm) / 1 mm * 1 deg",
        ),
    ];
    fs::write(&file, corner([20.0, -10.0, 26.0, 30.0], &expressions, &[])).unwrap();
    let asked = ["edit", "--set", "wide=60", "--out", out.to_str().unwrap()];
    let (code, text) = run(&file, &asked);
    assert_eq!(code, 0, "{text}");
    for words in [
        "led with it         high to -30, computed in floats by the file's `-Constraints.wide / 2`",
        "led with it         long to 60, computed",
        "led with it         turn to 70, computed",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert!(!text.contains("warning"), "{text}");
    let edited = read(&fs::read(&out).unwrap());
    let figure = Session::open(&edited.problem).unwrap();
    let at = |name: &str| {
        let point = edited.problem.points.iter().position(|p| p.name == name);
        figure.figure()[point.unwrap()]
    };
    let [x, y, _] = at("e2.end");
    assert!((x - 60.0).abs() < 1e-9 && (y + 30.0).abs() < 1e-9);
    let [x, y, _] = at("e3.end");
    assert!((y.atan2(x).to_degrees() - 70.0).abs() < 1e-9 && (x.hypot(y) - 60.0).abs() < 1e-9);
    // The numbers in the file are those of the expressions, so that nothing is out of date.
    assert!(
        edited.tied.iter().all(|tied| tied.fault.is_none()),
        "{:?}",
        edited.tied
    );
    let (code, text) = run(&out, &["edit", "--set", "wide=20"]);
    assert!(
        code == 0 && text.contains("turn to 30, computed") && text.contains("long to 26, computed"),
        "{text}"
    );

    // As JSON, and in a session of edits, where what was set before counts.
    let (_, text) = run(&file, &["edit", "--set", "wide=60", "--json", "-"]);
    let result: Value = serde_json::from_str(&text).unwrap();
    let [high, ..] = &result["followed"].as_array().unwrap()[..] else {
        panic!("{text}")
    };
    assert!(result["warnings"].as_array().unwrap().is_empty());
    assert_eq!(high["expression"], json!("-Constraints.wide / 2"));
    let mut serve = Command::new(env!("CARGO_BIN_EXE_krawl"));
    let serve = serve.args(["edit", file.to_str().unwrap(), "--serve"]);
    let lines = "{\"set\": {\"wide\": 40}}\n{\"set\": {\"wide\": 44}, \"probe\": true}\n{\"set\": {\"long\": 27}}\n";
    let answers = serve.write_stdin(lines).output().unwrap().stdout;
    let answers = String::from_utf8(answers).unwrap();
    let answers: Vec<Value> = answers
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let value = |answer: &Value, name: &str| {
        let all = answer["followed"].as_array().cloned().unwrap_or_default();
        let one = all.into_iter().find(|one| one["dimension"] == name);
        one.and_then(|one| one["value"].as_f64())
    };
    assert_eq!(value(&answers[0], "high"), Some(-20.0), "{answers:?}");
    assert_eq!(value(&answers[1], "turn"), Some(54.0), "{answers:?}");
    assert_eq!(value(&answers[2], "turn"), None, "{answers:?}");
}

#[test]
fn cells_are_read_and_set() {
    let directory = tempfile::tempdir().unwrap();
    let (file, out) = (
        directory.path().join("a.FCStd"),
        directory.path().join("b.FCStd"),
    );
    let cells = [
        ("A1", "", "'wide"),
        ("B1", "width", "=2 cm"),
        ("B2", "", "=B1 / 2 + $B$3 * 1 mm"),
        ("B3", "more", "2"),
        ("B4", "foot", "=2\""),
    ];
    let expressions = [
        ("Constraints.wide", "Sheet.width"),
        ("Constraints.high", "<<my sizes>>.B2"),
        ("Constraints.long", "Sheet.foot / 1 in * Constraints.wide"),
    ];
    fs::write(
        &file,
        corner([20.0, 12.0, 40.0, 30.0], &expressions, &cells),
    )
    .unwrap();
    let set = |name: &str, to: &str, out: &Path| {
        let set = format!("{name}={to}");
        run(
            &file,
            &["edit", "--set", &set, "--out", out.to_str().unwrap()],
        )
    };
    // In the unit of the cell: 2 cm become 3.
    let (code, text) = set("Sheet.width", "3", &out);
    assert_eq!(code, 0, "{text}");
    for words in [
        "wide to 30, computed",
        "high to 17, computed",
        "long to 60, computed",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let edited = read(&fs::read(&out).unwrap());
    assert!(
        edited.tied.iter().all(|tied| tied.fault.is_none()),
        "{:?}",
        edited.tied
    );
    let (code, text) = set("<<my sizes>>.foot", "3.5", &out);
    assert!(
        code == 0 && text.contains("long to 70, computed") && !text.contains("high to"),
        "{text}"
    );
    let edited = read(&fs::read(&out).unwrap());
    assert!(
        edited.tied.iter().all(|tied| tied.fault.is_none()),
        "{:?}",
        edited.tied
    );
    // A column of cells, each from the one above.
    let column: Vec<[String; 2]> = (1..200)
        .map(|k| [format!("C{k}"), format!("=C{} + 0.1 mm", k - 1)])
        .collect();
    let first = [("C0", "first", "=1 mm")];
    let column = column
        .iter()
        .map(|[address, text]| (&**address, "", &**text));
    let column: Vec<_> = first.into_iter().chain(column).collect();
    let expressions = [("Constraints.high", "Sheet.C199 - 8.9 mm")];
    let imported = read(&corner([20.0, 12.0, 40.0, 30.0], &expressions, &column));
    let mut other = imported.clone();
    assert_eq!(other.set_cell("Sheet.first", "4"), Some(Ok(())));
    let found = other.followed(&other.problem, &[]).set;
    assert!((found[0].value.to_f64() - 15.0).abs() < 1e-9, "{found:?}");
    let faults: Vec<_> = imported.tied.iter().map(|tied| &tied.fault).collect();
    assert_eq!(faults, [&None]);
    // What is computed, a text, or no number is not set, and what nothing follows from changes nothing.
    for (name, to, words) in [
        ("Sheet.B2", "3", "is computed, by `B1 / 2 + $B$3 * 1 mm`"),
        ("Sheet.A1", "3", "is no number"),
        ("Sheet.width", "three", "`three` is no number"),
        ("Sheet.B9", "3", "there is no dimension `Sheet.B9`"),
        ("Sheet.width", "-3", "greater than 0"),
    ] {
        let (code, text) = set(name, to, &out);
        assert!(code == 2 && text.contains(words), "{name}: {text}");
    }
    let alone = corner([20.0, 12.0, 40.0, 30.0], &[], &cells);
    fs::write(&file, alone).unwrap();
    let (code, text) = set("Sheet.width", "3", &out);
    assert!(
        code == 2 && text.contains("no dimension of the sketch follows from"),
        "{text}"
    );
}

#[test]
fn what_does_not_follow_is_said() {
    for (expression, words) in [
        (
            "Pad.Length / 2",
            "`Pad.Length` is neither a dimension of a sketch nor a cell",
        ),
        ("Constraints.wide * 2 kg", "no unit of lengths or angles"),
        (
            "Constraints.wide ^ 2 / 33.333 mm ^ 2 * 1 deg",
            "is no length",
        ),
        (
            "vector(Constraints.wide; 1; 2)",
            "no function `vector` of 3 numbers",
        ),
        (
            "Constraints.wide / 2 + 3 mm",
            "by it high is 13 mm, and the file has 12 mm",
        ),
        (
            "Constraints.long - 14 mm",
            "goes round in a circle, high from long from high",
        ),
        (
            "Constraints.Constraint2 * 1 mm",
            "is neither a dimension of a sketch nor a cell",
        ),
        (
            "Constraints[1] * 1 mm",
            "Constraint2 is neither a length nor an angle",
        ),
        ("Sheet.B1", "Sheet.size is no number"),
        (
            "Sheet.B2",
            "goes round in a circle, Sheet.B2 from Sheet.B3 from Sheet.B2",
        ),
        ("Other#Sheet.B1", "another document"),
    ] {
        let bytes = corner(
            [20.0, 12.0, 26.0, 30.0],
            &[
                ("Constraints.high", expression),
                ("Constraints.long", "Constraints.high + 14 mm"),
                ("Constraints.turn", "Constraints.wide / 1 mm * 1.5 deg"),
            ],
            &[("B1", "size", "text"), ("B2", "", "=B3"), ("B3", "", "=B2")],
        );
        // What is computed from it does not follow, what is not does.
        let imported = read(&bytes);
        let (set, warnings) = followed(&imported, &["wide=90"]);
        assert_eq!(set, numbers(&[("turn", "135")]), "{expression}");
        let [first, second] = &warnings[..] else {
            panic!("{expression}: {warnings:?}")
        };
        assert!(
            first.starts_with(&format!("high has the expression `{expression}`"))
                && first.contains("it stays 12 here"),
            "{first}"
        );
        assert!(second.starts_with("long has the expression"), "{second}");
        assert!(
            warnings.iter().any(|w| w.contains(words)),
            "{expression}: {warnings:?}"
        );
    }
    // There is a number in the file, and none for the new one; or one that no length is.
    let expressions = [(
        "Constraints.high",
        "sqrt(Constraints.wide / 1 mm - 11) * 4 mm",
    )];
    let imported = read(&corner([20.0, 12.0, 26.0, 30.0], &expressions, &[]));
    assert_eq!(
        followed(&imported, &["wide=36"]).0,
        numbers(&[("high", "20")])
    );
    let (set, warnings) = followed(&imported, &["wide=10"]);
    assert!(
        set.is_empty() && warnings[0].contains("there is no such number"),
        "{warnings:?}"
    );
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("a.FCStd");
    let expressions = [("Constraints.long", "Constraints.wide + 6 mm")];
    fs::write(&file, corner([20.0, 12.0, 26.0, 30.0], &expressions, &[])).unwrap();
    let (code, text) = run(&file, &["edit", "--set", "wide=20"]);
    assert!(code == 0 && text.contains("long to 26"), "{text}");
    let expressions = [("Constraints.long", "46 mm - Constraints.wide")];
    fs::write(&file, corner([20.0, 12.0, 26.0, 30.0], &expressions, &[])).unwrap();
    let (code, text) = run(&file, &["edit", "--set", "wide=50"]);
    let words = "long: a length must be greater than 0, and -4 is not; a number follows by the file's `46 mm - Constraints.wide`";
    assert!(code == 2 && text.contains(words), "{text}");
}

#[test]
fn verbs_that_lead_one_dimension_say_what_is_computed() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("a.FCStd");
    let expressions = [
        ("Constraints.high", "Constraints.wide / 2 + 2 mm"),
        ("Constraints.turn", "asin(0.5)"),
    ];
    fs::write(&file, corner([20.0, 12.0, 26.0, 30.0], &expressions, &[])).unwrap();
    let words = "by expressions, which are not followed here";
    let sweep = [
        "sweep", "--vary", "wide", "--from", "20", "--to", "22", "--frames", "2",
    ];
    let other = [
        "sweep", "--vary", "long", "--from", "26", "--to", "27", "--frames", "2",
    ];
    let table = directory.path().join("rows.csv");
    fs::write(&table, "wide\n20\n22\n").unwrap();
    let rows = ["sweep", "--table", table.to_str().unwrap()];
    for (asked, is_said) in [
        (&sweep[..], true),
        (&rows, true),
        (&other, false),
        (&["limits", "--only", "wide"], true),
        (&["limits", "--only", "long"], false),
        (&["tolerance", "--default", "0.1"], true),
    ] {
        let (code, text) = run(&file, asked);
        assert!(
            code == 0 && text.contains(words) == is_said,
            "{asked:?}: {text}"
        );
    }
    let (_, text) = run(&file, &["check"]);
    assert!(
        text.contains("(by the expression `Constraints.wide / 2 + 2 mm` in the file)"),
        "{text}"
    );
}

/// Where the straight way to what follows ends, that is no limit of the expressions; and a number that was set by hand, or a dimension
/// of another sketch, is named where what follows does not have it.
#[test]
fn what_is_not_as_the_expressions_have_it_is_said() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("a.FCStd");
    // c grows with the square of a, which b lets grow to 37.4; on the straight way c is too long before.
    let constraints = [
        constraint("", 1, 0.0, &[(0, 1), (-1, 1)]),
        constraint("", 2, 0.0, &[(0, 0)]),
        constraint("", 1, 0.0, &[(0, 2), (1, 1)]),
        constraint("", 1, 0.0, &[(0, 1), (2, 1)]),
        constraint("", 1, 0.0, &[(1, 2), (2, 2)]),
        constraint("a", 6, 20.0, &[(0, 0)]),
        constraint("b", 6, 15.0, &[(1, 0)]),
        constraint("c", 6, 15.0, &[(2, 0)]),
    ];
    let height = 125f64.sqrt();
    let geometry = line([0.0, 0.0, 20.0, 0.0])
        + &line([20.0, 0.0, 10.0, height])
        + &line([0.0, 0.0, 10.0, height]);
    let expression =
        "<Expression path=\"Constraints.c\" expression=\"15 mm * (Constraints.a / 20 mm) ^ 2\"/>";
    let triangle = sketch(&constraints.concat(), &geometry, expression);
    let other = "<Expression path=\"Constraints.c\" expression=\"Sketch.Constraints.a - 5 mm\"/>";
    let other = sketch(&constraints.concat(), &geometry, other);
    let kind = "Sketcher::SketchObject";
    let bytes = archive(&[(kind, "Sketch", &triangle), (kind, "Sketch001", &other)]);
    fs::write(&file, bytes).unwrap();
    for (wanted, code) in [("a=90", 3), ("a=21", 0)] {
        let asked = ["edit", "--sketch", "Sketch", "--set", wanted];
        let (found, text) = run(&file, &asked);
        assert!(
            found == code && text.contains("Sketch001.c follows too, and is not led here"),
            "{text}"
        );
        assert_eq!(text.contains("go in straight lines"), code == 3, "{text}");
    }
    let expressions = [
        ("Constraints.high", "Constraints.wide / 2 + 2 mm"),
        (
            "Constraints.long",
            "Constraints.high + Constraints.turn.Value * 1 mm - 16 mm",
        ),
    ];
    fs::write(&file, corner([20.0, 12.0, 26.0, 30.0], &expressions, &[])).unwrap();
    let mut serve = Command::new(env!("CARGO_BIN_EXE_krawl"));
    let serve = serve.args(["edit", file.to_str().unwrap(), "--serve"]);
    let lines = "{\"set\": {\"turn\": 31}}\n{\"set\": {\"high\": 14}}\n{\"set\": {\"turn\": 40}}\n";
    let answers = serve.write_stdin(lines).output().unwrap().stdout;
    let answers = String::from_utf8(answers).unwrap();
    let [first, _, third] = &answers.lines().collect::<Vec<_>>()[..] else {
        panic!("{answers}")
    };
    assert!(first.contains("\"warnings\":[]"), "{first}");
    let words = "high is 14 here, and 12 by its expression";
    assert!(third.contains(words), "{third}");
}
