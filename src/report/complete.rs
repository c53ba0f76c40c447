//! All solutions, for people and for programs.

use super::columns::{DIGITS, write_digits};
use super::document::all_names;
use super::supposed::supposed;
use super::table::write_objects;
use crate::blocks::{Account, LeftOut, rounded_down, rounded_up};
use crate::certificate::cover::CoverVerdict;
use crate::complete::{Among, Choice, Complete, Method, Status, Tested, Why};
use crate::constraint::{Symmetry, symmetry};
use crate::problem::{Object, Problem, Shape, counted, either, list};
use crate::track::{Mode, Solution};

/// Of the parts that a sketch falls apart into, so many are shown.
const SHOWN: usize = 12;

/// Of the names of what was left out, so many are listed.
const LISTED: usize = 24;

/// How a solution stands to what was left out, if anything was.
pub(super) fn figure(result: &Complete, index: usize) -> &[LeftOut] {
    let tested = result.tested.as_ref();
    tested.map_or(&[], |tested| &tested.figures[index])
}

pub(super) fn why(why: Why) -> &'static str {
    match why {
        Why::Flexible => "a curve of solutions seems to go through here",
        Why::Small => "a solution that is singular or nearly so, or centres of a step in line",
        Why::Unfinished => "the search was ended before",
        Why::GivenUp => "given up, as too many parts there stay undecided",
        Why::Unbounded => "unknowns that may be as large as they like",
        Why::Vanishing => {
            "whether a vector that must not vanish has a length, or a length is positive, is not certain"
        }
        Why::Border => {
            "a solution at the end of a range, or so near to it that it may be out of it"
        }
        Why::Sign => "a figure of which a sign that is asked for cannot be told",
        Why::Apart => "solutions too close to each other to be told apart",
    }
}

/// Which points are in the same place in all solutions, where there are so many that it is not told with each.
fn standing(solutions: &[Solution]) -> Vec<bool> {
    /// From so many on.
    const MANY: usize = 3;
    let [first, rest @ ..] = solutions else {
        return Vec::new();
    };
    let is_same = |p: usize| rest.iter().all(|other| other.points[p] == first.points[p]);
    let points = 0..first.points.len();
    points
        .map(|p| solutions.len() >= MANY && is_same(p))
        .collect()
}

/// The result as a text of several lines: what is proved, the solutions, the numbers of the search.
pub fn complete_to_table(problem: &Problem, result: &Complete) -> String {
    let mut out = format!("{}: {}\n", problem.name, complete_in_words(problem, result));
    for part in &result.undecided {
        let parts = counted(part.count as usize, "part");
        let share = 100.0 * part.share;
        if part.why == Why::Sign {
            let figures = counted(part.count as usize, "figure");
            out += &format!(
                "  undecided: {figures} of which a sign that is asked for cannot be told\n"
            );
            continue;
        }
        out += &format!(
            "  undecided: {parts} ({} % of {}): {}\n",
            percent(share),
            match result.method {
                Method::Coordinates => "the space of coordinates",
                _ => "the parameter space",
            },
            why(part.why)
        );
    }
    let standing = standing(&result.solutions);
    if let Some(first) = result.solutions.first()
        && standing.contains(&true)
    {
        out += "\nIn all of them\n";
        write_digits(&mut out, problem, &first.points, |p| standing[p]);
    }
    for (index, solution) in result.solutions.iter().enumerate() {
        out += &format!(
            "\nSolution {}, relative width {:.1e}\n",
            index + 1,
            solution.width
        );
        write_digits(&mut out, problem, &solution.points, |p| !standing[p]);
        write_objects(&mut out, problem, Mode::Certified, &solution.objects);
        let account = Account {
            left_out: figure(result, index).to_vec(),
            ..Account::default()
        };
        if !account.left_out.is_empty() {
            out += &format!("  {}\n", account.left_out_in_words());
        }
    }
    let listed = result.solutions.len();
    if result.count.is_none_or(|count| count > listed as u64) {
        out += &format!("\nThe first {listed} are listed.\n");
    }
    if !result.solutions.is_empty() {
        out += &format!("\n{DIGITS}\n");
    }
    write_choices(&mut out, &result.choices);
    if let Some(first) = &result.first_choice {
        out += &format!(
            "\nThe sketch falls apart once these are placed, in one of {}: {}. Beside each of them the solutions are all combinations of what the rest has.\n",
            counted(first.count, "way"),
            match first.names.is_empty() {
                true => "lengths or directions without a name".to_owned(),
                false => first.names.join(", "),
            }
        );
    }
    for part in &result.parts {
        let (names, verdict) = (
            all_names(&part.problem).join(", "),
            complete_in_words(&part.problem, &part.result),
        );
        out += &format!("\nPart {names}: {verdict}\n");
    }
    out.push('\n');
    match result.method {
        Method::Coordinates | Method::Complex => {
            out += &format!("unknowns            {}\n", result.driving);
        }
        _ => out += &format!("driving parameters  {}\n", result.driving),
    }
    if let Some(it) = result.constructed {
        out += &format!(
            "constructed         {} step by step, driven by {}\n",
            counted(it.unknowns, "unknown"),
            counted(it.parameters, "parameter")
        );
    }
    if let Some(count) = result.complex {
        out += &format!(
            "complex solutions   {count}, proved: as many as the product of the degrees allows\n"
        );
    }
    if !result.turned.is_empty() {
        out += &format!("rotations of        {}\n", result.turned.join(", "));
    }
    if result.complex.is_none() {
        out += &format!("boxes               {}\n", result.boxes);
    }
    out += &format!("seconds             {:.4}\n", result.seconds);
    match result.seconds_left {
        Some(left) if left.is_finite() => {
            let left = span(left);
            out += &format!(
                "left                perhaps {left}, if it goes on as in the second half of the time\n"
            );
        }
        Some(_) => {
            out += "left                no piece of it was finished: the same time again would lead no farther\n"
        }
        None if result.was_ended() && result.method != Method::Blocks => {
            out += "left                no estimate: in the second half of the time less than a thousandth of the rest was finished\n"
        }
        None => {}
    }
    out
}

