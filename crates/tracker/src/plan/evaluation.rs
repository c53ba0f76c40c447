//! Evaluating a plan on a branch: figure, removed constraints, and their derivatives.

use super::boundary::{gamma_three, gamma_two};
use super::vector::{V3, add_scaled, cross, dot, norm, scale, sub};
use super::{Arm, Lanes, Plan};
use crate::linalg::with_axes;
use crate::places::{Each as _, array};
use crate::system::Homotopy;

/// A plan made ready for evaluation, `[b]I` and `[b]H_R` of RR 8705, sections 2.3 and 3.2, with
/// room for all results, so that evaluating allocates nothing.
///
/// Parameters are `q = [t, k1, …, kd]`: the homotopy's t and the driving parameters. Points have
/// a coordinate per axis, in the homotopy's unit. The branch is a sign per instruction, read off a
/// figure by [`Evaluation::recover_branch`].
#[derive(Debug, Clone)]
pub struct Evaluation {
    pub(super) dimension: usize,
    pub(super) points: usize,
    pub(super) driving: usize,
    /// Groups of four parameters.
    pub(super) chunks: usize,
    pub(super) rows: Vec<Row>,
    removed: Vec<Removed>,
    /// For each driving parameter the point it drives (its reference point is
    /// `places[points + j]`).
    driven: Vec<usize>,
    /// The coefficients of a(t), for each distance.
    lengths: Vec<[f64; 3]>,
    /// Pairs of distances whose order condition (sc1) watches: the kept one and the one replaced.
    ordered: Vec<(usize, usize)>,
    alpha_squared: f64,
    t: f64,
    /// The coordinates of the points, then of the reference points.
    pub(super) places: Vec<f64>,
    /// Squares of the lengths, then of the driving parameters.
    squared: Vec<f64>,
    /// Half the derivatives of the squares: a a' by t, k by k.
    slope: Vec<f64>,
    pub(super) residual: Vec<f64>,
    /// ∂(point)/∂q, `chunks` for all axes to a point and to a reference point (those are zero).
    pub(super) sensitivity: Vec<Lanes>,
    /// ∂(residual)/∂q, `chunks` to a removed constraint.
    pub(super) jacobian: Vec<Lanes>,
    near: bool,
}

/// An instruction with everything as indices.
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub(super) point: usize,
    arity: usize,
    centres: [usize; 3],
    radii: [usize; 3],
    /// The parameter of each radius: 0 for t.
    pub(super) lanes: [usize; 3],
    /// Groups of parameters that this point or an earlier one depends on.
    chunks: usize,
    sign: f64,
}

#[derive(Debug, Clone)]
struct Removed {
    points: [usize; 2],
    edge: usize,
}

impl Evaluation {
    /// Prepares a plan, with all signs of the branch positive; `alpha` is the threshold that
    /// [`Evaluation::is_near_boundary`] tells of.
    pub fn new(homotopy: &Homotopy, plan: &Plan, alpha: f64) -> Self {
        let mut evaluation = Evaluation {
            dimension: homotopy.dimension,
            points: plan.points,
            driving: 0,
            chunks: 0,
            rows: Vec::new(),
            removed: Vec::new(),
            driven: Vec::new(),
            lengths: homotopy.lengths.iter().map(|l| l.a).collect(),
            ordered: Vec::new(),
            alpha_squared: alpha * alpha,
            t: 0.0,
            places: Vec::new(),
            squared: Vec::new(),
            slope: Vec::new(),
            residual: Vec::new(),
            sensitivity: Vec::new(),
            jacobian: Vec::new(),
            near: false,
        };
        evaluation.rebuild(homotopy, plan);
        evaluation
    }

