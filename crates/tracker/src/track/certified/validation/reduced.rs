//! What is proved of single tubes in the reduced space, against interval matrices: 𝒴, T and the
//! bounds of `reduced/rounds.rs`, with A(s)⁻¹ from a dense verified solution.

use super::super::link::{Ball, Frame};
use super::super::tracker::Test;
use super::disguise::Disguised;
use super::*;
use crate::interval::rounding::round_up;
use crate::linalg::LANE;
use crate::places::{Each as _, array};
use crate::track::reduced::certified::{COEFFICIENTS, ReducedTest};
use crate::track::{Options, Space};

pub type ReducedFrame = <ReducedTest as Test<COEFFICIENTS>>::Frame;
pub type ReducedTube = Tube<COEFFICIENTS, ReducedFrame>;

/// The bounds that a proof was made of.
#[derive(Debug, Clone, Copy)]
pub struct Stated {
    constant: f64,
    cubic: f64,
    width: f64,
    low: f64,
    high: f64,
    h: f64,
}

pub struct Proved {
    pub tube: ReducedTube,
    stated: Stated,
}

/// How near the true values come to what is stated, and how many there were.
#[derive(Debug, Default)]
struct Tally {
    tubes: usize,
    most_keys: usize,
    points: usize,
    unresolved: usize,
    tightened: usize,
    untied: usize,
    located: usize,
    middle: f64,
    contraction: f64,
    defect: f64,
    distance: f64,
    slope: f64,
    resolvent: f64,
    speed: f64,
    extent: f64,
    tight: f64,
}

fn raise(max: &mut f64, x: f64) {
    *max = max.max(x);
}

impl Proved {
    fn n(&self) -> usize {
        self.tube.weights.len() - 1
    }

    pub fn keys(&self) -> Vec<usize> {
        let layout = &self.tube.local.y.elimination.layout;
        layout.keys.iter().map(|&k| k as usize).collect()
    }

    /// A's unknowns and A's rows, in their order.
    pub fn inner(&self) -> (Vec<usize>, Vec<usize>) {
        let blocks = || self.tube.local.y.elimination.layout.blocks.iter();
        (
            blocks()
                .flat_map(|b| b.unknowns[..b.size].iter().map(|&i| i as usize))
                .collect(),
            blocks()
                .flat_map(|b| b.rows[..b.size].iter().map(|&e| e as usize))
                .collect(),
        )
    }

    /// Rows of numbers per key unknown, of a polynomial whose coefficients have one row each for
    /// many indices.
    fn polynomial(&self, rows: [&[[f64; LANE]]; 3], i: usize, s: f64) -> Vec<Interval> {
        let width = self.tube.local.y.elimination.reduced.width;
        let entry = |q: usize, l: usize| point(rows[q][i * width + l / LANE][l % LANE]);
        let s = point(s);
        (0..self.keys().len())
            .map(|l| entry(0, l) + s * (entry(1, l) + s * entry(2, l)))
            .collect()
    }

    fn k(&self, i: usize, s: f64) -> Vec<Interval> {
        let y = &self.tube.local.y;
        self.polynomial([&y.elimination.reduced.k, &y.k[0], &y.k[1]], i, s)
    }

    fn z(&self, e: usize, s: f64) -> Vec<Interval> {
        let y = &self.tube.local.y;
        self.polynomial([&y.z[0], &y.z[1], &y.z[2]], e, s)
    }

    /// T(s) v, or with the sign −1 its inverse times v.
    fn sheared(&self, v: &[Interval], s: f64, sign: f64) -> Vec<Interval> {
        let (keys, mut out) = (self.keys(), v.to_vec());
        for i in self.inner().0 {
            for (k, &key) in self.k(i, s).iter().zip(&keys) {
                out[i] += point(sign) * *k * v[key];
            }
        }
        out
    }

    /// A lower bound of |v|_ρ.
    fn norm(&self, v: &[Interval]) -> f64 {
        let rho = &self.tube.local.y.rho;
        v.iter()
            .zip(rho.iter())
            .fold(0.0, |max, (v, &rho)| (v.abs() / point(rho)).inf().max(max))
    }

