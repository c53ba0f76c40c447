//! Bounds of the full space: along certified runs, and with numbers changed on purpose.

use super::big::exact;
use super::moved::lengthen;
use super::reduced::{check_time, within};
use super::*;
use crate::generate::Family;
use crate::interval::rounding::round_up;
use crate::track::full::certified::norms::Norms;

/// Ỹ(s) of `tube.rs`, its matrices taken for exact.
fn preconditioner(sample: &Sample, s: &Big) -> Rows {
    let n = sample.kept.rows();
    let entries = |matrix: &Matrix| -> Rows {
        let row = |i| (0..n).map(|j| Big::of(matrix.get(i, j))).collect();
        (0..n).map(row).collect()
    };
    let y = entries(&sample.tube.local.y);
    let moved = times(&entries(&sample.kept), &y);
    let row = |(y, moved): (&Vec<Big>, &Vec<Big>)| {
        y.iter().zip(moved).map(|(y, x)| y - &(x * s)).collect()
    };
    y.iter().zip(&moved).map(row).collect()
}

fn times(a: &Rows, b: &Rows) -> Rows {
    let row = |a: &Vec<Big>| {
        let mut sums = vec![Big::of(0.0); b[0].len()];
        for (x, row) in a.iter().zip(b) {
            for (sum, y) in sums.iter_mut().zip(row) {
                if *y != Big::of(0.0) {
                    *sum += x * y;
                }
            }
        }
        sums
    };
    a.iter().map(row).collect()
}

/// M(s, w) = I − Ỹ(s) DG_s(w).
fn contraction(figure: &Figure, sample: &Sample, (y, s): (&Rows, &Big), w: &[Big]) -> Rows {
    let z: Vec<Big> = at(&sample.tube, s)
        .0
        .iter()
        .zip(w)
        .map(|(z, w)| z + w)
        .collect();
    identity_minus(times(y, &figure.bordered(&z, sample.normal())))
}

/// What `Norms` states, at one s.
fn check_norms(
    figure: &Figure,
    (sample, norms): (&Sample, &Norms),
    random: &mut Random,
    ratios: &mut Ratios,
) {
    let n = figure.n;
    let u = &sample.tube.weights[..n];
    let h = norms.h * [1.0, 1.0, 0.5, 0.1, 1e-3][random.below(5)];
    let (stays, width, defect) = norms.at(h);
    let s = Big::of(parameter(random, h));
    let y = preconditioner(sample, &s);
    let middle = contraction(figure, sample, (&y, &s), &vec![Big::of(0.0); n]);
    ratios.check("|M(s, 0)|", &norm_of(u, &middle), stays);
    let size = 0.5 / u[n - 1] * 10f64.powf(random.between(-3.0, 0.0));
    let w = in_box(random, u, size);
    let there = contraction(figure, sample, (&y, &s), &w);
    let change: Rows = (0..n)
        .map(|i| (0..n).map(|j| &there[i][j] - &middle[i][j]).collect())
        .collect();
    ratios.check(
        "|M(s, w) − M(s, 0)|",
        &norm_of(u, &change),
        round_up(width * size, 1),
    );
    let (z, slope) = at(&sample.tube, &s);
    let mut f = figure.residual(&z);
    f.push(Big::of(0.0));
    let step: Vec<Big> = y.iter().map(|row| dot(row, &f)).collect();
    ratios.check("|Ỹ F(ẑ)|", &norm(u, &step), defect);
    ratios.check("|ẑ'|", &norm(u, &slope), norms.slope);
    ratios.check("|ẑ_t'|", &slope[n - 1].abs(), norms.slope_of_t);
    let c: Vec<Big> = exact(&sample.normal()[..n]).iter().map(Big::abs).collect();
    ratios.check("|c|", &dot(&c, &exact(u)), round_up(norms.normal, n + 2));
}

/// What a proof says of the path's point at a parameter, and of its direction there: the point, and t'.
pub fn check_point(
    figure: &Figure,
    tube: &Tube,
    place: f64,
    ratios: &mut Ratios,
) -> Option<(Vec<Big>, Big)> {
    let (n, proof) = (figure.n, &tube.proof);
    let (u, c) = (&tube.weights[..n], &tube.local.normal[..n]);
    let (through, slope) = at(tube, &Big::of(place));
    let (z, tangent) = figure.point_near(&through, c)?;
    let away: Vec<Big> = z.iter().zip(&through).map(|(z, x)| z - x).collect();
    ratios.check("distance", &norm(u, &away), proof.distance);
    let advance = dot(&exact(c), &slope);
    let turned: Vec<Big> = (0..n).map(|i| &tangent[i] * &advance - &slope[i]).collect();
    ratios.check("slope_distance", &norm(u, &turned), proof.slope_distance);
    let rate = &tangent[n - 1] * &advance;
    Some((z, rate))
}

