//! Complex solutions, as text and for programs.

use super::certain_digits;
use super::document::{Complex, ManyDigits, names, text};
use crate::certificate::complex::{ComplexFlaw, ComplexVerdict};
use crate::complex::infinity::{Departure, Split};
use crate::complex::{Lowered, Nature, SolutionBox, Solutions, Status};
use crate::constraint::{Symmetry, symmetry};
use crate::interval::{Interval, point};
use crate::places::Each as _;
use crate::problem::{Problem, counted, either, list};

/// The real and imaginary part of an unknown, in the problem's unit.
fn parts(lowered: &Lowered, one: &SolutionBox, unknown: usize) -> [Interval; 2] {
    let system = &lowered.system;
    // A power of two: exact.
    let unit = point(system.unit.powi(system.unknowns[unknown].power));
    [2 * unknown, 2 * unknown + 1].each(|i| one.parts[i] * unit)
}

/// A coordinate; zero where the gauge fixes it. Of a real solution the imaginary part is zero.
pub(super) fn coordinate(
    lowered: &Lowered,
    one: &SolutionBox,
    nature: Nature,
    unknown: Option<usize>,
) -> [Interval; 2] {
    let zero = point(0.0);
    let Some(unknown) = unknown else {
        return [zero; 2];
    };
    let [re, im] = parts(lowered, one, unknown);
    match nature {
        Nature::Real => [re, zero],
        _ => [re, im],
    }
}

/// The unknowns that are no coordinates of points.
pub(super) fn others(lowered: &Lowered) -> Vec<usize> {
    let system = &lowered.system;
    let is_coordinate = |u: &usize| system.points.iter().flatten().any(|c| *c == Some(*u));
    (0..system.unknowns.len())
        .filter(|u| !is_coordinate(u))
        .collect()
}

/// What people named in equations of their own, in a solution.
pub fn named_numbers(
    (problem, lowered): (&Problem, &Lowered),
    one: &SolutionBox,
    nature: Nature,
) -> Vec<(String, [Interval; 2])> {
    let named = others(lowered).into_iter().filter_map(|u| {
        let name = &lowered.system.unknowns[u].name;
        let mut objects = problem.objects.iter();
        objects.find(|object| object.name == *name)?;
        Some((name.clone(), coordinate(lowered, one, nature, Some(u))))
    });
    named.collect()
}

/// The vectors that vanish in a solution, as far as its box tells, and must not in a figure.
pub(super) fn vanishing<'a>(
    lowered: &'a Lowered,
    one: &'a SolutionBox,
) -> impl Iterator<Item = &'a str> {
    let part = |unknown: usize, k: usize| one.parts.get(2 * unknown + k).copied();
    let may_be_zero = move |&[from, to]: &[usize; 2]| {
        let at = |unknown, k| part(unknown, k).unwrap_or(point(0.0));
        from == to || (0..2).all(|k| (at(from, k) - at(to, k)).contains(0.0))
    };
    let vectors = lowered.system.nonzero.iter();
    let vectors = vectors.filter(move |(_, vector)| vector.iter().all(may_be_zero));
    vectors.map(|(name, _)| name.as_str())
}

/// Which solutions are no figures, for people; empty if all are.
fn no_figures(lowered: &Lowered, result: &Solutions) -> String {
    let pairs = result.boxes.boxes().iter().zip(&result.natures);
    let of: Vec<(&str, Nature)> = pairs
        .filter_map(|(one, &nature)| Some((vanishing(lowered, one).next()?, nature)))
        .collect();
    let Some((vector, _)) = of.first() else {
        return String::new();
    };
    let real = of.iter().filter(|(_, nature)| *nature == Nature::Real);
    let be = either(
        of.len(),
        "is no figure, as far as its box tells",
        "are no figures, as far as their boxes tell",
    );
    format!(
        " {} of them ({} of the real ones) {be}: {vector} vanishes there, and a constraint needs its direction.",
        of.len(),
        real.count()
    )
}

/// The result for programs, as one line of JSON.
pub fn complex_to_json(
    problem: &Problem,
    lowered: &Lowered,
    result: &Solutions,
    digits: Option<Vec<ManyDigits>>,
) -> String {
    text(&Complex {
        digits,
        ..Complex::new(problem, lowered, result)
    })
}

/// Solutions are listed in full as long as there are no more.
const MOST: usize = 20;

