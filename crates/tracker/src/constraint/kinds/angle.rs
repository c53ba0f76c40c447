//! `angles`: at a point, between lines, between a line and a plane, between planes.
//!
//! The cosine `u·v / (|u| |v|)` is led linearly from that of the sketch to that of the angle. Where both
//! lengths are dimensions of the problem it needs no unknowns: `u·v` is a polynomial in t. The angle at a
//! point is that between the two legs; where the lengths of both are given, the distance between their other ends
//! takes its place, and so it does for two lines through given bars that have an end in common. Lines and planes have two angles, which add up to 180 degrees: the
//! one meant is the one that the sketch comes nearer to; of a right angle, to which both are as near, the one between the directions
//! from the first end of each line to its second (of planes between their normals).

use super::prelude::*;
use crate::places::Each as _;

/// See the module.
pub const ANGLES: Kind = Kind {
    key: "angles",
    meaning: "the angle in degrees at the middle one of three points, between two lines, between a line and a \
         plane, or between two planes",
    takes: "three points with the vertex in the middle, two lines, a line and a plane, or two planes",
    measure: Measure::Degrees,
    measure_of: Some(measure_of),
    read_as,
    ..Kind::lowered_by(lower)
};

fn measure_of(mut items: Arguments) -> Measure {
    if items.points_ahead() == 3 && items.left() == 3 {
        return Measure::Degrees;
    }
    match items.two_flats() {
        Ok([Flat::Line(_), Flat::Plane(_)] | [Flat::Plane(_), Flat::Line(_)]) => Measure::Slope,
        _ => Measure::Degrees,
    }
}

fn read_as(mut items: Arguments) -> Option<String> {
    if items.points_ahead() == 3 && items.left() == 3 {
        return None;
    }
    let names = items.clone();
    let things = items.two_flats().ok()?;
    Some(names.in_words(things.each(Thing::Flat)))
}

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let degrees = of.number().value().clone();
    if let Some([a, b, c]) = legs(&mut of.items)? {
        let target = Real::cosine_of_degrees(degrees);
        if low.measure_opposite(of.name, [a, b, c], &target)? {
            return Ok(());
        }
        let legs = [low.span(b, a)?, low.span(b, c)?];
        let [u, v] = legs.map(|leg| told(leg, &target, low));
        return between(of.name, low, &u, &v, target, false);
    }
    let corner = corner(&of.items);
    let (first, second) = directions(&mut of.items, low)?;
    let target = if first.1 == second.1 {
        Real::cosine_of_degrees(degrees)
    } else if degrees > Rational::from_integer(90.into()) {
        return Err("an angle between a line and a plane is at most 90 degrees".to_owned());
    } else {
        Real::sine_of_degrees(degrees)
    };
    if let Some((points, turned)) = corner
        && low.are_legs_given(points)?
    {
        // The cosine between the legs, of which one may run against its line.
        let now = dot(&first.0.at, &second.0.at);
        let cosine = match target.is_zero() && !low.is_editable() {
            true => target,
            false => nearer(low, &now, target),
        };
        let cosine = if turned { -&cosine } else { cosine };
        low.measure_opposite(of.name, points, &cosine)?;
        return Ok(());
    }
    let (first, second) = (told(first.0, &target, low), told(second.0, &target, low));
    between(of.name, low, &first, &second, target, true)
}

/// Three points and nothing more, of which the middle one is the vertex of an angle; `None`: it is of other things.
pub fn legs(items: &mut Arguments) -> Result<Option<[usize; 3]>, Fault> {
    if items.points_ahead() != 3 || items.left() != 3 {
        return Ok(None);
    }
    let [a, b, c] = [items.point()?, items.point()?, items.point()?];
    match a == c {
        true => Err("both legs are one and the same: name another point".to_owned()),
        false => Ok(Some([a, b, c])),
    }
}

/// Two lines through two points each, one of which they have in common: that one in the middle of the other ends, and
/// whether one of the lines runs towards it and the other away from it.
fn corner(items: &Arguments) -> Option<([usize; 3], bool)> {
    let mut items = items.clone();
    let (LineName::Points(first), LineName::Points(second)) =
        (items.line().ok()?, items.line().ok()?)
    else {
        return None;
    };
    items.end().ok()?;
    let (i, j) = [(0, 0), (0, 1), (1, 0), (1, 1)]
        .into_iter()
        .find(|&(i, j)| first[i] == second[j])?;
    let (from, to) = (first[1 - i], second[1 - j]);
    (from != to).then_some(([from, first[i], to], i != j))
}

/// Two directions or normals, and nothing more.
pub fn directions(
    items: &mut Arguments,
    low: &mut Lowering,
) -> Result<((Arrow, bool), (Arrow, bool)), Fault> {
    let (first, second) = (items.flat()?, items.flat()?);
    if let (Flat::Line(LineName::Axis(_)), Flat::Line(LineName::Axis(_))) = (first, second) {
        return Err("axes lie as they do: name a line or a plane".to_owned());
    }
    items.end()?;
    first.are_apart(second, low.problem)?;
    Ok((direction(first, low)?, direction(second, low)?))
}

/// The direction of a line or the normal of a plane, and whether it is a plane's.
fn direction(flat: Flat, low: &mut Lowering) -> Result<(Arrow, bool), Fault> {
    Ok(match flat {
        Flat::Line(line) => (low.line(line)?.along, false),
        Flat::Plane(plane) => (low.proper_plane(plane)?.normal, true),
    })
}

/// A vector as its angles are told: by its heading. A right angle needs none.
fn told(of: Arrow, cosine: &Real, low: &mut Lowering) -> Arrow {
    match cosine.is_zero() {
        true => low.heading_made(of),
        false => low.heading(of),
    }
}

/// Leads the cosine between two vectors to `target`, or, with `either`, to that or the opposite number,
/// whichever is nearer.
fn between(
    name: &str,
    low: &mut Lowering,
    u: &Arrow,
    v: &Arrow,
    target: Real,
    either: bool,
) -> Result<(), Fault> {
    if target.is_zero() && !low.is_editable() {
        orthogonal(name, low, u, v);
        return Ok(());
    }
    let now = dot(&u.at, &v.at);
    let odd = u.axial != v.axial;
    let products = low.dot(1, &u.forms, &v.forms);
    let then = match either {
        true => nearer(low, &now, target),
        false => {
            low.sense(false);
            target
        }
    };
    low.measure(
        name,
        Measured {
            products,
            now,
            then,
            power: 0,
            odd,
            arrows: vec![u, v],
        },
    );
    Ok(())
}

/// Of a cosine and the opposite number the one that is nearer to the cosine of which `now` has the sign.
fn nearer(low: &mut Lowering, now: &Rational, target: Real) -> Real {
    match low.sense(is_opposite_nearer(now, &target)) {
        true => -&target,
        false => target,
    }
}

/// Whether the opposite of a cosine is nearer than itself to the cosine of which `now` has the sign.
pub fn is_opposite_nearer(now: &Rational, cosine: &Real) -> bool {
    // A right angle is as near from below as from above, and what a drawing shows of the sign is what rounding left: which of
    // both angles it is is told by the order of the lines' ends, from the first to the second.
    !cosine.is_zero() && now.is_negative() == (cosine.enclose().inf() > 0.0) && !now.is_zero()
}
