//! The edited figure in the user's own file: only the numbers change.

use super::setting::measure_of;
use crate::constraint::{Arguments, LineName, is_opposite_nearer};
use crate::interval::{Interval, Real};
use crate::order::InOrder;
use crate::places::Each as _;
use crate::problem::{Constraint, Decimal, Problem, Shape, Target};
use crate::problem::{said_with_limits, toml_number, toml_unknown, toml_with_limits};
use crate::rational::Rational;
use crate::system::Located;
use num_bigint::BigInt;
use num_traits::One;
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use toml_edit::{Document, Item, TableLike, Value};

/// Why an edited problem cannot be written into the text of its file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WriteError {
    /// The text is not that of the problem.
    #[error("the file does not say what was read from it: {0}")]
    OtherFile(String),
    /// A square with more digits than are read.
    #[error("{0} is given by its square, and that of the new length has too many digits")]
    LongSquare(String),
    /// A number as far from the new one as the file's tolerance allows cannot be.
    #[error("{0}: within its tolerance it may be {1}, which it cannot be: give it a narrower one")]
    Limits(String, String),
    /// Under `angles` there are none of 0 and 180 degrees.
    #[error(
        "{0}: legs on one line are no angle that a file has under `angles`: write it under `turns`"
    )]
    Straight(String),
    /// The place of a body is not written in one line.
    #[error(
        "the place of `{0}` is written in parts: write it in one line under [places], as `{0} = {{ at = [...], z = [...], x = [...] }}`"
    )]
    Place(String),
    /// The places of bodies are no table of their own.
    #[error(
        "[places] is no table with a line for each body, to which one could be added: write it so"
    )]
    Places,
}

