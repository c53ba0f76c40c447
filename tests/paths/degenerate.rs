//! Paths through degenerate (flat) figures at t = 1: what is claimed of them, against arithmetic of the test's own.

use crate::common::certificate::{self, Certificate};
use crate::common::solve;
use krawl::certificate::{
    EndClaim, Ending, Flaw, FormatError, Outcome as Verdicts, Record, Settings, SolutionClaim,
    Verdict, verify,
};
use krawl::interval::{Interval, hull, point};
use krawl::problem::Problem;
use krawl::report::theorem;
use krawl::system::Homotopy;
use krawl::track::{Mode, Options, Outcome, Solution, Space, Status};
use std::collections::BTreeSet;
use std::sync::OnceLock;
use std::time::Duration;

/// The lengths and faces of the hexahedron, by the numbers of points.
const LENGTHS: [(usize, usize, f64); 12] = [
    (0, 1, 1.3),
    (1, 2, 1.3),
    (2, 3, 1.3),
    (3, 0, 0.5),
    (0, 6, 0.7),
    (1, 7, 0.9),
    (2, 4, 0.8),
    (3, 5, 0.8),
    (5, 6, 0.5),
    (6, 7, 1.9),
    (7, 4, 1.8),
    (4, 5, 1.5),
];
const FACES: [[usize; 4]; 6] = [
    [0, 1, 2, 3],
    [1, 2, 4, 7],
    [2, 3, 5, 4],
    [3, 0, 6, 5],
    [0, 1, 7, 6],
    [4, 5, 6, 7],
];

type Figure = Vec<[f64; 3]>;

/// The one with the longer path.
fn hexahedron() -> Problem {
    Problem::read("tests/data/hexahedron-28.toml").unwrap()
}

/// The one that is shipped, with the same lengths and faces.
fn shipped() -> Problem {
    Problem::read("problems/constraints/hexahedron.toml").unwrap()
}

