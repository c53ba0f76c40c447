//! Krawczyk's test in all free coordinates: a box that holds exactly one figure, and how far around its middle
//! there is no other.

use crate::elimination::invert;
use crate::interval::rounding::{gamma, largest, round_up};
use crate::interval::{Interval, hull, point};
use serde::{Deserialize, Serialize};

/// A figure with the distances wanted, in the base of a plan, proved to exist.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Figure {
    /// The middle of its box, three coordinates a point, in the search's unit.
    pub centre: Vec<[f64; 3]>,
    /// How far the exact figure may be from it, in each free coordinate.
    pub radius: f64,
    /// No other figure in the same base is within this of the middle, in every free coordinate.
    pub alone: f64,
}

/// The equations of a problem of distances in the base of a plan.
#[derive(Debug, Clone)]
pub struct Frame {
    dimension: usize,
    edges: Vec<[usize; 2]>,
    squares: Vec<Interval>,
    /// The unknown that a coordinate is, at `3 point + axis`, or [`FIXED`].
    unknown: Vec<usize>,
    /// The number of unknowns; of equations as well, where any figure is to be proved.
    pub m: usize,
    /// The last points of the base lie on the positive side of this coordinate's zero.
    upper: Vec<usize>,
}

const FIXED: usize = usize::MAX;

/// How far the zero of quadratic equations F is from a point x, and how far around it there is no other, which is looked for up to `most`; both in
/// the norm max |w_i|. With Y ≈ J(x)⁻¹, ‖I − Y J(x + w)‖ ≤ q₀ + κ|w|, so that there is at most one zero for |w| < (1 − q₀)/κ, and exactly one,
/// at most ‖Y F(x)‖/(1 − q) away, where that is small enough. `step`: a bound on ‖Y F(x)‖. `None`: no zero is proved.
pub fn alone([q0, kappa, step]: [f64; 3], most: f64) -> Option<[f64; 2]> {
    if !(q0 < 0.5 && kappa < 1e30) {
        return None;
    }
    let alone = match kappa > 0.0 {
        true => (0.9 * (0.9 - q0) / kappa).min(most),
        false => most,
    };
    let q = round_up(q0 + kappa * alone, 4);
    let radius = round_up(step / (1.0 - q), 8);
    (q < 1.0 && radius < 0.1 * alone).then_some([radius, alone])
}

/// The same where F is anywhere in a range, for every F there: the zero's box may be nearly as wide as where it is alone.
///
/// As F is quadratic, w − Y F(x + w) = −Y F(x) + (I − Y J(x + w/2)) w: with q = q₀ + κ r/2 and ‖Y F(x)‖/(1 − q) ≤ r the ball of radius r is mapped into
/// itself, so that it holds a zero, and as r is less than how far around x there is at most one, exactly one. r is sought from ‖Y F(x)‖ up.
pub fn alone_within([q0, kappa, step]: [f64; 3], most: f64) -> Option<[f64; 2]> {
    const ROUNDS: usize = 20;
    let [_, alone] = alone([q0, kappa, 0.0], most)?;
    let mut radius = step;
    for _ in 0..ROUNDS {
        // Made wider, so that rounds come to an end.
        let wide = round_up(1.01 * radius, 2);
        let q = round_up(q0 + 0.5 * kappa * wide, 4);
        if !(q < 1.0 && wide < alone) {
            return None;
        }
        radius = round_up(step / (1.0 - q), 8);
        if radius <= wide {
            return Some([radius, alone]);
        }
    }
    None
}

impl Frame {
    /// For so many points, with these squares of distances.
    pub fn new(
        (dimension, points): (usize, usize),
        edges: &[[usize; 2]],
        squares: &[Interval],
        base: &[usize],
    ) -> Self {
        let mut unknown = vec![FIXED; 3 * points];
        let mut m = 0;
        for p in 0..points {
            let place = base.iter().position(|&b| b == p).unwrap_or(dimension);
            for axis in 0..place {
                unknown[3 * p + axis] = m;
                m += 1;
            }
        }
        let upper = base.iter().enumerate().skip(1);
        Frame {
            dimension,
            edges: edges.to_vec(),
            squares: squares.to_vec(),
            m,
            upper: upper
                .map(|(place, &p)| unknown[3 * p + place - 1])
                .collect(),
            unknown,
        }
    }

    /// Proves that one figure is near a centre, with any inverse.
    pub fn prove(&self, centre: &[[f64; 3]]) -> Option<Figure> {
        let fits = 3 * centre.len() == self.unknown.len() && self.m == self.edges.len();
        let mut all = centre.iter().flatten().zip(&self.unknown);
        if !(fits && all.all(|(x, i)| *i != FIXED || *x == 0.0)) {
            return None;
        }
        let mut y = Vec::new();
        self.jacobian(centre, &mut y);
        invert(&mut y, self.m).then(|| self.test(centre.to_vec(), &y))?
    }

    fn free<'a>(&'a self, figure: &'a [[f64; 3]]) -> impl Iterator<Item = (usize, f64)> + 'a {
        let all = figure.iter().flatten().zip(&self.unknown);
        all.filter(|(_, i)| **i != FIXED).map(|(x, i)| (*i, *x))
    }

