//! Points brought onto the path by Newton's method, in floats.

use super::equations::{Differences, Equations, Lengths};
use super::local::Local;
use super::newton::{End, UNTIL, Until};
use super::preconditioner::Preconditioner;
use crate::interval::rounding::largest;
use crate::linalg::Vector;

/// Why a predicted point could not be brought onto the path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RefineError {
    /// The Jacobian with the normal is singular in floating point.
    Singular,
    /// The corrections do not shrink as they should.
    Diverged,
}

/// With a preconditioner made at the prediction, corrections shrink to a quarter each, or the prediction was too
/// far away.
pub(super) const SHRINKS: f64 = 0.25;

impl<const N: usize, Y: Preconditioner> Local<N, Y> {
    /// Makes the preconditioner at `z[0]`.
    pub fn precondition(
        &mut self,
        equations: &Equations,
        maker: &mut Y::Maker,
    ) -> Result<(), RefineError> {
        self.look(equations);
        self.negative = self
            .y
            .make(maker, equations, (&self.d[0], &self.lengths, &self.normal))
            .map_err(|_| RefineError::Singular)?;
        Ok(())
    }

    /// Corrects `z[0]` onto the path with the preconditioner made at the prediction, moving in
    /// the cross-section normal to `normal` (both to be set by the caller).
    pub fn refine(
        &mut self,
        equations: &Equations,
        maker: &mut Y::Maker,
        tolerance: f64,
        max_iterations: usize,
    ) -> Result<(), RefineError> {
        if self.is_extended {
            self.is_extended = false;
            self.low.fill(0.0);
        }
        self.precondition(equations, maker)?;
        let until = Until {
            goal: tolerance,
            ratio: SHRINKS,
            steps: max_iterations,
            ..UNTIL
        };
        // Computed and made in one pass.
        let seen = until.correct(self, |local| local.correct(equations), |_, _| {});
        (self.first_correction, self.contraction) = (seen.first, seen.contraction);
        match seen.end {
            End::Reached => Ok(()),
            _ => Err(RefineError::Diverged),
        }
    }

    /// Corrects `z[0]` once with the preconditioner as it is. Tells the size of the correction.
    #[inline(always)]
    pub fn correct(&mut self, equations: &Equations) -> f64 {
        let (m, n) = (equations.m, equations.n());
        equations.residual(&self.d[0], &self.lengths, &mut self.f);
        self.y.solve(equations, &self.f[..m], &mut self.delta);
        let mut size = 0.0f64;
        for (z, delta) in self.z[0][..n].iter_mut().zip(self.delta.iter()) {
            *z -= delta;
            size = largest(size, delta.abs());
        }
        self.look(equations);
        size
    }

    /// Corrects `z[0]` in X at a fixed t, as far as floats go.
    pub fn refine_at(&mut self, equations: &Equations, maker: &mut Y::Maker, t: f64) -> Option<()> {
        let m = equations.m;
        self.normal.fill(0.0);
        self.normal[m] = 1.0;
        self.z[0][m] = t;
        self.refine(equations, maker, 1e-6, 20).ok()?;
        // Newton's method with the preconditioner of the refined point. It is done where corrections fall below
        // 1e-13; where they stop shrinking before, at the limit of precision, the first one tells how near it was.
        for _ in 0..3 {
            self.z[0][m] = t;
            match self.refine(equations, maker, 1e-13, 20) {
                Ok(()) => break,
                Err(_) if self.first_correction <= 1e-5 => {}
                Err(_) => return None,
            }
        }
        self.z[0][m] = t;
        self.look(equations);
        Some(())
    }

    /// The path's point with t = `target` near the parameter `s`, found along the path: corrections in the
    /// cross-section alternate with Newton steps in s. `None`: no convergence.
    pub fn crossing(
        &self,
        equations: &Equations,
        mut s: f64,
        target: f64,
        room: &mut CrossingRoom,
        z: &mut Vector,
    ) -> Option<()> {
        let m = equations.m;
        self.at(s, z);
        let until = Until {
            goal: 1e-10,
            ratio: f64::INFINITY,
            largest: 1.0,
            steps: 40,
            ..UNTIL
        };
        let find = |z: &mut Vector| {
            equations.differences(z, &mut room.d);
            equations.expand_lengths(z[m], &mut room.lengths);
            equations.residual(&room.d, &room.lengths, &mut room.f);
            self.y.solve(equations, &room.f[..m], &mut room.delta);
            self.slope(s, &mut room.slope);
            // The next point is z − δ + ds ẑ'(s), with the ds that brings its t to the target.
            let ds = (target - z[m] + room.delta[m]) / room.slope[m];
            let mut size = 0.0f64;
            for i in 0..=m {
                let change = ds * room.slope[i] - room.delta[i];
                z[i] += change;
                size = largest(size, change.abs());
            }
            s += ds;
            size
        };
        let seen = until.correct(z, find, |_, _| {});
        (seen.end == End::Reached).then_some(())
    }
}

/// Work space of [`Local::crossing`].
#[derive(Debug)]
pub struct CrossingRoom {
    d: Differences,
    lengths: Lengths,
    f: Vector,
    delta: Vector,
    slope: Vector,
}

impl CrossingRoom {
    /// For one problem.
    pub fn new(equations: &Equations) -> Self {
        CrossingRoom {
            d: equations.room(),
            lengths: Lengths::new(equations),
            f: equations.vector(),
            delta: equations.vector(),
            slope: equations.vector(),
        }
    }
}
