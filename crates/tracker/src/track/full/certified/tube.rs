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

use super::bounds::Bounds;
use super::low_orders::LowOrders;
use super::norms::Norms;
use super::precision::Precision;
use crate::interval::rounding::{gamma, in_range, largest, round_up};
use crate::linalg::{LANE, Matrix, Vector, Workers};
use crate::system::Homotopy;
use crate::track::certified::link::Tube;
use crate::track::certified::proof::{Proof, powers_of};
use crate::track::certified::shortfall::{MAX_CONTRACTION, Shortfall};
use crate::track::certified::tracker::Test;
use crate::track::ends::{LONGEST, OUTSIDE};
use crate::track::full::{
    Differences, Equations, Forms, InverseMaker, Lengths, Local, ORDER, RefineError,
};
use crate::track::{Driving, Options, Space};

/// How near the exit's middle is brought to the path, as a fraction of the tube's radius.
const ENOUGH: f64 = 2e-2;
/// The smallest weight of an entry beside the largest, 1.
const MIN_WEIGHT: f64 = 0.1;
/// Far away unknowns differ in size as powers of each other do, and weights have to; no more than certificates tell well.
const MIN_WEIGHT_FAR: f64 = 1.0 / 4096.0;

/// The least weight where the unknowns, t left aside, are these.
fn least_weight(z: &[f64]) -> f64 {
    let size = z.iter().fold(OUTSIDE, |max: f64, x| max.max(x.abs()));
    (MIN_WEIGHT * OUTSIDE / size).max(MIN_WEIGHT_FAR)
}

/// Where bounds are out of range for tubes so long, as on a straight path, they are taken for tubes shorter by this.
const SHORTER: f64 = 1.0 / 16.0;

/// Where |I − Y [J₀; c]|_u is more than this and nothing could be proved, Y is made anew.
const STALE: f64 = 0.1;

/// Work space of the test.
#[derive(Debug, Clone)]
pub struct KrawczykTest {
    /// Tubes are cut short where the path may be further than this from their middle.
    pub radius: f64,
    pub(in crate::track) a: Matrix,
    /// Values of the sparse matrices J₁, J₂ and [J₀; c].
    j1: Vec<f64>,
    j2: Vec<f64>,
    j0: Vec<f64>,
    pub(super) bounds: Bounds,
    /// How far F at a point may be from what was computed, and in extended precision what is of orders ≥ 1.
    pub(super) hidden: Vector,
    pub(super) rest: Vector,
    /// Per distance: Σ |d_k| sᵏ for k ≤ 2 and for k ≥ 3, weight sums, a coefficient.
    pub(in crate::track) near: Differences,
    pub(in crate::track) far: Differences,
    pub(in crate::track) sums: Differences,
    /// For the tail: Σ |d_k| sᵏ for all k.
    pub(super) tail_sizes: Forms,
    pub(in crate::track) coefficient: Vector,
    pub(in crate::track) lengths: Lengths,
    pub(in crate::track) v: Vector,
    pub(in crate::track) f: Vector,
    pub(in crate::track) u: Vector,
    square_u: Vector,
    /// Weights for the next proof, and those to return to if it is rejected.
    pub(in crate::track) next_weights: Vector,
    kept_weights: Vector,
    maker: InverseMaker,
    workers: Workers,
    /// |I − Y [J₀; c]|_u in the last proof that was tried.
    staleness: f64,
    /// Whether points and F at them are taken in extended precision, and what the last proof rested on.
    pub(in crate::track) precision: Precision,
}

impl KrawczykTest {
    /// Finds the longest tube around `local` that can be proved, at most `max_h` to either side.
    /// `weights` are u; they are replaced by better ones for the next tube.
    ///
    /// `None`: nothing can be proved here, however short.
    pub fn prove(
        &mut self,
        equations: &Equations,
        local: &Local,
        weights: &mut Vector,
        max_h: f64,
    ) -> Option<Proof> {
        self.precision.forget();
        let norms = self.norms(equations, local, weights, max_h)?;
        let norms = self.in_precision(equations, local, norms)?;
        let proof = norms.longest(weights[equations.m]);
        let least = least_weight(&local.z[0][..equations.m]);
        self.improve(weights, least);
        proof
    }

