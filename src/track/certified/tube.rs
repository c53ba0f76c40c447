//! The Krawczyk test around a piece of the path (DESIGN.md, "One certified step").
//!
//! Let ẑ(s) be the Taylor polynomial at a point of the path, c the normal of its cross-sections,
//! G_s(w) = (F(ẑ(s) + w), c·w), and u > 0 a vector of weights with the norm |w|_u = max |w_i|/u_i.
//! The preconditioner moves with s: Ỹ(s) = (I − s A) Y with A ≈ Y·J₁, where J_k is the
//! coefficient of sᵏ of the Jacobian along ẑ. Then, with R₀ = I − Y[J₀; c],
//!
//! ```text
//! M(s, w) = I − Ỹ(s)·DG_s(w)
//!         = s²(A² − A₂) + s³ A A₂ + (I − s A)(R₀ + rounding − Σ_{k≥3} sᵏ Y J_k − Y J'(w)),   A₂ ≈ Y J₂
//! ```
//!
//! so that the terms linear in s cancel, and h may be of the order of 1/√|A² − A₂| rather than
//! 1/|A|. If |M|_u ≤ q < 1 for |s| ≤ h, |w|_u ≤ r and |Ỹ(s) F(ẑ(s))|_u ≤ η < (1 − q) r, then
//! w ↦ w − Ỹ(s) G_s(w) is a contraction of the box |w|_u ≤ r into itself: for every s there is
//! exactly one zero of G_s in the box, at most η/(1 − q) from its centre, and [J; c] is regular
//! on the whole tube (Krawczyk 1969; Rump, Acta Numerica 2010, section 13).

use super::link::{Tube, evaluation_error};
use crate::interval::rounding::{gamma, in_range, round_up};
use crate::linalg::{Matrix, Vector};
use crate::track::full::{Equations, Local, MAX_DEGREE, ORDER};

/// The largest power of s in F(ẑ(s)).
const DEGREE: usize = MAX_DEGREE * ORDER;
/// At most so much of the contraction may be used up by the length of the tube.
const MAX_CONTRACTION: f64 = 0.85;
/// The smallest weight of an entry beside the largest, 1.
const MIN_WEIGHT: f64 = 0.02;

/// What is proved of a tube.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Proof {
    /// The tube reaches over |s| ≤ h.
    pub h: f64,
    /// In the box |w|_u ≤ `r` around ẑ(s) the path is the only zero of the cross-section.
    pub r: f64,
    /// The path is at most that far from ẑ(s).
    pub distance: f64,
    /// The path's derivative by s is at most that far from ẑ'(s).
    pub slope_distance: f64,
    /// The bound on |M|_u.
    pub q: f64,
    /// |ẑ'(s)|_u on the tube.
    pub slope: f64,
    /// |A|_u.
    pub moving: f64,
}

/// Work space of the test.
#[derive(Debug, Clone)]
pub struct KrawczykTest {
    a: Matrix,
    a2: Matrix,
    r0: Matrix,
    g: [Vector; 5],
    v: Vector,
    f: Vector,
    u: Vector,
    square_u: Vector,
}

/// Bounds in the norm |·|_u, up to the factors that depend on h.
#[derive(Debug, Clone, Copy)]
struct Norms {
    /// |A|, |A₂|, |A² − A₂|.
    a: f64,
    a2: f64,
    square: f64,
    /// |R₀|, and rounding of all of the computed products.
    r0: f64,
    /// |Σ_{k≥3} sᵏ Y J_k| at |s| = `h`.
    higher: f64,
    /// |Y J'(w)| per |w|_u.
    width: f64,
    /// |Y F(ẑ(s))| at |s| = `h`: orders up to ORDER with rounding, ORDER + 1, and above.
    low: f64,
    middle: f64,
    high: f64,
    /// |ẑ'(s)|_u for |s| ≤ `h`, and the bound on |ẑ_t'(s)| in it.
    slope: f64,
    slope_of_t: f64,
    /// Where the bounds that depend on s were taken; they hold below.
    h: f64,
}

impl KrawczykTest {
    /// Room for the tubes of a problem.
    pub fn new<const D: usize>(equations: &Equations<D>) -> Self {
        let n = equations.n();
        // One spare column takes the entries of fixed coordinates.
        let matrix = || Matrix::zeros(n, n + 1);
        KrawczykTest {
            a: matrix(),
            a2: matrix(),
            r0: matrix(),
            g: std::array::from_fn(|_| equations.vector()),
            v: equations.vector(),
            f: equations.vector(),
            u: equations.vector(),
            square_u: equations.vector(),
        }
    }

