//! Changes of sign that take figures to congruent ones.

use super::format::{Change, Half};
use crate::certificate::checker::equations::{Equations, ZERO};
use crate::constraint::Symmetry;
use crate::interval::point;
use crate::system::Homotopy;

/// The unknowns that may be taken as not negative: each is changed by a symmetry that changes none before it, so that
/// of the images of a figure under these symmetries one has none of them negative.
pub fn not_negative(
    eq: &Equations,
    (allowed, signs): (Symmetry, &[(usize, bool)]),
    halves: &[Half],
) -> Result<Vec<usize>, String> {
    let mut done: Vec<usize> = Vec::new();
    for half in halves {
        let fits = changes(eq, (allowed, signs), &half.by).is_some_and(|changes| {
            changes.get(half.unknown) == Some(&true) && done.iter().all(|&i| !changes[i])
        });
        if !fits {
            return Err(format!(
                "unknown {} is looked at where it is not negative, and no symmetry of the problem allows that",
                half.unknown
            ));
        }
        done.push(half.unknown);
    }
    Ok(done)
}

/// For each unknown whether a change of signs changes it; `None` where it is no symmetry: it has to be one that the problem
/// has, to keep the equations, and to keep lengths and radii positive and all `signs` that figures have.
pub fn changes(
    eq: &Equations,
    (allowed, signs): (Symmetry, &[(usize, bool)]),
    by: &Change,
) -> Option<Vec<bool>> {
    let changes = signs_changed(&eq.homotopy, allowed, by)?;
    let told = signs.iter().map(|(i, _)| i);
    let stay = eq.positive.iter().chain(told).all(|&i| !changes[i]);
    (stay && keeps(eq, &changes)).then_some(changes)
}

/// For each unknown whether a reversal of axes and directions changes its sign. `None`: the reversal takes figures to others that are not
/// congruent, or there is no such axis or direction.
pub fn signs_changed(homotopy: &Homotopy, allowed: Symmetry, by: &Change) -> Option<Vec<bool>> {
    let is_allowed = match allowed {
        _ if by.axes.iter().any(|&axis| axis >= homotopy.dimension) => false,
        Symmetry::Isometries => true,
        Symmetry::Motions => by.axes.len().is_multiple_of(2),
        Symmetry::Identity => by.axes.is_empty(),
    };
    let first = homotopy.gauge.place.len();
    let mut twins = Vec::new();
    for &k in &by.twins {
        twins.push(homotopy.tail.twins.get(k)?);
    }
    if !is_allowed {
        return None;
    }
    let change = |i: usize| {
        let of_axes = by.axes.iter().filter(|&&axis| homotopy.flips(i, axis));
        let of_twins = twins.iter().filter(|twin| i >= first && twin[i - first]);
        (of_axes.count() + of_twins.count()) % 2 == 1
    };
    Some((0..homotopy.equations).map(change).collect())
}

/// Whether the equations hold with these signs changed wherever they hold without: each stays as it is, or changes its sign
/// and has 0 on the right.
fn keeps(eq: &Equations, changes: &[bool]) -> bool {
    // Behind the unknowns and t stands the number 0, which has both signs, and behind that the number 1.
    let zero = eq.m + 1;
    let sign = |[i, j]: [usize; 2]| match (changes.get(i), changes.get(j)) {
        (Some(a), Some(b)) => (a == b).then_some(*a),
        (Some(a), None) => (j == zero).then_some(*a),
        (None, Some(a)) => (i == zero).then_some(*a),
        (None, None) => Some(false),
    };
    let is_nothing = |form: usize| {
        let [i, j] = eq.forms[form];
        i == j
    };
    (0..eq.m).all(|e| {
        let products = eq.products[e].iter();
        let mut all = products.filter(|(_, [l, r])| !is_nothing(*l) && !is_nothing(*r));
        let both = |&(_, [l, r]): &(i64, [usize; 2])| Some(sign(eq.forms[l])? ^ sign(eq.forms[r])?);
        let Some(first) = all.next() else {
            return true;
        };
        let vanishes = eq.right_at(e, point(1.0))[0] == ZERO;
        match both(first) {
            None => false,
            Some(change) => all.all(|p| both(p) == Some(change)) && (!change || vanishes),
        }
    })
}
