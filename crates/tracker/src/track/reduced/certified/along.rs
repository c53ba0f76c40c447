//! How large everything along a tube's polynomial ẑ(s) is for |s| ≤ h.

use super::frame::Locals;
use super::series::SIGNED;
use super::tail::TailSizes;
use super::{COEFFICIENTS, DEGREE, ORDER};
use crate::interval::rounding::gamma;
use crate::linalg::rstructure::Lane;
use crate::linalg::{LANE, Vector};
use crate::places::{Each as _, array};
use crate::track::certified::proof::powers_of;
use crate::track::full::{Equations, MAX_DEGREE};

/// Sizes over a tube of a length that was chosen last.
#[derive(Debug)]
pub struct Along {
    /// 1, h, h², …
    pub powers: [f64; DEGREE + 1],
    /// Σ_{k≥j} |d_k| hᵏ for j = 0, 1, 2, 3, 4, 5, by axis and distance.
    pub from: [Vec<Vector>; 6],
    /// Σ k |d_k| hᵏ⁻¹.
    pub slopes: Vec<Vector>,
    /// F(ẑ(s)) by distance, with rounding and the radii of lengths: what does not get smaller with s,
    /// and what does like s^COEFFICIENTS.
    pub low: Vector,
    pub high: Vector,
    /// The derivative by s of what `low` bounds.
    pub low_slope: Vector,
    /// What t does.
    pub time: Time,
    /// Bounds by distance on the terms of E'(t), on what the exact one may be off, and on the exact
    /// |E''| wherever t is within 1 of the tube.
    pub slope_size: Vector,
    pub slope_radius: Vector,
    pub curvature: Vector,
    /// Sizes over the tube for the tail's equations, those that are no distances.
    pub tail: TailSizes,
    /// By equation what orders above s^SIGNED add to E'.
    pub slope_tails: Vector,
    coefficient: Vector,
}

impl Along {
    /// Room for them.
    pub fn new(equations: &Equations) -> Self {
        Along {
            powers: [1.0; DEGREE + 1],
            from: std::array::from_fn(|_| equations.per_axis()),
            slopes: equations.per_axis(),
            low: equations.per_edge(),
            high: equations.per_edge(),
            low_slope: equations.per_edge(),
            time: Time::default(),
            slope_size: equations.per_edge(),
            slope_radius: equations.per_edge(),
            curvature: equations.per_edge(),
            tail: TailSizes::new(equations),
            slope_tails: equations.per_edge(),
            coefficient: equations.per_edge(),
        }
    }

    /// Measures all but F, with the values of the tail's entries order by order.
    pub fn measure(
        &mut self,
        equations: &Equations,
        local: &Locals,
        entries: &[Vec<f64>; COEFFICIENTS],
        h: f64,
    ) {
        self.powers = powers_of(h);
        self.measure_time(equations, local);
        let hs = &self.powers;
        if !equations.tail.is_empty() {
            self.tail.measure(equations, local, entries, hs);
        }
        for axis in 0..equations.dimension() {
            let d: [&[Lane]; COEFFICIENTS] = array(|k| local.d[k][axis].lanes());
            let lanes = d[0].len();
            let d = d.each(|d| &d[..lanes]);
            let from = self.from.each_mut();
            let mut from = from.map(|from| &mut from[axis].lanes_mut()[..lanes]);
            let slopes = &mut self.slopes[axis].lanes_mut()[..lanes];
            for l in 0..lanes {
                let mut sum = [0.0; LANE];
                for k in (0..=ORDER).rev() {
                    for i in 0..LANE {
                        sum[i] += d[k][l][i].abs() * hs[k];
                    }
                    if let Some(from) = from.get_mut(k) {
                        from[l] = sum;
                    }
                }
                for i in 0..LANE {
                    slopes[l][i] = (1..=ORDER).rev().fold(0.0, |sum: f64, k| {
                        (k as f64 * d[k][l][i].abs()).mul_add(hs[k - 1], sum)
                    });
                }
            }
        }
    }

