//! Numbers computed from parameters: what is set in one place is changed everywhere, exactly, and the file keeps its expressions.

use assert_cmd::Command;
use krawl::problem::Problem;
use std::fs;
use std::path::Path;

fn run(arguments: &[&str], file: &Path) -> (String, i32) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
    let output = command
        .args(&arguments[..1])
        .arg(file)
        .args(&arguments[1..]);
    let output = output.output().unwrap();
    let text = [output.stdout, output.stderr].concat();
    (
        String::from_utf8(text).unwrap(),
        output.status.code().unwrap(),
    )
}

#[test]
fn a_parameter_moves_all_that_is_computed_from_it() {
    let directory = tempfile::tempdir().unwrap();
    let (file, out) = (
        Path::new("docs/examples/bracket.toml"),
        directory.path().join("out.toml"),
    );
    let asked = [
        "edit",
        "--set",
        "width=90",
        "--set",
        "margin=10",
        "--out",
        out.to_str().unwrap(),
    ];
    let (text, code) = run(&asked, file);
    assert_eq!(code, 0, "{text}");
    let written = fs::read_to_string(&out).unwrap();
    for line in [
        "width = 90.0",
        "margin = 10.0",
        "upright = \"height - 2*margin\"",
        "[\"hole\", \"width*3/40\"]",
    ] {
        assert!(written.contains(line), "{written}");
    }
    let problem = Problem::parse_loosely(&written, "out.toml").unwrap();
    let hole = &problem.points[problem.points.iter().position(|p| p.name == "H").unwrap()];
    assert!((hole.sketch[0].to_f64() - 45.0).abs() < 1e-9);
    // Half of 50 - 20, and the margin.
    assert!((hole.sketch[1].to_f64() - 25.0).abs() < 1e-9);
    // What says the same as before is reached where it is.
    let (text, code) = run(&["edit", "--set", "width=80"], file);
    assert_eq!(code, 0, "{text}");
}

#[test]
fn what_is_wrong_with_parameters_is_said() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("bracket.toml");
    let good = fs::read_to_string("docs/examples/bracket.toml").unwrap();
    let check = |text: &str| {
        fs::write(&file, text).unwrap();
        run(&["check"], &file)
    };
    let (text, code) = check(&good);
    assert!(
        code == 0 && text.contains("upright = 25, as height - 2*margin"),
        "{text}"
    );
    for (from, to, words) in [
        (
            "\"width/2\"",
            "\"widht/2\"",
            "bracket.toml:25: constraints.dx: A-H: `widht/2`: `widht` is no parameter that stands before; did you mean `width`?",
        ),
        ("\"width/2\"", "\"width/(height-50)\"", "divides by zero"),
        (
            "height - 2*margin",
            "height - 2*upright",
            "`upright` is no parameter that stands before",
        ),
        (
            "margin = 12.5",
            "margin = [1]",
            "a number, or an expression in quotes",
        ),
        ("margin = 12.5", "\"2 m\" = 1", "a name of letters"),
        ("\"width\"]]\nradii", "\"-width\"]]\nradii", "must be"),
    ] {
        let (text, code) = check(&good.replacen(from, to, 1));
        assert!(code == 2 && text.contains(words), "{from} -> {to}: {text}");
    }
    let endless = good.replace("height - 2*margin", "((((9^20)^20)^20)^20)^20");
    let (text, code) = check(&endless);
    assert!(code == 2 && text.contains("too large on the way"), "{text}");
    let file = Path::new("docs/examples/bracket.toml");
    for (asked, words) in [
        (
            &["edit", "--set", "dx:D-C=90"][..],
            "dx:D-C is computed, by `width`",
        ),
        (
            &["edit", "--set", "upright=30"],
            "upright is computed, by `height - 2*margin`: set the parameter in it",
        ),
        (&["edit", "--set", "widht=90"], "did you mean `width`?"),
        (
            &["edit", "--set", "width=90", "--set", "width=91"],
            "set twice",
        ),
        (&["edit", "--set", "width=x"], "width"),
        (
            &["sweep", "--vary", "upright", "--from", "25", "--to", "30"],
            "upright is computed, by `height - 2*margin`",
        ),
        (
            &["sweep", "--vary", "width", "--from", "80", "--to", "-1"],
            "a length must be greater than 0",
        ),
    ] {
        let (text, code) = run(asked, file);
        assert!(code == 2 && text.contains(words), "{asked:?}: {text}");
    }
}

