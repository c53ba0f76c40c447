//! Results for people.

use super::certain_digits;
use super::columns::{DIGITS, write_points};
use super::complete::{signs_in_words, tested_in_words};
use super::document::names;
use super::marks::Marks;
use crate::complete::Tested;
use crate::constraint::{Symmetry, symmetry};
use crate::interval::{Bound, Interval, hull};
use crate::order::each_once;
use crate::problem::{Problem, Shape, counted, either, list};
use crate::remarks::moves;
use crate::system::Located;
use crate::track::{EndKind, Mode, Outcome, PathEnd, Solution, Space, Status};

/// The results as a text of several lines: what was found and what that means, the solutions,
/// the numbers of the run. `tested`: where there are more distances than unknowns, what came of those that were left out.
pub fn to_table(problem: &Problem, outcome: &Outcome, tested: Option<&Tested>) -> String {
    table(problem, outcome, tested, usize::MAX)
}

/// Solutions are listed as long as they fit in so many lines.
const LINES: usize = 120;
/// Where not all solutions fit, as many are listed as take this many lines.
const LINES_OF_MANY: usize = 45;

/// A run as [`to_table`] has it, but with the first solutions only where there are too many for a few screens.
pub fn to_short_table(problem: &Problem, outcome: &Outcome, tested: Option<&Tested>) -> String {
    let each = problem.points.len() + 3;
    let most = match each * outcome.solutions.len() <= LINES {
        true => usize::MAX,
        false => (LINES_OF_MANY / each).max(1),
    };
    table(problem, outcome, tested, most)
}

/// The result in one line: name, how it ended, solutions, classes, seconds, and the reason where the
/// run stopped, or how many constraints were left out.
pub fn to_summary(problem: &Problem, outcome: &Outcome, tested: Option<&Tested>) -> String {
    let status = match (&outcome.status, outcome.mode) {
        (Status::Closed, Mode::Certified) => "closed, proved",
        (Status::Closed, Mode::Float) => "closed, observed",
        (Status::Open(_), Mode::Certified) => "open, proved",
        (Status::Open(_), Mode::Float) => "open, observed",
        (Status::Stopped(_), _) => "stopped",
    };
    let count = outcome.solutions.len();
    let straight = outcome.solutions.iter();
    let straight = straight.filter(|s| s.place.is_some_and(|place| place.folds == Some(0)));
    let mut line = format!(
        "{:<20} {status:<16} {:>13} {:>9} up to congruence {:>10.4} s",
        problem.name,
        solutions(count),
        classes(outcome),
        outcome.seconds
    );
    if straight.count() > 0 {
        line += "   one reached without a fold";
    }
    if let Some(tested) = tested {
        line += &format!("   in {} of {} {}", tested.used, tested.all, tested.what);
        if tested.missed > 0 {
            line += &format!(", {} struck out", tested.missed);
        }
    }
    if let Some(signed) = outcome.signed
        && signed.wrong + signed.undecided > 0
    {
        line += &format!(
            "   {} without the signs struck out",
            signed.wrong + signed.undecided
        );
    }
    if let Status::Stopped(reason) = &outcome.status {
        line += &format!("   {}", without_stop(reason));
    }
    line + "\n"
}

/// The first solution, reached without a fold, as a text of several lines; `None` if the outcome has none.
pub fn to_first_table(problem: &Problem, outcome: &Outcome) -> Option<String> {
    let is_first = |s: &Solution| s.place.is_some_and(|place| place.folds == Some(0));
    let index = outcome.solutions.iter().position(is_first)?;
    let mut out = format!(
        "{}: First{}: the sketch moves to this solution without turning back as its dimensions are led to their \
         targets.\n",
        problem.name,
        match outcome.mode {
            Mode::Certified => ", proved",
            Mode::Float => " (floats, not proved)",
        }
    );
    let marks = Marks::new(problem);
    write_solution(&mut out, (problem, outcome, &marks), index);
    Some(out)
}

/// What is said where the path turns back before t = 1, between these bounds on t: there is no solution that is reached
/// without a fold.
pub fn to_no_first(problem: &Problem, turns_at: Option<(f64, f64)>) -> String {
    let at = turns_at.map_or(String::new(), |(low, high)| {
        format!(" at t = {}", certain_digits(hull(low, high)))
    });
    format!(
        "{}: No solution without a fold, proved: led from the sketch to its targets the figure comes to a limit{at}, where \
         the path turns back. (Without `--first` the path is followed beyond.)\n",
        problem.name
    )
}

