//! Through flat figures at t = 1, at which the equations are dependent: the path is followed through them by other
//! equations, which are regular there.
//!
//! Where a problem has more conditions on heights than heights, every flat figure satisfies them at t = 1, and the
//! path, on which heights go to zero like 1 − t, runs into a continuum of flat figures. Before it does, this
//! chain of tubes goes over to one of the same path in the equations of [`Heights`], in which heights are divided by
//! 1 − t; and behind t = 1 it comes back. Both times a box around a point of one chain, carried over exactly, is
//! proved to lie in a tube of the other, and dt/ds to have the same sign in both, and in the piece between
//! throughout. So it is the same path, followed in the same direction, and it meets t = 1 in that piece once.

use super::{Test, Tracker};
use crate::interval::{Interval, point};
use crate::system::{Heights, Homotopy};
use crate::track::certified::figures::FigureBox;
use crate::track::certified::link::{Ball, Frame, Tube};
use crate::track::flat::Trials;
use crate::track::full::{Local, first_normal};
use crate::track::{Control, Options, Trace, Witness};
use std::borrow::Cow;

/// When crossings are tried: not where there is no room left for the links.
pub(super) const TRIALS: Trials = Trials {
    near: 0.25,
    nearest: 1e-7,
    nearer: 0.6,
    vanishing: 0.5,
};
/// The piece in the other equations ends as far behind t = 1 as it begins before it, or so many times farther
/// where the way back is not proved before.
const FARTHEST: f64 = 4.0;
/// No crossing takes more tubes.
const MOST_TUBES: usize = 400;

/// Both systems hold at the points where one is left for the other.
const FAULT: &str =
    "this is a bug in krawl, please report it: the equations do not hold at the point";

/// What a run keeps that may meet flat figures at t = 1.
#[derive(Debug)]
pub(super) struct Crossing {
    heights: Heights,
    /// How far from t = 1 the last trial was that failed on this approach,
    pub failed: Option<f64>,
    /// and why.
    why: String,
    /// How many were passed.
    passed: usize,
    /// Tubes of the pieces.
    tubes: usize,
}

/// Where the piece in other equations ends: at t or beyond.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beyond {
    t: f64,
    rising: bool,
}

impl Beyond {
    /// Whether the path is there at a parameter of a tube.
    pub fn is_reached<const N: usize, Y: Frame>(&self, tube: &Tube<N, Y>, s: f64) -> bool {
        let (low, high) = tube.time().range(s, s);
        match self.rising {
            true => low >= self.t,
            false => high <= self.t,
        }
    }
}

impl Crossing {
    /// For a problem in which flat figures can come in continua.
    pub fn new(homotopy: &Homotopy) -> Option<Self> {
        if homotopy.tail.is_empty() {
            return None;
        }
        let heights = homotopy.over_heights().ok()?;
        Some(Crossing {
            heights,
            failed: None,
            why: String::new(),
            passed: 0,
            tubes: 0,
        })
    }

    /// Why the last crossing could not be proved, if the path did not get away from there.
    pub fn failure(&self) -> Option<&str> {
        self.failed.map(|_| self.why.as_str())
    }

    /// Counts those of the way from the sketch in the other direction too.
    pub fn add(&mut self, other: &Crossing) {
        self.passed += other.passed;
        self.tubes += other.tubes;
    }

    /// What to say of those that were passed.
    pub fn in_words(&self) -> Option<String> {
        let figures = match self.passed {
            0 => return None,
            1 => "a degenerate (flat) figure at t = 1 was".to_owned(),
            n => format!("{n} degenerate (flat) figures at t = 1 were"),
        };
        Some(format!(
            "heights divided by 1 − t, {} tubes: {figures} passed",
            self.tubes
        ))
    }
}

/// The points of a ball, entry by entry.
fn intervals(ball: &Ball, n: usize) -> Vec<Interval> {
    (0..n).map(|i| ball.enclosure(i)).collect()
}

/// A ball that holds a box.
fn fill(ball: &mut Ball, box_: &[Interval]) {
    ball.low.fill(0.0);
    for (i, x) in box_.iter().enumerate() {
        (ball.centre[i], ball.radius[i]) = (x.mid(), x.rad());
    }
}

