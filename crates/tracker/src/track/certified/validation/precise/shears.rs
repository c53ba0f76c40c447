//! Single bounds of the reduced space, each against what it bounds.

use super::big::{exact, horner};
use super::reduced::{check_bounds, check_speed};
use super::view::View;
use super::*;
use crate::linalg::Vector;
use crate::track::certified::link::Frame;
use crate::track::certified::tracker::Test;
use crate::track::reduced::certified::Reduction;

/// |T v| from |v|, and |𝒴 g|_ρ / (1 − q) from g.
fn check_problem(case: &Case, tubes: usize, random: &mut Random, ratios: &mut Ratios) {
    let Case {
        homotopy, figure, ..
    } = case;
    let (n, m) = (figure.n, figure.m);
    let mut shop = Shop::new(homotopy, f64::INFINITY);
    let chain = shop.chain(homotopy, 100);
    for k in spread(&chain, tubes) {
        let mut tube = chain[k].tube.clone();
        let h = tube.proof.h;
        if shop.bounds_at(&mut tube, h).is_none() {
            continue;
        }
        let ignored: Vec<usize> = {
            let layout = &tube.local.y.elimination.layout;
            layout
                .ignored
                .iter()
                .map(|&e| e as usize)
                .chain([m])
                .collect()
        };
        for kind in 0..6 {
            let s = Big::of(parameter(random, h));
            // Right-hand sides of A's rows, of the ignored ones, of the normal's, of all.
            let g: Vec<f64> = (0..n)
                .map(|e| {
                    let wanted = match kind {
                        0 => !ignored.contains(&e),
                        1 | 2 => ignored.contains(&e),
                        3 => e == m,
                        _ => true,
                    };
                    if wanted {
                        random.between(-1.0, 1.0)
                    } else {
                        0.0
                    }
                })
                .collect();
            let bound = shop
                .test
                .radius_for(&shop.equations, &tube, &g)
                .expect("a radius");
            let view = View::new(figure, &tube);
            let columns = g.iter().map(|&g| vec![Big::of(g)]).collect();
            let step: Vec<Big> = view
                .preconditioned(&s, &columns)
                .expect("a regular A")
                .into_iter()
                .map(|mut row| row.swap_remove(0))
                .collect();
            let size = view.norm(&step) / (Big::of(1.0) - Big::of(tube.proof.q));
            ratios.check("radius from a defect", &size, bound);

            let k = view.k(&s);
            let v: Vec<f64> = (0..n).map(|_| random.between(-1.0, 1.0)).collect();
            let sizes: Vec<f64> = v.iter().map(|v| v.abs()).collect();
            let mut bound = vec![0.0; n];
            tube.local.y.bound_unsheared(&sizes, &mut bound);
            for (w, bound) in view.sheared(&k, &exact(&v), false).iter().zip(bound) {
                ratios.check("T v", &w.abs(), bound);
            }

            // The extent of what is given as exact, where all but little of it cancels.
            let place = parameter(random, h);
            let s = Big::of(place);
            let size = 10f64.powf(random.between(-16.0, 0.0));
            let small = view.in_box(random, size);
            let keys = view.keys.iter().fold(small, |mut v, &key| {
                v[key] = Big::of(random.between(-1.0, 1.0));
                v
            });
            let k = view.k(&s);
            let away: Vec<f64> = view
                .sheared(&k, &keys, false)
                .iter()
                .map(Big::to_f64)
                .collect();
            let extent = view.sheared(&k, &exact(&away), true);
            let known = |i: usize| (away[i], 0.0);
            let stated = |y: &Reduction| y.extent(&tube.weights[..n], place, known, known);
            ratios.check("extent of T v", &view.norm(&extent), stated(&tube.local.y));
            // Without the key unknowns' own, which are much larger.
            let mut own = tube.local.y.clone();
            view.keys
                .iter()
                .for_each(|&key| own.rho[key] = f64::INFINITY);
            let inner = view
                .unknowns
                .iter()
                .map(|&i| extent[i].abs() / Big::of(own.rho[i]));
            let inner = inner.fold(Big::of(0.0), Big::max);
            ratios.check("extent of T v in A", &inner, stated(&own));
        }
    }
}

#[test]
fn what_is_taken_along_and_radii_from_defects_are_bounded() {
    let (mut ratios, mut random) = (Ratios::default(), Random::new(34));
    let shipped = problems(&["octahedron", "disulfide", "k33", "dodecagon"]);
    for case in shipped.into_iter().map(Case::new).chain(tails(55, 6)) {
        check_problem(&case, effort(12), &mut random, &mut ratios)
    }
    ratios.come_near(&[("radius from a defect", 0.5), ("T v", 0.99)]);
}

/// A triangle at the t where its bending side is longest, seen from t: only t moves, with s⁸, so that
/// E(t(s)) has orders s¹⁶ and s³², of which the last is the largest.
#[test]
fn the_bend_counts_to_its_last_order() {
    let Case {
        homotopy, figure, ..
    } = Case::new(triangle());
    let mut shop = Shop::new(&homotopy, f64::INFINITY);
    let (n, m) = (figure.n, figure.m);
    let mut tube = Tube::new(&shop.equations);
    tube.local.z[0] = sketch(&homotopy, &shop.equations);
    tube.local.normal[m] = 1.0;
    // The bend grows from 1 to 2 in small steps of t.
    for step in 0..=50 {
        tube.local.z[0][m] = 0.01 * f64::from(step);
        shop.test
            .refine(&shop.equations, &mut tube.local, 1e-9)
            .expect("a figure");
    }
    shop.test
        .expand(&shop.equations, &mut tube.local)
        .expect("a figure");
    for z in &mut tube.local.z[1..] {
        z[..n].fill(0.0);
    }
    tube.local.z[8][m] = 2.0;
    settle(&shop.equations, &mut tube.local);
    let weights: &mut Vector = shop.test.weights_mut();
    weights[..n].fill(1.0);
    weights[m] = 1e-5;
    let stated = shop.bounds_at(&mut tube, 1.0).expect("bounds");
    let (speed, view) = (tube.local.y.speed, View::new(&figure, &tube));
    let (mut ratios, mut random) = (Ratios::default(), Random::new(35));
    // t is at 5/2 or 1/2 ± 0 then; ẑ_t is what was asked for.
    let last = [0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0];
    assert_eq!(view.at(&Big::of(1.0)).0[m], horner(&last, &Big::of(1.0)));
    for _ in 0..20 {
        check_bounds(&view, &stated, &mut random, &mut ratios).expect("a regular A");
        check_speed(&view, (1.0, 1.0, speed), &mut random, &mut ratios);
    }
    ratios.come_near(&[("|Φ(0)|", 0.15)]);

    // A tube that stays where it is, and a coefficient of which only the size is known: E'' is what
    // the radius makes it.
    tube.local.z[8][m] = 0.0;
    settle(&shop.equations, &mut tube.local);
    let weights = shop.test.weights_mut();
    weights[..n].fill(1e-3);
    weights[m] = 1.0;
    let bend = &mut shop.equations.bends[0];
    bend.e_radius[4] = 1e3;
    let mut e = figure.e;
    e[bend.edge][4] += Big::of(1e3);
    let figure = Figure::with(&homotopy, e);
    let stated = shop.bounds_at(&mut tube, 1.0).expect("bounds");
    let (view, mut ratios) = (View::new(&figure, &tube), Ratios::default());
    for _ in 0..20 {
        check_bounds(&view, &stated, &mut random, &mut ratios).expect("a regular A");
    }
    ratios.come_near(&[("|Φ'(v) − Φ'(0)|", 0.05)]);
}
