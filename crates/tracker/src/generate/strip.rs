//! Triangles in the plane.

use super::frame::{Frame, Hinge, JITTER, RADIUS, on_circle, plus};
use crate::random::Random;

/// Each point is joined to the two before it. Without the bar to the second of these, what comes
/// after turns about the first.
pub(super) fn frame(points: usize, random: &mut Random) -> Frame {
    let height = 0.75f64.sqrt();
    let places = (0..points).map(|k| {
        let out = if k % 2 == 0 { 0.0 } else { height };
        let regular = on_circle(0.5 * k as f64 / (RADIUS + 0.5 * height), out, 0.0);
        plus(regular, random.jitter(2, JITTER))
    });
    let points = places.collect::<Vec<_>>();
    let (mut bars, mut hinges) = (Vec::new(), Vec::new());
    for k in 1..points.len() {
        bars.push([k - 1, k]);
        if k >= 2 {
            hinges.push(Hinge {
                axis: [k - 1, k - 1],
                first: k,
                bar: bars.len(),
            });
            bars.push([k - 2, k]);
        }
    }
    Frame {
        dimension: 2,
        points,
        bars,
        hinges,
    }
}
