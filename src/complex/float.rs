//! Following complex paths in floats: fast, and nothing is proved on the way.
//!
//! A path x(t) of quadratic equations has Taylor coefficients that cost a linear solution each, all with the same matrix.
//! A step predicts by them, as far as they say that it may, and corrects by Newton's method with the Jacobian where it
//! arrived, whose elimination serves the next step's coefficients too: one elimination a step. Where unknowns are large,
//! squares cancel, and 53 bits leave Newton's method short of a zero; then the residual, and it alone, is taken in
//! double-doubles.
//!
//! The path may jump to another one. So what comes of it is a guess, to be proved at its end, and a claim about all
//! solutions rests on their number alone.

use super::system::System;
use crate::interval::DoubleDouble;
use crate::system::Right;
use nalgebra::Complex;

type C = Complex<f64>;

/// Taylor coefficients beyond the zeroth.
const ORDER: usize = 10;
/// What the last coefficient may add to a step, beside the size of the unknowns. Larger steps fail too often.
const TOLERANCE: f64 = 1e-5;
/// A step is taken if each correction is at most this part of the one before.
const CONTRACTION: f64 = 0.05;
/// A correction smaller than this beside the unknowns is the last one.
const SETTLED: f64 = 1e-12;
/// A correction smaller than this that is followed by no smaller one is taken for rounding.
const ROUNDING: f64 = 1e-8;
/// Where corrections smaller than this stop shrinking it is taken for rounding's doing, not for that of too long a step.
const NEAR: f64 = 1e-5;
/// Corrections for one step.
const MOST_CORRECTIONS: usize = 12;
/// Beyond this size of an unknown, in units of the typical length, or the radius allowed if that is larger, a path is
/// not followed: rounding has the say there. Up to it paths may go far and come back.
const FAR: f64 = 1e8;
/// Shorter steps of t end the path.
const LEAST_STEP: f64 = 1e-9;

/// How a path ended.
#[derive(Debug, Clone, PartialEq)]
pub enum FloatEnd {
    /// Near this point at t = 1: real and imaginary part of every unknown in turn.
    Reached(Vec<f64>),
    /// It could not be followed beyond this t < 1, where an unknown is larger than the radius allowed.
    Beyond(f64),
    /// It could not be followed beyond this t, where the largest unknown is of this size.
    Stopped(f64, f64),
}

/// One term of an equation: a factor times two linear forms, each the difference of two unknowns, or the number 1.
#[derive(Debug, Clone, Copy)]
struct Term {
    factor: f64,
    forms: [Option<[usize; 2]>; 2],
}

/// Follows paths of one system, setting nothing up twice.
pub struct FloatFollower {
    n: usize,
    /// Terms, and where each equation's begin.
    terms: Vec<Term>,
    first: Vec<usize>,
    /// Taylor coefficients of the unknowns, then of every term's two forms. Unknowns n and n + 1 are zero.
    x: Vec<[C; ORDER + 1]>,
    forms: Vec<[[C; ORDER + 1]; 2]>,
    /// Where a step arrives, rounded, and what that leaves, real and imaginary part.
    there: Vec<C>,
    low: Vec<C>,
    matrix: Matrix,
    right: Vec<C>,
    /// For every equation the coefficients of its right-hand side, a polynomial in t.
    rights: Vec<[C; 3]>,
    /// Steps taken.
    pub steps: usize,
}

impl FloatFollower {
    /// For the paths while the right-hand sides are these, of real and imaginary parts in turn.
    pub fn new(system: &System, rights: &[Right]) -> Self {
        let n = system.unknowns.len();
        let (mut terms, mut first) = (Vec::new(), vec![0]);
        for equation in &system.equations {
            terms.extend(equation.terms.iter().map(|term| Term {
                factor: 0.5 * f64::from(term.factor),
                forms: [term.left, term.right].map(|form| form.map(|ends| ends.map(|i| i.min(n)))),
            }));
            first.push(terms.len());
        }
        let zero = C::new(0.0, 0.0);
        let coefficients = |parts: &[Right]| -> [C; 3] {
            std::array::from_fn(|k| C::new(parts[0].e[k], parts[1].e[k]))
        };
        FloatFollower {
            n,
            x: vec![[zero; ORDER + 1]; n + 1],
            forms: vec![[[zero; ORDER + 1]; 2]; terms.len()],
            terms,
            first,
            there: vec![zero; n + 1],
            low: vec![zero; n + 1],
            matrix: Matrix::new(n),
            right: vec![zero; n],
            rights: rights.chunks(2).map(coefficients).collect(),
            steps: 0,
        }
    }

