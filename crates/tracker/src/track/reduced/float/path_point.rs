//! Points of the path and what lies between two of them.

use super::cubic::{Cubic, weights};

/// A point of the path in the full space, with its tangent: whatever plan is in use, the path is
/// this one. Free and fixed places, then t.
#[derive(Debug, Clone, Default)]
pub(super) struct PathPoint {
    pub z: Vec<f64>,
    /// The unit tangent in the direction of travel.
    pub tangent: Vec<f64>,
}

impl PathPoint {
    pub fn new(places: usize) -> Self {
        PathPoint {
            z: vec![0.0; places + 1],
            tangent: vec![0.0; places + 1],
        }
    }

    pub fn figure(&self) -> &[f64] {
        &self.z[..self.z.len() - 1]
    }

    pub fn t(&self) -> f64 {
        self.z[self.z.len() - 1]
    }

    pub fn slope(&self) -> f64 {
        self.tangent[self.z.len() - 1]
    }
}

/// The piece of the path between two points, `h` long.
pub(super) struct Piece<'a> {
    from: &'a PathPoint,
    to: &'a PathPoint,
    h: f64,
}

impl<'a> Piece<'a> {
    pub fn new(from: &'a PathPoint, to: &'a PathPoint, h: f64) -> Self {
        Piece { from, to, h }
    }

    /// The cubic through both ends at arc length `s` from the first; beyond the second end it
    /// is the predictor.
    pub fn at(&self, s: f64, out: &mut [f64]) {
        let [a, b, c, d] = weights(s / self.h);
        let (c, d) = (c * self.h, d * self.h);
        let ends = self.from.z.iter().zip(&self.to.z);
        let tangents = self.from.tangent.iter().zip(&self.to.tangent);
        for ((out, (x, y)), (u, v)) in out.iter_mut().zip(ends).zip(tangents) {
            *out = a.mul_add(*x, b.mul_add(*y, c.mul_add(*u, d * v)));
        }
    }

    /// t along the piece.
    pub fn t(&self) -> Cubic {
        Cubic {
            h: self.h,
            x: [self.from.t(), self.to.t()],
            slope: [self.from.slope(), self.to.slope()],
        }
    }

    /// `normal · (z − point)` along the piece.
    pub fn height(&self, normal: &[f64], point: &[f64]) -> Cubic {
        let height = |z: &[f64]| dot_difference(normal, z, point);
        Cubic {
            h: self.h,
            x: [height(&self.from.z), height(&self.to.z)],
            slope: [
                dot(normal, &self.from.tangent),
                dot(normal, &self.to.tangent),
            ],
        }
    }

    /// The length of the piece up to `s`, with figures stretched by `unit` (Simpson's rule).
    pub fn length(&self, s: f64, unit: f64) -> f64 {
        let places = self.from.z.len() - 1;
        // The derivative of the cubic, as weights of values and slopes.
        let speed = |u: f64| {
            let a = 6.0 * u * (u - 1.0) / self.h;
            let (c, d) = ((u - 1.0) * (3.0 * u - 1.0), u * (3.0 * u - 2.0));
            let (x, y) = (&self.from.z[..places], &self.to.z[..places]);
            let (v, w) = (&self.from.tangent[..places], &self.to.tangent[..places]);
            let mut squared = 0.0;
            for k in 0..places {
                let slope = a * (x[k] - y[k]) + c * v[k] + d * w[k];
                squared += slope * slope;
            }
            let t = a * (self.from.t() - self.to.t()) + c * self.from.slope() + d * self.to.slope();
            (unit * unit * squared + t * t).sqrt()
        };
        // At the ends the tangents are unit vectors.
        let end =
            |slope: f64| (unit * unit * (1.0 - slope * slope).max(0.0) + slope * slope).sqrt();
        let u = s / self.h;
        let last = if u == 1.0 {
            end(self.to.slope())
        } else {
            speed(u)
        };
        s / 6.0 * (end(self.from.slope()) + 4.0 * speed(0.5 * u) + last)
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    sum_of(a, b, |x, y| x * y)
}

pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    sum_of(a, b, |x, y| (x - y) * (x - y)).sqrt()
}

fn dot_difference(normal: &[f64], a: &[f64], b: &[f64]) -> f64 {
    normal
        .iter()
        .zip(a.iter().zip(b))
        .map(|(n, (x, y))| n * (x - y))
        .sum()
}

/// A sum in four strands, which the compiler turns into vector instructions.
#[inline(always)]
fn sum_of(a: &[f64], b: &[f64], f: impl Fn(f64, f64) -> f64) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut strands = [0.0; 4];
    for (a, b) in a.iter().zip(b) {
        for k in 0..4 {
            strands[k] += f(a[k], b[k]);
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(&x, &y)| f(x, y)).sum();
    strands.iter().sum::<f64>() + rest
}