/// The sign of dt/ds between two parameters of a tube, if it is certain: whether t rises.
fn direction<const N: usize, Y: Frame>(tube: &Tube<N, Y>, (from, to): (f64, f64)) -> Option<bool> {
    let (_, (low, high)) = tube.time().bounds(from, to);
    match (low > 0.0, high < 0.0) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

impl<const N: usize, T: Test<N>> Tracker<'_, N, T> {
    /// Follows the path through the flat figure ahead, if there is one, and comes back to these equations behind it, in a tube
    /// that is shown. If it cannot be proved all is as it was.
    pub(super) fn cross(&mut self, options: &Options, control: &mut Control) -> bool {
        let Some(mut crossing) = self.crossing.take() else {
            return false;
        };
        let left = (1.0 - self.now.local.z[0][self.equations.m]).abs();
        if let Some(witness) = &mut control.witness {
            witness.divide();
        }
        let result = self.try_to_cross(&mut crossing, left, options, control);
        let done = result.is_ok();
        if let Some(witness) = &mut control.witness {
            witness.end_divide(done);
        }
        match result {
            Ok(known) => self.show_tube(control, known, false),
            Err(why) => (crossing.failed, crossing.why) = (Some(left), why),
        }
        self.crossing = Some(crossing);
        done
    }

    /// Tells how many solutions are known before the last tube, that in these equations again.
    fn try_to_cross(
        &mut self,
        crossing: &mut Crossing,
        left: f64,
        options: &Options,
        control: &mut Control,
    ) -> Result<usize, String> {
        let heights = &crossing.heights;
        self.test
            .tighten_exit(&self.equations, &mut self.now)
            .ok_or("the point before it could not be enclosed")?;
        let rising = direction(&self.now, self.now.exit_between)
            .ok_or("it is not certain there whether t rises")?;
        let here = intervals(&self.now.exit, self.equations.n());
        let there = heights.divide(&here).ok_or("t may be 1 there already")?;
        // Not needed for the proof, which rests on how the equations were divided: it would show a fault of that.
        if !heights.homotopy.may_hold(&there) {
            return Err(format!("{FAULT} before it"));
        }

        let options = Options {
            reverse: !rising,
            max_steps: MOST_TUBES,
            ..options.clone()
        };
        let mut piece = Tracker::<N, T>::new(Cow::Borrowed(&heights.homotopy), &options);
        fill(&mut piece.sketch, &there);
        let mut distance = left;
        let beyond = |distance: f64| {
            let t = if rising {
                1.0 + distance
            } else {
                1.0 - distance
            };
            Some(Beyond { t, rising })
        };
        piece.beyond = beyond(distance);
        // It is part of another run, which alone tells of itself, but for its proof.
        let mut trace = control.trace.is_some().then(Trace::default);
        if let Some(trace) = &mut trace {
            trace.begin(&heights.homotopy);
        }
        let mut quiet = Control {
            cancel: control.cancel,
            limit: control.limit,
            trace: trace.as_mut(),
            witness: match &mut control.witness {
                Some(witness) => Some(&mut **witness as &mut dyn Witness),
                None => None,
            },
            ..Control::default()
        };
        let words = |why: String| format!("with heights divided by 1 − t, {why}");
        let max_h = piece.longest(&options);
        let started = piece.start(&options, max_h);
        let mut is_there = started.map_err(|halt| words(halt.stop.text))?;
        if direction(&piece.now, piece.now.entry) != Some(rising) {
            return Err(words("it is not certain whether t rises".to_owned()));
        }
        piece.show_tube(&mut quiet, 0, false);
        let known = loop {
            if !is_there {
                let gone = piece.go_on(&options, max_h, &mut quiet);
                gone.map_err(|halt| words(halt.stop.text))?;
            }
            if !piece.ledger.turns.is_steady(rising) {
                return Err(words(
                    "it is not certain that t goes through 1 without turning back".to_owned(),
                ));
            }
            match self.come_back(&mut piece, heights, rising, max_h) {
                Ok(known) => break known,
                Err(why) if distance >= FARTHEST * left => return Err(why),
                Err(_) => {
                    distance *= 1.5;
                    piece.beyond = beyond(distance);
                    is_there = false;
                }
            }
        };
        crossing.passed += piece.ledger.found().len();
        crossing.tubes += piece.steps + 1;
        self.steps += piece.steps + 1;
        self.rejected += piece.rejected;
        if let (Some(all), Some(piece)) = (&mut control.trace, &trace) {
            all.append(piece, self.homotopy.gauge.place.len(), rising);
        }
        Ok(known)
    }

    /// Proves a tube of these equations around the point at which `piece` ends, and takes over its account. Tells how many
    /// solutions are known before that tube. If it cannot be proved all is as it was.
    fn come_back(
        &mut self,
        piece: &mut Tracker<N, T>,
        heights: &Heights,
        rising: bool,
        max_h: f64,
    ) -> Result<usize, String> {
        piece
            .test
            .tighten_exit(&piece.equations, &mut piece.now)
            .ok_or("the point behind it could not be enclosed")?;
        if direction(&piece.now, piece.now.exit_between) != Some(rising) {
            return Err("it is not certain behind it whether t rises".to_owned());
        }
        let there = intervals(&piece.now.exit, piece.equations.n());
        let here = heights.multiply(&there);
        if !self.homotopy.may_hold(&here) {
            return Err(format!("{FAULT} behind it"));
        }
        let mut ball = Ball::new(&self.equations);
        fill(&mut ball, &here);
        let mut at_ball = <Local>::new(&self.equations);
        at_ball.z[0].copy_from_slice(&ball.centre);
        first_normal(&self.equations, &mut self.inverter, &mut at_ball, !rising)
            .map_err(|_| "the equations are still dependent behind it")?;

        let mark = self.ledger.mark();
        let given = |found: &FigureBox| self.flat_solution(found, heights);
        let flat: Vec<FigureBox> = piece.ledger.found().iter().map(given).collect();
        self.ledger.pass_flat(&piece.ledger, flat, rising)?;
        let known = self.ledger.found().len();
        // The tube around it comes in the next one's place, as one around the sketch.
        let mut normal = at_ball.normal.clone();
        std::mem::swap(&mut self.now, &mut self.next);
        std::mem::swap(&mut self.sketch, &mut ball);
        std::mem::swap(&mut self.first_normal, &mut normal);
        let tube = self.tube_at_sketch(max_h);
        std::mem::swap(&mut self.sketch, &mut ball);
        std::mem::swap(&mut self.first_normal, &mut normal);
        if tube.is_err() || direction(&self.now, self.now.entry) != Some(rising) {
            std::mem::swap(&mut self.now, &mut self.next);
            self.test.reject();
            self.ledger.return_to(mark);
            return Err("no tube behind it could be proved and linked".to_owned());
        }
        (self.has_previous, self.typical) = (false, f64::NAN);
        Ok(known)
    }

    /// A box around a flat figure in these unknowns.
    fn flat_solution(&self, found: &FigureBox, heights: &Heights) -> FigureBox {
        let unknowns = 0..heights.homotopy.equations;
        let there = unknowns.map(|i| found.figure.enclosure(i));
        let there: Vec<Interval> = there.chain([point(1.0)]).collect();
        let here = heights.multiply(&there);
        // There are other flat figures however near.
        FigureBox::around(here[..self.equations.m].iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::Real;
    use crate::problem::Problem;
    use crate::system::Right;
    use crate::track::EndKind;
    use crate::track::full::ORDER;
    use crate::track::full::certified::KrawczykTest;

    /// Whether the hexahedron's run closes, its flat figures, and the end it came to otherwise.
    fn run(change: impl Fn(&mut Homotopy)) -> (bool, usize, String) {
        let path = format!(
            "{}/../../tests/data/hexahedron-28.toml",
            env!("CARGO_MANIFEST_DIR")
        );
        let homotopy = Homotopy::new(&Problem::read(path).unwrap()).unwrap();
        let options = Options::certified();
        let mut tracker =
            Tracker::<{ ORDER + 1 }, KrawczykTest>::new(Cow::Borrowed(&homotopy), &options);
        tracker.crossing = Crossing::new(&homotopy);
        let crossing = tracker.crossing.as_mut().expect("flat figures in curves");
        change(&mut crossing.heights.homotopy);
        let result = tracker.run(&options, &mut Control::default());
        let found = tracker.ledger.found().iter();
        let flat = found.filter(|found| found.alone_within == 0.0).count();
        let is_closed = result.is_ok();
        let end = result.err().map(|halt| {
            let end = tracker.path_end(halt).expect("an end of the path");
            assert_eq!(end.kind, EndKind::Degenerate);
            assert!((end.t.0 - 1.0).abs() < 1e-2, "{end:?}");
            end.reason
        });
        (is_closed, flat, end.unwrap_or_default())
    }

    /// Divided equations that are wrong by little are not taken for the path's: nothing is passed, and the end is named.
    #[test]
    fn wrong_equations_pass_nothing() {
        let names = run(|_| ());
        assert!(names.0 && names.1 > 0, "{names:?}");
        let wrong = |last: bool, by: &'static str| {
            move |homotopy: &mut Homotopy| {
                let count = homotopy.tail.equations.len();
                let e = if last { count - 1 } else { 0 };
                let equation = &homotopy.tail.equations[e];
                let by: crate::problem::Decimal = by.parse().unwrap();
                let mut right = equation.right.clone();
                right[0] = &right[0] + &Real::from(by.value().clone());
                let unit = homotopy.unit.powi(equation.power);
                let first = homotopy.edges.len();
                homotopy.rights[first + e] = Right::polynomial(&right, unit);
            }
        };
        // The first is s = 1 − t, the last a face's.
        for last in [false, true] {
            for by in ["1e-3", "1e-8"] {
                let (is_closed, flat, end) = run(wrong(last, by));
                assert!(!is_closed && flat == 0, "{end}");
                assert!(end.contains("a degenerate (flat) figure at t = 1"), "{end}");
                assert!(end.contains(FAULT), "{end}");
            }
        }
    }
}
