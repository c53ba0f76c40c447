//! What a check costs beside the run that it checks, on one thread: `cargo bench --bench certificates`.
//!
//! The run's time is without writing the certificate. Run and check take turns, so that the ratios
//! hold on a machine whose speed drifts; figures are the best of many, which other work on the
//! machine disturbs least. The budget is printed last.

use krawl::certificate::{Outcome, Settings, Writer, verify};
use krawl::problem::Problem;
use krawl::track::{Control, Options, solve};
use std::time::Instant;

/// Check over run, at most.
const BUDGET: f64 = 15.0;

fn main() {
    // `cargo bench` passes --bench; anything else picks problems by name.
    let arguments = std::env::args().skip(1);
    let wanted: Vec<String> = arguments.filter(|a| !a.starts_with('-')).collect();
    let mut ratios = Vec::new();
    println!(
        "{:<15} {:>6} {:>9} {:>8} {:>9} {:>9} {:>9} {:>7}",
        "problem", "tubes", "bytes", "margin", "run, ms", "check, ms", "µs/tube", "ratio"
    );
    for name in [
        "octahedron",
        "disulfide",
        "dodecagon",
        "k33",
        "prism",
        "icosahedron-c1",
    ] {
        if !wanted.is_empty() && !wanted.iter().any(|w| w == name) {
            continue;
        }
        let problem = Problem::read(format!("problems/{name}.toml")).expect("a shipped problem");
        let mut writer = Writer::new(Vec::new(), &problem);
        let mut control = Control {
            witness: Some(&mut writer),
            ..Control::default()
        };
        solve(&problem, &Options::certified(), &mut control).expect("a run");
        let certificate = writer.finish().expect("a certificate");

        let settings = Settings { threads: 1 };
        let check = || verify(&certificate[..], &settings, &mut |_| ()).expect("a certificate");
        let verdict = check();
        assert_eq!(verdict.outcome, Outcome::Verified, "{name}");
        let (mut runs, mut checks) = (Vec::new(), Vec::new());
        let start = Instant::now();
        while runs.len() < 9 || start.elapsed().as_secs_f64() < 2.0 {
            let outcome = solve(&problem, &Options::certified(), &mut Control::default());
            runs.push(outcome.expect("a run").seconds);
            let clock = Instant::now();
            check();
            checks.push(clock.elapsed().as_secs_f64());
        }
        let best = |seconds: Vec<f64>| seconds.into_iter().fold(f64::INFINITY, f64::min);
        let (run, check) = (best(runs), best(checks));
        println!(
            "{name:<15} {:>6} {:>9} {:>8.4} {:>9.2} {:>9.2} {:>9.1} {:>7.1}",
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
        println!("  {name:<15} check / run {ratio:>6.1}  at most {BUDGET:>4.1}  {verdict}");
    }
}
