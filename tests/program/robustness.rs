//! Input that nobody would write, and interrupts that come when they come: no panic, bounded memory,
//! results that can be read.

use assert_cmd::Command;
use krawl::problem::Problem;
use krawl::track::{self, Control, Options, Space};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command as Process, Stdio};
use std::time::Duration;

/// Shipped files, hard ones among them.
fn shipped_texts() -> Vec<String> {
    let read = |folder: &str| {
        let files = fs::read_dir(folder)
            .unwrap()
            .map(|file| file.unwrap().path());
        let mut files: Vec<_> = files
            .filter(|file| file.extension().is_some_and(|e| e == "toml"))
            .collect();
        files.sort();
        files
    };
    let files = [read("problems"), read("problems/hard")].concat();
    files
        .iter()
        .map(|f| fs::read_to_string(f).unwrap())
        .collect()
}

/// Reads it, and follows the path for a little while if there is one.
fn survives(text: &str, solve: bool) -> Result<bool, TestCaseError> {
    match Problem::parse(text, "odd.toml") {
        Err(error) => {
            let message = error.to_string();
            prop_assert!(message.starts_with("odd.toml:"), "{message}");
            prop_assert!(!message.trim_end().contains('\n'), "{message}");
            Ok(false)
        }
        Ok(problem) => {
            prop_assert_eq!(problem.check(), Ok(()));
            prop_assert_eq!(
                &Problem::parse(&problem.to_toml(), "again.toml").unwrap(),
                &problem
            );
            if solve {
                for options in [
                    Options::certified(),
                    Options::float(Space::Full),
                    Options::float(Space::Reduced),
                ] {
                    let options = Options {
                        max_steps: 60,
                        ..options
                    };
                    // An error is an answer, too.
                    let _ = track::solve(&problem, &options, &mut Control::default());
                }
            }
            Ok(true)
        }
    }
}

/// Pieces of problem files, and of other things.
const PIECES: &[&str] = &[
    "name",
    "dimension",
    "source",
    "points",
    "constraints",
    "homotopy",
    "distances",
    "squared_distances",
    "reference",
    "bend",
    "bend_coefficient",
    "=",
    "=",
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    ",",
    ".",
    "\"p1\"",
    "\"p2\"",
    "\"p3\"",
    "p1",
    "p2",
    "p3",
    "2",
    "3",
    "1.5",
    "-0.0",
    "1e60",
    "1e-61",
    "nan",
    "-inf",
    "0x10",
    "1_000",
    "true",
    "'",
    "\"",
    "\"\"\"",
    "#",
    "\n",
    "\n",
    "\n",
    " ",
    "\t",
    "\r\n",
    "\\",
    "é",
    "\u{feff}",
    "1979-05-27",
];

/// A line of a problem file with its parts exchanged.
fn garbage_line() -> impl Strategy<Value = String> {
    let piece = || (0..PIECES.len()).prop_map(|k| PIECES[k]);
    let number = prop_oneof![
        any::<f64>().prop_map(|x| x.to_string()),
        (-9i32..9, -70i32..70).prop_map(|(m, e)| format!("{m}.5e{e}")),
        piece().prop_map(str::to_owned),
    ];
    let point =
        (piece(), number.clone(), number.clone()).prop_map(|(p, x, y)| format!("{p} = [{x}, {y}]"));
    let distance = (piece(), piece(), number).prop_map(|(p, q, d)| format!("[{p}, {q}, {d}],"));
    prop_oneof![
        3 => point,
        3 => distance,
        1 => Just("[points]".to_owned()),
        1 => Just("dimension = 2".to_owned()),
        1 => Just("[constraints]\ndistances = [".to_owned()),
        1 => Just("]".to_owned()),
        1 => Just("[homotopy]".to_owned()),
        1 => Just("bend_coefficient = -3.0".to_owned()),
        2 => prop::collection::vec(piece(), 1..12).prop_map(|pieces| pieces.concat()),
    ]
}

