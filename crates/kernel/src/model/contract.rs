//! Cutting away from a box of symbols what the equations exclude.

use super::{Model, Range};
use crate::interval::rounding::{UNDERFLOW, UNIT_ROUNDOFF, gamma};

/// No point of the box meets the equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Empty;

/// By how much a bound has to be clear, as a part of what it is about: whoever searches leaves a little more than
/// whoever checks, who may come to other roundings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Margin {
    /// A billionth.
    Some,
    /// Nothing.
    None,
}

impl Margin {
    /// How much that is of a size.
    pub fn of(self, size: f64) -> f64 {
        match self {
            Margin::Some => 1e-9 * size,
            Margin::None => 0.0,
        }
    }
}

/// Narrows the ranges `u` of the symbols, parts of [−1, 1], to where all equations e(u) = 0 can hold: each
/// equation is solved for each symbol, and then each of the combinations that Gauss–Jordan
/// elimination makes of their linear parts. `rows`: room for these.
pub fn contract<const S: usize, const M: usize>(
    equations: &[Model<S, M>],
    rows: &mut Vec<Model<S, M>>,
    u: &mut [Range; S],
    margin: Margin,
) -> Result<(), Empty> {
    for equation in equations {
        solve(equation, u, margin)?;
    }
    if S == 0 || equations.len() < 2 {
        return Ok(());
    }
    rows.clear();
    rows.extend(equations.iter().filter(|e| e.r < 1e3).copied());
    let count = rows.len().min(S);
    let mut used = [false; S];
    for step in 0..count {
        let mut best = (0.0, step, 0);
        for (r, row) in rows.iter().enumerate().skip(step) {
            // A row's constant, quadratic part and remainder are what limits its use.
            let blur = row.c[0].abs() + row.linear() + row.quadratic() + row.r + UNDERFLOW;
            for i in (0..S).filter(|&i| !used[i]) {
                let weight = row.c[1 + i].abs() / blur;
                // Of equal ones the first, whatever was rounded.
                if weight > 1.001 * best.0 {
                    best = (weight, r, i);
                }
            }
        }
        let (weight, r, i) = best;
        // What is left may be without a zero all the same.
        if !(weight > 1e-9) {
            break;
        }
        used[i] = true;
        rows.swap(step, r);
        let pivot = rows[step];
        for (other, row) in rows.iter_mut().enumerate() {
            let factor = row.c[1 + i] / pivot.c[1 + i];
            if other != step && factor.is_finite() && factor.abs() > 1e-12 {
                *row = row.minus(&pivot.scaled(factor));
            }
        }
    }
    for row in rows.iter() {
        solve(row, u, margin)?;
    }
    Ok(())
}

/// Narrows each symbol's range by one equation.
fn solve<const S: usize, const M: usize>(
    e: &Model<S, M>,
    u: &mut [Range; S],
    margin: Margin,
) -> Result<(), Empty> {
    if !(e.r < 1e100) {
        return Ok(());
    }
    let (mut lo, mut hi, mut size) = (e.c[0] - e.r, e.c[0] + e.r, e.size());
    let mut q = 1 + S;
    for i in 0..S {
        let (g, h) = (e.c[1 + i], e.c[q]);
        let (linear, square) = (times(g, u[i]), square(h, u[i]));
        lo += linear.lo + square.lo;
        hi += linear.hi + square.hi;
        q += 1;
        for j in i + 1..S {
            let cross = e.c[q].abs() * largest(u[i]) * largest(u[j]);
            lo -= cross;
            hi += cross;
            q += 1;
        }
    }
    // Every term and sum above is at most this in size.
    size = gamma(400) * size + UNDERFLOW;
    (lo, hi) = (lo - size, hi + size);
    let least = margin.of(e.c[0].abs());
    if lo > least || hi < -least {
        return Err(Empty);
    }
    for i in 0..S {
        let g = e.c[1 + i];
        let linear = times(g, u[i]);
        // −g u_i is the rest, which has the roundings of the whole.
        let (rest_lo, rest_hi) = (lo - linear.lo - size, hi - linear.hi + size);
        if !(g.abs() > 1e-12 * (rest_hi - rest_lo)) {
            continue;
        }
        let (a, b) = (-rest_hi / g, -rest_lo / g);
        let out = |x: f64| 4.0 * UNIT_ROUNDOFF * x.abs() + margin.of(1.0) + UNDERFLOW;
        let (low, high) = if g > 0.0 { (a, b) } else { (b, a) };
        let (low, high) = (low - out(low), high + out(high));
        if low > u[i].hi || high < u[i].lo {
            return Err(Empty);
        }
        if low > u[i].lo {
            u[i].lo = low;
        }
        if high < u[i].hi {
            u[i].hi = high;
        }
    }
    Ok(())
}

fn largest(u: Range) -> f64 {
    u.lo.abs().max(u.hi.abs())
}

fn times(g: f64, u: Range) -> Range {
    let (lo, hi) = if g >= 0.0 { (u.lo, u.hi) } else { (u.hi, u.lo) };
    Range {
        lo: g * lo,
        hi: g * hi,
    }
}

/// h u².
fn square(h: f64, u: Range) -> Range {
    let hi = largest(u) * largest(u);
    let lo = if u.lo > 0.0 || u.hi < 0.0 {
        u.lo.abs().min(u.hi.abs()).powi(2)
    } else {
        0.0
    };
    times(h, Range { lo, hi })
}
