//! Which equations say something new at a figure, and which unknowns nothing determines.
//!
//! This is seen in floats, by elimination, what says most that is new first, up to a factor. Nothing of a proof
//! rests on it: whatever is chosen here, what is proved is about the equations chosen, with the unknowns that nothing
//! determines standing still.

use super::System;
use crate::order::InOrder;

/// A pivot below this part of its row's largest entry counts as zero. Sketches meet their constraints to some eight
/// digits, and where one constraint follows from others a pivot is as small as that.
pub(super) const PIVOT: f64 = 1e-6;
/// For choices of which the order of the rows is to decide: one digit is lost at most where it does.
pub(crate) const COARSE: f64 = 0.1;
/// For choices of which how much is new in each row is to decide.
pub(crate) const FINE: f64 = 0.8;

/// What was chosen.
#[derive(Debug, Clone, Default)]
pub struct Choice {
    /// The rows of the system that are used, by position, in order.
    pub used: Vec<usize>,
    /// Those that follow from them near the figure.
    pub redundant: Vec<usize>,
    /// The unknowns that nothing determines.
    pub free: Vec<usize>,
}

/// What shall rather be free than all others.
pub(crate) const FREE_FIRST: u8 = 2;
/// A row that is used after all others, whatever is new in them.
pub(crate) const LAST: u8 = u8::MAX;

impl Choice {
    /// Looks at a system where its unknowns have these values, coordinates and lengths in a unit in which the figure
    /// is of size about 1. `later`: which unknowns shall rather be free than others, the more the higher the number, up to
    /// [`FREE_FIRST`]. `first`: of rows in which as much is new, up to `factor`, those with less of it are rather used than those with more, and of these the earlier.
    pub fn new(
        system: &System,
        at: &[f64],
        later: impl Fn(usize) -> u8,
        first: impl Fn(usize) -> u8,
        factor: f64,
    ) -> Self {
        let width = system.unknowns.len();
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(system.rows.len());
        for row in &system.rows {
            let mut entries = vec![0.0; width];
            row.evaluate(at, |u, slope| entries[u] += slope);
            let largest = entries.iter().fold(0.0f64, |max, x| max.max(x.abs()));
            if largest > 0.0 {
                entries.iter_mut().for_each(|x| *x /= largest);
            }
            rows.push(entries);
        }
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.order_by_key(|&row| (first(row), row));
        let of_all = order.partition_point(|&row| first(row) < LAST);
        let after_all = order.split_off(of_all);
        // Rows already taken, each with the column that it is solved for.
        let mut taken: Vec<(usize, usize)> = Vec::new();
        let mut left = order;
        let rounds = std::iter::successors(Some(factor), |least| Some(least * factor));
        let rounds = rounds.take_while(|&least| least > PIVOT).chain([PIVOT]);
        let rounds = rounds.map(|least| (least, false));
        for (least, is_last) in rounds.chain([(PIVOT, true)]) {
            if is_last {
                left.extend(&after_all);
            }
            let mut again = Vec::new();
            for row in left {
                let mut entries = std::mem::take(&mut rows[row]);
                // What is new in it; it was cleared of those taken in the round before already.
                for &(other, column) in &taken {
                    let times = entries[column] / rows[other][column];
                    if times != 0.0 {
                        let pivots = entries.iter_mut().zip(&rows[other]);
                        pivots.for_each(|(entry, x)| *entry -= times * x);
                        entries[column] = 0.0;
                    }
                }
                let largest = |rank: u8| {
                    let columns = (0..width).filter(|&column| later(column) == rank);
                    let sizes = columns.map(|column| (entries[column].abs(), column));
                    sizes.fold((least, None), |best, (size, column)| match size > best.0 {
                        true => (size, Some(column)),
                        false => best,
                    })
                };
                let column = (0..=FREE_FIRST).find_map(|rank| largest(rank).1);
                rows[row] = entries;
                match column {
                    Some(column) => taken.push((row, column)),
                    None => again.push(row),
                }
            }
            left = again;
        }
        let mut is_pivot = vec![false; width];
        taken
            .iter()
            .for_each(|&(_, column)| is_pivot[column] = true);
        let mut used: Vec<usize> = taken.into_iter().map(|(row, _)| row).collect();
        used.sort_unstable();
        left.sort_unstable();
        Choice {
            used,
            redundant: left,
            free: (0..width).filter(|&u| !is_pivot[u]).collect(),
        }
    }
}
