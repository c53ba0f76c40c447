//! The page of a sketch that was solved block by block in its own frame.

use super::reader::{Reader, ShowError, choices, circles, list, strings, text, wrong};
use super::{Figure, Page, Text, Tone};
use crate::problem::{counted, list as listed};
use serde_json::Value;

pub(super) fn page(reader: &Reader) -> Result<Page, ShowError> {
    let result = reader.result;
    let mut page = reader.page("Sketch", "not a solution: drawn for comparison")?;
    page.rate(match text(result, "status")? {
        "complete" => ("proved · all there are", Tone::Proved),
        "combined" => ("each proved; complete as the verdict says", Tone::Proved),
        _ => ("each proved; there may be more", Tone::Stopped),
    });
    page.verdict = text(result, "verdict")?.to_owned();
    let figures = list(result, "figures")?;
    for found in figures {
        let number = found["number"].as_u64().ok_or(wrong("figures"))?;
        let chosen = choices(&found["choices"]).filter(|chosen| !chosen.is_empty());
        let how = [chosen, senses(&found["senses"])];
        let how: Vec<String> = how.into_iter().flatten().collect();
        page.figures.push(Figure {
            name: format!("Figure {}", number + 1),
            note: how.join("; "),
            class: Some(number as usize),
            ..reader.figure(&found["points"], &circles(&found["radii"]), "figures")?
        });
    }
    let blocks = list(result, "blocks")?;
    page.text = vec![Text::Paragraph(
        "The sketch's equations fall apart into blocks, which are solved in order, each with those that it needs where they \
         are. A block of linear equations, of one unknown, or of two as circles and lines make them is solved by formula; \
         the path of any other is followed. The box of each figure holds exactly one that meets all constraints, but for those that \
         the verdict says are left out."
            .into(),
    )];
    if !blocks.is_empty() {
        let all = blocks.iter().map(block).collect::<Option<Vec<String>>>();
        page.text.push(Text::List(all.ok_or(wrong("blocks"))?));
    }
    if let Some(reason) = result["reason"].as_str() {
        page.text
            .push(Text::Paragraph(format!("Why there may be more: {reason}.")));
    }
    let shown = figures.len();
    page.rows = vec![
        ("blocks".into(), blocks.len().to_string()),
        (
            "figures".into(),
            match result["count"].as_u64() {
                Some(count) if count == shown as u64 => count.to_string(),
                Some(count) => format!("{count}, {shown} of them here (`--all`: all)"),
                None => format!("more than 2^64, {shown} of them here"),
            },
        ),
    ];
    if let Some(kept) = result["senses"]["kept"].as_u64() {
        let label = "figures with all senses of the sketch".to_owned();
        page.rows.push((label, kept.to_string()));
    }
    let held = list(&result["account"], "held")?.iter();
    let free: Vec<&str> = held.filter_map(|held| held["what"].as_str()).collect();
    if !free.is_empty() {
        let label = "free, held as drawn".to_owned();
        page.rows.push((label, free.join(", ")));
    }
    Ok(page)
}

/// How the senses of a figure stand to the sketch's.
fn senses(senses: &Value) -> Option<String> {
    const MOST: usize = 4;
    let named = |key: &str, what: &str| -> Option<String> {
        let names = strings(&senses[key]);
        (!names.is_empty()).then(|| format!("{what}: {}", listed(&names, MOST)))
    };
    let all = [
        named("other", "turned the other way"),
        named("flat", "flat"),
        named("undecided", "not certain which way"),
    ];
    let all: Vec<String> = all.into_iter().flatten().collect();
    match senses["as_in_sketch"].as_bool() {
        Some(true) => Some("senses as in the sketch".to_owned()),
        _ => (!all.is_empty()).then(|| all.join("; ")),
    }
}

/// `x of d, y of d: by formula, 2 solutions`.
fn block(block: &Value) -> Option<String> {
    let unknowns = strings(&block["unknowns"]);
    let way = match block["way"].as_str()? {
        "formula" => "by formula".to_owned(),
        _ => format!("its path of {} tubes", block["tubes"]),
    };
    let (low, high) = (
        block["solutions"][0].as_u64()?,
        block["solutions"][1].as_u64()?,
    );
    let solutions = match low == high {
        true => counted(high as usize, "solution"),
        false => format!("{low} to {high} solutions"),
    };
    Some(format!("{}: {way}, {solutions}", unknowns.join(", ")))
}
