//! New places for reference points (RR 8705, Algorithm 4 and section 6).

use super::vector::{V3, add_scaled, cross, dot, norm, perpendicular, scale, sub, unit};

/// Algorithm 4: a new reference point for a driven interCC or interSSP, from the point `p`
/// constructed, the other centre `c1` and the former centre `c2`.
///
/// It lies at the distance `|p − c1|` from `p`, straight away from it towards the line through the
/// two centres. By proposition 2 γ is then at least √½. All three points are in the xy plane, and
/// so is the result.
pub(super) fn shift_in_plane(p: V3, c1: V3, c2: V3) -> V3 {
    let radius = norm(sub(p, c1));
    let u = sub(p, c1);
    let along = unit(sub(c2, c1)).unwrap_or([1.0, 0.0, 0.0]);
    let foot = add_scaled(c1, dot(u, along), along);
    // Where p is on the line to within rounding, either side serves.
    let towards = sub(foot, p);
    let direction = if norm(towards) > 1e-9 * radius {
        scale(1.0 / norm(towards), towards)
    } else {
        [-along[1], along[0], 0.0]
    };
    add_scaled(p, radius, direction)
}

/// The same for interSS, whose circle is then met by a sphere around `c3`.
///
/// In space the condition on γ leaves a circle of places; taken is the one at a right angle from
/// both `c1` and `c3` as seen from `p`, so that interCS profits as well. γ is √½.
pub(super) fn shift_in_space(p: V3, c1: V3, c3: V3) -> V3 {
    let u = sub(p, c1);
    let across = cross(u, sub(p, c3));
    let clear = norm(across) > 1e-3 * norm(u) * norm(sub(p, c3));
    let direction = unit(across).filter(|_| clear).unwrap_or_else(|| perpendicular(u));
    add_scaled(p, norm(u), direction)
}

/// A new reference point for interCS: at a right angle from both centres `c1` and `c2` of the
/// circle as seen from `p`, at the distance of the circle's radius. γ is √½.
///
/// (Section 6 takes the larger of the circle's radius and the former sphere's. For a sphere much
/// larger than the circle γ then falls below any threshold: it is the quotient of the two.)
pub(super) fn shift_from_circle(p: V3, c1: V3, c2: V3) -> V3 {
    let (u1, line) = (sub(p, c1), sub(c2, c1));
    let normal = cross(u1, line);
    let radius = norm(normal) / norm(line);
    match unit(normal) {
        Some(direction) if radius > 1e-9 * norm(u1) => add_scaled(p, radius, direction),
        _ => add_scaled(p, norm(u1), perpendicular(u1)),
    }
}
