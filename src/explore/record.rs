//! What is kept of sketches, paths and solutions, in the store and in the files of work units.

use crate::interval::{Interval, hull};
use crate::places::Each as _;
use crate::track::FigureBox;
use crate::track::arc::Figure;
use serde::{Deserialize, Serialize};

/// A sketch to follow, or one that was followed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sketch {
    /// Its number, and that of its path.
    pub id: u64,
    /// How it was made, and how it is followed.
    pub way: usize,
    /// The solution that it was made from, and the branch of the way's plan: bits of the steps that take the other
    /// side. `None`: it is the problem's own sketch.
    pub from: Option<(u64, u64)>,
    /// Where its points are; empty for the problem's own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<[f64; 3]>,
    /// What its figure looks like up to congruence: see [`super::look`].
    pub look: Vec<f64>,
}

impl Sketch {
    /// Its points, if it is not the problem's own.
    pub fn places(&self) -> Option<&[[f64; 3]]> {
        (!self.points.is_empty()).then_some(&self.points[..])
    }
}

/// A box with exactly one figure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoxRecord {
    /// Its middle, one entry per unknown.
    pub centre: Vec<f64>,
    /// What is to be added to `centre` for the middle, in extended precision; empty where that is nothing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub low: Vec<f64>,
    /// How far the figure may be from it.
    pub radius: Vec<f64>,
    /// Within this distance there is no other.
    pub alone: f64,
}

impl BoxRecord {
    /// To be kept.
    pub fn of(found: &FigureBox) -> Self {
        let Figure {
            centre,
            low,
            radius,
        } = found.figure.clone();
        BoxRecord {
            centre,
            low: match low.iter().all(|&x| x == 0.0) {
                true => Vec::new(),
                false => low,
            },
            radius,
            alone: found.alone_within,
        }
    }

    /// As the proofs have it.
    pub fn figure(&self) -> FigureBox {
        let n = self.centre.len();
        let low = match self.low.is_empty() {
            true => vec![0.0; n],
            false => self.low.clone(),
        };
        FigureBox {
            figure: Figure {
                centre: self.centre.clone(),
                low,
                radius: self.radius.clone(),
            },
            alone_within: self.alone,
        }
    }
}

/// The coordinates of a figure's points, pairs of bounds.
pub type Bounds = Vec<[[f64; 2]; 3]>;

/// Bounds of intervals.
pub fn bounds(points: &[[Interval; 3]]) -> Bounds {
    let pair = |x: &Interval| [x.inf(), x.sup()];
    points.iter().map(|p| p.each_ref().each(pair)).collect()
}

/// Intervals of bounds.
pub fn intervals(points: &Bounds) -> Vec<[Interval; 3]> {
    points.iter().map(|p| p.each(|[a, b]| hull(a, b))).collect()
}

/// A solution on a path.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Met {
    /// Its points, in the gauge and the problem's units.
    pub points: Bounds,
    /// Its box.
    pub figure: BoxRecord,
}

crate::named! {
    /// How the run along a path ended.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum End {
        /// The path is a loop, proved.
        Closed = "closed",
        /// It has two ends, and is proved between them.
        Open = "open",
        /// The run stopped before. What it found before is proved.
        Stopped = "stopped",
        /// It was not followed, as a proved path passes through it at t = 0.
        Recognised = "recognised",
        /// No path can set out from it.
        Unusable = "unusable",
    }
}

/// What came of a sketch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PathRecord {
    /// The sketch's number.
    pub id: u64,
    /// How it ended.
    pub end: End,
    /// Why, where it stopped.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// The path that passes through the sketch, where one does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by: Option<u64>,
    /// Tubes proved.
    pub tubes: usize,
    /// Seconds on one core.
    pub seconds: f64,
    /// One of each class of congruent solutions on it.
    pub solutions: Vec<Met>,
    /// Figures with t = 0 that it passes through.
    pub starts: Vec<BoxRecord>,
    /// Degenerate solutions on it, flat figures with others as near as one likes: they are in no box alone, and are not
    /// among the solutions.
    #[serde(default)]
    pub degenerate: usize,
}

impl PathRecord {
    /// Of a sketch that ended so before anything was found.
    pub fn new(id: u64, end: End, reason: Option<String>) -> Self {
        PathRecord {
            id,
            end,
            reason,
            by: None,
            tubes: 0,
            seconds: 0.0,
            solutions: Vec::new(),
            starts: Vec::new(),
            degenerate: 0,
        }
    }
}

/// Solutions that are congruent, as one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Class {
    /// Its number.
    pub id: u64,
    /// The path that found it first.
    pub path: u64,
    /// Points of one of them, in the gauge and the problem's units.
    pub points: Bounds,
    /// Its box.
    pub figure: BoxRecord,
}
