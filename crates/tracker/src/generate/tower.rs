//! Octahedra face to face.

use super::frame::{JITTER, RADIUS, Structure, on_circle, plus};
use crate::places::{Each as _, array};
use crate::random::Random;
use std::f64::consts::TAU;

/// Triangles on top of each other, each turned by a sixth of a full turn against the one before:
/// two neighbours are opposite faces of an octahedron. Of its six points a, b, c are below, and
/// d, e, f above, joined to two of these each.
///
/// In `loops` octahedra, evenly spread, there are the edges and nothing else. In the others the
/// diagonal c d stands in for the edge a f. So the triangles keep all their edges: with one left out,
/// each would take its shape from the one below, and small changes would grow from layer to layer.
pub(super) fn structure(points: usize, loops: usize, random: &mut Random) -> Structure {
    let octahedra = points / 3 - 1;
    // The height of an octahedron over a face, and the distance of its points from the middle,
    // for edges of length 1.
    let (height, middle) = ((2.0f64 / 3.0).sqrt(), (1.0f64 / 3.0).sqrt());
    let mut places = Vec::new();
    for layer in 0..=octahedra {
        for corner in 0..3 {
            let angle = TAU / 3.0 * corner as f64 + TAU / 6.0 * (layer % 6) as f64;
            let around = layer as f64 * height / RADIUS;
            let regular = on_circle(around, middle * angle.cos(), middle * angle.sin());
            places.push(plus(regular, random.jitter(3, JITTER)));
        }
    }
    let is_plain = |k: usize| {
        let before = |k: usize| (k * loops + octahedra / 2) / octahedra;
        before(k + 1) > before(k)
    };
    let mut bars: Vec<([usize; 2], Option<f64>)> =
        [[0, 1], [0, 2], [1, 2]].each(|bar| (bar, None)).to_vec();
    let mut closing = Vec::new();
    for k in 0..octahedra {
        let [a, b, c, d, e, f] = array(|j| 3 * k + j);
        // The turn by a sixth puts d between a and b.
        let regular = [
            [a, d],
            [b, d],
            [b, e],
            [c, e],
            [d, e],
            [c, f],
            [d, f],
            [e, f],
        ];
        bars.extend(regular.each(|bar| (bar, None)));
        if is_plain(k) {
            closing.push([a, f]);
        } else {
            bars.push(([c, d], None));
        }
    }
    bars.extend(closing.into_iter().rev().map(|bar| (bar, None)));
    Structure {
        dimension: 3,
        points: places,
        bars,
        bend_coefficient: 0.2,
    }
}
