//! Problems for the tests of plans and of tracking with them.

use crate::problem::{Distance, HomotopyChoices, Point, Problem, Target};
use proptest::prelude::*;

/// A shipped problem.
pub fn shipped(name: &str) -> Problem {
    let file = format!("{}/../../problems/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Problem::read(file).unwrap()
}

/// Random rigid problems of the plane (`dimension` 2) or of space, by Henneberg steps: each point
/// is joined to as many earlier ones as there are dimensions, or (second kind, in the plane and in
/// space) is put on an edge, which is removed, and joined to its ends and enough other points.
/// Targets are near the sketch's lengths.
pub fn rigid(dimension: usize, points: std::ops::Range<usize>) -> impl Strategy<Value = Problem> {
    let coordinate = || -300i32..300;
    let point = (
        coordinate(),
        coordinate(),
        coordinate(),
        any::<[usize; 2]>(),
        any::<bool>(),
    );
    (
        prop::collection::vec(point, points),
        prop::collection::vec(-15i32..15, 60),
    )
        .prop_filter_map("points too near each other", move |(raw, changes)| {
            let n = raw.len();
            let place = |k: usize| {
                // The reference well apart; the others anywhere.
                let (x, y, z, ..) = raw[k];
                match k {
                    0 => [0, 0, 0],
                    1 => [200 + x / 6, 0, 0],
                    2 if dimension == 3 => [x / 3, 200 + y / 6, 0],
                    _ => [x, y, if dimension == 3 { z } else { 0 }],
                }
            };
            let mut edges: Vec<[usize; 2]> = Vec::new();
            for (k, &(.., choices, split)) in raw.iter().enumerate().skip(1) {
                if k <= dimension {
                    edges.extend((0..k.min(dimension)).map(|j| [j, k]));
                    continue;
                }
                let mut joined: Vec<usize> = Vec::new();
                let mut wanted = dimension;
                if split {
                    // The reference stays joined.
                    let candidates: Vec<usize> = (0..edges.len())
                        .filter(|&e| edges[e][1] >= dimension)
                        .collect();
                    let edge = edges.swap_remove(candidates[choices[1] % candidates.len()]);
                    joined.extend(edge);
                    wanted += 1;
                }
                for candidate in (0..k).map(|j| (choices[0] % k + j) % k) {
                    if joined.len() < wanted && !joined.contains(&candidate) {
                        joined.push(candidate);
                    }
                }
                edges.extend(joined.iter().map(|&j| [j, k]));
            }
            let decimal = |hundredths: i32| format!("{hundredths}e-2").parse().unwrap();
            let length = |[a, b]: [usize; 2]| {
                let (p, q) = (place(a), place(b));
                (0..3)
                    .map(|k| f64::from(p[k] - q[k]).powi(2))
                    .sum::<f64>()
                    .sqrt()
                    .round() as i32
            };
            if edges.iter().any(|&e| length(e) < 40) {
                return None;
            }
            Some(Problem {
                labels: Default::default(),
                tolerances: Default::default(),
                measures: Vec::new(),
                parameters: Vec::new(),
                kept: Default::default(),
                name: "random".into(),
                dimension,
                source: String::new(),
                points: (0..n)
                    .map(|k| Point {
                        name: format!("p{}", k + 1),
                        sketch: place(k).map(decimal),
                    })
                    .collect(),
                objects: Vec::new(),
                constraints: Vec::new(),
                orientations: Vec::new(),
                distances: edges
                    .iter()
                    .zip(changes.iter().cycle())
                    .map(|(&points, change)| Distance {
                        points,
                        target: Target::Length(decimal(length(points) + change)),
                    })
                    .collect(),
                homotopy: HomotopyChoices {
                    reference: (0..dimension).collect(),
                    bend: edges.len() - 1,
                    bend_coefficient: 2.into(),
                    detour: 0.into(),
                },
            })
        })
}
