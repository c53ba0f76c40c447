//! All solutions, for people and for programs.

use super::certain_digits;
use super::drawing::{Drawing, names};
use super::json::Points;
use crate::certificate::cover::CoverVerdict;
use crate::complete::{Complete, Status, Why};
use crate::interval::Interval;
use crate::problem::{Problem, counted};
use std::fmt::Write;

/// One JSON object on one line: what is said of every problem (docs/json.md, "The problem"), and
///
/// ```json
/// {"status": "complete" | "partial" | "flexible", "reason": null, "verdict": "Complete, proved: ...",
///  "reference": ["p1", "p2", "p3"],
///  "solutions": [{"points": {"p1": [[0.0, 0.0], [0.0, 0.0], [0.0, 0.0]]}, "class": 0, "width": 1e-14}],
///  "undecided": [{"reason": "...", "parts": 1, "share": 1e-9}],
///  "boxes": 101, "seconds": 0.0, "driving": 1, "plan": ["p1", "p2", "p3", "p5", "p4", "p6"]}
/// ```
///
/// Points are as in the JSON of a run along the path: pairs of bounds in the problem's units, seen from the
/// reference points.
pub fn complete_to_json(problem: &Problem, result: &Complete) -> String {
    serde_json::to_string(&Document::new(problem, result))
        .expect("strings, numbers and lists have a form in JSON")
}

/// What [`complete_to_json`] writes, as a value in memory.
pub fn complete_to_value(problem: &Problem, result: &Complete) -> serde_json::Value {
    serde_json::to_value(Document::new(problem, result))
        .expect("strings, numbers and lists have a form in JSON")
}

impl<'a> Document<'a> {
    fn new(problem: &'a Problem, result: &'a Complete) -> Self {
        Document {
            drawing: Drawing::seen_from("all", problem, &result.reference),
            status: result.status.name(),
            reason: result.reason.as_deref(),
            verdict: verdict(result),
            solutions: result
                .solutions
                .iter()
                .map(|solution| Entry {
                    points: Points(problem, solution.points.clone()),
                    class: solution.class,
                    width: solution.width,
                })
                .collect(),
            undecided: result
                .undecided
                .iter()
                .map(|part| Undecided {
                    reason: why(part.why),
                    parts: part.count,
                    share: part.share,
                })
                .collect(),
            boxes: result.boxes,
            seconds: result.seconds,
            driving: result.driving,
            plan: names(problem, &result.plan),
        }
    }
}

#[derive(serde::Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    drawing: Drawing<'a>,
    status: &'static str,
    reason: Option<&'a str>,
    verdict: String,
    solutions: Vec<Entry<'a>>,
    undecided: Vec<Undecided>,
    boxes: u64,
    seconds: f64,
    driving: usize,
    plan: Vec<&'a str>,
}

#[derive(serde::Serialize)]
struct Entry<'a> {
    points: Points<'a, [Interval; 3]>,
    class: usize,
    width: f64,
}

#[derive(serde::Serialize)]
struct Undecided {
    reason: &'static str,
    parts: u64,
    share: f64,
}

fn why(why: Why) -> &'static str {
    match why {
        Why::Flexible => "a curve of solutions seems to go through here",
        Why::Small => "a solution that is singular or nearly so, or centres of a step in line",
        Why::Unfinished => "the search was ended before",
        Why::Apart => "solutions too close to each other to be told apart",
    }
}

/// The result as a text of several lines: what is proved, the solutions, the numbers of the search.
pub fn complete_to_table(problem: &Problem, result: &Complete) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write_table(&mut out, problem, result);
    out
}

fn write_table(out: &mut String, problem: &Problem, result: &Complete) -> std::fmt::Result {
    writeln!(out, "{}: {}", problem.name, verdict(result))?;
    for part in &result.undecided {
        let parts = counted(part.count as usize, "part");
        let share = 100.0 * part.share;
        writeln!(
            out,
            "  undecided: {parts} ({share:.1e} % of the parameter space): {}",
            why(part.why)
        )?;
    }
    for (index, solution) in result.solutions.iter().enumerate() {
        writeln!(
            out,
            "\nSolution {}, relative width {:.1e}",
            index + 1,
            solution.width
        )?;
        for (point, place) in problem.points.iter().zip(&solution.points) {
            write!(out, "  {}", point.name)?;
            for x in place.iter().take(problem.dimension) {
                write!(out, "  {:>18}", certain_digits(*x))?;
            }
            writeln!(out)?;
        }
    }
    if !result.solutions.is_empty() {
        writeln!(
            out,
            "\nEvery coordinate differs from the exact one by at most 1 in its last digit shown."
        )?;
    }
    writeln!(out, "\ndriving parameters  {}", result.driving)?;
    writeln!(out, "boxes               {}", result.boxes)?;
    writeln!(out, "seconds             {:.4}", result.seconds)
}

/// What was found, in words that claim no more than was proved.
fn verdict(result: &Complete) -> String {
    let count = counted(result.solutions.len(), "solution");
    match result.status {
        Status::Complete if result.solutions.is_empty() => format!(
            "Complete, proved: there is no solution; {}.",
            result.reason.as_deref().unwrap_or("nothing is undecided")
        ),
        Status::Complete => format!(
            "Complete, proved: {count} up to rigid motions and reflections, and there is no other. Each box \
             holds exactly one; no two are congruent, even up to reflection."
        ),
        Status::Partial | Status::Flexible => {
            let what = match result.status {
                Status::Flexible => {
                    "Flexible: a curve of solutions is seen, in floating point, in parts that stay undecided"
                }
                _ => "Partial: some parts of the parameter space stay undecided",
            };
            let why = result
                .reason
                .as_deref()
                .map(|r| format!(" ({r})"))
                .unwrap_or_default();
            format!(
                "{what}{why}. {count} proved, each box holding exactly one, no two congruent; there may be \
                 more, in the undecided parts only."
            )
        }
    }
}

/// What a checked cover proves.
pub fn cover_theorem(verdict: &CoverVerdict, took: std::time::Duration) -> String {
    let name = &verdict.problem.name;
    let count = counted(verdict.solutions, "solution");
    let seconds = took.as_secs_f64();
    let parts = counted(verdict.parts as usize, "part");
    match &verdict.flaw {
        Some(flaw) => format!("REFUTED: {name}: {flaw}. Nothing is proved.\n"),
        None if verdict.undecided == 0 => format!(
            "VERIFIED: {name} has exactly {count} up to rigid motions and reflections. The cover has {parts}, \
             each proved again in {seconds:.2} s.\n"
        ),
        None => format!(
            "INCOMPLETE: {name} has {count} at least, no two congruent; nothing is claimed of {} of the \
             {parts} of the cover. Any other solution lies there. Checked in {seconds:.2} s.\n",
            verdict.undecided
        ),
    }
}
