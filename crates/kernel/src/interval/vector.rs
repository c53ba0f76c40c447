//! Vectors of three numbers: intervals, floats, complex numbers.

use super::Interval;
use crate::places::{Each as _, array};
use std::ops::{Add, Mul, Sub};

/// A vector in space; in the plane the last entry is zero.
pub type Vector = [Interval; 3];

/// a − b.
pub fn minus<T: Copy + Sub<Output = T>>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a · b.
pub fn dot<T: Copy + Add<Output = T> + Mul<Output = T>>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b.
pub fn cross<T: Copy + Sub<Output = T> + Mul<Output = T>>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The vector in which a frame of these axes has these coordinates.
pub fn out_of<T: Copy + Add<Output = T> + Mul<Output = T>>(
    axes: &[[T; 3]; 3],
    v: &[T; 3],
) -> [T; 3] {
    array(|k| v[0] * axes[0][k] + v[1] * axes[1][k] + v[2] * axes[2][k])
}

/// |v|.
pub fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

/// |a − b|.
pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    length(minus(a, b))
}

/// v / |v|; `None` where v may be zero.
pub fn unit(v: Vector) -> Option<Vector> {
    let length = (v[0].sqr() + v[1].sqr() + v[2].sqr()).sqrt();
    (length.inf() > 0.0).then(|| v.each(|x| x / length))
}
