//! Extended precision against exact rationals.

use super::solutions::exact_solution;
use super::*;
use crate::places::Each as _;
use crate::problem::Target;
use crate::rational::Rational;
use crate::track::certified::link::Ball;
use crate::track::certified::solution::SolutionProver;
use crate::track::certified::tracker::Test;
use crate::track::full::Local;
use crate::track::{Control, Options, solve};
use num_bigint::BigInt;

fn exact(x: f64) -> Rational {
    Rational::from_float(x).expect("a finite float")
}

/// Rounded to a multiple of 2⁻⁵⁰⁰.
fn trimmed(x: Rational) -> Rational {
    let scale = Rational::from(BigInt::from(1) << 500);
    (x * &scale).round() / scale
}

/// The equations in rationals, from the problem's own decimals; roots to 2⁻⁵⁰⁰.
struct Exactly<'a> {
    homotopy: &'a Homotopy,
    /// a₀, a₁, a₂ of every distance, in the homotopy's unit.
    lengths: Vec<[Rational; 3]>,
}

impl<'a> Exactly<'a> {
    fn new(problem: &Problem, homotopy: &'a Homotopy) -> Self {
        let unit = exact(homotopy.unit);
        let root = |x: Rational| {
            let scale = BigInt::from(1) << 500;
            let scaled = (x * Rational::from(&scale * &scale)).floor().to_integer();
            Rational::new(scaled.sqrt(), scale)
        };
        let lengths = problem.distances.iter().enumerate().map(|(e, distance)| {
            let [p, q] = distance.points.each(|p| &problem.points[p].sketch);
            let squared = (0..3).fold(Rational::zero(), |sum, k| {
                sum + (p[k].value() - q[k].value()).pow(2)
            });
            let a0 = root(squared / &unit / &unit);
            let target = match &distance.target {
                Target::Length(length) => length.value() / &unit,
                Target::SquaredLength(squared) => root(squared.value() / &unit / &unit),
            };
            let c = match e == problem.homotopy.bend {
                true => problem.homotopy.bend_coefficient.value() / &unit,
                false => Rational::zero(),
            };
            [a0.clone(), target - a0 + &c, -c]
        });
        Exactly {
            homotopy,
            lengths: lengths.collect(),
        }
    }

    fn residual(&self, z: &[Rational]) -> Vec<Rational> {
        let homotopy = self.homotopy;
        let t = &z[homotopy.equations];
        let per_edge = homotopy.edges.iter().zip(&self.lengths);
        per_edge
            .map(|(edge, [a0, a1, a2])| {
                let [i, j] = edge.points;
                let [a, b] = [i, j].map(|p| homotopy.place(p, |i| z[i].clone()));
                let squared = (0..3).fold(Rational::zero(), |sum, axis| {
                    sum + (&a[axis] - &b[axis]).pow(2)
                });
                let length = a0 + t * (a1 + t * a2);
                (squared - length.pow(2)) / exact(2.0)
            })
            .collect()
    }

    /// J(z) v.
    fn jacobian_times(&self, z: &[Rational], v: &[Rational]) -> Vec<Rational> {
        let homotopy = self.homotopy;
        let m = homotopy.equations;
        let t = &z[m];
        let per_edge = homotopy.edges.iter().zip(&self.lengths);
        per_edge
            .map(|(edge, [a0, a1, a2])| {
                let [i, j] = edge.points;
                let between = |x: &[Rational]| {
                    let [a, b] = [i, j].map(|p| homotopy.place(p, |i| x[i].clone()));
                    [0, 1, 2].map(|axis| &a[axis] - &b[axis])
                };
                let (a, b) = (between(z), between(v));
                let products = a.iter().zip(&b).map(|(a, b)| a * b);
                let product: Rational = products.sum();
                let (length, slope) = (a0 + t * (a1 + t * a2), a1 + exact(2.0) * t * a2);
                product - length * slope * &v[m]
            })
            .collect()
    }

