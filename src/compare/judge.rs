//! Whether a run is right, judged against the certified run: solution by solution, each of which
//! has to be in the place of one of the proved boxes, not just by counting.
//!
//! A certified run that closed proves all solutions of the path, one that ended open those of an arc of it.

use super::matching::Matching;
use super::{Measured, Method, Row};
use crate::places::Each as _;
use crate::track::{Mode, Outcome, Status};
use std::fmt;

crate::named! {
    /// What a run is worth.
    #[derive(Debug, Clone, PartialEq)]
    pub enum Verdict {
        /// It ended as the certified run did, closed or open, and its solutions are those of that run, in the same order.
        /// For a certified run itself: it is proved.
        Right = "right",
        /// It stopped, and nothing that it says up to there is wrong.
        Stopped = "stopped",
        /// A certified run that ended open, as the one that others are judged by did, but earlier: nothing that it says is wrong,
        /// and so many solutions of the arc that the other one proved are beyond its ends.
        Earlier(usize) = "earlier",
        /// It is wrong in these ways.
        Wrong(Vec<Fault>) = "wrong",
        /// No certified run closed or ended open, so that nothing can be judged. Or one proved an arc, on which this run
        /// is not wrong, but it says more than can be told from that: it closed, or has figures beside those that are on the arc.
        /// The path may be closed beyond the ends of the arc, and the figures may be on it there.
        Unjudged = "unjudged",
    }
}

crate::named! {
    /// A way of being wrong.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub enum Fault {
        /// It closed, or ended open, without this many of the solutions on the path (or the proved arc), or passed over them
        /// before it stopped.
        Lost(usize) = "lost",
        /// This many figures meet all constraints, but are not on the path through the sketch: the
        /// run jumped to another one.
        Jumped(usize) = "jumped",
        /// This many figures do not even meet the constraints, or were reported twice.
        Invented(usize) = "invented",
        /// It met the solutions in another order than the path does: it jumped from one part of the
        /// path to another, or took one solution for another.
        Order = "order",
        /// It closed after this many times the path's length: not the loop through the sketch, or not
        /// once.
        Length(f64) = "length",
        /// It went on for this many times the path's length and did not notice the sketch.
        NotClosed(f64) = "not_closed",
        /// It ended open, though the path is closed.
        Open = "open",
    }
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
            Fault::Open => write!(f, "open, and the path is closed"),
        }
    }
}

/// A solution is in the place of a box if no number of it is further away than this, relative to
/// the figure's size. Float runs correct their solutions to about 1e-15 times a condition number,
/// so that it leaves room for conditions up to a billion; of several boxes the nearest counts.
const PLACE: f64 = 1e-6;
/// Figures meet the constraints if their residual (see `residual.rs`) is below this.
const MEETS: f64 = 1e-8;
/// The lengths of a path that two runs measure agree to this. Chords are shorter than arcs, by the part
/// δ²/24 where steps turn by δ: less than a quarter even if all of them turn by 2 radians.
const LENGTHS: std::ops::RangeInclusive<f64> = 0.75..=1.01;

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ending {
    Closed,
    Open,
    Stopped,
}

impl Ending {
    fn of(outcome: &Outcome) -> Self {
        match outcome.status {
            Status::Closed => Ending::Closed,
            Status::Open(_) => Ending::Open,
            Status::Stopped(_) => Ending::Stopped,
        }
    }
}

/// A certified run that closed or ended open.
pub(super) struct Reference<'m> {
    outcome: Outcome,
    matching: &'m Matching,
}

impl<'m> Reference<'m> {
    /// Of all rows the first certified run that closed, or else, of those that ended open, the one with the most solutions.
    pub fn among(rows: &[Row], matching: &'m Matching) -> Option<Self> {
        let certified = rows
            .iter()
            .filter(|row| row.way.method == Method::Certified)
            .filter_map(Row::measured)
            .map(|measured| &measured.outcome)
            .filter(|outcome| outcome.mode == Mode::Certified);
        let mut best: Option<&Outcome> = None;
        for outcome in certified {
            let is_better = match (Ending::of(outcome), best) {
                (Ending::Stopped, _) => false,
                (_, None) => true,
                (Ending::Closed, Some(best)) => Ending::of(best) == Ending::Open,
                (Ending::Open, Some(best)) => {
                    Ending::of(best) == Ending::Open
                        && outcome.solutions.len() > best.solutions.len()
                }
            };
            if is_better {
                best = Some(outcome);
            }
        }
        best.map(|outcome| Reference {
            outcome: outcome.clone(),
            matching,
        })
    }

