//! New places for reference points (RR 8705, Algorithm 4 and section 6).

use super::vector::{V3, add_scaled, cross, dot, norm, perpendicular, sub, unit};

/// Algorithm 4: a new reference point for a driven interCC or interSSP, from the point `p`
/// constructed, the other centre `c1` and the former centre `c2`. All are in the xy plane.
///
/// It lies at the distance `|p − c1|` from `p`, at a right angle from `c1`, on the side of the line
/// through the two centres. γ is √½. (The paper takes the perpendicular to that line, which near
/// a boundary configuration is almost the same; this one also helps where `c1` and `c2` are near
/// each other.)
pub(super) fn shift_in_plane(p: V3, c1: V3, c2: V3) -> V3 {
    let u = sub(p, c1);
    let across = [-u[1], u[0], 0.0];
    let line = sub(c2, c1);
    let along = dot(u, line) / dot(line, line);
    let foot = add_scaled(c1, along, line);
    // Where p is on the line to within rounding, either side serves.
    let side = if dot(across, sub(foot, p)) < 0.0 {
        -1.0
    } else {
        1.0
    };
    add_scaled(p, side, across)
}

/// A place for the reference point of an interSS whose circle is then met by a sphere around `c3`.
///
/// In space the condition on γ leaves a circle of places; taken is the one at a right angle from
/// both `c1` and `c3` as seen from `p`, so that interCS profits as well. γ is √½.
pub(super) fn shift_in_space(p: V3, c1: V3, c3: V3) -> V3 {
    let u = sub(p, c1);
    let across = cross(u, sub(p, c3));
    let clear = norm(across) > 1e-3 * norm(u) * norm(sub(p, c3));
    let direction = unit(across)
        .filter(|_| clear)
        .unwrap_or_else(|| perpendicular(u));
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

#[cfg(test)]
mod tests {
    use super::super::boundary::{gamma_three, gamma_two};
    use super::*;
    use proptest::prelude::*;

    fn vector(flat: bool) -> impl Strategy<Value = V3> {
        prop::array::uniform3(-1.0f64..1.0)
            .prop_map(move |v| if flat { [v[0], v[1], 0.0] } else { v })
    }

    proptest! {
        // Proposition 2, and its equivalents of section 6.
        #[test]
        fn shifting_leads_away_from_the_boundary(p in vector(true), c1 in vector(true), s in -3.0f64..3.0, off in -0.05f64..0.05) {
            prop_assume!(norm(sub(p, c1)) > 1e-3 && s.abs() > 1e-2);
            let u = sub(p, c1);
            let c2 = add_scaled(add_scaled(p, s, u), off, [-u[1], u[0], 0.0]);
            prop_assert!(gamma_two(p, c1, shift_in_plane(p, c1, c2)) > 0.7);
            prop_assert!(gamma_two(p, c1, shift_in_plane(p, c1, add_scaled(p, s, u))) > 0.7);
        }

        #[test]
        fn shifting_leads_away_in_space(p in vector(false), c1 in vector(false), c2 in vector(false), c3 in vector(false)) {
            prop_assume!(norm(sub(p, c1)) > 1e-3 && norm(sub(p, c3)) > 1e-3);
            let first = shift_in_space(p, c1, c3);
            prop_assert!(gamma_two(p, c1, first) > 0.7);
            prop_assert!(gamma_three(p, c1, first, shift_from_circle(p, c1, first)) > 0.7);
            prop_assume!(gamma_two(p, c1, c2) > 0.1);
            prop_assert!(gamma_three(p, c1, c2, shift_from_circle(p, c1, c2)) > 0.7);
        }
    }
}
