//! The figures of a sketch in its own frame, as its blocks give them.

use super::columns::DIGITS;
use super::document::SensesOf;
use super::edit::{behind, write_numbers, write_points};
use super::supposed::{signs_not_looked_at, supposed};
use crate::blocks::{BlockAccount, Comparison, Figures, First, Sense, Way};
use crate::problem::{Shape, counted, list};

/// Figures that are listed in a table: as long as they fit in so many lines.
const LINES: u64 = 60;
/// Names that are listed before "and n more".
const LISTED: usize = 8;
/// Figures that are listed in JSON where not all are asked for.
pub(super) const IN_JSON: u64 = 100;
/// Figures that are listed, in a table or in JSON, where all are asked for.
const MOST: u64 = 1_000_000;

/// Which figures are listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Listed {
    /// The first ones.
    Some,
    /// All, as far as that can be.
    All,
    /// That of this number alone.
    Only(u64),
}

impl Listed {
    /// All where they are asked for, or the first ones.
    pub fn of(all: bool) -> Self {
        match all {
            true => Listed::All,
            false => Listed::Some,
        }
    }

    /// The numbers of those listed, of so many, the first `some` where not all are asked for.
    pub(super) fn numbers(self, count: u64, some: u64) -> std::ops::Range<u64> {
        match self {
            Listed::Some => 0..count.min(some),
            Listed::All => 0..count.min(MOST),
            Listed::Only(number) => number..number + 1,
        }
    }

    /// The numbers of those that a table lists, of so many that take so many lines each.
    pub(super) fn in_table(self, count: u64, each: u64) -> std::ops::Range<u64> {
        let some = match count.saturating_mul(each) <= LINES {
            true => count,
            false => (LINES / 2 / each).max(1),
        };
        self.numbers(count, some)
    }
}

/// What is said below the figures of a table, of which so many are there and those up to `end` are listed.
pub(super) fn write_more(out: &mut String, count: u64, end: u64) {
    if count > end {
        *out += &format!(
            "\n... and {} more: `--all` prints them, `--json FILE` writes the first {IN_JSON} (with `--all` all).\n",
            count - end
        );
    }
    match count {
        0 => {}
        _ => *out += &format!("\n{DIGITS}\n"),
    }
}

/// What is proved of the figures of a sketch, in a sentence or two.
pub fn figures_in_words(figures: &Figures) -> String {
    match figures.singular() {
        Some(singular) => format!("{} {}", claim_in_words(figures), singular.in_words()),
        None => claim_in_words(figures),
    }
}

/// What is proved, without what is said of the drawing.
fn claim_in_words(figures: &Figures) -> String {
    let doubt = figures.doubt();
    let number = match figures.count() {
        Some(0) => return none_in_words(figures, doubt) + &supposed(figures.problem()),
        Some(1) => "1 figure meets".to_owned(),
        Some(n) => format!("{n} figures meet"),
        None => "more than 2^64 figures meet".to_owned(),
    };
    let all = match figures.meets_all() {
        true if !figures.account().left_as_is.is_empty() => "all constraints that are read",
        true => "all constraints",
        false => "all constraints but those named below",
    };
    let mut out = match (&doubt, figures.has_paths()) {
        (None, false) if figures.meets_all() => {
            format!("Complete, proved: {number} {all}, and there is no other")
        }
        (None, false) => format!("Combined, proved: {number} {all}, and no other does"),
        (None, true) => format!(
            "Combined, proved: {number} {all}, and there is no other whose numbers in {} are on the \
             paths of these through the sketch",
            followed(figures)
        ),
        (Some(doubt), _) => format!(
            "Combined: {number} {all}, proved; there may be more ({})",
            doubt.trim_end_matches('.')
        ),
    };
    out += &provided(figures);
    out.push('.');
    out += &supposed(figures.problem());
    out += signs_not_looked_at(figures.problem());
    out += &senses_in_words(figures);
    let left_out = figures.account().left_out_in_words();
    if !left_out.is_empty() {
        out += &format!(" {left_out}.");
    }
    out
}

