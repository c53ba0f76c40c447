//! One tube, proved again. The mathematics and its notation are in `certs/README.md`.

use super::equations::{Equations, ZERO};
use super::guess::{Inverse, Moving, expand};
use super::krawczyk::{
    Curve, ORDER, Proof, Section, around, derivative, polynomial, scaled, weight,
};
use super::place::{Place, Spot};
use super::whole::{between, exact, size};
use crate::certificate::format::TubeClaim;
use crate::certificate::verdict::Fault;
use crate::interval::{Interval, point};

/// A proved tube: for |σ| ≤ 1 exactly one zero φ(σ) of F in the cross-section c·(z − ẑ(σ)) = 0
/// with |z − ẑ(σ)|_u ≤ r, regular, at most `distance` from ẑ(σ), φ' at
/// most `slope_distance` from ẑ'.
pub struct Tube {
    pub claim: TubeClaim,
    /// Coefficients of ẑ, each with n entries and a zero.
    z: Vec<Vec<Interval>>,
    /// z₀.
    centre: Spot,
    pub normal: Vec<f64>,
    u: Vec<Interval>,
    r: Interval,
    distance: Interval,
    slope_distance: Interval,
    /// c·ẑ'(σ), positive.
    advance: Interval,
    /// Where the path leaves, and the parameter of this point.
    pub exit: (Spot, Interval),
    /// 1 − q − η/r.
    pub margin: f64,
}

/// Where a zero of F is, seen from a tube.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Whereabouts {
    /// It is φ(σ), for a parameter σ in this interval.
    At(Interval),
    /// It is no φ(σ).
    Elsewhere,
    /// It cannot be told.
    Unknown,
}

/// What a tube adds to the account, from its entry to its exit.
pub struct Stretch {
    /// Solutions in the tube, and those that may be.
    pub met: Vec<usize>,
    pub unknown: Vec<usize>,
    /// The range of t.
    pub t: Interval,
}

/// Where t = 1 is not accounted for: a range of parameters, and whether there certainly is a solution that
/// is not listed.
pub struct Unaccounted(pub f64, pub f64, pub bool);

/// Ranges of parameters are not split into more pieces.
const PIECES: usize = 10_000;
/// How near the path exits are enclosed, in radii, unless it has to be nearer.
const ENOUGH: f64 = 1e-2;

/// What a tube's proof is made of.
struct Work<'a> {
    curve: Curve<'a>,
    at: Section,
    inverse: Inverse,
    r: Interval,
    proof: Proof,
}

impl<'a> Work<'a> {
    fn new(eq: &'a Equations, claim: &TubeClaim) -> Result<Work<'a>, Fault> {
        let c: Vec<f64> = claim.normal.iter().map(|&c| c.into()).collect();
        let mut curve = Curve::at(eq, &claim.centre)?;
        let at = curve.section(&c, &claim.weights);
        let inverse = Inverse::new(&curve, &at)?;
        expand(&mut curve, &inverse, claim.h)?;
        let (y, r) = (&inverse.whole, point(claim.r.into()));
        let test = curve.test(y, &at, r)?;
        let proof = test.within(r).map_err(|fault| {
            // The middle was moved by rounding: a zero within r of where it was, across c there, has a
            // component of `along` here, and is within `wider`.
            let n = eq.m + 1;
            let moved = |i: usize| exact(claim.centre[i]) - curve.z[0][i];
            let along = (0..n).fold(ZERO, |sum, i| sum + point(c[i]) * moved(i));
            let away = (0..n).map(|i| size(moved(i) / weight(at.u[i])));
            let wider = r + away.fold(ZERO, |max, x| if x.sup() > max.sup() { x } else { max });
            let q = test.contraction(wider);
            let reach = wider * (point(1.0) + q);
            let off = y.image(&scaled(curve.residual(0), -along, &at));
            Fault {
                is_false: off.inf() > reach.sup(),
                ..fault
            }
        })?;
        Ok(Work {
            curve,
            at,
            inverse,
            r,
            proof,
        })
    }

    fn moving(&self) -> Moving<'_> {
        Moving {
            curve: &self.curve,
            at: &self.at,
            inverse: &self.inverse,
        }
    }

    /// Encloses φ(σ): for any w in the box, |w − w*| ≤ |Ỹ G(w)| / (1 − q) for the zero w*.
    fn exit(&self, s: f64, enough: f64) -> Option<Spot> {
        let (eq, n) = (self.curve.eq, self.at.c.len());
        let guess = self.moving().zero(s, enough * self.r.sup());
        let there = Curve::at(eq, &guess).ok()?;
        let centre = &self.curve.z[0];
        let off = |i: usize| {
            let from_centre = there.z[0][i] - centre[i];
            from_centre - polynomial(&self.curve.z[1..], i, point(s)) * point(s)
        };
        let off: Vec<Interval> = (0..n).map(off).collect();
        let inside = |i: usize| size(off[i]).sup() < (self.r * weight(self.at.u[i])).inf();
        if !(0..n).all(inside) {
            return None;
        }
        let along = (0..n).fold(ZERO, |sum, i| sum + point(self.at.c[i]) * off[i]);
        let f = scaled(there.residual(0), along, &self.at);
        let distance = self.proof.solved(&self.inverse.whole, &f);
        Some(Spot {
            near: there.z[0][..n].iter().map(|z| z.mid()).collect(),
            rest: self
                .at
                .u
                .iter()
                .map(|&u| around(distance * weight(u)))
                .collect(),
        })
    }