    /// F_e = ½(|p_a − p_b|² − s_e).
    pub fn residual(&self, figure: &[[f64; 3]], f: &mut [f64]) {
        for ((&[a, b], s), f) in self.edges.iter().zip(&self.squares).zip(f) {
            let squared: f64 = (0..self.dimension)
                .map(|k| (figure[a][k] - figure[b][k]).powi(2))
                .sum();
            *f = 0.5 * (squared - s.mid());
        }
    }

    /// The entries of the Jacobian's row of an equation.
    pub fn row(&self, figure: &[[f64; 3]], e: usize, mut entry: impl FnMut(usize, f64)) {
        let [a, b] = self.edges[e];
        for k in 0..self.dimension {
            let d = figure[a][k] - figure[b][k];
            for (p, d) in [(a, d), (b, -d)] {
                let i = self.unknown[3 * p + k];
                if i != FIXED {
                    entry(i, d);
                }
            }
        }
    }

    /// The figure moved by a step in the unknowns.
    pub fn moved(&self, figure: &mut [[f64; 3]], step: &[f64], factor: f64) {
        for (p, x) in figure.iter_mut().enumerate() {
            for k in 0..self.dimension {
                let i = self.unknown[3 * p + k];
                if i != FIXED {
                    x[k] += factor * step[i];
                }
            }
        }
    }

    /// The full Jacobian, row by row.
    pub fn jacobian(&self, figure: &[[f64; 3]], out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.m * self.edges.len(), 0.0);
        for e in 0..self.edges.len() {
            let row = &mut out[e * self.m..(e + 1) * self.m];
            self.row(figure, e, |i, x| row[i] += x);
        }
    }

    /// With Y ≈ J⁻¹: what [`alone`] makes of it.
    fn test(&self, x: Vec<[f64; 3]>, y: &[f64]) -> Option<Figure> {
        let m = self.m;
        let (mut q0, mut kappa, mut step) = (0.0, 0.0, 0.0);
        let residual: Vec<f64> = (0..m)
            .map(|e| {
                let [a, b] = self.edges[e];
                let squared = (0..self.dimension).fold(point(0.0), |sum, k| {
                    sum + (point(x[a][k]) - point(x[b][k])).sqr()
                });
                ((squared - self.squares[e]) * point(0.5)).mag()
            })
            .collect();
        // Per row of J: the sizes of its entries, and how much |w| = 1 changes their sum.
        let mut sizes = vec![0.0; m];
        let mut changes = vec![0.0; m];
        for e in 0..m {
            let mut free = [0.0f64; 3];
            let [a, b] = self.edges[e];
            for k in 0..self.dimension {
                let count = [a, b]
                    .iter()
                    .filter(|&&p| self.unknown[3 * p + k] != FIXED)
                    .count();
                free[k] = count as f64;
            }
            self.row(&x, e, |_, d| sizes[e] += d.abs());
            changes[e] = free.iter().map(|f| f * f).sum();
        }
        let mut row = vec![0.0; m];
        for i in 0..m {
            row.fill(0.0);
            row[i] = -1.0;
            let (mut size, mut change, mut off) = (1.0, 0.0, 0.0);
            for e in 0..m {
                let y = y[i * m + e];
                self.row(&x, e, |k, d| row[k] += y * d);
                size += y.abs() * sizes[e];
                change += y.abs() * changes[e];
                off += y.abs() * residual[e];
            }
            let defect: f64 = row.iter().map(|x| x.abs()).sum();
            // An entry of J is rounded once, and passes through m products and sums.
            q0 = largest(q0, round_up(defect + gamma(m + 6) * size, 2 * m + 12));
            kappa = largest(kappa, round_up(change, m + 6));
            step = largest(step, round_up(off, m + 6));
        }
        let [radius, alone] = alone([q0, kappa, step], 1.0)?;
        // A figure in the base, not one reflected in an axis of it.
        let mut upper = true;
        for (i, value) in self.free(&x) {
            upper &= !self.upper.contains(&i) || value > radius;
        }
        upper.then_some(Figure {
            centre: x,
            radius,
            alone,
        })
    }
}

impl Figure {
    /// The mirror image in the base: the last coordinate with the other sign.
    pub fn mirrored(&self, dimension: usize) -> Figure {
        let mut image = self.clone();
        for p in &mut image.centre {
            p[dimension - 1] = -p[dimension - 1];
        }
        image
    }

    /// The greatest difference of coordinates of the middles.
    pub fn distance(&self, other: &Figure) -> f64 {
        let pairs = self
            .centre
            .iter()
            .flatten()
            .zip(other.centre.iter().flatten());
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, largest)
    }

    /// Whether both are the same figure: the box of this one lies where the other is alone.
    pub fn is_same(&self, other: &Figure) -> bool {
        round_up(self.distance(other) + self.radius, 4) < other.alone
    }

    /// Whether both are surely different.
    pub fn is_apart(&self, other: &Figure) -> bool {
        let range = |x: f64, r: f64| point(x) + hull(-r, r);
        let pairs = self
            .centre
            .iter()
            .flatten()
            .zip(other.centre.iter().flatten());
        pairs
            .into_iter()
            .any(|(&x, &y)| range(x, self.radius).disjoint(range(y, other.radius)))
    }
}