/// How many of the figures have all senses of the sketch, in a sentence.
fn senses_in_words(figures: &Figures) -> String {
    let Some(senses) = figures.senses() else {
        return " Which of them have the senses of the sketch is not told: there are too many to look at.".to_owned();
    };
    if senses.is_empty() {
        return String::new();
    }
    let Some(with) = figures.with_senses() else {
        return " How many of them have all senses of the sketch was not counted: there are too many.".to_owned();
    };
    let all =
        "all senses of the sketch (angles, parallels, tangents and joined points turn as there)";
    match (figures.count(), with.proved, with.undecided) {
        (Some(1), 1, _) => format!(" It has {all}, proved."),
        (Some(1), _, 0) => format!(" It has not {all}, proved."),
        (Some(1), ..) => format!(" Whether it has {all} is not certain."),
        (_, n, undecided) => {
            let number = match n {
                0 if undecided > 0 => {
                    return format!(
                        " None of them is proved to have {all}; of {undecided} it is not certain."
                    );
                }
                0 => "None of them has".to_owned(),
                1 => "1 of them has".to_owned(),
                n => format!("{n} of them have"),
            };
            let rest = match undecided {
                0 => ", proved".to_owned(),
                n => format!(", proved; of {n} more that is not certain"),
            };
            format!(" {number} {all}{rest}.")
        }
    }
}

/// What is taken as the sketch has it, in brackets.
fn provided(figures: &Figures) -> String {
    let mut with = Vec::new();
    let held = figures.account().names_held();
    match held.len() {
        0 => {}
        1 => with.push(format!("{} held where it is drawn", held[0])),
        _ => with.push(format!("{} held where they are drawn", list(&held, LISTED))),
    }
    let kept = figures.account().kept_in_words();
    if let Some(kept) = kept.strip_prefix("with ") {
        with.push(kept.to_owned());
    }
    if figures.keeps_directions() {
        with.push("distances along an axis, and lengths of lines along one, in the direction that they have in the sketch".to_owned());
    }
    if figures.has_cases() {
        with.push("points on the side of lines and circles where the sketch has them, angles and tangents whichever way they turn".to_owned());
    }
    match with.is_empty() {
        true => String::new(),
        false => format!(" (with {})", with.join(", and ")),
    }
}

/// What is said of a sketch for which no figure was found, in a sentence or two; `doubt`: why the search stopped.
fn none_in_words(figures: &Figures, doubt: Option<String>) -> String {
    if let Some(doubt) = doubt {
        return format!("Stopped: no figure was proved: {doubt}");
    }
    let refused = figures.refused().next();
    let what = match (figures.impossible(), refused) {
        (Some(block), _) => {
            format!("block {block} has no solution where the blocks before it are")
        }
        (None, Some((name, _))) => {
            format!("{name} does not hold in any figure of the others")
        }
        (None, None) => "the blocks have no figure in common".to_owned(),
    };
    let paths = match figures.has_paths() {
        true => format!(
            ", as far as numbers in {} are on the paths of these through the sketch",
            followed(figures)
        ),
        false => String::new(),
    };
    // At a singular drawing what was left out need not be what is one too many.
    if figures.singular().is_some() && !figures.account().left_out.is_empty() {
        return format!(
            "Stopped: no figure was found, and nothing is said of whether there is one: {what}{paths}{}, but the drawing is \
             singular (`krawl all` looks for all figures).",
            provided(figures)
        );
    }
    format!("None, proved: {what}{paths}{}.", provided(figures))
}

/// `block 2` or `blocks 2 and 5`.
fn followed(figures: &Figures) -> String {
    let blocks = figures.blocks().enumerate();
    let numbers: Vec<String> = blocks
        .filter(|(_, account)| account.way == Way::Path)
        .map(|(k, _)| (k + 1).to_string())
        .collect();
    match numbers.split_last() {
        Some((only, [])) => format!("block {only}"),
        Some((last, before)) => format!("blocks {} and {last}", before.join(", ")),
        None => String::new(),
    }
}

/// The figures as a text of several lines, the first ones or all.
pub fn figures_to_table(figures: &Figures, listed: Listed) -> String {
    let mut out = figures_to_summary(figures);
    write_figures(&mut out, figures, listed);
    write_blocks(&mut out, figures);
    out
}

/// What is said of the figure nearest to the sketch of those with all its senses, or that there is none.
pub fn first_in_words(figures: &Figures, first: First) -> String {
    let name = &figures.problem().name;
    match first {
        First::Figure { number, is_nearest } => {
            let nearest = match is_nearest {
                true => "of the figures listed it is the nearest to the sketch of which that is so",
                false => "others of which that is so are about as near to the sketch",
            };
            format!(
                "{name}: figure {} has all senses of the sketch (angles, parallels, tangents and joined points turn as \
                 there), proved; {nearest}.\n",
                number + 1
            )
        }
        First::None { is_proved: true } => {
            format!("{name}: no figure that was found has all senses of the sketch, proved.\n")
        }
        First::None { is_proved: false } => {
            format!("{name}: no figure is proved to have all senses of the sketch.\n")
        }
        First::TooMany => format!(
            "{name}: there are too many figures to look for the nearest one with all senses of the sketch.\n"
        ),
    }
}