fn middle(solution: &Solution) -> Figure {
    let of = |p: &[krawl::interval::Interval; 3]| p.map(|x| x.mid());
    solution.points.iter().map(of).collect()
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn volume(figure: &Figure, [a, b, c, d]: [usize; 4]) -> f64 {
    let [u, v, w] = [b, c, d].map(|p| minus(figure[p], figure[a]));
    u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
        + u[2] * (v[0] * w[1] - v[1] * w[0])
}

fn length(figure: &Figure, i: usize, j: usize) -> f64 {
    minus(figure[i], figure[j])
        .iter()
        .map(|x| x * x)
        .sum::<f64>()
        .sqrt()
}

fn is_flat(figure: &Figure) -> bool {
    figure.iter().all(|p| p[2].abs() < 1e-9)
}

/// The coefficients of the conditions on heights of a flat figure, over those of p3 to p7: heights w over 1 − t satisfy
/// D w = the faces' volumes in the sketch.
fn conditions(figure: &Figure) -> Vec<[f64; 5]> {
    let lifted = |p: usize| {
        let mut figure = figure.clone();
        figure[p][2] += 1.0;
        figure
    };
    let of_face = |&face: &[usize; 4]| {
        std::array::from_fn(|k| volume(&lifted(3 + k), face) - volume(figure, face))
    };
    FACES.iter().map(of_face).collect()
}

/// What the best heights leave of the conditions: least squares by Gram and Schmidt.
fn left_over(figure: &Figure, volumes: &[f64]) -> f64 {
    let rows = conditions(figure);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut rest = volumes.to_vec();
    for k in 0..5 {
        let mut column: Vec<f64> = rows.iter().map(|row| row[k]).collect();
        for _ in 0..2 {
            for b in &basis {
                let along = dot(&column, b);
                column.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
            }
        }
        let size = dot(&column, &column).sqrt();
        assert!(size > 1e-6, "the heights are not determined");
        column.iter_mut().for_each(|x| *x /= size);
        let along = dot(&rest, &column);
        rest.iter_mut()
            .zip(&column)
            .for_each(|(x, y)| *x -= along * y);
        basis.push(column);
    }
    dot(&rest, &rest).sqrt() / dot(volumes, volumes).sqrt()
}

/// The volumes of the faces in the sketch as the reference sees it: which a rigid motion does not change. The problem
/// leads p3's height instead of its face's volume, to the same zero.
fn volumes_in_sketch(problem: &Problem, flat: &Figure) -> Vec<f64> {
    let decimal = |x: &krawl::problem::Decimal| x.to_string().parse::<f64>().unwrap();
    let place = |p: &krawl::problem::Point| p.sketch.each_ref().map(decimal);
    let sketch: Figure = problem.points.iter().map(place).collect();
    let mut volumes: Vec<f64> = FACES.iter().map(|&face| volume(&sketch, face)).collect();
    // The height of p3 in the sketch, as the flat figure's base makes a volume of it.
    let normal = |figure: &Figure| {
        let (u, v) = (minus(figure[1], figure[0]), minus(figure[2], figure[0]));
        [
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ]
    };
    let size = normal(&sketch).iter().map(|x| x * x).sum::<f64>().sqrt();
    volumes[0] *= normal(flat)[2] / size;
    volumes
}

/// What holds of solutions, whoever lists them.
fn check(problem: &Problem, outcome: &Outcome) -> (usize, usize) {
    let mut degenerate = 0;
    for solution in &outcome.solutions {
        let figure = middle(solution);
        for (i, j, l) in LENGTHS {
            assert!((length(&figure, i, j) - l).abs() < 1e-8);
        }
        for face in FACES {
            assert!(volume(&figure, face).abs() < 1e-8);
        }
        assert_eq!(is_flat(&figure), solution.is_degenerate);
        if !solution.is_degenerate {
            continue;
        }
        degenerate += 1;
        assert!(solution.points.iter().all(|p| p[2].mag() == 0.0));
        // It is the one on its curve of flat figures in which heights over 1 − t have limits, and its neighbours
        // on that curve are not.
        let volumes = volumes_in_sketch(problem, &figure);
        let here = left_over(&figure, &volumes);
        assert!(here < 1e-7, "{here:e}");
        let mut found = 0;
        for step in [1e-3, -1e-3] {
            let other = along_the_curve(&figure, step);
            let there = left_over(&other, &volumes);
            assert!(there > 100.0 * here.max(1e-9), "{there:e} at {step}");
            found += 1;
        }
        assert_eq!(found, 2);
    }
    (outcome.solutions.len(), degenerate)
}

/// Another flat figure of the same lengths: a step along their curve, corrected by Newton's method with minimal
/// corrections.
fn along_the_curve(figure: &Figure, step: f64) -> Figure {
    // Unknowns: x of p1, x and y of p2 to p7.
    let free: Vec<(usize, usize)> = std::iter::once((1, 0))
        .chain((2..8).flat_map(|p| [(p, 0), (p, 1)]))
        .collect();
    let row = |figure: &Figure, (i, j, _): (usize, usize, f64)| -> Vec<f64> {
        let d = minus(figure[i], figure[j]);
        let entry = |&(p, k): &(usize, usize)| d[k] * (f64::from(p == i) - f64::from(p == j));
        free.iter().map(entry).collect()
    };
    // The kernel of 12 rows in 13 unknowns: what is left of a vector behind an orthonormal basis of the rows.
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let orthonormal = |figure: &Figure| {
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for l in LENGTHS {
            let mut r = row(figure, l);
            for _ in 0..2 {
                for b in &basis {
                    let along = dot(&r, b);
                    r.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
                }
            }
            let size = dot(&r, &r).sqrt();
            assert!(size > 1e-6, "the lengths are dependent");
            r.iter_mut().for_each(|x| *x /= size);
            basis.push(r);
        }
        basis
    };
    let basis = orthonormal(figure);
    let mut kernel: Vec<f64> = (0..13).map(|k| 1.0 + (k as f64).sin()).collect();
    for _ in 0..2 {
        for b in &basis {
            let along = dot(&kernel, b);
            kernel.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
        }
    }
    let size = dot(&kernel, &kernel).sqrt();
    let mut other = figure.clone();
    for (&(p, k), x) in free.iter().zip(&kernel) {
        other[p][k] += step * x / size;
    }
    // Kaczmarz's method: one length after the other.
    for _ in 0..4000 {
        for (i, j, l) in LENGTHS {
            let r = row(&other, (i, j, l));
            let excess = 0.5 * (length(&other, i, j).powi(2) - l * l);
            let by = excess / dot(&r, &r);
            for (&(p, k), x) in free.iter().zip(&r) {
                other[p][k] -= by * x;
            }
        }
    }
    for (i, j, l) in LENGTHS {
        assert!((length(&other, i, j) - l).abs() < 1e-10);
    }
    other
}

/// Solutions on the path, and degenerate ones among them: what a tracker of another make and other coordinates, with
/// steps over t = 1, counts too.
const SOLUTIONS: (usize, usize) = (28, 4);
/// The same of the shipped one: what the float and the certified tracker count alike.
const SHIPPED: (usize, usize) = (8, 2);

/// The path closes, through its flat figures, in floats and with proof.
#[test]
fn the_hexahedron_closes_through_flat_figures() {
    closes(&hexahedron(), SOLUTIONS);
}

/// The shipped one has 7 solutions up to reflection, as the paper's first path, and an even number of flat ones, as every
/// closed path that meets flat figures at t = 1 alone (docs/how/tubes.md).
#[test]
fn the_shipped_hexahedron_has_seven_solutions_up_to_reflection() {
    let problem = shipped();
    closes(&problem, SHIPPED);
    for options in [
        Options::certified(),
        Options::certified().reversed(),
        Options::float(Space::Full),
        Options::float(Space::Full).reversed(),
    ] {
        let outcome = solve(&problem, &options);
        assert_eq!(outcome.status, Status::Closed, "{options:?}");
        assert_eq!(check(&problem, &outcome), SHIPPED, "{options:?}");
        let classes = |flat: bool| -> BTreeSet<usize> {
            let solutions = outcome.solutions.iter();
            let wanted = solutions.filter(|s| s.is_degenerate == flat);
            wanted.map(|s| s.class).collect()
        };
        assert_eq!((classes(false).len(), classes(true).len()), (5, 2));
    }
}

/// A problem's path closes in both modes, with so many solutions and flat ones among them, which are the same in both.
fn closes(problem: &Problem, counts: (usize, usize)) {
    let [certified, float] = [Options::certified(), Options::float(Space::Full)].map(|options| {
        let outcome = solve(problem, &options);
        assert_eq!(outcome.status, Status::Closed, "{:?}", outcome.mode);
        assert_eq!(check(problem, &outcome), counts, "{:?}", outcome.mode);
        outcome
    });
    for (proved, seen) in certified.solutions.iter().zip(&float.solutions) {
        assert_eq!(proved.is_degenerate, seen.is_degenerate);
        for (proved, seen) in proved.points.iter().zip(&seen.points) {
            for (proved, seen) in proved.iter().zip(seen) {
                assert!((proved.mid() - seen.mid()).abs() < 1e-7);
                assert!(proved.wid() < 1e-6);
            }
        }
    }
    let says = |outcome: &Outcome, what: &str| outcome.switched_on.iter().any(|s| s.contains(what));
    assert!(says(&certified, "heights divided by 1 − t"));
}

/// Both ways round it is the same path.
#[test]
fn the_other_way_round_meets_the_same() {
    for options in [Options::certified(), Options::float(Space::Full)] {
        let there = solve(&hexahedron(), &options);
        let back = solve(&hexahedron(), &options.clone().reversed());
        assert_eq!(back.status, Status::Closed);
        assert_eq!(there.solutions.len(), back.solutions.len());
        for (one, other) in there.solutions.iter().zip(back.solutions.iter().rev()) {
            assert_eq!(one.is_degenerate, other.is_degenerate);
            let mut pairs = one
                .points
                .iter()
                .flatten()
                .zip(other.points.iter().flatten());
            assert!(pairs.all(|(a, b)| (a.mid() - b.mid()).abs() < 1e-7));
            if options.mode == Mode::Certified {
                let mut pairs = one
                    .points
                    .iter()
                    .flatten()
                    .zip(other.points.iter().flatten());
                assert!(pairs.all(|(a, b)| !a.disjoint(*b)));
            }
        }
    }
}

/// Where flat figures are no continua nothing is divided, and flat solutions are solutions like others.
#[test]
fn flat_figures_of_other_problems_are_not_degenerate() {
    let problem = Problem::read("problems/constraints/pentahedron.toml").unwrap();
    for options in [Options::certified(), Options::float(Space::Full)] {
        let outcome = solve(&problem, &options);
        assert!(outcome.solutions.iter().any(|s| is_flat(&middle(s))));
        assert!(outcome.solutions.iter().all(|s| !s.is_degenerate));
        let mut switched_on = outcome.switched_on.iter();
        assert!(switched_on.all(|what| !what.contains("heights divided")));
    }
}

type Certified = (Outcome, Certificate, Verdict);

/// A run with the certificate that it leaves, taken apart, and what is verified of that.
fn certified(options: &Options) -> Certified {
    let (outcome, bytes) = certificate::of(&hexahedron(), options);
    let verdict = verify(&bytes[..], &Settings::default(), &mut |_| ()).unwrap();
    (outcome, Certificate::read(&bytes), verdict)
}

/// The same for the default, made once for all tests; or with `reversed` in the other direction.
fn by_default(reversed: bool) -> &'static Certified {
    static MADE: [OnceLock<Certified>; 2] = [const { OnceLock::new() }; 2];
    MADE[usize::from(reversed)].get_or_init(|| match reversed {
        true => certified(&Options::certified().reversed()),
        false => certified(&Options::certified()),
    })
}

