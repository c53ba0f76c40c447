//! `radii` and `diameters` of circles, spheres and arcs.

use super::prelude::*;

/// A radius.
pub const RADII: Kind = Kind {
    key: "radii",
    meaning: "the radius of a circle, sphere or arc",
    takes: "a circle, sphere or arc",
    measure: Measure::Length,
    ..Kind::lowered_by(lower::<1>)
};

/// A diameter.
pub const DIAMETERS: Kind = Kind {
    key: "diameters",
    meaning: "the diameter of a circle, sphere or arc",
    lower: lower::<2>,
    ..RADII
};

fn lower<const FACTOR: i32>(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let round = of.items.round()?;
    of.items.end()?;
    let round = low.round(round);
    let now = &Real::whole(FACTOR.into()) * &Real::from(round.squared).sqrt();
    let then = Real::from(of.number().value().clone());
    let products = vec![Product::new(FACTOR, value(round.radius), Form::One)];
    let path = low.lead(now, then);
    low.equate(of.name, products, path, 1);
    Ok(())
}
