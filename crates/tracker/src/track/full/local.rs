//! A point of the path with its preconditioner and the path's Taylor expansion there.

use super::equations::{Differences, Equations, Lengths, MAX_DEGREE};
use super::preconditioner::Preconditioner;
use crate::linalg::{LANE, Matrix, Vector, dot};
use crate::places::{Each as _, array};

/// Degree of the Taylor polynomials where nothing else is said.
pub const ORDER: usize = 5;
/// The largest power of s in F(ẑ(s)) at that degree.
pub const DEGREE: usize = MAX_DEGREE * ORDER;
/// The largest degree of Taylor polynomials anywhere.
pub(in crate::track) const MAX_ORDER: usize = 8;
/// Room for the powers of t(s).
const POWERS: usize = MAX_DEGREE * MAX_ORDER + 1;

/// A point z₀ near the path, a unit normal c of the cross-section through it, a preconditioner
/// Y ≈ [J; c]⁻¹, and the polynomial ẑ(s) = z₀ + s z₁ + … with c·ẑ(s) = c·z₀ + s that follows the path.
/// It has N coefficients.
#[derive(Debug, Clone)]
pub struct Local<const N: usize = { ORDER + 1 }, Y = Matrix> {
    /// Coefficients z₀ … of ẑ.
    pub z: [Vector; N],
    /// The low words of z₀ in extended precision (it is `z[0]` + `low`); otherwise zero.
    pub low: Vector,
    /// Whether F(z₀) is taken in extended precision (`extended.rs`).
    pub is_extended: bool,
    /// Their differences p_i − p_j, and the factors of the tail's products.
    pub d: [Differences; N],
    /// Taylor coefficients of the lengths at t₀.
    pub lengths: Lengths,
    /// The normal c.
    pub normal: Vector,
    /// The preconditioner.
    pub y: Y,
    /// Powers of t(s) − t₀: `powers[j - 1][k]` is the coefficient of sᵏ in its j-th power.
    pub powers: [[f64; POWERS]; MAX_DEGREE],
    /// The size of the first correction: how far the prediction was from the path.
    pub first_correction: f64,
    /// How much the corrections shrank at the first iteration, or zero if one was enough.
    pub contraction: f64,
    /// The sign of det [J; c] at the prediction. Along a path that is followed in one direction,
    /// c being near its tangent, it never changes.
    pub negative: bool,
    pub(super) f: Vector,
    pub(super) delta: Vector,
}

impl<const N: usize, Y: Preconditioner> Local<N, Y> {
    /// The degree of ẑ.
    pub const ORDER: usize = N - 1;
    /// The largest power of s in F(ẑ(s)).
    pub const DEGREE: usize = MAX_DEGREE * Self::ORDER;

    /// Room for one point.
    pub fn new(equations: &Equations) -> Self {
        const { assert!(N > 1 && N - 1 <= MAX_ORDER, "room for the powers of t(s)") };
        let vector = || equations.vector();
        Local {
            z: std::array::from_fn(|_| vector()),
            low: vector(),
            is_extended: false,
            d: std::array::from_fn(|_| equations.room()),
            lengths: Lengths::new(equations),
            normal: vector(),
            y: Y::new(equations),
            powers: [[0.0; POWERS]; MAX_DEGREE],
            first_correction: 0.0,
            contraction: 0.0,
            negative: false,
            f: vector(),
            delta: vector(),
        }
    }

    /// Brings differences and lengths up to date with `z[0]`.
    #[inline(always)]
    pub(super) fn look(&mut self, equations: &Equations) {
        if self.is_extended {
            let z = (&self.z[0][..], &self.low[..]);
            equations
                .in_extended()
                .differences(equations, z, &mut self.d[0]);
        } else {
            equations.differences(&self.z[0], &mut self.d[0]);
        }
        equations.expand_lengths(self.z[0][equations.m], &mut self.lengths);
    }

    /// Computes the coefficients z₁ … by differentiating F(ẑ(s)) = 0: each solves the
    /// same linear system, with what the earlier ones leave as its right-hand side.
    pub fn expand(&mut self, equations: &Equations) {
        let (m, n) = (equations.m, equations.n());
        for k in 1..=Self::ORDER {
            // The terms of order k without z_k; the last row asks c·z₁ = 1, c·z_k = 0.
            self.set_power(k, 0.0);
            let mut f = std::mem::take(&mut self.f);
            self.coefficient(equations, k, 1, &mut f);
            for lane in f.lanes_mut() {
                *lane = lane.each(|x| -x);
            }
            f[m] = if k == 1 { 1.0 } else { 0.0 };
            self.y.solve(equations, &f[..n], &mut self.delta);
            self.z[k].copy_from_slice(&self.delta);
            equations.directions(&self.z[k], &mut self.d[k]);
            if !Y::FRESH {
                // One step of iterative refinement, as Y was made at the prediction.
                self.subtract_jacobian_times(equations, k, &mut f);
                f[m] -= dot(&self.normal[..n], &self.z[k][..n]);
                self.y.solve(equations, &f[..n], &mut self.delta);
                for (z, delta) in self.z[k].lanes_mut().iter_mut().zip(self.delta.lanes()) {
                    for i in 0..LANE {
                        z[i] += delta[i];
                    }
                }
                equations.directions(&self.z[k], &mut self.d[k]);
            }
            self.set_power(k, self.z[k][m]);
            self.f = f;
        }
        for k in Self::ORDER + 1..=Self::DEGREE {
            self.set_power(k, 0.0);
        }
    }

