//! Complex numbers whose parts are floats or double-doubles.

use super::DoubleDouble;
use crate::elimination::Field;
use crate::equations::{Halved, Ring};
use nalgebra::ComplexField;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// What complex numbers are made of.
pub trait Number:
    Copy
    + Default
    + PartialEq
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
{
    /// Whether this has twice a float's digits.
    const IS_DOUBLE: bool;

    /// a b + c.
    fn fused(a: Self, b: Self, c: Self) -> Self;
    /// About 1 / a.
    fn inverse(self) -> Self;
    /// The float near it.
    fn rough(self) -> f64;
    /// What that leaves.
    fn rest(self) -> f64;
    /// The number near a double-double.
    fn near(value: DoubleDouble) -> Self;
}

impl Number for f64 {
    const IS_DOUBLE: bool = false;

    #[inline(always)]
    fn fused(a: Self, b: Self, c: Self) -> Self {
        a.mul_add(b, c)
    }

    fn inverse(self) -> Self {
        1.0 / self
    }

    #[inline(always)]
    fn rough(self) -> f64 {
        self
    }

    fn rest(self) -> f64 {
        0.0
    }

    fn near(value: DoubleDouble) -> Self {
        value.hi
    }
}

impl Number for DoubleDouble {
    const IS_DOUBLE: bool = true;

    #[inline(always)]
    fn fused(a: Self, b: Self, c: Self) -> Self {
        a * b + c
    }

    /// One step of Newton's method from the float nearest to it.
    fn inverse(self) -> Self {
        let near = DoubleDouble::from(1.0 / self.hi);
        near + near * (DoubleDouble::from(1.0) - self * near)
    }

    #[inline(always)]
    fn rough(self) -> f64 {
        self.hi
    }

    fn rest(self) -> f64 {
        self.lo
    }

    fn near(value: DoubleDouble) -> Self {
        value
    }
}

/// A complex number.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Complex<N> {
    /// The real part.
    pub re: N,
    /// The imaginary part.
    pub im: N,
}

impl<N: Number> Complex<N> {
    /// From both parts.
    #[inline(always)]
    pub fn new(re: N, im: N) -> Self {
        Complex { re, im }
    }

    /// A real number.
    #[inline(always)]
    pub fn real(re: f64) -> Self {
        Complex::new(re.into(), 0.0.into())
    }

    /// About the square of its size.
    #[inline(always)]
    pub fn norm_sqr(self) -> f64 {
        let (re, im) = (self.re.rough(), self.im.rough());
        re * re + im * im
    }

    /// At most a few roundings below |re| + |im|, which is its size or more.
    pub fn sum_of_sizes(self) -> f64 {
        self.re.rough().abs() + self.im.rough().abs()
    }

    /// About 1 / z.
    pub fn inverse(self) -> Self {
        let scale = N::fused(self.re, self.re, self.im * self.im).inverse();
        Complex::new(self.re * scale, -(self.im * scale))
    }

    /// Both parts in other numbers.
    pub fn map<M>(self, part: impl Fn(N) -> M) -> Complex<M> {
        let [re, im] = [self.re, self.im].map(part);
        Complex { re, im }
    }

    /// This number times a real one.
    #[inline(always)]
    pub fn times(self, factor: N) -> Self {
        Complex::new(self.re * factor, self.im * factor)
    }
}

impl Complex<DoubleDouble> {
    /// About a square root.
    pub fn sqrt(self) -> Self {
        let near = ComplexField::sqrt(nalgebra::Complex::new(self.re.hi, self.im.hi));
        let mut root = Complex::new(near.re.into(), near.im.into());
        if near.norm_sqr() > 0.0 {
            for _ in 0..2 {
                root = (root + self * root.inverse()).times(0.5.into());
            }
        }
        root
    }
}

impl<N: Number> Add for Complex<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Complex::new(self.re + other.re, self.im + other.im)
    }
}

impl<N: Number> Sub for Complex<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Complex::new(self.re - other.re, self.im - other.im)
    }
}

impl<N: Number> Neg for Complex<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Complex::new(-self.re, -self.im)
    }
}

impl<N: Number> Mul for Complex<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Complex::new(
            self.re * other.re - self.im * other.im,
            self.re * other.im + self.im * other.re,
        )
    }
}

impl<N: Number> Div for Complex<N> {
    type Output = Self;
    #[allow(clippy::suspicious_arithmetic_impl)]
    fn div(self, other: Self) -> Self {
        self * other.inverse()
    }
}

impl<N: Number> Ring for Complex<N> {
    fn whole(number: i32) -> Self {
        Complex::real(f64::from(number))
    }
}

impl<N: Number> Halved for Complex<N> {
    fn halves(self, count: i32) -> Self {
        self.times((0.5 * f64::from(count)).into())
    }
}

impl<N: Number> Field for Complex<N> {
    fn size(&self) -> f64 {
        self.norm_sqr().sqrt()
    }
}
