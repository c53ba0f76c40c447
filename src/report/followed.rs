//! What follows from dimensions that are set, by the expressions of the file.

use crate::import::Followed;
use crate::problem::Problem;

/// Warnings, a line of text each.
pub fn warnings_in_words(warnings: &[String]) -> String {
    let lines = warnings.iter();
    lines
        .map(|warning| format!("warning             {warning}\n"))
        .collect()
}

/// The dimensions that follow, and the warnings, a line of text each.
pub fn followed_to_table(problem: &Problem, followed: &Followed) -> String {
    let lines = followed.set.iter().map(|follower| {
        let name = problem.dimension_name(follower.index);
        let (value, expression) = (&follower.value, &follower.expression);
        format!(
            "led with it         {name} to {value}, computed in floats by the file's `{expression}`\n"
        )
    });
    lines.collect::<String>() + &warnings_in_words(&followed.warnings)
}