    /// Takes over a changed plan. Figure and branch are to be set anew.
    pub fn rebuild(&mut self, homotopy: &Homotopy, plan: &Plan) {
        let m = plan.edges;
        let d = plan.driving();
        self.driving = d;
        self.chunks = (d + 1).div_ceil(4);
        self.driven.clear();
        self.places.clear();
        let axes = self.dimension;
        self.places.resize((plan.points + d) * axes, 0.0);
        self.rows.clear();
        self.ordered.clear();
        let mut used = vec![false; m];
        for instruction in &plan.instructions {
            let mut row = Row {
                point: instruction.point,
                arity: instruction.arity,
                centres: [0; 3],
                radii: [0; 3],
                lanes: [0; 3],
                chunks: 0,
                sign: 1.0,
            };
            for (k, arm) in instruction.arms().iter().enumerate() {
                match *arm {
                    Arm::Edge { centre, edge } => {
                        row.centres[k] = centre;
                        row.radii[k] = edge;
                        used[edge] = true;
                    }
                    Arm::Driving { place } => {
                        let j = self.driven.len();
                        row.centres[k] = plan.points + j;
                        row.radii[k] = m + j;
                        row.lanes[k] = j + 1;
                        let at = (plan.points + j) * axes;
                        self.places[at..at + axes].copy_from_slice(&place[..axes]);
                        self.driven.push(instruction.point);
                    }
                }
            }
            row.chunks = (self.driven.len() + 1).div_ceil(4);
            if let (Some(Arm::Edge { edge: original, .. }), Arm::Edge { edge, .. }) =
                (instruction.original[0], instruction.arms[0])
            {
                self.ordered.push((edge, original));
            }
            self.rows.push(row);
        }
        self.removed.clear();
        self.removed
            .extend((0..m).filter(|&e| !used[e]).map(|edge| Removed {
                points: homotopy.edges[edge].points,
                edge,
            }));
        self.squared.resize(m + d, 0.0);
        self.slope.resize(m + d, 0.0);
        self.residual.clear();
        self.residual.resize(self.removed.len(), 0.0);
        self.sensitivity.clear();
        self.sensitivity
            .resize((plan.points + d) * self.chunks * axes, Lanes::ZERO);
        self.jacobian.clear();
        self.jacobian
            .resize(self.removed.len() * self.chunks, Lanes::ZERO);
    }

    /// The number d of driving parameters, which is that of removed constraints.
    pub fn driving(&self) -> usize {
        self.driving
    }

    /// Groups of four parameters: `(d + 1) / 4`, rounded up.
    pub fn chunks(&self) -> usize {
        self.chunks
    }

    /// The figure of the last evaluation: the coordinates of all points.
    pub fn figure(&self) -> &[f64] {
        &self.places[..self.points * self.dimension]
    }

    /// The removed constraints at the last evaluation, `½(|p_i − p_j|² − a²)`.
    pub fn residual(&self) -> &[f64] {
        &self.residual
    }

    /// Derivatives of the removed constraints by `q`, `chunks` groups to a constraint.
    pub fn jacobian(&self) -> &[Lanes] {
        &self.jacobian
    }

    /// Derivatives of all places by `q`: `chunks` groups to a point, one for each axis in a group.
    pub fn sensitivity(&self) -> &[Lanes] {
        &self.sensitivity[..self.points * self.chunks * self.dimension]
    }

    /// Whether γ ≤ alpha for some instruction at the last evaluation.
    pub fn is_near_boundary(&self) -> bool {
        self.near
    }

    /// Condition (sc1): whether a replaced distance has become longer than the one that was kept
    /// (RR 8705, section 4.3.2), at the last evaluation.
    pub fn is_out_of_order(&self) -> bool {
        self.ordered
            .iter()
            .any(|&(kept, replaced)| self.squared[replaced] > self.squared[kept])
    }

    /// ϕ' of RR 8705, (4): the parameters of a figure. Written to `q[..=d]`.
    pub fn parameters(&self, figure: &[f64], t: f64, q: &mut [f64]) {
        q[0] = t;
        with_axes!(self.dimension, D => {
            let references = self.places.as_chunks::<D>().0[self.points..].iter();
            let figure = figure.as_chunks::<D>().0;
            for ((&p, &reference), q) in self.driven.iter().zip(references).zip(&mut q[1..]) {
                *q = norm(sub(figure[p], reference));
            }
        });
    }

    /// Reads the branch off a figure, that is, on which side of the line or plane of the centres
    /// each point is (RR 8705, Algorithm 1, steps 2 and 13).
    pub fn recover_branch(&mut self, figure: &[f64]) {
        self.places[..figure.len()].copy_from_slice(figure);
        with_axes!(self.dimension, D => self.recover_branch_in::<D>());
    }

    fn recover_branch_in<const D: usize>(&mut self) {
        let places = self.places.as_chunks::<D>().0;
        for row in &mut self.rows {
            let p = places[row.point];
            let c = row.centres.each(|c| places[c]);
            let side = match row.arity {
                1 => p[0],
                2 => side_of_line(p, c[0], c[1]),
                _ => {
                    let [u, e, f] = [sub(p, c[0]), sub(c[1], c[0]), sub(c[2], c[0])].each(spatial);
                    dot(cross(e, f), u)
                }
            };
            row.sign = if side < 0.0 { -1.0 } else { 1.0 };
        }
    }

