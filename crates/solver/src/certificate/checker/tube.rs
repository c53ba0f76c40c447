//! One tube, proved again. The mathematics and its notation are in `docs/how/tubes.md`.

use super::equations::{Equations, ZERO};
use super::guess::{Inverse, Moving, expand};
use super::krawczyk::{Curve, LARGE, ORDER, Proof, Section, around, derivative, way, weights};
use super::matrix::{Matrix, along, between, exact, size};
use super::place::{Spot, component};
use super::refute;
use crate::certificate::format::TubeClaim;
use crate::certificate::verdict::Fault;
use crate::interval::rounding::round_up;
use crate::interval::{Interval, hull, point};
use std::cell::Cell;

/// A proved tube: for |σ| ≤ 1 exactly one zero φ(σ) of F in the cross-section c·(z − ẑ(σ)) = 0
/// with |z − ẑ(σ)|_u ≤ r, regular, and as near ẑ(σ), and φ' as near ẑ', as its proof says.
pub struct Tube {
    /// Coefficients of ẑ, and what z₀ is more than its floats.
    pub z: Vec<Vec<f64>>,
    pub low: Vec<Interval>,
    pub normal: Vec<f64>,
    pub u: Vec<Interval>,
    r: Interval,
    pub claim: TubeClaim,
    pub proof: Proof,
    /// c·ẑ'(σ), positive.
    pub advance: Interval,
    /// Whether this tube certainly reaches to both ends of the claimed one: then what is not in it is not in that one.
    pub is_whole: bool,
    /// Parameters among which is the one at which the path leaves; for a tube that is whole, the one that is claimed.
    pub exit_at: Interval,
    /// Where all of them are.
    pub exit: Spot,
    /// The path's direction there.
    pub exit_direction: Vec<Interval>,
}

/// Whether the path, from a tube's entry to its exit, meets a solution: from what is false to what is true.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Met {
    No,
    Unknown,
    /// It is on the path in the tube, perhaps before the entry or beyond the exit: met by a path that is closed.
    InTube,
    Yes,
}

/// What a tube adds to the account, from its entry to its exit.
pub struct Stretch {
    /// Of each solution listed so far.
    pub met: Vec<Met>,
    /// The range of t − 1.
    pub t: Interval,
}

/// Ranges of parameters are split into so many pieces first.
const PARTS: u32 = 16;
/// They are not split into more pieces.
const PIECES: usize = 10_000;
/// Finer tubes are made within others so many times, and of pieces no longer than this.
const FINER: usize = 4;
/// And no more than so many for one claimed tube.
const MOST_FINER: usize = 50_000;
const FINE: f64 = 1.0 / 512.0;
/// How near the path its points are guessed, in radii.
const ENOUGH: f64 = 1e-6;
/// ẑ is guessed so much longer than the claimed tube, as its ends are only as good as rounding.
const LONGER: f64 = 1.0 + 1.0 / (1u64 << 40) as f64;

/// What a tube's proof is made of.
struct Work<'a> {
    curve: Curve<'a>,
    at: Section,
    inverse: Inverse,
    r: Interval,
    proof: Proof,
    a: Matrix,
}

impl<'a> Work<'a> {
    /// `advance`: about c·ẑ'.
    fn new(eq: &'a Equations, claim: &TubeClaim, advance: f64) -> Result<Work<'a>, Fault> {
        let c: Vec<f64> = claim.normal.iter().map(|&c| c.into()).collect();
        let r = point(claim.r.into());
        let mut curve = match claim.low.is_empty() {
            true => Curve::at(eq, &claim.centre)?,
            false => Curve::at_sum(eq, &claim.centre, &claim.low)?,
        };
        let at = curve.section(&c, &weights(&claim.weights));
        let inverse = Inverse::new(&at)?;
        expand(&mut curve, &inverse, advance)?;
        let test = curve.test(&inverse, &at, r);
        let proof = test.within(r).map_err(|fault| Fault {
            is_false: refute::tube(claim, &curve, &inverse, &at),
            ..fault
        })?;
        Ok(Work {
            curve,
            at,
            inverse,
            r,
            proof,
            a: test.a.ok_or(LARGE)?,
        })
    }

    fn moving(&self) -> Moving<'_> {
        Moving::new(&self.curve, &self.at, &self.inverse, &self.a)
    }

