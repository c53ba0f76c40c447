//! Distances to a boundary configuration (RR 8705, sections 4.2 and 6).
//!
//! In a boundary configuration of an instruction its two intersections merge: driving parameters
//! are then no longer coordinates of the path. The distance γ is between 0 and 1, zero there.
//!
//! The paper's γ does not see another place where an instruction breaks down: where its centres
//! coincide (in the plane), or a sphere's centre is on the axis of the circle that it meets, so
//! that there are infinitely many intersections. No generic path passes through such a place, but
//! a long one comes near. Therefore γ here is the smaller of the paper's and of the sine of the
//! angle at which the arms meet in the point constructed. Together they bound the derivatives.

use super::vector::{V3, cross, dot, norm, sub};

/// γ of interCC, interSSP and interSS: the distance of `p` from the line through the centres `c1`
/// and `c2`, relative to the larger radius; or the sine of the angle between the two arms.
///
/// ```
/// use krawl::plan::boundary::gamma_two;
/// assert_eq!(gamma_two([0.0, 3.0, 0.0], [-4.0, 0.0, 0.0], [1.0, 0.0, 0.0]), 0.6);
/// ```
pub fn gamma_two(p: V3, c1: V3, c2: V3) -> f64 {
    let (u1, u2) = (sub(p, c1), sub(p, c2));
    let (r1, r2) = (norm(u1), norm(u2));
    norm(cross(u1, u2)) / (r1.max(r2) * norm(sub(c2, c1)).max(r1.min(r2)))
}

/// γ of interCS: the distance of `p` from the plane through the three centres, which is its
/// distance from the line through the circle's centre and the foot of `c3` in the circle's plane,
/// relative to the larger of the circle's radius and `|p − c3|`; or the sine of the angle between
/// the third arm and the plane of the two others.
pub fn gamma_three(p: V3, c1: V3, c2: V3, c3: V3) -> f64 {
    let (u1, u2, u3) = (sub(p, c1), sub(p, c2), sub(p, c3));
    let (line, r3) = (sub(c2, c1), norm(u3));
    let across = cross(u1, u2);
    let volume = dot(across, u3).abs();
    let height = volume / norm(cross(line, sub(c3, c1)));
    let radius = norm(across) / norm(line);
    (height / radius.max(r3)).min(volume / (r3 * norm(across)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vanishes_where_intersections_merge() {
        let (c1, c2) = ([0.0, 0.0, 0.0], [2.0, 0.0, 0.0]);
        assert_eq!(gamma_two([1.0, 0.0, 0.0], c1, c2), 0.0);
        assert_eq!(gamma_two([5.0, 0.0, 0.0], c1, c2), 0.0);
        assert!((gamma_two([0.0, 2.0, 0.0], c1, c2) - 0.5f64.sqrt()).abs() < 1e-15);
        // A point of the plane of the centres, and the same lifted by a tenth of the radii.
        let c3 = [1.0, 2.0, 0.0];
        assert_eq!(gamma_three([1.0, 1.0, 0.0], c1, c2, c3), 0.0);
        let gamma = gamma_three([1.0, 1.0, 0.1], c1, c2, c3);
        assert!((gamma - 0.1 / 1.01f64.sqrt()).abs() < 1e-15, "{gamma}");
    }

    #[test]
    fn sees_a_centre_on_the_axis() {
        // Centres almost on a line, the point far from it: the paper's γ would be about 1.
        let gamma = gamma_three(
            [0.0, 0.0, 1.0],
            [-1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.5, 1e-3, 0.0],
        );
        assert!(gamma < 1e-2);
        assert!(gamma_two([0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [1e-3, 0.0, 0.0]) < 2e-3);
    }
}
