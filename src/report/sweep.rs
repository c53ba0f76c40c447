//! Ranges and sweeps, for people and for programs.

use super::certain_digits;
use super::columns::Grid;
use super::edit::{behind, edit_in_words, limit_in_words, short, write_moved};
use super::measured::{Measures, Placed};
use crate::blocks::{Account, rounded_up};
use crate::edit::{Edited, End, Ending, Extreme, Moved, Range, Sweep};
use crate::interval::{Bound, Interval};
use crate::problem::{Problem, list};
use crate::remarks::Reach;

/// The ranges of dimensions as a table.
pub fn ranges_to_table(problem: &Problem, ranges: &[Range], moved: Moved) -> String {
    let mut out = format!(
        "{}: how far each dimension can go alone, all others standing still\n",
        problem.name
    );
    if ranges.is_empty() {
        return out
            + "There is none: no distance, no number of a constraint, and no parameter that stands in an equation.\n";
    }
    write_moved(&mut out, problem, moved);
    out.push('\n');
    // Of several each has its own.
    let is_one = ranges.len() == 1;
    let account = ranges.iter().map(|range| Account {
        held_though_computed: match is_one {
            true => range.account.held_though_computed.clone(),
            false => Vec::new(),
        },
        ..range.account.clone()
    });
    let account = account.reduce(|mut all, one| {
        all.join(&one);
        all
    });
    let account = account.as_ref();
    let mut grid = Grid::new(["dimension", "is", "shrinks to", "grows to"], |_| true);
    for range in ranges {
        grid.push([
            problem.dimension_name(range.index),
            short(range.value),
            value_of((&range.low, &range.extremes[0]), "≤", Bound::Upper),
            value_of((&range.high, &range.extremes[1]), "≥", Bound::Lower),
        ]);
    }
    out += &grid.render();
    let scope = account.map_or(String::new(), |account| behind(" ", account.scope()));
    let left_out = account.map_or(String::new(), |account| match account.left_out_in_words() {
        words if words.is_empty() => words,
        words if account.meets_all() => format!(" At all these figures {words}."),
        words => format!(" At all these figures, and everywhere on the way to each, {words}."),
    });
    let mut extremes = ranges
        .iter()
        .flat_map(|range| range.extremes.iter().flatten());
    let free = match extremes.next() {
        None => "",
        Some(_) => {
            "A value with * is the end with nothing held: a figure has it, and no figure near that one goes further, however anything \
             moves, proved. "
        }
    };
    let is_held = account.is_some_and(|account| !account.held.is_empty());
    let ends = ranges.iter().flat_map(|range| {
        let ends = [&range.low, &range.high].into_iter();
        ends.zip(&range.extremes)
    });
    let mut ends = ends.filter(|(_, extreme)| extreme.is_none());
    let is_held_at_ends = is_held && ends.clone().next().is_some();
    let loose = match is_held_at_ends {
        false => "",
        true => {
            "The figure can move with all its dimensions as they are, if only as a whole: each can go at least so far, and with \
             other coordinates held perhaps further. "
        }
    };
    let every = match (
        free.is_empty(),
        ends.any(|(end, _)| matches!(end, End::Limit(..))),
    ) {
        (true, _) => format!("Every value is a limit{scope}, proved, and"),
        (false, true) => format!("Every other value is a limit{scope}, proved. Each value"),
        (false, false) if is_held_at_ends => format!("The others are proved{scope}. Each value"),
        (false, false) => "Each value".to_owned(),
    };
    let others = ranges.iter().filter(|_| !is_one);
    let others = others.map(|range| (range, &range.account.held_though_computed));
    let others: Vec<_> = others.filter(|(_, held)| !held.is_empty()).collect();
    let computed = match others.is_empty() {
        true => "",
        false => {
            "Each goes alone, with what the file computes from the same parameters held where it is, as told below. "
        }
    };
    out += &format!(
        "\n{free}{loose}{computed}{every} differs from the exact one by at most 1 in its last digit shown; but \
         \"≤\" and \"≥\" say that no limit was met up to there, proved, and \"?\" that nothing could be proved beyond.{left_out}\n"
    );
    for (range, held) in others {
        let name = problem.dimension_name(range.index);
        out += &format!("{name} goes with {}.\n", list(held, held.len()));
    }
    for range in ranges {
        let ends = [
            (&range.low, "shrinks to", Bound::Upper),
            (&range.high, "grows to", Bound::Lower),
        ];
        for ((end, verb, back), extreme) in ends.into_iter().zip(&range.extremes) {
            let name = problem.dimension_name(range.index);
            match (end, extreme) {
                (End::Limit(value, _), Some(extreme)) => {
                    out += &format!(
                        "{name} {verb} {}*: the way there was followed, with coordinates held, to {}, where no point is further than {} from \
                         where it is in that figure.\n",
                        certain_digits(extreme.value),
                        certain_digits(*value),
                        rounded_up(extreme.apart)
                    )
                }
                (End::Limit(value, limit), None) => {
                    out += &format!(
                        "{name} {verb} {}: {}\n",
                        certain_digits(*value),
                        limit_in_words(problem, limit)
                    )
                }
                (End::Beyond(_), _) => {}
                (End::Unknown(value, reason), _) => {
                    let value = not_beyond(*value, back);
                    out += &format!("{name} {verb} {value} at least: {reason}\n");
                }
            }
        }
        // Where nothing is held, and a limit is proved, no more is to be said.
        let is_open = |end: &End| !range.account.held.is_empty() || !matches!(end, End::Limit(..));
        let ends = [&range.low, &range.high].into_iter().zip(&range.reach);
        for (end, reach) in ends {
            if let Some(reach) = reach.as_ref().filter(|_| is_open(end)) {
                out += &reach_in_words(problem, range.index, reach);
            }
        }
    }
    out
}

