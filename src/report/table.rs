//! Results for people.

use super::certain_digits;
use crate::problem::Problem;
use crate::track::{Mode, Outcome, PathEnd, Solution, Space, Status};
use std::fmt::{self, Write};

/// The results as a text of several lines: what was found and what that means, the solutions,
/// the numbers of the run.
pub fn to_table(problem: &Problem, outcome: &Outcome) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write_table(&mut out, problem, outcome);
    out
}

fn write_table(out: &mut String, problem: &Problem, outcome: &Outcome) -> fmt::Result {
    writeln!(out, "{}: {}", problem.name, verdict(outcome))?;
    for (index, solution) in outcome.solutions.iter().enumerate() {
        write_solution(out, problem, outcome, index, solution)?;
    }
    if outcome.mode == Mode::Certified && !outcome.solutions.is_empty() {
        writeln!(
            out,
            "\nEvery coordinate differs from the exact one by at most 1 in its last digit shown."
        )?;
    }
    writeln!(out)?;
    for (label, value) in numbers(outcome) {
        writeln!(out, "{label:<20}{value}")?;
    }
    Ok(())
}

/// What was found, in words that claim no more than was proved.
fn verdict(outcome: &Outcome) -> String {
    let count = outcome.solutions.len();
    let mut classes: Vec<usize> = outcome.solutions.iter().map(|s| s.class).collect();
    classes.sort_unstable();
    classes.dedup();
    let different = match (count, classes.len()) {
        (0 | 1, _) => String::new(),
        (n, c) if n == c => " No two of them are congruent, even up to reflection.".to_owned(),
        (_, c) => format!(" Up to congruence and reflection they are {c}."),
    };
    match (outcome.mode, &outcome.status) {
        (Mode::Certified, Status::Closed) => {
            let text = match count {
                0 => "the path through the sketch has no point with t = 1".to_owned(),
                1 => "the solution listed is exactly the one point of the path through the sketch \
                      with t = 1"
                    .to_owned(),
                n => format!(
                    "the {n} solutions listed are exactly the points of the path through the \
                     sketch with t = 1"
                ),
            };
            format!("Closed, proved: {text}.{different}")
        }
        (_, Status::Open(ends)) => {
            let place = |end: &PathEnd| {
                let t = 0.5 * (end.t.0 + end.t.1);
                format!("at t = {t:.6}, {}", without_stop(&end.reason))
            };
            let text = match count {
                0 => "between them it has no point with t = 1".to_owned(),
                1 => "the solution listed is exactly its one point between them with t = 1"
                    .to_owned(),
                n => format!(
                    "the {n} solutions listed are exactly its points between them with t = 1"
                ),
            };
            format!(
                "Open, proved: the path through the sketch has two ends, and {text}.{different}\n  One end: \
                 {}.\n  The other: {}.",
                place(&ends[0]),
                place(&ends[1])
            )
        }
        (Mode::Certified, Status::Stopped(reason)) => {
            let text = match count {
                0 => "No solution was proved".to_owned(),
                1 => "The solution listed is proved to lie on the path through the sketch".into(),
                n => format!(
                    "The {n} solutions listed are proved to lie on the path through the sketch"
                ),
            };
            format!(
                "Stopped: {}. {text}; there may be more.",
                without_stop(reason)
            )
        }
        (Mode::Float, Status::Closed) => format!(
            "Closed, observed: the path came back to the sketch and met {} (floating-point \
             tracking, not a proof).{different}",
            solutions(count)
        ),
        (Mode::Float, Status::Stopped(reason)) => format!(
            "Stopped: {}. Up to there the path met {} (floating-point tracking, not a proof); \
             there may be more.{different}",
            without_stop(reason),
            solutions(count)
        ),
    }
}

fn solutions(count: usize) -> String {
    match count {
        0 => "no solution".to_owned(),
        1 => "1 solution".to_owned(),
        n => format!("{n} solutions"),
    }
}

fn without_stop(reason: &str) -> &str {
    reason.trim_end().trim_end_matches('.')
}

fn write_solution(
    out: &mut String,
    problem: &Problem,
    outcome: &Outcome,
    index: usize,
    solution: &Solution,
) -> fmt::Result {
    write!(out, "\nSolution {}, class {}", index + 1, solution.class)?;
    match outcome.mode {
        Mode::Certified => writeln!(out, ", relative width {:.1e}", solution.width)?,
        Mode::Float => writeln!(out)?,
    }
    let rows: Vec<Vec<String>> = solution
        .points
        .iter()
        .map(|point| {
            let coordinates = point.iter().take(problem.dimension);
            coordinates
                .map(|x| match outcome.mode {
                    Mode::Certified => certain_digits(*x),
                    Mode::Float => float_digits(x.mid()),
                })
                .collect()
        })
        .collect();
    // Columns are aligned at the point.
    let before = |text: &str| text.find('.').unwrap_or(text.len());
    let width_of = |axis: usize, part: &dyn Fn(&str) -> usize| {
        rows.iter().map(|row| part(&row[axis])).max().unwrap_or(0)
    };
    let columns: Vec<(usize, usize)> = (0..problem.dimension)
        .map(|axis| {
            (
                width_of(axis, &before),
                width_of(axis, &|text| text.len() - before(text)),
            )
        })
        .collect();
    let names = problem
        .points
        .iter()
        .map(|p| p.name.chars().count())
        .max()
        .unwrap_or(0);
    for (point, row) in problem.points.iter().zip(&rows) {
        let mut line = format!("  {:<names$}", point.name);
        for (text, &(left, right)) in row.iter().zip(&columns) {
            let at = before(text);
            write!(line, "  {:>left$}{:<right$}", &text[..at], &text[at..])?;
        }
        writeln!(out, "{}", line.trim_end())?;
    }
    Ok(())
}

/// Twelve digits, which float mode usually has.
fn float_digits(x: f64) -> String {
    if x == 0.0 {
        "0".to_owned()
    } else if (1e-4..1e7).contains(&x.abs()) {
        let whole = x.abs().log10().floor().max(0.0) as usize;
        format!("{x:.*}", 11 - whole.min(11))
    } else {
        format!("{x:.11e}")
    }
}

fn numbers(outcome: &Outcome) -> Vec<(&'static str, String)> {
    let (lo, hi) = outcome.t_range;
    let (mode, space) = (outcome.mode.name(), outcome.space.name());
    let mut rows = vec![
        ("mode, space", format!("{mode}, {space}")),
        ("steps", outcome.steps.to_string()),
        ("rejected steps", outcome.rejected.to_string()),
        ("changes of plan", outcome.plan_changes.to_string()),
    ];
    if outcome.space == Space::Reduced {
        let driving = outcome.driving;
        let text = format!("{:.2} on average, {} at most", driving.average, driving.max);
        rows.push(("driving parameters", text));
    }
    rows.push(("length of the path", format!("{:.4}", outcome.length)));
    rows.push(("range of t", format!("{lo:.6} to {hi:.6}")));
    rows.push(("seconds", format!("{:.4}", outcome.seconds)));
    for (index, text) in outcome.switched_on.iter().enumerate() {
        rows.push((if index == 0 { "switched on" } else { "" }, text.clone()));
    }
    rows
}