    /// The length of the path, if all of it is proved.
    pub fn length(&self) -> Option<f64> {
        (Ending::of(&self.outcome) == Ending::Closed).then_some(self.outcome.length)
    }

    fn judge(&self, measured: &Measured) -> Verdict {
        let outcome = &measured.outcome;
        let (known, ending) = (Ending::of(&self.outcome), Ending::of(outcome));
        let all = self.outcome.solutions.len();
        let mut places: Vec<usize> = Vec::new();
        let (mut jumped, mut invented, mut repeated) = (0, 0, 0);
        for (k, solution) in outcome.solutions.iter().enumerate() {
            let boxes = &self.outcome.solutions;
            match self.matching.place_of(boxes, solution, PLACE) {
                Some(place) if places.contains(&place) => repeated += 1,
                Some(place) => places.push(place),
                None if measured.residuals.get(k).is_some_and(|r| *r <= MEETS) => jumped += 1,
                None => invented += 1,
            }
        }
        let mut faults = Vec::new();
        // The path may be followed either way where the sketch is at a fold of t. A run that closed goes from the sketch to the
        // one end of a proved arc, and comes back by the other.
        let first = match (known, ending) {
            (Ending::Open, Ending::Closed) => self.solutions_behind(),
            _ => 0,
        };
        let forth: Vec<usize> = (first..all).chain(0..first).collect();
        let back: Vec<usize> = forth.iter().rev().copied().collect();
        // What is proved of an arc does not say that the path has no more: another proof may have got less far.
        let is_piece = ending == Ending::Open && outcome.mode == Mode::Certified;
        let lost = match known {
            _ if ending != Ending::Stopped && !is_piece => all - places.len(),
            Ending::Open => self.passed_over_on_arc(&places),
            _ => [&forth, &back]
                .each(|way| passed_over(way, &places))
                .into_iter()
                .min()
                .unwrap_or(0),
        };
        if lost > 0 {
            faults.push(Fault::Lost(lost));
        }
        // Beyond the ends of an arc the path may have more.
        let beyond = match known {
            Ending::Open => std::mem::take(&mut jumped),
            _ => 0,
        };
        if jumped > 0 {
            faults.push(Fault::Jumped(jumped));
        }
        if invented + repeated > 0 {
            faults.push(Fault::Invented(invented + repeated));
        }
        if ![&forth, &back]
            .into_iter()
            .any(|way| is_in_order(way, &places))
        {
            faults.push(Fault::Order);
        }
        let part = outcome.length / self.outcome.length;
        match (known, ending) {
            (Ending::Closed, Ending::Closed) if !LENGTHS.contains(&part) => {
                faults.push(Fault::Length(part));
            }
            (Ending::Closed, Ending::Stopped) if part > *LENGTHS.end() => {
                faults.push(Fault::NotClosed(part));
            }
            (Ending::Closed, Ending::Open) => faults.push(Fault::Open),
            _ => {}
        }
        match (faults.is_empty(), ending) {
            (false, _) => Verdict::Wrong(faults),
            _ if beyond > 0 => Verdict::Unjudged,
            // That the arc's ends are those of the path is not proved.
            (true, Ending::Closed) if known == Ending::Open => Verdict::Unjudged,
            (true, Ending::Stopped) => Verdict::Stopped,
            (true, Ending::Open) if is_piece && places.len() < all => {
                Verdict::Earlier(all - places.len())
            }
            (true, _) => Verdict::Right,
        }
    }

    /// How many solutions of the arc between the sketch and those met, on either side of it, were not met: a run that goes
    /// both ways from the sketch has seen one stretch of the path.
    fn passed_over_on_arc(&self, places: &[usize]) -> usize {
        let behind = self.solutions_behind();
        let ways: [Vec<usize>; 2] = [
            (behind..self.outcome.solutions.len()).collect(),
            (0..behind).rev().collect(),
        ];
        let over = ways.iter().map(|way| {
            let met: Vec<usize> = places.iter().copied().filter(|k| way.contains(k)).collect();
            passed_over(way, &met)
        });
        over.sum()
    }

    /// How many solutions of the arc, the first ones, are behind the sketch.
    fn solutions_behind(&self) -> usize {
        let solutions = self.outcome.solutions.iter();
        solutions
            .take_while(|solution| solution.place.is_some_and(|place| place.arc < 0.0))
            .count()
    }
}

