//! What has been proved along the chain so far: solutions, the range of t, the length.

mod classes;
mod defined;
mod lengths;
mod two_ways;

use super::figures::FigureBox;
use super::link::{Ball, Frame, Tube};
use super::reasons::Doubt;
use super::solution::{Same, SolutionProver};
use crate::interval::point;
use crate::linalg::Vector;
use crate::system::Homotopy;
use crate::track::Place;
use crate::track::events::{Crossing, TimeAlong};
use crate::track::full::{Equations, InverseMaker, path_length};
use crate::track::turns::{Stretch, Turns};

pub use classes::{Congruence, classes, is_congruent};

/// The account of a chain of linked tubes.
#[derive(Debug)]
pub struct Ledger {
    /// The homotopy's.
    unit: f64,
    /// The auxiliary unknowns that must stay positive.
    positive: Vec<usize>,
    /// The vectors that must not vanish: see [`Homotopy::nonzero_vectors`].
    nonzero: Vec<Vec<[usize; 2]>>,
    /// Proves boxes around solutions.
    pub prover: SolutionProver,
    found: Vec<FigureBox>,
    /// Where on the path each of them is.
    places: Vec<Place>,
    /// Where t turns.
    pub turns: Turns,
    /// The stretch of the last tube that belongs to the path, and the path's length up to it.
    pub last_stretch: (f64, f64, f64),
    /// Work space.
    crossings: Vec<Crossing>,
    /// The parameter before which the solution found last is, in the tube entered last.
    pub last_crossing: f64,
    scratch: Vector,
    ball: Ball,
    /// The length of the path, in floats.
    pub length: f64,
    /// An enclosure of the values of t.
    pub t_range: (f64, f64),
}

/// Where a [`Ledger`] stands.
#[derive(Debug, Clone, Copy)]
pub struct Mark {
    found: usize,
    turns: Turns,
    length: f64,
    t_range: (f64, f64),
}

impl Ledger {
    /// An empty account.
    pub fn new(homotopy: &Homotopy, equations: &Equations) -> Self {
        Ledger {
            unit: homotopy.unit,
            positive: homotopy.positive_unknowns(),
            nonzero: homotopy.nonzero_vectors(),
            prover: SolutionProver::new(homotopy, equations),
            found: Vec::new(),
            places: Vec::new(),
            turns: Turns::default(),
            last_stretch: (0.0, 0.0, 0.0),
            crossings: Vec::new(),
            last_crossing: f64::NAN,
            scratch: equations.vector(),
            ball: Ball::new(equations),
            length: 0.0,
            t_range: (f64::INFINITY, f64::NEG_INFINITY),
        }
    }

    /// Empties the account, for another path of the same equations with the lengths of `homotopy`.
    pub fn begin(&mut self, homotopy: &Homotopy) {
        self.prover.set_targets(homotopy);
        self.found.clear();
        self.places.clear();
        self.turns = Turns::default();
        self.length = 0.0;
        self.t_range = (f64::INFINITY, f64::NEG_INFINITY);
    }

    /// Where the account stands.
    pub fn mark(&self) -> Mark {
        Mark {
            found: self.found.len(),
            turns: self.turns,
            length: self.length,
            t_range: self.t_range,
        }
    }

    /// Whether all solutions that were known at a mark are still here: then [`Ledger::return_to`] gives that account again.
    pub fn holds(&self, mark: &Mark) -> bool {
        self.found.len() >= mark.found
    }

    /// Forgets what was entered since.
    pub fn return_to(&mut self, mark: Mark) {
        self.found.truncate(mark.found);
        self.places.truncate(mark.found);
        self.turns = mark.turns;
        (self.length, self.t_range) = (mark.length, mark.t_range);
    }

