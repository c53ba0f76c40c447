//! That claims are false. Nobody who believes a verified certificate has to trust this; whoever believes
//! a refuted one has.

use super::equations::{Equations, ZERO};
use super::guess::Inverse;
use super::krawczyk::{Curve, Section, way};
use super::matrix::{between, exact, size};
use super::place::{Place, Spot};
use super::tube::Tube;
use crate::certificate::format::TubeClaim;
use crate::interval::{Interval, point};

/// Whether a tube's first claim is false: that the cross-section through its centre holds a zero of F
/// within its radius. For a zero w* would be |Y G(0)| = |Y (G(0) − G(w*))| ≤ (1 + q) |w*|.
pub fn tube(claim: &TubeClaim, curve: &Curve, inverse: &Inverse, at: &Section) -> bool {
    // The centre was moved by rounding: a zero within r of where it was is within `wider`, and in a
    // cross-section beside this one.
    let low = |i: usize| claim.low.get(i).map_or(ZERO, |&x| point(x)) - curve.low_of(i);
    let moved = |i: usize| exact(claim.centre[i]) - point(curve.z[0][i]) + low(i);
    let along = (0..at.u.len()).fold(ZERO, |sum, i| sum + point(at.c[i]) * moved(i));
    let away = (0..at.u.len()).map(|i| size(moved(i) / point(at.u[i])).sup());
    let wider = point(claim.r.into()) + exact(away.fold(0.0, f64::max));
    // Bounds on the Jacobian there, not only where the tube's test has them.
    let test = curve.test(inverse, at, wider);
    let most = wider * (point(1.0) + test.contraction(wider));
    let mut off = curve.value();
    off.push(-along);
    inverse.y.image(&off).inf() > most.sup()
}

/// Whether a zero of F that lies in a tube's cross-sections is certainly not on the path in it: it is
/// beyond both ends, or further from the middle than the path.
pub fn elsewhere(tube: &Tube, z: &Spot) -> bool {
    let (s, n) = (tube.parameter(z), tube.u.len());
    let within = s.intersection(between(-1.0, 1.0));
    let most = |i: usize| (tube.proof.distance * tube.u[i]).sup();
    let away = |i: usize| (tube.off(z, i) - way(&tube.z, i, within)).mig() > most(i);
    within.is_empty() || (0..n).any(away)
}

/// Whether t certainly passes 1 in a range of a tube's parameters, at none of the solutions.
pub fn missing(tube: &Tube, range: Interval, solutions: &[Place]) -> bool {
    let share = |k: u32| (range.sup() - range.inf()) * f64::from(k) / 256.0;
    let cuts = (0..=256).map(|k| (range.inf() + share(k)).min(range.sup()));
    let times = cuts.map(|s| (s, tube.time(exact(s))));
    let known: Vec<(f64, Interval)> = times.filter(|(_, t)| !t.contains(0.0)).collect();
    known.windows(2).any(|ends| {
        let part = between(ends[0].0, ends[1].0);
        let inside = |spot: &Spot| !tube.parameter(spot).disjoint(part) && !elsewhere(tube, spot);
        (ends[0].1 * ends[1].1).sup() < 0.0 && !solutions.iter().any(|p| inside(&p.spot))
    })
}

/// Whether a box certainly holds no zero of F with t = 1: one of the equations has none in it; or the
/// whole box is where a figure is the only one, and that is not in it.
pub fn empty(eq: &Equations, claimed: &[Interval], place: Option<&Place>) -> bool {
    let forms = eq.differences(claimed, [ZERO, point(1.0)]);
    let excluded = |e: usize| {
        let products = eq.products[e].iter().map(|&(factor, [left, right])| {
            let product = match left == right {
                true => forms[left].sqr(),
                false => forms[left] * forms[right],
            };
            point(0.5 * factor as f64) * product
        });
        let sum = products.fold(ZERO, |sum, x| sum + x);
        !(sum - eq.right_at(e, point(1.0))[0]).contains(0.0)
    };
    let apart = |place: &Place| (0..eq.m).any(|i| claimed[i].disjoint(place.spot.at(i)));
    let alone = place.is_some_and(|place| place.covers(&claimed[..eq.m]) && apart(place));
    alone || (0..eq.m).any(excluded)
}
