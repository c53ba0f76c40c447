//! That two tubes hold the same piece of path, followed in the same direction.

use super::proof::Proof;
use crate::interval::rounding::{gamma, largest, round_up};
use crate::interval::{Interval, hull, point};
use crate::linalg::{LANE, Matrix, Vector, dot};
use crate::places::{Each as _, array};
use crate::track::arc::Figure;
use crate::track::events::TimeAlong;
use crate::track::full::{Equations, Local, ORDER, Preconditioner};

/// What a preconditioner knows of the box in which a tube was proved.
pub trait Frame: Preconditioner {
    /// By how much the box around ẑ(s), whose size is 1, must be scaled to hold a point, rounded up: `entry`
    /// tells, for each index once and in their order, how far it is from ẑ(s), and the error of that;
    /// `known` tells the same of any index at any time. `weights` are the tube's.
    fn extent(
        &self,
        weights: &[f64],
        s: f64,
        known: impl Fn(usize) -> (f64, f64),
        entry: impl FnMut(usize) -> (f64, f64),
    ) -> f64;

    /// A bound on how fast the extent of a fixed point changes with s.
    fn speed(&self, proof: &Proof) -> f64;
}

/// In the full space the box is |w|_u ≤ 1.
impl Frame for Matrix {
    #[inline(always)]
    fn extent(
        &self,
        weights: &[f64],
        _: f64,
        _: impl Fn(usize) -> (f64, f64),
        mut entry: impl FnMut(usize) -> (f64, f64),
    ) -> f64 {
        let mut widest = 0.0f64;
        for (i, weight) in weights.iter().enumerate() {
            let (away, error) = entry(i);
            let ratio = (away.abs() + error) / weight;
            widest = largest(widest, ratio);
        }
        // A sum and a division.
        round_up(widest, 2)
    }

    fn speed(&self, proof: &Proof) -> f64 {
        proof.slope
    }
}

/// A proved tube: for every |s| ≤ h exactly one point of the path in the cross-section through
/// ẑ(s), in the box around it that is the frame's scaled by r.
#[derive(Debug, Clone)]
pub struct Tube<const N: usize = { ORDER + 1 }, Y = Matrix> {
    /// The polynomial ẑ with its normal and preconditioner.
    pub local: Local<N, Y>,
    /// The weights u of the norm in which distances are stated. The box is in |w|_u ≤ r.
    pub weights: Vector,
    /// What is proved.
    pub proof: Proof,
    /// The path goes out at this parameter, at the point in this box.
    pub exit_at: f64,
    /// See `exit_at`.
    pub exit: Ball,
    /// The parameter of the point in that box is between these: `exit_at`, or a little before.
    pub exit_between: (f64, f64),
    /// Whether that box is as small as floats allow.
    pub exit_is_tight: bool,
    /// If so, the path's tangent there, in the tube's direction, up to `exit_slope_radius` in |·|_u.
    pub exit_slope: Vector,
    /// See `exit_slope`.
    pub exit_slope_radius: f64,
    /// The path comes in at a parameter in this range.
    pub entry: (f64, f64),
}

/// A box: a point and how far the exact one may be away, entry by entry.
#[derive(Debug, Clone)]
pub struct Ball {
    /// The middle.
    pub centre: Vector,
    /// The low words of the middle in extended precision (it is `centre` + `low`); otherwise zero.
    pub low: Vector,
    /// The radius of each entry.
    pub radius: Vector,
}

impl Ball {
    /// Room for a box of the problem's points.
    pub fn new(equations: &Equations) -> Self {
        Ball {
            centre: equations.vector(),
            low: equations.vector(),
            radius: equations.vector(),
        }
    }

    /// Becomes another box, of as many entries.
    pub fn copy_from(&mut self, other: &Self) {
        self.centre.copy_from_slice(&other.centre);
        self.low.copy_from_slice(&other.low);
        self.radius.copy_from_slice(&other.radius);
    }

