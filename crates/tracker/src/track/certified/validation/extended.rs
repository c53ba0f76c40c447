//! Extended precision against numbers of 256 bits.

use super::precise::big::Big;
use super::precise::full::{check_ball, check_point};
use super::precise::{Case, Figure, Ratios, ball_at};
use super::*;
use crate::places::Each as _;
use crate::track::certified::tracker::Test;

/// A refined point of the path at the sketch with its expansion, in extended precision.
fn around_sketch(homotopy: &Homotopy, workshop: &mut Workshop) -> Option<Tube> {
    workshop.equations.extend(homotopy);
    let mut tube = Tube::new(&workshop.equations);
    let (equations, inverter) = (&workshop.equations, &mut workshop.inverter);
    tube.local = at_sketch(homotopy, equations, inverter)?;
    tube.local.refine_extended(equations, inverter).ok()?;
    tube.local.expand(equations);
    Some(tube)
}

fn sum_of(z: f64, low: f64) -> Big {
    Big::of(z) + Big::of(low)
}

fn residuals(problem: &Problem, random: &mut Random, cancelled: &mut usize) {
    let Ok(homotopy) = Homotopy::new(problem) else {
        return;
    };
    let figure = Figure::new(problem, &homotopy);
    let mut workshop = Workshop::new(&homotopy, f64::INFINITY);
    let Some(tube) = around_sketch(&homotopy, &mut workshop) else {
        return;
    };
    let equations = &workshop.equations;
    let (m, n) = (equations.m, equations.n());
    let (mut f, mut error) = (equations.vector(), equations.vector());
    let mut differences = equations.room();
    for _ in 0..8 {
        // From a residual of 1e-32 to one of 1.
        let off = 10f64.powf(random.between(-34.0, 0.0));
        let (mut z, mut low) = (tube.local.z[0].clone(), tube.local.low.clone());
        let change: Vec<f64> = (0..n).map(|_| off * random.between(-1.0, 1.0)).collect();
        crate::track::full::shift(&mut z[..n], &mut low[..n], |i| change[i]);
        let point: Vec<Big> = (0..n).map(|i| sum_of(z[i], low[i])).collect();
        let extended = equations.in_extended();
        extended.residual(equations, (&z, &low), &mut f, Some(&mut error));
        for (e, value) in figure.residual(&point).iter().enumerate() {
            assert!(
                (value - &Big::of(f[e])).abs() <= Big::of(error[e]),
                "{}: F_{e} is {:e}, not {:e} up to {:e}",
                problem.name,
                value.to_f64(),
                f[e],
                error[e]
            );
            let size = homotopy.rights[e].e[0] + off;
            assert!(
                error[e] <= 1e-15 * f[e].abs() + 1e-28 * (size + 1.0),
                "{:e}",
                error[e]
            );
            *cancelled += usize::from(f[e].abs() < 1e-20 * size);
        }
        extended.differences(equations, (&z, &low), &mut differences);
        for axis in 0..equations.dimension() {
            for e in 0..m {
                let [i, j] = equations.ends[axis][e].each(|end| end as usize);
                let d = sum_of(z[i], low[i]) - sum_of(z[j], low[j]);
                let off = (&d - &Big::of(differences[axis][e])).abs();
                assert!(off <= d.abs() * Big::of(f64::EPSILON));
            }
        }
        // Words that overlap are no double-double.
        low[0] += 4.0 * f64::EPSILON * (z[0].abs() + 1.0);
        extended.residual(equations, (&z, &low), &mut f, Some(&mut error));
        assert!(error[0].is_infinite());
    }
}

#[test]
fn residuals_are_enclosed_at_all_scales() {
    let mut random = Random::new(21);
    let mut cancelled = 0;
    for round in 0..effort(60) {
        let (dimension, points) = (2 + round % 2, 4 + random.below(3));
        let problem = random_problem(&mut random, dimension, points, 0.3);
        for exponent in [-8, 0, 8] {
            let problem = scaled(&problem, exponent).unwrap();
            residuals(&problem, &mut random, &mut cancelled)
        }
    }
    println!("{cancelled} residuals below 1e-20");
    assert!(cancelled > 1000);
}

#[derive(Debug, Default)]
struct Tally {
    ratios: Ratios,
    proved: usize,
    sabotaged: usize,
    refused: usize,
    located: usize,
}