    /// 𝒴(s) g for columns g, a row per equation: a row per unknown.
    fn preconditioned(&self, exact: &Exact, g: &Rows, s: f64) -> Option<Rows> {
        let ((unknowns, rows), columns) = (self.inner(), g[0].len());
        let jacobian = exact.bordered(&middle(&self.tube, s), &self.tube.local.normal);
        let a: Rows = rows
            .iter()
            .map(|&e| unknowns.iter().map(|&i| jacobian[e][i]).collect())
            .collect();
        let g_a: Rows = rows.iter().map(|&e| g[e].clone()).collect();
        let inner = solved(&a, &g_a)?;
        let mut out = vec![vec![point(0.0); columns]; self.n()];
        for (&i, row) in unknowns.iter().zip(inner) {
            out[i] = row;
        }
        let keys = self.keys();
        for (e, g) in g.iter().enumerate() {
            for (z, &key) in self.z(e, s).iter().zip(&keys) {
                for (out, g) in out[key].iter_mut().zip(g) {
                    *out += *z * *g;
                }
            }
        }
        Some(out)
    }

    /// A lower bound of |Φ'(v)|_ρ.
    fn contraction(&self, exact: &Exact, s: f64, v: &[f64]) -> Option<f64> {
        let n = self.n();
        let v: Vec<Interval> = v.iter().map(|&v| point(v)).collect();
        let w = self.sheared(&v, s, 1.0);
        let there = middle(&self.tube, s);
        let z: Vec<Interval> = there.iter().zip(&w).map(|(z, w)| *z + *w).collect();
        let mut rows = exact.bordered(&z, &self.tube.local.normal);
        // J T: what hangs on the key unknowns is added to their columns.
        let (keys, inner) = (self.keys(), self.inner().0);
        let k: Rows = inner.iter().map(|&i| self.k(i, s)).collect();
        for row in &mut rows {
            for (l, &key) in keys.iter().enumerate() {
                for (k, &i) in k.iter().zip(&inner) {
                    let along = row[i] * k[l];
                    row[key] += along;
                }
            }
        }
        let product = self.preconditioned(exact, &rows, s)?;
        let rho = &self.tube.local.y.rho;
        let norm = (0..n).map(|i| {
            let sum = (0..n).fold(point(0.0), |sum, j| {
                let one = point(if i == j { 1.0 } else { 0.0 });
                sum + (one - product[i][j]).abs() * point(rho[j])
            });
            (sum / point(rho[i])).inf()
        });
        Some(norm.fold(0.0, f64::max))
    }
}

/// Encloses A⁻¹ G. `None`: A is too near a singular matrix.
fn solved(a: &Rows, g: &Rows) -> Option<Rows> {
    let n = a.len();
    let columns = g.first().map_or(0, Vec::len);
    if n == 0 {
        return Some(Vec::new());
    }
    let inverse = DMatrix::from_fn(n, n, |i, j| a[i][j].mid()).try_inverse()?;
    let times = |rows: &Rows| -> Rows {
        let count = rows[0].len();
        (0..n)
            .map(|i| {
                let mut sums = vec![point(0.0); count];
                for (k, row) in rows.iter().enumerate() {
                    let factor = point(inverse[(i, k)]);
                    for (sum, x) in sums.iter_mut().zip(row) {
                        *sum += factor * *x;
                    }
                }
                sums
            })
            .collect()
    };
    let near = times(g);
    let product = times(a);
    let norm = (0..n)
        .map(|i| {
            let sum = (0..n).fold(point(0.0), |sum, j| {
                sum + (product[i][j] - point(if i == j { 1.0 } else { 0.0 })).abs()
            });
            sum.sup()
        })
        .fold(0.0, f64::max);
    if norm >= 0.5 {
        return None;
    }
    // x = y + (I − B A) x with y = B G: |x − y| ≤ |I − B A| |y| / (1 − |I − B A|), column by column.
    let mut out = near.clone();
    for c in 0..columns {
        let size = near.iter().fold(0.0f64, |max, row| max.max(row[c].mag()));
        let error = (point(norm) * point(size) / (point(1.0) - point(norm))).sup();
        for row in &mut out {
            row[c] += hull(-error, error);
        }
    }
    Some(out)
}

/// So many rows of right-hand sides, full or with few entries.
pub fn right_hand_sides(random: &mut Random, rows: usize) -> Vec<[f64; LANE]> {
    let sparse = random.below(2) == 0;
    let mut entry = || match sparse && random.below(4) > 0 {
        true => 0.0,
        false => random.between(-1.0, 1.0),
    };
    let row = |_| array(|_| entry());
    (0..rows).map(row).collect()
}

