//! Which distances a motion is followed by, where there are more than say something new, and how it stands to the others.

use super::bounds::{Bounds, measure};
use crate::blocks::{Account, Ruler, Verdict};
use crate::edit::Round;
use crate::interval::vector::{cross, dot};
use crate::interval::{Interval, hull};
use crate::linalg::{Span, nearest_zero};
use crate::places::array;
use crate::problem::{Decimal, Problem, Target, free_coordinates};
use crate::system::{Quantity, typical_length};
use crate::track::Control;
use nalgebra::{DMatrix, DVector};

/// In how many ways the points of a problem of distances alone can begin to move as they are drawn, as far as floats tell.
pub(super) fn freedom(problem: &Problem) -> usize {
    let (rank, _) = taken(problem, None, 0);
    free_coordinates(problem.dimension, problem.points.len()).saturating_sub(rank)
}

/// The distances that say nothing new beside others and one more, by index: those written last, or, with another `choice` than 0, those
/// before some other place. `None`: that one says nothing new itself.
pub(super) fn surplus(problem: &Problem, driver: [usize; 2], choice: usize) -> Option<Vec<usize>> {
    let (rank, surplus) = taken(problem, Some(driver), choice);
    (rank == free_coordinates(problem.dimension, problem.points.len())).then_some(surplus)
}

/// How many distances say something new, after a first one, and the indices of the others.
fn taken(problem: &Problem, first: Option<[usize; 2]>, choice: usize) -> (usize, Vec<usize>) {
    let (d, n) = (problem.dimension, problem.points.len());
    let at = |p: usize| problem.points[p].sketch.each_ref().map(Decimal::to_f64);
    let row = |[a, b]: [usize; 2]| {
        let mut row = vec![0.0; d * n];
        let (pa, pb) = (at(a), at(b));
        for axis in 0..d {
            row[d * a + axis] = pa[axis] - pb[axis];
            row[d * b + axis] = pb[axis] - pa[axis];
        }
        row
    };
    let mut span = Span::default();
    if let Some(first) = first {
        span.take([row(first)]);
    }
    let count = problem.distances.len();
    let order = (0..count).map(|k| (k + choice * count / super::CHOICES) % count.max(1));
    let mut surplus: Vec<usize> = order
        .filter(|&index| !span.take([row(problem.distances[index].points)]))
        .collect();
    surplus.sort_unstable();
    (span.rank(), surplus)
}

/// Whether a problem has nothing but points and distances between them.
pub(super) fn is_of_distances(problem: &Problem) -> bool {
    problem.constraints.is_empty() && problem.objects.is_empty()
}

/// A problem of distances alone with the figure for a sketch that is nearest to it and meets them, in floats, and how far a point was moved at
/// most. Any other problem, and one without such a figure, as it is.
pub(super) fn corrected(problem: &Problem) -> (Problem, f64) {
    let as_it_is = || (problem.clone(), 0.0);
    if !is_of_distances(problem) || problem.points.len() > MOST_POINTS {
        return as_it_is();
    }
    let d = problem.dimension;
    let sketch = problem.points.iter().flat_map(|p| &p.sketch[..d]);
    let sketch: Vec<f64> = sketch.map(Decimal::to_f64).collect();
    let unit = typical_length(problem);
    let held = held(&sketch, d);
    let linearise = |x: &[f64]| {
        let rows = problem.distances.len();
        let all = rows + held.len();
        let (mut jacobian, mut off) = (DMatrix::zeros(all, x.len()), DVector::zeros(all));
        for (form, row) in held.iter().zip(rows..) {
            for &(at, factor) in form {
                jacobian[(row, at)] = factor;
                off[row] += factor * (x[at] - sketch[at]);
            }
        }
        for (e, distance) in problem.distances.iter().enumerate() {
            let [a, b] = distance.points;
            let square = match &distance.target {
                Target::Length(length) => length.to_f64().powi(2),
                Target::SquaredLength(square) => square.to_f64(),
            };
            // Half the square over the unit: as long as the coordinates are.
            off[e] = -square / (2.0 * unit);
            for axis in 0..d {
                let difference = x[d * a + axis] - x[d * b + axis];
                off[e] += difference * difference / (2.0 * unit);
                jacobian[(e, d * a + axis)] = difference / unit;
                jacobian[(e, d * b + axis)] = -difference / unit;
            }
        }
        (jacobian, off)
    };
    let Some(near) = nearest_zero(sketch.clone(), SINGULAR, linearise) else {
        return as_it_is();
    };
    let mut out = problem.clone();
    let mut moved: f64 = 0.0;
    for (p, point) in out.points.iter_mut().enumerate() {
        let mut square = 0.0;
        for axis in 0..d {
            let at = d * p + axis;
            let Ok(decimal) = format!("{:e}", near[at]).parse() else {
                return as_it_is();
            };
            if near[at] != sketch[at] {
                point.sketch[axis] = decimal;
            }
            square += (near[at] - sketch[at]).powi(2);
        }
        moved = moved.max(square.sqrt());
    }
    (out, moved)
}

