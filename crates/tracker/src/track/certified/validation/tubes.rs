//! What is proved of single tubes and of their links.

use super::super::link::Ball;
use super::disguise::Disguised;
use super::*;

/// What was checked, and how near the proofs' bounds the true values came.
#[derive(Debug, Default)]
struct Tally {
    tubes: usize,
    contractions: usize,
    points: usize,
    unresolved: usize,
    located: usize,
    tangents: usize,
    shortened: usize,
    refused: usize,
    nearest_q: f64,
    nearest_distance: f64,
    nearest_slope: f64,
}

/// M(s, w) = I − (I − s A) Y [J(ẑ(s) + w); c] in intervals; a lower bound of |M|_u.
fn contraction(exact: &Exact, sample: &Sample, s: f64, w: &[f64]) -> f64 {
    let n = exact.n;
    let z: Vec<Interval> = middle(&sample.tube, s)
        .iter()
        .zip(w)
        .map(|(&z, &w)| z + point(w))
        .collect();
    let rows = exact.bordered(&z, sample.normal());
    let (y, u) = (&sample.tube.local.y, &sample.tube.weights);
    let mut product = vec![vec![point(0.0); n]; n];
    for (i, out) in product.iter_mut().enumerate() {
        for (k, row) in rows.iter().enumerate() {
            let y = point(y.get(i, k));
            for (out, x) in out.iter_mut().zip(row) {
                *out += y * *x;
            }
        }
    }
    (0..n)
        .map(|i| {
            let mut row: Vec<Interval> = (0..n)
                .map(|j| point(if i == j { 1.0 } else { 0.0 }) - product[i][j])
                .collect();
            for (k, from) in product.iter().enumerate() {
                let x = point(s) * point(sample.a.get(i, k));
                for (out, from) in row.iter_mut().zip(from) {
                    *out += x * *from;
                }
            }
            let sum = row
                .iter()
                .zip(u.iter())
                .fold(point(0.0), |sum, (x, &u)| sum + x.abs() * point(u));
            (sum / point(u[i])).inf()
        })
        .fold(0.0, f64::max)
}

fn check_tube(
    exact: &Exact,
    sample: &Sample,
    random: &mut Random,
    rounds: usize,
    tally: &mut Tally,
) {
    let n = exact.n;
    let (proof, u) = (&sample.tube.proof, &sample.tube.weights);
    let time = sample.tube.time();
    let any = |random: &mut Random| match random.below(4) {
        0 => proof.h,
        1 => -proof.h,
        _ => random.between(-proof.h, proof.h),
    };
    for _ in 0..rounds {
        // (a) |M| ≤ q, in the middle of the box and at its corners.
        let s = any(random);
        let size = if random.below(3) == 0 {
            random.unit()
        } else {
            1.0
        };
        let w: Vec<f64> = (0..n)
            .map(|i| random.sign() * (size * proof.r * u[i] * (1.0 - 1e-15)))
            .collect();
        let norm = contraction(exact, sample, s, &w);
        assert!(
            norm <= proof.q,
            "|M| ≥ {norm} > {} at s = {s} of ±{}",
            proof.q,
            proof.h
        );
        tally.nearest_q = tally.nearest_q.max(norm / proof.q);
        tally.contractions += 1;

        // (b) The path's point and direction.
        let s = any(random);
        let through = middle(&sample.tube, s);
        let start: Vec<f64> = through.iter().map(|x| x.mid()).collect();
        let Some((z, x)) = exact.point_near(&start, sample.normal(), &through) else {
            tally.unresolved += 1;
            continue;
        };
        tally.points += 1;
        let away: Vec<Interval> = (0..n).map(|i| z[i] - through[i]).collect();
        let distance = sample.norm(&away);
        assert!(
            distance <= proof.distance,
            "the path is {distance} away, not {}",
            proof.distance
        );
        tally.nearest_distance = tally.nearest_distance.max(distance / proof.distance);
        let slope = slope(&sample.tube, s);
        let advance = (0..n).fold(point(0.0), |sum, i| {
            sum + point(sample.normal()[i]) * slope[i]
        });
        let turned: Vec<Interval> = (0..n).map(|i| x[i] * advance - slope[i]).collect();
        let turned = sample.norm(&turned);
        assert!(
            turned <= proof.slope_distance,
            "the slope is {turned} away, not {}",
            proof.slope_distance
        );
        tally.nearest_slope = tally.nearest_slope.max(turned / proof.slope_distance);

        // (e) t and its slope, over a range around s and at s itself.
        let (lo, hi) = if random.below(2) == 0 {
            (s, s)
        } else {
            (
                random.between(-proof.h, s).min(s),
                random.between(s, proof.h).max(s),
            )
        };
        let ((low, high), (slope_low, slope_high)) = time.bounds(lo, hi);
        let (t, rate) = (z[n - 1] - point(1.0), x[n - 1] * advance);
        assert!(
            t.sup() >= low && t.inf() <= high,
            "t − 1 in {t:?} is not in [{low}, {high}]"
        );
        assert!(
            rate.sup() >= slope_low && rate.inf() <= slope_high,
            "t' in {rate:?}, not [{slope_low}, {slope_high}]"
        );

        // (d) The point is found at its own parameter.
        let mut ball = sample.tube.exit.clone();
        for i in 0..n {
            (ball.centre[i], ball.radius[i]) = (z[i].mid(), z[i].rad());
        }
        if let Some((lo, hi)) = sample.tube.locate(&ball) {
            assert!(
                lo <= s && s <= hi,
                "the point at {s} was located in [{lo}, {hi}]"
            );
            tally.located += 1;
        }
    }
}

