//! The examples in `krawl --help` and in every verb's help run.

use assert_cmd::Command;
use std::fs;
use std::path::Path;
use std::process::Command as Process;

/// What would take long, or is not on every machine, and what is run in its place.
const INSTEAD: &[(&str, &str)] = &[
    (" && phc -b octahedron.phc out", ""),
    (" && msolve -f octahedron.ms", ""),
    ("man -l -", "cat"),
    ("problems/*.toml --repeat 9", "problems/k33.toml --repeat 1"),
    ("compare sketch.toml", "compare sketch.toml --repeat 1"),
    (
        "problems/disulfide.toml --bound",
        "problems/octahedron.toml --bound",
    ),
    (
        "problems/icosahedron.toml --store ico",
        "problems/k33.toml --store ico --paths 1 --all-time 0",
    ),
    ("--time 3500", "--time 0.1"),
];

fn help(verb: &str) -> String {
    let verb = if verb.is_empty() { None } else { Some(verb) };
    let output = Command::new(env!("CARGO_BIN_EXE_krawl"))
        .args(verb)
        .arg("--help")
        .output()
        .unwrap();
    String::from_utf8(output.stdout).unwrap()
}

/// All verbs, which stand by what people want before the options.
fn verbs() -> Vec<String> {
    let text = help("");
    let list = text.lines().take_while(|line| *line != "Options:");
    list.filter_map(|line| line.strip_prefix("  "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|verb| *verb != "help")
        .map(str::to_owned)
        .collect()
}

/// The command lines among a help's examples, without the remarks beside them.
fn examples(help: &str) -> Vec<String> {
    let lines = help.lines().skip_while(|line| *line != "Examples:");
    let lines = lines.filter_map(|line| line.strip_prefix("  "));
    lines
        .filter(|line| line.starts_with("krawl "))
        .map(|line| line.split("  ").next().unwrap().to_owned())
        .collect()
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        match entry.file_type().unwrap().is_dir() {
            true => copy(&entry.path(), &target),
            false => {
                fs::copy(entry.path(), target).unwrap();
            }
        }
    }
}

/// A terminal has 40 lines of 100 letters, or so.
#[test]
fn the_short_help_of_every_verb_fits_on_one_screen() {
    for verb in verbs().iter().map(String::as_str).chain([""]) {
        let words = [verb, "-h"].into_iter().filter(|word| !word.is_empty());
        let output = Command::new(env!("CARGO_BIN_EXE_krawl"))
            .args(words)
            .output()
            .unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        let wide = text.lines().find(|line| line.chars().count() > 120);
        assert_eq!(wide, None, "{verb}");
        assert!(text.lines().count() <= 42, "{verb}:\n{text}");
    }
}

#[test]
fn the_examples_of_every_help_run() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let sketch = "dimension = 2\n[points]\na = [0, 0]\nb = [5, 0]\nc = [4, 3]\nd = [1, 3]\n[constraints]\n\
                  distances = [[\"a\", \"b\", 5], [\"b\", \"c\", 3.2], [\"c\", \"d\", 3], [\"d\", \"a\", 3.1], [\"a\", \"c\", 5.1]]\n";
    for name in ["sketch", "a", "b", "c", "problem"] {
        fs::write(here.join(name).with_extension("toml"), sketch).unwrap();
    }
    copy(Path::new("problems"), &here.join("problems"));
    copy(Path::new("docs/examples"), &here.join("docs/examples"));
    for path in [
        ".local/share/bash-completion/completions",
        ".local/share/man/man1",
        ".zfunc",
        ".config/fish/completions",
    ] {
        fs::create_dir_all(here.join(path)).unwrap();
    }
    let bin = Path::new(env!("CARGO_BIN_EXE_krawl")).parent().unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let shell = |line: &str| {
        Process::new("sh")
            .args(["-c", line])
            .current_dir(here)
            .env("PATH", &path)
            .env("HOME", here)
            .env("SLURM_ARRAY_TASK_ID", "0")
            .output()
            .unwrap()
    };
    // A store with work units, as other machines are given them.
    let store = shell(
        "krawl explore problem.toml --store store --paths 1 --all-time 0 --shard 1 --quiet; \
         cp store/unit-0.krawl-unit .",
    );
    assert!(
        here.join("unit-0.krawl-unit").exists(),
        "{}",
        String::from_utf8_lossy(&store.stderr)
    );
    shell("krawl work store/unit-0.krawl-unit; krawl solve sketch.toml --cert proof.krawl");
    let (mut count, all) = (0, verbs());
    assert!(all.len() > 15);
    for verb in all.iter().map(String::as_str).chain([""]) {
        let examples = examples(&help(verb));
        assert!(!examples.is_empty(), "{verb}");
        for example in examples {
            let mut line = example.clone();
            for (from, to) in INSTEAD {
                line = line.replace(from, to);
            }
            let output = shell(&line);
            let errors = String::from_utf8_lossy(&output.stderr);
            // 3 and 4 are answers: a limit, what is proved but not to be all, what waits.
            assert!(
                matches!(output.status.code(), Some(0 | 3 | 4)),
                "`{example}`, run as `{line}`: {:?}\n{errors}",
                output.status
            );
            count += 1;
        }
    }
    assert!(count > 40);
    // What they say is written is there.
    for file in [
        "page.html",
        "all.html",
        "limits.html",
        "leg.html",
        "rings.html",
        "out.html",
        "edited.toml",
        "edited.slvs",
        "leg.csv",
        "pictures",
        "proof.krawl",
        "octahedron.phc",
        "ico/unit-0.krawl-unit",
        "proofs/path-0.krawl",
        ".local/share/man/man1/krawl-solve.1",
    ] {
        assert!(here.join(file).exists(), "{file}");
    }
}
