//! Changes of sign that keep the equations: mirror images in the axes of the gauge, and directions reversed.
//!
//! They are a group of sums modulo 2. In its reduced echelon form each generator has an unknown, its pivot, whose sign it
//! alone changes: for any zero the generators of those pivots that are negative lead to a zero at which none is. So all zeros are
//! found, up to such changes, where no pivot is negative.

use crate::blocks::Block;
use crate::certificate::cover::coordinates::{Change, Half, changes};
use crate::constraint::{Symmetry, symmetry};
use crate::problem::Problem;
use crate::system::{Held, Homotopy};

/// The unknowns that may be taken as not negative, each with the symmetry that changes it and none of the others: those of the first `blocks` that a
/// symmetry changes, so that what comes after them does not have to be searched for both signs.
pub fn halves(
    problem: &Problem,
    (homotopy, held): (&Homotopy, &[Held]),
    blocks: &[Block],
) -> Vec<Half> {
    let allowed = symmetry(problem);
    let (d, twins) = (homotopy.dimension, homotopy.tail.twins.len());
    let of = |axes: Vec<usize>, twins: Vec<usize>| {
        let by = Change { axes, twins };
        Some((changes(homotopy, (allowed, held), &by)?, by))
    };
    let of_axes = reversals(allowed, d)
        .into_iter()
        .filter_map(|axes| of(axes, Vec::new()));
    let of_twins = (0..twins).filter_map(|k| of(Vec::new(), vec![k]));
    let mut generators: Vec<(Vec<bool>, Change)> = of_axes.chain(of_twins).collect();
    let mut pivots: Vec<usize> = Vec::new();
    let columns = blocks.iter().flat_map(|block| {
        let mut own = block.unknowns.clone();
        own.sort_unstable();
        own
    });
    for column in columns {
        let rank = pivots.len();
        let Some(k) = (rank..generators.len()).find(|&k| generators[k].0[column]) else {
            continue;
        };
        generators.swap(rank, k);
        let (pivot, by) = generators[rank].clone();
        for (k, (unknowns, change)) in generators.iter_mut().enumerate() {
            if k != rank && unknowns[column] {
                unknowns.iter_mut().zip(&pivot).for_each(|(x, y)| *x ^= y);
                add(&mut change.axes, &by.axes);
                add(&mut change.twins, &by.twins);
            }
        }
        pivots.push(column);
    }
    let halves = pivots.into_iter().zip(generators);
    halves
        .map(|(unknown, (_, by))| Half { unknown, by })
        .collect()
}

/// Which axes are reversed, one list after the other, in what figures are counted up to.
fn reversals(allowed: Symmetry, dimension: usize) -> Vec<Vec<usize>> {
    match allowed {
        Symmetry::Identity => Vec::new(),
        Symmetry::Motions => (1..dimension).map(|axis| vec![axis - 1, axis]).collect(),
        Symmetry::Isometries => (0..dimension).map(|axis| vec![axis]).collect(),
    }
}

/// Whether each of these reversals keeps the equations and what is held.
pub fn keeps_axes(problem: &Problem, homotopy: &Homotopy, held: &[Held]) -> bool {
    let allowed = symmetry(problem);
    let mut all = reversals(allowed, homotopy.dimension).into_iter();
    all.all(|axes| {
        let twins = Vec::new();
        changes(homotopy, (allowed, held), &Change { axes, twins }).is_some()
    })
}

/// Adds places to others modulo 2: what both have is in neither.
fn add(own: &mut Vec<usize>, other: &[usize]) {
    for &place in other {
        match own.binary_search(&place) {
            Ok(at) => drop(own.remove(at)),
            Err(at) => own.insert(at, place),
        }
    }
}
