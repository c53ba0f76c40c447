//! Exits that are enclosed again by a very short tube (`reduced/exit.rs`, `enclose_by_short_tube`): what once went wrong
//! there, and what its box rests on.

use super::reduced::check_tied;
use super::*;
use crate::track::certified::tracker::Test;

fn chain_of(name: &str, count: usize) -> (Figure, Shop, Vec<ReducedSample>) {
    let case = Case::new(testing::shipped(name));
    let mut shop = Shop::new(&case.homotopy, f64::INFINITY);
    let chain = shop.chain(&case.homotopy, count);
    assert_eq!(chain.len(), count);
    (case.figure, shop, chain)
}

/// The exit of the one is that of the other, to the last bit.
fn is_untouched(a: &ReducedSample, b: &ReducedTube) -> bool {
    a.tube.exit.centre[..] == b.exit.centre[..]
        && a.tube.exit.radius[..] == b.exit.radius[..]
        && a.tube.exit_between == b.exit_between
        && a.tube.exit_slope[..] == b.exit_slope[..]
        && !b.exit_is_tight
}

#[test]
fn a_tie_that_fails_leaves_the_exit_as_it_was_proved() {
    let (_, mut shop, chain) = chain_of("octahedron", 30);
    for sample in &chain {
        let mut tube = sample.tube.clone();
        // No point can be proved to lie in a box without any room.
        tube.proof.r = 0.0;
        assert!(shop.test.tighten_exit(&shop.equations, &mut tube).is_none());
        assert!(
            is_untouched(sample, &tube),
            "the ball of a short tube that was not proved to be on the path"
        );
    }
}

#[test]
fn a_tie_is_not_made_before_the_entry() {
    let (_, mut shop, chain) = chain_of("octahedron", 30);
    let mut tightened = 0;
    for sample in &chain {
        let mut tube = sample.tube.clone();
        let usual = shop.test.tighten_exit(&shop.equations, &mut tube);
        if usual.is_none() {
            continue;
        }
        tightened += 1;
        // The short tube is 1e-5 h before the exit: an entry nearer to the exit than that is not gone behind.
        let mut late = sample.tube.clone();
        let entry = late.exit_at - 1e-7 * late.proof.h;
        late.entry = (entry, entry.next_up());
        assert!(shop.test.tighten_exit(&shop.equations, &mut late).is_none());
        late.entry = sample.tube.entry;
        assert!(is_untouched(sample, &late));
    }
    assert!(
        tightened > 20,
        "{tightened} of {} exits were tightened at all",
        chain.len()
    );
}

/// The exit, its parameter and its tangent where one test has tightened other tubes since and before.
#[test]
fn a_tie_expands_the_path_at_its_own_point() {
    let (figure, mut shop, chain) = chain_of("icosahedron-c1", 40);
    let (mut ratios, mut random) = (Ratios::default(), Random::new(36));
    for _ in 0..40 {
        let sample = &chain[random.below(chain.len())];
        let mut tube = sample.tube.clone();
        if shop.test.tighten_exit(&shop.equations, &mut tube).is_some() {
            check_tied(&figure, &sample.tube, &tube, &mut ratios).expect("a regular point");
        }
    }
    ratios.come_near(&[("tightened exit", 1e-3)]);
    assert!(ratios.count("tightened exit") > 20 * figure.n);
}

/// A short tube that is off the path on purpose: its box must reach as far, in all that hangs on the key unknowns.
#[test]
fn the_box_of_a_tightened_exit_reaches_the_path_from_wherever_the_short_tube_is() {
    let (figure, mut shop, chain) = chain_of("icosahedron-c1", 40);
    let (mut ratios, mut random) = (Ratios::default(), Random::new(37));
    let mut tightened = [0; 3];
    for round in 0..120 {
        let sample = &chain[random.below(chain.len())];
        let (equations, n) = (&shop.equations, figure.n);
        let mut short = Tube::new(equations);
        let at = sample.tube.exit_at - 1e-5 * sample.tube.proof.h;
        sample.tube.local.at(at, &mut short.local.z[0]);
        short
            .local
            .normal
            .copy_from_slice(&sample.tube.local.normal);
        shop.test
            .refine(equations, &mut short.local, 1e-11)
            .expect("a point");
        shop.test
            .expand(equations, &mut short.local)
            .expect("a point");
        let layout = short.local.y.elimination.layout.clone();
        let size = sample.tube.proof.h * 10f64.powf(random.between(-10.0, -6.0));
        // Along the figures that the key unknowns move, or one unknown of A alone; or the direction.
        let kind = round % 3;
        if kind == 0 {
            let width = short.local.y.elimination.reduced.width;
            for l in 0..layout.keys() {
                let step = size * random.between(-1.0, 1.0);
                for i in 0..n {
                    let k = short.local.y.elimination.reduced.k.as_flattened()[i * width * 4 + l];
                    short.local.z[0][i] += k * step;
                }
            }
        } else {
            let block = &layout.blocks[random.below(layout.blocks.len())];
            let i = block.unknowns[random.below(block.size)] as usize;
            short.local.z[kind - 1][i] += random.sign() * size;
        }
        settle(equations, &mut short.local);
        // For its series.
        let h = 1e-4 * sample.tube.proof.h;
        if shop.bounds_at(&mut short, h).is_none() {
            continue;
        }
        let mut tube = sample.tube.clone();
        if shop
            .test
            .enclose_by(&shop.equations, &mut tube, &mut short)
            .is_some()
        {
            tightened[kind] += 1;
            check_tied(&figure, &sample.tube, &tube, &mut ratios).expect("a regular point");
        }
    }
    println!("{tightened:?}");
    ratios.come_near(&[("tightened exit", 0.3), ("tightened tangent", 1e-3)]);
    assert!(tightened.iter().all(|&count| count > 10), "{tightened:?}");
}

/// A tube by hand that runs backwards where its exit's ball is, and forwards at `exit_at`.
#[test]
fn the_direction_of_a_link_is_that_at_the_point_linked() {
    let (figure, _, chain) = chain_of("octahedron", 10);
    for next in &chain {
        let n = figure.n;
        let mut from = next.tube.clone();
        // ẑ(s) = z₀ + z₁ s − z₁ s²/h: it turns at s = h/2.
        let h = from.proof.h;
        let forward = from.local.z[1].clone();
        for z in &mut from.local.z[2..] {
            z[..n].fill(0.0);
        }
        for i in 0..n {
            from.local.z[1][i] = -forward[i];
            from.local.z[2][i] = forward[i] / h;
        }
        from.exit.centre.copy_from_slice(&next.tube.local.z[0]);
        from.exit.radius[..n].fill(0.0);
        from.exit_at = h;
        from.exit_is_tight = false;
        from.proof.slope_distance = 1e-9;
        from.exit_between = (h, h);
        assert!(from.leads_to(&next.tube).is_some(), "forwards at h");
        from.exit_between = (0.0, 1e-6 * h);
        assert!(
            from.leads_to(&next.tube).is_none(),
            "the point at 0, where the path comes back, was linked with the direction at h"
        );
    }
}
