//! Tubes tried before they are claimed, for who writes certificates: nobody has to trust it.

use super::arc::Edits;
use super::degenerate::Divided;
use super::equations::Equations;
use super::tube::Tube;
use crate::certificate::format::{ArcClaim, TubeClaim};
use crate::interval::hull;
use crate::problem::Problem;
use crate::system::Homotopy;
use std::fmt;

/// A tube is claimed if its test succeeds with such a margin.
const MARGIN: f64 = 0.05;

/// A problem's equations, given or divided.
pub struct Trial(Equations);

impl Trial {
    /// Of the problem's own equations, or of those of a motion and edits before it, or of those with heights divided by 1 − t. `None`: the
    /// problem has none.
    pub fn new(
        problem: &Problem,
        unit: f64,
        motion: &[ArcClaim],
        is_divided: bool,
    ) -> Option<Trial> {
        let mut homotopy = Homotopy::with_unit(problem, unit).ok()?;
        let mut edits = Edits::new(problem);
        for (k, claim) in motion.iter().enumerate() {
            homotopy = edits.equations(claim, k + 1, &homotopy).ok()?.homotopy;
        }
        if is_divided {
            return Divided::new(&homotopy).map(|divided| Trial(divided.eq));
        }
        Some(Trial(Equations::new(homotopy)))
    }

    /// Whether the checker proves a tube and, up to its exit, that lengths are positive and vectors not zero that must not be.
    pub fn proves(&self, claim: &TubeClaim) -> bool {
        let range = hull(-claim.h, claim.exit.max(-claim.h));
        let stands = |tube: &Tube| tube.stands(&self.0, range).is_ok();
        let has_margin = |tube: &Tube| tube.proof.margin > MARGIN;
        Tube::prove(&self.0, claim).is_ok_and(|tube| has_margin(&tube) && stands(&tube))
    }
}

impl fmt::Debug for Trial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Trial").finish_non_exhaustive()
    }
}