    /// Becomes the box of a figure and of t.
    pub fn hold(&mut self, figure: &Figure, t: Interval) {
        let m = figure.centre.len();
        self.centre[..m].copy_from_slice(&figure.centre);
        self.low[..m].copy_from_slice(&figure.low);
        self.radius[..m].copy_from_slice(&figure.radius);
        (self.centre[m], self.low[m], self.radius[m]) = (t.mid(), 0.0, t.rad());
    }

    /// An entry.
    pub fn enclosure(&self, entry: usize) -> Interval {
        let radius = self.radius[entry];
        point(self.centre[entry]) + point(self.low[entry]) + hull(-radius, radius)
    }

    /// Whether the middle has more digits than floats have.
    pub fn is_extended(&self) -> bool {
        self.low.iter().any(|&x| x != 0.0)
    }
}

/// More roundings than there are in the evaluation at a point of ẑ or ẑ' with N coefficients.
const fn evaluation(coefficients: usize) -> usize {
    4 * coefficients
}

impl<const N: usize, Y: Frame> Tube<N, Y> {
    /// Room for a tube.
    pub fn new(equations: &Equations) -> Self {
        Tube {
            local: Local::new(equations),
            weights: equations.vector(),
            proof: Proof::default(),
            exit_at: 0.0,
            exit: Ball::new(equations),
            exit_between: (0.0, 0.0),
            exit_is_tight: false,
            exit_slope: equations.vector(),
            exit_slope_radius: f64::INFINITY,
            entry: (0.0, 0.0),
        }
    }

    /// Makes a box around the exit's middle, which has this extent from ẑ, of so large a radius in |·|_u: the path's point in
    /// the cross-section at `exit_at` is proved to be that near. `None`: either reaches out of the tube.
    #[inline(always)]
    pub fn hold_exit(&mut self, extent: f64, radius: f64) -> Option<()> {
        let r = self.proof.r;
        if !(extent < r && radius < r) {
            return None;
        }
        let n = self.weights.len() - 1;
        for (out, u) in self.exit.radius[..n].iter_mut().zip(self.weights.iter()) {
            *out = round_up(radius * u, 1);
        }
        self.exit_between = (self.exit_at, self.exit_at);
        Some(())
    }

    /// Proves that a point of H⁻¹(0) known to lie in `ball` is the path's point in one of this
    /// tube's cross-sections, and encloses its parameter. `None`: it could not be proved.
    ///
    /// For the point z let g(s) = c·(z − ẑ(s)). Around the parameter s̃ of the ball's middle, g
    /// changes sign within ω = |g(s̃)| / min c·ẑ'; there z is in a cross-section, and if its
    /// distance from ẑ is below r it is the cross-section's only zero.
    pub fn locate(&self, ball: &Ball) -> Option<(f64, f64)> {
        let proof = &self.proof;
        let s = self.parameter_near(ball);
        if s.is_nan() || s.abs() > proof.h {
            return None;
        }
        let (omega, width) = self.spread(ball, s)?;
        (round_up(s.abs() + omega, 2) <= proof.h && width < proof.r)
            .then(|| ((s - omega).next_down(), (s + omega).next_up()))
    }

    /// Whether the cross-section through the middle of a ball may be one of the tube's: no proof.
    pub fn reaches(&self, ball: &Ball) -> bool {
        self.parameter_near(ball).abs() < self.proof.h
    }

    /// For a ball with its middle near the cross-section of `s`: how far from s its points may be along
    /// the tube, and from the tube's middle in the norm of the box.
    #[inline(always)]
    pub fn spread(&self, ball: &Ball, s: f64) -> Option<(f64, f64)> {
        let n = self.weights.len() - 1;
        let (local, proof) = (&self.local, &self.proof);
        let radius = |i: usize| ball.radius[i];
        let (along, error, extent) = from_middle(local, &self.weights[..n], s, ball, radius);
        let omega = round_up((along.abs() + error) / self.least_advance()?, 4);
        let width = round_up(extent + omega * local.y.speed(proof), 4);
        Some((omega, width))
    }

