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
//! which proves it again, is timed apart. Steps are tubes, those tried in vain with them, or steps in floats.

mod others;
#[path = "others/shipped.rs"]
mod shipped;

use krawl::complex::{Template, Ways, lower, solve};
use krawl::problem::Problem;
use std::time::Instant;

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
        "{:<18} {:<8} {:>6} {:>9} {:>10} {:>10} {:>12} {:>12}  status",
        "problem", "paths", "number", "steps", "read ms", "solve ms", "us per step", "ms per path"
    );
    for (name, modes) in [
        ("octahedron", &[true, false][..]),
        ("k33", &[true, false]),
        ("prism", &[true, false]),
        ("disulfide", &[true, false]),
        ("constraints/3p3l-orthogonal", &[true, false]),
        ("constraints/3p3l", &[true, false]),
        ("constraints/pentahedron", &[false]),
        ("dodecagon", &[false]),
    ] {
        for &proved in modes {
            row(name, proved, runs);
        }
    }
    for program in ["phc", "M2"] {
        println!();
        for name in ["octahedron", "k33", "prism", "disulfide"] {
            println!("{name:<18} {program}: {}", shipped::run(program, name, 1e3));
        }
    }
}

/// A problem from its shipped template, its paths proved or in floats.
fn row(name: &str, proved: bool, runs: usize) {
    let problem = Problem::read(format!("problems/{name}.toml")).expect("a shipped problem");
    let lowered = lower(&problem).expect("a complex system");
    let text = std::fs::read_to_string(format!("problems/{name}.krawl-template"));
    let text = text.expect("a shipped template");
    let ways = Ways {
        proved,
        ..Ways::default()
    };
    let (mut reading, mut solving, mut last) = (Vec::new(), Vec::new(), None);
    for _ in 0..runs {
        let begin = Instant::now();
        let template = Template::read(&text, &lowered.system).expect("in order");
        reading.push(begin.elapsed().as_secs_f64());
        let solutions = solve(&lowered, &template, &ways);
        solving.push(solutions.seconds);
        last = Some(solutions);
    }
    let last = last.expect("at least one run");
    let effort = last.effort;
    let (read, seconds) = (median(reading), median(solving));
    let steps = effort.tubes + effort.rejected + effort.steps;
    println!(
        "{:<18} {:<8} {:>6} {steps:>9} {:>10.2} {:>10.2} {:>12.1} {:>12.3}  {:?}, {} real",
        problem.name,
        if proved { "proved" } else { "floats" },
        effort.paths,
        1e3 * read,
        1e3 * seconds,
        1e6 * seconds / steps.max(1) as f64,
        1e3 * seconds / effort.paths.max(1) as f64,
        last.status,
        last.real().count(),
    );
}
