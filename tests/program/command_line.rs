//! The program as its users meet it: what it prints and writes, and where it ends.

use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::process::{Command as Process, Stdio};
use std::time::Duration;

const OCTAHEDRON: &str = "problems/octahedron.toml";

fn krawl() -> Command {
    Command::new(env!("CARGO_BIN_EXE_krawl"))
}

#[test]
fn prints_a_table_and_writes_json() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.json");
    let run = krawl()
        .args(["solve", OCTAHEDRON, "--json"])
        .arg(&file)
        .assert()
        .code(0)
        .get_output()
        .clone();
    let table = String::from_utf8(run.stdout).unwrap();
    assert!(table.starts_with("octahedron: Closed, proved: the 4 solutions"));
    assert!(run.stderr.is_empty(), "no progress where nobody watches");
    let json: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
    assert_eq!(json["status"], "closed");
    assert_eq!(json["solutions"].as_array().unwrap().len(), 4);
    assert_eq!(
        json["solutions"][0]["points"]["p1"][2]
            .as_array()
            .unwrap()
            .len(),
        2
    );
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn json_on_standard_output_is_all_there_is() {
    let arguments = [
        "solve", OCTAHEDRON, "--mode", "float", "--space", "full", "--json", "-",
    ];
    let output = krawl()
        .args(arguments)
        .assert()
        .code(0)
        .get_output()
        .clone();
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(
        (&json["mode"], &json["space"]),
        (&"float".into(), &"full".into())
    );
    let x = &json["solutions"][0]["points"]["p4"][0];
    assert_eq!(x[0], x[1]);
    assert!(output.stderr.is_empty());
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_the_run_cleanly() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.json");
    // Steps so small that the run outlasts the test.
    let mut run = Process::new(env!("CARGO_BIN_EXE_krawl"))
        .args([
            "solve",
            "problems/icosahedron.toml",
            "--max-step",
            "1e-7",
            "--json",
        ])
        .arg(&file)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(700));
    let sent = Process::new("kill")
        .args(["-INT", &run.id().to_string()])
        .status()
        .unwrap();
    assert!(sent.success());
    assert_eq!(run.wait().unwrap().code(), Some(1));
    let json: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
    assert_eq!(json["status"], "stopped");
    assert!(json["reason"].is_string());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn check_shows_the_pattern_of_the_jacobian() {
    let check = |arguments: &[&str]| {
        let output = krawl().arg("check").args(arguments).assert().code(0);
        String::from_utf8(output.get_output().stdout.clone()).unwrap()
    };
    // Nine rows, the removed constraint last.
    let text = check(&["problems/k33.toml"]);
    let pattern = text.split_once("\nJacobian").unwrap().1;
    let rows: Vec<&str> = pattern.lines().skip(1).collect();
    let removed = rows.iter().position(|row| row.contains("-+-")).unwrap();
    assert!(rows[..removed].iter().any(|row| row.contains("[X X]")));
    assert!(rows[removed + 1..].iter().all(|row| !row.contains('[')));
    assert_eq!(rows.iter().filter(|row| row.contains('X')).count(), 9);
    // Larger ones on demand.
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("strip.toml");
    fs::write(&file, strip(25)).unwrap();
    let file = file.to_str().unwrap();
    assert!(!check(&[file]).contains("\nJacobian"));
    assert!(check(&[file, "--pattern"]).contains("\nJacobian"));
}

/// A strip of triangles in the plane.
fn strip(points: usize) -> String {
    let mut text = "name = \"strip\"\ndimension = 2\n[points]\n".to_owned();
    for k in 0..points {
        text += &format!("p{k} = [{}.{}, {}.0]\n", k / 2, 5 * (k % 2), k % 2);
    }
    text += "[constraints]\ndistances = [\n";
    for k in 1..points {
        text += &format!("[\"p{}\", \"p{k}\", 1.1],\n", k - 1);
        if k > 1 {
            text += &format!("[\"p{}\", \"p{k}\", 1.0],\n", k - 2);
        }
    }
    text + "]\n"
}

#[cfg(unix)]
#[test]
fn a_reader_who_leaves_early_does_no_harm() {
    let mut run = Process::new(env!("CARGO_BIN_EXE_krawl"))
        .args(["check", OCTAHEDRON])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(run.stdout.take());
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty());
}

