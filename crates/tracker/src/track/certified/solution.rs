//! Boxes around the points of the path with t = 1.

use super::figures::FigureBox;
use super::proof::zero_near;
use super::reasons::Doubt;
use crate::interval::rounding::{gamma, greatest, round_up};
use crate::interval::{Interval, ZERO, hull, point};
use crate::linalg::Vector;
use crate::system::{Homotopy, Located};
use crate::track::full::{Equations, InverseMaker, Local};

/// Whether two boxes hold the same solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Same {
    /// They do.
    Yes,
    /// They do not: the boxes are disjoint, also as they are printed.
    No,
    /// Neither could be proved.
    Unknown,
}

/// Work space for proving boxes.
#[derive(Debug)]
pub struct SolutionProver {
    local: Local,
    jacobian: Vec<f64>,
    ones: Vec<f64>,
    rounding: Vector,
    width: Vector,
    f: Vector,
    v: Vector,
    /// Where the boxes are: t = 1, or t = 0.
    t: f64,
    /// E(t) of every equation there.
    targets: Vec<Interval>,
    /// The box proved last.
    found: FigureBox,
}

impl SolutionProver {
    /// Work space for proving boxes around solutions of one problem, at t = 1.
    pub fn new(homotopy: &Homotopy, equations: &Equations) -> Self {
        let n = equations.n();
        SolutionProver {
            local: Local::new(equations),
            jacobian: vec![0.0; equations.bordered_pattern().entries()],
            ones: vec![1.0; n],
            rounding: equations.vector(),
            width: equations.vector(),
            f: equations.vector(),
            v: equations.vector(),
            t: 1.0,
            targets: homotopy.rights.iter().map(|e| e.at_target()).collect(),
            found: FigureBox::around(vec![ZERO; equations.m]),
        }
    }

    /// Work space for proving boxes around figures of one problem with t = 0, the equations being F(X, a(0)) = 0.
    /// Not in extended precision.
    pub fn at_start(homotopy: &Homotopy, equations: &Equations) -> Self {
        let zero = point(0.0);
        SolutionProver {
            t: 0.0,
            targets: homotopy.rights.iter().map(|e| e.enclose(zero)).collect(),
            ..Self::new(homotopy, equations)
        }
    }

    /// Takes other target lengths.
    pub fn set_targets(&mut self, homotopy: &Homotopy) {
        self.targets.clear();
        self.targets
            .extend(homotopy.rights.iter().map(|e| e.at_target()));
    }

    /// Proves a box around the solution near `guess`, the equations being F(X, a(1)) = 0.
    ///
    /// Krawczyk's test with the norm max |w_i|: with Y the inverse at the middle x,
    /// |I − Y J(x + w)| ≤ q₀ + κ |w|, so that there is at most one solution for |w| < (1 − q₀)/κ,
    /// and exactly one, at most |Y F(x)|/(1 − q) away, where that is small enough.
    ///
    /// `extended`: whether x and F(x) are to be taken in extended precision; everything else bears relative errors of 2⁻⁵³.
    pub fn prove(
        &mut self,
        equations: &Equations,
        inverter: &mut InverseMaker,
        guess: &[f64],
        extended: bool,
    ) -> Result<&FigureBox, Doubt> {
        let (m, n) = (equations.m, equations.n());
        let local = &mut self.local;
        local.z[0].copy_from_slice(guess);
        local.low.fill(0.0);
        local.is_extended = extended;
        // None may be made.
        local.first_correction = f64::INFINITY;
        let refined = if extended {
            local.refine_at_target(equations, inverter)
        } else {
            local.refine_at(equations, inverter, self.t)
        };
        if refined.is_none() {
            let first = local.first_correction;
            return Err(if first.is_finite() {
                Doubt::Newton(first)
            } else {
                Doubt::Singular(local.pivot_ratio(equations))
            });
        }

        let (q0, kappa) = self.contraction(equations);
        if !(q0 < 0.5 && kappa.is_finite()) {
            return Err(Doubt::Contraction(q0));
        }
        self.bound_residual(equations, extended);
        let local = &self.local;
        self.f[m] = 0.0;
        local.y.multiply_abs(&self.f[..m], &mut self.v);
        // The box itself, as it is printed, has to lie where its solution is alone.
        let printed = |all: f64| {
            let entry = |i: usize| all + outward(local.z[0][i], local.low[i], all);
            (0..m).fold(all, |max, i| max.max(entry(i)))
        };
        let test = (q0, kappa, 1e30);
        let (alone_within, radius) = zero_near(test, &self.v[..n], printed)?;
        let figure = &mut self.found.figure;
        for (r, v) in figure.radius.iter_mut().zip(self.v.iter()) {
            *r = radius(*v);
        }
        figure.centre.copy_from_slice(&local.z[0][..m]);
        figure.low.copy_from_slice(&local.low[..m]);
        self.found.alone_within = alone_within;
        Ok(&self.found)
    }

