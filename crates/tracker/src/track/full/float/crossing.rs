//! Over flat figures at t = 1, at which the equations are dependent, by a step from t = 1 − ε to t = 1 + ε, as paper 001
//! has it in 7.1. Nothing is proved by it.
//!
//! The path's coordinates have a Taylor expansion through such a figure, though Newton's method has no way to it:
//! so the expansion before it predicts the point behind it, and the figure itself, which is then corrected with
//! heights divided by 1 − t ([`Heights`]).

use crate::linalg::Vector;
use crate::system::{Heights, Homotopy};
use crate::track::flat::Trials;
use crate::track::full::{Equations, InverseMaker, Local, ORDER, Preconditioner, first_normal};

/// When steps over t = 1 are tried.
const TRIALS: Trials = Trials {
    near: 0.05,
    nearest: 1e-6,
    nearer: 0.5,
    vanishing: 0.1,
};
/// A corrected point may be away from its prediction by this part of the step.
const OFF: f64 = 0.02;

/// What steps over flat figures need.
pub struct Crossing {
    heights: Heights,
    equations: Equations,
    inverter: InverseMaker,
    local: Local,
    /// How far from t = 1 the last trial was that failed on this approach.
    failed: Option<f64>,
}

/// What a step over t = 1 has found.
pub struct Crossed {
    /// The flat figure: all unknowns, and t = 1.
    pub flat: Vector,
    /// The parameter of the expansion before it that predicted the point behind it.
    pub advance: f64,
}

type Path<Y> = Local<{ ORDER + 1 }, Y>;

impl Crossing {
    /// For a problem in which flat figures can come in continua.
    pub fn new(homotopy: &Homotopy) -> Option<Self> {
        if homotopy.tail.is_empty() {
            return None;
        }
        let heights = homotopy.over_heights().ok()?;
        let equations = Equations::new(&heights.homotopy);
        Some(Crossing {
            inverter: equations.inverter(),
            local: Local::new(&equations),
            equations,
            heights,
            failed: None,
        })
    }

    /// If the path runs into a flat figure from `now`, finds that and the point behind it, `next`, with its
    /// expansion.
    pub fn cross<Y: Preconditioner>(
        &mut self,
        homotopy: &Homotopy,
        (equations, inverter): (&Equations, &mut Y::Maker),
        now: &Path<Y>,
        next: &mut Path<Y>,
        tolerance: f64,
    ) -> Option<Crossed> {
        if !TRIALS.is_due(homotopy, now, &mut self.failed) {
            return None;
        }
        let distance = (1.0 - now.z[0][equations.m]).abs();
        let crossed = self.step(equations, inverter, now, next, tolerance);
        if crossed.is_none() {
            self.failed = Some(distance);
        }
        crossed
    }

    fn step<Y: Preconditioner>(
        &mut self,
        equations: &Equations,
        inverter: &mut Y::Maker,
        now: &Path<Y>,
        next: &mut Path<Y>,
        tolerance: f64,
    ) -> Option<Crossed> {
        let m = equations.m;
        let left = 1.0 - now.z[0][m];
        let (mut figure, mut slope) = (equations.vector(), equations.vector());
        let middle = parameter_at(now, m, 1.0)?;
        now.at(middle, &mut figure);
        now.slope(middle, &mut slope);
        let per_t = 1.0 / slope[m];
        let guess = self.heights.at_flat(&figure, |i| slope[i] * per_t);
        let local = &mut self.local;
        local.z[0][..guess.len()].copy_from_slice(&guess);
        local.refine_at(&self.equations, &mut self.inverter, 1.0)?;
        let flat = self.heights.flat_figure(&local.z[0]);
        let size = distance(&figure[..m], &now.z[0][..m]);
        if distance(&flat, &figure[..m]) > OFF * size {
            return None;
        }

        let behind = parameter_at(now, m, 1.0 + left)?;
        now.at(behind, &mut next.z[0]);
        let predicted = next.z[0].clone();
        next.refine_at(equations, inverter, 1.0 + left)?;
        if distance(&next.z[0][..m], &predicted[..m]) > OFF * size {
            return None;
        }
        first_normal(equations, inverter, next, left < 0.0).ok()?;
        next.refine(equations, inverter, tolerance, 8).ok()?;
        next.expand(equations);
        figure[..m].copy_from_slice(&flat);
        figure[m] = 1.0;
        Some(Crossed {
            flat: figure,
            advance: behind,
        })
    }
}

/// The greatest difference of two entries.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    let pairs = a.iter().zip(b);
    pairs.fold(0.0, |max: f64, (x, y)| max.max((x - y).abs()))
}

/// Where an expansion has this t, if it goes straight there.
fn parameter_at<Y>(local: &Path<Y>, m: usize, t: f64) -> Option<f64> {
    let mut s = (t - local.z[0][m]) / local.z[1][m];
    for _ in 0..20 {
        let (mut value, mut slope) = (0.0, 0.0);
        for k in (0..=ORDER).rev() {
            slope = slope * s + value;
            value = value * s + local.z[k][m];
        }
        s -= (value - t) / slope;
    }
    (s.is_finite() && s > 0.0).then_some(s)
}