    /// Follows a path from near this point at t = 0: real and imaginary part of every unknown in turn.
    pub fn follow(&mut self, start: &[f64], radius: f64, most_steps: usize) -> FloatEnd {
        for (to, parts) in self.there.iter_mut().zip(start.chunks(2)) {
            *to = C::new(parts[0], parts[1]);
        }
        let mut t = 0.0;
        if !self.correct(0.0) {
            return FloatEnd::Stopped(0.0, self.size());
        }
        // The size where the path is known to be.
        let mut size = self.size();
        for _ in 0..most_steps {
            if size > radius.max(FAR) || !self.step(&mut t, size) {
                break;
            }
            size = self.size();
            self.steps += 1;
            if t == 1.0 {
                let arrived = self.there[..self.n].iter();
                return FloatEnd::Reached(arrived.flat_map(|z| [z.re, z.im]).collect());
            }
        }
        match size > radius {
            true => FloatEnd::Beyond(t),
            false => FloatEnd::Stopped(t, size),
        }
    }

    /// One step from t on, to be tried at shorter lengths until Newton's method settles. False where none does.
    fn step(&mut self, t: &mut f64, size: f64) -> bool {
        self.expand(*t);
        let mut step = self.reach(size).min(1.0 - *t);
        loop {
            self.predict(step);
            let to = if *t + step >= 1.0 { 1.0 } else { *t + step };
            if self.correct(to) {
                *t = to;
                return true;
            }
            step *= 0.5;
            if step < LEAST_STEP {
                return false;
            }
        }
    }

    /// The greatest size of an unknown, at least 1.
    fn size(&self) -> f64 {
        let sizes = self.there.iter().map(|z| z.norm_sqr());
        sizes.fold(1.0, f64::max).sqrt()
    }

    /// The right-hand side of an equation.
    fn wanted(&self, equation: usize, t: f64) -> C {
        let [a, b, c] = self.rights[equation];
        (c * t + b) * t + a
    }

    /// The Taylor coefficients at the point arrived at, at t, by the elimination made there.
    fn expand(&mut self, t: f64) {
        let zero = C::new(0.0, 0.0);
        for (x, &there) in self.x.iter_mut().zip(&self.there) {
            x[0] = there;
        }
        for order in 0..=ORDER {
            if order > 0 {
                for e in 0..self.n {
                    let [_, b, c] = self.rights[e];
                    let mut right = match order {
                        1 => b + c * (2.0 * t),
                        2 => c,
                        _ => zero,
                    };
                    for term in self.first[e]..self.first[e + 1] {
                        let [left, other] = &self.forms[term];
                        let products = (1..order).map(|i| left[i] * other[order - i]);
                        right -= products.sum::<C>() * self.terms[term].factor;
                    }
                    self.right[e] = right;
                }
                self.matrix.solve(&mut self.right);
                for (x, &solved) in self.x.iter_mut().zip(&self.right) {
                    x[order] = solved;
                }
            }
            for (forms, term) in self.forms.iter_mut().zip(&self.terms) {
                for (form, ends) in forms.iter_mut().zip(term.forms) {
                    form[order] = match ends {
                        Some([a, b]) => self.x[a][order] - self.x[b][order],
                        None => C::new(if order == 0 { 1.0 } else { 0.0 }, 0.0),
                    };
                }
            }
        }
    }

    /// How far the coefficients say that a step may go.
    fn reach(&self, size: f64) -> f64 {
        let of = |order: usize| -> f64 {
            let largest = self.x.iter().map(|x| x[order].norm_sqr());
            let largest = largest.fold(0.0, f64::max).sqrt();
            (TOLERANCE * size / largest).powf(1.0 / order as f64)
        };
        let reach = of(ORDER).min(of(ORDER - 1));
        // All coefficients may be zero: then the path stands still.
        if reach.is_nan() { 1.0 } else { reach }
    }

    fn predict(&mut self, step: f64) {
        for (to, x) in self.there.iter_mut().zip(&self.x) {
            *to = x
                .iter()
                .rev()
                .fold(C::new(0.0, 0.0), |sum, &c| sum * step + c);
        }
    }