/// Whatever the low words are, what is proved of the tube around them is true.
fn tubes(problem: Problem, random: &mut Random, tally: &mut Tally) {
    let Case {
        homotopy, figure, ..
    } = Case::new(problem);
    let mut workshop = Workshop::new(&homotopy, f64::INFINITY);
    let Some(good) = around_sketch(&homotopy, &mut workshop) else {
        return;
    };
    let n = workshop.equations.n();
    workshop.test.precision.extended = true;
    for case in 0..12 {
        let mut tube = good.clone();
        let off = 10f64.powf(random.between(-30.0, -9.0));
        let change: Vec<f64> = (0..n).map(|_| off * random.between(-1.0, 1.0)).collect();
        let local = &mut tube.local;
        match case {
            0 => {}
            // Low words lost or made up, everything else being as it was.
            1..5 => {
                for i in 0..n {
                    let digit = 0.24 * f64::EPSILON * local.z[0][i].abs();
                    local.low[i] = [0.0, digit * random.between(-1.0, 1.0)][case % 2];
                }
            }
            // The point moved, perhaps by more than the low words are.
            5..9 => {
                let (z, low) = (&mut local.z[0][..n], &mut local.low[..n]);
                crate::track::full::shift(z, low, |i| change[i]);
                let inverter = &mut workshop.inverter;
                local.precondition(&workshop.equations, inverter).unwrap();
                local.expand(&workshop.equations);
            }
            // Low words that need not be low.
            _ => (0..n).for_each(|i| local.low[i] += change[i]),
        }
        let max_h = 10f64.powf(random.between(-10.0, -3.0));
        let weights = workshop.test.next_weights.clone();
        if !workshop.prove_as_it_is(&mut tube, weights, max_h) {
            tally.refused += 1;
            continue;
        }
        let proof = tube.proof;
        if case == 0 {
            // Rounding is relative to h.
            assert!(proof.distance < 1e-9 * proof.h + 1e-25, "{proof:?}");
        }
        let has_exit = workshop
            .test
            .tighten_exit(&workshop.equations, &mut tube)
            .is_some();
        for s in [-proof.h, 0.0, tube.exit_at] {
            let (z, _) =
                check_point(&figure, &tube, s, &mut tally.ratios).expect("a regular point");
            if has_exit && s > 0.0 {
                check_ball("exit", &z, &tube.exit, &mut tally.ratios);
                let small = 1e-8 * proof.h + 1e-24;
                let widest = tube.exit.radius.iter().fold(0.0, |max: f64, &r| max.max(r));
                assert!(case > 0 || widest < small, "{widest:e}, {proof:?}");
            }
            // The point itself is found where it is.
            if let Some((lo, hi)) = tube.locate(&ball_at(&tube, &z)) {
                assert!(lo <= s && s <= hi, "{s:e} located in [{lo:e}, {hi:e}]");
                tally.located += 1;
            }
        }
        tally.proved += 1;
        tally.sabotaged += usize::from(case > 0);
    }
}

#[test]
fn tubes_are_true_whatever_the_low_words() {
    let mut random = Random::new(22);
    let mut tally = Tally::default();
    for round in 0..effort(4) {
        let (dimension, points) = (2 + round % 2, 4 + random.below(2));
        let problem = random_problem(&mut random, dimension, points, 0.3);
        tubes(problem, &mut random, &mut tally)
    }
    println!("{tally:?}");
    assert!(
        tally.sabotaged > 20 && tally.refused > 5 && tally.located > 20,
        "{tally:?}"
    );
}

/// Room that was used in extended precision is used again in 53 bits: nothing of the low words may be left.
#[test]
fn low_words_do_not_outlive_their_tubes() {
    for problem in shipped().iter().filter(|p| p.dimension == 3) {
        let homotopy = Homotopy::new(problem).unwrap();
        let mut workshop = Workshop::new(&homotopy, f64::INFINITY);
        let mut tube = around_sketch(&homotopy, &mut workshop).unwrap();
        let prove = |workshop: &mut Workshop, tube: &mut Tube| {
            let (equations, test) = (&workshop.equations, &mut workshop.test);
            Test::refine(test, equations, &mut tube.local, 1e-9).unwrap();
            tube.local.expand(equations);
            assert!(Test::prove(test, equations, tube, f64::INFINITY));
            tube.exit_at = 0.97 * tube.proof.h;
            test.enclose_exit(equations, tube).unwrap();
        };
        workshop.test.precision.extended = true;
        prove(&mut workshop, &mut tube);
        assert!(tube.local.is_extended && tube.exit.is_extended());
        let distance = tube.proof.distance;
        assert!(tube.local.low.iter().any(|&x| x != 0.0));
        workshop.test.precision.extended = false;
        prove(&mut workshop, &mut tube);
        assert!(!tube.local.is_extended && !tube.exit.is_extended());
        assert!(tube.local.low.iter().all(|&x| x == 0.0));
        assert!(tube.proof.distance > distance);
        // And the tight exit is where the loose one says, seen from the same cross-section.
        workshop.test.precision.extended = true;
        let loose = tube.exit.clone();
        workshop
            .test
            .tighten_exit(&workshop.equations, &mut tube)
            .unwrap();
        let n = workshop.equations.n();
        for i in 0..n {
            let off = sum_of(tube.exit.centre[i], tube.exit.low[i]) - Big::of(loose.centre[i]);
            assert!(off.abs() <= Big::of(loose.radius[i]) + Big::of(tube.exit.radius[i]));
            assert!(tube.exit.radius[i] < 1e-6 * loose.radius[i]);
        }
    }
}

