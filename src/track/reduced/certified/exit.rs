//! Where the path leaves a tube.

use super::frame::{Reduction, Tubes};
use super::sides::Sides;
use super::test::ReducedTest;
use crate::interval::rounding::{largest, round_up};
use crate::track::certified::link::from_middle;
use crate::track::certified::tracker::Test;
use crate::track::full::Equations;

/// Newton's method needs two or three.
const MAX_STEPS: usize = 8;
/// Corrections that shrink by less than this are at the limit of floats.
const STAGNATION: f64 = 0.5;
/// Nor is there more to be had after one so much smaller than the box.
const NEGLIGIBLE: f64 = 1e-7;
/// How far before a tube's exit its path is looked at more closely, in half lengths, and how short
/// the tube is with which that is done.
const BEFORE: f64 = 1e-5;
const SHORT: f64 = 1e-3;
/// Accuracy of the point there before it is proved.
const POINT_TOLERANCE: f64 = 1e-11;

impl<const D: usize> ReducedTest<D> {
    /// Encloses the path's point in the cross-section at `exit_at`: Newton's method in floats; then, as
    /// Φ contracts by q, the path's point is at most |𝒴 G(w)|_ρ / (1 − q) from any w in the box.
    pub(super) fn enclose(&mut self, equations: &Equations<D>, tube: &mut Tubes<D>) -> Option<()> {
        let (m, n) = (equations.m, equations.n());
        let (local, s) = (&tube.local, tube.exit_at);
        let out = &mut tube.exit;
        // It could be anywhere until it is proved.
        out.radius[..n].fill(f64::INFINITY);
        local.at(s, &mut out.centre);
        let mut last = f64::INFINITY;
        let layout = &local.y.elimination.layout;
        for step in 0..MAX_STEPS {
            equations.differences(&out.centre, &mut self.d);
            equations.expand_lengths(out.centre[m], &mut self.lengths);
            equations.residual(&self.d, &self.lengths, &mut self.f);
            // The steps stay in the cross-section.
            self.f[m] = 0.0;
            if step == 0 {
                let at = (&self.d, &self.lengths, &local.normal);
                self.there.make_like(layout, equations, at).ok()?;
            }
            self.there.solve(equations, &self.f[..n], &mut self.step);
            let mut size = 0.0f64;
            for (i, (x, step)) in out.centre[..n].iter_mut().zip(self.step.iter()).enumerate() {
                *x -= step;
                let ratio = step.abs() / tube.weights[i];
                size = largest(size, ratio);
            }
            if size.is_nan() || size > STAGNATION * last || size <= NEGLIGIBLE * tube.proof.r {
                break;
            }
            last = size;
        }
        // The defect at the point reached, with what rounding may hide of it.
        equations.differences(&out.centre, &mut self.d);
        equations.expand_lengths(out.centre[m], &mut self.lengths);
        equations.residual(&self.d, &self.lengths, &mut self.f);
        equations.residual_error(&self.d, out.centre[m], &mut self.hidden);
        let (along, error, extent) = from_middle(local, &tube.weights[..n], s, out, |_| 0.0);
        (self.f[m], self.hidden[m]) = (along, error);
        let radius = self.radius_from_defect(equations, &local.y, tube.proof.q)?;
        if !(extent < tube.proof.r && radius < tube.proof.r) {
            return None;
        }
        for i in 0..n {
            out.radius[i] = round_up(radius * tube.weights[i], 1);
        }
        tube.exit_between = (s, s);
        Some(())
    }

    /// Encloses the path's point and tangent a little before the exit of a tube proved earlier, much
    /// more tightly: by a very short tube of its own there, in whose box the bound on A(s)⁻¹ is that at
    /// a point. Its zero is the path's if it is in the long tube's box.
    pub(super) fn tie(
        &mut self,
        equations: &Equations<D>,
        tube: &mut Tubes<D>,
        knot: &mut Tubes<D>,
    ) -> Option<()> {
        let at = tube.exit_at - BEFORE * tube.proof.h;
        tube.local.at(at, &mut knot.local.z[0]);
        knot.local.normal.copy_from_slice(&tube.local.normal);
        self.refine(equations, &mut knot.local, POINT_TOLERANCE)
            .and_then(|()| self.expand(equations, &mut knot.local))
            .ok()?;
        self.tie_to(equations, tube, knot)
    }

