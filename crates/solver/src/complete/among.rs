//! How many of all figures a path has, where that costs little.

use super::choose::plans_within;
use super::targets::Targets;
use super::{Options, Status, all};
use crate::problem::Problem;
use crate::track::{Mode, Outcome, Status as Ended};

/// Problems with more points are not looked at.
const MOST_POINTS: usize = 10;
/// Plans with more driving parameters are not searched: with one a search takes some hundred parts.
const MOST_PARAMETERS: usize = 1;
/// Parts that a search may take.
const MOST_BOXES: u64 = 1500;

/// The figures of a path among all that there are, up to rigid motions and reflections.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Among {
    /// Of the path.
    pub found: usize,
    /// All, by proof.
    pub all: u64,
}

/// Counts all figures of distances alone after a certified run, in a few milliseconds or not at all.
///
/// ```
/// use krawl::complete::{Among, among};
/// use krawl::problem::Problem;
/// use krawl::track::prove;
/// # std::env::set_current_dir("../..").unwrap();
/// let disulfide = Problem::read("problems/disulfide.toml")?;
/// let outcome = prove(&disulfide)?;
/// assert_eq!(among(&disulfide, &outcome), Some(Among { found: 8, all: 18 }));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn among(problem: &Problem, outcome: &Outcome) -> Option<Among> {
    let is_run = outcome.mode == Mode::Certified && !matches!(outcome.status, Ended::Stopped(_));
    if !is_run || !problem.is_distances_only() || problem.points.len() > MOST_POINTS {
        return None;
    }
    let targets = Targets::new(problem);
    plans_within(&targets, &targets.pairs(), MOST_PARAMETERS).ok()?;
    let options = Options {
        most_boxes: MOST_BOXES,
        threads: 1,
        ..Options::default()
    };
    let result = all(problem, &options).ok()?;
    let classes = outcome.solutions.iter().map(|solution| solution.class + 1);
    let found = classes.max().unwrap_or(0);
    let all = result.count.filter(|_| result.status == Status::Complete)?;
    // A path that had more would be a bug, and no sentence of ours.
    (found as u64 <= all).then_some(Among { found, all })
}
