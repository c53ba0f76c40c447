//! Problems that are solved block by block: sketches in their own frame, and what stopped as a whole.

use super::path::follow;
use super::told::worse;
use super::{Arguments, interrupt};
use crate::cli::take::{Candidates, Taken};
use crate::cli::{CLOSED, LIMIT, OPEN, STOPPED};
use crate::places::Each as _;
use krawl::blocks::{Figures, First as Nearest};
use krawl::problem::Problem;
use krawl::report::document::Measured;
use krawl::report::{
    BlockRuns, Document, Listed, figures_to_summary, figures_to_table, first_in_words, to_summary,
};
use krawl::track::{EndKind, Outcome, PathEnd, Status};
use std::path::Path;

/// The figures of a sketch, and what is told of them.
pub(super) struct Found {
    pub figures: Figures,
    /// Those that are told.
    listed: Listed,
    /// What was measured of them.
    measured: Vec<Measured>,
    /// The number of the one that `--first` means, if it is there.
    first: Option<u64>,
    pub text: String,
    /// The exit code.
    pub code: u8,
}

/// Of so many figures of a sketch, which may have many, measures are told.
const MOST_MEASURED: u64 = 1000;

/// A path with two ends of which neither says anything of the figures with t = 1.
#[derive(Clone, Copy)]
pub(super) struct Unbounded<'a> {
    /// Why it was left, one of the two ways.
    pub reason: &'a str,
    /// Whether it goes farther than it is followed, both ways: as from a sketch that meets all constraints, where nothing
    /// depends on t. Otherwise it has an end where a length or radius vanishes, as t makes it larger or smaller for ever.
    both_ways: bool,
}

impl<'a> Unbounded<'a> {
    /// The path of a run that came to two such ends.
    pub fn of(status: &'a Status) -> Option<Self> {
        let Status::Open(ends) = status else {
            return None;
        };
        let runs_on = |end: &PathEnd| end.kind == EndKind::Infinite && end.away.is_none();
        let vanishes = |end: &PathEnd| end.kind == EndKind::Undefined;
        if !ends.iter().all(|end| runs_on(end) || vanishes(end)) {
            return None;
        }
        let vanishing = ends.iter().rev().find(|end| vanishes(end));
        Some(Unbounded {
            reason: vanishing.unwrap_or(&ends[1]).in_words(),
            both_ways: vanishing.is_none(),
        })
    }
}

/// Follows the blocks of a problem one by one; what came of each, and the exit code.
pub(super) fn follow_blocks(
    arguments: &Arguments,
    blocks: Vec<Problem>,
    name: &str,
    which: &str,
) -> Result<(Vec<(Problem, Outcome)>, u8), String> {
    let mut code = CLOSED;
    let mut runs = Vec::with_capacity(blocks.len());
    for block in blocks {
        let (outcome, _, _) = follow(arguments, &block, name, which, None, None)?;
        code = worse(
            code,
            match &outcome.status {
                Status::Closed => CLOSED,
                Status::Open(_) => OPEN,
                Status::Stopped(_) => STOPPED,
            },
        );
        runs.push((block, outcome));
    }
    Ok((runs, code))
}

impl Found {
    /// The result that is written.
    pub fn document(&self) -> Document {
        let mut document = Document::figures(&self.figures, self.listed);
        document.beside.measures.clone_from(&self.measured);
        document
    }
}

