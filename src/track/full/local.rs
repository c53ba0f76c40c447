//! A point of the path with its preconditioner and the path's Taylor expansion there.

use super::{Equations, MAX_DEGREE};
use crate::linalg::{Inverter, Matrix, Vector};

/// Degree of the Taylor polynomials.
pub const ORDER: usize = 5;
/// One more than the largest power of s that F has along such a polynomial.
const POWERS: usize = MAX_DEGREE * ORDER + 1;

/// Why a predicted point could not be brought onto the path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RefineError {
    /// The Jacobian with the normal is singular in floating point.
    Singular,
    /// The corrections do not shrink as they should.
    Diverged,
}

/// A point z₀ near the path, a unit normal c of the cross-section through it, a float matrix
/// Y ≈ [J; c]⁻¹, and the polynomial ẑ(s) = z₀ + s z₁ + … with c·ẑ(s) = c·z₀ + s that follows the path.
#[derive(Debug, Clone)]
pub struct Local<const D: usize> {
    /// Coefficients z₀ … of ẑ.
    pub z: [Vector; ORDER + 1],
    /// Their differences p_i − p_j, per distance.
    pub d: [Vec<[f64; D]>; ORDER + 1],
    /// E⁽ʲ⁾(t₀)/j! per distance.
    pub lengths: Vec<[f64; 5]>,
    /// The normal c.
    pub normal: Vector,
    /// The preconditioner.
    pub y: Matrix,
    /// Powers of t(s) − t₀: `powers[j - 1][k]` is the coefficient of sᵏ in its j-th power.
    pub powers: [[f64; POWERS]; MAX_DEGREE],
    /// The size of the first correction: how far the prediction was from the path.
    pub first_correction: f64,
    /// How much the corrections shrank at the first iteration, or zero if one was enough.
    pub contraction: f64,
    f: Vector,
    delta: Vector,
}

impl<const D: usize> Local<D> {
    /// Room for one point.
    pub fn new(equations: &Equations<D>) -> Self {
        let (m, n) = (equations.m, equations.n());
        let vector = || equations.vector();
        Local {
            z: std::array::from_fn(|_| vector()),
            d: std::array::from_fn(|_| vec![[0.0; D]; m]),
            lengths: vec![[0.0; 5]; m],
            normal: vector(),
            y: Matrix::zeros(n, n),
            powers: [[0.0; POWERS]; MAX_DEGREE],
            first_correction: 0.0,
            contraction: 0.0,
            f: vector(),
            delta: vector(),
        }
    }

    /// A placeholder without any room.
    pub fn empty() -> Self {
        let none = || Vector::zeros(0);
        Local {
            z: std::array::from_fn(|_| none()),
            d: std::array::from_fn(|_| Vec::new()),
            lengths: Vec::new(),
            normal: none(),
            y: Matrix::zeros(0, 0),
            powers: [[0.0; POWERS]; MAX_DEGREE],
            first_correction: 0.0,
            contraction: 0.0,
            f: none(),
            delta: none(),
        }
    }

    /// Corrects `z[0]` onto the path with the preconditioner made at the prediction, moving in
    /// the cross-section normal to `normal` (both to be set by the caller).
    pub fn refine(
        &mut self,
        equations: &Equations<D>,
        inverter: &mut Inverter,
        tolerance: f64,
        max_iterations: usize,
    ) -> Result<(), RefineError> {
        let n = equations.n();
        equations.differences(&self.z[0], &mut self.d[0]);
        equations.expand_lengths(self.z[0][equations.m], &mut self.lengths);
        equations.jacobian(&self.d[0], &self.lengths, &self.normal, inverter.input());
        inverter
            .invert_into(&mut self.y)
            .map_err(|_| RefineError::Singular)?;
        let mut last = f64::INFINITY;
        self.contraction = 0.0;
        for iteration in 0..max_iterations {
            self.residual();
            self.y.multiply(&self.f[..equations.m], &mut self.delta);
            let mut size = 0.0f64;
            for (z, delta) in self.z[0][..n].iter_mut().zip(self.delta.iter()) {
                *z -= delta;
                size = size.max(delta.abs());
            }
            equations.differences(&self.z[0], &mut self.d[0]);
            equations.expand_lengths(self.z[0][equations.m], &mut self.lengths);
            match iteration {
                0 => self.first_correction = size,
                1 => self.contraction = size / last,
                _ => {}
            }
            if size <= tolerance {
                return Ok(());
            }
            // Quarter at least: a chord iteration that does worse started too far away.
            if size.is_nan() || size > 0.25 * last {
                return Err(RefineError::Diverged);
            }
            last = size;
        }
        Err(RefineError::Diverged)
    }

