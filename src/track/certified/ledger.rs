//! What has been proved along the chain so far: solutions, the range of t, the length.

use super::link::{Ball, Frame, Tube};
use super::reasons::Doubt;
use super::solution::{Same, SolutionBox, SolutionProver};
use crate::interval::rounding::round_up;
use crate::interval::{Interval, hull, point};
use crate::linalg::Vector;
use crate::system::Homotopy;
use crate::track::events::{Crossing, TimeAlong};
use crate::track::full::{Equations, InverseMaker, path_length};
use crate::track::turns::{Stretch, Turns};
use crate::track::{Place, Solution};

/// The account of a chain of linked tubes.
#[derive(Debug)]
pub struct Ledger<const D: usize> {
    /// The homotopy's.
    unit: f64,
    /// The auxiliary unknowns that must stay positive.
    positive: Vec<usize>,
    /// The vectors that must not vanish: see [`Homotopy::nonzero_vectors`].
    nonzero: Vec<Vec<[usize; 2]>>,
    prover: SolutionProver<D>,
    found: Vec<SolutionBox>,
    /// Where on the path each of them is.
    places: Vec<Place>,
    turns: Turns,
    /// The stretch of the last tube that belongs to the path, and the path's length up to it.
    pub last_stretch: (f64, f64, f64),
    /// Work space.
    crossings: Vec<Crossing>,
    /// See the method of that name.
    last_crossing: f64,
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

impl<const D: usize> Ledger<D> {
    /// An empty account.
    pub fn new(homotopy: &Homotopy, equations: &Equations<D>) -> Self {
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

    /// Proves a box around the solution near a point, beside the account.
    pub fn prove_at_end(
        &mut self,
        equations: &Equations<D>,
        inverter: &mut InverseMaker,
        near: &[f64],
    ) -> Result<&SolutionBox, Doubt> {
        self.prover.prove(equations, inverter, near, (true, false))
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

    /// Whether t is proved to rise all along, or to fall.
    pub fn is_steady(&self, rising: bool) -> bool {
        self.turns.is_steady(rising)
    }

    /// Takes over the account of a piece of path along which t rises throughout, or falls, kept for other equations
    /// of the same path, in which it passes flat figures: `flat` are those in these unknowns. If it fails nothing
    /// is changed.
    pub fn pass_flat(
        &mut self,
        piece: &Self,
        flat: Vec<SolutionBox>,
        rising: bool,
    ) -> Result<(), String> {
        let known = self.found.len();
        self.turns.go_on(rising);
        let (folds, is_certain) = (self.turns.count(), self.turns.is_certain());
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

    /// The parameter before which the solution found last is, in the tube entered last.
    pub fn last_crossing(&self) -> f64 {
        self.last_crossing
    }

    /// Enters a linked tube between two parameters, where there is no solution.
    pub fn pass<const N: usize, Y: Frame<D>>(
        &mut self,
        tube: &Tube<D, N, Y>,
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
    pub fn found(&self) -> &[SolutionBox] {
        &self.found
    }

    /// The number of solutions so far.
    pub fn solutions_so_far(&self) -> usize {
        self.found.len()
    }

    /// Finds all solutions in a linked tube, from its entry to the parameter `to`, the path being followed to
    /// the parameter `until`; `extended` is whether their boxes are proved in extended precision. If it fails
    /// nothing is changed.
    pub fn enter<const N: usize, Y: Frame<D>>(
        &mut self,
        equations: &Equations<D>,
        inverter: &mut InverseMaker,
        tube: &Tube<D, N, Y>,
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
    pub fn enter_crossing<const N: usize, Y: Frame<D>>(
        &mut self,
        equations: &Equations<D>,
        inverter: &mut InverseMaker,
        tube: &Tube<D, N, Y>,
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

    /// Proves that the auxiliary unknowns which are lengths or radii are positive on a stretch of a tube, and that no
    /// vector vanishes there that must not. Otherwise names the first for which that could not be proved.
    fn is_defined<const N: usize, Y: Frame<D>>(
        &self,
        tube: &Tube<D, N, Y>,
        (from, to): (f64, f64),
    ) -> Result<(), Doubt> {
        let fails = |&&entry: &&usize| {
            let ((low, _), _) = tube.entry_along(entry).bounds(from, to);
            // Bounds are of the unknown minus 1.
            (low + 1.0).next_down() <= 0.0 || low.is_nan()
        };
        if let Some(&unknown) = self.positive.iter().find(fails) {
            return Err(Doubt::Sign(unknown));
        }
        // Pieces of a stretch are cut in two no more often than that.
        const DEPTH: usize = 8;
        let zero = tube.weights.len() - 2;
        let mut vectors = self.nonzero.iter();
        match vectors.position(|vector| !is_nonzero(tube, vector, zero, (from, to), DEPTH)) {
            Some(vector) => Err(Doubt::Vanishes(vector)),
            None => Ok(()),
        }
    }

    /// Proves the box of one crossing, sought near a parameter: exactly one solution in it, which
    /// lies in this tube, and in this stretch of it.
    fn prove_crossing<const N: usize, Y: Frame<D>>(
        &mut self,
        equations: &Equations<D>,
        inverter: &mut InverseMaker,
        tube: &Tube<D, N, Y>,
        (crossing, near): (Crossing, f64),
        extended: bool,
    ) -> Result<(), Doubt> {
        let (a, b) = crossing.between;
        tube.local.at(near, &mut self.scratch);
        let how = (crossing.rising, extended);
        let found = self.prover.prove(equations, inverter, &self.scratch, how)?;
        self.ball.centre.copy_from_slice(&found.centre);
        self.ball.low.copy_from_slice(&found.low);
        self.ball.radius.copy_from_slice(&found.radius);
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
    fn place<const N: usize, Y: Frame<D>>(
        &mut self,
        tube: &Tube<D, N, Y>,
        time: &TimeAlong<N>,
        (from, to): (f64, f64),
        slopes: (f64, f64),
        known: usize,
    ) {
        let before = self.turns.count();
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
        let first = self.turns.first();
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
    fn widen_t_range<const N: usize>(
        &mut self,
        time: &TimeAlong<N>,
        (from, to): (f64, f64),
        values: (f64, f64),
    ) {
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

    /// What remains to be proved of a closed loop.
    pub fn check_closed(&self, homotopy: &Homotopy) -> Result<(), String> {
        // Not needed for the proof: a loop crosses t = 1 as often upwards as downwards.
        let rising = self.found.iter().filter(|s| s.rising).count();
        if 2 * rising != self.found.len() {
            return Err(format!(
                "of {} crossings of t = 1 along a closed path, {rising} go upwards: this is a bug in krawl, \
                 please report it",
                self.found.len()
            ));
        }
        self.lengths_are_positive(homotopy)
    }

    /// What remains to be proved of an arc.
    pub fn check_open(&self, homotopy: &Homotopy) -> Result<(), String> {
        self.lengths_are_positive(homotopy)
    }

    /// Takes the account of the way from the sketch in the other direction to that of this way: solutions are
    /// in the order of the path, from the end of the other way to that of this one. Fails where it cannot be told
    /// whether a solution was found on both.
    pub fn go_on_from(&mut self, back: Self) -> Result<(), String> {
        let ahead = std::mem::take(&mut self.found);
        let places = std::mem::take(&mut self.places);
        self.found = back.found;
        self.found.reverse();
        for found in &mut self.found {
            found.rising = !found.rising;
        }
        // Behind the sketch lengths of the path count downwards.
        self.places = back.places;
        self.places.reverse();
        for place in &mut self.places {
            (place.arc, place.rising) = (-place.arc, !place.rising);
        }
        for (found, place) in ahead.into_iter().zip(places) {
            let same = |other: &SolutionBox| found.is_same(other, |_| false);
            let answers: Vec<Same> = self.found.iter().map(same).collect();
            if answers.contains(&Same::Unknown) {
                return Err(
                    "it could not be told whether a solution near the sketch is one or two"
                        .to_owned(),
                );
            }
            if !answers.contains(&Same::Yes) {
                self.found.push(found);
                self.places.push(place);
            }
        }
        self.length += back.length;
        let (low, high) = back.t_range;
        self.t_range = (self.t_range.0.min(low), self.t_range.1.max(high));
        Ok(())
    }

    /// Takes over the account of the way from the sketch in the other direction, where the two have met: solutions are in
    /// the order of the closed path, from the sketch on. Fails where it cannot be told whether a solution was found on
    /// both, or one was elsewhere than where they met; what is left is then neither's account.
    pub fn close_with(&mut self, back: Self) -> Result<(), String> {
        let (folds, is_certain) = self.turns.closed_by(&back.turns);
        self.length += back.length;
        let ahead = self.found.len();
        let last = back.found.len();
        for (k, (mut found, place)) in back.found.into_iter().zip(back.places).enumerate().rev() {
            let others = self.found[..ahead].iter();
            let mut answers = others.map(|other| found.is_same(other, |_| false));
            match answers.position(|same| same != Same::No) {
                None => {}
                // The last one of both, where they met.
                Some(at)
                    if (at + 1, k + 1) == (ahead, last)
                        && found.is_same(&self.found[at], |_| false) == Same::Yes =>
                {
                    continue;
                }
                Some(_) => return Err("a solution was found on both ways".to_owned()),
            }
            found.rising = !found.rising;
            self.found.push(found);
            // Those of the whole path but for those between it and the sketch, on the way back.
            let folds = folds.saturating_sub(place.folds.unwrap_or(0));
            self.places.push(Place {
                arc: self.length - place.arc,
                rising: !place.rising,
                folds: (folds > 0 || is_certain).then_some(folds),
            });
        }
        let (low, high) = back.t_range;
        self.t_range = (self.t_range.0.min(low), self.t_range.1.max(high));
        Ok(())
    }

    /// Claim 3: a_i(t) > 0 on the whole range of t.
    fn lengths_are_positive(&self, homotopy: &Homotopy) -> Result<(), String> {
        let range = hull(self.t_range.0, self.t_range.1);
        for (index, length) in homotopy.lengths.iter().enumerate() {
            if length.enclose(range).inf() > 0.0 {
                continue;
            }
            let bounds = lower_bounds(|t| length.enclose(t), range);
            if !bounds.iter().all(|&bound| bound > 0.0) {
                let least = bounds.into_iter().fold(f64::INFINITY, f64::min);
                return Err(format!(
                    "the length of {} could not be proved positive for t from {:.6} to {:.6}: no more than \
                     that it is above {:.1e}",
                    homotopy.names[index],
                    self.t_range.0,
                    self.t_range.1,
                    least * homotopy.unit
                ));
            }
        }
        Ok(())
    }

    /// The solutions with their classes; the reason, if a claim about them could not be proved.
    pub fn solutions(&self, homotopy: &Homotopy) -> Result<Vec<Solution>, (String, Vec<Solution>)> {
        let mut reason = None;
        let mut classes: Vec<usize> = Vec::new();
        let mut mirrors: Vec<Option<usize>> = Vec::new();
        for (k, found) in self.found.iter().enumerate() {
            let (mut class, mut mirror) = (None, None);
            for (j, other) in self.found[..k].iter().enumerate() {
                match is_congruent(homotopy, found, other) {
                    (Same::Yes, mirrored) => {
                        class = Some(classes[j]);
                        mirror = mirror.or(mirrored.then_some(j));
                    }
                    (Same::No, _) => {}
                    (Same::Unknown, _) => {
                        reason.get_or_insert(format!(
                            "it could not be decided whether solutions {} and {}, known up to {:.1e}, \
                             are congruent; another reference may help",
                            j + 1,
                            k + 1,
                            found.greatest_radius().max(other.greatest_radius())
                                * homotopy.unit
                        ));
                    }
                }
            }
            mirrors.push(mirror);
            classes.push(class.unwrap_or_else(|| classes.iter().max().map_or(0, |c| c + 1)));
        }
        let solutions = self
            .found
            .iter()
            .zip(&self.places)
            .zip(classes.into_iter().zip(mirrors))
            .map(|((found, &place), (class, mirror_of))| {
                let points = found.points(homotopy);
                let width = relative_width(&points);
                Solution {
                    objects: found.objects(homotopy, &points),
                    points,
                    class,
                    width,
                    place: Some(place),
                    mirror_of,
                    is_degenerate: found.is_flat,
                }
            })
            .collect();
        match reason {
            None => Ok(solutions),
            Some(reason) => Err((reason, solutions)),
        }
    }
}

/// Whether two different solutions are congruent up to reflection, and if so, whether one is the
/// mirror image of the other (otherwise it is the other one moved).
///
/// The isometries that keep the gauge change the signs of coordinates. The second reference
/// point's first coordinate and the third's second one tell which signs they must change;
/// that of the last coordinate is free, unless a constraint says which way round the figure is. Where
/// constraints fix the figure in its frame no isometry is left. Each of them goes with the changes of
/// sign that leave a figure as it is, of the directions of lines of their own.
pub fn is_congruent(homotopy: &Homotopy, one: &SolutionBox, other: &SolutionBox) -> (Same, bool) {
    let gauge = &homotopy.gauge;
    let mut turned = [false; 3];
    for (axis, &p) in gauge.reference.iter().skip(1).enumerate() {
        let i = gauge.variable[p * homotopy.dimension + axis];
        let side = |s: &SolutionBox| {
            let spread = round_up(s.radius[i] + s.low[i].abs(), 1);
            (s.centre[i].abs() > spread).then_some(s.centre[i] > 0.0)
        };
        match (side(one), side(other)) {
            (Some(a), Some(b)) => turned[axis] = a != b,
            _ => return (Same::Unknown, false),
        }
    }
    let twins = homotopy.twins();
    // A motion first: a flat figure in space is its own mirror image.
    let odd = turned.iter().filter(|&&turned| turned).count() % 2 == 1;
    let last = match gauge.reference.is_empty() {
        true => &[false][..],
        false => &[odd, !odd][..],
    };
    for &last in last {
        turned[homotopy.dimension - 1] = last;
        let reversed = turned.iter().filter(|&&turned| turned).count();
        if reversed % 2 == 1 && !homotopy.tail.mirrors {
            continue;
        }
        let flips = |i: usize| {
            let flips =
                (0..homotopy.dimension).filter(|&axis| turned[axis] && homotopy.flips(i, axis));
            flips.count() % 2 == 1
        };
        let Some(twins) = &twins else {
            // They are too many to try all: figures differ where points do.
            if one.may_be(other, flips, gauge.place.len()) {
                return (Same::Unknown, false);
            }
            continue;
        };
        for twin in twins {
            // Without any change of sign they are known to differ.
            if reversed == 0 && !twin.contains(&true) {
                continue;
            }
            match one.is_same(other, |i| flips(i) ^ twin[i]) {
                Same::No => {}
                decided => return (decided, reversed % 2 == 1),
            }
        }
    }
    (Same::No, false)
}

/// Proves that a vector, of which each coordinate is the difference of two unknowns (from `zero` on: of none), does not
/// vanish on a stretch of a tube: on each piece one coordinate has one sign.
fn is_nonzero<const D: usize, const N: usize, Y: Frame<D>>(
    tube: &Tube<D, N, Y>,
    vector: &[[usize; 2]],
    zero: usize,
    (from, to): (f64, f64),
    depth: usize,
) -> bool {
    let bounds = |i: usize| match i < zero {
        // Of the unknown minus 1.
        true => tube.entry_along(i).bounds(from, to).0,
        false => (-1.0, -1.0),
    };
    let has_sign = |&[i, j]: &[usize; 2]| {
        let (a, b) = (bounds(i), bounds(j));
        a.0 > b.1 || a.1 < b.0
    };
    if vector.iter().any(has_sign) {
        return true;
    }
    let middle = 0.5 * (from + to);
    depth > 0
        && from < middle
        && middle < to
        && is_nonzero(tube, vector, zero, (from, middle), depth - 1)
        && is_nonzero(tube, vector, zero, (middle, to), depth - 1)
}

/// Pieces of the range of t on which lengths are bounded.
const PIECES: usize = 64;

/// Lower bounds of a function on the pieces of a range.
fn lower_bounds(enclose: impl Fn(Interval) -> Interval, range: Interval) -> [f64; PIECES] {
    let (lo, width) = (point(range.inf()), point(range.sup()) - point(range.inf()));
    std::array::from_fn(|k| {
        let piece = hull(k as f64 / PIECES as f64, (k + 1) as f64 / PIECES as f64);
        enclose((lo + width * piece).intersection(range)).inf()
    })
}

/// The widest coordinate's width over the largest coordinate.
fn relative_width(points: &[[Interval; 3]]) -> f64 {
    let all = || points.iter().flatten();
    let size = all().fold(0.0, |max: f64, x| max.max(x.mag()));
    all().fold(0.0, |max: f64, x| max.max(x.wid())) / size
}
