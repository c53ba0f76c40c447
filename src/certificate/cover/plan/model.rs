//! Functions of up to six symbols u ∈ [−1, 1], enclosed by quadratic polynomials with interval coefficients and an
//! interval for the rest. Every operation is an interval operation, so that all roundings are enclosed.

use super::format::MAX_SYMBOLS;
use crate::interval::{Interval, hull, point};

/// Coefficients of 1, u_i, u_i u_j.
const MOST: usize = (MAX_SYMBOLS + 1) * (MAX_SYMBOLS + 2) / 2;
use crate::interval::{UNIT as ONE, ZERO};

/// An enclosure of a function.
#[derive(Debug, Clone, Copy)]
pub struct Model {
    symbols: usize,
    c: [Interval; MOST],
    rest: Interval,
}

/// The place of the coefficient of u_i u_j, i ≤ j, symbols counted from 1, and 0 standing for the constant 1.
fn place(symbols: usize, i: usize, j: usize) -> usize {
    i * (symbols + 1) - i * i.saturating_sub(1) / 2 + j - i
}

impl Model {
    /// A constant.
    pub fn constant(symbols: usize, x: Interval) -> Self {
        let mut c = [ZERO; MOST];
        c[0] = x;
        Model {
            symbols,
            c,
            rest: ZERO,
        }
    }

    /// `middle + radius u_i`.
    pub fn symbol(symbols: usize, i: usize, middle: f64, radius: f64) -> Self {
        let mut out = Self::constant(symbols, point(middle));
        out.c[1 + i] = point(radius);
        out
    }

    fn count(&self) -> usize {
        (self.symbols + 1) * (self.symbols + 2) / 2
    }

    /// The coefficient of u_i.
    pub fn slope(&self, i: usize) -> Interval {
        self.c[1 + i]
    }

    /// A bound of the terms of degree 1, and one of those of degree 2.
    fn sizes(&self) -> [Interval; 2] {
        let sum =
            |range: std::ops::Range<usize>| self.c[range].iter().fold(ZERO, |sum, x| sum + x.abs());
        [
            sum(1..1 + self.symbols),
            sum(1 + self.symbols..self.count()),
        ]
    }

    /// How far the function may be from a number.
    pub fn distance(&self, from: f64) -> f64 {
        let [linear, quadratic] = self.sizes();
        ((self.c[0] - point(from)).abs() + linear + quadratic + self.rest.abs()).sup()
    }

    /// The middle of its constant: a guide, no bound.
    pub fn at_middle(&self) -> f64 {
        self.c[0].mid()
    }

    /// The polynomial without the rest.
    pub fn polynomial(&self) -> Model {
        Model {
            rest: ZERO,
            ..*self
        }
    }

    /// All functions that differ by no more than a range from one that is enclosed.
    pub fn widened(&self, by: Interval) -> Model {
        Model {
            rest: self.rest + by,
            ..*self
        }
    }

    /// How much it may vary about its constant: a guide, no bound.
    pub fn blur(&self) -> f64 {
        let [linear, quadratic] = self.sizes();
        (linear + quadratic + self.c[0].abs() + self.rest.abs()).sup()
    }

    /// f + k g.
    pub fn plus(&self, factor: Interval, other: &Model) -> Model {
        let mut out = *self;
        for q in 0..self.count() {
            out.c[q] += factor * other.c[q];
        }
        out.rest += factor * other.rest;
        out
    }

    /// f g.
    pub fn times(&self, other: &Model) -> Model {
        let s = self.symbols;
        let (a, b) = (&self.c, &other.c);
        let mut out = Self::constant(s, a[0] * b[0]);
        for i in 1..=s {
            out.c[i] = a[0] * b[i] + a[i] * b[0];
            for j in i..=s {
                let q = place(s, i, j);
                let cross = match i == j {
                    true => a[i] * b[i],
                    false => a[i] * b[j] + a[j] * b[i],
                };
                out.c[q] = a[0] * b[q] + a[q] * b[0] + cross;
            }
        }
        let ([la, qa], [lb, qb]) = (self.sizes(), other.sizes());
        let all = |c: Interval, l: Interval, q: Interval| ONE * (c.abs() + l + q);
        out.rest = ONE * (la * qb + qa * (lb + qb))
            + all(a[0], la, qa) * other.rest
            + self.rest * (all(b[0], lb, qb) + other.rest);
        out
    }

    /// f times a number.
    pub fn by(&self, factor: Interval) -> Model {
        Self::constant(self.symbols, ZERO).plus(factor, self)
    }

    /// The range of the function.
    pub fn range(&self) -> Interval {
        self.range_over(&[ONE; MAX_SYMBOLS])
    }

