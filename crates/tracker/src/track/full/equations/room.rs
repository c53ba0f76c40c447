//! What is computed of vectors of unknowns and of t, and the room for it.

use super::Equations;
use crate::linalg::{LANE, Vector};
use crate::track::full::tail::Forms;
use std::ops::{Deref, DerefMut};

/// Differences of a vector of unknowns.
#[derive(Debug, Clone)]
pub struct Differences {
    /// p_i − p_j, per axis and distance.
    pub axes: Vec<Vector>,
    /// The factors of the tail's products.
    pub forms: Forms,
}

impl Differences {
    /// For the equations of one lane the products with other differences, added up over the axes.
    #[inline(always)]
    pub fn lane_of_products(&self, other: &Self, lane: usize) -> [f64; LANE] {
        let mut sum = [-0.0; LANE];
        for (x, y) in self.axes.iter().zip(&other.axes) {
            let (x, y) = (&x.lanes()[lane], &y.lanes()[lane]);
            for i in 0..LANE {
                sum[i] += x[i] * y[i];
            }
        }
        sum
    }
}

impl Deref for Differences {
    type Target = [Vector];

    fn deref(&self) -> &[Vector] {
        &self.axes
    }
}

impl DerefMut for Differences {
    fn deref_mut(&mut self) -> &mut [Vector] {
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
    pub fn new(equations: &Equations) -> Self {
        Lengths {
            terms: [equations.per_edge(), equations.per_edge()],
            bends: vec![[0.0; 5]; equations.bends.len()],
        }
    }
}
