//! What each mode and space costs on each shipped problem, in one table: `cargo bench`.
//!
//! Every figure is the median of several runs, the runs of all modes taking turns, so that the
//! ratios hold on a machine whose speed drifts. Times are those of following the path: reading
//! the file and starting the process are not in them. The budgets are printed last.

use krawl::problem::Problem;
use krawl::track::{Control, Options, Outcome, Space, Status, solve};
use std::path::Path;
use std::time::Instant;

/// Problems, with the time of RR 8705, table 1 (reduced, i7-5600U), in seconds.
const PROBLEMS: [(&str, Option<f64>); 7] = [
    ("octahedron", Some(0.02)),
    ("disulfide", Some(0.09)),
    ("dodecagon", Some(0.01)),
    ("icosahedron-c1", None),
    ("icosahedron", Some(1.5)),
    ("k33", None),
    ("prism", None),
];

struct Row {
    name: &'static str,
    options: Options,
}

struct Measured {
    outcome: Outcome,
    median: f64,
}

fn main() {
    // `cargo bench` passes --bench; anything else picks problems by name.
    let wanted: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    let rows = [
        Row {
            name: "float full",
            options: Options::float(Space::Full),
        },
        Row {
            name: "float reduced",
            options: Options::float(Space::Reduced),
        },
        Row {
            name: "certified full",
            options: Options::certified(),
        },
        Row {
            name: "paper full",
            options: Options::paper(Space::Full),
        },
        Row {
            name: "paper reduced",
            options: Options::paper(Space::Reduced),
        },
    ];
    let mut budgets = Vec::new();
    println!(
        "{:<15} {:<15} {:>7} {:>8} {:>9} {:>10} {:>8} {:>7}  outcome",
        "problem", "mode", "steps", "rejected", "solutions", "ms", "µs/step", "ratio"
    );
    for (name, published) in PROBLEMS {
        if !wanted.is_empty() && !wanted.iter().any(|w| w == name) {
            continue;
        }
        let problem =
            Problem::read(Path::new(&format!("problems/{name}.toml"))).expect("a shipped problem");
        let measured = measure(&problem, &rows);
        let full = measured[0].median;
        for (row, m) in rows.iter().zip(&measured) {
            let o = &m.outcome;
            let outcome = match &o.status {
                Status::Open(_) => "open",
                Status::Closed => "closed",
                Status::Stopped(stop) => &stop.text,
            };
            println!(
                "{name:<15} {:<15} {:>7} {:>8} {:>9} {:>10.3} {:>8.2} {:>7.2}  {outcome}",
                row.name,
                o.steps,
                o.rejected,
                o.solutions.len(),
                1e3 * m.median,
                per_step(m),
                m.median / full,
            );
        }
        let certified = measured[2].median;
        budgets.push((
            format!("{name}: certified / float full"),
            certified / full,
            3.0,
        ));
        if matches!(name, "disulfide" | "icosahedron-c1") {
            let label = format!("{name}: float reduced / float full, per step");
            budgets.push((label, per_step(&measured[1]) / per_step(&measured[0]), 0.5));
        }
        if let Some(published) = published {
            budgets.push((
                format!("{name}: certified / published float"),
                certified / published,
                1.0,
            ));
        }
    }
    if let Some(megabytes) = peak_memory() {
        budgets.push(("peak memory of all the above, MB".into(), megabytes, 200.0));
    }
    println!("\nratio: to float full. ms: median. Budgets:");
    for (label, value, budget) in budgets {
        let verdict = if value <= budget { "met" } else { "MISSED" };
        println!("  {label:<52} {value:>8.3}  at most {budget:>6.2}  {verdict}");
    }
}

/// µs per accepted step.
fn per_step(m: &Measured) -> f64 {
    1e6 * m.median / m.outcome.steps.max(1) as f64
}

/// Runs all rows in turn, for about two seconds a problem and at least five times (three where
/// one round takes longer than that).
fn measure(problem: &Problem, rows: &[Row]) -> Vec<Measured> {
    let run = |row: &Row| solve(problem, &row.options, &mut Control::default()).expect("a run");
    let clock = Instant::now();
    let outcomes: Vec<Outcome> = rows.iter().map(run).collect();
    let round = clock.elapsed().as_secs_f64();
    let rounds = ((2.0 / round) as usize).clamp(if round > 1.0 { 3 } else { 5 }, 201);
    let mut seconds = vec![Vec::with_capacity(rounds); rows.len()];
    for _ in 0..rounds {
        for (row, seconds) in rows.iter().zip(&mut seconds) {
            seconds.push(run(row).seconds);
        }
    }
    let median = |mut s: Vec<f64>| {
        s.sort_by(f64::total_cmp);
        s[s.len() / 2]
    };
    outcomes
        .into_iter()
        .zip(seconds)
        .map(|(outcome, seconds)| Measured {
            outcome,
            median: median(seconds),
        })
        .collect()
}

/// The process's largest memory so far, in MB, where the system tells.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024.0)
}
