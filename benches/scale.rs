//! How the time of a step grows with the number m of free coordinates, the key unknowns being few:
//! `cargo bench --bench scale`.
//!
//! A family of generated structures at m = 30, 100, 300, 1000 and 3000, in every mode and space.
//! A cell follows the path for as many steps as its budget of time allows, to the end if it can;
//! the time of a step is that of the run less that of its first step, so that setting up is not
//! counted. Cells that would need more than the budget for a few steps, judged from the size
//! before, are left out and said to be. The exponents are least squares of log time over log m.
//!
//! Arguments: a family (`tetrahedra` if none is named), `loops=K`, `seed=X`, `budget=SECONDS`.

use krawl::generate::{Family, Recipe};
use krawl::plan::Plan;
use krawl::problem::Problem;
use krawl::system::Homotopy;
use krawl::track::{Control, Options, Outcome, Space, StartError, Status, solve};
use std::time::Instant;

const SIZES: [usize; 5] = [30, 100, 300, 1000, 3000];

/// Exponents are taken over sizes from here on: below, time is not spent on what grows.
const FROM: usize = 100;

struct Mode {
    name: &'static str,
    options: Options,
    /// The power of m with which its time is expected to grow at worst.
    worst: f64,
    /// The exponent to stay below.
    budget: Option<f64>,
}

/// What was measured of a mode at a size.
struct Cell {
    m: usize,
    /// The last run.
    outcome: Outcome,
    /// Seconds of a step.
    per_step: f64,
    /// Seconds of the first step, with all that comes before.
    first: f64,
    megabytes: Option<f64>,
}

enum Measured {
    Cell(Box<Cell>),
    /// Not run: it would take about so many seconds.
    TooLong(f64),
    /// Why there is no such mode, or none at this size.
    Refused(String),
}

fn main() {
    // `cargo bench` passes --bench.
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    let value = |key: &str| {
        let found = arguments.iter().find_map(|a| a.strip_prefix(key));
        found.map(|text| text.parse::<f64>().expect("a number"))
    };
    let (loops, seed) = (
        value("loops=").unwrap_or(1.0),
        value("seed=").unwrap_or(1.0),
    );
    let budget = value("budget=").unwrap_or(10.0);
    let families: Vec<Family> = Family::ALL
        .into_iter()
        .filter(|family| arguments.iter().any(|a| a == family.name()))
        .collect();
    let families = if families.is_empty() {
        vec![Family::Tetrahedra]
    } else {
        families
    };
    for family in families {
        table(family, loops as usize, seed as u64, budget);
    }
}

fn modes() -> [Mode; 4] {
    [
        Mode {
            name: "float reduced",
            options: Options::float(Space::Reduced),
            worst: 1.0,
            budget: Some(1.3),
        },
        Mode {
            name: "float full",
            options: Options::float(Space::Full),
            worst: 3.0,
            budget: None,
        },
        Mode {
            name: "certified full",
            options: Options::certified(),
            worst: 3.0,
            budget: None,
        },
        Mode {
            name: "certified reduced",
            options: Options {
                space: Space::Reduced,
                ..Options::certified()
            },
            worst: 3.0,
            budget: Some(2.5),
        },
    ]
}

fn table(family: Family, loops: usize, seed: u64, budget: f64) {
    println!(
        "\n{}, {loops} key unknown{}, seed {seed}, at most {budget} s a cell",
        family.name(),
        if loops == 1 { "" } else { "s" }
    );
    let problems: Vec<Problem> = SIZES
        .iter()
        .map(|&size| Recipe {
            family,
            size: size.max(family.smallest(loops)),
            loops,
            seed,
        })
        .map(|recipe| recipe.problem().expect("a size of the family"))
        .collect();
    println!(
        "{:>6} {:>9} {:>9} {:>9} {:>9}  before tracking, ms",
        "m", "read", "homotopy", "plan", "Jacobian"
    );
    let mut read = Vec::new();
    for problem in &problems {
        let times = prepare(problem);
        read.push((problem.free_coordinates(), times.iter().sum::<f64>()));
        print!("{:>6}", problem.free_coordinates());
        times.iter().for_each(|t| print!(" {:>9.2}", 1e3 * t));
        println!();
    }
    println!("exponent of the sum {}", show(exponent(&read)));

    println!(
        "\n{:<18} {:>5} {:>6} {:>8} {:>9} {:>11} {:>10} {:>7}  outcome",
        "mode", "m", "steps", "rejected", "length", "ms/step", "first, ms", "MB"
    );
    let mut verdicts = Vec::new();
    let mut proved: Option<(usize, f64)> = None;
    for mode in modes() {
        let mut cells: Vec<Cell> = Vec::new();
        for problem in &problems {
            let measured = measure(&mode, problem, cells.last(), budget);
            report(&mode, problem.free_coordinates(), &measured);
            if let Measured::Cell(cell) = measured {
                let outcome = &cell.outcome;
                let closed = outcome.status == Status::Closed && cell.m >= 300;
                let sooner =
                    proved.is_none_or(|(m, s)| m > cell.m || m == cell.m && s > outcome.seconds);
                if closed && sooner && mode.name.starts_with("certified") {
                    proved = Some((cell.m, outcome.seconds));
                }
                cells.push(*cell);
            }
        }
        let points: Vec<(usize, f64)> = cells
            .iter()
            .filter(|cell| cell.m >= FROM)
            .map(|cell| (cell.m, cell.per_step))
            .collect();
        if let Some(exponent) = exponent(&points) {
            verdicts.push((mode.name, exponent, mode.budget));
        }
    }
    println!("\nTime of a step grows with the power of m (from m = {FROM}):");
    for (name, exponent, budget) in verdicts {
        match budget {
            Some(budget) => println!(
                "  {name:<18} {exponent:>5.2}  at most {budget:.1}  {}",
                met(exponent <= budget)
            ),
            None => println!("  {name:<18} {exponent:>5.2}"),
        }
    }
    match proved {
        Some((m, seconds)) => println!(
            "A path proved closed at m = {m}: {seconds:.2} s  at most 60  {}",
            met(seconds <= 60.0)
        ),
        None => println!("No path was proved closed at m ≥ 300 within the budget"),
    }
}