pub struct Shop {
    pub equations: Equations,
    inverter: InverseMaker,
    pub test: ReducedTest,
    max_h: f64,
}

impl Shop {
    pub fn new(homotopy: &Homotopy, alpha: f64, max_h: f64) -> Self {
        let equations = Equations::new(homotopy);
        let options = Options {
            space: Space::Reduced,
            alpha,
            ..Options::certified()
        };
        Shop {
            inverter: equations.inverter(),
            test: ReducedTest::new(homotopy, &equations, &options),
            equations,
            max_h,
        }
    }

    pub fn tube(&mut self, z: &[f64], normal: &[f64], first: bool) -> Option<Proved> {
        let n = self.equations.n();
        let mut tube = Tube::new(&self.equations);
        tube.local.z[0][..n].copy_from_slice(&z[..n]);
        tube.local.normal[..n].copy_from_slice(&normal[..n]);
        let (test, equations) = (&mut self.test, &self.equations);
        test.refine(equations, &mut tube.local, 1e-9).ok()?;
        test.expand(equations, &mut tube.local).ok()?;
        if first {
            test.prepare(equations, &mut tube, self.max_h);
        }
        if !test.prove(equations, &mut tube, self.max_h) {
            return None;
        }
        let [constant, cubic, width, low, high, h] = test.stated();
        tube.exit_at = 0.97 * tube.proof.h;
        test.enclose_exit(equations, &mut tube)?;
        test.accept(&tube);
        let stated = Stated {
            constant,
            cubic,
            width,
            low,
            high,
            h,
        };
        Some(Proved { tube, stated })
    }

    /// Linked tubes from the sketch on, at most `count`.
    pub fn chain(&mut self, homotopy: &Homotopy, count: usize) -> Vec<Proved> {
        let first = at_sketch(homotopy, &self.equations, &mut self.inverter)
            .and_then(|local| self.tube(&local.z[0], &local.normal, true));
        let Some(first) = first else {
            return Vec::new();
        };
        let room = self.equations.vector();
        chain(
            first,
            (count, 0.85),
            room,
            |sample| &sample.tube,
            |last, z, normal| {
                let next = self.tube(z, normal, false).and_then(|mut next| {
                    next.tube.entry = last.tube.leads_to(&next.tube)?;
                    Some(next)
                });
                if next.is_none() {
                    self.test.reject();
                }
                next
            },
        )
    }
}

