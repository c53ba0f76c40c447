//! The page of a result of `solve`: the path through the sketch, and the solutions on it; or what came of blocks.

use super::reader::{Reader, ShowError, choices, list, strings, text, wrong};
use super::{Figure, Page, Text, Tone, path};
use serde_json::Value;

pub(super) fn page(reader: &Reader) -> Result<Page, ShowError> {
    let result = reader.result;
    let mut page = reader.page("Sketch", "where the path begins, t = 0")?;
    let mode = text(result, "mode")?;
    let closed = text(result, "status")? == "closed";
    let open = text(result, "status")? == "open";
    page.rate(match (mode, closed) {
        ("certified", false) if open => ("proved · between the ends of the path", Tone::Proved),
        ("certified", true) => ("proved · complete for this path", Tone::Proved),
        (_, true) => ("observed, not proved", Tone::Observed),
        (_, false) if open => (
            "observed between the ends of the path, not proved",
            Tone::Observed,
        ),
        (_, false) => ("stopped", Tone::Stopped),
    });
    page.verdict = text(result, "verdict")?.to_owned();
    page.paths.extend(path::read(reader, result)?);
    let sketch = &mut page.figures[0];
    (sketch.path, sketch.at, sketch.t) = (Some(0), Some(0.0), Some(0.0));
    let solutions = list(result, "solutions")?;
    for (k, found) in solutions.iter().enumerate() {
        page.figures
            .push(solution(reader, k, found).ok_or(wrong("solutions"))?);
    }
    if let Some(accuracy) = page.paths.iter_mut().find_map(|p| p.accuracy.as_mut()) {
        let widths = solutions.iter().map(|s| path::width(reader, &s["points"]));
        accuracy.figures = std::iter::once(None).chain(widths).collect();
    }
    page.text = words(mode, closed, open, reader);
    if mode != "certified" {
        page.digits = reader.gauge();
    }
    page.rows = rows(result);
    Ok(page)
}

/// Figures of the whole that are made of solutions of its blocks.
pub(super) fn blocks(reader: &Reader) -> Result<Page, ShowError> {
    let blocks = &reader.result["blocks"];
    let mut page = reader.page("Sketch", "not a solution: drawn for comparison")?;
    page.rate(match blocks["proved"].as_bool() {
        Some(true) => (
            "proved · complete for the paths of the blocks",
            Tone::Proved,
        ),
        _ => ("proved in part", Tone::Stopped),
    });
    page.verdict = text(blocks, "verdict")?.to_owned();
    let runs = list(blocks, "runs")?;
    let mut listed = 0;
    for (k, combined) in list(blocks, "figures")?.iter().enumerate() {
        listed += 1;
        // Where its boxes are too wide there is nothing to draw.
        if combined["points"].is_null() {
            continue;
        }
        page.figures.push(Figure {
            name: format!("Figure {}", k + 1),
            note: choices(&combined["choices"]).ok_or(wrong("blocks"))?,
            class: Some(k),
            ..reader.figure(&combined["points"], &Value::Null, "blocks")?
        });
    }
    page.text = vec![
        Text::Paragraph(
            "The problem falls apart into blocks that share no more than a side (in space: a triangle of sides). As a \
             whole it could not be followed to the end, so the path of each block was, and the solutions of the blocks are \
             put together in every way, as they are or mirrored in the side by which they hang together."
                .into(),
        ),
        Text::List(
            runs.iter()
                .map(|run| {
                    let named = strings(&run["names"]).join(", ");
                    Ok(format!("{named}: {}", text(run, "verdict")?))
                })
                .collect::<Result<_, ShowError>>()?,
        ),
    ];
    if let Some(reason) = reader.result["reason"].as_str() {
        page.text
            .push(Text::Paragraph(format!("Why the whole stopped: {reason}.")));
    }
    let shown = page.figures.len() - 1;
    page.rows = vec![
        ("blocks".into(), runs.len().to_string()),
        (
            "figures".into(),
            match blocks["count"].as_u64() {
                Some(count) if count > listed => {
                    format!("{count}, the first {shown} of them here (`--all`: all)")
                }
                Some(count) => count.to_string(),
                None => format!("more than 2^64, the first {shown} of them here"),
            },
        ),
    ];
    Ok(page)
}