    /// q₀ and κ at the point of `local`.
    fn contraction(&mut self, equations: &Equations) -> (f64, f64) {
        let (m, n) = (equations.m, equations.n());
        let local = &self.local;
        // q₀: I − Y [J; e_t], and the rounding of its computation and of J's entries.
        let per_entry = gamma(equations.roundings().of_entry_at_point());
        let (rounding, width) = (&mut self.rounding, &mut self.width);
        for e in 0..m {
            let slope = local.lengths.terms[1][e].abs();
            let (size, change) = equations.sizes_at(e, &local.d[0], slope);
            rounding[e] = per_entry * size;
            width[e] = change;
        }
        rounding[m] = per_entry;
        // The entries of t multiply zero in the cross-section t = 1, whatever they are.
        equations.bordered_values(
            &local.d[0],
            &local.lengths,
            &local.normal,
            &mut self.jacobian,
        );
        let pattern = equations.bordered_pattern();
        local
            .y
            .identity_minus_sparse_abs(pattern, &self.jacobian, &self.ones, &mut self.v);
        let defect = greatest(&self.v[..n]);
        local.y.multiply_abs(&rounding[..n], &mut self.v);
        // The ones of I pass through as many sums as the products that they are added to.
        let q0 = round_up(
            defect + greatest(&self.v[..n]) + gamma(m + 4),
            equations.roundings().of_contraction_at_point(),
        );
        local.y.multiply_abs(&width[..m], &mut self.v);
        let kappa = round_up(
            greatest(&self.v[..n]),
            equations.roundings().of_width_at_point(),
        );
        (q0, kappa)
    }

    /// |F| at the point of `local`, with all that is not known of it, into `f`.
    fn bound_residual(&mut self, equations: &Equations, extended: bool) {
        let (m, local) = (equations.m, &self.local);
        // The residual in intervals or in extended precision: its width is what limits the box.
        if extended {
            let (z, error) = ((&local.z[0][..], &local.low[..]), &mut self.v);
            let precise = equations.in_extended();
            precise.residual_at_target(equations, z, &mut self.f, Some(error));
            for e in 0..m {
                self.f[e] = round_up(self.f[e].abs() + error[e], 1);
            }
        } else {
            for e in 0..m {
                let (left, _) = equations.enclose_left(e, &local.z[0], &local.z[0]);
                self.f[e] = (left - self.targets[e]).mag();
            }
        }
    }
}

impl FigureBox {
    /// The greatest distance of an entry of the middle from that of another box.
    pub(super) fn distance(&self, other: &FigureBox) -> f64 {
        let (one, other) = (&self.figure, &other.figure);
        let entry = |i: usize| {
            let (high, low) = (one.centre[i] - other.centre[i], one.low[i] - other.low[i]);
            (high + low).abs()
        };
        (0..one.centre.len()).map(entry).fold(0.0, f64::max)
    }

    /// The greatest radius of an entry.
    pub(super) fn greatest_radius(&self) -> f64 {
        let radii = self.figure.radius.iter();
        radii.fold(0.0, |a: f64, &b| a.max(b))
    }

    /// How far an entry reaches from the middle where the box is printed.
    fn reach(&self, i: usize) -> f64 {
        let of = &self.figure;
        of.radius[i] + outward(of.centre[i], of.low[i], of.radius[i])
    }

    /// Whether the other box holds the same solution, after changing the sign of this one's
    /// entries where `mirror` says so.
    pub(in crate::track) fn is_same(
        &self,
        other: &FigureBox,
        mirror: impl Fn(usize) -> bool,
    ) -> Same {
        let (one, two) = (&self.figure, &other.figure);
        let (mut inside, mut apart) = (true, false);
        for i in 0..one.centre.len() {
            let sign = if mirror(i) { -1.0 } else { 1.0 };
            let high = sign * one.centre[i] - two.centre[i];
            let low = sign * one.low[i] - two.low[i];
            let distance = (high + low).abs();
            // Each difference is rounded relatively to itself, then their sum: a factor covers them.
            let slack = 4.0 * f64::EPSILON * (high.abs() + low.abs() + distance);
            let radii = self.reach(i) + other.reach(i) + slack;
            apart |= distance > round_up(radii, 8);
            inside &= round_up(distance + one.radius[i] + slack, 4) < other.alone_within;
            if apart && !inside {
                break;
            }
        }
        match (inside, apart) {
            // One solution within `alone_within` of the other's middle, so both are that one.
            (true, _) => Same::Yes,
            (false, true) => Same::No,
            (false, false) => Same::Unknown,
        }
    }

