//! `collinear`: three or more points on one line.
//!
//! For each point p beyond two: in the plane `(b − a) × (p − a)` is led to zero, in space `p − a = k (b − a)`
//! with an unknown k.

use super::prelude::*;

/// See the module.
pub const COLLINEAR: Kind = Kind {
    key: "collinear",
    meaning: "three or more points are on one line",
    takes: "three or more points",
    ..Kind::lowered_by(lower)
};

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let points = distinct(&mut of.items)?;
    let [a, b, rest @ ..] = points.as_slice() else {
        return Err("name at least three points".to_owned());
    };
    if rest.is_empty() {
        return Err("any two points are on one line: name at least three".to_owned());
    }
    let along = low.span(*a, *b)?;
    let base = low.place(*a);
    // Where a and b are one point, cross products with b − a say nothing of two others.
    if low.dimension() == 2 && rest.len() > 1 {
        low.nonzero(&along);
    }
    for &point in rest {
        let across = low.between(&base, &low.place(point));
        low.align(of.name, &along, &across);
    }
    Ok(())
}
