//! `along`: how much further along a line the second of two points is than the first, with its sign.
//!
//! `u·(q − p) = d |u|`, and d goes linearly from what it is in the sketch to what is wanted.

use super::prelude::*;

/// See the module.
pub const ALONG: Kind = Kind {
    key: "along",
    meaning: "the second point is by that much further along the line than the first (with its sign; a line leads from its \
         first point to its second)",
    takes: "two points and a line",
    measure: Measure::Signed,
    ..Kind::lowered_by(lower)
};

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let (first, second) = (of.items.point()?, of.items.point()?);
    if first == second {
        return Err("the two points are one and the same".to_owned());
    }
    let line = of.items.line()?;
    of.items.end()?;
    let line = low.line(line)?;
    let across = low.between(&low.place(first), &low.place(second));
    let products = low.dot(1, &line.along.forms, &across.forms);
    let now = dot(&line.along.at, &across.at);
    let then = Real::from(of.number().value().clone());
    low.measure(
        of.name,
        Measured {
            products,
            now,
            then,
            power: 1,
            odd: false,
            arrows: vec![&line.along],
        },
    );
    Ok(())
}
