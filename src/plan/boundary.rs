//! Distances to a boundary configuration (RR 8705, sections 4.2 and 6).
//!
//! In a boundary configuration of an instruction its two intersections merge: driving parameters
//! are then no longer coordinates of the path. The distance γ is between 0 and 1, zero there.

use super::vector::{V3, cross, dot, norm, sub};

/// γ of interCC, interSSP and interSS: the distance of `p` from the line through the centres `c1`
/// and `c2`, relative to the larger radius.
///
/// ```
/// use krawl::plan::boundary::gamma_two;
/// assert_eq!(gamma_two([0.0, 3.0, 0.0], [-4.0, 0.0, 0.0], [1.0, 0.0, 0.0]), 0.6);
/// ```
pub fn gamma_two(p: V3, c1: V3, c2: V3) -> f64 {
    let (u1, u2, line) = (sub(p, c1), sub(p, c2), sub(c2, c1));
    norm(cross(line, u1)) / (norm(line) * norm(u1).max(norm(u2)))
}

/// γ of interCS: the distance of `p` from the plane through the three centres, which is its
/// distance from the line through the circle's centre and the foot of `c3` in the circle's plane,
/// relative to the larger of the circle's radius and `|p − c3|`.
pub fn gamma_three(p: V3, c1: V3, c2: V3, c3: V3) -> f64 {
    let (u1, line) = (sub(p, c1), sub(c2, c1));
    let normal = cross(line, sub(c3, c1));
    let height = dot(normal, u1).abs() / norm(normal);
    let radius = norm(cross(line, u1)) / norm(line);
    height / radius.max(norm(sub(p, c3)))
}
