//! One sketch: recognised on a path that is proved, or followed.

use super::record::{BoxRecord, End, Met, PathRecord, Sketch, bounds};
use super::way::{Way, is_usable};
use crate::interval::vector::distance;
use crate::places::Each as _;
use crate::problem::Problem;
use crate::system::Homotopy;
use crate::track::{
    Control, FiguresSeen, Limit, Options, Relation, Status, prove_figure, solve_in_best_space,
};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Limits of a path.
#[derive(Debug, Clone, Copy)]
pub struct Limits<'a> {
    /// A run that takes more tubes is stopped.
    pub most_tubes: usize,
    /// Set from outside to end all runs.
    pub cancel: Option<&'a AtomicBool>,
    /// When all runs end.
    pub deadline: Option<Instant>,
}

impl Limits<'_> {
    /// Whether somebody asked to end.
    pub fn was_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// Whether it is time to end.
    pub fn is_over(&self) -> bool {
        self.was_cancelled() || self.deadline.is_some_and(|end| Instant::now() >= end)
    }
}

/// A path that is done, whose figures with t = 0 may be the sketch's.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// The path's number.
    pub id: u64,
    /// Its problem, with its own sketch and bend.
    pub problem: Problem,
    /// Its figures with t = 0.
    pub starts: Vec<BoxRecord>,
}

/// A sketch and its problem, to be followed.
#[derive(Debug, Clone)]
pub struct Job {
    /// The sketch.
    pub sketch: Sketch,
    /// The problem with this sketch and its way's bend.
    pub problem: Problem,
    /// Paths with nearly the same lengths at t = 0 and the same bend.
    pub candidates: Vec<Candidate>,
}

/// The lengths of all distances of a problem's sketch, in floats.
pub fn lengths_of(problem: &Problem) -> Vec<f64> {
    let places = problem.places();
    let length = |[a, b]: [usize; 2]| distance(places[a], places[b]);
    problem.distances.iter().map(|d| length(d.points)).collect()
}

/// Two sketches have the same lengths where they agree so far, relatively.
pub const SAME_LENGTHS: f64 = 1e-8;

/// How far the exact figure may be from the sketch that it stands for, in typical lengths.
const NEAR: f64 = 1e-5;

impl Job {
    /// The path that passes through this sketch at t = 0, if one of the candidates is proved to.
    ///
    /// A sketch is rough: what is looked for is the figure next to it that has exactly the lengths of the candidate's
    /// own sketch. It is proved to exist, and to be the one in a box that the candidate's tubes passed through.
    fn recognise(&self) -> Option<u64> {
        let candidates = self.candidates.iter();
        let mut passing = candidates.filter(|candidate| self.is_on(candidate).unwrap_or(false));
        passing.next().map(|candidate| candidate.id)
    }

    fn is_on(&self, candidate: &Candidate) -> Option<bool> {
        let own = Homotopy::new(&self.problem).ok()?;
        let homotopy = Homotopy::new(&candidate.problem).ok()?;
        if !have_same_form(&own, &homotopy) {
            return None;
        }
        let near: Vec<f64> = own.sketch_of_unknowns().map(|x| x.mid()).collect();
        let figure = prove_figure(&homotopy, &near, true).ok()?;
        let off = figure.figure.centre.iter().zip(&near);
        if off.fold(0.0, |max: f64, (x, y)| max.max((x - y).abs())) > NEAR {
            return None;
        }
        let mut starts = candidate.starts.iter().map(BoxRecord::figure);
        Some(starts.any(|start| figure.relation(&start, &homotopy) == Relation::Congruent))
    }

    /// Follows the sketch, unless it is recognised. `None`: it was time to end before.
    pub fn run(&self, limits: &Limits) -> Option<PathRecord> {
        let clock = Instant::now();
        let record = |end, reason| PathRecord {
            seconds: clock.elapsed().as_secs_f64(),
            ..PathRecord::new(self.sketch.id, end, reason)
        };
        if limits.is_over() {
            return None;
        }
        if let Some(by) = self.recognise() {
            return Some(PathRecord {
                by: Some(by),
                ..record(End::Recognised, None)
            });
        }
        if !is_usable(&self.problem) {
            let reason = "points of the sketch that must be apart are not".to_owned();
            return Some(record(End::Unusable, Some(reason)));
        }
        let mut seen = FiguresSeen::default();
        let far = Instant::now() + Duration::from_secs(1_000_000);
        let mut control = Control {
            cancel: limits.cancel,
            limit: limits.deadline.map(|deadline| Limit {
                length: f64::INFINITY,
                deadline: deadline.min(far),
            }),
            figures: Some(&mut seen),
            ..Control::default()
        };
        let options = Options {
            max_steps: limits.most_tubes,
            ..Options::certified()
        };
        let outcome = match solve_in_best_space(&self.problem, &options, &mut control) {
            Ok(outcome) => outcome,
            Err(error) => return Some(record(End::Unusable, Some(error.to_string()))),
        };
        let (end, reason) = match outcome.status {
            Status::Closed => (End::Closed, None),
            Status::Open(ends) => {
                let reasons = ends.iter().map(|end| end.reason.clone());
                (End::Open, Some(reasons.collect::<Vec<_>>().join("; ")))
            }
            // It was broken off, and will be followed anew.
            Status::Stopped(_) if limits.is_over() => return None,
            Status::Stopped(stop) => (End::Stopped, Some(stop.text)),
        };
        let mut classes = Vec::new();
        let pairs = outcome.solutions.iter().zip(&seen.solutions);
        let solutions = pairs.filter_map(|(solution, figure)| {
            if solution.is_degenerate || classes.contains(&solution.class) {
                return None;
            }
            classes.push(solution.class);
            Some(Met {
                points: bounds(&solution.points),
                figure: BoxRecord::of(figure),
            })
        });
        let solutions = solutions.collect();
        let degenerate = outcome.solutions.iter().filter(|s| s.is_degenerate);
        Some(PathRecord {
            degenerate: degenerate.count(),
            tubes: outcome.steps,
            solutions,
            starts: match end {
                // What a run that stopped passes through is not known to be on a path with all its solutions.
                End::Closed | End::Open => seen.start.iter().map(BoxRecord::of).collect(),
                _ => Vec::new(),
            },
            ..record(end, reason)
        })
    }
}

