//! Elimination in matrices with few entries, for guesses: nobody has to trust it.

use super::matrix::{Columns, Matrix};

/// A pivot is at least so much of the largest entry that is left in its row.
const THRESHOLD: f64 = 0.1;
/// So many of the shortest rows are looked at for a pivot.
const CANDIDATES: usize = 4;

/// A matrix M, eliminated row by row.
pub struct Sparse {
    n: usize,
    steps: Vec<Step>,
}

/// A pivot, what is to its right, and how often its row was taken from others.
struct Step {
    row: usize,
    column: usize,
    pivot: f64,
    right: Vec<(usize, f64)>,
    below: Vec<(usize, f64)>,
}

impl Sparse {
    /// `None`: the matrix is singular, or the elimination leaves too little of its zeros to be of use.
    pub fn new(columns: &Columns) -> Option<Sparse> {
        let n = columns.len();
        let mut rows: Vec<Vec<(usize, f64)>> = vec![Vec::new(); n];
        let mut in_column: Vec<Vec<usize>> = vec![Vec::new(); n];
        for (j, column) in columns.iter().enumerate() {
            for &(i, x) in column {
                match rows[i].last_mut() {
                    Some((last, sum)) if *last == j => *sum += x,
                    _ => {
                        rows[i].push((j, x));
                        in_column[j].push(i);
                    }
                }
            }
        }
        let mut left: Vec<usize> = (0..n).collect();
        let (mut steps, mut work, mut place) = (Vec::with_capacity(n), 0, vec![usize::MAX; n]);
        while !left.is_empty() {
            let (at, column) = best(&rows, &in_column, &mut left)?;
            let row = left.swap_remove(at);
            let mut right = std::mem::take(&mut rows[row]);
            for &(j, _) in &right {
                in_column[j].retain(|&i| i != row);
            }
            let at = right.iter().position(|x| x.0 == column)?;
            let pivot = right.swap_remove(at).1;
            let mut below = Vec::new();
            for i in std::mem::take(&mut in_column[column]) {
                let other = &mut rows[i];
                let at = other.iter().position(|x| x.0 == column)?;
                let factor = other.swap_remove(at).1 / pivot;
                for (k, x) in other.iter().enumerate() {
                    place[x.0] = k;
                }
                for &(j, x) in &right {
                    match other.get_mut(place[j]).filter(|x| x.0 == j) {
                        Some(entry) => entry.1 -= factor * x,
                        None => {
                            other.push((j, -factor * x));
                            in_column[j].push(i);
                        }
                    }
                }
                below.push((i, factor));
            }
            work += right.len() + below.len() + 1;
            if work > n * n / 8 || !(pivot.abs() > 0.0 && pivot.is_finite()) {
                return None;
            }
            steps.push(Step {
                row,
                column,
                pivot,
                right,
                below,
            });
        }
        Some(Sparse { n, steps })
    }

    /// M⁻¹, column by column.
    pub fn inverse(&self) -> Matrix {
        let n = self.n;
        let mut entries = vec![0.0; n * n];
        entries.iter_mut().step_by(n + 1).for_each(|x| *x = 1.0);
        // The rows of (Mᵀ)⁻¹.
        let mut out = vec![0.0; n * n];
        for step in &self.steps {
            let (z, from) = (step.row * n, step.column * n);
            for k in 0..n {
                out[z + k] = entries[from + k] / step.pivot;
            }
            for &(j, x) in &step.right {
                take(&mut entries[j * n..(j + 1) * n], &out[z..z + n], x);
            }
        }
        for step in self.steps.iter().rev() {
            for &(i, x) in &step.below {
                take_row(&mut out, n, step.row, i, x);
            }
        }
        Matrix { n, entries: out }
    }

    /// M⁻¹ f.
    pub fn solve_one(&self, f: &[f64]) -> Vec<f64> {
        let (mut left, mut out) = (f.to_vec(), vec![0.0; self.n]);
        for step in &self.steps {
            let from = left[step.row];
            step.below.iter().for_each(|&(i, x)| left[i] -= x * from);
        }
        for step in self.steps.iter().rev() {
            let known = step.right.iter().map(|&(j, x)| x * out[j]);
            out[step.column] = (left[step.row] - known.sum::<f64>()) / step.pivot;
        }
        out
    }

    /// (M⁻¹ B)ᵀ from Bᵀ: row by row.
    pub fn solve(&self, b: &Matrix) -> Matrix {
        let (n, mut rows) = (self.n, b.entries.clone());
        for step in &self.steps {
            for &(i, x) in &step.below {
                take_row(&mut rows, n, i, step.row, x);
            }
        }
        let mut entries = vec![0.0; n * n];
        for step in self.steps.iter().rev() {
            let (to, from) = (step.column * n, step.row * n);
            entries[to..to + n].copy_from_slice(&rows[from..from + n]);
            for &(j, x) in &step.right {
                take_row(&mut entries, n, step.column, j, x);
            }
            let out = &mut entries[to..to + n];
            out.iter_mut().for_each(|x| *x /= step.pivot);
        }
        Matrix { n, entries }
    }
}

/// The place in `left` of the row with the best pivot, and its column: few entries beside and below it.
fn best(
    rows: &[Vec<(usize, f64)>],
    in_column: &[Vec<usize>],
    left: &mut [usize],
) -> Option<(usize, usize)> {
    let few = CANDIDATES.min(left.len());
    // The shortest rows first.
    for k in 0..few {
        let shortest = (k..left.len()).min_by_key(|&at| rows[left[at]].len())?;
        left.swap(k, shortest);
    }
    let candidates = (0..few).flat_map(|at| {
        let row = &rows[left[at]];
        let largest = row.iter().fold(0.0f64, |max, x| max.max(x.1.abs()));
        let pivots = row.iter().filter(move |x| x.1.abs() >= THRESHOLD * largest);
        pivots.map(move |x| ((row.len() - 1) * (in_column[x.0].len() - 1), at, x.0))
    });
    let best = candidates.min_by_key(|x| x.0)?;
    Some((best.1, best.2))
}

fn take(from: &mut [f64], row: &[f64], factor: f64) {
    for (x, y) in from.iter_mut().zip(row) {
        *x -= factor * y;
    }
}

/// Takes a row from another.
fn take_row(entries: &mut [f64], n: usize, from: usize, row: usize, factor: f64) {
    let (low, high) = (from.min(row), from.max(row));
    let (first, second) = entries.split_at_mut(high * n);
    let (first, second) = (&mut first[low * n..(low + 1) * n], &mut second[..n]);
    match from < row {
        true => take(first, second, factor),
        false => take(second, first, factor),
    }
}
