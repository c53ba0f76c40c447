//! In which precision tubes are proved, and what their proofs rested on.

use super::norms::Norms;
use crate::track::certified::proof::Proof;
use crate::track::certified::shortfall::Shortfall;

/// Whether extended precision is on, and what the last proof rested on.
#[derive(Debug, Clone, Default)]
pub(in crate::track) struct Precision {
    /// Whether points and F at them are taken in extended precision.
    pub extended: bool,
    /// The bounds of the last proof and u_t.
    pub last: Option<(Norms, f64)>,
    /// In extended precision, what they would be in 53 bits.
    pub plain: Option<Norms>,
}

impl Precision {
    /// A proof begins.
    pub fn forget(&mut self) {
        (self.last, self.plain) = (None, None);
    }

    /// What 53 bits would prove of the tube that was proved last in extended precision.
    pub fn in_53_bits(&self) -> Option<Proof> {
        let (_, weight_of_t) = self.last?;
        self.plain?.longest(weight_of_t)
    }

    /// Whether nothing but rounding, and F at the middle, kept the last tube from being proved.
    pub fn is_limited_by_rounding(&self) -> bool {
        self.last
            .is_some_and(|(norms, weight_of_t)| norms.is_limited_by_rounding(weight_of_t))
    }

    /// Which condition kept the last tube from being proved, however short.
    pub fn shortfall(&self) -> Option<Shortfall> {
        match self.last {
            Some((norms, weight_of_t)) if norms.is_in_range() => norms.shortfall(weight_of_t),
            _ => Some(Shortfall::Overflow),
        }
    }
}
