//! Where the sketch is singular because points are on one line or in one plane, exactly.

use super::{Remark, joined, tetrahedra, triangles};
use crate::problem::Problem;
use num_rational::BigRational;
use num_traits::Zero;

type Vector = [BigRational; 3];

fn from(problem: &Problem, a: usize, b: usize) -> Vector {
    let [a, b] = [a, b].map(|p| &problem.points[p].sketch);
    std::array::from_fn(|k| b[k].value() - a[k].value())
}

fn cross(u: &Vector, v: &Vector) -> Vector {
    let minor = |i: usize, j: usize| &u[i] * &v[j] - &u[j] * &v[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn dot(u: &Vector, v: &Vector) -> BigRational {
    &u[0] * &v[0] + &u[1] * &v[1] + &u[2] * &v[2]
}

fn is_zero(v: &Vector) -> bool {
    v.iter().all(Zero::is_zero)
}

/// Whether some vectors span less than the whole plane or space.
fn are_flat(dimension: usize, vectors: &[Vector]) -> bool {
    let Some(first) = vectors.iter().find(|v| !is_zero(v)) else {
        return true;
    };
    let normals = vectors.iter().map(|v| cross(first, v));
    let mut normals = normals.filter(|n| !is_zero(n));
    match (dimension, normals.next()) {
        (_, None) => true,
        (2, Some(_)) => false,
        (_, Some(normal)) => vectors.iter().all(|v| dot(&normal, v).is_zero()),
    }
}

/// Points that are on one line or in one plane with all those that they are joined to; triangles (tetrahedra) of
/// joined points that are flat and not among these.
pub(super) fn in_sketch(problem: &Problem) -> Vec<Remark> {
    let d = problem.dimension;
    let mut all = Vec::new();
    let mut loose = vec![false; problem.points.len()];
    for (point, joined) in joined(problem).into_iter().enumerate() {
        let joined: Vec<usize> = joined.into_iter().map(|(p, _)| p).collect();
        // A triangle in space cannot but be in a plane; its points are no looser for that.
        if problem.points.len() <= d {
            break;
        }
        let sides: Vec<Vector> = joined.iter().map(|&p| from(problem, point, p)).collect();
        if are_flat(d, &sides) {
            loose[point] = true;
            all.push(Remark::Loose { point, joined });
        }
    }
    let sets: Vec<Vec<usize>> = match d {
        2 => triangles(problem)
            .into_iter()
            .map(|(points, _)| points.to_vec())
            .collect(),
        _ => tetrahedra(problem)
            .into_iter()
            .map(|points| points.to_vec())
            .collect(),
    };
    for points in sets {
        let sides: Vec<Vector> = points[1..]
            .iter()
            .map(|&p| from(problem, points[0], p))
            .collect();
        if are_flat(d, &sides) && !points.iter().any(|&p| loose[p]) {
            all.push(Remark::FlatInSketch(points));
        }
    }
    if d == 3 {
        for ([a, b, c], _) in triangles(problem) {
            let sides = [from(problem, a, b), from(problem, a, c)];
            if is_zero(&cross(&sides[0], &sides[1])) {
                all.push(Remark::FlatInSketch(vec![a, b, c]));
            }
        }
    }
    all
}
