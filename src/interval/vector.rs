//! Vectors of three intervals.

use super::Interval;
use crate::places::Each as _;

/// A vector in space; in the plane the last entry is zero.
pub type Vector = [Interval; 3];

/// a − b.
pub fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a · b.
pub fn dot(a: Vector, b: Vector) -> Interval {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b.
pub fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// v / |v|; `None` where v may be zero.
pub fn unit(v: Vector) -> Option<Vector> {
    let length = (v[0].sqr() + v[1].sqr() + v[2].sqr()).sqrt();
    (length.inf() > 0.0).then(|| v.each(|x| x / length))
}
