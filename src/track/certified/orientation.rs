//! Which signs of triangles and tetrahedra a path keeps, by proof.
//!
//! A sign is that of the determinant of the differences of the points from the first one: twice a signed
//! area in the plane, six times a signed volume in space.

use super::link::{Frame, Tube};
use crate::interval::rounding::{gamma, round_up};
use crate::linalg::Vector;
use crate::system::{Homotopy, simplices};
use crate::track::arc::{Figure, Orientation};

/// A tube is cut into at most 2 to this power pieces to tell a sign.
const DEPTH: usize = 10;

/// Signs and what becomes of them.
#[derive(Debug)]
pub struct Orientations {
    all: Vec<Simplex>,
    /// Those whose sign is known so far.
    known: Vec<u32>,
    /// Where the points of a piece of path are, and how far they may be from there.
    middle: Vector,
    radius: Vector,
    slope: Vector,
}

/// A triangle in the plane, a tetrahedron in space.
#[derive(Debug)]
struct Simplex {
    /// The entries of its points' coordinates, point by point.
    entries: [[u32; 3]; 4],
    what: Orientation,
}

impl Orientations {
    /// Of each point and as many of the points joined to it as there are dimensions.
    pub fn new(homotopy: &Homotopy, spare: &Vector) -> Self {
        let (d, m) = (homotopy.dimension, homotopy.equations);
        let pairs = homotopy.edges.iter().map(|edge| edge.points);
        let mut all = simplices(d, homotopy.points, pairs);
        all.extend(homotopy.followed.iter().cloned());
        for points in &mut all {
            points.sort_unstable();
        }
        all.sort_unstable();
        all.dedup();
        let entry = |p: usize, axis: usize| match homotopy.gauge.variable.get(p * d + axis) {
            Some(&i) if axis < d && i < m => i as u32,
            _ => m as u32 + 1,
        };
        let all = all.into_iter().map(|points| Simplex {
            entries: std::array::from_fn(|k| {
                std::array::from_fn(|axis| entry(points[k.min(d)], axis))
            }),
            what: Orientation {
                points,
                sign: 0,
                lost: None,
            },
        });
        Orientations {
            all: all.collect(),
            known: Vec::new(),
            middle: spare.clone(),
            radius: spare.clone(),
            slope: spare.clone(),
        }
    }

    /// Finds the signs of a figure.
    pub fn begin(&mut self, figure: &Figure) {
        let m = figure.centre.len();
        self.middle[..m].copy_from_slice(&figure.centre);
        for i in 0..m {
            self.radius[i] = round_up(figure.radius[i] + figure.low[i].abs(), 1);
        }
        self.known.clear();
        for (index, simplex) in self.all.iter_mut().enumerate() {
            simplex.what.lost = None;
            simplex.what.sign = simplex.sign(&self.middle, &self.radius);
            if simplex.what.sign != 0 {
                self.known.push(index as u32);
            }
        }
    }

    /// Follows the signs along a tube, between two parameters.
    pub fn follow<const D: usize, const N: usize, Y: Frame<D>>(
        &mut self,
        tube: &Tube<D, N, Y>,
        (from, to): (f64, f64),
    ) {
        let mut known = std::mem::take(&mut self.known);
        let mut doubtful = known.clone();
        self.split(tube, (from, to), DEPTH, &mut doubtful);
        if !doubtful.is_empty() {
            known.retain(|index| !doubtful.contains(index));
        }
        self.known = known;
    }

    /// Leaves those that are lost between two parameters, and notes where.
    fn split<const D: usize, const N: usize, Y: Frame<D>>(
        &mut self,
        tube: &Tube<D, N, Y>,
        (a, b): (f64, f64),
        depth: usize,
        doubtful: &mut Vec<u32>,
    ) {
        if doubtful.is_empty() {
            return;
        }
        self.look(tube, a, b);
        let (middle, radius) = (&self.middle, &self.radius);
        let all = &self.all;
        doubtful.retain(|&index| {
            let simplex = &all[index as usize];
            simplex.sign(middle, radius) != simplex.what.sign
        });
        if doubtful.is_empty() {
            return;
        }
        let half = 0.5 * (a + b);
        if depth == 0 || !(a < half && half < b) {
            let t = tube.time().range(a, b);
            for &index in doubtful.iter() {
                self.all[index as usize].what.lost = Some(t);
            }
            return;
        }
        let mut first = doubtful.clone();
        self.split(tube, (a, half), depth - 1, &mut first);
        doubtful.retain(|index| !first.contains(index));
        self.split(tube, (half, b), depth - 1, doubtful);
        doubtful.extend(first);
    }