    /// The range of the function over parts of the symbols' ranges.
    pub fn range_over(&self, u: &[Interval]) -> Interval {
        let mut sum = self.c[0] + self.rest;
        for i in 1..=self.symbols {
            sum += alone(self.c[i], self.c[place(self.symbols, i, i)], u[i - 1]);
            for j in i + 1..=self.symbols {
                sum += self.c[place(self.symbols, i, j)] * u[i - 1] * u[j - 1];
            }
        }
        sum
    }

    /// The range of f − g u_i, g being the coefficient of u_i.
    pub fn range_without(&self, i: usize, u: &[Interval]) -> Interval {
        let mut other = *self;
        other.c[1 + i] = ZERO;
        other.range_over(u)
    }

    /// k (1 + k₁ e + k₂ e² + R(e)), e = f/c − 1, for a function R that is monotone on the range of e.
    fn composed(
        &self,
        k: Interval,
        [k1, k2]: [f64; 2],
        rest: impl Fn(Interval) -> Interval,
    ) -> Option<Model> {
        let c = point(self.c[0].mid());
        let range = self.range();
        if !(range.inf() > 0.0 && range.sup() < 1e60 && c.inf() > 0.0) {
            return None;
        }
        let mut e = self.by(point(1.0) / c);
        e.c[0] -= point(1.0);
        let end = |x: f64| point(x) / c - point(1.0);
        let (low, high) = (rest(end(range.inf())), rest(end(range.sup())));
        let both = low.convex_hull(high);
        let mut out = Self::constant(self.symbols, point(1.0))
            .plus(point(k1), &e)
            .plus(point(k2), &e.times(&e));
        out.c[0] += point(both.mid());
        out.rest += both - point(both.mid());
        Some(out.by(k))
    }

    /// √f for f > 0: the remainder √(1 + e) − 1 − e/2 + e²/8 increases with e.
    pub fn square_root(&self) -> Option<Model> {
        let root = point(self.c[0].mid().max(0.0)).sqrt();
        self.composed(root, [0.5, -0.125], |e| {
            let one = point(1.0);
            let inside = hull((one + e).inf().max(0.0), (one + e).sup().max(0.0));
            inside.sqrt() - one - point(0.5) * e + point(0.125) * e.sqr()
        })
    }

    /// 1/f for f > 0: the remainder −e³/(1 + e) decreases with e.
    pub fn reciprocal(&self) -> Option<Model> {
        let c = self.c[0].mid();
        if !(c > 0.0) {
            return None;
        }
        self.composed(point(1.0) / point(c), [-1.0, 1.0], |e| {
            -(e.sqr() * e) / (point(1.0) + e)
        })
    }

    /// Cosine and sine of π/2 + 2 atan τ, τ = middle + radius u_i: the parts of i (1 + iτ)/(1 − iτ) = i z, with
    /// z' = 2i/(1 − iτ)², z'' = −4/(1 − iτ)³, |z'''| = 12/(1 + τ²)².
    pub fn rotation(symbols: usize, i: usize, middle: f64, radius: f64) -> [Model; 2] {
        let (t, r, two) = (point(middle), point(radius), point(2.0));
        let below = point(1.0) + t.sqr();
        // 1/(1 − iτ) = a + ib, its square and its cube.
        let (a, b) = (point(1.0) / below, t / below);
        let (a2, b2) = (a.sqr() - b.sqr(), two * a * b);
        let (a3, b3) = (a2 * a - b2 * b, a2 * b + b2 * a);
        let range = t + r * ONE;
        let third = two * r * r.sqr() / (point(1.0) + range.sqr()).sqr();
        let part = |c: Interval, slope: Interval, bend: Interval| {
            let mut out = Self::constant(symbols, c);
            out.c[1 + i] = slope * r;
            out.c[place(symbols, 1 + i, 1 + i)] = bend * r.sqr();
            out.rest = ONE * third.abs();
            out
        };
        // z = 2(a + ib) − 1, z' = −2b2 + 2i a2, z''/2 = −2a3 − 2i b3; multiplied by i.
        [
            part(-(two * b), -(two * a2), two * b3),
            part(two * a - point(1.0), -(two * b2), -(two * a3)),
        ]
    }
}

/// The range of g u + h u².
fn alone(g: Interval, h: Interval, u: Interval) -> Interval {
    let at = |x: f64| point(x) * (g + h * point(x));
    let mut out = at(u.inf()).convex_hull(at(u.sup()));
    let naive = g * u + h * u.sqr();
    if h.contains(0.0) {
        // The parabola may be a line; where it is one, the ends would do.
        return naive;
    }
    let turn = -g / (point(2.0) * h);
    if !turn.disjoint(u) {
        out = out.convex_hull(-g.sqr() / (point(4.0) * h));
    }
    out
}