    /// Encloses φ(s): for any w in the box, |w − w*| ≤ |Ỹ G(w)| / (1 − q) for the zero w*.
    fn spot(&self, s: f64, moving: &Moving) -> Option<Spot> {
        let (z, u) = (&self.curve.z, || self.at.u.iter().map(|&u| point(u)));
        let there = moving.zero(s, ENOUGH * self.r.sup()).ok()?;
        let near = there.z[0].clone();
        let s = point(s);
        let off = |i: usize| {
            let low = there.low_of(i) - self.curve.low_of(i);
            exact(near[i]) - point(z[0][i]) + low - way(z, i, s)
        };
        let off: Vec<Interval> = (0..near.len()).map(off).collect();
        let mut inside = off.iter().zip(u());
        if !inside.all(|(&off, u)| size(off).sup() < (self.r * u).inf()) {
            return None;
        }
        let mut f = there.value();
        f.push(component(&off, &self.at.c));
        let distance = self.proof.inverse * self.inverse.y.image(&f);
        let rest = u().enumerate();
        let rest = rest.map(|(i, u)| there.low_of(i) + around(distance * u));
        let rest = rest.collect();
        Some(Spot { rest, near })
    }

    /// The path's direction T, c·T = 1, at a point φ(σ) of it near φ(s):
    /// |T − v| ≤ |Ỹ ([J; c] v − e_n)| / (1 − q) for any v.
    fn direction(&self, spot: &Spot, s: f64, moving: &Moving) -> Vec<Interval> {
        let v = moving.tangent(&spot.near, s);
        let off = spot.off_direction(self.curve.eq, &self.at, &v);
        let distance = self.proof.inverse * self.inverse.y.image(&off);
        let near = |(&v, &u): (&f64, &f64)| exact(v) + around(distance * point(u));
        v.iter().zip(&self.at.u).map(near).collect()
    }
}

/// The path's direction at a point that lies in a tube for certain: with c·T = 1 for the tube's normal c.
pub fn direction(eq: &Equations, claim: &TubeClaim, spot: &Spot) -> Result<Vec<Interval>, Fault> {
    let work = Work::new(eq, claim, LONGER * claim.h)?;
    Ok(work.direction(spot, 0.0, &work.moving()))
}

impl Tube {
    pub fn prove(eq: &Equations, claim: &TubeClaim) -> Result<Tube, Fault> {
        Tube::with(eq, claim, LONGER * claim.h)
    }

    fn with(eq: &Equations, claim: &TubeClaim, guess: f64) -> Result<Tube, Fault> {
        let work = Work::new(eq, claim, guess)?;
        let along = |k: usize| along(&work.curve.z[k], &work.at.c);
        let beyond = |k: usize| around(point(k as f64)) * along(k);
        let advance = (2..=ORDER).fold(along(1), |sum, k| sum + beyond(k));
        if !(advance.inf() > 0.0) {
            return Err(Fault::because("its cross-sections may turn back"));
        }
        // A parameter in [−1, 1], whatever is rounded, and some beside it.
        let near = (claim.exit / guess).clamp(-1.0, 1.0);
        let claimed = refute::exit(claim, &work.curve, &work.at.c, (near, advance));
        let exit_at = point(near).convex_hull(claimed.unwrap_or(point(near)));
        let exit_at = exit_at.intersection(between(-1.0, 1.0));
        let moving = work.moving();
        let exit = work.spot(near, &moving);
        let mut exit = exit.ok_or(Fault::because("its exit cannot be enclosed"))?;
        for (i, rest) in exit.rest.iter_mut().enumerate() {
            let off = around(work.proof.slope_distance * point(work.at.u[i]));
            *rest += (exit_at - point(near)) * (derivative(&work.curve.z, i, exit_at) + off);
        }
        Ok(Tube {
            exit_direction: work.direction(&exit, near, &moving),
            is_whole: claimed.is_some(),
            exit_at,
            exit,
            low: (0..=eq.m).map(|i| work.curve.low_of(i)).collect(),
            z: work.curve.z,
            u: work.at.u.iter().map(|&u| point(u)).collect(),
            r: work.r,
            claim: claim.clone(),
            proof: work.proof,
            advance,
            normal: work.at.c,
        })
    }

