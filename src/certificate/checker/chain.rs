//! The chain: every tube linked to the one before, the loop closed, and what that proves.

use super::equations::{Equations, ZERO, unknown};
use super::place::{Place, Spot};
use super::tube::{Stretch, Tube, Unaccounted, Whereabouts};
use crate::certificate::format::{EndClaim, SolutionClaim, TubeClaim};
use crate::certificate::verdict::{Fault, Flaw, Outcome, Verdict};
use crate::interval::{Interval, hull, point};
use rayon::prelude::*;

/// What is kept from one part of the chain to the next: all solutions, and two tubes.
pub struct Chain {
    pub eq: Equations,
    sketch: Spot,
    /// The normal of the first tube, in whose direction the path starts.
    start: Vec<f64>,
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

fn faulty(fault: Fault, with: impl FnOnce(Fault) -> Flaw) -> Outcome {
    flaw(fault.is_false, with(fault))
}

impl Chain {
    pub fn new(eq: Equations) -> Self {
        let sketch = &eq.sketch[..=eq.m];
        let near: Vec<f64> = sketch.iter().map(|x| x.mid()).collect();
        let rest = sketch.iter().zip(&near).map(|(&x, &near)| x - point(near));
        Chain {
            sketch: Spot {
                rest: rest.collect(),
                near,
            },
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
            Tube::prove(eq, tube)
                .map_err(|fault| faulty(fault, |f| Flaw::Tube(first + k as u64, f)))
        });
        let tubes: Vec<_> = tubes.collect();
        // How many solutions are listed up to each tube.
        let mut listed = Vec::new();
        for (_, solutions) in claims {
            for solution in solutions {
                let number = self.solutions.len() + 1;
                let solution = Place::solution(eq, solution);
                self.solutions
                    .push(solution.map_err(|fault| faulty(fault, |f| Flaw::Solution(number, f)))?);
            }
            listed.push(self.solutions.len());
        }
        self.met.resize(self.solutions.len(), Some(false));
        if let (true, Some(Ok(tube))) = (self.start.is_empty(), tubes.first()) {
            self.start.clone_from(&tube.normal);
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
        let found = |place: Whereabouts, claim: Flaw| match place {
            Whereabouts::At(s) => Ok(s),
            other => Err(flaw(other == Whereabouts::Elsewhere, claim)),
        };
        let entry = match before {
            None => found(tube.locate(&self.sketch), Flaw::Start)?,
            Some(before) => {
                let (mut link, at) = before.exit.clone();
                let mut place = tube.locate(&link);
                if place == Whereabouts::Unknown {
                    link = before.narrow_exit(&self.eq);
                    place = tube.locate(&link);
                }
                let entry = found(place, Flaw::Link(number))?;
                match before.goes_along(&self.eq, &link, at, &tube.normal) {
                    Some(true) => entry,
                    other => return Err(flaw(other.is_some(), Flaw::Direction(number))),
                }
            }
        };
        let mut exit = tube.exit.1;
        if closes {
            let open = |is_false| flaw(is_false, Flaw::Open(number));
            let sketch = match tube.locate(&self.sketch) {
                Whereabouts::At(s) if s.inf() > entry.sup() => s,
                Whereabouts::At(s) => return Err(open(s.sup() <= entry.inf())),
                other => return Err(open(other == Whereabouts::Elsewhere)),
            };
            match tube.goes_along(&self.eq, &self.sketch, sketch, &self.start) {
                Some(true) => exit = sketch,
                other => return Err(open(other.is_some())),
            }
        } else if !(entry.sup() < exit.inf()) {
            let is_false = entry.inf() >= exit.sup();
            return Err(flaw(is_false, Flaw::Backwards(number)));
        }
        let stretch = tube.account(hull(entry.inf(), exit.sup()), listed);
        stretch.map_err(|Unaccounted(a, b, missing)| flaw(missing, Flaw::Unlisted(number, a, b)))
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
                let undecided = || flaw(false, Flaw::Congruence(j + 1, k + 1));
                if congruent.ok_or_else(undecided)? {
                    class = verdict.classes[j];
                }
            }
            if end.classes[k] != class {
                return Err(flaw(true, Flaw::Class(k + 1, end.classes[k])));
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
                let name = verdict.problem.distance_name(e);
                return Err(flaw(false, Flaw::Length(name, low, high)));
            }
        }
        Ok(())
    }

    /// The coordinates of all points of a solution in the problem's units.
    pub fn points(&self, solution: &Place) -> Vec<[Interval; 3]> {
        let homotopy = &self.eq.homotopy;
        let unit = point(homotopy.unit);
        let coordinate = |p, axis| {
            let claimed = solution.claimed.get(unknown(homotopy, p, axis));
            claimed.map_or(ZERO, |&x| x * unit)
        };
        let points = 0..homotopy.points;
        let points = points.map(|p| std::array::from_fn(|axis| coordinate(p, axis)));
        points.collect()
    }
}
