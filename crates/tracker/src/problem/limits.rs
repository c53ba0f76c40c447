//! Numbers with limits, `[4.2, 4.3]`, `"4.2426 ± 0.05"` and `"90 +0.1 -0.2"`, and the table of tolerances.

use super::cursor::At;
use super::expression;
use super::file::FileError;
use super::write::number as written;
use super::{Decimal, Problem, Target, Tolerances};
use crate::rational::Rational;

/// How a number with limits may be written.
const WANTED: &str =
    "limits, [4.2, 4.3] with the lower one first, \"4.25 ± 0.05\" or \"4.2 +0.1 -0.05\"";

/// What stands before a number by which another one may be less and more.
const BOTH: [&str; 3] = ["±", "+/-", "+-"];

/// A text that is meant as a number with limits: what it is of, and how far it may be from that.
fn parts(text: &str) -> Option<(&str, &str)> {
    let is_number = |text: &str| text.parse::<Decimal>().is_ok();
    let split = BOTH.iter();
    let split = split.filter_map(|sign| Some((text.split_once(sign)?, *sign)));
    for ((number, by), sign) in split {
        // With names it may be an expression.
        if sign != "+-" || is_number(number) {
            return Some((number.trim(), by.trim()));
        }
    }
    let (number, by) = text.trim().split_once(char::is_whitespace)?;
    let mut ends = by.split_whitespace();
    let is_end = |end: &str| end.starts_with(['+', '-', '−']) || end == "0";
    let is_meant = is_number(number) && by.split_whitespace().count() == 2 && ends.all(is_end);
    is_meant.then_some((number, by.trim()))
}

/// Whether a text is meant as a number with limits.
pub(super) fn is_meant(text: &str) -> bool {
    parts(text).is_some()
}

/// How far down and up one or two numbers, with their signs, say.
fn deviations(texts: &[&str]) -> Option<[Decimal; 2]> {
    let read = |text: &&str| {
        let text = text.strip_prefix('+').unwrap_or(text);
        text.replace('−', "-").parse::<Decimal>().ok()
    };
    let numbers: Option<Vec<Decimal>> = texts.iter().map(read).collect();
    match numbers?.as_slice() {
        [both] if both.to_f64() >= 0.0 => Some([both.negative(), both.clone()]),
        [a, b] if a.value() <= b.value() => Some([a.clone(), b.clone()]),
        [a, b] => Some([b.clone(), a.clone()]),
        _ => None,
    }
}

/// The number with its tolerance that a text says.
fn of_text(text: &str) -> Option<Decimal> {
    let (number, by) = parts(text)?;
    let by: Vec<&str> = by.split_whitespace().collect();
    // Both ways as far, or down and up.
    let is_both = BOTH.iter().any(|sign| text.contains(sign));
    (by.len() == if is_both { 1 } else { 2 }).then_some(())?;
    let number: Decimal = number.parse().ok()?;
    let by = deviations(&by)?;
    number.within(&by).ok()?;
    Some(number.with_tolerance(Some(&by)))
}

/// The middle of limits, exactly, with its tolerance.
fn of_ends([low, high]: [&Decimal; 2]) -> Option<Decimal> {
    let half = |x: Rational| expression::decimal(&(x / Rational::from_integer(2.into()))).ok();
    let middle = half(low.value() + high.value())?;
    let by = half(high.value() - low.value())?;
    let by = [by.negative(), by];
    // Of very many digits the middle is rounded.
    let ends = middle.within(&by).ok()?;
    let is_exact = ends[0].value() == low.value() && ends[1].value() == high.value();
    (is_exact && low.value() <= high.value()).then(|| middle.with_tolerance(Some(&by)))
}

/// The number with limits that stands in a file.
pub(super) fn read(at: &At, has_parameters: bool) -> Result<Decimal, FileError> {
    let wrong = || at.wrong(WANTED);
    let Some(text) = at.item.as_str() else {
        let ends = at.list(WANTED)?;
        let ends = ends.iter().map(At::number);
        let ends = ends.collect::<Result<Vec<Decimal>, _>>()?;
        let [low, high] = &ends[..] else {
            return Err(wrong());
        };
        return of_ends([low, high]).ok_or_else(wrong);
    };
    if has_parameters && !text.contains('±') {
        return Err(at.fault(format!(
            "`{text}` may be an expression or a number with limits, as the file has parameters: write [low, high], or ±"
        )));
    }
    let is_computed = |(number, _): (&str, &str)| number.parse::<Decimal>().is_err();
    if has_parameters && parts(text).is_some_and(is_computed) {
        return Err(at.fault("the tolerance of a computed number stands under [tolerances]"));
    }
    of_text(text).ok_or_else(wrong)
}

/// The number that a value of a file says, if it has limits.
#[doc(hidden)]
pub fn said_with_limits(value: &toml_edit::Value, text: &str) -> Option<Decimal> {
    if let Some(text) = value.as_str() {
        return of_text(text);
    }
    let number = |k: usize| -> Option<Decimal> {
        let span = value.as_array()?.get(k)?.span()?;
        text.get(span)?.replace('_', "").parse().ok()
    };
    of_ends([&number(0)?, &number(1)?])
}

/// A number as a file has it: with its tolerance, if it has one. `is_list`: as two limits.
#[doc(hidden)]
pub fn toml_with_limits(number: &Decimal, is_list: bool) -> String {
    let Some([down, up]) = number.tolerance() else {
        return written(number);
    };
    if let (true, Some(ends)) = (is_list, number.limits()) {
        let [low, high] = ends.each_ref().map(written);
        return format!("[{low}, {high}]");
    }
    let sign = |x: &Decimal| if x.value().is_negative() { "" } else { "+" };
    match *down == up.negative() {
        true => format!("\"{number} ± {up}\""),
        false => format!("\"{number} {}{up} {}{down}\"", sign(up), sign(down)),
    }
}

impl Problem {
    /// The problem with numbers alone, without what their limits are: for what is about one figure for each.
    #[doc(hidden)]
    pub fn without_limits(&self) -> Problem {
        let mut plain = self.clone();
        let lengths = plain.distances.iter_mut().map(|d| match &mut d.target {
            Target::Length(number) | Target::SquaredLength(number) => number,
        });
        let others = plain
            .constraints
            .iter_mut()
            .filter_map(|c| c.value.as_mut());
        for number in lengths.chain(others) {
            *number = number.clone().with_tolerance(None);
        }
        plain
    }

    /// The table of tolerances of a file.
    pub(super) fn tolerances_of(root: &At) -> Result<Tolerances, FileError> {
        let mut out = Tolerances::default();
        let Some(table) = root.get("tolerances") else {
            return Ok(out);
        };
        let wanted = "a number, 0.1, or how far down and up, [-0.2, 0.1]";
        for (name, at) in table.entries()? {
            let text = |of: &At| match of.item.as_str() {
                Some(text) => Ok(text.trim().to_owned()),
                None => of.number().map(|number| number.text().to_owned()),
            };
            let texts = match at.item.is_array() {
                true => at.values().map(|of| text(&of)).collect::<Result<_, _>>()?,
                false if at.is_number() || at.item.is_str() => vec![text(&at)?],
                false => Vec::new(),
            };
            let is_as_wanted = texts.len() == 1 + usize::from(at.item.is_array());
            let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
            let both = deviations(&texts).filter(|_| is_as_wanted);
            let both = both.ok_or_else(|| at.wrong(wanted))?;
            match name {
                "default" => out.default = Some(both),
                name => out.named.push((name.to_owned(), both)),
            }
        }
        Ok(out)
    }
}