fn met(met: bool) -> &'static str {
    if met { "met" } else { "MISSED" }
}

/// Seconds for reading and checking the file, the homotopy, the plan, and the Jacobian's pattern
/// under it.
fn prepare(problem: &Problem) -> [f64; 4] {
    let text = problem.to_toml();
    let mut clock = Instant::now();
    let mut lap = || {
        std::mem::replace(&mut clock, Instant::now())
            .elapsed()
            .as_secs_f64()
    };
    let problem = Problem::parse(&text, "generated").expect("a problem");
    let read = lap();
    let homotopy = Homotopy::new(&problem).expect("a homotopy");
    let set_up = lap();
    let plan = Plan::derive(&homotopy);
    let derived = lap();
    let jacobian = plan.jacobian(&homotopy, &homotopy.sketch);
    std::hint::black_box(jacobian.ordering());
    [read, set_up, derived, lap()]
}

fn run(mode: &Mode, problem: &Problem, steps: usize) -> Result<Outcome, StartError> {
    let options = Options {
        max_steps: steps,
        ..mode.options.clone()
    };
    solve(problem, &options, &mut Control::default())
}

/// Twice as many steps each time, as long as there is time for it; then medians.
fn measure(mode: &Mode, problem: &Problem, smaller: Option<&Cell>, budget: f64) -> Measured {
    let m = problem.free_coordinates();
    if let Some(smaller) = smaller {
        let grown = (m as f64 / smaller.m as f64).powf(mode.worst);
        let expected = grown * (smaller.first + 3.0 * smaller.per_step);
        if expected > budget {
            return Measured::TooLong(expected);
        }
    }
    reset_peak_memory();
    let mut first = match run(mode, problem, 1) {
        Ok(outcome) => vec![outcome.seconds],
        Err(error) => return Measured::Refused(error.to_string()),
    };
    let mut spent = first[0];
    let mut steps = 3;
    let mut last;
    loop {
        last = run(mode, problem, steps).expect("it ran before");
        spent += last.seconds;
        let finished = last.steps < steps;
        if finished || spent + 3.0 * last.seconds > budget {
            break;
        }
        steps *= 2;
    }
    let megabytes = peak_memory();
    // The short ones again, all the time of a twentieth of the budget.
    let mut whole = vec![last.seconds];
    while whole.len() < 21 && whole.iter().sum::<f64>() < 0.05 * budget {
        whole.push(run(mode, problem, steps).expect("it ran before").seconds);
        first.push(run(mode, problem, 1).expect("it ran before").seconds);
    }
    let (first, whole) = (median(first), median(whole));
    last.seconds = whole;
    Measured::Cell(Box::new(Cell {
        m,
        per_step: (whole - first) / (last.steps.max(2) - 1) as f64,
        first,
        megabytes,
        outcome: last,
    }))
}

fn report(mode: &Mode, m: usize, measured: &Measured) {
    print!("{:<18} {m:>5} ", mode.name);
    let cell = match measured {
        Measured::TooLong(seconds) => {
            return println!("not run: about {seconds:.0} s for the first few steps");
        }
        Measured::Refused(reason) => return println!("not run: {reason}"),
        Measured::Cell(cell) => cell,
    };
    let o = &cell.outcome;
    let outcome = match &o.status {
        Status::Closed => format!(
            "closed in {:.3} s, {} solutions",
            o.seconds,
            o.solutions.len()
        ),
        Status::Open(_) => "open".to_owned(),
        Status::Stopped(reason) if reason.contains("limit") => "so far".to_owned(),
        Status::Stopped(reason) => reason.text.clone(),
    };
    println!(
        "{:>6} {:>8} {:>9.1} {:>11.4} {:>10.2} {:>7}  {outcome}",
        o.steps,
        o.rejected,
        o.length,
        1e3 * cell.per_step,
        1e3 * cell.first,
        cell.megabytes
            .map_or("?".to_owned(), |mb| format!("{mb:.0}")),
    );
}

/// The slope of the line through (log m, log time) by least squares.
fn exponent(points: &[(usize, f64)]) -> Option<f64> {
    if points.len() < 2 {
        return None;
    }
    let logs: Vec<(f64, f64)> = points
        .iter()
        .map(|&(m, time)| ((m as f64).ln(), time.ln()))
        .collect();
    let n = logs.len() as f64;
    let mean = |pick: fn(&(f64, f64)) -> f64| logs.iter().map(pick).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = logs.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let variance: f64 = logs.iter().map(|p| (p.0 - x).powi(2)).sum();
    Some(covariance / variance)
}

fn show(exponent: Option<f64>) -> String {
    exponent.map_or("unknown".to_owned(), |e| format!("{e:.2}"))
}

fn median(mut seconds: Vec<f64>) -> f64 {
    seconds.sort_by(f64::total_cmp);
    seconds[seconds.len() / 2]
}

/// Begins anew to look for the largest memory, where the system can.
fn reset_peak_memory() {
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

/// The largest memory since, in MB, where the system tells.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024.0)
}