fn table(problem: &Problem, outcome: &Outcome, tested: Option<&Tested>, most: usize) -> String {
    let mut out = format!("{}: {}\n", problem.name, verdict(problem, outcome, tested));
    let of_signs = outcome.signed.map(|signed| signed.found);
    let found = tested
        .and_then(|tested| tested.found)
        .or(of_signs)
        .unwrap_or(0);
    if outcome.status == Status::Closed && outcome.solutions.is_empty() && found == 0 {
        match problem.impossible_triangle() {
            Some(message) => out += &format!("There can be none: {message}.\n"),
            None if moves(problem).is_some() => out += &format!("{IT_MOVES}\n"),
            None => out += &format!("{NOTHING_FOUND}\n"),
        }
    }
    let marks = Marks::new(problem);
    for index in 0..outcome.solutions.len().min(most) {
        write_solution(&mut out, (problem, outcome, &marks), index);
    }
    let left = outcome.solutions.len().saturating_sub(most);
    if left > 0 {
        out += &format!(
            "\n... and {} more: `--all` prints them, `--json FILE` writes them, `--html FILE` shows them.\n",
            solutions(left)
        );
    }
    if outcome.mode == Mode::Certified && !outcome.solutions.is_empty() {
        out += &format!("\n{DIGITS}\n");
    }
    out.push('\n');
    for (label, value) in numbers(outcome) {
        out += &format!("{label:<20}{value}\n");
    }
    out
}

/// What to do after a path without solutions.
const NOTHING_FOUND: &str = "\
This says nothing about figures that are not on this path. Other paths through the same sketch: set
`bend_coefficient = 0` (or smaller, or larger) under [homotopy], or bend another length. Or move the sketch
nearer to the figure wanted.";

/// The same where the sketch seems to move with all its constraints kept.
const IT_MOVES: &str = "\
This says nothing about figures that are not on this path, such as those through which the sketch seems to move, as floats have it:
`krawl motion --free DIMENSION` follows these.";

/// The number of classes of congruent solutions.
fn classes(outcome: &Outcome) -> usize {
    each_once(outcome.solutions.iter().map(|s| s.class)).len()
}

/// What is to be said of degenerate solutions, if there are any.
fn degenerate(outcome: &Outcome) -> String {
    let count = outcome.solutions.iter().filter(|s| s.is_degenerate).count();
    let which = match count {
        0 => return String::new(),
        1 => "One of them is a degenerate (flat) figure".to_owned(),
        n => format!("{n} of them are degenerate (flat) figures"),
    };
    match outcome.mode {
        Mode::Certified => format!(
            " {which}: each meets all constraints, and the path passes through it, heights divided by 1 − t having limits \
             there. Other flat figures that meet the constraints are as near as one likes; on the path are only those \
             listed."
        ),
        Mode::Float => format!(
            " {which}: the path was followed over t = 1 by a step, as the equations are dependent there; other flat \
             figures near them meet the constraints too."
        ),
    }
}