/// The result for people: what was found and what that means, then solutions, the real ones only unless `all`.
pub fn complex_to_table(
    problem: &Problem,
    lowered: &Lowered,
    result: &Solutions,
    all: bool,
) -> String {
    let mut out = format!("{}: {}\n", problem.name, complex_in_words(lowered, result));
    let is_absolute = lowered.system.is_absolute;
    let different = match (is_absolute, others(lowered).is_empty()) {
        (true, _) if lowered.system.is_told_by_points() => "no two are the same figure",
        (true, _) => {
            "no two agree in points and auxiliary unknowns together (in points alone they may)"
        }
        (false, true) => "no two are congruent",
        // A flat figure has normals on both sides.
        (false, false) => {
            "no two agree up to signs of axes and directions in points and auxiliary unknowns together (in points alone they may)"
        }
    };
    if !result.natures.is_empty() {
        out += &format!(
            "Each box holds exactly one solution; {different}. {}{}\n",
            natures(lowered, result),
            no_figures(lowered, result)
        );
    }
    if !result.infinite.is_empty() {
        let paths = counted(result.infinite.len(), "path");
        let where_to = match result.at_infinity() {
            0 => "as to a solution at infinity",
            _ => "to the figures at infinity below, or so it seems",
        };
        out += &format!("{paths} went beyond the radius before t = 1, {where_to}.\n");
    }
    departures(&mut out, problem, result);
    if result.repeated > 0 {
        let paths = counted(result.repeated, "path");
        let why = match result.paths_proved {
            true => "these dimensions have symmetries that others do not have",
            false => {
                "these dimensions have symmetries, or paths jumped, as they were followed in floats"
            }
        };
        let image = match is_absolute {
            true => "",
            false => " or a mirror image of one",
        };
        out += &format!("{paths} came to a solution{image} to which another had come: {why}.\n");
    }
    if result.conjugates > 0 {
        let solutions = counted(result.conjugates, "solution");
        out += &format!(
            "{solutions}, to which no path came, are conjugates of others: dimensions are real, so these are solutions too; \
             proved as all are.\n"
        );
    }
    if let Some(reason) = result.stopped.first() {
        let paths = counted(result.stopped.len(), "path");
        out += &format!("{paths} stopped, the first because {reason}\n");
    }
    let d = problem.dimension;
    let others = others(lowered);
    let listed: Vec<usize> = (0..result.natures.len())
        .filter(|&k| all || result.natures[k] == Nature::Real)
        .collect();
    let most = if all { usize::MAX } else { MOST };
    for &k in listed.iter().take(most) {
        let (one, nature) = (&result.boxes.boxes()[k], result.natures[k]);
        let what = match nature {
            Nature::Pair(other) if is_absolute => {
                format!("its conjugate is solution {}", other + 1)
            }
            Nature::Pair(other) => format!("its conjugate is congruent to solution {}", other + 1),
            Nature::Real => "real, proved".to_owned(),
            Nature::SelfConjugate if is_absolute => {
                "its own conjugate with directions reversed, not real".to_owned()
            }
            Nature::SelfConjugate => "congruent to its conjugate, not real".to_owned(),
            Nature::Alone => "its conjugate was not found".to_owned(),
            Nature::Unknown => "it could not be told whether it is real".to_owned(),
        };
        let width = one.relative_width();
        out += &format!("\nSolution {}, {what}, relative width {width:.1e}\n", k + 1);
        let show = |[re, im]: [Interval; 2]| match nature {
            Nature::Real => format!("  {:>18}", certain_digits(re)),
            _ => format!(
                "  {:>18} + {:>18} i",
                certain_digits(re),
                certain_digits(im)
            ),
        };
        for (p, unknowns) in problem.points.iter().zip(&lowered.system.points) {
            out += &format!("  {}", p.name);
            for &unknown in &unknowns[..d] {
                out += &show(coordinate(lowered, one, nature, unknown));
            }
            out.push('\n');
        }
        // Of equations of one's own what people named.
        let is_named = |name: &str| problem.objects.iter().any(|object| object.name == name);
        for &unknown in &others {
            if lowered.is_of_numbers() && !is_named(&lowered.system.unknowns[unknown].name) {
                continue;
            }
            out += &format!("  {}", lowered.system.unknowns[unknown].name);
            out += &show(coordinate(lowered, one, nature, Some(unknown)));
            out.push('\n');
        }
    }
    if listed.len() > most {
        out += &format!(
            "\n{} more: `--all` lists every one, `--json` writes them\n",
            listed.len() - most
        );
    } else if !all && listed.len() < result.natures.len() {
        out += "\nReal ones are listed; `--all` lists the others too.\n";
    }
    out.push('\n');
    if !lowered.is_of_numbers() {
        out += &format!("gauge      {}\n", lowered.system.gauge);
    }
    let effort = result.effort;
    let paths = effort.paths;
    out += &format!("paths      {paths}");
    if result.paths_proved || effort.tubes > 0 {
        out += &format!(", {} tubes, {} rejected", effort.tubes, effort.rejected);
    }
    if effort.steps > 0 {
        let which = match effort.tubes {
            0 => "followed in floats",
            _ => "some of them in floats",
        };
        out += &format!(", {which}, {} steps", effort.steps);
    }
    if effort.double_steps > 0 {
        let double = effort.double_steps;
        out += &format!(", {double} of them in double-doubles, where unknowns are large");
    }
    out.push('\n');
    out += &format!("seconds    {:.4}\n", result.seconds);
    out
}

