//! What equations suppose to be greater than 0, so that figures in which it is 0 are none.

use crate::constraint::{equations_with_roots, supposed_lengths};
use crate::interval::Interval;
use crate::places::Each as _;
use crate::problem::{Orientation, Problem, list};
use crate::system::orientation;
use crate::track::{Signs, Stand};

/// Most names in one list.
const LISTED: usize = 8;

/// That nothing is said of the signs that a problem asks for, in a sentence with a space before it; empty where it asks for none.
pub fn signs_not_looked_at(problem: &Problem) -> &'static str {
    match problem.orientations.is_empty() {
        true => "",
        false => {
            " The signs asked for (`orientation`) are not looked at here: figures may have others."
        }
    }
}

/// How a figure stands to the signs that a problem asks for, as a line of text; empty where it asks for none.
pub fn signs_of_figure(problem: &Problem, points: &[[Interval; 3]]) -> String {
    match signs_in_words(problem, points) {
        Some(words) => format!("signs               {words}\n"),
        None => String::new(),
    }
}

/// The same in words; `None` where it asks for none.
pub(super) fn signs_in_words(problem: &Problem, points: &[[Interval; 3]]) -> Option<String> {
    if problem.orientations.is_empty() {
        return None;
    }
    let signs = Signs::of(problem);
    let words = match signs.of_figure(points) {
        Stand::Right => "as asked for (`orientation`), proved".to_owned(),
        Stand::Mirrored => {
            "all the other way round: its mirror image has those asked for (`orientation`), proved"
                .to_owned()
        }
        _ => {
            let named = |sign: i8| {
                let is_so = |one: &Orientation| {
                    orientation(points, &one.points) * if one.is_positive { 1 } else { -1 } == sign
                };
                let of = (0..signs.all.len()).filter(|&k| is_so(&signs.all[k]));
                let of = of.map(|k| format!("`{}`", problem.orientation_name(k)));
                of.collect::<Vec<String>>()
            };
            match [named(-1), named(0)] {
                [wrong, _] if !wrong.is_empty() => {
                    format!("the figure has not {}, proved", list(&wrong, LISTED))
                }
                [_, untold] => format!(
                    "whether the figure has {} cannot be told",
                    list(&untold, LISTED)
                ),
            }
        }
    };
    Some(words)
}

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