    /// The path's derivative by s at a point z of it, by chord iteration; less ẑ'(s).
    fn slope_off(&self, local: &Local, s: f64, z: &[Rational]) -> Vec<Rational> {
        let n = z.len();
        let s = exact(s);
        let slope: Vec<Rational> = (0..n)
            .map(|i| {
                (1..=ORDER).rev().fold(Rational::zero(), |sum, k| {
                    sum * &s + exact(k as f64) * exact(local.z[k][i])
                })
            })
            .collect();
        let mut v = slope.clone();
        loop {
            let mut g = self.jacobian_times(z, &v);
            g.push((0..n).fold(exact(-1.0), |sum, i| sum + exact(local.normal[i]) * &v[i]));
            let mut largest = Rational::zero();
            for i in 0..n {
                let step = (0..n).fold(Rational::zero(), |sum, j| {
                    sum + exact(local.y.get(i, j)) * &g[j]
                });
                largest = largest.max(step.abs());
                v[i] = trimmed(&v[i] - step);
            }
            if largest < exact(1e-50) {
                return v.iter().zip(&slope).map(|(v, slope)| v - slope).collect();
            }
        }
    }

    /// The zero of F in the cross-section of ẑ(s), by chord iteration from ẑ(s); and ẑ(s).
    fn path(&self, local: &Local, s: f64) -> Option<(Vec<Rational>, Vec<Rational>)> {
        let n = self.homotopy.equations + 1;
        let s = exact(s);
        let through: Vec<Rational> = (0..n)
            .map(|i| {
                let terms = (0..=ORDER).rev();
                let sum = terms.fold(Rational::zero(), |sum, k| sum * &s + exact(local.z[k][i]));
                sum + exact(local.low[i])
            })
            .collect();
        let inverse: Vec<Vec<Rational>> = (0..n)
            .map(|i| (0..n).map(|j| exact(local.y.get(i, j))).collect())
            .collect();
        let mut z = through.clone();
        for _ in 0..80 {
            let mut g = self.residual(&z);
            g.push((0..n).fold(Rational::zero(), |sum, i| {
                sum + exact(local.normal[i]) * (&z[i] - &through[i])
            }));
            let mut largest = Rational::zero();
            for i in 0..n {
                let step = (0..n).fold(Rational::zero(), |sum, j| sum + &inverse[i][j] * &g[j]);
                largest = largest.max(step.abs());
                z[i] = trimmed(&z[i] - step);
            }
            if largest < exact(1e-60) {
                return Some((z, through));
            }
        }
        None
    }
}

fn scaled(problem: &Problem, exponent: i32) -> Option<Problem> {
    let mut problem = problem.clone();
    for point in &mut problem.points {
        for x in &mut point.sketch {
            *x = times_ten_to(x, exponent)?;
        }
    }
    for distance in &mut problem.distances {
        distance.target = match &distance.target {
            Target::Length(length) => Target::Length(times_ten_to(length, exponent)?),
            Target::SquaredLength(x) => Target::SquaredLength(times_ten_to(x, 2 * exponent)?),
        };
    }
    let bend = &mut problem.homotopy.bend_coefficient;
    *bend = times_ten_to(bend, exponent)?;
    Some(problem)
}

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

fn sum_of(z: f64, low: f64) -> Rational {
    exact(z) + exact(low)
}

