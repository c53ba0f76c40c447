//! A problem's equations with the heights over the reference plane divided by 1 − t, beside the given ones: see
//! [`crate::constraint::divide`].

use super::Homotopy;
use crate::constraint::{Origin, divide, odd_ones};
use crate::interval::{Interval, point};
use crate::problem::Problem;

/// The divided equations of a problem, and how points go from the given unknowns to theirs and back.
#[derive(Debug, Clone)]
pub struct Heights {
    /// The divided equations.
    pub homotopy: Homotopy,
    origins: Vec<Origin>,
    /// The number of free coordinates, which come first in both.
    places: usize,
    /// The number of given unknowns.
    given: usize,
}

impl Homotopy {
    /// The equations with heights divided by 1 − t, for paths through flat figures at t = 1. The error says why there
    /// are none.
    pub fn over_heights(&self) -> Result<Heights, String> {
        if self.dimension != 3 || self.gauge.reference.is_empty() {
            return Err(
                "flat figures are sought in the plane of three reference points only".to_owned(),
            );
        }
        let divided = divide(&self.tail, &self.heights())?;
        Ok(Heights {
            homotopy: self.with_other_tail(divided.tail),
            origins: divided.origins,
            places: self.gauge.place.len(),
            given: self.equations,
        })
    }
}

impl Homotopy {
    /// For every point its height over the reference plane in the sketch, as the tail counts lengths, where that is an
    /// unknown.
    fn heights(&self) -> Vec<Option<Interval>> {
        let height = |p: usize| {
            self.coordinate(p, 2)
                .map(|_| self.sketch_box[3 * p + 2] * point(self.unit))
        };
        (0..self.points).map(height).collect()
    }

    /// How many equations change their sign with the heights over the reference plane, and how many unknowns do, where
    /// all of these equations hold in every flat figure at every t, and the others stay as they are.
    pub fn odd_in_heights(&self) -> Option<[usize; 2]> {
        if self.dimension != 3 || self.gauge.reference.is_empty() {
            return None;
        }
        let (counts, hold) = odd_ones(&self.tail, &self.heights()).ok()?;
        hold.then_some(counts)
    }
}

impl Heights {
    /// A point (X, t) of the given path, with t ≠ 1, in the unknowns of the divided equations. `None`: t may be 1.
    pub fn divide(&self, z: &[Interval]) -> Option<Vec<Interval>> {
        let t = z[self.given];
        let s = point(1.0) - t;
        if s.contains(0.0) {
            return None;
        }
        let gauge = &self.homotopy.gauge;
        let auxiliary = |origin: &Origin| match *origin {
            Origin::Scale => s,
            Origin::Same(u) => z[self.places + u],
            Origin::Divided(u) => z[self.places + u] / s,
            Origin::Height(p) => z[gauge.variable[3 * p + 2]] / s,
        };
        let coordinates = z[..self.places].iter().copied();
        let others = self.origins.iter().map(auxiliary);
        Some(coordinates.chain(others).chain([t]).collect())
    }

    /// A point of the path of the divided equations in the given unknowns.
    pub fn multiply(&self, z: &[Interval]) -> Vec<Interval> {
        let (m, given) = (self.homotopy.equations, self.given);
        let mut out = vec![point(0.0); given + 1];
        out[..self.places].copy_from_slice(&z[..self.places]);
        out[given] = z[m];
        let s = point(1.0) - z[m];
        let is_one = z[m].inf() == 1.0 && z[m].sup() == 1.0;
        // Where an unknown is there as it is and divided, the first is the better one, but not where it is zero.
        for (k, origin) in self.origins.iter().enumerate() {
            if let Origin::Divided(u) = *origin {
                out[self.places + u] = s * z[self.places + k];
            }
        }
        for (k, origin) in self.origins.iter().enumerate() {
            match *origin {
                Origin::Same(u) if !(is_one && self.is_odd(u)) => {
                    out[self.places + u] = z[self.places + k];
                }
                Origin::Height(p) if is_one => {
                    out[self.homotopy.gauge.variable[3 * p + 2]] = point(0.0);
                }
                _ => {}
            }
        }
        out
    }

