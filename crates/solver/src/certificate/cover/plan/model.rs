//! Functions of up to six symbols u ∈ [−1, 1], enclosed by quadratic polynomials and a number for all that they may be off by. The
//! constant is an interval, the other coefficients are floats.
//!
//! What floats round away is bounded a priori: a sum of products, of which none goes through more than k roundings, is off
//! by at most γ_k times the sum of their sizes (Higham, *Accuracy and Stability of Numerical Algorithms*, section 3.1), and
//! what underflow takes in one operation here is less than `UNDERFLOW`. What overflows leaves a bound that is infinite or
//! no number, and with it ranges that are everything.

use super::format::MAX_SYMBOLS;
use crate::certificate::checker::matrix::{between, exact, halves};
use crate::interval::rounding::{UNDERFLOW, gamma, round_up};
use crate::interval::{Interval, UNIT, ZERO, hull, point};

/// Coefficients of 1, u_i, u_i u_j.
const MOST: usize = (MAX_SYMBOLS + 1) * (MAX_SYMBOLS + 2) / 2;

/// An enclosure of a function.
#[derive(Debug, Clone, Copy)]
pub struct Model {
    symbols: usize,
    /// The coefficient of 1, never empty.
    constant: Interval,
    /// A number in the middle of that, the coefficients of u_i, and those of u_i u_j for i ≤ j, row by row.
    c: [f64; MOST],
    /// At least the sum of the sizes of the coefficients of u_i, and of those of u_i u_j.
    sizes: [f64; 2],
    /// At least how far the function may be from the polynomial with some number of the constant.
    rest: f64,
}

/// The place of the coefficient of u_i u_j, i ≤ j, symbols counted from 1, and 0 standing for the constant 1.
fn place(symbols: usize, i: usize, j: usize) -> usize {
    i * (symbols + 1) - i * i.saturating_sub(1) / 2 + j - i
}

impl Model {
    /// A constant.
    pub fn constant(symbols: usize, x: Interval) -> Self {
        let constant = if x.is_empty() { Interval::ENTIRE } else { x };
        let mut c = [0.0; MOST];
        c[0] = constant.mid();
        Model {
            symbols,
            constant,
            c,
            sizes: [0.0; 2],
            rest: 0.0,
        }
    }

    /// `middle + radius u_i`.
    pub fn symbol(symbols: usize, i: usize, middle: f64, radius: f64) -> Self {
        let mut out = Self::constant(symbols, exact(middle));
        (out.c[1 + i], out.sizes[0]) = (radius, radius.abs());
        out
    }

    fn count(&self) -> usize {
        (self.symbols + 1) * (self.symbols + 2) / 2
    }

    /// The coefficient of u_i.
    pub fn slope(&self, i: usize) -> f64 {
        self.c[1 + i]
    }

    /// At least the sum of the sizes of all coefficients but the constant, but for a rounding.
    fn size(&self) -> f64 {
        self.sizes[0] + self.sizes[1]
    }

    /// At least how far the constant may be from the number in its middle.
    fn off(&self) -> f64 {
        (self.constant - exact(self.c[0])).mag()
    }

    /// Sets what follows from the coefficients, and the rest: a sum of so many roundings.
    fn finish(&mut self, rest: f64, roundings: usize) {
        let (s, count) = (self.symbols, self.count());
        let sum = |c: &[f64]| round_up(c.iter().map(|x| x.abs()).sum(), MOST);
        self.sizes = [sum(&self.c[1..1 + s]), sum(&self.c[1 + s..count])];
        self.rest = round_up(rest + UNDERFLOW, roundings + 1);
    }

    /// How far the function may be from a number.
    pub fn distance(&self, from: f64) -> f64 {
        round_up(
            (self.constant - exact(from)).mag() + self.size() + self.rest,
            5,
        )
    }

    /// A number in the middle of its constant: a guide, no bound.
    pub fn at_middle(&self) -> f64 {
        self.c[0]
    }

    /// A polynomial near the function.
    pub fn polynomial(&self) -> Model {
        let (constant, rest) = (exact(self.c[0]), 0.0);
        Model {
            constant,
            rest,
            ..*self
        }
    }

    /// All functions that differ by no more than a range from one that is enclosed.
    pub fn widened(&self, by: Interval) -> Model {
        let rest = round_up(self.rest + by.mag(), 1);
        Model { rest, ..*self }
    }

    /// How much it may vary about its constant: a guide, no bound.
    pub fn blur(&self) -> f64 {
        self.c[0].abs() + self.size() + self.rest
    }