/// Of what the figures are combinations.
fn write_choices(out: &mut String, choices: &[Choice]) {
    if choices.is_empty() {
        return;
    }
    let mut factors: Vec<(usize, usize)> = Vec::new();
    for choice in choices {
        match factors.iter_mut().find(|(count, _)| *count == choice.count) {
            Some((_, times)) => *times += 1,
            None => factors.push((choice.count, 1)),
        }
    }
    let factors = factors.iter().map(|&(count, times)| match times {
        1 => count.to_string(),
        _ => format!("{count}^{times}"),
    });
    *out += &format!(
        "\nThe sketch falls apart into {} that do not depend on each other; the solutions are all combinations of theirs, {}:\n",
        counted(choices.len(), "part"),
        factors.collect::<Vec<_>>().join(" · ")
    );
    for choice in choices.iter().take(SHOWN) {
        let names = match choice.names.is_empty() {
            true => "a length or direction without a name".to_owned(),
            false => choice.names.join(", "),
        };
        *out += &format!("  {}: {names}\n", counted(choice.count, "place"));
    }
    match choices.len().saturating_sub(SHOWN) {
        0 => {}
        more => *out += &format!("  and {} more\n", counted(more, "part")),
    }
}

/// A share in percent: small ones by their size, others to two places that are never rounded to nothing or to all.
fn percent(share: f64) -> String {
    match share {
        0.0 => "0".to_owned(),
        _ if share < 0.01 => format!("{share:.1e}"),
        _ if share < 100.0 => format!("{:.2}", share.min(99.99)),
        _ => "100".to_owned(),
    }
}

/// A time, as people say it.
fn span(seconds: f64) -> String {
    const UNITS: [(&str, f64); 4] = [
        ("years", 3.156e7),
        ("days", 86400.0),
        ("hours", 3600.0),
        ("minutes", 60.0),
    ];
    let unit = UNITS
        .into_iter()
        .find(|(_, length)| seconds >= 2.0 * length);
    let (name, length) = unit.unwrap_or(("seconds", 1.0));
    match seconds / length {
        count if count < 10.0 => format!("{count:.1} {name}"),
        count if count < 1e6 => format!("{count:.0} {name}"),
        count => format!("{count:.0e} {name}"),
    }
}

/// What a sketch was made of to be searched, a sentence; empty where it was searched as it is.
pub fn made_in_words(made: &Account) -> String {
    match made.clause() {
        clause if clause.is_empty() => clause,
        clause => format!("The sketch was searched with as many equations as unknowns, {clause}."),
    }
}

/// What was found, in words that claim no more than was proved.
pub fn complete_in_words(problem: &Problem, result: &Complete) -> String {
    let signed = result.signed.unwrap_or_default();
    let mut struck = match (signed.cut, signed.wrong) {
        (0, 0) => String::new(),
        (cut, wrong) => format!(
            " With other signs {} of the search and {} were struck out.",
            counted(cut as usize, "part"),
            counted(wrong as usize, "figure")
        ),
    };
    if signed.undecided > 0 {
        let figures = counted(signed.undecided as usize, "figure");
        struck += &format!(" Of {figures} a sign cannot be told: these are not counted.");
    }
    let mut words = without_sides(problem, result);
    if result.count != Some(0) {
        words += &both_ways_in_words(&result.both_ways);
    }
    words + &struck + &supposed(problem)
}

