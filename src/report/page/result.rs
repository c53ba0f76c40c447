//! The page of a result, whichever verb it is of.

use super::reader::Reader;
use super::{Page, ShowError};
use super::{banded, complete, cut, edited, explored, motion, ranges, solved, swept};
use crate::report::document::{Document, Verb, wrong};
use serde_json::Value;

impl Page {
    /// The page of a result that a verb wrote with `--json`. With samples in it (`--samples`) there is a path to travel.
    pub fn from_json(text: &str) -> Result<Page, ShowError> {
        let value = serde_json::from_str::<Value>(text);
        let value = value.map_err(|error| ShowError::NotJson(error.to_string()))?;
        Self::of(&value.try_into()?)
    }

    /// The page of a result in memory.
    pub fn of(result: &Document) -> Result<Page, ShowError> {
        // Where the path of the whole stopped, of its blocks.
        if let Verb::Solve(run) = &result.own
            && let Some(by_blocks) = &run.by_blocks
        {
            return Self::of(by_blocks);
        }
        let reader = Reader::new(&result.drawing)?;
        let mut page = match &result.own {
            Verb::Solve(run) => match &run.blocks {
                Some(blocks) => solved::blocks(&reader, run, blocks),
                None => solved::page(&reader, run),
            },
            Verb::Figures(figures) => cut::page(&reader, figures),
            Verb::Edit(edit) => edited::page(&reader, edit),
            Verb::Motion(motion) => motion::page(&reader, motion),
            Verb::Tolerance(study) => banded::page(&reader, study),
            Verb::Tolerances(_) => Err(wrong("figure")),
            Verb::Sweep(sweep) => swept::page(&reader, sweep),
            Verb::Limits(limits) => ranges::page(&reader, limits),
            Verb::All(all) => complete::page(&reader, all),
            Verb::Explore(explored) => explored::page(&reader, explored),
        }?;
        let paths = page.paths.len();
        for figure in &mut page.figures {
            figure.path = figure.path.filter(|path| *path < paths);
        }
        page.turn_arcs();
        Ok(page)
    }
}
