//! The page of an edit: the figure before and after.

use super::reader::{Reader, circles, digits, middle, shown};
use super::{Figure, Page, ShowError, Tone};
use crate::report::document::Edit;
use crate::report::edit::behind;

pub(super) fn page(reader: &Reader, edit: &Edit) -> Result<Page, ShowError> {
    let mut page = reader.page("Before", "the figure in the file")?;
    let (name, badge, tone) = match &edit.status[..] {
        "reached" => ("After", "proved", Tone::Proved),
        "limit" => ("At the limit", "limit, proved", Tone::Proved),
        _ => ("", "stopped", Tone::Stopped),
    };
    page.rate((badge, tone));
    page.verdict = edit.words.clone();
    let scope = behind(" ", edit.account.scope());
    let so = match scope.is_empty() {
        true => "",
        false => " so",
    };
    for (name, value) in &edit.dimensions.0 {
        // Other dimensions than distances have no bar to stand on.
        let ends = reader.ends_of(name);
        for bar in page.bars.iter_mut().filter(|bar| Some(bar.ends) == ends) {
            bar.target = Some(middle(*value));
            bar.label = digits(*value).chars().take(8).collect();
        }
    }
    // What is drawn beside the figure in the file is that too where the new values were not reached.
    if !name.is_empty() {
        let new = |name: &str| Some(shown(&digits(*edit.dimensions.get(name)?)));
        let radii = edit.radii.clone().unwrap_or_default();
        page.labels = reader.labels(new);
        page.figures.push(Figure {
            name: name.into(),
            note: format!("the one and only continuation{scope}"),
            class: Some(0),
            ..reader.figure(&edit.points, &circles(&radii))?
        });
    }
    page.say(match &edit.status[..] {
        "reached" => format!(
            "The dimensions were led from the old values to the new ones together, with proof: all the way there is \
             exactly one figure that continues the old one{scope}, and none of them is singular. So it cannot have \
             flipped into another figure with the same dimensions."
        ),
        "limit" => format!(
            "The dimensions were led towards the new values, with proof: up to the figure shown there is exactly \
             one that continues the old one{scope}, and beyond it there is none{so}. There it can move for an instant with \
             all its dimensions as they are{so}."
        ),
        _ => {
            "The new values were not reached, so the figure stays what it was. What is said above is as far as \
             the proof got."
                .to_owned()
        }
    });
    if let Some(signs) = &edit.signs {
        page.row("signs asked for", signs.clone());
    }
    page.row("orientations kept, proved", edit.kept.len());
    page.row("not proved to be kept", edit.lost.len());
    page.row("tubes", edit.tubes);
    page.row("seconds", format!("{:.6}", edit.seconds));
    Ok(page)
}
