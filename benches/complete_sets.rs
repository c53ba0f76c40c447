//! All real solutions, proved complete: parts and times, beside what they should be.
//!
//! ```sh
//! cargo bench --bench complete_sets         # the best of 5 runs, and 60 s for the icosahedron
//! cargo bench --bench complete_sets -- 600  # more time for the icosahedron
//! ```
//!
//! Parts of the parameter space looked at do not depend on what else the machine does; times do. Parts of trials that
//! chose the plan are not counted, their time is. The other programs that prove such sets (msolve, ibexsolve,
//! RealPaver) run beside them where they are installed, on the system that `krawl export` writes.

mod others;
#[path = "others/shipped.rs"]
mod shipped;

use krawl::complete::{Complete, Options, Part, all};
use krawl::problem::Problem;
use std::time::Duration;

/// The problems, and the seconds that one thread may take.
const ROWS: [(&str, f64); 6] = [
    ("octahedron", 1e-3),
    ("k33", 1e-3),
    ("prism", 1e-3),
    ("disulfide", 5e-3),
    ("dodecagon", 30e-3),
    ("icosahedron", 90.0),
];
const RUNS: usize = 5;

fn best(problem: &Problem, threads: usize, seconds: f64) -> Complete {
    let long = problem.name == "icosahedron";
    let options = || Options {
        threads,
        time: long.then(|| Duration::from_secs_f64(seconds)),
        ..Options::default()
    };
    let runs = (0..if long { 1 } else { RUNS }).map(|_| all(problem, &options()).expect("served"));
    runs.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
        .expect("one run at least")
}

fn main() {
    let seconds = std::env::args()
        .filter_map(|argument| argument.parse::<f64>().ok())
        .next()
        .unwrap_or(60.0);
    println!(
        "{:<12} {:>2} {:>10} {:>10} {:>12} {:>12} {:>10}  status",
        "problem", "k", "parts", "solutions", "one thread", "all threads", "at most"
    );
    for (name, budget) in ROWS {
        let problem = Problem::read(format!("problems/{name}.toml")).expect("a shipped problem");
        let (one, every) = (best(&problem, 1, seconds), best(&problem, 0, seconds));
        let open = |result: &Complete| -> f64 {
            let share = |part: &Part| part.share;
            result.undecided.iter().map(share).sum()
        };
        let status = match open(&one) {
            0.0 => one.status.name().to_owned(),
            open => format!(
                "{}: {:.4} % of the space done",
                one.status.name(),
                100.0 * (1.0 - open)
            ),
        };
        println!(
            "{name:<12} {:>2} {:>10} {:>10} {:>9.2} ms {:>9.2} ms {:>7.0} ms  {status}",
            one.driving,
            one.boxes,
            one.solutions.len(),
            1e3 * one.seconds,
            1e3 * every.seconds,
            1e3 * budget,
        );
    }
    for program in ["msolve", "ibexsolve", "realpaver"] {
        println!();
        for (name, _) in ROWS {
            println!(
                "{name:<12} {program}: {}",
                shipped::run(program, name, 100.0)
            );
        }
    }
}