/// What was found, in words that claim no more than was proved.
pub(super) fn verdict(problem: &Problem, outcome: &Outcome, tested: Option<&Tested>) -> String {
    let count = outcome.solutions.len();
    let different = match (count, classes(outcome), symmetry(problem)) {
        // Constraints that say where the figure is leave nothing to be told of congruence.
        (0 | 1, _, _) | (_, _, Symmetry::Identity) => String::new(),
        (n, c, Symmetry::Motions) if n == c => {
            " No two of them are the same figure moved.".to_owned()
        }
        (_, c, Symmetry::Motions) => format!(" Up to motions they are {c}."),
        (n, c, _) if n == c => " No two of them are congruent, even up to reflection.".to_owned(),
        (_, c, _) => format!(" Up to congruence and reflection they are {c}."),
    };
    let different = different + &degenerate(outcome);
    let these = match tested {
        None => "these",
        Some(_) => "those that are not struck out",
    };
    let signed = signed_in_words(these, outcome);
    if let Some(tested) = tested {
        let path = format!(
            "with {} the path through the sketch has",
            used_in_words(tested)
        );
        let others = tested_in_words(tested) + &signed;
        return verdict_of_a_part(outcome, (path, tested.found, others), &different);
    }
    if let Some(all) = outcome.signed {
        let path = "the path through the sketch has".to_owned();
        return verdict_of_a_part(outcome, (path, Some(all.found), signed), &different);
    }
    match (outcome.mode, &outcome.status) {
        (Mode::Certified, Status::Closed) => {
            let text = match count {
                0 => "the path through the sketch has no point with t = 1".to_owned(),
                1 => "the solution listed is exactly the one point of the path through the sketch \
                      with t = 1"
                    .to_owned(),
                n => format!(
                    "the {n} solutions listed are exactly the points of the path through the \
                     sketch with t = 1"
                ),
            };
            format!("Closed, proved: {text}.{different}")
        }
        (mode, Status::Open(ends)) => {
            let both = both_ends(ends);
            let text = match (mode, count) {
                (Mode::Float, n) => {
                    return format!(
                        "Open, observed: the path through the sketch seems to have two ends, and between them it met \
                         {} (floating-point tracking, not a proof).{different}{both}",
                        solutions(n)
                    );
                }
                (Mode::Certified, 0) => "no point with t = 1".to_owned(),
                (Mode::Certified, 1) => {
                    "exactly one point with t = 1, the solution listed".to_owned()
                }
                (Mode::Certified, n) => {
                    format!("exactly {n} points with t = 1, the solutions listed")
                }
            };
            // That it does not go on there after all is not proved.
            format!(
                "Open, proved: between the two places below the path through the sketch has {text}. It seems to end at both, \
                 and was not followed beyond.{different}{both}"
            )
        }
        (Mode::Certified, Status::Stopped(reason)) => {
            let text = match count {
                0 => "No solution was proved".to_owned(),
                1 => "The solution listed is proved to lie on the path through the sketch".into(),
                n => format!(
                    "The {n} solutions listed are proved to lie on the path through the sketch"
                ),
            };
            format!(
                "Stopped: {}. {text}; there may be more.{}",
                without_stop(reason),
                degenerate(outcome)
            )
        }
        (Mode::Float, Status::Closed) => format!(
            "Closed, observed: the path came back to the sketch and met {} (floating-point \
             tracking, not a proof).{different}",
            solutions(count)
        ),
        (Mode::Float, Status::Stopped(reason)) => format!(
            "Stopped: {}. Up to there the path met {} (floating-point tracking, not a proof); \
             there may be more.{different}",
            without_stop(reason),
            solutions(count)
        ),
    }
}

/// Where and why a path ends, both ways.
fn both_ends(ends: &[PathEnd; 2]) -> String {
    let place = |end: &PathEnd| {
        let t = 0.5 * (end.t.0 + end.t.1);
        // No zero with a sign.
        let t = if t.abs() < 5e-7 { 0.0 } else { t };
        let reason = end.in_words();
        match end.kind {
            // What happens there happens somewhat farther on.
            EndKind::Infinite => format!("followed to t = {t:.6}, {reason}"),
            _ => format!("at t = {t:.6}, {reason}"),
        }
    };
    format!(
        "\n  One end: {}.\n  The other: {}.",
        place(&ends[0]),
        place(&ends[1])
    )
}

/// Which constraints are used of those that there are.
fn used_in_words(tested: &Tested) -> String {
    match tested.all == tested.used {
        true => format!("the {} {} that are used", tested.used, tested.what),
        false => format!("{} of the {} {}", tested.used, tested.all, tested.what),
    }
}

/// What a path was followed with, where constraints were left out, and how its figures stand to these.
pub fn part_in_words(tested: &Tested) -> String {
    let figures = counted(tested.found.unwrap_or(u64::MAX) as usize, "figure");
    let (used, others) = (used_in_words(tested), tested_in_words(tested));
    format!("Followed with {used}, to {figures}.{others}")
}

/// How figures of a path, called `these`, stand to the signs that are asked for, as a sentence behind another one.
pub fn signed_in_words(these: &str, outcome: &Outcome) -> String {
    let Some(signed) = outcome.signed else {
        return String::new();
    };
    let count = outcome.solutions.len();
    let have = either(count, "has", "have");
    let mut parts = vec![format!("{count} {have} {}", signs_in_words(signed.asked))];
    if signed.mirrored > 0 {
        parts[0] += ", or their mirror images have, which are listed then";
    }
    if signed.wrong > 0 {
        let are = either(
            signed.wrong as usize,
            "has not and is no solution",
            "have not and are no solutions",
        );
        parts.push(format!("{} {are}", signed.wrong));
    }
    if signed.undecided > 0 {
        let n = signed.undecided;
        parts.push(format!(
            "of {n} a sign cannot be told: not listed, and maybe a solution"
        ));
    }
    let again = signed.found - signed.wrong - signed.undecided - count as u64;
    if again > 0 {
        let are = either(
            again as usize,
            "is the mirror image of one",
            "are mirror images of some",
        );
        parts.push(format!("{again} {are} of them and the same figure then"));
    }
    format!(" Of {these} {}.", parts.join("; "))
}

