//! Solutions to many digits.

use crate::digits::Digits;
use crate::problem::Problem;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// What is said of the solutions of a list, of which the first one has the number `first`, each to many digits or why it is not.
pub fn digits_to_table(problem: &Problem, first: usize, all: &[Result<Digits, String>]) -> String {
    let mut out = String::new();
    for (number, one) in (first..).zip(all) {
        let found = match one {
            Ok(found) => found,
            Err(why) => {
                let _ = writeln!(
                    out,
                    "\nSolution {number} is not told to more digits: {why}."
                );
                continue;
            }
        };
        let _ = writeln!(
            out,
            "\nSolution {number}, each number off by at most 1 in its last digit, proved"
        );
        for (point, at) in problem.points.iter().zip(&found.points) {
            let _ = writeln!(out, "  {} = ({})", point.name, at.join(", "));
        }
        for (name, number) in &found.numbers {
            let _ = writeln!(out, "  {name} = {number}");
        }
    }
    out
}

/// The same for JSON: of each solution its points and numbers by name, as texts, or why it is not told.
pub fn digits_to_value(problem: &Problem, all: &[Result<Digits, String>]) -> Value {
    let each = all.iter().map(|one| {
        let found = match one {
            Ok(found) => found,
            Err(why) => return json!({"reason": why}),
        };
        let points = problem.points.iter().zip(&found.points);
        let points: Map<String, Value> = points
            .map(|(point, at)| (point.name.clone(), json!(at)))
            .collect();
        let numbers = found.numbers.iter();
        let numbers: Map<String, Value> = numbers
            .map(|(name, number)| (name.clone(), json!(number)))
            .collect();
        json!({"points": points, "numbers": numbers})
    });
    each.collect()
}
