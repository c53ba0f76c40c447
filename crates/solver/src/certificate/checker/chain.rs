//! The chain: every tube linked to the one before, the loop closed, and what that proves.

use super::arc::{Edits, Fold, keeps, rises};
use super::degenerate::Divided;
use super::equations::{Equations, ZERO};
use super::matrix::between;
use super::place::{Place, Spot, component};
use super::refute;
use super::tube::{Met, Stretch, Tube, direction};
use crate::certificate::format::{ArcClaim, EndClaim, Ending, Record, SolutionClaim, TubeClaim};
use crate::certificate::verdict::{Arc, Flaw, Outcome, Verdict};
use crate::interval::{Interval, hull, point};
use crate::problem::Problem;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// What is kept from one part of the chain to the next: all solutions, and two tubes.
pub struct Chain {
    pub eq: Equations,
    /// Where the first tube begins: at the sketch, or at the figure where the last edit ended.
    from: Spot,
    /// The path's direction there, along the normal of the first tube.
    start: Vec<Interval>,
    last: Option<Tube>,
    /// The equations with heights divided by 1 − t, once they were wanted, and whether the tubes to come are of those.
    divided: Option<Box<Divided>>,
    is_divided: bool,
    /// In the problem's own unknowns.
    pub solutions: Vec<Place>,
    /// Where degenerate (flat) ones among them, by their places in that list, are in the divided equations' unknowns.
    pub flat: BTreeMap<usize, Spot>,
    /// Whether the path meets each of them: the best that any tube says.
    met: Vec<Met>,
    /// Whether the tubes to come are those behind the turn.
    turned: bool,
    /// The problem's dimensions as they are now, and the edit that is followed.
    edits: Edits,
    arc: Option<ArcClaim>,
}

/// Where the last tube of a part leads.
enum Goal {
    /// On to the next.
    On,
    /// Back to the sketch.
    Sketch,
    /// To a figure with t = 1.
    Figure(Place),
    Fold(Fold),
}

/// The outcome where a claim is false, or only not proved.
fn flaw(is_false: bool, flaw: Flaw) -> Outcome {
    match is_false {
        true => Outcome::Refuted(flaw),
        false => Outcome::NotProved(flaw),
    }
}

impl Chain {
    pub fn new(eq: Equations, problem: &Problem) -> Self {
        Chain {
            from: sketch(&eq),
            eq,
            start: Vec::new(),
            last: None,
            divided: None,
            is_divided: false,
            flat: BTreeMap::new(),
            solutions: Vec::new(),
            met: Vec::new(),
            turned: false,
            edits: Edits::new(problem),
            arc: None,
        }
    }

    /// Proves and links tubes, each with the solutions that were first met in it, on all
    /// threads. The flaw is the first in their order. `mark` is the record behind the last of them.
    pub fn add(
        &mut self,
        claims: &[(TubeClaim, Vec<SolutionClaim>)],
        mark: Option<&Record>,
        verdict: &mut Verdict,
    ) -> Result<(), Outcome> {
        let divided = self.divided.as_ref().filter(|_| self.is_divided);
        let eq = divided.map_or(&self.eq, |divided| &divided.eq);
        let first = verdict.tubes + 1;
        let tubes = claims.par_iter().enumerate().map(|(k, (tube, _))| {
            let number = first + k as u64;
            Tube::prove(eq, tube).map_err(|f| flaw(f.is_false, Flaw::Tube(number, f)))
        });
        let tubes: Vec<_> = tubes.collect();
        // How many solutions are listed up to each tube.
        let mut listed = Vec::new();
        for (tube, solutions) in claims {
            for solution in solutions {
                let number = self.solutions.len() + 1;
                let solution = Place::solution(eq, solution, tube);
                let solution = solution.map_err(|f| flaw(f.is_false, Flaw::Solution(number, f)));
                let mut place = solution?;
                if let Some(divided) = divided {
                    let given = divided.flat_figure(&place);
                    let there = std::mem::replace(&mut place, given).spot;
                    self.flat.insert(number - 1, there);
                }
                self.solutions.push(place);
            }
            listed.push(self.solutions.len());
        }
        self.met.resize(self.solutions.len(), Met::No);
        if let (None, Some((claim, _))) = (&self.last, claims.first()) {
            let start = direction(eq, claim, &self.from).unwrap_or_default();
            if self.turned {
                let tube = tubes[0].as_ref().map_err(Outcome::clone)?;
                let along = component(&self.start, &tube.normal);
                if !(along.sup() < 0.0) {
                    let is_there = tube.locate(&self.from).is_some();
                    return Err(flaw(is_there && along.inf() > 0.0, Flaw::Turn(first)));
                }
            } else {
                self.start = start;
            }
        }

        let arc = verdict.arcs.len() + 1;
        let goal = match (mark, claims.last()) {
            (Some(Record::End(end)), _) if self.arc.is_none() && end.ending == Ending::Complete => {
                Goal::Sketch
            }
            (Some(Record::Reached(claim)), Some((tube, _))) => {
                let place = Place::solution(eq, claim, tube);
                Goal::Figure(place.map_err(|f| flaw(f.is_false, Flaw::Figure(arc, f)))?)
            }
            (Some(Record::Fold(claim)), Some((tube, _))) => {
                let fold = Fold::prove(eq, claim, tube);
                Goal::Fold(fold.map_err(|f| flaw(f.is_false, Flaw::Fold(arc, f)))?)
            }
            _ => Goal::On,
        };
        // Tubes tell of solutions in their own unknowns alone.
        let spot = |k: usize| match (self.flat.get(&k), self.is_divided) {
            (None, false) => Some(&self.solutions[k].spot),
            (flat, is_divided) => flat.filter(|_| is_divided),
        };
        let spots: Vec<Option<&Spot>> = (0..self.solutions.len()).map(spot).collect();
        let join = |k: usize| {
            let before = match k {
                0 => self.last.as_ref(),
                _ => Some(tubes[k - 1].as_ref().map_err(Outcome::clone)?),
            };
            let tube = tubes[k].as_ref().map_err(Outcome::clone)?;
            let goal = match k + 1 == tubes.len() {
                true => &goal,
                false => &Goal::On,
            };
            let solutions = &spots[..listed[k]];
            let stretch = self.join(eq, (first + k as u64, arc), before, tube, goal, solutions)?;
            Ok((tube.proof.margin, stretch))
        };
        let joined: Vec<_> = (0..tubes.len()).into_par_iter().map(join).collect();
        for joined in joined {
            let (margin, stretch) = joined?;
            verdict.tubes += 1;
            verdict.margin = verdict.margin.min(margin);
            let (low, high) = verdict.t_range;
            let t = stretch.t + point(1.0);
            verdict.t_range = (low.min(t.inf()), high.max(t.sup()));
            let both = self.met.iter_mut().zip(stretch.met);
            both.for_each(|(all, met)| *all = met.max(*all));
        }
        self.last = tubes
            .into_iter()
            .next_back()
            .and_then(Result::ok)
            .or(self.last.take());
        self.go_on(mark, goal, verdict)
    }

