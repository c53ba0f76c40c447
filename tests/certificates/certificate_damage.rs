//! One thing at a time is changed in good certificates: every false claim must be refused, every
//! harmless change accepted.

use crate::common::certificate::{Certificate, shipped};
use crate::common::hard::families;
use crate::common::mixed::Spec;
use dice::Dice;
use krawl::certificate::{Outcome, Record, Settings, TubeClaim, Verdict, verify};
use krawl::problem::Problem;
use krawl::track::{Options, Status};
use proptest::test_runner::{RngAlgorithm, TestRng};
use std::collections::{BTreeMap, BTreeSet};

/// Random choices from the generator that comes with proptest.
mod dice {
    use proptest::prelude::Rng;
    use proptest::test_runner::TestRng;

    pub struct Dice(pub TestRng);

    impl Dice {
        /// From 0 to below `n`.
        pub fn below(&mut self, n: usize) -> usize {
            (self.0.next_u64() % n as u64) as usize
        }

        /// Between two numbers.
        pub fn between(&mut self, a: f64, b: f64) -> f64 {
            a + (b - a) * (self.0.next_u64() as f64 / u64::MAX as f64)
        }

        /// Between two numbers, their logarithms equally likely.
        pub fn about(&mut self, a: f64, b: f64) -> f64 {
            self.between(a.ln(), b.ln()).exp()
        }
    }
}

type Damage = fn(&mut Certificate, &mut Dice);