/// What a short tube around a middle claims at a few parameters, if it is proved: how near the claimed distances come.
fn proved(
    figure: &Figure,
    workshop: &mut Workshop,
    tube: &mut Tube,
    random: &mut Random,
) -> Option<(f64, f64)> {
    let max_h = 10f64.powf(random.between(-10.0, -4.0));
    workshop.test.precision.extended = true;
    let weights = workshop.test.next_weights.clone();
    if !workshop.prove_as_it_is(tube, weights, max_h) {
        return None;
    }
    let (proof, mut ratios) = (&tube.proof, Ratios::default());
    for s in [-proof.h, -0.5 * proof.h, 0.0, 0.5 * proof.h, proof.h] {
        check_point(figure, tube, s, &mut ratios).expect("a regular point");
    }
    Some((ratios.largest("distance"), ratios.largest("slope_distance")))
}

/// Lengths known less well than they are: the middle is then off by as much as order 0 of F may be.
fn blurred(case: &Case, random: &mut Random) -> Option<(f64, f64)> {
    let (homotopy, figure) = (&case.homotopy, &case.figure);
    let mut workshop = Workshop::new(homotopy, f64::INFINITY);
    workshop.equations.extend(homotopy);
    let size = 10f64.powf(random.between(-22.0, -12.0));
    let extended = workshop.equations.in_extended_mut();
    extended.blur(|_| size * random.sign());
    let mut tube = around_sketch(homotopy, &mut workshop)?;
    let used = proved(figure, &mut workshop, &mut tube, random)?;
    let test = &mut workshop.test;
    if test.tighten_exit(&workshop.equations, &mut tube).is_some() {
        let ratios = &mut Ratios::default();
        let (z, _) = check_point(figure, &tube, tube.exit_at, ratios).expect("a regular point");
        check_ball("exit", &z, &tube.exit, ratios);
    }
    Some(used)
}

/// Differences and slopes rounded as badly as the bounds allow for: orders k ≥ 1 of F vanish as computed,
/// and do not.
fn rough(case: &Case, random: &mut Random) -> Option<(f64, f64)> {
    let mut workshop = Workshop::new(&case.homotopy, f64::INFINITY);
    let mut tube = around_sketch(&case.homotopy, &mut workshop)?;
    let m = workshop.equations.m;
    let mut rounded = |x: &mut f64| *x *= 1.0 + 40.0 * f64::EPSILON * random.between(-1.0, 1.0);
    for e in 0..m {
        let axes = tube.local.d[0].iter_mut();
        axes.for_each(|d| rounded(&mut d[e]));
        rounded(&mut tube.local.lengths.terms[1][e]);
    }
    tube.local.expand(&workshop.equations);
    proved(&case.figure, &mut workshop, &mut tube, random)
}

#[test]
fn low_orders_hold_what_is_not_known_of_them() {
    let mut random = Random::new(23);
    let (mut most, mut proved) = ([(0.0f64, 0.0f64); 2], [0; 2]);
    for round in 0..effort(16) {
        let (dimension, points) = (2 + round % 2, 4 + random.below(2));
        let case = Case::new(random_problem(&mut random, dimension, points, 0.3));
        for (kind, used) in [blurred, rough].into_iter().enumerate() {
            let used = used(&case, &mut random);
            if let Some(used) = used {
                proved[kind] += 1;
                most[kind] = (most[kind].0.max(used.0), most[kind].1.max(used.1));
            }
        }
    }
    println!("{proved:?} tubes, at most {most:?} of the distance used");
    assert!(proved.iter().all(|&n| n > 8), "{proved:?}");
    // Otherwise nothing was put to the test: without the errors these are above 1.
    assert!(
        most[0].0 > 0.2 && most[1].0 > 0.02 && most[1].1 > 0.005,
        "{most:?}"
    );
}
