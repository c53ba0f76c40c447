//! The proofs' bounds, checked in arithmetic of 256 bits from the problems' exact data: a bound that
//! is too small by one rounding shows, where an enclosure in floats would hide it.
//!
//! The numbers that a tube keeps (ẑ's coefficients, preconditioners, boxes) are exact here: the
//! theorems hold whatever they are, so that some tests change them on purpose, which makes terms
//! large that are otherwise of rounding's size.

pub mod big;
mod contraction;
mod extended;
mod figure;
mod float;
mod folds;
pub mod full;
mod given;
mod moved;
pub mod reduced;
mod shears;
mod short_tubes;
pub mod view;

pub use figure::Figure;

use super::disguise::{Disguised, run};
use super::*;
use crate::track::Status;
use crate::track::certified::link::Ball;
use big::{Big, Rows, dot, exact, horner, horner_slope, solve};
use std::collections::BTreeMap;

/// How near the true values come to what bounds them: the largest ratio by name, and how many there were.
#[derive(Debug, Default)]
pub struct Ratios(BTreeMap<&'static str, (usize, f64)>);

/// What 256 bits themselves may be off, many orders below any bound: numbers here are of the size
/// 1e-12 to 1e6, and no condition is beyond 1e6.
pub const OWN: f64 = 1e-62;

impl Ratios {
    /// A true value and its bound.
    #[track_caller]
    pub fn check(&mut self, name: &'static str, value: &Big, bound: f64) {
        assert!(!bound.is_nan(), "{name}: no bound");
        let ratio = if bound.is_finite() {
            assert!(
                *value <= Big::of(bound) + Big::of(OWN),
                "{name}: {:e} > {bound:e}",
                value.to_f64()
            );
            if bound > OWN {
                value.to_f64() / bound
            } else {
                0.0
            }
        } else {
            0.0
        };
        let (count, largest) = self.0.entry(name).or_default();
        *count += 1;
        *largest = largest.max(ratio);
    }

    pub fn count(&self, name: &str) -> usize {
        self.0.get(name).map_or(0, |r| r.0)
    }

    pub fn largest(&self, name: &str) -> f64 {
        self.0.get(name).map_or(0.0, |r| r.1)
    }

    pub fn all(&self) -> usize {
        self.0.values().map(|r| r.0).sum()
    }

    /// A bound that nothing comes near says little about the proof.
    #[track_caller]
    pub fn come_near(&self, least: &[(&str, f64)]) {
        println!("{} comparisons: {:.4?}", self.all(), self.0);
        for &(name, least) in least {
            assert!(
                self.largest(name) >= least,
                "{name} comes to {} of its bound only",
                self.largest(name)
            );
        }
    }
}

/// Problems to look at: small and large, in the plane and in space,
pub const REGULAR: [&str; 6] = [
    "octahedron",
    "disulfide",
    "k33",
    "prism",
    "icosahedron-c1",
    "dodecagon",
];
/// and nearly singular ones.
pub const SINGULAR: [&str; 8] = [
    "hard/flaps-apart-3",
    "hard/graze-4",
    "hard/fold-5",
    "hard/crowd-2",
    "hard/sliver-3",
    "hard/lengths-1",
    "hard/tents-split-4",
    "hard/triple-2",
];

/// A problem with its homotopy, also in exact numbers.
pub struct Case {
    pub problem: Problem,
    pub homotopy: Homotopy,
    pub figure: Figure,
}

impl Case {
    pub fn new(problem: Problem) -> Self {
        let homotopy = Homotopy::new(&problem).expect("a gauge");
        (problem, homotopy).into()
    }
}

impl From<(Problem, Homotopy)> for Case {
    fn from((problem, homotopy): (Problem, Homotopy)) -> Self {
        Case {
            figure: Figure::new(&problem, &homotopy),
            problem,
            homotopy,
        }
    }
}

/// So many places in a chain, as far apart as they can be.
pub fn spread<T>(chain: &[T], count: usize) -> impl Iterator<Item = usize> + use<T> {
    (0..chain.len()).step_by((chain.len() / count).max(1))
}

/// A generated one.
pub fn generated(family: crate::generate::Family, size: usize) -> Problem {
    crate::generate::Recipe::new(family, size)
        .problem()
        .expect("a recipe")
}

/// Random problems of distances written as other equations, with products of all kinds, several of degree 4 in
/// t: those whose paths close.
pub fn tails(seed: u64, count: usize) -> Vec<Case> {
    let mut random = Random::new(seed);
    let list: Vec<Case> = (0..count)
        .filter_map(|round| {
            let dimension = 2 + round % 2;
            let points = dimension + 1 + random.below(4);
            let plain = random_problem(&mut random, dimension, points, 0.3);
            let disguised = Disguised::new(&plain, 0.8, &mut random).with_homotopy()?;
            let closes = run(&disguised.1, false).status == Status::Closed;
            closes.then(|| disguised.into())
        })
        .collect();
    assert!(3 * list.len() > 2 * count - 2);
    list
}

/// Problems with constraints of all kinds, whose paths close.
pub fn mixed(seed: u64, count: usize) -> Vec<Case> {
    let mut random = Random::new(seed);
    let list: Vec<Case> = (0..count)
        .map(|round| mixed_problem(&mut random, 2 + round % 2))
        .filter(|problem| closes(problem, Space::Full))
        .map(Case::new)
        .collect();
    assert!(2 * list.len() > count, "{} of {count} close", list.len());
    list
}

/// A triangle that is its own target, one side of which grows from 1 to 2 and back as t goes from 0 to 1.
pub fn triangle() -> Problem {
    Problem::build("triangle", 2)
        .point("a", [0.0, 0.0])
        .point("b", [1.0, 0.0])
        .point("c", [0.375, 1.5])
        .squared_distance("a", "b", 1.0)
        .squared_distance("a", "c", 2.390625)
        .squared_distance("b", "c", 2.640625)
        .bend(["a", "b"])
        .bend_coefficient(4.0)
        .finish()
        .expect("a problem")
}

/// A parameter in [−h, h]: at the ends, anywhere, and near the middle.
pub fn parameter(random: &mut Random, h: f64) -> f64 {
    match random.below(6) {
        0 => h,
        1 => -h,
        2 => 0.0,
        3 => 1e-3 * random.between(-h, h),
        _ => random.between(-h, h),
    }
}

/// ẑ(s), its low words included, and ẑ'(s).
pub fn at<const N: usize, Y>(tube: &Tube<N, Y>, s: &Big) -> (Vec<Big>, Vec<Big>) {
    let of = |i: usize| std::array::from_fn::<f64, N, _>(|k| tube.local.z[k][i]);
    let all = 0..tube.weights.len() - 1;
    (
        all.clone()
            .map(|i| horner(&of(i), s) + Big::of(tube.local.low[i]))
            .collect(),
        all.map(|i| horner_slope(&of(i), s)).collect(),
    )
}

/// max |v_i| / u_i.
pub fn norm(u: &[f64], v: &[Big]) -> Big {
    v.iter()
        .zip(u)
        .map(|(v, &u)| v.abs() / Big::of(u))
        .fold(Big::of(0.0), Big::max)
}

/// The norm of a matrix that belongs to it.
pub fn norm_of(u: &[f64], m: &Rows) -> Big {
    let weights = exact(&u[..m.len()]);
    let row = |(i, row): (usize, &Vec<Big>)| {
        let sizes: Vec<Big> = row.iter().map(Big::abs).collect();
        dot(&sizes, &weights) / &weights[i]
    };
    m.iter().enumerate().map(row).fold(Big::of(0.0), Big::max)
}

/// A corner of the box of so many times the size u, or any of its points.
pub fn in_box(random: &mut Random, u: &[f64], size: f64) -> Vec<Big> {
    let corner = random.below(2) == 0;
    u.iter()
        .map(|&u| {
            let part = if corner { 1.0 } else { random.unit() };
            Big::of(random.sign() * part * size) * Big::of(u)
        })
        .collect()
}

/// I − M.
pub fn identity_minus(mut m: Rows) -> Rows {
    for (i, row) in m.iter_mut().enumerate() {
        for (j, x) in row.iter_mut().enumerate() {
            *x = Big::of(if i == j { 1.0 } else { 0.0 }) - &*x;
        }
    }
    m
}

/// A point as exits are kept: its nearest floats, with low words where the tube has such, and what is left.
pub fn ball_at<const N: usize, Y>(tube: &Tube<N, Y>, z: &[Big]) -> Ball {
    let mut ball = tube.exit.clone();
    ball.low.fill(0.0);
    for (i, z) in z.iter().enumerate() {
        ball.centre[i] = z.to_f64();
        let mut left = z - &Big::of(ball.centre[i]);
        if tube.local.is_extended {
            ball.low[i] = left.to_f64();
            left -= Big::of(ball.low[i]);
        }
        ball.radius[i] = left.abs().to_f64().next_up();
    }
    ball
}

/// Whether a point of the path is in a tube between these parameters.
pub fn is_between<const N: usize, Y>(tube: &Tube<N, Y>, z: &[Big], (lo, hi): (f64, f64)) -> bool {
    let g = |s: f64| {
        let (there, _) = at(tube, &Big::of(s));
        let away: Vec<Big> = z.iter().zip(&there).map(|(z, x)| z - x).collect();
        dot(&exact(&tube.local.normal[..z.len()]), &away)
    };
    g(lo) >= Big::of(0.0) && g(hi) <= Big::of(0.0)
}

/// The exit of the tube before, and the path's direction there: it is in this tube where its entry
/// says, and this tube is followed the same way.
pub fn check_entry<const N: usize, Y>(tube: &Tube<N, Y>, (z, direction): (&[Big], &[Big])) {
    assert!(
        is_between(tube, z, tube.entry),
        "the entry is not in {:?}",
        tube.entry
    );
    assert!(
        dot(&exact(&tube.local.normal[..z.len()]), direction) > Big::of(0.0),
        "the next tube is followed backwards"
    );
}

/// Brings what follows from ẑ's coefficients up to date with them.
pub fn settle<const N: usize, Y>(equations: &Equations, local: &mut crate::track::full::Local<N, Y>)
where
    Y: crate::track::full::Preconditioner,
{
    let m = equations.m;
    equations.differences(&local.z[0], &mut local.d[0]);
    for k in 1..N {
        equations.directions(&local.z[k], &mut local.d[k]);
    }
    equations.expand_lengths(local.z[0][m], &mut local.lengths);
    let t: Vec<f64> = (0..local.powers[0].len())
        .map(|k| if 0 < k && k < N { local.z[k][m] } else { 0.0 })
        .collect();
    let mut power = vec![0.0; t.len()];
    power[0] = 1.0;
    for out in &mut local.powers {
        let next = (0..t.len()).map(|k| (0..=k).map(|a| t[a] * power[k - a]).sum());
        power = next.collect();
        out.copy_from_slice(&power);
    }
}
