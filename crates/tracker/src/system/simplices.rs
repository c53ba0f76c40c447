//! Triangles in the plane and tetrahedra in space whose orientation tells figures of the same dimensions apart.

use crate::equations::Ring;
use crate::interval::Interval;
use crate::interval::vector::{cross, dot, minus};
use crate::order::each_once;
use crate::statement::neighbours;

/// Each point with as many of the points joined to it as there are dimensions, in order, each set once.
pub fn simplices(dimension: usize, points: usize, pairs: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let joined = neighbours(points, pairs.iter().copied());
    let mut all: Vec<Vec<usize>> = Vec::new();
    for (centre, joined) in joined.into_iter().enumerate() {
        let joined = each_once(joined.into_iter().map(|(point, _)| point));
        for (i, &a) in joined.iter().enumerate() {
            for (j, &b) in joined.iter().enumerate().skip(i + 1) {
                if dimension == 2 {
                    all.push(vec![centre, a, b]);
                } else {
                    let others = joined[j + 1..].iter();
                    all.extend(others.map(|&c| vec![centre, a, b, c]));
                }
            }
        }
    }
    // Points that are all joined turn up once for each of them.
    for points in &mut all {
        points.sort_unstable();
    }
    each_once(all)
}

/// The determinant of the differences of some points, three in the plane and four in space, from the first of them: twice a
/// signed area, six times a signed volume.
#[inline]
pub fn determinant<T: Ring + Copy>(points: usize, at: impl Fn(usize) -> [T; 3]) -> T {
    let side = |k: usize| minus(at(k), at(0));
    match points {
        3 => cross(side(1), side(2))[2],
        4 => dot(side(1), cross(side(2), side(3))),
        _ => T::whole(0),
    }
}

/// The sign of all numbers of a range; 0 where they have none.
pub fn sign_of(range: Interval) -> i8 {
    i8::from(range.inf() > 0.0) - i8::from(range.sup() < 0.0)
}

/// The sign of the [`determinant`] of some points. 0 where the boxes do not tell.
pub fn orientation(points: &[[Interval; 3]], simplex: &[usize]) -> i8 {
    sign_of(determinant(simplex.len(), |k| points[simplex[k]]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::point;

    #[test]
    fn each_set_of_joined_points_turns_up_once() {
        let triangle = [[0, 1], [1, 2], [2, 0]];
        assert_eq!(simplices(2, 3, &triangle), [vec![0, 1, 2]]);
        let path = [[2, 1], [1, 0], [3, 2]];
        assert_eq!(simplices(2, 4, &path), [vec![0, 1, 2], vec![1, 2, 3]]);
        let star = [[0, 1], [0, 2], [0, 3], [0, 4]];
        assert_eq!(simplices(3, 5, &star).len(), 4);
    }

    #[test]
    fn signs_are_those_of_areas_and_volumes() {
        let at = |x: f64, y: f64, z: f64| [point(x), point(y), point(z)];
        let points = [
            at(0.0, 0.0, 0.0),
            at(1.0, 0.0, 0.0),
            at(0.0, 1.0, 0.0),
            at(0.0, 0.0, 1.0),
        ];
        assert_eq!(orientation(&points, &[0, 1, 2]), 1);
        assert_eq!(orientation(&points, &[0, 2, 1]), -1);
        assert_eq!(orientation(&points, &[0, 1, 2, 3]), 1);
        assert_eq!(orientation(&points, &[0, 1, 3, 2]), -1);
        assert_eq!(orientation(&points, &[0, 1, 1]), 0);
    }
}