    /// The same with what is known of the path a little before the exit given: any numbers will do.
    pub(in crate::track) fn tie_to(
        &mut self,
        equations: &Equations<D>,
        tube: &mut Tubes<D>,
        knot: &mut Tubes<D>,
    ) -> Option<()> {
        let (n, last) = (equations.n(), tube.exit_at);
        if !self.prove(equations, knot, SHORT * tube.proof.h) {
            return None;
        }
        // |v| ≤ |Φ(0)| + |Φ'| |v|, row by row, with |Φ'|_ρ as it is within the distance that was proved.
        let (bounds, distance) = (&self.last, knot.proof.distance);
        let share = bounds.constant + bounds.cubic + bounds.width * distance;
        let rho = &knot.local.y.rho;
        for (i, defect) in self.defect[..n].iter_mut().enumerate() {
            *defect = round_up(*defect + share * distance * rho[i], 8);
        }
        let exit = &mut knot.exit;
        exit.centre.copy_from_slice(&knot.local.z[0]);
        knot.local.y.take_along(&self.defect, &mut exit.radius);
        let slope_radius = (0..n).fold(0.0, |max, i| {
            let ratio = knot.proof.slope_distance * knot.weights[i] / tube.weights[i];
            largest(max, ratio)
        });
        // Both are followed in the direction of the normal that they have in common.
        knot.least_advance()?;
        // What lies between this point and the tube's exit is travelled twice, and nothing is left
        // out; what lies before the entry is not gone back to.
        let between = tube
            .locate(&knot.exit)
            .filter(|between| tube.entry.1 < between.0 && between.1 <= last)?;
        tube.exit.centre.copy_from_slice(&knot.exit.centre);
        tube.exit.radius.copy_from_slice(&knot.exit.radius);
        tube.exit_between = between;
        tube.exit_slope.copy_from_slice(&knot.local.z[1]);
        tube.exit_slope_radius = round_up(slope_radius, 4);
        tube.exit_is_tight = true;
        Some(())
    }

    /// A bound on |𝒴 g|_ρ / (1 − q) for any g within `hidden` of `f`, entry by entry.
    fn radius_from_defect(
        &mut self,
        equations: &Equations<D>,
        y: &Reduction<D>,
        q: f64,
    ) -> Option<f64> {
        let (m, layout) = (equations.m, &y.elimination.layout);
        let sides = &mut self.sides;
        for e in 0..=m {
            let size = round_up(self.f[e].abs() + self.hidden[e], 2);
            sides.g[e] = [size, 0.0, 0.0, 0.0];
        }
        sides.gather(y);
        sides.bound(equations, y);
        let mut widest = 0.0f64;
        let mut see = |bound: f64, unknown: u32| {
            widest = largest(widest, bound / y.rho[unknown as usize]);
        };
        for block in &layout.blocks {
            for c in 0..block.size {
                see(sides.a[block.start + c][0], block.unknowns[c]);
            }
        }
        for (value, &key) in sides.keys.iter().zip(&layout.keys) {
            see(value[0], key);
        }
        let radius = round_up(widest, Sides::roundings(y, m) + 30) / (1.0 - q);
        let radius = round_up(radius, 4);
        radius.is_finite().then_some(radius)
    }
}

#[cfg(test)]
impl<const D: usize> ReducedTest<D> {
    /// The bound on |𝒴 g|_ρ / (1 − q) for this `g`.
    pub fn radius_for(
        &mut self,
        equations: &Equations<D>,
        tube: &Tubes<D>,
        g: &[f64],
    ) -> Option<f64> {
        self.f[..g.len()].copy_from_slice(g);
        self.hidden.fill(0.0);
        self.radius_from_defect(equations, &tube.local.y, tube.proof.q)
    }
}
