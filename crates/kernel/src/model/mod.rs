//! Functions of a few symbols, enclosed by polynomials of the second degree: Taylor models, rounded outwards.
//!
//! A model stands for a function f of S symbols u ∈ [−1, 1]^S: a polynomial of degree 2 with float
//! coefficients, and a remainder r such that |f(u) − polynomial(u)| ≤ r for every such u. What an
//! operation rounds away, and the terms of degree 3 and 4 that it drops, go into r (Makino, Berz,
//! *Taylor models and other validated functional inclusion methods*, Int. J. Pure Appl. Math. 4,
//! 2003). What overflows leaves a remainder that is infinite or no number, and with it ranges that decide nothing;
//! roots and quotients are taken of functions between 1e-60 and 1e60 alone. S is known at compile time, and so is the
//! number M = (S + 1)(S + 2)/2 of coefficients.

// A bound that is not a number proves nothing: tests say what they need, and `!(a < b)` is not `a >= b`.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod contract;

pub use contract::{Empty, Margin, contract};

use crate::interval::rounding::{UNDERFLOW, UNIT_ROUNDOFF, gamma};
use crate::interval::{Interval, hull};

/// The most symbols.
pub const SYMBOLS: usize = 6;

/// A function of S symbols, enclosed.
#[derive(Debug, Clone, Copy)]
pub struct Model<const S: usize, const M: usize> {
    /// The constant, the S linear coefficients, and those of u_i u_j for i ≤ j, row by row.
    c: [f64; M],
    /// How far the function may be from the polynomial.
    r: f64,
}

/// A real number, enclosed: a middle and a radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number {
    /// The middle.
    pub mid: f64,
    /// How far the number may be from it.
    pub rad: f64,
}

/// Bounds of a function, not finite or NaN where nothing is known. Every test against them is
/// written so that a NaN decides nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Not above any value.
    pub lo: f64,
    /// Not below any value.
    pub hi: f64,
}

/// Covers the roundings of a sum of up to 90 non-negative terms and of the products in it, three
/// factors deep.
const UP: f64 = 1.0 + 100.0 * 1.01 * UNIT_ROUNDOFF;

impl Number {
    /// The number 1.
    pub const ONE: Number = Number::exact(1.0);

    /// From an interval.
    pub fn new(x: Interval) -> Self {
        let (mid, rad) = (x.mid(), x.rad());
        Number { mid, rad }
    }

    /// A float.
    pub const fn exact(mid: f64) -> Self {
        Number { mid, rad: 0.0 }
    }

    /// −x.
    pub fn negative(self) -> Self {
        let mid = -self.mid;
        Number { mid, ..self }
    }

    /// x + f y for a float f.
    pub fn plus(self, factor: f64, other: Number) -> Number {
        let product = factor * other.mid;
        let mid = self.mid + product;
        // A product and a sum are rounded once each.
        let rounded = UNIT_ROUNDOFF * (product.abs() + mid.abs()) + UNDERFLOW;
        let rad = (self.rad + factor.abs() * other.rad + rounded) * UP;
        Number { mid, rad }
    }

    /// x y.
    pub fn times(self, other: Number) -> Number {
        let mid = self.mid * other.mid;
        let rounded = UNIT_ROUNDOFF * mid.abs() + UNDERFLOW;
        let spread = self.mid.abs() * other.rad + self.rad * (other.mid.abs() + other.rad);
        Number {
            mid,
            rad: (spread + rounded) * UP,
        }
    }
}

/// Σ |x|, in four sums that do not wait for each other.
#[inline(always)]
fn sizes(x: &[f64]) -> f64 {
    let mut lanes = [0.0; 4];
    let (fours, rest) = x.as_chunks::<4>();
    for four in fours {
        for k in 0..4 {
            lanes[k] += four[k].abs();
        }
    }
    let rest: f64 = rest.iter().map(|x| x.abs()).sum();
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]) + rest
}

/// A model as a factor of products, with bounds of its parts.
#[derive(Debug, Clone, Copy)]
pub struct Factor<'m, const S: usize, const M: usize> {
    model: &'m Model<S, M>,
    linear: f64,
    quadratic: f64,
    /// Of the polynomial.
    all: f64,
}

