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
//! bound is needed (`resolvent`). For Φ(v) = v − 𝒴 G_s(T v), G_s(w) = (F(ẑ(s) + w), c·w), on the
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
//! points but X ≈ A₀⁻¹ in `resolvent`, whose rows are what keeps the wrapping effect away.

use super::along::Along;
use super::bounds::Bounds;
use super::frame::{Locals, Reduction, Tubes};
use super::series::Series;
use super::shape::Shape;
use super::sides::Sides;
use super::{COEFFICIENTS, ORDER};
use crate::linalg::Vector;
use crate::linalg::rstructure::with_width;
use crate::system::Homotopy;
use crate::track::certified::link::Tube;
use crate::track::certified::shortfall::Shortfall;
use crate::track::certified::tracker::Test;
use crate::track::ends::LONGEST;
use crate::track::full::{Differences, Equations, Lengths, RefineError};
use crate::track::reduced::plans::Plans;
use crate::track::reduced::structure::elimination::{Elimination, Maker};
use crate::track::reduced::structure::layout::Order;
use crate::track::{Driving, Options, Space};
#[cfg(test)]
use {super::speed::speed, crate::interval::rounding::round_up};

/// Bounds are taken for a tube at most so many times as long as the last one.
const GROWTH: f64 = 1.25;
/// The length for which they are taken changes by at most this factor where the polynomial's own reach does.
const CHANGE: f64 = 3.0;
/// Where nothing is proved for a length, a tube of so much of it is tried next.
const SHRINK: f64 = 0.75;
/// So many lengths are tried.
const ATTEMPTS: i32 = 120;
/// Bounds are good enough for a tube if they were taken for one not much longer.
const NEAR: f64 = 0.7;

/// Work space of the test.
#[derive(Debug)]
pub struct ReducedTest {
    maker: Maker,
    pub(super) series: Series,
    pub(super) along: Along,
    pub(super) shape: Shape,
    pub(super) sides: Sides,
    /// What bounds Φ(0), row by row, and all bounds, of the last attempt.
    pub(in crate::track) defect: Vector,
    pub(in crate::track) last: Bounds,
    /// The half length of the tube before, and the reach of its Taylor polynomial.
    expected: f64,
    reach: f64,
    /// No coordinate of the path may be further than this from the tube's middle.
    pub(super) radius: f64,
    /// Work space for correcting points.
    pub(super) there: Elimination,
    pub(super) d: Differences,
    pub(super) lengths: Lengths,
    pub(super) f: Vector,
    pub(super) hidden: Vector,
    pub(super) step: Vector,
    /// A very short tube, see `exit.rs`.
    short: Option<Box<Tubes>>,
    plans: Plans,
}

impl Test<COEFFICIENTS> for ReducedTest {
    type Frame = Reduction;
    const SPACE: Space = Space::Reduced;
    const FORESEES: bool = true;

    fn new(homotopy: &Homotopy, equations: &Equations, options: &Options) -> Self {
        let m = equations.m;
        ReducedTest {
            maker: Maker::new(Order::new(homotopy, equations), options.alpha),
            series: Series::new(equations),
            along: Along::new(equations),
            shape: Shape::new(equations),
            sides: Sides::new(m),
            defect: equations.vector(),
            last: Bounds::default(),
            expected: 0.05,
            reach: 1.0,
            radius: options.radius(homotopy.unit),
            there: Elimination::new(equations),
            d: equations.room(),
            lengths: Lengths::new(equations),
            f: equations.vector(),
            hidden: equations.vector(),
            step: equations.vector(),
            short: None,
            plans: Plans::default(),
        }
    }

    fn refine(
        &mut self,
        equations: &Equations,
        local: &mut Locals,
        tolerance: f64,
    ) -> Result<(), RefineError> {
        local.refine(equations, &mut self.maker, tolerance, 8)
    }

    fn expand(&mut self, equations: &Equations, local: &mut Locals) -> Result<(), RefineError> {
        // The layout that was chosen at the prediction.
        self.maker.chooses = false;
        let made = local.precondition(equations, &mut self.maker);
        self.maker.chooses = true;
        made?;
        // To the limit of floats: what is left of the residual is multiplied along chains of points.
        local.correct(equations);
        local.expand(equations);
        let series = &mut self.series;
        with_width!(
            local.y.elimination.reduced.width,
            series.make(equations, local)
        );
        Ok(())
    }

