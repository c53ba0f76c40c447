//! Which changes of sign leave what the equations say as it is.

use super::super::quadratic::{Entry, Form};
use super::Lowering;
use crate::problem::Shape;

impl Lowering<'_> {
    /// Unknowns of lines and planes of their own that must change their signs together, if the object is to be the
    /// same with them: the direction; the normal and the level; and by itself, as it must not change, the
    /// base (with `Entry::Zero`).
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
                _ => {}
            }
        }
        pairs
    }

    /// Whether what satisfies the equations at t = 1 still does with an axis reversed: every equation
    /// stays as it is, or changes its sign and has zero on the right.
    pub(super) fn is_symmetric(&self, axis: usize) -> bool {
        let entry = |e: &Entry| match *e {
            Entry::Coordinate { axis: k, .. } => k == axis,
            Entry::Unknown(u) => self.tail.unknowns[u].flips[axis],
            Entry::Zero => false,
        };
        let form = |f: &Form| match f {
            Form::One => false,
            Form::Difference(Entry::Zero, e) | Form::Difference(e, _) => entry(e),
        };
        let mut equations = self.tail.equations.iter().zip(&self.vanishing);
        equations.all(|(equation, vanishing)| {
            let mut changes = equation
                .products
                .iter()
                .map(|p| form(&p.left) ^ form(&p.right));
            let first = changes.next().unwrap_or(false);
            changes.all(|change| change == first) && (!first || *vanishing)
        })
    }
}