/// A job for a sketch.
pub fn job(problem: &Problem, way: &Way, sketch: Sketch, candidates: Vec<Candidate>) -> Job {
    Job {
        problem: way.problem(problem, sketch.places()),
        sketch,
        candidates,
    }
}

/// Whether two homotopies of one problem, with different sketches, have the same unknowns and left-hand sides, and the
/// same right-hand sides at t = 1: then solutions of one are those of the other. (How a constraint is written may
/// depend on the sketch.)
pub fn have_same_form(one: &Homotopy, other: &Homotopy) -> bool {
    let same_unknowns = || {
        let unknowns = one.tail.unknowns.iter().zip(&other.tail.unknowns);
        let mut pairs = unknowns.map(|(a, b)| {
            a.name == b.name && a.power == b.power && a.role == b.role && a.flips == b.flips
        });
        pairs.all(|same| same)
    };
    // What is to be met at t = 1 is what the problem says, whatever the sketch; it is enclosed from the sketch's numbers.
    // Enclosures that are disjoint show that the other sketch has the constraint the other way round.
    let targets_agree = |e: usize| {
        let [a, b] = [one, other].each(|h| h.rights[e].at_target());
        !a.disjoint(b)
    };
    one.unit == other.unit
        && one.equations == other.equations
        && one.tail.unknowns.len() == other.tail.unknowns.len()
        && same_unknowns()
        && one.tail.mirrors == other.tail.mirrors
        && one.tail.twins == other.tail.twins
        && (0..one.equations).all(|e| one.terms(e) == other.terms(e) && targets_agree(e))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explore::construction::Construction;

    const FREE: Limits = Limits {
        most_tubes: 100_000,
        cancel: None,
        deadline: None,
    };

    fn sketch(id: u64, points: Vec<[f64; 3]>) -> Sketch {
        Sketch {
            id,
            way: 0,
            from: None,
            points,
            look: Vec::new(),
        }
    }

    /// A loop meets t = 0 an even number of times: at the sketch, and at another figure with the sketch's lengths. A
    /// sketch drawn there is on that path; one of another component with the same lengths is not.
    #[test]
    fn a_sketch_on_a_proved_path_is_recognised() {
        let problem = Problem::read("problems/octahedron.toml").unwrap();
        let way = Way::new(&problem, &Construction::some(&problem, 1), 0);
        let first = job(&problem, &way, sketch(0, Vec::new()), Vec::new());
        let record = first.run(&FREE).unwrap();
        assert_eq!((record.end, record.solutions.len()), (End::Closed, 4));
        assert!(record.starts.len() >= 2, "{}", record.starts.len());
        let homotopy = Homotopy::new(&first.problem).unwrap();
        let candidate = Candidate {
            id: 0,
            problem: first.problem.clone(),
            starts: record.starts.clone(),
        };
        for start in &record.starts {
            let points = start.figure().points(&homotopy);
            let points: Vec<[f64; 3]> = points.iter().map(|p| p.each(|x| x.mid())).collect();
            let mirrored: Vec<[f64; 3]> = points.iter().map(|&[x, y, z]| [x, y, -z]).collect();
            for points in [points, mirrored] {
                let again = job(&problem, &way, sketch(1, points), vec![candidate.clone()]);
                assert!(agree_in_lengths(&again.problem, &first.problem));
                let again = again.run(&FREE).unwrap();
                assert_eq!((again.end, again.by), (End::Recognised, Some(0)));
            }
        }
        // Without the proof that the path passes there it is followed, and finds the same.
        let nowhere = Candidate {
            starts: Vec::new(),
            ..candidate
        };
        let points = record.starts[1].figure().points(&homotopy);
        let points = points.iter().map(|p| p.each(|x| x.mid())).collect();
        let again = job(&problem, &way, sketch(1, points), vec![nowhere]);
        let again = again.run(&FREE).unwrap();
        assert_eq!((again.end, again.solutions.len()), (End::Closed, 4));
    }

    fn agree_in_lengths(one: &Problem, other: &Problem) -> bool {
        super::super::index::agree(&lengths_of(one), &lengths_of(other), SAME_LENGTHS)
    }
}