    /// The parameter at which a ball's middle is in the cross-section, but for rounding.
    pub fn parameter_near(&self, ball: &Ball) -> f64 {
        let (local, n) = (&self.local, self.weights.len() - 1);
        let c = &local.normal[..n];
        let s = local.parameter_of(&ball.centre);
        if local.is_extended {
            s + (dot(c, &ball.low[..n]) - dot(c, &local.low[..n]))
        } else {
            s
        }
    }

    /// A lower bound of c·ẑ'(s) on the tube. It is near 1; less than ½ is refused.
    pub fn least_advance(&self) -> Option<f64> {
        let n = self.weights.len() - 1;
        let h = self.proof.h;
        let c = &self.local.normal[..n];
        let (mut power, mut least) = (1.0, 0.0);
        for k in 1..N {
            let z = &self.local.z[k][..n];
            let (sum, size) = dot_with_size(c, z);
            let sideways = (sum - if k == 1 { 1.0 } else { 0.0 }).abs() + gamma(n + 2) * size;
            least += k as f64 * power * sideways;
            power *= h;
        }
        let least = 1.0 - round_up(least, n + 40);
        (least > 0.5).then_some(least)
    }

    /// Proves that the path's tangent, at some parameter between those given, taken in this tube's
    /// direction, has a positive component along `normal`: a tube with that normal is followed
    /// the same way.
    pub fn goes_along(&self, between: (f64, f64), normal: &[f64]) -> bool {
        let n = self.weights.len() - 1;
        let s = 0.5 * (between.0 + between.1);
        let off = (between.1 - between.0).abs();
        // |ẑ''| ≤ N/h times the sum that bounds |ẑ'|, which is `slope` in the norm.
        let turn = off * (N as f64 / self.proof.h) * self.proof.slope;
        let (mut along, mut error) = (0.0, 0.0);
        let mut lane = ([0.0; LANE], [0.0; LANE]);
        for i in 0..n {
            if i % LANE == 0 {
                lane = self.local.lane_of_slope(i / LANE, s);
            }
            let (slope, size) = (lane.0[i % LANE], lane.1[i % LANE]);
            along += normal[i] * slope;
            let away = (self.proof.slope_distance + turn) * self.weights[i];
            error += normal[i].abs() * (away + gamma(evaluation(N) + n) * size);
        }
        along > round_up(error, n + evaluation(N))
    }

    /// t along the tube.
    pub fn time(&self) -> TimeAlong {
        self.time_if(&self.proof)
    }

    /// t along the tube if `proof` were what is proved.
    pub fn time_if(&self, proof: &Proof) -> TimeAlong {
        self.entry_if(proof, self.weights.len() - 2)
    }

    /// An unknown along the tube, in the place of t.
    pub fn entry_along(&self, unknown: usize) -> TimeAlong {
        self.entry_if(&self.proof, unknown)
    }

    fn entry_if(&self, proof: &Proof, i: usize) -> TimeAlong {
        // One rounding each, within what `TimeAlong` adds for its own.
        TimeAlong::with_low(
            &array::<_, N>(|k| self.local.z[k][i]),
            self.local.low[i],
            proof.h,
            round_up(proof.distance * self.weights[i], 1),
            round_up(proof.slope_distance * self.weights[i], 1),
        )
    }

    /// Proves that the path goes on from this tube into `next`: the point at `exit` of this tube
    /// is in `next` too, and both are followed the same way. Encloses the point's parameter in `next`.
    pub fn leads_to(&self, next: &Self) -> Option<(f64, f64)> {
        let entry = next.locate(&self.exit)?;
        let normal = &next.local.normal;
        let same_way = self.goes_along(self.exit_between, normal)
            || self.exit_is_tight && self.exit_goes_along(normal);
        same_way.then_some(entry)
    }

    /// Proves, by the tangent's own enclosure, that the path's tangent at the exit, taken in this tube's
    /// direction, has a positive component along `normal`.
    fn exit_goes_along(&self, normal: &[f64]) -> bool {
        let n = self.weights.len() - 1;
        let (mut along, mut error) = (0.0, 0.0);
        for i in 0..n {
            let slope = self.exit_slope[i];
            along += normal[i] * slope;
            error += normal[i].abs()
                * (self.exit_slope_radius * self.weights[i] + gamma(n + 2) * slope.abs());
        }
        along > round_up(error, n + 8)
    }
}

