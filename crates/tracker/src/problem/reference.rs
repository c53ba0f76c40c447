//! Choosing the reference where the user does not.

use super::check::collinear;
use super::{Distance, Object, Point, Problem, Shape};
use crate::constraint::fix_frame;
use crate::interval::vector::{cross, minus};
use crate::places::Each as _;
use crate::statement::neighbours;

/// A body whose roundest triangle is thinner than this tells its plane badly: other points are taken then.
const THIN: f64 = 0.1;
/// Of a body with more points these are enough to choose from.
const MOST_OF_BODY: usize = 40;

impl Problem {
    /// A problem that was read loosely, up to rigid motions where no constraint says where the figure is or how it is turned.
    pub fn up_to_motions(mut self) -> Self {
        if !fix_frame(&self) {
            let bend = self.homotopy.bend;
            let chosen = choose(
                self.dimension,
                &self.points,
                &self.distances,
                &self.objects,
                bend,
            );
            self.homotopy.reference = chosen.unwrap_or_default();
        }
        self
    }
}

/// Chooses reference points, best-conditioned in the sketch among these, in this order of
/// preference:
///
/// 0. points of the first rigid body, such as the base of a robot, if it is no thin rod: results are then seen from it;
/// 1. mutually constrained points (an edge in the plane, a triangle in space) without the bend:
///    with a free third coordinate the reference could become collinear on the path, and with the
///    bend in it, it could shrink;
/// 2. the same with the bend;
/// 3. in space, two joined points and a third joined to one of them;
/// 4. in space, two joined points and any third;
/// 5. where no distance joins points, the two that are farthest apart, with any third in space.
///
/// `None` if all points of the sketch lie on one line.
pub(super) fn choose(
    dimension: usize,
    points: &[Point],
    distances: &[Distance],
    objects: &[Object],
    bend: usize,
) -> Option<Vec<usize>> {
    let place: Vec<[f64; 3]> = points.iter().map(Point::place).collect();
    let n = points.len();
    let joined = neighbours(n, distances.iter().map(|d| d.points));
    let edge = |a: usize, b: usize| joined[a].iter().find(|&&(c, _)| c == b).map(|&(_, e)| e);

    // The better candidate: first by preference, then by shape; the first one on a tie.
    let mut best: Option<(usize, f64, Vec<usize>)> = None;
    let mut offer = |preference: usize, shape: f64, candidate: &[usize]| {
        let better = best
            .as_ref()
            .is_none_or(|&(p, s, _)| preference < p || preference == p && shape > s);
        let usable = || match *candidate {
            [a, b, c] => !collinear(&points[a], &points[b], &points[c]),
            _ => true,
        };
        if better && usable() {
            best = Some((preference, shape, candidate.to_vec()));
        }
    };

    let bodies = objects.iter().filter_map(|object| match &object.shape {
        Shape::Body { points, local, .. } => Some((points, local)),
        _ => None,
    });
    for (body, local) in bodies.take(1) {
        let local: Vec<[f64; 3]> = local
            .iter()
            .map(|p| p.each_ref().each(|x| x.to_f64()))
            .collect();
        let count = body.len().min(MOST_OF_BODY);
        for (k, l) in (0..count).flat_map(|l| (0..l).map(move |k| (k, l))) {
            let (a, b) = (body[k], body[l]);
            if dimension == 2 {
                offer(0, squared_length(local[k], local[l]), &[a, b]);
                continue;
            }
            for m in l + 1..count {
                let shape = roundness(local[k], local[l], local[m]);
                if shape > THIN {
                    offer(0, shape, &[a, b, body[m]]);
                }
            }
        }
    }
    if distances.is_empty() {
        let pairs = (0..n).flat_map(|a| (0..a).map(move |b| [b, a]));
        let apart = |&[a, b]: &[usize; 2]| squared_length(place[a], place[b]);
        let [a, b] = pairs.max_by(|one, other| apart(one).total_cmp(&apart(other)))?;
        if points[a].sketch == points[b].sketch {
            return None;
        }
        if dimension == 2 {
            offer(5, apart(&[a, b]), &[a, b]);
        } else {
            for c in (0..n).filter(|&c| c != a && c != b) {
                offer(5, roundness(place[a], place[b], place[c]), &[a, b, c]);
            }
        }
    } else if dimension == 2 {
        for (index, distance) in distances.iter().enumerate() {
            let [a, b] = distance.points;
            let preference = if index == bend { 2 } else { 1 };
            offer(preference, squared_length(place[a], place[b]), &[a, b]);
        }
    } else {
        for (index, distance) in distances.iter().enumerate() {
            let [a, b] = distance.points;
            for c in (0..n).filter(|&c| c != a && c != b) {
                let preference = match (edge(a, c), edge(b, c)) {
                    // Every triangle would turn up three times: take it at its last edge.
                    (Some(ac), Some(bc)) if ac < index && bc < index => {
                        if [ac, bc, index].contains(&bend) {
                            2
                        } else {
                            1
                        }
                    }
                    (Some(_), Some(_)) => continue,
                    (None, None) => 4,
                    _ => 3,
                };
                offer(
                    preference,
                    roundness(place[a], place[b], place[c]),
                    &[a, b, c],
                );
            }
        }
    }
    best.map(|(preference, _, mut reference)| {
        // Joined points first, in the order in which people listed them.
        if preference == 0 || dimension == 2 || edge(reference[0], reference[2]).is_some() {
            reference.sort_unstable();
        }
        reference
    })
}

fn squared_length(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum()
}

/// Twice the area over the square of the longest side: 0 for a flat triangle, √3/2 at most.
fn roundness(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    let normal = cross(minus(b, a), minus(c, a));
    let longest = squared_length(a, b)
        .max(squared_length(b, c))
        .max(squared_length(c, a));
    squared_length(normal, [0.0; 3]).sqrt() / longest
}