/// What was found where figures of the path were struck out, and how the figures stand to what they were struck out for.
fn verdict_of_a_part(
    outcome: &Outcome,
    (path, found, others): (String, Option<u64>, String),
    different: &str,
) -> String {
    let (exactly, points) = match found.unwrap_or(u64::MAX) {
        0 => ("", "no point with t = 1".to_owned()),
        1 => ("exactly ", "one point with t = 1".to_owned()),
        n => ("exactly ", format!("{n} points with t = 1")),
    };
    let proved = match outcome.mode {
        Mode::Certified => "proved",
        Mode::Float => "observed (floating-point tracking, not a proof)",
    };
    match &outcome.status {
        Status::Closed => format!("Closed, {proved}: {path} {exactly}{points}.{others}{different}"),
        Status::Open(ends) => format!(
            "Open, {proved}: between the two places below, {path} {exactly}{points}. It seems to end at both, and was not followed \
             beyond.{others}{different}{}",
            both_ends(ends)
        ),
        Status::Stopped(reason) => format!(
            "Stopped: {}. Up to there {path} {points}, {proved}; there may be more.{others}{different}",
            without_stop(reason)
        ),
    }
}

fn solutions(count: usize) -> String {
    match count {
        0 => "no solution".to_owned(),
        n => counted(n, "solution"),
    }
}

fn without_stop(reason: &str) -> &str {
    reason.trim_end().trim_end_matches('.')
}

/// Where on the path a solution is, and what it has turned over beside the sketch.
fn write_marks(
    out: &mut String,
    problem: &Problem,
    outcome: &Outcome,
    marks: &Marks,
    solution: &Solution,
) {
    let mut parts = Vec::new();
    if let Some(place) = solution.place {
        parts.push(format!(
            "{:.4} of {:.4} along the path",
            place.arc, outcome.length
        ));
    }
    let (turned, flat, all) = marks.turned(solution);
    let what = match problem.dimension {
        2 => "triangles",
        _ => "tetrahedra",
    };
    let named = |sets: &[&[usize]]| {
        let all = sets.iter().map(|set| names(problem, set).join(" "));
        list(&all.collect::<Vec<_>>(), TURNED)
    };
    match (turned.len(), flat.len()) {
        _ if all == 0 => {}
        (0, 0) => parts.push(format!("all {what} as in the sketch")),
        (n, 0) if n == all => parts.push(format!("all {what} turned over")),
        (0, _) => {}
        _ => parts.push(format!(
            "{} of {all} {what} turned over: {}",
            turned.len(),
            named(&turned)
        )),
    }
    if !flat.is_empty() {
        parts.push(format!("flat, or too near to tell: {}", named(&flat)));
    }
    match parts.is_empty() {
        true => {}
        false => *out += &format!("  ({})\n", parts.join("; ")),
    }
}

/// Triangles and tetrahedra that are named.
const TURNED: usize = 6;

fn write_solution(
    out: &mut String,
    (problem, outcome, marks): (&Problem, &Outcome, &Marks),
    index: usize,
) {
    let solution = &outcome.solutions[index];
    *out += &format!("\nSolution {}, class {}", index + 1, solution.class);
    if let Some(other) = solution.mirror_of {
        *out += &format!(", mirror image of solution {}", other + 1);
    }
    if solution.is_degenerate {
        *out += ", degenerate (flat)";
    }
    match solution.place.and_then(|place| place.folds) {
        None => {}
        Some(0) => *out += ", reached without a fold",
        Some(1) => *out += ", after a fold",
        Some(folds) => *out += &format!(", after {folds} folds"),
    }
    match outcome.mode {
        Mode::Certified => *out += &format!(", relative width {:.1e}\n", solution.width),
        Mode::Float => out.push('\n'),
    }
    write_marks(out, problem, outcome, marks, solution);
    let digits = |x: &Interval| digits(outcome.mode, x);
    write_points(out, problem, &solution.points, digits);
    write_objects(out, problem, outcome.mode, &solution.objects)
}