    /// Newton's method at t, by the Jacobian where it begins. Tells whether it converges at once.
    fn correct(&mut self, t: f64) -> bool {
        self.fill();
        if !self.matrix.eliminate() {
            return false;
        }
        self.low.fill(C::new(0.0, 0.0));
        let size = self.size();
        let (mut before, mut precisely) = (f64::INFINITY, false);
        for _ in 0..MOST_CORRECTIONS {
            for e in 0..self.n {
                self.right[e] = match precisely {
                    false => self.residual(e, t),
                    true => self.precise_residual(e, t),
                };
            }
            self.matrix.solve(&mut self.right);
            let mut largest = 0.0f64;
            for k in 0..self.n {
                let change = self.right[k];
                largest = largest.max(change.norm_sqr());
                match precisely {
                    false => self.there[k] -= change,
                    true => self.subtract_precisely(k, change),
                }
            }
            let change = largest.sqrt() / size;
            if change < SETTLED {
                return true;
            }
            if change > CONTRACTION * before || change.is_nan() {
                if before < ROUNDING {
                    return true;
                }
                let is_rounding = before.max(change) < NEAR;
                if precisely || !is_rounding {
                    return false;
                }
                precisely = true;
            }
            before = change;
        }
        false
    }

    /// Subtracts a number from an unknown, in double-doubles.
    fn subtract_precisely(&mut self, k: usize, change: C) {
        let (x, low) = (self.there[k], self.low[k]);
        let re = DoubleDouble::sum(x.re, low.re) - DoubleDouble::from(change.re);
        let im = DoubleDouble::sum(x.im, low.im) - DoubleDouble::from(change.im);
        self.there[k] = C::new(re.hi, im.hi);
        self.low[k] = C::new(re.lo, im.lo);
    }

    /// What an equation lacks.
    fn residual(&self, e: usize, t: f64) -> C {
        let mut value = -self.wanted(e, t);
        for term in &self.terms[self.first[e]..self.first[e + 1]] {
            let [left, right] = term.forms.map(|form| self.form(form));
            value += left * right * term.factor;
        }
        value
    }

    /// The same in double-doubles.
    fn precise_residual(&self, e: usize, t: f64) -> C {
        let wanted = self.wanted(e, t);
        let mut sum = [-wanted.re, -wanted.im].map(DoubleDouble::from);
        let form = |ends: Option<[usize; 2]>| match ends {
            None => [DoubleDouble::from(1.0), DoubleDouble::default()],
            Some([a, b]) => {
                let (x, y) = (self.there[a], self.there[b]);
                let (p, q) = (self.low[a], self.low[b]);
                [
                    DoubleDouble::sum(x.re, p.re) - DoubleDouble::sum(y.re, q.re),
                    DoubleDouble::sum(x.im, p.im) - DoubleDouble::sum(y.im, q.im),
                ]
            }
        };
        for term in &self.terms[self.first[e]..self.first[e + 1]] {
            let ([a, b], [c, d]) = (form(term.forms[0]), form(term.forms[1]));
            let factor = DoubleDouble::from(term.factor);
            sum[0] = sum[0] + factor * (a * c - b * d);
            sum[1] = sum[1] + factor * (a * d + b * c);
        }
        C::new(sum[0].hi, sum[1].hi)
    }

    fn form(&self, ends: Option<[usize; 2]>) -> C {
        ends.map_or(C::new(1.0, 0.0), |[a, b]| self.there[a] - self.there[b])
    }

    /// The Jacobian at the point arrived at.
    fn fill(&mut self) {
        let n = self.n;
        self.matrix.clear();
        for e in 0..n {
            for term in &self.terms[self.first[e]..self.first[e + 1]] {
                let values = term.forms.map(|form| self.form(form));
                for side in 0..2 {
                    let Some([plus, minus]) = term.forms[side] else {
                        continue;
                    };
                    let slope = values[1 - side] * term.factor;
                    for (unknown, slope) in [(plus, slope), (minus, -slope)] {
                        if unknown < n {
                            self.matrix.add(e, unknown, slope);
                        }
                    }
                }
            }
        }
    }
}

