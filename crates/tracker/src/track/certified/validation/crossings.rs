//! Crossings of t = 1 on polynomials made to mislead, against Sturm's theorem in rationals.

use super::*;
use crate::rational::{Rational, exact};
use crate::track::events::{Crossing, TimeAlong};

type Polynomial = Vec<Rational>;

fn value(p: &[Rational], x: &Rational) -> Rational {
    p.iter().rev().fold(Rational::zero(), |sum, c| sum * x + c)
}

fn trim(mut p: Polynomial) -> Polynomial {
    while p.last().is_some_and(|c| c.is_zero()) {
        p.pop();
    }
    p
}

/// Sturm's sequence, each member scaled to a leading coefficient ±1.
fn sturm(p: &[Rational]) -> Vec<Polynomial> {
    let derivative: Polynomial = p
        .iter()
        .enumerate()
        .skip(1)
        .map(|(k, c)| c * Rational::from_integer(k.into()))
        .collect();
    let mut sequence = vec![trim(p.to_vec()), trim(derivative)];
    loop {
        let (a, b) = (&sequence[sequence.len() - 2], &sequence[sequence.len() - 1]);
        if b.is_empty() {
            sequence.pop();
            return sequence;
        }
        let mut rest = a.clone();
        while rest.len() >= b.len() {
            let factor = &rest[rest.len() - 1] / &b[b.len() - 1];
            let shift = rest.len() - b.len();
            for (k, c) in b.iter().enumerate() {
                rest[k + shift] = &rest[k + shift] - &factor * c;
            }
            rest.pop();
        }
        let rest = trim(rest);
        let scale = rest
            .last()
            .map_or(Rational::from_integer(1.into()), |c| c.abs());
        sequence.push(rest.into_iter().map(|c| -c / &scale).collect());
    }
}

/// The number of different roots in [a, b].
fn roots(p: &[Rational], a: &Rational, b: &Rational) -> usize {
    let sequence = sturm(p);
    let changes = |x: &Rational| {
        let signs: Vec<bool> = sequence
            .iter()
            .map(|q| value(q, x))
            .filter(|v| !v.is_zero())
            .map(|v| v.is_positive())
            .collect();
        signs.windows(2).filter(|w| w[0] != w[1]).count()
    };
    // Sturm counts those in (a, b].
    changes(a) - changes(b) + value(p, a).is_zero() as usize
}

fn shifted(p: &[Rational], constant: &Rational, linear: &Rational) -> Polynomial {
    let mut p = p.to_vec();
    p[0] = &p[0] + constant;
    p[1] = &p[1] + linear;
    p
}

/// What a list of crossings claims of one of the functions that the bounds allow.
fn is_true(p: &[Rational], (from, to): (f64, f64), crossings: &[Crossing]) -> bool {
    let mut inside = 0;
    for c in crossings {
        let (a, b) = (exact(c.between.0), exact(c.between.1));
        let (before, after) = (value(p, &a), value(p, &b));
        if roots(p, &a, &b) != 1
            || before.is_positive() == c.rising
            || after.is_positive() != c.rising
        {
            return false;
        }
        // Those beyond the ends do not count below.
        let (a, b) = (a.max(exact(from)), b.min(exact(to)));
        inside += if a <= b { roots(p, &a, &b) } else { 0 };
    }
    inside == roots(p, &exact(from), &exact(to))
}

/// Coefficients of (s − r₁)(s − r₂)…, rounded.
fn product(factors: &[f64]) -> Vec<f64> {
    factors.iter().fold(vec![1.0], |p, r| {
        let mut out = vec![0.0; p.len() + 1];
        for (k, c) in p.iter().enumerate() {
            out[k + 1] += c;
            out[k] -= r * c;
        }
        out
    })
}

#[test]
fn lists_of_crossings_are_true_or_undecided() {
    let mut random = Random::new(5);
    let (mut decided, mut undecided, mut found) = (0, 0, 0);
    for _ in 0..effort(1500) {
        let h = 10f64.powf(random.between(-3.0, 1.0));
        let (from, to) = (-h * random.between(0.3, 1.0), 0.97 * h);
        let near = 10f64.powf(random.between(-15.0, -1.0)) * h;
        let a = random.between(from, to);
        let factors = match random.below(7) {
            // A tangency, moved a little below; two or three near crossings; an inflection.
            0 => vec![a, a],
            1 => vec![a, a + near],
            2 => vec![a, a + near, a - 2.0 * near],
            3 => vec![a, a, a],
            // At the ends, and near them.
            4 => vec![to, a],
            5 => vec![from + random.sign() * near, to + random.sign() * near],
            _ => (0..1 + random.below(5))
                .map(|_| random.between(-1.5 * h, 1.5 * h))
                .collect(),
        };
        let mut c = product(&factors);
        let scale =
            random.sign() * 10f64.powf(random.between(-3.0, 0.0)) / h.powi(factors.len() as i32);
        let mut z = [0.0; ORDER + 1];
        for (k, c) in c.drain(..).enumerate() {
            z[k] = scale * c;
        }
        z[0] += 1.0;
        if random.below(2) == 0 {
            z[0] += random.sign() * 10f64.powf(random.between(-16.0, -2.0));
        }
        let distance = 10f64.powf(random.between(-14.0, -4.0));
        let slope_distance = 10f64.powf(random.between(-3.0, 1.0)) * distance / h;
        let mut crossings = Vec::new();
        if TimeAlong::new(&z, h, distance, slope_distance)
            .crossings(from, to, &mut crossings)
            .is_err()
        {
            undecided += 1;
            continue;
        }
        decided += 1;
        found += crossings.len();
        let mut p: Polynomial = z.iter().map(|&c| exact(c)).collect();
        p[0] = &p[0] - exact(1.0);
        // The polynomial itself, and others within the bounds.
        let tilt = 0.999 * slope_distance.min(distance / h);
        for (constant, linear) in [
            (0.0, 0.0),
            (random.sign() * distance, 0.0),
            (0.0, random.sign() * tilt),
        ] {
            let p = shifted(&p, &exact(constant), &exact(linear));
            assert!(
                is_true(&p, (from, to), &crossings),
                "z = {z:?}, h = {h}, from {from} to {to}, {distance} {slope_distance}: {crossings:?}"
            );
        }
    }
    println!("{decided} decided with {found} crossings, {undecided} undecided");
    assert!(decided > 600 && found > 600 && undecided > 100);
}