#[cfg(target_os = "linux")]
#[test]
fn output_that_cannot_be_written_is_said() {
    let run = Process::new(env!("CARGO_BIN_EXE_krawl"))
        .args(["check", OCTAHEDRON])
        .stdout(
            fs::OpenOptions::new()
                .write(true)
                .open("/dev/full")
                .unwrap(),
        )
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(2));
    assert!(
        String::from_utf8(run.stderr)
            .unwrap()
            .contains("cannot be written")
    );
}

#[test]
fn a_run_leaves_a_certificate_that_verifies() {
    let folder = tempfile::tempdir().unwrap();
    let cert = folder.path().join("octahedron.krawl");
    let solve = |arguments: &[&str]| {
        let run = krawl()
            .args(["solve", OCTAHEDRON])
            .args(arguments)
            .arg("--cert")
            .arg(&cert)
            .assert();
        run.get_output().status.code()
    };
    assert_eq!(solve(&[]), Some(0));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    let verify = |arguments: &[&str]| {
        let run = krawl().arg("verify").arg(&cert).args(arguments).assert();
        let output = run.get_output().clone();
        (
            output.status.code(),
            String::from_utf8(output.stdout).unwrap(),
            String::from_utf8(output.stderr).unwrap(),
        )
    };
    // It was checked at once, unless that was not wanted.
    assert_eq!(solve(&["--no-verify"]), Some(0));
    let (code, text, errors) = verify(&["--threads", "1", OCTAHEDRON]);
    assert_eq!(code, Some(0), "{text} {errors}");
    assert!(
        text.starts_with("octahedron: VERIFIED.") && text.contains("exactly 4 points with t = 1")
    );
    assert!(text.contains("smallest margin") && text.contains("exactly.\n"));
    // Another problem.
    let (code, text, _) = verify(&["problems/k33.toml"]);
    assert_eq!(code, Some(1));
    assert!(text.contains("the problem is not the one"));
    // Damaged: the last tube's numbers.
    let good = fs::read(&cert).unwrap();
    let mut bad = good.clone();
    let middle = bad.len() / 2;
    bad[middle..middle + 300].fill(0x3f);
    fs::write(&cert, bad).unwrap();
    assert!(matches!(verify(&[]).0, Some(1..=3)));
    // Not one at all.
    fs::write(&cert, &good[..good.len() - 1]).unwrap();
    let (code, text, errors) = verify(&[]);
    assert_eq!((code, text.as_str()), (Some(2), ""));
    assert!(errors.contains("truncated"), "{errors}");
    // Float mode proves nothing, and writes nothing.
    fs::remove_file(&cert).unwrap();
    assert_eq!(solve(&["--mode", "float"]), Some(2));
    assert!(!cert.exists());
}

const FLAPS: &str = "problems/hard/flaps-split-8.toml";

/// The reason, if the run stopped, and the list of what was switched on.
fn solved(arguments: &[&str]) -> (Option<i32>, Option<String>, Vec<String>) {
    let run = krawl()
        .arg("solve")
        .args(arguments)
        .args(["--json", "-"])
        .assert();
    let output = run.get_output();
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let list = json["switched_on"].as_array().unwrap().iter();
    (
        output.status.code(),
        json["reason"].as_str().map(str::to_owned),
        list.map(|text| text.as_str().unwrap().to_owned()).collect(),
    )
}

#[test]
fn extended_precision_can_be_left_off() {
    let is_extended = |list: &[String]| list.iter().any(|text| text.contains("extended precision"));
    let (code, reason, list) = solved(&[FLAPS]);
    assert_eq!((code, reason), (Some(0), None));
    assert!(is_extended(&list), "{list:?}");
    // As a whole it stops; it falls apart, and each of its blocks closes.
    let (code, reason, list) = solved(&[FLAPS, "--no-extended"]);
    assert_eq!(code, Some(0));
    assert!(reason.unwrap().contains("the Krawczyk test fails"));
    assert!(!is_extended(&list), "{list:?}");
    // Where 53 bits do it changes nothing.
    let (code, _, list) = solved(&[OCTAHEDRON, "--no-extended"]);
    assert_eq!(code, Some(0));
    assert!(!is_extended(&list), "{list:?}");
    // Float mode has none.
    let run = krawl()
        .args(["solve", OCTAHEDRON, "--mode", "float", "--no-extended"])
        .assert()
        .code(2);
    assert!(String::from_utf8_lossy(&run.get_output().stderr).contains("`--no-extended`"));
}