/// Puts the places of points, the radii of circles, the values of unknowns and the dimensions of `problem` into the text of the file that it was read from,
/// which keeps its order, comments and layout.
///
/// Two lines have two angles. Of a right angle the file tells by the order of the lines' ends which of both it is; where an angle
/// becomes one and is not the angle between the lines as they are named, the ends of one of them are named in place of it, in
/// the other order.
///
/// Places are rounded to floats. Dimensions are put where they differ from what the text says, those given
/// by their squares as exact squares. `objects`: where they are; those that are missing stay as they are.
pub fn rewrite(
    text: &str,
    problem: &Problem,
    places: &[[f64; 3]],
    objects: &[Located],
) -> Result<String, WriteError> {
    let other = |what: &str| WriteError::OtherFile(what.to_owned());
    let document = Document::parse(text).map_err(|error| other(error.message()))?;
    let root = document.as_table();
    let mut changes: Vec<(Range<usize>, String)> = Vec::new();
    let mut put = |value: &Value, new: String| {
        let span = value.span().ok_or_else(|| other("a number has no place"))?;
        changes.push((span, new));
        Ok(())
    };

    let points = table(root, "points");
    for (point, place) in problem.points.iter().zip(places) {
        let item = points.and_then(|points| points.get(&point.name)?.as_array());
        let array = item.ok_or_else(|| other(&point.name))?;
        for (value, x) in array.iter().zip(place) {
            put(value, float(*x))?;
        }
    }
    for key in ["circles", "spheres", "unknowns"] {
        let Some(all) = table(root, key) else {
            continue;
        };
        for (object, located) in problem.objects.iter().zip(objects) {
            let item = all.get(&object.name);
            let own = item.and_then(Item::as_value);
            let parts = own.and_then(Value::as_inline_table);
            let value = match (key, &object.shape) {
                ("unknowns", Shape::Number { within, .. }) => {
                    // One that is written as a range has no value yet.
                    if let (Some(value), None, Some(number)) = (
                        own.filter(|own| parts.is_some() || own.is_array()),
                        parts.and_then(|parts| parts.get("value")),
                        located.number(),
                    ) {
                        put(value, toml_unknown(float(number.mid()), within))?;
                        continue;
                    }
                    parts.map_or(own, |parts| parts.get("value"))
                }
                _ => item.and_then(|round| round.as_inline_table()?.get("radius")),
            };
            if let (Some(value), Some(number)) = (value, located.number()) {
                put(value, float(number.mid()))?;
            }
        }
    }
    let mut new_places = String::new();
    let standing = problem.standing_bodies();
    for (index, (object, located)) in problem.objects.iter().zip(objects).enumerate() {
        let Located::Pose { at, axes } = located else {
            continue;
        };
        if standing.contains(&index) {
            continue;
        }
        let there = table(root, "places").and_then(|places| places.get(&object.name));
        let in_one = there
            .and_then(Item::as_inline_table)
            .filter(|parts| !parts.is_dotted());
        if let (Some(_), Some(value)) = (in_one, there.and_then(Item::as_value)) {
            put(value, place(at, axes))?;
        } else if there.is_some() {
            return Err(WriteError::Place(object.name.clone()));
        } else {
            let name = toml_edit::Key::new(&object.name);
            new_places += &format!("{name} = {}\n", place(at, axes));
        }
    }
    for (name, wanted) in &problem.parameters {
        let value = table(root, "parameters").and_then(|all| all.get(name)?.as_value());
        // One that the path leads from elsewhere says where to beside.
        let value = match value.and_then(Value::as_inline_table) {
            Some(parts) => parts.get("value"),
            None => value,
        };
        let value = value.ok_or_else(|| other(name))?;
        let is_said = match wanted.expression() {
            Some(expression) => value.as_str() == Some(expression),
            None => said(text, value).as_ref() == Some(wanted),
        };
        if !is_said {
            put(value, toml_number(wanted))?;
        }
    }
    let constraints = table(root, "constraints");
    let list = |key: &str| -> Vec<&Value> {
        let array = constraints.and_then(|all| all.get(key)?.as_array());
        array.map_or(Vec::new(), |array| array.iter().collect())
    };
    // Under `distances` there are those of points from lines and planes too, which are constraints.
    let names: HashSet<&str> = problem.points.iter().map(|p| p.name.as_str()).collect();
    let joins_points = |value: &&Value| {
        let array = value.as_array();
        array.is_some_and(|array| {
            let name = |k: usize| array.get(k).and_then(Value::as_str);
            let both = [0, 1].each(|k| name(k).is_some_and(|name| names.contains(name)));
            array.len() == 3 && both == [true, true]
        })
    };
    let (lengths, others): (Vec<&Value>, Vec<&Value>) =
        list("distances").into_iter().partition(joins_points);
    let mut turned: Vec<(Range<usize>, String)> = Vec::new();
    let mut entries: HashMap<String, std::vec::IntoIter<&Value>> = HashMap::new();
    entries.insert("distances".to_owned(), others.into_iter());
    for (index, constraint) in problem.constraints.iter().enumerate() {
        let key = &constraint.kind;
        let is_parameter = |item: &crate::problem::Item| {
            let named = problem.item_name(*item);
            problem.parameters.iter().any(|(name, _)| name == named)
        };
        // Equations have no number, and parameters in them have theirs under `parameters`.
        if constraint.formula.is_some()
            || key == "values" && constraint.items.first().is_some_and(is_parameter)
        {
            continue;
        }
        let entries = entries
            .entry(key.clone())
            .or_insert_with(|| list(key).into_iter());
        let entry = entries
            .next()
            .ok_or_else(|| other("another number of constraints"))?;
        let Some(wanted) = &constraint.value else {
            continue;
        };
        let last = entry.as_array().and_then(|array| array.iter().last());
        if wanted.expression().is_some() && last.and_then(Value::as_str) == wanted.expression() {
            continue;
        }
        let wanted = &match key.as_str() {
            "angles" => folded(wanted)
                .ok_or_else(|| WriteError::Straight(problem.constraint_name(index)))?,
            _ => wanted.clone(),
        };
        let array = entry.as_array().ok_or_else(|| other(key))?;
        let number = array
            .get(array.len().saturating_sub(1))
            .ok_or_else(|| other(key))?;
        let before = said(text, number);
        if before.as_ref() != Some(wanted) {
            let head = problem.distances.len();
            put(
                number,
                in_place_of(number, before.as_ref(), wanted, (problem, head + index))?,
            )?;
            if let Some((which, ends)) =
                before.and_then(|b| turned_round(problem, constraint, (&b, wanted)))
            {
                let span = |k: usize| array.get(k).and_then(Value::span);
                let (first, last) = (span(which.start), span(which.end - 1));
                let (first, last) = first.zip(last).ok_or_else(|| other(key))?;
                let names = ends.map(|p| Value::from(&*problem.points[p].name).to_string());
                turned.push((first.start..last.end, names.join(", ")));
            }
        }
    }
    let lengths = lengths.into_iter().map(|value| (value, false));
    let squares = list("squared_distances")
        .into_iter()
        .map(|value| (value, true));
    let all: Vec<(&Value, bool)> = lengths.chain(squares).collect();
    if all.len() != problem.distances.len() {
        return Err(other("another number of distances"));
    }
    for (index, (value, is_square)) in all.into_iter().enumerate() {
        let number = value.as_array().and_then(|array| array.get(2));
        let number = number.ok_or_else(|| other("a distance without a number"))?;
        let name = || problem.distance_name(index);
        let (Target::Length(now) | Target::SquaredLength(now)) = &problem.distances[index].target;
        if now.expression().is_some() && number.as_str() == now.expression() {
            continue;
        }
        let wanted = match (&problem.distances[index].target, is_square) {
            (Target::Length(length), false) => length.clone(),
            (Target::SquaredLength(square), true) => square.clone(),
            (Target::Length(length), true) => {
                squared(length).ok_or_else(|| WriteError::LongSquare(name()))?
            }
            (Target::SquaredLength(_), false) => return Err(other(&name())),
        };
        let before = said(text, number);
        if before.as_ref() != Some(&wanted) {
            put(
                number,
                in_place_of(number, before.as_ref(), &wanted, (problem, index))?,
            )?;
        }
    }

    if !new_places.is_empty() {
        let is_heading = |line: &str| {
            let before = line.split('#').next().unwrap_or_default();
            before.split_whitespace().collect::<String>() == "[places]"
        };
        match text.lines().position(is_heading) {
            Some(line) => {
                let end = text
                    .split_inclusive('\n')
                    .take(line + 1)
                    .map(str::len)
                    .sum();
                changes.push((end..end, new_places));
            }
            None if root.contains_key("places") => return Err(WriteError::Places),
            None => changes.push((text.len()..text.len(), format!("\n[places]\n{new_places}"))),
        }
    }
    let mut out = text.to_owned();
    changes.extend(turned);
    changes.order_by_key(|change| std::cmp::Reverse(change.0.start));
    for (span, new) in changes {
        out.replace_range(span, &new);
    }
    Ok(out)
}

