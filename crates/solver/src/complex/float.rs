//! Following complex paths in floats: fast, and nothing is proved on the way.
//!
//! A path x(t) of quadratic equations has Taylor coefficients that cost a linear solution each, all with the same matrix.
//! A step predicts by them, as far as they say that it may, and corrects by Newton's method with the Jacobian where it
//! arrived, whose elimination serves the next step's coefficients too: one elimination a step. Where unknowns are large,
//! squares cancel, and 53 bits leave Newton's method short of a zero; then the residual, and it alone, is taken in
//! double-doubles. Where that does not suffice, as the linear equations lose all digits too, the path is followed in
//! double-doubles altogether, until its unknowns are smaller again; such a step takes some thirty times as long.
//!
//! The path may jump to another one. So what comes of it is a guess, to be proved at its end, and a claim about all
//! solutions rests on their number alone.

use super::matrix::Matrix;
use super::system::System;
use crate::equations::{Form, Halved as _, Product, left_side, slopes};
use crate::interval::DoubleDouble;
use crate::interval::complex::{Complex, Number};
use crate::places::{Each as _, array};
use crate::system::Right;

/// Taylor coefficients beyond the zeroth.
const ORDER: usize = 10;
/// What the last coefficient may add to a step, beside the size of the unknowns. Larger steps fail too often.
const TOLERANCE: f64 = 1e-5;
/// A step is taken if each correction is at most this part of the one before.
const CONTRACTION: f64 = 0.05;
/// A correction smaller than this beside the unknowns is the last one: in floats, in double-doubles.
const SETTLED: [f64; 2] = [1e-12, 1e-20];
/// A correction smaller than this that is followed by no smaller one is taken for rounding.
const ROUNDING: [f64; 2] = [1e-8, 1e-14];
/// Where corrections smaller than this stop shrinking it is taken for rounding's doing, not for that of too long a step.
const NEAR: f64 = 1e-5;
/// How often a step is halved before floats are given up, and before the path is.
const HALVINGS: [usize; 2] = [10, 30];
/// Double-doubles are left again where the unknowns are by so much smaller than where they were taken up.
const SMALLER: f64 = 0.1;
/// Corrections for one step.
const MOST_CORRECTIONS: usize = 12;
/// Beyond this size of an unknown, in units of the typical length, or the radius allowed if that is larger, a path is
/// not followed: rounding has the say there. Up to it paths may go far and come back.
const FAR: f64 = 1e8;
/// Shorter steps of t end the path.
const LEAST_STEP: f64 = 1e-12;

/// How a path ended.
#[derive(Debug, Clone, PartialEq)]
pub enum FloatEnd {
    /// Near this point at t = 1: real and imaginary part of every unknown in turn.
    Reached(Vec<DoubleDouble>),
    /// It could not be followed beyond this t < 1, where an unknown is larger than the radius allowed, and where it was
    /// near this point.
    Beyond(f64, Vec<DoubleDouble>),
    /// It could not be followed beyond this t, where the largest unknown is of this size.
    Stopped(f64, f64),
}

/// Follows paths of one system, setting nothing up twice.
pub struct FloatFollower<'a> {
    plain: Stepper<f64>,
    /// Made when it is wanted for the first time.
    double: Option<Stepper<DoubleDouble>>,
    system: &'a System,
    rights: &'a [Right],
    /// Steps taken, and those of them in double-doubles.
    pub steps: [usize; 2],
}

impl<'a> FloatFollower<'a> {
    /// For the paths while the right-hand sides are these, of real and imaginary parts in turn.
    pub fn new(system: &'a System, rights: &'a [Right]) -> Self {
        FloatFollower {
            plain: Stepper::new(system, rights),
            double: None,
            system,
            rights,
            steps: [0; 2],
        }
    }

    /// Follows a path from near this point at t = 0: real and imaginary part of every unknown in turn.
    pub fn follow(&mut self, start: &[DoubleDouble], radius: f64, most_steps: usize) -> FloatEnd {
        let mut t = 0.0;
        // Where double-doubles are on: the size of the unknowns below which floats are tried again.
        let mut until = None;
        // The size where the path is known to be.
        let mut size = 1.0;
        if self.plain.set(start, 0.0) {
            size = self.plain.size();
        } else if !self.go_over(start, 0.0, &mut until) {
            return FloatEnd::Stopped(0.0, self.plain.size());
        }
        for _ in 0..most_steps {
            if size > radius.max(FAR) {
                break;
            }
            let went = match (&mut self.double, until) {
                (Some(double), Some(small)) => {
                    let went = double.step(&mut t, size);
                    size = if went { double.size() } else { size };
                    if went && size < small && self.plain.set(&double.place(), t) {
                        until = None;
                    }
                    self.steps[1] += usize::from(went);
                    went
                }
                _ if self.plain.step(&mut t, size) => {
                    size = self.plain.size();
                    true
                }
                _ => {
                    let from = self.plain.last_place();
                    self.go_over(&from, t, &mut until)
                }
            };
            if !went {
                break;
            }
            self.steps[0] += 1;
            if t == 1.0 {
                return FloatEnd::Reached(self.place(until.is_some()));
            }
        }
        match size > radius {
            true => FloatEnd::Beyond(t, self.place(until.is_some())),
            false => FloatEnd::Stopped(t, size),
        }
    }

