//! Targets that no figure meets, or only a singular one.

use super::{Remark, tetrahedra, triangles};
use crate::interval::{Interval, enclose_rational, point};
use crate::problem::{Problem, Target};
use crate::rational::Rational;

/// The exact square of a target length.
fn squared(problem: &Problem, distance: usize) -> Rational {
    problem.distances[distance].target.squared()
}

/// An enclosure of a target length.
fn length(problem: &Problem, distance: usize) -> Interval {
    problem.distances[distance].target.enclose()
}

/// The shortest way from one end of a distance to the other along the others, and a bound on its length, not
/// less than it is.
pub(crate) fn detour(problem: &Problem, index: usize) -> Option<(Vec<usize>, f64)> {
    let [from, to] = problem.distances[index].points;
    let n = problem.points.len();
    let mut way = vec![f64::INFINITY; n];
    let mut before = vec![usize::MAX; n];
    way[from] = 0.0;
    // Bellman and Ford's method.
    for _ in 0..n {
        let mut changed = false;
        for (k, distance) in problem.distances.iter().enumerate() {
            if k == index {
                continue;
            }
            let [a, b] = distance.points;
            for (a, b) in [(a, b), (b, a)] {
                if !way[a].is_finite() {
                    continue;
                }
                let sum = (point(way[a]) + length(problem, k)).sup();
                if sum < way[b] {
                    (way[b], before[b]) = (sum, a);
                    changed = true;
                }
            }
        }
        if !changed {
            break;
        }
    }
    if !way[to].is_finite() {
        return None;
    }
    let mut points = vec![to];
    while let Some(&last) = points.last()
        && last != from
        && points.len() <= n
    {
        points.push(before[last]);
    }
    points.reverse();
    Some((points, way[to]))
}

/// Distances that are longer than the shortest way around.
pub(super) fn too_long(problem: &Problem) -> Vec<Remark> {
    // The square of the number of distances, each time.
    const MOST: usize = 400;
    if problem.distances.len() > MOST {
        return Vec::new();
    }
    (0..problem.distances.len())
        .filter_map(|distance| {
            let (way, around) = detour(problem, distance)?;
            let is_too_long = length(problem, distance).inf() > around;
            is_too_long.then_some(Remark::TooLong {
                distance,
                way,
                length: around,
            })
        })
        .collect()
}

/// Triangles without area, tetrahedra without volume, and those that would have less than none.
pub(super) fn flat(problem: &Problem) -> Vec<Remark> {
    let mut all = Vec::new();
    for (points, sides) in triangles(problem) {
        let [a, b, c] = sides.map(|side| squared(problem, side));
        // Heron: 16 area² = 4 a² b² − (a² + b² − c²)².
        let four = Rational::from_integer(4.into());
        let area = four * &a * &b - (&a + &b - &c).pow(2);
        if area.is_zero() {
            // The longest side is opposite to the one in the middle.
            let [p, q, r] = points;
            all.push(Remark::LineInTarget(if a >= b && a >= c {
                [q, p, r]
            } else if b >= c {
                [p, q, r]
            } else {
                [p, r, q]
            }));
        }
    }
    if problem.dimension == 3 {
        for points in tetrahedra(problem) {
            let volume = gram(problem, points);
            if volume.is_negative() {
                all.push(Remark::NoTetrahedron(points));
            } else if volume.is_zero() {
                all.push(Remark::PlaneInTarget(points));
            }
        }
    }
    all
}

/// 36 volume² of the tetrahedron with the target lengths: the determinant of the products of its sides from the first
/// point.
fn gram(problem: &Problem, points: [usize; 4]) -> Rational {
    let between = |a: usize, b: usize| -> Rational {
        let (a, b) = (points[a], points[b]);
        let mut found = problem.distances.iter().enumerate();
        let found = found.find(|(_, d)| d.points == [a, b] || d.points == [b, a]);
        found.map_or(Rational::zero(), |(index, _)| squared(problem, index))
    };
    let half = Rational::new(1.into(), 2.into());
    let g = |i: usize, j: usize| -> Rational {
        let opposite = if i == j {
            Rational::zero()
        } else {
            between(i, j)
        };
        (between(0, i) + between(0, j) - opposite) * &half
    };
    let minor = |i: usize, j: usize| g(2, i) * g(3, j) - g(2, j) * g(3, i);
    g(1, 1) * minor(2, 3) + g(1, 2) * minor(3, 1) + g(1, 3) * minor(1, 2)
}

/// The target length in words, as the problem has it.
pub(super) fn length_in_words(problem: &Problem, distance: usize) -> String {
    match &problem.distances[distance].target {
        Target::Length(length) => length.text().to_owned(),
        Target::SquaredLength(squared) => {
            format!("{:.6}", enclose_rational(squared.value()).sqrt().mid())
        }
    }
}