/// What keeps a figure from moving as a whole: its first point stays, the next one that is elsewhere stays on its ray from there, and in space the
/// next one off that line in their plane. Each as coordinates with factors whose sum does not change.
fn held(sketch: &[f64], d: usize) -> Vec<Vec<(usize, f64)>> {
    let from_first = |p: usize| -> [f64; 3] {
        array(|axis| {
            if axis < d {
                sketch[d * p + axis] - sketch[axis]
            } else {
                0.0
            }
        })
    };
    let across = |p: usize, normal: [f64; 3]| -> Vec<(usize, f64)> {
        let size = dot(normal, normal).sqrt();
        let factors = (0..d).map(|axis| (axis, normal[axis] / size));
        factors
            .flat_map(|(axis, factor)| [(d * p + axis, factor), (axis, -factor)])
            .collect()
    };
    let mut out: Vec<Vec<(usize, f64)>> = (0..d).map(|axis| vec![(axis, 1.0)]).collect();
    let count = sketch.len() / d;
    let Some(second) = (1..count).find(|&p| dot(from_first(p), from_first(p)) > 0.0) else {
        return out;
    };
    let ray = from_first(second);
    if d == 2 {
        out.push(across(second, [-ray[1], ray[0], 0.0]));
        return out;
    }
    // The axis that is farthest from the ray.
    let axis = (0..3).fold(0, |best, k| {
        if ray[k].abs() < ray[best].abs() {
            k
        } else {
            best
        }
    });
    let normal = cross(ray, array(|k| if k == axis { 1.0 } else { 0.0 }));
    out.push(across(second, normal));
    out.push(across(second, cross(ray, normal)));
    let off = |p: usize| cross(ray, from_first(p));
    let is_off = |p: &usize| {
        dot(off(*p), off(*p)) > 1e-12 * dot(ray, ray) * dot(from_first(*p), from_first(*p))
    };
    if let Some(third) = (1..count).find(is_off) {
        out.push(across(third, off(third)));
    }
    out
}

/// Larger figures are led to their dimensions along a path.
const MOST_POINTS: usize = 100;
/// Singular values of the Jacobian, each row about a direction, that count as zero.
const SINGULAR: f64 = 1e-6;

/// What is proved of the figures of a path: how they stand to the distances that were left out.
pub(super) fn account(
    problem: &Problem,
    left_out: &[usize],
    round: &Round,
    control: &Control,
) -> Account {
    let mut account = Account {
        equations: round.equations(),
        ..Account::default()
    };
    let unit = typical_length(problem);
    for &index in left_out {
        let distance = &problem.distances[index];
        let target = match &distance.target {
            Target::Length(length) => crate::interval::enclose(length),
            Target::SquaredLength(square) => crate::interval::enclose(square).sqrt(),
        };
        let owner = problem.objects.len() + problem.constraints.len() + 1 + index;
        let epsilon = Ruler::new(problem, owner, (unit, 2), None).epsilon;
        let quantity = Quantity::length(problem, distance.points);
        let verdict = match measure(round, quantity, control).bounds {
            Bounds::Between { least, most } => {
                verdict((least.value - target, most.value - target), epsilon)
            }
            _ => Verdict::Undecided {
                at_most: f64::INFINITY,
            },
        };
        account.leave_out(problem.distance_name(index), verdict);
    }
    account
}

/// Of a length that is off its target by so much at the least, and by so much at the most.
fn verdict((low, high): (Interval, Interval), epsilon: f64) -> Verdict {
    // A figure reaches into each.
    let worst = [low, high].map(|off| Verdict::of(off, epsilon));
    match worst {
        [Verdict::Missed { .. }, _] | [_, Verdict::Missed { .. }] => worst[0].and(worst[1]),
        _ => Verdict::of(hull(low.inf(), high.sup()), epsilon),
    }
}