fn solution(reader: &Reader, k: usize, solution: &Value) -> Option<Figure> {
    let class = solution["class"].as_u64()? as usize;
    let folds = solution["folds"].as_u64().map(|n| n as usize);
    let mut note = match folds {
        Some(0) => "reached without a fold".to_owned(),
        Some(1) => "after a fold".to_owned(),
        Some(n) => format!("after {n} folds"),
        None => format!("class {class}"),
    };
    if let Some(other) = solution["mirror_of"].as_u64() {
        note += &format!(", mirror image of {}", other + 1);
    }
    if solution["degenerate"].as_bool() == Some(true) {
        note += ", degenerate (flat)";
    }
    Some(Figure {
        name: format!("Solution {}", k + 1),
        note,
        class: Some(class),
        path: Some(0),
        at: solution["arc"].as_f64(),
        t: Some(1.0),
        folds,
        ..reader
            .figure(&solution["points"], &solution["objects"], "solutions")
            .ok()?
    })
}

fn rows(result: &Value) -> Vec<(String, String)> {
    let mut rows = Vec::new();
    let mut row = |label: &str, value: String| rows.push((label.to_owned(), value));
    let plain = |value: &Value| match value {
        Value::String(text) => text.clone(),
        other => other.to_string(),
    };
    let rounded = |value: &Value| value.as_f64().map_or("?".into(), |x| format!("{x:.6}"));
    row(
        "mode, space",
        format!("{}, {}", plain(&result["mode"]), plain(&result["space"])),
    );
    row(
        "steps, rejected",
        format!("{}, {}", result["steps"], result["rejected"]),
    );
    row("length of the path", rounded(&result["length"]));
    let range = &result["t_range"];
    row(
        "range of t",
        format!("{} to {}", rounded(&range[0]), rounded(&range[1])),
    );
    row("seconds", rounded(&result["seconds"]));
    let options = &result["options"];
    if !options["bend"].is_null() {
        let bend = [0, 1].map(|k| plain(&options["bend"][k])).join("-");
        let c = plain(&options["bend_coefficient"]);
        row("bend", format!("{bend}, c = {c}"));
    }
    for text in result["switched_on"].as_array().into_iter().flatten() {
        row("switched on", plain(text));
    }
    row("written by", format!("krawl {}", plain(&result["krawl"])));
    if let Some(source) = result["source"].as_str() {
        row("source", source.to_owned());
    }
    rows
}

/// The answer explained.
fn words(mode: &str, closed: bool, open: bool, reader: &Reader) -> Vec<Text> {
    let paragraph = |text: &str| Text::Paragraph(text.to_owned());
    let mut out = vec![paragraph(
        "The sketch's dimensions are led to the wanted ones together: t = 0 is the sketch, and at t = 1 all \
         dimensions are what they should be. As they change the figure moves along a path; wherever that \
         path meets t = 1 there is a solution. Solutions of one colour are congruent: the same figure, or \
         its mirror image.",
    )];
    let solutions = reader.result["solutions"].as_array();
    let mut solutions = solutions.into_iter().flatten();
    let is_flat = solutions.any(|solution| solution["degenerate"].as_bool() == Some(true));
    match (mode, closed) {
        ("certified", true) => {
            out.push(paragraph(
                "What is proved, for the exact decimals of the problem and with every rounding accounted for:",
            ));
            out.push(Text::List(vec![
                "The path through the sketch is a closed curve, regular along its whole length, and it was \
                 followed all the way round: no step jumped to another curve."
                    .into(),
                "The solutions listed are exactly the points of that path with t = 1: none is missing and \
                 none is there twice. Each lies within the digits shown, alone."
                    .into(),
                "All lengths stay positive along the path.".into(),
            ]));
            out.push(paragraph(
                "Other solutions may exist on other paths. The pictures are drawn from the tubes that were \
                 proved; they are pictures, the digits are the result.",
            ));
        }
        ("certified", false) if open => out.push(paragraph(
            "The path seems to have two ends, beyond which it was not followed. What is proved is about the arc between them: it is \
             regular, no step jumped, and the solutions listed are exactly those on it, each alone within the digits shown.",
        )),
        ("certified", false) => out.push(paragraph(
            "The run stopped before it came back to the sketch. The solutions listed are proved, each alone \
             within the digits shown; there may be more on the rest of the path.",
        )),
        _ => out.push(paragraph(
            "This run was made in floating-point arithmetic: what it says is observed, not proved.",
        )),
    }
    if is_flat && mode == "certified" {
        out.push(paragraph(
            "This is different at solutions that are degenerate (flat): there the path is regular in the equations with heights \
             divided by 1 − t, not in the given ones, and other flat figures that meet the constraints are as near as one likes. On \
             the path are only those listed.",
        ));
    }
    if let Some(reason) = reader.result["reason"].as_str() {
        out.push(Text::Paragraph(format!("Why it stopped: {reason}.")));
    }
    out
}
