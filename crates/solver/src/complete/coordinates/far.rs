//! Unknowns that may be as large as they like, by the equations that are linear in them.
//!
//! A point at the corner of two legs of known headings is not far away, as L u − M v is the difference of the legs' other ends; but no
//! equation by itself says so. All that is bounded is taken as numbers in their ranges, and what equations are then
//! linear in the unbounded unknowns are solved by elimination in intervals: for every zero in the box the exact numbers are in them, so
//! that every row that is left holds, too.

use super::expanded::expanded;
use super::system::Row;
use crate::certificate::cover::coordinates::{Empty, bounds};
use crate::interval::Interval;

/// Bounds the free entries that are unbounded by the rows that are linear in them. Tells whether any of them is bounded now.
pub fn far(rows: &[&Row], is_free: &[bool], x: &mut [Interval]) -> Result<bool, Empty> {
    let unbounded = (0..x.len()).filter(|&e| is_free[e] && !x[e].is_common_interval());
    let unbounded: Vec<usize> = unbounded.collect();
    let of = |entry: usize| {
        let place = unbounded.iter().position(|&u| u == entry);
        place.ok_or(x[entry])
    };
    let is_about = |row: &&&Row| row.entries.iter().any(|&e| of(e).is_ok());
    let rows = rows.iter().filter(is_about);
    let rows = rows.filter_map(|row| expanded(row, unbounded.len(), of));
    let found = bounds::far(rows, unbounded.len());
    let mut is_better = false;
    for (k, range) in found {
        let entry = unbounded[k];
        let new = x[entry].intersection(range);
        if new.is_empty() {
            return Err(Empty);
        }
        is_better |= new.is_common_interval();
        x[entry] = new;
    }
    Ok(is_better)
}

#[cfg(test)]
mod tests {
    use super::super::system::{Form, Product};
    use super::*;
    use crate::interval::{ZERO, hull, point, upper_half};

    /// (x, y) + L u = (0, 0) and (x, y) + M v = (1, 0) in the entries x, y, L, M, u, v, 0, 1.
    fn corner(u: [f64; 2], v: [f64; 2], wide: f64) -> (Vec<Row>, Vec<Interval>) {
        const ZERO_ENTRY: usize = 8;
        let value = |entry| Form::Difference(entry, ZERO_ENTRY);
        let product = |factor, left, right| Product::new(point(factor), left, right);
        let mut rows = Vec::new();
        for (far, heading, place) in [(2, 4, [0.0, 0.0]), (3, 6, [1.0, 0.0])] {
            for axis in 0..2 {
                let products = vec![
                    product(1.0, value(axis), Form::One),
                    product(1.0, value(far), value(heading + axis)),
                ];
                rows.push(Row::new(products, point(place[axis]), ZERO_ENTRY));
            }
        }
        let mut x = vec![
            Interval::ENTIRE,
            Interval::ENTIRE,
            upper_half(),
            upper_half(),
        ];
        x.extend(
            [u, v]
                .into_iter()
                .flatten()
                .map(|c| hull(c - wide, c + wide)),
        );
        x.push(ZERO);
        (rows, x)
    }

    #[test]
    fn a_corner_of_two_legs_is_not_far_away() {
        // At (0.5, 1): both legs are √1.25 long.
        let size = 1.25f64.sqrt();
        let (u, v) = ([-0.5 / size, -1.0 / size], [0.5 / size, -1.0 / size]);
        let (rows, mut x) = corner(u, v, 1e-3);
        let rows: Vec<&Row> = rows.iter().collect();
        let is_free = [true; 8].into_iter().chain([false]).collect::<Vec<_>>();
        assert_eq!(far(&rows, &is_free, &mut x), Ok(true));
        for (range, exact) in x.iter().zip([0.5, 1.0, size, size]) {
            assert!(range.contains(exact) && range.wid() < 0.05, "{range:?}");
        }
    }

    #[test]
    fn parallel_legs_say_nothing_and_legs_that_part_have_no_corner() {
        let is_free = [true; 8].into_iter().chain([false]).collect::<Vec<_>>();
        let (rows, mut x) = corner([0.0, 1.0], [0.0, 1.0], 1e-3);
        let rows: Vec<&Row> = rows.iter().collect();
        assert_eq!(far(&rows, &is_free, &mut x), Ok(false));
        // Headings that meet behind the ends: a length would be negative.
        let size = 1.25f64.sqrt();
        let (rows, mut x) = corner([0.5 / size, 1.0 / size], [-0.5 / size, 1.0 / size], 1e-3);
        let rows: Vec<&Row> = rows.iter().collect();
        // (0.5, 1) + L u with L = −√1.25.
        assert_eq!(far(&rows, &is_free, &mut x), Err(Empty));
    }
}
