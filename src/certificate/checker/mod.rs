//! Proves a certificate's claims again, each tube on its own and then the chain.

// Comparisons are written so that a NaN fails them.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod equations;
mod solution;
mod tube;
mod whole;

use super::format::{EndClaim, FormatError, Record, SolutionClaim, TubeClaim};
use super::reader::Reader;
use super::verdict::{Flaw, Outcome, Verdict};
use crate::interval::{Interval, hull, point};
use crate::system::Homotopy;
use equations::Equations;
use rayon::prelude::*;
use solution::Solution;
use std::io::Read;
use tube::Tube;

/// How to check.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Settings {
    /// Threads to use; 0 for one per processor. The verdict does not depend on it.
    pub threads: usize,
}

/// Where a check is: tubes checked so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stage {
    /// Tubes proved and linked.
    pub tubes: u64,
    /// Solutions proved.
    pub solutions: usize,
}

/// Tubes that are checked at a time. All that is kept of one chunk for the next is its last tube.
const CHUNK: usize = 64;

/// Checks a certificate, read from a stream, in memory that does not grow with the chain.
///
/// Fails where the stream is not a certificate; whether its claims hold is in the verdict.
pub fn verify(
    input: impl Read,
    settings: &Settings,
    progress: &mut dyn FnMut(Stage),
) -> Result<Verdict, FormatError> {
    let mut reader = Reader::new(input)?;
    let header = reader.header();
    let mut verdict = Verdict {
        outcome: Outcome::Verified,
        problem: header.problem.clone(),
        program: header.program.clone(),
        tubes: 0,
        solutions: Vec::new(),
        classes: Vec::new(),
        margin: 1.0,
        t_range: (f64::INFINITY, f64::NEG_INFINITY),
    };
    let unit = 2f64.powi(header.unit_exponent.into());
    let homotopy = match Homotopy::with_unit(&header.problem, unit) {
        Ok(homotopy) => homotopy,
        Err(error) => {
            verdict.outcome = Outcome::Refuted(Flaw::Sketch(error.to_string()));
            return Ok(verdict);
        }
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(settings.threads);
    let pool = pool
        .build()
        .map_err(|e| FormatError::Unreadable(std::io::Error::other(e)))?;
    let mut chain = Chain {
        eq: Equations::new(homotopy),
        last: None,
        start: Vec::new(),
        solutions: Vec::new(),
        met: Vec::new(),
    };
    let mut flaw = None;
    let mut ahead = None;
    let end = loop {
        let (chunk, end) = read_chunk(&mut reader, &mut ahead)?;
        if flaw.is_none() {
            flaw = pool
                .install(|| chain.add(chunk, end.as_ref(), &mut verdict))
                .err();
            let solutions = chain.solutions.len();
            progress(Stage {
                tubes: verdict.tubes,
                solutions,
            });
        }
        if let Some(end) = end {
            break end;
        }
    };
    verdict.solutions = chain
        .solutions
        .iter()
        .map(|s| chain.points(s, unit))
        .collect();
    verdict.outcome = match flaw.map_or_else(|| chain.conclude(&end, &mut verdict), Err) {
        Err(flaw) => Outcome::Refuted(flaw),
        Ok(()) => end.stopped.map_or(Outcome::Verified, Outcome::Partial),
    };
    Ok(verdict)
}

type Chunk = Vec<(TubeClaim, Vec<SolutionClaim>)>;

/// Reads tubes, each with the solutions that follow it, and the end if it is reached.
fn read_chunk<R: Read>(
    reader: &mut Reader<R>,
    ahead: &mut Option<TubeClaim>,
) -> Result<(Chunk, Option<EndClaim>), FormatError> {
    let mut chunk: Chunk = ahead
        .take()
        .map(|tube| (tube, Vec::new()))
        .into_iter()
        .collect();
    loop {
        match reader.next_record()? {
            Some(Record::Tube(tube)) if chunk.len() == CHUNK => {
                *ahead = Some(tube);
                return Ok((chunk, None));
            }
            Some(Record::Tube(tube)) => chunk.push((tube, Vec::new())),
            Some(Record::Solution(solution)) => {
                // The reader has seen to it that there is a tube before.
                chunk
                    .last_mut()
                    .into_iter()
                    .for_each(|last| last.1.push(solution.clone()));
            }
            Some(Record::End(end)) => return Ok((chunk, Some(end))),
            None => return Err(FormatError::Truncated("the chain of tubes")),
        }
    }
}

/// What is kept from chunk to chunk.
struct Chain {
    eq: Equations,
    last: Option<Tube>,
    /// The normal of the first tube.
    start: Vec<Interval>,
    solutions: Vec<Solution>,
    met: Vec<bool>,
}

/// What one tube adds to the account.
struct Joined {
    met: Vec<usize>,
    t: Interval,
}

impl Chain {
    /// Proves and links the tubes of a chunk. The flaw found is the first in order.
    fn add(
        &mut self,
        chunk: Chunk,
        end: Option<&EndClaim>,
        verdict: &mut Verdict,
    ) -> Result<(), Flaw> {
        let eq = &self.eq;
        let first = verdict.tubes;
        let proofs: Vec<_> = chunk
            .par_iter()
            .map(|(tube, found)| {
                let found = found.iter().map(|claim| Solution::prove(eq, claim));
                (Tube::prove(eq, tube), found.collect::<Vec<_>>())
            })
            .collect();
        let mut tubes = Vec::new();
        // For each tube the number of solutions listed up to there.
        let mut listed = Vec::new();
        let mut flaw = None;
        'tubes: for (k, (tube, found)) in proofs.into_iter().enumerate() {
            match tube {
                Ok(tube) => tubes.push(tube),
                Err(fault) => {
                    flaw = Some(Flaw::Tube(first + k as u64 + 1, fault));
                    break;
                }
            }
            for solution in found {
                match solution {
                    Ok(solution) => self.solutions.push(solution),
                    Err(fault) => {
                        flaw = Some(Flaw::Solution(self.solutions.len() + 1, fault));
                        tubes.pop();
                        break 'tubes;
                    }
                }
            }
            listed.push(self.solutions.len());
        }
        self.met.resize(self.solutions.len(), false);
        if self.start.is_empty() {
            self.start = tubes.first().map_or(Vec::new(), |tube| tube.normal.clone());
        }
        let closed = end.is_some_and(|end| end.stopped.is_none()) && flaw.is_none();
        let joined: Vec<Result<Joined, Flaw>> = (0..tubes.len())
            .into_par_iter()
            .map(|k| {
                let before = if k == 0 {
                    self.last.as_ref()
                } else {
                    Some(&tubes[k - 1])
                };
                let closes = closed && k + 1 == tubes.len();
                self.join(first + k as u64 + 1, before, &tubes[k], closes, listed[k])
            })
            .collect();
        for (tube, joined) in tubes.iter().zip(joined) {
            let joined = joined?;
            verdict.tubes += 1;
            verdict.margin = verdict.margin.min(tube.margin);
            let (low, high) = verdict.t_range;
            verdict.t_range = (low.min(joined.t.inf()), high.max(joined.t.sup()));
            joined.met.into_iter().for_each(|k| self.met[k] = true);
        }
        self.last = tubes.pop().or_else(|| self.last.take());
        flaw.map_or(Ok(()), Err)
    }

    /// Links a tube to the one before, or to the sketch, and finds all solutions in its stretch
    /// of the path: from its entry to its exit, or to the sketch where it closes the loop.
    fn join(
        &self,
        number: u64,
        before: Option<&Tube>,
        tube: &Tube,
        closes: bool,
        listed: usize,
    ) -> Result<Joined, Flaw> {
        let entry = match before {
            None => tube.locate(&self.eq.sketch).ok_or(Flaw::Start)?,
            Some(before) => {
                if !before.goes_along(point(before.exit), &tube.normal) {
                    return Err(Flaw::Direction(number));
                }
                tube.locate(&before.exit_box).ok_or(Flaw::Link(number))?
            }
        };
        let mut to = tube.exit;
        if closes {
            let sketch = tube.locate(&self.eq.sketch);
            let sketch =
                sketch.filter(|s| s.inf() > entry.sup() && tube.goes_along(*s, &self.start));
            to = sketch.ok_or(Flaw::Open(number))?.sup();
        } else if !(entry.sup() < to) {
            return Err(Flaw::Backwards(number));
        }
        let from = entry.inf();
        let crossings = tube.crossings(from, to).ok_or(Flaw::Undecided(number))?;
        let met = crossings.into_iter().map(|(a, b)| {
            // In all of the stretch there is one point with t = 1: the solution that lies in it.
            let lies_there = |k: &usize| {
                let at = tube.locate(&self.solutions[*k].figure);
                at.is_some_and(|s| a <= s.inf() && s.sup() <= b)
            };
            (0..listed)
                .rev()
                .find(lies_there)
                .ok_or(Flaw::Unlisted(number, a, b))
        });
        let met = met.collect::<Result<Vec<usize>, Flaw>>()?;
        const PIECES: u32 = 8;
        let at = |k: u32| from + (to - from) * (f64::from(k) / f64::from(PIECES));
        let end = |k: u32| if k == PIECES { to } else { at(k) };
        let pieces = (0..PIECES).map(|k| tube.time(end(k), end(k + 1)));
        let t = pieces
            .reduce(|a, b| a.convex_hull(b))
            .unwrap_or(Interval::ENTIRE);
        Ok(Joined { met, t })
    }

    /// What remains to be proved when all tubes are linked.
    fn conclude(&self, end: &EndClaim, verdict: &mut Verdict) -> Result<(), Flaw> {
        if self.last.is_none() {
            return if end.stopped.is_some() {
                Ok(())
            } else {
                Err(Flaw::Empty)
            };
        }
        for (k, solution) in self.solutions.iter().enumerate() {
            verdict.margin = verdict.margin.min(solution.margin);
            if !self.met[k] {
                return Err(Flaw::Unmet(k + 1));
            }
            let touching = |j: &usize| !solution.is_apart(&self.solutions[*j]);
            if let Some(j) = (0..k).find(touching) {
                return Err(Flaw::Overlap(j + 1, k + 1));
            }
            let mut class = None;
            for j in 0..k {
                let other = &self.solutions[j];
                let congruent = solution.is_congruent(other, &self.eq);
                if congruent.ok_or(Flaw::Congruence(j + 1, k + 1))? {
                    class = Some(verdict.classes[j]);
                }
            }
            let next = verdict.classes.iter().max().map_or(0, |c| c + 1);
            let class = class.unwrap_or(next);
            if end.classes[k] != class {
                return Err(Flaw::Class(k + 1, end.classes[k]));
            }
            verdict.classes.push(class);
        }
        // Exactly a(t) > 0 on pieces of the range.
        const PIECES: u32 = 64;
        let (low, high) = verdict.t_range;
        for (e, length) in self.eq.homotopy.lengths.iter().enumerate() {
            let unproved = || Flaw::Length(verdict.problem.distance_name(e), low, high);
            if !(low.is_finite() && high.is_finite()) {
                return Err(unproved());
            }
            let width = point(high) - point(low);
            let range = |k: u32| hull(f64::from(k), f64::from(k + 1)) / point(PIECES.into());
            let positive = |k| length.enclose(point(low) + width * range(k)).inf() > 0.0;
            if !(0..PIECES).all(positive) {
                return Err(unproved());
            }
        }
        Ok(())
    }

    /// The coordinates of all points in the problem's units.
    fn points(&self, solution: &Solution, unit: f64) -> Vec<[Interval; 3]> {
        let (homotopy, d) = (&self.eq.homotopy, self.eq.homotopy.dimension);
        let coordinate = |p: usize, axis: usize| {
            let fixed = axis >= d || homotopy.gauge.variable[p * d + axis] == self.eq.m;
            if fixed {
                return equations::ZERO;
            }
            solution.figure[homotopy.gauge.variable[p * d + axis]] * point(unit)
        };
        let points = 0..homotopy.points;
        points
            .map(|p| std::array::from_fn(|axis| coordinate(p, axis)))
            .collect()
    }
}