    /// Finds the longest tube around `local` that can be proved, at most `max_h` to either side.
    /// `weights` are u; they are replaced by better ones for the next tube.
    ///
    /// `None`: nothing can be proved here, however short.
    pub fn prove<const D: usize>(
        &mut self,
        equations: &Equations<D>,
        local: &mut Local<D>,
        weights: &mut Vector,
        max_h: f64,
    ) -> Option<Proof> {
        local.complete_powers(ORDER);
        let norms = self.norms(equations, local, weights, max_h)?;
        let proof = norms.longest(weights[equations.m]);
        self.improve(weights);
        proof
    }

    /// Encloses the path's point in the cross-section at `exit_at` of the tube that was proved
    /// last, whose A this test still has.
    ///
    /// A few steps w ← w − Ỹ(s) G_s(w) come near it. As that map is a contraction by q, the zero
    /// is at most |Ỹ(s) G_s(w)|_u / (1 − q) from any w in the box.
    pub fn enclose_exit<const D: usize>(
        &mut self,
        equations: &Equations<D>,
        tube: &mut Tube<D>,
    ) -> Option<()> {
        let (m, n) = (equations.m, equations.n());
        let (local, proof, u, s) = (&tube.local, &tube.proof, &tube.weights, tube.exit_at);
        let out = &mut tube.exit;
        let c = &local.normal[..n];
        local.at(s, ORDER, &mut out.centre);
        let goal = 1e-3 * proof.r;
        let mut step = f64::INFINITY;
        for _ in 0..6 {
            equations.residual(&out.centre, &mut self.f);
            self.f[m] = 0.0;
            local.y.multiply(&self.f[..n], &mut self.v);
            self.a.multiply(&self.v[..n], &mut self.f);
            for i in 0..n {
                self.v[i] -= s * self.f[i];
                out.centre[i] -= self.v[i];
            }
            let last = step;
            step = norm_of(&self.v, u, n);
            if step < goal || step > 0.5 * last {
                break;
            }
        }
        // The defect at the point reached, with what rounding may hide of it.
        equations.residual_with_error(&out.centre, &mut self.f, &mut self.g[0]);
        let (mut along, mut error) = (0.0, 0.0);
        let mut offset = 0.0f64;
        for i in 0..n {
            let z = (0..=ORDER)
                .rev()
                .fold(0.0f64, |sum, k| sum.mul_add(s, local.z[k][i]));
            let w = out.centre[i] - z;
            let e = evaluation_error(local, i, s) + f64::EPSILON * w.abs();
            along += c[i] * w;
            error += c[i].abs() * (e + gamma(n + 2) * w.abs());
            let ratio = (w.abs() + e) / u[i];
            if ratio > offset || ratio.is_nan() {
                offset = ratio;
            }
        }
        self.f[m] = along;
        self.g[0][m] = error;
        for i in 0..n {
            self.g[0][i] += gamma(n + 2) * self.f[i].abs();
        }
        local.y.multiply(&self.f[..n], &mut self.v);
        let computed = norm_of(&self.v, u, n);
        local.y.multiply_abs(&self.g[0][..n], &mut self.v);
        let hidden = norm_of(&self.v, u, n);
        let defect = round_up(
            (computed + hidden) * (1.0 + s.abs() * proof.moving),
            2 * n + 20,
        );
        let radius = round_up(defect / (1.0 - proof.q), 400);
        if !(round_up(offset, 40) < proof.r && radius < proof.r) {
            return None;
        }
        for i in 0..n {
            out.radius[i] = round_up(radius * u[i], 1);
        }
        Some(())
    }

    /// The weights used in the last proof.
    pub fn weights(&self) -> &Vector {
        &self.u
    }

    /// Weights for the next tube: towards the Perron vector of |A² − A₂|, in whose norm that
    /// matrix is smallest.
    fn improve(&self, weights: &mut Vector) {
        let n = self.square_u.len() - 1;
        let largest = self.square_u[..n]
            .iter()
            .fold(f64::MIN_POSITIVE, |max: f64, v| max.max(*v));
        let mut top = 0.0f64;
        for (w, v) in weights[..n].iter_mut().zip(self.square_u.iter()) {
            *w = (*w * (v / largest)).sqrt().max(MIN_WEIGHT);
            top = top.max(*w);
        }
        for w in &mut weights[..n] {
            *w /= top;
        }
    }

