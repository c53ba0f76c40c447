//! Who trusts the checker has few lines to read, and they use nothing of the tracker.

use std::fs;
use std::path::PathBuf;

fn sources() -> Vec<(PathBuf, String)> {
    let files = fs::read_dir("crates/solver/src/certificate/checker").unwrap();
    let mut paths: Vec<PathBuf> = files.map(|file| file.unwrap().path()).collect();
    paths.extend(
        ["format.rs", "head.rs", "reader.rs", "verdict.rs"]
            .map(|f| PathBuf::from("crates/solver/src/certificate").join(f)),
    );
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).unwrap();
        // Without its tests.
        let code = text.split("#[cfg(test)]").next().unwrap().to_owned();
        (path, code)
    };
    paths.into_iter().map(read).collect()
}

#[test]
fn the_checker_uses_only_the_problem_the_intervals_and_the_equations() {
    const ALLOWED: [&str; 6] = [
        "equations",
        "problem",
        "constraint",
        "interval",
        "system",
        "certificate",
    ];
    for (path, text) in sources() {
        let mut parts = text.split("crate::");
        parts.next();
        for part in parts {
            let module: String = part.chars().take_while(|c| c.is_alphanumeric()).collect();
            // Guesses may be made by anything.
            let is_guess =
                ["elimination", "linalg"].contains(&&*module) && path.ends_with("checker/guess.rs");
            assert!(
                is_guess || ALLOWED.contains(&module.as_str()),
                "{}: crate::{module}",
                path.display()
            );
        }
        // Of its own module, not the writer: that one knows the tracker.
        assert!(!text.contains("writer"), "{}", path.display());
        assert!(!text.contains("unsafe"), "{}", path.display());
    }
    // And what those use: nothing above them.
    for folder in ["statement", "problem", "constraint", "interval", "system"] {
        let package = if folder == "interval" {
            "kernel"
        } else {
            "tracker"
        };
        for file in fs::read_dir(format!("crates/{package}/src/{folder}")).unwrap() {
            let path = file.unwrap().path();
            if path.is_file() {
                let text = fs::read_to_string(&path).unwrap();
                for module in ["track", "plan", "linalg", "certificate", "report"] {
                    assert!(
                        !text.contains(&format!("crate::{module}")),
                        "{}",
                        path.display()
                    );
                }
            }
        }
    }
}

/// Lines of code, as rustfmt leaves them, without blank lines and comments. All of these files have
/// to be trusted, but for the guesses: whatever those are, no false claim passes.
#[test]
fn the_checker_is_short() {
    let code = |line: &&str| !line.trim().is_empty() && !line.trim().starts_with("//");
    let lines = |names: &[&str]| -> usize {
        let own = sources()
            .into_iter()
            .filter(|(path, _)| names.iter().any(|name| path.ends_with(name)));
        own.map(|(_, text)| text.lines().filter(code).count()).sum()
    };
    let proofs = [
        "checker/equations.rs",
        "checker/matrix.rs",
        "checker/krawczyk.rs",
        "checker/place.rs",
        "checker/tube.rs",
        "checker/chain.rs",
    ];
    let parts = [
        ("proofs", lines(&proofs), 1414),
        (
            "proofs of paths through flat figures, beside those",
            lines(&["checker/degenerate.rs"]),
            40,
        ),
        (
            "proofs of edits, beside those",
            lines(&["checker/arc.rs"]),
            140,
        ),
        (
            "many unknowns, beside those",
            lines(&["checker/structure.rs"]),
            55,
        ),
        (
            "points of more than 53 bits, and finer tubes around them",
            lines(&["checker/extended.rs"]),
            110,
        ),
        (
            "refutations, not trusted by who believes a proof",
            lines(&["checker/refute.rs"]),
            85,
        ),
        (
            "reading in parts, settings",
            lines(&["checker/mod.rs"]),
            125,
        ),
        (
            "guesses, not trusted",
            lines(&["checker/guess.rs", "checker/sparse.rs", "checker/trial.rs"]),
            445,
        ),
        (
            "format, head, reader, verdict",
            lines(&["format.rs", "head.rs", "reader.rs", "verdict.rs"]),
            685,
        ),
    ];
    // No file is forgotten.
    let all: usize = sources()
        .iter()
        .map(|(_, text)| text.lines().filter(code).count())
        .sum();
    assert_eq!(parts.iter().map(|part| part.1).sum::<usize>(), all);
    for (part, lines, most) in parts {
        println!("{part}: {lines} lines");
        assert!(lines <= most, "{part}: {lines} lines of code");
    }
}

/// The lines of code of a folder, which uses these modules alone.
fn lines_of(folder: &str, allowed: &[&str]) -> usize {
    let mut lines = 0;
    for file in fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        if path.is_dir() || path.ends_with("tests.rs") {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap();
        // Nor in comments.
        for part in code.split("crate::").skip(1) {
            let module: String = part.chars().take_while(|c| c.is_alphanumeric()).collect();
            assert!(
                allowed.contains(&module.as_str()),
                "{}: crate::{module}",
                path.display()
            );
        }
        assert!(!code.contains("unsafe"), "{}", path.display());
        let is_code = |line: &&str| !line.trim().is_empty() && !line.trim().starts_with("//");
        lines += code.lines().filter(is_code).count();
    }
    println!("{folder}: {lines} lines");
    lines
}

/// The check of complex sets is short, too, and uses neither the search for them nor the tracker.
#[test]
fn the_check_of_complex_sets_is_short_and_its_own() {
    // With other constraints than distances it has the kernel's equations, and the test of changes of signs that covers have.
    // A guess of an inverse may be made by anything.
    let own = [
        "equations",
        "rational",
        "problem",
        "interval",
        "system",
        "constraint",
        "certificate",
    ];
    let with_guess = [&own[..], &["elimination"]].concat();
    assert!(lines_of("crates/solver/src/certificate/complex", &with_guess) <= 1100);
}

/// The checks of covers use nothing of the searches; that of coordinates has the kernel's equations and the test
/// for one figure of the checker of certificates.
#[test]
fn the_checks_of_covers_are_short_and_their_own() {
    let cover = "crates/solver/src/certificate/cover";
    // An example runs the search.
    assert!(lines_of(cover, &["problem", "constraint", "certificate"]) <= 120);
    // Taylor models are the kernel's, which searches use as well; a guess of an inverse may be made by anything.
    assert!(lines_of("crates/kernel/src/model", &["interval"]) <= 550);
    let own = [
        "problem",
        "interval",
        "certificate",
        "model",
        "places",
        "elimination",
    ];
    // A quarter of it is the constructions, which searches use as well.
    assert!(lines_of(&format!("{cover}/plan"), &own) <= 1585);
    let kernel = [
        "problem",
        "constraint",
        "interval",
        "system",
        "certificate",
        "model",
        "places",
        "linalg",
    ];
    // A quarter of it is about rotations of bodies, a tenth about equations that fall apart.
    assert!(lines_of(&format!("{cover}/coordinates"), &kernel) <= 2390);
}