/// That figures with either direction of some lines and planes, if there are any, are counted.
pub(super) fn both_ways_in_words(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    let (of, them) = match names.len() {
        0 => return String::new(),
        1 => ("", "it"),
        _ => ("each of ", "them"),
    };
    format!(
        " Both directions of {of}{} are counted: what is on one side of {them} may be on the other.",
        names.join(", ")
    )
}

/// The same but for what is said of sides and lengths.
fn without_sides(problem: &Problem, result: &Complete) -> String {
    let (up_to, different) = counted_once(problem, result.symmetry);
    let (count, have) = match &result.tested {
        None => (counted_or_many(result.count, "solution"), String::new()),
        Some(tested) => (
            counted_or_many(tested.found, "figure"),
            format!(
                " with {} of the {} {}",
                tested.used, tested.all, tested.what
            ),
        ),
    };
    let with = match &have[..] {
        "" => " with",
        _ => " and",
    };
    let have = match result.signed {
        None => have,
        Some(signed) => format!("{have}{with} {}", signs_in_words(signed.asked)),
    };
    let have = match have.is_empty() {
        true => in_ranges(problem),
        false => have + &in_ranges(problem).replacen(" with", " and", 1),
    };
    let tested = result
        .tested
        .as_ref()
        .map_or_else(String::new, tested_in_words);
    let found = result
        .tested
        .as_ref()
        .map_or(result.count, |tested| tested.found);
    let space = match result.method {
        Method::Plan => "the parameter space",
        Method::Coordinates | Method::Complex => "the space of coordinates",
        Method::Blocks => "the parts' parameter spaces",
    };
    // Boxes of figures that are not listed were not compared with these.
    let is_listed = result.count == Some(result.solutions.len() as u64);
    match result.status {
        Status::Complete if found == Some(0) => format!(
            "Complete, proved: there is no solution{have}; {}.{tested}",
            result.reason.as_deref().unwrap_or("nothing is undecided")
        ),
        Status::Complete => {
            let each = match is_listed {
                true => "Each box holds exactly one",
                false => "Each box listed holds one of them",
            };
            format!(
                "Complete, proved: {count}{have}{up_to}, and there is no other.{tested} {each}; {different}."
            )
        }
        Status::Partial | Status::Flexible => {
            let what = match result.status {
                Status::Flexible => {
                    "Flexible: a curve of solutions is seen, in floating point, in parts that stay undecided".to_owned()
                }
                _ => format!("Partial: some parts of {space} stay undecided"),
            };
            let why = result
                .reason
                .as_deref()
                .map(|r| format!(" ({r})"))
                .unwrap_or_default();
            let each = match is_listed {
                true => "each box holding exactly one",
                false => "each box listed holding one of them",
            };
            format!(
                "{what}{why}. {count}{have} proved, {each}, {}; there may be more, in the undecided \
                 parts only.{tested}",
                different.replace(" are", "")
            )
        }
    }
}

/// The signs that are asked for.
pub(super) fn signs_in_words(asked: usize) -> String {
    match asked {
        1 => "the sign asked for (`orientation`)".to_owned(),
        n => format!("the {n} signs asked for (`orientation`)"),
    }
}

/// How the figures that were found stand to what was left out, as sentences behind another one.
pub(super) fn tested_in_words(tested: &Tested) -> String {
    let left_out = tested.left_out.len();
    let others = match left_out {
        1 => tested.left_out[0].clone(),
        _ => format!("the other {}", tested.all - tested.used),
    };
    let mut parts = Vec::new();
    if tested.met > 0 {
        let meet = either(tested.met, "meets", "meet");
        parts.push(format!(
            "{} {meet} {others} within {}",
            tested.met,
            rounded_up(tested.within)
        ));
    }
    if tested.missed > 0 {
        let miss = either(tested.missed, "misses", "miss");
        let are = either(tested.missed, "is no solution", "are no solutions");
        let one = either(left_out, &others, "one of them");
        let by = rounded_down(tested.by);
        parts.push(format!(
            "{} {miss} {one} by at least {by} and {are}",
            tested.missed
        ));
    }
    let mut text = String::new();
    if left_out > 0 && !parts.is_empty() {
        text += &format!(" Of these {}, proved.", parts.join("; "));
    }
    if left_out > 0 && tested.undecided > 0 {
        text += &match tested.undecided {
            1 => format!(" Of one it is not decided whether it meets {others}."),
            n => format!(" Of {n} it is not decided whether they meet {others}."),
        };
    }
    if tested.missed > 0 && tested.met + tested.undecided == 0 {
        text += " With `--redundant-tolerance` larger misses count as met.";
    }
    let looked_at = (tested.met + tested.missed + tested.undecided) as u64;
    if left_out > 0 && tested.found.is_none_or(|found| found > looked_at) {
        text += " The others were not tested, and may be no solutions.";
    }
    if left_out > 0 {
        text += &format!(" Left out: {}.", list(&tested.left_out, LISTED));
    }
    if !tested.added.is_empty() {
        text += &format!(
            " Beside these it holds {}: figures in which that is otherwise are not among these.",
            list(&tested.added, LISTED)
        );
    }
    text
}

