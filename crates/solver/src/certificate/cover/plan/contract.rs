//! What equations between models leave of the symbols' ranges.

use super::format::MAX_SYMBOLS;
use super::model::Model;
use crate::interval::{Interval, hull, point};

/// What the equations leave of the symbols' ranges, or nothing: each equation solved for each symbol, then each of the
/// combinations that Gauss–Jordan elimination makes.
pub fn contracted(symbols: usize, equations: &[Model]) -> Option<[Interval; MAX_SYMBOLS]> {
    let mut u = [hull(-1.0, 1.0); MAX_SYMBOLS];
    for equation in equations {
        solve(equation, symbols, &mut u)?;
    }
    let mut rows: Vec<Model> = equations.to_vec();
    let mut used = [false; MAX_SYMBOLS];
    for step in 0..rows.len().min(symbols) {
        let mut best = (1e-9, None);
        for (r, row) in rows.iter().enumerate().skip(step) {
            for i in (0..symbols).filter(|&i| !used[i]) {
                let weight = row.slope(i).abs() / row.blur();
                if weight > 1.001 * best.0 {
                    best = (weight, Some((r, i)));
                }
            }
        }
        let Some((r, i)) = best.1 else {
            rows.truncate(step);
            break;
        };
        used[i] = true;
        rows.swap(step, r);
        let pivot = rows[step];
        for (other, row) in rows.iter_mut().enumerate() {
            let factor = row.slope(i) / pivot.slope(i);
            if other != step && factor.is_finite() && factor.abs() > 1e-12 {
                *row = row.plus(point(-factor), &pivot);
            }
        }
    }
    for row in &rows {
        solve(row, symbols, &mut u)?;
    }
    Some(u)
}

/// Narrows the ranges by one equation; `None` if it cannot hold.
fn solve(equation: &Model, symbols: usize, u: &mut [Interval; MAX_SYMBOLS]) -> Option<()> {
    let whole = equation.range_over(&u[..]);
    if !whole.contains(0.0) {
        return None;
    }
    for i in 0..symbols {
        let slope = equation.slope(i);
        if !(slope.abs() > 0.0 && slope.is_finite()) {
            continue;
        }
        let left = (-equation.range_without(i, &u[..]) / point(slope)).intersection(u[i]);
        if left.is_empty() {
            return None;
        }
        u[i] = left;
    }
    Some(())
}
