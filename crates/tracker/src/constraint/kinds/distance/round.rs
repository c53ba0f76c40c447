//! The distance of a circle, arc or sphere from something else, from curve to curve. An arc is as good as its whole circle.
//!
//! From a line or plane the centre is `h = r + d` away. A point is `r + d` away from the centre, or inside, where the
//! sketch has it there, `r − d`. Centres are `r₁ + r₂ + d` apart, or where the sketch has one inside the other
//! `r₁ − r₂ − d`; centres in one place are not apart, and d is `r₁ − r₂`. The distance of centres is an unknown, and d
//! goes linearly from what it is in the sketch, which is less than zero where curves cross there.

use super::super::prelude::*;
use super::CENTRE;
use super::place::off_line;
use crate::constraint::Entry;
use crate::places::Each as _;

/// A point is so far from a circle or sphere.
pub fn from_point(
    name: &str,
    low: &mut Lowering,
    object: usize,
    point: usize,
    then: Real,
) -> Result<(), Fault> {
    let (round, center) = (low.round(object), low.center(object));
    if low.are_together(center, point) {
        return Err(
            "the point is the centre of it, and is apart from it by the radius: say that with `radii`"
                .to_owned(),
        );
    }
    let span = low.span(center, point)?;
    let square = dot(&span.at, &span.at);
    if square == round.squared {
        return Err(
            "the point is on it in the sketch: move it to the side where it is wanted, or say `on`"
                .to_owned(),
        );
    }
    let is_outside = square > round.squared;
    let apart = low.length(&span);
    let off = Off(apart, length(&span.at));
    let edge = Off(round.radius, Real::from(round.squared).sqrt());
    match is_outside {
        true => differ(name, low, [&off, &edge], then),
        false => differ(name, low, [&edge, &off], then),
    }
    Ok(())
}

/// A circle or sphere is so far from a line or plane.
pub fn from_flat(
    name: &str,
    low: &mut Lowering,
    object: usize,
    flat: Flat,
    then: Real,
) -> Result<(), Fault> {
    let round = low.round(object);
    let what = format!("{name}, from the centre");
    let off = match flat {
        Flat::Line(line) if low.dimension() == 3 => {
            let line = low.line(line)?;
            let (mut products, square) = off_line(name, low, &round.center, &line).ok_or(CENTRE)?;
            let at = Real::from(square).sqrt();
            let off = low.scalar(what.clone(), 1, Parity::Even, at.clone());
            products.push(Product::new(-1, value(off), value(off)));
            low.equate(&what, products, vec![Real::zero()], 2);
            Off(off, at)
        }
        Flat::Line(line) => {
            let line = low.line(line)?;
            let line = low.headed_line(line);
            let across = low.between(&line.base, &round.center);
            let products = low.cross_in_plane(1, &line.along.forms, &across.forms);
            let now = cross_in_plane(&line.along.at, &across.at);
            height(&what, low, products, now, &line.along)?
        }
        Flat::Plane(plane) => {
            let plane = low.proper_plane(plane)?;
            let plane = low.headed_plane(plane);
            let products = plane.height(low, 1, &round.center);
            let now = plane.height_in_sketch(low, &round.center);
            height(&what, low, products, now, &plane.normal)?
        }
    };
    let edge = Off(round.radius, Real::from(round.squared).sqrt());
    differ(name, low, [&off, &edge], then);
    Ok(())
}

/// Two circles or spheres are so far apart.
pub fn between(
    name: &str,
    low: &mut Lowering,
    one: usize,
    other: usize,
    then: Real,
) -> Result<(), Fault> {
    if one == other {
        return Err("name two different ones".to_owned());
    }
    let rounds = [one, other].map(|object| low.round(object));
    let centers = [one, other].each(|object| low.center(object));
    let is_larger = rounds[0].squared > rounds[1].squared;
    let are_equal = rounds[0].squared == rounds[1].squared;
    let edges = rounds.map(|round| Off(round.radius, Real::from(round.squared).sqrt()));
    let [large, small] = match is_larger {
        true => [&edges[0], &edges[1]],
        false => [&edges[1], &edges[0]],
    };
    let equal =
        "they are equally large in the sketch: make the one larger that is to be around the other";
    if low.are_together(centers[0], centers[1]) {
        if are_equal {
            return Err(equal.to_owned());
        }
        differ(name, low, [large, small], then);
        return Ok(());
    }
    let span = low.span(centers[0], centers[1])?;
    let squares: Rational = dot(&span.at, &span.at);
    let [r, s] = [one, other].map(|object| low.round(object).squared);
    let is_outside = squares > r + s;
    if !is_outside && are_equal {
        return Err(equal.to_owned());
    }
    let apart = Off(low.length(&span), length(&span.at));
    let (first, rest) = match is_outside {
        true => (&apart, [large, small]),
        false => (large, [small, &apart]),
    };
    let mut products = vec![Product::new(1, value(first.0), Form::One)];
    products.extend(rest.each(|off| Product::new(-1, value(off.0), Form::One)));
    let now = &(&first.1 - &rest[0].1) - &rest[1].1;
    let path = low.lead(now, then);
    low.equate(name, products, path, 1);
    Ok(())
}

/// A length among the unknowns, and what it is in the sketch.
struct Off(Entry, Real);

/// The first length is by so much longer than the second.
fn differ(name: &str, low: &mut Lowering, [long, short]: [&Off; 2], then: Real) {
    let products = vec![Product::new(
        1,
        Form::Difference(long.0, short.0),
        Form::One,
    )];
    let path = low.lead(&long.1 - &short.1, then);
    low.equate(name, products, path, 1);
}

/// The height over a line or plane, positive on the side where the sketch has it: `products` are |along| times that with a
/// sign, and are `now` in the sketch.
fn height(
    what: &str,
    low: &mut Lowering,
    mut products: Vec<crate::constraint::Product>,
    now: Rational,
    along: &Arrow,
) -> Result<Off, Fault> {
    if now.is_zero() {
        return Err(CENTRE.to_owned());
    }
    let side = if now.is_negative() { -1 } else { 1 };
    let at = &Real::from(now.abs()) / &length(&along.at);
    let scale = low.length(along);
    let off = low.scalar(what.to_owned(), 1, Parity::Even, at.clone());
    products.push(Product::new(-side, value(off), value(scale)));
    low.equate(what, products, vec![Real::zero()], along.power + 1);
    Ok(Off(off, at))
}
