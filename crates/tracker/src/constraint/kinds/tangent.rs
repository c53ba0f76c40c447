//! `tangent`: a line and a circle, arc or sphere, two circles or arcs, a plane and a sphere, two spheres.
//!
//! A line that meets an arc at an end which both share, or that goes through a point `on` a circle, is perpendicular to the radius
//! there; two arcs that share an end have their centres in line with it. Otherwise the centre's signed distance from the line or plane is
//! `± r` (in space a centre's distance from a line is r, which has no sign), and two centres are `r₁ + r₂` apart (from outside) or `|r₁ − r₂|` (from inside); which of these is
//! read off the sketch. An arc is then as good as its whole circle.

use super::distance::{CENTRE, off_line};
use super::prelude::*;
use crate::statement::Shape;

/// See the module.
pub const TANGENT: Kind = Kind {
    key: "tangent",
    meaning: "a line and a circle, arc or sphere, two circles or arcs, a plane and a sphere, or two spheres touch; at an end \
         or a point on them that both share, if there is one, and otherwise from the side where the sketch has them",
    takes: "a circle, arc or sphere, and another one, a line or a plane",
    fixes: Fixes::beside_axis,
    ..Kind::lowered_by(lower)
};

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let (first, other) = if of.items.next() == Sort::Round {
        (Some(of.items.round()?), flat_or_round(&mut of.items)?)
    } else {
        let flat = flat_or_round(&mut of.items)?;
        (None, flat)
    };
    let (object, other) = match first {
        Some(object) => (object, other),
        None => (of.items.round()?, other),
    };
    of.items.end()?;
    let round = low.round(object);
    match other {
        Other::Line(name) => {
            let line = low.line(name)?;
            if let LineName::Points(points) = name
                && let Some((_, end)) = shared_end(low, &points, &ends(low, object))
            {
                let radius = low.between(&round.center, &low.place(end));
                // The radius vanishes no more than the circle does.
                low.nonzero(&line.along);
                let products = low.dot(1, &line.along.forms, &radius.forms);
                let start = Real::from(dot(&line.along.at, &radius.at));
                low.vanish(of.name, products, start, line.along.power + 1);
                return Ok(());
            }
            if low.dimension() == 3 {
                let (mut products, square) =
                    off_line(of.name, low, &round.center, &line).ok_or(CENTRE)?;
                products.push(Product::new(-1, value(round.radius), value(round.radius)));
                let start = Real::from(square - &round.squared);
                low.vanish(of.name, products, start, 2);
                return Ok(());
            }
            let line = low.headed_line(line);
            let across = low.between(&line.base, &round.center);
            let products = low.cross_in_plane(1, &line.along.forms, &across.forms);
            let now = cross_in_plane(&line.along.at, &across.at);
            touch(of.name, low, products, now, &line.along, &round)
        }
        Other::Plane(name) => {
            let plane = low.proper_plane(name)?;
            let plane = low.headed_plane(plane);
            let products = plane.height(low, 1, &round.center);
            let now = plane.height_in_sketch(low, &round.center);
            touch(of.name, low, products, now, &plane.normal, &round)
        }
        Other::Round(second) => {
            if second == object {
                return Err("name two different ones".to_owned());
            }
            let mine = ends(low, object);
            let theirs = ends(low, second);
            let another = low.round(second);
            if let Some((a, b)) = shared_end(low, &mine, &theirs) {
                let u = low.between(&round.center, &low.place(a));
                let v = low.between(&another.center, &low.place(b));
                let products = low.cross_in_plane(1, &u.forms, &v.forms);
                let start = Real::from(cross_in_plane(&u.at, &v.at));
                low.vanish(of.name, products, start, 2);
                return Ok(());
            }
            both_round(of.name, low, &round, &another)
        }
    }
}

enum Other {
    Line(LineName),
    Plane(PlaneName),
    Round(usize),
}

fn flat_or_round(items: &mut Arguments) -> Result<Other, Fault> {
    Ok(match items.next() {
        Sort::Round => Other::Round(items.round()?),
        _ => match items.flat()? {
            Flat::Line(line) => Other::Line(line),
            Flat::Plane(plane) => Other::Plane(plane),
        },
    })
}

/// The ends of an arc, and of a circle in the plane the points that are `on` it: what goes through one of them touches there.
fn ends(low: &Lowering, object: usize) -> Vec<usize> {
    let on = low.problem.constraints.iter().filter(|c| c.kind == "on");
    let on = on.filter_map(|on| match *on.items {
        [Item::Point(p), Item::Object(o)] if o == object => Some(p),
        _ => None,
    });
    match low.problem.objects[object].shape {
        Shape::Arc { start, end, .. } => vec![start, end],
        Shape::Round { .. } if low.dimension() == 2 => on.collect(),
        _ => Vec::new(),
    }
}

/// A point of either list, if they are one and the same or a `coincident` puts them in one place.
fn shared_end(low: &Lowering, one: &[usize], other: &[usize]) -> Option<(usize, usize)> {
    let mut pairs = one.iter().flat_map(|&a| other.iter().map(move |&b| (a, b)));
    pairs.find(|&(a, b)| low.are_together(a, b))
}

/// Leads `products` ∓ r |along| to zero, where products are |along| times a signed distance.
fn touch(
    name: &str,
    low: &mut Lowering,
    mut products: Vec<crate::constraint::Product>,
    now: Rational,
    along: &Arrow,
    round: &Round,
) -> Result<(), Fault> {
    let apart = with_sign(&now, Real::whole(1));
    let side = match &apart {
        Some(one) if one.as_rational().is_some_and(Rational::is_negative) => -1,
        Some(_) => 1,
        None => {
            return Err(CENTRE.to_owned());
        }
    };
    let scale = low.length(along);
    products.push(Product::new(-side, value(round.radius), value(scale)));
    let both = &Real::from(round.squared.clone()).sqrt() * &length(&along.at);
    let start = &Real::from(now) - &(&Real::whole(side.into()) * &both);
    low.vanish(name, products, start, along.power + 1);
    Ok(())
}

/// Leads |c₁ − c₂|² − (r₁ ± r₂)² to zero.
fn both_round(name: &str, low: &mut Lowering, one: &Round, other: &Round) -> Result<(), Fault> {
    let apart = low.between(&one.center, &other.center);
    if is_zero(&apart.at) {
        return Err("their centres coincide in the sketch: move one of them".to_owned());
    }
    let off = dot(&apart.at, &apart.at) - &one.squared - &other.squared;
    let side = if off.is_negative() { -1 } else { 1 };
    let (r, s) = (value(one.radius), value(other.radius));
    let mut products = low.dot(1, &apart.forms, &apart.forms);
    products.push(Product::new(-1, r, r));
    products.push(Product::new(-1, s, s));
    products.push(Product::new(-2 * side, r, s));
    let twice = &Real::whole((2 * side).into()) * &Real::from(&one.squared * &other.squared).sqrt();
    low.vanish(name, products, &Real::from(off) - &twice, 2);
    Ok(())
}
