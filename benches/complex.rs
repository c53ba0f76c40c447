//! All complex solutions from the shipped templates: paths, tubes and times.
//!
//! ```sh
//! cargo bench --bench complex         # the median of 5 runs
//! cargo bench --bench complex -- 21   # of more
//! ```
//!
//! A run follows every path of the template to the instance and proves the results; reading the template,
//! which proves it again, is timed apart.

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
}
