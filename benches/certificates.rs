//! What a check costs beside the run that it checks, on one thread: `cargo bench --bench certificates`.
//!
//! The run's time is without writing the certificate. Times are those that the processor spent, so that other work on the machine disturbs them little: averages over about a
//! second of each (one call where that takes longer), taking turns. The budget is printed last.

use cpu_time::ProcessTime;
use krawl::certificate::{Outcome, Settings, Writer, verify};
use krawl::problem::Problem;
use krawl::track::{Control, Options, Status, solve};
use std::time::Instant;

/// Check over run, at most.
const BUDGET: f64 = 10.0;

fn main() {
    // `cargo bench` passes --bench; anything else picks problems by name.
    let arguments = std::env::args().skip(1);
    let wanted: Vec<String> = arguments.filter(|a| !a.starts_with('-')).collect();
    let (mut ratios, mut left_out) = (Vec::new(), Vec::new());
    println!(
        "{:<35} {:>6} {:>9} {:>8} {:>9} {:>9} {:>9} {:>7}",
        "problem", "tubes", "bytes", "margin", "run, ms", "check, ms", "µs/tube", "ratio"
    );
    for name in shipped() {
        if !wanted.is_empty() && !wanted.contains(&name) {
            continue;
        }
        let problem = Problem::read(format!("problems/{name}.toml")).expect("a shipped problem");
        let mut writer = Writer::new(Vec::new(), &problem);
        let mut control = Control {
            witness: Some(&mut writer),
            ..Control::default()
        };
        let run = solve(&problem, &Options::certified(), &mut control);
        let is_whole = run.is_ok_and(|run| matches!(run.status, Status::Closed | Status::Open(_)));
        let certificate = writer.finish().expect("a certificate");
        let settings = Settings { threads: 1 };
        let check = || verify(&certificate[..], &settings, &mut |_| ()).expect("a certificate");
        if !is_whole || check().outcome != Outcome::Verified {
            left_out.push(name);
            continue;
        }
        let verdict = check();
        let run = || {
            solve(&problem, &Options::certified(), &mut Control::default()).expect("a run");
        };
        let check = || {
            check();
        };
        let (mut run_seconds, mut check_seconds) = (0.0, 0.0);
        const ROUNDS: u32 = 4;
        for _ in 0..ROUNDS {
            run_seconds += average(&run) / f64::from(ROUNDS);
            check_seconds += average(&check) / f64::from(ROUNDS);
        }
        let (run, check) = (run_seconds, check_seconds);
        println!(
            "{name:<35} {:>6} {:>9} {:>8.4} {:>9.2} {:>9.2} {:>9.1} {:>7.1}",
            verdict.tubes,
            certificate.len(),
            verdict.margin,
            1e3 * run,
            1e3 * check,
            1e6 * check / verdict.tubes as f64,
            check / run
        );
        ratios.push((name, check / run));
    }
    println!("\nmargin: the smallest of a Krawczyk test. Budgets:");
    for (name, ratio) in ratios {
        let verdict = if ratio <= BUDGET { "met" } else { "MISSED" };
        println!("  {name:<35} check / run {ratio:>6.1}  at most {BUDGET:>4.1}  {verdict}");
    }
    println!(
        "\nWithout a certificate that proves the whole path: {}",
        left_out.join(", ")
    );
}

/// The problems that come with krawl, by the names of their files.
fn shipped() -> Vec<String> {
    let mut names = Vec::new();
    for folder in ["", "constraints/", "mechanisms/", "complex/", "hard/"] {
        let entries = std::fs::read_dir(format!("problems/{folder}")).expect("shipped problems");
        for entry in entries {
            let file = entry.expect("an entry").file_name();
            let name = file.to_str().and_then(|file| file.strip_suffix(".toml"));
            names.extend(name.map(|name| format!("{folder}{name}")));
        }
    }
    names.sort_by_key(|name| (name.contains('/'), name.clone()));
    names
}

/// The processor's seconds that one of many calls takes, which take a quarter of a second together.
fn average(work: &dyn Fn()) -> f64 {
    let (clock, processor) = (Instant::now(), ProcessTime::now());
    let mut calls = 0;
    while calls == 0 || clock.elapsed().as_secs_f64() < 0.25 {
        work();
        calls += 1;
    }
    processor.elapsed().as_secs_f64() / f64::from(calls)
}
