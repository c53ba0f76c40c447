//! Whether a run is right, judged against the certified run: solution by solution, each of which
//! has to be in the place of one of the proved boxes, not just by counting.

use super::{Measured, Method, Row};
use crate::interval::Interval;
use crate::track::{Mode, Outcome, Solution};
use std::fmt;

/// What a run is worth.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// It closed, and its solutions are those of the certified run, in the same order. For the
    /// certified run itself: it is proved.
    Right,
    /// It stopped, and nothing that it says up to there is wrong.
    Stopped,
    /// It is wrong in these ways.
    Wrong(Vec<Fault>),
    /// No certified run closed, so that nothing can be judged.
    Unjudged,
}

/// A way of being wrong.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fault {
    /// It closed without this many of the solutions on the path, or passed over them before it
    /// stopped.
    Lost(usize),
    /// This many figures meet the dimensions, but are not on the path through the sketch: the
    /// run jumped to another one.
    Jumped(usize),
    /// This many figures do not even meet the dimensions, or were reported twice.
    Invented(usize),
    /// It met the solutions in another order than the path does: it jumped from one part of the
    /// path to another, or took one solution for another.
    Order,
    /// It closed after this many times the path's length: not the loop through the sketch, or not
    /// once.
    Length(f64),
    /// It went on for this many times the path's length and did not notice the sketch.
    NotClosed(f64),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::Lost(n) => write!(f, "lost {n}"),
            Fault::Jumped(n) => write!(f, "jumped: {n} of other paths"),
            Fault::Invented(n) => write!(f, "invented {n}"),
            Fault::Order => write!(f, "another order"),
            Fault::Length(x) => write!(f, "closed at {x:.2} times the length"),
            Fault::NotClosed(x) => write!(f, "not closed at {x:.2} times the length"),
        }
    }
}

/// A solution is in the place of a box if no coordinate is further away than this, relative to
/// the figure's size. Float runs correct their solutions to about 1e-15 times a condition number,
/// so that it leaves room for conditions up to a billion; of several boxes the nearest counts.
const PLACE: f64 = 1e-6;
/// Figures meet the dimensions if their residual (see [`super::residual_bound`]) is below this.
const MEETS: f64 = 1e-8;
/// The lengths of a path that two runs measure agree to this. Chords are shorter than arcs, by the part
/// δ²/24 where steps turn by δ: less than a quarter even if all of them turn by 2 radians.
const LENGTHS: std::ops::RangeInclusive<f64> = 0.75..=1.01;

/// A closed certified run.
pub(super) struct Reference {
    outcome: Outcome,
}

impl Reference {
    pub fn new(row: &Row) -> Option<Self> {
        let measured = row.measured()?;
        let fits = row.way.method == Method::Certified && measured.is_closed();
        debug_assert!(measured.outcome.mode == Mode::Certified || !fits);
        fits.then_some(Reference {
            outcome: measured.outcome.clone(),
        })
    }

    pub fn length(&self) -> f64 {
        self.outcome.length
    }

    /// The box in whose place a figure is.
    fn place_of(&self, figure: &Solution) -> Option<usize> {
        let boxes = self.outcome.solutions.iter().enumerate();
        let (index, away) = boxes
            .map(|(k, b)| (k, distance(&b.points, &figure.points)))
            .min_by(|a, b| a.1.total_cmp(&b.1))?;
        let size = self.outcome.solutions[index]
            .points
            .iter()
            .flatten()
            .fold(0.0, |max: f64, x| max.max(x.mag()));
        (away <= PLACE * size).then_some(index)
    }