/// The whole closed path, in either direction and in either space.
#[test]
fn a_certificate_holds_the_whole_closed_path() {
    let reduced = Options {
        space: Space::Reduced,
        ..Options::certified()
    };
    let in_reduced = certified(&reduced);
    for (options, (outcome, certificate, verdict)) in [
        (Options::certified(), by_default(false)),
        (Options::certified().reversed(), by_default(true)),
        (reduced, &in_reduced),
    ] {
        assert_eq!(outcome.status, Status::Closed);
        assert_eq!(outcome.space, options.space);
        assert_eq!(verdict.outcome, Verdicts::Verified, "{options:?}");
        assert!(verdict.is_about(&hexahedron()));
        assert_eq!(verdict.solutions.len(), SOLUTIONS.0);
        let pieces = certificate.records.iter();
        let pieces = pieces.filter(|record| matches!(record, Record::Divide));
        assert_eq!(pieces.count(), SOLUTIONS.1);
        let classes: BTreeSet<u32> = verdict.classes.iter().copied().collect();
        assert_eq!(classes.len(), 22);
        for (k, ours) in verdict.solutions.iter().enumerate() {
            let run = &outcome.solutions[k];
            assert_eq!(verdict.degenerate[k], run.is_degenerate);
            if run.is_degenerate {
                assert!(ours.iter().all(|p| p[2].mag() == 0.0));
            }
            for (a, b) in ours.iter().flatten().zip(run.points.iter().flatten()) {
                assert!(b.subset(*a) && a.wid() <= 1e-6, "{a:?} {b:?}");
            }
        }
        let words = theorem(verdict, Duration::ZERO);
        let what = "28 points with t = 1, 4 of them degenerate (flat) figures";
        assert!(words.contains(what), "{words}");
        assert!(words.contains("S is a closed curve"), "{words}");
    }
}