    /// The path's direction T, c·T = 1, at a point of it that is φ(σ) for a σ near s:
    /// |T − v| ≤ |Ỹ ([J; c] v − e_n)| / (1 − q) for any v.
    fn direction(&self, spot: &Spot, s: f64) -> Vec<Interval> {
        let v = self.moving().tangent(&spot.near, s);
        let off = spot.off_direction(self.curve.eq, &self.at, &v);
        let distance = self.proof.solved(&self.inverse.whole, &off);
        let entries = v.iter().zip(&self.at.u);
        entries
            .map(|(&v, &u)| exact(v) + around(distance * weight(u)))
            .collect()
    }
}

impl Tube {
    pub fn prove(eq: &Equations, claim: &TubeClaim) -> Result<Tube, Fault> {
        let work = Work::new(eq, claim)?;
        let n = eq.m + 1;
        let along = |k: usize| {
            let products = work
                .at
                .c
                .iter()
                .zip(&work.curve.z[k])
                .map(|(&c, &z)| point(c) * z);
            let range = if k == 1 {
                point(1.0)
            } else {
                around(point(k as f64))
            };
            products.fold(ZERO, |sum, x| sum + x) * range
        };
        let advance = (1..=ORDER).fold(ZERO, |sum, k| sum + along(k));
        if !(advance.inf() > 0.0) {
            return Err(Fault::because("its cross-sections may turn back"));
        }
        // A parameter in [−1, 1], whatever is rounded.
        let s = (claim.exit / claim.h).clamp(-1.0, 1.0);
        let exit = work
            .exit(s, ENOUGH)
            .ok_or(Fault::because("its exit cannot be enclosed"))?;
        Ok(Tube {
            claim: claim.clone(),
            centre: Spot {
                near: work.curve.z[0][..n].iter().map(|z| z.mid()).collect(),
                rest: vec![ZERO; n],
            },
            z: work.curve.z,
            u: claim.weights.iter().map(|&u| weight(u)).collect(),
            r: work.r,
            distance: work.proof.distance,
            slope_distance: work.proof.slope_distance,
            advance,
            exit: (exit, point(s)),
            margin: work.proof.margin,
            normal: work.at.c,
        })
    }

    /// The place where the path leaves as narrow as can be.
    pub fn narrow_exit(&self, eq: &Equations) -> Spot {
        let s = self.exit.1.mid();
        let work = Work::new(eq, &self.claim).ok();
        let narrow = work.and_then(|work| work.exit(s, 0.0));
        narrow.unwrap_or_else(|| self.exit.0.clone())
    }

    /// Whether the path, at a point φ(σ) of it with σ in an interval, goes along a normal in this tube's
    /// direction; in a second try as nearly as can be.
    pub fn goes_along(
        &self,
        eq: &Equations,
        spot: &Spot,
        s: Interval,
        normal: &[f64],
    ) -> Option<bool> {
        let slope = |i: usize| derivative(&self.z, i, s) + around(self.slope_distance * self.u[i]);
        let slope: Vec<Interval> = (0..self.u.len()).map(slope).collect();
        super::place::goes_along(&slope, normal).or_else(|| {
            let work = Work::new(eq, &self.claim).ok()?;
            super::place::goes_along(&work.direction(spot, s.mid()), normal)
        })
    }

    /// Where in this tube a zero of F is.
    ///
    /// g(σ) = c·(z − ẑ(σ)) falls with slope −c·ẑ'; Newton's interval around 0 holds its zero in
    /// |σ| ≤ 1, and there is one if the interval lies within.
    pub fn locate(&self, z: &Spot) -> Whereabouts {
        let n = self.u.len();
        let along = |sum, i: usize| sum + point(self.normal[i]) * z.minus(&self.centre, i);
        let s = (0..n).fold(ZERO, along) / self.advance;
        let within = s.intersection(between(-1.0, 1.0));
        if within.is_empty() {
            return Whereabouts::Elsewhere;
        }
        let offset = |i: usize| {
            let along = polynomial(&self.z[1..], i, within) * within;
            size_between(z.minus(&self.centre, i) - along)
        };
        let offsets: Vec<Interval> = (0..n).map(offset).collect();
        let away = |i: usize| offsets[i].inf() > (self.distance * self.u[i]).sup();
        if (0..n).any(away) {
            return Whereabouts::Elsewhere;
        }
        let inside = |i: usize| offsets[i].sup() < (self.r * self.u[i]).inf();
        match s.mag() <= 1.0 && (0..n).all(inside) {
            true => Whereabouts::At(s),
            false => Whereabouts::Unknown,
        }
    }