    fn judge(&self, measured: &Measured) -> Verdict {
        let (outcome, closed) = (&measured.outcome, measured.is_closed());
        let all = self.outcome.solutions.len();
        let mut places: Vec<usize> = Vec::new();
        let mut unplaced = 0;
        let mut repeated = 0;
        for solution in &outcome.solutions {
            match self.place_of(solution) {
                Some(place) if places.contains(&place) => repeated += 1,
                Some(place) => places.push(place),
                None => unplaced += 1,
            }
        }
        let mut faults = Vec::new();
        // The path may be followed either way where the sketch is at a fold of t.
        let forth: Vec<usize> = (0..all).collect();
        let back: Vec<usize> = (0..all).rev().collect();
        let lost = if closed {
            all - places.len()
        } else {
            [&forth, &back]
                .map(|way| passed_over(way, &places))
                .into_iter()
                .min()
                .unwrap_or(0)
        };
        if lost > 0 {
            faults.push(Fault::Lost(lost));
        }
        if unplaced > 0 {
            let meets = measured.residual.is_some_and(|r| r <= MEETS);
            faults.push(if meets {
                Fault::Jumped(unplaced)
            } else {
                Fault::Invented(unplaced)
            });
        }
        if repeated > 0 {
            faults.push(Fault::Invented(repeated));
        }
        if ![&forth, &back]
            .into_iter()
            .any(|way| is_in_order(way, &places))
        {
            faults.push(Fault::Order);
        }
        let part = outcome.length / self.length();
        if closed && !LENGTHS.contains(&part) {
            faults.push(Fault::Length(part));
        } else if !closed && part > *LENGTHS.end() {
            faults.push(Fault::NotClosed(part));
        }
        match (faults.is_empty(), closed) {
            (false, _) => Verdict::Wrong(faults),
            (true, true) => Verdict::Right,
            (true, false) => Verdict::Stopped,
        }
    }
}

/// Judges all rows, if there is something to judge them against.
pub(super) fn all(rows: &mut [Row], reference: Option<&Reference>) {
    let judged: Vec<Verdict> = rows
        .iter()
        .map(|row| match (reference, row.measured()) {
            (Some(reference), Some(measured)) => reference.judge(measured),
            _ => Verdict::Unjudged,
        })
        .collect();
    for (row, verdict) in rows.iter_mut().zip(judged) {
        row.verdict = verdict;
    }
}

/// How many solutions before the last one met were not met, going `way`.
fn passed_over(way: &[usize], places: &[usize]) -> usize {
    let at = |place: &usize| way.iter().position(|k| k == place);
    let last = places.iter().filter_map(at).max();
    last.map_or(0, |last| last + 1 - places.len())
}

/// Whether the places come in the order of `way`.
fn is_in_order(way: &[usize], places: &[usize]) -> bool {
    let mut way = way.iter();
    places.iter().all(|place| way.any(|k| k == place))
}

