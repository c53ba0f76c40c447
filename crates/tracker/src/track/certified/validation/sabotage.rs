//! Chains that must not hold: other branches, left out tubes, wrong directions.

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
    let exact = Exact::new(&homotopy);
    let mut workshop = Workshop::new(&homotopy, f64::INFINITY);
    let chain = workshop.chain(&homotopy, 400);
    let n = exact.n;
    let last_axis = |i: usize| i < exact.m && homotopy.flips(i, homotopy.dimension - 1);
    let stride = (chain.len() / 40).max(1);
    for k in (0..chain.len() - 1).step_by(stride) {
        let (from, next) = (&chain[k], &chain[k + 1]);
        assert!(link_is_true(
            &exact,
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
        let flip = |v: &[f64]| -> Vec<f64> {
            (0..n)
                .map(|i| if last_axis(i) { -v[i] } else { v[i] })
                .collect()
        };
        workshop.weights.copy_from_slice(&next.tube.weights);
        if let Some(mirrored) = workshop.tube(&flip(&next.tube.local.z[0]), &flip(next.normal()), 1)
        {
            if let Some(entry) = from.tube.leads_to(&mirrored.tube) {
                assert!(
                    link_is_true(&exact, &from.tube, &mirrored.tube, entry),
                    "linked to the mirror image"
                );
            }
            tally.mirrored += 1;
        }

        // Other branches at the same t, from near and far, with their own tangents or the true normal.
        for spread in [1e-3, 0.1, 0.3, 1.0, 1.0, 3.0] {
            let mut local = next.tube.local.clone();
            for i in 0..n - 1 {
                local.z[0][i] += spread * random.between(-1.0, 1.0);
            }
            let t = next.tube.local.z[0][n - 1];
            if local
                .refine_at(&workshop.equations, &mut workshop.inverter, t)
                .is_none()
            {
                continue;
            }
            let start = local.z[0].clone();
            let normal: Vec<f64> = if random.below(2) == 0 {
                next.normal()[..n].to_vec()
            } else if first_normal(
                &workshop.equations,
                &mut workshop.inverter,
                &mut local,
                random.below(2) == 0,
            )
            .is_ok()
            {
                local.normal[..n].to_vec()
            } else {
                continue;
            };
            workshop.weights.copy_from_slice(&next.tube.weights);
            if let Some(other) = workshop.tube(&start, &normal, 2) {
                if let Some(entry) = from.tube.leads_to(&other.tube) {
                    assert!(
                        link_is_true(&exact, &from.tube, &other.tube, entry),
                        "linked to another branch"
                    );
                } else {
                    tally.branches += 1;
                }
            }
        }

        // Tubes left out, or taken in the wrong order.
        for other in &chain {
            tally.pairs += 1;
            if let Some(entry) = from.tube.leads_to(&other.tube) {
                tally.linked_pairs += 1;
                assert!(
                    link_is_true(&exact, &from.tube, &other.tube, entry),
                    "tubes that do not touch were linked"
                );
            }
        }
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
