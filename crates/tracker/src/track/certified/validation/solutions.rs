//! Solution boxes against exact solutions: Newton's method in rationals.

use super::*;
use crate::problem::Target;
use crate::rational::Rational;
use crate::track::{Control, Options, Outcome, Status, solve};
use num_bigint::BigInt;

fn exact(x: f64) -> Rational {
    Rational::from_float(x).expect("a finite float")
}

/// Rounded to a multiple of 2⁻³⁰⁰.
fn trimmed(x: Rational) -> Rational {
    let scale: BigInt = BigInt::from(1) << 300;
    (x * Rational::from(scale.clone())).round() / Rational::from(scale)
}

/// The solution near the middles of a figure's boxes, far beyond the precision of floats.
///
/// Its equations are |p_i − p_j|² = (target length)², from the problem's own decimals.
pub fn exact_solution(
    problem: &Problem,
    homotopy: &Homotopy,
    boxes: &[[Interval; 3]],
) -> Option<Vec<Rational>> {
    let (d, m) = (homotopy.dimension, homotopy.equations);
    let variable = |p: usize, axis: usize| homotopy.gauge.variable[p * d + axis];
    let place = |v: usize| (homotopy.gauge.place[v] / d, homotopy.gauge.place[v] % d);
    let mut x: Vec<Rational> = (0..m)
        .map(|v| exact(boxes[place(v).0][place(v).1].mid()))
        .collect();
    let get = |x: &[Rational], p: usize, axis: usize| match variable(p, axis) {
        v if v < m => x[v].clone(),
        _ => Rational::zero(),
    };
    let mut jacobian = DMatrix::zeros(m, m);
    for (e, distance) in problem.distances.iter().enumerate() {
        let [i, j] = distance.points;
        for axis in 0..d {
            let difference = 2.0 * (get(&x, i, axis) - get(&x, j, axis)).to_f64();
            for (p, sign) in [(i, 1.0), (j, -1.0)] {
                if variable(p, axis) < m {
                    jacobian[(e, variable(p, axis))] += sign * difference;
                }
            }
        }
    }
    let inverse = jacobian.try_inverse()?;
    let inverse: Vec<Vec<Rational>> = (0..m)
        .map(|i| (0..m).map(|j| exact(inverse[(i, j)])).collect())
        .collect();
    let mut last = Rational::from_integer(1.into());
    for _ in 0..100 {
        let residual: Vec<Rational> = problem
            .distances
            .iter()
            .map(|distance| {
                let [i, j] = distance.points;
                let target = match &distance.target {
                    Target::Length(length) => length.value() * length.value(),
                    Target::SquaredLength(square) => square.value().clone(),
                };
                (0..d).fold(-target, |sum, axis| {
                    let difference = get(&x, i, axis) - get(&x, j, axis);
                    sum + &difference * &difference
                })
            })
            .collect();
        last = Rational::zero();
        for i in 0..m {
            let step = trimmed((0..m).fold(Rational::zero(), |sum, j| {
                sum + &inverse[i][j] * &residual[j]
            }));
            last = last.max(step.abs());
            x[i] = &x[i] - step;
        }
        if last < exact(1e-60) {
            return Some(x);
        }
    }
    (last < exact(1e-60)).then_some(x)
}

/// Squared distances between all points, in rationals.
fn shape(homotopy: &Homotopy, x: &[Rational]) -> Vec<Rational> {
    let places = (0..homotopy.points).map(|p| homotopy.place(p, |i| x[i].clone()));
    let places: Vec<[Rational; 3]> = places.collect();
    let mut out = Vec::new();
    for i in 0..homotopy.points {
        for j in 0..i {
            out.push((0..3).fold(Rational::zero(), |sum, axis| {
                let difference = &places[i][axis] - &places[j][axis];
                sum + &difference * &difference
            }));
        }
    }
    out
}

/// Checks all that is claimed of a closed run's solutions one by one.
pub fn check_solutions(problem: &Problem, outcome: &Outcome) {
    let homotopy = Homotopy::new(problem).unwrap();
    let slack = exact(1e-55);
    let found: Vec<Vec<Rational>> = outcome
        .solutions
        .iter()
        .map(|s| exact_solution(problem, &homotopy, &s.points).expect("a regular solution"))
        .collect();
    for (solution, x) in outcome.solutions.iter().zip(&found) {
        for (p, point) in solution.points.iter().enumerate() {
            let place = homotopy.place(p, |i| x[i].clone());
            for (axis, (box_, value)) in point.iter().zip(&place).enumerate() {
                assert!(
                    exact(box_.inf()) <= value + &slack && value - &slack <= exact(box_.sup()),
                    "{}: coordinate {axis} of point {p} is not in {box_:?}",
                    problem.name
                );
            }
        }
    }
    for (i, a) in outcome.solutions.iter().enumerate() {
        for (j, b) in outcome.solutions.iter().enumerate().take(i) {
            let apart = a
                .points
                .iter()
                .flatten()
                .zip(b.points.iter().flatten())
                .any(|(a, b)| a.disjoint(*b));
            assert!(
                apart,
                "{}: the boxes of solutions {i} and {j} meet",
                problem.name
            );
            let close = |(x, y): (&Rational, &Rational)| (x - y).abs() < exact(1e-40);
            let congruent = shape(&homotopy, &found[i])
                .iter()
                .zip(&shape(&homotopy, &found[j]))
                .all(close);
            assert_eq!(
                a.class == b.class,
                congruent,
                "{}: classes of solutions {i} and {j}",
                problem.name
            );
        }
    }
}

#[test]
fn boxes_hold_the_exact_solutions() {
    let mut random = Random::new(4);
    let mut problems = shipped();
    for round in 0..effort(60) {
        let dimension = 2 + round % 2;
        let points = dimension + 2 + random.below(4);
        let change = [0.02, 0.1][random.below(2)];
        problems.push(random_problem(&mut random, dimension, points, change));
    }
    let (mut closed, mut boxes) = (0, 0);
    for problem in &problems {
        let options = Options {
            max_steps: 5000,
            ..Options::certified()
        };
        let outcome = solve(problem, &options, &mut Control::default()).unwrap();
        if outcome.status == Status::Closed {
            check_solutions(problem, &outcome);
            closed += 1;
            boxes += outcome.solutions.len();
        }
    }
    println!("{closed} closed, {boxes} boxes");
    assert!(
        closed > 30 && boxes > 60,
        "too few cases: {closed} closed, {boxes} boxes"
    );
}
