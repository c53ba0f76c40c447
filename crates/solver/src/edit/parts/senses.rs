//! Which points tell by their orientation the senses that constraints leave open, tangents, angles and chirality.

use crate::interval::enclose;
use crate::order::each_once;
use crate::places::Each as _;
use crate::problem::{Item, Problem, Shape};
use crate::system::{orientation, simplices};

/// Points of which the orientation tells a sense that constraints leave open. In the plane: both legs of an angle, the ends
/// of a line and the centre of what touches it. In space, the chirality of points: each with three joined to it.
pub(in crate::edit) fn senses(problem: &Problem) -> Vec<Vec<usize>> {
    if problem.dimension == 3 {
        return chiralities(problem);
    }
    let mut out = Vec::new();
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
        let parts: Vec<Vec<usize>> = match constraint.kind.as_str() {
            "equal_angles" => angles(&constraint.items, points_of),
            "equal_distances" if points.len() != 6 => continue,
            "equal_distances" => points.chunks(3).map(<[usize]>::to_vec).collect(),
            _ => vec![points],
        };
        for points in parts {
            match points[..] {
                [a, b, c] => out.push([a, b, c]),
                // A point of one line with the other line.
                [a, b, c, d] => out.extend([[a, b, c], [a, b, d]]),
                _ => {}
            }
        }
    }
    let triples = out.into_iter().map(each_once);
    each_once(triples.filter(|points| points.len() == 3))
}

/// The points of each of two equal angles: the three of an angle at a point, or the ends of two lines. An angle with a
/// coordinate axis, which has no points, is none of these.
fn angles(items: &[Item], points_of: impl Fn(&Item) -> Vec<usize>) -> Vec<Vec<usize>> {
    let is_point = |item: &Item| matches!(item, Item::Point(_));
    if items.len() == 6 && items.iter().all(is_point) {
        let points: Vec<usize> = items.iter().flat_map(points_of).collect();
        return points.chunks(3).map(<[usize]>::to_vec).collect();
    }
    let (mut lines, mut rest) = (Vec::new(), items);
    while let Some((item, after)) = rest.split_first() {
        let mut line = points_of(item);
        rest = after;
        if let (true, Some((end, after))) = (is_point(item), after.split_first()) {
            line.extend(points_of(end));
            rest = after;
        }
        lines.push(line);
    }
    let halves = lines.chunks(2).map(<[Vec<usize>]>::concat);
    halves.filter(|points| points.len() == 4).collect()
}

/// One tetrahedron of each point that is joined to three others at least, the first that is not flat in the sketch.
fn chiralities(problem: &Problem) -> Vec<Vec<usize>> {
    let points = problem.points.iter();
    let sketch: Vec<_> = points.map(|p| p.sketch.each_ref().each(enclose)).collect();
    let mut found = vec![None; problem.points.len()];
    for pair in each_once(pairs(problem)) {
        for p in pair {
            found[p].get_or_insert_with(Vec::new).push(pair);
        }
    }
    let first = |pairs: Vec<[usize; 2]>| {
        let mut all = simplices(3, problem.points.len(), &pairs).into_iter();
        all.find(|set| orientation(&sketch, set) != 0)
    };
    each_once(found.into_iter().flatten().filter_map(first))
}

/// The pairs of points that have a distance.
fn pairs(problem: &Problem) -> impl Iterator<Item = [usize; 2]> + '_ {
    problem.distances.iter().map(|d| d.points)
}

/// The senses, and each point with two (in space: three) joined to it by distances.
pub(super) fn followed(problem: &Problem) -> Vec<Vec<usize>> {
    let mut out = senses(problem);
    let pairs: Vec<[usize; 2]> = pairs(problem).collect();
    out.extend(simplices(problem.dimension, problem.points.len(), &pairs));
    each_once(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_halves_of_equal_angles_are_not_mixed() {
        let file = |equal: &str| {
            format!(
                "name = \"fan\"\ndimension = 2\n\n[points]\na = [0, 0]\nb = [3, 0]\nc = [3, 2]\nd = [1, 3]\ne = [-1, 2]\nf = [4, 4]\n\n\
                 [constraints]\nfixed = [\"a\"]\nequal_angles = [{equal}]\n"
            )
        };
        let of = |equal: &str| senses(&Problem::parse_loosely(&file(equal), "fan.toml").unwrap());
        // Three lines and an axis: only the half without the axis has points to tell its sense by.
        let expected = vec![vec![2, 3, 4], vec![2, 3, 5]];
        assert_eq!(
            of("[\"a\", \"b\", \"x-axis\", \"c\", \"d\", \"e\", \"f\"]"),
            expected
        );
        assert_eq!(
            of("[\"a\", \"b\", \"c\", \"d\", \"e\", \"f\"]"),
            [[0, 1, 2], [3, 4, 5]]
        );
    }
}