    /// Weights for the next tube: towards the Perron vector of |A² − A₂|, in whose norm that
    /// matrix is smallest; none below `least`.
    fn improve(&self, weights: &mut Vector, least: f64) {
        let n = self.square_u.len() - 1;
        let largest = self.square_u[..n]
            .iter()
            .fold(f64::MIN_POSITIVE, |max: f64, v| max.max(*v));
        let mut top = 0.0f64;
        for (w, v) in weights[..n].iter_mut().zip(self.square_u.iter()) {
            *w = (*w * (v / largest)).sqrt().max(least);
            top = top.max(*w);
        }
        for w in &mut weights[..n] {
            *w /= top;
        }
    }

    /// The bounds that do not depend on the final h, and the others at the largest h worth trying.
    pub(in crate::track) fn norms(
        &mut self,
        equations: &Equations,
        local: &Local,
        weights: &Vector,
        max_h: f64,
    ) -> Option<Norms> {
        let (m, n) = (equations.m, equations.n());
        self.u.copy_from_slice(weights);
        let [a, a2, square, r0] = self.products(equations, local);
        self.staleness = r0;
        let a = round_up(a, n + 2);
        let a2 = round_up(a2, n + 2);
        let square = round_up(square + gamma(n + m + 8) * (a * a + a2), n + 8);
        if !(in_range(a) && in_range(a2) && in_range(square)) {
            return None;
        }
        let mut h = max_h
            .min(LONGEST)
            .min((MAX_CONTRACTION / square.max(f64::MIN_POSITIVE)).sqrt());
        loop {
            let norms = self.norms_within(equations, local, [a, a2, square, r0], h);
            if norms.is_in_range() {
                return Some(norms);
            }
            // Where |A² − A₂| does not say how long tubes may be, powers of h can be more than floats hold.
            if h.is_nan() || h <= 1.0 {
                return None;
            }
            h *= SHORTER;
        }
    }

    /// The same with the largest h given.
    fn norms_within(
        &mut self,
        equations: &Equations,
        local: &Local,
        [a, a2, square, r0]: [f64; 4],
        h: f64,
    ) -> Norms {
        let (m, n) = (equations.m, equations.n());
        let per_entry = gamma(equations.roundings().of_entry_along());
        let hs = powers_of(h);
        self.bound_equations(equations, local, &hs, per_entry);

        let u = &self.u;
        let y = &local.y;
        let roundings = equations.roundings().of_norm_along();
        let mut bound = |g: &Vector, len: usize| {
            y.multiply_abs(&g[..len], &mut self.v);
            round_up(norm_of(&self.v, u, n), roundings)
        };
        let of = &self.bounds;
        // The ones of I pass through as many sums as the products that they are added to.
        let r0 = round_up(
            round_up(r0, n + 4) + bound(&of.rounding, n) + gamma(m + 4),
            3,
        );
        let higher = bound(&of.higher, m);
        let width = bound(&of.width, m);
        let low = bound(&of.low, m);
        let high = bound(&of.high, m);
        // The leading term keeps its signs: Y first, absolute values after. Its rounding is in `low`.
        y.multiply(&self.f[..m], &mut self.v);
        let middle = round_up(norm_of(&self.v, u, n) * hs[ORDER + 1], n + 20);
        for (l, v) in self.v.lanes_mut().iter_mut().enumerate() {
            *v = local.lane_of_slope(l, h).1;
        }
        let slope = round_up(norm_of(&self.v, u, n), 40);
        let slope_of_t = round_up(self.v[m], 40);
        let normal = local.normal[..n]
            .iter()
            .zip(&u[..n])
            .map(|(c, u)| c.abs() * u)
            .sum();
        Norms {
            a,
            a2,
            square,
            r0,
            higher,
            width,
            low: LowOrders::Whole(low),
            middle,
            high,
            slope,
            slope_of_t,
            normal,
            h,
            radius: self.radius,
        }
    }

