//! Folds and orientations of edits in 256 bits: the box around a fold, its test's bounds, and signs that are kept.

use super::*;
use crate::track::arc::{ArcEnd, Fold};
use crate::track::certified::arcs;
use crate::track::certified::fold::FoldProver;
use crate::track::{Control, Options};

/// The Jacobian of Φ = (F, J v, c·v − 1) at (X, t, v).
fn jacobian(figure: &Figure, z: &[Big], v: &[Big], c: &[f64]) -> Rows {
    let m = figure.m;
    let (j, turned) = (figure.jacobian(z), figure.change_of_jacobian(v));
    let zero = || Big::of(0.0);
    let mut rows: Rows = Vec::new();
    for row in &j {
        let mut out = row.clone();
        out.extend((0..m).map(|_| zero()));
        rows.push(out);
    }
    for (turned, row) in turned.iter().zip(&j) {
        let mut out = turned[..m].to_vec();
        out.push(zero());
        out.extend_from_slice(&row[..m]);
        rows.push(out);
    }
    let mut last: Vec<Big> = (0..=m).map(|_| zero()).collect();
    last.extend(exact(&c[..m]));
    rows.push(last);
    rows
}

/// Φ.
fn residual(figure: &Figure, z: &[Big], v: &[Big], c: &[f64]) -> Vec<Big> {
    let m = figure.m;
    let mut out = figure.residual(z);
    let j = figure.jacobian(z);
    out.extend(j.iter().map(|row| dot(&row[..m], &v[..m])));
    out.push(dot(&exact(&c[..m]), &v[..m]) - Big::of(1.0));
    out
}

/// The zero of Φ that Newton's method finds from a point.
fn zero_near(figure: &Figure, x: &[Big], c: &[f64]) -> Option<Vec<Big>> {
    let m = figure.m;
    let mut x = x.to_vec();
    for _ in 0..60 {
        let (z, v) = x.split_at(m + 1);
        let right = residual(figure, z, v, c).into_iter().map(|f| vec![f]);
        let step = solve(jacobian(figure, z, v, c), right.collect())?;
        let mut size = Big::of(0.0);
        for (x, step) in x.iter_mut().zip(&step) {
            *x -= step[0].clone();
            size = size.max(step[0].abs());
        }
        if size < Big::of(1e-60) {
            return Some(x);
        }
        if size > Big::of(1e6) {
            return None;
        }
    }
    None
}

/// The middle of a fold's box: X, t and v.
fn middle(fold: &Fold) -> Vec<Big> {
    let mut x = exact(&fold.figure.centre);
    x.push(Big::of(fold.t.mid()));
    x.extend(exact(&fold.velocity));
    x
}

fn check_box(figure: &Figure, fold: &Fold, random: &mut Random, ratios: &mut Ratios) {
    let (m, c) = (figure.m, &fold.normal);
    let centre = middle(fold);
    let zero = zero_near(figure, &centre, c).expect("a fold is a regular zero");
    for i in 0..m {
        let away = (&zero[i] - &centre[i]).abs();
        ratios.check("the figure at a fold", &away, fold.figure.radius[i]);
        let away = (&zero[m + 1 + i] - &centre[m + 1 + i]).abs();
        ratios.check("the velocity at a fold", &away, fold.velocity_radius[i]);
    }
    assert!(zero[m].is_in(fold.t), "t at a fold");
    // No other zero is as near as that.
    for _ in 0..4 {
        let off = |x: &Big, random: &mut Random| {
            x + &Big::of(fold.alone_within * random.between(-1.0, 1.0))
        };
        let from: Vec<Big> = centre.iter().map(|x| off(x, random)).collect();
        if let Some(other) = zero_near(figure, &from, c) {
            let pairs = other.iter().zip(&centre).map(|(x, y)| (x - y).abs());
            let apart = pairs.fold(Big::of(0.0), Big::max);
            let pairs = other.iter().zip(&zero).map(|(x, y)| (x - y).abs());
            let same = pairs.fold(Big::of(0.0), Big::max) < Big::of(1e-50);
            assert!(same || apart > Big::of(fold.alone_within), "another fold");
        }
    }
}

