//! Triangles in the plane.

use super::frame::{Frame, JITTER, RADIUS, on_circle, plus};
use crate::random::Random;

/// Each point is joined to the two before it.
pub(super) fn frame(points: usize, random: &mut Random) -> Frame {
    let height = 0.75f64.sqrt();
    let places = (0..points).map(|k| {
        let out = if k % 2 == 0 { 0.0 } else { height };
        let regular = on_circle(0.5 * k as f64 / (RADIUS + 0.5 * height), out, 0.0);
        plus(regular, random.jitter(2, JITTER))
    });
    Frame::of_simplices(2, places.collect())
}
