//! Octahedra edge to edge.

use super::frame::{Frame, Hinge, JITTER, RADIUS, on_circle, plus};
use crate::places::array;
use crate::random::Random;

/// Of the six points of an octahedron, a and b are an edge shared with the one before, c and d
/// are opposite each other, and the last two are the edge shared with the next, opposite to a b.
///
/// The diagonal c d stands in for the edge from b to the next b. A bar from c to the c before
/// keeps the octahedra from turning about the edge that they share.
pub(super) fn frame(points: usize, random: &mut Random) -> Frame {
    let octahedra = (points - 2) / 4;
    let (half, side) = (0.5, 0.5f64.sqrt());
    let step = 1.0 / RADIUS;
    let mut places = Vec::new();
    let (mut bars, mut hinges) = (Vec::new(), Vec::new());
    for k in 0..=octahedra {
        let angle = step * k as f64;
        for up in [half, -half] {
            places.push(on_circle(angle, 0.0, up));
        }
        if k < octahedra {
            for out in [side, -side] {
                places.push(on_circle(angle + 0.5 * step, out, 0.0));
            }
        }
    }
    bars.push([0, 1]);
    for k in 0..octahedra {
        let at = 4 * k;
        let [a, b, c, d, e, f] = array(|j| at + j);
        bars.extend([[a, c], [b, c]]);
        if k > 0 {
            hinges.push(Hinge {
                axis: [a, b],
                first: c,
                bar: bars.len(),
            });
            bars.push([c - 4, c]);
        }
        bars.extend([[a, d], [b, d], [c, d]]);
        bars.extend([[a, e], [c, e], [d, e]]);
        bars.extend([[c, f], [d, f], [e, f]]);
    }
    Frame {
        dimension: 3,
        points: places
            .into_iter()
            .map(|place| plus(place, random.jitter(3, JITTER)))
            .collect(),
        bars,
        hinges,
    }
}