/// start ± f₁ g₁ ± f₂ g₂ …, rounded as one sum.
///
/// No term of a coefficient passes through more than N + 4 roundings: its product, up to three sums within
/// the product of the models, and up to N on the way to `start`. All terms of all coefficients together are at most
/// |start| + Σ |f||g|, the sizes of the polynomials.
#[inline(always)]
pub fn combined<const N: usize, const S: usize, const M: usize>(
    start: &Model<S, M>,
    terms: [(f64, Factor<S, M>, Factor<S, M>); N],
) -> Model<S, M> {
    let mut c = start.c;
    let (mut size, mut r) = (start.polynomial(), start.r);
    for (sign, f, g) in terms {
        let (a, b) = (&f.model.c, &g.model.c);
        assert!(sign.abs() == 1.0);
        let lead = sign * a[0];
        c[0] += lead * b[0];
        let mut q = 1 + S;
        for i in 1..1 + S {
            let own = sign * a[i];
            c[i] += lead * b[i] + own * b[0];
            c[q] += lead * b[q] + sign * a[q] * b[0] + own * b[i];
            q += 1;
            for j in i + 1..1 + S {
                let cross = own * b[j] + sign * a[j] * b[i];
                c[q] += lead * b[q] + sign * a[q] * b[0] + cross;
                q += 1;
            }
        }
        r += f.linear * g.quadratic
            + f.quadratic * (g.linear + g.quadratic)
            + f.all * g.model.r
            + f.model.r * (g.all + g.model.r);
        size += f.all * g.all;
    }
    let r = (r + gamma(N + 5) * size) * UP + UNDERFLOW;
    Model { c, r }
}

impl Range {
    /// All that a symbol may be.
    pub const SYMBOL: Range = Range { lo: -1.0, hi: 1.0 };

    /// Whether no value is zero, by more than a billionth of `size`: a margin, so that whoever
    /// evaluates the same function with other roundings comes to the same end.
    pub fn misses_zero(&self, size: f64) -> bool {
        self.sign(size) != 0
    }

    /// The sign of all values, by the same margin; 0 where they have not one.
    pub fn sign(&self, size: f64) -> i8 {
        match self.lo > 1e-9 * size {
            true => 1,
            false => -i8::from(self.hi < -1e-9 * size),
        }
    }

    /// As an interval: everything where nothing is known.
    pub fn interval(&self) -> Interval {
        match self.lo <= self.hi && self.lo.abs() < f64::INFINITY && self.hi.abs() < f64::INFINITY {
            true => hull(self.lo, self.hi),
            false => Interval::ENTIRE,
        }
    }
}

/// start + x₁ f₁ + x₂ f₂ … for numbers x, rounded as one sum: every term passes through a product and up to N sums.
#[inline(always)]
pub fn weighted<const N: usize, const S: usize, const M: usize>(
    start: &Model<S, M>,
    terms: [(Number, &Model<S, M>); N],
) -> Model<S, M> {
    let mut c = start.c;
    let (mut size, mut r) = (start.polynomial(), start.r);
    for (x, f) in terms {
        for q in 0..M {
            c[q] += x.mid * f.c[q];
        }
        let all = f.polynomial();
        r += (x.mid.abs() + x.rad) * f.r + x.rad * all;
        size += x.mid.abs() * all;
    }
    let r = (r + gamma(N + 2) * size) * UP + UNDERFLOW;
    Model { c, r }
}

impl<const S: usize, const M: usize> Model<S, M> {
    /// The function that is 0.
    pub const ZERO: Self = Model {
        c: [0.0; M],
        r: 0.0,
    };

    const SHAPE: () = assert!(M == (S + 1) * (S + 2) / 2);

    /// A constant.
    pub fn constant(x: Number) -> Self {
        let () = Self::SHAPE;
        let mut out = Self::ZERO;
        (out.c[0], out.r) = (x.mid, x.rad);
        out
    }

