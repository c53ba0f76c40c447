//! Which points tell by their orientation the senses that constraints leave open.

use crate::problem::{Item, Problem, Shape};
use std::collections::BTreeSet;

/// Triples of points, in order, each once.
#[derive(Default)]
struct Triples(BTreeSet<Vec<usize>>);

impl Triples {
    fn put(&mut self, mut points: Vec<usize>) {
        points.sort_unstable();
        points.dedup();
        if points.len() == 3 {
            self.0.insert(points);
        }
    }
}

/// Points of which the orientation tells a sense that constraints in the plane leave open: both legs of an angle, the ends
/// of a line and the centre of what touches it.
pub(super) fn senses(problem: &Problem) -> Vec<Vec<usize>> {
    let mut out = Triples::default();
    let points_of = |item: &Item| match *item {
        Item::Point(p) => vec![p],
        Item::Object(o) => match problem.objects[o].shape {
            Shape::Line(ends) => ends.to_vec(),
            Shape::Round { center, .. } | Shape::Arc { center, .. } => vec![center],
            _ => Vec::new(),
        },
        Item::Axis(_) => Vec::new(),
    };
    let kinds = ["angles", "tangent", "perpendicular", "distances"];
    let all = problem.constraints.iter();
    for constraint in all.filter(|c| problem.dimension == 2 && kinds.contains(&c.kind.as_str())) {
        let points: Vec<usize> = constraint.items.iter().flat_map(points_of).collect();
        match *points.as_slice() {
            [a, b, c] => out.put(vec![a, b, c]),
            // A point of one line with the other line.
            [a, b, c, d] => {
                out.put(vec![a, b, c]);
                out.put(vec![a, b, d]);
            }
            _ => {}
        }
    }
    out.0.into_iter().collect()
}

/// The same, and three points joined by two distances.
pub(super) fn followed(problem: &Problem) -> Vec<Vec<usize>> {
    let mut out = Triples(senses(problem).into_iter().collect());
    let plane = problem.dimension == 2;
    for (index, distance) in problem.distances.iter().enumerate().filter(|_| plane) {
        let [a, b] = distance.points;
        for other in &problem.distances[index + 1..] {
            let [c, d] = other.points;
            if [c, d].contains(&a) || [c, d].contains(&b) {
                out.put(vec![a, b, c, d]);
            }
        }
    }
    out.0.into_iter().collect()
}