/// Objects that are not told by their points: a line for each.
pub(super) fn write_objects(out: &mut String, problem: &Problem, mode: Mode, objects: &[Located]) {
    let digits = |x: &Interval| digits(mode, x);
    let place = |x: &[Interval; 3]| in_brackets(&x[..problem.dimension], &digits);
    for (object, at) in problem.objects.iter().zip(objects) {
        let name = &object.name;
        match (&object.shape, at) {
            (Shape::FreeLine { .. }, Located::Line { point, direction }) => {
                let (point, direction) = (place(point), place(direction));
                *out += &format!("  line {name}: through {point}, direction {direction}\n");
            }
            (Shape::FreePlane { .. }, Located::Plane { point, normal }) => {
                let (point, normal) = (place(point), place(normal));
                *out += &format!("  plane {name}: through {point}, normal {normal}\n");
            }
            (
                Shape::Round { center, .. } | Shape::Arc { center, .. },
                Located::Round { radius, .. },
            ) => {
                let (kind, center) = (
                    object.kind(problem.dimension),
                    &problem.points[*center].name,
                );
                *out += &format!(
                    "  {kind} {name}: centre {center}, radius {}\n",
                    digits(radius)
                );
            }
            (Shape::Number { .. }, Located::Number(value)) => {
                *out += &format!("  {name} = {}\n", digits(value));
            }
            _ => {}
        }
    }
    write_joints(out, problem, objects, &digits)
}

fn in_brackets(numbers: &[Interval], digits: &dyn Fn(&Interval) -> String) -> String {
    let all: Vec<String> = numbers.iter().map(digits).collect();
    format!("({})", all.join(", "))
}

/// Joints and the bodies between them that move, a line each: `digits` has a number as text.
pub(super) fn write_joints(
    out: &mut String,
    problem: &Problem,
    objects: &[Located],
    digits: &dyn Fn(&Interval) -> String,
) {
    let place = |x: &[Interval; 3]| in_brackets(&x[..problem.dimension], digits);
    for (object, at) in problem.objects.iter().zip(objects) {
        if let Located::Joint { turn, travel } = at {
            let turn = turn
                .as_ref()
                .map(|x| format!("turned by {} degrees", digits(x)));
            let travel = travel
                .as_ref()
                .map(|x| format!("drawn out by {}", digits(x)));
            let told: Vec<String> = turn.into_iter().chain(travel).collect();
            if !told.is_empty() {
                *out += &format!("  joint {}: {}\n", object.name, told.join(", "));
            }
        }
    }
    let standing = problem.standing_bodies();
    for (index, (object, at)) in problem.objects.iter().zip(objects).enumerate() {
        if let (Located::Pose { at, axes }, false) = (at, standing.contains(&index)) {
            let [x, _, z] = axes.each_ref().map(place);
            let turned = match problem.dimension {
                2 => format!("x axis {x}"),
                _ => format!("x axis {x}, z axis {z}"),
            };
            *out += &format!("  body {}: at {}, {turned}\n", object.name, place(at));
        }
    }
}

/// The digits of a number that a mode is certain of.
fn digits(mode: Mode, x: &Interval) -> String {
    match mode {
        Mode::Certified => certain_digits(*x),
        Mode::Float => float_digits(x.mid()),
    }
}

/// Twelve digits, which float mode usually has.
fn float_digits(x: f64) -> String {
    if x == 0.0 {
        "0".to_owned()
    } else if (1e-4..1e7).contains(&x.abs()) {
        let whole = x.abs().log10().floor().max(0.0) as usize;
        format!("{x:.*}", 11 - whole.min(11))
    } else {
        format!("{x:.11e}")
    }
}

fn numbers(outcome: &Outcome) -> Vec<(&'static str, String)> {
    let (lo, hi) = outcome.t_range;
    let (mode, space) = (outcome.mode.name(), outcome.space.name());
    let mut rows = vec![
        ("mode, space", format!("{mode}, {space}")),
        ("steps", outcome.steps.to_string()),
        ("rejected steps", outcome.rejected.to_string()),
        ("changes of plan", outcome.plan_changes.to_string()),
    ];
    if outcome.space == Space::Reduced {
        let driving = outcome.driving;
        let text = format!("{:.2} on average, {} at most", driving.average, driving.max);
        rows.push(("driving parameters", text));
    }
    rows.push(("length of the path", format!("{:.4}", outcome.length)));
    // All of the path is between these.
    let (lo, hi) = (Bound::Lower.decimals(lo, 6), Bound::Upper.decimals(hi, 6));
    rows.push(("range of t", format!("{lo} to {hi}")));
    rows.push(("seconds", format!("{:.4}", outcome.seconds)));
    for (index, text) in outcome.switched_on.iter().enumerate() {
        rows.push((if index == 0 { "switched on" } else { "" }, text.clone()));
    }
    rows
}
