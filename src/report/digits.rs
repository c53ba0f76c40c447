//! Solutions to many digits.

use crate::digits::Digits;
use crate::problem::Problem;
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
