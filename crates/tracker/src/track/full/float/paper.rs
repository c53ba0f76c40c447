//! The paper's tracker in the full space, to set its figures beside ours (RR 8705, section 7.1).

use super::SAME_LENGTH;
use crate::linalg::{Matrix, Vector, dot};
use crate::system::Homotopy;
use crate::track::float::{self, Record, SMALLEST_STEP, Tried, doubled};
use crate::track::full::{Equations, InverseMaker, Local, ORDER};
use crate::track::{Control, Options, Outcome, Status, Stop, StopKind};

/// δmax of RR 8705, section 7.3.1, without a construction plan.
pub const LARGEST_STEP: f64 = 0.1;
/// The paper does not say when a correction has succeeded; this is ours, if none is asked for.
const TOLERANCE: f64 = 1e-8;
const MAX_CORRECTIONS: usize = 5;
/// The step of the finite differences, about √u.
const DIFFERENCE: f64 = 1.5e-8;

/// Follows the path with an Euler predictor, Newton–Raphson corrections with Jacobians by finite
/// differences, and steps that are doubled and halved.
///
/// `homotopy` should have the unit 1, as the paper's steps are in the problem's lengths.
pub fn track(homotopy: &Homotopy, options: &Options, control: &mut Control) -> Outcome {
    let mut record = Record::new();
    let equations = Equations::new(homotopy);
    let run = Paper::new(homotopy, &equations).run(options, control, &mut record);
    let status = run.map_or_else(Status::Stopped, |()| Status::Closed);
    record.into_outcome(homotopy, status, SAME_LENGTH)
}

struct Paper<'a> {
    homotopy: &'a Homotopy,
    equations: &'a Equations,
    inverter: InverseMaker,
    /// Corrects solutions.
    solution: Local<{ ORDER + 1 }>,
    inverse: Matrix,
    values: Vec<f64>,
    f: Vector,
    shifted: Vector,
    z: Vector,
    next: Vector,
    tangent: Vector,
    next_tangent: Vector,
}

impl<'a> Paper<'a> {
    fn new(homotopy: &'a Homotopy, equations: &'a Equations) -> Self {
        let vector = || equations.vector();
        let n = equations.n();
        Paper {
            homotopy,
            equations,
            inverter: equations.inverter(),
            solution: Local::new(equations),
            inverse: Matrix::zeros(n, n),
            values: vec![0.0; equations.bordered_pattern().entries()],
            f: vector(),
            shifted: vector(),
            z: vector(),
            next: vector(),
            tangent: vector(),
            next_tangent: vector(),
        }
    }

    /// c_i = |p_j − p_k| − a_i(t), equation (1) of the paper.
    fn residual(homotopy: &Homotopy, equations: &Equations, z: &[f64], out: &mut [f64]) {
        let t = z[equations.m];
        for (e, (length, f)) in homotopy.lengths.iter().zip(out).enumerate() {
            let ends = equations.ends.iter().map(|ends| ends[e]);
            let squared: f64 = ends
                .map(|[i, j]| (z[i as usize] - z[j as usize]).powi(2))
                .sum();
            *f = squared.sqrt() - length.value(t);
        }
    }

    /// Inverts [J; c] at `self.next`, J by finite differences; leaves H there in `self.f`.
    fn differentiate(&mut self) -> Option<()> {
        let (m, n) = (self.equations.m, self.equations.n());
        Self::residual(self.homotopy, self.equations, &self.next, &mut self.f);
        let pattern = self.equations.bordered_pattern();
        let mut at = 0;
        for k in 0..n {
            let kept = self.next[k];
            self.next[k] = kept + DIFFERENCE;
            let h = self.next[k] - kept;
            Self::residual(self.homotopy, self.equations, &self.next, &mut self.shifted);
            self.next[k] = kept;
            for e in pattern.rows_of(k) {
                self.values[at] = if e < m {
                    (self.shifted[e] - self.f[e]) / h
                } else {
                    self.tangent[k]
                };
                at += 1;
            }
        }
        self.inverter.0.invert(&self.values, &mut self.inverse).ok()
    }

