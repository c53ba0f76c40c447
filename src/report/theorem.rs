//! What a certificate proves, in words.

use super::certain_digits;
use crate::certificate::{Outcome, Verdict};
use crate::constraint::{Symmetry, symmetry};
use crate::interval::{Bound, Interval, point};
use crate::problem::{Problem, Target, counted};
use std::time::Duration;

/// The theorem that was checked, or the claim that failed, with the numbers of the check.
pub fn theorem(verdict: &Verdict, time: Duration) -> String {
    let name = &verdict.problem.name;
    let (low, high) = verdict.t_range;
    let (from, to) = (
        Bound::Lower.decimals(low, 6),
        Bound::Upper.decimals(high, 6),
    );
    let mut out = match &verdict.outcome {
        Outcome::Verified if verdict.motion.is_some() => {
            format!("{name}: VERIFIED.\nTheorem. {}", motion(verdict))
        }
        Outcome::Verified if !verdict.arcs.is_empty() => edits(verdict),
        Outcome::Verified => {
            let count = verdict.solutions.len();
            let regular = regular_in_words(verdict);
            let (first, curve, on_it) = match verdict.is_open {
                true => (
                    format!(
                        "From the sketch both ways the certificate's tubes hold an arc of S, {regular}"
                    ),
                    "The arc",
                    "it",
                ),
                false => (format!("S is a closed curve, {regular}"), "S", "S"),
            };
            format!(
                "{name}: VERIFIED.\n\
                 Theorem. Let H(X, t) = 0 be the equations of the problem in this certificate, \
                 for the exact decimals in it, and S {}.\n\
                 1. {first}.\n\
                 2. {curve} has exactly {} with t = 1{}, one in each of {}; {}.\n\
                 3. On {on_it} t stays between {from} and {to}, and all lengths stay positive.\n",
                curve_in_words(verdict),
                counted(count, "point"),
                degenerate_in_words(verdict),
                counted(count, "disjoint box"),
                classes_in_words(&verdict.problem, &verdict.classes)
            )
        }
        Outcome::Partial(reason) if verdict.motion.is_some() => format!(
            "{name}: INCOMPLETE. The certificate ends early: {reason}.\nVerified so far: {}",
            motion(verdict)
        ),
        Outcome::Partial(reason) if verdict.is_edit => {
            let until = format!(
                "{name}: INCOMPLETE. The certificate ends early: {reason}.\n\
                 Verified: the last edit leads the figure without a fold to about t = {:.6}, and before it:\n",
                high.max(0.0)
            );
            until + &edits(verdict)
        }
        Outcome::Partial(reason) if verdict.tubes == 0 => format!(
            "{name}: INCOMPLETE. The certificate ends before its first tube: {reason}.\n\
             Nothing was verified, and nothing is claimed of the curve through the sketch.\n"
        ),
        Outcome::Partial(reason) => format!(
            "{name}: INCOMPLETE. The certificate ends early: {reason}.\n\
             Verified so far: an arc of the curve through the sketch, {}, with t between {from} and \
             {to}, and on it exactly {} with t = 1{}. Nothing is claimed of the rest of \
             the curve.\n",
            regular_in_words(verdict),
            counted(verdict.solutions.len(), "point"),
            degenerate_in_words(verdict)
        ),
        Outcome::NotProved(flaw) => format!(
            "{name}: NOT PROVED. This claim may be true, but the checker's test is too coarse for it:\n\
             {flaw}.\n"
        ),
        Outcome::Refuted(flaw) => format!("{name}: REFUTED. This claim is false:\n{flaw}.\n"),
    };
    let is_listed = matches!(verdict.outcome, Outcome::Verified | Outcome::Partial(_));
    if is_listed && verdict.motion.is_none() {
        for (k, solution) in verdict.solutions.iter().enumerate() {
            let what = match verdict.degenerate[k] {
                true => ", degenerate (flat)",
                false => "",
            };
            out += &format!("  solution {}{what}\n", k + 1);
            write_figure(&mut out, verdict, solution);
        }
    }
    let margin = match verdict.tubes {
        0 => String::new(),
        _ => format!(", smallest margin of a Krawczyk test {:.4}", verdict.margin),
    };
    out += &format!(
        "tubes checked {}{margin}, {:.3} s, written by {}\n",
        verdict.tubes,
        time.as_secs_f64(),
        verdict.program.escape_debug()
    );
    out
}

fn write_figure(out: &mut String, verdict: &Verdict, figure: &[[Interval; 3]]) {
    for (point, place) in verdict.problem.points.iter().zip(figure) {
        let place = place.iter().take(verdict.problem.dimension);
        let place: Vec<String> = place.map(|&x| certain_digits(x)).collect();
        *out += &format!("    {:<12} {}\n", point.name, place.join("  "));
    }
}

/// How many of the solutions are degenerate.
fn degenerate(verdict: &Verdict) -> usize {
    verdict.degenerate.iter().filter(|&&is| is).count()
}

/// What S is.
fn curve_in_words(verdict: &Verdict) -> &'static str {
    match degenerate(verdict) {
        0 => "the connected component of the sketch at t = 0",
        _ => {
            "the curve of solutions of these equations through the sketch at t = 0, which goes on through degenerate (flat) \
             figures at t = 1 so that heights over 1 − t stay continuous"
        }
    }
}

