//! Where the path leaves a tube.

use super::frame::{Reduction, Tubes};
use super::sides::Sides;
use super::test::ReducedTest;
use crate::interval::rounding::{largest, round_up};
use crate::track::certified::link::{Ball, from_middle};
use crate::track::certified::tracker::Test;
use crate::track::full::Equations;
use crate::track::full::newton::{End, UNTIL, Until};

/// Newton's method needs two or three.
const MAX_STEPS: usize = 8;
/// Corrections that shrink by less than this are at the limit of floats.
const STAGNATION: f64 = 0.5;
/// A correction so much smaller than the box is the last: more accuracy is of no use.
const NEGLIGIBLE: f64 = 1e-7;
/// How far before a tube's exit its path is looked at more closely, in half lengths, and how short
/// the tube is with which that is done.
const BEFORE: f64 = 1e-5;
const SHORT: f64 = 1e-3;
/// Accuracy of the point there before it is proved.
const POINT_TOLERANCE: f64 = 1e-11;

impl ReducedTest {
    /// Encloses the path's point in the cross-section at `exit_at`: Newton's method in floats; then, as
    /// Φ contracts by q, the path's point is at most |𝒴 G(w)|_ρ / (1 − q) from any w in the box.
    pub(super) fn enclose(&mut self, equations: &Equations, tube: &mut Tubes) -> Option<()> {
        let (m, n) = (equations.m, equations.n());
        let (local, s) = (&tube.local, tube.exit_at);
        let out = &mut tube.exit;
        // It could be anywhere until it is proved.
        out.radius[..n].fill(f64::INFINITY);
        local.at(s, &mut out.centre);
        let layout = &local.y.elimination.layout;
        let until = Until {
            goal: NEGLIGIBLE * tube.proof.r,
            ratio: STAGNATION,
            steps: MAX_STEPS,
            ..UNTIL
        };
        let mut is_made = false;
        let find = |(test, out): &mut (&mut Self, &mut Ball)| {
            test.residual_at(equations, out, false);
            // The steps stay in the cross-section.
            test.f[m] = 0.0;
            if !is_made {
                is_made = true;
                let at = (&test.d, &test.lengths, &local.normal);
                if test.there.make_like(layout, equations, at).is_err() {
                    return f64::NAN;
                }
            }
            test.there.solve(equations, &test.f[..n], &mut test.step);
            let mut size = 0.0f64;
            for (i, (x, step)) in out.centre[..n].iter_mut().zip(test.step.iter()).enumerate() {
                *x -= step;
                let ratio = step.abs() / tube.weights[i];
                size = largest(size, ratio);
            }
            size
        };
        let seen = until.correct(&mut (&mut *self, &mut *out), find, |_, _| {});
        if seen.end == End::Away {
            return None;
        }
        // The defect at the point reached, with what rounding may hide of it.
        self.residual_at(equations, out, true);
        let (along, error, extent) = from_middle(local, &tube.weights[..n], s, out, |_| 0.0);
        (self.f[m], self.hidden[m]) = (along, error);
        let radius = self.radius_from_defect(equations, &local.y, tube.proof.q)?;
        tube.hold_exit(extent, radius)
    }

    /// F at the middle of a box, into `f`, and if wanted how far the exact value may be, into `hidden`.
    fn residual_at(&mut self, equations: &Equations, at: &Ball, with_error: bool) {
        equations.residual_at(
            (&at.centre, None),
            (&mut self.d, &mut self.lengths),
            &mut self.f,
            with_error.then_some(&mut self.hidden),
        );
    }

    /// Encloses the path's point and tangent a little before the exit of a tube proved earlier, much
    /// more tightly: by a very short tube of its own there, in whose box the bound on A(s)⁻¹ is that at
    /// a point. Its zero is the path's if it is in the long tube's box.
    pub(super) fn enclose_by_short_tube(
        &mut self,
        equations: &Equations,
        tube: &mut Tubes,
        short: &mut Tubes,
    ) -> Option<()> {
        let at = tube.exit_at - BEFORE * tube.proof.h;
        tube.local.at(at, &mut short.local.z[0]);
        short.local.normal.copy_from_slice(&tube.local.normal);
        self.refine(equations, &mut short.local, POINT_TOLERANCE)
            .and_then(|()| self.expand(equations, &mut short.local))
            .ok()?;
        self.enclose_by(equations, tube, short)
    }

    /// Encloses the path's point and tangent a little before the exit of a tube proved earlier, by the very
    /// short tube `short`, in which what is known of the path there is given: any numbers will do.
    pub(in crate::track) fn enclose_by(
        &mut self,
        equations: &Equations,
        tube: &mut Tubes,
        short: &mut Tubes,
    ) -> Option<()> {
        let (n, last) = (equations.n(), tube.exit_at);
        if !self.prove(equations, short, SHORT * tube.proof.h) {
            return None;
        }
        // |v| ≤ |Φ(0)| + |Φ'| |v|, row by row, with |Φ'|_ρ as it is within the distance that was proved.
        let (bounds, distance) = (&self.last, short.proof.distance);
        let share = bounds.constant + bounds.cubic + bounds.width * distance;
        let rho = &short.local.y.rho;
        for (i, defect) in self.defect[..n].iter_mut().enumerate() {
            *defect = round_up(*defect + share * distance * rho[i], 8);
        }
        let exit = &mut short.exit;
        exit.centre.copy_from_slice(&short.local.z[0]);
        short
            .local
            .y
            .bound_unsheared(&self.defect, &mut exit.radius);
        let slope_radius = (0..n).fold(0.0, |max, i| {
            let ratio = short.proof.slope_distance * short.weights[i] / tube.weights[i];
            largest(max, ratio)
        });
        // Both are followed in the direction of the normal that they have in common.
        short.least_advance()?;
        // What lies between this point and the tube's exit is travelled twice, and nothing is left
        // out; what lies before the entry is not gone back to.
        let between = tube
            .locate(&short.exit)
            .filter(|between| tube.entry.1 < between.0 && between.1 <= last)?;
        tube.exit.centre.copy_from_slice(&short.exit.centre);
        tube.exit.radius.copy_from_slice(&short.exit.radius);
        tube.exit_between = between;
        tube.exit_slope.copy_from_slice(&short.local.z[1]);
        tube.exit_slope_radius = round_up(slope_radius, 4);
        tube.exit_is_tight = true;
        Some(())
    }

    /// A bound on |𝒴 g|_ρ / (1 − q) for any g within `hidden` of `f`, entry by entry.
    fn radius_from_defect(&mut self, equations: &Equations, y: &Reduction, q: f64) -> Option<f64> {
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
impl ReducedTest {
    /// The bound on |𝒴 g|_ρ / (1 − q) for this `g`.
    pub fn radius_for(&mut self, equations: &Equations, tube: &Tubes, g: &[f64]) -> Option<f64> {
        self.f[..g.len()].copy_from_slice(g);
        self.hidden.fill(0.0);
        self.radius_from_defect(equations, &tube.local.y, tube.proof.q)
    }
}