/// What no figure goes beyond, however it moves.
fn reach_in_words(problem: &Problem, index: usize, reach: &Reach) -> String {
    let name = problem.dimension_name(index);
    let pairs = reach.way.windows(2).map(|pair| {
        let mut distances = problem.distances.iter();
        let is_it = |ends: [usize; 2]| pair.iter().all(|p| ends.contains(p));
        let known = distances.position(|distance| is_it(distance.points));
        problem.distance_name(known.expect("a way goes along distances"))
    });
    let mut pairs: Vec<String> = pairs.collect();
    let longest = reach.longest.map(|place| pairs.remove(place));
    let bound = |side| not_beyond(reach.bound, side);
    let why = match longest {
        Some(longest) => format!(
            "at least {}: {longest} \u{2212} {}",
            bound(Bound::Lower),
            pairs.join(" \u{2212} ")
        ),
        None => format!("at most {}: {}", bound(Bound::Upper), pairs.join(" + ")),
    };
    format!("However the rest moves, {name} is {why}, proved.\n")
}

fn value_of((end, extreme): (&End, &Option<Extreme>), beyond: &str, back: Bound) -> String {
    match end {
        End::Limit(value, _) => match extreme {
            Some(extreme) => certain_digits(extreme.value) + "*",
            None => certain_digits(*value),
        },
        End::Beyond(value) => format!("{beyond} {}", short(*value)),
        End::Unknown(value, _) => format!("? {}", not_beyond(*value, back)),
    }
}

