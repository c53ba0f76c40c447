//! What a check finds, in words for people.

use crate::interval::Interval;
use crate::problem::Problem;

/// What a certificate proves.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// Whether its claims hold.
    pub outcome: Outcome,
    /// The problem that it is about.
    pub problem: Problem,
    /// The program that wrote it.
    pub program: String,
    /// Tubes proved and linked from the sketch on.
    pub tubes: u64,
    /// The boxes, each with exactly one solution: coordinates of every point in the problem's units.
    pub solutions: Vec<Vec<[Interval; 3]>>,
    /// Their classes up to congruence and reflection.
    pub classes: Vec<u32>,
    /// The smallest margin 1 − q − η/r of a Krawczyk test: 0 would fail, 1 is the most.
    pub margin: f64,
    /// An enclosure of the t along the chain.
    pub t_range: (f64, f64),
}

/// Whether a certificate's claims hold.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// They do: S is closed and its points with t = 1 are those listed.
    Verified,
    /// They do as far as they go: the chain ends before S is closed, for this reason.
    Partial(String),
    /// One could not be proved.
    Refuted(Flaw),
}

/// The first claim that could not be proved. Tubes and solutions are counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Flaw {
    /// The reference is degenerate in the sketch.
    #[error("{0}")]
    Sketch(String),
    /// A tube is no tube.
    #[error("tube {0} is not proved: {1}")]
    Tube(u64, &'static str),
    /// The chain does not begin at the sketch.
    #[error("the sketch does not lie in tube 1 before its exit for certain")]
    Start,
    /// A link is missing.
    #[error("tube {0} is not linked to tube {prev}: the exit of tube {prev} does not lie in it for certain", prev = .0 - 1)]
    Link(u64),
    /// The path turns round between two tubes.
    #[error("tube {0} does not follow the path in the direction of tube {prev} for certain", prev = .0 - 1)]
    Direction(u64),
    /// There is nothing to travel.
    #[error("in tube {0} the path's exit does not lie behind its entry for certain")]
    Backwards(u64),
    /// A crossing without a solution.
    #[error(
        "tube {0} may meet t = 1 between {1} and {2} of its half length, and none of the solutions listed so far is certain to be all that lies there"
    )]
    Unlisted(u64, f64, f64),
    /// A box is no box.
    #[error("solution {0} is not proved: {1}")]
    Solution(usize, &'static str),
    /// Two boxes overlap.
    #[error("the boxes of solutions {0} and {1} are not disjoint")]
    Overlap(usize, usize),
    /// A solution that the path does not meet.
    #[error("solution {0} was not met by the path")]
    Unmet(usize),
    /// Nothing is proved about two figures.
    #[error("it could not be decided whether solutions {0} and {1} are congruent")]
    Congruence(usize, usize),
    /// A wrong class.
    #[error("solution {0} is listed in class {1}, which is not proved")]
    Class(usize, u32),
    /// The loop is open.
    #[error(
        "the loop is not closed: the sketch does not lie in the last tube, tube {0}, behind its entry and in the direction of the start, for certain"
    )]
    Open(u64),
    /// A length may vanish.
    #[error("the length of {0} is not proved positive for t from {1} to {2}")]
    Length(String, f64, f64),
    /// No tube at all.
    #[error("there is no tube")]
    Empty,
}

impl Verdict {
    /// Whether the theorem is about this problem: the same points in the same places, the same
    /// distances, reference and interpolation, exactly. Titles do not count.
    pub fn is_about(&self, problem: &Problem) -> bool {
        let (a, b) = (&self.problem, problem);
        // As in the text of a certificate: lengths before squared lengths.
        let b = Problem::parse(&b.to_toml(), "").unwrap_or_else(|_| b.clone());
        a.dimension == b.dimension
            && a.points == b.points
            && a.distances == b.distances
            && a.homotopy == b.homotopy
    }
}
