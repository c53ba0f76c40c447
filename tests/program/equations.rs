//! Equations of one's own on the command line: what is wrong with them is said with its place, and what is found is written.

use crate::krawl;
use std::fs;

/// The exit code, and all that was written.
fn run(arguments: &[&str]) -> (Option<i32>, String) {
    let (code, text, error) = krawl(arguments);
    (code, text + &error)
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("system.toml");
    let file = file.to_str().unwrap();
    for (text, words) in [
        (
            "equations = [\"x^2 = b\"]\n[unknowns]\nx = 1\n",
            "system.toml:1: equations: `x^2 = b`: there is no unknown or parameter `b`",
        ),
        (
            "equations = [\n\"x^2 = 2\",\n\"y +* 2\",\n]\n[unknowns]\nx = 1\ny = 1\n",
            "system.toml:3: equations: `y +* 2`: a number or a name was expected at `* 2`",
        ),
        (
            "[unknowns]\nx = 1\nequations = [\"x^2 = 2\"]\n",
            "system.toml:3: equations: must be before the first [table] of the file, or under [constraints]",
        ),
        (
            "equations = [\"x^2 = 2\", \"x^2 = 2\"]\n[unknowns]\nx = 1\n",
            "given twice",
        ),
        (
            "equations = [\"x = a\"]\n[unknowns]\nx = 1\na = 2\n[parameters]\na = 2\n",
            "an object or a parameter",
        ),
        (
            "equations = [\"x = 2\"]\n[unknowns]\nx = 1\n[parameters]\na = { value = 2, from = 1 }\n",
            "a parameter in `equations`",
        ),
        (
            "equations = [\"1/x = 2\"]\n[unknowns]\nx = 0\n",
            "divides by what is zero in the sketch",
        ),
        (
            "equations = [\"sqrt(x) = 2\"]\n[unknowns]\nx = -1\n",
            "the root of a number that is not greater than zero in the sketch",
        ),
        (
            "equations = [\"x + y = 2\"]\n[unknowns]\nx = 1\ny = 1\n",
            "there are 2 unknowns and 1 equation",
        ),
        (
            "equations = 3\n[unknowns]\nx = 1\n",
            "a list of equations in quotes",
        ),
        ("[unknowns]\nx = [1, 2, 3]\n", "unknowns.x: must be a range"),
        ("[unknowns]\nx = 1\n", "constraints"),
    ] {
        fs::write(file, text).unwrap();
        let (code, said) = run(&["all", file]);
        assert!(code == Some(2) && said.contains(words), "{text}: {said}");
    }
}

#[test]
fn what_is_found_is_written_into_the_file() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("out.toml");
    let path = out.to_str().unwrap();
    let file = "docs/examples/circle-hyperbola.toml";
    let (code, said) = run(&["edit", file, "--set", "a=5", "--out", path]);
    assert_eq!(code, Some(0), "{said}");
    assert!(
        said.contains("  x = 2.18890105931673") && said.contains("  a = 5\n"),
        "{said}"
    );
    let text = fs::read_to_string(&out).unwrap();
    assert!(
        text.contains("x = 2.188901059316") && text.contains("a = { value = 5.0, from = 2.5 }"),
        "{text}"
    );
    // The parameter is a dimension, which can be driven.
    let (code, said) = run(&[
        "sweep", file, "--vary", "a", "--from", "4", "--to", "9", "--frames", "3",
    ]);
    assert_eq!(code, Some(0), "{said}");
    let (code, said) = run(&["limits", file]);
    assert!(
        code == Some(0) && said.contains("a          4   2.0000000"),
        "{said}"
    );
    // Every verb that makes pages and values makes them of numbers, too.
    for verb in [&["solve"][..], &["all"], &["limits"]] {
        let html = directory.path().join("page.html");
        let asked = [verb, &[file, "--html", html.to_str().unwrap()]].concat();
        let (code, said) = run(&asked);
        assert!(code == Some(0) && html.exists(), "{verb:?}: {said}");
    }
    let (code, said) = run(&["motion", file, "--free", "a"]);
    assert!(
        code == Some(2) && said.contains("not of unknown numbers"),
        "{said}"
    );
}

/// What is exported has the equations, and the names.
#[test]
fn equations_are_exported() {
    let (code, said) = run(&["export", "docs/examples/katsura-5.toml", "--to", "phcpack"]);
    assert!(code == Some(0) && said.contains("u1 is u0"), "{said}");
}

/// Up to where something is proved is rounded to where it comes from: there is no x for an a below 0.
#[test]
fn what_is_proved_up_to_somewhere_is_not_said_to_be_proved_beyond() {
    let directory = tempfile::tempdir().unwrap();
    for scale in [1, 1000] {
        let text = format!(
            "equations = [\"x = sqrt(a)\"]\n[unknowns]\nx = {}\n[parameters]\na = {}\n",
            f64::from(4 * scale).sqrt(),
            4 * scale
        );
        let file = directory.path().join("a.toml");
        std::fs::write(&file, text).unwrap();
        let file = file.to_str().unwrap();
        let (_, said) = run(&["limits", file]);
        let (_, value) = said
            .split_once("a shrinks to ")
            .unwrap_or_else(|| panic!("{said}"));
        let value: f64 = value.split(' ').next().unwrap().parse().unwrap();
        assert!((0.0..1e-6).contains(&value), "{said}");
        let (_, said) = run(&["edit", file, "--set", "a=0"]);
        assert!(
            said.contains("proved up to t = 0.999999 of the way"),
            "{said}"
        );
    }
}

