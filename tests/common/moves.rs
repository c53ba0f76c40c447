//! The same problem written down differently, in exact arithmetic.

use super::exact::{decimal, squared_target};
use krawl::problem::{Decimal, Point, Problem, Target};
use krawl::rational::Rational;

pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// The sketch moved: turned by the angle of the 3-4-5 triangle about the z axis and, in space,
/// about the x axis, and shifted. Decimals stay decimals.
pub fn moved(problem: &Problem) -> Problem {
    let (cos, sin) = (ratio(3, 5), ratio(4, 5));
    let shift = [ratio(-7, 4), ratio(31, 10), ratio(9, 8)];
    map_sketch(problem, |[x, y, z]| {
        let (x, y) = (&cos * &x - &sin * &y, &sin * &x + &cos * &y);
        if problem.dimension == 2 {
            return [x + &shift[0], y + &shift[1], z];
        }
        let (y, z) = (&cos * &y - &sin * &z, &sin * &y + &cos * &z);
        [x + &shift[0], y + &shift[1], z + &shift[2]]
    })
}

/// The mirror image of the sketch.
pub fn mirrored(problem: &Problem) -> Problem {
    map_sketch(problem, |[x, y, z]| [-x, y, z])
}

fn map_sketch(problem: &Problem, map: impl Fn([Rational; 3]) -> [Rational; 3]) -> Problem {
    let mut other = problem.clone();
    for point in &mut other.points {
        let place = map(point.sketch.each_ref().map(|x| x.value().clone()));
        point.sketch = place.each_ref().map(decimal);
    }
    other
}

/// The same problem in another unit: all lengths multiplied, the bend's coefficient, which is a
/// length too, among them.
pub fn scaled(problem: &Problem, factor: &Rational) -> Problem {
    let times = |x: &Decimal| decimal(&(x.value() * factor));
    let mut other = problem.clone();
    for point in &mut other.points {
        point.sketch = point.sketch.each_ref().map(times);
    }
    for distance in &mut other.distances {
        distance.target = match &distance.target {
            Target::Length(length) => Target::Length(times(length)),
            Target::SquaredLength(squared) => {
                Target::SquaredLength(decimal(&(squared.value() * factor * factor)))
            }
        };
    }
    other.homotopy.bend_coefficient = times(&problem.homotopy.bend_coefficient);
    other
}

/// The points in another order and under other names, the distances in another order and turned
/// round. Returns the new place of each point, too.
pub fn relabelled(problem: &Problem) -> (Problem, Vec<usize>) {
    let shuffled = |count: usize| -> Vec<usize> {
        // A step that has no factor in common with the count visits every place once.
        let step = (2..).find(|&k| gcd(k, count) == 1).unwrap();
        (0..count).map(|k| (k * step + 1) % count).collect()
    };
    let mut other = problem.clone();
    let place = shuffled(problem.points.len());
    for (point, &at) in problem.points.iter().zip(&place) {
        other.points[at] = Point {
            name: format!("point {at}"),
            ..point.clone()
        };
    }
    let distance_place = shuffled(problem.distances.len());
    for (distance, &at) in problem.distances.iter().zip(&distance_place) {
        let [a, b] = distance.points;
        other.distances[at] = distance.clone();
        other.distances[at].points = [place[b], place[a]];
    }
    for point in &mut other.homotopy.reference {
        *point = place[*point];
    }
    other.homotopy.bend = distance_place[problem.homotopy.bend];
    (other, place)
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// All lengths given by their squares.
pub fn squared(problem: &Problem) -> Problem {
    let mut other = problem.clone();
    for distance in &mut other.distances {
        distance.target = Target::SquaredLength(decimal(&squared_target(&distance.target)));
    }
    other
}
