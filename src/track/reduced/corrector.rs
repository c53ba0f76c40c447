//! Newton's method on the removed constraints, and tangents.

use super::elimination::Elimination;
use super::lane;
use crate::plan::{Evaluation, Lanes};

/// Work space: parameters, corrections, factorizations.
pub(super) struct Corrector {
    /// `[t, k1, …, kd]`.
    pub q: Vec<f64>,
    step: Vec<Lanes>,
    sizes: Vec<Lanes>,
    /// The matrix at the current station, and the one at the station to come.
    here: Elimination,
    there: Elimination,
    /// For refining, beside the path's own matrices.
    apart: Elimination,
    apart_sizes: Vec<Lanes>,
    places: usize,
}

/// How a correction went.
pub(super) enum Correction {
    /// At a point of the path; the size of the last but one correction, in the figure and t.
    Done(f64),
    /// It did not converge.
    Failed,
}

/// A correction no larger than this (in the figure, homotopy's unit) is the last: what remains is
/// of the order of its square.
const SMALL: f64 = 1e-6;

/// Each correction must be smaller than the one before by this factor.
const CONTRACTION: f64 = 0.3;

impl Corrector {
    pub fn new(places: usize) -> Self {
        Corrector {
            q: Vec::new(),
            step: Vec::new(),
            sizes: Vec::new(),
            here: Elimination::default(),
            there: Elimination::default(),
            apart: Elimination::default(),
            apart_sizes: Vec::new(),
            places,
        }
    }

    /// Parameters, derivatives and matrix at a point of the path, for a new plan.
    pub fn settle<const D: usize>(&mut self, evaluation: &mut Evaluation<D>, z: &[f64]) -> bool {
        self.q.resize(evaluation.driving() + 1, 0.0);
        self.step.resize(evaluation.chunks(), Lanes::ZERO);
        self.sizes.resize(evaluation.chunks(), Lanes::ZERO);
        let (figure, t) = (&z[..self.places], z[self.places]);
        evaluation.parameters(figure, t, &mut self.q);
        if !evaluation.evaluate(&self.q) {
            return false;
        }
        let done = self.differentiate(evaluation);
        self.accept();
        done
    }

    /// The matrix just computed is that of the current station from now on.
    pub fn accept(&mut self) {
        std::mem::swap(&mut self.here, &mut self.there);
    }

    /// Derivatives and factorization at the last evaluation.
    fn differentiate<const D: usize>(&mut self, evaluation: &mut Evaluation<D>) -> bool {
        evaluation.differentiate();
        evaluation.column_sizes(&mut self.sizes);
        self.there.factorize(evaluation.driving(), evaluation.jacobian(), &self.sizes)
    }

    /// The unit tangent in the full space at the station accepted last, either way round.
    pub fn tangent<const D: usize>(&mut self, evaluation: &mut Evaluation<D>, out: &mut [f64]) -> Option<()> {
        self.here.null(&mut self.step);
        lift_unit(evaluation, &self.step, self.places, out)
    }

    /// q −= step, and the figure that goes with it to first order.
    fn move_by_step<const D: usize>(&mut self, evaluation: &Evaluation<D>, z: &mut [f64]) -> f64 {
        for (j, q) in self.q.iter_mut().enumerate() {
            *q -= lane(&self.step, j);
        }
        let (moved, t) = z.split_at_mut(self.places);
        evaluation.lift(&self.step, moved);
        let mut squared = lane(&self.step, 0).powi(2);
        for (z, x) in moved.iter_mut().zip(evaluation.figure()) {
            squared += *z * *z;
            *z = x - *z;
        }
        t[0] = self.q[0];
        squared.sqrt()
    }