/// A number of solutions or figures; `None`: it has no place in 64 bits.
pub(super) fn counted_or_many(count: Option<u64>, what: &str) -> String {
    match count {
        Some(count) => counted(count as usize, what),
        None => format!("more than 2^64 {what}s"),
    }
}

/// Up to what figures are counted once, and what is proved of any two then.
pub(super) fn counted_once(problem: &Problem, symmetry: Symmetry) -> (&'static str, &'static str) {
    let of_numbers = |object: &Object| matches!(object.shape, Shape::Number { .. });
    let has_numbers = problem.objects.iter().any(of_numbers);
    let (up_to, different, with_numbers) = match symmetry {
        _ if problem.points.is_empty() => return ("", "no two are the same"),
        Symmetry::Isometries => (
            " up to rigid motions and reflections",
            "no two are congruent, even up to reflection",
            "no two have the same numbers and are congruent, even up to reflection",
        ),
        Symmetry::Motions => (
            " up to rigid motions",
            "no two are the same figure moved",
            "no two have the same numbers and are the same figure moved",
        ),
        Symmetry::Identity => (
            " in the coordinates of the file",
            "no two are the same figure",
            "no two are the same figure with the same numbers",
        ),
    };
    // The same figure with other numbers is another solution.
    match has_numbers {
        true => (up_to, with_numbers),
        false => (up_to, different),
    }
}

/// How many of all figures a path has: "these are 8 of 18".
pub fn among_in_words(among: Among) -> String {
    let Among { found, all } = among;
    let these = match found {
        _ if found as u64 == all => "There is no other, on any path".to_owned(),
        0 => format!("On other paths: {all}, and no more"),
        1 => format!("This is 1 of {all}: the others are on other paths"),
        _ => format!("These are {found} of {all}: the others are on other paths"),
    };
    format!(
        "\n{these}; proved by a search up to rigid motions and reflections (`krawl all` lists them).\n"
    )
}

/// Between which numbers unknowns are sought, ` with x between 0 and 2`; empty where that may be any.
fn in_ranges(problem: &Problem) -> String {
    let ranges = problem.objects.iter();
    let ranges = ranges.filter_map(|o| Some(format!("{} {}", o.name, o.shape.range()?)));
    match ranges.collect::<Vec<String>>() {
        all if all.is_empty() => String::new(),
        all => format!(" with {}", all.join(" and ")),
    }
}

/// What a checked cover proves.
pub fn cover_theorem(verdict: &CoverVerdict, took: std::time::Duration) -> String {
    let name = &verdict.problem.name;
    let count = counted_or_many(verdict.solutions, "solution");
    let seconds = took.as_secs_f64();
    let parts = counted(verdict.parts as usize, "part");
    let (up_to, different) = counted_once(&verdict.problem, symmetry(&verdict.problem));
    let exactly = verdict.solutions.map_or("", |_| "exactly ");
    let supposed = supposed(&verdict.problem);
    let have = in_ranges(&verdict.problem);
    match &verdict.flaw {
        Some(flaw) => format!("NOT PROVED: {name}: {flaw}. Nothing is claimed.\n"),
        None if verdict.undecided == 0 => format!(
            "VERIFIED: {name} has {exactly}{count}{have}{up_to}. The cover has {parts}, each proved again in {seconds:.2} s.{supposed}\n"
        ),
        None => format!(
            "INCOMPLETE: {name} has {count}{have} at least, {different}; nothing is claimed of {} of the {parts} of the \
             cover. Any other solution lies there. Checked in {seconds:.2} s.{supposed}\n",
            verdict.undecided
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_never_rounded_to_nothing_or_all() {
        for (share, text) in [
            (0.0, "0"),
            (4.25e-34, "4.3e-34"),
            (0.5, "0.50"),
            (99.3444, "99.34"),
            (99.9999, "99.99"),
            (100.0, "100"),
        ] {
            assert_eq!(percent(share), text);
        }
    }

    #[test]
    fn times_are_in_units_that_fit() {
        for (seconds, text) in [
            (3.21, "3.2 seconds"),
            (100.0, "100 seconds"),
            (150.0, "2.5 minutes"),
            (91_500.0, "25 hours"),
            (1e7, "116 days"),
            (1e20, "3e12 years"),
        ] {
            assert_eq!(span(seconds), text);
        }
    }
}
