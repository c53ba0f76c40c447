//! The Krawczyk test through the R-structure.
//!
//! At a point of the path the unknowns are split into key ones (t among them) and A's, the equations
//! into A's and ignored ones (the normal's among them), so that the Jacobian with the normal for
//! a last row is J = [[A, H], [L, C]] with A block lower triangular, one block per constructed point.
//! Along the tube's polynomial ẑ(s) all of these are polynomials in s. Deviations w from ẑ(s) are
//! written as w = T(s) v:
//!
//! ```text
//! T = [[I, K], [0, I]],   K(s) ≈ −A(s)⁻¹ H(s),      J T = [[A, E], [L, S]],   E = A K + H,  S = L K + C
//! ```
//!
//! so that key unknowns take along what hangs on them. The preconditioner is
//!
//! ```text
//! 𝒴 = [[A(s)⁻¹, 0], [−V(s), P(s)]],   P ≈ S⁻¹,  V ≈ P L A⁻¹,      Z = [−V, P]
//! ```
//!
//! with K, V and P polynomials of degree 2 in floats, and A(s)⁻¹ the exact inverse, of which only a
//! bound is needed (`resolvent.rs`). For Φ(v) = v − 𝒴 G_s(T v), G_s(w) = (F(ẑ(s) + w), c·w), on the
//! box |v| ≤ ρ, with ω_i a bound on |w_i| there and θ_e = Σ (ω_i + ω_j)² + … one on the change of the
//! Jacobian times w (second derivatives are constant),
//!
//! ```text
//! |Φ'| ρ ≤ ( |A⁻¹| (|E| ρ_K + θ_A),   |Z J_A| ρ_A + |P S − V E − I| ρ_K + |V| θ_A + |P| θ_L )
//! |Φ(0)| ≤ ( |A⁻¹| |F_A|,             |V| |F_A| + |P| |F_L| )
//! ```
//!
//! If |Φ'|_ρ ≤ q < 1 and |Φ(0)|_ρ ≤ η < 1 − q for |s| ≤ h, then for every s there is exactly one zero
//! of G_s in the box, and [J; c] is regular on the tube. Everything is linear in the number of
//! points but X ≈ A₀⁻¹ in `resolvent.rs`, whose rows are what keeps the wrapping effect away.

use super::super::link::Tube;
use super::super::norms::powers_of;
use super::super::reasons::Shortfall;
use super::super::tracker::Test;
use super::bounds::Bounds;
use super::elimination::{Elimination, MAX_KEYS, Maker};
use super::frame::{Reduction, SERIES};
use super::layout::{Layout, Order};
use super::passes::{Lane, Row, with_width};
use super::series::{SIGNED, Series, add_product};
use crate::interval::rounding::{gamma, largest, round_up};
use crate::linalg::{LANE, Vector};
use crate::system::Homotopy;
use crate::track::full::{Equations, Local, MAX_DEGREE, RefineError};
use crate::track::{Driving, Options, Space};
use std::sync::Arc;

/// The tubes' polynomials have so many coefficients.
pub const COEFFICIENTS: usize = 9;
/// Their degree.
const ORDER: usize = COEFFICIENTS - 1;
/// The largest power of s in F(ẑ(s)).
const DEGREE: usize = MAX_DEGREE * ORDER;

pub(super) type Tubes<const D: usize> = Tube<D, COEFFICIENTS, Reduction<D>>;
type Locals<const D: usize> = Local<D, COEFFICIENTS, Reduction<D>>;

/// Bounds are taken for a tube so much longer than the last one.
const GROWTH: f64 = 1.25;
/// And tried again with so much of that.
const SHRINK: f64 = 0.75;
/// So many lengths are tried.
const ATTEMPTS: i32 = 120;
/// Bounds are good enough for a tube if they were taken for one not much longer.
const NEAR: f64 = 0.7;
/// The box of A's unknowns is so much larger than what was found to be needed.
const ROOM: f64 = 2.5;
/// And at least this part of what the key unknowns' own box takes along.
const LEAST: f64 = 0.25;
/// Unknowns that no key unknown takes along count as if one did, by this part of the most.
const STILL: f64 = 0.01;
/// The smallest weight of a key unknown beside the largest, 1.
const MIN_WEIGHT: f64 = 0.05;
/// The contraction that comes with the reference length may be that at most.
const TOO_LONG: f64 = 0.8;