    /// The bounds that do not depend on the final h, and the others at the largest h worth trying.
    fn norms<const D: usize>(
        &mut self,
        equations: &Equations<D>,
        local: &Local<D>,
        weights: &Vector,
        max_h: f64,
    ) -> Option<Norms> {
        let (m, n) = (equations.m, equations.n());
        self.u.copy_from_slice(weights);
        self.products(equations, local);
        let u = &self.u;
        let norm = |v: &[f64]| norm_of(v, u, n);
        // Differences, sums over a column, and the powers of t(s): fewer roundings than this.
        let per_entry = gamma(m + 120);
        self.a.multiply_abs(&u[..n], &mut self.v);
        let a = round_up(norm(&self.v), n + 2);
        self.a2.multiply_abs(&u[..n], &mut self.v);
        let a2 = round_up(norm(&self.v), n + 2);
        self.a.square_minus_abs(&self.a2, &u[..n], &mut self.v);
        let square = round_up(norm(&self.v) + gamma(n + 4) * (a * a + a2), n + 8);
        if !(in_range(a) && in_range(a2) && in_range(square)) {
            return None;
        }
        self.square_u.copy_from_slice(&self.v);
        let h = max_h.min((MAX_CONTRACTION / square).sqrt());
        self.r0.multiply_abs(&u[..n], &mut self.v);
        let mut r0 = round_up(norm(&self.v), n + 2);

        // Per equation: rounding of the products; the Jacobian's higher terms; its change over
        // the width; the residual's orders ≤ ORDER with rounding, and > ORDER + 1.
        let ut = u[m];
        let t = local.z[0][m].abs();
        let hs = powers_of(h);
        let reach: f64 = (1..=ORDER).map(|k| local.z[k][m].abs() * hs[k]).sum();
        let [rounding, higher, width, low, high] = &mut self.g;
        for (e, edge) in equations.edges.iter().enumerate() {
            let (mut j_low, mut j_high, mut j_width, mut size) = (0.0, 0.0, 0.0, 0.0);
            for k in 0..D {
                let sum = u[edge.at[0][k]] + u[edge.at[1][k]];
                let d = |order: usize| local.d[order][e][k].abs() * hs[order];
                let first = d(0) + d(1) + d(2);
                let rest: f64 = (3..=ORDER).map(d).sum();
                j_low += first * sum;
                j_high += rest * sum;
                j_width += sum * sum;
                size += (first + rest).powi(2);
            }
            let far = t + reach;
            let (e_abs, e_rad) = (&edge.e, &edge.e_radius);
            let mut length_size = e_abs[0].abs() + far * (e_abs[1].abs() + far * e_abs[2].abs());
            let mut length_radius = e_rad[0] + far * (e_rad[1] + far * e_rad[2]);
            let mut slope_size = e_abs[1].abs() + 2.0 * far * e_abs[2].abs();
            let mut slope_radius = e_rad[1] + 2.0 * far * e_rad[2];
            let mut curvature = 2.0 * (e_abs[2].abs() + e_rad[2]);
            if edge.bend {
                // The width may add its share to t: |w_t| ≤ r u_t ≤ 1 is checked at the end.
                let far3 = far * far * far;
                length_size += far3 * (e_abs[3].abs() + far * e_abs[4].abs());
                length_radius += far3 * (e_rad[3] + far * e_rad[4]);
                slope_size += far * far * (3.0 * e_abs[3].abs() + 4.0 * far * e_abs[4].abs());
                slope_radius += far * far * (3.0 * e_rad[3] + 4.0 * far * e_rad[4]);
                let wide = far + 1.0;
                curvature += wide
                    * (6.0 * (e_abs[3].abs() + e_rad[3])
                        + 12.0 * wide * (e_abs[4].abs() + e_rad[4]));
                let c = &local.lengths[e];
                for k in 3..=(MAX_DEGREE - 1) * ORDER {
                    let entry = 2.0 * c[2] * local.powers[0][k]
                        + 3.0 * c[3] * local.powers[1][k]
                        + 4.0 * c[4] * local.powers[2][k];
                    j_high += entry.abs() * hs[k] * ut;
                }
            } else {
                let t_rest: f64 = (3..=ORDER).map(|k| local.z[k][m].abs() * hs[k]).sum();
                j_high += 2.0 * e_abs[2].abs() * t_rest * ut;
            }
            rounding[e] = per_entry * (j_low + slope_size * ut) + slope_radius * ut;
            higher[e] = j_high;
            width[e] = j_width + curvature * ut * ut;
            let mut f_low = gamma(200) * (size + length_size) + length_radius;
            for k in 0..=ORDER {
                f_low += local.coefficient(e, k, ORDER).abs() * hs[k];
            }
            low[e] = f_low;
            self.f[e] = local.coefficient(e, ORDER + 1, ORDER);
            let top = if edge.bend { DEGREE } else { 2 * ORDER };
            // With k/(ORDER + 2) ≥ 1, so that it bounds the derivative by s as well, see `proof`.
            high[e] = (ORDER + 2..=top)
                .map(|k| {
                    local.coefficient(e, k, ORDER).abs() * hs[k] * (k as f64 / (ORDER + 2) as f64)
                })
                .sum();
        }
        let normal: f64 = local.normal[..n]
            .iter()
            .zip(&u[..n])
            .map(|(c, u)| c.abs() * u)
            .sum();
        rounding[m] = per_entry * normal;

        let bound = |g: &Vector, len: usize, v: &mut Vector| {
            local.y.multiply_abs(&g[..len], v);
            round_up(norm(v), n + 200)
        };
        r0 = round_up(r0 + bound(&self.g[0], n, &mut self.v), 2);
        let higher = bound(&self.g[1], m, &mut self.v);
        let width = bound(&self.g[2], m, &mut self.v);
        let mut low = bound(&self.g[3], m, &mut self.v);
        let high = bound(&self.g[4], m, &mut self.v);
        // The leading term keeps its signs: Y first, absolute values after.
        let (size, f) = (&mut self.g[0], &self.f);
        for (size, f) in size[..m].iter_mut().zip(f.iter()) {
            *size = gamma(n + 2) * f.abs();
        }
        local.y.multiply(&f[..m], &mut self.v);
        let middle = round_up(norm_of(&self.v, u, n) * hs[ORDER + 1], n + 20);
        low = round_up(low + bound(&self.g[0], m, &mut self.v) * hs[ORDER + 1], 20);
        let slope_of = |i: usize| {
            (1..=ORDER)
                .map(|k| k as f64 * local.z[k][i].abs() * hs[k - 1])
                .sum::<f64>()
        };
        let slope = round_up(
            (0..n).fold(0.0, |max: f64, i| max.max(slope_of(i) / u[i])),
            40,
        );
        let slope_of_t = round_up(slope_of(m), 40);
        let norms = Norms {
            a,
            a2,
            square,
            r0,
            higher,
            width,
            low,
            middle,
            high,
            slope,
            slope_of_t,
            h,
        };
        norms.is_in_range().then_some(norms)
    }

