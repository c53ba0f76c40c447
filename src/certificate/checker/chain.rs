//! The chain: every tube linked to the one before, the loop closed, and what that proves.

use super::equations::{Equations, ZERO};
use super::place::{Place, Spot, component};
use super::refute;
use super::tube::{Stretch, Tube, direction};
use crate::certificate::format::{EndClaim, SolutionClaim, TubeClaim};
use crate::certificate::verdict::{Flaw, Outcome, Verdict};
use crate::interval::{Interval, hull, point};
use rayon::prelude::*;

/// What is kept from one part of the chain to the next: all solutions, and two tubes.
pub struct Chain {
    pub eq: Equations,
    sketch: Spot,
    /// The path's direction at the sketch, along the normal of the first tube.
    start: Vec<Interval>,
    last: Option<Tube>,
    pub solutions: Vec<Place>,
    /// Whether the path meets each of them, if that is known.
    met: Vec<Option<bool>>,
}

/// The outcome where a claim is false, or only not proved.
fn flaw(is_false: bool, flaw: Flaw) -> Outcome {
    match is_false {
        true => Outcome::Refuted(flaw),
        false => Outcome::NotProved(flaw),
    }
}

impl Chain {
    pub fn new(eq: Equations) -> Self {
        let sketch: Vec<Interval> = eq.homotopy.sketch_of_unknowns().chain([ZERO]).collect();
        let near = sketch.iter().map(|x| x.mid()).collect();
        let rest = sketch.iter().map(|&x| x - point(x.mid())).collect();
        Chain {
            sketch: Spot { near, rest },
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
    ) -> Result<(), Outcome> {
        let (eq, first) = (&self.eq, verdict.tubes + 1);
        let tubes = claims.par_iter().enumerate().map(|(k, (tube, _))| {
            let number = first + k as u64;
            Tube::prove(eq, tube).map_err(|f| flaw(f.is_false, Flaw::Tube(number, f)))
        });
        let tubes: Vec<_> = tubes.collect();
        // How many solutions are listed up to each tube.
        let mut listed = Vec::new();
        for (_, solutions) in claims {
            for solution in solutions {
                let number = self.solutions.len() + 1;
                let solution = Place::solution(eq, solution);
                let solution = solution.map_err(|f| flaw(f.is_false, Flaw::Solution(number, f)));
                self.solutions.push(solution?);
            }
            listed.push(self.solutions.len());
        }
        self.met.resize(self.solutions.len(), Some(false));
        if let (true, Some((claim, _))) = (self.start.is_empty(), claims.first()) {
            self.start = direction(eq, claim, &self.sketch).unwrap_or_default();
        }

        let join = |k: usize| {
            let before = match k {
                0 => self.last.as_ref(),
                _ => Some(tubes[k - 1].as_ref().map_err(Outcome::clone)?),
            };
            let tube = tubes[k].as_ref().map_err(Outcome::clone)?;
            let (number, closes) = (first + k as u64, closes && k + 1 == tubes.len());
            let stretch = self.join(number, before, tube, closes, &self.solutions[..listed[k]])?;
            Ok((tube.margin, stretch))
        };
        let joined: Vec<_> = (0..tubes.len()).into_par_iter().map(join).collect();
        for joined in joined {
            let (margin, stretch) = joined?;
            verdict.tubes += 1;
            verdict.margin = verdict.margin.min(margin);
            let (low, high) = verdict.t_range;
            verdict.t_range = (low.min(stretch.t.inf()), high.max(stretch.t.sup()));
            for k in stretch.unknown {
                self.met[k] = self.met[k].filter(|&met| met);
            }
            stretch
                .met
                .into_iter()
                .for_each(|k| self.met[k] = Some(true));
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
    ) -> Result<Stretch, Outcome> {
        let find = |spot: &Spot, claim: Flaw| {
            let place = tube.locate(spot);
            place.ok_or_else(|| flaw(refute::elsewhere(tube, spot), claim))
        };
        // That a direction is along the tube's normal, and that one parameter is before another.
        let along = |direction: &[Interval], claim: Flaw| match component(direction, &tube.normal) {
            x if x.inf() > 0.0 => Ok(()),
            x => Err(flaw(x.sup() < 0.0, claim)),
        };
        let order = |a: Interval, b: Interval, claim: Flaw| match a.sup() < b.inf() {
            true => Ok(()),
            false => Err(flaw(a.inf() >= b.sup(), claim)),
        };
        let entry = match before {
            None => find(&self.sketch, Flaw::Start)?,
            Some(before) => {
                let entry = find(&before.exit, Flaw::Link(number))?;
                along(&before.exit_direction, Flaw::Direction(number))?;
                entry
            }
        };
        let mut exit = point(tube.exit_at);
        if closes {
            exit = find(&self.sketch, Flaw::Open(number))?;
            if before.is_none() {
                return Err(flaw(true, Flaw::Open(number)));
            }
            order(entry, exit, Flaw::Open(number))?;
            along(&self.start, Flaw::Open(number))?;
        } else {
            order(entry, exit, Flaw::Backwards(number))?;
        }
        let stretch = tube.account(hull(entry.inf(), exit.sup()), listed);
        stretch.map_err(|part| {
            let claim = Flaw::Unlisted(number, part.inf(), part.sup());
            flaw(refute::missing(tube, part, listed), claim)
        })
    }

    /// What remains to be proved when all tubes are linked.
    pub fn conclude(&self, end: &EndClaim, verdict: &mut Verdict) -> Result<(), Outcome> {
        match (&self.last, &end.stopped) {
            (None, None) => return Err(flaw(true, Flaw::Empty)),
            (None, Some(_)) => return Ok(()),
            _ => {}
        }
        for (k, solution) in self.solutions.iter().enumerate() {
            verdict.margin = verdict.margin.min(solution.margin);
            if self.met[k] != Some(true) {
                return Err(flaw(self.met[k].is_some(), Flaw::Unmet(k + 1)));
            }
            let mut class = verdict.classes.iter().max().map_or(0, |c| c + 1);
            for (j, other) in self.solutions[..k].iter().enumerate() {
                if !solution.is_apart(other) {
                    return Err(flaw(true, Flaw::Overlap(j + 1, k + 1)));
                }
                let congruent = solution.is_congruent(other, &self.eq);
                if congruent.ok_or(flaw(false, Flaw::Congruence(j + 1, k + 1)))? {
                    class = verdict.classes[j];
                }
            }
            if end.classes[k] != class {
                return Err(flaw(true, Flaw::Class(k + 1, end.classes[k])));
            }
            verdict.classes.push(class);
        }
        Ok(())
    }

    /// The coordinates of all points of a solution in the problem's units.
    pub fn points(&self, solution: &Place) -> Vec<[Interval; 3]> {
        let homotopy = &self.eq.homotopy;
        let unit = point(homotopy.unit);
        let coordinate = |p, axis| {
            let free = homotopy.coordinate(p, axis);
            free.map_or(ZERO, |i| solution.claimed[i] * unit)
        };
        let points = 0..homotopy.points;
        let points = points.map(|p| std::array::from_fn(|axis| coordinate(p, axis)));
        points.collect()
    }
}