/// More roundings than any term of a coefficient of F along ẑ goes through: the differences and their
/// sum over a, b and the axes (27), the powers of t(s) − t₀ (40), E and its derivatives (20).
const COEFFICIENT: usize = 100;

/// Work space of the test.
#[derive(Debug)]
pub struct ReducedTest<const D: usize> {
    maker: Maker<D>,
    series: Series<D>,
    /// Weights of the unknowns for the next tube, and those to return to.
    weights: Vector,
    kept: Vector,
    /// The expected half length of the next tube.
    expected: f64,
    /// No coordinate of the path may be further than this from the tube's middle.
    radius: f64,
    /// Σ_{k≥j} |d_k| Hᵏ for j = 0, 2, 3, 4, 5, and Σ k |d_k| Hᵏ⁻¹.
    sizes: [[Vector; D]; 6],
    /// |K_i| Hⁱ times the key unknowns' weights; their sum, then |w|; ρ; A's part of it.
    moved: [Vector; SERIES + 1],
    omega: Vector,
    rho: Vector,
    rho_a: Vector,
    /// What bounds Φ(0), row by row, and all bounds, of the last attempt.
    pub(super) defect: Vector,
    pub(super) last: Bounds,
    coefficient: Vector,
    low: Vector,
    high: Vector,
    /// Right-hand sides by equation, and by row of A; work space; and solutions.
    pub(super) g: Vec<Lane>,
    pub(super) g_a: Vec<Lane>,
    pub(super) y_a: Vec<Lane>,
    pub(super) v_a: Vec<Lane>,
    /// Work space for correcting points.
    pub(super) there: Elimination<D>,
    pub(super) d: [Vector; D],
    pub(super) lengths: crate::track::full::Lengths,
    pub(super) f: Vector,
    pub(super) hidden: Vector,
    pub(super) step: Vector,
    products: Vec<Lane>,
    /// A very short tube, see `exit.rs`.
    knot: Option<Box<Tubes<D>>>,
    last_layout: Option<Arc<Layout>>,
    plan_changes: usize,
    tubes: usize,
    driving: usize,
    most_driving: usize,
}

/// One number per key unknown.
type PerKey = [f64; MAX_KEYS];

impl<const D: usize> ReducedTest<D> {
    fn room(homotopy: &Homotopy, equations: &Equations<D>, alpha: f64) -> Self {
        let per_axis = || std::array::from_fn(|_| equations.per_edge());
        let mut weights = equations.vector();
        weights[..equations.n()].fill(1.0);
        let lanes = |count: usize| vec![[0.0; LANE]; count];
        let m = equations.m;
        ReducedTest {
            maker: Maker::new(Order::new(homotopy, equations), alpha),
            series: Series::new(equations),
            kept: weights.clone(),
            weights,
            expected: 0.05,
            radius: f64::INFINITY,
            sizes: std::array::from_fn(|_| per_axis()),
            moved: std::array::from_fn(|_| equations.vector()),
            omega: equations.vector(),
            rho: equations.vector(),
            rho_a: equations.vector(),
            defect: equations.vector(),
            last: Bounds::default(),
            coefficient: equations.per_edge(),
            low: equations.per_edge(),
            high: equations.per_edge(),
            g: lanes(m + 1),
            g_a: lanes(m),
            y_a: lanes(m),
            v_a: lanes(m),
            there: Elimination::new(equations),
            d: per_axis(),
            lengths: crate::track::full::Lengths::new(m),
            f: equations.vector(),
            hidden: equations.vector(),
            step: equations.vector(),
            products: Vec::new(),
            knot: None,
            last_layout: None,
            plan_changes: 0,
            tubes: 0,
            driving: 0,
            most_driving: 0,
        }
    }