/// Ranges in files and on the command line are in what is claimed, and what is wrong with them is said.
#[test]
fn ranges_are_said() {
    let file = "docs/examples/circle-hyperbola.toml";
    let (code, said) = run(&["all", file, "--within", "x=0..2", "--within", "y=..1"]);
    let claim = "Complete, proved: 1 solution with x between 0 and 2 and y at most 1, and there is no other.";
    assert!(code == Some(0) && said.contains(claim), "{said}");
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name).to_str().unwrap().to_owned();
    let (own, cert, out) = (path("own.toml"), path("own.krawl"), path("out.toml"));
    let text = "equations = [\"x^2 = 2\", \"x*y = 1\"]\n[unknowns]\nx = [0, 2]\ny = { within = [-inf, 9] }\n";
    fs::write(&own, text).unwrap();
    let (code, said) = run(&["all", &own, "--cert", &cert, "--pick", "1", "--out", &out]);
    assert_eq!(code, Some(0), "{said}");
    let (code, said) = run(&["verify", &cert, &own]);
    let theorem = "has exactly 1 solution with x between 0 and 2.0 and y at most 9.0";
    assert!(code == Some(0) && said.contains(theorem), "{said}");
    // The solution that is taken begins there, in the same range.
    let taken = fs::read_to_string(&out).unwrap();
    assert!(
        taken.contains("x = { value = 1.414213562373095")
            && taken.contains("within = [0.0, 2.0] }"),
        "{taken}"
    );
    // The certificate is not one of the file with another range.
    let wider = text.replace("[0, 2]", "[-2, 2]");
    fs::write(&own, &wider).unwrap();
    let (code, said) = run(&["verify", &cert, &own]);
    assert_eq!(code, Some(1), "{said}");
    let (_, said) = run(&["check", &own]);
    assert!(said.contains("x between -2 and 2"), "{said}");
    for (arguments, words) in [
        (["--within", "z=0..2"], "there is no unknown `z`"),
        (
            ["--within", "x=2..0"],
            "from the lesser number to the greater one",
        ),
        (["--within", "x=.."], "x=0..2, x=0.. or x=..2"),
        (["--within", "x"], "x=0..2, x=0.. or x=..2"),
        (["--within", "x=a..2"], "`a`"),
    ] {
        let (code, said) = run(&[&["all", file], &arguments[..]].concat());
        assert!(
            code == Some(2) && said.contains(words),
            "{arguments:?}: {said}"
        );
    }
    for (unknown, words) in [
        ("x = [2, 0]", "from the lesser number to the greater one"),
        (
            "x = [0, 1, 2]",
            "a range, [0, 2], or [0, inf] where it has no end",
        ),
        ("x = [-inf, inf]", "within = [number, number]"),
        ("x = { within = [0, \"2\"] }", "a number without quotes"),
        ("x = { from = 1 }", "from"),
    ] {
        fs::write(
            &own,
            format!("equations = [\"x^2 = 2\"]\n[unknowns]\n{unknown}\n"),
        )
        .unwrap();
        let (code, said) = run(&["all", &own]);
        assert!(code == Some(2) && said.contains(words), "{unknown}: {said}");
    }
}

/// A set that has a curve of solutions is told so in a third of the boxes that a search takes which does not look for one: cyclic-4 has x₃ = −x₁, x₄ = −x₂, (x₁ x₂)² = 1.
#[test]
fn curves_of_solutions_are_told() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("cyclic-4");
    let text = "4\na+b+c+d;\na*b+b*c+c*d+d*a;\na*b*c+b*c*d+c*d*a+d*a*b;\na*b*c*d-1;\n";
    fs::write(&file, text).unwrap();
    let (code, said) = run(&["all", file.to_str().unwrap()]);
    assert!(
        code == Some(1) && said.contains("Flexible: a curve of solutions is seen"),
        "{said}"
    );
    let boxes = said.split_once("boxes ").unwrap().1.trim_start();
    let boxes: u64 = boxes.split_whitespace().next().unwrap().parse().unwrap();
    assert!(boxes < 600_000, "{said}");
}

#[test]
fn complex_solutions_are_told_to_many_digits() {
    let file = "docs/examples/circle-hyperbola.toml";
    let (code, said) = run(&["complex", file, "--digits", "40"]);
    // √(2 + √3) = (√6 + √2)/2
    let digits = "x = 1.93185165257813657349948639945779473";
    assert!(code == Some(0) && said.contains(digits), "{said}");
}