    /// Encloses the path between two parameters of a tube.
    fn look<const D: usize, const N: usize, Y: Frame<D>>(
        &mut self,
        tube: &Tube<D, N, Y>,
        a: f64,
        b: f64,
    ) {
        let n = tube.weights.len() - 1;
        let (z, proof) = (&tube.local.z, &tube.proof);
        let middle = 0.5 * (a + b);
        let half = round_up((b - middle).max(middle - a), 4);
        let reach = a.abs().max(b.abs());
        let rounding = gamma(4 * N);
        // One order after the other of all entries together. The radii are the sizes at first.
        let values = &mut self.middle[..n - 1];
        let sizes = &mut self.radius[..n - 1];
        let slopes = &mut self.slope[..n - 1];
        values.fill(0.0);
        sizes.fill(0.0);
        slopes.fill(0.0);
        for k in (0..N).rev() {
            let sums = values.iter_mut().zip(&mut *slopes).zip(&mut *sizes);
            for (((value, slope), size), &z) in sums.zip(&z[k][..n - 1]) {
                *value = value.mul_add(middle, z);
                *slope = slope.mul_add(reach, *size);
                *size = size.mul_add(reach, z.abs());
            }
        }
        let (weights, low) = (&tube.weights[..n - 1], &tube.local.low[..n - 1]);
        for i in 0..n - 1 {
            let spread = half * slopes[i] + proof.distance * weights[i];
            let rounded = rounding * sizes[i] + low[i].abs();
            sizes[i] = round_up(spread + rounded, 8 * N);
        }
    }

    /// What became of all of them.
    pub fn account(&self) -> Vec<Orientation> {
        self.all
            .iter()
            .map(|simplex| simplex.what.clone())
            .collect()
    }
}

impl Simplex {
    /// The sign, where it is the same within all radii; otherwise 0.
    fn sign(&self, middle: &[f64], radius: &[f64]) -> i8 {
        // Of one length, so that one check of an index serves both.
        let radius = &radius[..middle.len()];
        let at = |k: usize| -> Vague {
            let entries = self.entries[k].map(|i| i as usize);
            (entries.map(|i| middle[i]), entries.map(|i| radius[i]))
        };
        let first = at(0);
        let side = |k: usize| -> Vague {
            let other = at(k);
            let d: [f64; 3] = std::array::from_fn(|axis| other.0[axis] - first.0[axis]);
            // The difference's own rounding is relative to it.
            let error = |axis: usize| other.1[axis] + first.1[axis] + f64::EPSILON * d[axis].abs();
            (d, std::array::from_fn(error))
        };
        let (value, size, error) = if self.what.points.len() == 3 {
            debug_assert!(self.entries[0][2] as usize == middle.len() - 1);
            determinant_of_two(side(1), side(2))
        } else {
            determinant_of_three(side(1), side(2), side(3))
        };
        // Products of three, sums of six: fewer than 20 roundings.
        let error = round_up(error + gamma(20) * size, 30);
        if value > error {
            1
        } else if value < -error {
            -1
        } else {
            0
        }
    }
}

/// A vector, and how far its components may be off.
type Vague = ([f64; 3], [f64; 3]);

/// The value, the size of its terms, and how far it may be off, of u × v.
fn determinant_of_two((u, du): Vague, (v, dv): Vague) -> (f64, f64, f64) {
    let error = |x: f64, dx: f64, y: f64, dy: f64| x.abs() * dy + dx * (y.abs() + dy);
    (
        u[0] * v[1] - u[1] * v[0],
        (u[0] * v[1]).abs() + (u[1] * v[0]).abs(),
        error(u[0], du[0], v[1], dv[1]) + error(u[1], du[1], v[0], dv[0]),
    )
}

/// The value, the size of its terms, and how far it may be off, of u · (v × w).
fn determinant_of_three((u, du): Vague, (v, dv): Vague, (w, dw): Vague) -> (f64, f64, f64) {
    let term = |i: usize, j: usize, k: usize| -> (f64, f64, f64) {
        let (v1, dv1, v2, dv2) = (v[j], dv[j], v[k], dv[k]);
        let (w1, dw1, w2, dw2) = (w[j], dw[j], w[k], dw[k]);
        let (x, dx) = (u[i], du[i]);
        let minor = v1 * w2 - v2 * w1;
        let size_of_minor = (v1 * w2).abs() + (v2 * w1).abs();
        let error_of_minor =
            (v1.abs() * dw2 + dv1 * (w2.abs() + dw2)) + (v2.abs() * dw1 + dv2 * (w1.abs() + dw1));
        (
            x * minor,
            x.abs() * size_of_minor,
            x.abs() * error_of_minor + dx * (size_of_minor + error_of_minor),
        )
    };
    let (a, b, c) = (term(0, 1, 2), term(1, 2, 0), term(2, 0, 1));
    (a.0 + b.0 + c.0, a.1 + b.1 + c.1, a.2 + b.2 + c.2)
}