    /// `middle + radius u_i`, exactly.
    pub fn symbol(i: usize, middle: f64, radius: f64) -> Self {
        let mut out = Self::ZERO;
        (out.c[0], out.c[1 + i]) = (middle, radius);
        out
    }

    /// The constant coefficient.
    pub fn middle(&self) -> f64 {
        self.c[0]
    }

    /// The coefficient of a symbol.
    pub fn slope(&self, i: usize) -> f64 {
        self.c[1 + i]
    }

    /// The coefficient of the product of two symbols.
    pub fn bend(&self, i: usize, j: usize) -> f64 {
        let (i, j) = (i.min(j), i.max(j));
        self.c[1 + S + i * S - i * i.saturating_sub(1) / 2 + j - i]
    }

    /// How far the function may be from its polynomial.
    pub fn rest(&self) -> f64 {
        self.r
    }

    /// The polynomial, exactly.
    pub fn without_rest(&self) -> Self {
        Model { r: 0.0, ..*self }
    }

    /// All functions that differ by no more than so much from one that is enclosed.
    pub fn widened(&self, by: f64) -> Self {
        let r = (self.r + by) * UP;
        Model { r, ..*self }
    }

    /// −f.
    pub fn negative(&self) -> Self {
        let mut c = self.c;
        for x in &mut c {
            *x = -*x;
        }
        Model { c, r: self.r }
    }

    /// A bound on the linear part.
    #[inline(always)]
    pub fn linear(&self) -> f64 {
        sizes(&self.c[1..1 + S])
    }

    /// A bound on the quadratic part.
    #[inline(always)]
    pub fn quadratic(&self) -> f64 {
        sizes(&self.c[1 + S..])
    }

    /// A bound on the size of the polynomial.
    #[inline(always)]
    pub fn polynomial(&self) -> f64 {
        sizes(&self.c)
    }

