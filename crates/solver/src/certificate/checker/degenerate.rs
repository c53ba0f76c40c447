//! Pieces of paths through degenerate (flat) figures at t = 1, in equations with heights divided by 1 − t: from the given equations
//! to the divided ones and back. What is claimed of them, and why that is enough, is in `docs/how/tubes.md`.

use super::equations::Equations;
use super::place::{Place, Spot};
use super::tube::Tube;
use crate::system::{Heights, Homotopy};

/// A problem's divided equations.
pub struct Divided {
    pub eq: Equations,
    heights: Heights,
}

impl Divided {
    /// `None`: the problem has none.
    pub fn new(given: &Homotopy) -> Option<Divided> {
        let heights = given.over_heights().ok()?;
        let eq = Equations::new(heights.homotopy.clone());
        Some(Divided { eq, heights })
    }

    /// Carries the point where the path leaves a tube, and its direction there, over to the divided equations, or back to the `given`
    /// ones. `None`: t may be 1 there, where a zero of the one system may be none of the other.
    ///
    /// For t ≠ 1 both ways lead from zeros to zeros and are each other's inverse, so that the image of the curve in this tube is
    /// a curve of zeros of the other system, and the image of its tangent is that one's.
    pub fn carry(&self, given: &Equations, tube: &mut Tube, back: bool) -> Option<()> {
        let (z, v) = (tube.exit.entries(), &tube.exit_direction);
        let t = z.last().filter(|t| !t.contains(1.0))?;
        // Not so for bounds that are not numbers.
        t.is_common_interval().then_some(())?;
        let (eq, point, direction) = match back {
            false => {
                let direction = self.heights.divide_along(&z, v)?;
                (&self.eq, self.heights.divide(&z)?, direction)
            }
            true => {
                let direction = self.heights.multiply_along(&z, v);
                (given, self.heights.multiply(&z), direction)
            }
        };
        // This holds if the divided equations are right; it finds some that are not.
        eq.homotopy.may_hold(&point).then_some(())?;
        (tube.exit, tube.exit_direction) = (Spot::around(&point), direction);
        Some(())
    }

    /// A solution of the divided equations, where t = 1, in the unknowns of the given ones: all heights are 0 there, exactly.
    pub fn flat_figure(&self, place: &Place) -> Place {
        place.carried(|z| self.heights.multiply(z))
    }
}
