//! The page of `limits`: the figures at both ends of every dimension's range.

use super::reader::{Reader, are_bounds, digits, middle, nothing};
use super::{Figure, Page, ShowError, Text, Tone};
use crate::blocks::rounded_up;
use crate::interval::{Bound, hull};
use crate::order::InOrder;
use crate::report::document::{Limits, RangeOf, wrong};
use crate::report::edit::behind;
use crate::report::sweep::not_beyond;

pub(super) fn page(reader: &Reader, limits: &Limits) -> Result<Page, ShowError> {
    let mut page = reader.page("In the file", "all dimensions as they are")?;
    page.verdict = "How far each dimension can go alone, all others standing still.".into();
    if limits.moved > 0.0 {
        page.verdict += &format!(
            " The sketch was led to its own dimensions first, proved likewise: no point moved by more than {}.",
            rounded_up(limits.moved)
        );
    }
    let kept = limits
        .ranges
        .0
        .iter()
        .map(|(_, range)| range.account.kept_in_words());
    if let Some(kept) = kept.max().filter(|kept| !kept.is_empty()) {
        page.verdict += &format!(" This holds {kept}.");
    }
    let mut ranges: Vec<&(String, RangeOf)> = limits.ranges.0.iter().collect();
    // In the order of the file.
    ranges.order_by_key(|(_, range)| range.constraint);
    let (mut all, mut is_loose) = (true, false);
    let mut words = Vec::new();
    for (name, range) in ranges {
        let mut values = Vec::new();
        let scope = behind(", ", range.account.scope());
        let is_held = !range.account.held.is_empty();
        is_loose |= is_held;
        let ends = [
            (&range.low, "least", Bound::Upper),
            (&range.high, "largest", Bound::Lower),
        ];
        for (end, which, back) in ends {
            let value = end.value;
            match &end.status[..] {
                "limit" => values.push(digits(value)),
                "reached" => values.push(format!("{} and beyond", near(middle(value)))),
                _ => {
                    all = false;
                    let up_to = match are_bounds(&value) {
                        true => not_beyond(hull(value[0], value[1]), back),
                        false => "?".to_owned(),
                    };
                    values.push(format!("{up_to} or beyond, not known"));
                }
            }
            // Where no limit was met the figure is one of many.
            if end.status != "limit" {
                continue;
            }
            let (Some(told), Some(points)) = (&end.words, &end.points) else {
                return Err(wrong("ranges"));
            };
            let led = match is_held {
                true => " found, perhaps not of all",
                false => "",
            };
            words.push(format!(
                "{name}, the {which}{led}{scope}, {}: {told}",
                digits(value)
            ));
            if let Some(extreme) = &end.extreme {
                words.push(format!(
                    "{name}, the {which} with nothing held: {}, of a figure near that one, no point further than {} from where it is there. \
                     No figure near goes further, however anything moves, proved",
                    digits(extreme.value),
                    rounded_up(extreme.apart)
                ));
            }
            page.figures.push(Figure {
                name: format!("{name} = {}", near(middle(value))),
                note: format!(
                    "the {which} that it can be led to from the file{scope}{}",
                    special(reader, end.flat.as_deref().unwrap_or_default())
                ),
                // No two of them are congruent.
                class: Some(page.figures.len() - 1),
                ..reader.figure(points, &nothing())?
            });
        }
        let (now, values) = (digits(range.value), values.join(" to "));
        page.row(name, format!("is {now}; from {values}{scope}"));
        let bounds = [
            ("least", range.least, Bound::Lower),
            ("most", range.most, Bound::Upper),
        ];
        for (which, bound, side) in bounds {
            if let Some(bound) = bound.filter(|_| is_held) {
                let bound = side.decimals(bound, 9);
                words.push(format!(
                    "However the rest moves, {name} is at {which} {bound}, proved"
                ));
            }
        }
    }
    page.rate(match all {
        true => ("proved", Tone::Proved),
        false => ("proved in part", Tone::Stopped),
    });
    page.say(match is_loose {
        false => {
            "Each dimension was moved alone, both ways, with proof, and what had to be held or left out for that is named with it: between \
             the figure of the file and a limit there is exactly one figure for every value that continues it, and beyond the limit it has no continuation. Figures that are put together \
             another way may have other limits. At a limit the figure can move for an instant with all dimensions as they are."
        }
        true => {
            "Each dimension was moved alone, both ways, with proof. The figure can move with all its dimensions as they are, so \
             coordinates were held, which are named: with these held there is exactly one figure for every value up to a limit that \
             continues that of the file, and none beyond. So each dimension can go at least so far, and with other coordinates held \
             perhaps further."
        }
    });
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
fn special(reader: &Reader, flat: &[Vec<String>]) -> String {
    let [names, others @ ..] = flat else {
        return String::new();
    };
    let place = match reader.dimension {
        2 => "on one line",
        _ => "in one plane",
    };
    let more = match others {
        [] => "",
        _ => ", and others",
    };
    format!("; {} {place}{more}", names.join(", "))
}
