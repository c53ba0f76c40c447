//! What a certified run tells whoever writes its proof down.

use super::Status;

/// A tube that was proved and linked to the one before, as far as a checker has to be told.
///
/// Vectors have one entry per free coordinate and a last one for t, in the homotopy's unit.
#[derive(Debug, Clone, Copy)]
pub struct TubeSeen<'a> {
    /// The point z₀ near the path.
    pub centre: &'a [f64],
    /// Whether the tube was proved in extended precision: then z₀ has more digits than `centre`.
    pub extended: bool,
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
    /// In the tube just seen the path meets t = 1 for the first time at this point: `centre` up to
    /// `radius`, per free coordinate.
    fn solution(&mut self, centre: &[f64], radius: &[f64]);
    /// The run is over; `classes` has the class of every solution seen.
    fn end(&mut self, status: &Status, classes: &[usize]);
}
