//! The page of a result, from its JSON: whichever verb wrote it.

use super::reader::{Reader, ShowError, wrong};
use super::{Page, banded, complete, cut, edited, explored, motion, ranges, solved, swept};
use serde_json::Value;

impl Page {
    /// The page of a result that a verb wrote with `--json`. With samples in it (`--samples`) there is a path to travel.
    pub fn from_json(text: &str) -> Result<Page, ShowError> {
        let value = serde_json::from_str::<Value>(text);
        Self::from_result(&value.map_err(|error| ShowError::NotJson(error.to_string()))?)
    }

    /// The page of a result in memory.
    pub fn from_result(result: &Value) -> Result<Page, ShowError> {
        let version = result["version"].as_u64().ok_or(wrong("version"))?;
        if version != u64::from(crate::report::JSON_VERSION) {
            return Err(ShowError::Version(version, crate::report::JSON_VERSION));
        }
        let reader = || Reader::new(result);
        // Results of `solve` were the only ones that could be shown before there was this key.
        let verb = &result["verb"];
        let verb = verb.as_str().or(verb.is_null().then_some("solve"));
        let mut page = match verb {
            Some("solve") if result["blocks"].is_object() => solved::blocks(&reader()?),
            // A sketch in its own frame, block by block: from the start, or where the path of the whole stopped.
            Some("solve") if result["blocks"].is_array() => cut::page(&reader()?),
            Some("solve") if result["by_blocks"]["verb"].is_string() => {
                cut::page(&Reader::new(&result["by_blocks"])?)
            }
            Some("solve") => solved::page(&reader()?),
            Some("edit") => edited::page(&reader()?),
            Some("motion") => motion::page(&reader()?),
            Some("tolerance") => banded::page(&reader()?),
            Some("sweep") => swept::page(&reader()?),
            Some("limits") => ranges::page(&reader()?),
            Some("all") => complete::page(&reader()?),
            Some("explore") => explored::page(&reader()?),
            Some("complex") => Err(ShowError::NoFigure(
                "complex",
                "its coordinates are complex numbers; `krawl all` or `krawl explore` with `--html` show real figures",
            )),
            Some("compare") => Err(ShowError::NoFigure(
                "compare",
                "it sets runs beside each other; `krawl compare --output DIR` draws them",
            )),
            _ => Err(wrong("verb")),
        }?;
        let paths = page.paths.len();
        for figure in &mut page.figures {
            figure.path = figure.path.filter(|path| *path < paths);
        }
        page.turn_arcs();
        Ok(page)
    }
}
