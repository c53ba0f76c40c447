//! Edits of random figures: what krawl proves in a stream, beside what floats do.
//!
//! ```sh
//! cargo bench --bench edit           # 2000 edits of 5 to 12 points, then larger figures
//! cargo bench --bench edit -- 200    # fewer
//! ```
//!
//! One dimension is multiplied by 0.7 to 1.4 (and once more by 0.9 to 1.1). The truth is found by thousands of
//! small steps (tests/common/edits.rs). Beside krawl's session stand: a path in floats (predictor along the
//! tangent, Newton's method, steps in t that are halved where it does not converge), Newton's method and
//! Levenberg and Marquardt's from the old figure, as most CAD programs do. All dense, all with nalgebra, all without
//! what is set up once.

#[path = "../tests/common/edits.rs"]
mod edits;

use edits::{Case, Random, Truth, case, invariants, lengths, shortest, sketch, system, truth};
use krawl::edit::{Ending, Session, Setting};
use krawl::generate::{Family, Recipe};
use krawl::problem::{Decimal, Problem, Target};
use krawl::track::Control;
use nalgebra::{DMatrix, DVector};
use std::time::Instant;

/// Figures that differ by less than this in every distance are the same.
const SAME: f64 = 1e-6;

#[derive(Default)]
struct Tally {
    name: &'static str,
    same: usize,
    other: usize,
    failed: usize,
    /// Another figure, where no continuation exists.
    beyond: usize,
    /// No figure, where no continuation exists.
    silent: usize,
    limit: usize,
    seconds: Vec<f64>,
}

enum Answer {
    Figure(Vec<f64>),
    Limit,
    Failed,
}

impl Tally {
    fn count(&mut self, dimension: usize, answer: &Answer, truth: &Truth, seconds: f64) {
        self.seconds.push(seconds);
        match (answer, truth) {
            (Answer::Figure(x), Truth::Reached(y)) => {
                let (x, y) = (invariants(dimension, x), invariants(dimension, y));
                let off = x.iter().zip(&y).map(|(a, b)| (a - b).abs());
                if off.fold(0.0, f64::max) < SAME {
                    self.same += 1;
                } else {
                    self.other += 1;
                }
            }
            (_, Truth::Reached(_)) => self.failed += 1,
            (Answer::Figure(_), Truth::Folded(_)) => self.beyond += 1,
            (Answer::Limit, Truth::Folded(_)) => self.limit += 1,
            (Answer::Failed, Truth::Folded(_)) => self.silent += 1,
        }
    }

    fn print(&mut self) {
        let median = median(&mut self.seconds);
        println!(
            "| {} | {} | {} | {} | {} | {} | {} | {:.3} |",
            self.name,
            self.same,
            self.other,
            self.failed,
            self.beyond,
            self.silent,
            self.limit,
            1e3 * median
        );
    }
}