    /// `f −= J z_k` in the first m rows.
    #[inline(always)]
    fn subtract_jacobian_times(&self, equations: &Equations, k: usize, f: &mut Vector) {
        let t = self.z[k][equations.m];
        let slope = self.lengths.terms[1].lanes();
        for (l, f) in f.lanes_mut().iter_mut().enumerate().take(slope.len()) {
            let product = self.d[0].lane_of_products(&self.d[k], l);
            for i in 0..LANE {
                f[i] -= product[i] - slope[l][i] * t;
            }
        }
        if !equations.tail.is_empty() {
            let (d0, dk) = (&self.d[0].forms, &self.d[k].forms);
            equations.tail.add_products(-1.0, d0, dk, f);
        }
    }

    /// Brings the powers of t(s) − t₀ up to date at order k, t_k being `t`.
    fn set_power(&mut self, k: usize, t: f64) {
        let [p1, p2, p3, p4] = &mut self.powers;
        p1[k] = t;
        let (mut s2, mut s3, mut s4) = (0.0, 0.0, 0.0);
        // t_a, 1 ≤ a ≤ ORDER, with what goes with it from order k − 1 down.
        let last = k.clamp(1, Self::ORDER + 1);
        let others = p1[..k].iter().zip(&p2[..k]).zip(&p3[..k]).rev();
        for (t, ((p1, p2), p3)) in p1[1..last].iter().zip(others) {
            s2 += t * p1;
            s3 += t * p2;
            s4 += t * p3;
        }
        (p2[k], p3[k], p4[k]) = (s2, s3, s4);
    }

    /// The coefficients of sᵏ in F(ẑ(s)), for all distances, from products of z_a with a ≥ `least`:
    /// 0 for all of them, 1 for those without J z_k.
    #[inline(always)]
    pub fn coefficient(&self, equations: &Equations, k: usize, least: usize, out: &mut Vector) {
        let least = least.max(k.saturating_sub(Self::ORDER));
        let e2 = equations.e[2].lanes();
        let (square, linear) = (
            self.powers[1][k],
            if least == 0 { self.powers[0][k] } else { 0.0 },
        );
        let slope = self.lengths.terms[1].lanes();
        let lanes = e2.len();
        let out_lanes = &mut out.lanes_mut()[..lanes];
        for ((out, e2), slope) in out_lanes.iter_mut().zip(e2).zip(slope) {
            *out = array(|i| -(e2[i].mul_add(square, slope[i] * linear)));
        }
        for a in least..=k / 2 {
            let b = k - a;
            if b > Self::ORDER {
                continue;
            }
            let factor = if a == b { 0.5 } else { 1.0 };
            for (x, y) in self.d[a].iter().zip(&self.d[b].axes) {
                let of_axis = x.lanes().iter().zip(y.lanes());
                for (out, (x, y)) in out_lanes.iter_mut().zip(of_axis) {
                    for i in 0..LANE {
                        out[i] = (factor * x[i]).mul_add(y[i], out[i]);
                    }
                }
            }
        }
        if k == 0 {
            let t0 = self.lengths.terms[0].lanes();
            for (out, t0) in out_lanes.iter_mut().zip(t0) {
                for i in 0..LANE {
                    out[i] -= t0[i];
                }
            }
        } else {
            for (b, bend) in equations.bends.iter().enumerate() {
                out[bend.edge] -= self.bend_excess(equations, b, k);
            }
        }
        if !equations.tail.is_empty() {
            let forms = |k: usize| &self.d[k].forms;
            let tail = &equations.tail;
            tail.add_coefficient(k, least, Self::ORDER, forms, out);
        }
    }

    /// What E(t(s)) of the `bend`-th equation of degree 4 in t has at sᵏ beyond E' t_k and
    /// e₂ (t(s) − t₀)².
    pub fn bend_excess(&self, equations: &Equations, bend: usize, k: usize) -> f64 {
        let c = &self.lengths.bends[bend];
        (c[2] - equations.bends[bend].e[2]) * self.powers[1][k]
            + c[3] * self.powers[2][k]
            + c[4] * self.powers[3][k]
    }