    /// Evaluates figure and removed constraints at `q`. False where the figure does not exist:
    /// `q` is outside the branch's domain.
    pub fn evaluate(&mut self, q: &[f64]) -> bool {
        self.set_time(q[0]);
        for (j, &k) in q[1..=self.driving].iter().enumerate() {
            self.set_driving(j, k);
        }
        self.construct(0)
    }

    /// Sets t, and with it all lengths.
    pub(super) fn set_time(&mut self, t: f64) {
        self.t = t;
        for (a, squared) in self.lengths.iter().zip(&mut self.squared) {
            let length = t.mul_add(t.mul_add(a[2], a[1]), a[0]);
            *squared = length * length;
        }
    }

    /// Sets driving parameter `j`, counted from 0.
    pub(super) fn set_driving(&mut self, j: usize, k: f64) {
        let at = self.lengths.len() + j;
        self.squared[at] = k * k;
        self.slope[at] = k;
    }

    /// Carries out the instructions from the given one on, and evaluates the removed constraints.
    pub(super) fn construct(&mut self, from: usize) -> bool {
        with_axes!(self.dimension, D => self.construct_in::<D>(from))
    }

    fn construct_in<const D: usize>(&mut self, from: usize) -> bool {
        let places = self.places.as_chunks_mut::<D>().0;
        // How far the square of half the distance of the two intersections is above 0, and how
        // far γ² is above α² (times something positive).
        let (mut domain, mut clear) = (f64::INFINITY, f64::INFINITY);
        let alpha = self.alpha_squared;
        for row in &self.rows[from..] {
            let place = match row.arity {
                3 => {
                    let c1 = spatial(places[row.centres[0]]);
                    let c2 = spatial(places[row.centres[1]]);
                    let c3 = spatial(places[row.centres[2]]);
                    let r1 = self.squared[row.radii[0]];
                    let r2 = self.squared[row.radii[1]];
                    let r3 = self.squared[row.radii[2]];
                    let (e, f) = (sub(c2, c1), sub(c3, c1));
                    let (ee, ef, ff) = (dot(e, e), dot(e, f), dot(f, f));
                    // p = c1 + x e + y f + z e × f, from p·e and p·f (seen from c1).
                    let pe = 0.5 * (r1 - r2 + ee);
                    let pf = 0.5 * (r1 - r3 + ff);
                    let det = ee.mul_add(ff, -(ef * ef));
                    let per_det = 1.0 / det;
                    let x = ff.mul_add(pe, -(ef * pf)) * per_det;
                    let y = ee.mul_add(pf, -(ef * pe)) * per_det;
                    // Squares: the height above the plane of the centres; ee times the radius
                    // of the circle of interSS.
                    let hh = x.mul_add(-pe, y.mul_add(-pf, r1));
                    let circle = r1.mul_add(ee, -(pe * pe));
                    domain = domain.min(hh);
                    clear = clear
                        .min((-alpha).mul_add(r1.max(r2) * ee.max(r1.min(r2)), circle))
                        .min((-alpha).mul_add(circle.max(r3 * ee), hh * ee))
                        .min((-alpha).mul_add(r3 * circle, hh * det));
                    let z = row.sign * (hh * per_det).sqrt();
                    let p = add_scaled(add_scaled(c1, x, e), y, f);
                    narrow(add_scaled(p, z, cross(e, f)))
                }
                2 => {
                    let (c1, c2) = (places[row.centres[0]], places[row.centres[1]]);
                    let (r1, r2) = (self.squared[row.radii[0]], self.squared[row.radii[1]]);
                    let e = [c2[0] - c1[0], c2[1] - c1[1]];
                    let ee = dot(e, e);
                    let pe = 0.5 * (r1 - r2 + ee);
                    let per_ee = 1.0 / ee;
                    let x = pe * per_ee;
                    let hh = (-pe).mul_add(x, r1);
                    domain = domain.min(hh);
                    clear = clear.min((-alpha).mul_add(r1.max(r2) * ee.max(r1.min(r2)), hh * ee));
                    let z = row.sign * (hh * per_ee).sqrt();
                    let p = add_scaled(add_scaled([c1[0], c1[1]], x, e), z, [-e[1], e[0]]);
                    array(|k| if k < 2 { p[k] } else { 0.0 })
                }
                _ => {
                    let x = row.sign * self.squared[row.radii[0]].sqrt();
                    array(|k| if k == 0 { x } else { 0.0 })
                }
            };
            places[row.point] = place;
        }
        for (removed, residual) in self.removed.iter().zip(&mut self.residual) {
            let u = sub(places[removed.points[0]], places[removed.points[1]]);
            *residual = 0.5 * (dot(u, u) - self.squared[removed.edge]);
        }
        self.near = clear <= 0.0;
        domain > 0.0
    }

