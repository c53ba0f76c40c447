//! Which points tell by their orientation the senses that constraints leave open, tangents, angles and chirality.

use crate::interval::enclose;
use crate::problem::{Item, Problem, Shape};
use crate::system::{orientation, simplices};
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

/// Points of which the orientation tells a sense that constraints leave open. In the plane: both legs of an angle, the ends
/// of a line and the centre of what touches it. In space, the chirality of points: each with three joined to it.
pub(in crate::edit) fn senses(problem: &Problem) -> Vec<Vec<usize>> {
    if problem.dimension == 3 {
        return chiralities(problem);
    }
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
    let kinds = [
        "angles",
        "tangent",
        "perpendicular",
        "distances",
        "equal_angles",
        "equal_distances",
    ];
    let all = problem.constraints.iter();
    for constraint in all.filter(|c| kinds.contains(&c.kind.as_str())) {
        let points: Vec<usize> = constraint.items.iter().flat_map(points_of).collect();
        // Of two angles, and of two points with a line each, each half has a sense.
        let parts = match constraint.kind.as_str() {
            "equal_angles" if !matches!(points.len(), 6 | 8) => continue,
            "equal_distances" if points.len() != 6 => continue,
            "equal_angles" | "equal_distances" => 2,
            _ => 1,
        };
        for points in points.chunks(points.len().div_ceil(parts).max(1)) {
            match *points {
                [a, b, c] => out.put(vec![a, b, c]),
                // A point of one line with the other line.
                [a, b, c, d] => {
                    out.put(vec![a, b, c]);
                    out.put(vec![a, b, d]);
                }
                _ => {}
            }
        }
    }
    out.0.into_iter().collect()
}

/// One tetrahedron of each point that is joined to three others at least, the first that is not flat in the sketch.
fn chiralities(problem: &Problem) -> Vec<Vec<usize>> {
    let points = problem.points.iter();
    let sketch: Vec<_> = points.map(|p| p.sketch.each_ref().map(enclose)).collect();
    let mut found = vec![None; problem.points.len()];
    for pair in pairs(problem).collect::<BTreeSet<_>>() {
        for p in pair {
            found[p].get_or_insert_with(Vec::new).push(pair);
        }
    }
    let first = |pairs: Vec<[usize; 2]>| {
        let mut all = simplices(3, problem.points.len(), pairs).into_iter();
        all.find(|set| orientation(&sketch, set) != 0)
    };
    let mut out: Vec<Vec<usize>> = found.into_iter().flatten().filter_map(first).collect();
    out.sort_unstable();
    out.dedup();
    out
}

/// The pairs of points that have a distance.
fn pairs(problem: &Problem) -> impl Iterator<Item = [usize; 2]> + '_ {
    problem.distances.iter().map(|d| d.points)
}

/// The senses, and each point with two (in space: three) joined to it by distances.
pub(super) fn followed(problem: &Problem) -> Vec<Vec<usize>> {
    let mut out: BTreeSet<Vec<usize>> = senses(problem).into_iter().collect();
    out.extend(simplices(
        problem.dimension,
        problem.points.len(),
        pairs(problem),
    ));
    out.into_iter().collect()
}