    /// Takes over the account of a piece of path along which t rises throughout, or falls, kept for other equations
    /// of the same path, in which it passes flat figures: `flat` are those in these unknowns. If it fails nothing
    /// is changed.
    pub fn pass_flat(
        &mut self,
        piece: &Self,
        flat: Vec<FigureBox>,
        rising: bool,
    ) -> Result<(), String> {
        let known = self.found.len();
        self.turns.go_on(rising);
        let (folds, is_certain) = (self.turns.count, self.turns.is_certain());
        for (found, place) in flat.into_iter().zip(&piece.places) {
            let mut others = self.found.iter();
            if others.any(|other| found.is_same(other, |_| false) != Same::No) {
                self.found.truncate(known);
                self.places.truncate(known);
                return Err("it cannot be told from another solution".to_owned());
            }
            self.found.push(found);
            self.places.push(Place {
                arc: self.length + place.arc,
                rising,
                folds: (folds > 0 || is_certain).then_some(folds),
            });
        }
        self.length += piece.length;
        let (low, high) = piece.t_range;
        self.t_range = (self.t_range.0.min(low), self.t_range.1.max(high));
        Ok(())
    }

    /// Enters a linked tube between two parameters, where there is no solution.
    pub fn pass<const N: usize, Y: Frame>(
        &mut self,
        tube: &Tube<N, Y>,
        (from, to): (f64, f64),
    ) -> Result<(), Doubt> {
        self.is_defined(tube, (from, to))?;
        self.length += path_length(&tube.local, from, to, self.unit, &mut self.scratch);
        let time = tube.time();
        let (values, slopes) = time.bounds(from, to);
        self.turns.follow_within(&time, (from, to), slopes, |_| {});
        self.widen_t_range(&time, (from, to), values);
        Ok(())
    }

    /// The solutions so far, in the order of the path.
    pub fn found(&self) -> &[FigureBox] {
        &self.found
    }

    /// Finds all solutions in a linked tube, from its entry to the parameter `to`, the path being followed to
    /// the parameter `until`; `extended` is whether their boxes are proved in extended precision. If it fails
    /// nothing is changed.
    pub fn enter<const N: usize, Y: Frame>(
        &mut self,
        equations: &Equations,
        inverter: &mut InverseMaker,
        tube: &Tube<N, Y>,
        (to, until): (f64, f64),
        extended: bool,
    ) -> Result<(), Doubt> {
        let time = tube.time();
        let from = tube.entry.0.max(-tube.proof.h);
        let to = to.min(tube.proof.h);
        self.is_defined(tube, (from, to))?;
        let mut crossings = std::mem::take(&mut self.crossings);
        let known = self.found.len();
        // One look at all of it is enough for most tubes: t is not 1 there, and dt/ds has one sign.
        let (values, slopes) = time.bounds(from, to);
        let separated = if values.0 > 0.0 || values.1 < 0.0 {
            crossings.clear();
            Ok(())
        } else {
            time.crossings(from, to, &mut crossings)
        };
        let all = separated.map_err(Doubt::Time).and_then(|()| {
            crossings.iter().try_for_each(|&crossing| {
                let (a, b) = crossing.between;
                // Where solutions are near each other it matters from where they are sought.
                let near = if extended {
                    time.zero_between((a, b))
                } else {
                    0.5 * (a + b)
                };
                self.prove_crossing(equations, inverter, tube, (crossing, near), extended)
            })
        });
        self.crossings = crossings;
        if all.is_err() {
            self.found.truncate(known);
            self.places.truncate(known);
            return all;
        }
        self.place(tube, &time, (from, to), slopes, known);
        self.last_stretch = (from, until, self.length);
        self.length += path_length(&tube.local, from, until, self.unit, &mut self.scratch);
        self.widen_t_range(&time, (from, to), values);
        Ok(())
    }

    /// Enters a linked tube in which the path meets t = 1 exactly once, rising, between two parameters. If it fails
    /// nothing is changed.
    pub fn enter_crossing<const N: usize, Y: Frame>(
        &mut self,
        equations: &Equations,
        inverter: &mut InverseMaker,
        tube: &Tube<N, Y>,
        between: (f64, f64),
        extended: bool,
    ) -> Result<(), Doubt> {
        self.is_defined(tube, between)?;
        let crossing = Crossing {
            between,
            rising: true,
        };
        let near = tube.time().zero_between(between);
        self.prove_crossing(equations, inverter, tube, (crossing, near), extended)?;
        let (from, to) = (between.0, self.last_crossing);
        self.length += path_length(&tube.local, from, to, self.unit, &mut self.scratch);
        Ok(())
    }

