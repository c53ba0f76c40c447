//! Chains that must not hold: other branches, left out tubes, wrong directions.

use super::precise::Figure;
use super::*;

#[derive(Debug, Default)]
struct Tally {
    branches: usize,
    shifted: usize,
    mirrored: usize,
    backwards: usize,
    pairs: usize,
    linked_pairs: usize,
}

fn sabotage<const N: usize, T: Stated<N>>(
    make: impl Fn(&Homotopy, f64) -> Maker<N, T>,
    problem: &Problem,
    random: &mut Random,
    tally: &mut Tally,
) {
    let homotopy = Homotopy::new(problem).unwrap();
    let figure = Figure::new(problem, &homotopy);
    let mut maker = make(&homotopy, f64::INFINITY);
    let chain = maker.chain(&homotopy, 400);
    let n = figure.n;
    let stride = (chain.len() / 40).max(1);
    for k in (0..chain.len() - 1).step_by(stride) {
        let (from, next) = (&chain[k].tube, &chain[k + 1].tube);
        let exit = on_path(&figure, from, from.exit_at);
        assert!(link_is_true(&figure, &exit, next, next.entry));
        let (z, normal) = (&next.local.z[0], &next.local.normal);

        // The same piece of path, followed backwards.
        let back: Vec<f64> = normal[..n].iter().map(|c| -c).collect();
        if let Some(turned) = maker.tube(z, &back, true) {
            let link = from.leads_to(&turned.tube);
            assert_eq!(link, None, "a tube that runs backwards was linked");
            tally.backwards += 1;
        }

        // The mirror image, which meets the same equations.
        let [z_image, image] = [z, normal].map(|v| mirrored(&homotopy, v));
        if let Some(image) = maker.tube(&z_image, &image, true) {
            leads_truly(&figure, (from, &exit), &image.tube);
            tally.mirrored += 1;
        }

        // From beside the path, near and far.
        for spread in [1e-3, 0.1, 0.5, 1.0] {
            let shifted = z[..n].iter();
            let shifted = shifted.map(|z| z + spread * random.between(-1.0, 1.0));
            if let Some(other) = maker.tube(&shifted.collect::<Vec<_>>(), normal, true) {
                leads_truly(&figure, (from, &exit), &other.tube);
                tally.shifted += 1;
            }
        }

        // Other branches at the same t, from near and far, with their own tangents or the true normal.
        for spread in [1e-3, 0.1, 0.3, 1.0, 1.0, 3.0] {
            let (equations, inverter) = (&maker.equations, &mut maker.inverter);
            let mut local: Local = Local::new(equations);
            local.z[0].copy_from_slice(z);
            for z in &mut local.z[0][..n - 1] {
                *z += spread * random.between(-1.0, 1.0);
            }
            if local.refine_at(equations, inverter, z[n - 1]).is_none() {
                continue;
            }
            let start = local.z[0].clone();
            if random.below(2) == 0 {
                local.normal.copy_from_slice(normal);
            } else {
                let reverse = random.below(2) == 0;
                if first_normal(equations, inverter, &mut local, reverse).is_err() {
                    continue;
                }
            }
            let other = maker.tube(&start, &local.normal, true);
            if other.is_some_and(|other| !leads_truly(&figure, (from, &exit), &other.tube)) {
                tally.branches += 1;
            }
        }

        // Tubes left out, or taken in the wrong order.
        tally.pairs += chain.len();
        let others = chain.iter();
        let linked = others.filter(|other| leads_truly(&figure, (from, &exit), &other.tube));
        tally.linked_pairs += linked.count();
    }
}

fn there_were_enough(tally: &Tally) {
    println!("{tally:?}");
    assert!(
        tally.branches > 30 && tally.mirrored > 50 && tally.backwards > 50,
        "too few cases: {tally:?}"
    );
    assert!(
        tally.shifted > 30 && tally.linked_pairs > 30,
        "too few cases: {tally:?}"
    );
}

#[test]
fn false_links_are_refused() {
    let (mut tally, mut random) = (Tally::default(), Random::new(3));
    for problem in shipped() {
        sabotage(Workshop::new, &problem, &mut random, &mut tally)
    }
    there_were_enough(&tally);
}

#[test]
fn false_links_are_refused_in_the_reduced_space() {
    let (mut tally, mut random) = (Tally::default(), Random::new(23));
    for problem in shipped() {
        sabotage(Shop::new, &problem, &mut random, &mut tally)
    }
    there_were_enough(&tally);
}

#[test]
fn false_links_are_refused_with_mixed_kinds() {
    let (mut tally, mut random) = (Tally::default(), Random::new(5));
    for round in 0..effort(16) {
        let problem = mixed_problem(&mut random, 2 + round % 2);
        if closes(&problem, Space::Full) {
            sabotage(Workshop::new, &problem, &mut random, &mut tally)
        }
    }
    there_were_enough(&tally);
}
