//! Edits in words and tables, for people, and as JSON, for programs.

use super::certain_digits;
use super::columns::{self, DIGITS};
use super::document::{Named, names};
use super::table::write_joints;
use crate::blocks::{Account, Why, rounded_up};
use crate::edit::{Alone, Decomposition, Dimension, Dragged, Edited, Ending, Limit, Moved};
use crate::interval::vector::length;
use crate::interval::{Bound, Interval};
use crate::order::InOrder;
use crate::problem::{Object, Problem, Shape, counted, either, list};
use crate::system::Located;

/// What is said of a sketch whose path has no figure with all dimensions: what comes of each of them alone. Empty if nothing is
/// known of that.
pub fn alone_in_words(found: &[Alone]) -> String {
    const MOST: usize = 3;
    let Some(first) = found.first() else {
        return String::new();
    };
    let name = |one: &Alone| one.problem.dimension_name(one.edited.dimensions[0].index);
    let words = |one: &Alone| edit_in_words(&one.problem, &one.edited);
    if first.edited.ending == Ending::Reached {
        return format!(
            "All dimensions can be met, one after the other. Led to all but {} first, and then to this one: {}\n",
            name(first),
            words(first)
        );
    }
    let mut text = "Led to all dimensions but one first, and then to this one:\n".to_owned();
    for one in found.iter().take(MOST) {
        let to = short(one.edited.dimensions[0].to);
        text += &format!("  {}, to be {to}: {}\n", name(one), words(one));
    }
    match found.len().saturating_sub(MOST) {
        0 => {}
        more => text += &format!("  and {more} more likewise\n"),
    }
    text
}