impl Arguments {
    /// The figures of a sketch in its own frame, with `--first` the nearest one with its senses.
    pub(super) fn by_blocks(&self, problem: &Problem) -> Result<Found, String> {
        let mut control = interrupt::control();
        let figures = Figures::find(problem, &self.options(), &mut control)?;
        let mut listed = Listed::of(self.all);
        let mut code = match figures.doubt() {
            Some(_) => STOPPED,
            None => CLOSED,
        };
        let (mut text, mut first) = (String::new(), None);
        if self.first {
            let nearest = figures.first();
            text = first_in_words(&figures, nearest);
            first = match nearest {
                Nearest::Figure { number, .. } => Some(number),
                _ => None,
            };
            (listed, code) = match nearest {
                Nearest::Figure { number, .. } => (Listed::Only(number), CLOSED),
                Nearest::None { is_proved: true } if code == CLOSED => (listed, LIMIT),
                Nearest::None { .. } | Nearest::TooMany => (listed, STOPPED),
            };
        }
        text += &match self.summary {
            true => figures_to_summary(&figures),
            false => figures_to_table(&figures, listed),
        };
        let mut measured = Vec::new();
        let measures = self.measured.of(problem)?;
        if !measures.is_empty() {
            let numbers = match first {
                Some(number) => number..number + 1,
                None if self.first => 0..0,
                None => 0..figures.count().unwrap_or(u64::MAX).min(MOST_MEASURED),
            };
            let boxes: Vec<_> = numbers.map(|number| figures.figure(number)).collect();
            let boxes = || {
                boxes
                    .iter()
                    .map(|(points, objects)| (&points[..], &objects[..]))
            };
            text += &measures.to_table("", boxes());
            measured = measures.told(boxes());
        }
        if self.many.is_wanted() {
            text += "\nFigures found block by block are not told to more digits: `krawl all --digits` tells them.\n";
        }
        Ok(Found {
            figures,
            listed,
            measured,
            first,
            text,
            code,
        })
    }

    /// Writes the figure that is wanted of those found block by block, if one is; whether all went well.
    pub(super) fn take_of(&self, found: &Found, (problem, file): (&Problem, &Path)) -> bool {
        let Found { figures, first, .. } = found;
        let listed = Candidates {
            count: match (self.first, first) {
                // None that was asked for.
                (true, None) => 0,
                _ => figures.count().unwrap_or(u64::MAX),
            },
            first: *first,
            is_all: true,
        };
        let from = (file, &self.which);
        self.take.write(from, problem, listed, |number| {
            let (points, objects) = figures.figure(number);
            Ok(Taken {
                points: points.iter().map(|p| p.each(|x| x.mid())).collect(),
                objects,
            })
        })
    }

    /// The figures, block by block, of a problem that stopped for `reason` when followed as a whole. `None`: its blocks do not come to an end either, and no certificate is asked for.
    /// `unbounded`: its path has two ends. Where a length or radius vanishes at one of them, what is on the path is said unless
    /// nothing is asked for that a path alone has, and the blocks have all figures.
    pub(super) fn instead(
        &self,
        problem: &Problem,
        reason: &str,
        unbounded: Option<Unbounded>,
    ) -> Option<Found> {
        let vanishes = unbounded.is_some_and(|path| !path.both_ways);
        if vanishes && self.wants_path().is_some() {
            return None;
        }
        let found = self.by_blocks(problem).ok()?;
        if vanishes && !found.figures.is_complete() {
            return None;
        }
        let certificate = match self.cert {
            Some(_) => {
                " The certificate has what was proved of the path of the whole, whose exit code is told; of the figures below it says nothing (that of `krawl all` has all solutions)."
            }
            None => "",
        };
        let reason = reason.trim_end_matches('.');
        let how = match unbounded {
            Some(Unbounded {
                both_ways: true, ..
            }) => "its path goes farther than it is followed, both ways",
            Some(_) => {
                "its path ends where a length or radius vanishes, or goes farther than it is followed"
            }
            None => "it stops",
        };
        let introduction = match self.summary {
            true => String::new(),
            false => format!(
                "{}: followed as a whole {how} ({reason}). Its equations fall apart into blocks, and these are solved \
                 one by one.{certificate}\n\n",
                problem.name
            ),
        };
        // A certificate of a path that stopped, or is open, proves no more for it.
        let worth = match self.cert {
            Some(_) if unbounded.is_some() => OPEN,
            Some(_) => STOPPED,
            None => found.code,
        };
        let is_worth_it = found.code == CLOSED || self.cert.is_some();
        is_worth_it.then(|| Found {
            text: introduction + &found.text,
            code: worth,
            ..found
        })
    }

    pub(super) fn shown_blocks(&self, all: &BlockRuns) -> String {
        let runs = all.runs.iter();
        match self.summary {
            true => {
                let lines = runs.map(|(block, run)| to_summary(block, run, None));
                let lines: String = lines.collect();
                format!("{lines}{}: {}\n", all.problem.name, all.verdict())
            }
            false => {
                let tables = runs.map(|(block, run)| self.shown(block, run, None) + "\n");
                let tables: String = tables.collect();
                format!("{}\n{tables}{}", all.introduction(), all.to_table(self.all))
            }
        }
    }
}