    /// Where the path is known to be: the last step, if it failed, began there.
    fn place(&self, in_double: bool) -> Vec<DoubleDouble> {
        match &self.double {
            Some(double) if in_double => double.known(),
            _ => self.plain.known(),
        }
    }

    /// Goes on in double-doubles from near a point at t. False where Newton's method does not settle there either.
    fn go_over(&mut self, from: &[DoubleDouble], t: f64, until: &mut Option<f64>) -> bool {
        let make = || Stepper::new(self.system, self.rights);
        let double = self.double.get_or_insert_with(make);
        let settled = double.set(from, t);
        *until = Some(SMALLER * double.size());
        settled
    }
}

/// Takes steps along paths in numbers of one kind.
struct Stepper<N> {
    n: usize,
    /// Terms, in which entry n is zero, and where each equation's begin.
    terms: Vec<Product<usize>>,
    first: Vec<usize>,
    /// Taylor coefficients of the unknowns, then of every term's two forms. Unknown n is zero.
    x: Vec<[Complex<N>; ORDER + 1]>,
    forms: Vec<[[Complex<N>; ORDER + 1]; 2]>,
    /// Where a step arrives, and in floats what that leaves if it is known better.
    there: Vec<Complex<N>>,
    low: Vec<Complex<f64>>,
    /// Whether the last step arrived.
    arrived: bool,
    matrix: Matrix<N>,
    right: Vec<Complex<N>>,
    /// For every equation the coefficients of its right-hand side, a polynomial in t.
    rights: Vec<[Complex<N>; 3]>,
}

impl<N: Number> Stepper<N> {
    fn new(system: &System, rights: &[Right]) -> Self {
        let n = system.unknowns.len();
        let (mut terms, mut first) = (Vec::new(), vec![0]);
        for equation in &system.equations {
            let numbered = equation.terms.iter();
            terms.extend(numbered.map(|term| term.map(|i| i.unwrap_or(n))));
            first.push(terms.len());
        }
        let coefficients = |parts: &[Right]| -> [Complex<N>; 3] {
            let number = |part: &Right| part.doubles().each(|(near, _)| N::near(near));
            let (re, im) = (number(&parts[0]), number(&parts[1]));
            array(|k| Complex::new(re[k], im[k]))
        };
        let zero = Complex::default();
        Stepper {
            n,
            x: vec![[zero; ORDER + 1]; n + 1],
            forms: vec![[[zero; ORDER + 1]; 2]; terms.len()],
            terms,
            first,
            there: vec![zero; n + 1],
            low: vec![Complex::default(); n + 1],
            arrived: false,
            matrix: Matrix::new(n),
            right: vec![zero; n],
            rights: rights.chunks(2).map(coefficients).collect(),
        }
    }

    /// Begins near a point at t. False where Newton's method does not settle there.
    fn set(&mut self, start: &[DoubleDouble], t: f64) -> bool {
        for (to, parts) in self.there.iter_mut().zip(start.chunks(2)) {
            *to = Complex::new(N::near(parts[0]), N::near(parts[1]));
        }
        // Should it not settle, this is where it was.
        for (x, &there) in self.x.iter_mut().zip(&self.there) {
            x[0] = there;
        }
        self.arrived = self.correct(t);
        self.arrived
    }

    /// Real and imaginary part of every unknown in turn, where the last step arrived.
    fn place(&self) -> Vec<DoubleDouble> {
        let parts = |(z, low): (&Complex<N>, &Complex<f64>)| {
            [(z.re, low.re), (z.im, low.im)]
                .each(|(x, low)| DoubleDouble::sum(x.rough(), x.rest()) + DoubleDouble::from(low))
        };
        let all = self.there[..self.n].iter().zip(&self.low);
        all.flat_map(parts).collect()
    }

    /// Real and imaginary part of every unknown in turn, where the last step arrived, or where it began if it failed.
    fn known(&self) -> Vec<DoubleDouble> {
        match self.arrived {
            true => self.place(),
            false => self.last_place(),
        }
    }

    /// Real and imaginary part of every unknown in turn, where the last step began.
    fn last_place(&self) -> Vec<DoubleDouble> {
        let parts = |x: &[Complex<N>; ORDER + 1]| {
            [x[0].re, x[0].im].each(|x| DoubleDouble::sum(x.rough(), x.rest()))
        };
        self.x[..self.n].iter().flat_map(parts).collect()
    }

    /// One step from t on, to be tried at shorter lengths until Newton's method settles. False where none does.
    fn step(&mut self, t: &mut f64, size: f64) -> bool {
        self.expand(*t);
        let mut step = self.reach(size).min(1.0 - *t);
        for _ in 0..HALVINGS[usize::from(N::IS_DOUBLE)] {
            self.predict(step);
            let to = if *t + step >= 1.0 { 1.0 } else { *t + step };
            self.arrived = self.correct(to);
            if self.arrived {
                *t = to;
                return true;
            }
            step *= 0.5;
            if step < LEAST_STEP {
                break;
            }
        }
        false
    }

