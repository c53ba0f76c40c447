//! A run, with what belongs to it.

use crate::complete::Tested;
use crate::problem::Problem;
use crate::track::{Options, Outcome, Trace};

/// A run with all that belongs to it, to be written down.
#[derive(Debug, Clone, Copy)]
pub struct Run<'a> {
    /// The problem that was solved.
    pub problem: &'a Problem,
    /// The options with which it was solved.
    pub options: &'a Options,
    /// The outcome of the run.
    pub outcome: &'a Outcome,
    /// The path, where it was kept: only certified runs have one.
    pub trace: Option<&'a Trace>,
    /// The number of figures along the path that are written.
    pub samples: usize,
    /// Where there are more distances than unknowns, what came of those that were left out.
    pub tested: Option<&'a Tested>,
}

impl<'a> Run<'a> {
    /// A run of which no path was kept, and in which nothing was left out.
    pub fn new(problem: &'a Problem, options: &'a Options, outcome: &'a Outcome) -> Self {
        Run {
            problem,
            options,
            outcome,
            trace: None,
            samples: 0,
            tested: None,
        }
    }
}