/// What a certificate holds up to so many pieces in divided equations and two tubes behind, as one of a run that stopped.
fn cut(whole: &Certificate, pieces: usize) -> Certificate {
    let mut cut = whole.clone();
    let returns = whole.records.iter().enumerate();
    let mut returns = returns.filter(|(_, record)| matches!(record, Record::Return));
    let (at, _) = returns.nth(pieces - 1).unwrap();
    let tubes = whole.records.iter().enumerate().skip(at);
    let mut tubes = tubes.filter(|(_, record)| matches!(record, Record::Tube(_)));
    let (end, _) = tubes.nth(2).unwrap();
    cut.records.truncate(end);
    finish(&mut cut, Ending::Stopped("cut".to_owned()), whole);
    cut
}

fn classes(certificate: &Certificate) -> &[u32] {
    match certificate.records.last() {
        Some(Record::End(end)) => &end.classes,
        _ => unreachable!(),
    }
}

fn boxes(certificate: &Certificate) -> Vec<&SolutionClaim> {
    let records = certificate.records.iter();
    let boxes = records.filter_map(|record| match record {
        Record::Solution(solution) => Some(solution),
        _ => None,
    });
    boxes.collect()
}

/// Ends a certificate that has no end, with the classes that another one has for its solutions.
fn finish(certificate: &mut Certificate, ending: Ending, whole: &Certificate) {
    let known = boxes(whole);
    let class = |solution: &&SolutionClaim| {
        let near = known.iter().position(|other| {
            let pairs = solution.centre.iter().zip(&other.centre);
            // Coordinates of points come first in all of them.
            pairs.take(18).all(|(a, b)| (a - b).abs() < 1e-6)
        });
        classes(whole)[near.unwrap()]
    };
    let all: Vec<u32> = boxes(certificate).iter().map(class).collect();
    let mut names: Vec<u32> = Vec::new();
    let mut numbers = Vec::new();
    for class in all {
        let known = names.iter().position(|&other| other == class);
        numbers.push(known.unwrap_or(names.len()) as u32);
        if known.is_none() {
            names.push(class);
        }
    }
    certificate.records.push(Record::End(EndClaim {
        ending,
        tubes: certificate.tubes() as u64,
        classes: numbers,
    }));
}