    /// The coefficient of sᵏ, k ≥ 1, in E'(t(s)) of the `bend`-th equation of degree 4 in t.
    pub fn bend_slope(&self, bend: usize, k: usize) -> f64 {
        let c = &self.lengths.bends[bend];
        2.0 * c[2] * self.powers[0][k]
            + 3.0 * c[3] * self.powers[1][k]
            + 4.0 * c[4] * self.powers[2][k]
    }

    /// Predicts the path's point and unit tangent at `s`, beyond the range of this expansion.
    ///
    /// The polynomial is raised by one degree so that it also goes through `previous`, the point
    /// of the path where the expansion before was made: that costs no linear algebra.
    pub fn predict(&self, s: f64, previous: Option<&[f64]>, z: &mut Vector, normal: &mut Vector) {
        let n = self.z[0].len() - 1;
        self.at(s, z);
        self.slope(s, normal);
        if let Some(previous) = previous {
            let back = self.parameter_of(previous);
            let ratio = s / back;
            let factor = ratio.powi(Self::ORDER as i32 + 1);
            for i in 0..n {
                let away = factor * (previous[i] - self.entry_at(i, back));
                z[i] += away;
                normal[i] += (Self::ORDER + 1) as f64 / s * away;
            }
        }
        let size = dot(&normal[..n], &normal[..n]).sqrt();
        for x in &mut normal[..n] {
            *x /= size;
        }
    }

    /// The parameter of the cross-section that holds `point`: c·(point − z₀).
    pub fn parameter_of(&self, point: &[f64]) -> f64 {
        let n = self.z[0].len() - 1;
        let terms = point[..n]
            .iter()
            .zip(&self.z[0][..n])
            .zip(&self.normal[..n]);
        terms.map(|((point, z), c)| c * (point - z)).sum()
    }

    /// ẑ(s)_i.
    #[inline(always)]
    pub fn entry_at(&self, i: usize, s: f64) -> f64 {
        (0..N)
            .rev()
            .fold(0.0, |sum: f64, k| sum.mul_add(s, self.z[k][i]))
    }

    /// ẑ(s).
    pub fn at(&self, s: f64, out: &mut Vector) {
        let z = self.z.each_ref().each(|z| z.lanes());
        for (l, out) in out.lanes_mut().iter_mut().enumerate() {
            for i in 0..LANE {
                out[i] = (0..N)
                    .rev()
                    .fold(0.0, |sum: f64, k| sum.mul_add(s, z[k][l][i]));
            }
        }
    }

    /// One lane of ẑ'(s), and of Σ k |z_k| |s|ᵏ⁻¹.
    #[inline(always)]
    pub fn lane_of_slope(&self, lane: usize, s: f64) -> ([f64; LANE], [f64; LANE]) {
        let (mut slope, mut size) = ([0.0f64; LANE], [0.0f64; LANE]);
        for (k, z) in self.z.iter().enumerate().skip(1).rev() {
            let (k, z) = (k as f64, &z.lanes()[lane]);
            for i in 0..LANE {
                let z = k * z[i];
                slope[i] = slope[i].mul_add(s, z);
                size[i] = size[i].mul_add(s.abs(), z.abs());
            }
        }
        (slope, size)
    }

    /// ẑ'(s).
    pub fn slope(&self, s: f64, out: &mut Vector) {
        for (l, out) in out.lanes_mut().iter_mut().enumerate() {
            let mut sum = [0.0f64; LANE];
            for (k, z) in self.z.iter().enumerate().skip(1).rev() {
                let (k, z) = (k as f64, z.lanes()[l]);
                sum = array(|i| sum[i].mul_add(s, k * z[i]));
            }
            *out = sum;
        }
    }
}

/// A float estimate of the condition of [J; c] at a point, |·|_∞ of both factors.
pub fn condition(equations: &Equations, point: &[f64], normal: &[f64]) -> Option<f64> {
    let n = equations.n();
    let mut local = <Local>::new(equations);
    local.z[0].copy_from_slice(point);
    local.normal.copy_from_slice(normal);
    local
        .precondition(equations, &mut equations.inverter())
        .ok()?;
    let mut values = vec![0.0; equations.bordered_pattern().entries()];
    equations.bordered_values(&local.d[0], &local.lengths, normal, &mut values);
    let mut sums = equations.vector();
    let largest = |sums: &[f64]| sums.iter().fold(0.0, |max: f64, &x| max.max(x));
    equations
        .bordered_pattern()
        .row_sums_abs(&values, &mut sums);
    let jacobian = largest(&sums);
    local.y.multiply_abs(&vec![1.0; n], &mut sums);
    let condition = jacobian * largest(&sums);
    condition.is_finite().then_some(condition)
}
