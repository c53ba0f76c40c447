//! In how many ways a figure can move.

use super::drawn::CLEAR;
use super::near::What;
use crate::constraint::{fix_frame, pinned_axes};
use crate::interval::vector::{cross, length, minus};
use crate::problem::{Problem, list};

/// In how many ways a figure can move, besides those in which it moves as a whole.
#[derive(Debug, Clone, PartialEq)]
pub struct Freedom {
    /// How many there are; or why that cannot be told.
    pub ways: Result<usize, String>,
    /// How it may move as a whole; nothing where it may not.
    pub whole: String,
}

impl Freedom {
    /// That cannot be told.
    pub(super) fn open(problem: &Problem, why: &str) -> Self {
        Freedom {
            ways: Err(why.to_owned()),
            whole: whole(problem).1,
        }
    }

    /// Of a figure to which so many unknowns are left free.
    pub(super) fn of(problem: &Problem, free: usize, what: What) -> Self {
        let (motions, whole) = whole(problem);
        let ways = match what {
            _ if motions > 0 && !fix_frame(problem) && !turns_in_all_ways(problem) => {
                Err("all points are drawn in one place or on one line".to_owned())
            }
            What::Figure | What::Most { .. } => Ok(free.saturating_sub(motions)),
            What::Drawing { .. } => {
                Err("nothing that meets the constraints was found near the drawing".to_owned())
            }
            What::Large => {
                Err("the drawing is too large for figures near it to be looked for".to_owned())
            }
        };
        Freedom { ways, whole }
    }

    /// What is said of it, in a line.
    pub fn in_words(&self) -> String {
        let whole = match self.whole.as_str() {
            "" => String::new(),
            whole => format!(", besides {whole}"),
        };
        match &self.ways {
            Ok(ways) => format!("{ways}{whole}"),
            Err(why) => format!("not told: {why}"),
        }
    }
}

/// Whether all motions of a figure as a whole move its points: there are as many of them as of a body.
fn turns_in_all_ways(problem: &Problem) -> bool {
    let points = problem.places();
    let Some((&first, rest)) = points.split_first() else {
        return false;
    };
    let ways = rest.iter().map(|&p| minus(p, first));
    let Some(longest) = ways
        .clone()
        .max_by(|a, b| length(*a).total_cmp(&length(*b)))
    else {
        return false;
    };
    match problem.dimension {
        2 => length(longest) > 0.0,
        _ => ways
            .into_iter()
            .any(|way| length(cross(way, longest)) > CLEAR * length(longest) * length(longest)),
    }
}

/// In how many ways a figure may move as a whole, as nothing says where it is, and which.
fn whole(problem: &Problem) -> (usize, String) {
    let d = problem.dimension;
    if !fix_frame(problem) {
        return (d * (d + 1) / 2, "moving and turning as a whole".to_owned());
    }
    let axes = pinned_axes(problem);
    let names: Vec<&str> = axes.iter().map(|&k| ["x", "y", "z"][k]).collect();
    match names.is_empty() {
        true => (0, String::new()),
        false => (
            names.len(),
            format!("moving as a whole along {}", list(&names, 3)),
        ),
    }
}
