//! What a certified run tells whoever writes its proof down.

use super::Status;
use super::arc::ArcRun;
use crate::problem::Target;

/// A tube that was proved and linked to the one before, as far as a checker has to be told.
///
/// Vectors have one entry per free coordinate and a last one for t, in the homotopy's unit.
#[derive(Debug, Clone, Copy)]
pub struct TubeSeen<'a> {
    /// The point z₀ near the path.
    pub centre: &'a [f64],
    /// What z₀ is more than that, where the tube was proved in extended precision.
    pub low: Option<&'a [f64]>,
    /// The normal c of the cross-sections.
    pub normal: &'a [f64],
    /// The weights u of the norm, at most 1.
    pub weights: &'a [f64],
    /// The tube reaches over |s| ≤ h.
    pub h: f64,
    /// In the box |w|_u ≤ r the path is the only zero of a cross-section.
    pub r: f64,
    /// The path leaves the tube at this s.
    pub exit: f64,
}

/// Sees a certified run's proof as it is found, in the order of the path.
pub trait Witness {
    /// The run begins; lengths are divided by `unit` from here on.
    fn begin(&mut self, unit: f64);
    /// A tube joined the chain.
    fn tube(&mut self, tube: TubeSeen);
    /// Whether a checker would prove such a tube. Tubes of the reduced space are told in parts for which this holds.
    fn is_provable(&mut self, _tube: &TubeSeen) -> bool {
        true
    }
    /// In the tube just seen the path meets t = 1 for the first time at this point: `centre` up to
    /// `radius`, per free coordinate.
    fn solution(&mut self, centre: &[f64], radius: &[f64]);
    /// What follows are tubes of the path in the equations with heights divided by 1 − t ([`crate::system::Heights`]), from where
    /// the last tube is left, and solutions in the unknowns of those.
    fn divide(&mut self) {}
    /// What follows are tubes in the problem's own equations again, from where the last tube is left. Unless the piece before is
    /// kept its tubes and solutions are forgotten.
    fn end_divide(&mut self, _kept: bool) {}
    /// What follows are the tubes the other way from the sketch.
    fn turn(&mut self) {}
    /// The way back is over. Unless it is kept its tubes and solutions are forgotten.
    fn end_turn(&mut self, _kept: bool) {}
    /// An edit: what follows are tubes of an arc from the figure at hand, along which these dimensions, distances first,
    /// are led to these values. An arc that was begun and did not end is given up.
    fn begin_arc(&mut self, _dimensions: &[(usize, &Target)]) {}
    /// The arc is over.
    fn end_arc(&mut self, _run: &ArcRun) {}
    /// A motion: what follows are the tubes of a run from the figure at hand, along which these dimensions are led as far as that goes.
    fn begin_motion(&mut self, _dimensions: &[(usize, &Target)]) {}
    /// The run is over; `classes` has the class of every solution seen.
    fn end(&mut self, status: &Status, classes: &[usize]);
}