fn check_tube(exact: &Exact, sample: &Proved, random: &mut Random, tally: &mut Tally) {
    let n = exact.n;
    let (tube, stated) = (&sample.tube, &sample.stated);
    let (proof, y) = (&tube.proof, &tube.local.y);
    let c = &tube.local.normal[..n];
    assert!(proof.h <= stated.h && proof.r <= 1.0);
    tally.tubes += 1;
    tally.most_keys = tally.most_keys.max(sample.keys().len());
    // The bounds hold for all |s| ≤ H; what is made of them for |s| ≤ h.
    let any = |random: &mut Random, h: f64| match random.below(4) {
        0 => h,
        1 => -h,
        2 => random.between(-h, h),
        _ => 1e-3 * random.between(-h, h),
    };

    // Φ' at the middle, and Φ there.
    let s = any(random, stated.h);
    let x = s.abs() / stated.h;
    let Some(norm) = sample.contraction(exact, s, &vec![0.0; n]) else {
        tally.unresolved += 1;
        return;
    };
    let bound = stated.constant + stated.cubic * x.powi(3);
    assert!(norm <= bound, "|Φ'(0)| ≥ {norm} > {bound} at {x} of H");
    raise(&mut tally.middle, norm / bound);
    let mut f = exact.residual(&middle(tube, s));
    f.push(point(0.0));
    let f: Rows = f.into_iter().map(|f| vec![f]).collect();
    if let Some(step) = sample.preconditioned(exact, &f, s) {
        let defect = sample.norm(&step.iter().map(|row| row[0]).collect::<Vec<_>>());
        let bound = round_up(stated.low + stated.high * x.powi(COEFFICIENTS as i32), 40);
        assert!(defect <= bound, "|Φ(0)| ≥ {defect} > {bound} at {x} of H");
        raise(&mut tally.defect, defect / bound);
    }

    // Φ' in the box, at its corners and elsewhere.
    let s = any(random, proof.h);
    let size = [1.0, 1.0, random.unit()][random.below(3)] * proof.r * (1.0 - 1e-15);
    let v: Vec<f64> = (0..n)
        .map(|i| random.sign() * size * y.rho[i] * [1.0, random.unit()][random.below(2)])
        .collect();
    if let Some(norm) = sample.contraction(exact, s, &v) {
        assert!(norm <= proof.q, "|Φ'| ≥ {norm} > {}", proof.q);
        raise(&mut tally.contraction, norm / proof.q);
        let x = s.abs() / stated.h;
        let bound = stated.constant + stated.cubic * x.powi(3) + stated.width * size;
        assert!(norm <= round_up(bound, 10), "|Φ'| ≥ {norm} > {bound}");
    }
    let weights = &tube.weights;
    let box_: Vec<Interval> = (0..n).map(|i| hull(-y.rho[i], y.rho[i])).collect();
    for (i, w) in sample.sheared(&box_, s, 1.0).iter().enumerate() {
        let corner = (point(w.sup()) / point(weights[i])).inf();
        assert!(corner <= 1.0 + 1e-12, "the box is wider than its weights");
    }

    // |A(s)⁻¹ g|.
    let layout = &*y.elimination.layout;
    let (unknowns, rows) = sample.inner();
    if !rows.is_empty() {
        let s = any(random, stated.h);
        let jacobian = exact.bordered(&middle(tube, s), c);
        let a: Rows = rows
            .iter()
            .map(|&e| unknowns.iter().map(|&i| jacobian[e][i]).collect())
            .collect();
        let g = right_hand_sides(random, rows.len());
        let sizes: Vec<[f64; LANE]> = g.iter().map(|g| g.each(f64::abs)).collect();
        let (mut work, mut bound) = (sizes.clone(), sizes.clone());
        y.resolvent.bound(
            &exact_equations(exact),
            layout,
            &sizes,
            &mut work,
            &mut bound,
        );
        let g: Rows = g
            .iter()
            .map(|g| g.iter().map(|&g| point(g)).collect())
            .collect();
        if let Some(v) = solved(&a, &g) {
            for (v, bound) in v.iter().zip(&bound) {
                for (v, &bound) in v.iter().zip(bound) {
                    let bound = round_up(bound, y.resolvent.roundings());
                    assert!(v.abs().inf() <= bound, "|A⁻¹ g| ≥ {v:?} > {bound}");
                    if bound > 0.0 {
                        raise(&mut tally.resolvent, v.abs().inf() / bound);
                    }
                }
            }
        }
    }

    // The path's point and direction.
    let s = any(random, proof.h);
    let (through, slope) = (middle(tube, s), slope(tube, s));
    let start: Vec<f64> = through.iter().map(|x| x.mid()).collect();
    let Some((z, tangent)) = exact.point_near(&start, c, &through) else {
        tally.unresolved += 1;
        return;
    };
    tally.points += 1;
    let away: Vec<Interval> = (0..n).map(|i| z[i] - through[i]).collect();
    let distance = sample.norm(&sample.sheared(&away, s, -1.0));
    assert!(
        distance <= proof.distance,
        "the path is {distance} away, not {}",
        proof.distance
    );
    raise(&mut tally.distance, distance / proof.distance);
    let advance = (0..n).fold(point(0.0), |sum, i| sum + point(c[i]) * slope[i]);
    let turned: Vec<Interval> = (0..n).map(|i| tangent[i] * advance - slope[i]).collect();
    let turned = sample.norm(&sample.sheared(&turned, s, -1.0));
    assert!(
        turned <= proof.slope_distance,
        "the slope is {turned} away, not {}",
        proof.slope_distance
    );
    raise(&mut tally.slope, turned / proof.slope_distance);
    let mut ball = tube.exit.clone();
    for i in 0..n {
        (ball.centre[i], ball.radius[i]) = (z[i].mid(), z[i].rad());
    }
    if let Some((lo, hi)) = tube.locate(&ball) {
        assert!(lo <= s && s <= hi, "located in [{lo}, {hi}], not at {s}");
        tally.located += 1;
    }

    // The extent of a point that stays while s goes on.
    let v: Vec<Interval> = (0..n)
        .map(|i| point(0.9 * random.between(-1.0, 1.0) * y.rho[i]))
        .collect();
    let w = sample.sheared(&v, s, 1.0);
    let fixed: Vec<f64> = (0..n).map(|i| (through[i] + w[i]).mid()).collect();
    let extent = |s: f64| {
        let there = middle(tube, s);
        let away: Vec<Interval> = (0..n).map(|i| point(fixed[i]) - there[i]).collect();
        let entry = |i: usize| {
            let away = fixed[i] - tube.local.entry_at(i, s);
            let error = evaluation_error(&tube.local, i, s);
            (away, error + 2.0 * f64::EPSILON * away.abs())
        };
        let stated = y.extent(&weights[..n], s, entry, entry);
        (sample.sheared(&away, s, -1.0), stated)
    };
    let (before, stated_extent) = extent(s);
    let true_extent = sample.norm(&before);
    assert!(true_extent <= stated_extent);
    raise(&mut tally.extent, true_extent / stated_extent);
    let step = 0.09 / y.speed * random.unit();
    let to = if s > 0.0 { s - step } else { s + step };
    if to.abs() <= proof.h {
        let change: Vec<Interval> = extent(to)
            .0
            .iter()
            .zip(&before)
            .map(|(a, b)| *a - *b)
            .collect();
        let change = sample.norm(&change);
        let most = (point(y.speed) * (point(to) - point(s)).abs()).sup();
        assert!(change <= most, "an extent changes by {change} > {most}");
        raise(&mut tally.speed, change / most);
    }
}