/// The place of a body with joints as a file has it.
fn place(at: &[Interval; 3], axes: &[[Interval; 3]; 3]) -> String {
    let three = |v: &[Interval; 3]| {
        let [x, y, z] = v.map(|x| float(x.mid()));
        format!("[{x}, {y}, {z}]")
    };
    let [x, _, z] = axes.each_ref().map(three);
    format!("{{ at = {}, z = {z}, x = {x} }}", three(at))
}

/// Of an angle of two lines that becomes a right one, and is the angle of one of them with the other one reversed: which items
/// name a line through two points, and its ends in the order in which it is that of the lines as they are named.
fn turned_round(
    problem: &Problem,
    constraint: &Constraint,
    (before, after): (&Decimal, &Decimal),
) -> Option<(Range<usize>, [usize; 2])> {
    let is_right = |degrees: &Decimal| *degrees.value() == Rational::from_integer(90.into());
    let becomes_right = is_right(after) && !is_right(before);
    let mut items = Arguments::new(problem, &constraint.items);
    let all = items.left();
    if constraint.kind != "angles" || !becomes_right || (all == 3 && items.points_ahead() == 3) {
        return None;
    }
    let first = items.line().ok()?;
    let middle = all - items.left();
    let second = items.line().ok()?;
    items.end().ok()?;
    let (u, v) = (direction(problem, first)?, direction(problem, second)?);
    let now = u.iter().zip(&v).map(|(a, b)| a * b).sum();
    if !is_opposite_nearer(&now, &Real::cosine_of_degrees(before.value().clone())) {
        return None;
    }
    match (first, second) {
        (LineName::Points([a, b]), _) => Some((0..middle, [b, a])),
        (_, LineName::Points([a, b])) => Some((middle..all, [b, a])),
        _ => None,
    }
}

/// The direction of a line in the drawing, from its first end to its second. `None`: it is a line of its own.
pub(super) fn direction(problem: &Problem, line: LineName) -> Option<[Rational; 3]> {
    match line {
        LineName::Points([a, b]) => {
            let [from, to] = [a, b].each(|p| &problem.points[p].sketch);
            Some(std::array::from_fn(|k| to[k].value() - from[k].value()))
        }
        LineName::Axis(axis) => Some(std::array::from_fn(|k| {
            Rational::from_integer(i32::from(k == axis).into())
        })),
        LineName::Free(_) => None,
    }
}

/// A number as it is put in place of one, with the tolerance that was written with that; of a dimension of a problem.
fn in_place_of(
    value: &Value,
    before: Option<&Decimal>,
    wanted: &Decimal,
    (problem, index): (&Problem, usize),
) -> Result<String, WriteError> {
    let wanted = wanted.clone();
    let wanted = wanted.with_tolerance(before.and_then(Decimal::tolerance));
    let measure = measure_of(problem, index);
    let mut ends = wanted.limits().into_iter().flatten();
    match ends.find(|end| !measure.allows(end)) {
        None => Ok(toml_with_limits(&wanted, value.is_array())),
        Some(end) => Err(WriteError::Limits(
            problem.dimension_name(index),
            end.to_string(),
        )),
    }
}

