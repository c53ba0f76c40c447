//! `x`, `y`, `z`: a coordinate of a point; `dx`, `dy`, `dz`: by how much the second of two points is further
//! along an axis than the first, with its sign.

use super::prelude::*;
use crate::places::array;

/// A coordinate of a point.
pub const fn coordinate<const AXIS: usize>(key: &'static str) -> Kind {
    Kind {
        key,
        meaning: "a coordinate of a point is that number",
        takes: "a point",
        measure: Measure::Signed,
        fixes: |_, _| Fixes {
            frame: true,
            axes: array(|k| k == AXIS),
        },
        ..Kind::lowered_by(lower::<AXIS, false>)
    }
}

/// By how much one coordinate is greater than another.
pub const fn difference<const AXIS: usize>(key: &'static str) -> Kind {
    Kind {
        key,
        meaning: "the second point is by that much further along the axis than the first (with its sign)",
        takes: "two points",
        measure: Measure::Signed,
        fixes: Fixes::direction,
        ..Kind::lowered_by(lower::<AXIS, true>)
    }
}

fn lower<const AXIS: usize, const DIFFERENCE: bool>(
    mut of: Given,
    low: &mut Lowering,
) -> Result<(), Fault> {
    if AXIS >= low.dimension() {
        return Err("this is for problems of dimension 3".to_owned());
    }
    let first = of.items.point()?;
    let (form, now) = if DIFFERENCE {
        let second = of.items.point()?;
        if first == second {
            return Err("the two points are one and the same".to_owned());
        }
        let span = low.between(&low.place(first), &low.place(second));
        (span.forms[AXIS], span.at[AXIS].clone())
    } else {
        let place = low.place(first);
        (value(place.entries[AXIS]), place.at[AXIS].clone())
    };
    let then = Real::from(of.number().value().clone());
    of.items.end()?;
    let path = low.lead(now.into(), then);
    low.equate(of.name, vec![Product::new(1, form, Form::One)], path, 1);
    Ok(())
}
