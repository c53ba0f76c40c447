//! The unknowns of the equations that paths follow, of complex solutions in another frame.

use super::boxes::{SolutionBox, SolutionSet};
use super::certify::numbers;
use super::lines;
use super::system::System;
use super::vector::{Z, cross, dot, minus, plus};
use crate::interval::DoubleDouble;
use crate::order::each_once;
use crate::places::Each as _;
use crate::problem::Problem;
use crate::system::Homotopy;

/// For each solution every unknown: the real and the imaginary part, perhaps followed by what these leave, in the problem's
/// unit. `None`: they have no place in the frame that paths have.
pub fn of(
    problem: &Problem,
    system: &System,
    solutions: &SolutionSet,
) -> Option<Vec<Vec<Vec<f64>>>> {
    let boxes = solutions.boxes().iter();
    if let Some(frame) = lines::frame_of(problem, system) {
        let homotopy = Homotopy::new(problem).ok()?;
        return boxes
            .map(|one| {
                let figure = lines::figure(system, frame, &one.middle());
                in_gauge(problem, &homotopy, system.unit, figure)
            })
            .collect();
    }
    let of_box = |one: &SolutionBox| {
        let number = numbers(one);
        let unknowns = system.unknowns.iter().enumerate();
        unknowns
            .map(|(k, unknown)| number(k, system.unit.powi(unknown.power)))
            .collect()
    };
    Some(boxes.map(of_box).collect())
}

/// A vector divided by its length.
fn unit(a: [Z; 3]) -> Option<[Z; 3]> {
    let square = dot(a, a);
    let over = square.sqrt().inverse();
    (square.norm_sqr() > 1e-20).then(|| a.each(|x| x * over))
}

/// A figure of points, and lines with a point and a direction of length 1, in a unit.
fn in_gauge(
    problem: &Problem,
    homotopy: &Homotopy,
    figure_unit: f64,
    (points, lines): lines::Figure,
) -> Option<Vec<Vec<f64>>> {
    let &[a, b, c] = problem.homotopy.reference.as_slice() else {
        return None;
    };
    // Both units are powers of two.
    let scale = DoubleDouble::from(figure_unit / homotopy.unit);
    let points: Vec<[Z; 3]> = points.iter().map(|p| p.each(|x| x.times(scale))).collect();
    let first = unit(minus(points[b], points[a]))?;
    let across = minus(points[c], points[a]);
    let second = unit(plus(&across, -dot(across, first), &first))?;
    let axes = [first, second, cross(first, second)];
    let turned = |v: [Z; 3]| axes.each(|axis| dot(axis, v));
    let m = homotopy.equations;
    let mut known: Vec<Option<Z>> = vec![None; m];
    for (p, &at) in points.iter().enumerate() {
        let at = turned(minus(at, points[a]));
        for (axis, x) in at.into_iter().enumerate() {
            if let Some(unknown) = homotopy.coordinate(p, axis) {
                known[unknown] = Some(x);
            }
        }
    }
    for (object, (base, along)) in lines.into_iter().enumerate() {
        let base = turned(minus(base.each(|x| x.times(scale)), points[a]));
        let along = turned(along);
        // The place nearest to the origin, and a direction as long as in the sketch.
        let base = plus(&base, -dot(base, along), &along);
        let length = lines::length(problem, object)?;
        let unknowns = homotopy.object_unknowns(object);
        for (unknown, x) in unknowns.zip(base.into_iter().chain(along.each(|x| x.times(length)))) {
            known[unknown] = Some(x);
        }
    }
    fill(homotopy, &mut known);
    let numbers = known.into_iter().enumerate().map(|(k, x)| {
        let x = x?;
        let unit = homotopy.unit.powi(homotopy.power(k));
        let parts = [x.re.hi, x.im.hi, x.re.lo, x.im.lo];
        Some(parts.each(|part| part * unit).to_vec())
    });
    numbers.collect()
}

/// Computes all unknowns that stand in an equation alone, and not squared, all others in it being known.
fn fill(homotopy: &Homotopy, known: &mut [Option<Z>]) {
    let m = known.len();
    loop {
        let mut is_new = false;
        for e in 0..m {
            let terms = homotopy.terms(e);
            let entries = terms.iter().flat_map(|term| term.entries()).flatten();
            let open = each_once(entries.filter(|&i| known[i].is_none()));
            let &[unknown] = open.as_slice() else {
                continue;
            };
            let right = homotopy.rights[e].double_at_target().0;
            // The left-hand side less the right-hand one, twice, where the unknown is 0, 1 and −1.
            let value = |x: f64| {
                let at = |entry: Option<usize>| match entry {
                    Some(i) if i == unknown => Z::real(x),
                    entry => entry.and_then(|i| known[i]).unwrap_or_default(),
                };
                let twice = Z::new(right * DoubleDouble::from(-2.0), 0.0.into());
                terms.iter().fold(twice, |sum, t| {
                    sum + t.value(at).times(DoubleDouble::from(f64::from(t.factor)))
                })
            };
            let (none, one, back) = (value(0.0), value(1.0), value(-1.0));
            let slope = one - none;
            let curvature = one + back - none.times(2.0.into());
            if slope.norm_sqr() > 1e-20 && curvature.norm_sqr() < 1e-24 * slope.norm_sqr() {
                known[unknown] = Some(-(none * slope.inverse()));
                is_new = true;
            }
        }
        if !is_new {
            return;
        }
    }
}
