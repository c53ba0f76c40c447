//! What `krawl solve` writes of a sketch in its own frame, block by block.

use super::{At, Bounds, Document, Drawing, Named, Objects, Points, Verb, all, bounds, points};
use crate::blocks::{self, Account, BlockAccount, Comparison, Sense};
use crate::interval::Interval;
use crate::problem::Problem;
use crate::report::edit::numbers_of;
use crate::report::figures::{IN_JSON, Listed, figures_in_words, named};
use crate::system::Located;

keys! {
    /// The figures of a sketch.
    Figures(figures: &blocks::Figures, listed: Listed) {
        /// `certified`.
        mode: String = "certified".into(),
        /// `complete`, `combined` or `stopped`.
        status: String = match figures.doubt() {
            Some(_) => "stopped".into(),
            None if figures.is_complete() => "complete".into(),
            None => "combined".into(),
        },
        /// Why there may be more.
        reason: Option<String> = figures.doubt(),
        /// What is proved.
        verdict: String = figures_in_words(figures),
        /// How many there are; none where that has no place in 64 bits.
        count: Option<u64> = figures.count(),
        /// The blocks.
        blocks: Vec<BlockAccount> = figures.blocks().cloned().collect(),
        /// Of what it is proved.
        account: Account = figures.account().clone(),
        /// What refused figures.
        refused: Vec<Refused> = all(figures.refused(), Refused::new),
        /// Which way things turn in the sketch.
        senses: Option<Senses> = figures.senses().map(|senses| Senses::new(figures, senses)),
        /// The figures that are listed.
        figures: Vec<FigureOfBlocks> = all(
            listed.numbers(figures.count().unwrap_or(u64::MAX), IN_JSON),
            |number| FigureOfBlocks::new(figures, figures.problem(), number, figures.figure(number)),
        ),
    }
}

keys! {
    /// A constraint that some figures miss.
    Refused(refused: (&str, usize)) {
        /// Its name.
        name: String = refused.0.into(),
        /// How many.
        figures: usize = refused.1,
    }
}

keys! {
    /// Which way things turn in the sketch.
    Senses(figures: &blocks::Figures, senses: &[Sense]) {
        /// What turns.
        names: Vec<String> = all(senses, |sense| sense.name.clone()),
        /// How many figures have all of these.
        kept: Option<u64> = figures.with_senses().map(|with| with.proved),
        /// Of how many that is not certain.
        undecided: Option<u64> = figures.with_senses().map(|with| with.undecided),
    }
}

keys! {
    /// A figure.
    FigureOfBlocks(figures: &blocks::Figures, problem: &Problem, number: u64, figure: (Vec<[Interval; 3]>, Vec<Located>)) {
        /// Its number, from 0 on.
        number: u64 = number,
        /// Of which solutions of blocks it is made.
        choices: Vec<Choice> = all(figures.chosen(number).iter(), |&(block, solution)| Choice::new(block, solution, None)),
        /// Its points.
        points: Points<Bounds> = points(problem, &figure.0),
        /// Its circles.
        radii: Named<Bounds> = numbers_of(problem, &figure.1, false, bounds),
        /// Which way things turn in it.
        senses: Option<SensesOf> = figures.senses().map(|senses| SensesOf::new(senses, &figures.compared(number))),
    } or nothing {
        /// The values of unknown numbers.
        unknowns: Named<Bounds> = numbers_of(problem, &figure.1, true, bounds),
        /// Bodies with joints, and joints.
        joints: Objects<Bounds> = At::joints(problem, &figure.1, bounds),
    }
}

keys! {
    /// A solution of a block.
    Choice(block: usize, solution: usize, mirrored: Option<bool>) {
        /// The block, from 0 on.
        block: usize = block,
        /// Which of its solutions.
        solution: usize = solution,
    } or nothing {
        /// Whether it is mirrored, where it may be.
        mirrored: Option<bool> = mirrored,
    }
}

keys! {
    /// How the senses of a figure stand to the sketch's.
    SensesOf(senses: &[Sense], compared: &[Comparison]) {
        /// Whether all are the same, if that is certain.
        as_in_sketch: Option<bool> = match compared.iter().any(|c| matches!(c, Comparison::Other | Comparison::Flat)) {
            true => Some(false),
            false if compared.contains(&Comparison::Undecided) => None,
            false => Some(true),
        },
        /// What turns the other way.
        other: Vec<String> = named(senses, compared, Comparison::Other),
        /// What is flat.
        flat: Vec<String> = named(senses, compared, Comparison::Flat),
        /// Of what it is not certain.
        undecided: Vec<String> = named(senses, compared, Comparison::Undecided),
    }
}

impl Document {
    /// The figures of a sketch (docs/using/programs.md, docs/schema/figures.schema.json).
    pub fn figures(figures: &blocks::Figures, listed: Listed) -> Document {
        let drawing = Drawing::new("solve", figures.problem());
        Document::of(drawing, Verb::Figures(Figures::new(figures, listed)))
    }
}
