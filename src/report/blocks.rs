//! A problem that was followed block by block, and the figures of the whole that come of it.

use super::complete::counted_or_many;
use super::document::{Blocks, Document, Solve};
use super::edit::write_points;
use super::figures::{IN_JSON, Listed, chosen_in_words, write_more};
use super::run::Run;
use crate::blocks::Combined;
use crate::problem::Problem;
use crate::track::{Mode, Options, Outcome, Status};

/// A problem with the runs of its blocks ([`crate::blocks::clusters`]).
#[derive(Debug, Clone, Copy)]
pub struct BlockRuns<'a> {
    /// The whole.
    pub problem: &'a Problem,
    /// Why it was not followed as a whole to the end.
    pub reason: &'a str,
    /// How the blocks were followed.
    pub options: &'a Options,
    /// The blocks, and what came of each.
    pub runs: &'a [(Problem, Outcome)],
}

impl BlockRuns<'_> {
    /// The figures of the whole; `None` if the blocks do not hang together.
    pub(super) fn combined(&self) -> Option<Combined<'_>> {
        let blocks: Vec<Problem> = self.runs.iter().map(|(block, _)| block.clone()).collect();
        let solutions = self.runs.iter().map(|(_, run)| run.solutions.as_slice());
        Combined::new(self.problem, &blocks, solutions.collect())
    }

    /// Whether every run was proved to its end, closed or open.
    pub(super) fn all_proved(&self) -> bool {
        self.runs.iter().all(|(_, run)| {
            run.mode == Mode::Certified && !matches!(run.status, Status::Stopped(_))
        })
    }

    /// What is said before the blocks.
    pub fn introduction(&self) -> String {
        let what = match self.problem.dimension {
            2 => "a side",
            _ => "a triangle of sides",
        };
        format!(
            "{}: followed as a whole it stops ({}). It falls apart into {} blocks that share no more than {what}, and \
             these are followed one by one.\n",
            self.problem.name,
            self.reason.trim_end_matches('.'),
            self.runs.len(),
        )
    }

    /// What comes of all blocks together, in a sentence or two.
    pub fn verdict(&self) -> String {
        let Some(combined) = self.combined() else {
            return "Combined: the blocks do not hang together.".to_owned();
        };
        let up_to = match combined.without_mirror_images() {
            true => "up to motions and reflections",
            false => "up to motions, mirror images among them",
        };
        let count = combined.count();
        let number = counted_or_many(count, "figure");
        let blocks = "those whose blocks are solutions listed above, one of each block, as they are or mirrored";
        match (count, self.all_proved()) {
            (Some(0), true) => {
                "Combined, proved: none, as a block has no solution on its path.".to_owned()
            }
            (Some(0), false) => {
                "Combined: none was found, as a block has no solution that was proved.".to_owned()
            }
            (_, true) => format!(
                "Combined, proved: {number} {up_to} ({blocks}) meet all dimensions, and no others have blocks on these paths."
            ),
            (_, false) => format!(
                "Combined: {number} {up_to} ({blocks}) are proved to meet all dimensions; there may be more, as a block stopped."
            ),
        }
    }

    /// The combined figures as a text of several lines, the first ones or all.
    pub fn to_table(&self, all: bool) -> String {
        let mut out = format!("{}: {}\n", self.problem.name, self.verdict());
        let Some(combined) = self.combined() else {
            return out;
        };
        let count = combined.count().unwrap_or(u64::MAX);
        let each = self.problem.points.len() as u64 + 2;
        let numbers = Listed::of(all).in_table(count, each);
        for number in numbers.clone() {
            let choices = combined.choices(number);
            let chosen = choices.iter().map(|c| (c.block, c.solution, c.mirrored));
            out += &format!("\nFigure {}: {}\n", number + 1, chosen_in_words(chosen));
            match combined.figure(&choices) {
                Some(points) => write_points(&mut out, self.problem, &points),
                None => out += "  (its boxes are too wide to put the blocks together)\n",
            }
        }
        write_more(&mut out, count, numbers.end);
        out
    }

    /// The result: that of the whole, which stopped, with `blocks` in it (docs/using/programs.md).
    pub fn document(&self, whole: &Outcome, all: bool) -> Document {
        let mut own = Solve::of(&Run::new(self.problem, self.options, whole));
        let combined = self.combined();
        let count = combined.as_ref().and_then(Combined::count);
        let numbers = Listed::of(all).numbers(count.unwrap_or(u64::MAX), IN_JSON);
        own.blocks = Some(Blocks::new(self, combined.as_ref(), numbers));
        own.document(self.problem)
    }
}