    /// A ≈ Y J₁, A₂ ≈ Y J₂ and R₀ ≈ I − Y [J₀; c]: sums of columns of Y, as the J_k are sparse.
    fn products<const D: usize>(&mut self, equations: &Equations<D>, local: &Local<D>) {
        let (m, n) = (equations.m, equations.n());
        let y = &local.y;
        self.a.clear();
        self.a2.clear();
        self.r0.clear();
        for i in 0..n {
            self.r0.set(i, i, 1.0);
        }
        for (e, edge) in equations.edges.iter().enumerate() {
            for k in 0..D {
                let [i, j] = edge.at.map(|at| at[k]);
                let [d0, d1, d2] = [0, 1, 2].map(|order| local.d[order][e][k]);
                self.r0.add_column(i, -d0, y, e);
                self.r0.add_column(j, d0, y, e);
                self.a.add_column(i, d1, y, e);
                self.a.add_column(j, -d1, y, e);
                self.a2.add_column(i, d2, y, e);
                self.a2.add_column(j, -d2, y, e);
            }
            let c = &local.lengths[e];
            let slope = |k: usize| {
                2.0 * c[2] * local.powers[0][k]
                    + 3.0 * c[3] * local.powers[1][k]
                    + 4.0 * c[4] * local.powers[2][k]
            };
            self.r0.add_column(m, c[1], y, e);
            self.a.add_column(m, -slope(1), y, e);
            self.a2.add_column(m, -slope(2), y, e);
        }
        for (column, &c) in local.normal[..n].iter().enumerate() {
            self.r0.add_column(column, -c, y, m);
        }
    }
}

/// |v|_u: one division per entry, to be covered by the caller's `round_up`.
fn norm_of(v: &[f64], u: &[f64], n: usize) -> f64 {
    v[..n].iter().zip(&u[..n]).fold(0.0, |max: f64, (v, u)| {
        // A NaN must not be lost in the comparison.
        let x = v.abs() / u;
        if x > max || x.is_nan() { x } else { max }
    })
}