#[test]
fn stopped_runs_in_the_reduced_space_point_to_the_full_one() {
    const HINT: &str = "the full space has extended precision";
    let (code, reason, _) = solved(&[FLAPS, "--space", "reduced"]);
    assert_eq!(code, Some(0), "its blocks close");
    assert!(reason.unwrap().contains(HINT));
    // Not to what is not wanted.
    let (_, reason, _) = solved(&[FLAPS, "--space", "reduced", "--no-extended"]);
    assert!(!reason.unwrap().contains(HINT));
}

/// A run that stops says what makes the problem singular, if that can be seen.
#[test]
fn stopped_runs_say_what_is_singular() {
    let between = "dimension = 2\n[points]\nA = [0, 0]\nB = [118, 0]\nM = [30, 0.5]\nC = [60, 50]\n\
        [constraints]\ndistances = [[\"A\", \"B\", 120], [\"A\", \"M\", 30], [\"M\", \"B\", 90],\n\
        [\"A\", \"C\", 80], [\"B\", \"C\", 80]]\n";
    let run = krawl()
        .args(["solve", "-"])
        .write_stdin(between)
        .assert()
        .code(1);
    let text = String::from_utf8_lossy(&run.get_output().stdout).into_owned();
    assert!(
        text.contains("\nwarning: with these target lengths B, M and A are on one line, M between"),
        "{text}"
    );
    // One that closes has nothing to explain.
    let run = krawl().args(["solve", OCTAHEDRON]).assert().code(0);
    assert!(!String::from_utf8_lossy(&run.get_output().stdout).contains("warning"));
}

#[test]
fn a_certificate_that_ends_early_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let cert = folder.path().join("flaps.krawl");
    let verify = |flags: &[&str], code: i32, verdict: i32| {
        let run = krawl()
            .args(["solve", FLAPS, "--cert"])
            .arg(&cert)
            .args(flags)
            .assert();
        run.code(code);
        let run = krawl().arg("verify").arg(&cert).assert().code(verdict);
        String::from_utf8(run.get_output().stdout.clone()).unwrap()
    };
    // The run closed, in extended precision.
    let text = verify(&[], 0, 0);
    assert!(text.contains("VERIFIED"), "{text}");
    // It stopped.
    let text = verify(&["--no-extended"], 1, 4);
    assert!(
        text.contains("INCOMPLETE. The certificate ends early: the Krawczyk test fails"),
        "{text}"
    );
    // It could not even set out.
    let text = verify(&["--no-extended", "--tube-radius", "1e-30"], 1, 4);
    assert!(
        text.contains("INCOMPLETE. The certificate ends before its first tube: at the sketch"),
        "{text}"
    );
    assert!(text.contains("Nothing was verified"), "{text}");
    assert!(
        !text.contains("inf") && text.contains("tubes checked 0, 0"),
        "{text}"
    );
}

/// Two points on the line between two others, all lengths being as they should be: nothing tells in which
/// direction they leave it.
#[test]
fn a_singular_sketch_is_said_to_be_one_by_a_number() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("flat.toml");
    let text = r#"
        name = "flat"
        dimension = 2
        [points]
        a = [0.0, 0.0]
        b = [1.0, 0.0]
        c = [0.4, 1.1]
        d = [0.5, 0.0]
        e = [0.25, 0.0]
        [constraints]
        distances = [
            ["a", "b", 1.0], ["a", "c", 1.3], ["b", "c", 1.2],
            ["a", "d", 0.5], ["b", "d", 0.5], ["a", "e", 0.25], ["b", "e", 0.75],
        ]
    "#;
    fs::write(&file, text).unwrap();
    for space in ["full", "reduced"] {
        let (code, reason, _) = solved(&[file.to_str().unwrap(), "--space", space]);
        let reason = reason.unwrap();
        assert_eq!(code, Some(1));
        assert!(
            reason.contains("the smallest pivot of the Jacobian is 0.0e0 times its largest"),
            "{reason}"
        );
        assert!(!reason.contains("the full space"), "{reason}");
    }
}

