//! Whether the distances are as many as needed, and where they are needed.

mod rigidity;
mod sketch;
mod triangle;

pub use rigidity::{Rigidity, rigidity, rigidity_row};
pub(super) use sketch::{coincide, collinear};

use super::error::Place;
use super::{DEPENDS, Distance, Point, ProblemError, free_coordinates, list};
use crate::order::each_once;
use crate::statement::{counted, either};

/// Most names in one list of a message.
const LISTED: usize = 12;

/// Checks that the graph of the distances is generically rigid without a distance to spare.
pub(super) fn check_structure(
    dimension: usize,
    points: &[Point],
    distances: &[Distance],
) -> Result<(), ProblemError> {
    let edges: Vec<[usize; 2]> = distances.iter().map(|d| d.points).collect();
    let needed = free_coordinates(dimension, points.len());
    let found = rigidity(dimension, points.len(), &edges);
    if edges.len() == needed && found.rank == needed {
        return Ok(());
    }
    let parts: Vec<String> = [
        over_constrained(&found, points, &edges),
        under_constrained(&found, dimension, needed, points),
    ]
    .into_iter()
    .flatten()
    .collect();
    let parts = parts.join("; ");
    Err(match found.circuit.last() {
        Some(&index) if edges.len() == needed => {
            let text = "the distances are as many as needed, but not where they are needed";
            ProblemError::structure(Place::Distance(index), format!("{text}: {parts}"))
        }
        _ => {
            let counts = [points.len(), needed, edges.len()];
            let text = count_message(dimension, counts, &parts);
            ProblemError::structure(Place::Distances, text)
        }
    })
}

fn count_message(dimension: usize, [points, needed, given]: [usize; 3], parts: &str) -> String {
    let (space, formula) = match dimension {
        2 => ("the plane", format!("2·{points} − 3")),
        _ => ("space", format!("3·{points} − 6")),
    };
    let verdict = match needed.abs_diff(given) {
        n if given < needed => format!("{n} {} missing", either(n, "is", "are")),
        n => format!("{n} {} too many", either(n, "is", "are")),
    };
    let are = either(given, "is", "are");
    let colon = if parts.is_empty() { "" } else { "; " };
    format!(
        "{points} points in {space} need {formula} = {needed} distances, and there {are} {given}: \
         {verdict}{colon}{parts}"
    )
}

fn over_constrained(found: &Rigidity, points: &[Point], edges: &[[usize; 2]]) -> Option<String> {
    if found.circuit.is_empty() {
        return None;
    }
    let names: Vec<String> = found
        .circuit
        .iter()
        .map(|&e| {
            let [a, b] = edges[e];
            format!("{}-{}", points[a].name, points[b].name)
        })
        .collect();
    let ends = each_once(found.circuit.iter().flat_map(|&e| edges[e]));
    let ends: Vec<&str> = ends.iter().map(|&p| points[p].name.as_str()).collect();
    let in_all = match edges.len() - found.rank {
        1 => String::new(),
        n => format!(" ({n} distances in all are to spare)"),
    };
    Some(format!(
        "over-constrained among the points {}: any of the {} distances {} {DEPENDS}, remove one of them{in_all}",
        list(&ends, LISTED),
        names.len(),
        list(&names, LISTED),
    ))
}

fn under_constrained(
    found: &Rigidity,
    dimension: usize,
    needed: usize,
    points: &[Point],
) -> Option<String> {
    let freedoms = match needed - found.rank {
        0 => return None,
        n => counted(n, "degree") + " of freedom",
    };
    let name = |&p: &usize| points[p].name.as_str();
    let names = |part: &[usize]| part.iter().map(name).collect::<Vec<_>>();
    Some(match found.bodies.as_slice() {
        [] => format!(
            "under-constrained ({freedoms}): no part of more than {dimension} points is rigid, \
             all of the points {} can move against each other",
            list(&names(&(0..points.len()).collect::<Vec<_>>()), LISTED)
        ),
        [largest, others @ ..] => {
            let free: Vec<usize> = (0..points.len()).filter(|p| !largest.contains(p)).collect();
            let mut text = format!(
                "under-constrained ({freedoms}): {} {} can move against the rigid part {}",
                either(free.len(), "the point", "the points"),
                list(&names(&free), LISTED),
                list(&names(largest), LISTED),
            );
            if !others.is_empty() {
                let others: Vec<String> = others
                    .iter()
                    .map(|body| format!("({})", list(&names(body), LISTED)))
                    .collect();
                text += &format!("; further rigid parts: {}", list(&others, 4));
            }
            text
        }
    })
}
