//! Random figures and edits of them, and the truth about them by fine steps in floats: nothing of krawl's
//! trackers.

use krawl::problem::{Problem, Target};
use nalgebra::{DMatrix, DVector};

/// SplitMix64 (Steele, Lea, Flood 2014).
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * ((self.bits() >> 11) as f64 * (0.5f64).powi(53))
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }
}

/// A figure, one of its dimensions, and what it shall be.
pub struct Case {
    pub problem: Problem,
    pub index: usize,
    /// In thousandths.
    pub length: String,
}

/// So many places, in hundredths, between −1 and 1.
pub fn places(random: &mut Random, dimension: usize, points: usize) -> Vec<Vec<i64>> {
    let mut place = || -> Vec<i64> {
        let axes = (0..dimension).map(|_| random.between(-100.0, 100.0) as i64);
        axes.collect()
    };
    (0..points).map(|_| place()).collect()
}

/// The edges of a random graph that is rigid, by Henneberg's steps: a point joined to D others, or put on a distance and joined to
/// D − 1 more.
pub fn rigid(random: &mut Random, dimension: usize, points: usize) -> Vec<[usize; 2]> {
    let mut edges: Vec<[usize; 2]> = (0..dimension)
        .flat_map(|b| (0..b).map(move |a| [a, b]))
        .collect();
    for p in dimension..points {
        let mut ends = Vec::new();
        if random.below(2) == 0 && p > dimension {
            ends.extend(edges.swap_remove(random.below(edges.len())));
        }
        let wanted = dimension + usize::from(!ends.is_empty());
        while ends.len() < wanted {
            let q = random.below(p);
            if !ends.contains(&q) {
                ends.push(q);
            }
        }
        edges.extend(ends.into_iter().map(|q| [q, p]));
    }
    edges
}

/// A random well-constrained figure of so many points that meets its dimensions exactly (they are given by
/// their squares), with one dimension to be multiplied by a factor between these.
pub fn case(random: &mut Random, dimension: usize, points: usize, factor: (f64, f64)) -> Case {
    loop {
        let places = places(random, dimension, points);
        let edges = rigid(random, dimension, points);
        let name = |p: usize| format!("p{p}");
        let mut builder = Problem::build("random", dimension);
        for (p, place) in places.iter().enumerate() {
            let place = place.iter().map(|x| format!("{x}e-2"));
            builder = builder.point(
                &name(p),
                place.collect::<Vec<_>>().iter().map(|x| x.as_str()),
            );
        }
        let squared = |[a, b]: [usize; 2]| -> i64 {
            let terms = places[a].iter().zip(&places[b]);
            terms.map(|(x, y)| (x - y).pow(2)).sum()
        };
        for &[a, b] in &edges {
            let square = format!("{}e-4", squared([a, b]));
            builder = builder.squared_distance(&name(a), &name(b), square.as_str());
        }
        let Ok(problem) = builder.finish() else {
            continue;
        };
        let index = random.below(edges.len());
        let length = (squared(edges[index]) as f64).sqrt() / 100.0;
        let wanted = length * random.between(factor.0, factor.1);
        return Case {
            problem,
            index,
            length: format!("{wanted:.3}"),
        };
    }
}

/// What fine steps say.
#[derive(Debug, Clone, PartialEq)]
pub enum Truth {
    /// The figure at t = 1, points one after the other.
    Reached(Vec<f64>),
    /// No further than this t.
    Folded(f64),
}

/// The sketch of a problem, points one after the other.
pub fn sketch(problem: &Problem) -> Vec<f64> {
    let places = problem
        .points
        .iter()
        .map(|p| &p.sketch[..problem.dimension]);
    places.flatten().map(|x| x.to_f64()).collect()
}

/// The lengths of a problem.
pub fn lengths(problem: &Problem) -> Vec<f64> {
    let targets = problem.distances.iter().map(|d| match &d.target {
        Target::Length(x) => x.to_f64(),
        Target::SquaredLength(x) => x.to_f64().sqrt(),
    });
    targets.collect()
}

/// Half the squares of the distances less those of the lengths, and their derivatives.
pub fn system(problem: &Problem, x: &[f64], lengths: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
    let d = problem.dimension;
    let m = problem.distances.len();
    let mut f = DVector::zeros(m);
    let mut j = DMatrix::zeros(m, x.len());
    for (e, distance) in problem.distances.iter().enumerate() {
        let [a, b] = distance.points;
        let mut squared = 0.0;
        for k in 0..d {
            let difference = x[a * d + k] - x[b * d + k];
            squared += difference * difference;
            j[(e, a * d + k)] = difference;
            j[(e, b * d + k)] = -difference;
        }
        f[e] = 0.5 * (squared - lengths[e] * lengths[e]);
    }
    (f, j)
}

/// The shortest step that solves J s = f.
pub fn shortest(j: &DMatrix<f64>, f: &DVector<f64>) -> Option<DVector<f64>> {
    let s = (j * j.transpose()).lu().solve(f)?;
    Some(j.transpose() * s)
}

/// Follows the figure by steps in t so short that it cannot leave its branch.
pub fn truth(problem: &Problem, from: &[f64], to: &[f64]) -> Truth {
    let mut x = sketch(problem);
    let (mut t, mut step) = (0.0f64, 1e-3f64);
    while t < 1.0 {
        let next = (t + step).min(1.0);
        let at: Vec<f64> = from
            .iter()
            .zip(to)
            .map(|(a, b)| a + next * (b - a))
            .collect();
        match newton(problem, &x, &at) {
            Some(y) => {
                (x, t) = (y, next);
                step = (1.5 * step).min(1e-3);
            }
            None => step *= 0.5,
        }
        if step < 1e-10 {
            return Truth::Folded(t);
        }
    }
    Truth::Reached(x)
}

/// Newton's method, refused where it moves far or does not converge well.
fn newton(problem: &Problem, x: &[f64], lengths: &[f64]) -> Option<Vec<f64>> {
    let mut x = x.to_vec();
    let mut last = f64::INFINITY;
    for k in 0..8 {
        let (f, j) = system(problem, &x, lengths);
        let step = shortest(&j, &f)?;
        let size = step.norm();
        let allowed = if k == 0 { 1e-2 } else { 0.2 * last };
        if size < 1e-9 {
            return Some(x);
        }
        if size.is_nan() || size > allowed {
            return None;
        }
        x.iter_mut().zip(step.iter()).for_each(|(x, s)| *x -= s);
        last = size;
    }
    None
}

/// All distances between points, and the signs of all triangles or tetrahedra with the first points: what does
/// not depend on where a figure stands.
pub fn invariants(dimension: usize, x: &[f64]) -> Vec<f64> {
    let n = x.len() / dimension;
    let mut all = Vec::new();
    for a in 0..n {
        for b in 0..a {
            let d = (0..dimension).map(|k| (x[a * dimension + k] - x[b * dimension + k]).powi(2));
            all.push(d.sum::<f64>().sqrt());
        }
    }
    // One signed volume tells a figure from its image.
    let side = |p: usize, k: usize| x[p * dimension + k] - x[k];
    for p in dimension..n {
        all.push(if dimension == 2 {
            side(1, 0) * side(p, 1) - side(1, 1) * side(p, 0)
        } else {
            (0..3)
                .map(|k| {
                    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                    side(p, k) * (side(1, i) * side(2, j) - side(1, j) * side(2, i))
                })
                .sum()
        });
    }
    all
}