/// 1, h, h², …: each with at most DEGREE roundings.
fn powers_of(h: f64) -> [f64; DEGREE + 1] {
    let mut powers = [1.0; DEGREE + 1];
    for k in 1..=DEGREE {
        powers[k] = powers[k - 1] * h;
    }
    powers
}

impl Norms {
    fn is_in_range(&self) -> bool {
        [
            self.a,
            self.a2,
            self.square,
            self.r0,
            self.higher,
            self.width,
            self.low,
            self.middle,
            self.high,
            self.slope,
            self.slope_of_t,
            self.h,
        ]
        .into_iter()
        .all(in_range)
    }

    /// The contraction without the width, the factor of the width, and the defect, at `h`.
    /// Sums of fewer than 60 roundings, covered by the factor.
    fn at(&self, h: f64) -> (f64, f64, f64) {
        let moving = 1.0 + h * self.a;
        let x = h / self.h;
        let x3 = x * x * x;
        let x6 = x3 * x3;
        let contraction =
            moving * (self.r0 + self.higher * x3) + h * h * (self.square + h * (self.a * self.a2));
        let defect = moving * (self.low + self.middle * x6 + self.high * (x6 * x));
        (
            round_up(contraction, 60),
            round_up(moving * self.width, 60),
            round_up(defect, 60),
        )
    }

    /// The largest provable h: by bisection on a logarithmic scale, as any h that passes will do.
    fn longest(&self, weight_of_t: f64) -> Option<Proof> {
        const {
            assert!(
                ORDER + 1 == 6,
                "the powers in `at` are those of the Taylor order"
            )
        };
        if let Some(proof) = self.proof(self.h, weight_of_t) {
            return Some(proof);
        }
        let (mut lo, mut hi) = (0.0, self.h);
        let mut best = None;
        for _ in 0..40 {
            let h = if lo == 0.0 {
                hi / 2.0
            } else {
                (lo * hi).sqrt()
            };
            match self.proof(h, weight_of_t) {
                Some(proof) => {
                    best = Some(proof);
                    lo = h;
                    if hi / lo < 1.02 {
                        break;
                    }
                }
                None => hi = h,
            }
        }
        best
    }

    fn proof(&self, h: f64, weight_of_t: f64) -> Option<Proof> {
        let (contraction, width, defect) = self.at(h);
        let room = 1.0 - contraction;
        // Beyond this the box would be too narrow to be linked, or the proof too close to call.
        if !(contraction <= MAX_CONTRACTION && 8.0 * defect * width <= room * room) {
            return None;
        }
        let r = (0.5 * room / width).min(0.5 / weight_of_t);
        let q = round_up(contraction + width * r, 4);
        // The path is nearer than r: again with the width that is really needed, |w|_u ≤ η/(1 − q).
        let near = round_up(defect / (1.0 - q), 400);
        let nearer_q = round_up(contraction + width * near.min(r), 4);
        let distance = round_up(defect / (1.0 - nearer_q), 400);
        if !(q < 1.0 && round_up(defect + q * r, 4) < r && distance < r) {
            return None;
        }
        // w' solves [J; c] w' = −[J(ẑ + w) ẑ'; 0], and J(ẑ + w) ẑ' = F(ẑ)' + J(ẑ)' w + ½ E⁽³⁾ w_t² ẑ_t'.
        // A power sᵏ gains a factor k/h: k ≤ DEGREE in the rounding, k ≤ (MAX_DEGREE − 1) ORDER in J_k.
        // In the last term, of the bend alone, ½ |E⁽³⁾| is below the curvature that `width` counts.
        let moving = 1.0 + h * self.a;
        let orders = [DEGREE, ORDER + 1, ORDER + 2, (MAX_DEGREE - 1) * ORDER].map(|k| k as f64 / h);
        let x = h / self.h;
        let x3 = x * x * x;
        let defect_slope =
            orders[0] * self.low + x3 * x3 * (orders[1] * self.middle + orders[2] * self.high * x);
        let jacobian_slope = self.a + 2.0 * h * self.a2 + orders[3] * self.higher * x3;
        let slope = moving
            * (defect_slope
                + distance * (jacobian_slope + self.width * distance * self.slope_of_t));
        let slope_distance = round_up(slope / (1.0 - nearer_q), 400);
        Some(Proof {
            h,
            r,
            distance,
            slope_distance,
            q,
            slope: self.slope,
            moving: self.a,
        })
    }
}
