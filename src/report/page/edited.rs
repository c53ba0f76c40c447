//! The page of an edit: the figure before and after.

use super::reader::{Reader, ShowError, circles, digits, list, middle, pair, shown, text, wrong};
use super::{Figure, Page, Text, Tone};

pub(super) fn page(reader: &Reader) -> Result<Page, ShowError> {
    let result = reader.result;
    let mut page = reader.page("Before", "the figure in the file")?;
    let status = text(result, "status")?;
    let (name, badge, tone) = match status {
        "reached" => ("After", "proved", Tone::Proved),
        "limit" => ("At the limit", "limit, proved", Tone::Proved),
        _ => ("", "stopped", Tone::Stopped),
    };
    page.rate((badge, tone));
    page.verdict = text(result, "words")?.to_owned();
    let dimensions = result["dimensions"].as_object();
    for (name, value) in dimensions.ok_or(wrong("dimensions"))? {
        let value = pair(value).ok_or(wrong("dimensions"))?;
        // Other dimensions than distances have no bar to stand on.
        let ends = reader.ends_of(name);
        for bar in page.bars.iter_mut().filter(|bar| Some(bar.ends) == ends) {
            bar.target = Some(middle(value));
            bar.label = digits(value).chars().take(8).collect();
        }
    }
    // What is drawn beside the figure in the file is that too where the new values were not reached.
    if !name.is_empty() {
        let new = |name: &str| Some(shown(&digits(pair(&result["dimensions"][name])?)));
        page.labels = reader.labels(new);
        page.figures.push(Figure {
            name: name.into(),
            note: "the one and only continuation".into(),
            class: Some(0),
            ..reader.figure(&result["points"], &circles(&result["radii"]), "points")?
        });
    }
    page.text = vec![Text::Paragraph(
        match status {
            "reached" => {
                "The dimensions were led from the old values to the new ones together, with proof: all the way there is \
                 exactly one figure that continues the old one, and none of them is singular. So it cannot have \
                 flipped into another figure with the same dimensions."
            }
            "limit" => {
                "The dimensions were led towards the new values, with proof: up to the figure shown there is exactly \
                 one that continues the old one, and beyond it there is none. There it can move for an instant with \
                 all its dimensions as they are."
            }
            _ => {
                "The new values were not reached, so the figure stays what it was. What is said above is as far as \
                 the proof got."
            }
        }
        .to_owned(),
    )];
    let count = |key, what: &str| -> Result<(String, String), ShowError> {
        Ok((what.to_owned(), list(result, key)?.len().to_string()))
    };
    page.rows = vec![
        count("kept", "orientations kept, proved")?,
        count("lost", "not proved to be kept")?,
        ("tubes".into(), result["tubes"].to_string()),
        (
            "seconds".into(),
            format!("{:.6}", result["seconds"].as_f64().unwrap_or(0.0)),
        ),
    ];
    Ok(page)
}