/// What a proof says of the path: its point, its direction, its t, where it is found.
pub fn check_path(
    figure: &Figure,
    sample: &Sample,
    random: &mut Random,
    ratios: &mut Ratios,
) -> Option<()> {
    let (n, tube) = (figure.n, &sample.tube);
    let (proof, u) = (&tube.proof, &tube.weights[..n]);
    let place = parameter(random, proof.h);
    let s = Big::of(place);
    let (z, rate) = check_point(figure, tube, place, ratios)?;
    check_time(
        &tube.time(),
        (place, proof.h),
        (&z[n - 1], &rate),
        random,
        ratios,
    );
    let w = in_box(random, u, proof.r);
    let y = preconditioner(sample, &s);
    ratios.check(
        "q",
        &norm_of(u, &contraction(figure, sample, (&y, &s), &w)),
        proof.q,
    );
    if let Some(between) = tube.locate(&ball_at(tube, &z)) {
        within("its own parameter", &s, between, ratios);
    }
    Some(())
}

/// A point, and the ball that it is said to be in.
pub fn check_ball(name: &'static str, z: &[Big], ball: &Ball, ratios: &mut Ratios) {
    for (i, z) in z.iter().enumerate() {
        let away = z - &Big::of(ball.centre[i]) - Big::of(ball.low[i]);
        ratios.check(name, &away.abs(), ball.radius[i]);
    }
}

/// The exit's box, also as tight as it gets, with the tangent; and the next tube's entry.
pub fn check_exit(
    workshop: &mut Workshop,
    figure: &Figure,
    (sample, next): (&Sample, Option<&Sample>),
    ratios: &mut Ratios,
) -> Option<()> {
    let (n, c) = (figure.n, sample.normal());
    let (through, _) = at(&sample.tube, &Big::of(sample.tube.exit_at));
    let (z, x) = figure.point_near(&through, c)?;
    let mut tight = sample.tube.clone();
    workshop
        .test
        .tighten_exit(&workshop.equations, &mut tight)?;
    check_ball("exit", &z, &sample.tube.exit, ratios);
    check_ball("tight exit", &z, &tight.exit, ratios);
    for i in 0..n {
        let turned = (&x[i] - &Big::of(tight.exit_slope[i])).abs();
        let bound = round_up(tight.exit_slope_radius * tight.weights[i], 1);
        ratios.check("tight tangent", &turned, bound);
    }
    if let Some(next) = next {
        check_entry(&next.tube, (&z, &x));
    }
    Some(())
}

/// The numbers of a tube changed in some way: ẑ's coefficients, one of them, or Y's entries.
fn changed(sample: &Sample, kind: usize, equations: &Equations, random: &mut Random) -> Sample {
    let (n, mut tube) = (sample.kept.rows(), sample.tube.clone());
    let size = 10f64.powf(random.between(-9.0, -2.0));
    let local = &mut tube.local;
    match kind {
        1 => {
            for x in local.z[1..].iter_mut().flat_map(|z| z[..n].iter_mut()) {
                *x *= 1.0 + size * random.between(-1.0, 1.0);
            }
        }
        2 => local.z[1 + random.below(ORDER)][random.below(n)] += random.sign() * size,
        3 => {
            for i in 0..n {
                for j in 0..n {
                    let x = local.y.get(i, j) * (1.0 + size * random.between(-1.0, 1.0));
                    local.y.set(i, j, x);
                }
            }
        }
        _ => {}
    }
    settle(equations, local);
    Sample {
        tube,
        kept: sample.kept.clone(),
    }
}

