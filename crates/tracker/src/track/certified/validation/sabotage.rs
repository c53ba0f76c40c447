//! Chains that must not hold: other branches, left out tubes, wrong directions.

use super::precise::Figure;
use super::*;

#[derive(Debug, Default)]
struct Tally {
    branches: usize,
    mirrored: usize,
    backwards: usize,
    pairs: usize,
    linked_pairs: usize,
}

fn sabotage(problem: &Problem, random: &mut Random, tally: &mut Tally) {
    let homotopy = Homotopy::new(problem).unwrap();
    let figure = Figure::new(problem, &homotopy);
    let mut workshop = Workshop::new(&homotopy, f64::INFINITY);
    let chain = workshop.chain(&homotopy, 400);
    let n = figure.n;
    let stride = (chain.len() / 40).max(1);
    for k in (0..chain.len() - 1).step_by(stride) {
        let (from, next) = (&chain[k], &chain[k + 1]);
        assert!(link_is_true(
            &figure,
            &from.tube,
            &next.tube,
            next.tube.entry
        ));

        // The same piece of path, followed backwards.
        let back: Vec<f64> = next.normal()[..n].iter().map(|c| -c).collect();
        workshop.weights.copy_from_slice(&next.tube.weights);
        if let Some(turned) = workshop.tube(&next.tube.local.z[0], &back, 1) {
            assert_eq!(
                from.tube.leads_to(&turned.tube),
                None,
                "a tube that runs backwards was linked"
            );
            tally.backwards += 1;
        }

        // The mirror image, which meets the same equations.
        let (z, normal) = (&next.tube.local.z[0], next.normal());
        workshop.weights.copy_from_slice(&next.tube.weights);
        let image = workshop.tube(&mirrored(&homotopy, z), &mirrored(&homotopy, normal), 1);
        if let Some(image) = image {
            leads_truly(&figure, &from.tube, &image.tube);
            tally.mirrored += 1;
        }

        // Other branches at the same t, from near and far, with their own tangents or the true normal.
        for spread in [1e-3, 0.1, 0.3, 1.0, 1.0, 3.0] {
            let mut local = next.tube.local.clone();
            for i in 0..n - 1 {
                local.z[0][i] += spread * random.between(-1.0, 1.0);
            }
            let t = next.tube.local.z[0][n - 1];
            let (equations, inverter) = (&workshop.equations, &mut workshop.inverter);
            if local.refine_at(equations, inverter, t).is_none() {
                continue;
            }
            let start = local.z[0].clone();
            if random.below(2) == 0 {
                local.normal = next.tube.local.normal.clone();
            } else {
                let reverse = random.below(2) == 0;
                if first_normal(equations, inverter, &mut local, reverse).is_err() {
                    continue;
                }
            }
            let normal = local.normal[..n].to_vec();
            workshop.weights.copy_from_slice(&next.tube.weights);
            let other = workshop.tube(&start, &normal, 2);
            if other.is_some_and(|other| !leads_truly(&figure, &from.tube, &other.tube)) {
                tally.branches += 1;
            }
        }

        // Tubes left out, or taken in the wrong order.
        tally.pairs += chain.len();
        let others = chain.iter();
        tally.linked_pairs += others
            .filter(|other| leads_truly(&figure, &from.tube, &other.tube))
            .count();
    }
}

#[test]
fn false_links_are_refused() {
    let mut tally = Tally::default();
    let mut random = Random::new(3);
    for problem in shipped() {
        sabotage(&problem, &mut random, &mut tally)
    }
    println!("{tally:?}");
    assert!(
        tally.branches > 30 && tally.mirrored > 50 && tally.backwards > 50,
        "too few cases: {tally:?}"
    );
}

#[test]
fn false_links_are_refused_with_mixed_kinds() {
    let mut tally = Tally::default();
    let mut random = Random::new(5);
    for round in 0..effort(16) {
        let problem = mixed_problem(&mut random, 2 + round % 2);
        if !closes(&problem, Space::Full) {
            continue;
        }
        sabotage(&problem, &mut random, &mut tally)
    }
    println!("{tally:?}");
    assert!(
        tally.branches > 30 && tally.mirrored > 50 && tally.backwards > 50,
        "too few cases: {tally:?}"
    );
}