/// Where S is regular.
fn regular_in_words(verdict: &Verdict) -> &'static str {
    match degenerate(verdict) {
        0 => "regular along its whole length",
        _ => {
            "regular along its whole length: at degenerate figures in the equations with heights divided by 1 − t, and \
             elsewhere in the given ones"
        }
    }
}

/// How many of the solutions are degenerate, if any are.
fn degenerate_in_words(verdict: &Verdict) -> String {
    let figures = match degenerate(verdict) {
        0 => return String::new(),
        1 => "1 of them a degenerate (flat) figure".to_owned(),
        n => format!("{n} of them degenerate (flat) figures"),
    };
    format!(", {figures} with other flat figures that meet the constraints as near as one likes")
}

/// More edits than that are not told one by one.
const SHOWN: usize = 12;

fn edits(verdict: &Verdict) -> String {
    let mut out = String::new();
    let (name, count) = (&verdict.problem.name, verdict.arcs.len());
    if verdict.outcome == Outcome::Verified {
        out += &format!(
            "{name}: VERIFIED.\n\
             Theorem. Every figure below is the one and only continuation of the one before, the first one of the sketch: \
             between the two there is exactly one figure on the way for every t, and none of them is singular.\n"
        );
    }
    for (k, arc) in verdict.arcs.iter().enumerate() {
        if k > 0 && k + SHOWN < count {
            continue;
        }
        let led = arc.claim.dimensions.iter().map(|(index, value)| {
            let name = verdict.problem.dimension_name(*index as usize);
            format!("{name} to {value}")
        });
        let what = match arc.claim.dimensions.is_empty() {
            true => "the sketch is led to its own dimensions".to_owned(),
            false => led.collect::<Vec<_>>().join(", "),
        };
        let end = match arc.t == point(1.0) {
            true => "reached".to_owned(),
            false => format!(
                "limit: a fold at t = {}, where the path turns back",
                certain_digits(arc.t)
            ),
        };
        let kept = counted(arc.claim.kept.len(), "sign");
        out += &format!("  edit {}: {what}: {end}; {kept} kept\n", k + 1);
    }
    if let Some(arc) = verdict.arcs.last() {
        write_figure(&mut out, verdict, &arc.figure);
    }
    out
}

/// How a figure moves, and the figure that it sets out from.
fn motion(verdict: &Verdict) -> String {
    let (problem, (low, high)) = (&verdict.problem, verdict.t_range);
    let mut led = verdict.motion.iter().flat_map(|claim| &claim.dimensions);
    let Some((index, value)) = led.next() else {
        return String::new();
    };
    let name = problem.dimension_name(*index as usize);
    let distance = problem.distances.get(*index as usize);
    let range = distance.filter(|_| low <= high).map(|distance| {
        // It is led in step with t.
        let [from, to] = [distance.target.clone(), Target::Length(value.clone())];
        let [from, to] = [from.enclose(), to.enclose()];
        let at = |t: f64| from + point(t) * (to - from);
        let both = at(low).convex_hull(at(high));
        format!(
            " {name} stays between {} and {}.",
            Bound::Lower.decimals(both.inf(), 6),
            Bound::Upper.decimals(both.sup(), 6)
        )
    });
    let from = match verdict.arcs.is_empty() {
        true => "The sketch meets its dimensions, exactly.",
        false => {
            "The sketch is led to its dimensions, to the figure below, the one and only continuation of it."
        }
    };
    let what = match (&verdict.outcome, verdict.is_open) {
        (Outcome::Verified, false) => {
            "these figures are a closed curve, regular along its whole length: the figure comes back to where it set out from, and \
             without taking it apart no other can be reached"
        }
        _ => {
            "the certificate's tubes hold an arc of these figures, regular along its whole length: nowhere on it could the figure go \
             another way, and nothing is claimed of what is beyond"
        }
    };
    let mut out = format!(
        "{from} From there on all constraints of the problem in this certificate stand still but for {name}: {what}.{}\n",
        range.unwrap_or_default()
    );
    if let Some(arc) = verdict.arcs.last() {
        write_figure(&mut out, verdict, &arc.figure);
    }
    out
}

fn classes_in_words(problem: &Problem, classes: &[u32]) -> String {
    let (congruent, none) = match symmetry(problem) {
        Symmetry::Isometries => (
            "congruent up to reflection",
            "are congruent, even up to reflection",
        ),
        Symmetry::Motions => ("the same figure moved", "are the same figure moved"),
        Symmetry::Identity => ("the same", "are the same"),
    };
    let mut groups: Vec<String> = Vec::new();
    for class in 0..=classes.iter().copied().max().unwrap_or(0) {
        let of_class = (0..classes.len()).filter(|&k| classes[k] == class);
        let members: Vec<String> = of_class.map(|k| (k + 1).to_string()).collect();
        if members.len() > 1 {
            groups.push(members.join(" and "));
        }
    }
    if groups.is_empty() {
        format!("no two of them {none}")
    } else {
        format!("{congruent} are {}, and no others", groups.join("; "))
    }
}
