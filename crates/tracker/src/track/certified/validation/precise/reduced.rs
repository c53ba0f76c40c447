//! Bounds of the reduced space along certified runs.

use super::super::reduced::right_hand_sides;
use super::big::{exact, horner};
use super::full::check_ball;
use super::view::View;
use super::*;
use crate::generate::Family;
use crate::interval::rounding::round_up;
use crate::linalg::LANE;
use crate::places::Each as _;
use crate::track::certified::link::Frame;
use crate::track::certified::tracker::Test;
use crate::track::reduced::certified::{Bounds, COEFFICIENTS};

/// What `ReducedTest::bounds` states for |s| ≤ H, at one s.
pub fn check_bounds(
    view: &View,
    (bounds, defect): &(Bounds, Vec<f64>),
    random: &mut Random,
    ratios: &mut Ratios,
) -> Option<()> {
    let (n, m) = (view.figure.n, view.figure.m);
    let y = &view.tube.local.y;
    let at = parameter(random, bounds.h);
    let s = Big::of(at);
    let x = at.abs() / bounds.h;
    let nothing = vec![Big::of(0.0); n];
    let (z, slope) = view.at(&s);

    // Φ'(0), and its change over the box. The sum of two bounds has a rounding of its own.
    let middle = view.derivative(&s, &nothing)?;
    let bound = round_up(bounds.constant + bounds.cubic * x.powi(3), 8);
    ratios.check("|Φ'(0)|", &view.norm_of(&middle), bound);
    let size = if random.below(2) == 0 {
        1.0
    } else {
        random.unit()
    };
    let v = view.in_box(random, size);
    let there = view.derivative(&s, &v)?;
    let change: Rows = (0..n)
        .map(|i| (0..n).map(|j| &there[i][j] - &middle[i][j]).collect())
        .collect();
    let bound = round_up(bounds.width * size, 1);
    ratios.check("|Φ'(v) − Φ'(0)|", &view.norm_of(&change), bound);

    // Φ(0), in the norm and row by row; its right-hand side's derivative; the turn.
    let k = view.k(&s);
    let w = view.sheared(&k, &v, false);
    let zw: Vec<Big> = z.iter().zip(&w).map(|(z, w)| z + w).collect();
    let (here, there) = (view.figure.jacobian(&z), view.figure.jacobian(&zw));
    let (mut g, f) = (Rows::new(), view.figure.residual(&z));
    for e in 0..m {
        let f_slope = dot(&here[e], &slope);
        let turn = dot(&there[e], &slope) - &f_slope;
        g.push(vec![f[e].clone(), f_slope, turn]);
    }
    g.push(vec![Big::of(0.0); 3]);
    let g = view.preconditioned(&s, &g)?;
    let column = |c: usize| -> Vec<Big> { g.iter().map(|row| row[c].clone()).collect() };
    let power = x.powi(COEFFICIENTS as i32);
    let bound = round_up(bounds.low + bounds.high * power, 40);
    ratios.check("|Φ(0)|", &view.norm(&column(0)), bound);
    for (value, &bound) in column(0).iter().zip(defect) {
        ratios.check("Φ(0), by row", &value.abs(), bound);
    }
    let high = COEFFICIENTS as f64 / bounds.h * bounds.high * x.powi(COEFFICIENTS as i32 - 1);
    let bound = round_up(bounds.low_slope + high, 60);
    ratios.check("|𝒴 F(ẑ)'|", &view.norm(&column(1)), bound);
    let bound = round_up(bounds.turn * size, 1);
    ratios.check("turn", &view.norm(&column(2)), bound);

    // K(s), its derivative and Z(s), entry by entry; what T makes of the box; the normal.
    let width = y.elimination.reduced.width;
    let entry = |rows: &[[f64; LANE]], i: usize, l: usize| rows[i * width + l / LANE][l % LANE];
    let k_slope = view.k_slope(&s);
    for (at, &i) in view.unknowns.iter().enumerate() {
        for l in 0..view.keys.len() {
            ratios.check("|K|", &k[at][l].abs(), entry(&y.k_size, i, l));
            ratios.check("|K'|", &k_slope[at][l].abs(), entry(&y.k_slope, i, l));
        }
    }
    for e in 0..n {
        for l in 0..view.keys.len() {
            let z = horner(&view.z_of(e, l), &s);
            ratios.check("|Z|", &z.abs(), entry(&y.z_size, e, l));
        }
    }
    let weights = exact(&view.tube.weights[..n]);
    let mut widest = exact(&y.rho[..n]);
    for (&i, row) in view.unknowns.iter().zip(&k) {
        for (k, &key) in row.iter().zip(&view.keys) {
            let along = k.abs() * Big::of(y.rho[key]);
            widest[i] += along;
        }
    }
    for (widest, weight) in widest.iter().zip(&weights) {
        ratios.check("the box's weights", &(widest / weight), 1.0);
    }
    for (slope, weight) in slope.iter().zip(&weights) {
        ratios.check("|ẑ'|", &(slope.abs() / weight), bounds.slope);
    }
    let c: Vec<Big> = exact(&view.tube.local.normal[..n])
        .iter()
        .map(Big::abs)
        .collect();
    let bound = round_up(bounds.normal, n + 2);
    ratios.check("|c|", &dot(&c, &weights), bound);
    Some(())
}