    /// f + k g.
    pub fn plus(&self, factor: Interval, other: &Model) -> Model {
        let (k, off) = halves(factor);
        let mut out = Self::constant(self.symbols, self.constant + factor * other.constant);
        for q in 1..self.count() {
            out.c[q] = self.c[q] + k * other.c[q];
        }
        // Products are rounded, if they are any; and the sums.
        let products = if k.abs() == 1.0 {
            0.0
        } else {
            gamma(2) * k.abs()
        };
        let sums = gamma(1) * (self.size() + k.abs() * other.size());
        let rest = self.rest + (k.abs() + off) * other.rest + (off + products) * other.size();
        out.finish(rest + sums, 10);
        out
    }

    /// f g.
    pub fn times(&self, other: &Model) -> Model {
        let (s, a, b) = (self.symbols, &self.c, &other.c);
        let mut out = Self::constant(s, self.constant * other.constant);
        for q in 1..self.count() {
            out.c[q] = a[0] * b[q] + a[q] * b[0];
        }
        let mut q = 1 + s;
        for i in 1..=s {
            out.c[q] += a[i] * b[i];
            for j in i + 1..=s {
                out.c[q + j - i] += a[i] * b[j] + a[j] * b[i];
            }
            q += 1 + s - i;
        }
        let ([la, qa], [lb, qb]) = (self.sizes, other.sizes);
        let (size, other_size) = (self.constant.mag() + la + qa, other.size());
        // Each product of two coefficients occurs once, and goes through a product and two sums at most.
        let products = a[0].abs() * other_size + (la + qa) * (b[0].abs() + other_size);
        // What the constants are off, terms of the third and fourth degree, and the rests.
        let rest = self.off() * other_size
            + other.off() * (la + qa)
            + la * qb
            + qa * (lb + qb)
            + size * other.rest
            + self.rest * (other.constant.mag() + other_size + other.rest);
        out.finish(rest + gamma(3) * products, 14);
        out
    }

    /// f times a number.
    pub fn by(&self, factor: Interval) -> Model {
        Self::constant(self.symbols, ZERO).plus(factor, self)
    }

    /// The range of the function.
    pub fn range(&self) -> Interval {
        let (s, mut below, mut above) = (self.symbols, self.rest, self.rest);
        let mut q = 1 + s;
        for i in 1..=s {
            // The least and the greatest of g u + h u², and of that with −g, for u from −1 to 1.
            let (g, h) = (self.c[i].abs(), self.c[q].abs());
            let turn = if g < 2.0 * h {
                g * (g / (4.0 * h))
            } else {
                g - h
            };
            let (low, high) = if self.c[q] < 0.0 {
                (g + h, turn)
            } else {
                (turn, g + h)
            };
            let cross: f64 = self.c[q + 1..q + 1 + s - i].iter().map(|x| x.abs()).sum();
            (below, above) = (below + low + cross, above + high + cross);
            q += 1 + s - i;
        }
        // No term goes through more than three sums for each symbol, five among its neighbours, three roundings of its own and the
        // last sum; all are at most this.
        let size = self.size() + self.rest;
        let lost = round_up(gamma(MOST + 4) * size, 3) + UNDERFLOW;
        match size < 1e300 {
            true => self.constant + between(-(below + lost), above + lost),
            false => Interval::ENTIRE,
        }
    }

    /// The range of the function over parts of the symbols' ranges.
    pub fn range_over(&self, u: &[Interval]) -> Interval {
        let coefficient = |q: usize| exact(self.c[q]);
        let mut sum = self.constant + between(-self.rest, self.rest);
        for i in 1..=self.symbols {
            sum += coefficient(i) * u[i - 1];
            sum += coefficient(place(self.symbols, i, i)) * u[i - 1].sqr();
            for j in i + 1..=self.symbols {
                sum += coefficient(place(self.symbols, i, j)) * u[i - 1] * u[j - 1];
            }
        }
        sum
    }

    /// The range of f − g u_i, g being the coefficient of u_i.
    pub fn range_without(&self, i: usize, u: &[Interval]) -> Interval {
        let mut other = *self;
        other.c[1 + i] = 0.0;
        other.range_over(u)
    }

    /// k (1 + k₁ e + k₂ e² + R(e)), e = f/c − 1, for the constant c and a function R that is monotone on the range of e.
    fn composed(
        &self,
        k: Interval,
        [k1, k2]: [f64; 2],
        rest: impl Fn(Interval) -> Interval,
    ) -> Option<Model> {
        let range = self.range();
        if !(range.inf() > 0.0 && range.sup() < 1e60 && self.c[0] > 0.0) {
            return None;
        }
        let c = point(self.c[0]);
        let mut e = *self;
        e.constant = self.constant - c;
        e.c[0] = e.constant.mid();
        let e = e.by(point(1.0) / c);
        let end = |x: f64| point(x) / c - point(1.0);
        let (low, high) = (rest(end(range.inf())), rest(end(range.sup())));
        let start = Self::constant(self.symbols, point(1.0) + low.convex_hull(high));
        let sum = start.plus(point(k1), &e).plus(point(k2), &e.times(&e));
        Some(sum.by(k))
    }

