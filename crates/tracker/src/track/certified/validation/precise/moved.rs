//! Bounds of the reduced space where its floats are changed on purpose: coefficients of ẑ, P, K₀ and the
//! blocks' inverses may be any numbers, and the lengths anything within their radii. What is of
//! rounding's size along a run is large here.

use super::reduced::{check_bounds, check_path, check_resolvent, check_speed};
use super::view::View;
use super::*;
use crate::generate::Family;
use crate::linalg::LANE;
use crate::track::reduced::certified::COEFFICIENTS;

/// What may be changed.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Change {
    Nothing,
    /// All coefficients, relatively.
    Path,
    /// One coefficient of one unknown.
    Entry,
    /// One order of one unknown that is not key, far beyond what any path does.
    Wild,
    Schur,
    Shear,
    Inverses,
    /// The radii of the lengths' coefficients, and the lengths within them.
    Lengths,
}

const CHANGES: [Change; 8] = [
    Change::Nothing,
    Change::Path,
    Change::Entry,
    Change::Wild,
    Change::Schur,
    Change::Shear,
    Change::Inverses,
    Change::Lengths,
];

fn change(what: Change, equations: &Equations, tube: &mut ReducedTube, random: &mut Random) {
    let n = equations.n();
    let size = 10f64.powf(random.between(-9.0, -1.0));
    let mut scale = |x: &mut f64| *x *= 1.0 + size * random.between(-1.0, 1.0);
    let local = &mut tube.local;
    let layout = local.y.elimination.layout.clone();
    let inner: Vec<usize> = layout
        .blocks
        .iter()
        .flat_map(|b| b.unknowns[..b.size].iter().map(|&i| i as usize))
        .collect();
    match what {
        Change::Nothing | Change::Lengths => return,
        Change::Path => local.z[1..]
            .iter_mut()
            .for_each(|z| z[..n].iter_mut().for_each(&mut scale)),
        Change::Entry => {
            let (k, i) = (1 + random.below(COEFFICIENTS - 1), random.below(n));
            local.z[k][i] += random.sign() * size;
        }
        Change::Wild if !inner.is_empty() => {
            let (k, i) = (
                1 + random.below(COEFFICIENTS - 1),
                inner[random.below(inner.len())],
            );
            local.z[k][i] += random.sign() * 10f64.powf(random.between(0.0, 3.0));
        }
        Change::Wild => return,
        Change::Schur => local
            .y
            .elimination
            .reduced
            .p
            .as_flattened_mut()
            .iter_mut()
            .for_each(scale),
        Change::Shear => {
            let row = local.y.elimination.reduced.width * LANE;
            let k = local.y.elimination.reduced.k.as_flattened_mut();
            for i in inner {
                k[i * row..(i + 1) * row].iter_mut().for_each(&mut scale);
            }
        }
        Change::Inverses => {
            let inverses = &mut local.y.elimination.inverses;
            let points = inverses.points.as_flattened_mut().as_flattened_mut();
            let wide = inverses.wide.as_flattened_mut().as_flattened_mut();
            points.iter_mut().chain(wide).for_each(scale)
        }
    }
    settle(equations, local);
}

/// Makes the radii of the lengths' coefficients large; the coefficients at one end of them or inside.
pub fn lengthen(
    equations: &mut Equations,
    homotopy: &Homotopy,
    size: f64,
    random: &mut Random,
) -> Figure {
    let mut e = Vec::new();
    for edge in 0..equations.m {
        let bend = equations.bends.iter().position(|bend| bend.edge == edge);
        let coefficients: [Big; 5] = std::array::from_fn(|k| {
            if bend.is_none() && k > 2 {
                return Big::of(0.0);
            }
            let (middle, radius) = if let Some(bend) = bend {
                let radius = size * random.unit();
                equations.bends[bend].e_radius[k] = radius;
                if k < 3 {
                    equations.e_radius[k][edge] = radius;
                }
                (equations.bends[bend].e[k], radius)
            } else {
                let radius = size * random.unit();
                equations.e_radius[k][edge] = radius;
                (equations.e[k][edge], radius)
            };
            let part = if random.below(3) == 0 {
                random.between(-1.0, 1.0)
            } else {
                random.sign()
            };
            Big::of(middle) + Big::of(part) * Big::of(radius)
        });
        e.push(coefficients);
    }
    Figure::with(homotopy, e)
}

