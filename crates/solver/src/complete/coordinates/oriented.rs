//! Signs that are asked for of figures, looked at in boxes of coordinates.

use super::system::System;
use crate::interval::Interval;
use crate::interval::vector::Vector;
use crate::places::Each as _;
use crate::system::{Homotopy, orientation};
use crate::track::{Signs, Stand};

/// Signs, and which entries the coordinates of points are.
#[derive(Debug, Clone)]
pub struct Oriented {
    signs: Signs,
    coordinates: Vec<[usize; 3]>,
}

impl Oriented {
    /// Those of a problem.
    pub fn new(signs: Signs, system: &System, homotopy: &Homotopy, points: usize) -> Self {
        let entry = system.coordinates(homotopy);
        let zero = system.unknowns;
        let coordinates = (0..points).map(|p| {
            [0, 1, 2].each(|axis| {
                if axis < homotopy.dimension {
                    entry(p, axis)
                } else {
                    zero
                }
            })
        });
        Oriented {
            coordinates: coordinates.collect(),
            signs,
        }
    }

    /// Those of them of which all coordinates are known.
    pub fn of(&self, is_known: impl Fn(usize) -> bool) -> Self {
        let mut of = self.clone();
        let mut entries = |p: &usize| self.coordinates[*p].into_iter().all(&is_known);
        of.signs
            .all
            .retain(|one| one.points.iter().all(&mut entries));
        of
    }

    /// Whether all figures in a box have a wrong sign.
    pub fn is_wrong(&self, x: &[Interval]) -> bool {
        let sign = |simplex: &[usize]| {
            let corners = simplex
                .iter()
                .map(|&p| self.coordinates[p].each(|entry| x[entry]));
            let corners: Vec<Vector> = corners.collect();
            orientation(&corners, &[0, 1, 2, 3][..corners.len()])
        };
        self.signs.stand(sign) == Stand::Wrong
    }
}
