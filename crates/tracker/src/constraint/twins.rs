//! Changes of sign that leave a figure as it is.
//!
//! A line of its own is a point and a direction, and the same line with the direction reversed; a plane likewise. What
//! follows from such a direction (the projection of a point, a cross product) changes its sign too. All such changes
//! are the solutions of linear equations modulo 2, one bit for each auxiliary unknown: the coordinates of points
//! keep their signs, and so do lengths and radii, which are positive; both ends of a difference change together, and so do all products of an equation, with
//! which it stays as it is, or changes its sign and has zero on the right at t = 1. Products with an unknown that is zero
//! ([`super::zeros`]) are none.

use super::quadratic::{Entry, Form, Role, Tail};
use crate::elimination::Echelon;
use crate::equations::Ring;
use crate::residues::Residue;

/// A basis of the changes, per change the unknowns concerned. `vanishing`: for each equation whether its right-hand
/// side is zero at t = 1. `same_sign`: pairs of entries that have to change together, so that objects stay what they are.
/// `zeros`: the unknowns that are known to be zero at t = 1.
pub fn twins(
    tail: &Tail,
    vanishing: &[bool],
    same_sign: &[[Entry; 2]],
    zeros: &[bool],
) -> Vec<Vec<bool>> {
    let n = tail.unknowns.len();
    let is_zero = |e: Entry| match e {
        Entry::Unknown(u) => zeros[u],
        Entry::Zero => true,
        Entry::Coordinate { .. } => false,
    };
    // Zero whatever the signs of others are.
    let vanishes =
        |form: &Form| matches!(*form, Form::Difference(a, b) if is_zero(a) && is_zero(b));
    let mut rows: Vec<Vec<bool>> = Vec::new();
    let entry = |row: &mut Vec<bool>, e: &Entry| {
        if let Entry::Unknown(u) = *e {
            row[u] ^= true;
        }
    };
    for pair in same_sign {
        let mut together = vec![false; n];
        pair.iter().for_each(|e| entry(&mut together, e));
        rows.push(together);
    }
    for u in (0..n).filter(|&u| tail.unknowns[u].role == Role::Positive) {
        let mut stays = vec![false; n];
        stays[u] = true;
        rows.push(stays);
    }
    for u in (0..n).filter(|&u| zeros[u]) {
        // Its own sign is nothing, but for what it has to agree with.
        let mut alone = vec![false; n];
        alone[u] = !rows.iter().any(|row| row[u]);
        rows.push(alone);
    }
    for (equation, &vanishing) in tail.equations.iter().zip(vanishing) {
        let mut first: Option<Vec<bool>> = None;
        for product in &equation.products {
            if vanishes(&product.left) || vanishes(&product.right) {
                continue;
            }
            let mut parity = vec![false; n];
            for form in [&product.left, &product.right] {
                match form {
                    Form::One => {}
                    Form::Difference(a, e) | Form::Difference(e, a) if is_zero(*a) => {
                        entry(&mut parity, e);
                    }
                    Form::Difference(a, b) => {
                        entry(&mut parity, a);
                        let mut together = vec![false; n];
                        entry(&mut together, a);
                        entry(&mut together, b);
                        rows.push(together);
                    }
                }
            }
            match (&first, vanishing) {
                (None, true) => first = Some(parity),
                (Some(first), true) => {
                    rows.push(first.iter().zip(&parity).map(|(a, b)| a ^ b).collect());
                }
                (_, false) => rows.push(parity),
            }
        }
    }
    let mut echelon = Echelon::<Residue<2>>::new(n);
    for row in rows {
        let bits = row.into_iter().map(|bit| Residue::whole(bit.into()));
        echelon.take(&mut bits.collect::<Vec<_>>());
    }
    let changes = echelon.null_space();
    changes
        .map(|change| change.iter().map(|bit| *bit != Residue::whole(0)).collect())
        .collect()
}
