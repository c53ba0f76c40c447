//! Complex numbers in floats and in double-doubles, and inverses of matrices of them.

use crate::interval::DoubleDouble;
use std::ops::{Add, Mul, Sub};

/// A complex number: its real and its imaginary part.
pub type Z = [DoubleDouble; 2];

/// A number of one of two precisions.
pub trait Number:
    Copy + From<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// The number nearest to this one.
    fn near(x: DoubleDouble) -> Self;
    /// The number itself.
    fn exactly(self) -> DoubleDouble;
}

impl Number for f64 {
    fn near(x: DoubleDouble) -> Self {
        x.hi
    }

    fn exactly(self) -> DoubleDouble {
        self.into()
    }
}

impl Number for DoubleDouble {
    fn near(x: DoubleDouble) -> Self {
        x
    }

    fn exactly(self) -> DoubleDouble {
        self
    }
}

/// The sum.
pub fn plus<T: Number>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// The difference.
pub fn minus<T: Number>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// The product.
pub fn times<T: Number>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// |Re| + |Im|, which is not below the size, up to three roundings.
pub fn size(z: Z) -> f64 {
    z[0].size() + z[1].size()
}

fn rough<T: Number>(z: [T; 2]) -> [f64; 2] {
    z.map(|x| x.exactly().hi)
}

/// About the inverse of a number, from that in floats by a step of Newton's method.
fn about_inverse_of<T: Number>(z: [T; 2]) -> Option<[T; 2]> {
    let [a, b] = rough(z);
    let square = a * a + b * b;
    if !square.is_normal() {
        return None;
    }
    let first = [a / square, -b / square].map(T::from);
    let left = minus([1.0, 0.0].map(T::from), times(z, first));
    Some(plus(first, times(first, left)))
}

/// About the inverse of a matrix; `None` where none is found. Row after row.
pub fn about_inverse<T: Number>(mut a: Vec<Vec<[T; 2]>>) -> Option<Vec<Vec<[T; 2]>>> {
    let n = a.len();
    let mut inverse = vec![vec![[T::from(0.0); 2]; n]; n];
    for (k, row) in inverse.iter_mut().enumerate() {
        row[k][0] = T::from(1.0);
    }
    for k in 0..n {
        let size = |z: [T; 2]| {
            let [a, b] = rough(z);
            a.hypot(b)
        };
        let pivot = (k..n).max_by(|&i, &j| size(a[i][k]).total_cmp(&size(a[j][k])))?;
        a.swap(k, pivot);
        inverse.swap(k, pivot);
        let per = about_inverse_of(a[k][k])?;
        for matrix in [&mut a, &mut inverse] {
            matrix[k].iter_mut().for_each(|x| *x = times(*x, per));
        }
        for i in (0..n).filter(|&i| i != k) {
            let factor = a[i][k];
            if rough(factor) == [0.0; 2] {
                continue;
            }
            for matrix in [&mut a, &mut inverse] {
                let row = matrix[k].clone();
                for (x, y) in matrix[i].iter_mut().zip(row) {
                    if rough(y) != [0.0; 2] {
                        *x = minus(*x, times(factor, y));
                    }
                }
            }
        }
    }
    Some(inverse)
}
