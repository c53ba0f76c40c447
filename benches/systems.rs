//! All complex solutions of systems on which path trackers are compared, beside those of other programs.
//!
//! ```sh
//! cargo bench --bench systems             # small ones
//! cargo bench --bench systems -- long     # katsura-12 and others that take minutes
//! ```
//!
//! A row is one run from the equations to the proved set, on all processors: *fill* finds the solutions of a random instance,
//! in floats from equations of the same degrees, each proved; *paths* takes each of them along a proved path to the system. Steps are
//! tubes of these paths, those tried in vain with them. PHCpack (`phc`), and Macaulay2 (`M2`) in floats and certified, take the
//! same equations from nothing, where they are installed; they use one processor.
//!
//! *dense n d*: n equations of degree d with all monomials, coefficients whole numbers drawn at random. The others as in the
//! collections of PoSSo and PHCpack.

mod others;

use krawl::complex::{Export, Filling, Random, Template, Ways, fill, lower, solve};
use krawl::problem::Problem;
use std::time::Instant;

/// More paths are not followed by the certified tracker of Macaulay2.
const MOST_CERTIFIED: usize = 100;

fn main() {
    let is_long = std::env::args().any(|a| a == "long");
    println!(
        "{:<12} {:>6} {:>9} {:>8} {:>8} {:>6} {:>10} {:>12}  status",
        "system", "paths", "solutions", "fill s", "paths s", "real", "steps/path", "us per step"
    );
    let mut systems = vec![
        ("katsura-5".to_owned(), katsura(5)),
        ("katsura-8".to_owned(), katsura(8)),
        ("dense 2 8".to_owned(), dense(2, 8)),
        ("dense 3 4".to_owned(), dense(3, 4)),
        ("dense 6 2".to_owned(), dense(6, 2)),
        ("cyclic-5".to_owned(), cyclic(5)),
        ("noon-4".to_owned(), noon(4)),
    ];
    if is_long {
        systems.extend([
            ("katsura-10".to_owned(), katsura(10)),
            ("katsura-12".to_owned(), katsura(12)),
            ("dense 8 2".to_owned(), dense(8, 2)),
            ("cyclic-6".to_owned(), cyclic(6)),
            ("noon-5".to_owned(), noon(5)),
        ]);
    }
    let rows = systems.iter();
    let paths: Vec<usize> = rows.map(|(name, all)| row(name, all)).collect();
    for program in ["phc", "M2", "M2 certified"] {
        println!();
        for ((name, polynomials), paths) in systems.iter().zip(&paths) {
            // A certified path takes thousands of steps there.
            if program == "M2 certified" && *paths > MOST_CERTIFIED {
                continue;
            }
            let text = match others::form(program) {
                Export::PhcPack => format!("{}\n{};\n", polynomials.len(), polynomials.join(";\n")),
                _ => format!(
                    "R = QQ[{}]\nI = ideal({})\n",
                    unknowns(polynomials.len()).join(","),
                    polynomials.join(",\n")
                ),
            };
            println!("{name:<12} {program}: {}", others::solve(program, text));
        }
    }
}

/// A system from nothing to its proved set. Tells the product of the degrees.
fn row(name: &str, polynomials: &[String]) -> usize {
    let mut build = Problem::build(name, 2);
    for unknown in unknowns(polynomials.len()) {
        build = build.unknown(&unknown, "0.1");
    }
    for polynomial in polynomials {
        build = build.equation(polynomial);
    }
    let problem = build.finish().expect("a system");
    let lowered = lower(&problem).expect("a complex system");
    let filling = Filling {
        enough: lowered.enough(),
        ..Filling::default()
    };
    let begin = Instant::now();
    let fibre = fill(&lowered.system, &filling).expect("a random figure");
    let filled = begin.elapsed().as_secs_f64();
    let paths = fibre.led.map_or(0, |led| led.paths);
    let found = solve(&lowered, &Template::new(name, fibre), &Ways::default());
    let steps = (found.effort.tubes + found.effort.rejected) as f64;
    println!(
        "{name:<12} {paths:>6} {:>9} {filled:>8.2} {:>8.2} {:>6} {:>10.1} {:>12.1}  {:?}",
        found.boxes.len(),
        found.seconds,
        found.real().count(),
        steps / found.effort.paths.max(1) as f64,
        1e6 * found.seconds / steps.max(1.0),
        found.status,
    );
    paths
}

/// Names of n unknowns.
fn unknowns(n: usize) -> Vec<String> {
    (0..n).map(|k| format!("x{k}")).collect()
}

/// Katsura's equations of a magnet: n + 1 unknowns, 2ⁿ solutions.
fn katsura(n: usize) -> Vec<String> {
    let size = n as isize;
    let mut all: Vec<String> = (0..size)
        .map(|m| {
            let products = (-size..=size).filter(|l| (m - l).abs() <= size);
            let terms = products.map(|l| format!("x{}*x{}", l.abs(), (m - l).abs()));
            let sum: Vec<String> = terms.collect();
            format!("{} - x{m}", sum.join(" + "))
        })
        .collect();
    let sum: Vec<String> = (1..=n).map(|k| format!("2*x{k}")).collect();
    all.push(format!("x0 + {} - 1", sum.join(" + ")));
    all
}

/// n equations of degree d with random coefficients.
fn dense(n: usize, d: usize) -> Vec<String> {
    let mut random = Random::new((100 * n + d) as u64);
    // The exponents of all monomials of at most this degree.
    let mut monomials: Vec<Vec<usize>> = vec![vec![]];
    for _ in 0..n {
        let longer = monomials.iter().flat_map(|one| {
            let left = d - one.iter().sum::<usize>();
            (0..=left).map(move |power| [&one[..], &[power]].concat())
        });
        monomials = longer.collect();
    }
    let mut polynomial = || {
        let terms = monomials.iter().map(|powers| {
            let coefficient = 1 + random.bits() % 9;
            let sign = ["-", "+"][(random.bits() % 2) as usize];
            let factors = powers.iter().enumerate().filter(|(_, power)| **power > 0);
            let factors: String = factors.map(|(k, power)| format!("*x{k}^{power}")).collect();
            format!("{sign} {coefficient}{factors} ")
        });
        terms.collect::<String>()
    };
    (0..n).map(|_| polynomial()).collect()
}

/// The cyclic n-roots: sums of products of neighbours.
fn cyclic(n: usize) -> Vec<String> {
    let product = |from: usize, count: usize| {
        let factors: Vec<String> = (0..count).map(|k| format!("x{}", (from + k) % n)).collect();
        factors.join("*")
    };
    let sum = |count: usize| {
        let terms: Vec<String> = (0..n).map(|from| product(from, count)).collect();
        terms.join(" + ")
    };
    let last = format!("{} - 1", product(0, n));
    (1..n).map(sum).chain([last]).collect()
}

/// Noonburg's neural network.
fn noon(n: usize) -> Vec<String> {
    let equation = |k: usize| {
        let others = (0..n).filter(|other| *other != k);
        let terms: Vec<String> = others.map(|other| format!("10*x{k}*x{other}^2")).collect();
        format!("{} - 11*x{k} + 10", terms.join(" + "))
    };
    (0..n).map(equation).collect()
}