fn checked(certificate: &Certificate) -> Result<Verdicts, FormatError> {
    let bytes = certificate.bytes();
    verify(&bytes[..], &Settings::default(), &mut |_| ()).map(|verdict| verdict.outcome)
}

/// A run that stops behind a flat figure leaves what it has.
#[test]
fn a_run_that_stops_behind_a_flat_figure_is_incomplete() {
    let (_, whole, _) = by_default(false);
    let short = cut(whole, 1);
    let stopped = || Verdicts::Partial("cut".to_owned());
    assert_eq!(checked(&short).unwrap(), stopped());
    let options = Options {
        max_steps: short.tubes(),
        ..Options::certified()
    };
    let (outcome, certificate, verdict) = certified(&options);
    assert!(matches!(outcome.status, Status::Stopped(_)));
    assert!(matches!(verdict.outcome, Verdicts::Partial(_)));
    assert_eq!(verdict.degenerate.iter().filter(|&&is| is).count(), 1);
    assert_eq!(verdict.solutions.len(), outcome.solutions.len());
    assert!(certificate.records.contains(&Record::Return));
    // In the middle of such a piece, too, and before its first tube.
    let mut middle = whole.clone();
    let at = of_kind(&middle, |record| *record == Record::Divide)[0];
    for behind in [at, at + 1] {
        middle.records.truncate(behind + 1);
        finish(&mut middle, Ending::Stopped("cut".to_owned()), whole);
        assert_eq!(checked(&middle).unwrap(), stopped());
        middle = whole.clone();
    }
}

/// Both ways from the sketch, past a flat figure each: an open path, as far as a certificate goes.
#[test]
fn open_paths_pass_flat_figures() {
    let (_, whole, _) = by_default(false);
    let (_, back, _) = by_default(true);
    let mut open = cut(whole, 1);
    open.records.pop();
    open.records.push(Record::Turn);
    let mut other = cut(back, 1);
    other.records.pop();
    open.records.extend(other.records);
    let ends = ["one".to_owned(), "other".to_owned()];
    finish(&mut open, Ending::Open(ends), whole);
    let verdict = verify(&open.bytes()[..], &Settings::default(), &mut |_| ()).unwrap();
    assert_eq!(verdict.outcome, Verdicts::Verified);
    assert!(verdict.is_open);
    assert_eq!(verdict.degenerate.iter().filter(|&&is| is).count(), 2);
    // No part of it ends in the divided equations.
    for at in of_kind(&open, |record| *record == Record::Return) {
        let mut within = open.clone();
        within.records.remove(at);
        let next =
            (at..).find(|&k| !matches!(within.records[k], Record::Tube(_) | Record::Solution(_)));
        within.records.drain(at..next.unwrap());
        within.recount();
        let kept = boxes(&within).len();
        within.classes_mut().truncate(kept);
        let error = checked(&within).unwrap_err().to_string();
        assert!(
            error.contains("may not stand here") || error.contains("it cannot end so"),
            "{error}"
        );
    }
}

