//! Solutions to many digits.

use crate::digits::Digits;
use crate::problem::Problem;

/// What is said of the solutions of a list, of which the first one has the number `first`, each to many digits or why it is not.
pub fn digits_to_table(problem: &Problem, first: usize, all: &[Result<Digits, String>]) -> String {
    let mut out = String::new();
    for (number, one) in (first..).zip(all) {
        let found = match one {
            Ok(found) => found,
            Err(why) => {
                out += &format!("\nSolution {number} is not told to more digits: {why}.\n");
                continue;
            }
        };
        out += &format!(
            "\nSolution {number}, each number off by at most 1 in its last digit, proved\n"
        );
        for (point, at) in problem.points.iter().zip(&found.points) {
            out += &format!("  {} = ({})\n", point.name, at.join(", "));
        }
        for (name, number) in &found.numbers {
            out += &format!("  {name} = {number}\n");
        }
    }
    out
}