fn output_of(arguments: &[&str], input: Option<&str>) -> (Option<i32>, String, String) {
    let mut command = krawl();
    command.args(arguments);
    if let Some(input) = input {
        command.write_stdin(input);
    }
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

#[test]
fn reads_standard_input() {
    let text = fs::read_to_string("problems/k33.toml").unwrap();
    for verb in ["solve", "check"] {
        let (code, out, _) = output_of(&[verb, "-"], Some(&text));
        assert_eq!(code, Some(0));
        assert!(out.starts_with("k33: "), "{out}");
    }
    let (code, _, errors) = output_of(&["solve", "-"], Some("dimension = 4\n"));
    assert_eq!(code, Some(2));
    assert!(errors.contains("standard input:1: dimension: "), "{errors}");
    let (code, _, errors) = output_of(&["solve", "-", "-"], Some(&text));
    assert_eq!(code, Some(2));
    assert!(errors.contains("named twice"), "{errors}");
}

#[test]
fn several_problems_in_one_run() {
    let stopped = "problems/hard/threshold-9.toml";
    let files = ["problems/k33.toml", stopped, OCTAHEDRON];
    let (code, out, _) = output_of(&[&["solve"][..], &files, &["--summary"]].concat(), None);
    let lines: Vec<&str> = out.lines().collect();
    assert_eq!(lines.len(), 3, "{out}");
    assert!(lines[0].starts_with("k33 ") && lines[0].contains("closed, proved"));
    assert!(lines[0].contains("8 solutions") && lines[2].contains("4 solutions"));
    let (one, _, _) = output_of(&["solve", stopped, "--quiet"], None);
    assert_eq!(code, one, "the worst of them");
    let (code, out, _) = output_of(&["solve", files[0], files[2], "--json", "-"], None);
    assert_eq!(code, Some(0));
    let names: Vec<Value> = out
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).unwrap()["problem"].clone())
        .collect();
    assert_eq!(names, ["k33", "octahedron"]);
    // One that is not there costs only itself.
    let (code, out, errors) = output_of(&["solve", OCTAHEDRON, "no-such.toml"], None);
    assert!(
        code == Some(2) && out.starts_with("octahedron: Closed"),
        "{out}"
    );
    assert!(errors.contains("no-such.toml: cannot be read"));
    let (code, _, errors) = output_of(&["solve", OCTAHEDRON, files[0], "--cert", "c.krawl"], None);
    assert_eq!(code, Some(2));
    assert!(errors.contains("`--cert` is for one problem"));
}

#[test]
fn many_solutions_do_not_scroll() {
    let icosahedron = "problems/icosahedron.toml";
    let float = ["--mode", "float"];
    let (code, short, _) = output_of(&[&["solve", icosahedron][..], &float].concat(), None);
    assert_eq!(code, Some(0));
    assert!(
        short.lines().count() < 60,
        "{} lines",
        short.lines().count()
    );
    assert!(
        short.contains("... and 281 solutions more: `--all` prints them"),
        "{short}"
    );
    let (_, all, _) = output_of(
        &[&["solve", icosahedron, "--all"][..], &float].concat(),
        None,
    );
    assert!(all.lines().count() > 3900 && all.contains("Solution 284,"));
    // A few are all printed.
    let (_, few, _) = output_of(&["solve", "problems/prism.toml"], None);
    assert!(
        few.contains("Solution 12,") && !few.contains("--all"),
        "{few}"
    );
}

#[test]
fn solutions_say_how_the_path_reaches_them() {
    let (_, out, _) = output_of(&["solve", OCTAHEDRON], None);
    let lines: Vec<&str> = out
        .lines()
        .filter(|line| line.starts_with("Solution "))
        .collect();
    assert!(
        lines[0].starts_with("Solution 1, class 0, reached without a fold, "),
        "{out}"
    );
    assert!(
        lines[1..].iter().all(|line| line.contains(" fold")),
        "{out}"
    );
}

