//! Why a run ended before its path did: a kind for programs, and words for people.

use std::fmt;
use std::ops::Deref;

crate::named! {
    /// What made a run stop.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    #[non_exhaustive]
    pub enum StopKind {
        /// It was interrupted, or its time was over.
        Interrupted = "interrupted",
        /// As many steps, tubes or seconds were spent as were allowed, or it went as far.
        Limit = "limit",
        /// No more of the path was asked for.
        Enough = "enough",
        /// t turns back before it is 1, where only the path up to there was asked for.
        TurnsBack = "turns_back",
        /// The path does not set out from the sketch: the equations are dependent there, or no first step succeeds.
        Sketch = "sketch",
        /// No step succeeds, however short; certified: none could be proved, or thousands of them lead nowhere.
        NoStep = "no_step",
        /// The same, near a figure where the equations are dependent, so that branches may meet: seen in floats.
        Singular = "singular",
        /// The same, near a figure with t = 1 that can move: seen in floats.
        Flexible = "flexible",
        /// A figure grows, ever farther as far as one can see.
        Infinite = "infinite",
        /// A length, a radius or a vector that must not vanish goes to zero, or could not be proved not to do so.
        Undefined = "undefined",
        /// A drawn line or arc shrinks to nothing, or an arc grows to a whole circle, and would come out turned round.
        Vanishes = "vanishes",
        /// Two edges of outlines come to touch.
        Touches = "touches",
        /// It cannot be told whether t is 1 somewhere, or whether two solutions are one, or congruent.
        Undecided = "undecided",
        /// A constraint that seemed to follow from the others does not.
        Contradiction = "contradiction",
        /// The equations of what was asked for cannot be made, or are others than those that were followed.
        Refused = "refused",
        /// The path was proved the other way from the sketch, not this one.
        OtherWay = "other_way",
        /// Something that must not happen: a bug in krawl.
        Bug = "bug",
    }
}

/// Why a run stopped. It reads as its words do.
///
/// ```
/// use krawl::problem::Problem;
/// use krawl::track::{Control, Options, Status, StopKind, solve};
///
/// # std::env::set_current_dir("../..").unwrap();
/// let problem = Problem::read("problems/octahedron.toml")?;
/// let options = Options { max_steps: 5, ..Options::certified() };
/// let outcome = solve(&problem, &options, &mut Control::default())?;
/// let Status::Stopped(stop) = &outcome.status else { panic!("{:?}", outcome.status) };
/// assert_eq!(stop.kind, StopKind::Limit);
/// assert!(stop.starts_with("the limit of 5 tubes was reached"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{text}")]
pub struct Stop {
    /// For programs.
    pub kind: StopKind,
    /// For people: what happened, where, and what is known of it.
    pub text: String,
}

impl Stop {
    /// A reason.
    pub fn new(kind: StopKind, text: impl Into<String>) -> Self {
        Stop {
            kind,
            text: text.into(),
        }
    }

    /// The same, said in other words.
    pub fn in_words(self, words: impl fmt::Display) -> Self {
        Stop {
            kind: self.kind,
            text: words.to_string(),
        }
    }
}

impl Deref for Stop {
    type Target = str;

    fn deref(&self) -> &str {
        &self.text
    }
}