    /// Makes A ≈ Y J₁.
    pub(in crate::track) fn make_moving_matrix(&mut self, equations: &Equations, local: &Local) {
        self.derivative(equations, local, 1);
        local
            .y
            .multiply_sparse(equations.pattern(), &self.j1, &mut self.a);
    }

    /// The values of the sparse matrix J_k, k = 1 or 2. The entry of t is minus E'(t(s)) at sᵏ:
    /// 2 e₂ t_k but for the bend.
    fn derivative(&mut self, equations: &Equations, local: &Local, k: usize) {
        let m = equations.m;
        let slope = 2.0 * local.z[k][m];
        for (time, e2) in self.f[..m].iter_mut().zip(equations.e[2].iter()) {
            *time = e2 * slope;
        }
        for (b, bend) in equations.bends.iter().enumerate() {
            self.f[bend.edge] = local.bend_slope(b, k);
        }
        let values = if k == 1 { &mut self.j1 } else { &mut self.j2 };
        equations.pattern_values(&local.d[k], &self.f[..m], values);
    }

    /// A ≈ Y J₁, kept; and |A|_u, |A₂|_u with A₂ ≈ Y J₂, |A² − A₂|_u, |I − Y [J₀; c]|_u, as computed.
    fn products(&mut self, equations: &Equations, local: &Local) -> [f64; 4] {
        let n = equations.n();
        self.make_moving_matrix(equations, local);
        self.derivative(equations, local, 2);
        let (y, u) = (&local.y, &self.u);
        let pattern = equations.pattern();
        equations.bordered_values(&local.d[0], &local.lengths, &local.normal, &mut self.j0);
        y.identity_minus_sparse_abs(equations.bordered_pattern(), &self.j0, &u[..n], &mut self.v);
        let r0 = norm_of(&self.v, u, n);
        self.a.multiply_abs(&u[..n], &mut self.v);
        let a = norm_of(&self.v, u, n);
        self.a.square_minus_sparse_abs(
            (y, pattern, &self.j2),
            &u[..n],
            (&mut self.square_u, &mut self.v),
            &mut self.workers,
        );
        [a, norm_of(&self.v, u, n), norm_of(&self.square_u, u, n), r0]
    }
}

/// |v|_u: one division per entry, to be covered by the caller's `round_up`.
pub(in crate::track) fn norm_of(v: &[f64], u: &[f64], n: usize) -> f64 {
    let (v4, v1) = v[..n].as_chunks::<LANE>();
    let (u4, u1) = u[..n].as_chunks::<LANE>();
    let mut lane = [0.0; LANE];
    for (v, u) in v4.iter().zip(u4) {
        for i in 0..LANE {
            lane[i] = largest(lane[i], v[i].abs() / u[i]);
        }
    }
    let rest = v1.iter().zip(u1).map(|(v, u)| v.abs() / u);
    lane.into_iter().chain(rest).fold(0.0, largest)
}

impl Test<{ ORDER + 1 }> for KrawczykTest {
    type Frame = Matrix;
    const SPACE: Space = Space::Full;
    const FORESEES: bool = false;