    /// Measures F(ẑ(s)), after [`Along::measure`].
    pub fn measure_residual(&mut self, equations: &Equations, local: &Locals) {
        let hs = &self.powers;
        self.low.fill(0.0);
        self.high.fill(0.0);
        self.low_slope.fill(0.0);
        for k in 0..=2 * ORDER {
            local.coefficient(equations, k, 0, &mut self.coefficient);
            let (sums, factor) = if k <= ORDER {
                (&mut self.low, hs[k])
            } else {
                // With what the derivative by s needs of it, see `bounds.rs`.
                (&mut self.high, hs[k] * (k as f64 / COEFFICIENTS as f64))
            };
            let coefficient = self.coefficient.lanes();
            for (sum, c) in sums.lanes_mut().iter_mut().zip(coefficient) {
                for i in 0..LANE {
                    sum[i] = c[i].abs().mul_add(factor, sum[i]);
                }
            }
            if (1..=ORDER).contains(&k) {
                let factor = k as f64 * hs[k - 1];
                for (sum, c) in self.low_slope.lanes_mut().iter_mut().zip(coefficient) {
                    for i in 0..LANE {
                        sum[i] = c[i].abs().mul_add(factor, sum[i]);
                    }
                }
            }
        }
        for k in 2 * ORDER + 1..=DEGREE {
            for (b, bend) in equations.bends.iter().enumerate() {
                let excess = local.bend_excess(equations, b, k).abs();
                self.high[bend.edge] += excess * hs[k] * (k as f64 / COEFFICIENTS as f64);
            }
        }
        let count = equations.roundings();
        let of_coefficient = count.of_reduced_coefficient(COEFFICIENTS);
        let (at_point, rounding) = (gamma(count.of_reduced_residual()), gamma(of_coefficient));
        let t = self.time.t;
        let [e0, e1, e2] = equations.e.each_ref().each(|e| e.lanes());
        let [r0, r1, r2] = equations.e_radius.each_ref().each(|r| r.lanes());
        // Rounding in F(z₀) is at most γ(at a point) times ½ Σ d₀² + |E|(|t₀|). Rounding in the coefficient of
        // sᵏ, k ≥ 1, is at most γ(in a coefficient) times that of hᵏ in Σ all² + |E|(T), with T(h) = Σ |t_k| hᵏ,
        // and the radii's share that in E's radius at T. These are polynomials in h with coefficients
        // ≥ 0: the derivative by s is bounded by that by h, and what they have without k = 0 by
        // Σ (all − |d₀|)(all + |d₀|) and (T − |t₀|) |E|'(T).
        let (t0, away) = (local.z[0][equations.m].abs(), self.time.away);
        let (sizes, radii) = (self.slope_size.lanes(), self.slope_radius.lanes());
        let lows = self.low.lanes_mut().iter_mut();
        for (l, (low, slope)) in lows.zip(self.low_slope.lanes_mut()).enumerate() {
            let (mut at_0, mut beyond, mut turned) = ([0.0; LANE], [0.0; LANE], [0.0; LANE]);
            for axis in 0..equations.dimension() {
                let of = |vectors: &[Vector]| vectors[axis].lanes()[l];
                let (d, from1) = (of(&local.d[0]).each(f64::abs), of(&self.from[1]));
                let (all, slopes) = (of(&self.from[0]), of(&self.slopes));
                for i in 0..LANE {
                    at_0[i] += 0.5 * (d[i] * d[i]);
                    beyond[i] += from1[i] * (all[i] + d[i]);
                    turned[i] += 2.0 * (all[i] * slopes[i]);
                }
            }
            for i in 0..LANE {
                at_0[i] += e0[l][i].abs() + t0 * (e1[l][i].abs() + t0 * e2[l][i].abs());
                beyond[i] += away * sizes[l][i];
                turned[i] += sizes[l][i] * self.time.speed;
                let radius = r0[l][i] + t * (r1[l][i] + t * r2[l][i]);
                low[i] += at_point * at_0[i] + rounding * beyond[i] + radius;
                slope[i] += rounding * turned[i] + radii[l][i] * self.time.speed;
            }
        }
        if !equations.tail.is_empty() {
            let into = (&mut self.low, &mut self.low_slope);
            self.tail.add_terms(equations, (at_point, rounding), into);
        }
        // Up to t² the bend's coefficients are among the others.
        let beyond = |c: [f64; 5], t: f64| t * t * t * (c[3] + t * c[4]);
        for bend in &equations.bends {
            self.low[bend.edge] +=
                at_point * beyond(bend.e.each(f64::abs), t0) + beyond(bend.e_radius, t);
        }
    }