fn residuals(problem: &Problem, random: &mut Random, cancelled: &mut usize) {
    let Ok(homotopy) = Homotopy::new(problem) else {
        return;
    };
    let rational = Exactly::new(problem, &homotopy);
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
        let point: Vec<Rational> = (0..n).map(|i| sum_of(z[i], low[i])).collect();
        let extended = equations.in_extended();
        extended.residual(equations, (&z, &low), &mut f, Some(&mut error));
        for (e, value) in rational.residual(&point).iter().enumerate() {
            assert!(
                (value - exact(f[e])).abs() <= exact(error[e]),
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
                let off = (&d - exact(differences[axis][e])).abs();
                assert!(off <= d.abs() * exact(f64::EPSILON));
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
    proved: usize,
    sabotaged: usize,
    refused: usize,
    located: usize,
}

/// Whatever the low words are, what is proved of the tube around them is true.
fn tubes(problem: &Problem, random: &mut Random, tally: &mut Tally) {
    let homotopy = Homotopy::new(problem).unwrap();
    let rational = Exactly::new(problem, &homotopy);
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
        let mut weights = workshop.weights.clone();
        let proof = workshop
            .test
            .prove(&workshop.equations, &tube.local, &mut weights, max_h);
        let Some(proof) = proof else {
            tally.refused += 1;
            continue;
        };
        tube.proof = proof;
        tube.weights.copy_from_slice(workshop.test.weights());
        tube.exit_at = 0.97 * proof.h;
        if case == 0 {
            // Rounding is relative to h.
            assert!(proof.distance < 1e-9 * proof.h + 1e-25, "{proof:?}");
        }
        let has_exit = workshop
            .test
            .tighten_exit(&workshop.equations, &mut tube)
            .is_some();
        for s in [-proof.h, 0.0, tube.exit_at] {
            let (z, through) = rational.path(&tube.local, s).expect("a regular point");
            for i in 0..n {
                let off = (&z[i] - &through[i]).abs();
                let allowed = exact(proof.distance) * exact(tube.weights[i]);
                assert!(off <= allowed, "{proof:?}: {:e}", off.to_f64());
            }
            if has_exit && s > 0.0 {
                for i in 0..n {
                    let centre = sum_of(tube.exit.centre[i], tube.exit.low[i]);
                    assert!((&z[i] - centre).abs() <= exact(tube.exit.radius[i]));
                }
                let small = 1e-8 * proof.h + 1e-24;
                let widest = tube.exit.radius.iter().fold(0.0, |max: f64, &r| max.max(r));
                assert!(case > 0 || widest < small, "{widest:e}, {proof:?}");
            }
            // The point itself is found where it is.
            let mut ball = Ball::new(&workshop.equations);
            for i in 0..n {
                let (near, left) = crate::interval::DoubleDouble::near(&z[i]);
                (ball.centre[i], ball.low[i]) = (near.hi, near.lo);
                ball.radius[i] = left;
            }
            if let Some((lo, hi)) = tube.locate(&ball) {
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
        tubes(&problem, &mut random, &mut tally)
    }
    println!("{tally:?}");
    assert!(
        tally.sabotaged > 20 && tally.refused > 5 && tally.located > 20,
        "{tally:?}"
    );
}

#[test]
fn boxes_of_solutions_hold_them() {
    for problem in shipped().iter().filter(|p| p.dimension == 3).take(2) {
        let homotopy = Homotopy::new(problem).unwrap();
        let mut equations = Equations::new(&homotopy);
        equations.extend(&homotopy);
        let mut inverter = equations.inverter();
        let mut prover = SolutionProver::new(&homotopy, &equations);
        let outcome = solve(problem, &Options::certified(), &mut Control::default()).unwrap();
        assert!(!outcome.solutions.is_empty());
        for solution in &outcome.solutions {
            let x = exact_solution(problem, &homotopy, &solution.points).unwrap();
            let mut guess = equations.vector();
            for (v, &place) in homotopy.gauge.place.iter().enumerate() {
                let middle = solution.points[place / 3][place % 3].mid();
                guess[v] = middle / homotopy.unit + 1e-9;
            }
            let found = prover
                .prove(&equations, &mut inverter, &guess, true)
                .unwrap();
            for (v, x) in x.iter().enumerate() {
                let centre = sum_of(found.figure.centre[v], found.figure.low[v]);
                let off = (x / exact(homotopy.unit) - centre).abs();
                assert!(off <= exact(found.figure.radius[v]));
                assert!(
                    found.figure.radius[v] < 1e-26,
                    "{:e}",
                    found.figure.radius[v]
                );
            }
            for (point, place) in found.points(&homotopy).iter().zip(0..) {
                for axis in 0..3 {
                    let v = homotopy.gauge.variable[place * 3 + axis];
                    if v < x.len() {
                        assert!(
                            exact(point[axis].inf()) <= x[v] && x[v] <= exact(point[axis].sup())
                        );
                    }
                }
            }
        }
    }
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
            let off = sum_of(tube.exit.centre[i], tube.exit.low[i]) - exact(loose.centre[i]);
            assert!(off.abs() <= exact(loose.radius[i]) + exact(tube.exit.radius[i]));
            assert!(tube.exit.radius[i] < 1e-6 * loose.radius[i]);
        }
    }
}

/// What a tube claims at a few parameters, against rationals: how near the claimed distance comes.
fn compare(rational: &Exactly, tube: &Tube) -> (f64, f64) {
    let (n, proof) = (tube.weights.len() - 1, &tube.proof);
    let (mut used, mut turned) = (0.0f64, 0.0f64);
    for s in [-proof.h, -0.5 * proof.h, 0.0, 0.5 * proof.h, proof.h] {
        let (z, through) = rational.path(&tube.local, s).expect("a regular point");
        for i in 0..n {
            let off = (&z[i] - &through[i]).abs();
            let allowed = exact(proof.distance) * exact(tube.weights[i]);
            used = used.max((off / allowed).to_f64());
        }
        for (i, off) in rational.slope_off(&tube.local, s, &z).iter().enumerate() {
            let allowed = exact(proof.slope_distance) * exact(tube.weights[i]);
            turned = turned.max((off.abs() / allowed).to_f64());
        }
    }
    (used, turned)
}

/// Proves a tube around `local` as it is, at most `max_h` long.
fn prove_as_it_is(workshop: &mut Workshop, tube: &mut Tube, max_h: f64) -> bool {
    let mut weights = workshop.weights.clone();
    workshop.test.precision.extended = true;
    let (test, equations) = (&mut workshop.test, &workshop.equations);
    let Some(proof) = test.prove(equations, &tube.local, &mut weights, max_h) else {
        return false;
    };
    tube.proof = proof;
    tube.weights.copy_from_slice(workshop.test.weights());
    true
}

/// Lengths known less well than they are: the middle is then off by as much as order 0 of F may be.
fn blurred(problem: &Problem, random: &mut Random) -> Option<(f64, f64)> {
    let homotopy = Homotopy::new(problem).unwrap();
    let rational = Exactly::new(problem, &homotopy);
    let mut workshop = Workshop::new(&homotopy, f64::INFINITY);
    workshop.equations.extend(&homotopy);
    let size = 10f64.powf(random.between(-22.0, -12.0));
    let extended = workshop.equations.in_extended_mut();
    extended.blur(|_| size * random.sign());
    let mut tube = around_sketch(&homotopy, &mut workshop)?;
    let max_h = 10f64.powf(random.between(-10.0, -4.0));
    if !prove_as_it_is(&mut workshop, &mut tube, max_h) {
        return None;
    }
    let used = compare(&rational, &tube);
    assert!(used.0 <= 1.0 && used.1 <= 1.0, "{used:?}, {:?}", tube.proof);
    tube.exit_at = 0.97 * tube.proof.h;
    let test = &mut workshop.test;
    if test.tighten_exit(&workshop.equations, &mut tube).is_some() {
        let (z, _) = rational.path(&tube.local, tube.exit_at).unwrap();
        for i in 0..workshop.equations.n() {
            let centre = sum_of(tube.exit.centre[i], tube.exit.low[i]);
            assert!((&z[i] - centre).abs() <= exact(tube.exit.radius[i]));
        }
    }
    Some(used)
}

/// Differences and slopes rounded as badly as the bounds allow for: orders k ≥ 1 of F vanish as computed,
/// and do not.
fn rough(problem: &Problem, random: &mut Random) -> Option<(f64, f64)> {
    let homotopy = Homotopy::new(problem).unwrap();
    let rational = Exactly::new(problem, &homotopy);
    let mut workshop = Workshop::new(&homotopy, f64::INFINITY);
    let mut tube = around_sketch(&homotopy, &mut workshop)?;
    let m = workshop.equations.m;
    let mut rounded = |x: &mut f64| *x *= 1.0 + 40.0 * f64::EPSILON * random.between(-1.0, 1.0);
    for e in 0..m {
        let axes = tube.local.d[0].iter_mut();
        axes.for_each(|d| rounded(&mut d[e]));
        rounded(&mut tube.local.lengths.terms[1][e]);
    }
    tube.local.expand(&workshop.equations);
    let max_h = 10f64.powf(random.between(-10.0, -4.0));
    if !prove_as_it_is(&mut workshop, &mut tube, max_h) {
        return None;
    }
    let used = compare(&rational, &tube);
    assert!(used.0 <= 1.0 && used.1 <= 1.0, "{used:?}, {:?}", tube.proof);
    Some(used)
}

#[test]
fn low_orders_hold_what_is_not_known_of_them() {
    let mut random = Random::new(23);
    let (mut most, mut proved) = ([(0.0f64, 0.0f64); 2], [0; 2]);
    for round in 0..effort(16) {
        let (dimension, points) = (2 + round % 2, 4 + random.below(2));
        let problem = random_problem(&mut random, dimension, points, 0.3);
        for kind in 0..2 {
            let used = match kind {
                0 => blurred(&problem, &mut random),
                _ => rough(&problem, &mut random),
            };
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
