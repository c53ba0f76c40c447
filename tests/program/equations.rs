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
        ("[unknowns]\nx = [1, 2]\n", "unknowns.x: must be a number"),
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