/// False claims.
const FALSE: &[(&str, Damage)] = &[
    ("tube's centre off the path", |c, dice| {
        let k = dice.below(c.tubes());
        let factor = dice.about(3.0, 300.0);
        let tube = c.tube_mut(k);
        let off = sideways(tube, factor, dice);
        tube.centre
            .iter_mut()
            .zip(off)
            .for_each(|(x, off)| *x += off);
    }),
    ("tube's radius too large", |c, dice| {
        let k = dice.below(c.tubes());
        c.tube_mut(k).r *= dice.about(100.0, 1e6) as f32;
    }),
    ("tube too long", |c, dice| {
        let k = dice.below(c.tubes());
        c.tube_mut(k).h *= dice.about(3.0, 100.0);
    }),
    ("normal in a random direction", |c, dice| {
        let k = dice.below(c.tubes());
        let tube = c.tube_mut(k);
        let random: Vec<f64> = tube
            .normal
            .iter()
            .map(|_| dice.between(-1.0, 1.0))
            .collect();
        tube.normal
            .iter_mut()
            .zip(random)
            .for_each(|(c, x)| *c = x as f32);
    }),
    ("link removed", |c, dice| {
        // Where the next tube reaches back over a short one, the chain holds without it.
        let gone = loop {
            let k = 1 + dice.below(c.tubes() - 2);
            if leaves_a_gap(c, k) {
                break k;
            }
        };
        c.keep_tubes(|k| k != gone);
    }),
    ("two tubes swapped", |c, dice| {
        let (a, b) = (dice.below(c.tubes()), dice.below(c.tubes() - 1));
        let (a, b) = (c.tube_at(a), c.tube_at(if b < a { b } else { b + 1 }));
        c.records.swap(a, b);
    }),
    ("exit on the wrong side", |c, dice| {
        // The last one's exit does not count: there the sketch is the end.
        let k = dice.below(c.tubes() - 1);
        c.tube_mut(k).exit *= -1.0;
    }),
    ("solution dropped", |c, dice| {
        let k = dice.below(c.solutions());
        let at = c.solution_at(k);
        c.records.remove(at);
        // The classes of all shipped solutions are different.
        c.classes_mut().pop();
    }),
    ("solution listed twice", |c, dice| {
        let k = dice.below(c.solutions());
        let at = c.solution_at(k);
        let again = c.records[at].clone();
        c.records.insert(at, again);
        let next = c.classes_mut().len() as u32;
        c.classes_mut().push(next);
    }),
    ("solution added", |c, dice| {
        let k = dice.below(c.solutions());
        let at = c.solution_at(k);
        let mut other = c.records[at].clone();
        if let Record::Solution(solution) = &mut other {
            let shift = dice.about(1e-3, 1.0);
            solution
                .centre
                .iter_mut()
                .for_each(|x| *x += dice.between(-shift, shift));
        }
        c.records.insert(at + 1, other);
        let next = c.classes_mut().len() as u32;
        c.classes_mut().push(next);
    }),
    ("mirror image of a solution added", |c, dice| {
        let k = dice.below(c.solutions());
        let at = c.solution_at(k);
        let mut other = c.records[at].clone();
        if let Record::Solution(solution) = &mut other {
            c.mirrored_unknowns()
                .into_iter()
                .for_each(|i| solution.centre[i] *= -1.0);
        }
        c.records.insert(at + 1, other);
        // It is a solution, and of this class; only the path does not meet it.
        c.classes_mut().insert(k + 1, k as u32);
    }),
    ("solution moved", |c, dice| {
        let k = dice.below(c.solutions());
        let factor = dice.about(5.0, 1e6);
        let solution = c.solution_mut(k);
        let i = dice.below(solution.centre.len());
        solution.centre[i] += factor * f64::from(solution.radius);
    }),
    ("solution replaced by another", |c, dice| {
        let (a, b) = (dice.below(c.solutions()), dice.below(c.solutions() - 1));
        let (a, b) = (
            c.solution_at(a),
            c.solution_at(if b < a { b } else { b + 1 }),
        );
        c.records[a] = c.records[b].clone();
    }),
    ("box too narrow for its solution", |c, dice| {
        let k = dice.below(c.solutions());
        let factor = dice.about(1e-9, 1e-3) as f32;
        c.solution_mut(k).radius *= factor;
    }),
    ("box widened over its neighbour", |c, dice| {
        let count = c.solutions();
        let (a, b) = (dice.below(count), dice.below(count - 1));
        let b = if b < a { b } else { b + 1 };
        let other = c.solution_mut(b).centre.clone();
        let solution = c.solution_mut(a);
        let pairs = other.iter().zip(&solution.centre);
        let distance = pairs.fold(0.0, |max: f64, (x, y)| max.max((x - y).abs()));
        solution.radius = 1.01 * distance as f32;
    }),
    ("last digit of a number of the problem", |c, dice| {
        // Of a length, a coordinate of the sketch, or the bend's coefficient.
        let numbers = c.problem.find("[points]").unwrap();
        let digits: Vec<usize> = (numbers..c.problem.len() - 1)
            .filter(|&i| {
                let byte = |i: usize| c.problem.as_bytes()[i];
                byte(i).is_ascii_digit() && matches!(byte(i + 1), b',' | b']' | b'\n')
            })
            .collect();
        let at = digits[dice.below(digits.len())];
        let digit = (c.problem.as_bytes()[at] - b'0' + 1 + dice.below(9) as u8) % 10;
        let digit = digit.to_string();
        c.problem.replace_range(at..=at, &digit);
    }),
    ("unit changed", |c, dice| {
        c.unit_exponent += [-2, -1, 1, 2][dice.below(4)];
    }),
    ("loop cut short", |c, dice| {
        let last = c.tubes() - 1 - dice.below(c.tubes() / 2);
        c.keep_tubes(|k| k < last);
    }),
    ("start left out", |c, dice| {
        let first = 1 + dice.below(c.tubes() / 2);
        c.keep_tubes(|k| k >= first);
    }),
    ("direction reversed half-way", |c, dice| {
        let (from, count) = (1 + dice.below(c.tubes() - 1), c.tubes());
        for k in from..count {
            let tube = c.tube_mut(k);
            tube.normal.iter_mut().for_each(|c| *c *= -1.0);
        }
    }),
    ("turned round and back to the sketch", |c, dice| {
        // All of these tubes are true, and the last one holds the sketch.
        let turn = 1 + dice.below(c.tubes() - 2);
        let end = c.records.pop().unwrap();
        let back: Vec<Record> = (0..=turn)
            .rev()
            .map(|k| {
                let mut tube = c.tube_mut(k).clone();
                tube.normal.iter_mut().for_each(|c| *c *= -1.0);
                Record::Tube(tube)
            })
            .collect();
        c.keep_tubes(|k| k <= turn);
        c.records.extend(back);
        c.records.push(end);
        c.recount();
    }),
    ("class changed", |c, dice| {
        let k = dice.below(c.solutions());
        let other = dice.below(c.solutions()) as u32;
        let class = &mut c.classes_mut()[k];
        *class = if other == *class { other + 1 } else { other };
    }),
];

