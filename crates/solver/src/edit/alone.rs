//! Where all dimensions together cannot be met from a sketch: each of them alone, with the others met.

use super::setting::Setting;
use super::{Edited, Ending, Keep, Session};
use crate::interval::Interval;
use crate::interval::vector::{dot, length, minus};
use crate::order::InOrder;
use crate::problem::{Decimal, Item, Problem, Shape};
use crate::track::{Control, Options};
use std::slice;
use std::time::Instant;

/// What one dimension can do alone.
#[derive(Debug, Clone)]
pub struct Alone {
    /// The problem, with this dimension as the sketch has it.
    pub problem: Problem,
    /// What comes of leading it from there to what it is to be, once all others are met.
    pub edited: Edited,
}

/// Leads a sketch to all of its dimensions but one, and then this one to what it is to be; so for each dimension that is a
/// distance of two points, an angle at a point, a radius or a coordinate. Those come back that reach a limit, the one first that
/// comes nearest to what it is to be; or, alone, the first one that is reached with nothing held and nothing left out that does not follow. What
/// could not be proved is left out, as is what is at its limit just what it is to be. Ends when the limit of `control` has passed.
///
/// ```
/// use krawl::edit::{Ending, alone};
/// use krawl::problem::Problem;
/// use krawl::track::{Control, Options};
///
/// // Sides of 5 and 3 do not reach over 9.
/// let triangle = Problem::build("triangle", 2)
///     .point("a", [0, 0]).point("b", [4, 0]).point("c", [0, 3])
///     .distance("a", "b", 9).distance("b", "c", 5).distance("c", "a", 3)
///     .finish().unwrap();
/// let found = alone(&triangle, &Options::certified(), &mut Control::default());
/// let a_b = found.iter().find(|one| one.edited.dimensions[0].index == 0).unwrap();
/// assert!(matches!(a_b.edited.ending, Ending::Limit(_)));
/// assert!((a_b.edited.dimensions[0].value.mid() - 8.0).abs() < 1e-12);
/// ```
pub fn alone(problem: &Problem, options: &Options, control: &mut Control) -> Vec<Alone> {
    let mut found = Vec::new();
    for index in problem.dimensions() {
        let is_late = control
            .limit
            .is_some_and(|limit| Instant::now() > limit.deadline);
        if is_late || control.is_interrupted() {
            break;
        }
        let wanted = Setting::now(problem, index);
        let Some(drawn) = drawn(problem, index) else {
            continue;
        };
        if meet(drawn.value(), wanted.value()) {
            continue;
        }
        let others = Setting::applied(&[drawn], problem);
        let Ok(mut session) = Session::open_with(&others, options, control) else {
            continue;
        };
        let edited = session.follow_to(slice::from_ref(&wanted), Keep::Never, control);
        let one = Alone {
            problem: others,
            edited,
        };
        let dimension = &one.edited.dimensions[0];
        match one.edited.ending {
            Ending::Reached if one.edited.account.is_whole() => return vec![one],
            // What is just met at its limit is not out of reach; nor is it told by figures that miss what was left out.
            Ending::Limit(_) if meet(dimension.value, dimension.to) => {}
            Ending::Limit(_) if one.edited.astray.is_none() => found.push(one),
            _ => {}
        }
    }
    let missed = |one: &Alone| {
        let dimension = &one.edited.dimensions[0];
        let way = (dimension.to - dimension.from).mag();
        (dimension.to - dimension.value).mag() / way
    };
    found.order_by(|a, b| missed(a).total_cmp(&missed(b)));
    found
}

/// Whether two enclosures may be of the same number.
fn meet(a: Interval, b: Interval) -> bool {
    a.inf() <= b.sup() && b.inf() <= a.sup()
}

/// A setting to what a dimension is in the sketch, to seven digits; `None`: it is of another kind than those named above, or
/// no dimension can be that.
fn drawn(problem: &Problem, index: usize) -> Option<Setting> {
    let places = problem.places();
    let between = |a: usize, b: usize| minus(places[b], places[a]);
    let value = match index.checked_sub(problem.distances.len()) {
        None => {
            let [a, b] = problem.distances[index].points;
            length(between(a, b))
        }
        Some(c) => {
            let constraint = &problem.constraints[c];
            match (constraint.kind.as_str(), constraint.items.as_slice()) {
                ("angles", &[Item::Point(a), Item::Point(b), Item::Point(c)]) => {
                    let (u, v) = (between(b, a), between(b, c));
                    (dot(u, v) / (length(u) * length(v))).acos().to_degrees()
                }
                (kind @ ("radii" | "diameters"), &[Item::Object(object)]) => {
                    let radius = match &problem.objects[object].shape {
                        Shape::Round { radius, .. } => radius.to_f64(),
                        &Shape::Arc { center, start, .. } => length(between(center, start)),
                        _ => return None,
                    };
                    if kind == "radii" {
                        radius
                    } else {
                        2.0 * radius
                    }
                }
                ("x" | "y" | "z", &[Item::Point(p)]) => places[p][axis(&constraint.kind)],
                ("dx" | "dy" | "dz", &[Item::Point(a), Item::Point(b)]) => {
                    between(a, b)[axis(&constraint.kind)]
                }
                _ => return None,
            }
        }
    };
    let value = Decimal::try_from(format!("{value:.6e}").as_str()).ok()?;
    Setting::new(problem, index, value).ok()
}

/// The axis that the name of a kind ends with.
fn axis(kind: &str) -> usize {
    match kind.as_bytes().last() {
        Some(b'x') => 0,
        Some(b'y') => 1,
        _ => 2,
    }
}
