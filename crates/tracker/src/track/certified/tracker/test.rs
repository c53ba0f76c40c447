//! What a way of proving tubes has to offer the tracker.

use crate::system::Homotopy;
use crate::track::certified::link::{Frame, Tube};
use crate::track::certified::proof::Proof;
use crate::track::certified::shortfall::Shortfall;
use crate::track::full::{Equations, Local, RefineError};
use crate::track::{Driving, Options, Space};

/// A way of proving tubes: with polynomials of N coefficients, in frames of its own.
pub trait Test<const N: usize>: Sized + Send + std::fmt::Debug {
    /// The preconditioner of a tube, which also describes its box.
    type Frame: Frame + Send + std::fmt::Debug;
    /// The space in which it works.
    const SPACE: Space;
    /// Whether the last coefficient of the expansion tells how long the tube will be.
    const FORESEES: bool;

    /// Room for the tubes of a problem.
    fn new(homotopy: &Homotopy, equations: &Equations, options: &Options) -> Self;

    /// Brings a predicted point onto the path.
    fn refine(
        &mut self,
        equations: &Equations,
        local: &mut Local<N, Self::Frame>,
        tolerance: f64,
    ) -> Result<(), RefineError>;

    /// Expands the path there.
    fn expand(
        &mut self,
        equations: &Equations,
        local: &mut Local<N, Self::Frame>,
    ) -> Result<(), RefineError>;

    /// Before the first tube is proved: finds what later ones take over from those before.
    fn prepare(&mut self, equations: &Equations, tube: &mut Tube<N, Self::Frame>, max_h: f64);

    /// Proves the longest tube it can, at most `max_h` to either side, around a refined point: sets
    /// its proof and weights. False: nothing could be proved, however short.
    fn prove(&mut self, equations: &Equations, tube: &mut Tube<N, Self::Frame>, max_h: f64)
    -> bool;

    /// Why the last tube could not be proved: which condition fails for one as short as that is tried.
    /// `None`: none of them, but its exit could not be enclosed.
    fn shortfall(
        &mut self,
        equations: &Equations,
        tube: &mut Tube<N, Self::Frame>,
        max_h: f64,
    ) -> Option<Shortfall>;

    /// What was proved last is in the chain.
    fn accept(&mut self, tube: &Tube<N, Self::Frame>);

    /// What was tried last is given up.
    fn reject(&mut self);

    /// Encloses the path's point at `exit_at` of the tube that was proved last, as tightly as most
    /// links need.
    fn enclose_exit(
        &mut self,
        equations: &Equations,
        tube: &mut Tube<N, Self::Frame>,
    ) -> Option<()>;

    /// Encloses the path's point at `exit_at` of a tube proved earlier, and the path's tangent there, as tightly
    /// as floats allow.
    fn tighten_exit(
        &mut self,
        equations: &Equations,
        tube: &mut Tube<N, Self::Frame>,
    ) -> Option<()>;

    /// Switches extended precision on or off, for the tubes and exits to come. False: there is none.
    fn set_extended(&mut self, _on: bool) -> bool {
        false
    }

    /// What 53 bits would prove of the tube that was proved last in extended precision.
    fn in_53_bits(&self) -> Option<Proof> {
        None
    }

    /// Whether nothing but rounding, and F at the middle, kept the last tube from being proved.
    fn is_limited_by_rounding(&self) -> bool {
        false
    }

    /// Changes of plan, and the numbers of driving parameters.
    fn plans(&self) -> (usize, Driving);
}