/// |A(s)⁻¹ g| row by row.
pub fn check_resolvent(
    view: &View,
    equations: &Equations,
    h: f64,
    random: &mut Random,
    ratios: &mut Ratios,
) -> Option<()> {
    let y = &view.tube.local.y;
    let s = Big::of(parameter(random, h));
    let g = right_hand_sides(random, view.rows.len());
    let sizes: Vec<[f64; LANE]> = g.iter().map(|g| g.each(f64::abs)).collect();
    let (mut work, mut bound) = (sizes.clone(), sizes.clone());
    let layout = &y.elimination.layout;
    y.resolvent
        .bound(equations, layout, &sizes, &mut work, &mut bound);
    let g = g.iter().map(|g| exact(g)).collect();
    for (v, bound) in solve(view.a(&s), g)?.iter().zip(&bound) {
        for (v, &bound) in v.iter().zip(bound) {
            let bound = round_up(bound, y.resolvent.roundings());
            ratios.check("|A⁻¹ g|", &v.abs(), bound);
        }
    }
    Some(())
}

/// How fast the extent of a point that stays changes, in a box so many times as large.
pub fn check_speed(
    view: &View,
    (h, factor, speed): (f64, f64, f64),
    random: &mut Random,
    ratios: &mut Ratios,
) {
    let s = Big::of(parameter(random, h));
    let (_, slope) = view.at(&s);
    let (k, k_slope) = (view.k(&s), view.k_slope(&s));
    let v = view.in_box(random, factor);
    // v_K' = −ẑ_K', v_A' = −ẑ_A' + K ẑ_K' − K' v_K.
    let mut change = view.sheared(&k, &slope, true);
    let moved: Vec<Big> = view.keys.iter().map(|&key| v[key].clone()).collect();
    for (&i, row) in view.unknowns.iter().zip(&k_slope) {
        change[i] += dot(row, &moved);
    }
    let name = if factor == 1.0 {
        "speed"
    } else {
        "speed in a large box"
    };
    ratios.check(name, &(view.norm(&change) / Big::of(factor)), speed);
}

