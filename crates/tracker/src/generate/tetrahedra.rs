//! Tetrahedra face to face.

use super::frame::{Frame, JITTER, RADIUS, on_circle, plus};
use crate::random::Random;
use std::f64::consts::TAU;

/// Each point is joined to the three before it.
pub(super) fn frame(points: usize, random: &mut Random) -> Frame {
    // Boerdijk and Coxeter's helix, bent round: a step forward by 1/√10, a turn by arccos(−2/3),
    // at a distance of √(27/100) from the middle, for edges of length 1.
    let (step, turn) = (0.1f64.sqrt(), (-2.0f64 / 3.0).acos());
    let middle = 0.27f64.sqrt();
    let places = (0..points).map(|k| {
        let angle = (k as f64 * turn) % TAU;
        let regular = on_circle(
            k as f64 * step / RADIUS,
            middle * angle.cos(),
            middle * angle.sin(),
        );
        plus(regular, random.jitter(3, JITTER))
    });
    Frame::of_simplices(3, places.collect())
}