    /// How a direction of the given path, one entry per given unknown and t, looks in the unknowns of the divided equations: the
    /// derivative of [`Heights::divide`] at a point z, times v. `None`: t may be 1.
    pub fn divide_along(&self, z: &[Interval], v: &[Interval]) -> Option<Vec<Interval>> {
        let (s, dt) = (point(1.0) - z[self.given], v[self.given]);
        if s.contains(0.0) {
            return None;
        }
        // (x/s)' = (x' + (x/s) t')/s, as s' = −t'.
        let quotient = |i: usize| (v[i] + z[i] / s * dt) / s;
        let auxiliary = |origin: &Origin| match *origin {
            Origin::Scale => -dt,
            Origin::Same(u) => v[self.places + u],
            Origin::Divided(u) => quotient(self.places + u),
            Origin::Height(p) => quotient(self.homotopy.gauge.variable[3 * p + 2]),
        };
        let coordinates = v[..self.places].iter().copied();
        let others = self.origins.iter().map(auxiliary);
        Some(coordinates.chain(others).chain([dt]).collect())
    }

    /// How a direction of the path of the divided equations looks in the given unknowns: the derivative of
    /// [`Heights::multiply`] at a point z of that path, times v.
    pub fn multiply_along(&self, z: &[Interval], v: &[Interval]) -> Vec<Interval> {
        let (m, given) = (self.homotopy.equations, self.given);
        let (s, dt) = (point(1.0) - z[m], v[m]);
        let mut out = vec![point(0.0); given + 1];
        out[..self.places].copy_from_slice(&v[..self.places]);
        out[given] = dt;
        for (k, origin) in (self.places..).zip(&self.origins) {
            match *origin {
                Origin::Divided(u) => out[self.places + u] = s * v[k] - dt * z[k],
                // Before that one, where an unknown is there both ways: either will do.
                Origin::Same(u) => out[self.places + u] = v[k],
                Origin::Scale | Origin::Height(_) => {}
            }
        }
        out
    }

    /// The number of unknowns of a problem's divided equations, t not among them. `None`: there are none.
    pub fn size(problem: &Problem) -> Option<usize> {
        let heights = Homotopy::with_unit(problem, 1.0).ok()?.over_heights();
        heights.ok().map(|heights| heights.homotopy.equations)
    }

    /// Where the path passes a flat figure, about its unknowns from those given there (`x`) and their derivatives by t:
    /// floats.
    pub fn at_flat(&self, x: &[f64], per_t: impl Fn(usize) -> f64) -> Vec<f64> {
        let gauge = &self.homotopy.gauge;
        let auxiliary = |origin: &Origin| match *origin {
            Origin::Scale => 0.0,
            Origin::Same(u) => x[self.places + u],
            // u = (1 − t) u'.
            Origin::Divided(u) => -per_t(self.places + u),
            Origin::Height(p) => -per_t(gauge.variable[3 * p + 2]),
        };
        let coordinates = x[..self.places].iter().copied();
        coordinates
            .chain(self.origins.iter().map(auxiliary))
            .collect()
    }

    /// The given unknowns at a flat figure, in floats.
    pub fn flat_figure(&self, z: &[f64]) -> Vec<f64> {
        let m = self.homotopy.equations;
        let z: Vec<Interval> = z[..m].iter().map(|&x| point(x)).collect();
        let z = [&z[..], &[point(1.0)]].concat();
        let given = self.multiply(&z);
        given[..self.given].iter().map(|x| x.mid()).collect()
    }

    fn is_odd(&self, unknown: usize) -> bool {
        self.origins.contains(&Origin::Divided(unknown))
    }
}
