//! Figures whose whole path is known: triangles (in space, tetrahedra) built one on another.
//!
//! Each new point is joined to the corners of a simplex side that is there already, so that it has
//! two places, mirror images, which meet where its own simplex is flat. Whether that is so depends
//! on the simplex's own lengths alone, and these on t alone. So t runs between the nearest flat
//! simplices on either side of 0. If it is the same simplex at both ends, the path goes through
//! those values of t twice, otherwise four times. A sketch that is flat itself is one of the ends.

use super::Answer;
use super::polynomial::{Polynomial, Root, first_negative, first_positive, root_to, two_to};
use krawl::problem::Problem;
use krawl::problem::Target;
use krawl::rational::Rational;

/// Binary digits of lengths that are no rational numbers.
const DIGITS: i32 = 150;

fn whole(x: i64) -> Rational {
    Rational::from_integer(x.into())
}

/// a(t) of every distance.
pub fn lengths(problem: &Problem) -> Vec<Polynomial> {
    let of = |(index, distance): (usize, &krawl::problem::Distance)| {
        let [a, b] = distance.points.map(|p| &problem.points[p].sketch);
        let squared: Rational = (0..3)
            .map(|k| {
                let d = a[k].value() - b[k].value();
                &d * &d
            })
            .sum();
        let sketch = root_to(DIGITS, &squared);
        let target = match &distance.target {
            Target::Length(length) => length.value().clone(),
            Target::SquaredLength(square) => root_to(DIGITS, square.value()),
        };
        let c = if index == problem.homotopy.bend {
            problem.homotopy.bend_coefficient.value().clone()
        } else {
            Rational::zero()
        };
        let slope = target - &sketch + &c;
        Polynomial(vec![sketch, slope, -c]).plus(&Polynomial(vec![]))
    };
    problem.distances.iter().enumerate().map(of).collect()
}

/// The Gram determinant of the edges from the last of some points: zero where they are flat.
fn gram(problem: &Problem, squares: &[Polynomial], corners: &[usize]) -> Polynomial {
    let square = |a: usize, b: usize| {
        let joins = |d: &krawl::problem::Distance| d.points == [a, b] || d.points == [b, a];
        let index = problem.distances.iter().position(joins);
        squares[index.expect("the corners of a simplex are joined")].clone()
    };
    let (apex, others) = corners.split_last().expect("corners");
    let half = Rational::new(1.into(), 2.into());
    let entry = |i: usize, j: usize| {
        let (p, q) = (others[i], others[j]);
        if i == j {
            return square(p, *apex);
        }
        let sum = square(p, *apex).plus(&square(q, *apex));
        sum.minus(&square(p, q)).scaled(&half)
    };
    let product = |a: &Polynomial, b: &Polynomial, c: &Polynomial| a.times(b).times(c);
    match others.len() {
        2 => entry(0, 0)
            .times(&entry(1, 1))
            .minus(&entry(0, 1).times(&entry(0, 1))),
        _ => {
            let [a, b, c] = [entry(0, 0), entry(1, 1), entry(2, 2)];
            let [f, g, h] = [entry(1, 2), entry(0, 2), entry(0, 1)];
            product(&a, &b, &c)
                .plus(&product(&f, &g, &h).scaled(&whole(2)))
                .minus(&product(&a, &f, &f))
                .minus(&product(&b, &g, &g))
                .minus(&product(&c, &h, &h))
        }
    }
}

/// The simplices, from the order of the points: each point but the first few is joined to exactly
/// as many earlier ones as there are dimensions.
fn simplices(problem: &Problem) -> Vec<Vec<usize>> {
    (problem.dimension..problem.points.len())
        .map(|p| {
            let mut corners: Vec<usize> = (0..p).filter(|&q| problem.are_joined(p, q)).collect();
            assert_eq!(corners.len(), problem.dimension, "no tree: point {p}");
            corners.push(p);
            corners
        })
        .collect()
}

/// What must come out of the path of such a problem.
pub fn answer(problem: &Problem) -> Answer {
    let lengths = lengths(problem);
    let squares: Vec<Polynomial> = lengths.iter().map(|a| a.times(a)).collect();
    let volumes: Vec<Polynomial> = simplices(problem)
        .iter()
        .map(|corners| gram(problem, &squares, corners))
        .collect();
    // Lengths that are roots are known to 150 binary digits only.
    let tolerance = two_to(-100);
    let near = |a: &Rational, b: &Rational| (a - b).abs() < tolerance;
    let mut ends = [
        nearest(&volumes, first_negative, &tolerance),
        nearest(&volumes, first_positive, &tolerance),
    ];
    let flat: Vec<usize> = (0..volumes.len())
        .filter(|&k| volumes[k].value(&Rational::zero()).is_zero())
        .collect();
    match flat[..] {
        [] => {}
        // The path lies on the side where the simplex is one.
        [k] => {
            let slope = volumes[k].derivative().value(&Rational::zero());
            if slope.is_zero() {
                return Answer::NeverCloses;
            }
            ends[usize::from(slope.is_negative())] = End::At(k, Rational::zero());
        }
        _ => return Answer::NeverCloses,
    }
    let [End::At(i, below), End::At(j, above)] = &ends else {
        return Answer::NeverCloses;
    };
    let one = whole(1);
    if near(above, &one) || near(below, &one) {
        return Answer::NeverCloses;
    }
    if *above < one || *below > one {
        return Answer::Path {
            solutions: 0,
            classes: 0,
        };
    }
    let solutions = if i == j { 2 } else { 4 };
    // Mirror images are congruent: all simplices turned over.
    let mirrored = volumes.len() == 1 && solutions == 2 || volumes.len() == 2 && solutions == 4;
    Answer::Path {
        solutions,
        classes: if mirrored { solutions / 2 } else { solutions },
    }
}

enum End {
    At(usize, Rational),
    /// There is none, or the path is singular there.
    None,
}

fn nearest(
    volumes: &[Polynomial],
    first: fn(&Polynomial) -> Option<Root>,
    tolerance: &Rational,
) -> End {
    let roots: Vec<(usize, Root)> = volumes
        .iter()
        .enumerate()
        .filter_map(|(k, p)| first(p).map(|root| (k, root)))
        .collect();
    let Some((k, root)) = roots.iter().min_by_key(|(_, root)| root.at.abs()) else {
        return End::None;
    };
    let ties = roots
        .iter()
        .filter(|(_, other)| (&other.at - &root.at).abs() < *tolerance)
        .count();
    if ties > 1 || !root.simple {
        return End::None;
    }
    End::At(*k, root.at.clone())
}
