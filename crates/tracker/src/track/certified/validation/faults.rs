//! Whole runs of a tracker that goes wrong: what it proves in spite of that must still be true.
//!
//! Predictor and corrector are not part of any proof. Here they are made to lie, between the
//! corrector and the test: a run may stop then, but what it claims has to be what a sound run claims.

use super::*;
use crate::track::full::{InverseMaker, Local, Preconditioner};
use crate::track::{Control, Options, Outcome, Space, Status, solve};
use std::cell::RefCell;

/// What goes wrong, and how often.
struct Faults {
    random: Random,
    /// The share of steps in which something does.
    rate: f64,
    /// The least size of shifts, as a power of ten.
    finest: f64,
    /// Points seen before, with their normals: to come back to.
    seen: Vec<(Vec<f64>, Vec<f64>)>,
    /// How many of each kind.
    injected: [usize; 7],
}

thread_local! {
    static FAULTS: RefCell<Option<Faults>> = const { RefCell::new(None) };
}

/// The hook in the tracker: does nothing but in the tests below. Tells whether the point was moved to
/// another place of the path, or of another.
pub fn inject<const N: usize, Y: Preconditioner>(
    equations: &Equations,
    inverter: &mut InverseMaker,
    now: &Local<N, Y>,
    advance: f64,
    next: &mut Local<N, Y>,
) -> bool {
    FAULTS.with_borrow_mut(|faults| {
        let Some(faults) = faults else { return false };
        {
            // In a point of the full space, whatever the space of the run.
            let mut point = Local::new(equations);
            point.z[0].copy_from_slice(&next.z[0]);
            point.normal.copy_from_slice(&next.normal);
            let moved = faults.inject(equations, inverter, now, advance, &mut point);
            if point.z[0] != next.z[0] {
                // Low words are those of the point before, and what follows from z₀ follows from this one.
                next.low.fill(0.0);
                equations.differences(&point.z[0], &mut next.d[0]);
                equations.expand_lengths(point.z[0][equations.m], &mut next.lengths);
            }
            next.z[0].copy_from_slice(&point.z[0]);
            next.normal.copy_from_slice(&point.normal);
            moved
        }
    })
}

impl Faults {
    fn inject<const N: usize, Y: Preconditioner>(
        &mut self,
        equations: &Equations,
        inverter: &mut InverseMaker,
        now: &Local<N, Y>,
        advance: f64,
        next: &mut Local,
    ) -> bool {
        let (m, n) = (equations.m, equations.n());
        let (random, finest) = (&mut self.random, self.finest);
        if self.seen.len() < 200 {
            self.seen
                .push((next.z[0][..n].to_vec(), next.normal[..n].to_vec()));
        }
        if random.unit() >= self.rate {
            return false;
        }
        let before = next.clone();
        let kind = random.below(self.injected.len());
        match kind {
            // The corrector lands on another branch at the same t.
            0 => {
                let spread = 10f64.powf(random.between(finest + 1.0, 0.5));
                for x in &mut next.z[0][..m] {
                    *x += spread * random.between(-1.0, 1.0);
                }
                let t = next.z[0][m];
                if next.refine_at(equations, inverter, t).is_none() {
                    *next = before;
                    return false;
                }
            }
            // The prediction is shifted, perhaps to a neighbouring component.
            1 => {
                let spread = 10f64.powf(random.between(finest, 0.5));
                for x in &mut next.z[0][..n] {
                    *x += spread * random.between(-1.0, 1.0);
                }
            }
            // Links are skipped.
            2 => now.predict(
                advance * random.between(1.2, 20.0),
                None,
                &mut next.z[0],
                &mut next.normal,
            ),
            // Back the way it came.
            3 => next.normal[..n].iter_mut().for_each(|c| *c = -*c),
            // To a place seen before, the sketch perhaps, and on from there.
            4 => {
                let (z, normal) = &self.seen[random.below(self.seen.len())];
                next.z[0][..n].copy_from_slice(z);
                next.normal[..n].copy_from_slice(normal);
            }
            // To the mirror image.
            5 => {
                for x in next.z[0][..m].iter_mut().chain(&mut next.normal[..m]) {
                    if random.below(2) == 0 {
                        *x = -*x;
                    }
                }
            }
            // Not refined, and not quite on the path.
            _ => {
                let spread = 10f64.powf(random.between(-14.0, -5.0));
                for x in &mut next.z[0][..n] {
                    *x += spread * random.between(-1.0, 1.0);
                }
                self.injected[kind] += 1;
                return false;
            }
        }
        // The corrector again, so that the lie is a good one.
        if next.refine(equations, inverter, 1e-9, 8).is_err() {
            *next = before;
            return false;
        }
        self.injected[kind] += 1;
        true
    }
}

/// All that is claimed is claimed by the sound run, too. Where other objects than points tell solutions apart, as many
/// have these points in both runs.
fn claims_are_true(sound: &Outcome, faulty: &Outcome, by_points: bool, context: &str) {
    for solution in &faulty.solutions {
        let with_its_points = |run: &Outcome| {
            run.solutions
                .iter()
                .filter(|s| boxes_meet(s, solution))
                .count()
        };
        let partners = with_its_points(sound);
        if by_points {
            assert_eq!(partners, 1, "no solution of this path: {context}");
        } else {
            assert!(
                (1..=partners).contains(&with_its_points(faulty)),
                "no solution of this path: {context}"
            );
        }
    }
    if faulty.status == Status::Closed {
        assert_eq!(
            faulty.solutions.len(),
            sound.solutions.len(),
            "closed with other solutions: {context}"
        );
    }
}