    /// F at z₀, from the differences.
    #[inline(always)]
    fn residual(&mut self) {
        for ((f, d), length) in self.f.iter_mut().zip(&self.d[0]).zip(&self.lengths) {
            let squared: f64 = (0..D).map(|k| d[k] * d[k]).sum();
            *f = 0.5 * squared - length[0];
        }
    }

    /// Corrects `z[0]` in X at a fixed t, as far as floats go.
    pub fn polish_at(
        &mut self,
        equations: &Equations<D>,
        inverter: &mut Inverter,
        t: f64,
    ) -> Option<()> {
        let m = equations.m;
        self.normal.fill(0.0);
        self.normal[m] = 1.0;
        self.z[0][m] = t;
        self.refine(equations, inverter, 1e-6, 20).ok()?;
        // Newton's method with the preconditioner of the refined point: the first correction
        // tells how near it was, further ones stop shrinking at the limit of precision.
        for _ in 0..3 {
            self.z[0][m] = t;
            let refined = self.refine(equations, inverter, 1e-13, 20);
            if refined.is_err() && self.first_correction.is_nan() || self.first_correction > 1e-5 {
                return None;
            }
        }
        self.z[0][m] = t;
        Some(())
    }

    /// Computes the coefficients z₁ … z_order by differentiating F(ẑ(s)) = 0: each solves the
    /// same linear system, with what the earlier ones leave as its right-hand side.
    pub fn expand(&mut self, equations: &Equations<D>, order: usize) {
        let (m, n) = (equations.m, equations.n());
        for p in &mut self.powers {
            p.fill(0.0);
        }
        for k in 1..=order {
            // The terms of order k without z_k; the last row asks c·z₁ = 1, c·z_k = 0.
            self.set_powers(k, 0.0);
            for e in 0..m {
                self.f[e] = -self.coefficient_without_top(e, k);
            }
            self.f[m] = if k == 1 { 1.0 } else { 0.0 };
            self.y.multiply(&self.f[..n], &mut self.delta);
            self.z[k][..n].copy_from_slice(&self.delta[..n]);
            // One step of iterative refinement, as Y was made at the prediction.
            equations.differences(&self.z[k], &mut self.d[k]);
            let t = self.z[k][m];
            for e in 0..m {
                let product: f64 = (0..D).map(|a| self.d[0][e][a] * self.d[k][e][a]).sum();
                self.f[e] -= product - self.lengths[e][1] * t;
            }
            self.f[m] -= dot(&self.normal[..n], &self.z[k][..n]);
            self.y.multiply(&self.f[..n], &mut self.delta);
            for (z, delta) in self.z[k][..n].iter_mut().zip(self.delta.iter()) {
                *z += delta;
            }
            equations.differences(&self.z[k], &mut self.d[k]);
            let t = self.z[k][m];
            self.set_powers(k, t);
        }
        for k in order + 1..=ORDER {
            self.z[k].fill(0.0);
            self.d[k].fill([0.0; D]);
        }
    }

    /// Brings the powers of t(s) − t₀ up to date at order k, t_k being `t`.
    fn set_powers(&mut self, k: usize, t: f64) {
        let [p1, p2, p3, p4] = &mut self.powers;
        p1[k] = t;
        p2[k] = (1..k).map(|a| p1[a] * p1[k - a]).sum();
        p3[k] = (1..k).map(|a| p1[a] * p2[k - a]).sum();
        p4[k] = (1..k).map(|a| p1[a] * p3[k - a]).sum();
    }

    /// Extends the powers of t(s) − t₀ beyond the order of the expansion.
    pub fn complete_powers(&mut self, order: usize) {
        let [p1, p2, p3, p4] = &mut self.powers;
        for k in order + 1..=MAX_DEGREE * order {
            p1[k] = 0.0;
            p2[k] = (1..=order.min(k)).map(|a| p1[a] * p1[k - a]).sum();
            p3[k] = (1..=order.min(k)).map(|a| p1[a] * p2[k - a]).sum();
            p4[k] = (1..=order.min(k)).map(|a| p1[a] * p3[k - a]).sum();
        }
    }