    /// Whether none of the first unknowns, with some signs changed, is known to differ.
    pub(super) fn may_be(
        &self,
        other: &FigureBox,
        mirror: impl Fn(usize) -> bool,
        first: usize,
    ) -> bool {
        !(0..first).any(|i| self.differs(other, i, mirror(i)))
    }

    /// Whether an unknown, with its sign changed here if `mirror`, is known to differ.
    pub(super) fn differs(&self, other: &FigureBox, i: usize, mirror: bool) -> bool {
        let (one, two) = (&self.figure, &other.figure);
        let sign = if mirror { -1.0 } else { 1.0 };
        let distance = (sign * one.centre[i] - two.centre[i]).abs();
        let low = one.low[i].abs() + two.low[i].abs();
        // As in [`FigureBox::is_same`].
        let slack = 4.0 * f64::EPSILON * (distance + low);
        distance > round_up(self.reach(i) + other.reach(i) + low + slack, 8)
    }

    /// How far the exact solution may be from the upper words of the middle alone.
    pub(super) fn radius_of_centre(&self) -> Vec<f64> {
        let mut radius = self.figure.radius.clone();
        for (radius, low) in radius.iter_mut().zip(&self.figure.low) {
            if *low != 0.0 {
                *radius = round_up(*radius + low.abs(), 1);
            }
        }
        radius
    }

    /// The coordinates of all points, in the problem's units.
    pub fn points(&self, homotopy: &Homotopy) -> Vec<[Interval; 3]> {
        let coordinate = |i: usize| {
            let x = self.entry(i);
            // Scaling by a power of two is exact.
            hull(x.inf() * homotopy.unit, x.sup() * homotopy.unit)
        };
        let points = 0..homotopy.points;
        points.map(|p| homotopy.place(p, coordinate)).collect()
    }

    /// An unknown, in the homotopy's unit.
    fn entry(&self, i: usize) -> Interval {
        let of = &self.figure;
        let (x, low, r) = (of.centre[i], of.low[i], of.radius[i]);
        if low == 0.0 && r == 0.0 {
            return point(x);
        }
        let lo = (x + (low - r).next_down()).next_down();
        let hi = (x + (low + r).next_up()).next_up();
        hull(lo, hi)
    }

    /// The unknowns beside the points' coordinates, in the homotopy's unit.
    pub(super) fn auxiliary(&self, homotopy: &Homotopy) -> Vec<Interval> {
        let unknowns = homotopy.auxiliary_unknowns();
        unknowns.map(|i| self.entry(i)).collect()
    }

    /// Where the problem's objects are, given all points in the problem's units.
    pub(super) fn objects(&self, homotopy: &Homotopy, points: &[[Interval; 3]]) -> Vec<Located> {
        homotopy.locate(points, &|i| self.entry(i))
    }
}

/// More than [`FigureBox::points`] adds to an entry by rounding outwards: twice two roundings of
/// numbers no larger than this, ε each.
fn outward(x: f64, low: f64, radius: f64) -> f64 {
    5.0 * f64::EPSILON * (x.abs() + low.abs() + radius) + f64::MIN_POSITIVE
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Problem;

    #[test]
    fn boxes_that_are_apart_are_printed_apart() {
        let path = format!(
            "{}/../../problems/octahedron.toml",
            env!("CARGO_MANIFEST_DIR")
        );
        let homotopy = Homotopy::new(&Problem::read(path).unwrap()).unwrap();
        let equations = Equations::new(&homotopy);
        let mut one = SolutionProver::new(&homotopy, &equations).found;
        one.figure.centre.fill(1.0);
        one.figure.radius.fill(1e-28);
        one.alone_within = 1e-20;
        let (mut apart, mut overlapping) = (0, 0);
        for off in 0..60 {
            for (low, r) in [
                (1e-17, 1e-28),
                (0.0, 1e-28),
                (0.0, 0.4 * f64::EPSILON),
                (0.0, 1.9 * f64::EPSILON),
                (-1e-17, 9.9 * f64::EPSILON),
            ] {
                let mut other = one.clone();
                one.figure.radius.fill(r);
                other.figure.radius.fill(r);
                other.figure.centre[0] += off as f64 * f64::EPSILON;
                other.figure.low[0] = low;
                let (p, q) = (one.points(&homotopy), other.points(&homotopy));
                let mut pairs = p.iter().flatten().zip(q.iter().flatten());
                let disjoint = pairs.any(|(p, q)| p.sup() < q.inf() || q.sup() < p.inf());
                let same = one.is_same(&other, |_| false);
                assert!(
                    disjoint || same != Same::No,
                    "off {off} low {low:e} r {r:e}"
                );
                apart += (same == Same::No) as usize;
                overlapping += !disjoint as usize;
            }
        }
        assert!(apart > 100 && overlapping > 20, "{apart} {overlapping}");
    }
}