/// A random way off a tube's centre, so many radii long: not along the path, where the tube would stay where it is.
fn sideways(tube: &TubeClaim, radii: f64, dice: &mut Dice) -> Vec<f64> {
    let n = tube.centre.len();
    let mut off: Vec<f64> = (0..n).map(|_| dice.between(-1.0, 1.0)).collect();
    let normal: Vec<f64> = tube.normal.iter().map(|&c| c.into()).collect();
    let along: f64 = off.iter().zip(&normal).map(|(x, c)| x * c).sum();
    off.iter_mut()
        .zip(&normal)
        .for_each(|(x, c)| *x -= along * c);
    let weight = |i: usize| f64::from(tube.weights[i]) / 65536.0;
    let size = (0..n).fold(0.0, |max: f64, i| max.max(off[i].abs() / weight(i)));
    let factor = radii * f64::from(tube.r) / size;
    off.into_iter().map(|x| factor * x).collect()
}

/// Changes after which all claims are still true, and proved.
const HARMLESS: &[(&str, Damage)] = &[
    ("tube split in two", |c, dice| {
        let k = dice.below(c.tubes() - 1);
        let at = c.tube_at(k);
        let second = c.records[at].clone();
        // The second has the same middle, and is entered where the first is left.
        let part = dice.between(0.3, 0.9);
        c.tube_mut(k).exit *= part;
        let next = (at + 1..c.records.len())
            .find(|&i| !matches!(c.records[i], Record::Solution(_)))
            .unwrap();
        c.records.insert(next, second);
        c.recount();
    }),
    ("slightly shorter tube", |c, dice| {
        let k = dice.below(c.tubes());
        c.tube_mut(k).h *= dice.between(0.98, 1.0);
    }),
    ("slightly smaller radius", |c, dice| {
        let k = dice.below(c.tubes());
        c.tube_mut(k).r *= dice.between(0.9, 1.0) as f32;
    }),
    ("slightly different centre", |c, dice| {
        let k = dice.below(c.tubes());
        let tube = c.tube_mut(k);
        let i = dice.below(tube.centre.len());
        tube.centre[i] += 1e-4 * f64::from(tube.r) * dice.between(-1.0, 1.0);
    }),
    ("slightly different normal", |c, dice| {
        let k = dice.below(c.tubes());
        let tube = c.tube_mut(k);
        tube.normal
            .iter_mut()
            .for_each(|c| *c += dice.between(-1e-6, 1e-6) as f32);
    }),
    ("exit slightly earlier", |c, dice| {
        let k = dice.below(c.tubes());
        c.tube_mut(k).exit *= dice.between(0.99, 1.0);
    }),
    ("box slightly wider", |c, dice| {
        let k = dice.below(c.solutions());
        c.solution_mut(k).radius *= dice.between(1.0, 10.0) as f32;
    }),
    ("another title", |c, dice| {
        let line = c.problem.find('\n').unwrap();
        c.problem
            .replace_range(..line, &format!("name = \"{}\"", dice.below(1000)));
    }),
    ("another program", |c, dice| {
        c.program = format!("krawl {}", dice.below(1000))
    }),
];

