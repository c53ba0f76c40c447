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
        for i in 0..n - 1 {
            let (mut value, mut size, mut slope) = (0.0f64, 0.0f64, 0.0f64);
            for k in (0..N).rev() {
                let z = z[k][i];
                value = value.mul_add(middle, z);
                slope = slope.mul_add(reach, size);
                size = size.mul_add(reach, z.abs());
            }
            self.middle[i] = value;
            let spread = half * slope + proof.distance * tube.weights[i];
            let rounded = rounding * size + tube.local.low[i].abs();
            self.radius[i] = round_up(spread + rounded, 8 * N);
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
        let [first, others @ ..] = &self.entries;
        let side = |k: usize| -> [(f64, f64); 3] {
            std::array::from_fn(|axis| {
                let (i, j) = (others[k][axis] as usize, first[axis] as usize);
                let d = middle[i] - middle[j];
                // The difference's own rounding is relative to it.
                (d, radius[i] + radius[j] + f64::EPSILON * d.abs())
            })
        };
        let spare = middle.len() - 1;
        let (value, size, error) = if self.what.points.len() == 3 {
            debug_assert!(first[2] as usize == spare);
            determinant_of_two(side(0), side(1))
        } else {
            determinant_of_three(side(0), side(1), side(2))
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

/// The value, the size of its terms, and how far it may be off, of u × v.
fn determinant_of_two(u: [(f64, f64); 3], v: [(f64, f64); 3]) -> (f64, f64, f64) {
    let [(a, da), (b, db), _] = u;
    let [(c, dc), (d, dd), _] = v;
    let error = |x: f64, dx: f64, y: f64, dy: f64| x.abs() * dy + dx * (y.abs() + dy);
    (
        a * d - b * c,
        (a * d).abs() + (b * c).abs(),
        error(a, da, d, dd) + error(b, db, c, dc),
    )
}

/// The same of u · (v × w).
fn determinant_of_three(
    u: [(f64, f64); 3],
    v: [(f64, f64); 3],
    w: [(f64, f64); 3],
) -> (f64, f64, f64) {
    let (mut value, mut size, mut error) = (0.0, 0.0, 0.0);
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        let [(v1, dv1), (v2, dv2)] = [v[j], v[k]];
        let [(w1, dw1), (w2, dw2)] = [w[j], w[k]];
        let (x, dx) = u[i];
        let minor = v1 * w2 - v2 * w1;
        let size_of_minor = (v1 * w2).abs() + (v2 * w1).abs();
        let error_of_minor =
            (v1.abs() * dw2 + dv1 * (w2.abs() + dw2)) + (v2.abs() * dw1 + dv2 * (w1.abs() + dw1));
        value += x * minor;
        size += x.abs() * size_of_minor;
        error += x.abs() * error_of_minor + dx * (size_of_minor + error_of_minor);
    }
    (value, size, error)
}
