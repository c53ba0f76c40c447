//! Newton's method on the removed constraints, and tangents.

use super::elimination::Elimination;
use super::lane;
use super::path_point::{PathPoint, distance, dot};
use crate::places::Each as _;
use crate::plan::{Differences, Evaluation, Lanes};

/// Work space: parameters, corrections, factorizations.
pub(super) struct Corrector {
    /// `[t, k1, …, kd]`.
    pub q: Vec<f64>,
    step: Vec<Lanes>,
    null: Vec<Lanes>,
    sizes: Vec<Lanes>,
    there: Elimination,
    /// For refining, beside the path's own matrices.
    apart: Elimination,
    apart_sizes: Vec<Lanes>,
    /// The sign of the determinant of the Jacobian with the tangent as last row, which stays the
    /// same as long as plan and branch do.
    orientation: f64,
    /// How much the second correction was smaller than the first; zero if one was enough.
    pub contraction: f64,
    /// How far a point may be from the path, in the figure, by default and as in the paper.
    small: f64,
    converged: f64,
    places: usize,
}

/// A point is at most about this far from the path (in the figure, homotopy's unit), if nothing
/// else is asked for.
const SMALL: f64 = 1e-6;

/// Corrections in a step, at most, beside the first.
const MOST: usize = 4;

/// As in RR 8705: the step of finite differences, Newton iterations, and when they have converged.
/// The paper gives no numbers for these.
const DIFFERENCE: f64 = 1e-7;
const TURNS: usize = 5;
const CONVERGED: f64 = 1e-8;

/// Derivatives that have changed by more than this, relatively, are computed anew.
const CHANGE: f64 = 0.01;

/// Refined is what the last correction moves by less than this, relative to the figure.
const REFINED: f64 = 2e-10;

/// Each correction must be smaller than the one before by this factor.
const CONTRACTION: f64 = 0.3;

impl Corrector {
    pub fn new(places: usize, tolerance: Option<f64>) -> Self {
        Corrector {
            q: Vec::new(),
            step: Vec::new(),
            null: Vec::new(),
            sizes: Vec::new(),
            there: Elimination::default(),
            apart: Elimination::default(),
            apart_sizes: Vec::new(),
            orientation: 1.0,
            contraction: 0.0,
            small: tolerance.unwrap_or(SMALL),
            converged: tolerance.unwrap_or(CONVERGED),
            places,
        }
    }

    /// Takes over a plan at the point `z` of the path: parameters, derivatives, and the tangent,
    /// which is written to `tangent`. It keeps the direction that `tangent` has. (RR 8705, section
    /// 7.1, translates the last tangent with ϕ'; here it is at hand in the full space.)
    pub fn settle(
        &mut self,
        evaluation: &mut Evaluation,
        z: &[f64],
        tangent: &mut [f64],
        fresh: &mut [f64],
    ) -> bool {
        self.q.resize(evaluation.driving() + 1, 0.0);
        self.step.resize(evaluation.chunks(), Lanes::ZERO);
        self.sizes.resize(evaluation.chunks(), Lanes::ZERO);
        let (figure, t) = (&z[..self.places], z[self.places]);
        evaluation.parameters(figure, t, &mut self.q);
        if !evaluation.evaluate(&self.q) || !self.differentiate(evaluation) {
            return false;
        }
        let parity = self.there.null(&mut self.step);
        if lift_unit(evaluation, &self.step, self.places, 1.0, fresh).is_none() {
            return false;
        }
        let same = if dot(fresh, tangent) < 0.0 { -1.0 } else { 1.0 };
        self.orientation = parity * same;
        for (out, x) in tangent.iter_mut().zip(fresh) {
            *out = same * *x;
        }
        true
    }

    /// Derivatives and factorization at the last evaluation.
    fn differentiate(&mut self, evaluation: &mut Evaluation) -> bool {
        evaluation.differentiate();
        evaluation.column_sizes(&mut self.sizes);
        self.factorize(evaluation)
    }

    fn factorize(&mut self, evaluation: &Evaluation) -> bool {
        self.there
            .factorize(evaluation.driving(), evaluation.jacobian(), &self.sizes)
    }

