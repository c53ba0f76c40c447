//! Which equations say something new at a figure, and which unknowns nothing determines.
//!
//! This is seen in floats, by elimination with full pivoting. Nothing of a proof rests on it: whatever is chosen
//! here, what is proved is about the equations chosen, with the unknowns that nothing determines standing still.

use super::System;
use crate::constraint::{Entry, Form};

/// A pivot below this part of its row's largest entry counts as zero. Sketches meet their constraints to some eight
/// digits, and where one constraint follows from others a pivot is as small as that.
const PIVOT: f64 = 1e-6;

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

impl Choice {
    /// Looks at a system where its unknowns have these values, coordinates and lengths in a unit in which the figure
    /// is of size about 1. `later`: unknowns that shall rather be free than others.
    pub fn new(system: &System, at: &[f64], later: impl Fn(usize) -> bool) -> Self {
        let width = system.unknowns.len();
        let form = |form: Form| match form {
            Form::One => 1.0,
            Form::Difference(a, b) => value(a, at) - value(b, at),
        };
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(system.rows.len());
        for row in &system.rows {
            let mut entries = vec![0.0; width];
            for p in &row.products {
                let factor = f64::from(p.factor);
                for (this, other) in [(p.left, p.right), (p.right, p.left)] {
                    if let Form::Difference(a, b) = this {
                        let slope = factor * form(other);
                        for (entry, sign) in [(a, 1.0), (b, -1.0)] {
                            if let Entry::Unknown(u) = entry {
                                entries[u] += sign * slope;
                            }
                        }
                    }
                }
            }
            let largest = entries.iter().fold(0.0f64, |max, x| max.max(x.abs()));
            if largest > 0.0 {
                entries.iter_mut().for_each(|x| *x /= largest);
            }
            rows.push(entries);
        }
        let mut is_pivot = vec![false; width];
        let mut left: Vec<usize> = (0..rows.len()).collect();
        let mut used = Vec::new();
        for may_be_free in [false, true] {
            loop {
                let mut best = (PIVOT, None);
                for (k, &row) in left.iter().enumerate() {
                    for (column, x) in rows[row].iter().enumerate() {
                        if x.abs() > best.0 && later(column) == may_be_free {
                            best = (x.abs(), Some((k, column)));
                        }
                    }
                    // A row with an entry of full size will do.
                    if best.0 >= 1.0 {
                        break;
                    }
                }
                let Some((k, column)) = best.1 else {
                    break;
                };
                let row = left.swap_remove(k);
                is_pivot[column] = true;
                used.push(row);
                let pivot = std::mem::take(&mut rows[row]);
                let support: Vec<usize> = (0..width).filter(|&c| pivot[c] != 0.0).collect();
                for &other in &left {
                    let factor = rows[other][column] / pivot[column];
                    if factor != 0.0 {
                        for &c in &support {
                            rows[other][c] -= factor * pivot[c];
                        }
                        rows[other][column] = 0.0;
                    }
                }
            }
        }
        used.sort_unstable();
        left.sort_unstable();
        Choice {
            used,
            redundant: left,
            free: (0..width).filter(|&u| !is_pivot[u]).collect(),
        }
    }
}

fn value(entry: Entry, at: &[f64]) -> f64 {
    match entry {
        Entry::Unknown(u) => at[u],
        _ => 0.0,
    }
}
