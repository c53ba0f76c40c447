//! How large everything along a tube's polynomial ẑ(s) is for |s| ≤ h.

use super::frame::Locals;
use super::passes::Lane;
use super::series::SIGNED;
use super::{COEFFICIENTS, DEGREE, ORDER};
use crate::interval::rounding::gamma;
use crate::linalg::{LANE, Vector};
use crate::track::certified::norms::powers_of;
use crate::track::full::{Equations, MAX_DEGREE};

/// More roundings than any term of a coefficient of F along ẑ goes through: the differences and their
/// sum over a, b and the axes (27), the powers of t(s) − t₀ (40), E and its derivatives (20).
const COEFFICIENT: usize = 100;

/// Sizes over a tube of a length that was chosen last.
#[derive(Debug)]
pub struct Along<const D: usize> {
    /// 1, h, h², …
    pub powers: [f64; DEGREE + 1],
    /// Σ_{k≥j} |d_k| hᵏ for j = 0, 2, 3, 4, 5, by axis and distance.
    pub all: [Vector; D],
    pub from2: [Vector; D],
    pub from3: [Vector; D],
    pub from4: [Vector; D],
    pub from5: [Vector; D],
    /// Σ k |d_k| hᵏ⁻¹.
    pub slopes: [Vector; D],
    /// F(ẑ(s)) by distance, with rounding and the radii of lengths: what does not get smaller with s,
    /// and what does like s^COEFFICIENTS.
    pub low: Vector,
    pub high: Vector,
    pub time: Time,
    /// What the bend's E' adds above s^SIGNED.
    bend_tail: f64,
    coefficient: Vector,
}

impl<const D: usize> Along<D> {
    /// Room for them.
    pub fn new(equations: &Equations<D>) -> Self {
        let per_axis = || std::array::from_fn(|_| equations.per_edge());
        Along {
            powers: [1.0; DEGREE + 1],
            all: per_axis(),
            from2: per_axis(),
            from3: per_axis(),
            from4: per_axis(),
            from5: per_axis(),
            slopes: per_axis(),
            low: equations.per_edge(),
            high: equations.per_edge(),
            time: Time::default(),
            bend_tail: 0.0,
            coefficient: equations.per_edge(),
        }
    }

    /// Measures all but F.
    pub fn measure(&mut self, equations: &Equations<D>, local: &Locals<D>, h: f64) {
        self.powers = powers_of(h);
        let hs = &self.powers;
        self.time = Time::new(std::array::from_fn(|k| local.z[k][equations.m]), hs);
        self.bend_tail = (SIGNED + 1..=(MAX_DEGREE - 1) * ORDER)
            .map(|k| local.bend_slope(k).abs() * hs[k])
            .sum();
        for axis in 0..D {
            let d: [&[Lane]; COEFFICIENTS] = std::array::from_fn(|k| local.d[k][axis].lanes());
            let lanes = d[0].len();
            let d = d.map(|d| &d[..lanes]);
            let all = &mut self.all[axis].lanes_mut()[..lanes];
            let from2 = &mut self.from2[axis].lanes_mut()[..lanes];
            let from3 = &mut self.from3[axis].lanes_mut()[..lanes];
            let from4 = &mut self.from4[axis].lanes_mut()[..lanes];
            let from5 = &mut self.from5[axis].lanes_mut()[..lanes];
            let slopes = &mut self.slopes[axis].lanes_mut()[..lanes];
            for l in 0..lanes {
                for i in 0..LANE {
                    let size = |k: usize| d[k][l][i].abs() * hs[k];
                    let five = (5..=ORDER).rev().fold(0.0, |sum: f64, k| sum + size(k));
                    let four = five + size(4);
                    let three = four + size(3);
                    let two = three + size(2);
                    from5[l][i] = five;
                    from4[l][i] = four;
                    from3[l][i] = three;
                    from2[l][i] = two;
                    all[l][i] = two + size(1) + size(0);
                    slopes[l][i] = (1..=ORDER).rev().fold(0.0, |sum: f64, k| {
                        (k as f64 * d[k][l][i].abs()).mul_add(hs[k - 1], sum)
                    });
                }
            }
        }
    }

    /// Measures F(ẑ(s)), after [`Along::measure`].
    pub fn measure_residual(&mut self, equations: &Equations<D>, local: &Locals<D>) {
        let hs = &self.powers;
        self.low.fill(0.0);
        self.high.fill(0.0);
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
        }
        for k in 2 * ORDER + 1..=DEGREE {
            let excess = local.bend_excess(equations, k).abs();
            self.high[equations.bend.edge] += excess * hs[k] * (k as f64 / COEFFICIENTS as f64);
        }
        for e in 0..equations.m {
            let size: f64 = (0..D).map(|axis| self.all[axis][e].powi(2)).sum();
            let (length_size, length_radius) = self.time.length(equations, e);
            self.low[e] += gamma(COEFFICIENT) * (size + length_size) + length_radius;
        }
    }

    /// What orders above s^SIGNED add to the slope of a length's half square.
    pub fn slope_tail(&self, equations: &Equations<D>, e: usize) -> f64 {
        if e == equations.bend.edge {
            self.bend_tail
        } else {
            2.0 * equations.e[2][e].abs() * self.time.tail
        }
    }

    /// A bound on |ẑ_i'|.
    pub fn slope_of(&self, local: &Locals<D>, i: usize) -> f64 {
        (1..=ORDER)
            .map(|k| k as f64 * local.z[k][i].abs() * self.powers[k - 1])
            .sum()
    }
}

/// What t does along a tube.
#[derive(Debug, Default)]
pub struct Time {
    /// A bound on |t|.
    t: f64,
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
            tail: sum(SIGNED + 1),
            speed: (1..=ORDER).map(|k| k as f64 * z[k].abs() * hs[k - 1]).sum(),
        }
    }

    /// Bounds on the size of the terms of E(t), and on what the exact one may be off.
    fn length<const D: usize>(&self, equations: &Equations<D>, e: usize) -> (f64, f64) {
        let t = self.t;
        let [c, r] = coefficients(equations, e);
        let value = |c: [f64; 5]| c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4])));
        (value(c), value(r))
    }

    /// The same for E'.
    pub fn slope<const D: usize>(&self, equations: &Equations<D>, e: usize) -> (f64, f64) {
        let t = self.t;
        let [c, r] = coefficients(equations, e);
        let value = |c: [f64; 5]| c[1] + t * (2.0 * c[2] + t * (3.0 * c[3] + 4.0 * t * c[4]));
        (value(c), value(r))
    }

    /// A bound on the exact |E''| wherever t is within 1 of the tube.
    pub fn curvature<const D: usize>(&self, equations: &Equations<D>, e: usize) -> f64 {
        let t = self.t + 1.0;
        let [c, r] = coefficients(equations, e);
        let value = |c: [f64; 5]| 2.0 * c[2] + t * (6.0 * c[3] + 12.0 * t * c[4]);
        value(c) + value(r)
    }
}

/// Sizes of the coefficients of E for a distance, and their radii.
fn coefficients<const D: usize>(equations: &Equations<D>, e: usize) -> [[f64; 5]; 2] {
    if e == equations.bend.edge {
        [equations.bend.e.map(f64::abs), equations.bend.e_radius]
    } else {
        let of = |c: &[Vector; 3]| [c[0][e].abs(), c[1][e].abs(), c[2][e].abs(), 0.0, 0.0];
        [of(&equations.e), of(&equations.e_radius)]
    }
}
