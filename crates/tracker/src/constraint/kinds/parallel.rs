//! `parallel`: lines, planes, or a line and a plane. `perpendicular`: the same at a right angle, lines also in space,
//! where they need not meet.
//!
//! Of two directions, or two normals, that are parallel one is a multiple of the other ([`Lowering::align`]), and of
//! two that are at a right angle the product is led to zero; with a line and a plane it is the other way round.
//! Neither vector may vanish.

use super::prelude::*;
use crate::places::Each as _;

/// Parallel.
pub const PARALLEL: Kind = Kind {
    key: "parallel",
    meaning: "two lines, two planes, or a line and a plane are parallel",
    takes: "two lines, two planes, or a line and a plane",
    read_as,
    ..Kind::lowered_by(lower::<false>)
};

/// At a right angle.
pub const PERPENDICULAR: Kind = Kind {
    key: "perpendicular",
    meaning: "two lines (which need not meet), two planes, or a line and a plane are at a right angle",
    lower: lower::<true>,
    ..PARALLEL
};

fn read_as(mut items: Arguments) -> Option<String> {
    let names = items.clone();
    let things = items.two_flats().ok()?;
    Some(names.in_words(things.each(Thing::Flat)))
}

fn lower<const RIGHT: bool>(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let (first, second) = super::angle::directions(&mut of.items, low)?;
    if (first.1 == second.1) == RIGHT {
        orthogonal(of.name, low, &first.0, &second.0);
    } else {
        low.nonzero(&first.0);
        low.nonzero(&second.0);
        low.align(of.name, &first.0, &second.0);
    }
    Ok(())
}
