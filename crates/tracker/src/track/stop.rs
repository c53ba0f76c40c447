//! Why a run ended before its path did: a kind for programs, and words for people.

use std::fmt;
use std::ops::Deref;

/// What made a run stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum StopKind {
    /// It was interrupted, or its time was over.
    Interrupted,
    /// As many steps, tubes or seconds were spent as were allowed, or it went as far.
    Limit,
    /// No more of the path was asked for.
    Enough,
    /// t turns back before it is 1, where only the path up to there was asked for.
    TurnsBack,
    /// The path does not set out from the sketch: the equations are dependent there, or no first step succeeds.
    Sketch,
    /// No step succeeds, however short; certified: none could be proved, or thousands of them lead nowhere.
    NoStep,
    /// The same, near a figure where the equations are dependent, so that branches may meet: seen in floats.
    Singular,
    /// The same, near a figure with t = 1 that can move: seen in floats.
    Flexible,
    /// A figure grows, ever farther as far as one can see.
    Infinite,
    /// A length, a radius or a vector that must not vanish goes to zero, or could not be proved not to do so.
    Undefined,
    /// A drawn line or arc shrinks to nothing, or an arc grows to a whole circle, and would come out turned round.
    Vanishes,
    /// It cannot be told whether t is 1 somewhere, or whether two solutions are one, or congruent.
    Undecided,
    /// A constraint that seemed to follow from the others does not.
    Contradiction,
    /// The equations of what was asked for cannot be made, or are others than those that were followed.
    Refused,
    /// The path was proved the other way from the sketch, not this one.
    OtherWay,
    /// Something that must not happen: a bug in krawl.
    Bug,
}

impl StopKind {
    /// All of them.
    pub const ALL: [StopKind; 16] = [
        StopKind::Interrupted,
        StopKind::Limit,
        StopKind::Enough,
        StopKind::TurnsBack,
        StopKind::Sketch,
        StopKind::NoStep,
        StopKind::Singular,
        StopKind::Flexible,
        StopKind::Infinite,
        StopKind::Undefined,
        StopKind::Vanishes,
        StopKind::Undecided,
        StopKind::Contradiction,
        StopKind::Refused,
        StopKind::OtherWay,
        StopKind::Bug,
    ];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            StopKind::Interrupted => "interrupted",
            StopKind::Limit => "limit",
            StopKind::Enough => "enough",
            StopKind::TurnsBack => "turns_back",
            StopKind::Sketch => "sketch",
            StopKind::NoStep => "no_step",
            StopKind::Singular => "singular",
            StopKind::Flexible => "flexible",
            StopKind::Infinite => "infinite",
            StopKind::Undefined => "undefined",
            StopKind::Vanishes => "vanishes",
            StopKind::Undecided => "undecided",
            StopKind::Contradiction => "contradiction",
            StopKind::Refused => "refused",
            StopKind::OtherWay => "other_way",
            StopKind::Bug => "bug",
        }
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
