//! The proofs, checked against computations that share nothing with them: numbers of 256 bits from the problems' exact data,
//! rationals, figures whose whole path is known, and sabotage.
//!
//! A test here that fails shows a claim that is false, or one that is made without a proof.

mod along;
mod components;
mod crossings;
mod disguise;
mod extended;
mod faults;
mod known_paths;
#[path = "../../../../../../tests/common/mixed/mod.rs"]
#[allow(dead_code, unused_imports)]
mod mixed;
mod mutations;
mod precise;
mod reduced;
mod reruns;
mod sabotage;
mod solutions;
mod tubes;

pub use faults::inject as inject_fault;

use crate::plan::testing;
use along::{at_sketch, leads_truly, link_is_true, mirrored, on_path};

use super::link::Tube;
use super::tracker::Test;
use crate::interval::rounding::{gamma, round_up};
use crate::interval::{Interval, hull, point};
use crate::linalg::{Matrix, Vector};
use crate::problem::{Decimal, Problem, Target};
use crate::system::Homotopy;
use crate::track::full::certified::KrawczykTest;
use crate::track::full::{
    Equations, InverseMaker, Local, ORDER, Preconditioner, first_normal, sketch,
};
use crate::track::reduced::certified::{Bounds, COEFFICIENTS, ReducedTest};
use crate::track::{Control, Options, Solution, Space, Status, solve};

/// How far ẑ(s)_i, as [`Local::entry_at`] evaluates it in floats, may be from the exact value.
fn evaluation_error<const N: usize, Y: Preconditioner>(
    local: &Local<N, Y>,
    i: usize,
    s: f64,
) -> f64 {
    let s = s.abs();
    let size = (0..N)
        .rev()
        .fold(0.0, |sum, k| sum * s + local.z[k][i].abs());
    round_up(gamma(4 * N) * size, 4 * N)
}

/// The same numbers in every run.
pub struct Random(crate::random::Random);

impl Random {
    pub fn new(seed: u64) -> Self {
        let seed = seed + 1000 * from_environment("KRAWL_SEED").unwrap_or(0);
        Random(crate::random::Random::new(seed))
    }

    pub fn bits(&mut self) -> u64 {
        self.0.bits()
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (0.5f64).powi(53)
    }

    pub fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    pub fn sign(&mut self) -> f64 {
        if self.bits() & 1 == 0 { 1.0 } else { -1.0 }
    }
}

/// How many times the usual number of cases to run, and a seed to add, from the environment
/// (KRAWL_EFFORT, KRAWL_SEED): for long searches.
pub fn effort(rounds: usize) -> usize {
    rounds * from_environment("KRAWL_EFFORT").unwrap_or(1) as usize
}