/// (c) The exit's box holds the path's point there, and that point is in the next tube where its
/// entry says.
fn check_link(
    workshop: &mut Workshop,
    exact: &Exact,
    sample: &Sample,
    next: Option<&Sample>,
    tally: &mut Tally,
) {
    let n = exact.n;
    let through = middle(&sample.tube, sample.tube.exit_at);
    let start: Vec<f64> = through.iter().map(|x| x.mid()).collect();
    let Some((z, x)) = exact.point_near(&start, sample.normal(), &through) else {
        tally.unresolved += 1;
        return;
    };
    let in_exit = |exit: &Ball| {
        for i in 0..n {
            let (c, r) = (point(exit.centre[i]), exit.radius[i]);
            assert!(
                (z[i] - c).abs().inf() <= r,
                "entry {i} of the exit is {} ± {r}, not in {:?}",
                exit.centre[i],
                z[i]
            );
        }
    };
    in_exit(&sample.tube.exit);
    // The tighter enclosure, with that of the tangent, from a test that has seen other tubes since.
    let mut tight = sample.tube.clone();
    workshop
        .test
        .tighten_exit(&workshop.equations, &mut tight)
        .expect("a tube whose exit was enclosed before");
    in_exit(&tight.exit);
    let u = &tight.weights;
    for i in 0..n {
        let away = (x[i] - point(tight.exit_slope[i])).abs();
        assert!(
            away.inf() <= tight.exit_slope_radius * u[i],
            "entry {i} of the tangent is {} ± {}, not in {:?}",
            tight.exit_slope[i],
            tight.exit_slope_radius * u[i],
            x[i]
        );
    }
    tally.tangents += 1;
    if let Some(next) = next {
        // x is along this tube's direction, as c·x = 1.
        check_entry(&next.tube, (&z, &x));
    }
}

fn check_problem(
    homotopy: &Homotopy,
    max_h: f64,
    (tubes, rounds): (usize, usize),
    random: &mut Random,
    tally: &mut Tally,
) {
    let exact = Exact::new(homotopy);
    let mut workshop = Workshop::new(homotopy, max_h);
    let chain = workshop.chain(homotopy, 1000);
    let stride = (chain.len() / tubes).max(1);
    for k in (0..chain.len()).step_by(stride) {
        let sample = &chain[k];
        tally.tubes += 1;
        check_tube(&exact, sample, random, rounds, tally);
        check_link(&mut workshop, &exact, sample, chain.get(k + 1), tally);

        // (g) What is provable is provable for shorter tubes, unless so short that rounding drowns
        // the direction.
        for factor in [0.999, 0.5, 0.01, 1e-4] {
            let mut weights = sample.tube.weights.clone();
            let h = factor * sample.tube.proof.h;
            tally.shortened += 1;
            let Some(proof) =
                workshop
                    .test
                    .prove(&workshop.equations, &sample.tube.local, &mut weights, h)
            else {
                tally.refused += 1;
                continue;
            };
            assert!(proof.h <= h);
            let mut shorter = sample.tube.clone();
            shorter.proof = proof;
            let a = workshop.test.moving_matrix().clone();
            check_tube(&exact, &Sample { tube: shorter, a }, random, 1, tally);
        }
    }
}

#[test]
fn proofs_hold_along_the_shipped_problems() {
    let mut tally = Tally::default();
    let mut random = Random::new(1);
    for problem in shipped() {
        for max_h in [f64::INFINITY, 1e-2, 1e-5] {
            let homotopy = Homotopy::new(&problem).expect("a gauge");
            check_problem(&homotopy, max_h, (12, 4), &mut random, &mut tally)
        }
    }
    println!("{tally:?}");
    assert!(
        tally.unresolved * 20 < tally.points,
        "too few cases were resolved: {tally:?}"
    );
    assert!(tally.refused == 0, "short tubes are not proved: {tally:?}");
    assert!(
        tally.nearest_q > 0.5 && tally.nearest_distance > 0.1,
        "the tests come nowhere near: {tally:?}"
    );
}

#[test]
fn proofs_hold_along_random_problems() {
    let mut tally = Tally::default();
    let mut random = Random::new(2);
    for round in 0..effort(60) {
        let dimension = 2 + round % 2;
        let points = dimension + 1 + random.below(4);
        let change = [0.1, 0.5, 1e-6][random.below(3)];
        let problem = random_problem(&mut random, dimension, points, change);
        let max_h = [f64::INFINITY, 1e-3][random.below(2)];
        // Every other problem in other words.
        let homotopy = if round % 4 < 2 {
            Homotopy::new(&problem).ok()
        } else {
            Disguised::new(&problem, 0.7, &mut random).homotopy()
        };
        let Some(homotopy) = homotopy else { continue };
        check_problem(&homotopy, max_h, (8, 4), &mut random, &mut tally)
    }
    println!("{tally:?}");
    assert!(
        tally.refused * 100 < tally.shortened,
        "short tubes are not proved: {tally:?}"
    );
    assert!(
        tally.tubes > 200 && tally.unresolved * 20 < tally.points,
        "too few cases: {tally:?}"
    );
}

/// Constraints of all kinds, each with its own auxiliary unknowns.
#[test]
fn proofs_hold_along_problems_of_mixed_kinds() {
    let mut tally = Tally::default();
    let mut random = Random::new(4);
    for round in 0..effort(40) {
        let dimension = 2 + round % 2;
        let homotopy = Homotopy::new(&mixed_problem(&mut random, dimension)).unwrap();
        let max_h = [f64::INFINITY, 1e-3][random.below(2)];
        check_problem(&homotopy, max_h, (8, 4), &mut random, &mut tally)
    }
    println!("{tally:?}");
    assert!(
        tally.tubes > 120 && tally.unresolved * 20 < tally.points,
        "too few cases: {tally:?}"
    );
}
