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

/// The shortest ways from a point to all others along all distances but one: how long each is, and the point before its last; `None` where there
/// is none.
fn ways(problem: &Problem, from: usize, without: usize) -> Vec<Option<(Interval, usize)>> {
    let n = problem.points.len();
    let mut ways = vec![None; n];
    ways[from] = Some((point(0.0), n));
    // Bellman and Ford's method.
    for _ in 0..n {
        let mut changed = false;
        let others = problem.distances.iter().enumerate();
        for (k, distance) in others.filter(|(k, _)| *k != without) {
            let [a, b] = distance.points;
            for (a, b) in [(a, b), (b, a)] {
                let Some((way, _)) = ways[a] else { continue };
                let sum: Interval = way + length(problem, k);
                if ways[b].is_none_or(|(other, _)| sum.sup() < other.sup()) {
                    ways[b] = Some((sum, a));
                    changed = true;
                }
            }
        }
        if !changed {
            break;
        }
    }
    ways
}

/// The points on a way, to the one at its end.
fn way_to(ways: &[Option<(Interval, usize)>], to: usize) -> Vec<usize> {
    let before = |&p: &usize| {
        ways[p]
            .map(|(_, before)| before)
            .filter(|&p| p < ways.len())
    };
    let points = std::iter::successors(Some(to), before).take(ways.len());
    let mut points: Vec<usize> = points.collect();
    points.reverse();
    points
}

/// What a distance can be in no figure, by the others alone.
#[derive(Debug, Clone, PartialEq)]
pub struct Reach {
    /// A bound on it.
    pub bound: Interval,
    /// The points on the way from its one end to the other from which that follows.
    pub way: Vec<usize>,
    /// Of a bound from below the distance on this way, by the number of its first point, that is longer than the others.
    pub longest: Option<usize>,
}

/// The least and the greatest that a distance can be by the others alone, whatever moves: no figure has less than what the longest of
/// a way leaves if all the others are laid against it, and none more than a way around.
pub(crate) fn reach(problem: &Problem, index: usize) -> [Option<Reach>; 2] {
    let [from, to] = problem.distances[index].points;
    let [there, back] = [from, to].map(|end| ways(problem, end, index));
    let others = problem.distances.iter().enumerate();
    let each = others.filter(|(k, _)| *k != index).flat_map(|(k, other)| {
        let [a, b] = other.points;
        [[a, b], [b, a]].map(|[a, b]| {
            let others = there[a]?.0 + back[b]?.0;
            Some((a, b, length(problem, k) - others))
        })
    });
    let longest = each.flatten().filter(|(.., left)| left.inf() > 0.0);
    let longest = longest.max_by(|x, y| x.2.inf().total_cmp(&y.2.inf()));
    let least = longest.map(|(a, b, bound)| {
        let mut way = way_to(&there, a);
        let longest = Some(way.len() - 1);
        way.extend(way_to(&back, b).into_iter().rev());
        Reach {
            bound,
            way,
            longest,
        }
    });
    [least, around(&there, to)]
}

/// The shortest way to a point: no figure has these two further apart.
fn around(ways: &[Option<(Interval, usize)>], to: usize) -> Option<Reach> {
    let (bound, _) = ways[to]?;
    Some(Reach {
        bound,
        way: way_to(ways, to),
        longest: None,
    })
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
            let [from, to] = problem.distances[distance].points;
            let Reach { bound, way, .. } = around(&ways(problem, from, distance), to)?;
            let is_too_long = length(problem, distance).inf() > bound.sup();
            is_too_long.then_some(Remark::TooLong {
                distance,
                way,
                length: bound.sup(),
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
