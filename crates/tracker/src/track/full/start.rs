//! Setting out from the sketch, and measuring what was travelled.

use super::{Equations, Local, ORDER, Preconditioner};
use crate::linalg::{Singular, Vector, dot};
use crate::system::Homotopy;

/// A tangent larger than this in the coordinate that is held comes from rounding, not from the problem.
pub const LARGEST_TANGENT: f64 = 1e12;

/// The sketch, with t = 0.
pub fn sketch(homotopy: &Homotopy, equations: &Equations) -> Vector {
    let mut z = equations.vector();
    for (z, exact) in z.iter_mut().zip(homotopy.sketch_of_unknowns()) {
        *z = exact.mid();
    }
    z
}

/// Finds the path's unit tangent at `local.z[0]` and sets it as normal: with t rising, or falling
/// where `reverse` says so. Where t is stationary, the other way is the opposite direction still.
///
/// The tangent is the solution of [J; e_k] x = e_n, first with t for the k-th entry, and where
/// that is singular, as at a fold of t, with each of the coordinates.
pub fn first_normal<Y: Preconditioner>(
    equations: &Equations,
    inverter: &mut Y::Maker,
    local: &mut Local<{ ORDER + 1 }, Y>,
    reverse: bool,
) -> Result<(), Singular> {
    let (m, n) = (equations.m, equations.n());
    let (mut last, mut tangent) = (vec![0.0; n], equations.vector());
    last[m] = 1.0;
    for k in (0..n).rev() {
        local.normal.fill(0.0);
        local.normal[k] = 1.0;
        if local.precondition(equations, inverter).is_err() {
            continue;
        }
        local.y.solve(equations, &last, &mut tangent);
        let tangent = &tangent[..n];
        let size = dot(tangent, tangent).sqrt();
        if !(size.is_finite() && size < LARGEST_TANGENT) {
            continue;
        }
        let sign = if (tangent[m] < 0.0) == reverse {
            1.0
        } else {
            -1.0
        };
        for (c, x) in local.normal[..n].iter_mut().zip(tangent) {
            *c = sign * x / size;
        }
        return Ok(());
    }
    Err(Singular)
}

/// Gauss's rule with five points: half of its nodes and their weights, the middle first
/// (Abramowitz and Stegun, table 25.4).
const GAUSS: [(f64, f64); 3] = [
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// The length of ẑ between two parameters, the coordinates counted in units of `unit`.
pub fn path_length<const N: usize, Y: Preconditioner>(
    local: &Local<N, Y>,
    from: f64,
    to: f64,
    unit: f64,
    scratch: &mut Vector,
) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let t = scratch.len() - 2;
    let mut speed = |s: f64| {
        local.slope(s, scratch);
        let x = dot(&scratch[..t], &scratch[..t]);
        (unit * unit * x + scratch[t] * scratch[t]).sqrt()
    };
    let [(_, first), rest @ ..] = GAUSS;
    let mut sum = first * speed(middle);
    for (node, weight) in rest {
        sum += weight * (speed(middle - node * half) + speed(middle + node * half));
    }
    half * sum
}