fn of_kind(certificate: &Certificate, is: impl Fn(&Record) -> bool) -> Vec<usize> {
    let records = certificate.records.iter().enumerate();
    let places = records.filter(|(_, record)| is(record)).map(|(at, _)| at);
    places.collect()
}

fn is_tube(record: &Record) -> bool {
    matches!(record, Record::Tube(_))
}

fn is_solution(record: &Record) -> bool {
    matches!(record, Record::Solution(_))
}

/// The first and last record of the first piece in the divided equations.
fn piece(certificate: &Certificate) -> (usize, usize) {
    let first = of_kind(certificate, |record| *record == Record::Divide)[0];
    let last = of_kind(certificate, |record| *record == Record::Return)[0];
    (first, last)
}

fn without(certificate: &Certificate, records: std::ops::RangeInclusive<usize>) -> Certificate {
    let mut rest = certificate.clone();
    let gone: Vec<Record> = rest.records.drain(records).collect();
    rest.recount();
    let solutions = gone.iter().filter(|record| is_solution(record)).count();
    let kept = rest.classes_mut().len() - solutions;
    rest.classes_mut().truncate(kept);
    rest
}

fn reversed(record: &Record) -> Record {
    let mut record = record.clone();
    if let Record::Tube(tube) = &mut record {
        tube.normal.iter_mut().for_each(|c| *c *= -1.0);
    }
    record
}