    /// The coefficient of sᵏ in F_e(ẑ(s)) but for the terms J z_k.
    #[inline(always)]
    fn coefficient_without_top(&self, e: usize, k: usize) -> f64 {
        let mut sum = 0.0;
        for a in 1..=(k - 1) / 2 {
            let (x, y) = (&self.d[a][e], &self.d[k - a][e]);
            sum += (0..D).map(|i| x[i] * y[i]).sum::<f64>();
        }
        if k.is_multiple_of(2) {
            sum += 0.5 * self.d[k / 2][e].iter().map(|x| x * x).sum::<f64>();
        }
        let t = &self.lengths[e];
        sum -= t[2] * self.powers[1][k];
        if t[4] != 0.0 || t[3] != 0.0 {
            sum -= t[3] * self.powers[2][k] + t[4] * self.powers[3][k];
        }
        sum
    }

    /// The coefficient of sᵏ in F_e(ẑ(s)), ẑ being of degree `order`. For k beyond `order`,
    /// [`Local::complete_powers`] must have been called.
    #[inline(always)]
    pub fn coefficient(&self, e: usize, k: usize, order: usize) -> f64 {
        let mut sum = 0.0;
        for a in k.saturating_sub(order)..=(k.saturating_sub(1) / 2).min(order) {
            if k == 0 {
                break;
            }
            let (x, y) = (&self.d[a][e], &self.d[k - a][e]);
            sum += (0..D).map(|i| x[i] * y[i]).sum::<f64>();
        }
        if k.is_multiple_of(2) && k / 2 <= order {
            sum += 0.5 * self.d[k / 2][e].iter().map(|x| x * x).sum::<f64>();
        }
        let t = &self.lengths[e];
        if k == 0 {
            return sum - t[0];
        }
        sum -= t[1] * self.powers[0][k] + t[2] * self.powers[1][k];
        if t[4] != 0.0 || t[3] != 0.0 {
            sum -= t[3] * self.powers[2][k] + t[4] * self.powers[3][k];
        }
        sum
    }

    /// Predicts the path's point and unit tangent at `s`, beyond the range of this expansion.
    ///
    /// The polynomial is raised by one degree so that it also goes through `previous`, the point
    /// of the path where the expansion before was made: that costs no linear algebra.
    pub fn predict(&self, s: f64, previous: Option<&[f64]>, z: &mut Vector, normal: &mut Vector) {
        let n = self.y.rows();
        self.at(s, ORDER, z);
        self.slope(s, ORDER, normal);
        if let Some(previous) = previous {
            let back: f64 = (0..n)
                .map(|i| self.normal[i] * (previous[i] - self.z[0][i]))
                .sum();
            let ratio = s / back;
            let square = ratio * ratio;
            let factor = square * square * square;
            const {
                assert!(
                    ORDER == 5,
                    "the factor is the (ORDER + 1)-st power of the ratio"
                )
            };
            for i in 0..n {
                let there = (0..=ORDER)
                    .rev()
                    .fold(0.0f64, |sum, k| sum.mul_add(back, self.z[k][i]));
                let away = factor * (previous[i] - there);
                z[i] += away;
                normal[i] += (ORDER + 1) as f64 / s * away;
            }
        }
        let size = dot(&normal[..n], &normal[..n]).sqrt();
        for x in &mut normal[..n] {
            *x /= size;
        }
    }

    /// A float estimate of the condition of [J; c], |·|_∞ of both factors.
    pub fn condition(&self, equations: &Equations<D>) -> Option<f64> {
        let n = equations.n();
        let mut jacobian = Matrix::zeros(n, n);
        equations.jacobian(&self.d[0], &self.lengths, &self.normal, &mut jacobian);
        let ones = vec![1.0; n];
        let mut sums = equations.vector();
        let mut norm = |a: &Matrix| {
            a.multiply_abs(&ones, &mut sums);
            sums.iter().fold(0.0, |max: f64, &x| max.max(x))
        };
        let condition = norm(&jacobian) * norm(&self.y);
        condition.is_finite().then_some(condition)
    }

    /// ẑ(s).
    pub fn at(&self, s: f64, order: usize, out: &mut Vector) {
        out.copy_from_slice(&self.z[order]);
        for k in (0..order).rev() {
            for (x, z) in out.iter_mut().zip(self.z[k].iter()) {
                *x = x.mul_add(s, *z);
            }
        }
    }

    /// ẑ'(s).
    pub fn slope(&self, s: f64, order: usize, out: &mut Vector) {
        out.fill(0.0);
        for k in (1..=order).rev() {
            for (x, z) in out.iter_mut().zip(self.z[k].iter()) {
                *x = x.mul_add(s, k as f64 * z);
            }
        }
    }
}

/// a·b.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