    /// Measures t, E' and E''.
    fn measure_time(&mut self, equations: &Equations, local: &Locals) {
        let hs = &self.powers;
        self.time = Time::new(array(|k| local.z[k][equations.m]), hs);
        let tail = self.time.tail;
        let tails = self.slope_tails.iter_mut().zip(equations.e[2].iter());
        tails.for_each(|(out, e2)| *out = 2.0 * e2.abs() * tail);
        for (b, bend) in equations.bends.iter().enumerate() {
            self.slope_tails[bend.edge] = (SIGNED + 1..=(MAX_DEGREE - 1) * ORDER)
                .map(|k| local.bend_slope(b, k).abs() * hs[k])
                .sum();
        }
        let t = self.time.t;
        let [_, e1, e2] = equations.e.each_ref().each(|e| e.lanes());
        let [_, r1, r2] = equations.e_radius.each_ref().each(|r| r.lanes());
        let sizes = self.slope_size.lanes_mut().iter_mut();
        let radii = self.slope_radius.lanes_mut().iter_mut();
        let curvatures = self.curvature.lanes_mut().iter_mut();
        for (l, ((size, radius), curvature)) in sizes.zip(radii).zip(curvatures).enumerate() {
            for i in 0..LANE {
                size[i] = e1[l][i].abs() + 2.0 * t * e2[l][i].abs();
                radius[i] = r1[l][i] + 2.0 * t * r2[l][i];
                curvature[i] = 2.0 * (e2[l][i].abs() + r2[l][i]);
            }
        }
        let beyond = t + 1.0;
        let second = |c: [f64; 5]| 2.0 * c[2] + beyond * (6.0 * c[3] + 12.0 * beyond * c[4]);
        for bend in &equations.bends {
            let (size, radius) = equations.slope_of_length(bend.edge, t);
            self.slope_size[bend.edge] = size;
            self.slope_radius[bend.edge] = radius;
            self.curvature[bend.edge] = second(bend.e.each(f64::abs)) + second(bend.e_radius);
        }
    }

    /// A bound on |ẑ_i'|.
    pub fn slope_of(&self, local: &Locals, i: usize) -> f64 {
        (1..=ORDER)
            .map(|k| k as f64 * local.z[k][i].abs() * self.powers[k - 1])
            .sum()
    }
}

/// What t does along a tube.
#[derive(Debug, Default)]
pub struct Time {
    /// A bound on |t|, and on how far it is from t₀.
    t: f64,
    away: f64,
    /// What orders above s^SIGNED add.
    tail: f64,
    /// A bound on |t'|.
    pub speed: f64,
}

impl Time {
    fn new(z: [f64; COEFFICIENTS], hs: &[f64; DEGREE + 1]) -> Self {
        let sum = |from: usize| -> f64 { (from..=ORDER).map(|k| z[k].abs() * hs[k]).sum() };
        Time {
            t: z[0].abs() + sum(1),
            away: sum(1),
            tail: sum(SIGNED + 1),
            speed: (1..=ORDER).map(|k| k as f64 * z[k].abs() * hs[k - 1]).sum(),
        }
    }
}
