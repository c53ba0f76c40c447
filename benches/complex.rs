//! All complex solutions from the shipped templates: paths, tubes and times.
//!
//! ```sh
//! cargo bench --bench complex         # the median of 5 runs
//! cargo bench --bench complex -- 21   # of more
//! ```
//!
//! Beside them PHCpack (`phc`) and Macaulay2 (`M2`), where they are installed, on the system that `krawl export` writes:
//! they find all solutions in the gauge from nothing, so that what they take compares with the template and the
//! instance together.
//!
//! A run follows every path of the template to the instance and proves the results; reading the template,
//! which proves it again, is timed apart.

use krawl::complex::{Export, Template, Ways, export, lower, lower_in_squares, solve};
use krawl::problem::Problem;
use std::process::{Command, Stdio};
use std::time::Instant;

/// Seconds after which another program is stopped.
const PATIENCE: &str = "600";

/// What another program makes of the same system: a line for the table.
fn other(program: &str, name: &str) -> String {
    let is_there = Command::new(program)
        .arg("--version")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .stdin(Stdio::null())
        .status()
        .is_ok();
    if !is_there {
        return format!("skipped: {program} is not installed");
    }
    let problem = Problem::read(format!("problems/{name}.toml")).expect("a shipped problem");
    let lowered = match lower_in_squares(&problem) {
        Ok(lowered) => lowered,
        Err(error) => return format!("skipped: {error}"),
    };
    let (to, ending) = match program {
        "phc" => (Export::PhcPack, ""),
        // Its numerical solver takes inexact coefficients.
        _ => (
            Export::Macaulay2,
            "needsPackage \"NumericalAlgebraicGeometry\"\nS = CC[gens R]\n\
             sols = solveSystem flatten entries gens sub(I, S)\nprint(#sols, \"solutions\")\nexit 0\n",
        ),
    };
    let text = match export(&lowered.system, to, 1e3) {
        Ok(text) => text + ending,
        Err(error) => return format!("skipped: {error}"),
    };
    let folder = std::env::temp_dir().join(format!("krawl-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for files");
    let (input, output) = (folder.join("input"), folder.join("output"));
    let _ = std::fs::remove_file(&output);
    std::fs::write(&input, text).expect("a file for the system");
    let mut command = Command::new("timeout");
    command.args([PATIENCE, program]);
    match program {
        "phc" => command.arg("-b").arg(&input).arg(&output),
        _ => command.arg("--script").arg(&input),
    };
    let begin = Instant::now();
    let run = command.stdin(Stdio::null()).output().expect("timeout runs");
    let seconds = begin.elapsed().as_secs_f64();
    let said = match program {
        "phc" => std::fs::read_to_string(&output).unwrap_or_default(),
        _ => String::from_utf8_lossy(&run.stdout).into_owned(),
    };
    let _ = std::fs::remove_dir_all(&folder);
    let count = said.lines().find(|line| line.contains("solutions"));
    match run.status.code() {
        Some(0) => format!("{seconds:.2} s, {}", count.unwrap_or("").trim()),
        Some(124) => format!("stopped after {PATIENCE} s"),
        _ => format!("failed after {seconds:.2} s"),
    }
}

fn median(mut seconds: Vec<f64>) -> f64 {
    seconds.sort_by(f64::total_cmp);
    seconds[seconds.len() / 2]
}

fn main() {
    let runs = std::env::args()
        .filter_map(|a| a.parse().ok())
        .next()
        .unwrap_or(5usize)
        .max(1);
    println!(
        "{:<18} {:>6} {:>8} {:>12} {:>12} {:>12} {:>12}",
        "problem", "paths", "tubes", "read ms", "solve ms", "us per tube", "ms per path"
    );
    for name in [
        "octahedron",
        "k33",
        "prism",
        "disulfide",
        "constraints/3p3l-orthogonal",
    ] {
        let problem = Problem::read(format!("problems/{name}.toml")).expect("a shipped problem");
        let lowered = lower(&problem).expect("a complex system");
        let text = std::fs::read_to_string(format!("problems/{name}.krawl-template"));
        let text = text.expect("a shipped template");
        let (mut reading, mut solving, mut last) = (Vec::new(), Vec::new(), None);
        for _ in 0..runs {
            let begin = Instant::now();
            let template = Template::read(&text, &lowered.system).expect("in order");
            reading.push(begin.elapsed().as_secs_f64());
            let solutions = solve(&lowered, &template, &Ways::default());
            solving.push(solutions.seconds);
            last = Some(solutions);
        }
        let effort = last.expect("at least one run").effort;
        let (read, seconds) = (median(reading), median(solving));
        let per_tube = 1e6 * seconds / (effort.tubes + effort.rejected).max(1) as f64;
        println!(
            "{:<18} {:>6} {:>8} {:>12.2} {:>12.2} {:>12.1} {:>12.3}",
            problem.name,
            effort.paths,
            effort.tubes,
            1e3 * read,
            1e3 * seconds,
            per_tube,
            1e3 * seconds / effort.paths.max(1) as f64
        );
    }
    for program in ["phc", "M2"] {
        println!();
        for name in ["octahedron", "k33", "prism", "disulfide"] {
            println!("{name:<18} {program}: {}", other(program, name));
        }
    }
}