    fn run(
        &mut self,
        options: &Options,
        control: &mut Control,
        record: &mut Record,
    ) -> Result<(), Stop> {
        let (m, n) = (self.equations.m, self.equations.n());
        for (x, &place) in self.z.iter_mut().zip(&self.homotopy.gauge.place) {
            *x = self.homotopy.sketch[place];
        }
        let sketch = self.z.clone();
        // The orientation is arbitrary; ours is that of rising t.
        self.tangent[m] = if options.reverse { -1.0 } else { 1.0 };
        self.next.copy_from_slice(&self.z);
        self.differentiate().ok_or_else(|| {
            let words = "the sketch is a singular point of its path";
            Stop::new(StopKind::Sketch, words)
        })?;
        self.set_tangent();
        std::mem::swap(&mut self.tangent, &mut self.next_tangent);
        let direction = self.tangent.clone();
        let unit = self.homotopy.unit;
        let largest = options.step_in(unit).unwrap_or(LARGEST_STEP);
        let tolerance = options.tolerance_in(unit).unwrap_or(TOLERANCE);
        let may_try = |step: f64, _| step >= SMALLEST_STEP;
        let stuck = float::follow(largest, may_try, |step, _| {
            for i in 0..n {
                self.next[i] = self.tangent[i].mul_add(step, self.z[i]);
            }
            if !self.correct(tolerance) {
                record.rejected += 1;
                return Ok(Tried::Failed("the correction fails"));
            }
            self.set_tangent();
            record.steps += 1;
            record.meet(self.next[m]);
            self.look_for_solution(record);
            record.length += distance(&self.z[..n], &self.next);
            // The hyperplane t = 0 was crossed near the sketch, in the direction of the start.
            if record.steps > 1 && self.passed(&sketch, &direction, step) {
                return Ok(Tried::Closed);
            }
            std::mem::swap(&mut self.z, &mut self.next);
            std::mem::swap(&mut self.tangent, &mut self.next_tangent);
            record.go_on(self.z[m], options, control)?;
            Ok(Tried::Taken(doubled(step, largest)))
        })?;
        stuck.map_or(Ok(()), |stuck| {
            Err(record.stuck(self.homotopy, self.z[m], stuck))
        })
    }

    /// Newton–Raphson in the hyperplane normal to the tangent.
    fn correct(&mut self, tolerance: f64) -> bool {
        let (m, n) = (self.equations.m, self.equations.n());
        for _ in 0..MAX_CORRECTIONS {
            if self.differentiate().is_none() {
                return false;
            }
            self.f[m] = 0.0;
            self.inverse.multiply(&self.f[..n], &mut self.shifted);
            let mut size = 0.0f64;
            for i in 0..n {
                self.next[i] -= self.shifted[i];
                size = size.max(self.shifted[i].abs());
            }
            if size <= tolerance {
                return true;
            }
            if size.is_nan() {
                return false;
            }
        }
        false
    }

    /// The unit tangent from the last inverse, along the one before.
    fn set_tangent(&mut self) {
        let (m, n) = (self.equations.m, self.equations.n());
        let column = self.inverse.column(m);
        let size = dot(column, column).sqrt();
        for i in 0..n {
            self.next_tangent[i] = column[i] / size;
        }
    }

    /// A change of sign of t − 1 between two points is a solution.
    fn look_for_solution(&mut self, record: &mut Record) {
        let m = self.equations.m;
        let (a, b) = (self.z[m] - 1.0, self.next[m] - 1.0);
        if (a < 0.0) == (b < 0.0) {
            return;
        }
        let part = a / (a - b);
        for i in 0..self.shifted.len() {
            self.shifted[i] = self.z[i] + part * (self.next[i] - self.z[i]);
        }
        // Where the interpolated point is too far off, the solution is lost: the paper's tracker
        // has no other way either.
        let system = (self.equations, &mut self.inverter);
        let _ = record.solution(system, &mut self.solution, &self.shifted);
    }

    fn passed(&self, sketch: &[f64], direction: &[f64], step: f64) -> bool {
        let (m, n) = (self.equations.m, self.equations.n());
        let crossed = (self.z[m] < 0.0) != (self.next[m] < 0.0);
        let away = distance(&self.next[..n], sketch);
        crossed && away <= 1.5 * step && dot(&self.next_tangent[..n], &direction[..n]) > 0.0
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let pairs = a.iter().zip(b);
    pairs.map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt()
}
