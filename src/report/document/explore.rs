//! What `krawl explore` writes.

use super::{Bounds, Fold, Points, Sample};
use crate::problem::Published;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What came of exploring.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Explored {
    /// How the run ended; none: nothing was run.
    pub status: Option<String>,
    /// What is proved.
    pub verdict: String,
    /// The solutions.
    pub solutions: Vec<FigureFound>,
    /// The paths on which they were found first, by number.
    pub paths: BTreeMap<u64, PathFollowed>,
    /// Paths by how they ended.
    pub counts: Counts,
    /// Solutions that could not be told from others.
    pub undecided: u64,
    /// Plans, lengths that bend and coefficients.
    pub ways: usize,
    /// How many real solutions there are, where that is proved.
    pub all_real: Option<usize>,
    /// Results that others published.
    pub published: Vec<Publication>,
    /// How long it took.
    pub seconds: f64,
}

keys! {
    /// A solution; `place`: how far on the path that found it, and how many folds are before it.
    FigureFound(points: Points<Bounds>, flat: bool, path: u64, place: Option<(f64, Option<usize>)>) {
        /// Its points.
        points: Points<Bounds> = points,
        /// Whether it is flat.
        flat: bool = flat,
        /// The path that found it.
        path: u64 = path,
    } or nothing {
        /// How far on that.
        arc: Option<f64> = place.map(|(arc, _)| arc),
        /// How many folds are before it.
        folds: Option<usize> = place.and_then(|(_, folds)| folds),
    }
}

/// A path.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PathFollowed {
    /// How it ended.
    pub status: String,
    /// Where its sketch comes from; none: it is the drawn one.
    pub from: Option<Origin>,
    /// Its sketch.
    pub sketch: Points<f64>,
    /// The length that bends.
    pub bend: String,
    /// By how much.
    pub bend_coefficient: String,
    /// Its tubes.
    pub tubes: usize,
    /// Where it turns back.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub folds: Option<Vec<Fold>>,
    /// Figures along it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples: Option<Vec<Sample>>,
}

impl PathFollowed {
    /// Where its sketch comes from, in words.
    pub(crate) fn origin(&self) -> String {
        match &self.from {
            Some(from) => format!("solution {}, branch {}", from.solution + 1, from.branch),
            None => "the drawn sketch".to_owned(),
        }
    }
}

/// Where a sketch comes from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// The solution, from 0 on.
    pub solution: u64,
    /// The branch of a plan.
    pub branch: u64,
}

keys! {
    /// A result that others published.
    Publication(published: &Published, solutions: usize) {
        /// By what method.
        method: String = published.method.clone(),
        /// How many solutions.
        solutions: usize = solutions,
        /// How long it took.
        seconds: Option<f64> = published.seconds,
    }
}

/// Numbers of paths by how they ended.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub struct Counts {
    pub followed: usize,
    pub closed: usize,
    pub open: usize,
    pub stopped: usize,
    pub recognised: usize,
    pub unusable: usize,
    pub repeated: u64,
    pub waiting: usize,
    pub in_units: usize,
    pub degenerate: usize,
    pub tubes: usize,
}
