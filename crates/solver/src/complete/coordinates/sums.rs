//! Sums of two equations in which products of unknowns cancel.
//!
//! Two spheres about given points meet in a plane, and so do other quadrics that have most products in common. Each by itself
//! bounds a point badly where it holds for many places; the plane does not. So of every two equations of a block the sum of whole multiples in
//! which most products cancel is taken, if it has fewer than either, or by two fewer than one of them, and narrows ranges beside them. It is 0 at every
//! zero.

use super::expanded::Expanded;
use super::newton::Square;
use super::system::Row;
use crate::interval::Interval;

/// The greatest number of sums taken, so that they cost no more than all else.
const MOST: usize = 200;

/// The sums of a block's equations, as rows, entries of blocks before being in their ranges. `zero`: the entry that is the number 0.
pub fn sums(square: &Square, zero: usize, x: &[Interval]) -> Vec<Row> {
    let rows = square.rows.iter();
    let rows: Vec<Expanded> = rows
        .filter_map(|row| Expanded::new(row, square, x))
        .collect();
    let pairs = rows.iter().enumerate();
    let pairs = pairs.flat_map(|(e, one)| rows[..e].iter().map(move |other| (one, other)));
    let sums = pairs.filter_map(|(one, other)| {
        let sizes = [one.quadratic.len(), other.quadratic.len()];
        let (least, most) = (sizes[0].min(sizes[1]), sizes[0].max(sizes[1]));
        let tried = one.quadratic.iter().filter_map(|(key, &q)| {
            let p = *other.quadratic.get(key)?;
            one.less(p, other, q)
        });
        let best = tried.min_by_key(|sum| sum.quadratic.len())?;
        let left = best.quadratic.len();
        (left < least || left + 2 <= most).then(|| best.row(&square.own, zero))
    });
    sums.take(MOST).collect()
}