/// What a proof for |s| ≤ h says of the path: its point, its direction, its t, where it is found.
pub fn check_path(view: &View, random: &mut Random, ratios: &mut Ratios) -> Option<()> {
    let (n, tube) = (view.figure.n, view.tube);
    let (proof, y) = (&tube.proof, &tube.local.y);
    let c = &tube.local.normal[..n];
    let at = parameter(random, proof.h);
    let s = Big::of(at);
    let (through, slope) = view.at(&s);
    let (z, tangent) = view.figure.point_near(&through, c)?;
    let k = view.k(&s);
    let away: Vec<Big> = z.iter().zip(&through).map(|(z, x)| z - x).collect();
    ratios.check(
        "distance",
        &view.norm(&view.sheared(&k, &away, true)),
        proof.distance,
    );
    let advance = dot(&exact(c), &slope);
    let turned: Vec<Big> = (0..n).map(|i| &tangent[i] * &advance - &slope[i]).collect();
    let turned = view.norm(&view.sheared(&k, &turned, true));
    ratios.check("slope_distance", &turned, proof.slope_distance);
    check_time(
        &tube.time(),
        (at, proof.h),
        (&z[n - 1], &(&tangent[n - 1] * &advance)),
        random,
        ratios,
    );

    // Φ' anywhere in the tube.
    let v = view.in_box(random, proof.r);
    ratios.check("q", &view.norm_of(&view.derivative(&s, &v)?), proof.q);

    // The extents of floats near the path, and anywhere in the tube.
    let minus = |a: &[Big], b: &[Big]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>();
    let mut check_extent = |name: &'static str, x: &[f64]| {
        let before = view.sheared(&k, &minus(&exact(x), &through), true);
        let entry = |i: usize| {
            let away = x[i] - tube.local.entry_at(i, at);
            let error = evaluation_error(&tube.local, i, at) + 2.0 * f64::EPSILON * away.abs();
            (away, error)
        };
        let stated = Frame::extent(y, &tube.weights[..n], at, entry, entry);
        ratios.check(name, &view.norm(&before), stated);
        before
    };
    let near: Vec<f64> = z.iter().map(Big::to_f64).collect();
    check_extent("extent", &near);
    let w = view.sheared(&k, &view.in_box(random, 0.9), false);
    let stays: Vec<f64> = through
        .iter()
        .zip(&w)
        .map(|(x, w)| (x + w).to_f64())
        .collect();
    let before = check_extent("extent of a point that stays", &stays);
    // It changes as s goes on.
    let step = 0.09 / y.speed * random.unit();
    let to = if at > 0.0 { at - step } else { at + step };
    if to.abs() <= proof.h {
        let there = Big::of(to);
        let away = minus(&exact(&stays), &view.at(&there).0);
        let after = view.sheared(&view.k(&there), &away, true);
        let most = (point(y.speed) * (point(to) - point(at)).abs()).sup();
        let change = view.norm(&minus(&after, &before));
        ratios.check("change of an extent", &change, most);
    }
    for (i, x) in through.iter().enumerate() {
        let error = (Big::of(tube.local.entry_at(i, at)) - x).abs();
        ratios.check(
            "ẑ(s) in floats",
            &error,
            evaluation_error(&tube.local, i, at),
        );
    }

    // The point is found at its own parameter.
    if let Some(between) = tube.locate(&ball_at(tube, &z)) {
        within("its own parameter", &s, between, ratios);
    }
    Some(())
}

/// t − 1 and t' against what is said of them around a parameter.
pub fn check_time(
    time: &crate::track::events::TimeAlong,
    (s, h): (f64, f64),
    (t, rate): (&Big, &Big),
    random: &mut Random,
    ratios: &mut Ratios,
) {
    let (lo, hi) = match random.below(2) {
        0 => (s, s),
        _ => (random.between(-h, s).min(s), random.between(s, h).max(s)),
    };
    let (values, slopes) = time.bounds(lo, hi);
    within("t", &(t - &Big::of(1.0)), values, ratios);
    within("t'", rate, slopes, ratios);
}

/// A number, and an interval that it is said to be in.
pub fn within(name: &'static str, x: &Big, (lo, hi): (f64, f64), ratios: &mut Ratios) {
    let middle = 0.5 * (lo + hi);
    assert!(
        Big::of(lo) <= *x && *x <= Big::of(hi),
        "{name}: {} not in [{lo:e}, {hi:e}]",
        x.to_f64()
    );
    let half = 0.5 * (hi - lo);
    let away = (x - &Big::of(middle)).abs();
    ratios.check(
        name,
        &away,
        half.next_up() + 2.0 * f64::EPSILON * middle.abs(),
    );
}

/// The exit's box, before and after it is tightened, and the next tube's entry. Whether it can be tightened.
pub fn check_exit(
    shop: &mut Shop,
    figure: &Figure,
    sample: &ReducedSample,
    next: Option<&ReducedSample>,
    ratios: &mut Ratios,
) -> Option<bool> {
    let (n, tube) = (figure.n, &sample.tube);
    let c = &tube.local.normal[..n];
    let (through, _) = at(tube, &Big::of(tube.exit_at));
    let (z, x) = figure.point_near(&through, c)?;
    check_ball("exit", &z, &tube.exit, ratios);
    if let Some(next) = next {
        check_entry(&next.tube, (&z, &x));
    }
    let mut tight = tube.clone();
    let tightened = shop.test.tighten_exit(&shop.equations, &mut tight);
    if tightened.is_none() {
        // What was proved before still is.
        check_ball("exit", &z, &tight.exit, ratios);
        return Some(false);
    }
    check_tied(figure, tube, &tight, ratios)?;
    Some(true)
}