fn from_environment(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Problems that come with krawl, by their files' names.
pub fn problems(names: &[&str]) -> Vec<Problem> {
    names.iter().map(|name| testing::shipped(name)).collect()
}

/// Some of them.
pub fn shipped() -> Vec<Problem> {
    problems(&["disulfide", "dodecagon", "icosahedron-c1", "octahedron"])
}

/// A decimal times a power of ten, exactly. `None`: out of range.
pub fn times_ten_to(x: &Decimal, exponent: i32) -> Option<Decimal> {
    let text = x.text();
    let (mantissa, old) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    format!("{mantissa}e{}", old.parse::<i32>().ok()? + exponent)
        .parse()
        .ok()
}

/// The same in another unit. `None`: out of range.
pub fn scaled(problem: &Problem, exponent: i32) -> Option<Problem> {
    let mut problem = problem.clone();
    for point in &mut problem.points {
        for x in &mut point.sketch {
            *x = times_ten_to(x, exponent)?;
        }
    }
    for distance in &mut problem.distances {
        distance.target = match &distance.target {
            Target::Length(length) => Target::Length(times_ten_to(length, exponent)?),
            Target::SquaredLength(x) => Target::SquaredLength(times_ten_to(x, 2 * exponent)?),
        };
    }
    let bend = &mut problem.homotopy.bend_coefficient;
    *bend = times_ten_to(bend, exponent)?;
    Some(problem)
}

/// Whether two solutions may have the same points.
pub fn boxes_meet(a: &Solution, b: &Solution) -> bool {
    let mut pairs = a.points.iter().flatten().zip(b.points.iter().flatten());
    pairs.all(|(x, y)| !x.disjoint(*y))
}

/// A number with few digits, so that its decimal is what people would write.
pub fn rounded(x: f64, digits: i32) -> f64 {
    let power = 10f64.powi(digits);
    (x * power).round() / power
}

/// The edges of a graph that is rigid for generic lengths, made by Henneberg's steps: a point
/// joined to as many others as there are axes, or put on an edge and joined to one less.
pub fn random_edges(random: &mut Random, dimension: usize, points: usize) -> Vec<[usize; 2]> {
    let mut edges: Vec<[usize; 2]> = (0..dimension)
        .flat_map(|b| (0..b).map(move |a| [a, b]))
        .collect();
    for p in dimension..points {
        let mut ends = Vec::new();
        if random.below(2) == 0 && edges.len() > 1 && p > dimension {
            let [a, b] = edges.swap_remove(random.below(edges.len()));
            ends.extend([a, b]);
        }
        let wanted = if ends.is_empty() {
            dimension
        } else {
            dimension + 1
        };
        while ends.len() < wanted {
            let q = random.below(p);
            if !ends.contains(&q) {
                ends.push(q);
            }
        }
        edges.extend(ends.into_iter().map(|q| [q, p]));
    }
    edges.sort_unstable();
    edges
}

/// A problem on such a graph, its targets away from the sketch by a factor up to 1 ± `change`.
pub fn random_problem(
    random: &mut Random,
    dimension: usize,
    points: usize,
    change: f64,
) -> Problem {
    loop {
        let edges = random_edges(random, dimension, points);
        let places: Vec<Vec<f64>> = (0..points)
            .map(|_| {
                (0..dimension)
                    .map(|_| rounded(random.between(-1.0, 1.0), 2))
                    .collect()
            })
            .collect();
        let name = |p: usize| format!("p{p}");
        let mut builder = Problem::build("random", dimension);
        for (p, place) in places.iter().enumerate() {
            builder = builder.point(&name(p), place.iter().copied());
        }
        for &[a, b] in &edges {
            let length = (0..dimension)
                .map(|k| (places[a][k] - places[b][k]).powi(2))
                .sum::<f64>()
                .sqrt();
            let target = rounded(length * (1.0 + random.between(-change, change)), 3).max(0.001);
            builder = builder.distance(&name(a), &name(b), target);
        }
        if let Ok(problem) = builder
            .bend_coefficient([2.0, 0.3, 0.05, -0.1][random.below(4)])
            .finish()
        {
            return problem;
        }
    }
}

/// A problem in which constraints of all kinds stand in place of some distances.
pub fn mixed_problem(random: &mut Random, dimension: usize) -> Problem {
    loop {
        if let Some((_, problem)) = mixed::Spec::random(dimension, &mut |n| random.below(n)) {
            return problem;
        }
    }
}

/// Whether a short run round the path closes.
pub fn closes(problem: &Problem, space: Space) -> bool {
    let options = Options {
        space,
        max_steps: 600,
        ..Options::certified()
    };
    let outcome = solve(problem, &options, &mut Control::default());
    outcome.is_ok_and(|outcome| outcome.status == Status::Closed)
}

/// A test, and what its proofs are made of that tubes do not keep.
pub trait Stated<const N: usize>: Test<N> {
    /// Of one proof.
    type Kept: Clone;

    /// Of the last one.
    fn kept(&self) -> Self::Kept;
}

/// A of the tube.
impl Stated<{ ORDER + 1 }> for KrawczykTest {
    type Kept = Matrix;

    fn kept(&self) -> Matrix {
        self.a.clone()
    }
}

/// The bounds, and what bounds Φ(0) row by row.
impl Stated<COEFFICIENTS> for ReducedTest {
    type Kept = (Bounds, Vec<f64>);

    fn kept(&self) -> (Bounds, Vec<f64>) {
        (self.last, self.defect.to_vec())
    }
}

/// A proved tube, and what its proof was made of.
#[derive(Clone)]
pub struct Proved<const N: usize, T: Stated<N>> {
    pub tube: Tube<N, T::Frame>,
    pub kept: T::Kept,
}

impl<const N: usize, T: Stated<N>> Proved<N, T> {
    pub fn normal(&self) -> &[f64] {
        &self.tube.local.normal
    }
}

/// What is needed to make tubes by hand.
pub struct Maker<const N: usize, T: Stated<N>> {
    pub equations: Equations,
    pub inverter: InverseMaker,
    pub test: T,
    pub max_h: f64,
}

/// In the full space.
pub type Sample = Proved<{ ORDER + 1 }, KrawczykTest>;
pub type Workshop = Maker<{ ORDER + 1 }, KrawczykTest>;

/// In the reduced space.
pub type ReducedTube = Tube<COEFFICIENTS, <ReducedTest as Test<COEFFICIENTS>>::Frame>;
pub type ReducedSample = Proved<COEFFICIENTS, ReducedTest>;
pub type Shop = Maker<COEFFICIENTS, ReducedTest>;

impl<const N: usize, T: Stated<N>> Maker<N, T> {
    pub fn new(homotopy: &Homotopy, max_h: f64) -> Self {
        Self::with_alpha(homotopy, Options::certified().alpha, max_h)
    }

    pub fn with_alpha(homotopy: &Homotopy, alpha: f64, max_h: f64) -> Self {
        let equations = Equations::new(homotopy);
        let options = Options {
            space: T::SPACE,
            alpha,
            ..Options::certified()
        };
        Maker {
            inverter: equations.inverter(),
            test: T::new(homotopy, &equations, &options),
            equations,
            max_h,
        }
    }

    /// A proved tube at the point and with the normal given; `first`: after some rounds for what is found by proving.
    pub fn tube(&mut self, z: &[f64], normal: &[f64], first: bool) -> Option<Proved<N, T>> {
        let n = self.equations.n();
        let mut tube = Tube::new(&self.equations);
        tube.local.z[0][..n].copy_from_slice(&z[..n]);
        tube.local.normal[..n].copy_from_slice(&normal[..n]);
        let (test, equations) = (&mut self.test, &self.equations);
        test.refine(equations, &mut tube.local, 1e-9).ok()?;
        test.expand(equations, &mut tube.local).ok()?;
        if first {
            test.prepare(equations, &mut tube, self.max_h);
        }
        if !test.prove(equations, &mut tube, self.max_h) {
            return None;
        }
        let kept = test.kept();
        tube.exit_at = 0.97 * tube.proof.h;
        test.enclose_exit(equations, &mut tube)?;
        test.accept(&tube);
        Some(Proved { tube, kept })
    }

    /// Linked tubes from the sketch on, at most `count`, each tried so many half lengths behind the exit of the one before.
    pub fn chain(&mut self, homotopy: &Homotopy, count: usize) -> Vec<Proved<N, T>> {
        const REACH: f64 = 0.85;
        let first = at_sketch(homotopy, &self.equations, &mut self.inverter)
            .and_then(|local| self.tube(&local.z[0], &local.normal, true));
        let mut chain: Vec<_> = first.into_iter().collect();
        let [mut z, mut normal] = [0, 1].map(|_| self.equations.vector());
        let mut trust = 1.0f64;
        while let Some(Proved { tube: last, .. }) = chain.last()
            && chain.len() < count
            && trust > 1e-6
        {
            let advance = last.exit_at + REACH * trust * last.proof.h;
            last.local.predict(advance, None, &mut z, &mut normal);
            let next = self.tube(&z, &normal, false).and_then(|mut next| {
                next.tube.entry = last.leads_to(&next.tube)?;
                Some(next)
            });
            match next {
                Some(next) => {
                    chain.push(next);
                    trust = (1.5 * trust).min(1.0);
                }
                None => {
                    self.test.reject();
                    trust *= 0.6;
                }
            }
        }
        chain
    }
}

impl Shop {
    /// What the bounds of a tube for |s| ≤ `h` are, whether or not they prove anything.
    pub fn bounds_at(&mut self, tube: &mut ReducedTube, h: f64) -> Option<(Bounds, Vec<f64>)> {
        self.test.bounds_at(&self.equations, tube, h)?;
        Some(self.test.kept())
    }
}

impl Workshop {
    /// Proves a tube around its middle as it is, with these weights and at most so long: whether that was possible.
    pub fn prove_as_it_is(&mut self, tube: &mut Tube, mut weights: Vector, max_h: f64) -> bool {
        let (test, equations) = (&mut self.test, &self.equations);
        let proof = test.prove(equations, &tube.local, &mut weights, max_h);
        if let Some(proof) = proof {
            tube.proof = proof;
            tube.weights.copy_from_slice(&test.u);
            tube.exit_at = 0.97 * proof.h;
        }
        proof.is_some()
    }
}
