//! What is said of a singular drawing.

use super::System;
use super::drawn::Seen;
use crate::order::{InOrder, add_new};
use crate::places::Each as _;
use crate::problem::{Problem, list};
use nalgebra::Vector3;
use std::collections::BTreeSet;

/// Names that are listed before "and n more".
const LISTED: usize = 8;

/// A drawing at which constraints depend on each other, as far as floats tell.
#[derive(Debug, Clone, PartialEq)]
pub struct Singular {
    /// What people call these constraints.
    pub constraints: Vec<String>,
    /// What was seen of them near the drawing.
    pub seen: Seen,
    /// Points on one line there, or in space in one plane, by name, the largest such sets first.
    pub flat: Vec<Vec<String>>,
    /// Whether the points are those of the plane.
    pub dimension: usize,
    /// The drawing was moved off that place first, no point further than this. `None`: it stays there, as it meets its
    /// dimensions, or figures that do are as singular.
    pub moved: Option<f64>,
    /// Where it was moved off in the opposite direction and led to another figure: the points that are elsewhere in that one, in
    /// floats.
    pub other: Vec<(String, [f64; 3])>,
}

impl Singular {
    /// Of the rows that depend on each other; `names`: whose they are, and what was seen of them.
    pub(crate) fn new(
        problem: &Problem,
        system: &System,
        rows: &[usize],
        (names, seen): (impl Iterator<Item = String>, Seen),
    ) -> Self {
        let mut constraints: Vec<String> = Vec::new();
        names.for_each(|name| add_new(&mut constraints, name));
        Singular {
            constraints,
            seen,
            flat: flat(problem, system, rows),
            dimension: problem.dimension,
            moved: None,
            other: Vec::new(),
        }
    }

    /// What is so about the drawing, in a sentence without its end.
    pub fn place_in_words(&self) -> String {
        let sets = self.flat.iter().take(3).map(|set| {
            let line = match self.dimension {
                2 => "on one line",
                _ => "on one line or in one plane",
            };
            format!("{} are {line} in it, and ", list(set, LISTED))
        });
        let sets: String = sets.collect();
        let names = list(&self.constraints, LISTED);
        let is_singular = match self.seen {
            Seen::TooMany => "",
            _ => "the drawing is singular: ",
        };
        let near = match self.seen {
            Seen::Regular => "there, as they do not at figures near it (seen in floats)",
            Seen::FirstOrder => "there, to first order only (seen in floats)",
            Seen::TooMany => {
                "in the drawing and at figures near it: some of them are too many (seen in floats; `krawl check` names these)"
            }
            Seen::NoFigure => {
                "there, as they do not at places near it that meet all but dimensions (seen in floats; no figure was found near it)"
            }
        };
        format!("{is_singular}{sets}{names} depend on each other {near}")
    }

    /// The same with a capital letter.
    pub fn place_in_a_sentence(&self) -> String {
        let place = self.place_in_words();
        let mut letters = place.chars();
        let first = letters.next().map(|c| c.to_ascii_uppercase());
        first.into_iter().chain(letters).collect()
    }

    /// What became of it, in sentences.
    pub fn in_words(&self) -> String {
        let place = self.place_in_a_sentence();
        let Some(moved) = self.moved else {
            return format!(
                "{place}. It meets its dimensions, or figures that do are as singular, so it was not moved off that place; \
                 nothing follows from it of which constraint is one too many."
            );
        };
        format!(
            "{place}. Nothing follows from that of whether figures exist or of which constraint is one too many; the drawing \
             was moved off that place first, no point by more than {}.{}",
            rounded_up(moved),
            self.other_in_words()
        )
    }

    /// The other figure, in a sentence; nothing where there is none.
    pub fn other_in_words(&self) -> String {
        if self.other.is_empty() {
            return String::new();
        }
        let shown = self.other.iter().take(3).map(|(name, at)| {
            let at: Vec<String> = at[..self.dimension]
                .iter()
                .map(|x| format!("{x:.6}"))
                .collect();
            format!("{name} at ({})", at.join(", "))
        });
        let shown: Vec<String> = shown.collect();
        format!(
            " Moved off in the opposite direction it leads to another figure that meets its dimensions, with {}: either continues \
             the drawing.",
            shown.join(", ")
        )
    }
}

/// The largest sets of points on one line, in space in one plane, at the drawing, of those that some rows are about: in floats.
fn flat(problem: &Problem, system: &System, rows: &[usize]) -> Vec<Vec<String>> {
    const NEAR: f64 = 1e-9;
    const MOST: usize = 24;
    let d = problem.dimension;
    let unknowns: BTreeSet<usize> = rows
        .iter()
        .flat_map(|&row| system.rows[row].unknowns.iter().copied())
        .collect();
    let mut places: Vec<([f64; 3], &str)> = Vec::new();
    for (p, point) in problem.points.iter().enumerate() {
        let own = &system.coordinates[p * d..(p + 1) * d];
        let place = point.place();
        if own.iter().any(|u| unknowns.contains(u)) && places.iter().all(|(at, _)| *at != place) {
            places.push((place, &point.name));
        }
    }
    if places.len() > MOST {
        return Vec::new();
    }
    let from = |a: usize, b: usize| -> Vector3<f64> {
        let [a, b] = [a, b].each(|p| Vector3::from(places[p].0));
        (b - a).normalize()
    };
    let mut sets: Vec<Vec<usize>> = Vec::new();
    let mut add = |seed: &[usize], is_in: &dyn Fn(usize) -> bool| {
        let known = |set: &Vec<usize>| seed.iter().all(|p| set.contains(p));
        let set: Vec<usize> = (0..places.len())
            .filter(|p| seed.contains(p) || is_in(*p))
            .collect();
        if set.len() > seed.len() && !sets.iter().any(known) {
            sets.push(set);
        }
    };
    for a in 0..places.len() {
        for b in 0..a {
            let along = from(a, b);
            add(&[a, b], &|p| along.cross(&from(a, p)).norm() < NEAR);
            for c in 0..if d == 3 { b } else { 0 } {
                let normal = along.cross(&from(a, c));
                if normal.norm() > NEAR {
                    add(&[a, b, c], &|p| normal.dot(&from(a, p)).abs() < NEAR);
                }
            }
        }
    }
    sets.order_by_key(|set| std::cmp::Reverse(set.len()));
    let names = |set: Vec<usize>| set.iter().map(|&p| places[p].1.to_owned()).collect();
    sets.into_iter().map(names).collect()
}

/// A number of three digits that is no less than this one.
fn rounded_up(x: f64) -> f64 {
    format!("{:.2e}", x * 1.005).parse().unwrap_or(x)
}
