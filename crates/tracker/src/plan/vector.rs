//! Vectors of the space: coordinates as arrays.

use crate::places::array;

pub(super) type V3 = [f64; 3];

#[inline(always)]
pub(super) fn sub<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    array(|k| a[k] - b[k])
}

/// a + s b.
#[inline(always)]
pub(super) fn add_scaled<const D: usize>(a: [f64; D], s: f64, b: [f64; D]) -> [f64; D] {
    array(|k| s.mul_add(b[k], a[k]))
}

#[inline(always)]
pub(super) fn scale<const D: usize>(s: f64, a: [f64; D]) -> [f64; D] {
    array(|k| s * a[k])
}

#[inline(always)]
pub(super) fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    let mut sum = a[0] * b[0];
    for k in 1..D {
        sum = a[k].mul_add(b[k], sum);
    }
    sum
}

#[inline(always)]
pub(super) fn cross(a: V3, b: V3) -> V3 {
    let minor = |i: usize, j: usize| a[i].mul_add(b[j], -(a[j] * b[i]));
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

pub(super) fn norm<const D: usize>(a: [f64; D]) -> f64 {
    dot(a, a).sqrt()
}

/// The direction of `a`, where it has one.
pub(super) fn unit<const D: usize>(a: [f64; D]) -> Option<[f64; D]> {
    let length = norm(a);
    (length > 0.0 && length.is_finite()).then(|| scale(1.0 / length, a))
}

/// Some direction perpendicular to `a` (any, where `a` is zero).
pub(super) fn perpendicular(a: V3) -> V3 {
    let axis = (0..3)
        .min_by(|&i, &j| a[i].abs().total_cmp(&a[j].abs()))
        .unwrap_or(0);
    let mut e = [0.0; 3];
    e[axis] = 1.0;
    unit(cross(a, e)).unwrap_or([1.0, 0.0, 0.0])
}