fn exact_equations(exact: &Exact) -> Equations {
    Equations::new(exact.homotopy)
}

/// The exit's box holds the path's point, before and after it is tightened; the next tube's entry.
fn check_link(
    shop: &mut Shop,
    exact: &Exact,
    sample: &Proved,
    next: Option<&Proved>,
    tally: &mut Tally,
) {
    let (n, c) = (exact.n, &sample.tube.local.normal[..exact.n]);
    let through = middle(&sample.tube, sample.tube.exit_at);
    let start: Vec<f64> = through.iter().map(|x| x.mid()).collect();
    let Some((z, x)) = exact.point_near(&start, c, &through) else {
        tally.unresolved += 1;
        return;
    };
    let in_ball = |z: &[Interval], ball: &Ball| {
        for i in 0..n {
            let away = (z[i] - point(ball.centre[i])).abs().inf();
            assert!(away <= ball.radius[i], "entry {i} of the exit: {away}");
        }
    };
    in_ball(&z, &sample.tube.exit);
    if let Some(next) = next {
        check_entry(&next.tube, (&z, &x));
    }
    let mut tight = sample.tube.clone();
    if shop
        .test
        .tighten_exit(&shop.equations, &mut tight)
        .is_none()
    {
        tally.untied += 1;
        // What was proved before still is.
        in_ball(&z, &tight.exit);
        return;
    }
    tally.tightened += 1;
    let (lo, hi) = tight.exit_between;
    assert!(tight.entry.1 < lo && hi <= tight.exit_at);
    let through: Vec<Interval> = (0..n).map(|i| point(tight.exit.centre[i])).collect();
    let Some((z, x)) = exact.point_near(&tight.exit.centre, c, &through) else {
        tally.unresolved += 1;
        return;
    };
    in_ball(&z, &tight.exit);
    let advance = (0..n).fold(point(0.0), |sum, i| {
        sum + point(c[i]) * point(tight.exit_slope[i])
    });
    for i in 0..n {
        let away = (x[i] * advance - point(tight.exit_slope[i])).abs().inf();
        let most = tight.exit_slope_radius * tight.weights[i];
        assert!(away <= most, "entry {i} of the tangent: {away} > {most}");
        raise(&mut tally.tight, away / most);
    }
}

fn check_problem(
    homotopy: &Homotopy,
    (alpha, max_h): (f64, f64),
    (tubes, rounds): (usize, usize),
    random: &mut Random,
    tally: &mut Tally,
) {
    let exact = Exact::new(homotopy);
    let mut shop = Shop::new(homotopy, alpha, max_h);
    let chain = shop.chain(homotopy, 600);
    let stride = (chain.len() / tubes).max(1);
    for k in (0..chain.len()).step_by(stride) {
        for _ in 0..rounds {
            check_tube(&exact, &chain[k], random, tally);
        }
        check_link(&mut shop, &exact, &chain[k], chain.get(k + 1), tally);
    }
}

