//! That claims are false. Nobody who believes a verified certificate has to trust this; whoever believes
//! a refuted one has.

use super::equations::{Equations, ZERO};
use super::guess::Inverse;
use super::krawczyk::{Curve, Section, way};
use super::matrix::{along, between, exact, size};
use super::place::{Place, Spot, component};
use super::tube::Tube;
use crate::certificate::format::TubeClaim;
use crate::interval::{Interval, point};

/// How far z₀ was moved by rounding: what the tube's is more than the claimed one.
fn moved(claim: &TubeClaim, curve: &Curve) -> Vec<Interval> {
    let low = |i: usize| curve.low_of(i) - claim.low.get(i).map_or(ZERO, |&x| point(x));
    let moved = |(i, &x): (usize, &f64)| point(curve.z[0][i]) - exact(x) + low(i);
    claim.centre.iter().enumerate().map(moved).collect()
}

/// Of a tube that certainly reaches to both ends of the claimed one the parameters among which is that of the claimed exit: Newton's
/// interval, from one near it and from bounds on c·ẑ'.
pub fn exit(
    claim: &TubeClaim,
    curve: &Curve,
    c: &[f64],
    (near, advance): (f64, Interval),
) -> Option<Interval> {
    // c·(ẑ(σ) − z₀) with the z₀ that is claimed.
    let moved = component(&moved(claim, curve), c);
    let ahead = |s: f64| {
        let terms = curve.z[1..].iter().rev();
        terms.fold(ZERO, |sum, z| (sum + along(z, c)) * point(s)) + moved
    };
    let is_whole = ahead(1.0).inf() >= claim.h && ahead(-1.0).sup() <= -claim.h;
    is_whole.then(|| point(near) + (point(claim.exit) - ahead(near)) / advance)
}

/// Whether a tube's first claim is false: that the cross-section through its centre holds a zero of F
/// within its radius. For a zero w* would be |Y G(0)| = |Y (G(0) − G(w*))| ≤ (1 + q) |w*|.
pub fn tube(claim: &TubeClaim, curve: &Curve, inverse: &Inverse, at: &Section) -> bool {
    // The centre was moved by rounding: a zero within r of where it was is within `wider`, and in a
    // cross-section beside this one.
    let moved = moved(claim, curve);
    let along = component(&moved, &at.c);
    let away = moved
        .iter()
        .zip(&at.u)
        .map(|(&x, &u)| size(x / point(u)).sup());
    let wider = point(claim.r.into()) + exact(away.fold(0.0, f64::max));
    // Bounds on the Jacobian there, not only where the tube's test has them.
    let test = curve.test(inverse, at, wider);
    let most = wider * (point(1.0) + test.contraction(wider));
    let mut off = curve.value();
    off.push(along);
    inverse.y.image(&off).inf() > most.sup()
}

/// Whether a zero of F is certainly not on the path in a tube: it is in none of the cross-sections, or further from the
/// middle than the path. The cross-sections are those of a guess, and tell nothing where they may not be all of the claimed ones.
pub fn elsewhere(tube: &Tube, z: &Spot) -> bool {
    let (s, n) = (tube.parameter(z), tube.u.len());
    let within = s.intersection(between(-1.0, 1.0));
    let most = |i: usize| (tube.proof.distance * tube.u[i]).sup();
    let away = |i: usize| (tube.off(z, i) - way(&tube.z, i, within)).mig() > most(i);
    tube.is_whole && (within.is_empty() || (0..n).any(away))
}

/// A part of a range of a tube's parameters in which t certainly passes 1, at none of the solutions.
pub fn missing(tube: &Tube, range: Interval, solutions: &[Option<&Spot>]) -> Option<Interval> {
    let share = |k: u32| (range.sup() - range.inf()) * f64::from(k) / 256.0;
    let cuts = (0..=256).map(|k| (range.inf() + share(k)).min(range.sup()));
    let times = cuts.map(|s| (s, tube.time(exact(s))));
    let known: Vec<(f64, Interval)> = times.filter(|(_, t)| !t.contains(0.0)).collect();
    known.windows(2).find_map(|ends| {
        let part = between(ends[0].0, ends[1].0);
        let inside = |spot: &Spot| !tube.parameter(spot).disjoint(part) && !elsewhere(tube, spot);
        let passes = (ends[0].1 * ends[1].1).sup() < 0.0;
        (passes && !solutions.iter().flatten().any(|spot| inside(spot))).then_some(part)
    })
}

/// Whether two claimed boxes certainly have a point in common: it is strictly inside of both as they are after rounding, which
/// moved their ends by less than a float's step.
pub fn overlap(a: &Place, b: &Place) -> bool {
    let mut pairs = a.claimed.iter().zip(&b.claimed);
    let common =
        |(&a, &b): (&Interval, &Interval)| a.inf().max(b.inf()).next_up() < a.sup().min(b.sup());
    pairs.all(common)
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
