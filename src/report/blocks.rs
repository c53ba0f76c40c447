//! A problem that was followed block by block, and the figures of the whole that come of it.

use super::columns::written;
use super::complete::counted_or_many;
use super::edit::{points_to_value, write_points};
use super::figures::{IN_JSON, Listed, chosen_in_words, write_more};
use super::json::Run;
use crate::blocks::Combined;
use crate::problem::Problem;
use crate::track::{Mode, Options, Outcome, Status};
use serde_json::{Value, json};
use std::fmt::{self, Write};

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
    fn combined(&self) -> Option<Combined<'_>> {
        let blocks: Vec<Problem> = self.runs.iter().map(|(block, _)| block.clone()).collect();
        let solutions = self.runs.iter().map(|(_, run)| run.solutions.as_slice());
        Combined::new(self.problem, &blocks, solutions.collect())
    }

    /// Whether every run was proved to its end, closed or open.
    fn all_proved(&self) -> bool {
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
        let heading = format!("{}: {}\n", self.problem.name, self.verdict());
        heading + &written(|out| self.write_figures(out, all))
    }

    fn write_figures(&self, out: &mut String, all: bool) -> fmt::Result {
        let Some(combined) = self.combined() else {
            return Ok(());
        };
        let count = combined.count().unwrap_or(u64::MAX);
        let each = self.problem.points.len() as u64 + 2;
        let numbers = Listed::of(all).in_table(count, each);
        for number in numbers.clone() {
            let choices = combined.choices(number);
            let chosen = choices.iter().map(|c| (c.block, c.solution, c.mirrored));
            writeln!(out, "\nFigure {}: {}", number + 1, chosen_in_words(chosen))?;
            match combined.figure(&choices) {
                Some(points) => write_points(out, self.problem, &points)?,
                None => writeln!(out, "  (its boxes are too wide to put the blocks together)")?,
            }
        }
        write_more(out, count, numbers.end)
    }

    /// The result as a value in memory: that of the whole, which stopped, with `blocks` added (docs/using/programs.md).
    pub fn to_value(&self, whole: &Outcome, all: bool) -> Value {
        let run = |problem, outcome| Run::new(problem, self.options, outcome);
        let mut value = run(self.problem, whole).to_value();
        let blocks: Vec<Value> = self
            .runs
            .iter()
            .map(|(block, outcome)| run(block, outcome).to_value())
            .collect();
        let combined = self.combined();
        let count = combined.as_ref().and_then(Combined::count);
        let numbers = Listed::of(all).numbers(count.unwrap_or(u64::MAX), IN_JSON);
        let figures = combined.iter().flat_map(|combined| {
            numbers.clone().map(|number| {
                let choices = combined.choices(number);
                let points = combined.figure(&choices);
                let chosen = choices.iter().map(
                    |c| json!({"block": c.block, "solution": c.solution, "mirrored": c.mirrored}),
                );
                json!({
                    "choices": chosen.collect::<Vec<_>>(),
                    "points": points.map(|points| points_to_value(self.problem, &points)),
                })
            })
        });
        let figures: Vec<Value> = figures.collect();
        value["blocks"] = json!({
            "verdict": self.verdict(),
            "proved": self.all_proved(),
            "count": count,
            "without_mirror_images": combined.as_ref().is_some_and(Combined::without_mirror_images),
            "runs": blocks,
            "figures": figures,
        });
        value
    }
}
