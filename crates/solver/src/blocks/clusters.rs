//! Figures of distances that fall apart at sides that their parts share.

use crate::places::Each as _;
use crate::problem::{Problem, Target};

/// Larger problems are not looked at by [`clusters`].
pub const MOST_POINTS: usize = 400;

/// The parts of a problem of distances alone that hang together only at a side (in the plane: two points with a
/// distance) or a triangle of sides (in space): problems of their own, two at least, or none where it does not fall apart.
///
/// Cut at such places, a problem that has as many distances as free coordinates, where they are needed, gives parts that
/// have so too: with n points, k parts and s shared distances (1 or 3) the sums are those of one. The shared
/// distances are exact numbers, so that figures of the parts, one of each, fit together, each as it is or mirrored; and
/// every figure of the whole is made of figures of the parts. A sign that the problem asks for of points of one part is
/// asked for of that part.
///
/// ```
/// use krawl::problem::Problem;
/// let rectangle = Problem::build("rectangle", 2)
///     .point("a", [0, 0]).point("b", [4, 0]).point("c", [4, 3]).point("d", [0, 3])
///     .distance("a", "b", 5).distance("b", "c", 3).distance("c", "d", 5).distance("d", "a", 3)
///     .squared_distance("a", "c", 34).finish().unwrap();
/// let parts = krawl::blocks::clusters(&rectangle);
/// assert_eq!(parts.len(), 2);
/// assert_eq!(parts[0].points.len(), 3);
/// ```
pub fn clusters(problem: &Problem) -> Vec<Problem> {
    let n = problem.points.len();
    if !problem.is_distances_only() || problem.is_absolute() || n > MOST_POINTS {
        return Vec::new();
    }
    let edges: Vec<[usize; 2]> = problem.distances.iter().map(|d| d.points).collect();
    let mut whole = vec![(0..n).collect::<Vec<usize>>()];
    let mut parts: Vec<Vec<usize>> = Vec::new();
    while let Some(points) = whole.pop() {
        match split(problem.dimension, &points, &edges) {
            Some(pieces) => whole.extend(pieces),
            None => parts.push(points),
        }
    }
    if parts.len() < 2 {
        return Vec::new();
    }
    parts.sort();
    let count = parts.len();
    let parts = parts.iter().enumerate();
    let problems = parts.map(|(k, points)| part(problem, points, k + 1, count));
    problems
        .collect::<Option<Vec<Problem>>>()
        .unwrap_or_default()
}

/// The pieces that some points fall into where a side or triangle is taken away, each with it.
fn split(dimension: usize, points: &[usize], edges: &[[usize; 2]]) -> Option<Vec<Vec<usize>>> {
    let inside = |e: &&[usize; 2]| e.iter().all(|p| points.contains(p));
    let edges: Vec<[usize; 2]> = edges.iter().filter(inside).copied().collect();
    let joined = |a: usize, b: usize| edges.contains(&[a, b]) || edges.contains(&[b, a]);
    let mut cuts: Vec<Vec<usize>> = Vec::new();
    for &[a, b] in &edges {
        if dimension == 2 {
            cuts.push(vec![a, b]);
        } else {
            let third = points
                .iter()
                .filter(|&&c| c > a.max(b) && joined(a, c) && joined(b, c));
            cuts.extend(third.map(|&c| vec![a, b, c]));
        }
    }
    cuts.iter().find_map(|cut| {
        let mut left: Vec<usize> = points
            .iter()
            .filter(|p| !cut.contains(p))
            .copied()
            .collect();
        let mut pieces = Vec::new();
        while let Some(first) = left.pop() {
            let (mut piece, mut next) = (vec![first], vec![first]);
            while let Some(p) = next.pop() {
                let (near, far) = left.iter().partition(|&&q| joined(p, q));
                left = far;
                next.extend::<&Vec<usize>>(&near);
                piece.extend::<Vec<usize>>(near);
            }
            piece.extend(cut);
            piece.sort_unstable();
            pieces.push(piece);
        }
        (pieces.len() > 1).then_some(pieces)
    })
}

/// The problem of some of the points.
fn part(problem: &Problem, points: &[usize], number: usize, of: usize) -> Option<Problem> {
    let name = |p: usize| problem.points[p].name.as_str();
    let names: Vec<&str> = points.iter().map(|&p| name(p)).collect();
    let names = match names.as_slice() {
        [first @ .., last] if names.len() <= 6 => format!("{} and {last}", first.join(", ")),
        _ => format!(
            "{} to {}, {} points",
            names[0],
            names[names.len() - 1],
            names.len()
        ),
    };
    let title = format!("{}, block {number} of {of} ({names})", problem.name);
    let mut builder = Problem::build(&title, problem.dimension).source(&problem.source);
    for &p in points {
        let coordinates = problem.points[p]
            .sketch
            .iter()
            .take(problem.dimension)
            .cloned();
        builder = builder.point(name(p), coordinates);
    }
    let is_inside = |pair: &[usize; 2]| pair.iter().all(|p| points.contains(p));
    for distance in problem.distances.iter().filter(|d| is_inside(&d.points)) {
        let [a, b] = distance.points.each(name);
        builder = match &distance.target {
            Target::Length(x) => builder.distance(a, b, x.clone()),
            Target::SquaredLength(x) => builder.squared_distance(a, b, x.clone()),
        };
    }
    if let Some(bend) = problem.bend()
        && is_inside(&problem.distances[bend].points)
    {
        builder = builder.bend(problem.distances[bend].points.each(name));
    }
    if problem
        .homotopy
        .reference
        .iter()
        .all(|p| points.contains(p))
    {
        builder = builder.reference(problem.homotopy.reference.iter().map(|&p| name(p)));
    }
    let oriented = problem.orientations.iter();
    for one in oriented.filter(|one| one.points.iter().all(|p| points.contains(p))) {
        builder = builder.orientation(one.points.iter().map(|&p| name(p)), one.is_positive);
    }
    let coefficient = problem.homotopy.bend_coefficient.clone();
    builder.bend_coefficient(coefficient).finish().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fall_apart_is_left_alone() {
        for name in ["octahedron", "k33", "disulfide"] {
            let problem = Problem::read(format!("../../problems/{name}.toml")).unwrap();
            assert!(clusters(&problem).is_empty(), "{name}");
        }
    }
}
