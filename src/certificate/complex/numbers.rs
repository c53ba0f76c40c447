//! Complex numbers: rectangles of intervals, and floats.

use crate::interval::{Interval, point};

/// A rectangle in the complex plane.
#[derive(Debug, Clone, Copy)]
pub struct Rectangle {
    /// The real part.
    pub re: Interval,
    /// The imaginary part.
    pub im: Interval,
}

impl Rectangle {
    /// One number.
    pub fn point([re, im]: [f64; 2]) -> Self {
        Rectangle {
            re: point(re),
            im: point(im),
        }
    }

    /// A real number.
    pub fn real(re: Interval) -> Self {
        Rectangle { re, im: point(0.0) }
    }

    /// The sum.
    pub fn plus(self, other: Self) -> Self {
        Rectangle {
            re: self.re + other.re,
            im: self.im + other.im,
        }
    }

    /// The difference.
    pub fn minus(self, other: Self) -> Self {
        Rectangle {
            re: self.re - other.re,
            im: self.im - other.im,
        }
    }

    /// The product.
    pub fn times(self, other: Self) -> Self {
        Rectangle {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }

    /// Bounds of the sizes of both parts.
    pub fn size(self) -> f64 {
        self.re.mag().max(self.im.mag())
    }

    /// The conjugate.
    pub fn conjugate(self) -> Self {
        Rectangle {
            re: self.re,
            im: -self.im,
        }
    }

    /// The number times −1.
    pub fn negative(self) -> Self {
        Rectangle {
            re: -self.re,
            im: -self.im,
        }
    }

    /// Whether all of it is inside the other one, off its boundary.
    pub fn is_inside(self, other: Self) -> bool {
        let inside = |a: Interval, b: Interval| a.inf() > b.inf() && a.sup() < b.sup();
        inside(self.re, other.re) && inside(self.im, other.im)
    }

    /// Whether both have no number in common.
    pub fn is_apart(self, other: Self) -> bool {
        self.re.disjoint(other.re) || self.im.disjoint(other.im)
    }
}

type C = [f64; 2];

fn times(a: C, b: C) -> C {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// About the inverse of a matrix, in floats; `None` where there is none. Row after row.
pub fn about_inverse(mut a: Vec<Vec<C>>) -> Option<Vec<Vec<C>>> {
    let n = a.len();
    let mut inverse = vec![vec![[0.0; 2]; n]; n];
    for (k, row) in inverse.iter_mut().enumerate() {
        row[k] = [1.0, 0.0];
    }
    for k in 0..n {
        let size = |c: C| c[0].hypot(c[1]);
        let pivot = (k..n).max_by(|&i, &j| size(a[i][k]).total_cmp(&size(a[j][k])))?;
        a.swap(k, pivot);
        inverse.swap(k, pivot);
        let p = a[k][k];
        let square = p[0] * p[0] + p[1] * p[1];
        if !(square.is_normal()) {
            return None;
        }
        let per = [p[0] / square, -p[1] / square];
        for matrix in [&mut a, &mut inverse] {
            let row: Vec<C> = matrix[k].iter().map(|&x| times(x, per)).collect();
            matrix[k] = row;
        }
        for i in (0..n).filter(|&i| i != k) {
            let factor = a[i][k];
            for matrix in [&mut a, &mut inverse] {
                let row = matrix[k].clone();
                for (x, y) in matrix[i].iter_mut().zip(row) {
                    let product = times(factor, y);
                    *x = [x[0] - product[0], x[1] - product[1]];
                }
            }
        }
    }
    Some(inverse)
}
