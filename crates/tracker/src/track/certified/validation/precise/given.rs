//! What a run is given: lengths and sketches in floats, against those of the problem in 256 bits.

use super::super::disguise::Disguised;
use super::*;
use crate::generate::Family;
use crate::interval::rounding::round_up;

/// The sketch seen from the reference, all places, in the homotopy's unit.
fn sketch(problem: &Problem, homotopy: &Homotopy) -> Vec<Big> {
    let (d, reference) = (problem.dimension, &problem.homotopy.reference);
    let place = |p: usize| -> Vec<Big> {
        let sketch = &problem.points[p].sketch;
        sketch.iter().map(|x| Big::ratio(x.value())).collect()
    };
    let origin = place(reference[0]);
    let from_origin =
        |p: usize| -> Vec<Big> { place(p).iter().zip(&origin).map(|(x, o)| x - o).collect() };
    let unit = |v: Vec<Big>| -> Vec<Big> {
        let size = dot(&v, &v).sqrt();
        v.into_iter().map(|x| x / &size).collect()
    };
    let e1 = unit(from_origin(reference[1]));
    let mut axes = vec![e1.clone()];
    if d == 2 {
        axes.push(vec![-e1[1].clone(), e1[0].clone(), Big::of(0.0)]);
    } else {
        // What is left of the third point's direction, and the product of both.
        let third = from_origin(reference[2]);
        let along = dot(&e1, &third);
        let e2 = unit(
            third
                .iter()
                .zip(&e1)
                .map(|(x, e)| x - &(e * &along))
                .collect(),
        );
        let cross =
            |k: usize| &e1[(k + 1) % 3] * &e2[(k + 2) % 3] - &e1[(k + 2) % 3] * &e2[(k + 1) % 3];
        axes.extend([e2.clone(), (0..3).map(cross).collect()]);
    }
    let size = Big::of(homotopy.unit);
    (0..problem.points.len())
        .flat_map(|p| {
            let v = from_origin(p);
            axes.iter().map(|e| dot(e, &v) / &size).collect::<Vec<_>>()
        })
        .collect()
}

fn check(case: Case, random: &mut Random, ratios: &mut Ratios) {
    let (homotopy, figure) = (&case.homotopy, &case.figure);
    for (right, e) in homotopy.rights.iter().zip(&figure.e) {
        for k in 0..5 {
            assert!(
                e[k].is_in(right.enclosures()[k]),
                "coefficient {k} of a right-hand side"
            );
            let away = (&e[k] - &Big::of(right.e[k])).abs();
            ratios.check("coefficients of E", &away, right.e_radius[k]);
        }
        let all = |t: &Big| e.iter().rev().fold(Big::of(0.0), |sum, c| &sum * t + c);
        assert!(all(&Big::of(1.0)).is_in(right.at_target()));
        let (a, b) = (random.between(-3.0, 3.0), random.between(-3.0, 3.0));
        let (lo, hi) = (a.min(b), a.max(b));
        let t = Big::of(random.between(lo, hi));
        assert!(all(&t).is_in(right.enclose(hull(lo, hi))));
    }
    for (length, e) in homotopy.lengths.iter().zip(&figure.e) {
        let all = |t: &Big| e.iter().rev().fold(Big::of(0.0), |sum, c| &sum * t + c);
        let (a, b) = (random.between(-3.0, 3.0), random.between(-3.0, 3.0));
        let (lo, hi) = (a.min(b), a.max(b));
        let half_square = all(&Big::of(random.between(lo, hi)));
        // |a| where E ≥ 0: both signs are looked at.
        let root = (Big::of(2.0) * half_square.max(Big::of(0.0))).sqrt();
        let range = length.enclose(hull(lo, hi));
        assert!(root.is_in(range) || (-root.clone()).is_in(range));
    }
    let m = homotopy.equations;
    for (place, x) in sketch(&case.problem, homotopy).iter().enumerate() {
        if homotopy.gauge.variable[place] < m {
            let box_ = homotopy.sketch_box[place];
            assert!(x.is_in(box_), "place {place} of the sketch");
            let away = (x - &Big::of(box_.mid())).abs();
            ratios.check("sketch", &away, box_.rad());
        } else {
            assert!(
                x.abs() < Big::of(1e-60),
                "a fixed coordinate that is not zero"
            );
        }
    }

    // F and J in floats, at points and with directions of any size.
    check_residual(homotopy, figure, random, ratios)
}