/// A square matrix of complex numbers and its elimination with pivots of rows, real and imaginary parts apart.
struct Matrix {
    n: usize,
    re: Vec<f64>,
    im: Vec<f64>,
    /// Which row stands at each place.
    order: Vec<usize>,
    /// Inverses of the pivots.
    pivots: Vec<C>,
    work: Vec<C>,
}

impl Matrix {
    fn new(n: usize) -> Self {
        let zero = C::new(0.0, 0.0);
        Matrix {
            n,
            re: vec![0.0; n * n],
            im: vec![0.0; n * n],
            order: (0..n).collect(),
            pivots: vec![zero; n],
            work: vec![zero; n],
        }
    }

    fn clear(&mut self) {
        self.re.fill(0.0);
        self.im.fill(0.0);
        for (k, row) in self.order.iter_mut().enumerate() {
            *row = k;
        }
    }

    fn add(&mut self, row: usize, column: usize, value: C) {
        self.re[row * self.n + column] += value.re;
        self.im[row * self.n + column] += value.im;
    }

    /// L and U in place. False where a pivot is zero or no number.
    fn eliminate(&mut self) -> bool {
        let n = self.n;
        for k in 0..n {
            let mut best = (k, -1.0);
            for place in k..n {
                let at = self.order[place] * n + k;
                let size = self.re[at] * self.re[at] + self.im[at] * self.im[at];
                if size > best.1 {
                    best = (place, size);
                }
            }
            if best.1 <= 0.0 || !best.1.is_finite() {
                return false;
            }
            self.order.swap(k, best.0);
            let top = self.order[k] * n;
            let inverse = C::new(self.re[top + k], self.im[top + k]).inv();
            self.pivots[k] = inverse;
            for place in k + 1..n {
                let row = self.order[place] * n;
                let here = C::new(self.re[row + k], self.im[row + k]);
                if here.re == 0.0 && here.im == 0.0 {
                    continue;
                }
                let factor = here * inverse;
                subtract(&mut self.re, &mut self.im, [row, top], k + 1, n, factor);
                self.re[row + k] = factor.re;
                self.im[row + k] = factor.im;
            }
        }
        true
    }

    /// Puts the solution in place of the right-hand side.
    fn solve(&mut self, right: &mut [C]) {
        let n = self.n;
        let dot = |row: usize, from: usize, to: usize, x: &[C]| -> C {
            let (re, im) = (
                &self.re[row + from..row + to],
                &self.im[row + from..row + to],
            );
            let mut sum = C::new(0.0, 0.0);
            for ((&a, &b), z) in re.iter().zip(im).zip(&x[from..to]) {
                sum.re = a.mul_add(z.re, (-b).mul_add(z.im, sum.re));
                sum.im = a.mul_add(z.im, b.mul_add(z.re, sum.im));
            }
            sum
        };
        let mut work = std::mem::take(&mut self.work);
        for k in 0..n {
            let row = self.order[k];
            work[k] = right[row] - dot(row * n, 0, k, &work);
        }
        for k in (0..n).rev() {
            work[k] = (work[k] - dot(self.order[k] * n, k + 1, n, &work)) * self.pivots[k];
        }
        right.copy_from_slice(&work);
        self.work = work;
    }
}

/// Subtracts a multiple of one row from another, from a column on.
fn subtract(
    re: &mut [f64],
    im: &mut [f64],
    [row, top]: [usize; 2],
    from: usize,
    n: usize,
    factor: C,
) {
    let (row_re, top_re) = two_rows(re, row, top, from, n);
    let (row_im, top_im) = two_rows(im, row, top, from, n);
    for (((a, b), &c), &d) in row_re.iter_mut().zip(row_im).zip(top_re).zip(top_im) {
        *a = factor.im.mul_add(d, (-factor.re).mul_add(c, *a));
        *b = (-factor.im).mul_add(c, (-factor.re).mul_add(d, *b));
    }
}

/// One row to write and another to read, from a column on.
fn two_rows(
    all: &mut [f64],
    row: usize,
    top: usize,
    from: usize,
    n: usize,
) -> (&mut [f64], &[f64]) {
    if row < top {
        let (low, high) = all.split_at_mut(top);
        (&mut low[row + from..row + n], &high[from..n])
    } else {
        let (low, high) = all.split_at_mut(row);
        (&mut high[from..n], &low[top + from..top + n])
    }
}