/// What is wrong in the records of other equations is refused.
#[test]
fn false_pieces_are_refused() {
    let (_, whole, _) = by_default(false);
    let good = cut(whole, 2);
    assert_eq!(checked(&good).unwrap(), Verdicts::Partial("cut".to_owned()));
    let refused = |what: &str, certificate: &Certificate| match checked(certificate) {
        Ok(outcome @ (Verdicts::Verified | Verdicts::Partial(_))) => panic!("{what}: {outcome:?}"),
        Ok(outcome) => outcome,
        Err(_) => Verdicts::Verified,
    };
    let (first, last) = piece(&good);
    let tubes: Vec<usize> = (first..last)
        .filter(|&k| is_tube(&good.records[k]))
        .collect();
    assert!(tubes.len() > 1);

    // A record of change left out, moved past a tube, or twice: tubes of the wrong size.
    for at in [first, last] {
        refused("change left out", &without(&good, at..=at));
        let mut twice = good.clone();
        twice.records.insert(at, twice.records[at].clone());
        refused("change twice", &twice);
        for with in [at - 1, at + 1] {
            let mut moved = good.clone();
            moved.records.swap(at, with);
            refused("change moved", &moved);
        }
    }
    // The whole piece left out, its tubes, or one tube at an end of it or beside it where that leaves a gap.
    let gap = refused("piece left out", &without(&good, first..=last));
    assert!(
        matches!(
            gap,
            Verdicts::Refuted(Flaw::Link(_) | Flaw::Unlisted(..) | Flaw::Backwards(_))
        ),
        "{gap:?}"
    );
    refused("tubes left out", &without(&good, first + 1..=last - 1));
    refused(
        "first half left out",
        &without(&good, first + 1..=tubes[tubes.len() / 2]),
    );
    refused(
        "last half left out",
        &without(&good, tubes[tubes.len() / 2]..=last - 1),
    );
    for at in [first - 1, last + 1] {
        let tube = |certificate: &Certificate| match &certificate.records[at] {
            Record::Tube(tube) => tube.clone(),
            other => panic!("{other:?}"),
        };
        // As if the path had been left, or were come to, farther away.
        let mut short = good.clone();
        if let Record::Tube(tube) = &mut short.records[at] {
            tube.exit = -0.9 * tube.h;
        }
        refused("exit elsewhere", &short);
        let mut away = good.clone();
        if let Record::Tube(tube) = &mut away.records[at] {
            tube.centre[0] += 1e3 * f64::from(tube.r);
        }
        assert_ne!(tube(&away), tube(&good));
        refused("tube elsewhere", &away);
    }
    // The piece of the other crossing in this one's place.
    let divides = of_kind(&good, |record| *record == Record::Divide);
    let returns = of_kind(&good, |record| *record == Record::Return);
    let mut swapped = good.clone();
    let other = good.records[divides[1]..=returns[1]].to_vec();
    swapped
        .records
        .splice(divides[1]..=returns[1], good.records[first..=last].to_vec());
    swapped.records.splice(first..=last, other);
    swapped.recount();
    let found = refused("pieces swapped", &swapped);
    assert!(
        matches!(found, Verdicts::Refuted(Flaw::Link(_))),
        "{found:?}"
    );

    // The other way through the piece; and from its middle back to where it began.
    let mut back = good.clone();
    back.records[first + 1..last].reverse();
    back.records[first + 1..last]
        .iter_mut()
        .for_each(|record| *record = reversed(record));
    refused("piece backwards", &back);
    let mut negative = good.clone();
    negative.records[first + 1..]
        .iter_mut()
        .for_each(|record| *record = reversed(record));
    let found = refused("direction of all that follows", &negative);
    let number = good.records[..first]
        .iter()
        .filter(|record| is_tube(record))
        .count() as u64
        + 1;
    assert_eq!(found, Verdicts::Refuted(Flaw::Direction(number)));
    let mut behind = good.clone();
    behind.records[last + 1..]
        .iter_mut()
        .for_each(|record| *record = reversed(record));
    let found = refused("direction behind the piece", &behind);
    assert!(
        matches!(found, Verdicts::Refuted(Flaw::Direction(_))),
        "{found:?}"
    );
    let mut round = whole.clone();
    round.records.truncate(tubes[0] + 1);
    let only = |k: &usize| !is_solution(&round.records[*k]);
    let there: Vec<usize> = (0..first).filter(only).collect();
    let mut way: Vec<Record> = vec![reversed(&round.records[tubes[0]]), Record::Return];
    way.extend(there.iter().rev().map(|&k| reversed(&round.records[k])));
    round.records.extend(way);
    finish(&mut round, Ending::Complete, whole);
    let found = refused("turned round in the piece", &round);
    let turn = number + 1;
    assert!(
        matches!(found, Verdicts::Refuted(Flaw::Direction(k)) if k == turn),
        "{found:?}"
    );

    // The degenerate solution.
    let at = (first..last)
        .find(|&k| is_solution(&good.records[k]))
        .unwrap();
    let Record::Solution(flat) = &good.records[at] else {
        unreachable!()
    };
    let found = refused("left out", &without(&good, at..=at));
    assert!(
        matches!(found, Verdicts::Refuted(Flaw::Unlisted(..))),
        "{found:?}"
    );
    let number = good.records[..at]
        .iter()
        .filter(|record| is_solution(record))
        .count();
    let added = |at: usize, solution: &SolutionClaim| {
        let mut more = good.clone();
        more.records.insert(at, Record::Solution(solution.clone()));
        let new = boxes(&more).len() as u32;
        more.classes_mut().push(new);
        more
    };
    refused("twice", &added(at, flat));
    // The other one, proved here, is not met so far, but is later: its class alone is in the way, and it is there twice.
    let later = (divides[1]..returns[1])
        .find(|&k| is_solution(&good.records[k]))
        .unwrap();
    let Record::Solution(later) = &good.records[later] else {
        unreachable!()
    };
    refused("one of another crossing", &added(at, later));
    // In the given unknowns, behind a tube of the given equations: it is not alone.
    let heights = Homotopy::new(&hexahedron())
        .unwrap()
        .over_heights()
        .unwrap();
    let mut given = flat.clone();
    given.centre = heights.flat_figure(&flat.centre);
    for radius in [flat.radius, 1e-9, 1e-6] {
        given.radius = radius;
        for before in [first, last + 2] {
            let mut as_others = without(&good, at..=at);
            let before = if before > at { before - 1 } else { before };
            as_others
                .records
                .insert(before, Record::Solution(given.clone()));
            let next = as_others.classes_mut().len() as u32;
            as_others.classes_mut().push(next);
            refused("as one that is alone", &as_others);
        }
    }
    // Numbers: the box of any unknown moved.
    for k in 0..flat.centre.len() {
        let mut moved = good.clone();
        if let Record::Solution(solution) = &mut moved.records[at] {
            solution.centre[k] += 30.0 * f64::from(solution.radius);
        }
        let found = refused("box moved", &moved);
        assert!(
            matches!(found, Verdicts::Refuted(Flaw::Solution(n, _)) | Verdicts::NotProved(Flaw::Solution(n, _)) if n == number + 1),
            "{k}: {found:?}"
        );
    }
    // The centre of a tube in there, any unknown of it.
    for k in 0..flat.centre.len() {
        let mut moved = good.clone();
        if let Record::Tube(tube) = &mut moved.records[tubes[1]] {
            tube.centre[k] += 1e4 * f64::from(tube.r);
        }
        refused("tube moved", &moved);
    }
}