    /// From `q`, already evaluated, to the path. Writes the station's point and its tangent, which
    /// points the way `forward` does.
    ///
    /// The first correction uses the matrix of the current station, all others that of the point
    /// which it leads to.
    pub fn correct<const D: usize>(
        &mut self,
        evaluation: &mut Evaluation<D>,
        forward: &[f64],
        z: &mut [f64],
        tangent: &mut [f64],
    ) -> Correction {
        self.here.solve(evaluation.residual(), &mut self.step);
        for (j, q) in self.q.iter_mut().enumerate() {
            *q -= lane(&self.step, j);
        }
        let mut first = 0.0;
        for (step, size) in self.step.iter().zip(&self.sizes) {
            for k in 0..4 {
                first += step.0[k] * step.0[k] * size.0[k];
            }
        }
        let first = f64::sqrt(first);
        if !evaluation.evaluate(&self.q) || !self.differentiate(evaluation) {
            return Correction::Failed;
        }
        self.there.solve(evaluation.residual(), &mut self.step);
        let mut size = self.move_by_step(evaluation, z);
        self.there.null(&mut self.step);
        if lift_unit(evaluation, &self.step, self.places, tangent).is_none() {
            return Correction::Failed;
        }
        if super::station::dot(tangent, forward) < 0.0 {
            tangent.iter_mut().for_each(|x| *x = -*x);
        }
        let second = size;
        if !(second <= CONTRACTION.max(SMALL) * first || second <= SMALL) {
            return Correction::Failed;
        }
        for _ in 0..4 {
            if size <= SMALL {
                return Correction::Done(second);
            }
            if !evaluation.evaluate(&self.q) {
                return Correction::Failed;
            }
            self.there.solve(evaluation.residual(), &mut self.step);
            let smaller = self.move_by_step(evaluation, z);
            if !(smaller <= CONTRACTION * size || smaller <= SMALL) {
                return Correction::Failed;
            }
            size = smaller;
        }
        Correction::Failed
    }

    /// Newton's method to the end of precision, from the guess `z`, with one parameter fixed: t
    /// where `at` is none, and otherwise the one that moves most along the path, which takes the
    /// value it has at the point `at`. Writes the point found over `z`.
    pub fn refine<const D: usize>(
        &mut self,
        evaluation: &mut Evaluation<D>,
        at: Option<&[f64]>,
        z: &mut [f64],
    ) -> bool {
        let d = evaluation.driving();
        evaluation.parameters(&z[..self.places], z[self.places], &mut self.q);
        self.apart_sizes.resize(evaluation.chunks(), Lanes::ZERO);
        let mut best = f64::INFINITY;
        let mut idle = 0;
        for turn in 0..20 {
            if !evaluation.evaluate(&self.q) {
                return false;
            }
            evaluation.differentiate();
            evaluation.column_sizes(&mut self.apart_sizes);
            if at.is_none() {
                // The last choice for a pivot.
                self.apart_sizes[0].0[0] = 1e300;
            }
            if !self.apart.factorize(d, evaluation.jacobian(), &self.apart_sizes) {
                return false;
            }
            if let (Some(at), 0) = (at, turn) {
                let free = self.apart.free();
                let mut wanted = vec![0.0; d + 1];
                evaluation.parameters(&at[..self.places], at[self.places], &mut wanted);
                self.q[free] = wanted[free];
                continue;
            }
            self.apart.solve(evaluation.residual(), &mut self.step);
            let size = self.move_by_step(evaluation, z);
            if size < 0.5 * best {
                best = size;
            } else {
                // No longer shrinking: either all digits are there, or it will not converge.
                idle += 1;
                if idle == 2 {
                    break;
                }
            }
            if size == 0.0 {
                break;
            }
        }
        best < 1e-9
    }
}

/// Lifts a vector of the null space to the full space and makes it a unit vector there.
fn lift_unit<const D: usize>(
    evaluation: &Evaluation<D>,
    direction: &[Lanes],
    places: usize,
    out: &mut [f64],
) -> Option<()> {
    evaluation.lift(direction, &mut out[..places]);
    out[places] = lane(direction, 0);
    let per_size = 1.0 / super::station::dot(out, out).sqrt();
    out.iter_mut().for_each(|x| *x *= per_size);
    (per_size > 0.0 && per_size.is_finite()).then_some(())
}