#[test]
fn reduced_proofs_hold_along_the_shipped_problems() {
    let mut tally = Tally::default();
    let mut random = Random::new(21);
    for problem in shipped() {
        let homotopy = Homotopy::new(&problem).expect("a gauge");
        for how in [(0.1, f64::INFINITY), (0.4, f64::INFINITY), (0.1, 1e-3)] {
            check_problem(&homotopy, how, (10, 6), &mut random, &mut tally)
        }
    }
    println!("{tally:?}");
    assert!(tally.unresolved * 20 < tally.points, "{tally:?}");
    // A bound that nothing comes near says little about the proof.
    assert!(tally.middle > 0.3 && tally.defect > 0.1, "{tally:?}");
}

#[test]
fn reduced_proofs_hold_along_random_problems() {
    let mut tally = Tally::default();
    let mut random = Random::new(22);
    for round in 0..effort(60) {
        let dimension = 2 + round % 2;
        let points = 2 + random.below(6) + usize::from(dimension == 3);
        let change = [0.1, 0.5, 1e-6][random.below(3)];
        let problem = random_problem(&mut random, dimension, points, change);
        let alpha = [0.05, 0.1, 0.2, 0.4][random.below(4)];
        let how = (alpha, [f64::INFINITY, 1e-2][random.below(2)]);
        // Every other problem in other words.
        let homotopy = if round % 4 < 2 {
            Homotopy::new(&problem).ok()
        } else {
            Disguised::new(&problem, 0.7, &mut random).homotopy()
        };
        let Some(homotopy) = homotopy else { continue };
        check_problem(&homotopy, how, (8, 4), &mut random, &mut tally)
    }
    println!("{tally:?}");
    assert!(
        tally.tubes > 200 && tally.tightened > 50 && tally.unresolved * 20 < tally.points,
        "{tally:?}"
    );
}

#[test]
fn reduced_proofs_hold_along_problems_of_mixed_kinds() {
    let mut tally = Tally::default();
    let mut random = Random::new(24);
    for round in 0..effort(40) {
        let dimension = 2 + round % 2;
        let homotopy = Homotopy::new(&mixed_problem(&mut random, dimension)).unwrap();
        let alpha = [0.05, 0.1, 0.2, 0.4][random.below(4)];
        let how = (alpha, [f64::INFINITY, 1e-2][random.below(2)]);
        check_problem(&homotopy, how, (8, 4), &mut random, &mut tally)
    }
    println!("{tally:?}");
    assert!(
        tally.tubes > 100 && tally.unresolved * 20 < tally.points,
        "{tally:?}"
    );
}

#[test]
fn false_links_are_refused_in_the_reduced_space() {
    fn sabotage(problem: &Problem, random: &mut Random, tally: &mut [usize; 4]) {
        let homotopy = Homotopy::new(problem).unwrap();
        let exact = Exact::new(&homotopy);
        let mut shop = Shop::new(&homotopy, 0.1, f64::INFINITY);
        let chain = shop.chain(&homotopy, 400);
        let n = exact.n;
        let stride = (chain.len() / 20).max(1);
        for k in (0..chain.len() - 1).step_by(stride) {
            let (from, next) = (&chain[k], &chain[k + 1]);
            assert!(link_is_true(
                &exact,
                &from.tube,
                &next.tube,
                next.tube.entry
            ));
            let (z, normal) = (&next.tube.local.z[0], &next.tube.local.normal);
            let flip = |v: &[f64]| mirrored(&homotopy, v);
            let back: Vec<f64> = normal[..n].iter().map(|c| -c).collect();
            let mut others = vec![(0, z[..n].to_vec(), back), (1, flip(z), flip(normal))];
            for spread in [1e-3, 0.1, 0.5, 1.0] {
                let shifted = z[..n]
                    .iter()
                    .map(|z| z + spread * random.between(-1.0, 1.0));
                others.push((2, shifted.collect(), normal[..n].to_vec()));
            }
            for (kind, z, normal) in others {
                let Some(other) = shop.tube(&z, &normal, false) else {
                    shop.test.reject();
                    continue;
                };
                tally[kind] += 1;
                let is_linked = leads_truly(&exact, &from.tube, &other.tube);
                assert!(
                    kind != 0 || !is_linked,
                    "a link to a tube that runs backwards"
                );
            }
            let others = chain.iter();
            tally[3] += others
                .filter(|other| leads_truly(&exact, &from.tube, &other.tube))
                .count();
        }
    }
    let (mut tally, mut random) = ([0; 4], Random::new(23));
    for problem in shipped() {
        sabotage(&problem, &mut random, &mut tally)
    }
    println!("{tally:?}");
    assert!(tally.iter().all(|&count| count > 30), "{tally:?}");
}