/// The figures at infinity: which points go there, and which lengths let them.
fn departures(out: &mut String, problem: &Problem, result: &Solutions) {
    if result.at_infinity() == 0 {
        return;
    }
    *out += &format!(
        "{} at infinity, proved, up to isometry; other lengths bring them back. Here lengths around the points that go away add up \
         to zero with signs:\n",
        counted(result.at_infinity(), "figure")
    );
    for Departure { split, figures } in &result.departures {
        let go = list(&names(problem, &split.inside), 4);
        let verb = either(split.inside.len(), "goes", "go");
        *out += &format!(
            "  {} where {go} {verb} away, as {}\n",
            figures.len(),
            sum_of_lengths(problem, split)
        );
    }
}

/// The lengths around a cycle with the signs with which they add up to zero.
fn sum_of_lengths(problem: &Problem, split: &Split) -> String {
    let mut text = String::new();
    for (k, [from, to]) in split.around().enumerate() {
        let joins =
            |d: &&crate::problem::Distance| d.points == [from, to] || d.points == [to, from];
        let Some(distance) = problem.distances.iter().find(joins) else {
            continue;
        };
        let falls = split.height(to) < split.height(from);
        let sign = match (k, falls) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        };
        let length = distance.target.to_f64();
        let [a, b] = [from, to].each(|p| problem.points[p].name.as_str());
        text += &format!("{sign}{length} ({a}-{b})");
    }
    text + " = 0"
}

/// What the check of a set of complex solutions showed.
pub fn complex_set_theorem(verdict: &ComplexVerdict, took: std::time::Duration) -> String {
    let name = &verdict.problem.name;
    if verdict.is_general && verdict.flaw.is_none() {
        return general_theorem(verdict, took);
    }
    let counts = format!(
        "{} up to isometry ({} of them real), {} up to rotation",
        counted(verdict.isometry, "complex solution"),
        verdict.real,
        verdict.rotation
    );
    let seconds = took.as_secs_f64();
    match (&verdict.flaw, verdict.bound) {
        (Some(ComplexFlaw::False(flaw)), _) => {
            format!("REFUTED: {name}: {flaw}. Nothing is proved.\n")
        }
        (Some(ComplexFlaw::NotProved(flaw)), _) => {
            format!("NOT PROVED: {name}: {flaw}. Nothing is proved.\n")
        }
        (None, Some(bound)) if verdict.proves_all() => {
            let away = match verdict.rotation_at_infinity() {
                0 => String::new(),
                away => format!(
                    ", of which {away} are at infinity: {}",
                    at_infinity(verdict)
                ),
            };
            format!(
                "VERIFIED: {name} has exactly {counts}, and no other isolated one: the multi-homogeneous Bézout bound of the \
                 graph is {bound}{away}. Each was proved again in {seconds:.2} s.\n"
            )
        }
        (None, bound) => {
            let mut bound = bound.map_or(String::new(), |bound| {
                format!(" There are at most {bound} isolated ones up to rotation.")
            });
            if !verdict.at_infinity.is_empty() {
                bound += &format!(" Of these at infinity are {}.", at_infinity(verdict));
            }
            format!(
                "VERIFIED: {name} has at least {counts}, no two congruent. That there are no others is not proved.{bound} Each was \
                 proved again in {seconds:.2} s.\n"
            )
        }
    }
}

