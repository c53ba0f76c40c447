//! What follows by the file's expressions where dimensions are set.

use super::Places;
use super::computed::{Evaluation, Numbers, is_same};
use super::quantity::Quantity;
use crate::edit::Setting;
use crate::import::drawing::decimal;
use crate::import::{Followed, Follower, Imported, Tied, value};
use crate::problem::{Point, Problem};
use std::ops::Range;

/// The first dimension that a constraint of the file is.
fn dimension_of(imported: &Imported, source: usize) -> Option<usize> {
    let mut all = imported.problem.dimensions();
    all.find(|&index| imported.sources[index] == Some(source))
}

/// The dimensions that expressions of the sketch compute.
pub fn tied(imported: &Imported, numbers: &Numbers) -> Vec<Tied> {
    let tied = numbers.tied().filter_map(|(source, expression)| {
        Some(Tied {
            index: dimension_of(imported, source)?,
            expression: expression.to_owned(),
            fault: numbers.fault(source).cloned(),
        })
    });
    tied.collect()
}

/// The names of dimensions that the file computes and that are led, or follow from those that are.
pub fn computed(imported: &Imported, places: &Places, led: &[usize]) -> Vec<String> {
    let numbers = &places.computed;
    let led = led.iter().filter_map(|&index| {
        let source = imported.sources[index]?;
        Some((source, numbers.said(source)?, true))
    });
    let mut evaluation = Evaluation::new(numbers, led);
    let tied = imported.tied.iter().map(|tied| tied.index);
    let follow = tied
        .filter(|&index| imported.sources[index].is_some_and(|source| evaluation.number(source).1));
    follow
        .map(|index| imported.problem.dimension_name(index))
        .collect()
}

/// The sign of a dimension's number in the file against the one in the problem, by what both were as the file was read.
pub fn sign(said: f64, before: f64) -> f64 {
    if said * before < 0.0 { -1.0 } else { 1.0 }
}

/// The number of a dimension in the file, and its sign against the one in the problem.
fn signed(imported: &Imported, places: &Places, index: usize) -> Option<(Quantity, f64)> {
    let said = places.computed.said(imported.sources[index]?)?;
    let before = value(&imported.problem, index);
    Some((said, sign(said.value, before)))
}

/// What the file's expressions come to where the sketch's dimensions are as in `now`, those that have none and those that are set.
fn evaluation<'a>(
    imported: &Imported,
    places: &'a Places,
    now: &Problem,
    is_set: impl Fn(usize) -> bool,
) -> Evaluation<'a> {
    let is_tied = |index: usize| imported.tied.iter().any(|tied| tied.index == index);
    let all = now.dimensions().filter(|&i| is_set(i) || !is_tied(i));
    let given = all.filter_map(|index| {
        let (said, sign) = signed(imported, places, index)?;
        let number = said.with(sign * value(now, index));
        Some((imported.sources[index]?, number, is_set(index)))
    });
    Evaluation::new(&places.computed, given)
}

/// The variables that expressions compute, where they come to other numbers than in the file: these as text, and where they are
/// in the file.
pub fn variables(
    imported: &Imported,
    places: &Places,
    now: &Problem,
) -> Vec<(String, Range<usize>)> {
    let mut evaluation = evaluation(imported, places, now, |_| false);
    evaluation.variables()
}

/// What follows by the file's expressions where these dimensions, and cells, are set, and all others are as in `now`.
pub fn followed(imported: &Imported, places: &Places, now: &Problem, set: &[Setting]) -> Followed {
    let (numbers, before) = (&places.computed, &imported.problem);
    let is_set = |index: usize| set.iter().any(|setting| setting.index == index);
    let then = Setting::applied(set, now);
    let mut evaluation = evaluation(imported, places, &then, is_set);
    let mut followed = Followed::default();
    let is_external = |point: &Point| point.name.starts_with("external");
    if numbers.set_cells().next().is_some() && before.points.iter().any(is_external) {
        followed.warnings.push(
            "geometry of other objects stays where it is here, and may follow from the cell when the file is recomputed there".to_owned(),
        );
    }
    for (source, expression) in numbers.tied() {
        let index = dimension_of(imported, source);
        let name = match index {
            Some(index) => before.dimension_name(index),
            None => numbers.shown(numbers.entry(source)),
        };
        let has = format!("{name} has the expression `{expression}` in the file");
        if index.is_some_and(is_set) {
            followed.warnings.push(format!(
                "{has}, by which it is set anew when the file is recomputed there"
            ));
            continue;
        }
        let (found, is_new) = evaluation.number(source);
        let here = index
            .and_then(|index| Some((index, signed(imported, places, index)?.1, value(now, index))));
        let why = match (found, here) {
            (Err(why), _) if is_new || numbers.fault(source).is_some() => why,
            (Ok(by_it), Some((index, sign, here))) => match decimal(sign * by_it.value) {
                Some(value) if is_new => {
                    let expression = expression.to_owned();
                    followed.set.push(Follower {
                        index,
                        value,
                        expression,
                    });
                    continue;
                }
                // Set by hand before, perhaps.
                Some(by_it) if !is_same(by_it.to_f64(), here) => {
                    followed.warnings.push(format!(
                        "{name} is {here} here, and {by_it} by its expression `{expression}`: what is computed from it takes that"
                    ));
                    continue;
                }
                None if is_new => "the number is out of range".to_owned(),
                _ => continue,
            },
            // Zero still, as a rule.
            (Ok(by_it), None) if is_new && numbers.said(source) != Some(by_it) => {
                format!("it would be {by_it}, and there is no number here that can be led there")
            }
            _ => continue,
        };
        let stays = here.map_or(String::new(), |(_, _, here)| format!(" {here}"));
        followed.warnings.push(format!(
            "{has}, which is not followed: {why}; it stays{stays} here, and is set anew when the file is recomputed there"
        ));
    }
    let elsewhere = evaluation.elsewhere();
    if !elsewhere.is_empty() {
        followed.warnings.push(format!(
            "{} follows too, and is not led here: it is set anew when the file is recomputed there",
            elsewhere.join(", ")
        ));
    }
    followed
}