/// Judges all rows, if there is something to judge them against.
pub(super) fn all(rows: &mut [Row], reference: Option<&Reference<'_>>) {
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

#[cfg(test)]
mod tests {
    use super::super::{Row, Way};
    use super::*;
    use crate::interval::{hull, point};
    use crate::problem::Problem;
    use crate::system::Homotopy;
    use crate::track::{EndKind, PathEnd, Place, Solution, Space, Status, Stop, StopKind};

    /// A run that met figures of one moving point, and how far it went.
    fn measured(mode: Mode, met: &[f64], length: f64, ending: Ending, residual: f64) -> Measured {
        let radius = if mode == Mode::Certified { 1e-12 } else { 0.0 };
        let solution = |&x: &f64| Solution {
            width: 2.0 * radius,
            // The sketch is at 0.25.
            place: (mode == Mode::Certified).then_some(Place {
                arc: x - 0.25,
                rising: true,
                folds: None,
            }),
            ..Solution::placed(
                vec![
                    [point(0.0); 3],
                    [hull(x - radius, x + radius), point(1.0), point(0.0)],
                ],
                0,
            )
        };
        let end = || PathEnd {
            t: (2.0, 2.0),
            kind: EndKind::Infinite,
            stop: None,
            what: String::new(),
            reason: "somehow".into(),
            away: None,
            points: Vec::new(),
        };
        let status = match ending {
            Ending::Closed => Status::Closed,
            Ending::Open => Status::Open(Box::new([end(), end()])),
            Ending::Stopped => Status::Stopped(Stop::new(StopKind::NoStep, "somewhere")),
        };
        Measured {
            outcome: Outcome {
                solutions: met.iter().map(solution).collect(),
                steps: 1,
                length,
                t_range: (0.0, 1.0),
                seconds: 1.0,
                ..Outcome::new(mode, Space::Full, status)
            },
            seconds: vec![1.0],
            median: 1.0,
            residual: Some(residual),
            residuals: vec![residual; met.len()],
        }
    }

    const PROVED: [f64; 4] = [0.1, 0.2, 0.3, 0.4];
    /// With one that is not proved, and with one twice.
    const BEYOND: [f64; 5] = [0.1, 0.2, 0.3, 0.35, 0.4];
    const TWICE: [f64; 5] = [0.1, 0.2, 0.2, 0.3, 0.4];

    fn certified(met: &[f64], ending: Ending) -> Row {
        Row {
            way: Way {
                method: Method::Certified,
                space: Space::Full,
            },
            setting: None,
            result: Ok(measured(Mode::Certified, met, 10.0, ending, 1e-12)),
            verdict: Verdict::Unjudged,
        }
    }

    fn matching() -> Matching {
        let problem = Problem::read("problems/k33.toml").unwrap();
        Matching::new(&Homotopy::new(&problem).unwrap())
    }

    /// A run beside a certified one that met four solutions, two behind the sketch and two ahead.
    fn judged(known: Ending, run: &Measured) -> Verdict {
        let matching = matching();
        let rows = [certified(&PROVED, known)];
        let reference = Reference::among(&rows, &matching).unwrap();
        reference.judge(run)
    }

    fn wrong(fault: Fault) -> Verdict {
        Verdict::Wrong(vec![fault])
    }

    #[test]
    fn an_arc_is_a_reference() {
        use Fault::{Invented, Lost, Order};
        use Verdict::{Earlier, Right, Stopped, Unjudged};
        let on_arc = |mode, met: &[f64], ending, residual| {
            judged(Ending::Open, &measured(mode, met, 30.0, ending, residual))
        };
        for (met, ending, verdict) in [
            (&PROVED[..], Ending::Open, Right),
            (&[0.4, 0.3, 0.2, 0.1], Ending::Open, Right),
            (&[0.2, 0.3, 0.4], Ending::Open, wrong(Lost(1))),
            (&[0.1, 0.3, 0.2, 0.4], Ending::Open, wrong(Order)),
            // That the path is closed beyond its ends may be. A run that says so goes from the sketch, at 0.25, to the one end
            // of the arc and comes back by the other.
            (&[0.3, 0.4, 0.1, 0.2], Ending::Closed, Unjudged),
            (&[0.2, 0.1, 0.4, 0.3], Ending::Closed, Unjudged),
            (&[0.3, 0.4, 0.5, 0.1, 0.2], Ending::Closed, Unjudged),
            (&PROVED, Ending::Closed, wrong(Order)),
            (&[0.3, 0.4, 0.2], Ending::Closed, wrong(Lost(1))),
            // One that stopped has seen one stretch, with the sketch in it.
            (&[], Ending::Stopped, Stopped),
            (&[0.3], Ending::Stopped, Stopped),
            (&[0.2], Ending::Stopped, Stopped),
            (&[0.2, 0.1], Ending::Stopped, Stopped),
            (&[0.2, 0.3], Ending::Stopped, Stopped),
            (&[0.1, 0.2, 0.3], Ending::Stopped, Stopped),
            (&[0.4], Ending::Stopped, wrong(Lost(1))),
            (&[0.1], Ending::Stopped, wrong(Lost(1))),
            (&[0.1, 0.3], Ending::Stopped, wrong(Lost(1))),
            (&[0.2, 0.4], Ending::Stopped, wrong(Lost(1))),
            // Figures beyond the ends are nothing that can be told.
            (&[0.1, 0.2, 0.3, 0.4, 0.5], Ending::Open, Unjudged),
        ] {
            let found = on_arc(Mode::Float, met, ending, 1e-15);
            assert_eq!(found, verdict, "{met:?} {ending:?}");
        }
        // What does not meet the constraints is wrong.
        for (met, ending) in [
            ([0.3, 0.4, 0.5, 0.1, 0.2], Ending::Closed),
            ([0.1, 0.2, 0.3, 0.4, 0.5], Ending::Open),
        ] {
            let found = on_arc(Mode::Float, &met, ending, 1e-3);
            assert_eq!(found, wrong(Invented(1)));
        }
        // Another proof may get less far, and does not pass over anything.
        let proved = |met: &[f64]| on_arc(Mode::Certified, met, Ending::Open, 1e-12);
        assert_eq!(proved(&PROVED), Right);
        assert_eq!(proved(&[0.2, 0.3]), Earlier(2));
        assert_eq!(proved(&[0.1, 0.2, 0.3]), Earlier(1));
        assert_eq!(proved(&[]), Earlier(4));
        // Its figures beyond the other end are not known to be wrong.
        assert_eq!(proved(&[0.3, 0.4, 0.5]), Unjudged);
        assert_eq!(proved(&[0.1, 0.3]), wrong(Lost(1)));
        // A closed path is not open.
        let matching = matching();
        let rows = [
            certified(&PROVED, Ending::Open),
            certified(&PROVED, Ending::Closed),
        ];
        let reference = Reference::among(&rows, &matching).unwrap();
        assert_eq!(reference.length(), Some(10.0));
        let open = measured(Mode::Float, &PROVED, 10.0, Ending::Open, 1e-15);
        assert_eq!(reference.judge(&open), wrong(Fault::Open));
    }

    #[test]
    fn finds_each_fault() {
        use Fault::{Invented, Jumped, Length, Lost, NotClosed, Order};
        use Verdict::{Right, Stopped};
        let (closed, stopped) = (Ending::Closed, Ending::Stopped);
        for (met, length, ending, residual, verdict) in [
            (&PROVED[..], 10.0, closed, 1e-15, Right),
            (&[0.1 + 1e-9, 0.2, 0.3, 0.4], 9.8, closed, 1e-15, Right),
            (&[0.4, 0.3, 0.2, 0.1], 10.0, closed, 1e-15, Right),
            (&[0.1, 0.2, 0.4], 10.0, closed, 1e-15, wrong(Lost(1))),
            (&BEYOND, 10.0, closed, 1e-15, wrong(Jumped(1))),
            (&BEYOND, 10.0, closed, 1e-3, wrong(Invented(1))),
            (&TWICE, 10.0, closed, 1e-15, wrong(Invented(1))),
            (&[0.1, 0.3, 0.2, 0.4], 10.0, closed, 1e-15, wrong(Order)),
            (&PROVED, 20.0, closed, 1e-15, wrong(Length(2.0))),
            (&PROVED, 5.0, closed, 1e-15, wrong(Length(0.5))),
            // Runs that stopped are wrong in what they say, not in what they do not.
            (&[0.1, 0.2], 5.0, stopped, 1e-15, Stopped),
            (&[0.4, 0.3], 5.0, stopped, 1e-15, Stopped),
            (&[], 0.0, stopped, 1e-15, Stopped),
            (&[0.1, 0.3], 7.0, stopped, 1e-15, wrong(Lost(1))),
            (&[0.1, 0.9], 7.0, stopped, 1e-15, wrong(Jumped(1))),
            (&PROVED, 30.0, stopped, 1e-15, wrong(NotClosed(3.0))),
        ] {
            let run = measured(Mode::Float, met, length, ending, residual);
            assert_eq!(judged(Ending::Closed, &run), verdict, "{met:?} {length}");
        }
    }

    #[test]
    fn a_stopped_run_is_no_reference() {
        let rows = [certified(&PROVED, Ending::Stopped)];
        assert!(Reference::among(&rows, &matching()).is_none());
    }
}
