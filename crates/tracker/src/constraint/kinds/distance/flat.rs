//! The distance between two lines, two planes, or a line and a plane.
//!
//! Two lines in space that are not said to be parallel: along their common normal, `(u × v)·(c − a) = ± d |u × v|`.
//! All others are parallel, and then the distance is that of a point of one from the other: an end of a
//! line, a point of a plane, or of a line or plane of its own the nearest point to the origin.

use super::super::prelude::*;
use super::place::{from_line, from_plane, on_its_side};
use crate::constraint::directions::Directions;

/// Two lines or planes are so far apart.
pub fn between(
    name: &str,
    low: &mut Lowering,
    one: Flat,
    other: Flat,
    then: Real,
) -> Result<(), Fault> {
    one.are_apart(other, low.problem)?;
    let said = Directions::before(low.problem, low.constraint()).are_parallel(one, other);
    match (one, other) {
        (Flat::Line(LineName::Axis(_)), Flat::Line(LineName::Axis(_))) => {
            Err("axes are where they are: name a line".to_owned())
        }
        (Flat::Line(a), Flat::Line(b)) if low.dimension() == 3 && !said => {
            skew(name, low, a, b, then)
        }
        (Flat::Line(a), Flat::Line(b)) => {
            have_no_point_in_common(low, one, other)?;
            // From the one that is best known: an axis before all others.
            let is_axis = matches!(b, LineName::Axis(_));
            let (a, b) = if is_axis { (b, a) } else { (a, b) };
            let (a, b) = (low.line(a)?, low.line(b)?);
            if !said {
                parallel(name, low, &a.along, &b.along);
            }
            from_line(name, low, &b.base, &a, then)
        }
        (Flat::Line(line), Flat::Plane(plane)) | (Flat::Plane(plane), Flat::Line(line)) => {
            have_no_point_in_common(low, one, other)?;
            let (line, plane) = (low.line(line)?, low.proper_plane(plane)?);
            if !said {
                let what = format!("{name}, parallel");
                orthogonal(&what, low, &line.along, &plane.normal);
            }
            from_plane(name, low, &line.base, &plane, then)
        }
        (Flat::Plane(a), Flat::Plane(b)) => {
            have_no_point_in_common(low, one, other)?;
            // The place is a point of the problem where there is one.
            let is_free = matches!(b, PlaneName::Free(_));
            let (a, b) = if is_free { (b, a) } else { (a, b) };
            let (a, b) = (low.proper_plane(a)?, low.proper_plane(b)?);
            if !said {
                parallel(name, low, &a.normal, &b.normal);
            }
            let place = low.place_in(&b);
            from_plane(name, low, &place, &a, then)
        }
    }
}

fn parallel(name: &str, low: &mut Lowering, u: &Arrow, v: &Arrow) {
    low.nonzero(u);
    low.nonzero(v);
    low.align(&format!("{name}, parallel"), u, v);
}

/// Parallel ones with a point in common are one, or lie in each other.
fn have_no_point_in_common(low: &Lowering, one: Flat, other: Flat) -> Result<(), Fault> {
    let (mine, theirs) = (one.points(), other.points());
    let mut pairs = mine
        .iter()
        .flat_map(|&a| theirs.iter().map(move |&b| (a, b)));
    match pairs.find(|&(a, b)| low.are_together(a, b)) {
        None => Ok(()),
        Some((point, _)) => Err(format!(
            "both go through `{}`, so that they meet there and are nowhere apart: name another one, or give an angle \
             (`angles`) in place of the distance",
            low.name(point)
        )),
    }
}

fn skew(name: &str, low: &mut Lowering, a: LineName, b: LineName, then: Real) -> Result<(), Fault> {
    let (a, b) = (low.line(a)?, low.line(b)?);
    let what = format!("the common normal of {} and {}", a.along.name, b.along.name);
    let normal = low.cross(&a.along, &b.along, what);
    if is_zero(&normal.at) {
        return Err(
            "the lines are parallel in the sketch: if they are to stay so, say `parallel` too; otherwise turn one \
             of them"
                .to_owned(),
        );
    }
    let normal = low.heading(normal);
    let apart = low.between(&a.base, &b.base);
    let products = low.dot(1, &normal.forms, &apart.forms);
    let now = dot(&normal.at, &apart.at);
    let meet = "the lines meet in the sketch: move one of them to the side where it is wanted";
    on_its_side(name, low, (products, now), then, (&normal, true), meet)
}