/// The same where solutions are zeros of the equations that paths follow.
fn general_theorem(verdict: &ComplexVerdict, took: std::time::Duration) -> String {
    let others = match verdict.cited {
        Some(cited) => format!(
            "There is no other isolated one if there are at most {cited} up to such signs, as whoever made the set cites; that is not checked."
        ),
        None => "That there are no others is not proved.".to_owned(),
    };
    let seconds = took.as_secs_f64();
    let signs = match symmetry(&verdict.problem) {
        Symmetry::Isometries => "of axes and of directions",
        Symmetry::Motions => "of two axes and of directions",
        Symmetry::Identity => "of directions",
    };
    format!(
        "VERIFIED: the equations of {} have {} at least ({} of those given are real), of which no two differ by signs \
         {signs} alone. {others} Each was proved again in {seconds:.2} s.\n",
        verdict.problem.name,
        counted(verdict.isometry, "complex solution"),
        verdict.real
    )
}

/// The figures at infinity of a set, up to isometry.
fn at_infinity(verdict: &ComplexVerdict) -> String {
    let departures = verdict.at_infinity.iter().map(|(points, count)| {
        let names = names(&verdict.problem, points).join(", ");
        let verb = either(points.len(), "goes", "go");
        format!("{} where {names} {verb} away", counted(*count, "figure"))
    });
    departures.collect::<Vec<_>>().join(", ") + ", up to isometry"
}

/// How many are real, and so on.
fn natures(lowered: &Lowered, result: &Solutions) -> String {
    let number = |pick: &dyn Fn(&Nature) -> bool| result.natures.iter().filter(|n| pick(n)).count();
    let real = number(&|n| *n == Nature::Real);
    let own = number(&|n| *n == Nature::SelfConjugate);
    let pairs = number(&|n| matches!(n, Nature::Pair(_)));
    let rest = result.natures.len() - real - own - pairs;
    let (up_to, congruent) = match lowered.system.is_absolute {
        true => ("", "equal to their conjugates with directions reversed"),
        false => ("Up to isometry ", "congruent to their conjugates"),
    };
    let are = either(real, "is", "are");
    let mut text = format!("{up_to}{real} {are} real, {pairs} in pairs of conjugates");
    if own > 0 {
        text += &format!(", {own} {congruent} without being real");
    }
    if rest > 0 {
        text += &format!(", {rest} of which that is not known");
    }
    text + "."
}

/// What was found, in words that claim no more than was proved.
pub fn complex_in_words(lowered: &Lowered, result: &Solutions) -> String {
    let counts = result.counts_in_words(&lowered.system);
    let up_to = match lowered.system.is_absolute {
        true => "",
        false => " up to rotation",
    };
    match (&result.status, &lowered.bound) {
        (Status::Complete, Some(bound)) if bound.is_cited => format!(
            "Complete if the bound that you cite holds: {counts}, each proved. There is no other isolated complex solution \
             if there are at most {}{up_to}, which is not proved here.",
            bound.count
        ),
        (_, Some(bound))
            if bound.is_cited
                && result.counts.certain
                && bound.count < result.counts.rotation as u128 =>
        {
            format!(
                "The bound that you cite is wrong: at most {}{up_to}, and {counts} are proved.",
                bound.count
            )
        }
        (Status::Complete, Some(bound)) => format!(
            "Complete, proved: {counts}. There is no other isolated complex solution: {} is {}{}.",
            bound.source,
            bound.count,
            match 2 * result.at_infinity() {
                0 => String::new(),
                lost => format!(", of which {lost} are at infinity, proved"),
            }
        ),
        (Status::Complete, None) | (Status::Found, _) => {
            let bound = match &lowered.bound {
                Some(bound) => format!("; {} is {}{up_to}", bound.source, bound.count),
                None => String::new(),
            };
            format!("Found, each proved: {counts}. That there are no others is not proved{bound}.")
        }
        (Status::Partial, _) => {
            let found = match result.natures.is_empty() {
                true => "no complex solution was found".to_owned(),
                false => format!("{counts}, each proved"),
            };
            format!("Partial: {found}; some paths could not be followed, and there may be more.")
        }
    }
}
