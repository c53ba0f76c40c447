//! Other programs on the systems that `krawl export` writes.

use crate::others::{form, solve};
use krawl::complex::{export, lower_in_squares};
use krawl::problem::Problem;

/// What a program makes of a shipped problem: a line for the table.
///
/// `within` is the size up to which programs that search boxes look, in the file's units.
pub fn run(name: &str, problem: &str, within: f64) -> String {
    let problem = Problem::read(format!("problems/{problem}.toml")).expect("a shipped problem");
    let lowered = match lower_in_squares(&problem) {
        Ok(lowered) => lowered,
        Err(error) => return format!("skipped: {error}"),
    };
    match export(&lowered.system, form(name), within) {
        Ok(text) => solve(name, text),
        Err(error) => format!("skipped: {error}"),
    }
}
