//! Which signs of triangles and tetrahedra a path keeps, by proof.
//!
//! A sign is that of the determinant of the differences of the points from the first one: twice a signed
//! area in the plane, six times a signed volume in space. Likewise which lines and arcs do not vanish.

use super::link::{Frame, Tube};
use crate::interval::rounding::{gamma, round_up};
use crate::linalg::Vector;
use crate::places::{Each as _, array};
use crate::system::{Extent, Homotopy, simplices};
use crate::track::arc::{Figure, Kept, Orientation};

/// A tube is cut into at most 2 to this power pieces to tell a sign.
const DEPTH: usize = 10;
/// And into so many to tell where a line or an arc vanishes, which ends an edit.
const DEEP: usize = 40;

/// Signs and what becomes of them.
#[derive(Debug)]
pub struct Orientations {
    all: Vec<Simplex>,
    /// Those whose sign is known so far.
    known: Vec<u32>,
    /// Lines and arcs likewise, counted after the others.
    unbroken: Vec<u32>,
    /// Where the points of a piece of path are: `middle` + θ `slope`, −1 ≤ θ ≤ 1, and how far they may be from there.
    middle: Vector,
    slope: Vector,
    radius: Vector,
    /// Work space.
    curvature: Vector,
    size: Vector,
}

/// A triangle in the plane, a tetrahedron in space; or a line or arc.
#[derive(Debug)]
struct Simplex {
    /// The object and its extent, of a line or arc.
    segment: Option<(usize, Extent)>,
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
        let simplex = |points: Vec<usize>, segment| Simplex {
            segment,
            entries: array(|k| array(|axis| entry(points[k.min(points.len() - 1)], axis))),
            what: Orientation {
                points,
                sign: 0,
                lost: None,
            },
        };
        let segments = homotopy.segments.iter().map(|segment| {
            let points = segment.extent.points().to_vec();
            simplex(points, Some((segment.object, segment.extent.clone())))
        });
        let all = all.into_iter().map(|points| simplex(points, None));
        Orientations {
            all: all.chain(segments).collect(),
            known: Vec::new(),
            unbroken: Vec::new(),
            middle: spare.clone(),
            slope: spare.clone(),
            radius: spare.clone(),
            curvature: spare.clone(),
            size: spare.clone(),
        }
    }

    /// Finds the signs of a figure.
    pub fn begin(&mut self, figure: &Figure) {
        let m = figure.centre.len();
        self.middle[..m].copy_from_slice(&figure.centre);
        for i in 0..m {
            self.radius[i] = round_up(figure.radius[i] + figure.low[i].abs(), 1);
        }
        self.slope.fill(0.0);
        self.known.clear();
        self.unbroken.clear();
        for (index, simplex) in self.all.iter_mut().enumerate() {
            simplex.what.lost = None;
            simplex.what.sign = simplex.sign(&self.middle, &self.slope, &self.radius);
            if simplex.what.sign != 0 {
                match simplex.segment {
                    None => self.known.push(index as u32),
                    Some(_) => self.unbroken.push(index as u32),
                }
            }
        }
    }

    /// Follows the signs along a tube, between two parameters.
    pub fn follow<const N: usize, Y: Frame>(&mut self, tube: &Tube<N, Y>, (from, to): (f64, f64)) {
        let known = std::mem::take(&mut self.known);
        let unbroken = std::mem::take(&mut self.unbroken);
        let mut keep = |mut known: Vec<u32>, depth: usize| {
            let mut doubtful = known.clone();
            self.split(tube, (from, to), depth, &mut doubtful);
            if !doubtful.is_empty() {
                known.retain(|index| !doubtful.contains(index));
            }
            known
        };
        let (known, unbroken) = (keep(known, DEPTH), keep(unbroken, DEEP));
        (self.known, self.unbroken) = (known, unbroken);
    }

    /// Leaves those that are lost between two parameters, and notes where.
    fn split<const N: usize, Y: Frame>(
        &mut self,
        tube: &Tube<N, Y>,
        (a, b): (f64, f64),
        depth: usize,
        doubtful: &mut Vec<u32>,
    ) {
        if doubtful.is_empty() {
            return;
        }
        self.look(tube, a, b);
        let (middle, slope, radius) = (&self.middle, &self.slope, &self.radius);
        let all = &mut self.all;
        doubtful.retain(|&index| {
            let simplex = &mut all[index as usize];
            let (sign, before) = (simplex.sign(middle, slope, radius), simplex.what.sign);
            match &simplex.segment {
                None => sign != before,
                Some((_, extent)) if extent.goes_with(before, sign) => {
                    simplex.what.sign = sign;
                    false
                }
                Some(_) => true,
            }
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

    /// Encloses the path between two parameters of a tube: with c in the middle and r the largest parameter in size, the tube's
    /// polynomial p(s) differs from p(c) + p'(c)(s − c) by at most the sum of k(k − 1)/2 |p_k| rᵏ⁻² times (s − c)².
    fn look<const N: usize, Y: Frame>(&mut self, tube: &Tube<N, Y>, a: f64, b: f64) {
        let n = tube.weights.len() - 1;
        let (z, proof) = (&tube.local.z, &tube.proof);
        let middle = 0.5 * (a + b);
        let half = round_up((b - middle).max(middle - a), 4);
        let reach = a.abs().max(b.abs());
        // A coefficient goes through at most 2N roundings in Horner's scheme for the slope.
        let rounding = gamma(4 * N);
        // One order after the other of all entries together. `radius` is the sum of the sizes of the slope's terms at first.
        let values = &mut self.middle[..n - 1];
        let slopes = &mut self.slope[..n - 1];
        let changes = &mut self.radius[..n - 1];
        let curvatures = &mut self.curvature[..n - 1];
        let sizes = &mut self.size[..n - 1];
        values.fill(0.0);
        slopes.fill(0.0);
        changes.fill(0.0);
        curvatures.fill(0.0);
        sizes.fill(0.0);
        for k in (0..N).rev() {
            let sums = values.iter_mut().zip(&mut *slopes).zip(&mut *changes);
            let sums = sums.zip(&mut *curvatures).zip(&mut *sizes);
            for (((((value, slope), change), curvature), size), &z) in sums.zip(&z[k][..n - 1]) {
                *slope = slope.mul_add(middle, *value);
                *value = value.mul_add(middle, z);
                *curvature = curvature.mul_add(reach, *change);
                *change = change.mul_add(reach, *size);
                *size = size.mul_add(reach, z.abs());
            }
        }
        let (weights, low) = (&tube.weights[..n - 1], &tube.local.low[..n - 1]);
        for i in 0..n - 1 {
            slopes[i] *= half;
            let bent = curvatures[i] * half * half + proof.distance * weights[i];
            // The last one is of the product above.
            let rounded =
                rounding * (sizes[i] + changes[i] * half) + f64::EPSILON * slopes[i].abs();
            changes[i] = round_up(bent + rounded + low[i].abs(), 8 * N);
        }
    }

    /// What became of all triangles and tetrahedra.
    pub fn account(&self) -> Vec<Orientation> {
        let simplices = self.all.iter().filter(|simplex| simplex.segment.is_none());
        simplices.map(|simplex| simplex.what.clone()).collect()
    }

    /// What became of all lines and arcs.
    pub fn segments(&self) -> Vec<Kept> {
        let segments = self.all.iter().filter_map(|simplex| {
            let (object, _) = simplex.segment.as_ref()?;
            Some(Kept {
                object: *object,
                sign: simplex.what.sign,
                lost: simplex.what.lost,
            })
        });
        segments.collect()
    }
}

impl Simplex {
    /// The sign, where it is the same for every θ and within all radii; otherwise 0.
    fn sign(&self, middle: &[f64], slope: &[f64], radius: &[f64]) -> i8 {
        // Of one length, so that one check of an index serves all.
        let (slope, radius) = (&slope[..middle.len()], &radius[..middle.len()]);
        let at = |k: usize| {
            self.entries[k].each(|i| Along {
                value: middle[i as usize],
                slope: slope[i as usize],
                rest: radius[i as usize],
            })
        };
        let first = at(0);
        let side = |k: usize| -> [Along; 3] {
            let other = at(k);
            array(|axis| other[axis].minus(first[axis]))
        };
        let minor = |v: [Along; 3], w: [Along; 3], i: usize, j: usize| {
            v[i].times(w[j]).minus(v[j].times(w[i]))
        };
        // A term of `rest` goes through fewer than 12 roundings in a product, 5 in a sum, of which there are two and four.
        let certain = |value: Along| {
            let error = round_up(value.slope.abs() + value.rest, 60);
            i8::from(value.value > error) - i8::from(value.value < -error)
        };
        match &self.segment {
            Some((_, Extent::Along { axis, .. })) => return certain(side(1)[*axis]),
            Some((_, Extent::Sweep { .. })) => {
                let (u, v) = (side(1), side(2));
                return match certain(minor(u, v, 0, 1)) {
                    0 if certain(u[0].times(v[0]).plus(u[1].times(v[1]))) < 0 => 1,
                    sign => sign,
                };
            }
            None => {}
        }
        let value = if self.what.points.len() == 3 {
            assert!(self.entries[0][2] as usize == middle.len() - 1);
            minor(side(1), side(2), 0, 1)
        } else {
            let (u, v, w) = (side(1), side(2), side(3));
            let parts = [(0, 1, 2), (1, 2, 0), (2, 0, 1)];
            let [a, b, c] = parts.each(|(i, j, k)| u[i].times(minor(v, w, j, k)));
            a.plus(b).plus(c)
        };
        certain(value)
    }
}

/// A number on a piece of the path: `value` + θ `slope`, −1 ≤ θ ≤ 1, and something of at most `rest`, which holds the roundings of
/// the other two; its own, relative ones, are for the reader to count.
#[derive(Debug, Clone, Copy)]
struct Along {
    value: f64,
    slope: f64,
    rest: f64,
}

impl Along {
    fn plus(self, other: Along) -> Along {
        let (value, slope) = (self.value + other.value, self.slope + other.slope);
        let rounded = f64::EPSILON * (value.abs() + slope.abs());
        Along {
            value,
            slope,
            rest: self.rest + other.rest + rounded,
        }
    }

    fn minus(self, other: Along) -> Along {
        self.plus(Along {
            value: -other.value,
            slope: -other.slope,
            ..other
        })
    }

    /// With x = v + θs + e and y = v' + θs' + e': xy − vv' − θ(sv' + vs') is at most (|s| + |e|)(|s'| + |e'|) + |v e'| + |e v'|.
    fn times(self, other: Along) -> Along {
        let (v, s, e) = (self.value, self.slope, self.rest);
        let (w, t, f) = (other.value, other.slope, other.rest);
        let (value, one, two) = (v * w, s * w, v * t);
        // Three roundings to nearest at most in the slope, one in the value, each half an epsilon.
        let rounded = f64::EPSILON * (value.abs() + one.abs() + two.abs());
        let product = (s.abs() + e) * (t.abs() + f) + (v.abs() * f + e * w.abs());
        Along {
            value,
            slope: one + two,
            rest: product + rounded,
        }
    }
}