#[test]
fn a_path_without_solutions_comes_with_advice() {
    let text = |long: u32| {
        format!(
            "name = \"triangle\"\ndimension = 2\n[points]\na = [0, 0]\nb = [100, 0]\nc = [40, 60]\n\
             [constraints]\ndistances = [[\"a\", \"b\", {long}], [\"b\", \"c\", 90], [\"c\", \"a\", 70]]\n"
        )
    };
    let (code, out, _) = output_of(&["check", "-"], Some(&text(200)));
    assert_eq!(code, Some(0));
    // Said once.
    let words = "no figure has these target lengths: a-b is 200, and a-c-b is only 160 long";
    assert!(out.contains(words), "{out}");
    assert_eq!(out.matches("no figure").count(), 1, "{out}");
    let words = "no figure has these lengths: a-b is longer than a-c and c-b together";
    let (_, out, _) = output_of(&["solve", "-"], Some(&text(200)));
    assert!(out.contains(words) && !out.contains("Other paths"), "{out}");
    let (_, out, _) = output_of(&["check", "-"], Some(&text(120)));
    assert!(!out.contains("no figure"), "{out}");
}

#[test]
fn every_help_has_examples_and_exit_codes() {
    let (_, help, _) = output_of(&["--help"], None);
    let verbs: Vec<&str> = help
        .lines()
        .take_while(|line| *line != "Options:")
        .filter_map(|line| line.strip_prefix("  "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|&verb| verb != "help")
        .collect();
    assert!(verbs.len() > 15, "{help}");
    for verb in [&[""][..], &verbs].concat() {
        let arguments: Vec<&str> = [verb, "--help"]
            .into_iter()
            .filter(|a| !a.is_empty())
            .collect();
        let (code, help, _) = output_of(&arguments, None);
        assert_eq!(code, Some(0));
        assert!(
            help.contains("Examples:") && help.contains("Exit codes: 0 "),
            "{verb}: {help}"
        );
    }
}

#[test]
fn shells_and_man_are_told() {
    for (shell, words) in [
        ("bash", "_krawl()"),
        ("zsh", "#compdef krawl"),
        ("fish", "complete -c krawl"),
    ] {
        let (code, out, _) = output_of(&["completions", shell], None);
        assert_eq!(code, Some(0));
        assert!(
            out.contains(words) && out.contains("tube-radius"),
            "{shell}"
        );
    }
    let (_, out, _) = output_of(&["man"], None);
    assert!(out.contains(".TH krawl 1") && out.contains("Exit codes"));
    let folder = tempfile::tempdir().unwrap();
    let (code, _, _) = output_of(&["man", "--dir", folder.path().to_str().unwrap()], None);
    assert_eq!(code, Some(0));
    let solve = fs::read_to_string(folder.path().join("krawl-solve.1")).unwrap();
    assert!(solve.contains("Examples:"));
}

/// Whoever asks for a proof on disk learns from the exit code that there is none, or only of a part.
#[test]
fn proofs_that_are_not_there_are_no_success() {
    let folder = tempfile::tempdir().unwrap();
    // A path through degenerate figures has all of its proof in the certificate.
    let cert = folder.path().join("hexahedron.krawl");
    let problem = "problems/constraints/hexahedron.toml";
    let solve = ["solve", problem, "--quiet", "--cert"];
    krawl().args(solve).arg(&cert).assert().code(0);
    krawl()
        .arg("verify")
        .arg(&cert)
        .arg(problem)
        .assert()
        .code(0);

    // Complex figures of lengths that are those of no real triangle, which sets of solutions stand on.
    let file = folder.path().join("impossible.toml");
    let text = r#"
        name = "impossible"
        dimension = 3
        [points]
        a = [0, 0, 0]
        b = [1, 0, 0]
        c = [0, 1, 0]
        d = [0, 0, 1]
        [constraints]
        distances = [
            ["a", "b", 10], ["c", "d", 10], ["a", "c", 1], ["a", "d", 1], ["b", "c", 1], ["b", "d", 1],
        ]
        "#;
    fs::write(&file, text).unwrap();
    let set = folder.path().join("impossible.set");
    fs::write(&set, "old").unwrap();
    let run = krawl()
        .args(["complex", "--float", "--quiet"])
        .arg(&file)
        .arg("--cert")
        .arg(&set)
        .assert()
        .code(2)
        .get_output()
        .clone();
    let told = String::from_utf8(run.stderr).unwrap();
    assert!(
        told.contains("is left as it was): the figures stand on"),
        "{told}"
    );
    assert!(told.contains("those of no real triangle"), "{told}");
    assert_eq!(fs::read_to_string(&set).unwrap(), "old");
}

/// What is compared with a file is said: of sets of distances alone the sketch is not.
#[test]
fn verify_says_what_it_compared() {
    let folder = tempfile::tempdir().unwrap();
    let cert = folder.path().join("c.krawl");
    let text = |x: &str, last: &str| {
        format!(
            "dimension = 2\n[points]\na = [0, 0]\nb = [{x}, 0]\nc = [1, 3]\n[constraints]\n\
             distances = [[\"a\", \"b\", 4], [\"b\", \"c\", 4.3]{last}]\n"
        )
    };
    let write = |name: &str, text: String| {
        let file = folder.path().join(name);
        fs::write(&file, text).unwrap();
        file
    };
    let of_distances = ", [\"a\", \"c\", 3.1]]\n# ";
    let of_angles = "]\nangles = [[\"b\", \"a\", \"c\", 70]";
    for (last, sketch_counts) in [(of_distances, false), (of_angles, true)] {
        let [own, other] =
            [("own.toml", "4"), ("other.toml", "4.01")].map(|(name, x)| write(name, text(x, last)));
        krawl()
            .arg("all")
            .arg(&own)
            .arg("--quiet")
            .arg("--cert")
            .arg(&cert)
            .assert()
            .success();
        let verify = |file: &std::path::Path| {
            let run = krawl().arg("verify").arg(&cert).arg(file).assert();
            let output = run.get_output();
            (
                output.status.code(),
                String::from_utf8(output.stdout.clone()).unwrap(),
            )
        };
        let (code, text) = verify(&own);
        assert_eq!(code, Some(0), "{text}");
        assert_eq!(text.contains("was not compared"), !sketch_counts, "{text}");
        let (code, text) = verify(&other);
        assert_eq!(code, Some(i32::from(sketch_counts)), "{text}");
        assert!(!text.contains("points and constraints are those"), "{text}");
    }
}

/// `--time` ends a run as Ctrl-C does.
#[test]
fn time_ends_a_run_with_what_was_found() {
    let clock = std::time::Instant::now();
    let run = krawl()
        .args([
            "solve",
            "problems/icosahedron.toml",
            "--max-step",
            "1e-4",
            "--time",
            "1",
        ])
        .assert()
        .code(1);
    let text = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    assert!(text.contains("interrupted"), "{text}");
    assert!(clock.elapsed().as_secs() < 60, "{:?}", clock.elapsed());
    for verb in [
        "solve", "edit", "limits", "motion", "sweep", "all", "complex", "explore", "verify",
        "compare", "template", "work",
    ] {
        let help = krawl().args([verb, "--help"]).assert().success();
        let text = String::from_utf8(help.get_output().stdout.clone()).unwrap();
        assert!(text.contains("--time"), "{verb}");
    }
}

/// Of several files one that cannot be read costs only itself.
#[test]
fn a_broken_file_among_others_is_passed_over() {
    let folder = tempfile::tempdir().unwrap();
    let broken = folder.path().join("broken.toml");
    fs::write(&broken, "dimension\n").unwrap();
    let broken = broken.to_str().unwrap();
    let files = ["solve", OCTAHEDRON, broken, "problems/prism.toml"];
    let (code, told, error) = output_of(&[&files[..], &["--summary"]].concat(), None);
    assert_eq!(code, Some(2));
    assert!(
        told.contains("octahedron") && told.contains("prism"),
        "{told}"
    );
    assert!(error.contains("broken.toml:1"), "{error}");
}

/// A bracket in its own frame is told its figures, though its path ends where a side goes to nothing; ends are told without numbers of the run.
#[test]
fn a_bracket_is_solved() {
    let (code, told, _) = output_of(&["solve", "docs/examples/bracket.toml"], None);
    assert_eq!(code, Some(0));
    assert!(
        told.contains("Complete, proved: 1 figure meets all constraints"),
        "{told}"
    );
    assert!(!told.contains("Jacobian"), "{told}");
}