    /// Bounds for |s| ≤ `h` in a box that suits that length, which is put into the tube's frame. `None`:
    /// the bound on A(s)⁻¹ does not exist, or nothing is left to contract.
    fn bounds<const W: usize>(
        &mut self,
        equations: &Equations<D>,
        tube: &mut Tubes<D>,
        h: f64,
    ) -> Option<Bounds> {
        let (m, n) = (equations.m, equations.n());
        let local = &mut tube.local;
        let layout = local.y.elimination.layout.clone();
        let keys = layout.keys();
        let hs = powers_of(h);
        // Differences and the powers of t(s), sums over the normal or the distances of a point (m
        // each, the latter at three orders), over A's rows at two orders and key unknowns at three:
        // in all fewer roundings than this.
        let per_entry = gamma(4 * m + 4 * MAX_KEYS + 200);
        self.add_sizes(local, &hs);
        let [all, from2, from3, from4, from5, slopes] = &self.sizes;

        // |A(s)⁻¹|.
        for (axis, spread) in local.y.resolvent.spread_mut().iter_mut().enumerate() {
            let terms = from2[axis].iter().zip(all[axis].iter());
            for (spread, (from2, all)) in spread.iter_mut().zip(terms) {
                *spread = from2 + per_entry * all;
            }
        }
        let d = [&local.d[0], &local.d[1]];
        let y = &mut local.y;
        if !y
            .resolvent
            .make(equations, &layout, &y.elimination.inverses, d, h)
        {
            return None;
        }
        let roundings = y.resolvent.roundings();

        // What the key unknowns take along, per weight.
        let weight = |i: usize| self.weights[layout.keys[i] as usize];
        let mut kappa: PerKey = [0.0; MAX_KEYS];
        (0..keys).for_each(|i| kappa[i] = weight(i));
        let kappa_rows: Row<W> = rows_of(&kappa);
        let ks = [&y.elimination.k, &y.k[0], &y.k[1]].map(|k| k.as_chunks::<W>().0);
        for (q, (moved, k)) in self.moved.iter_mut().zip(ks).enumerate() {
            for (moved, k) in moved.iter_mut().zip(k) {
                *moved = hs[q] * weigh(k, &kappa_rows);
            }
        }
        for i in 0..n {
            self.omega[i] = self.moved[0][i] + self.moved[1][i] + self.moved[2][i];
        }
        let resize = |rows: &mut Vec<Lane>, count: usize| {
            rows.clear();
            rows.resize(count * W, [0.0; LANE]);
        };
        resize(&mut y.k_size, n + 1);
        resize(&mut y.k_slope, n + 1);
        resize(&mut y.z_size, n);
        let sizes = y.k_size.as_chunks_mut::<W>().0.iter_mut();
        for (i, (size, slope)) in sizes.zip(y.k_slope.as_chunks_mut::<W>().0).enumerate() {
            for w in 0..W {
                for l in 0..LANE {
                    let [k0, k1, k2] = ks.map(|k| k[i][w][l].abs());
                    size[w][l] = round_up(k0 + h * k1 + hs[2] * k2, 6);
                    slope[w][l] = round_up(k1 + 2.0 * h * k2, 6);
                }
            }
        }
        let zs = y.z.each_ref().map(|z| z.as_chunks::<W>().0);
        for (e, size) in y.z_size.as_chunks_mut::<W>().0.iter_mut().enumerate() {
            for w in 0..W {
                for l in 0..LANE {
                    let [z0, z1, z2] = zs.map(|z| z[e][w][l].abs());
                    size[w][l] = round_up(z0 + h * z1 + hs[2] * z2, 6);
                }
            }
        }
        // From here on the frame is only read, but for the box.
        let local = &tube.local;
        let y = &local.y;
        let zs = y.z.each_ref().map(|z| z.as_chunks::<W>().0);

        // What t does along the tube.
        let time = Time::new(std::array::from_fn(|k| local.z[k][m]), &hs);
        let bend_tail: f64 = (SIGNED + 1..=(MAX_DEGREE - 1) * ORDER)
            .map(|k| local.bend_slope(k).abs() * hs[k])
            .sum();
        let slope_tail = |e: usize| {
            if e == equations.bend.edge {
                bend_tail
            } else {
                2.0 * equations.e[2][e].abs() * time.tail
            }
        };

        // F along the tube: what does not get smaller with s, and what does.
        self.low.fill(0.0);
        self.high.fill(0.0);
        let mut coefficient = std::mem::take(&mut self.coefficient);
        for k in 0..=2 * ORDER {
            local.coefficient(equations, k, 0, &mut coefficient);
            let (sums, factor) = if k <= ORDER {
                (&mut self.low, hs[k])
            } else {
                (&mut self.high, hs[k] * (k as f64 / COEFFICIENTS as f64))
            };
            for (sum, c) in sums.lanes_mut().iter_mut().zip(coefficient.lanes()) {
                for i in 0..LANE {
                    sum[i] = c[i].abs().mul_add(factor, sum[i]);
                }
            }
        }
        self.coefficient = coefficient;
        for k in 2 * ORDER + 1..=DEGREE {
            let excess = local.bend_excess(equations, k).abs();
            self.high[equations.bend.edge] += excess * hs[k] * (k as f64 / COEFFICIENTS as f64);
        }
        // First round of right-hand sides, with the key unknowns' weights for the box: low, cubic,
        // width, high.
        let [jk3, jk4] = [3, 4].map(|q| self.series.jk[q].as_chunks::<W>().0);
        let sum2 = |x: &Vector, ends: [u32; 2]| x[ends[0] as usize] + x[ends[1] as usize];
        let t = m;
        for e in 0..m {
            let (mut cubic, mut width, mut size) = (slope_tail(e) * self.omega[t], 0.0, 0.0);
            for axis in 0..D {
                let ends = equations.ends[axis][e];
                cubic += from5[axis][e] * sum2(&self.moved[0], ends)
                    + from4[axis][e] * sum2(&self.moved[1], ends)
                    + from3[axis][e] * sum2(&self.moved[2], ends);
                let both = sum2(&self.omega, ends);
                width += both * both;
                size += all[axis][e] * all[axis][e];
            }
            width += time.curvature(equations, e) * (self.omega[t] * self.omega[t]);
            let (length_size, length_radius) = time.length(equations, e);
            let low = self.low[e] + gamma(COEFFICIENT) * (size + length_size) + length_radius;
            self.g[e] = [low, cubic, width, self.high[e]];
        }
        self.g[m] = [0.0; LANE];
        let resolvent = &y.resolvent;
        let zhat = y.z_size.as_chunks::<W>().0;
        let through_z = |g: &[Lane]| -> [PerKey; LANE] {
            let mut out = [[0.0; MAX_KEYS]; LANE];
            for (z, g) in zhat.iter().zip(g) {
                for i in 0..LANE {
                    for (out, z) in out[i].iter_mut().zip(z.as_flattened()) {
                        *out = z.mul_add(g[i], *out);
                    }
                }
            }
            out
        };
        for block in &layout.blocks {
            for r in 0..block.size {
                let e = block.rows[r] as usize;
                let mut g = self.g[e];
                // For the key unknowns these are counted with their signs, see `left_over_of_s`.
                g[1] += hs[3] * weigh(&jk3[e], &kappa_rows) + hs[4] * weigh(&jk4[e], &kappa_rows);
                self.g_a[block.start + r] = g;
            }
        }
        resolvent.bound(equations, &layout, &self.g_a, &mut self.y_a, &mut self.v_a);
        let [low, mut cubic, width, high] = through_z(&self.g);
        let (left0, left3) = left_over_of_s::<D, W>(
            &self.series,
            &mut self.products,
            &layout,
            zs,
            (&kappa, &hs, m),
        );
        for i in 0..keys {
            cubic[i] += left3[i];
        }
        let share =
            |values: &PerKey| (0..keys).fold(0.0, |max, i| largest(max, values[i] / kappa[i]));
        let (used, widest) = (share(&cubic), share(&width));
        if !(used < TOO_LONG && widest > 0.0) {
            return None;
        }
        let scale = 0.5 * (1.0 - used) / widest;
        // |w_t| ≤ 1, see `Time::curvature`.
        let scale = scale.min(0.5 / self.omega[t]);

        // The box, and |w| in it.
        let still = STILL * self.omega[..n].iter().fold(0.0, |max: f64, &u| max.max(u));
        self.rho.fill(0.0);
        self.rho_a.fill(0.0);
        for block in &layout.blocks {
            for c in 0..block.size {
                let (at, i) = (block.start + c, block.unknowns[c] as usize);
                let [v_low, v_cubic, v_width, v_high] = self.v_a[at];
                let need = scale * (v_cubic + scale * v_width) + v_low + v_high;
                self.rho_a[i] = ROOM * need + LEAST * scale * self.omega[i].max(still);
                self.rho[i] = self.rho_a[i];
            }
        }
        for &key in &layout.keys {
            self.rho[key as usize] = scale * self.weights[key as usize];
        }
        for i in 0..n {
            self.omega[i] = round_up(scale * self.omega[i] + self.rho_a[i], 2 * MAX_KEYS + 20);
        }
        let rho = &self.rho;

        // The first round's shares of the bounds.
        let top = self.omega[..n].iter().fold(0.0, |max: f64, &u| max.max(u));
        let mut bounds = Bounds {
            h,
            radius: self.radius / top,
            ..Bounds::default()
        };
        let raise = |bound: &mut f64, value: f64| *bound = largest(*bound, value);
        let up = |x: f64| round_up(x, roundings + 4 * m + 200);
        for block in &layout.blocks {
            for c in 0..block.size {
                let i = block.unknowns[c] as usize;
                let rho = rho[i];
                let [v_low, v_cubic, _, v_high] = self.v_a[block.start + c];
                self.defect[i] = up(v_low + v_high);
                raise(&mut bounds.low, up(v_low / rho));
                raise(&mut bounds.high, up(v_high / rho));
                raise(&mut bounds.cubic, up(scale * v_cubic / rho));
            }
        }
        let (box0, box3) = self.left_over_of_z::<W>(equations, y, &layout, &hs);
        for i in 0..keys {
            let rho = scale * kappa[i];
            self.defect[layout.keys[i] as usize] = up(low[i] + high[i]);
            raise(&mut bounds.low, up(low[i] / rho));
            raise(&mut bounds.high, up(high[i] / rho));
            raise(&mut bounds.cubic, up((scale * cubic[i] + box3[i]) / rho));
        }

        // Second round, with the box itself: constant, width, turn.
        let jk = [0, 1, 2].map(|q| self.series.jk[q].as_chunks::<W>().0);
        for e in 0..m {
            let (mut rounding, mut width, mut turn) = (0.0, 0.0, 0.0);
            let ut = self.omega[t];
            for axis in 0..D {
                let both = sum2(&self.omega, equations.ends[axis][e]);
                rounding += all[axis][e] * both;
                width += both * both;
                turn += slopes[axis][e] * both;
            }
            let curvature = time.curvature(equations, e);
            let (slope_size, slope_radius) = time.slope(equations, e);
            width += curvature * (ut * ut);
            turn += curvature * time.speed * ut;
            let constant = per_entry * (rounding + slope_size * ut) + slope_radius * ut;
            self.g[e] = [constant, width, turn, 0.0];
        }
        let normal: f64 = local.normal[..n]
            .iter()
            .zip(&self.omega[..n])
            .map(|(c, u)| c.abs() * u)
            .sum();
        self.g[m] = [per_entry * normal, 0.0, 0.0, 0.0];
        for block in &layout.blocks {
            for r in 0..block.size {
                let e = block.rows[r] as usize;
                for (q, jk) in jk.iter().enumerate() {
                    self.g[e][0] += scale * hs[q] * weigh(&jk[e], &kappa_rows);
                }
                self.g_a[block.start + r] = self.g[e];
            }
        }
        resolvent.bound(equations, &layout, &self.g_a, &mut self.y_a, &mut self.v_a);
        let [constant, width, turn, _] = through_z(&self.g);
        for block in &layout.blocks {
            for c in 0..block.size {
                let rho = rho[block.unknowns[c] as usize];
                let [v_constant, v_width, v_turn, _] = self.v_a[block.start + c];
                raise(&mut bounds.constant, up(v_constant / rho));
                raise(&mut bounds.width, up(v_width / rho));
                raise(&mut bounds.turn, up(v_turn / rho));
            }
        }
        for i in 0..keys {
            let rho = scale * kappa[i];
            let all = constant[i] + scale * left0[i] + box0[i];
            raise(&mut bounds.constant, up(all / rho));
            raise(&mut bounds.width, up(width[i] / rho));
            raise(&mut bounds.turn, up(turn[i] / rho));
        }
        let slope_of = |i: usize| {
            (1..=ORDER)
                .map(|k| k as f64 * local.z[k][i].abs() * hs[k - 1])
                .sum::<f64>()
        };
        for i in 0..n {
            raise(&mut bounds.slope, up(slope_of(i) / self.omega[i]));
        }
        bounds.normal = normal;
        let speed = up(speed_of::<D, W>(y, rho, &layout, &bounds, slope_of));
        let y = &mut tube.local.y;
        y.rho.copy_from_slice(&self.rho);
        y.speed = speed;
        self.set_next_weights(&layout, &kappa, &width);
        self.last = bounds;
        (bounds.is_in_range() && speed.is_finite()).then_some(bounds)
    }