    /// What follows is another edit, or the other way from the sketch.
    fn go_on(
        &mut self,
        mark: Option<&Record>,
        goal: Goal,
        verdict: &mut Verdict,
    ) -> Result<(), Outcome> {
        let end = match &goal {
            Goal::Figure(place) => Some((point(1.0), &place.spot)),
            Goal::Fold(fold) => Some((fold.spot.at(self.eq.m), &fold.spot)),
            Goal::On | Goal::Sketch => None,
        };
        if let Some((t, spot)) = end
            && let Some(claim) = self.arc.take()
        {
            let figure: Vec<Interval> = (0..self.eq.m).map(|i| spot.at(i)).collect();
            let figure = self.points(&figure);
            verdict.arcs.push(Arc { claim, t, figure });
        }
        if let Goal::Figure(place) = goal {
            self.from = place.spot;
            self.from.near[self.eq.m] = 0.0;
        }
        match mark {
            Some(Record::Turn) => (self.last, self.turned) = (None, true),
            Some(Record::Arc(claim)) => {
                self.set_out(claim, verdict)?;
                self.arc = Some(claim.clone());
            }
            Some(Record::Motion(claim)) => {
                self.set_out(claim, verdict)?;
                verdict.motion = Some(claim.clone());
            }
            Some(Record::Divide) => self.change(true, verdict.tubes)?,
            Some(Record::Return) => self.change(false, verdict.tubes)?,
            _ => {}
        }
        Ok(())
    }

    /// What follows are tubes of the divided equations, or of the given ones again: the point where the last tube is left, and the
    /// path's direction there, are carried over, to be linked to the next tube as in one system.
    fn change(&mut self, is_divided: bool, tubes: u64) -> Result<(), Outcome> {
        if self.divided.is_none() {
            self.divided = Divided::new(&self.eq.homotopy).map(Box::new);
        }
        let carried = match (&self.divided, &mut self.last) {
            (Some(divided), Some(last)) => divided.carry(&self.eq, last, !is_divided),
            _ => None,
        };
        self.is_divided = is_divided;
        carried.ok_or(flaw(false, Flaw::Change(tubes)))
    }

    /// What follows are tubes of an edit, or of a motion.
    fn set_out(&mut self, claim: &ArcClaim, verdict: &mut Verdict) -> Result<(), Outcome> {
        let number = verdict.arcs.len() + 1;
        let eq = self.edits.equations(claim, number, &self.eq.homotopy);
        self.eq = eq.map_err(|(is_false, claim)| flaw(is_false, claim))?;
        if number == 1 {
            self.from = sketch(&self.eq);
        }
        (self.last, self.turned, verdict.is_edit) = (None, false, true);
        verdict.t_range = (f64::INFINITY, f64::NEG_INFINITY);
        Ok(())
    }