    fn new(homotopy: &Homotopy, equations: &Equations, options: &Options) -> Self {
        let n = equations.n();
        let entries = equations.pattern().entries();
        let mut ones = equations.vector();
        ones[..n].fill(1.0);
        KrawczykTest {
            radius: options.radius(homotopy.unit),
            a: Matrix::zeros(n, n),
            j1: vec![0.0; entries],
            j2: vec![0.0; entries],
            j0: vec![0.0; equations.bordered_pattern().entries()],
            bounds: Bounds::new(equations),
            hidden: equations.vector(),
            rest: equations.vector(),
            near: equations.room(),
            far: equations.room(),
            sums: equations.room(),
            tail_sizes: Forms::new(&equations.tail),
            coefficient: equations.per_edge(),
            lengths: Lengths::new(equations),
            v: equations.vector(),
            f: equations.vector(),
            u: equations.vector(),
            square_u: equations.vector(),
            next_weights: ones.clone(),
            kept_weights: ones,
            maker: equations.inverter(),
            workers: Workers::new(n, options.threads),
            staleness: 0.0,
            precision: Precision::default(),
        }
    }

    fn refine(
        &mut self,
        equations: &Equations,
        local: &mut Local,
        tolerance: f64,
    ) -> Result<(), RefineError> {
        if self.precision.extended {
            return local.refine_extended(equations, &mut self.maker);
        }
        local.refine(equations, &mut self.maker, tolerance, 8)
    }

    fn expand(&mut self, equations: &Equations, local: &mut Local) -> Result<(), RefineError> {
        local.expand(equations);
        Ok(())
    }

    fn prepare(&mut self, equations: &Equations, tube: &mut Tube, max_h: f64) {
        // The first rounds find the weights.
        let mut weights = std::mem::take(&mut self.next_weights);
        for _ in 0..3 {
            KrawczykTest::prove(self, equations, &tube.local, &mut weights, max_h);
        }
        self.next_weights = weights;
    }

    fn prove(&mut self, equations: &Equations, tube: &mut Tube, max_h: f64) -> bool {
        self.kept_weights.copy_from_slice(&self.next_weights);
        let mut weights = std::mem::take(&mut self.next_weights);
        let mut proof = KrawczykTest::prove(self, equations, &tube.local, &mut weights, max_h);
        // Tubes can be so short that the prediction, where Y was made, is as far from the path as they are long.
        if proof.is_none()
            && self.staleness > STALE
            && tube.local.precondition(equations, &mut self.maker).is_ok()
        {
            tube.local.expand(equations);
            proof = KrawczykTest::prove(self, equations, &tube.local, &mut weights, max_h);
        }
        self.next_weights = weights;
        let Some(proof) = proof else { return false };
        tube.proof = proof;
        tube.weights.copy_from_slice(&self.u);
        true
    }

    fn shortfall(&mut self, equations: &Equations, _: &mut Tube, _: f64) -> Option<Shortfall> {
        // The weights are still those of the last proof.
        let u = self.u[..equations.n()].iter();
        let top = u.fold(0.0, |a: f64, &u| a.max(u));
        let shortfall = self.precision.shortfall()?;
        Some(shortfall.scaled(top))
    }

    fn accept(&mut self, _: &Tube) {}

    fn reject(&mut self) {
        self.next_weights.copy_from_slice(&self.kept_weights);
    }

    fn enclose_exit(&mut self, equations: &Equations, tube: &mut Tube) -> Option<()> {
        self.enclose(equations, tube, ENOUGH)?;
        tube.exit_is_tight = false;
        Some(())
    }

    fn tighten_exit(&mut self, equations: &Equations, tube: &mut Tube) -> Option<()> {
        self.make_moving_matrix(equations, &tube.local);
        self.enclose(equations, tube, 0.0)?;
        tube.exit_slope_radius = self.enclose_tangent(equations, tube);
        tube.exit_is_tight = true;
        Some(())
    }

    fn plans(&self) -> (usize, Driving) {
        (0, Driving::default())
    }

    fn set_extended(&mut self, on: bool) -> bool {
        self.precision.extended = on;
        true
    }

    fn in_53_bits(&self) -> Option<Proof> {
        self.precision.in_53_bits()
    }

    fn is_limited_by_rounding(&self) -> bool {
        self.precision.is_limited_by_rounding()
    }
}
