//! A figure up to motions, held in the frame of its sketch.

use crate::constraint::order_of_kind;
use crate::interval::vector::cross;
use crate::order::InOrder;
use crate::places::array;
use crate::problem::{Constraint, Decimal, Item, Problem};

/// The problem with its reference held, so that its equations can be cut into blocks as those of a problem in its own frame
/// are: the first point where the sketch has it, of the next one all coordinates but that in which they differ most, of the
/// third (in space) the one that leaves the plane of all three most. `None`: it is in its own frame already.
pub fn pinned(problem: &Problem) -> Option<Problem> {
    let reference = &problem.homotopy.reference;
    let &first = reference.first()?;
    let d = problem.dimension;
    let place = |p: usize| problem.points[p].place();
    let from_first = |p: usize| -> [f64; 3] {
        let (a, b) = (place(first), place(p));
        array(|k| b[k] - a[k])
    };
    let largest = |v: [f64; 3]| (0..d).max_by(|&i, &j| v[i].abs().total_cmp(&v[j].abs()));
    let mut out = problem.clone();
    let mut hold = |kind: &str, point: usize, value: Option<Decimal>| {
        out.constraints.push(Constraint {
            kind: kind.to_owned(),
            items: vec![Item::Point(point)],
            value,
            formula: None,
        });
    };
    hold("fixed", first, None);
    let mut hold_axis = |point: usize, axis: usize| {
        let at = problem.points[point].sketch[axis].clone();
        hold(["x", "y", "z"][axis], point, Some(at));
    };
    if let Some(&second) = reference.get(1) {
        let along = largest(from_first(second))?;
        (0..d)
            .filter(|&axis| axis != along)
            .for_each(|axis| hold_axis(second, axis));
        if let Some(&third) = reference.get(2) {
            let normal = cross(from_first(second), from_first(third));
            hold_axis(third, largest(normal)?);
        }
    }
    out.constraints.order_by_key(|c| order_of_kind(&c.kind));
    out.labels.clear();
    out.homotopy.reference.clear();
    Some(out)
}
