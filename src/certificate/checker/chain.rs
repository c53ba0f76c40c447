//! The chain: every tube linked to the one before, the loop closed, and what that proves.

use super::equations::{Equations, unknown};
use super::place::{NEAR, Place};
use super::tube::{Stretch, Tube};
use crate::certificate::format::{EndClaim, SolutionClaim, TubeClaim};
use crate::certificate::verdict::{Flaw, Verdict};
use crate::interval::{Interval, hull, point};
use rayon::prelude::*;

/// What is kept from one part of the chain to the next: all solutions, and two tubes.
pub struct Chain {
    pub eq: Equations,
    /// The normal of the first tube, in whose direction the path starts.
    start: Vec<f64>,
    last: Option<Tube>,
    pub solutions: Vec<Place>,
    met: Vec<bool>,
}

impl Chain {
    pub fn new(eq: Equations) -> Self {
        Chain {
            eq,
            start: Vec::new(),
            last: None,
            solutions: Vec::new(),
            met: Vec::new(),
        }
    }

    /// Proves and links tubes, each with the solutions that were first met in it, on all
    /// threads. The flaw is the first in their order. With `closes` the last one closes the loop.
    pub fn add(
        &mut self,
        claims: &[(TubeClaim, Vec<SolutionClaim>)],
        closes: bool,
        verdict: &mut Verdict,
    ) -> Result<(), Flaw> {
        let (eq, first) = (&self.eq, verdict.tubes + 1);
        let tubes = claims.par_iter().enumerate().map(|(k, (tube, _))| {
            Tube::prove(eq, tube).map_err(|fault| Flaw::Tube(first + k as u64, fault))
        });
        let tubes: Vec<_> = tubes.collect();
        // How many solutions are listed up to each tube.
        let mut listed = Vec::new();
        for (_, solutions) in claims {
            for solution in solutions {
                let number = self.solutions.len() + 1;
                let solution = Place::solution(eq, solution);
                self.solutions
                    .push(solution.map_err(|fault| Flaw::Solution(number, fault))?);
            }
            listed.push(self.solutions.len());
        }
        self.met.resize(self.solutions.len(), false);
        if let (true, Some(Ok(tube))) = (self.start.is_empty(), tubes.first()) {
            self.start.clone_from(&tube.normal);
        }

        let join = |k: usize| {
            let before = match k {
                0 => self.last.as_ref(),
                _ => Some(tubes[k - 1].as_ref().map_err(Flaw::clone)?),
            };
            let tube = tubes[k].as_ref().map_err(Flaw::clone)?;
            let (number, closes) = (first + k as u64, closes && k + 1 == tubes.len());
            let stretch = self.join(number, before, tube, closes, &self.solutions[..listed[k]])?;
            Ok((tube.margin.min(tube.exit.0.margin), stretch))
        };
        let joined: Vec<_> = (0..tubes.len()).into_par_iter().map(join).collect();
        for joined in joined {
            let (margin, stretch) = joined?;
            verdict.tubes += 1;
            verdict.margin = verdict.margin.min(margin);
            let (low, high) = verdict.t_range;
            verdict.t_range = (low.min(stretch.t.inf()), high.max(stretch.t.sup()));
            stretch.met.into_iter().for_each(|k| self.met[k] = true);
        }
        self.last = tubes
            .into_iter()
            .next_back()
            .and_then(Result::ok)
            .or(self.last.take());
        Ok(())
    }

    /// Links a tube to the one before, or to the sketch, and accounts for its stretch of the path:
    /// from its entry to its exit, or to the sketch where it closes the loop.
    fn join(
        &self,
        number: u64,
        before: Option<&Tube>,
        tube: &Tube,
        closes: bool,
        listed: &[Place],
    ) -> Result<Stretch, Flaw> {
        let entry = match before {
            None => tube.locate(&self.eq.sketch).ok_or(Flaw::Start)?,
            Some(before) => {
                let link = &before.exit.0;
                let entry = tube.locate(&link.figure).ok_or(Flaw::Link(number))?;
                if !link.goes_along(&tube.normal) {
                    return Err(Flaw::Direction(number));
                }
                entry
            }
        };
        let mut exit = tube.exit.1;
        if closes {
            let sketch = tube.locate(&self.eq.sketch);
            let sketch = sketch.filter(|s| s.inf() > entry.sup() && self.returns(tube));
            exit = sketch.ok_or(Flaw::Open(number))?;
        } else if !(entry.sup() < exit.inf()) {
            return Err(Flaw::Backwards(number));
        }
        let stretch = tube.account(hull(entry.inf(), exit.sup()), listed);
        stretch.map_err(|(a, b)| Flaw::Unlisted(number, a, b))
    }

    /// Whether the path comes to the sketch in this tube in the direction in which it started.
    fn returns(&self, tube: &Tube) -> bool {
        let sketch: Vec<f64> = self.eq.sketch[..=self.eq.m]
            .iter()
            .map(|x| x.mid())
            .collect();
        let place = Place::prove(&self.eq, &sketch, &tube.normal, &tube.weights, 0.0);
        place
            .is_ok_and(|place| place.covers(&self.eq.sketch, NEAR) && place.goes_along(&self.start))
    }

    /// What remains to be proved when all tubes are linked.
    pub fn conclude(&self, end: &EndClaim, verdict: &mut Verdict) -> Result<(), Flaw> {
        match (&self.last, &end.stopped) {
            (None, None) => return Err(Flaw::Empty),
            (None, Some(_)) => return Ok(()),
            _ => {}
        }
        for (k, solution) in self.solutions.iter().enumerate() {
            verdict.margin = verdict.margin.min(solution.margin);
            if !self.met[k] {
                return Err(Flaw::Unmet(k + 1));
            }
            let mut class = verdict.classes.iter().max().map_or(0, |c| c + 1);
            for (j, other) in self.solutions[..k].iter().enumerate() {
                if !solution.is_apart(other) {
                    return Err(Flaw::Overlap(j + 1, k + 1));
                }
                let congruent = solution.is_congruent(other, &self.eq);
                if congruent.ok_or(Flaw::Congruence(j + 1, k + 1))? {
                    class = verdict.classes[j];
                }
            }
            if end.classes[k] != class {
                return Err(Flaw::Class(k + 1, end.classes[k]));
            }
            verdict.classes.push(class);
        }
        // a(t) > 0 on every piece of the range.
        const PIECES: u32 = 64;
        let (low, high) = verdict.t_range;
        for (e, length) in self.eq.homotopy.lengths.iter().enumerate() {
            let piece = |k: u32| {
                let part = hull(f64::from(k), f64::from(k + 1)) / point(PIECES.into());
                point(low) + (point(high) - point(low)) * part
            };
            let finite = low.is_finite() && high.is_finite();
            if !finite || !(0..PIECES).all(|k| length.enclose(piece(k)).inf() > 0.0) {
                return Err(Flaw::Length(verdict.problem.distance_name(e), low, high));
            }
        }
        Ok(())
    }

    /// The coordinates of all points of a solution in the problem's units.
    pub fn points(&self, solution: &Place) -> Vec<[Interval; 3]> {
        let homotopy = &self.eq.homotopy;
        let unit = point(homotopy.unit);
        let coordinate = |p, axis| solution.figure[unknown(homotopy, p, axis)] * unit;
        let points = 0..homotopy.points;
        let points = points.map(|p| std::array::from_fn(|axis| coordinate(p, axis)));
        points.collect()
    }
}