/// What floats may be off, `residual_error` and `jacobian_times_error`.
fn check_residual(homotopy: &Homotopy, figure: &Figure, random: &mut Random, ratios: &mut Ratios) {
    let equations = Equations::new(homotopy);
    let (n, m) = (figure.n, figure.m);
    let mut vector = |size: f64| {
        let mut out = equations.vector();
        out[..n]
            .iter_mut()
            .for_each(|x| *x = size * random.between(-1.0, 1.0));
        out
    };
    for size in [1e-3, 1.0, 30.0] {
        let (z, v, away) = (vector(size), vector(1.0), vector(1e-9 * size));
        let [mut d, mut dv, mut sums] = std::array::from_fn(|_| equations.room());
        let mut lengths = crate::track::full::Lengths::new(&equations);
        let [mut f, mut error] = std::array::from_fn(|_| equations.vector());
        equations.differences(&z, &mut d);
        equations.directions(&v, &mut dv);
        equations.expand_lengths(z[m], &mut lengths);
        equations.residual(&d, &lengths, &mut f);
        equations.residual_error(&d, z[m], &mut error);
        let exact = big::exact(&z[..n]);
        for (e, x) in figure.residual(&exact).iter().enumerate() {
            ratios.check("F in floats", &(x - &Big::of(f[e])).abs(), error[e]);
        }
        // J is taken anywhere within these radii.
        let mut radius = equations.vector();
        (0..n).for_each(|i| radius[i] = away[i].abs());
        equations.sums(&radius, &mut sums);
        equations.jacobian_times(&d, &lengths, &dv, v[m], &mut f);
        equations.jacobian_times_error((&d, z[m]), (&sums, radius[m]), (&dv, v[m]), &mut error);
        let moved: Vec<Big> = exact
            .iter()
            .zip(&away[..n])
            .map(|(z, &x)| z + &Big::of(x))
            .collect();
        let direction = big::exact(&v[..n]);
        for (e, row) in figure.jacobian(&moved).iter().enumerate() {
            let away = (dot(row, &direction) - Big::of(f[e])).abs();
            ratios.check("J v in floats", &away, round_up(error[e], 1));
        }
    }
}

#[test]
fn lengths_sketches_and_residuals_are_enclosed() {
    let (mut ratios, mut random) = (Ratios::default(), Random::new(43));
    let mut list = problems(&[
        "octahedron",
        "disulfide",
        "k33",
        "icosahedron-c1",
        "dodecagon",
        "hard/lengths-6",
        "hard/sliver-3",
        "hard/octahedron-large",
        "hard/octahedron-small",
        "hard/flaps-split-8",
    ]);
    list.extend([generated(Family::Chain, 48), generated(Family::Strip, 31)]);
    for round in 0..effort(40) {
        let dimension = 2 + round % 2;
        let points = dimension + random.below(6);
        list.push(random_problem(&mut random, dimension, points, 0.5));
    }
    for problem in &list {
        let plain = Homotopy::new(problem).ok();
        let plain = plain.map(|homotopy| (problem.clone(), homotopy));
        if let Some(given) = plain {
            check(given.into(), &mut random, &mut ratios);
        }
        let rest = Disguised::new(problem, 0.7, &mut random).with_homotopy();
        if let Some(given) = rest {
            check(given.into(), &mut random, &mut ratios);
        }
    }
    ratios.come_near(&[
        ("coefficients of E", 0.9),
        ("sketch", 0.5),
        ("F in floats", 0.05),
        ("J v in floats", 0.5),
    ]);
}
