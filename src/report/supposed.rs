//! What equations suppose to be greater than 0, so that figures in which it is 0 are none.

use crate::constraint::{equations_with_roots, supposed_lengths};
use crate::places::Each as _;
use crate::problem::{Problem, list};

/// Most names in one list.
const LISTED: usize = 8;

/// Which figures are none though the words of the constraints may hold in them, in a sentence with a space before it; empty where there are
/// none such.
pub(super) fn supposed(problem: &Problem) -> String {
    let name = |[a, b]: [usize; 2]| {
        let [a, b] = [a, b].each(|p| &problem.points[p].name);
        format!("{a}-{b}")
    };
    let lengths: Vec<String> = supposed_lengths(problem).into_iter().map(name).collect();
    let lengths = match lengths.as_slice() {
        [] => String::new(),
        [one] => format!(
            " The length {one} is supposed to be greater than 0: a figure in which it is 0 is not counted."
        ),
        _ => format!(
            " The lengths {} are supposed to be greater than 0: a figure in which one of them is 0 is not counted.",
            lengths.join(", ")
        ),
    };
    let roots: Vec<String> = equations_with_roots(problem)
        .map(|text| format!("`{text}`"))
        .collect();
    match roots.as_slice() {
        [] => lengths,
        _ => format!(
            "{lengths} What is under a root in {} is supposed to be greater than 0: a solution in which it is 0 is not counted.",
            list(&roots, LISTED)
        ),
    }
}