    /// Derivatives of figure and removed constraints at the last evaluation, by forward
    /// differentiation along the plan. A point is differentiated only by those groups of
    /// parameters that occur up to it (compare RR 8705, section 7.2).
    ///
    /// From `|p − c_i|² = r_i²` follows `(p − c_i)·(dp − dc_i) = r_i dr_i`, one small linear system
    /// per point whose matrix is the same for all parameters.
    pub fn differentiate(&mut self) {
        with_axes!(self.dimension, D => self.differentiate_in::<D>());
    }

    fn differentiate_in<const D: usize>(&mut self) {
        let places = self.places.as_chunks::<D>().0;
        let sensitivities = self.sensitivity.as_chunks_mut::<D>().0;
        let t = self.t;
        for (a, slope) in self.lengths.iter().zip(&mut self.slope) {
            let length = t.mul_add(t.mul_add(a[2], a[1]), a[0]);
            *slope = length * (2.0 * t).mul_add(a[2], a[1]);
        }
        let chunks = self.chunks;
        for row in &self.rows {
            let p = places[row.point];
            let at = row.point * chunks;
            match row.arity {
                3 => {
                    let u0 = spatial(sub(p, places[row.centres[0]]));
                    let u1 = spatial(sub(p, places[row.centres[1]]));
                    let u2 = spatial(sub(p, places[row.centres[2]]));
                    let w0 = cross(u1, u2);
                    let per_det = 1.0 / dot(u0, w0);
                    let u = [u0, u1, u2];
                    let w = [
                        scale(per_det, w0),
                        scale(per_det, cross(u2, u0)),
                        scale(per_det, cross(u0, u1)),
                    ];
                    for chunk in 0..row.chunks {
                        let mut out = [Lanes::ZERO; D];
                        for k in 0..3 {
                            let centre = &sensitivities[row.centres[k] * chunks + chunk];
                            let mut right = radius(row.lanes[k], self.slope[row.radii[k]], chunk);
                            for axis in 0..D {
                                right = right.plus(u[k][axis], centre[axis]);
                            }
                            for (axis, out) in out.iter_mut().enumerate() {
                                *out = out.plus(w[k][axis], right);
                            }
                        }
                        sensitivities[at + chunk] = out;
                    }
                }
                2 => {
                    let u: [_; 2] = array(|k| sub(p, places[row.centres[k]]));
                    let per_det = 1.0 / (u[0][0] * u[1][1] - u[0][1] * u[1][0]);
                    let w = [
                        [u[1][1] * per_det, -u[1][0] * per_det],
                        [-u[0][1] * per_det, u[0][0] * per_det],
                    ];
                    for chunk in 0..row.chunks {
                        let mut out = [Lanes::ZERO; D];
                        for k in 0..2 {
                            let centre = &sensitivities[row.centres[k] * chunks + chunk];
                            let right = radius(row.lanes[k], self.slope[row.radii[k]], chunk)
                                .plus(u[k][0], centre[0])
                                .plus(u[k][1], centre[1]);
                            out[0] = out[0].plus(w[k][0], right);
                            out[1] = out[1].plus(w[k][1], right);
                        }
                        sensitivities[at + chunk] = out;
                    }
                }
                _ => {
                    let slope = self.slope[row.radii[0]] / p[0];
                    for chunk in 0..row.chunks {
                        sensitivities[at + chunk][0] = radius(row.lanes[0], slope, chunk);
                    }
                }
            }
        }
        for (removed, jacobian) in self
            .removed
            .iter()
            .zip(self.jacobian.chunks_exact_mut(chunks))
        {
            let [i, j] = removed.points;
            let u = sub(places[i], places[j]);
            for (chunk, out) in jacobian.iter_mut().enumerate() {
                let (si, sj) = (
                    &sensitivities[i * chunks + chunk],
                    &sensitivities[j * chunks + chunk],
                );
                let mut sum = radius(0, -self.slope[removed.edge], chunk);
                for axis in 0..D {
                    sum = sum.plus(u[axis], si[axis].minus(sj[axis]));
                }
                *out = sum;
            }
        }
    }