    /// As a factor of products.
    #[inline(always)]
    pub fn factor(&self) -> Factor<'_, S, M> {
        let (linear, quadratic) = (self.linear(), self.quadratic());
        Factor {
            model: self,
            linear,
            quadratic,
            all: self.c[0].abs() + linear + quadratic,
        }
    }

    /// A bound on how far the function is from its constant coefficient.
    pub fn reach(&self) -> f64 {
        (self.linear() + self.quadratic() + self.r) * UP
    }

    /// A bound on the function's size.
    pub fn size(&self) -> f64 {
        (self.c[0].abs() + self.reach()) * UP
    }

    /// f + g.
    #[inline(always)]
    pub fn plus(&self, other: &Self) -> Self {
        let mut c = self.c;
        for q in 0..M {
            c[q] += other.c[q];
        }
        let size = sizes(&c);
        // The error of a sum is at most u times the computed one, and none where it is subnormal.
        let r = (self.r + other.r + UNIT_ROUNDOFF * size) * UP;
        Model { c, r }
    }

    /// f − g.
    #[inline(always)]
    pub fn minus(&self, other: &Self) -> Self {
        let mut c = self.c;
        for q in 0..M {
            c[q] -= other.c[q];
        }
        let size = sizes(&c);
        let r = (self.r + other.r + UNIT_ROUNDOFF * size) * UP;
        Model { c, r }
    }

    /// f times a float.
    #[inline(always)]
    pub fn scaled(&self, factor: f64) -> Self {
        let mut c = self.c;
        for x in &mut c {
            *x *= factor;
        }
        let size = sizes(&c);
        let r = (self.r * factor.abs() + UNIT_ROUNDOFF * size) * UP + UNDERFLOW;
        Model { c, r }
    }

    /// f times a number.
    #[inline(always)]
    pub fn by(&self, factor: Number) -> Self {
        let mut out = self.scaled(factor.mid);
        out.r = (out.r + self.size() * factor.rad) * UP;
        out
    }

    /// f plus a number.
    #[inline(always)]
    pub fn shifted(&self, by: Number) -> Self {
        let mut out = *self;
        out.c[0] += by.mid;
        out.r = (out.r + by.rad + UNIT_ROUNDOFF * out.c[0].abs()) * UP;
        out
    }

    /// f g.
    #[inline(always)]
    pub fn times(&self, other: &Self) -> Self {
        combined(&Self::ZERO, [(1.0, self.factor(), other.factor())])
    }

    /// f².
    #[inline(always)]
    pub fn squared(&self) -> Self {
        let factor = self.factor();
        combined(&Self::ZERO, [(1.0, factor, factor)])
    }

    /// Bounds of the function: the terms g u + h u² of one symbol exactly, the others by size.
    pub fn range(&self) -> Range {
        let (mut below, mut above, mut size) = (0.0, 0.0, self.c[0].abs() + self.r);
        let mut q = 1 + S;
        for i in 0..S {
            let (g, h) = (self.c[1 + i].abs(), self.c[q]);
            size += g + h.abs();
            // The least and the greatest value of g u + h u² on [−1, 1].
            let turn = if g < 2.0 * h.abs() {
                // It is at most g/2; the square of a number as small as this may be lost.
                if g > 1e-150 {
                    g * g / (4.0 * h.abs())
                } else {
                    g
                }
            } else {
                g - h.abs()
            };
            if h >= 0.0 {
                below += turn;
                above += g + h;
            } else {
                below += g - h;
                above += turn;
            }
            q += 1;
            for _ in i + 1..S {
                let cross = self.c[q].abs();
                size += cross;
                below += cross;
                above += cross;
                q += 1;
            }
        }
        let slack = gamma(100) * size + UNDERFLOW;
        Range {
            lo: self.c[0] - (below + self.r + slack),
            hi: self.c[0] + (above + self.r + slack),
        }
    }

    /// √f, where the range of f is `range` and f > 0.
    ///
    /// With f = c(1 + e): √(1 + e) = 1 + e/2 − e²/8 + R(e), and R increases with e, its derivative
    /// being ½((1 + e)^(−½) − 1 + e/2) ≥ 0 by convexity.
    pub fn square_root(&self, range: Range) -> Self {
        let c = self.c[0];
        if !(range.lo > 0.0 && c > 0.0) {
            return Self::unknown();
        }
        let root = c.sqrt();
        let rest = |e: f64| (1.0 + e).max(0.0).sqrt() - 1.0 - 0.5 * e + 0.125 * e * e;
        self.composed(range, rest, [root, 0.5, -0.125])
    }

    /// 1/f, where the range of f is `range` and f > 0.
    ///
    /// With f = c(1 + e): 1/(1 + e) = 1 − e + e² + R(e), and R(e) = −e³/(1 + e) decreases with e.
    pub fn reciprocal(&self, range: Range) -> Self {
        let c = self.c[0];
        if !(range.lo > 0.0 && c > 0.0) {
            return Self::unknown();
        }
        let rest = |e: f64| -e * e * e / (1.0 + e);
        self.composed(range, rest, [1.0 / c, -1.0, 1.0])
    }

    /// k (1 + k₁ e + k₂ e² + R(e)) with e = f/c − 1, R monotone on the range of e.
    fn composed(&self, range: Range, rest: impl Fn(f64) -> f64, k: [f64; 3]) -> Self {
        let c = self.c[0];
        // The squares and quotients below are far from where floats end.
        if !(range.hi < 1e60 && c > 1e-60) {
            return Self::unknown();
        }
        // e within ulps of 1 + |e|; the ends are moved out by that.
        let end = |x: f64, out: f64| {
            let e = x / c - 1.0;
            e + out * 4.0 * UNIT_ROUNDOFF * (1.0 + e.abs())
        };
        let (low, high) = (end(range.lo, -1.0), end(range.hi, 1.0));
        if !(low > -1.0 && high < 1e6) {
            return Self::unknown();
        }
        let at = [rest(low), rest(high)];
        // Each is a sum of four terms that are at most (1 + |e|)² in size, or the quotient of such
        // whose denominator 1 + e has a relative error of u/(1 + e).
        let widest = 1.0 + low.abs().max(high);
        let error =
            16.0 * UNIT_ROUNDOFF * (widest * widest + at[0].abs() / (1.0 + low) + at[1].abs());
        let (middle, half) = (0.5 * (at[0] + at[1]), 0.5 * (at[0] - at[1]).abs() + error);

        let (k1, k2) = (k[1] / c, k[2] / (c * c));
        let mut out = Self::ZERO;
        out.c[0] = k[0] * (1.0 + middle);
        let mut q = 1 + S;
        for i in 1..1 + S {
            out.c[i] = k[0] * (k1 * self.c[i]);
        }
        for i in 1..1 + S {
            for j in i..1 + S {
                let both = if i == j { 1.0 } else { 2.0 };
                let square = both * self.c[i] * self.c[j];
                out.c[q] = k[0] * (k1 * self.c[q] + k2 * square);
                q += 1;
            }
        }
        let (l, h, r) = (self.linear(), self.quadratic(), self.r);
        let all = l + h + r;
        let dropped = k1.abs() * r + k2.abs() * (h * (2.0 * l + h) + r * (2.0 * (l + h) + r));
        let rounded = gamma(16) * (1.0 + middle.abs() + k1.abs() * all + k2.abs() * (all * all));
        out.r = k[0].abs() * (dropped + half + rounded) * UP + UNDERFLOW;
        out
    }

    /// Adds how much each symbol bends the function, and a little of how much it moves it: what is gained by halving its range.
    #[inline(always)]
    pub fn weigh(&self, weights: &mut [f64; S]) {
        let mut q = 1 + S;
        for i in 0..S {
            weights[i] += self.c[q].abs() + 1e-3 * self.c[1 + i].abs();
            q += 1;
            for j in i + 1..S {
                let cross = 0.5 * self.c[q].abs();
                weights[i] += cross;
                weights[j] += cross;
                q += 1;
            }
        }
    }

    /// A function of which nothing is known.
    pub fn unknown() -> Self {
        Model {
            c: [0.0; M],
            r: f64::INFINITY,
        }
    }
}

