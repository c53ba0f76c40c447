//! No zero is lost, wherever it is in a part and however large that is.

use super::{Order, walk};
use crate::blocks::Blocks;
use crate::complete::coordinates::search::Block;
use crate::complete::coordinates::system::{Row, System};
use crate::interval::{Interval, ZERO, hull, point};
use crate::places::Each as _;
use crate::problem::Problem;
use crate::random::Random;
use crate::system::{Homotopy, typical_length};
use proptest::prelude::*;
use std::sync::OnceLock;

/// How often parts with a zero were looked at, were left with it, had several leaves, and came out with half of their widths or less.
#[derive(Debug, Default)]
struct Seen {
    parts: usize,
    several: usize,
    narrowed: usize,
}

/// Makes the numbers near the sketch, moved at random, a zero of all equations, and looks at parts around it.
fn look(system: &System, sketch: &[f64], seed: u64, seen: &mut Seen) {
    let mut random = Random::new(seed);
    let m = system.unknowns;
    assert_eq!(sketch.len(), m);
    let scale = 2f64.powf(2.0 * random.symmetric() - 3.0);
    let zero: Vec<f64> = sketch
        .iter()
        .map(|x| x + scale * random.symmetric())
        .collect();
    let mut at: Vec<Interval> = zero.iter().map(|&x| point(x)).collect();
    at.push(ZERO);
    let mut system = system.clone();
    for row in &mut system.rows {
        row.right = ZERO;
        row.right = row.value(&at);
    }
    let rows: Vec<Vec<usize>> = system.rows[..m]
        .iter()
        .map(|row| row.entries.clone())
        .collect();
    let blocks = Blocks::new(&rows, m)
        .expect("as many unknowns as equations")
        .blocks;
    for block in blocks {
        let own = block.unknowns;
        let block = Block::new(&system, &block.equations, &own, |u| !own.contains(&u));
        let rows: Vec<&Row> = block.square.rows.clone();
        let orders = Order::some(&block.square, m, 4);
        for order in &orders {
            let width = 2f64.powf(6.0 * random.symmetric() - 3.0);
            let mut x = at.clone();
            // What blocks before have found are ranges.
            let known = width * 1e-3 * random.symmetric().max(0.0);
            for e in 0..m {
                let [below, above] =
                    [random.symmetric(), random.symmetric()].each(|x| known * x.max(0.0));
                x[e] = hull(zero[e] - below, zero[e] + above);
            }
            for &u in &own {
                // Now and then the zero is at the border.
                let [below, above] =
                    [random.symmetric(), random.symmetric()].each(|x| width * x.max(0.0));
                x[u] = hull(zero[u] - below, zero[u] + above);
            }
            let leaves = (0..=6).find_map(|symbols| walk(symbols, order, &rows, &x));
            let leaves = leaves.expect("with six variables it comes to an end");
            let has_it = |x: &[Interval]| own.iter().all(|&u| x[u].contains(zero[u]));
            let holder = leaves.iter().find(|leaf| has_it(&leaf.x));
            let holder = holder.unwrap_or_else(|| panic!("seed {seed}: {zero:?} is lost of {x:?}"));
            seen.parts += 1;
            seen.several += usize::from(leaves.len() > 1);
            let kept = block.volume(&holder.x) - block.volume(&x);
            seen.narrowed += usize::from(kept < -1.0);
        }
    }
}

fn systems() -> &'static [(System, Vec<f64>)] {
    static SYSTEMS: OnceLock<Vec<(System, Vec<f64>)>> = OnceLock::new();
    SYSTEMS.get_or_init(read)
}

fn read() -> Vec<(System, Vec<f64>)> {
    let problems = [
        "octahedron",
        "dodecagon",
        "disulfide",
        "mechanisms/double-butterfly",
        "constraints/pentahedron",
        "constraints/hexahedron",
        "constraints/6p7d3a2c-closed",
    ];
    let read = |name: &str| {
        let problem =
            Problem::read(format!("../../problems/{name}.toml")).expect("a shipped problem");
        let homotopy = Homotopy::for_sets_in(&problem, typical_length(&problem)).expect("a gauge");
        let sketch = homotopy.sketch_of_unknowns().map(|x| x.mid()).collect();
        (System::new(&homotopy), sketch)
    };
    problems.into_iter().map(read).collect()
}

#[test]
fn no_zero_is_lost() {
    let systems = systems();
    let mut seen = Seen::default();
    for seed in 0..3000 {
        let (system, sketch) = &systems[seed as usize % systems.len()];
        look(system, sketch, seed, &mut seen);
    }
    println!("{seen:?}");
    // The test tries what it is about.
    assert!(
        seen.several > seen.parts / 100 && seen.narrowed > seen.parts / 10,
        "{seen:?}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn no_zero_is_lost_for_any_seed(seed in any::<u64>()) {
        let systems = systems();
        let (system, sketch) = &systems[seed as usize % systems.len()];
        look(system, sketch, seed, &mut Seen::default());
    }
}