/// |I − Y Φ'(x + w)| ≤ q₀ + κ |w| in the norm of the largest entry.
fn check_contraction(
    (figure, homotopy): (&Figure, &Homotopy),
    fold: &Fold,
    random: &mut Random,
    ratios: &mut Ratios,
) {
    let m = figure.m;
    let mut equations = Equations::new(homotopy);
    equations.set_rights(homotopy);
    let mut prover = FoldProver::new(&equations);
    let (mut x, mut v) = (equations.vector(), equations.vector());
    x[..m].copy_from_slice(&fold.figure.centre);
    x[m] = fold.t.mid();
    v[..m].copy_from_slice(&fold.velocity);
    let mut normal = equations.vector();
    normal[..m].copy_from_slice(&fold.normal);
    let again = prover.prove(&equations, homotopy, (&x, &v), &normal);
    let again = again.expect("what was proved is proved again");
    let (y, (q0, kappa)) = prover.test();
    let n = 2 * m + 1;
    let centre = middle(&again);
    for round in 0..3 {
        let size = [0.0, 1e-3, 1.0][round] * again.alone_within;
        let moved = |x: &Big, random: &mut Random| {
            let sign = if random.below(2) == 0 { -1.0 } else { 1.0 };
            x + &Big::of(size * sign)
        };
        let at: Vec<Big> = centre.iter().map(|x| moved(x, random)).collect();
        // Where |t| may be larger by 1 at most.
        let (z, v) = at.split_at(m + 1);
        let rows = jacobian(figure, z, v, &fold.normal);
        for i in 0..n {
            let mut sum = Big::of(0.0);
            for k in 0..n {
                let product: Big = (0..n).map(|j| &Big::of(y.get(i, j)) * &rows[j][k]).sum();
                let one = Big::of(f64::from(u8::from(i == k)));
                sum += (one - product).abs();
            }
            ratios.check(
                "the contraction at a fold",
                &sum,
                q0 + kappa * size * (1.0 + 1e-15),
            );
        }
    }
}

/// Signs that are kept, at points of the path at many t.
fn check_signs(
    figure: &Figure,
    homotopy: &Homotopy,
    (from, until): (Vec<Big>, f64),
    kept: &[(Vec<usize>, i8)],
) -> usize {
    const STEPS: usize = 40;
    let m = figure.m;
    let mut c = vec![0.0; m + 1];
    c[m] = 1.0;
    let (mut z, mut seen) = (from, 0);
    for k in 0..=STEPS {
        z[m] = Big::of(until * (k as f64 / STEPS as f64) * (1.0 - 1e-6));
        let Some((point, _)) = figure.point_near(&z, &c) else {
            return seen;
        };
        let moved = point.iter().zip(&z).map(|(x, y)| (x - y).abs());
        // As Newton's method may come to another branch near a fold.
        if k > 0 && moved.fold(Big::of(0.0), Big::max) > Big::of(0.2) {
            return seen;
        }
        z = point;
        let at = |p: usize, axis: usize| match homotopy.coordinate(p, axis) {
            Some(i) => z[i].clone(),
            None => Big::of(0.0),
        };
        for (points, sign) in kept {
            let side = |k: usize, axis: usize| at(points[k], axis) - at(points[0], axis);
            let minor = |k: usize, l: usize, a: usize, b: usize| {
                side(k, a) * side(l, b) - side(k, b) * side(l, a)
            };
            let value = match points.len() {
                3 => minor(1, 2, 0, 1),
                _ => {
                    side(1, 0) * minor(2, 3, 1, 2)
                        + side(1, 1) * minor(2, 3, 2, 0)
                        + side(1, 2) * minor(2, 3, 0, 1)
                }
            };
            assert_eq!(value > Big::of(0.0), *sign > 0, "{points:?} at step {k}");
            seen += 1;
        }
    }
    seen
}

fn check(case: &Case, random: &mut Random, ratios: &mut Ratios) -> (bool, usize) {
    let (homotopy, figure) = (&case.homotopy, &case.figure);
    let start = crate::track::arc::Figure::of_sketch(homotopy);
    let mut arcs = arcs(homotopy.clone(), &Options::certified());
    let run = arcs.follow(&start, &mut Control::default());
    let kept = run.orientations.iter();
    let kept = kept.filter(|o| o.sign != 0 && o.lost.is_none());
    let kept: Vec<_> = kept.map(|o| (o.points.clone(), o.sign)).collect();
    let mut from = exact(&start.centre);
    from.push(Big::of(0.0));
    let seen = check_signs(figure, homotopy, (from, run.t.0), &kept);
    let ArcEnd::Limit(fold) = &run.end else {
        return (false, seen);
    };
    check_box(figure, fold, random, ratios);
    check_contraction((figure, homotopy), fold, random, ratios);
    (true, seen)
}

#[test]
fn folds_and_kept_signs_hold_in_256_bits() {
    let mut random = Random::new(1414);
    let (mut ratios, mut folds, mut signs) = (Ratios::default(), 0, 0);
    let mut all = tails(77, 8);
    for round in 0..24 {
        let dimension = 2 + round % 2;
        let points = dimension + 1 + random.below(3);
        let problem = random_problem(&mut random, dimension, points, 0.3);
        all.push(Case::new(problem));
    }
    for case in &all {
        let (is_fold, seen) = check(case, &mut random, &mut ratios);
        folds += usize::from(is_fold);
        signs += seen;
    }
    assert!(folds >= 8 && signs > 500, "{folds} folds, {signs} signs");
    // Radii hold rounding of intervals; κ holds for every direction.
    ratios.come_near(&[
        ("the figure at a fold", 1e-3),
        ("the contraction at a fold", 1e-2),
    ]);
}