    /// How far a point is from z₀.
    pub fn off(&self, z: &Spot, i: usize) -> Interval {
        z.minus(&self.z[0], i) - self.low[i]
    }

    /// The parameters in [−1, 1] in whose cross-sections a point may be, and if that is all within there it
    /// is in one: g(σ) = c·(z − ẑ(σ)) falls with slope −c·ẑ', and this is Newton's interval around 0.
    pub fn parameter(&self, z: &Spot) -> Interval {
        let off: Vec<Interval> = (0..self.u.len()).map(|i| self.off(z, i)).collect();
        component(&off, &self.normal) / self.advance
    }

    /// The parameters σ with φ(σ) = z, for a zero z of F. `None`: it could not be proved that there is one.
    pub fn locate(&self, z: &Spot) -> Option<Interval> {
        let s = self.parameter(z);
        let inside =
            |i: usize| size(self.off(z, i) - way(&self.z, i, s)).sup() < (self.r * self.u[i]).inf();
        (s.mag() <= 1.0 && (0..self.u.len()).all(inside)).then_some(s)
    }

    /// An entry of the path for all parameters of a range, beyond a number.
    pub fn beyond(&self, base: f64, i: usize, s: Interval) -> Interval {
        let start = (point(self.z[0][i]) - point(base)) + self.low[i];
        let [constant, growing] = self.proof.distances.map(Interval::sup);
        let away = round_up((constant + growing * s.mag()) * self.u[i].sup(), 3);
        start + (way(&self.z, i, s) + around(exact(away)))
    }

    /// An entry of the path's derivative φ'(σ) for all parameters of a range.
    pub fn slope(&self, i: usize, s: Interval) -> Interval {
        derivative(&self.z, i, s) + around(self.proof.slope_distance * self.u[i])
    }

    /// t − 1 on the path for all parameters of a range.
    pub fn time(&self, s: Interval) -> Interval {
        self.beyond(1.0, self.u.len() - 1, s)
    }

    /// dt/dσ on the path for all parameters of a range.
    pub fn time_slope(&self, s: Interval) -> Interval {
        self.slope(self.u.len() - 1, s)
    }

    /// Proves that on the path for all parameters of a range lengths and radii are positive, and that no vector is zero
    /// which must not be.
    pub fn stands(&self, eq: &Equations, range: Interval) -> Result<(), Fault> {
        let entry = |i: usize, s: Interval| match i < eq.m {
            true => self.beyond(0.0, i, s),
            false => ZERO,
        };
        let positive = |s| eq.positive.iter().all(|&i| entry(i, s).inf() > 0.0);
        let off = |s, &[i, j]: &[usize; 2]| !(entry(i, s) - entry(j, s)).contains(0.0);
        let is_off = |s| eq.nonzero.iter().all(|v| v.iter().any(|d| off(s, d)));
        let stands = everywhere(range, |s| positive(s) && is_off(s), |_| false);
        stands.map_err(|_| {
            Fault::because("a length or radius in it may not be positive, or a vector vanish")
        })
    }

    /// Accounts for all parameters from the entry to the exit: the path meets t = 1 in no other point of these than
    /// these solutions, which have t = 1; those of other equations than this tube's are `None`. `Err`: a range where this fails.
    pub fn account(
        &self,
        eq: &Equations,
        ends: [Interval; 2],
        listed: &[Option<&Spot>],
    ) -> Result<Stretch, Interval> {
        let [entry, exit] = ends;
        let range = hull(entry.inf(), exit.sup());
        let times = parts(range).map(|part| self.time(part));
        let t = times.reduce(|a, b| a.convex_hull(b));
        let t = t.unwrap_or(Interval::ENTIRE);
        let met = vec![Met::No; listed.len()];
        let mut stretch = Stretch { met, t };
        if !t.contains(0.0) {
            return Ok(stretch);
        }
        for (k, spot) in listed.iter().enumerate() {
            let Some(spot) = spot else { continue };
            stretch.met[k] = match self.locate(spot) {
                Some(s) if entry.sup() <= s.inf() && s.sup() <= exit.inf() => Met::Yes,
                Some(s) if entry.inf() <= s.sup() && s.inf() <= exit.sup() => Met::InTube,
                None if !refute::elsewhere(self, spot) => Met::Unknown,
                _ => Met::No,
            }
        }
        self.meets_only(eq, range, listed, (FINER, &Cell::new(MOST_FINER)))?;
        Ok(stretch)
    }