    fn prepare(&mut self, equations: &Equations, tube: &mut Tubes, max_h: f64) {
        // The first rounds find the weights, and how long tubes are.
        self.reach = reach(&tube.local);
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

    fn prove(&mut self, equations: &Equations, tube: &mut Tubes, max_h: f64) -> bool {
        let n = equations.n();
        self.shape.keep();
        let mut h = self.first_length(tube, max_h);
        for _ in 0..ATTEMPTS {
            let width = tube.local.y.elimination.reduced.width;
            let bounds = with_width!(width, self.bounds(equations, tube, h));
            let proof = bounds.and_then(|bounds| bounds.longest::<COEFFICIENTS>());
            match proof {
                // For a much longer tube than this one the bounds are much too large.
                Some(proof) if proof.h < NEAR * h => {
                    h = (GROWTH * proof.h).max(SHRINK * SHRINK * h)
                }
                Some(proof) => {
                    tube.proof = proof;
                    tube.weights[..n].copy_from_slice(&self.shape.omega[..n]);
                    return true;
                }
                None => h *= SHRINK,
            }
            self.shape.restore();
        }
        false
    }

    fn shortfall(
        &mut self,
        equations: &Equations,
        tube: &mut Tubes,
        max_h: f64,
    ) -> Option<Shortfall> {
        let longest = self.first_length(tube, max_h);
        let width = tube.local.y.elimination.reduced.width;
        Shortfall::least((0..ATTEMPTS).map(|k| {
            let h = longest * SHRINK.powi(k);
            let Some(bounds) = with_width!(width, self.bounds(equations, tube, h)) else {
                return Some(Shortfall::Overflow);
            };
            let omega = &self.shape.omega[..equations.n()];
            let top = omega.iter().fold(0.0, |a: f64, &u| a.max(u));
            Some(bounds.shortfall::<COEFFICIENTS>()?.scaled(top))
        }))
    }

    fn accept(&mut self, tube: &Tubes) {
        self.expected = tube.proof.h;
        self.reach = reach(&tube.local);
        self.plans.add(&tube.local.y.elimination.layout);
    }

    fn reject(&mut self) {
        self.shape.restore();
    }

    fn enclose_exit(&mut self, equations: &Equations, tube: &mut Tubes) -> Option<()> {
        self.enclose(equations, tube)?;
        tube.exit_is_tight = false;
        Some(())
    }

    fn tighten_exit(&mut self, equations: &Equations, tube: &mut Tubes) -> Option<()> {
        let mut short = self
            .short
            .take()
            .unwrap_or_else(|| Box::new(Tube::new(equations)));
        let kept = (self.shape.weights.clone(), self.shape.kept.clone());
        let tightened = self.enclose_by_short_tube(equations, tube, &mut short);
        (self.shape.weights, self.shape.kept) = kept;
        self.short = Some(short);
        tightened
    }

    fn plans(&self) -> (usize, Driving) {
        (self.plans.changes, self.plans.driving())
    }
}

#[cfg(test)]
impl ReducedTest {
    /// The bounds for |s| ≤ `h`, whether or not they prove anything, the series being made anew.
    pub fn bounds_at(&mut self, equations: &Equations, tube: &mut Tubes, h: f64) -> Option<Bounds> {
        let (width, series) = (tube.local.y.elimination.reduced.width, &mut self.series);
        with_width!(width, series.make(equations, &mut tube.local));
        let bounds = with_width!(width, self.bounds(equations, tube, h))?;
        let n = equations.n();
        tube.weights[..n].copy_from_slice(&self.shape.omega[..n]);
        Some(bounds)
    }

    /// The weights of the unknowns, for what is proved next.
    pub fn weights_mut(&mut self) -> &mut Vector {
        &mut self.shape.weights
    }

    /// How fast extents change in a box so many times as large as that of the last bounds.
    pub fn speed_in(&self, tube: &Tubes, factor: f64) -> f64 {
        let (y, b) = (&tube.local.y, &self.last);
        let rho: Vec<f64> = y.rho.iter().map(|rho| factor * rho).collect();
        let bounds = Bounds {
            low_slope: b.low_slope / factor,
            high: b.high / factor,
            ..*b
        };
        let slope_of = |i: usize| self.along.slope_of(&tube.local, i);
        let speed = match y.elimination.reduced.width {
            1 => speed::<1>(y, &rho, &bounds, slope_of),
            2 => speed::<2>(y, &rho, &bounds, slope_of),
            3 => speed::<3>(y, &rho, &bounds, slope_of),
            4 => speed::<4>(y, &rho, &bounds, slope_of),
            6 => speed::<6>(y, &rho, &bounds, slope_of),
            _ => speed::<8>(y, &rho, &bounds, slope_of),
        };
        round_up(speed, y.resolvent.roundings() + 1000)
    }
}

impl ReducedTest {
    /// The length for which bounds are taken first.
    fn first_length(&self, tube: &Tubes, max_h: f64) -> f64 {
        let reach = reach(&tube.local) / self.reach;
        (GROWTH * self.expected * reach.clamp(1.0 / CHANGE, CHANGE))
            .min(max_h)
            .min(LONGEST)
    }
}

/// How far a polynomial is of use: where its last coefficients become as large as its first, in floats.
/// The lengths of tubes are nearly in proportion.
fn reach(local: &Locals) -> f64 {
    let size = |k: usize| local.z[k].iter().fold(0.0f64, |max, x| max.max(x.abs()));
    let first = size(1);
    let of = |k: usize| (first / size(k)).powf(1.0 / (k as f64 - 1.0));
    of(ORDER).min(of(ORDER - 1)).clamp(1e-30, 1e30)
}