/// Under `angles` a file has none beyond 180 degrees, and what is computed is not written as another angle; a squared length that stays does not
/// stand in the way; a stream of edits keeps what is computed as it is.
#[test]
fn what_cannot_be_written_is_refused_before() {
    let directory = tempfile::tempdir().unwrap();
    let (file, out) = (
        directory.path().join("t.toml"),
        directory.path().join("out.toml"),
    );
    let text = "name = \"t\"\ndimension = 2\n[parameters]\nw = 4\ng = 45\nq = 9\n[points]\na = [0, 0]\nb = [4, 0]\nc = [4, 3]\n[constraints]\n\
                fixed = [\"a\"]\nhorizontal = [[\"a\", \"b\"]]\nangles = [[\"a\", \"b\", \"c\", \"2*g\"]]\ndistances = [[\"a\", \"b\", \"w\"]]\n\
                squared_distances = [[\"b\", \"c\", \"q\"]]\n";
    fs::write(&file, text).unwrap();
    for value in ["g=100", "g=-10", "g=90"] {
        let asked = ["edit", "--set", value, "--out", out.to_str().unwrap()];
        let (said, code) = run(&asked, &file);
        assert!(
            code == 2 && said.contains("leave out --out") && !out.exists(),
            "{said}"
        );
    }
    let (said, code) = run(
        &["edit", "--set", "w=5", "--out", out.to_str().unwrap()],
        &file,
    );
    assert_eq!(code, 0, "{said}");
    assert_eq!(run(&["check"], &out).1, 0);
    for value in ["q=16", "q=9"] {
        let (said, code) = run(&["edit", "--set", value], &file);
        assert!(code == 2 && said.contains("give the length"), "{said}");
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
    let lines = "{\"set\": {\"w\": 5}}\n{\"set\": {\"a-b\": 5}}\n";
    let output = command
        .arg("edit")
        .arg(&file)
        .arg("--serve")
        .write_stdin(lines)
        .output()
        .unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(
        said.contains("w is a parameter") && said.contains("a-b is computed, by `w`"),
        "{said}"
    );
}

/// x² = a − b with b half of a, and a triangle of which two sides come from w.
const EQUATION: &str = "name = \"e\"\nequations = [\"x^2 = a-b\"]\n[unknowns]\nx = 1\n[parameters]\na = 2\nb = \"a/2\"\n";
const TRIANGLE: &str = "name = \"t\"\ndimension = 2\n[parameters]\nw = 4\nv = \"w-1\"\n[points]\na = [0, 0]\nb = [4, 0]\nc = [2.8, 2.7]\n[constraints]\n\
    distances = [[\"a\", \"b\", \"w\"], [\"b\", \"c\", \"v\"], [\"a\", \"c\", 3.9]]\n";

/// What the file computes from what is led stands still where nothing follows, and the claim says so; sweeps lead it.
#[test]
fn claims_name_what_the_file_computes_and_is_held() {
    let directory = tempfile::tempdir().unwrap();
    let at = |name: &str| directory.path().join(name);
    let (equation, triangle, json) = (at("e.toml"), at("t.toml"), at("out.json"));
    fs::write(&equation, EQUATION).unwrap();
    fs::write(&triangle, TRIANGLE).unwrap();
    let asked = ["limits", "--json", json.to_str().unwrap()];
    let held = [
        "b held at 1 (which the file computes by `a/2`)",
        "a held at 2 (from which the file computes b)",
    ];
    let (text, code) = run(&asked, &equation);
    assert!(
        code == 0 && text.contains("from the same parameters held where it is"),
        "{text}"
    );
    for (name, held) in ["a", "b"].into_iter().zip(held) {
        assert!(
            text.contains(&format!("{name} goes with {held}.")),
            "{text}"
        );
    }
    let told: serde_json::Value = serde_json::from_slice(&fs::read(&json).unwrap()).unwrap();
    for (name, held) in ["a", "b"].into_iter().zip(held) {
        let account = &told["ranges"][name]["account"];
        assert_eq!(
            account["held_though_computed"],
            serde_json::json!([held]),
            "{told}"
        );
    }
    let sides = [
        "a-b held at 4 (which the file computes by `w`)",
        "b-c held at 3 (which the file computes by `v`)",
    ];
    let (text, code) = run(&["limits"], &triangle);
    assert!(
        code == 0 && sides.iter().all(|words| text.contains(words)),
        "{text}"
    );
    // The third side has nothing to do with w.
    let (text, _) = run(&["limits", "--only", "a-c"], &triangle);
    assert!(text.contains("Every value is a limit, proved"), "{text}");
    let (text, _) = run(&["tolerance", "--tolerance", "a-b=0.1"], &triangle);
    assert!(
        text.contains(&format!("proved with {}", sides[1])),
        "{text}"
    );
    let (text, _) = run(&["tolerance", "--default", "0.1"], &triangle);
    assert!(!text.contains("held"), "{text}");
}

#[test]
fn a_sweep_of_a_parameter_leads_what_is_computed_from_it() {
    let directory = tempfile::tempdir().unwrap();
    let at = |name: &str| directory.path().join(name);
    let (equation, triangle, csv, cert) =
        (at("e.toml"), at("t.toml"), at("out.csv"), at("out.krawl"));
    fs::write(&equation, EQUATION).unwrap();
    fs::write(&triangle, TRIANGLE).unwrap();
    let last = || -> Vec<f64> {
        let text = fs::read_to_string(&csv).unwrap();
        let row = text.lines().last().unwrap().split(',');
        row.map(|cell| cell.parse().unwrap()).collect()
    };
    let sweep = |name, from, to| {
        [
            "sweep",
            "--vary",
            name,
            "--from",
            from,
            "--to",
            to,
            "--frames",
            "4",
            "--csv",
            csv.to_str().unwrap(),
        ]
    };
    let asked = [&sweep("a", "2", "0.5")[..], &["--measure", "value x"]].concat();
    let (text, code) = run(&asked, &equation);
    let words = "4 frames of a from 2 to 0.5 and with it of b, computed by the file's expressions, each proved";
    assert!(code == 0 && text.contains(words), "{text}");
    // The root of a/2.
    assert!((last()[1] - 0.5).abs() < 1e-9, "{:?}", last());
    let asked = [
        &sweep("w", "4", "20")[..],
        &["--cert", cert.to_str().unwrap()],
    ]
    .concat();
    let (text, code) = run(&asked, &triangle);
    assert!(
        code == 0 && text.contains("a-b from 4 to 20 and with it of b-c"),
        "{text}"
    );
    let far = |row: &[f64], a: usize, b: usize| (row[a] - row[b]).hypot(row[a + 1] - row[b + 1]);
    let row = last();
    for (ends, length) in [((1, 3), 20.0), ((3, 5), 19.0), ((1, 5), 3.9)] {
        assert!((far(&row, ends.0, ends.1) - length).abs() < 1e-9, "{row:?}");
    }
    let (text, code) = run(&sweep("b", "1", "1.9"), &equation);
    assert!(
        code == 2 && text.contains("b is computed, by `a/2`: set the parameter in it"),
        "{text}"
    );
    let out = at("ob.toml");
    let (text, code) = run(
        &["edit", "--set", "b=0.5", "--out", out.to_str().unwrap()],
        &equation,
    );
    assert!(
        code == 2 && text.contains("b is computed, by `a/2`") && !out.exists(),
        "{text}"
    );
    fs::write(&equation, EQUATION.replace("a/2", "2/a")).unwrap();
    let (text, code) = run(&sweep("a", "2", "0"), &equation);
    assert!(code == 2 && text.contains("divides by zero"), "{text}");
    // Row by row, each written with its parameter.
    fs::write(at("rows.csv"), "w,a-c\n5,3.9\n6,4\n").unwrap();
    let (rows, folder) = (at("rows.csv"), at("rows"));
    let asked = [
        "sweep",
        "--table",
        rows.to_str().unwrap(),
        "--csv",
        csv.to_str().unwrap(),
        "--out-folder",
        folder.to_str().unwrap(),
    ];
    let (text, code) = run(&asked, &triangle);
    assert!(code == 0 && text.contains("2 of 2 rows"), "{text}");
    assert!(
        fs::read_to_string(&csv)
            .unwrap()
            .starts_with("a-c,a-b,b-c,")
    );
    let written = fs::read_to_string(folder.join("t-2.toml")).unwrap();
    assert!(
        written.contains("w = 6.0")
            && written.contains("\"v\"]")
            && written.contains("v = \"w-1\""),
        "{written}"
    );
    assert_eq!(run(&["check"], &folder.join("t-2.toml")).1, 0);
    fs::write(&rows, "b\n1.5\n").unwrap();
    fs::write(&equation, EQUATION).unwrap();
    let (text, code) = run(&asked[..3], &equation);
    assert!(
        code == 2 && text.contains("b is computed, by `a/2`"),
        "{text}"
    );
}

/// 6.5 and the root of 29: what is printed as a bound is one.
#[test]
fn bounds_are_rounded_outwards() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("quad.toml");
    let text = "name = \"q\"\ndimension = 2\n[points]\na = [0, 0]\nb = [6, -2.5]\nc = [0, 2.5]\nd = [4, 2.5]\n[constraints]\n\
                distances = [[\"a\", \"b\", 6.5], [\"a\", \"c\", 2.5], [\"c\", \"d\", 4]]\nsquared_distances = [[\"d\", \"b\", 29]]\n";
    fs::write(&file, text).unwrap();
    let (text, _) = run(&["limits", "--only", "a-b"], &file);
    let (_, bound) = text
        .split_once("However the rest moves, a-b is at most ")
        .expect(&text);
    let (bound, _) = bound.split_once(':').unwrap();
    let [bound, rest]: [krawl::problem::Decimal; 2] = [bound, "6.5"].map(|x| x.parse().unwrap());
    let root = bound.value() - rest.value();
    let least = krawl::rational::Rational::from_integer(29.into());
    assert!(&root * &root >= least, "{text}");
}
