//! The page of `limits`: the figures at both ends of every dimension's range.

use super::reader::{Reader, ShowError, digits, middle, pair, strings, text, wrong};
use super::{Figure, Page, Text, Tone};
use crate::blocks::rounded_up;
use crate::order::InOrder;
use serde_json::Value;

pub(super) fn page(reader: &Reader) -> Result<Page, ShowError> {
    let result = reader.result;
    let mut page = reader.page("In the file", "all dimensions as they are")?;
    page.verdict = "How far each dimension can go alone, all others standing still.".into();
    let moved = result["moved"].as_f64().ok_or(wrong("moved"))?;
    if moved > 0.0 {
        page.verdict += &format!(
            " The sketch was led to its own dimensions first, proved likewise: no point moved by more than {}.",
            rounded_up(moved)
        );
    }
    let ranges = result["ranges"].as_object().ok_or(wrong("ranges"))?;
    let mut ranges: Vec<(&String, &Value)> = ranges.iter().collect();
    // In the order of the file.
    ranges.order_by_key(|(_, range)| range["constraint"].as_u64());
    let mut all = true;
    let mut words = Vec::new();
    for (name, range) in ranges {
        let mut values = Vec::new();
        for (key, which) in [("low", "least"), ("high", "largest")] {
            let end = &range[key];
            let value = pair(&end["value"]).ok_or(wrong("ranges"))?;
            match text(end, "status")? {
                "limit" => values.push(digits(value)),
                "reached" => values.push(format!("{} and beyond", near(middle(value)))),
                _ => {
                    all = false;
                    values.push(format!("{} or beyond, not known", near(middle(value))));
                }
            }
            // Where no limit was met the figure is one of many.
            if text(end, "status")? != "limit" {
                continue;
            }
            words.push(format!(
                "{name}, the {which}, {}: {}",
                digits(value),
                text(end, "words")?
            ));
            page.figures.push(Figure {
                name: format!("{name} = {}", near(middle(value))),
                note: format!(
                    "the {which} that it can be{}",
                    special(reader, &end["flat"])
                ),
                // No two of them are congruent.
                class: Some(page.figures.len() - 1),
                ..reader.figure(&end["points"], &Value::Null, "ranges")?
            });
        }
        let value = pair(&range["value"]).ok_or(wrong("ranges"))?;
        page.rows.push((
            name.clone(),
            format!("is {}; from {}", digits(value), values.join(" to ")),
        ));
    }
    page.rate(match all {
        true => ("proved", Tone::Proved),
        false => ("proved in part", Tone::Stopped),
    });
    page.text = vec![Text::Paragraph(
        "Each dimension was moved alone, both ways, with proof: between the figure of the file and a limit there is \
         exactly one figure for every value, and beyond the limit it has no continuation. At a limit the figure can \
         move for an instant with all dimensions as they are."
            .into(),
    )];
    if !words.is_empty() {
        page.text.push(Text::List(words));
    }
    Ok(page)
}

/// A number of a few digits, to be read and not to be relied on.
fn near(x: f64) -> String {
    format!("{}", format!("{x:.5e}").parse::<f64>().unwrap_or(x))
}

/// What is special about the figure at a limit, in few words.
fn special(reader: &Reader, flat: &Value) -> String {
    if !flat[0].is_array() {
        return String::new();
    }
    let names = strings(&flat[0]);
    let place = match reader.dimension {
        2 => "on one line",
        _ => "in one plane",
    };
    let more = match flat[1].is_array() {
        true => ", and others",
        false => "",
    };
    format!("; {} {place}{more}", names.join(", "))
}