    /// Proves the box of one crossing, sought near a parameter: exactly one solution in it, which
    /// lies in this tube, and in this stretch of it.
    fn prove_crossing<const N: usize, Y: Frame>(
        &mut self,
        equations: &Equations,
        inverter: &mut InverseMaker,
        tube: &Tube<N, Y>,
        (crossing, near): (Crossing, f64),
        extended: bool,
    ) -> Result<(), Doubt> {
        let (a, b) = crossing.between;
        tube.local.at(near, &mut self.scratch);
        let near = &self.scratch;
        let found = self.prover.prove(equations, inverter, near, extended)?;
        self.ball.hold(&found.figure, point(1.0));
        let outside = || Doubt::Outside {
            radius: found.greatest_radius(),
            stretch: b - a,
        };
        let at = tube.locate(&self.ball).ok_or_else(outside)?;
        // All of it: beyond the stretch there may be another solution, in the tube but not counted.
        if at.0 < a || at.1 > b {
            return Err(outside());
        }
        for other in &self.found {
            match found.is_same(other, |_| false) {
                // In the overlap of two tubes, or at the end of the loop.
                Same::Yes => return Ok(()),
                Same::No => {}
                Same::Unknown => {
                    return Err(Doubt::Twin {
                        distance: found.distance(other),
                        radius: found.greatest_radius().max(other.greatest_radius()),
                    });
                }
            }
        }
        self.found.push(found.clone());
        // Its place in the tube, until [`Ledger::place`] knows that on the path.
        self.places.push(Place {
            arc: tube.time().zero_between((a, b)),
            rising: crossing.rising,
            folds: None,
        });
        self.last_crossing = at.1;
        Ok(())
    }

    /// Counts the folds in a tube, `slopes` bounding dt/ds in it, and places the solutions in it that were not
    /// `known` before.
    fn place<const N: usize, Y: Frame>(
        &mut self,
        tube: &Tube<N, Y>,
        time: &TimeAlong,
        (from, to): (f64, f64),
        slopes: (f64, f64),
        known: usize,
    ) {
        let before = self.turns.count;
        let new = &mut self.places[known..];
        let mut passed = vec![0; new.len()];
        // From where the path is in this tube for certain, lest a fold be counted in two tubes.
        let start = tube.entry.1.max(from);
        let was_certain = self.turns.is_certain();
        self.turns
            .follow_within(time, (start, to), slopes, |stretch| {
                if let Stretch::Turned(at, _) = stretch {
                    let later = new
                        .iter()
                        .zip(&mut passed)
                        .filter(|(place, _)| place.arc >= at);
                    later.for_each(|(_, passed)| *passed += 1);
                }
            });
        let first = self.turns.first;
        // What is hidden in this tube counts for all solutions in it.
        let is_certain = was_certain && self.turns.is_certain();
        for (place, passed) in new.iter_mut().zip(passed) {
            let mut folds = before + passed;
            // The sign at a crossing is certain. Where that of the stretch around it is not, the change
            // is seen a little later.
            let odd = folds % 2 == 1;
            folds += usize::from(first.is_some_and(|first| (place.rising != first) != odd));
            place.folds = (folds > 0 || is_certain).then_some(folds);
            place.arc = self.length
                + path_length(&tube.local, from, place.arc, self.unit, &mut self.scratch);
        }
    }

    /// Takes the values of t between two parameters, `values` bounding t − 1 there.
    fn widen_t_range(&mut self, time: &TimeAlong, (from, to): (f64, f64), values: (f64, f64)) {
        let shift = |(lo, hi): (f64, f64)| ((lo + 1.0).next_down(), (hi + 1.0).next_up());
        let (lo, hi) = shift(values);
        if lo >= self.t_range.0 && hi <= self.t_range.1 {
            return;
        }
        // Where the crude bound would widen the range, a finer one.
        const PIECES: usize = 32;
        let at = |k: usize| match k {
            PIECES => to,
            _ => from + (to - from) * (k as f64 / PIECES as f64),
        };
        for k in 0..PIECES {
            let (lo, hi) = shift(time.bounds(at(k), at(k + 1)).0);
            self.t_range = (self.t_range.0.min(lo), self.t_range.1.max(hi));
        }
    }
}