/// Up to where something is proved that is proved up to somewhere in an interval, with the digits that are certain: the bound on the side
/// that it comes from.
pub(super) fn not_beyond(value: Interval, back: Bound) -> String {
    let known = value.wid().max(1e-15 * value.mag());
    let decimals = -known.log10().floor();
    let text = back.decimals(back.end(value), decimals.clamp(0.0, 15.0) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// The edit that a sweep did not get over, if there is one.
pub(super) fn obstacle(sweep: &Sweep) -> Option<&Edited> {
    match &sweep.approach.ending {
        Ending::Reached => sweep.end.as_ref(),
        _ => Some(&sweep.approach),
    }
}

/// What came of a sweep in words.
pub fn sweep_in_words(problem: &Problem, index: usize, sweep: &Sweep) -> String {
    let name = problem.dimension_name(index);
    let with = sweep.led[1..]
        .iter()
        .map(|&index| problem.dimension_name(index));
    let with = match list(&with.collect::<Vec<_>>(), 12) {
        names if names.is_empty() => names,
        names => format!(" and with it of {names}, computed by the file's expressions"),
    };
    let frames = match (sweep.frames.first(), sweep.frames.last()) {
        (Some(first), Some(last)) => format!(
            "{} of {name} from {} to {}{with}, each proved to be the one and only continuation of the one before{}",
            crate::problem::counted(sweep.frames.len(), "frame"),
            short(first.value),
            short(last.value),
            sweep.account.clause_behind()
        ),
        _ => format!("no frame of {name}"),
    };
    let straight = match sweep.led.len() {
        0 | 1 => "",
        _ => {
            " Between two frames these go straight, and not by the expressions: where that ends is no limit of what is varied."
        }
    };
    let end = obstacle(sweep).map_or(String::new(), |edited| {
        format!(" {}{straight}", edit_in_words(problem, edited))
    });
    format!("{}: {frames}.{end}", problem.name)
}

/// A sweep as CSV: the dimension's value, then the coordinates of all points, as floats, and what is measured.
pub fn sweep_to_csv(problem: &Problem, index: usize, sweep: &Sweep, measures: &Measures) -> String {
    let frames = sweep.frames.iter();
    let frames: Vec<_> = frames
        .map(|frame| ([frame.value], (&frame.points[..], &frame.objects[..])))
        .collect();
    frames_to_csv(problem, &[problem.dimension_name(index)], &frames, measures)
}

/// Figures as CSV, each with the values of some dimensions: these, then the coordinates of all points, as floats, and what is measured.
pub fn frames_to_csv(
    problem: &Problem,
    dimensions: &[String],
    frames: &[(impl AsRef<[Interval]>, Placed)],
    measures: &Measures,
) -> String {
    let axes = &["x", "y", "z"][..problem.dimension];
    let points = problem.points.iter();
    let coordinates =
        points.flat_map(|p| axes.iter().map(move |axis| format!("{}.{axis}", p.name)));
    let names = dimensions.iter().cloned().chain(coordinates);
    let names = names.chain(measures.names().map(str::to_owned));
    let names: Vec<String> = names.map(|name| quoted(&name)).collect();
    let mut out = names.join(",") + "\n";
    for &(ref values, figure @ (points, _)) in frames {
        let coordinates = points.iter().flat_map(|p| &p[..problem.dimension]);
        let measured = measures.of(figure);
        let all = values.as_ref().iter().chain(coordinates).chain(&measured);
        // What has no bounds is left empty.
        let cell = |x: &Interval| match x.wid().is_finite() {
            true => within(*x).to_string(),
            false => String::new(),
        };
        let all: Vec<String> = all.map(cell).collect();
        out += &(all.join(",") + "\n");
    }
    out
}

/// A number within these bounds, with no more digits than it takes.
fn within(x: Interval) -> f64 {
    // About as many as the bounds agree in.
    let least = (x.mag() / x.wid()).log10() as usize;
    let rounded = |digits: usize| format!("{:.digits$e}", x.mid()).parse::<f64>().ok();
    let mut all = (least.saturating_sub(1)..17).filter_map(rounded);
    all.find(|&y| x.contains(y)).unwrap_or_else(|| x.mid()) + 0.0
}

/// A name as a field of CSV (RFC 4180).
pub(super) fn quoted(name: &str) -> String {
    if name.contains([',', '"', ' ']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.to_owned()
    }
}