    /// Proves that for all parameters of a range the path meets t = 1 in no other point than these. Where the bounds of a
    /// tube in extended precision are too coarse, finer ones are made: so many times one within the other, and so many in all. `Err`: a range where this
    /// fails.
    fn meets_only(
        &self,
        eq: &Equations,
        range: Interval,
        listed: &[Option<&Spot>],
        (finer, left): (usize, &Cell<usize>),
    ) -> Result<(), Interval> {
        // Where in this tube the solutions are that it holds.
        let spots = listed.iter().flatten();
        let here: Vec<Interval> = spots.filter_map(|spot| self.locate(spot)).collect();
        // Where t is monotone from a solution on, it is the only one.
        let only = |part: Interval, s| !self.time_slope(part.convex_hull(s)).contains(0.0);
        let is_seen = |part| !self.time(part).contains(0.0) || here.iter().any(|&s| only(part, s));
        // Of parts that are halved one has such a length.
        let length = FINE.min(range.wid() / f64::from(PARTS));
        let is_due = |part: Interval| part.wid() <= length && part.wid() > 0.5 * length;
        // Where one of them fails no more are tried: their number stays small.
        let may_be_finer = Cell::new(finer > 0 && !self.claim.low.is_empty());
        let is_seen_finer = |part: Interval| {
            let next = (finer - 1, left);
            let again = |(tube, s): (Tube, Interval)| tube.meets_only(eq, s, listed, next);
            let count = left.get();
            left.set(count.saturating_sub(1));
            let tube = (count > 0).then(|| self.finer(eq, part)).flatten();
            may_be_finer.set(tube.is_some_and(|tube| again(tube).is_ok()));
            may_be_finer.get()
        };
        let holds =
            |part| is_seen(part) || (may_be_finer.get() && is_due(part) && is_seen_finer(part));
        everywhere(range, holds, |_| false)
    }
}

/// A range in equal parts.
fn parts(range: Interval) -> impl Iterator<Item = Interval> {
    let width = range.sup() - range.inf();
    let cut = move |k: u32| match k {
        PARTS => range.sup(),
        _ => range.inf() + width * (f64::from(k) / f64::from(PARTS)),
    };
    (0..PARTS).map(move |k| between(cut(k), cut(k + 1)))
}