fn check_problem(
    case: &Case,
    (tubes, rounds): (usize, usize),
    random: &mut Random,
    ratios: &mut [Ratios; 5],
) {
    let (homotopy, true_figure) = (&case.homotopy, &case.figure);
    let mut workshop = Workshop::new(homotopy, f64::INFINITY);
    let chain = workshop.chain(homotopy, 400);
    assert!(!chain.is_empty(), "{}", case.problem.name);
    for k in spread(&chain, tubes) {
        let exits = (&chain[k], chain.get(k + 1));
        check_exit(&mut workshop, true_figure, exits, &mut ratios[0]).expect("a regular point");
        for _ in 0..rounds {
            check_path(true_figure, &chain[k], random, &mut ratios[0]).expect("a regular point");
        }
        // The same with numbers changed, and lengths of large radii.
        for (kind, ratios) in ratios.iter_mut().enumerate() {
            let mut sample = changed(&chain[k], kind, &workshop.equations, random);
            let kept = workshop.equations.clone();
            let other = (kind == 4).then(|| {
                let size = 10f64.powf(random.between(-12.0, -4.0));
                lengthen(&mut workshop.equations, homotopy, size, random)
            });
            let figure = other.as_ref().unwrap_or(true_figure);
            let h = sample.tube.proof.h * [1.0, 0.1, 1e-3, 1e-5][random.below(4)];
            let (equations, tube) = (&workshop.equations, &sample.tube);
            let norms = workshop
                .test
                .norms(equations, &tube.local, &tube.weights, h);
            sample.kept = workshop.test.kept();
            if let Some(norms) = norms {
                for _ in 0..rounds {
                    check_norms(figure, (&sample, &norms), random, ratios);
                }
                for part in [1.0, 0.5, 0.2] {
                    let weight = sample.tube.weights[figure.m];
                    if let Ok(proof) = norms.proof(part * norms.h, weight) {
                        sample.tube.proof = proof;
                        check_path(figure, &sample, random, ratios).expect("a regular point");
                    }
                }
            }
            workshop.equations = kept;
        }
    }
}

fn check_all(list: impl IntoIterator<Item = Case>, tubes: usize, seed: u64) {
    let (mut ratios, mut random) = (<[Ratios; 5]>::default(), Random::new(seed));
    for case in list {
        check_problem(&case, (effort(tubes), 2), &mut random, &mut ratios)
    }
    let kinds = ["as they are", "path", "one coefficient", "Y", "lengths"];
    for (kind, ratios) in kinds.iter().zip(&ratios) {
        print!("{kind}: ");
        ratios.come_near(&[("|M(s, 0)|", 0.3), ("|Ỹ F(ẑ)|", 0.2), ("distance", 0.1)]);
    }
}

/// Few rows and short tubes: what rounding adds is not hidden among other terms.
#[test]
fn full_bounds_dominate_exact_values_of_small_problems() {
    let mut random = Random::new(44);
    let list = (0..24).map(|round| {
        let dimension = 2 + round % 2;
        let points = dimension + random.below(3);
        Case::new(random_problem(&mut random, dimension, points, 0.3))
    });
    check_all(list, 4, 45);
}

#[test]
fn full_bounds_dominate_exact_values_of_tails() {
    check_all(tails(48, 24), 4, 49);
}

#[test]
fn full_bounds_dominate_exact_values_of_mixed_kinds() {
    check_all(mixed(53, 30), 3, 54);
}

/// See the test of the same name in the reduced space: t moves alone, with the highest order that ẑ
/// has, where E' vanishes.
#[test]
fn the_bend_counts_to_its_last_order_in_the_full_space() {
    let mut ratios = Ratios::default();
    let Case {
        homotopy, figure, ..
    } = Case::new(triangle());
    let mut workshop = Workshop::new(&homotopy, 1.0);
    let (n, m) = (figure.n, figure.m);
    let mut tube = Tube::new(&workshop.equations);
    tube.local.z[0] = sketch(&homotopy, &workshop.equations);
    tube.local.normal[m] = 1.0;
    for step in 0..=50 {
        tube.local.z[0][m] = 0.01 * f64::from(step);
        tube.local
            .refine(&workshop.equations, &mut workshop.inverter, 1e-9, 8)
            .expect("a figure");
    }
    for z in &mut tube.local.z[1..] {
        z[..n].fill(0.0);
    }
    tube.local.z[ORDER][m] = 2.0;
    settle(&workshop.equations, &mut tube.local);
    tube.weights[..n].fill(1.0);
    tube.weights[m] = 1e-5;
    let (equations, local) = (&workshop.equations, &tube.local);
    let norms = workshop
        .test
        .norms(equations, local, &tube.weights, 1.0)
        .expect("bounds");
    assert_eq!(norms.h, 1.0);
    let kept = workshop.test.kept();
    let (sample, mut random) = (Sample { tube, kept }, Random::new(46));
    for _ in 0..40 {
        check_norms(&figure, (&sample, &norms), &mut random, &mut ratios);
    }
    ratios.come_near(&[("|Ỹ F(ẑ)|", 0.15)]);
}

#[test]
fn full_bounds_dominate_exact_values() {
    let mut list = problems(&REGULAR);
    list.push(generated(Family::Strip, 31));
    check_all(list.into_iter().map(Case::new), 3, 41);
}

#[test]
fn full_bounds_dominate_exact_values_near_singular_places() {
    check_all(problems(&SINGULAR).into_iter().map(Case::new), 5, 42);
}
