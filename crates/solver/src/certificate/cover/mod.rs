//! The check of covers: that no figure lies in the space searched but those listed.
//!
//! A cover says of every part of the space why it holds no figure but those listed. There are two kinds: of the parameter
//! space of a construction plan ([`plan`]), for distances, and of the space of all coordinates and auxiliary unknowns
//! ([`coordinates`]), for every problem. What is trusted is in this folder, the reading of the header (`../head.rs`), and the intervals and the problem beside
//! it; for the second kind the kernel's equations too, and the test of certificates for one figure.

// A bound that is not a number proves nothing: tests say what they need, and `!(a < b)` is not `a >= b`.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

pub mod coordinates;
mod lines;
mod plan;

pub use plan::{Cover, Kind, Left, MAX_SYMBOLS, Mark, Radius};
pub(crate) use plan::{Figure, Frame, Pairs, alone, alone_within, closing, construct};

use super::Compared;
use super::format::TAG_COVER_OF_COORDINATES;
use super::head::Head;
use super::verdict::are_same;
use crate::problem::Problem;

/// Why bytes are no cover.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("not a cover that can be read: {0}")]
pub struct CoverError(pub String);

/// What a cover proves.
#[derive(Debug, Clone, PartialEq)]
pub struct CoverVerdict {
    /// The problem that it is about.
    pub problem: Problem,
    /// How many solutions there are, up to the symmetries of the problem ([`crate::constraint::symmetry`]), each proved to exist,
    /// no two congruent; `None` where that has no place in 64 bits.
    pub solutions: Option<u64>,
    /// Parts of the space of which nothing is claimed: if there are none, there is no other solution.
    pub undecided: u64,
    /// Parts that were checked.
    pub parts: u64,
    /// What is not proved, if something is not: then nothing is.
    pub flaw: Option<String>,
}

/// Where a check is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoverStage {
    /// Parts that are proved.
    pub parts: u64,
    /// The share of the marks that is read, from 0 to 1.
    pub share: f64,
}

impl CoverStage {
    /// Behind so many parts, with so many of the marks read.
    fn new(parts: u64, read: usize, marks: &[u8]) -> Self {
        let share = read as f64 / marks.len().max(1) as f64;
        CoverStage { parts, share }
    }
}

/// What becomes of a check that is told not to go on.
const ENDED: &str = "the check was ended before its end";

impl CoverVerdict {
    /// Of a cover that lists so many solutions, before anything is checked.
    fn about(problem: &str, solutions: usize) -> Result<Self, CoverError> {
        let problem = Problem::parse(problem, "the cover's problem")
            .map_err(|error| CoverError(error.to_string()))?;
        if !problem.orientations.is_empty() {
            return Err(CoverError(
                "its problem asks for signs, of which covers say nothing".to_owned(),
            ));
        }
        Ok(CoverVerdict {
            problem,
            solutions: Some(solutions as u64),
            undecided: 0,
            parts: 0,
            flaw: None,
        })
    }

    /// Whether the solutions listed are proved to be all.
    pub fn proves_all(&self) -> bool {
        self.flaw.is_none() && self.undecided == 0
    }

    /// What is compared where it is held against a problem.
    pub fn compared(&self) -> Compared {
        Compared::of(&self.problem)
    }

    /// Whether this is about a problem: of distances alone about its points and distances, whatever its sketch; otherwise
    /// about all that it says, as other constraints may mean what the sketch shows.
    pub fn is_about(&self, problem: &Problem) -> bool {
        are_same(&self.problem, problem)
    }
}

/// Checks a cover of either kind.
///
/// ```
/// use krawl::certificate::cover::verify_cover;
/// use krawl::complete::{Options, all};
/// use krawl::problem::Problem;
///
/// let triangle = Problem::build("triangle", 2)
///     .point("a", ["0", "0"]).point("b", ["1", "0"]).point("c", ["0.4", "1.1"])
///     .distance("a", "b", "1").distance("b", "c", "1.2").distance("c", "a", "1.3")
///     .finish().unwrap();
/// let result = all(&triangle, &Options { cover: true, ..Options::default() }).unwrap();
/// let verdict = verify_cover(&result.cover.unwrap()).unwrap();
/// assert!(verdict.proves_all() && verdict.is_about(&triangle));
/// assert_eq!(verdict.solutions, Some(1));
/// ```
pub fn verify_cover(bytes: &[u8]) -> Result<CoverVerdict, CoverError> {
    verify_cover_while(bytes, &mut |_| true)
}

/// Checks a cover of either kind, and tells time and again where it is. It goes on as long as it is told `true`; otherwise
/// nothing is proved ([`CoverVerdict::flaw`]).
pub fn verify_cover_while(
    bytes: &[u8],
    goes_on: &mut (dyn FnMut(CoverStage) -> bool + Send),
) -> Result<CoverVerdict, CoverError> {
    match Head::of_one_record(bytes, TAG_COVER_OF_COORDINATES) {
        Ok(_) => coordinates::verify(bytes, goes_on),
        Err(_) => plan::verify(bytes, goes_on),
    }
}
