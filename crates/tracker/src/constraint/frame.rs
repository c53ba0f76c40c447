//! The sketch in exact numbers, and the frame in which figures are described.

use crate::decimal::Decimal;
use crate::interval::Real;
use crate::rational::Rational;
use crate::statement::Problem;
use std::ops::{Add, Mul, Sub};

/// A place or a direction in the coordinates of the file; the third number is zero in the plane.
pub type Vector = [Rational; 3];

/// The number zero.
pub fn zero() -> Rational {
    Rational::zero()
}

/// The vector of three decimals.
pub fn vector(of: &[Decimal; 3]) -> Vector {
    of.each_ref().map(|x| x.value().clone())
}

/// a + b.
pub fn plus<T>(a: &[T; 3], b: &[T; 3]) -> [T; 3]
where
    for<'a> &'a T: Add<&'a T, Output = T>,
{
    std::array::from_fn(|k| &a[k] + &b[k])
}

/// a − b.
pub fn minus<T>(a: &[T; 3], b: &[T; 3]) -> [T; 3]
where
    for<'a> &'a T: Sub<&'a T, Output = T>,
{
    std::array::from_fn(|k| &a[k] - &b[k])
}

/// factor · a.
pub fn times<T>(factor: &T, a: &[T; 3]) -> [T; 3]
where
    for<'a> &'a T: Mul<&'a T, Output = T>,
{
    a.each_ref().map(|x| factor * x)
}

/// a · b.
pub fn dot<T>(a: &[T; 3], b: &[T; 3]) -> T
where
    for<'a> &'a T: Add<&'a T, Output = T> + Mul<&'a T, Output = T>,
{
    let product = |k: usize| &a[k] * &b[k];
    &(&product(0) + &product(1)) + &product(2)
}

/// a × b.
pub fn cross<T>(a: &[T; 3], b: &[T; 3]) -> [T; 3]
where
    for<'a> &'a T: Sub<&'a T, Output = T> + Mul<&'a T, Output = T>,
{
    let minor = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// The z coordinate of a × b: in the plane, |a| |b| times the sine of the angle from a to b.
pub fn cross_in_plane(a: &Vector, b: &Vector) -> Rational {
    &a[0] * &b[1] - &a[1] * &b[0]
}

/// Whether all coordinates are zero.
pub fn is_zero(a: &Vector) -> bool {
    a.iter().all(Rational::is_zero)
}

/// |a|.
pub fn length(a: &Vector) -> Real {
    Real::from(dot(a, a)).sqrt()
}

/// Where coordinates are counted from and along what: the reference of a problem (the first of its
/// points at the origin, the second on the x axis, the third in the xy plane), or the file's own axes.
#[derive(Debug, Clone)]
pub struct Frame {
    /// The origin.
    pub origin: Vector,
    /// A vector along each axis.
    axes: [Vector; 3],
}

impl Frame {
    /// The frame of a problem whose reference has been checked.
    pub fn new(problem: &Problem) -> Self {
        let place = |k: usize| vector(&problem.points[problem.homotopy.reference[k]].sketch);
        let (o, one) = (zero(), Rational::one());
        if problem.is_absolute() {
            return Frame {
                origin: [o.clone(), o.clone(), o.clone()],
                axes: [
                    [one.clone(), o.clone(), o.clone()],
                    [o.clone(), one.clone(), o.clone()],
                    [o.clone(), o, one],
                ],
            };
        }
        let origin = place(0);
        let along = minus(&place(1), &origin);
        let axes = if problem.dimension == 2 {
            let turned = [-&along[1], along[0].clone(), zero()];
            [along, turned, [zero(), zero(), one]]
        } else {
            let normal = cross(&along, &minus(&place(2), &origin));
            [along.clone(), cross(&normal, &along), normal]
        };
        Frame { origin, axes }
    }

    /// The coordinate of a direction along an axis of the frame.
    pub fn component(&self, of: &Vector, axis: usize) -> Real {
        let along = &self.axes[axis];
        let product = dot(along, of);
        if product.is_zero() {
            return Real::zero();
        }
        &Real::from(product) / &length(along)
    }

    /// The coordinate of a place along an axis of the frame.
    pub fn coordinate(&self, of: &Vector, axis: usize) -> Real {
        self.component(&minus(of, &self.origin), axis)
    }
}