/// How far a ball's middle is from ẑ(s) in a lane's entries, in floats, and the errors of that.
///
/// Both are seen from z₀: what is subtracted is small, and so is its rounding.
#[inline(always)]
pub fn offsets<const N: usize, Y: Preconditioner>(
    local: &Local<N, Y>,
    lane: usize,
    s: f64,
    ball: &Ball,
) -> ([f64; LANE], [f64; LANE]) {
    let (mut along, mut size) = ([0.0f64; LANE], [0.0f64; LANE]);
    for z in local.z[1..].iter().rev() {
        let z = &z.lanes()[lane];
        for i in 0..LANE {
            along[i] = along[i].mul_add(s, z[i]);
            size[i] = size[i].mul_add(s.abs(), z[i].abs());
        }
    }
    let [high, low] = [&ball.centre, &ball.low].each(|v| &v.lanes()[lane]);
    let [z_high, z_low] = [&local.z[0], &local.low].each(|v| &v.lanes()[lane]);
    let (mut away, mut error) = ([0.0; LANE], [0.0; LANE]);
    for i in 0..LANE {
        let (from_high, from_low) = (high[i] - z_high[i], low[i] - z_low[i]);
        away[i] = s.mul_add(-along[i], from_high + from_low);
        // One rounding in each difference, one in their sum, one at last.
        let size = size[i] * s.abs() + (from_high.abs() + from_low.abs());
        error[i] = round_up(gamma(evaluation(N)) * size, evaluation(N));
    }
    (away, error)
}

/// For w, how far the points of a ball, of the `radius` given by entry, are from ẑ(s): c·w at the ball's
/// middle, with the normal c; how far that may be off for any of them; and the extent of all of them. The
/// latter two are rounded up.
#[inline(always)]
pub fn from_middle<const N: usize, Y: Frame>(
    local: &Local<N, Y>,
    weights: &[f64],
    s: f64,
    ball: &Ball,
    radius: impl Fn(usize) -> f64,
) -> (f64, f64, f64) {
    let n = weights.len();
    let c = &local.normal[..n];
    let mut lane = ([0.0; LANE], [0.0; LANE]);
    let (mut along, mut along_error) = (0.0, 0.0);
    let known = |i: usize| {
        let (away, rounding) = offsets(local, i / LANE, s, ball);
        (away[i % LANE], rounding[i % LANE] + radius(i))
    };
    let extent = local.y.extent(weights, s, known, |i| {
        if i % LANE == 0 {
            lane = offsets(local, i / LANE, s, ball);
        }
        let (away, rounding) = (lane.0[i % LANE], lane.1[i % LANE]);
        let error = rounding + radius(i);
        along += c[i] * away;
        along_error += c[i].abs() * (error + gamma(n + 2) * away.abs());
        (away, error)
    });
    (along, round_up(along_error, n + 8), extent)
}

/// a·b and |a|·|b|, each in interleaved sums.
fn dot_with_size(a: &[f64], b: &[f64]) -> (f64, f64) {
    let (a4, a1) = a.as_chunks::<LANE>();
    let (b4, b1) = b.as_chunks::<LANE>();
    let (mut sums, mut sizes) = ([0.0f64; LANE], [0.0f64; LANE]);
    for (a, b) in a4.iter().zip(b4) {
        for i in 0..LANE {
            sums[i] = a[i].mul_add(b[i], sums[i]);
            sizes[i] = a[i].abs().mul_add(b[i].abs(), sizes[i]);
        }
    }
    let (mut sum, mut size): (f64, f64) = (sums.iter().sum(), sizes.iter().sum());
    for (a, b) in a1.iter().zip(b1) {
        sum = a.mul_add(*b, sum);
        size = a.abs().mul_add(b.abs(), size);
    }
    (sum, size)
}