    /// The smallest γ over all instructions at the last evaluation (RR 8705, section 4.2).
    pub fn gamma(&self) -> f64 {
        let place = |at: usize| -> V3 {
            let place = self.places[at * self.dimension..].iter();
            let mut axes = place.take(self.dimension);
            array(|_| axes.next().copied().unwrap_or(0.0))
        };
        self.rows.iter().fold(1.0, |least, row| {
            let p = place(row.point);
            let c = row.centres.each(place);
            match row.arity {
                1 => least,
                2 => least.min(gamma_two(p, c[0], c[1])),
                _ => least
                    .min(gamma_two(p, c[0], c[1]))
                    .min(gamma_three(p, c[0], c[1], c[2])),
            }
        })
    }

    /// The figure's derivative along `direction` in the parameters (`chunks` groups, zero beyond
    /// d): ∂I/∂(A+, t) · direction, written to `out`, all coordinates.
    pub fn lift(&self, direction: &[Lanes], out: &mut [f64]) {
        with_axes!(self.dimension, D => self.lift_in::<D>(direction, out));
    }

    fn lift_in<const D: usize>(&self, direction: &[Lanes], out: &mut [f64]) {
        let out = out.as_chunks_mut::<D>().0;
        let sensitivities = self.sensitivity.as_chunks::<D>().0;
        for (out, sensitivity) in out.iter_mut().zip(sensitivities.chunks_exact(self.chunks)) {
            let mut sum = [Lanes::ZERO; D];
            for (s, &x) in sensitivity.iter().zip(direction) {
                for axis in 0..D {
                    sum[axis] = sum[axis].plus_product(s[axis], x);
                }
            }
            for (out, sum) in out.iter_mut().zip(&sum) {
                *out = sum.sum();
            }
        }
    }

    /// Squares of the sizes of the figure's derivatives by each parameter, t counted in.
    pub fn column_sizes(&self, out: &mut [Lanes]) {
        out.fill(Lanes::ZERO);
        let axes = self.dimension;
        for sensitivity in self.sensitivity().chunks_exact(self.chunks * axes) {
            for (s, out) in sensitivity.chunks_exact(axes).zip(out.iter_mut()) {
                for &s in s {
                    *out = out.plus_product(s, s);
                }
            }
        }
        out[0].0[0] += 1.0;
    }
}

/// The right-hand side r dr of one arm, in the lane of its parameter.
#[inline(always)]
fn radius(lane: usize, slope: f64, chunk: usize) -> Lanes {
    if lane / 4 == chunk {
        Lanes::UNIT[lane % 4].times(slope)
    } else {
        Lanes::ZERO
    }
}

/// A vector of the plane or of space, in space.
#[inline(always)]
fn spatial<const D: usize>(v: [f64; D]) -> [f64; 3] {
    [v[0], v[1], if D == 3 { v[2] } else { 0.0 }]
}

#[inline(always)]
fn narrow<const D: usize>(v: [f64; 3]) -> [f64; D] {
    array(|k| v[k])
}

