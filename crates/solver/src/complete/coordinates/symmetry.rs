//! Changes of sign that keep the equations: mirror images in the axes of the gauge, and directions reversed.
//!
//! They are a group of sums modulo 2. In its reduced echelon form each generator has an unknown, its pivot, whose sign it
//! alone changes: for any zero the generators of those pivots that are negative lead to a zero at which none is. So all zeros are
//! found, up to such changes, where no pivot is negative.

use super::system::{Form, System};
use crate::blocks::Block;
use crate::certificate::cover::coordinates::{self, Half};
use crate::constraint::{Symmetry, symmetry};
use crate::interval::ZERO;
use crate::problem::Problem;
use crate::system::Homotopy;

/// A change of signs: of which unknowns, and by what.
#[derive(Clone)]
struct Change {
    unknowns: Vec<bool>,
    axes: Vec<bool>,
    twins: Vec<bool>,
}

impl Change {
    fn add(&mut self, other: &Change) {
        let pairs = [
            (&mut self.unknowns, &other.unknowns),
            (&mut self.axes, &other.axes),
            (&mut self.twins, &other.twins),
        ];
        for (own, other) in pairs {
            own.iter_mut().zip(other).for_each(|(x, y)| *x ^= y);
        }
    }
}

/// The unknowns that may be taken as not negative, each with the symmetry that changes it and none of the others: those of the first `blocks` that a
/// symmetry changes, so that what comes after them does not have to be searched for both signs.
pub fn halves(
    problem: &Problem,
    (homotopy, signs): (&Homotopy, &[(usize, bool)]),
    system: &System,
    blocks: &[Block],
) -> Vec<Half> {
    let m = system.unknowns;
    let d = homotopy.dimension;
    let first = homotopy.gauge.place.len();
    let twins = &homotopy.tail.twins;
    let reversed = |axes: &[usize]| Change {
        unknowns: (0..m)
            .map(|i| axes.iter().filter(|&&axis| homotopy.flips(i, axis)).count() % 2 == 1)
            .collect(),
        axes: (0..d).map(|axis| axes.contains(&axis)).collect(),
        twins: vec![false; twins.len()],
    };
    let mut generators: Vec<Change> = match symmetry(problem) {
        Symmetry::Identity => Vec::new(),
        Symmetry::Motions => (1..d).map(|axis| reversed(&[axis - 1, axis])).collect(),
        Symmetry::Isometries => (0..d).map(|axis| reversed(&[axis])).collect(),
    };
    for (k, twin) in twins.iter().enumerate() {
        let mut change = reversed(&[]);
        change.unknowns = (0..m).map(|i| i >= first && twin[i - first]).collect();
        change.twins[k] = true;
        generators.push(change);
    }
    let mut positive = homotopy.positive_unknowns();
    positive.extend(signs.iter().map(|(i, _)| i));
    generators.retain(|g| keeps(system, &g.unknowns) && positive.iter().all(|&i| !g.unknowns[i]));
    let mut pivots: Vec<usize> = Vec::new();
    let columns = blocks.iter().flat_map(|block| {
        let mut own = block.unknowns.clone();
        own.sort_unstable();
        own
    });
    for column in columns {
        let rank = pivots.len();
        let Some(k) = (rank..generators.len()).find(|&k| generators[k].unknowns[column]) else {
            continue;
        };
        generators.swap(rank, k);
        let pivot = generators[rank].clone();
        for (k, row) in generators.iter_mut().enumerate() {
            if k != rank && row.unknowns[column] {
                row.add(&pivot);
            }
        }
        pivots.push(column);
    }
    let places = |of: &[bool]| (0..of.len()).filter(|&k| of[k]).collect();
    pivots
        .into_iter()
        .zip(&generators)
        .map(|(unknown, change)| Half {
            unknown,
            by: coordinates::Change {
                axes: places(&change.axes),
                twins: places(&change.twins),
            },
        })
        .collect()
}

/// Whether the equations hold with these signs changed wherever they hold without: every equation stays as it is, or
/// changes its sign and has zero on the right.
fn keeps(system: &System, changes: &[bool]) -> bool {
    let zero = system.unknowns;
    // Both ends of a difference change together.
    let sign = |form: Form| match form {
        Form::One => Some(false),
        Form::Difference(a, b) if a == zero && b == zero => None,
        Form::Difference(a, b) if b == zero => Some(changes[a]),
        Form::Difference(a, b) if a == zero => Some(changes[b]),
        Form::Difference(a, b) => (changes[a] == changes[b]).then_some(changes[a]),
    };
    // Zero whatever the signs are.
    let vanishes = |form: Form| matches!(form, Form::Difference(a, b) if a == b);
    system.rows[..system.unknowns].iter().all(|row| {
        let products = row.products.iter();
        let mut products = products.filter(|p| !vanishes(p.left) && !vanishes(p.right));
        let Some(first) = products.next() else {
            return true;
        };
        let both = |p: &super::system::Product| Some(sign(p.left)? ^ sign(p.right)?);
        let Some(change) = both(first) else {
            return false;
        };
        products.all(|p| both(p) == Some(change)) && (!change || row.right == ZERO)
    })
}