/// cos θ and sin θ for θ = quarter + 2 atan τ, τ = middle + radius u_i: every point of half a circle is
/// met for one τ ∈ [−1, 1], the ends by τ = ±1, and the other half is its negative. Rational in τ:
/// e^(2 i atan τ) = (1 + iτ)/(1 − iτ) = z, and what is told is i z.
///
/// z' = 2i/(1 − iτ)², z'' = −4/(1 − iτ)³, |z'''| = 12/(1 + τ²)².
pub fn rotation<const S: usize, const M: usize>(
    i: usize,
    middle: f64,
    radius: f64,
) -> [Model<S, M>; 2] {
    let t = middle;
    let w = 1.0 / (1.0 + t * t);
    // 1/(1 − iτ) = (1 + iτ) w, and its powers.
    let (a, b) = (w, t * w);
    let (a2, b2) = (a * a - b * b, 2.0 * a * b);
    let (a3, b3) = (a2 * a - b2 * b, a2 * b + b2 * a);
    let z = [2.0 * a - 1.0, 2.0 * b];
    let slope = [-2.0 * b2, 2.0 * a2];
    let bend = [-2.0 * a3, -2.0 * b3];
    // |1/(1 − iτ)| ≤ 1, so all numbers above have absolute errors of a few u. The third derivative's bound
    // is divided by 3!; the nearest τ to 0 is at least |middle| − radius away.
    let nearest = (t.abs() - radius).max(0.0);
    let third = 2.0 / (1.0 + nearest * nearest).powi(2);
    let r = (third * radius.powi(3) + 64.0 * UNIT_ROUNDOFF * (1.0 + radius + radius * radius)) * UP
        + UNDERFLOW;
    let quadratic = {
        // The place of u_i².
        let mut q = 1 + S;
        for k in 0..i {
            q += S - k;
        }
        q
    };
    let part = |k: usize, sign: f64| {
        let mut out = Model::<S, M>::ZERO;
        out.c[0] = sign * z[k];
        out.c[1 + i] = sign * (slope[k] * radius);
        out.c[quadratic] = sign * (bend[k] * radius * radius);
        out.r = r;
        out
    };
    [part(1, -1.0), part(0, 1.0)]
}

#[cfg(test)]
mod tests;
