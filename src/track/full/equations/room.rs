//! What is computed of vectors of unknowns and of t, and the room for it.

use super::Equations;
use crate::linalg::Vector;
use crate::track::full::tail::Forms;
use std::ops::{Deref, DerefMut};

/// Differences of a vector of unknowns.
#[derive(Debug, Clone)]
pub struct Differences<const D: usize> {
    /// p_i − p_j, per axis and distance.
    pub axes: [Vector; D],
    /// The factors of the tail's products.
    pub forms: Forms,
}

impl<const D: usize> Deref for Differences<D> {
    type Target = [Vector; D];

    fn deref(&self) -> &[Vector; D] {
        &self.axes
    }
}

impl<const D: usize> DerefMut for Differences<D> {
    fn deref_mut(&mut self) -> &mut [Vector; D] {
        &mut self.axes
    }
}

/// Taylor coefficients of the right-hand sides E at some t.
#[derive(Debug, Clone)]
pub struct Lengths {
    /// E and E' of all equations.
    pub terms: [Vector; 2],
    /// All five coefficients of those of degree 4.
    pub bends: Vec<[f64; 5]>,
}

impl Lengths {
    /// Room for the right-hand sides of a problem.
    pub fn new<const D: usize>(equations: &Equations<D>) -> Self {
        Lengths {
            terms: [equations.per_edge(), equations.per_edge()],
            bends: vec![[0.0; 5]; equations.bends.len()],
        }
    }
}
