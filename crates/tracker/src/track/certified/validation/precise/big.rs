//! Numbers of 256 bits, and linear algebra with them.

use crate::equations::{Halved, Ring};
use crate::interval::{Interval, hull};
use crate::rational::Rational;
use dashu_float::FBig;
use dashu_float::ops::Abs;
use dashu_float::round::mode::HalfEven;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

const BITS: usize = 256;

/// A float with a mantissa of 256 bits: every operation is correctly rounded, exponents are unbounded.
#[derive(Debug, Clone, PartialEq, PartialOrd)]
pub struct Big(FBig<HalfEven>);

pub type Rows = Vec<Vec<Big>>;

impl Big {
    /// Exactly.
    pub fn of(x: f64) -> Self {
        let x = FBig::<HalfEven>::try_from(x).expect("a number");
        Big(x.with_precision(BITS).value())
    }

    pub fn ratio(x: &Rational) -> Self {
        let part = |x: &num_bigint::BigInt| -> FBig<HalfEven> {
            let text = format!("{x:x}");
            let (negative, digits) = match text.strip_prefix('-') {
                Some(digits) => (true, digits),
                None => (false, &text[..]),
            };
            // In base 16, four bits a digit: exact where it fits, as inputs do.
            let sixteen = Big::of(16.0);
            let sum = digits.chars().fold(Big::of(0.0), |sum, digit| {
                &sum * &sixteen + Big::of(f64::from(digit.to_digit(16).expect("a digit")))
            });
            if negative { -sum.0 } else { sum.0 }
        };
        Big(part(x.numer()) / part(x.denom()))
    }

    pub fn sqrt(&self) -> Self {
        Big(self.0.sqrt())
    }

    pub fn abs(&self) -> Self {
        Big(self.0.clone().abs())
    }

    pub fn max(self, other: Self) -> Self {
        if self < other { other } else { self }
    }

    pub fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }

    /// What holds it.
    pub fn enclosure(&self) -> Interval {
        let x = self.to_f64();
        hull(x.next_down(), x.next_up())
    }

    /// Up to what 256 bits may be off after some operations: where an interval is a single float.
    pub fn is_in(&self, x: Interval) -> bool {
        let slack = self.abs() * Big::of(0.5f64.powi(220));
        Big::of(x.inf()) <= self + &slack && self - &slack <= Big::of(x.sup())
    }
}

macro_rules! operators {
    ($($trait:ident $f:ident),*) => {$(
        impl $trait for Big {
            type Output = Big;
            fn $f(self, other: Big) -> Big { Big(self.0.$f(other.0)) }
        }
        impl $trait<&Big> for &Big {
            type Output = Big;
            fn $f(self, other: &Big) -> Big { Big((&self.0).$f(&other.0)) }
        }
        impl $trait<&Big> for Big {
            type Output = Big;
            fn $f(self, other: &Big) -> Big { Big(self.0.$f(&other.0)) }
        }
        impl $trait<Big> for &Big {
            type Output = Big;
            fn $f(self, other: Big) -> Big { Big((&self.0).$f(other.0)) }
        }
    )*};
}
operators!(Add add, Sub sub, Mul mul, Div div);

impl Ring for Big {
    fn whole(number: i32) -> Self {
        Big::of(number.into())
    }
}

impl Halved for Big {
    fn halves(self, count: i32) -> Self {
        self * Big::of(0.5 * f64::from(count))
    }
}

impl Neg for Big {
    type Output = Big;
    fn neg(self) -> Big {
        Big(-self.0)
    }
}

impl AddAssign for Big {
    fn add_assign(&mut self, other: Big) {
        self.0 += other.0;
    }
}

impl SubAssign for Big {
    fn sub_assign(&mut self, other: Big) {
        self.0 -= other.0;
    }
}

impl Sum for Big {
    fn sum<I: Iterator<Item = Big>>(terms: I) -> Big {
        terms.fold(Big::of(0.0), |sum, x| sum + x)
    }
}

pub fn dot(a: &[Big], b: &[Big]) -> Big {
    let parts = nonzero(a).into_iter();
    parts.map(|(i, x)| x * &b[i]).sum()
}

/// A vector of floats, exactly.
pub fn exact(x: &[f64]) -> Vec<Big> {
    x.iter().map(|&x| Big::of(x)).collect()
}

/// Σ c_k sᵏ.
pub fn horner(coefficients: &[f64], s: &Big) -> Big {
    let mut out = Big::of(0.0);
    for &c in coefficients.iter().rev() {
        out = &out * s + Big::of(c);
    }
    out
}

/// Its derivative by s.
pub fn horner_slope(coefficients: &[f64], s: &Big) -> Big {
    let mut out = Big::of(0.0);
    for (k, &c) in coefficients.iter().enumerate().skip(1).rev() {
        out = &out * s + Big::of(k as f64) * Big::of(c);
    }
    out
}

/// What is not zero in a row, with where it stands.
fn nonzero(row: &[Big]) -> Vec<(usize, Big)> {
    let zero = Big::of(0.0);
    let entries = row.iter().cloned().enumerate();
    entries.filter(|(_, x)| *x != zero).collect()
}

/// X with A X = G, by Gauss's elimination with row pivots. `None`: A is singular.
pub fn solve(mut a: Rows, mut g: Rows) -> Option<Rows> {
    let n = a.len();
    for k in 0..n {
        let best = (k..n).max_by(|&i, &j| {
            let sizes = a[i][k].abs().partial_cmp(&a[j][k].abs());
            sizes.expect("numbers")
        })?;
        a.swap(k, best);
        g.swap(k, best);
        if a[k][k] == Big::of(0.0) {
            return None;
        }
        let scale = Big::of(1.0) / &a[k][k];
        let (row, right) = (nonzero(&a[k][k + 1..]), nonzero(&g[k]));
        for i in k + 1..n {
            if a[i][k] == Big::of(0.0) {
                continue;
            }
            let factor = &a[i][k] * &scale;
            for (j, y) in &row {
                a[i][k + 1 + j] -= &factor * y;
            }
            for (j, y) in &right {
                g[i][*j] -= &factor * y;
            }
        }
    }
    for k in (0..n).rev() {
        let scale = Big::of(1.0) / &a[k][k];
        let mut row = g[k].clone();
        for (j, factor) in nonzero(&a[k][k + 1..]) {
            for (x, y) in row.iter_mut().zip(&g[k + 1 + j]) {
                *x -= &factor * y;
            }
        }
        g[k] = row.iter().map(|x| x * &scale).collect();
    }
    Some(g)
}
