//! The distance of a place from a line or plane.
//!
//! In the plane that from the line through a and b is signed: `(b − a) × (p − a) = ± d |b − a|`; so is that from a plane,
//! `n·(p − a) = ± d |n|`. In space the distance from a line has no sign: with q the length of the projection,
//! `q |u| = (p − a)·u` and `|p − a|² − q² = d²`.

use super::super::prelude::*;
use crate::constraint::Product;

/// A place is so far from a line or plane.
pub fn from_flat(
    name: &str,
    low: &mut Lowering,
    place: &Place,
    flat: Flat,
    then: Real,
) -> Result<(), Fault> {
    match flat {
        Flat::Plane(plane) => {
            let plane = low.proper_plane(plane)?;
            from_plane(name, low, place, &plane, then)
        }
        Flat::Line(line) => {
            let line = low.line(line)?;
            from_line(name, low, place, &line, then)
        }
    }
}

/// A place is so far from a plane.
pub fn from_plane(
    name: &str,
    low: &mut Lowering,
    place: &Place,
    plane: &Plane,
    then: Real,
) -> Result<(), Fault> {
    let plane = &low.headed_plane(plane.clone());
    let now = plane.height_in_sketch(low, place);
    let products = plane.height(low, 1, place);
    let in_it = "the point is in the plane in the sketch: move it to the side where it is wanted";
    let normal = &plane.normal;
    on_its_side(
        name,
        low,
        (products, now),
        then,
        (normal, normal.axial),
        in_it,
    )
}

/// Products that are a distance times the length of an arrow, and what they are in the sketch: they keep their sign. Of the arrow also
/// whether they change it under reflections; `on_it`: what is said where they have none.
pub fn on_its_side(
    name: &str,
    low: &mut Lowering,
    (products, now): (Vec<Product>, Rational),
    then: Real,
    (arrow, odd): (&Arrow, bool),
    on_it: &str,
) -> Result<(), Fault> {
    let then = with_sign(&now, then).ok_or(on_it)?;
    low.measure(
        name,
        Measured {
            products,
            now,
            then,
            power: 1,
            odd,
            arrows: vec![arrow],
        },
    );
    Ok(())
}

/// A place is so far from a line.
pub fn from_line(
    name: &str,
    low: &mut Lowering,
    place: &Place,
    line: &Line,
    then: Real,
) -> Result<(), Fault> {
    let line = &low.headed_line(line.clone());
    let on_it = "the point is on the line in the sketch: move it to the side where it is wanted, or say `on`";
    if low.dimension() == 2 {
        let across = low.between(&line.base, place);
        let products = low.cross_in_plane(1, &line.along.forms, &across.forms);
        let now = cross_in_plane(&line.along.at, &across.at);
        return on_its_side(name, low, (products, now), then, (&line.along, true), on_it);
    }
    let (products, square) = off_line(name, low, place, line).ok_or(on_it)?;
    let d = low.lead(Real::from(square).sqrt(), then);
    low.equate(name, products, multiply(&d, &d), 2);
    Ok(())
}

/// In space, the products of the square of the distance of a place from a line, and what that is in the sketch. `None`: it is
/// on it there.
pub fn off_line(
    name: &str,
    low: &mut Lowering,
    place: &Place,
    line: &Line,
) -> Option<(Vec<Product>, Rational)> {
    let line = &low.headed_line(line.clone());
    let across = low.between(&line.base, place);
    let along = dot(&line.along.at, &across.at);
    let square =
        dot(&across.at, &across.at) - &along * &along / dot(&line.along.at, &line.along.at);
    if square.is_zero() {
        return None;
    }
    let unit = low.length(&line.along);
    let at = &Real::from(along) / &length(&line.along.at);
    let what = format!("{name}, the projection");
    let projection = low.scalar(what.clone(), 1, Parity::Even, at);
    let mut products = low.dot(-1, &line.along.forms, &across.forms);
    products.push(Product::new(1, value(projection), value(unit)));
    low.equate(&what, products, vec![Real::zero()], 1 + line.along.power);
    let mut products = low.dot(1, &across.forms, &across.forms);
    products.push(Product::new(-1, value(projection), value(projection)));
    Some((products, square))
}