    /// The greatest size of an unknown, at least 1.
    fn size(&self) -> f64 {
        let sizes = self.there.iter().map(|z| z.norm_sqr());
        sizes.fold(1.0, f64::max).sqrt()
    }

    /// The right-hand side of an equation.
    fn wanted(&self, equation: usize, t: f64) -> Complex<N> {
        let [a, b, c] = self.rights[equation];
        (c.times(t.into()) + b).times(t.into()) + a
    }

    /// The Taylor coefficients at the point arrived at, at t, by the elimination made there.
    fn expand(&mut self, t: f64) {
        let zero = Complex::default();
        for (x, &there) in self.x.iter_mut().zip(&self.there) {
            x[0] = there;
        }
        for order in 0..=ORDER {
            if order > 0 {
                for e in 0..self.n {
                    let [_, b, c] = self.rights[e];
                    let mut right = match order {
                        1 => b + c.times((2.0 * t).into()),
                        2 => c,
                        _ => zero,
                    };
                    for term in self.first[e]..self.first[e + 1] {
                        let [left, other] = &self.forms[term];
                        let products = (1..order).map(|i| left[i] * other[order - i]);
                        let sum = products.fold(zero, |sum, product| sum + product);
                        right = right - sum.halves(self.terms[term].factor);
                    }
                    self.right[e] = right;
                }
                self.matrix.solve(&mut self.right);
                for (x, &solved) in self.x.iter_mut().zip(&self.right) {
                    x[order] = solved;
                }
            }
            for (forms, term) in self.forms.iter_mut().zip(&self.terms) {
                for (form, of) in forms.iter_mut().zip(term.forms()) {
                    form[order] = match of {
                        Form::One if order > 0 => Complex::default(),
                        of => of.value(|i| self.x[i][order]),
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
            let powers = x.iter().rev();
            *to = powers.fold(Complex::default(), |sum, &c| sum.times(step.into()) + c);
        }
    }

    /// Newton's method at t, by the Jacobian where it begins. Tells whether it converges at once.
    fn correct(&mut self, t: f64) -> bool {
        self.fill();
        if !self.matrix.eliminate() {
            return false;
        }
        self.low.fill(Complex::default());
        let (kind, size) = (usize::from(N::IS_DOUBLE), self.size());
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
                    false => self.there[k] = self.there[k] - change,
                    true => self.subtract_precisely(k, change),
                }
            }
            let change = largest.sqrt() / size;
            if change < SETTLED[kind] {
                return true;
            }
            if change > CONTRACTION * before || change.is_nan() {
                if before < ROUNDING[kind] {
                    return true;
                }
                let is_rounding = before.max(change) < NEAR;
                if precisely || N::IS_DOUBLE || !is_rounding {
                    return false;
                }
                precisely = true;
            }
            before = change;
        }
        false
    }

    /// Subtracts a number from an unknown, in double-doubles.
    fn subtract_precisely(&mut self, k: usize, change: Complex<N>) {
        let (x, low) = (self.there[k], self.low[k]);
        let re = DoubleDouble::sum(x.re.rough(), low.re) - change.re.rough().into();
        let im = DoubleDouble::sum(x.im.rough(), low.im) - change.im.rough().into();
        self.there[k] = Complex::new(re.hi.into(), im.hi.into());
        self.low[k] = Complex::new(re.lo, im.lo);
    }

    fn terms_of(&self, e: usize) -> &[Product<usize>] {
        &self.terms[self.first[e]..self.first[e + 1]]
    }

    /// What an equation lacks.
    fn residual(&self, e: usize, t: f64) -> Complex<N> {
        left_side(self.terms_of(e), |i| self.there[i]) - self.wanted(e, t)
    }

    /// The same in double-doubles where `there` and `low` are floats.
    fn precise_residual(&self, e: usize, t: f64) -> Complex<N> {
        let wanted = self.wanted(e, t);
        let wanted = wanted.map(|part| DoubleDouble::from(part.rough()));
        let number = |k: usize| {
            let (x, low) = (self.there[k], self.low[k]);
            Complex::new(
                DoubleDouble::sum(x.re.rough(), low.re),
                DoubleDouble::sum(x.im.rough(), low.im),
            )
        };
        let lacks = left_side(self.terms_of(e), number) - wanted;
        lacks.map(|part| part.hi.into())
    }

    /// The Jacobian at the point arrived at.
    fn fill(&mut self) {
        self.matrix.clear();
        for e in 0..self.n {
            let terms = &self.terms[self.first[e]..self.first[e + 1]];
            slopes(
                terms,
                |i| self.there[i],
                |unknown, slope| {
                    if unknown < self.n {
                        self.matrix.add(e, unknown, slope);
                    }
                },
            );
        }
    }
}
