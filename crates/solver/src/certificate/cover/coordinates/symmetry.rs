//! Changes of sign that take figures to congruent ones.

use super::format::{Change, Half};
use crate::constraint::Symmetry;
use crate::system::{Held, Homotopy};

/// The unknowns that may be taken as not negative: each is changed by a symmetry that changes none before it, so that
/// of the images of a figure under these symmetries one has none of them negative.
pub fn not_negative(
    homotopy: &Homotopy,
    (allowed, held): (Symmetry, &[Held]),
    halves: &[Half],
) -> Result<Vec<usize>, String> {
    let mut done: Vec<usize> = Vec::new();
    for half in halves {
        let fits = changes(homotopy, (allowed, held), &half.by).is_some_and(|changes| {
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
/// has, to keep the equations, and to keep lengths and radii positive, and all unknowns that are `held` what they are.
pub fn changes(
    homotopy: &Homotopy,
    (allowed, held): (Symmetry, &[Held]),
    by: &Change,
) -> Option<Vec<bool>> {
    let changes = signs_changed(homotopy, allowed, by)?;
    let positive = homotopy.positive_unknowns().into_iter();
    let mut signed = positive.chain(held.iter().map(|held| held.unknown));
    let stay = signed.all(|i| !changes[i]);
    (stay && homotopy.keeps(&changes)).then_some(changes)
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