/// What was tried.
#[derive(Debug, Default)]
struct Tally {
    injected: [usize; 7],
    closed: usize,
    stopped: usize,
    /// Runs in which extended precision came on, and those of them that closed.
    extended: usize,
    extended_closed: usize,
}

impl Tally {
    /// So many faults of each kind, but for those that are `rare`.
    fn has_more_than(&self, least: usize, rare: Option<usize>) {
        println!("{self:?}");
        let counts = self.injected.iter().enumerate();
        let mut others = counts.filter(|(kind, _)| Some(*kind) != rare);
        assert!(others.all(|(_, &count)| count > least), "{self:?}");
    }
}

/// Coordinates and auxiliary unknowns with signs changed at random are hardly ever near a path where there are other
/// constraints.
const MIRRORED: Option<usize> = Some(5);

/// Faulty runs of problems whose sound ones close, so many times six each.
fn try_all(
    names: &[&str],
    (rounds, finest, max_steps): (usize, f64, usize),
    random: &mut Random,
) -> Tally {
    let mut tally = Tally::default();
    for problem in problems(names) {
        for _ in 0..effort(rounds) {
            let how = (finest, &[Space::Full][..]);
            let sound = try_faults(&problem, how, max_steps, random, &mut tally);
            assert!(sound, "{}", problem.name);
        }
    }
    tally
}

/// Six faulty runs of a problem. False: the sound one does not close.
fn try_faults(
    problem: &Problem,
    (finest, spaces): (f64, &[Space]),
    max_steps: usize,
    random: &mut Random,
    tally: &mut Tally,
) -> bool {
    let run = |options| solve(problem, &options, &mut Control::default()).unwrap();
    let limited = Options {
        max_steps: 3000,
        ..Options::certified()
    };
    let sound = run(limited.clone());
    if sound.status != Status::Closed {
        return false;
    }
    for _ in 0..6 {
        let rate = [0.03, 0.3, 0.9][random.below(3)];
        let seed = random.bits() % 1_000_000;
        FAULTS.set(Some(Faults {
            random: Random::new(seed),
            rate,
            finest,
            seen: Vec::new(),
            injected: [0; 7],
        }));
        let reverse = random.below(2) == 0;
        let space = spaces[random.below(spaces.len())];
        let faulty = run(Options {
            reverse,
            space,
            max_steps,
            ..limited.clone()
        });
        let faults = FAULTS.take().expect("set above");
        for (sum, count) in tally.injected.iter_mut().zip(faults.injected) {
            *sum += count;
        }
        let context = format!("seed {seed}, rate {rate}, {}", problem.to_toml());
        claims_are_true(&sound, &faulty, problem.objects.is_empty(), &context);
        let closed = faulty.status == Status::Closed;
        if let Status::Stopped(reason) = &faulty.status {
            assert!(!reason.contains("this is a bug"), "{reason}: {context}");
        }
        let words = &faulty.switched_on;
        let extended = words.iter().any(|w| w.contains("extended precision"));
        tally.closed += usize::from(closed);
        tally.stopped += usize::from(!closed);
        tally.extended += usize::from(extended);
        tally.extended_closed += usize::from(extended && closed);
    }
    true
}

#[test]
fn no_fault_leads_to_a_false_claim() {
    let (mut random, mut tally) = (Random::new(11), Tally::default());
    for round in 0..effort(150) {
        let problem = match round % 5 {
            0 => {
                let mut problems = shipped();
                problems.swap_remove(random.below(problems.len()))
            }
            k => {
                let dimension = 2 + k % 2;
                let points = dimension + 1 + random.below(5);
                random_problem(&mut random, dimension, points, 0.3)
            }
        };
        let how = (-4.0, &[Space::Full, Space::Reduced][..]);
        try_faults(&problem, how, 600, &mut random, &mut tally);
    }
    tally.has_more_than(50, None);
    assert!(tally.closed > 100);
}

/// Where other branches are 1e-8 away, and less than 53 bits can tell: with faults as small as that.
#[test]
fn no_fault_leads_to_a_false_claim_near_singular_places() {
    let names = [
        "hard/flaps-split-8",
        "hard/fold-8",
        "hard/triple-3",
        "hard/crowd-2",
        "hard/tents-split-4",
        "hard/graze-4",
        "hard/flaps-apart-3",
        "hard/fold-missed-5",
    ];
    let tally = try_all(&names, (2, -12.0, 3000), &mut Random::new(13));
    tally.has_more_than(50, None);
    assert!(
        tally.extended > 10 && tally.extended_closed > 3,
        "{tally:?}"
    );
}

/// Constraints of other kinds, each with auxiliary unknowns of its own.
#[test]
fn no_fault_leads_to_a_false_claim_with_other_constraints() {
    let names = [
        "constraints/3p3l",
        "constraints/3p3l-orthogonal",
        "constraints/6p7d3a2c-closed",
        "constraints/pentahedron",
    ];
    let tally = try_all(&names, (3, -4.0, 1000), &mut Random::new(17));
    tally.has_more_than(20, MIRRORED);
    assert!(tally.closed > 5, "{tally:?}");
}

#[test]
fn no_fault_leads_to_a_false_claim_with_mixed_kinds() {
    let (mut random, mut tally) = (Random::new(19), Tally::default());
    let mut sound = 0;
    for round in 0..effort(60) {
        let problem = mixed_problem(&mut random, 2 + round % 2);
        let how = (-4.0, &[Space::Full, Space::Reduced][..]);
        sound += usize::from(try_faults(&problem, how, 600, &mut random, &mut tally));
    }
    tally.has_more_than(20, MIRRORED);
    assert!(sound > 25 && tally.closed > 30, "{tally:?}");
}