/// The names of points, as people read them: `a, b and c`.
pub(super) fn named(problem: &Problem, points: &[usize]) -> String {
    match names(problem, points).as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// What came of an edit in words, one sentence or two, without the figure.
pub fn edit_in_words(problem: &Problem, edited: &Edited) -> String {
    if let Some(dragged) = &edited.dragged {
        return dragged_in_words(problem, edited, dragged);
    }
    let changes = edited.dimensions.iter().map(|d| {
        let name = problem.dimension_name(d.index);
        let there = match edited.ending.is_at_an_edge() {
            true => format!(", there {}", certain_digits(d.value)),
            false => String::new(),
        };
        format!("{name} from {} to {}{there}", short(d.from), short(d.to))
    });
    let changes = changes.collect::<Vec<_>>().join(", ");
    // Beside so long a way what happens on it is not to be told from its beginning.
    let is_far = |d: &Dimension| (d.to - d.from).mag() > 1e6 * d.from.mag() && d.from.mag() > 0.0;
    let far = match edited.dimensions.iter().find(|d| is_far(d)) {
        Some(d) => format!(
            " The new value is {:.0e} times what {} is: try one that is nearer, or `krawl limits` for how far it can go.",
            (d.to / d.from).mag(),
            problem.dimension_name(d.index)
        ),
        None => String::new(),
    };
    let account = &edited.account;
    let left_out = behind("; ", account.left_out_in_words());
    let clause = account.clause_behind();
    if let (Ending::Reached, Some(singular)) = (&edited.ending, &edited.singular) {
        return format!(
            "Reached, proved: the figure meets the dimensions{clause}, {changes}. The old one is singular, so that no \
             continuation is the one and only. {}",
            singular.in_words()
        );
    }
    match &edited.ending {
        Ending::Reached => {
            let scope = behind(" ", account.scope());
            format!(
                "Reached, proved: the figure is the one and only continuation of the old one{scope}, {changes}{left_out}."
            )
        }
        Ending::Limit(limit) => {
            let reached = edited.dimensions.iter().map(|d| {
                let name = problem.dimension_name(d.index);
                let verb = if d.to.mid() >= d.from.mid() {
                    "grow"
                } else {
                    "shrink"
                };
                let digits = certain_digits(d.value);
                match account.chosen_anew > 0 && !account.held.is_empty() {
                    true => format!(
                        "{name} can {verb} to {digits} at least, and with what is held there no further"
                    ),
                    false => format!("{name} can {verb} to {digits} and no further"),
                }
            });
            let reached = reached.collect::<Vec<_>>().join(", ");
            let together = if edited.dimensions.len() > 1 {
                " together, led in step"
            } else {
                ""
            };
            let scope = match account.scope() {
                scope if scope.is_empty() => scope,
                scope => format!("{scope}, "),
            };
            let near = match edited.t.1 >= 1.0 {
                true => {
                    " Whether what was wanted is beyond that is not decided: it is too near to the limit."
                }
                false => "",
            };
            format!(
                "Limit, proved: {scope}{reached}{together}{left_out}.{near} {}",
                limit_in_words(problem, limit)
            )
        }
        Ending::Passes(reason) => format!(
            "Passes: near t = {} of the way ({changes}) branches of figures seem to meet, so that none of \
                 them continues this one more than another; proved up to there{clause} ({reason}).{far}",
            Bound::Lower.short(edited.t.0)
        ),
        Ending::Stopped(reason) => format!(
            "Stopped: proved up to t = {} of the way ({changes}){clause}, and not further: {reason}.{far}",
            Bound::Lower.short(edited.t.0)
        ),
    }
}

/// A clause with what parts it from the words before, where there is one.
pub(super) fn behind(sign: &str, clause: String) -> String {
    match clause.is_empty() {
        true => clause,
        false => format!("{sign}{clause}"),
    }
}

/// What came of dragging points.
fn dragged_in_words(problem: &Problem, edited: &Edited, dragged: &Dragged) -> String {
    let names: Vec<usize> = dragged.places.iter().map(|(drag, _)| drag.point).collect();
    let names = named(problem, &names);
    let place = match (dragged.is_there, &dragged.places[..]) {
        (true, [_]) => format!("{names} is where it was wanted"),
        (true, _) => format!("{names} are where they were wanted"),
        (false, [(_, off)]) => {
            format!(
                "{names} is {} from where it was wanted",
                certain_digits(*off)
            )
        }
        (false, places) => {
            let off = places.iter().map(|(_, off)| certain_digits(*off));
            let off: Vec<String> = off.collect();
            format!(
                "{names} are {} from where they were wanted",
                list(&off, LISTED)
            )
        }
    };
    let why = match (dragged.is_there, &dragged.stop) {
        (true, _) => String::new(),
        (false, Some(stop)) => format!(" No way further was found: {stop}."),
        (false, None) => " No figure was found that is noticeably nearer to that.".to_owned(),
    };
    let account = &edited.account;
    let led = match dragged.led.is_empty() {
        true => "the figure stands where it stood".to_owned(),
        false => {
            let how = match dragged.legs {
                1 => "straight".to_owned(),
                legs => format!("in {legs} straight legs"),
            };
            let led = dragged.led.len();
            let (are, they) = (either(led, "is", "are"), either(led, "it is", "they are"));
            let scope = behind(", ", account.scope());
            format!(
                "the figure is the one and only continuation of the old one as {} {are} led {how} to where {they} now{scope}",
                list(&dragged.led, LISTED),
            )
        }
    };
    let left_out = behind("; ", account.left_out_in_words());
    format!("Dragged, proved: {place}; {led}{left_out}.{why}")
}

/// What is special about the figure at a limit.
pub fn limit_in_words(problem: &Problem, limit: &Limit) -> String {
    if problem.points.is_empty() {
        return "The equations are singular there: two solutions meet.".to_owned();
    }
    let sizes = limit.motion.iter().copied().map(length);
    let mut moving: Vec<(usize, f64)> = sizes.enumerate().collect();
    moving.order_by(|a, b| b.1.total_cmp(&a.1));
    let moving: Vec<usize> = moving
        .iter()
        .take(3)
        .filter(|m| m.1 > 1e-3)
        .map(|m| m.0)
        .collect();
    let instant = format!(
        "for an instant it can move with all its dimensions as they are, {} most",
        named(problem, &moving)
    );
    if limit.flat.is_empty() {
        return format!("The figure there is at a dead centre: {instant}.");
    }
    let place = if problem.dimension == 2 {
        "on one line"
    } else {
        "in one plane"
    };
    let shown: Vec<String> = limit
        .flat
        .iter()
        .take(4)
        .map(|f| named(problem, f))
        .collect();
    let more = match limit.flat.len().saturating_sub(4) {
        0 => String::new(),
        n => format!(", and {n} more such sets"),
    };
    format!(
        "There {} are {place}{more} (up to {}), and {instant}.",
        shown.join("; "),
        rounded_up(limit.flat_within)
    )
}

/// A length for sentences: with thirteen digits, or as many more as it takes to come between its bounds.
pub(super) fn short(x: Interval) -> String {
    let digits = |k: usize| format!("{:.k$e}", x.mid()).parse::<f64>().ok();
    let middle = (12..17).find_map(|k| digits(k).filter(|&y| x.contains(y)));
    format!("{}", middle.or(digits(12)).unwrap_or(x.mid()))
}

/// An edit as a text of several lines: how it ended, the figure, what became of orientations, numbers of the
/// run. `moved`: how far the sketch was from the old figure.
pub fn edit_to_table(problem: &Problem, edited: &Edited, moved: Moved) -> String {
    let mut out = format!("{}: {}\n", problem.name, edit_in_words(problem, edited));
    write_moved(&mut out, problem, moved);
    let what = match edited.ending {
        Ending::Reached if problem.points.is_empty() => "Solution",
        Ending::Limit(_) if problem.points.is_empty() => "Solution at the limit",
        _ if problem.points.is_empty() => "Old solution",
        Ending::Reached => "Figure, in the coordinates of the file",
        Ending::Limit(_) => "Figure at the limit, in the coordinates of the file",
        _ if edited.there.is_some() => "Figure shortly before",
        _ => "Old figure, in the coordinates of the file",
    };
    out += &format!("\n{what}");
    if let Some(values) = &edited.there {
        let at = edited.dimensions.iter().zip(values);
        let at =
            at.map(|(d, value)| format!("{} = {}", problem.dimension_name(d.index), short(*value)));
        let at = at.collect::<Vec<_>>().join(", ");
        out += &format!(", at {at}, in the coordinates of the file");
    }
    out.push('\n');
    write_points(&mut out, problem, &edited.points);
    write_numbers(&mut out, problem, &edited.objects);
    out += &format!("\n{DIGITS}\n");

    let orientations = &edited.orientations;
    let what = if problem.dimension == 2 {
        "triangles"
    } else {
        "tetrahedra"
    };
    let kept = orientations.kept.len();
    let all = kept + orientations.lost.len();
    let until = match edited.ending {
        Ending::Reached => "all the way",
        _ => "up to there",
    };
    out.push('\n');
    out += &format!(
        "orientations        {kept} of {all} {what} of joined points keep their sign {until}, proved\n"
    );
    for lost in orientations.lost.iter().take(LISTED) {
        let (lo, hi) = lost.t;
        let names = named(problem, &lost.points);
        let end = match &edited.ending {
            Ending::Limit(limit) if limit.flat.contains(&lost.points) => "flat at the limit",
            _ => "flat there, or too near to it to tell",
        };
        out += &format!(
            "  not kept          {names}: up to t = {}, not from there to {}: {end}\n",
            Bound::Lower.short(lo),
            Bound::Upper.short(hi)
        );
    }
    if orientations.lost.len() > LISTED {
        let more = orientations.lost.len() - LISTED;
        out += &format!("                    and {more} more\n");
    }
    for flat in orientations.flat.iter().take(LISTED) {
        let names = named(problem, flat);
        out += &format!(
            "  no sign           {names}: flat in the old figure, or too near to it to tell\n"
        );
    }
    out += &format!("tubes               {}\n", edited.tubes);
    out += &format!("rejected tubes      {}\n", edited.rejected);
    out += &format!("length of the path  {:.4}\n", edited.length.abs());
    out += &format!("seconds             {:.6}\n", edited.seconds);
    for (index, text) in edited.switched_on.iter().enumerate() {
        let label = if index == 0 { "switched on" } else { "" };
        out += &format!("{label:<20}{text}\n");
    }
    out
}

/// How far the sketch was led before, if it was.
pub(super) fn write_moved(out: &mut String, problem: &Problem, moved: Moved) {
    if moved.tubes == 0 {
        return;
    }
    let far = match problem.points.is_empty() {
        true => String::new(),
        false => format!(
            ": no point moved by more than {}",
            rounded_up(moved.distance)
        ),
    };
    *out += &format!("The sketch was led to its own dimensions first, proved likewise{far}.\n");
}
/// Most orientations in one list.
const LISTED: usize = 12;

/// Points in aligned columns, with their certain digits.
pub(super) fn write_points(out: &mut String, problem: &Problem, points: &[[Interval; 3]]) {
    columns::write_points(out, problem, points, |x| certain_digits(*x))
}

/// What a claim about a figure was proved of, as lines under its table; none where that is the figure as it is.
pub fn account_in_words(account: &Account) -> String {
    let mut out = String::new();
    let held = account.names_held();
    if !held.is_empty() {
        let label = match account.chosen_anew {
            0 => "held where it is",
            _ => "held, or in part",
        };
        out += &format!("{label}    {}\n", list(&held, LISTED));
    }
    let left_out = account.left_out_in_words();
    if !left_out.is_empty() {
        out += &format!("left out            {left_out}\n");
    }
    out
}

/// Whether a sketch is in order, or what of it can still move.
pub fn freedom_of_sketch_in_words(found: &Decomposition) -> String {
    let mut parts = Vec::new();
    let held = found.account.names_held();
    if !held.is_empty() {
        parts.push(format!(
            "under-constrained: it can still move (edits hold {} where they are)",
            list(&held, LISTED)
        ));
    }
    if let Some(singular) = &found.singular {
        parts.push(format!(
            "{}; nothing follows from that of which constraint is one too many",
            singular.place_in_words()
        ));
    }
    match parts.is_empty() {
        true => "the input is in order".to_owned(),
        false => parts.join("; "),
    }
}

/// How a sketch falls apart, as lines of text.
pub fn decomposition_in_words(found: &Decomposition) -> String {
    let mut out = format!(
        "blocks\n  {} merged with others, {} left\n",
        counted(found.merged, "coordinate"),
        counted(found.unknowns, "unknown")
    );
    if found.blocks.is_empty() {
        out += "  none to solve: all are known exactly, one after the other\n";
    }
    for (index, block) in found.blocks.iter().enumerate() {
        out += &format!(
            "  {}: {}: {}\n",
            index + 1,
            counted(block.len(), "unknown"),
            list(block, LISTED)
        );
    }
    let held = found.account.names_held();
    let (follow, seem) = left_out(&found.account);
    for (what, names) in [
        ("free (edits hold them where they are)", held),
        (
            "left out of the blocks, as they follow from the others, proved",
            follow,
        ),
        (
            "left out of the blocks, as they say nothing new where it is drawn (seen in floats)",
            seem,
        ),
    ] {
        if !names.is_empty() {
            out += &format!("  {what}: {}\n", list(&names, LISTED));
        }
    }
    if let Some(singular) = &found.singular {
        out += &format!("  {}\n", singular.place_in_words());
    }
    out
}

/// The names of what was left out: what is proved to follow from the others, and what seems to.
fn left_out(account: &Account) -> (Vec<String>, Vec<String>) {
    let names = |why: Why| {
        let those = account.left_out.iter().filter(|one| one.why == why);
        those.map(|one| one.name.clone()).collect()
    };
    (names(Why::Follows), names(Why::NothingNew))
}

/// Objects that are not told by their points, with what they have of their own: circles, unknown numbers, bodies with joints, joints.
fn own<'a>(
    problem: &'a Problem,
    objects: &'a [Located],
) -> impl Iterator<Item = (&'a Object, &'a Located)> {
    let all = problem.objects.iter().zip(objects);
    all.filter(|(object, at)| match at {
        Located::Pose { .. } | Located::Joint { .. } | Located::Number(_) => true,
        _ => matches!(object.shape, Shape::Round { .. }),
    })
}

/// The radii of circles, or the values of unknown numbers, by name, each as `number` has it.
pub(super) fn numbers_of<C>(
    problem: &Problem,
    objects: &[Located],
    are_unknowns: bool,
    number: fn(&Interval) -> C,
) -> Named<C> {
    let objects = own(problem, objects);
    let objects = objects.filter(|(o, _)| matches!(o.shape, Shape::Number { .. }) == are_unknowns);
    let all = objects.filter_map(|(object, at)| Some((object.name.clone(), number(&at.number()?))));
    Named(all.collect())
}

/// The radii of circles, the values of unknown numbers, bodies with joints and joints, a line each.
pub(super) fn write_numbers(out: &mut String, problem: &Problem, objects: &[Located]) {
    for (object, at) in own(problem, objects) {
        match (&object.shape, at.number().map(certain_digits)) {
            (Shape::Number { .. }, Some(number)) => {
                *out += &format!("  {} = {number}\n", object.name)
            }
            (_, Some(number)) => *out += &format!("  {}: radius {number}\n", object.name),
            (_, None) => {}
        }
    }
    write_joints(out, problem, objects, &|x| certain_digits(*x))
}