/// The largest distance of a coordinate's middle from a box.
fn distance(boxes: &[[Interval; 3]], figure: &[[Interval; 3]]) -> f64 {
    let pairs = boxes.iter().flatten().zip(figure.iter().flatten());
    pairs.fold(0.0, |max: f64, (b, x)| {
        let x = x.mid();
        let away = (b.inf() - x).max(x - b.sup());
        // A NaN is far away.
        if away.is_nan() {
            f64::INFINITY
        } else {
            max.max(away)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Row, Way};
    use super::*;
    use crate::interval::{hull, point};
    use crate::track::{Driving, Space, Status, Stop, StopKind};

    /// A run that met figures of one moving point, and how far it went.
    fn measured(mode: Mode, met: &[f64], length: f64, closed: bool, residual: f64) -> Measured {
        let radius = if mode == Mode::Certified { 1e-12 } else { 0.0 };
        let solution = |&x: &f64| Solution {
            points: vec![
                [point(0.0); 3],
                [hull(x - radius, x + radius), point(1.0), point(0.0)],
            ],
            objects: Vec::new(),
            class: 0,
            width: 2.0 * radius,
            place: None,
            mirror_of: None,
            is_degenerate: false,
        };
        Measured {
            outcome: Outcome {
                mode,
                space: Space::Full,
                status: match closed {
                    true => Status::Closed,
                    false => Status::Stopped(Stop::new(StopKind::NoStep, "somewhere")),
                },
                solutions: met.iter().map(solution).collect(),
                steps: 1,
                rejected: 0,
                plan_changes: 0,
                driving: Driving::default(),
                length,
                t_range: (0.0, 1.0),
                seconds: 1.0,
                switched_on: Vec::new(),
            },
            seconds: vec![1.0],
            median: 1.0,
            residual: Some(residual),
        }
    }

    const PROVED: [f64; 4] = [0.1, 0.2, 0.3, 0.4];

    fn verdict(met: &[f64], length: f64, closed: bool, residual: f64) -> Verdict {
        let row = Row {
            way: Way {
                method: Method::Certified,
                space: Space::Full,
            },
            setting: None,
            result: Ok(measured(Mode::Certified, &PROVED, 10.0, true, 1e-12)),
            verdict: Verdict::Unjudged,
        };
        let reference = Reference::new(&row).unwrap();
        reference.judge(&measured(Mode::Float, met, length, closed, residual))
    }

    #[test]
    fn finds_each_fault() {
        use Verdict::{Right, Stopped, Wrong};
        assert_eq!(verdict(&PROVED, 10.0, true, 1e-15), Right);
        assert_eq!(
            verdict(&[0.1 + 1e-9, 0.2, 0.3, 0.4], 9.8, true, 1e-15),
            Right
        );
        assert_eq!(verdict(&[0.4, 0.3, 0.2, 0.1], 10.0, true, 1e-15), Right);
        assert_eq!(
            verdict(&[0.1, 0.2, 0.4], 10.0, true, 1e-15),
            Wrong(vec![Fault::Lost(1)])
        );
        assert_eq!(
            verdict(&[0.1, 0.2, 0.3, 0.35, 0.4], 10.0, true, 1e-15),
            Wrong(vec![Fault::Jumped(1)])
        );
        assert_eq!(
            verdict(&[0.1, 0.2, 0.3, 0.35, 0.4], 10.0, true, 1e-3),
            Wrong(vec![Fault::Invented(1)])
        );
        assert_eq!(
            verdict(&[0.1, 0.2, 0.2, 0.3, 0.4], 10.0, true, 1e-15),
            Wrong(vec![Fault::Invented(1)])
        );
        assert_eq!(
            verdict(&[0.1, 0.3, 0.2, 0.4], 10.0, true, 1e-15),
            Wrong(vec![Fault::Order])
        );
        assert_eq!(
            verdict(&PROVED, 20.0, true, 1e-15),
            Wrong(vec![Fault::Length(2.0)])
        );
        assert_eq!(
            verdict(&PROVED, 5.0, true, 1e-15),
            Wrong(vec![Fault::Length(0.5)])
        );
        // Runs that stopped are wrong in what they say, not in what they do not.
        assert_eq!(verdict(&[0.1, 0.2], 5.0, false, 1e-15), Stopped);
        assert_eq!(verdict(&[0.4, 0.3], 5.0, false, 1e-15), Stopped);
        assert_eq!(verdict(&[], 0.0, false, 1e-15), Stopped);
        assert_eq!(
            verdict(&[0.1, 0.3], 7.0, false, 1e-15),
            Wrong(vec![Fault::Lost(1)])
        );
        assert_eq!(
            verdict(&[0.1, 0.9], 7.0, false, 1e-15),
            Wrong(vec![Fault::Jumped(1)])
        );
        assert_eq!(
            verdict(&PROVED, 30.0, false, 1e-15),
            Wrong(vec![Fault::NotClosed(3.0)])
        );
    }

    #[test]
    fn a_stopped_run_is_no_reference() {
        let row = Row {
            way: Way {
                method: Method::Certified,
                space: Space::Full,
            },
            setting: None,
            result: Ok(measured(Mode::Certified, &PROVED, 10.0, false, 1e-12)),
            verdict: Verdict::Unjudged,
        };
        assert!(Reference::new(&row).is_none());
    }
}