#[derive(Debug, Default)]
struct Seen {
    bounded: [usize; CHANGES.len()],
    refused: usize,
    proved: [usize; CHANGES.len()],
}

fn check_problem(
    case: &Case,
    (tubes, rounds): (usize, usize),
    random: &mut Random,
    ratios: &mut [Ratios; CHANGES.len()],
    seen: &mut Seen,
) {
    let (homotopy, true_figure) = (&case.homotopy, &case.figure);
    let mut shop = Shop::with_alpha(homotopy, [0.05, 0.1, 0.2][random.below(3)], f64::INFINITY);
    let chain = shop.chain(homotopy, 40);
    for sample in spread(&chain, tubes).map(|k| &chain[k]) {
        for round in 0..rounds {
            let kind = round % CHANGES.len();
            let what = CHANGES[kind];
            let ratios = &mut ratios[kind];
            let mut tube = sample.tube.clone();
            change(what, &shop.equations, &mut tube, random);
            let kept = shop.equations.clone();
            let other = (what == Change::Lengths).then(|| {
                let size = 10f64.powf(random.between(-12.0, -3.0));
                lengthen(&mut shop.equations, homotopy, size, random)
            });
            let figure = other.as_ref().unwrap_or(true_figure);
            let part = [1.5, 1.0, 1.0, 0.1, 1e-2, 1e-4][random.below(6)];
            let h = sample.tube.proof.h * part;
            let Some(stated) = shop.bounds_at(&mut tube, h) else {
                seen.refused += 1;
                shop.equations = kept;
                continue;
            };
            seen.bounded[kind] += 1;
            let speed = tube.local.y.speed;
            let faster = shop.test.speed_in(&tube, 1e6);
            let view = View::new(figure, &tube);
            check_bounds(&view, &stated, random, ratios);
            check_resolvent(&view, &shop.equations, h, random, ratios);
            check_speed(&view, (h, 1.0, speed), random, ratios);
            check_speed(&view, (h, 1e6, faster), random, ratios);
            // What is proved of much shorter tubes by the same bounds.
            for part in [1.0, 0.6, 0.3] {
                if let Ok(proof) = stated.0.proof::<COEFFICIENTS>(part * h) {
                    let mut proved = tube.clone();
                    proved.proof = proof;
                    seen.proved[kind] += 1;
                    check_path(&View::new(figure, &proved), random, ratios)
                        .expect("a regular point");
                }
            }
            shop.equations = kept;
        }
    }
}

#[test]
fn reduced_bounds_hold_whatever_the_numbers_kept() {
    let mut random = Random::new(33);
    let mut list = problems(&[
        "octahedron",
        "k33",
        "prism",
        "dodecagon",
        "hard/fold-5",
        "hard/flaps-apart-3",
    ]);
    list.push(generated(Family::Strip, 25));
    for dimension in [2, 3] {
        for points in dimension..dimension + 3 {
            list.push(random_problem(&mut random, dimension, points, 0.3));
        }
    }
    check_all(list.into_iter().map(Case::new), &mut random);
}

#[test]
fn reduced_bounds_of_tails_hold_whatever_the_numbers_kept() {
    check_all(tails(53, 16), &mut Random::new(54));
}

fn check_all(list: impl IntoIterator<Item = Case>, random: &mut Random) {
    let mut ratios: [Ratios; CHANGES.len()] = Default::default();
    let mut seen = Seen::default();
    for case in list {
        let counts = (effort(4), 2 * CHANGES.len());
        check_problem(&case, counts, random, &mut ratios, &mut seen)
    }
    println!("{seen:?}");
    for (what, ratios) in CHANGES.iter().zip(&ratios) {
        print!("{what:?}: ");
        ratios.come_near(&[("|Φ(0)|", 0.3)]);
    }
    assert!(seen.bounded.iter().all(|&count| count > 20), "{seen:?}");
}
