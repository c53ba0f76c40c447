//! The first tube of a run, around the sketch.

use super::{CameTo, EXIT, Halt, POINT_TOLERANCE, Test, Tracker};
use crate::track::certified::reasons::{Rejection, no_direction};
use crate::track::full::{Local, first_normal};
use crate::track::{Options, Stop, StopKind};

impl<const N: usize, T: Test<N>> Tracker<'_, N, T> {
    /// Proves the tube around the sketch. Tells whether the path ends in it.
    pub(super) fn start(&mut self, options: &Options, max_h: f64) -> Result<bool, Halt> {
        let equations = &self.equations;
        let mut at_sketch = <Local>::new(equations);
        at_sketch.z[0].copy_from_slice(&self.sketch.centre);
        let reverse = options.reverse;
        if first_normal(equations, &mut self.inverter, &mut at_sketch, reverse).is_err() {
            let pivots = at_sketch.pivot_ratio_of_jacobian(equations);
            return Err(Halt {
                came_to: CameTo::Stuck { is_singular: true },
                ..Stop::new(StopKind::Sketch, no_direction(pivots)).into()
            });
        }
        self.first_normal.copy_from_slice(&at_sketch.normal);
        loop {
            match self.tube_at_sketch(max_h) {
                Ok(is_done) => {
                    self.has_set_out = true;
                    if let Some(way) = &self.way
                        && self.now.goes_along(self.now.entry, &self.first_normal)
                    {
                        way.sets_out(&self.first_normal);
                    }
                    self.account_for_precision();
                    return Ok(is_done);
                }
                Err((rejection, _)) if options.extended && self.extend(rejection) => {}
                Err((rejection, limit)) => {
                    return Err(self.stuck_at_sketch(rejection, limit).into());
                }
            }
        }
    }

    /// Proves the tube around the sketch, as short as it takes.
    /// Otherwise tells how long it could have been at last.
    pub(super) fn tube_at_sketch(&mut self, max_h: f64) -> Result<bool, (Rejection, f64)> {
        let equations = &self.equations;
        let local = &mut self.now.local;
        local.z[0].copy_from_slice(&self.sketch.centre);
        local.normal.copy_from_slice(&self.first_normal);
        self.test
            .refine(equations, local, POINT_TOLERANCE)
            .and_then(|()| self.test.expand(equations, local))
            .map_err(|e| (Rejection::Refine(e), max_h))?;
        self.test.prepare(equations, &mut self.now, max_h);
        let mut limit = max_h;
        loop {
            match self.first_tube(limit) {
                // Where t = 1 is hard to separate, shorter tubes do it.
                Err(Rejection::Undecided(_)) if self.now.proof.h > self.smallest_step() => {
                    self.shortened += 1;
                    limit = 0.25 * self.now.proof.h;
                }
                done => return done.map_err(|rejection| (rejection, limit)),
            }
        }
    }

    /// Proves the tube around the sketch, at most `limit` to either side, and that the sketch is in it.
    fn first_tube(&mut self, limit: f64) -> Result<bool, Rejection> {
        let equations = &self.equations;
        if !self.test.prove(equations, &mut self.now, limit) {
            return Err(Rejection::Unproved);
        }
        self.now.exit_at = EXIT * self.now.proof.h;
        self.test
            .enclose_exit(equations, &mut self.now)
            .ok_or(Rejection::Unproved)?;
        // Before the exit: what lies between is to be searched, and the loop to close behind it.
        self.now.entry = self
            .now
            .locate(&self.sketch)
            .filter(|entry| entry.1 < self.now.exit_at)
            .ok_or(Rejection::Unlinked)?;
        let is_done = self.enter(true)?;
        self.test.accept(&self.now);
        Ok(is_done)
    }
}