    /// √f for f > 0: the remainder √(1 + e) − 1 − e/2 + e²/8 increases with e.
    pub fn square_root(&self) -> Option<Model> {
        let root = exact(self.c[0]).sqrt();
        self.composed(root, [0.5, -0.125], |e| {
            let one = point(1.0);
            let inside = hull((one + e).inf().max(0.0), (one + e).sup().max(0.0));
            inside.sqrt() - one - point(0.5) * e + point(0.125) * e.sqr()
        })
    }

    /// 1/f for f > 0: the remainder −e³/(1 + e) decreases with e.
    pub fn reciprocal(&self) -> Option<Model> {
        let over = point(1.0) / exact(self.c[0]);
        self.composed(over, [-1.0, 1.0], |e| -(e.sqr() * e) / (point(1.0) + e))
    }

    /// Cosine and sine of π/2 + 2 atan τ, τ = middle + radius u_i: the parts of i (1 + iτ)/(1 − iτ) = i z, with
    /// z' = 2i/(1 − iτ)², z'' = −4/(1 − iτ)³, |z'''| = 12/(1 + τ²)².
    pub fn rotation(symbols: usize, i: usize, middle: f64, radius: f64) -> [Model; 2] {
        let (t, r, two) = (exact(middle), exact(radius), point(2.0));
        let below = point(1.0) + t.sqr();
        // 1/(1 − iτ) = a + ib, its square and its cube.
        let (a, b) = (point(1.0) / below, t / below);
        let (a2, b2) = (a.sqr() - b.sqr(), two * a * b);
        let (a3, b3) = (a2 * a - b2 * b, a2 * b + b2 * a);
        let range = t + r * UNIT;
        let third = two * r * r.sqr() / (point(1.0) + range.sqr()).sqr();
        let part = |c: Interval, slope: Interval, bend: Interval| {
            let mut out = Self::constant(symbols, c);
            let [slope, bend] = [slope * r, bend * r.sqr()].map(halves);
            out.c[1 + i] = slope.0;
            out.c[place(symbols, 1 + i, 1 + i)] = bend.0;
            out.finish(slope.1 + bend.1 + third.mag(), 4);
            out
        };
        // z = 2(a + ib) − 1, z' = −2b2 + 2i a2, z''/2 = −2a3 − 2i b3; multiplied by i.
        [
            part(-(two * b), -(two * a2), two * b3),
            part(two * a - point(1.0), -(two * b2), -(two * a3)),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::{Rational, exact as ratio};
    use num_traits::Signed;
    use proptest::prelude::*;

    const SYMBOLS: usize = 3;
    /// Where functions are evaluated.
    type At = [f64; SYMBOLS];

    /// A function and its exact value at a place.
    type Known = (Model, Rational);

    fn polynomial(model: &Model, u: &At) -> Rational {
        let of = |i: usize| {
            if i == 0 {
                Rational::one()
            } else {
                ratio(u[i - 1])
            }
        };
        let mut sum = Rational::zero();
        for i in 0..=SYMBOLS {
            for j in i..=SYMBOLS {
                sum += ratio(model.c[place(SYMBOLS, i, j)]) * of(i) * of(j);
            }
        }
        sum
    }

    /// Whether all that a model says is true of the value there.
    fn holds((model, value): &Known, u: &At) -> bool {
        let inside = |x: Interval| ratio(x.inf()) <= *value && *value <= ratio(x.sup());
        let sum = |of: std::ops::Range<usize>| {
            model.c[of]
                .iter()
                .fold(Rational::zero(), |sum, &x| sum + ratio(x).abs())
        };
        let [linear, quadratic] = model.sizes.map(ratio);
        let points = u.map(point);
        let off = ratio(model.rest) + ratio(model.off());
        (value - polynomial(model, u)).abs() <= off
            && model.constant.contains(model.c[0])
            && sum(1..1 + SYMBOLS) <= linear
            && sum(1 + SYMBOLS..MOST.min(10)) <= quadratic
            && inside(model.range())
            && inside(model.range_over(&points))
            && inside(model.range_over(&[UNIT; SYMBOLS]))
            && inside(model.range_without(0, &points) + point(model.slope(0)) * points[0])
            && value.abs() <= ratio(model.distance(0.0))
    }

    fn wide() -> impl Strategy<Value = f64> {
        let scaled = (-1.0f64..1.0, -40i32..40).prop_map(|(x, e)| x * 2f64.powi(e));
        prop_oneof![4 => -1.0f64..1.0, 1 => scaled, 1 => Just(0.0), 1 => Just(1e-200)]
    }

    /// The symbols scaled and moved, and then what a few operations make of them.
    fn functions(
        start: &[(f64, f64)],
        operations: &[(u8, usize, usize, f64, f64)],
        u: &At,
    ) -> Vec<Known> {
        let symbol = |(i, &(middle, radius)): (usize, &(f64, f64))| {
            let value = ratio(middle) + ratio(radius.abs()) * ratio(u[i]);
            (Model::symbol(SYMBOLS, i, middle, radius.abs()), value)
        };
        let mut all: Vec<Known> = start.iter().enumerate().map(symbol).collect();
        for &(what, a, b, x, off) in operations {
            let ((f, at_f), (g, at_g)) = (&all[a % all.len()], &all[b % all.len()]);
            let number = between(x.min(x + off), x.max(x + off));
            all.push(match what % 4 {
                0 => (f.times(g), at_f * at_g),
                1 => (f.plus(number, g), at_f + at_g * ratio(x)),
                2 => (f.by(number), at_f * ratio(x)),
                _ => (
                    f.plus(point(1.0), &Model::constant(SYMBOLS, number)),
                    at_f + ratio(x),
                ),
            });
        }
        all
    }

    fn places() -> impl Strategy<Value = At> {
        let one = prop_oneof![3 => -1.0f64..=1.0, 1 => Just(1.0), 1 => Just(-1.0), 1 => Just(0.0)];
        [one.clone(), one.clone(), one]
    }

    proptest! {
        #[test]
        fn models_hold_exact_values(
            start in prop::collection::vec((wide(), wide()), SYMBOLS),
            operations in prop::collection::vec((any::<u8>(), 0..20usize, 0..20usize, wide(), prop_oneof![Just(0.0), -1e-3f64..1e-3]), 0..6),
            u in places(),
        ) {
            for known in functions(&start, &operations, &u) {
                prop_assert!(holds(&known, &u), "{known:?}");
            }
        }

        #[test]
        fn roots_and_reciprocals_hold_exact_values(
            slopes in [-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0],
            (beside, scale) in (0.0f64..2.0, -30i32..30),
            u in places(),
        ) {
            let scale = 2f64.powi(scale);
            let least: f64 = slopes.iter().map(|x| x.abs()).sum();
            let constant = scale * (least + beside);
            let mut f = (Model::constant(SYMBOLS, point(constant)), ratio(constant));
            for (i, slope) in slopes.iter().enumerate() {
                let slope = scale * slope;
                f.0 = f.0.plus(point(slope), &Model::symbol(SYMBOLS, i, 0.0, 1.0));
                f.1 += ratio(slope) * ratio(u[i]);
            }
            // Of a quadratic function, too.
            let square = (f.0.times(&f.0), &f.1 * &f.1);
            for (model, value) in [f, square] {
                if let Some(over) = model.reciprocal() {
                    prop_assert!(holds(&(over, value.recip()), &u));
                }
                if let Some(root) = model.square_root() {
                    let (near, rest) = (polynomial(&root, &u), ratio(root.rest) + ratio(root.off()));
                    let (low, high) = (&near - &rest, near + rest);
                    prop_assert!(!high.is_negative() && value <= &high * &high);
                    prop_assert!(low.is_negative() || &low * &low <= value);
                }
            }
        }

        #[test]
        fn rotations_hold_exact_values(middle in -1.0f64..1.0, radius in prop_oneof![0.0f64..1.0, 0.0f64..1e-6], u in places()) {
            let both = Model::rotation(SYMBOLS, 1, middle, radius);
            let tau = ratio(middle) + ratio(radius) * ratio(u[1]);
            let (one, square) = (Rational::one(), &tau * &tau);
            let below = &one + &square;
            let values = [-(&tau + &tau) / &below, (one - square) / below];
            for known in both.into_iter().zip(values) {
                prop_assert!(holds(&known, &u), "{known:?}");
            }
        }
    }

    /// Whatever is not finite leaves everything possible.
    #[test]
    fn nothing_follows_from_what_overflows() {
        for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e300, -1e308] {
            let f = Model::symbol(2, 0, bad, 1.0);
            let g = Model::symbol(2, 1, 1.0, bad.abs());
            for model in [
                f.times(&f),
                g.times(&g),
                f.times(&g),
                f.plus(point(1e300), &f),
                g.widened(Interval::ENTIRE),
            ] {
                let is_bounded = |x: Interval| x.is_empty() || x.is_common_interval();
                assert!(!is_bounded(model.range()));
                assert!(!is_bounded(model.range_over(&[UNIT; 2])));
                assert!(!(model.distance(0.0) < 1e299));
                assert!(model.reciprocal().is_none() && model.square_root().is_none());
            }
        }
        for empty in [Interval::EMPTY, Interval::ENTIRE] {
            assert_eq!(Model::constant(1, empty).range(), Interval::ENTIRE);
        }
    }
}
