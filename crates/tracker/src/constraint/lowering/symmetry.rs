//! Which changes of sign leave what the equations say as it is.

use super::super::quadratic::Entry;
use super::super::twins::twins;
use super::super::zeros::zeros;
use super::Lowering;
use crate::elimination::Echelon;
use crate::equations::{Ring, sign};
use crate::residues::Residue;
use crate::statement::Shape;

impl Lowering<'_> {
    /// The changes of sign that leave a figure as it is, see [`twins`].
    pub(super) fn twins(&self) -> Vec<Vec<bool>> {
        let same_sign = self.same_sign();
        let none = vec![false; self.tail.unknowns.len()];
        let plain = twins(&self.tail, &self.vanishing, &same_sign, &none);
        // A change for each line and plane of its own is as many as there are.
        let shown: Vec<usize> = self.directions().collect();
        if rank(&plain, &shown) == shown.len() {
            return plain;
        }
        // And those that are changes because some unknowns are zero: new ones if they change other unknowns than these.
        let zeros = zeros(&self.tail, &self.vanishing);
        let told: Vec<usize> = (0..zeros.len()).filter(|&u| !zeros[u]).collect();
        let mut all = plain;
        if zeros.contains(&true) {
            for change in twins(&self.tail, &self.vanishing, &same_sign, &zeros) {
                let before = rank(&all, &told);
                all.push(change);
                if rank(&all, &told) == before {
                    all.pop();
                }
            }
        }
        all
    }

    /// Of each line and plane of its own an unknown that changes its sign where the direction is reversed.
    fn directions(&self) -> impl Iterator<Item = usize> + '_ {
        self.objects.iter().filter_map(|(&object, entries)| {
            let shape = &self.problem.objects[object].shape;
            match shape.split_direction(entries, self.dimension())?[1] {
                [Entry::Unknown(u), ..] => Some(*u),
                _ => None,
            }
        })
    }

    /// Unknowns of lines and planes of their own that must change their signs together, if the object is to be the
    /// same with them: the direction; the normal and the level; and by itself, as it must not change, the
    /// base (with `Entry::Zero`). An unknown number does not change either.
    pub(super) fn same_sign(&self) -> Vec<[Entry; 2]> {
        let mut pairs = Vec::new();
        for (&object, entries) in &self.objects {
            match &self.problem.objects[object].shape {
                Shape::FreeLine { .. } => {
                    let (base, along) = entries.split_at(self.dimension());
                    pairs.extend(base.iter().map(|&e| [e, Entry::Zero]));
                    pairs.extend(along.iter().map(|&e| [e, along[0]]));
                }
                Shape::FreePlane { .. } => pairs.extend(entries.iter().map(|&e| [e, entries[0]])),
                // x and −x are two numbers, and a body is where its frame is.
                Shape::Number { .. } | Shape::Body { .. } => {
                    pairs.extend(entries.iter().map(|&e| [e, Entry::Zero]))
                }
                _ => {}
            }
        }
        pairs
    }

    /// Whether what satisfies the equations at t = 1 still does with an axis reversed: every equation
    /// stays as it is, or changes its sign and has zero on the right.
    pub(super) fn is_symmetric(&self, axis: usize) -> bool {
        let mut equations = self.tail.equations.iter().zip(&self.vanishing);
        equations.all(|(equation, vanishing)| {
            let sign = sign(&equation.products, |entry| entry.changes(&self.tail, axis));
            sign.is_some_and(|changes| !changes || *vanishing)
        })
    }
}

/// In how many ways the changes, and sums of them, change the signs of these unknowns: the rank modulo 2.
fn rank(changes: &[Vec<bool>], unknowns: &[usize]) -> usize {
    let mut echelon = Echelon::<Residue<2>>::new(unknowns.len());
    for change in changes {
        let bits = unknowns.iter().map(|&u| Residue::whole(change[u].into()));
        echelon.take(&mut bits.collect::<Vec<_>>());
    }
    echelon.rank
}
