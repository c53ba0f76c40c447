//! The page of `limits`: the figures at both ends of every dimension's range.

use super::{Figure, Page, Text, Tone};
use crate::edit::{End, Limit, Moved, Range};
use crate::problem::Problem;
use crate::report::{certain_digits, limit_in_words};

impl Page {
    /// The page of the ranges of dimensions.
    pub fn of_ranges(problem: &Problem, ranges: &[Range], moved: Moved) -> Page {
        let mut page = Page::of_sketch(problem);
        page.figures[0].name = "In the file".into();
        page.figures[0].note = "all dimensions as they are".into();
        let known = |end: &End| !matches!(end, End::Unknown(..));
        let all = ranges
            .iter()
            .all(|range| known(&range.low) && known(&range.high));
        (page.badge, page.tone) = match all {
            true => ("proved".into(), Tone::Proved),
            false => ("proved in part".into(), Tone::Stopped),
        };
        page.verdict = "How far each dimension can go alone, all others standing still.".into();
        if moved.tubes > 0 {
            page.verdict += &format!(
                " The sketch was led to its own dimensions first, proved likewise: no point moved by more than {:.1e}.",
                moved.distance
            );
        }
        let mut words = Vec::new();
        for range in ranges {
            let name = problem.dimension_name(range.index);
            let value = |end: &End| match end {
                End::Limit(value, _) => certain_digits(*value),
                End::Beyond(value) => format!("{} and beyond", near(value.mid())),
                End::Unknown(value, _) => format!("{} or beyond, not known", near(value.mid())),
            };
            page.rows.push((
                name.clone(),
                format!(
                    "is {}; from {} to {}",
                    certain_digits(range.value),
                    value(&range.low),
                    value(&range.high)
                ),
            ));
            for (end, figure, which) in [
                (&range.low, &range.low_figure, "least"),
                (&range.high, &range.high_figure, "largest"),
            ] {
                // Where no limit was met the figure is one of many.
                let End::Limit(at, limit) = end else {
                    continue;
                };
                words.push(format!(
                    "{name}, the {which}, {}: {}",
                    certain_digits(*at),
                    limit_in_words(problem, limit)
                ));
                page.figures.push(Figure {
                    name: format!("{name} = {}", near(at.mid())),
                    note: format!("the {which} that it can be{}", special(problem, limit)),
                    kind: "solution",
                    // No two of them are congruent.
                    class: Some(page.figures.len() - 1),
                    at: None,
                    t: None,
                    folds: None,
                    outlines: Vec::new(),
                    points: figure.iter().flatten().map(|x| x.mid()).collect(),
                    digits: Some(super::figures::digits(problem, figure)),
                });
            }
        }
        page.text = vec![Text::Paragraph(
            "Each dimension was moved alone, both ways, with proof: between the figure of the file and a limit there is \
             exactly one figure for every value, and beyond the limit it has no continuation. At a limit the figure can \
             move for an instant with all dimensions as they are."
                .into(),
        )];
        if !words.is_empty() {
            page.text.push(Text::List(words));
        }
        page.digits = "In the coordinates of the file. Every coordinate differs from the exact one by at most 1 in its \
                       last digit shown."
            .into();
        page
    }
}

/// A number of a few digits, to be read and not to be relied on.
fn near(x: f64) -> String {
    format!("{}", format!("{x:.5e}").parse::<f64>().unwrap_or(x))
}

/// What is special about the figure at a limit, in few words.
fn special(problem: &Problem, limit: &Limit) -> String {
    let Some(points) = limit.flat.first() else {
        return String::new();
    };
    let names: Vec<&str> = points
        .iter()
        .map(|&p| problem.points[p].name.as_str())
        .collect();
    let place = if problem.dimension == 2 {
        "on one line"
    } else {
        "in one plane"
    };
    let more = if limit.flat.len() > 1 {
        ", and others"
    } else {
        ""
    };
    format!("; {} {place}{more}", names.join(", "))
}
