//! The page of `explore`: every solution found, with the path that found it first.

use super::reader::{Reader, ShowError, list, text, wrong};
use super::{Figure, Page, Text, Tone, path};
use serde_json::Value;
use std::collections::BTreeMap;

pub(super) fn page(reader: &Reader) -> Result<Page, ShowError> {
    let result = reader.result;
    let note = "of the problem; solutions have been found from others too";
    let mut page = reader.page("Sketch", note)?;
    let solutions = list(result, "solutions")?;
    // Paths that are drawn, in the order in which solutions ask for them.
    let mut drawn: BTreeMap<u64, usize> = BTreeMap::new();
    let mut widths: Vec<Option<f64>> = vec![None];
    for (k, solution) in solutions.iter().enumerate() {
        let id = solution["path"].as_u64().ok_or(wrong("solutions"))?;
        let found = &result["paths"][&id.to_string()];
        let from = origin(found);
        if !drawn.contains_key(&id)
            && let Some(mut read) = path::read(reader, found)?
        {
            read.name = format!("path {id}, from {from}");
            read.has_own_sketch = true;
            drawn.insert(id, page.paths.len());
            page.paths.push(read);
        }
        let on = drawn.get(&id).copied();
        let bend = match (found["bend"].as_str(), found["bend_coefficient"].as_str()) {
            (Some(bend), Some(c)) => format!(", {bend} bent by {c}"),
            _ => String::new(),
        };
        let flat = match solution["flat"].as_bool() {
            Some(true) => "; flat",
            _ => "",
        };
        page.figures.push(Figure {
            name: format!("Solution {}", k + 1),
            note: format!("on path {id}, from {from}{bend}{flat}"),
            class: Some(k),
            path: on,
            at: solution["arc"].as_f64().filter(|_| on.is_some()),
            t: on.map(|_| 1.0),
            folds: solution["folds"].as_u64().map(|n| n as usize),
            ..reader.figure(&solution["points"], &Value::Null, "solutions")?
        });
        widths.push(path::width(reader, &solution["points"]));
    }
    for path in &mut page.paths {
        if let Some(accuracy) = &mut path.accuracy {
            accuracy.figures.clone_from(&widths);
        }
    }
    let all = result["all_real"].as_u64() == Some(solutions.len() as u64);
    page.rate(match all {
        true => ("proved · all there are", Tone::Proved),
        false => ("each proved; there may be more", Tone::Observed),
    });
    page.verdict = text(result, "verdict")?.to_owned();
    page.text = vec![
        Text::Paragraph(
            "From every solution found, the branches of a construction plan give new sketches, and the path through each \
             was followed with proof. A solution of the list lies within the digits shown, alone, and no two are \
             congruent. The path is the one that found the solution first."
                .into(),
        ),
        Text::Paragraph(match page.paths.is_empty() {
            true => "Paths are drawn where they are asked for: `krawl explore` with `--html`, or `--json` with \
                     `--samples N`."
                .into(),
            false => "The pictures are drawn from the tubes that were proved; they are pictures, the digits are the \
                      result."
                .into(),
        }),
    ];
    let counts = &result["counts"];
    page.rows = [
        ("paths followed", &counts["followed"]),
        ("of these closed", &counts["closed"]),
        ("stopped", &counts["stopped"]),
        ("sketches that wait", &counts["waiting"]),
        ("tubes", &counts["tubes"]),
        (
            "ways (plan, length that bends, coefficient)",
            &result["ways"],
        ),
        ("real solutions, proved to be all", &result["all_real"]),
    ]
    .into_iter()
    .filter(|(_, value)| !value.is_null())
    .map(|(label, value)| (label.to_owned(), value.to_string()))
    .collect();
    Ok(page)
}

/// Where the sketch of a path comes from, in words.
fn origin(path: &Value) -> String {
    let from = &path["from"];
    match (from["solution"].as_u64(), from["branch"].as_u64()) {
        (Some(solution), Some(branch)) => format!("solution {}, branch {branch}", solution + 1),
        _ => "the drawn sketch".to_owned(),
    }
}