/// Where a problem has no divided equations their records make a file no certificate.
#[test]
fn problems_without_divided_equations_have_no_such_records() {
    for name in ["prism", "k33"] {
        let mut none = Certificate::read(&certificate::shipped(name));
        let at = none.tube_at(3);
        none.records.insert(at, Record::Divide);
        let error = checked(&none).unwrap_err().to_string();
        assert!(
            error.contains("no equations with heights divided"),
            "{error}"
        );
    }
    // Nor do edits have any.
    let mut edit = Certificate::read(&certificate::shipped("plate-reached"));
    let at = edit.tube_at(1);
    edit.records.insert(at, Record::Divide);
    let error = checked(&edit).unwrap_err().to_string();
    assert!(error.contains("may not stand here"), "{error}");
}

/// Points and directions carried over and back are the same again; and directions go with differences of points.
#[test]
fn directions_are_carried_over_as_points_are() {
    let homotopy = Homotopy::new(&hexahedron()).unwrap();
    let heights = homotopy.over_heights().unwrap();
    let (n, step) = (homotopy.equations + 1, 1e-5);
    let z: Vec<f64> = (0..n).map(|i| 1.0 + (7.0 * i as f64).sin()).collect();
    let v: Vec<f64> = (0..n).map(|i| (3.0 + 5.0 * i as f64).cos()).collect();
    let boxed = |x: &[f64]| x.iter().map(|&x| point(x)).collect::<Vec<Interval>>();
    let at = |z: &[f64], v: &[f64], s: f64| -> Vec<f64> {
        z.iter().zip(v).map(|(z, v)| z + s * v).collect()
    };
    let (there, along) = (
        heights.divide(&boxed(&z)).unwrap(),
        heights.divide_along(&boxed(&z), &boxed(&v)).unwrap(),
    );
    assert_eq!(there.len(), heights.homotopy.equations + 1);
    let [ahead, back] = [step, -step].map(|s| heights.divide(&boxed(&at(&z, &v, s))).unwrap());
    for (i, x) in along.iter().enumerate() {
        let slope = (ahead[i].mid() - back[i].mid()) / (2.0 * step);
        assert!((x.mid() - slope).abs() < 1e-6 * (1.0 + slope.abs()), "{i}");
    }
    let (here, again) = (
        heights.multiply(&there),
        heights.multiply_along(&there, &along),
    );
    for i in 0..n {
        assert!(here[i].contains(z[i]) && here[i].wid() < 1e-12);
        assert!(again[i].contains(v[i]) && again[i].wid() < 1e-12);
    }
    let middles = |x: &[Interval]| x.iter().map(|x| x.mid()).collect::<Vec<f64>>();
    let (there, along) = (middles(&there), middles(&along));
    let [ahead, back] = [step, -step].map(|s| heights.multiply(&boxed(&at(&there, &along, s))));
    for i in 0..n {
        let slope = (ahead[i].mid() - back[i].mid()) / (2.0 * step);
        assert!((v[i] - slope).abs() < 1e-6 * (1.0 + slope.abs()), "{i}");
    }
    // Where t may be 1 there is no way over.
    let mut at_one = boxed(&z);
    at_one[n - 1] = hull(0.9, 1.1);
    assert!(
        heights.divide(&at_one).is_none() && heights.divide_along(&at_one, &boxed(&v)).is_none()
    );
}