    /// q −= step, and the figure that goes with it to first order.
    fn move_by_step(&mut self, evaluation: &Evaluation, z: &mut [f64]) -> f64 {
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

    /// From `q`, already evaluated, to the path. Writes the point; false if there is none. `h` is the
    /// length of the step, against which the corrections are measured.
    ///
    /// A correction that finds the derivatives changed since they were computed computes them
    /// anew; otherwise matrix and tangent are those of the first point.
    pub fn correct(&mut self, evaluation: &mut Evaluation, h: f64, next: &mut PathPoint) -> bool {
        let PathPoint { z, tangent } = next;
        if !self.differentiate(evaluation) {
            return false;
        }
        self.there.solve(evaluation.residual(), &mut self.step);
        let mut size = self.move_by_step(evaluation, z);
        let small = (1e-4 * h).clamp(self.small.min(1e-12), self.small);
        // About what is left to correct.
        let mut left = size;
        self.contraction = 0.0;
        for turn in 0..MOST {
            if left <= small {
                break;
            }
            if !evaluation.evaluate(&self.q) {
                return false;
            }
            self.there.solve(evaluation.residual(), &mut self.step);
            let smaller = self.step_size();
            if turn == 0 {
                self.contraction = smaller / size;
            }
            if !(smaller <= CONTRACTION * size || smaller <= small) {
                return false;
            }
            // How much derivatives have changed on the way, and with them the tangent.
            let bent = distance(evaluation.figure(), &z[..self.places]);
            let change = smaller.max(2.0 * bent) / size;
            let renew = change > CHANGE;
            if renew {
                evaluation.differentiate();
                if !self.factorize(evaluation) {
                    return false;
                }
                self.there.solve(evaluation.residual(), &mut self.step);
            }
            let before = size;
            size = self.move_by_step(evaluation, z);
            left = change * size * if renew { size / before } else { 1.0 };
        }
        if left > small || left.is_nan() {
            return false;
        }
        let way = self.there.null(&mut self.step) * self.orientation;
        lift_unit(evaluation, &self.step, self.places, way, tangent).is_some()
    }

    /// About the size of the step in the figure and t.
    fn step_size(&self) -> f64 {
        let mut sum = Lanes::ZERO;
        for (step, &size) in self.step.iter().zip(&self.sizes) {
            sum = sum.plus_product(Lanes(step.0.each(|x| x * x)), size);
        }
        sum.sum().sqrt()
    }

    /// A step as in RR 8705, section 7.1, of length `delta` in the driving parameters and t, from the
    /// point `z`. Derivatives are finite differences. Returns the distance of the figure found from
    /// the one on the tangent, or none where Newton's method does not converge.
    pub fn predict_and_correct(
        &mut self,
        evaluation: &mut Evaluation,
        z: &[f64],
        delta: f64,
        next: &mut PathPoint,
        differences: &mut Differences,
    ) -> Option<f64> {
        evaluation.parameters(&z[..self.places], z[self.places], &mut self.q);
        let mut tangent = |this: &mut Self, evaluation: &mut Evaluation| {
            let inside = evaluation.difference(&this.q, DIFFERENCE, differences);
            evaluation.column_sizes(&mut this.sizes);
            (inside && this.factorize(evaluation)).then_some(())
        };
        tangent(self, evaluation)?;
        let way = self.there.null(&mut self.step) * self.orientation;
        let size = length(&self.step);
        for (j, q) in self.q.iter_mut().enumerate() {
            *q += delta * way / size * lane(&self.step, j);
        }
        // The figure on the tangent, for the error.
        evaluation.lift(&self.step, &mut next.tangent[..self.places]);
        next.tangent[self.places] = lane(&self.step, 0);
        for (x, z) in next.tangent.iter_mut().zip(z) {
            *x = z + delta * way / size * *x;
        }
        for _ in 0..TURNS {
            tangent(self, evaluation)?;
            self.there.solve(evaluation.residual(), &mut self.step);
            // The smallest correction: nothing along the path.
            let (mut along, mut square) = (0.0, 0.0);
            self.null.resize(self.step.len(), Lanes::ZERO);
            let way = self.there.null(&mut self.null) * self.orientation;
            for (x, y) in self.step.iter().zip(&self.null) {
                along += Lanes::ZERO.plus_product(*x, *y).sum();
                square += Lanes::ZERO.plus_product(*y, *y).sum();
            }
            for (x, y) in self.step.iter_mut().zip(&self.null) {
                *x = x.plus(-along / square, *y);
            }
            let size = length(&self.step);
            self.move_by_step(evaluation, &mut next.z);
            if size <= self.converged {
                let error = distance(&next.z, &next.tangent);
                lift_unit(evaluation, &self.null, self.places, way, &mut next.tangent)?;
                return Some(error);
            }
        }
        None
    }

    /// Newton's method to the end of precision, from the guess `z`, with one parameter fixed: t
    /// where `at` is none, and otherwise the one that moves most along the path, which takes the
    /// value it has at the point `at`. Writes the point found over `z`.
    pub fn refine(
        &mut self,
        evaluation: &mut Evaluation,
        at: Option<&[f64]>,
        z: &mut [f64],
    ) -> bool {
        let d = evaluation.driving();
        evaluation.parameters(&z[..self.places], z[self.places], &mut self.q);
        self.apart_sizes.resize(evaluation.chunks(), Lanes::ZERO);
        let mut best = f64::INFINITY;
        let mut idle = 0;
        let mut fixed = at.is_none().then_some(0);
        for _ in 0..20 {
            if !evaluation.evaluate(&self.q) {
                return false;
            }
            evaluation.differentiate();
            evaluation.column_sizes(&mut self.apart_sizes);
            if let Some(free) = fixed {
                // Never a pivot, then.
                self.apart_sizes[free / 4].0[free % 4] = 1e300;
            }
            if !self
                .apart
                .factorize(d, evaluation.jacobian(), &self.apart_sizes)
            {
                return false;
            }
            if let (Some(at), None) = (at, fixed) {
                let free = self.apart.free();
                fixed = Some(free);
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
        best < REFINED * dot(z, z).sqrt()
    }
}

/// The length of a vector of parameters.
fn length(x: &[Lanes]) -> f64 {
    let square = |sum: Lanes, &x: &Lanes| sum.plus_product(x, x);
    x.iter().fold(Lanes::ZERO, square).sum().sqrt()
}

/// Lifts a vector of the null space to the full space and makes it a unit vector there, pointing
/// this way (1) or the other (-1).
fn lift_unit(
    evaluation: &Evaluation,
    direction: &[Lanes],
    places: usize,
    way: f64,
    out: &mut [f64],
) -> Option<()> {
    evaluation.lift(direction, &mut out[..places]);
    out[places] = lane(direction, 0);
    let per_size = way / dot(out, out).sqrt();
    out.iter_mut().for_each(|x| *x *= per_size);
    (per_size != 0.0 && per_size.is_finite()).then_some(())
}
