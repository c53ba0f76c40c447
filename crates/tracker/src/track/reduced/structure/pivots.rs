//! Which equations find the unknowns of a group at a point: those whose rows depend least on each other.

use super::layout::WIDEST;
use crate::places::Each as _;

/// One number for each unknown of a group.
pub type Wide = [f64; WIDEST];

/// What is left of a row, and whether it was taken.
#[derive(Debug, Clone)]
pub struct Candidate {
    row: Wide,
    /// Whether it has a pivot.
    pub taken: bool,
}

impl Candidate {
    /// A row that counts as so long.
    pub fn new(row: Wide, long: f64) -> Self {
        Candidate {
            row: divided(row, long),
            taken: false,
        }
    }

    /// The square of what is left of it, and the place of the pivot, of which it has at most √size times as much: where
    /// the pivot is small it counts. Negative if there is nothing to be had.
    fn worth(&self, open: &[bool; WIDEST], size: usize) -> (f64, usize) {
        let (mut pivot, mut at) = (-1.0, 0);
        for place in 0..size {
            if open[place] && self.row[place].abs() >= pivot {
                (pivot, at) = (self.row[place].abs(), place);
            }
        }
        if self.taken || pivot < 0.0 {
            return (-1.0, at);
        }
        let row = &self.row[..size];
        let worth = dot(row, row).min(size as f64 * pivot * pivot);
        (worth, at)
    }
}

/// Takes the row with the best pivot in an open place, and what the others have of its direction out of them. Returns
/// the row, the place and its worth; nothing if that is less than the `least` asked for.
#[inline(always)]
pub fn take_best(
    rows: &mut [Candidate],
    open: &mut [bool; WIDEST],
    size: usize,
    least: f64,
) -> Option<(usize, usize, f64)> {
    let (mut best, mut most) = (None, least);
    for (r, candidate) in rows.iter().enumerate() {
        let (worth, place) = candidate.worth(open, size);
        if worth >= most {
            (best, most) = (Some((r, place)), worth);
        }
    }
    let (best, place) = best?;
    let direction = rows[best].row;
    let direction = divided(direction, dot(&direction, &direction).sqrt());
    let direction = &direction[..size];
    rows[best].taken = true;
    open[place] = false;
    for Candidate { row, .. } in rows.iter_mut().filter(|row| !row.taken) {
        let along = dot(row, direction);
        for (x, direction) in row.iter_mut().zip(direction) {
            *x -= along * direction;
        }
    }
    Some((best, place, most))
}

/// The sum of the products of two rows' numbers, as far as both go.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn divided(row: Wide, by: f64) -> Wide {
    if by > 0.0 { row.each(|x| x / by) } else { row }
}
