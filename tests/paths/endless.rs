//! Paths along which t, or a point, goes to infinity end, in a time that does not depend on how far one looks; and what is said of
//! a path that is closed its certificate says again.
//!
//! Quadratic systems are drawn as figures: the number u is the point (u, 0), on the y axis by reflection in the line y = x, and
//! the product of u and v is where the line from (−1, 0) to (0, v) is at x = u − 1.

use crate::common::certificate;
use crate::common::edits::Random;
use crate::common::wanted;
use krawl::certificate::{Outcome as Verdict, Settings, verify};
use krawl::problem::Problem;
use krawl::track::{EndKind, Options, Outcome, Status};
use std::fmt::Write;
use std::time::{Duration, Instant};

/// A case that was sent in.
fn case(name: &str) -> Problem {
    Problem::read(format!("tests/data/endless/{name}.toml")).unwrap()
}

/// The figure of a random quadratic system, drawn near to one of its zeros or anywhere.
fn quadratic(random: &mut Random) -> String {
    let mut points: Vec<(String, [f64; 2])> = vec![
        ("O".to_owned(), [0.0, 0.0]),
        ("A".to_owned(), [-1.0, 0.0]),
        ("D".to_owned(), [1.0, 1.0]),
    ];
    let mut given: Vec<(&str, String)> = ["O", "A", "D"]
        .map(|p| ("fixed", format!("\"{p}\"")))
        .to_vec();
    let round = |x: f64| (1000.0 * x).round() / 1000.0;
    let n = 1 + random.below(2);
    let values: Vec<f64> = (0..n).map(|_| round(random.between(-1.5, 1.5))).collect();
    for (i, &u) in values.iter().enumerate() {
        points.push((format!("x{i}"), [u, 0.0]));
        points.push((format!("y{i}"), [0.0, u]));
        given.push(("y", format!("\"x{i}\", 0")));
        given.push(("symmetric", format!("\"x{i}\", \"y{i}\", \"O\", \"D\"")));
    }
    for equation in 0..n {
        // Points of the y axis whose heights are added up: numbers and products.
        let mut terms: Vec<(String, f64)> = Vec::new();
        for k in 0..2 + random.below(2) {
            let (i, j) = (random.below(n), random.below(n));
            if random.below(3) == 0 {
                terms.push((format!("y{i}"), values[i]));
                continue;
            }
            let (c, w) = (format!("c{equation}{k}"), format!("w{equation}{k}"));
            let product = values[i] * values[j];
            points.push((c.clone(), [values[i] - 1.0, product]));
            points.push((w.clone(), [0.0, product]));
            given.push(("dx", format!("\"{c}\", \"x{i}\", 1")));
            given.push(("on", format!("\"{c}\", \"A\", \"y{j}\"")));
            given.push(("x", format!("\"{w}\", 0")));
            given.push(("horizontal", format!("\"{c}\", \"{w}\"")));
            terms.push((w, product));
        }
        terms.dedup_by(|a, b| a.0 == b.0);
        if terms.len() < 2 {
            let (c, w) = (format!("c{equation}s"), format!("w{equation}s"));
            let square = values[equation] * values[equation];
            points.push((c.clone(), [values[equation] - 1.0, square]));
            points.push((w.clone(), [0.0, square]));
            given.push(("dx", format!("\"{c}\", \"x{equation}\", 1")));
            given.push(("on", format!("\"{c}\", \"A\", \"y{equation}\"")));
            given.push(("x", format!("\"{w}\", 0")));
            given.push(("horizontal", format!("\"{c}\", \"{w}\"")));
            terms.push((w, square));
        }
        let (mut sum, mut height) = terms[0].clone();
        for (k, (term, value)) in terms[1..].iter().enumerate() {
            let middle = format!("m{equation}{k}");
            height = 0.5 * (height + value);
            points.push((middle.clone(), [0.0, height]));
            given.push(("midpoint", format!("\"{middle}\", \"{sum}\", \"{term}\"")));
            sum = middle;
        }
        let wanted = round(random.between(-1.0, 1.0));
        given.push(("y", format!("\"{sum}\", {wanted}")));
    }
    let mut text = "dimension = 2\n[points]\n".to_owned();
    for (name, [x, y]) in points {
        writeln!(text, "{name} = [{x:.9}, {y:.9}]").unwrap();
    }
    text += "[constraints]\n";
    let mut kinds: Vec<&str> = given.iter().map(|g| g.0).collect();
    kinds.sort_unstable();
    kinds.dedup();
    for kind in kinds {
        let entries = given.iter().filter(|g| g.0 == kind);
        let entries: Vec<String> = entries.map(|g| format!("[{}]", g.1)).collect();
        writeln!(text, "{kind} = [{}]", entries.join(", ")).unwrap();
    }
    text
}

