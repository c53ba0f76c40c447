//! Points dragged to other places, the rest of the figure after them.

use crate::interval::Interval;
use crate::problem::{Decimal, Problem};
use crate::track::Stop;

/// Where a point is wanted.
#[derive(Debug, Clone, PartialEq)]
pub struct Drag {
    /// The point, by index.
    pub point: usize,
    /// Its coordinates there, as many as the problem has dimensions.
    pub to: Vec<Decimal>,
}

/// What came of dragging points.
#[derive(Debug, Clone, PartialEq)]
pub struct Dragged {
    /// How far each is from where it was wanted.
    pub places: Vec<(Drag, Interval)>,
    /// The names of the coordinates that were led, on each leg of the way straight from where they were to where they are at its end.
    pub led: Vec<String>,
    /// The legs of the way.
    pub legs: usize,
    /// Whether all points are where they were wanted: no further from there than 1e-9 of the size of the figure.
    pub is_there: bool,
    /// Why it goes no further, if the points are not where they were wanted; `None`: no figure was found that has them nearer.
    pub stop: Option<Stop>,
}

impl Drag {
    /// Checks that no point is wanted in two places.
    ///
    /// # Errors
    /// One is: in words.
    pub fn check(problem: &Problem, drags: &[Drag]) -> Result<(), String> {
        let twice = |(k, drag): (usize, &Drag)| {
            let is_same = |other: &Drag| other.point == drag.point;
            drags[..k].iter().any(is_same).then_some(drag.point)
        };
        match drags.iter().enumerate().find_map(twice) {
            Some(p) => Err(format!(
                "{} is dragged to two places: leave out one of them",
                problem.points[p].name
            )),
            None => Ok(()),
        }
    }

    /// From a text such as `P=40,25`.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn parse(problem: &Problem, text: &str) -> Result<Self, String> {
        let axes = &["x", "y", "z"][..problem.dimension];
        let example = || format!("write `P={}`", axes.join(","));
        let (name, to) = text
            .split_once('=')
            .ok_or_else(|| format!("{text}: {}", example()))?;
        let to: Vec<&str> = to.split(',').collect();
        Self::new(problem, name.trim(), &to)
            .map_err(|error| format!("{text}: {error}; {}", example()))
    }

    /// Of a point, by name, and its coordinates as they are written.
    ///
    /// # Errors
    /// As [`Drag::parse`].
    pub fn new(problem: &Problem, name: &str, to: &[&str]) -> Result<Self, String> {
        let point = problem.points.iter().position(|point| point.name == name);
        let point = point.ok_or_else(|| format!("there is no point `{name}`"))?;
        let to = to.iter().map(|x| match x.trim() {
            "" => Err("a coordinate is missing".to_owned()),
            x => x.parse().map_err(|error| format!("{error}")),
        });
        let to: Vec<Decimal> = to.collect::<Result<_, String>>()?;
        match to.len() == problem.dimension {
            true => Ok(Drag { point, to }),
            false => Err(format!(
                "a place has {} coordinates here, and {} are given",
                problem.dimension,
                to.len()
            )),
        }
    }
}
