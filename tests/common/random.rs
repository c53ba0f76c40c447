//! Random problems whose graphs are generically rigid by construction.

use krawl::problem::{Problem, ProblemError};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// How to build a problem. Numbers are taken modulo the number of choices that there are, so that
/// every recipe means something and shrinks well.
#[derive(Debug, Clone)]
pub struct Recipe {
    dimension: usize,
    /// One for each point beyond the first two (plane) or three (space): the kind of the
    /// construction step, and what it is applied to.
    steps: Vec<(bool, [usize; 3])>,
    /// The sketch, in hundredths.
    sketch: Vec<[i32; 3]>,
    /// By how many percent each length differs from the one in the sketch.
    stretch: Vec<i32>,
    bend: usize,
    /// The bend's coefficient, in tenths.
    bend_coefficient: i32,
}

/// Chance that is the same each time, so that a result of `cargo test` does not depend on luck.
pub fn same_each_time() -> TestRng {
    TestRng::deterministic_rng(RngAlgorithm::ChaCha)
}

/// A linear congruence, of which the low bits are not random.
pub struct Dice(pub u64);

impl Dice {
    pub fn bits(&mut self) -> u64 {
        let next = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = next.wrapping_add(1_442_695_040_888_963_407);
        self.0
    }

    /// From 0 to 1.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() >> 33) as usize % n
    }
}

/// Recipes for `points` points in the plane or in space, at most ten.
pub fn recipe(
    dimension: usize,
    points: std::ops::RangeInclusive<usize>,
) -> impl Strategy<Value = Recipe> {
    let first = dimension;
    let step = (any::<bool>(), [0usize..60, 0usize..60, 0usize..60]);
    let coordinate = || -200i32..=200;
    let sketch = prop::collection::vec([coordinate(), coordinate(), coordinate()], 10);
    let stretch = prop::collection::vec(-20i32..=20, 24);
    let steps = prop::collection::vec(step, points.start() - first..=points.end() - first);
    (steps, sketch, stretch, 0usize..60, 1i32..=20).prop_map(
        move |(steps, sketch, stretch, bend, bend_coefficient)| Recipe {
            dimension,
            steps,
            sketch,
            stretch,
            bend,
            bend_coefficient,
        },
    )
}

/// Random problems, as many in the plane as in space.
pub fn problems(count: usize) -> Vec<Problem> {
    let mut runner = TestRunner::new_with_rng(Config::default(), same_each_time());
    let mut problems = Vec::new();
    while problems.len() < count {
        let dimension = 2 + problems.len() % 2;
        let tree = recipe(dimension, 4..=9).new_tree(&mut runner).unwrap();
        problems.extend(tree.current().build());
    }
    problems
}

impl Recipe {
    /// The problem, checked as any other.
    pub fn build(&self) -> Result<Problem, ProblemError> {
        let edges = if self.dimension == 2 {
            henneberg(&self.steps)
        } else {
            sphere(&self.steps)
        };
        let points = self.steps.len() + self.dimension;
        let name = |p: usize| format!("p{}", p + 1);
        let mut builder = Problem::build("random", self.dimension);
        for p in 0..points {
            let place = self.sketch[p].iter().map(|x| f64::from(*x) / 100.0);
            builder = builder.point(&name(p), place.take(self.dimension));
        }
        for (&[a, b], &stretch) in edges.iter().zip(&self.stretch) {
            let squared: i32 = (0..self.dimension)
                .map(|k| (self.sketch[a][k] - self.sketch[b][k]).pow(2))
                .sum();
            let length = f64::from(squared).sqrt() * f64::from(100 + stretch) / 1e4;
            builder = builder.distance(&name(a), &name(b), format!("{length:.3}").as_str());
        }
        let [a, b] = edges[self.bend % edges.len()];
        let c = f64::from(self.bend_coefficient) / 10.0;
        builder
            .bend([name(a), name(b)])
            .bend_coefficient(c)
            .finish()
    }
}

/// Henneberg's constructions of the rigid graphs of the plane: a new point joined to two, or put
/// on a distance, which it replaces, and joined to a third point.
fn henneberg(steps: &[(bool, [usize; 3])]) -> Vec<[usize; 2]> {
    let mut edges = vec![[0, 1]];
    for (k, &(on_edge, [x, y, z])) in steps.iter().enumerate() {
        let new = k + 2;
        if on_edge && new > 2 {
            let [a, b] = edges.swap_remove(x % edges.len());
            let others: Vec<usize> = (0..new).filter(|&p| p != a && p != b).collect();
            let c = others[y % others.len()];
            edges.extend([[a, new], [b, new], [c, new]]);
        } else {
            let a = x % new;
            let b = (a + 1 + z % (new - 1)) % new;
            edges.extend([[a, new], [b, new]]);
        }
    }
    edges
}

/// Triangulated spheres, which are generically rigid in space: a new point in a face, joined to
/// its corners, or on an edge, which it divides, joined to the corners of both faces.
fn sphere(steps: &[(bool, [usize; 3])]) -> Vec<[usize; 2]> {
    let mut faces = vec![[0, 1, 2], [0, 2, 1]];
    for (k, &(on_edge, [x, y, _])) in steps.iter().enumerate() {
        let new = k + 3;
        let mut face = faces.swap_remove(x % faces.len());
        face.rotate_left(y % 3);
        let [a, b, c] = face;
        if on_edge && new > 3 {
            let corner = |f: &[usize; 3]| (0..3).find(|&k| f[k] == b && f[(k + 1) % 3] == a);
            let at = faces.iter().position(|f| corner(f).is_some()).unwrap();
            let other = faces.swap_remove(at);
            let d = other[(corner(&other).unwrap() + 2) % 3];
            faces.extend([[a, new, c], [new, b, c], [b, new, d], [new, a, d]]);
        } else {
            faces.extend([[a, b, new], [b, c, new], [c, a, new]]);
        }
    }
    let mut edges: Vec<[usize; 2]> = faces
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .filter(|[a, b]| a < b)
        .collect();
    edges.sort_unstable();
    edges
}
