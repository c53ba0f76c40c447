//! Solution boxes against exact solutions: Newton's method in 256 bits.

use super::precise::Figure;
use super::precise::big::{Big, dot};
use super::*;
use crate::track::{Control, Options, Outcome, Status, solve};

/// The solution near the middles of a figure's boxes, far beyond the precision of floats: all points, from the problem's own
/// decimals.
fn exact_solution(
    problem: &Problem,
    homotopy: &Homotopy,
    boxes: &[[Interval; 3]],
) -> Option<Vec<[Big; 3]>> {
    let (d, m, unit) = (
        homotopy.dimension,
        homotopy.equations,
        Big::of(homotopy.unit),
    );
    let middle = |&place: &usize| Big::of(boxes[place / d][place % d].mid()) / &unit;
    let mut through: Vec<Big> = homotopy.gauge.place.iter().map(middle).collect();
    through.push(Big::of(1.0));
    let mut normal = vec![0.0; m + 1];
    normal[m] = 1.0;
    let figure = Figure::at_target(problem, homotopy);
    let (z, _) = figure.point_near(&through, &normal)?;
    let place = |p: usize| homotopy.place(p, |i| &z[i] * &unit);
    Some((0..homotopy.points).map(place).collect())
}

/// Squared distances between all points.
fn shape(places: &[[Big; 3]]) -> Vec<Big> {
    let mut out = Vec::new();
    for (i, p) in places.iter().enumerate() {
        for q in &places[..i] {
            let difference = [0, 1, 2].map(|axis| &p[axis] - &q[axis]);
            out.push(dot(&difference, &difference));
        }
    }
    out
}

/// Checks all that is claimed of a closed run's solutions one by one.
pub fn check_solutions(problem: &Problem, outcome: &Outcome) {
    let homotopy = Homotopy::new(problem).unwrap();
    let slack = Big::of(1e-55);
    let found: Vec<Vec<[Big; 3]>> = outcome
        .solutions
        .iter()
        .map(|s| exact_solution(problem, &homotopy, &s.points).expect("a regular solution"))
        .collect();
    for (solution, x) in outcome.solutions.iter().zip(&found) {
        for (p, (point, place)) in solution.points.iter().zip(x).enumerate() {
            for (axis, (box_, value)) in point.iter().zip(place).enumerate() {
                assert!(
                    Big::of(box_.inf()) <= value + &slack && value - &slack <= Big::of(box_.sup()),
                    "{}: coordinate {axis} of point {p} is not in {box_:?}",
                    problem.name
                );
            }
        }
    }
    for (i, a) in outcome.solutions.iter().enumerate() {
        for (j, b) in outcome.solutions.iter().enumerate().take(i) {
            assert!(
                !boxes_meet(a, b),
                "{}: the boxes of solutions {i} and {j} meet",
                problem.name
            );
            let (a_shape, b_shape) = (shape(&found[i]), shape(&found[j]));
            let mut pairs = a_shape.iter().zip(&b_shape);
            let congruent = pairs.all(|(x, y)| (x - y).abs() < Big::of(1e-40));
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