    fn add_sizes(&mut self, local: &Locals<D>, hs: &[f64; DEGREE + 1]) {
        for axis in 0..D {
            let d: [&[Lane]; COEFFICIENTS] = std::array::from_fn(|k| local.d[k][axis].lanes());
            let [all, from2, from3, from4, from5, slopes] =
                self.sizes.each_mut().map(|v| v[axis].lanes_mut());
            for l in 0..all.len() {
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

    /// |Z J_A| ρ_A: what does not get smaller with s, and what does like s³.
    fn left_over_of_z<const W: usize>(
        &self,
        equations: &Equations<D>,
        y: &Reduction<D>,
        layout: &Layout,
        hs: &[f64; DEGREE + 1],
    ) -> (PerKey, PerKey) {
        let mut out = ([0.0; MAX_KEYS], [0.0; MAX_KEYS]);
        let zj = self.series.zj.each_ref().map(|zj| zj.as_chunks::<W>().0);
        for block in &layout.blocks {
            for &unknown in &block.unknowns[..block.size] {
                let i = unknown as usize;
                let rho = self.rho_a[i];
                for l in 0..W * LANE {
                    let entry = |q: usize| hs[q] * zj[q][i][l / LANE][l % LANE].abs();
                    out.0[l] += (entry(0) + entry(1) + entry(2)) * rho;
                    out.1[l] += entry(3) * rho;
                }
            }
        }
        let [_, from2, from3, from4, _, _] = &self.sizes;
        let zs = y.z.each_ref().map(|z| z.as_chunks::<W>().0);
        for e in 0..equations.m {
            let mut tails = [0.0; 3];
            for axis in 0..D {
                let [i, j] = equations.ends[axis][e];
                let both = self.rho_a[i as usize] + self.rho_a[j as usize];
                tails[0] += from4[axis][e] * both;
                tails[1] += from3[axis][e] * both;
                tails[2] += from2[axis][e] * both;
            }
            for (q, (z, tail)) in zs.iter().zip(tails).enumerate() {
                let factor = hs[q] * tail;
                for (out, z) in out.1.iter_mut().zip(z[e].as_flattened()) {
                    *out = z.abs().mul_add(factor, *out);
                }
            }
        }
        out
    }

    /// Weights for the next tube: towards those for which the width is the same in every key
    /// unknown; A's unknowns, which may be key later, have theirs from the box.
    fn set_next_weights(&mut self, layout: &Layout, kappa: &PerKey, width: &PerKey) {
        let largest = (0..layout.keys()).fold(f64::MIN_POSITIVE, |max, i| max.max(width[i]));
        let mut top = 0.0f64;
        for (i, &key) in layout.keys.iter().enumerate() {
            let weight = (kappa[i] * (width[i] / largest)).sqrt().max(MIN_WEIGHT);
            self.weights[key as usize] = weight;
            top = top.max(weight);
        }
        let widest = layout.keys.iter().fold(f64::MIN_POSITIVE, |max, &key| {
            max.max(self.omega[key as usize])
        });
        for block in &layout.blocks {
            for &unknown in &block.unknowns[..block.size] {
                let i = unknown as usize;
                self.weights[i] = top * (self.omega[i] / widest).clamp(MIN_WEIGHT, 1.0);
            }
        }
        let n = self.weights.len() - 1;
        for weight in &mut self.weights[..n] {
            *weight = (*weight / top).max(MIN_WEIGHT);
        }
    }
}

/// |P S − V E − I| times the key unknowns' weights, but for what V E has at low orders by rounding: what does not get smaller with s, and what does like s³.
fn left_over_of_s<const D: usize, const W: usize>(
    series: &Series<D>,
    products: &mut Vec<Lane>,
    layout: &Layout,
    zs: [&[Row<W>]; SERIES + 1],
    (kappa, hs, m): (&PerKey, &[f64; DEGREE + 1], usize),
) -> (PerKey, PerKey) {
    let keys = layout.keys();
    let rows: [usize; MAX_KEYS] = std::array::from_fn(|l| match layout.ignored.get(l) {
        Some(&e) => e as usize,
        None => m,
    });
    let mut out = [[0.0; MAX_KEYS]; 2];
    for q in 0..=SERIES + SIGNED {
        products.clear();
        products.resize(keys * W, [0.0; LANE]);
        let columns = products.as_chunks_mut::<W>().0;
        for i in q.saturating_sub(SIGNED)..=SERIES.min(q) {
            let jk = series.jk[q - i].as_chunks::<W>().0;
            add_product(&rows[..keys], zs[i], jk, columns);
            if q - i > SERIES {
                for block in &layout.blocks {
                    let rows = block.rows.map(|e| e as usize);
                    add_product(&rows[..block.size], zs[i], jk, columns);
                }
            }
        }
        let out = &mut out[(q > SERIES) as usize];
        for (j, column) in columns.iter_mut().enumerate() {
            if q == 0 {
                column[j / LANE][j % LANE] -= 1.0;
            }
            for (out, x) in out.iter_mut().zip(column.as_flattened()) {
                *out = x.abs().mul_add(hs[q] * kappa[j], *out);
            }
        }
    }
    let [constant, cubic] = out;
    (constant, cubic)
}

/// How fast v = T(s)⁻¹ (z − ẑ(s)) changes with s for a fixed point z in the box, in the norm |·|_ρ.
///
/// v_K' = −ẑ_K'. As A (K ẑ_K' − ẑ_A') = E ẑ_K' − F_A(ẑ)', v_A' = A⁻¹ (E ẑ_K' − F_A(ẑ)') − K' v_K; and
/// |A⁻¹ E| ρ_K and |A⁻¹ F_A(ẑ)'| are among the things that the bounds bound.
fn speed_of<const D: usize, const W: usize>(
    y: &Reduction<D>,
    rho: &[f64],
    layout: &Layout,
    bounds: &Bounds,
    slope_of: impl Fn(usize) -> f64,
) -> f64 {
    let mut sizes = [0.0; MAX_KEYS];
    let mut along = 0.0f64;
    for (i, &key) in layout.keys.iter().enumerate() {
        let rho = rho[key as usize];
        sizes[i] = rho;
        along = along.max(slope_of(key as usize) / rho);
    }
    let sizes: Row<W> = rows_of(&sizes);
    let slope = y.k_slope.as_chunks::<W>().0;
    let mut turning = 0.0f64;
    for block in &layout.blocks {
        for &unknown in &block.unknowns[..block.size] {
            let i = unknown as usize;
            turning = turning.max(weigh(&slope[i], &sizes) / rho[i]);
        }
    }
    let residual = (DEGREE as f64 * bounds.low + COEFFICIENTS as f64 * bounds.high) / bounds.h;
    along.max(along * (bounds.constant + bounds.cubic) + residual + turning)
}

/// What t does along a tube.
struct Time {
    /// A bound on |t|.
    t: f64,
    /// What orders above s³ add.
    tail: f64,
    /// A bound on |t'|.
    speed: f64,
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
    fn slope<const D: usize>(&self, equations: &Equations<D>, e: usize) -> (f64, f64) {
        let t = self.t;
        let [c, r] = coefficients(equations, e);
        let value = |c: [f64; 5]| c[1] + t * (2.0 * c[2] + t * (3.0 * c[3] + 4.0 * t * c[4]));
        (value(c), value(r))
    }

    /// A bound on the exact |E''| wherever t is within 1 of the tube.
    fn curvature<const D: usize>(&self, equations: &Equations<D>, e: usize) -> f64 {
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

/// Σ |k| κ over a row.
#[inline(always)]
pub(super) fn weigh<const W: usize>(k: &Row<W>, kappa: &Row<W>) -> f64 {
    let mut sums = [0.0; LANE];
    for w in 0..W {
        for l in 0..LANE {
            sums[l] = k[w][l].abs().mul_add(kappa[w][l], sums[l]);
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

fn rows_of<const W: usize>(values: &PerKey) -> Row<W> {
    values.as_chunks::<LANE>().0[..W]
        .try_into()
        .expect("W lanes")
}

#[cfg(test)]
impl<const D: usize> ReducedTest<D> {
    /// The bounds of the last proof: constant, cubic, width, low, high, and the length they hold for.
    pub fn stated(&self) -> [f64; 6] {
        let b = &self.last;
        [b.constant, b.cubic, b.width, b.low, b.high, b.h]
    }
}

impl<const D: usize> Test<D, COEFFICIENTS> for ReducedTest<D> {
    type Frame = Reduction<D>;
    const SPACE: Space = Space::Reduced;

    fn new(homotopy: &Homotopy, equations: &Equations<D>, options: &Options) -> Self {
        ReducedTest {
            radius: options.radius(homotopy.unit),
            ..ReducedTest::room(homotopy, equations, options.alpha)
        }
    }

    fn refine(
        &mut self,
        equations: &Equations<D>,
        local: &mut Locals<D>,
        tolerance: f64,
    ) -> Result<(), RefineError> {
        local.refine(equations, &mut self.maker, tolerance, 8)
    }

    fn expand(
        &mut self,
        equations: &Equations<D>,
        local: &mut Locals<D>,
    ) -> Result<(), RefineError> {
        local.precondition(equations, &mut self.maker)?;
        // To the limit of floats: what is left of the residual is multiplied along chains of points.
        local.correct(equations);
        local.expand(equations);
        let series = &mut self.series;
        with_width!(local.y.elimination.width, series.make(equations, local));
        Ok(())
    }

    fn prepare(&mut self, equations: &Equations<D>, tube: &mut Tubes<D>, max_h: f64) {
        // The first rounds find the weights, and how long tubes are.
        for _ in 0..12 {
            let h = self.expected;
            if !self.prove(equations, tube, max_h) {
                break;
            }
            self.expected = tube.proof.h;
            if self.expected < 1.1 * h {
                break;
            }
            self.expected *= 1.5;
        }
    }

    fn prove(&mut self, equations: &Equations<D>, tube: &mut Tubes<D>, max_h: f64) -> bool {
        let n = equations.n();
        self.kept.copy_from_slice(&self.weights);
        let mut h = (GROWTH * self.expected).min(max_h);
        for _ in 0..ATTEMPTS {
            let width = tube.local.y.elimination.width;
            let bounds = with_width!(width, self.bounds(equations, tube, h));
            let proof = bounds.and_then(|bounds| bounds.longest::<COEFFICIENTS>());
            match proof {
                // For a much longer tube than this one the bounds are much too large.
                Some(proof) if proof.h < NEAR * h => {
                    h = (GROWTH * proof.h).max(SHRINK * SHRINK * h)
                }
                Some(proof) => {
                    tube.proof = proof;
                    tube.weights[..n].copy_from_slice(&self.omega[..n]);
                    return true;
                }
                None => h *= SHRINK,
            }
            self.weights.copy_from_slice(&self.kept);
        }
        false
    }

    fn shortfall(
        &mut self,
        equations: &Equations<D>,
        tube: &mut Tubes<D>,
        max_h: f64,
    ) -> Option<Shortfall> {
        let longest = (GROWTH * self.expected).min(max_h);
        let width = tube.local.y.elimination.width;
        Shortfall::least((0..ATTEMPTS).map(|k| {
            let h = longest * SHRINK.powi(k);
            let Some(bounds) = with_width!(width, self.bounds(equations, tube, h)) else {
                return Some(Shortfall::Overflow);
            };
            let omega = &self.omega[..equations.n()];
            let top = omega.iter().fold(0.0, |a: f64, &u| a.max(u));
            Some(bounds.shortfall::<COEFFICIENTS>()?.scaled(top))
        }))
    }

    fn accept(&mut self, tube: &Tubes<D>) {
        self.expected = tube.proof.h;
        let layout = &tube.local.y.elimination.layout;
        if let Some(last) = &self.last_layout
            && !Arc::ptr_eq(last, layout)
        {
            self.plan_changes += 1;
        }
        self.last_layout = Some(layout.clone());
        let driving = layout.keys() - 1;
        self.tubes += 1;
        self.driving += driving;
        self.most_driving = self.most_driving.max(driving);
    }

    fn reject(&mut self) {
        self.weights.copy_from_slice(&self.kept);
    }

    fn enclose_exit(&mut self, equations: &Equations<D>, tube: &mut Tubes<D>) -> Option<()> {
        self.enclose(equations, tube)?;
        tube.exit_is_tight = false;
        Some(())
    }

    fn tighten_exit(&mut self, equations: &Equations<D>, tube: &mut Tubes<D>) -> Option<()> {
        let mut knot = self
            .knot
            .take()
            .unwrap_or_else(|| Box::new(Tube::new(equations)));
        let kept = (self.weights.clone(), self.kept.clone());
        let tightened = self.tie(equations, tube, &mut knot);
        (self.weights, self.kept) = kept;
        self.knot = Some(knot);
        tightened
    }

    fn plans(&self) -> (usize, Driving) {
        let driving = Driving {
            average: self.driving as f64 / self.tubes.max(1) as f64,
            max: self.most_driving,
        };
        (self.plan_changes, driving)
    }
}