fn side_of_line<const D: usize>(p: [f64; D], c1: [f64; D], c2: [f64; D]) -> f64 {
    let (u, e) = (sub(p, c1), sub(c2, c1));
    e[0] * u[1] - e[1] * u[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::testing::{rigid, shipped};
    use crate::plan::{Differences, Situation};
    use crate::problem::Problem;
    use proptest::prelude::*;

    /// A plan that is far enough from boundary configurations in the sketch, evaluated there.
    fn at_sketch(problem: &Problem, alpha: f64) -> (Homotopy, Plan, Evaluation, Vec<f64>) {
        let homotopy = Homotopy::new(problem).unwrap();
        let mut plan = Plan::derive(&homotopy);
        let lengths: Vec<f64> = homotopy.lengths.iter().map(|l| l.value(0.0)).collect();
        let figure = &homotopy.sketch;
        plan.change(&Situation {
            figure,
            ahead: None,
            lengths: &lengths,
            alpha,
            restore: 1.0,
        });
        let (evaluation, q) = evaluated(&homotopy, &plan, alpha);
        (homotopy, plan, evaluation, q)
    }

    fn evaluated(homotopy: &Homotopy, plan: &Plan, alpha: f64) -> (Evaluation, Vec<f64>) {
        let mut evaluation = Evaluation::new(homotopy, plan, alpha);
        evaluation.recover_branch(&homotopy.sketch);
        let mut q = vec![0.0; evaluation.driving() + 1];
        evaluation.parameters(&homotopy.sketch, 0.0, &mut q);
        assert!(evaluation.evaluate(&q));
        (evaluation, q)
    }

    fn is_sketch(homotopy: &Homotopy, evaluation: &Evaluation) -> bool {
        let off = homotopy
            .sketch
            .iter()
            .zip(evaluation.figure())
            .fold(0.0f64, |off, (a, b)| off.max((a - b).abs()));
        off < 1e-10 && evaluation.residual().iter().all(|r| r.abs() < 1e-10)
    }

    fn check(problem: &Problem) {
        let (homotopy, mut plan, mut evaluation, q) = at_sketch(problem, 0.3);
        assert!(
            is_sketch(&homotopy, &evaluation),
            "the branch through the sketch gives the sketch"
        );
        assert!(evaluation.gamma() > 0.1 && !evaluation.is_near_boundary());

        // Exact derivatives against differences.
        evaluation.differentiate();
        let mut other = evaluation.clone();
        assert!(other.difference(&q, 1e-7, &mut Differences::default()));
        // Differences are off by their step times second derivatives, which grow along the plan
        // like squares of first derivatives.
        let agree = |exact: &[Lanes], other: &[Lanes]| {
            let size = exact
                .iter()
                .flat_map(|x| x.0)
                .fold(1.0, |size: f64, x| size.max(x.abs()));
            let mut both = exact
                .iter()
                .zip(other)
                .flat_map(|(a, b)| a.0.into_iter().zip(b.0));
            both.all(|(a, b)| (a - b).abs() < 1e-6 * size * size)
        };
        assert!(agree(evaluation.jacobian(), other.jacobian()));
        let flat = |e: &Evaluation| e.sensitivity().to_vec();
        assert!(agree(&flat(&evaluation), &flat(&other)));

        // Replacing every instruction there is and restoring all of them keeps the figure.
        let original = plan.clone();
        let lengths: Vec<f64> = homotopy.lengths.iter().map(|l| l.value(0.0)).collect();
        let at = Situation {
            figure: &homotopy.sketch,
            ahead: None,
            lengths: &lengths,
            alpha: 0.7,
            restore: 1.0,
        };
        plan.change(&at);
        let (replaced, _) = evaluated(&homotopy, &plan, 0.1);
        assert!(replaced.gamma() > 0.7 - 1e-9, "{}", replaced.gamma());
        assert!(is_sketch(&homotopy, &replaced));
        assert!(plan.driving() >= original.driving() && plan.driving() == plan.removed().len());
        let restoring = Situation {
            alpha: 0.0,
            restore: 0.0,
            ..at
        };
        plan.change(&restoring);
        assert!(plan.is_original());
        assert_eq!(plan.driving(), Plan::derive(&homotopy).driving());
        if homotopy.dimension == 3 {
            let (restored, _) = evaluated(&homotopy, &plan, 0.1);
            assert!(is_sketch(&homotopy, &restored));
        }
    }

    #[test]
    fn figures_and_derivatives_of_the_shipped_problems() {
        check(&shipped("octahedron"));
        check(&shipped("disulfide"));
        check(&shipped("icosahedron"));
        check(&shipped("dodecagon"));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn figures_and_derivatives_in_the_plane(problem in rigid(2, 4..12)) {
            at_sketch(&problem, 0.1);
            let (homotopy, _, evaluation, _) = at_sketch(&problem, 0.1);
            prop_assert!(is_sketch(&homotopy, &evaluation));
            prop_assert!(evaluation.gamma() > 0.1 && !evaluation.is_near_boundary());
        }

        #[test]
        fn figures_and_derivatives_in_space(problem in rigid(3, 5..12)) {
            let (homotopy, _, evaluation, _) = at_sketch(&problem, 0.1);
            prop_assert!(is_sketch(&homotopy, &evaluation));
            prop_assert!(evaluation.gamma() > 0.1 && !evaluation.is_near_boundary());
        }
    }
}
