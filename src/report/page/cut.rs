//! The page of a sketch that was solved block by block in its own frame.

use super::reader::{Reader, choices, circles};
use super::{Figure, Page, ShowError, Text, Tone};
use crate::blocks::BlockAccount;
use crate::problem::list as listed;
use crate::report::document::{Figures, SensesOf};
use crate::report::figures::solved_in_words;

pub(super) fn page(reader: &Reader, result: &Figures) -> Result<Page, ShowError> {
    let mut page = reader.page("Sketch", "not a solution: drawn for comparison")?;
    page.rate(match &result.status[..] {
        "complete" => ("proved · all there are", Tone::Proved),
        "combined" => ("each proved; complete as the verdict says", Tone::Proved),
        _ => ("each proved; there may be more", Tone::Stopped),
    });
    page.verdict = result.verdict.clone();
    for found in &result.figures {
        let number = found.number;
        let chosen = Some(choices(&found.choices)).filter(|chosen| !chosen.is_empty());
        let how = [chosen, found.senses.as_ref().and_then(senses)];
        let how: Vec<String> = how.into_iter().flatten().collect();
        page.figures.push(Figure {
            name: format!("Figure {}", number + 1),
            note: how.join("; "),
            class: Some(number as usize),
            ..reader.figure(&found.points, &circles(&found.radii))?
        });
    }
    let blocks = &result.blocks;
    page.say(
        "The sketch's equations fall apart into blocks, which are solved in order, each with those that it needs where they \
         are. A block of linear equations, of one unknown, or of two as circles and lines make them is solved by formula; \
         the path of any other is followed. The box of each figure holds exactly one that meets all constraints, but for those that \
         the verdict says are left out.",
    );
    if !blocks.is_empty() {
        let blocks = blocks.iter().map(block);
        page.text.push(Text::List(blocks.collect()));
    }
    if let Some(reason) = &result.reason {
        page.say(format!("Why there may be more: {reason}."));
    }
    let shown = result.figures.len();
    page.row("blocks", blocks.len());
    let figures = match result.count {
        Some(count) if count == shown as u64 => count.to_string(),
        Some(count) => format!("{count}, {shown} of them here (`--all`: all)"),
        None => format!("more than 2^64, {shown} of them here"),
    };
    page.row("figures", figures);
    if let Some(kept) = result.senses.as_ref().and_then(|senses| senses.kept) {
        page.row("figures with all senses of the sketch", kept);
    }
    let free = result.account.names_held();
    if !free.is_empty() {
        page.row("free, held as drawn", free.join(", "));
    }
    Ok(page)
}

/// How the senses of a figure stand to the sketch's.
fn senses(senses: &SensesOf) -> Option<String> {
    const MOST: usize = 4;
    let named = |names: &[String], what: &str| -> Option<String> {
        (!names.is_empty()).then(|| format!("{what}: {}", listed(names, MOST)))
    };
    let all = [
        named(&senses.other, "turned the other way"),
        named(&senses.flat, "flat"),
        named(&senses.undecided, "not certain which way"),
    ];
    let all: Vec<String> = all.into_iter().flatten().collect();
    match senses.as_in_sketch {
        Some(true) => Some("senses as in the sketch".to_owned()),
        _ => (!all.is_empty()).then(|| all.join("; ")),
    }
}

/// `x of d, y of d: by formula, 2 solutions`.
fn block(block: &BlockAccount) -> String {
    format!("{}: {}", block.unknowns.join(", "), solved_in_words(block))
}