    /// Links a tube to the one before, or to the sketch, and accounts for its stretch of the path:
    /// from its entry to its exit, or to the goal.
    fn join(
        &self,
        eq: &Equations,
        (number, arc): (u64, usize),
        before: Option<&Tube>,
        tube: &Tube,
        goal: &Goal,
        listed: &[Option<&Spot>],
    ) -> Result<Stretch, Outcome> {
        // What is claimed of tubes that were not proved to their ends may be true of what is beyond.
        let is_whole = tube.is_whole && before.is_none_or(|before| before.is_whole);
        let flaw = |is_false: bool, claim: Flaw| flaw(is_false && is_whole, claim);
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
            None => find(&self.from, Flaw::Start)?,
            Some(before) => {
                let entry = find(&before.exit, Flaw::Link(number))?;
                along(&before.exit_direction, Flaw::Direction(number))?;
                entry
            }
        };
        let (exit, claim) = match goal {
            Goal::On => (tube.exit_at, Flaw::Backwards(number)),
            Goal::Sketch => (find(&self.from, Flaw::Open(number))?, Flaw::Open(number)),
            Goal::Figure(Place { spot, .. }) | Goal::Fold(Fold { spot, .. }) => {
                (find(spot, Flaw::Elsewhere(arc))?, Flaw::Elsewhere(arc))
            }
        };
        if before.is_none() && matches!(goal, Goal::Sketch) {
            return Err(Outcome::Refuted(claim));
        }
        order(entry, exit, claim.clone())?;
        if let Goal::Sketch = goal {
            along(&self.start, claim)?;
        }
        let range = hull(entry.inf(), exit.sup());
        let stands = tube.stands(eq, range);
        stands.map_err(|fault| flaw(false, Flaw::Tube(number, fault)))?;
        // Certainly between entry and exit.
        let inner = between(entry.sup(), exit.inf());
        let Some(edit) = &self.arc else {
            let stretch = tube.account(eq, [entry, exit], listed);
            let mut stretch = stretch.map_err(|part| {
                let missing = refute::missing(tube, inner, listed);
                let at = missing.unwrap_or(part);
                let claim = Flaw::Unlisted(number, at.inf(), at.sup());
                flaw(missing.is_some(), claim)
            })?;
            let least = if is_whole { Met::No } else { Met::Unknown };
            let met = stretch.met.iter_mut();
            met.for_each(|met| *met = least.max(*met));
            return Ok(stretch);
        };
        // It begins to rise in the first tube, and goes on in the others.
        if before.is_none() && !self.start.last().is_some_and(|t| t.inf() > 0.0) {
            let falls = self.start.last().is_some_and(|t| t.sup() < 0.0);
            return Err(flaw(falls, Flaw::Rise(number, entry.inf(), entry.sup())));
        }
        let fold = match goal {
            Goal::Fold(fold) => Some(fold),
            _ => None,
        };
        let fault = |claim: fn(u64, f64, f64) -> Flaw| {
            move |(s, is_false): (Interval, bool)| {
                let is_false = is_false && !s.disjoint(inner);
                flaw(is_false, claim(number, s.inf(), s.sup()))
            }
        };
        rises(tube, range, fold).map_err(fault(Flaw::Rise))?;
        keeps(&self.eq, tube, range, &edit.kept).map_err(fault(Flaw::Kept))?;
        Ok(Stretch {
            met: Vec::new(),
            t: tube.time(entry).convex_hull(tube.time(exit)),
        })
    }

    /// What remains to be proved when all tubes are linked.
    pub fn conclude(&self, end: &EndClaim, verdict: &mut Verdict) -> Result<(), Outcome> {
        let closed = end.ending == Ending::Complete;
        if self.last.is_none() && closed {
            return Err(flaw(true, Flaw::Empty));
        }
        for (k, solution) in self.solutions.iter().enumerate() {
            verdict.margin = verdict.margin.min(solution.margin);
            // A point of a tube is on the path; on an arc it is where it lies between entry and exit.
            let enough = if closed { Met::InTube } else { Met::Yes };
            if self.met[k] < enough {
                return Err(flaw(self.met[k] == Met::No, Flaw::Unmet(k + 1)));
            }
            let mut class = verdict.classes.iter().max().map_or(0, |c| c + 1);
            for (j, other) in self.solutions[..k].iter().enumerate() {
                if !solution.is_apart(other) {
                    let overlap = refute::overlap(solution, other);
                    return Err(flaw(overlap, Flaw::Overlap(j + 1, k + 1)));
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

    /// The coordinates of all points of a figure in the problem's units.
    pub fn points(&self, figure: &[Interval]) -> Vec<[Interval; 3]> {
        let homotopy = &self.eq.homotopy;
        let unit = point(homotopy.unit);
        let coordinate = |p, axis| {
            let free = homotopy.coordinate(p, axis);
            free.map_or(ZERO, |i| figure[i] * unit)
        };
        let points = 0..homotopy.points;
        let points = points.map(|p| std::array::from_fn(|axis| coordinate(p, axis)));
        points.collect()
    }
}

/// The exact sketch, and t = 0.
fn sketch(eq: &Equations) -> Spot {
    let sketch: Vec<Interval> = eq.homotopy.sketch_of_unknowns().chain([ZERO]).collect();
    Spot::around(&sketch)
}