/// The exit of a tube that was tightened: its point, its parameter, its tangent.
pub fn check_tied(
    figure: &Figure,
    tube: &ReducedTube,
    tight: &ReducedTube,
    ratios: &mut Ratios,
) -> Option<()> {
    let n = figure.n;
    let c = &tube.local.normal[..n];
    let (lo, hi) = tight.exit_between;
    assert!(tube.entry.1 < lo && lo <= hi && hi <= tube.exit_at);
    let through = exact(&tight.exit.centre[..n]);
    let (z, x) = figure.point_near(&through, c)?;
    assert!(
        is_between(tube, &z, (lo, hi)),
        "the tightened exit's parameter"
    );
    let advance = dot(&exact(c), &exact(&tight.exit_slope[..n]));
    for i in 0..n {
        let away = (&z[i] - &through[i]).abs();
        ratios.check("tightened exit", &away, tight.exit.radius[i]);
        let turned = (&x[i] * &advance - Big::of(tight.exit_slope[i])).abs();
        let bound = round_up(tight.exit_slope_radius * tight.weights[i], 1);
        ratios.check("tightened tangent", &turned, bound);
    }
    Some(())
}

/// Some tubes of a path, so often each, by a test with this α and tubes of at most this length: how many there were, and how many
/// of their exits can be tightened.
pub fn check_problem(
    case: &Case,
    (alpha, max_h): (f64, f64),
    (tubes, rounds): (usize, usize),
    random: &mut Random,
    ratios: &mut Ratios,
) -> [usize; 2] {
    let (homotopy, figure) = (&case.homotopy, &case.figure);
    let mut shop = Shop::with_alpha(homotopy, alpha, max_h);
    let chain = shop.chain(homotopy, 600);
    let mut counts = [0; 2];
    for k in spread(&chain, tubes) {
        let Proved { tube, kept } = &chain[k];
        let bounds = &kept.0;
        assert!(tube.proof.h <= bounds.h && tube.proof.r <= 1.0);
        let view = View::new(figure, tube);
        for _ in 0..rounds {
            check_path(&view, random, ratios).expect("a regular point");
            check_bounds(&view, kept, random, ratios).expect("a regular A");
            check_resolvent(&view, &shop.equations, bounds.h, random, ratios).expect("a regular A");
        }
        let tightened = check_exit(&mut shop, figure, &chain[k], chain.get(k + 1), ratios);
        counts[0] += 1;
        counts[1] += usize::from(tightened.expect("a regular point"));
        // The bounds are those of the test, whose box is that of the tube proved last.
        let mut again = chain[k].tube.clone();
        let h = again.proof.h * [1.0, 0.1, 1e-3][random.below(3)];
        let Some(kept) = shop.bounds_at(&mut again, h) else {
            continue;
        };
        let speed = again.local.y.speed;
        let view = View::new(figure, &again);
        for _ in 0..rounds {
            check_bounds(&view, &kept, random, ratios).expect("a regular A");
            check_resolvent(&view, &shop.equations, h, random, ratios).expect("a regular A");
            check_speed(&view, (h, 1.0, speed), random, ratios);
        }
    }
    counts
}

fn check_all(list: impl IntoIterator<Item = Case>, tubes: usize, seed: u64) -> Ratios {
    let (mut ratios, mut random) = (Ratios::default(), Random::new(seed));
    for case in list {
        let (how, counts) = ((0.1, f64::INFINITY), (effort(tubes), 2));
        let [tubes, _] = check_problem(&case, how, counts, &mut random, &mut ratios);
        assert!(tubes > 0, "{}", case.problem.name);
    }
    ratios
}

const NEAR: [(&str, f64); 11] = [
    ("|Φ'(0)|", 0.5),
    ("|Φ'(v) − Φ'(0)|", 0.3),
    ("|Φ(0)|", 0.5),
    ("turn", 0.2),
    ("|K|", 0.99),
    ("|Z|", 0.99),
    ("|A⁻¹ g|", 0.9),
    ("speed", 0.5),
    ("distance", 0.5),
    ("slope_distance", 0.3),
    ("t", 0.3),
];

#[test]
fn reduced_bounds_dominate_exact_values() {
    let mut list = problems(&REGULAR);
    list.extend([generated(Family::Chain, 48), generated(Family::Strip, 31)]);
    check_all(list.into_iter().map(Case::new), 4, 31).come_near(&NEAR);
}

#[test]
fn reduced_bounds_dominate_exact_values_near_singular_places() {
    let list = problems(&SINGULAR).into_iter().map(Case::new);
    check_all(list, 6, 32).come_near(&NEAR);
}

#[test]
fn reduced_bounds_dominate_exact_values_of_tails() {
    check_all(tails(51, 24), 4, 52).come_near(&NEAR);
}

#[test]
fn reduced_bounds_dominate_exact_values_of_mixed_kinds() {
    check_all(mixed(55, 30), 3, 56);
}
