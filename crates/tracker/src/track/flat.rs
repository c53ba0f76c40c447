//! When a path is taken to run into a flat figure at t = 1, at which the equations are dependent.

use crate::system::Homotopy;
use crate::track::full::{Local, Preconditioner};

/// Where it is tried to get over a flat figure.
#[derive(Debug, Clone, Copy)]
pub struct Trials {
    /// Where t is nearer to 1 than this,
    pub near: f64,
    /// and farther than this.
    pub nearest: f64,
    /// After a trial in vain the next is made at this part of the distance.
    pub nearer: f64,
    /// Where heights would be so small at t = 1, beside what they are, if they went on as they do.
    pub vanishing: f64,
}

impl Trials {
    /// Whether the path runs into a flat figure, and a trial is to be made at this point; in floats. `failed` tells how
    /// far from t = 1 the last one was that failed on this approach.
    pub fn is_due<const N: usize, Y: Preconditioner>(
        self,
        homotopy: &Homotopy,
        now: &Local<N, Y>,
        failed: &mut Option<f64>,
    ) -> bool {
        let t = homotopy.equations;
        let (left, slope) = (1.0 - now.z[0][t], now.z[1][t]);
        if left.abs() > self.near || left * slope <= 0.0 {
            *failed = None;
            return false;
        }
        if failed.is_some_and(|at| left.abs() > self.nearer * at) || left.abs() < self.nearest {
            return false;
        }
        let (mut largest, mut remaining) = (0.0f64, 0.0f64);
        for p in 0..homotopy.points {
            if let Some(i) = homotopy.coordinate(p, 2) {
                let (z, dz) = (now.z[0][i], now.z[1][i]);
                largest = largest.max(z.abs());
                remaining = remaining.max((z + dz * (left / slope)).abs());
            }
        }
        remaining <= self.vanishing * largest
    }
}