/// A triangle whose numbers and names are anything: many of them are problems.
fn odd_triangle() -> impl Strategy<Value = String> {
    let number = || {
        prop_oneof![
            4 => (-99i32..99, -3i32..1).prop_map(|(m, e)| format!("{m}e{e}")),
            1 => (1i32..99, -62i32..60).prop_map(|(m, e)| format!("{m}e{e}")),
        ]
    };
    let numbers = prop::collection::vec(number(), 10);
    (numbers, 2..=3usize).prop_map(|(n, dimension)| {
        let place = |k: usize| match dimension {
            2 => format!("[{}, {}]", n[2 * k], n[2 * k + 1]),
            _ => format!("[{}, {}, {}]", n[2 * k], n[2 * k + 1], n[9 - k]),
        };
        format!(
            "dimension = {dimension}\n[points]\na = {}\nb = {}\nc = {}\n[constraints]\n\
             distances = [[\"a\", \"b\", {}], [\"b\", \"c\", {}], [\"c\", \"a\", {}]]\n\
             [homotopy]\nbend_coefficient = {}",
            place(0),
            place(1),
            place(2),
            n[6].trim_start_matches('-'),
            n[7].trim_start_matches('-'),
            n[8].trim_start_matches('-'),
            n[9]
        )
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn flipped_bytes_are_survived(
        which in any::<prop::sample::Index>(),
        flips in prop::collection::vec((any::<prop::sample::Index>(), 0u8..8), 1..6),
    ) {
        let texts = shipped_texts();
        let mut bytes = texts[which.index(texts.len())].clone().into_bytes();
        for (at, bit) in flips {
            let at = at.index(bytes.len());
            bytes[at] ^= 1 << bit;
        }
        survives(&String::from_utf8_lossy(&bytes), bytes.len() < 1200)?;
    }

    #[test]
    fn garbage_is_survived(lines in prop::collection::vec(garbage_line(), 0..25)) {
        survives(&lines.join("\n"), true)?;
    }

    #[test]
    fn odd_triangles_are_survived(text in odd_triangle()) {
        survives(&text, true)?;
    }
}

#[test]
fn enough_odd_triangles_are_problems() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let problems = (0..200).filter(|_| {
        let text = odd_triangle().new_tree(&mut runner).unwrap().current();
        Problem::parse(&text, "odd.toml").is_ok()
    });
    let problems = problems.count();
    assert!(problems > 50, "{problems} of 200");
}

/// Runs the program on a file with so little memory that it would end in an abort if it asked for more.
#[cfg(target_os = "linux")]
fn with_little_memory(file: &Path) -> std::process::Output {
    Process::new("sh")
        .args(["-c", "ulimit -v 400000; exec \"$0\" solve \"$1\" --quiet"])
        .arg(env!("CARGO_BIN_EXE_krawl"))
        .arg(file)
        .output()
        .unwrap()
}

#[test]
#[cfg(target_os = "linux")]
fn a_megabyte_of_anything_is_refused_in_little_memory() {
    const SIZE: usize = 1 << 20;
    let head = "dimension = 2\n[points]\n";
    let many = |line: &dyn Fn(usize) -> String, size: usize| {
        let mut text = String::new();
        for k in 0.. {
            let line = line(k);
            if text.len() + line.len() > size {
                return text;
            }
            text += &line;
        }
        unreachable!()
    };
    let points = |count: usize| -> String {
        (0..count)
            .map(|k| format!("p{k} = [{k}.5, {}.25]\n", k % 7))
            .collect()
    };
    let room = SIZE - 100;
    let megabytes = [
        (
            "points",
            head.to_owned() + &many(&|k| format!("p{k}=[{k},1]\n"), room),
        ),
        (
            "one point",
            format!("{head}p = [{}1]", "1,".repeat(room / 2)),
        ),
        (
            "distances",
            format!(
                "{head}{}[constraints]\ndistances = [{}]",
                points(1000),
                many(
                    &|k| format!(
                        "[\"p{}\",\"p{}\",1],",
                        k % 1000,
                        (k % 1000 + k / 1000 + 1) % 1000
                    ),
                    room - 25_000
                )
            ),
        ),
        (
            "references",
            format!(
                "{head}[homotopy]\nreference=[{}]",
                "\"p\",".repeat(room / 4)
            ),
        ),
        ("brackets", format!("a={}", "[".repeat(room))),
        ("braces", format!("a={}", "{a=".repeat(room / 3))),
        ("dotted keys", format!("{}a=1", "a.".repeat(room / 2))),
        ("tables", many(&|k| format!("[t{k}]\n"), room)),
        ("arrays of tables", "[[a]]\n".repeat(room / 6)),
        ("a name", format!("name = \"{}\"", "x".repeat(room))),
        ("digits", format!("{head}p = [{}, 1]", "1".repeat(room))),
        ("quotes", "\"".repeat(room)),
        ("zeros", "\0".repeat(room)),
    ];
    let folder = tempfile::tempdir().unwrap();
    for (what, text) in megabytes {
        assert!(
            text.len() <= SIZE && text.len() > SIZE / 2,
            "{what}: {}",
            text.len()
        );
        let file = folder.path().join("megabyte.toml");
        fs::write(&file, text).unwrap();
        let output = with_little_memory(&file);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{what}: {message}");
        assert_eq!(message.lines().count(), 1, "{what}: {message}");
        assert!(message.len() < 600, "{what}: {message}");
    }
}

/// The icosahedron's path, long enough to be interrupted on it.
fn interrupted_after(delay: Duration, folder: &Path) -> Option<i32> {
    let mut run = Process::new(env!("CARGO_BIN_EXE_krawl"))
        .args(["solve", "problems/icosahedron.toml", "--quiet", "--json"])
        .arg(folder.join("out.json"))
        .arg("--cert")
        .arg(folder.join("out.krawl"))
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(delay);
    let _ = Process::new("kill")
        .args(["-INT", &run.id().to_string()])
        .stderr(Stdio::null())
        .status()
        .unwrap();
    run.wait().unwrap().code()
}

/// At any moment: what is written can be read, and what is half done is not there.
#[test]
#[cfg(unix)]
fn interrupts_leave_what_can_be_read() {
    let mut stopped = 0;
    for round in 0..10u64 {
        let folder = tempfile::tempdir().unwrap();
        let delay = Duration::from_micros(round * round * 2000 + round * 37 % 1000);
        let code = interrupted_after(delay, folder.path());
        let files = fs::read_dir(folder.path()).unwrap().count();
        let Some(code) = code else {
            // The signal came before the program had begun.
            assert_eq!(files, 0, "after {delay:?}");
            continue;
        };
        assert!(code == 0 || code == 1, "{code} after {delay:?}");
        assert_eq!(files, 2, "after {delay:?}");
        let json = fs::read_to_string(folder.path().join("out.json")).unwrap();
        let json: Value = serde_json::from_str(&json).unwrap();
        let status = if code == 0 { "closed" } else { "stopped" };
        assert_eq!(json["status"], status, "after {delay:?}");
        // The checker reads what there is, and takes no part for the whole.
        let verify = Command::new(env!("CARGO_BIN_EXE_krawl"))
            .arg("verify")
            .arg(folder.path().join("out.krawl"))
            .args(["problems/icosahedron.toml", "--quiet"])
            .assert();
        assert_eq!(
            verify.get_output().status.code(),
            // Incomplete, where the run stopped.
            Some(if code == 0 { 0 } else { 4 }),
            "after {delay:?}"
        );
        if code == 1 {
            stopped += 1;
            assert!(json["reason"].as_str().unwrap().contains("interrupted"));
        }
    }
    assert!(stopped > 2, "{stopped} runs were interrupted");
}

/// Figures of which one length is 10^57 others: steps and bounds over- and underflow. Float runs once
/// looked for t = 1 without end there.
#[test]
fn wild_sizes_come_to_an_end() {
    let triangle = |a: &str, b: &str, c: &str, lengths: [&str; 3], bend: &str| {
        let text = format!(
            "dimension = 3\n[points]\na = {a}\nb = {b}\nc = {c}\n[constraints]\ndistances = [\
             [\"a\", \"b\", {}], [\"b\", \"c\", {}], [\"c\", \"a\", {}]]\n\
             [homotopy]\nbend_coefficient = {bend}",
            lengths[0], lengths[1], lengths[2]
        );
        survives(&text, true).unwrap()
    };
    let clock = std::time::Instant::now();
    let one = triangle(
        "[53.0, 3.0, 60e11]",
        "[-56.0, 9.7, 3.7]",
        "[-1.3, 0.13, 63e57]",
        ["0.6", "63e57", "3.7"],
        "60e11",
    );
    let other = triangle(
        "[-81.0, 19e-32, 0.42]",
        "[0.032, 15.0, 6.0]",
        "[3.7, -3.0, 25e38]",
        ["0.041", "25e38", "6.0"],
        "0.42",
    );
    assert!(one && other, "both are problems");
    assert!(clock.elapsed() < Duration::from_secs(20));
}