/// The number that stands in the text.
fn said(text: &str, number: &Value) -> Option<Decimal> {
    if number.is_array() || number.is_str() {
        return said_with_limits(number, text);
    }
    let text = number.span().and_then(|span| text.get(span))?;
    text.replace('_', "").parse().ok()
}

fn table<'t>(root: &'t dyn TableLike, key: &str) -> Option<&'t dyn TableLike> {
    root.get(key)?.as_table_like()
}

/// A float as TOML has it, zero where it is too small for a coordinate.
fn float(x: f64) -> String {
    if x.abs() < 1e-60 {
        "0.0".to_owned()
    } else {
        format!("{x:?}")
    }
}

/// An angle set to any number of degrees as it is without a sense of turn, which the places of points tell: between 0 and 180.
fn folded(degrees: &Decimal) -> Option<Decimal> {
    let whole = |x: i32| Rational::from_integer(x.into());
    let value = degrees.value();
    if value.is_positive() && *value < whole(180) {
        return Some(degrees.clone());
    }
    let rest = value - (value / whole(360)).floor() * whole(360);
    let folded = rest.clone().min(whole(360) - rest);
    (folded.is_positive() && folded < whole(180)).then(|| decimal(folded))?
}

/// The exact square of a decimal, unless it has too many digits.
fn squared(length: &Decimal) -> Option<Decimal> {
    decimal(length.value().pow(2))
}

/// A ratio that is a decimal, unless it has too many digits.
fn decimal(ratio: Rational) -> Option<Decimal> {
    let ten = Rational::from_integer(BigInt::from(10));
    let mut scaled = ratio;
    // A decimal's denominator divides a power of ten.
    for shift in 0..400 {
        if scaled.denom().is_one() {
            let exponent = if shift == 0 {
                String::new()
            } else {
                format!("e-{shift}")
            };
            return format!("{}{exponent}", scaled.numer()).parse().ok();
        }
        scaled *= &ten;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "# A triangle.\ndimension = 2\n[points]\na = [0, 0] # fixed\nb = [ 4.0, 0 ]\nc = [0, 3]\n\
                        [constraints]\ndistances = [[\"a\", \"b\", 4], [\"b\", \"c\", 5.0]]\n\
                        squared_distances = [[\"c\", \"a\", 9]]\n";

    #[test]
    fn only_numbers_change() {
        let mut problem = Problem::parse(FILE, "triangle.toml").unwrap();
        problem.distances[0].target = Target::Length("+04.50".parse().unwrap());
        problem.distances[2].target = Target::Length("3.5".parse().unwrap());
        let places = [[0.0, 0.0, 0.0], [4.5, 1e-70, 0.0], [0.25, 3.0, 0.0]];
        let text = rewrite(FILE, &problem, &places, &[]).unwrap();
        let wanted = FILE
            .replace("[0, 0] #", "[0.0, 0.0] #")
            .replace("[ 4.0, 0 ]", "[ 4.5, 0.0 ]")
            .replace("c = [0, 3]", "c = [0.25, 3.0]")
            .replace("\"b\", 4]", "\"b\", 4.50]")
            .replace("\"a\", 9]", "\"a\", 1225.0e-2]");
        assert_eq!(text, wanted);
        let again = Problem::parse(&text, "again.toml").unwrap();
        assert_eq!(again.distances[0].target, problem.distances[0].target);
    }

    #[test]
    fn a_right_angle_says_which_it_is() {
        // From a to b and from a to c it is 120 degrees, and the angle of the lines is the other one.
        let file = "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [-1, 1.7]\n[lines]\nl = [\"a\", \"b\"]\n\
                    [constraints]\nfixed = [\"a\"]\nhorizontal = [\"l\"]\n\
                    distances = [[\"a\", \"b\", 4], [\"a\", \"c\", 2]]\nangles = [[\"l\", \"a\", \"c\", 60]]\n";
        let mut problem = Problem::parse_loosely(file, "angle.toml").unwrap();
        let places = problem.places();
        let at = problem.constraints.iter().position(|c| c.kind == "angles");
        let mut written = |degrees: &str| {
            problem.constraints[at.unwrap()].value = Some(degrees.parse().unwrap());
            rewrite(file, &problem, &places, &[]).unwrap()
        };
        assert!(written("90").contains("[[\"b\", \"a\", \"a\", \"c\", 90.0]]"));
        assert!(written("80").contains("[[\"l\", \"a\", \"c\", 80.0]]"));
    }

    #[test]
    fn another_file_is_refused() {
        let problem = Problem::parse(FILE, "triangle.toml").unwrap();
        let places = [[0.0; 3]; 3];
        let other = FILE.replace("\"a\", \"b\", 4], ", "");
        assert!(matches!(
            rewrite(&other, &problem, &places, &[]),
            Err(WriteError::OtherFile(_))
        ));
    }
}
