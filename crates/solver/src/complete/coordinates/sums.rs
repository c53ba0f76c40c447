//! Sums of two equations in which products of unknowns cancel.
//!
//! Two spheres about given points meet in a plane, and so do other quadrics that have most products in common. Each by itself
//! bounds a point badly where it holds for many places; the plane does not. So of every two equations of a block the sum of whole multiples in
//! which most products cancel is taken, if it has fewer than either, or by two fewer than one of them, and narrows ranges beside them. It is 0 at every
//! zero.

use super::expanded::equations;
use super::newton::Square;
use super::sides;
use super::system::Row;
use crate::certificate::cover::coordinates::sums::choose;
use crate::interval::Interval;

/// The sums of a block's equations, as rows, entries of blocks before being in their ranges. `zero`: the entry that is the number 0.
pub fn sums(square: &Square, zero: usize, x: &[Interval]) -> Vec<Row> {
    let rows = equations(square, x);
    let sums = choose(&rows).into_iter().filter_map(|sum| sum.of(&rows));
    sums.map(|sum| sides::row(&sum.flat(&square.own), zero))
        .collect()
}
