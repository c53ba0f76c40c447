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
    // A parameter that is computed can be set, and is a number then.
    let asked = [
        "edit",
        "--set",
        "upright=30",
        "--out",
        out.to_str().unwrap(),
    ];
    assert_eq!(run(&asked, file).1, 0);
    assert!(fs::read_to_string(&out).unwrap().contains("upright = 30.0"));
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
        (&["edit", "--set", "widht=90"], "did you mean `width`?"),
        (
            &["edit", "--set", "width=90", "--set", "width=91"],
            "set twice",
        ),
        (&["edit", "--set", "width=x"], "width"),
        (
            &["sweep", "--vary", "width", "--from", "80", "--to", "90"],
            "is a parameter",
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
    let (said, code) = run(&["edit", "--set", "q=16"], &file);
    assert!(code == 2 && said.contains("give the length"), "{said}");
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