/// Proves that something holds on pieces that cover a range. `Err`: one where it does not, though it is small,
/// or fails for certain.
pub fn everywhere(
    range: Interval,
    holds: impl Fn(Interval) -> bool,
    fails: impl Fn(Interval) -> bool,
) -> Result<(), Interval> {
    let mut pieces: Vec<Interval> = parts(range).collect();
    let mut next = 0;
    while let Some(&part) = pieces.get(next) {
        next += 1;
        if holds(part) {
            continue;
        }
        if pieces.len() > PIECES || fails(part) {
            return Err(part);
        }
        pieces.push(between(part.inf(), part.mid()));
        pieces.push(between(part.mid(), part.sup()));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::checker::guess::newton;
    use crate::certificate::format::Record;
    use crate::certificate::reader::Reader;
    use crate::system::Homotopy;

    /// Bounds over whole tubes against what the test proves at single points: where the path is,
    /// and where it goes.
    #[test]
    fn the_path_and_its_slope_are_where_tubes_say() {
        for name in ["k33", "dodecagon", "prism"] {
            let file = std::fs::File::open(format!("../../certs/{name}.krawl")).unwrap();
            let mut reader = Reader::new(std::io::BufReader::new(file)).unwrap();
            let unit = 2f64.powi(reader.header().unit_exponent.into());
            let homotopy = Homotopy::with_unit(&reader.header().problem, unit).unwrap();
            let eq = Equations::new(homotopy);
            // Bounds may be generous, but not so much that nothing was compared.
            let mut nearest = f64::INFINITY;
            while let Some(record) = reader.next_record().unwrap() {
                let Record::Tube(claim) = record else {
                    continue;
                };
                for s in [-0.99, -0.7, -0.2, 0.0, 0.4, 0.8, 1.0] {
                    let exit = s * claim.h;
                    let claim = TubeClaim {
                        exit,
                        ..claim.clone()
                    };
                    let tube = Tube::prove(&eq, &claim).unwrap();
                    let (n, s) = (eq.m + 1, tube.exit_at);
                    let z: Vec<Interval> = (0..n)
                        .map(|i| point(tube.z[0][i]) + way(&tube.z, i, s))
                        .collect();
                    // Another way to the same point, and the same direction there.
                    let middle: Vec<f64> = z.iter().map(|z| z.mid()).collect();
                    let (curve, _) = newton(
                        &eq,
                        (&middle, false),
                        &tube.normal,
                        &weights(&claim.weights),
                    )
                    .unwrap();
                    // With the inverse there.
                    let middle = curve.z[0][..n].to_vec();
                    let (curve, inverse) = newton(
                        &eq,
                        (&middle, false),
                        &tube.normal,
                        &weights(&claim.weights),
                    )
                    .unwrap();
                    let mut last = vec![0.0; n];
                    last[n - 1] = 1.0;
                    let tangent = inverse.times(&last);
                    for i in 0..n {
                        let away = tube.exit.at(i) - point(curve.z[0][i]);
                        assert!(away.mig() < 1e-13 && away.wid() < 1e-4 * f64::from(claim.r));
                        let away = tube.exit_direction[i] - point(tangent[i]);
                        assert!(away.mig() < 1e-6 && away.wid() < 1e-2, "{name}: {away:?}");
                        let off = (tube.exit.at(i) - z[i]).mig();
                        let bound = (tube.proof.distance * tube.u[i]).sup();
                        assert!(off <= bound, "{name}: {off:e} from the middle, {bound:e}");
                        nearest = nearest.min(bound / off);
                        // With c·T = 1 and c·φ' = c·ẑ'.
                        let slope =
                            tube.exit_direction[i] * tube.advance - derivative(&tube.z, i, s);
                        let bound = (tube.proof.slope_distance * tube.u[i]).sup();
                        assert!(
                            slope.mig() <= bound,
                            "{name}: slope off by {slope:?}, {bound:e}"
                        );
                    }
                }
            }
            assert!(nearest < 100.0, "{name}: {nearest}");
        }
    }

    /// Where the path leaves is told by the certificate, whatever the polynomial is; and one that ends before the claimed
    /// tube refutes nothing of what is beyond.
    #[test]
    fn a_polynomial_that_is_too_short_refutes_nothing() {
        let file = std::fs::File::open("../../certs/dodecagon.krawl").unwrap();
        let mut reader = Reader::new(std::io::BufReader::new(file)).unwrap();
        let unit = 2f64.powi(reader.header().unit_exponent.into());
        let homotopy = Homotopy::with_unit(&reader.header().problem, unit).unwrap();
        let eq = Equations::new(homotopy);
        while let Some(record) = reader.next_record().unwrap() {
            let Record::Tube(mut claim) = record else {
                continue;
            };
            for share in [-1.0, -0.75, 0.3, 0.75, 1.0] {
                claim.exit = share * claim.h;
                let tube = Tube::prove(&eq, &claim).unwrap();
                assert!(tube.is_whole && tube.exit_at.wid() < 1e-12);
                let off: Vec<Interval> = (0..=eq.m)
                    .map(|i| tube.exit.minus(&claim.centre, i))
                    .collect();
                assert!(component(&off, &tube.normal).contains(claim.exit));
                assert!(tube.locate(&tube.exit).is_some() || share.abs() == 1.0);
                assert!(!refute::elsewhere(&tube, &tube.exit));

                let short = Tube::with(&eq, &claim, 0.5 * claim.h).unwrap();
                let within = short.parameter(&tube.exit).intersection(between(-1.0, 1.0));
                assert!(!short.is_whole && within.is_empty() == (share.abs() > 0.5));
                assert!(!refute::elsewhere(&short, &tube.exit));
            }
        }
    }
}