/// Runs a problem, sees to it that it ends in time, and that its certificate says what the run does.
fn ends(problem: &Problem, what: &str, time: Duration) -> Outcome {
    let clock = Instant::now();
    let (outcome, bytes) = certificate::of(problem, &Options::certified());
    let took = clock.elapsed();
    assert!(took < time, "{what}: {took:?}, {} tubes", outcome.steps);
    let verdict = verify(&bytes[..], &Settings::default(), &mut |_| {}).unwrap();
    match outcome.status {
        // Far away the checker's bounds may be too coarse for what was proved of an open path.
        Status::Open(_) if matches!(verdict.outcome, Verdict::NotProved(_)) => {}
        Status::Closed | Status::Open(_) => {
            assert_eq!(
                verdict.outcome,
                Verdict::Verified,
                "{what}: {:?}",
                outcome.status
            );
            assert_eq!(verdict.solutions.len(), outcome.solutions.len(), "{what}");
        }
        Status::Stopped(_) => assert!(
            matches!(verdict.outcome, Verdict::Partial(_)),
            "{what}: {:?}",
            verdict.outcome
        ),
    }
    outcome
}

/// Builds for tests take several times as long as those for use.
const TIME: Duration = Duration::from_secs(60);

#[test]
fn paths_to_infinity_end() {
    for (name, solutions) in [("min2", 2), ("hang-0", 2)] {
        let outcome = ends(&case(name), name, TIME);
        let Status::Open(ends) = &outcome.status else {
            panic!("{name}: {:?}", outcome.status);
        };
        assert_eq!(outcome.solutions.len(), solutions, "{name}");
        assert!(
            ends.iter().all(|end| end.kind == EndKind::Infinite),
            "{name}: {ends:?}"
        );
        assert!(ends[0].reason.contains("t has passed"), "{name}: {ends:?}");
    }
    for name in ["apollonius", "three-points"] {
        let outcome = ends(&case(name), name, TIME);
        assert!(outcome.steps < 50_000, "{name}: {} tubes", outcome.steps);
        let Status::Open(ends) = &outcome.status else {
            panic!("{name}: {:?}", outcome.status);
        };
        let infinite = ends.iter().filter(|end| end.kind == EndKind::Infinite);
        assert!(infinite.count() > 0, "{name}: {ends:?}");
    }
}

/// Boxes whose entries are known to 1e-20 beside others that are known to 1e-15.
#[test]
fn what_is_closed_is_verified_where_some_numbers_are_known_far_better_than_others() {
    let outcome = ends(&case("certfail-small"), "certfail-small", TIME);
    assert_eq!(
        (outcome.status, outcome.solutions.len()),
        (Status::Closed, 2)
    );
}

fn campaign(seed: u64, count: usize) {
    let mut random = Random(seed);
    let mut closed = 0;
    for k in 0..count {
        let text = quadratic(&mut random);
        let problem =
            Problem::parse(&text, "quadratic.toml").unwrap_or_else(|e| panic!("{e}\n{text}"));
        // The sketch may be singular, or the system dependent.
        if problem.check().is_err() {
            continue;
        }
        let mut control = krawl::track::Control::default();
        if krawl::track::solve(
            &problem,
            &Options {
                max_steps: 1,
                ..Options::certified()
            },
            &mut control,
        )
        .is_err()
        {
            continue;
        }
        let outcome = ends(&problem, &format!("{k}:\n{text}"), TIME);
        closed += usize::from(outcome.status == Status::Closed);
    }
    println!("{closed} of {count} closed");
}

#[test]
fn quadratic_systems_end_and_what_is_said_of_them_is_verified() {
    campaign(43, 5);
}

/// The same many times: KRAWL_COUNT systems.
#[test]
#[ignore = "minutes"]
fn many_quadratic_systems_end_and_what_is_said_of_them_is_verified() {
    campaign(1, wanted("KRAWL_COUNT", 300));
}
