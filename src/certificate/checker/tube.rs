//! One tube, proved again. The mathematics and its notation are in `certs/README.md`.

use super::equations::{Equations, ZERO};
use super::guess::{Inverse, expand};
use super::krawczyk::{Curve, Fault, ORDER, around, between, derivative, polynomial, weight};
use super::place::Place;
use super::whole::size;
use crate::certificate::format::TubeClaim;
use crate::interval::{Interval, point};

/// A proved tube: for |σ| ≤ 1 exactly one zero φ(σ) of F in the cross-section c·(z − ẑ(σ)) = 0
/// with |z − ẑ(σ)|_u ≤ r, regular, at most `distance` from ẑ(σ), φ' at
/// most `slope_distance` from ẑ'.
pub struct Tube {
    /// Coefficients of ẑ, each with n entries and a zero.
    z: Vec<Vec<Interval>>,
    pub normal: Vec<f64>,
    pub weights: Vec<u16>,
    u: Vec<Interval>,
    r: Interval,
    distance: Interval,
    slope_distance: Interval,
    /// c·ẑ'(σ), positive.
    advance: Interval,
    /// Where the path leaves, and the parameter of this point.
    pub exit: (Place, Interval),
    /// 1 − q − η/r.
    pub margin: f64,
}

/// What a tube adds to the account, from its entry to its exit.
pub struct Stretch {
    /// Solutions in the tube.
    pub met: Vec<usize>,
    /// The range of t.
    pub t: Interval,
}

/// Ranges of parameters are not split into more pieces.
const PIECES: usize = 10_000;

impl Tube {
    pub fn prove(eq: &Equations, claim: &TubeClaim) -> Result<Tube, Fault> {
        let n = eq.m + 1;
        let normal: Vec<f64> = claim.normal.iter().map(|&c| c.into()).collect();
        let (c, u) = (&normal, &claim.weights);
        let mut curve = Curve::at(eq, &claim.centre)?;
        let inverse = Inverse::new(&curve, c, u)?;
        expand(&mut curve, &inverse, claim.h)?;
        let r = point(claim.r.into());
        let proof = curve.test(&inverse.whole, c, u, r)?.within(r)?;

        let along = |k: usize| {
            let products = c.iter().zip(&curve.z[k]).map(|(&c, &z)| point(c) * z);
            let range = if k == 1 {
                point(1.0)
            } else {
                around(point(k as f64))
            };
            products.fold(ZERO, |sum, x| sum + x) * range
        };
        let advance = (1..=ORDER).fold(ZERO, |sum, k| sum + along(k));
        if !(advance.inf() > 0.0) {
            return Err("its cross-sections turn back");
        }
        let z = curve.z;
        // A parameter in [−1, 1], whatever is rounded.
        let exit = (claim.exit / claim.h).clamp(-1.0, 1.0);
        let near = |i: usize| z.iter().rev().fold(0.0, |sum, z| sum * exit + z[i].mid());
        let near: Vec<f64> = (0..n).map(near).collect();
        let enough = 1e-6 * r.sup();
        let exit =
            Place::prove(eq, &near, c, u, enough).map_err(|_| "its exit cannot be enclosed")?;
        let mut tube = Tube {
            z,
            u: u.iter().map(|&u| weight(u)).collect(),
            r,
            distance: proof.distance,
            slope_distance: proof.slope_distance,
            advance,
            exit: (exit, ZERO),
            margin: proof.margin,
            weights: claim.weights.clone(),
            normal,
        };
        tube.exit.1 = tube
            .locate(&tube.exit.0.figure)
            .ok_or("its exit does not lie in it for certain")?;
        Ok(tube)
    }

    /// The parameters σ with φ(σ) = z, for a zero z of F that lies in a box. `None`: it could
    /// not be proved that there is one.
    ///
    /// g(σ) = c·(z − ẑ(σ)) falls with slope −c·ẑ'; Newton's interval around 0 holds its zero.
    pub fn locate(&self, z: &[Interval]) -> Option<Interval> {
        let n = self.u.len();
        let along = |sum, i: usize| sum + point(self.normal[i]) * (z[i] - self.z[0][i]);
        let s = (0..n).fold(ZERO, along) / self.advance;
        if !(s.mag() <= 1.0) {
            return None;
        }
        let offset = |i: usize| size(z[i] - polynomial(&self.z, i, s));
        let inside = |i: usize| offset(i).sup() < (self.r * self.u[i]).inf();
        (0..n).all(inside).then_some(s)
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
    /// these solutions, which have t = 1. `Err`: a range where this fails.
    pub fn account(&self, range: Interval, solutions: &[Place]) -> Result<Stretch, (f64, f64)> {
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
            t: t.unwrap_or(Interval::ENTIRE),
        };
        if !stretch.t.contains(1.0) {
            return Ok(stretch);
        }
        // The solutions that are in this tube, and where.
        let here = solutions.iter().enumerate();
        let here = here.filter_map(|(k, solution)| Some((k, self.locate(&solution.figure)?)));
        let here: Vec<(usize, Interval)> = here.collect();
        let mut pieces: Vec<Interval> = parts.collect();
        let mut next = 0;
        while let Some(&part) = pieces.get(next) {
            next += 1;
            // Where t is monotone from a solution on, it is the only one.
            let only = |s: Interval| !self.time_slope(part.convex_hull(s)).contains(0.0);
            if !self.time(part).contains(1.0) || here.iter().any(|&(_, s)| only(s)) {
                continue;
            }
            if pieces.len() > PIECES {
                return Err((part.inf(), part.sup()));
            }
            pieces.push(between(part.inf(), part.mid()));
            pieces.push(between(part.mid(), part.sup()));
        }
        stretch.met = here.into_iter().map(|(k, _)| k).collect();
        Ok(stretch)
    }
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
