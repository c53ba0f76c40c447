//! Pairs of triangles that the path must flatten together.

use super::{Remark, triangles};
use crate::problem::Problem;
use crate::rational::Rational;
use std::collections::HashMap;

/// The squares of a length in the sketch and in the target, and whether it bends.
fn lengths(problem: &Problem, index: usize) -> (Rational, Rational, bool) {
    let distance = &problem.distances[index];
    (
        problem.squared_in_sketch(distance.points),
        distance.target.squared(),
        index == problem.homotopy.bend,
    )
}

/// Triangles on a common side whose other sides are the same, in whichever order.
///
/// In the plane only: in space one that collapses does not take the other's freedom away.
pub(super) fn twins(problem: &Problem) -> Vec<Remark> {
    if problem.dimension != 2 {
        return Vec::new();
    }
    let mut on_side: HashMap<usize, Vec<(usize, [usize; 2])>> = HashMap::new();
    for (points, sides) in triangles(problem) {
        for k in 0..3 {
            let others = [sides[(k + 1) % 3], sides[(k + 2) % 3]];
            on_side
                .entry(sides[k])
                .or_default()
                .push((points[k], others));
        }
    }
    let mut sides: Vec<usize> = on_side.keys().copied().collect();
    sides.sort_unstable();
    let mut all = Vec::new();
    for side in sides {
        let corners = &on_side[&side];
        for (k, (one, [a, b])) in corners.iter().enumerate() {
            for (other, [c, d]) in &corners[..k] {
                let [a, b, c, d] = [a, b, c, d].map(|&s| lengths(problem, s));
                if a == c && b == d || a == d && b == c {
                    all.push(Remark::Twins {
                        side: problem.distances[side].points,
                        corners: [*other, *one],
                    });
                }
            }
        }
    }
    all
}