/// Whether the tubes around the k-th are too far from each other to meet.
fn leaves_a_gap(c: &Certificate, k: usize) -> bool {
    let [before, tube, after] = [k - 1, k, k + 1].map(|k| c.clone().tube_mut(k).clone());
    let along = |other: &TubeClaim| -> f64 {
        let pairs = other.centre.iter().zip(&tube.centre);
        let away = pairs.map(|(a, b)| a - b);
        away.zip(&tube.normal).map(|(x, &c)| x * f64::from(c)).sum()
    };
    along(&before) + before.exit < along(&after) - 1.02 * after.h
}

fn outcome(bytes: &[u8]) -> Option<Outcome> {
    let settings = Settings { threads: 1 };
    verify(bytes, &settings, &mut |_| ())
        .ok()
        .map(|verdict| verdict.outcome)
}

/// Damages a certificate in each way so many times. Returns how many of which kind.
fn damage(name: &str, times: usize, kinds: &[(&'static str, Damage)], harmless: bool) {
    let good = Certificate::read(&shipped(name));
    let (refuted, total) = damage_in(name, &good, times, kinds, harmless);
    // Of a few kinds it cannot be told: tubes that are too long or too wide for the test may be true.
    assert!(harmless || 3 * refuted > 2 * total, "{refuted} of {total}");
    assert!(total + kinds.len() >= times * kinds.len() * 9 / 10);
}

/// The same for any certificate. Returns how many changes were proved false, of how many.
fn damage_in(
    name: &str,
    good: &Certificate,
    times: usize,
    kinds: &[(&'static str, Damage)],
    harmless: bool,
) -> (usize, usize) {
    let mut counts = BTreeMap::new();
    let mut refuted = 0;
    let mut dice = Dice(TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    for &(kind, change) in kinds {
        for round in 0..times {
            let mut changed = good.clone();
            change(&mut changed, &mut dice);
            if changed.problem == good.problem
                && changed.program == good.program
                && changed.bytes() == good.bytes()
            {
                continue;
            }
            let outcome = outcome(&changed.bytes());
            let accepted = outcome == Some(Outcome::Verified);
            refuted += usize::from(matches!(outcome, Some(Outcome::Refuted(_)) | None));
            assert_eq!(
                accepted, harmless,
                "{name}, {kind}, round {round}: {outcome:?}"
            );
            *counts.entry(kind).or_insert(0) += 1;
        }
    }
    let total: usize = counts.values().sum();
    let verb = if harmless { "accepted" } else { "refused" };
    println!("{name}: {total} changes {verb}, {refuted} of them proved false: {counts:?}");
    (refuted, total)
}

// 22 kinds: more than 1,000 false claims in all.

#[test]
fn damaged_octahedron_is_refused() {
    damage("octahedron", 12, FALSE, false);
}

#[test]
fn damaged_dodecagon_is_refused() {
    damage("dodecagon", 16, FALSE, false);
}

#[test]
fn damaged_k33_is_refused() {
    damage("k33", 10, FALSE, false);
}

#[test]
fn damaged_prism_is_refused() {
    damage("prism", 10, FALSE, false);
}

#[test]
fn damaged_disulfide_is_refused() {
    damage("disulfide", 4, FALSE, false);
}

#[test]
fn damaged_icosahedron_is_refused() {
    damage("icosahedron-c1", 2, FALSE, false);
}

/// Constraints of all kinds, with their auxiliary unknowns.
#[test]
fn damaged_certificates_of_mixed_kinds_are_refused() {
    let mut dice = Dice(TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let kinds: Vec<(&str, Damage)> = FALSE
        .iter()
        .copied()
        // Another place of the sketch's line on the same line says nothing else.
        .filter(|(kind, _)| *kind != "last digit of a number of the problem")
        .collect();
    let (mut tried, mut sum) = (0, (0, 0));
    while tried < 8 {
        let dimension = 2 + tried % 2;
        let Some((_, problem)) = Spec::random(dimension, &mut |n| dice.below(n)) else {
            continue;
        };
        let options = Options {
            max_steps: 150,
            ..Options::certified()
        };
        let (run, bytes) = crate::common::certificate::of(&problem, &options);
        let classes: BTreeSet<usize> = run.solutions.iter().map(|s| s.class).collect();
        let is_fit = run.status == Status::Closed
            && run.solutions.len() >= 2
            && classes.len() == run.solutions.len()
            && run.steps > 6
            && outcome(&bytes) == Some(Outcome::Verified);
        if is_fit && !problem.constraints.is_empty() {
            tried += 1;
            let name = format!("mixed {tried}:\n{}", problem.to_toml());
            let (refuted, of) = damage_in(&name, &Certificate::read(&bytes), 2, &kinds, false);
            sum = (sum.0 + refuted, sum.1 + of);
        }
    }
    assert!(2 * sum.0 > sum.1, "{sum:?}");
}

/// A path that passes degenerate (flat) figures: tubes and solutions of two systems of equations.
fn damage_through_flat_figures(times: usize) {
    let problem = Problem::read("tests/data/hexahedron-28.toml").unwrap();
    let (_, bytes) = crate::common::certificate::of(&problem, &Options::certified());
    let good = Certificate::read(&bytes);
    let (refuted, of) = damage_in("hexahedron", &good, times, FALSE, false);
    assert!(2 * refuted > of, "{refuted} of {of}");
    damage_in("hexahedron", &good, times.div_ceil(2), HARMLESS, true);
}

#[test]
fn damaged_certificates_through_flat_figures_are_refused() {
    damage_through_flat_figures(1);
}

#[test]
#[ignore = "half a minute"]
fn many_damaged_certificates_through_flat_figures_are_refused() {
    damage_through_flat_figures(6);
}

#[test]
fn harmless_changes_are_accepted() {
    for (name, times) in [
        ("octahedron", 6),
        ("dodecagon", 6),
        ("k33", 6),
        ("prism", 6),
        ("disulfide", 2),
        ("icosahedron-c1", 1),
    ] {
        damage(name, times, HARMLESS, true);
    }
}

type Change = fn(&mut TubeClaim, &mut Dice);

/// Changes of one tube in extended precision after which a claim is false.
const FALSE_EXTENDED: &[(&str, Change)] = &[
    ("low parts off the path", |tube, dice| {
        let off = sideways(tube, dice.about(3.0, 300.0), dice);
        tube.low.iter_mut().zip(off).for_each(|(x, off)| *x += off);
    }),
    ("centre off the path", |tube, dice| {
        let off = sideways(tube, dice.about(3.0, 300.0), dice);
        tube.centre
            .iter_mut()
            .zip(off)
            .for_each(|(x, off)| *x += off);
    }),
    (
        "low parts and centre changed places with a factor",
        |tube, dice| {
            let factor = dice.between(0.1, 0.9);
            for (x, low) in tube.centre.iter_mut().zip(&mut tube.low) {
                (*x, *low) = (*low, factor * *x);
            }
        },
    ),
    ("normal reversed", |tube, _| {
        tube.normal.iter_mut().for_each(|c| *c *= -1.0);
    }),
    ("exit on the wrong side", |tube, _| tube.exit *= -1.0),
];

/// Changes of one tube in extended precision after which its claims may be true.
const DOUBTFUL_EXTENDED: &[(&str, Change)] = &[
    ("a low part zeroed", |tube, dice| {
        let i = dice.below(tube.low.len());
        tube.low[i] = 0.0;
    }),
    ("all low parts zeroed", |tube, _| tube.low.fill(0.0)),
    ("low parts swapped", |tube, dice| {
        let n = tube.low.len();
        tube.low.swap(dice.below(n), dice.below(n));
    }),
    ("low parts reversed in sign", |tube, _| {
        tube.low.iter_mut().for_each(|x| *x *= -1.0);
    }),
    ("a low part changed", |tube, dice| {
        let i = dice.below(tube.low.len());
        tube.low[i] += dice.about(1e-40, 1e-3) * [-1.0, 1.0][dice.below(2)];
    }),
    ("t changed", |tube, dice| {
        let sign = [-1.0, 1.0][dice.below(2)];
        *tube.low.last_mut().unwrap() += sign * dice.about(1e-35, 1e-3);
    }),
    ("low parts in the precision of floats", |tube, _| {
        for (x, low) in tube.centre.iter_mut().zip(&mut tube.low) {
            (*x, *low) = (*x + *low, 0.0);
        }
    }),
    ("another radius", |tube, dice| {
        tube.r *= dice.about(1e-6, 1e6) as f32
    }),
    ("another length", |tube, dice| {
        tube.h *= dice.about(1.0, 1e6)
    }),
    ("next to no length", |tube, dice| {
        tube.h *= dice.about(1e-9, 1e-6);
        tube.exit = tube.exit.clamp(-tube.h, tube.h);
    }),
    ("another normal", |tube, dice| {
        let size = dice.about(1e-7, 1.0);
        let change = |c: &mut f32| *c += dice.between(-size, size) as f32;
        tube.normal.iter_mut().for_each(change);
    }),
    ("normal in a random direction", |tube, dice| {
        let random = |_: &f32| dice.between(-1.0, 1.0) as f32;
        tube.normal = tube.normal.iter().map(random).collect();
    }),
    ("other weights", |tube, dice| {
        let change = |u: &mut u16| *u = 1 + dice.below(65535) as u16;
        tube.weights.iter_mut().for_each(change);
    }),
    ("left elsewhere", |tube, dice| {
        tube.exit = tube.h * dice.between(-1.0, 1.0)
    }),
    ("in 53 bits", |tube, _| tube.low.clear()),
];

/// Records in extended precision left out, doubled and moved; and the solutions behind them.
const RECORDS_EXTENDED: &[(&str, Damage)] = &[
    ("dropped", |c, dice| {
        let gone = extended(c, dice);
        c.keep_tubes(|k| k != gone);
    }),
    ("all dropped", |c, _| {
        c.records
            .retain(|r| !matches!(r, Record::Tube(tube) if !tube.low.is_empty()));
        c.recount();
    }),
    ("doubled", |c, dice| {
        let k = extended(c, dice);
        let at = c.tube_at(k);
        c.records.insert(at, c.records[at].clone());
        c.recount();
    }),
    ("moved", |c, dice| {
        let (k, to) = (extended(c, dice), dice.below(c.tubes() - 1));
        let (at, to) = (c.tube_at(k), c.tube_at(to));
        let record = c.records.remove(at);
        c.records.insert(to, record);
    }),
    ("swapped with another", |c, dice| {
        let (k, other) = (extended(c, dice), dice.below(c.tubes()));
        let (a, b) = (c.tube_at(k), c.tube_at(other));
        c.records.swap(a, b);
    }),
    ("two doubled in the other order", |c, dice| {
        let k = extended(c, dice).min(c.tubes() - 2);
        let pair = [k + 1, k].map(|k| c.records[c.tube_at(k)].clone());
        let at = c.tube_at(k);
        c.records.splice(at..at, pair);
        c.recount();
    }),
];

/// The number of a tube in extended precision.
fn extended(c: &mut Certificate, dice: &mut Dice) -> usize {
    let count = c.tubes();
    let all: Vec<usize> = (0..count)
        .filter(|&k| !c.tube_mut(k).low.is_empty())
        .collect();
    all[dice.below(all.len())]
}

/// Tubes in extended precision: false claims are refused; and where a change is accepted, what is said of the path is
/// what was said before. So many times in each way.
fn damage_in_extended_precision(times: usize) {
    let mut dice = Dice(TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let said = |c: &Certificate| -> Option<Verdict> {
        verify(&c.bytes()[..], &Settings { threads: 1 }, &mut |_| ()).ok()
    };
    let (mut accepted, mut refused) = (BTreeMap::new(), BTreeMap::new());
    for (name, k) in [
        ("fold", 8),
        ("fold-missed", 10),
        ("peak", 9),
        ("flaps-split", 8),
        ("graze", 7),
    ] {
        let problem = families().find(|f| f.name == name).unwrap().problem(k);
        let (run, bytes) = crate::common::certificate::of(&problem, &Options::certified());
        assert_eq!(run.status, Status::Closed);
        let good = Certificate::read(&bytes);
        let before = said(&good).unwrap();
        assert_eq!(before.outcome, Outcome::Verified, "{name}-{k}");
        let mut judge = |kind: &'static str, changed: &Certificate, is_false: bool| {
            let after = said(changed);
            let Some(after) = after.filter(|v| v.outcome == Outcome::Verified) else {
                *refused.entry(kind).or_insert(0) += 1;
                return;
            };
            assert!(!is_false, "{name}-{k}: {kind} is accepted");
            *accepted.entry(kind).or_insert(0) += 1;
            assert_eq!(
                after.solutions.len(),
                before.solutions.len(),
                "{name}-{k}: {kind}"
            );
            let coordinates = |v: &Verdict| v.solutions.concat().concat();
            let both = coordinates(&after).into_iter().zip(coordinates(&before));
            assert!(
                both.into_iter().all(|(a, b)| !a.disjoint(b)),
                "{name}-{k}: {kind}"
            );
        };
        let kinds = FALSE_EXTENDED.iter().map(|kind| (kind, true));
        for (&(kind, change), is_false) in
            kinds.chain(DOUBTFUL_EXTENDED.iter().map(|kind| (kind, false)))
        {
            for _ in 0..times {
                let mut changed = good.clone();
                let tube = extended(&mut changed, &mut dice);
                change(changed.tube_mut(tube), &mut dice);
                judge(kind, &changed, is_false);
            }
        }
        for &(kind, change) in RECORDS_EXTENDED {
            for _ in 0..times {
                let mut changed = good.clone();
                change(&mut changed, &mut dice);
                judge(kind, &changed, false);
            }
        }
        // The solutions, which are next to such tubes.
        for k in 0..good.solutions() {
            let mut changed = good.clone();
            changed.records.remove(good.solution_at(k));
            changed.classes_mut().pop();
            judge("solution dropped", &changed, true);
            let mut changed = good.clone();
            let solution = changed.solution_mut(k);
            solution.centre[0] += 10.0 * f64::from(solution.radius);
            judge("solution moved", &changed, true);
        }
    }
    println!("accepted: {accepted:?}\nrefused: {refused:?}");
    let sum = |counts: &BTreeMap<&str, usize>| counts.values().sum::<usize>();
    assert!(
        sum(&refused) > 50 * times && sum(&accepted) > 20 * times,
        "{accepted:?} {refused:?}"
    );
}

#[test]
fn damaged_tubes_in_extended_precision_are_refused() {
    damage_in_extended_precision(2);
}

#[test]
#[ignore = "a quarter of a minute"]
fn many_damaged_tubes_in_extended_precision_are_refused() {
    damage_in_extended_precision(8);
}

/// Bytes at random: an error, a refusal or a harmless change, and never a panic.
#[test]
fn random_bytes_do_no_harm() {
    let mut dice = Dice(TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    for name in ["dodecagon", "k33", "prism"] {
        let good = shipped(name);
        for _ in 0..100 {
            let mut bytes = good.clone();
            for _ in 0..1 + dice.below(3) {
                let at = dice.below(bytes.len());
                bytes[at] = dice.below(256) as u8;
            }
            if dice.below(4) == 0 {
                bytes.truncate(dice.below(bytes.len()));
            }
            let _ = outcome(&bytes);
        }
    }
}