/// One line for a sketch.
pub fn figures_to_summary(figures: &Figures) -> String {
    format!(
        "{}: {}\n",
        figures.problem().name,
        figures_in_words(figures)
    )
}

fn write_figures(out: &mut String, figures: &Figures, listed: Listed) {
    let problem = figures.problem();
    let count = figures.count().unwrap_or(u64::MAX);
    let circles = problem.objects.iter();
    let circles = circles.filter(|o| {
        matches!(
            o.shape,
            Shape::Round { .. }
                | Shape::Number { .. }
                | Shape::Joint { .. }
                | Shape::Body { place: Some(_), .. }
        )
    });
    let each = (problem.points.len() + circles.count()) as u64 + 2;
    let numbers = listed.in_table(count, each);
    for number in numbers.clone() {
        let chosen = figures.chosen(number);
        let chosen = chosen_in_words(chosen.iter().map(|&(b, s)| (b, s, false)));
        *out += &format!("\nFigure {}{}\n", number + 1, behind(": ", chosen));
        write_senses(out, figures, number);
        let (points, objects) = figures.figure(number);
        write_points(out, problem, &points);
        write_numbers(out, problem, &objects);
    }
    let end = match listed {
        Listed::Only(_) => count,
        _ => numbers.end,
    };
    write_more(out, count, end)
}

/// The names of the senses of a figure that stand to the sketch's in some way, each once.
pub(super) fn named(senses: &[Sense], compared: &[Comparison], how: Comparison) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    for (sense, _) in senses.iter().zip(compared).filter(|(_, c)| **c == how) {
        if !out.contains(&sense.name) {
            out.push(sense.name.clone());
        }
    }
    out
}

fn write_senses(out: &mut String, figures: &Figures, number: u64) {
    let Some(senses @ [_, ..]) = figures.senses() else {
        return;
    };
    let told = SensesOf::new(senses, &figures.compared(number));
    if told.as_in_sketch == Some(true) {
        *out += "  senses as in the sketch\n";
        return;
    }
    for (names, what) in [
        (&told.other, "turned the other way"),
        (&told.flat, "flat, without a sense"),
        (&told.undecided, "not certain which way"),
    ] {
        if !names.is_empty() {
            *out += &format!("  {what}: {}\n", list(names, LISTED));
        }
    }
}

fn write_blocks(out: &mut String, figures: &Figures) {
    *out += "\nblocks\n";
    let mut none = true;
    for (k, account) in figures.blocks().enumerate() {
        none = false;
        *out += &format!("  {}: {}\n", k + 1, block_in_words(account));
    }
    if none {
        *out += "  none to solve: all numbers are known exactly, one after the other\n";
    }
    let held = figures.account().names_held();
    if !held.is_empty() {
        *out += &format!("free, held as drawn: {}\n", list(&held, LISTED));
    }
}

/// `by formula, 2 solutions`.
pub(super) fn solved_in_words(account: &BlockAccount) -> String {
    let (low, high) = account.solutions;
    let solutions = match low == high {
        true => counted(high, "solution"),
        false => format!("{low} to {}", counted(high, "solution")),
    };
    match account.way {
        Way::Formula => format!("by formula, {solutions}"),
        Way::Path => format!(
            "its path of {}, {solutions}",
            counted(account.tubes, "tube")
        ),
    }
}

/// `2 unknowns: x of d, y of d: by formula, 2 solutions`.
fn block_in_words(account: &BlockAccount) -> String {
    let runs = match account.runs {
        1 => String::new(),
        n => format!(", for {n} figures of the blocks before"),
    };
    let doubt = account.doubt.as_ref();
    let doubt = doubt.map_or(String::new(), |why| format!("; {why}"));
    format!(
        "{}: {}: {}{runs}{doubt}",
        counted(account.unknowns.len(), "unknown"),
        list(&account.unknowns, LISTED),
        solved_in_words(account)
    )
}

/// `block 1 solution 1, block 2 solution 3 mirrored`: blocks, their solutions, and whether these are mirrored.
pub(super) fn chosen_in_words(chosen: impl Iterator<Item = (usize, usize, bool)>) -> String {
    let each = chosen.map(|(block, solution, is_mirrored)| {
        let mirrored = if is_mirrored { " mirrored" } else { "" };
        format!("block {} solution {}{mirrored}", block + 1, solution + 1)
    });
    each.collect::<Vec<_>>().join(", ")
}