fn median(seconds: &mut [f64]) -> f64 {
    seconds.sort_by(f64::total_cmp);
    seconds.get(seconds.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The best of a few runs, as other work on the machine only ever adds to it.
fn timed<T>(mut run: impl FnMut() -> T) -> (T, f64) {
    let mut best = f64::INFINITY;
    let mut out = None;
    for _ in 0..3 {
        let clock = Instant::now();
        out = Some(run());
        best = best.min(clock.elapsed().as_secs_f64());
    }
    (out.expect("three runs"), best)
}

fn proved(session: &mut Session, settings: &[Setting]) -> Answer {
    let dimension = session.problem().dimension;
    let edited = session.probe(settings, &mut Control::default());
    match edited.ending {
        Ending::Reached => {
            let points = edited.points.iter().map(|p| &p[..dimension]);
            Answer::Figure(points.flatten().map(|x| x.mid()).collect())
        }
        Ending::Limit(_) => Answer::Limit,
        Ending::Passes(_) | Ending::Stopped(_) => Answer::Failed,
    }
}

fn newton(problem: &Problem, to: &[f64]) -> Answer {
    let mut x = sketch(problem);
    for _ in 0..50 {
        let (f, j) = system(problem, &x, to);
        let Some(step) = shortest(&j, &f) else {
            return Answer::Failed;
        };
        x.iter_mut().zip(step.iter()).for_each(|(x, s)| *x -= s);
        let size = step.norm();
        if size < 1e-10 {
            return Answer::Figure(x);
        }
        let is_near = size < 1e6;
        if !is_near {
            break;
        }
    }
    Answer::Failed
}

/// Levenberg and Marquardt's method with the damping of Nielsen (1999).
fn levenberg_marquardt(problem: &Problem, to: &[f64]) -> Answer {
    let mut x = sketch(problem);
    let (mut f, mut j) = system(problem, &x, to);
    let mut a = &j * j.transpose();
    let (mut damping, mut growth) = (1e-3 * a.diagonal().max(), 2.0);
    for _ in 0..200 {
        let m = f.len();
        let damped = &a + DMatrix::identity(m, m) * damping;
        let Some(s) = damped.cholesky().map(|c| c.solve(&f)) else {
            return Answer::Failed;
        };
        let step: DVector<f64> = j.transpose() * s;
        let next: Vec<f64> = x.iter().zip(step.iter()).map(|(x, s)| x - s).collect();
        let (f_next, j_next) = system(problem, &next, to);
        let linear = &f - &j * &step;
        let gain =
            (f.norm_squared() - f_next.norm_squared()) / (f.norm_squared() - linear.norm_squared());
        if gain > 0.0 {
            (x, f, j) = (next, f_next, j_next);
            a = &j * j.transpose();
            damping *= (1.0 - (2.0 * gain - 1.0).powi(3)).max(1.0 / 3.0);
            growth = 2.0;
            if f.amax() < 1e-12 {
                return Answer::Figure(x);
            }
        } else {
            damping *= growth;
            growth *= 2.0;
        }
        let is_moving = step.norm() > 1e-14 && damping < 1e30;
        if !is_moving {
            break;
        }
    }
    Answer::Failed
}

/// The path in floats, with steps in t.
fn float_path(problem: &Problem, from: &[f64], to: &[f64]) -> Answer {
    let mut x = sketch(problem);
    let (mut t, mut step) = (0.0f64, 0.25f64);
    while t < 1.0 {
        if step < 1e-6 {
            return Answer::Limit;
        }
        let next = (t + step).min(1.0);
        let at: Vec<f64> = from
            .iter()
            .zip(to)
            .map(|(a, b)| a + next * (b - a))
            .collect();
        let mut y = x.clone();
        let mut last = f64::INFINITY;
        let mut done = false;
        // The first step of Newton's method is that along the tangent.
        for k in 0..5 {
            let (f, j) = system(problem, &y, &at);
            let Some(s) = shortest(&j, &f) else { break };
            let size = s.norm();
            let allowed = if k == 0 { 0.3 } else { 0.25 * last };
            let is_small = size < allowed;
            if !is_small {
                break;
            }
            y.iter_mut().zip(s.iter()).for_each(|(y, s)| *y -= s);
            last = size;
            if size < 1e-9 {
                done = true;
                break;
            }
        }
        if done {
            (x, t) = (y, next);
            step *= 2.0;
        } else {
            step *= 0.5;
        }
    }
    Answer::Figure(x)
}

fn counts(cases: usize, dimension: usize, factor: (f64, f64), seed: u64) {
    println!(
        "\n{cases} edits of 5 to 12 points in {}, one dimension times {} to {}\n",
        if dimension == 2 { "the plane" } else { "space" },
        factor.0,
        factor.1
    );
    println!(
        "| | same figure | another figure | failed | another where none continues | failed where none continues | limit named | ms |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    let mut random = Random(seed);
    let names = [
        "krawl, proved",
        "path in floats",
        "Newton",
        "Levenberg–Marquardt",
    ];
    let mut tallies = names.map(|name| Tally {
        name,
        ..Tally::default()
    });
    let mut setups = Vec::new();
    for _ in 0..cases {
        let points = 5 + random.below(8);
        let case = case(&mut random, dimension, points, factor);
        let Case {
            problem,
            index,
            length,
        } = &case;
        let from = lengths(problem);
        let mut to = from.clone();
        to[*index] = length.parse().unwrap();
        let truth = truth(problem, &from, &to);
        let length = length.parse().unwrap();
        let settings = [Setting::new(problem, *index, length).unwrap()];
        let clock = Instant::now();
        let mut session = Session::open(problem).unwrap();
        setups.push(clock.elapsed().as_secs_f64());
        let answers = [
            timed(|| proved(&mut session, &settings)),
            timed(|| float_path(problem, &from, &to)),
            timed(|| newton(problem, &to)),
            timed(|| levenberg_marquardt(problem, &to)),
        ];
        for (tally, (answer, seconds)) in tallies.iter_mut().zip(&answers) {
            tally.count(dimension, answer, &truth, *seconds);
        }
    }
    tallies.iter_mut().for_each(Tally::print);
    println!(
        "\nSetting a session up: {:.3} ms (median).",
        1e3 * median(&mut setups)
    );
}

/// Median times of proved edits by size: one dimension times 0.95 to 1.05.
fn sizes(cases: usize) {
    println!(
        "\nOne dimension times 0.95 to 1.05, proved, by size (medians of those that are reached, and of limits)\n"
    );
    println!("| figure | unknowns | reached | ms | tubes | limits | ms | tubes |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    let mut random = Random(7);
    for (dimension, points) in [
        (2, 5),
        (2, 8),
        (2, 12),
        (2, 20),
        (2, 30),
        (3, 5),
        (3, 8),
        (3, 12),
        (3, 20),
    ] {
        let mut row = Row::default();
        for _ in 0..cases {
            let case = case(&mut random, dimension, points, (0.95, 1.05));
            let mut session = Session::open(&case.problem).unwrap();
            let length = case.length.parse().unwrap();
            row.add(
                &mut session,
                &[Setting::new(&case.problem, case.index, length).unwrap()],
            );
        }
        let m = krawl::problem::free_coordinates(dimension, points);
        row.print(&format!("random, {dimension}D, {points} points"), m);
    }
    for (family, name) in [(Family::Strip, "strip"), (Family::Tetrahedra, "tetrahedra")] {
        let mut row = Row::default();
        let mut unknowns = 0;
        for seed in 1..=5 {
            let recipe = Recipe {
                seed,
                ..Recipe::new(family, 200)
            };
            let problem = as_drawn(&recipe.problem().unwrap());
            unknowns = problem.distances.len();
            let Ok(mut session) = Session::open(&problem) else {
                continue;
            };
            for _ in 0..(cases / 10).max(2) {
                let index = random.below(unknowns);
                let length = session.length(index).mid() * random.between(0.95, 1.05);
                let length: Decimal = format!("{length:.4}").parse().unwrap();
                row.add(
                    &mut session,
                    &[Setting::new(&problem, index, length).unwrap()],
                );
            }
        }
        row.print(name, unknowns);
    }
}

/// The problem whose dimensions are those of its sketch, to four digits.
fn as_drawn(problem: &Problem) -> Problem {
    let mut drawn = problem.clone();
    for distance in &mut drawn.distances {
        let [a, b] = distance.points.map(|p| &problem.points[p].sketch);
        let squared: f64 = (0..3)
            .map(|k| (a[k].to_f64() - b[k].to_f64()).powi(2))
            .sum();
        distance.target = Target::Length(format!("{:.4}", squared.sqrt()).parse().unwrap());
    }
    drawn
}

#[derive(Default)]
struct Row {
    seconds: [Vec<f64>; 2],
    tubes: [Vec<f64>; 2],
    others: usize,
}

impl Row {
    fn add(&mut self, session: &mut Session, settings: &[Setting]) {
        let (edited, seconds) = timed(|| session.probe(settings, &mut Control::default()));
        let kind = match edited.ending {
            Ending::Reached => 0,
            Ending::Limit(_) => 1,
            Ending::Passes(_) | Ending::Stopped(_) => {
                self.others += 1;
                return;
            }
        };
        self.seconds[kind].push(seconds);
        self.tubes[kind].push((edited.tubes + edited.rejected) as f64);
    }

    fn print(&mut self, name: &str, unknowns: usize) {
        let [reached, limits] = [0, 1].map(|kind| {
            let count = self.seconds[kind].len();
            if count == 0 {
                return "0 | |".to_owned();
            }
            let (ms, tubes) = (
                1e3 * median(&mut self.seconds[kind]),
                median(&mut self.tubes[kind]),
            );
            format!("{count} | {ms:.3} | {tubes}")
        });
        let others = match self.others {
            0 => String::new(),
            n => format!(" ({n} stopped)"),
        };
        println!("| {name}{others} | {unknowns} | {reached} | {limits} |");
    }
}

fn main() {
    let cases = std::env::args()
        .skip(1)
        .find_map(|a| a.parse().ok())
        .unwrap_or(2000);
    counts(cases, 2, (0.7, 1.4), 11);
    counts(cases, 2, (0.9, 1.1), 12);
    counts(cases / 4, 3, (0.7, 1.4), 13);
    sizes((cases / 20).max(10));
}
