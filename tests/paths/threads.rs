//! How many threads there are is nobody's business: results are the same for one, two, three, eight.

use crate::common::certificate::{self, Certificate};
use crate::common::random::problems;
use crate::common::{SHORT, shipped};
use krawl::certificate::{Outcome, Settings, Verdict, verify};
use krawl::problem::Problem;
use krawl::track::{self, Control, Options, Space};
use rayon::prelude::*;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;

const THREADS: [usize; 4] = [1, 2, 3, 8];

fn short() -> impl Iterator<Item = Problem> {
    SHORT.into_iter().map(|(name, _)| shipped(name))
}

fn all_ways() -> Vec<Options> {
    let mut ways = crate::common::ways();
    ways.push(Options {
        space: Space::Reduced,
        ..Options::certified()
    });
    for way in &mut ways {
        way.max_steps = 20_000;
    }
    ways
}

/// All that a run says but how long it took.
fn run(problem: &Problem, options: &Options) -> track::Outcome {
    let outcome = track::solve(problem, options, &mut Control::default()).unwrap();
    track::Outcome {
        seconds: 0.0,
        ..outcome
    }
}

#[test]
fn runs_side_by_side_are_the_same_runs() {
    let problems: Vec<Problem> = short().chain(problems(40)).collect();
    let jobs: Vec<(&Problem, Options)> = problems
        .iter()
        .flat_map(|problem| all_ways().into_iter().map(move |way| (problem, way)))
        .collect();
    let mut first: Option<Vec<track::Outcome>> = None;
    for threads in THREADS {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let outcomes: Vec<track::Outcome> = pool
            .build()
            .unwrap()
            .install(|| jobs.par_iter().map(|(p, way)| run(p, way)).collect());
        let first = first.get_or_insert_with(|| outcomes.clone());
        for (((problem, way), one), other) in jobs.iter().zip(&*first).zip(&outcomes) {
            assert_eq!(one, other, "{}, {way:?}, {threads} threads", problem.name);
        }
    }
}

fn checked(bytes: &[u8], threads: usize) -> Verdict {
    verify(bytes, &Settings { threads }, &mut |_| ()).unwrap()
}

/// True certificates, those of stopped runs, and false ones: the same flaw is named, though there are
/// several, in pieces that different threads look at.
#[test]
fn verdicts_are_the_same() {
    let mut certificates: Vec<Vec<u8>> = ["octahedron", "k33", "prism"]
        .map(certificate::shipped)
        .into();
    let stopped = Options {
        max_steps: 15,
        ..Options::certified()
    };
    for problem in problems(24) {
        certificates.push(certificate::of(&problem, &Options::certified()).1);
        certificates.push(certificate::of(&problem, &stopped).1);
    }
    for k in 0..certificates.len() {
        let mut false_one = Certificate::read(&certificates[k]);
        let tubes = false_one.tubes();
        for at in [tubes / 5, tubes / 2, tubes / 2 + 1, 4 * tubes / 5] {
            if at < tubes {
                false_one.tube_mut(at).centre[0] += 0.01;
            }
        }
        certificates.push(false_one.bytes());
    }
    let (mut verified, mut refuted) = (0, 0);
    for bytes in &certificates {
        let one = checked(bytes, 1);
        match one.outcome {
            Outcome::Verified => verified += 1,
            Outcome::Refuted(_) | Outcome::NotProved(_) => refuted += 1,
            Outcome::Partial(_) => {}
        }
        for threads in &THREADS[1..] {
            let other = checked(bytes, *threads);
            // Debug text tells all bits of all numbers.
            assert_eq!(
                format!("{one:?}"),
                format!("{other:?}"),
                "{threads} threads"
            );
        }
    }
    assert!(verified >= 20, "{verified} verified");
    assert!(refuted >= 20, "{refuted} refuted");
}

/// Without what depends on the clock.
fn timeless(value: &mut Value) {
    match value {
        Value::Object(fields) => {
            for clock in ["seconds", "runs", "ratio"] {
                fields.remove(clock);
            }
            fields.values_mut().for_each(timeless);
        }
        Value::Array(items) => items.iter_mut().for_each(timeless),
        _ => {}
    }
}

/// Exit code and output of the program with so many threads.
fn krawl(threads: usize, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_krawl"))
        .args(arguments)
        .env("RAYON_NUM_THREADS", threads.to_string())
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    (output.status.code(), text)
}

fn json(threads: usize, arguments: &[&str]) -> (Option<i32>, Value) {
    let (code, text) = krawl(threads, arguments);
    let mut value = serde_json::from_str(&text).unwrap();
    timeless(&mut value);
    (code, value)
}

/// The program, with processes side by side as well.
#[test]
fn the_program_says_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let mut files: Vec<String> = ["dodecagon", "k33", "prism"]
        .map(|name| format!("problems/{name}.toml"))
        .into();
    for (k, problem) in problems(6).iter().enumerate() {
        let file = folder.path().join(format!("{k}.toml"));
        fs::write(&file, problem.to_toml()).unwrap();
        files.push(file.to_str().unwrap().to_owned());
    }
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    // The paper's own steps take minutes on some random problems: only shipped ones.
    let compare = [&["compare", "--repeat", "1", "--json", "-"], &files[..3]].concat();
    let mut first = None;
    for threads in THREADS {
        let solve = |file: &str| {
            let certificate = folder.path().join(format!("{}.krawl", name_of(file)));
            let certificate = certificate.to_str().unwrap();
            let solved = json(
                threads,
                &["solve", file, "--json", "-", "--cert", certificate],
            );
            let count = threads.to_string();
            let (code, text) = krawl(threads, &["verify", certificate, file, "--threads", &count]);
            (
                solved,
                fs::read(certificate).unwrap(),
                (code, without_seconds(&text)),
            )
        };
        let solved: Vec<_> = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap()
            .install(|| files.par_iter().map(|file| solve(file)).collect());
        let compared = json(threads, &compare);
        let all = (solved, compared);
        assert!(all.0.iter().any(|(_, _, verdict)| verdict.0 == Some(0)));
        match &first {
            None => first = Some(all),
            Some(first) => assert!(*first == all, "{threads} threads:\n{first:?}\n\n{all:?}"),
        }
    }
}

fn name_of(file: &str) -> &str {
    Path::new(file).file_stem().unwrap().to_str().unwrap()
}

/// The last line says how long it took: `…, 0.012 s, written by …`.
fn without_seconds(text: &str) -> String {
    let seconds = |part: &&str| !part.ends_with(" s");
    let parts: Vec<&str> = text.split(", ").filter(seconds).collect();
    assert!(parts.len() < text.split(", ").count(), "{text}");
    parts.join(", ")
}
