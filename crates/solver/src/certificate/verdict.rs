//! What a check finds, in words for people.

use super::format::ArcClaim;
use crate::interval::Interval;
use crate::problem::Problem;
use std::fmt;

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
    /// Which of them are degenerate (flat) figures: alone in their boxes in the equations with heights divided by 1 − t only.
    pub degenerate: Vec<bool>,
    /// Whether the certificate is one of edits.
    pub is_edit: bool,
    /// Those whose arc was proved to its end.
    pub arcs: Vec<Arc>,
    /// The dimension that a motion leads, where the tubes behind the arcs are those of one: then they set out from the figure of the last arc.
    pub motion: Option<ArcClaim>,
    /// Whether the path was followed both ways from the sketch, to two ends.
    pub is_open: bool,
    /// Their classes up to congruence and reflection.
    pub classes: Vec<u32>,
    /// The smallest margin 1 − q − η/r of a Krawczyk test: 0 would fail, 1 is the most.
    pub margin: f64,
    /// An enclosure of the t along the chain; (∞, −∞) where there is no tube.
    pub t_range: (f64, f64),
}

/// An edit that was proved.
#[derive(Debug, Clone, PartialEq)]
pub struct Arc {
    /// What it claims to change and to keep.
    pub claim: ArcClaim,
    /// Where it ended: t = 1, or an enclosure of the t of the fold.
    pub t: Interval,
    /// A box that holds the figure there: coordinates of every point, in the gauge, in the problem's units.
    pub figure: Vec<[Interval; 3]>,
}

/// Whether a certificate's claims hold.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// They do: S is closed, or open, and its points with t = 1 are those listed; or all edits end as they say.
    Verified,
    /// They do as far as they go: the chain ends before S is closed, for this reason.
    Partial(String),
    /// This claim could not be proved by the checker's test. It may be true.
    NotProved(Flaw),
    /// This claim is false.
    Refuted(Flaw),
}

/// A claim that is false, or could not be proved, in words. Tubes and solutions are counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Flaw {
    /// The reference is degenerate in the sketch.
    #[error("the sketch can be seen from its reference: {0}")]
    Sketch(String),
    /// A tube is no tube.
    #[error("tube {0} holds the path: {1}")]
    Tube(u64, Fault),
    /// The chain does not begin at the sketch.
    #[error("the sketch lies in tube 1, before its exit")]
    Start,
    /// A link is missing.
    #[error("the point where the path leaves tube {prev} lies in tube {0}", prev = .0 - 1)]
    Link(u64),
    /// The path turns round between two tubes.
    #[error("tube {0} follows the path in the direction of tube {prev}", prev = .0 - 1)]
    Direction(u64),
    /// Other equations follow where they may not.
    #[error(
        "where the path leaves tube {0} t is not 1, so that it can be followed in equations with heights divided by 1 − t, or back"
    )]
    Change(u64),
    /// There is nothing to travel.
    #[error("in tube {0} the path's exit lies behind its entry")]
    Backwards(u64),
    /// A crossing without a solution.
    #[error(
        "where tube {0} meets t = 1, between {1} and {2} of its half length, it does so in solutions listed so far"
    )]
    Unlisted(u64, f64, f64),
    /// A box is no box.
    #[error("the box of solution {0} holds exactly one solution: {1}")]
    Solution(usize, Fault),
    /// Two boxes overlap.
    #[error("the boxes of solutions {0} and {1} are disjoint")]
    Overlap(usize, usize),
    /// A solution that the path does not meet.
    #[error("the path meets solution {0}")]
    Unmet(usize),
    /// Nothing is proved about two figures.
    #[error("solutions {0} and {1} are congruent, or are not, as listed")]
    Congruence(usize, usize),
    /// A wrong class.
    #[error("solution {0} belongs to class {1}")]
    Class(usize, u32),
    /// The loop is open.
    #[error(
        "the loop is closed: the sketch lies in the last tube, tube {0}, behind its entry, and the path comes \
         there in the direction of the start"
    )]
    Open(u64),
    /// The tubes behind the turn lead the same way.
    #[error("tube {0} leads from the sketch the other way than tube 1")]
    Turn(u64),
    /// An edit begins nowhere.
    #[error("the sketch meets the dimensions of the problem, exactly")]
    Met,
    /// An edit is none.
    #[error("the equations of arc {0} are such that it can be followed")]
    Arc(usize),
    /// Time stands still, or goes back.
    #[error("t rises in tube {0}, between {1} and {2} of its half length")]
    Rise(u64, f64, f64),
    /// A sign changes.
    #[error("in tube {0}, between {1} and {2} of its half length, signs are kept as claimed")]
    Kept(u64, f64, f64),
    /// The box at the end of an arc is no box.
    #[error("the box at the end of arc {0} holds exactly one figure: {1}")]
    Figure(usize, Fault),
    /// It is no fold.
    #[error("there is a fold in the box at the end of arc {0}: {1}")]
    Fold(usize, Fault),
    /// An arc ends elsewhere.
    #[error(
        "arc {0} comes to the figure in the box at its end, behind its entry into the last tube"
    )]
    Elsewhere(usize),
    /// No tube at all.
    #[error("there is a tube")]
    Empty,
}

/// Why a test does not prove what it should.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fault {
    /// In words.
    pub why: &'static str,
    /// 1 − q − η/r where it was made, which would have to be positive.
    pub margin: Option<f64>,
    /// Whether this shows that the claim is false.
    pub is_false: bool,
}

impl Fault {
    /// That something cannot be told.
    pub const fn because(why: &'static str) -> Self {
        Fault {
            why,
            margin: None,
            is_false: false,
        }
    }

    /// That the test's margin is not positive.
    pub const fn margin(margin: f64) -> Self {
        Fault {
            margin: Some(margin),
            ..Fault::because("the Krawczyk test fails")
        }
    }

    /// That something is not so.
    pub const fn proof(why: &'static str) -> Self {
        Fault {
            is_false: true,
            ..Fault::because(why)
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str(self.why)?;
        match self.margin {
            Some(margin) => write!(out, ", with a margin of {margin:.4}"),
            None => Ok(()),
        }
    }
}

/// Whether sets of all solutions of two problems are about the same: of distances alone the points and distances, whatever the sketch;
/// otherwise all that they say, as other constraints may mean what the sketch shows. `own`: as it stands in a set.
pub(super) fn are_same(own: &Problem, problem: &Problem) -> bool {
    // As in the text of a set: lengths before squared lengths.
    let other = Problem::parse(&problem.to_toml(), "").unwrap_or_else(|_| problem.clone());
    let is_same_figure = own.dimension == other.dimension && own.distances == other.distances;
    if own.is_distances_only() && other.is_distances_only() {
        let names = |p: &Problem| p.points.iter().map(|p| p.name.clone()).collect::<Vec<_>>();
        return is_same_figure && names(own) == names(&other);
    }
    is_same_figure
        && own.points == other.points
        && own.objects == other.objects
        && own.constraints == other.constraints
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
            && a.objects == b.objects
            && a.distances == b.distances
            && a.constraints == b.constraints
            && a.homotopy == b.homotopy
    }
}