    /// t on the path for all parameters of a range.
    fn time(&self, s: Interval) -> Interval {
        let (t, middle) = (self.u.len() - 1, point(s.mid()));
        let change = derivative(&self.z, t, s) * (s - middle);
        polynomial(&self.z, t, middle) + change + around(self.distance * self.u[t])
    }

    /// dt/dσ on the path for all parameters of a range.
    fn time_slope(&self, s: Interval) -> Interval {
        let t = self.u.len() - 1;
        derivative(&self.z, t, s) + around(self.slope_distance * self.u[t])
    }

    /// Accounts for all parameters of a range: the path meets t = 1 in no other point of it than
    /// these solutions, which have t = 1.
    pub fn account(&self, range: Interval, solutions: &[Place]) -> Result<Stretch, Unaccounted> {
        const PARTS: u32 = 16;
        let width = range.sup() - range.inf();
        let cut = |k: u32| match k {
            PARTS => range.sup(),
            _ => range.inf() + width * (f64::from(k) / f64::from(PARTS)),
        };
        let parts = (0..PARTS).map(|k| between(cut(k), cut(k + 1)));
        let t = parts
            .clone()
            .map(|part| self.time(part))
            .reduce(|a, b| a.convex_hull(b));
        let mut stretch = Stretch {
            met: Vec::new(),
            unknown: Vec::new(),
            t: t.unwrap_or(Interval::ENTIRE),
        };
        if !stretch.t.contains(1.0) {
            return Ok(stretch);
        }
        // The solutions that are in this tube, and where.
        let mut here = Vec::new();
        for (k, solution) in solutions.iter().enumerate() {
            match self.locate(&solution.spot) {
                Whereabouts::At(s) => {
                    stretch.met.push(k);
                    here.push(s);
                }
                Whereabouts::Elsewhere => {}
                Whereabouts::Unknown => stretch.unknown.push(k),
            }
        }
        let mut pieces: Vec<Interval> = parts.collect();
        let mut next = 0;
        while let Some(&part) = pieces.get(next) {
            next += 1;
            // Where t is monotone from a solution on, it is the only one.
            let only = |s: Interval| !self.time_slope(part.convex_hull(s)).contains(0.0);
            if !self.time(part).contains(1.0) || here.iter().any(|&s| only(s)) {
                continue;
            }
            // Where t passes 1 for certain, and all listed solutions are certainly elsewhere, one is missing.
            let [from, to] = [part.inf(), part.sup()].map(|s| self.time(exact(s)));
            let passes = from.sup() < 1.0 && to.inf() > 1.0 || from.inf() > 1.0 && to.sup() < 1.0;
            let missing =
                passes && stretch.unknown.is_empty() && here.iter().all(|s| s.disjoint(part));
            if missing || pieces.len() > PIECES {
                return Err(Unaccounted(part.inf(), part.sup(), missing));
            }
            pieces.push(between(part.inf(), part.mid()));
            pieces.push(between(part.mid(), part.sup()));
        }
        Ok(stretch)
    }
}

/// The sizes of the numbers of an interval.
fn size_between(x: Interval) -> Interval {
    between(x.mig(), x.mag())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::format::Record;
    use crate::certificate::reader::Reader;
    use crate::system::Homotopy;

    /// Bounds over whole tubes against what the test proves at single points: where the path is,
    /// and where it goes.
    #[test]
    fn the_path_and_its_slope_are_where_tubes_say() {
        for name in ["k33", "dodecagon", "prism"] {
            let file = std::fs::File::open(format!("certs/{name}.krawl")).unwrap();
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
                let tube = Tube::prove(&eq, &claim).unwrap();
                for s in [-0.99, -0.7, -0.2, 0.0, 0.4, 0.8, 1.0].map(point) {
                    let n = eq.m + 1;
                    let z: Vec<Interval> = (0..n).map(|i| polynomial(&tube.z, i, s)).collect();
                    let middle: Vec<f64> = z.iter().map(|z| z.mid()).collect();
                    let place = Place::prove(&eq, &middle, &tube.normal, &tube.weights, 0.0);
                    let place = place.unwrap();
                    for i in 0..n {
                        let off = (place.figure[i] - z[i]).mig();
                        let bound = (tube.distance * tube.u[i]).sup();
                        assert!(off <= bound, "{name}: {off:e} from the middle, {bound:e}");
                        nearest = nearest.min(bound / off);
                        // With c·T = 1 and c·φ' = c·ẑ'.
                        let slope = place.tangent[i] * tube.advance - derivative(&tube.z, i, s);
                        let bound = (tube.slope_distance * tube.u[i]).sup();
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
}
