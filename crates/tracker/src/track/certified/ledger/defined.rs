//! Where figures are what they are named: lengths and radii positive, vectors not zero.

use super::Ledger;
use crate::track::certified::link::{Frame, Tube};
use crate::track::certified::reasons::Doubt;

impl Ledger {
    /// Proves that the auxiliary unknowns which are lengths or radii are positive on a stretch of a tube, and that no
    /// vector vanishes there that must not. Otherwise names the first for which that could not be proved.
    pub(super) fn is_defined<const N: usize, Y: Frame>(
        &self,
        tube: &Tube<N, Y>,
        (from, to): (f64, f64),
    ) -> Result<(), Doubt> {
        let fails = |&&entry: &&usize| {
            let ((low, _), _) = tube.entry_along(entry).bounds(from, to);
            // Bounds are of the unknown minus 1.
            (low + 1.0).next_down() <= 0.0 || low.is_nan()
        };
        if let Some(&unknown) = self.positive.iter().find(fails) {
            return Err(Doubt::Sign(unknown));
        }
        // Pieces of a stretch are cut in two no more often than that.
        const DEPTH: usize = 8;
        let zero = tube.weights.len() - 2;
        let mut vectors = self.nonzero.iter();
        match vectors.position(|vector| !is_nonzero(tube, vector, zero, (from, to), DEPTH)) {
            Some(vector) => Err(Doubt::Vanishes(vector)),
            None => Ok(()),
        }
    }
}

/// Proves that a vector, of which each coordinate is the difference of two unknowns (from `zero` on: of none), does not
/// vanish on a stretch of a tube: on each piece one coordinate has one sign.
fn is_nonzero<const N: usize, Y: Frame>(
    tube: &Tube<N, Y>,
    vector: &[[usize; 2]],
    zero: usize,
    (from, to): (f64, f64),
    depth: usize,
) -> bool {
    let bounds = |i: usize| match i < zero {
        // Of the unknown minus 1.
        true => tube.entry_along(i).bounds(from, to).0,
        false => (-1.0, -1.0),
    };
    let has_sign = |&[i, j]: &[usize; 2]| {
        let (a, b) = (bounds(i), bounds(j));
        a.0 > b.1 || a.1 < b.0
    };
    if vector.iter().any(has_sign) {
        return true;
    }
    let middle = 0.5 * (from + to);
    depth > 0
        && from < middle
        && middle < to
        && is_nonzero(tube, vector, zero, (from, middle), depth - 1)
        && is_nonzero(tube, vector, zero, (middle, to), depth - 1)
}
