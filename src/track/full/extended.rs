//! F to more than a float's precision: what tubes rest on where 53 bits do not suffice.
//!
//! Points are pairs of vectors, z = high + low, each pair of entries a double-double. Only F itself
//! is evaluated so: everything else in a proof tolerates relative errors of 2⁻⁵³.

use super::equations::{Differences, Equations};
use super::local::{Local, RefineError};
use super::preconditioner::Preconditioner;
use super::tail::Tail;
use crate::interval::rounding::{largest, round_up};
use crate::interval::{DoubleDouble, gamma_double};
use crate::linalg::Vector;
use crate::system::Homotopy;

/// A coefficient and how far the exact one may be from it.
type Approximate = (DoubleDouble, f64);

/// The right-hand sides in double-doubles.
#[derive(Debug, Clone)]
pub struct Extended {
    /// E(t) of every equation.
    half_squares: Vec<[Approximate; 5]>,
    /// E(1), from the target itself.
    targets: Vec<Approximate>,
}

impl Extended {
    /// From a problem's exact numbers.
    pub fn new(homotopy: &Homotopy) -> Self {
        let rights = homotopy.rights.iter();
        Extended {
            half_squares: rights.clone().map(|e| e.doubles()).collect(),
            targets: rights.map(|e| e.double_at_target()).collect(),
        }
    }

    /// Differences p_i − p_j rounded to floats, each with a relative error below 2⁻⁵².
    pub fn differences<const D: usize>(
        &self,
        equations: &Equations<D>,
        (z, low): (&[f64], &[f64]),
        out: &mut Differences<D>,
    ) {
        for (axis, out) in out.iter_mut().enumerate() {
            for (e, out) in out[..equations.m].iter_mut().enumerate() {
                // The float nearest to it.
                *out = difference((z, low), equations.ends[axis][e].map(|end| end as usize)).hi;
            }
        }
        for (form, out) in out.forms.iter_mut().enumerate() {
            *out = form_value(equations, (z, low), form).hi;
        }
    }

    /// F(z) rounded to floats, and how far the exact value may be from that.
    pub fn residual<const D: usize>(
        &self,
        equations: &Equations<D>,
        (z, low): (&[f64], &[f64]),
        out: &mut Vector,
        error: &mut Vector,
    ) {
        let m = equations.m;
        let t = DoubleDouble {
            hi: z[m],
            lo: low[m],
        };
        let size_of_t = t.size();
        for e in 0..m {
            let mut length = DoubleDouble::default();
            let (mut size, mut radius) = (0.0, 0.0);
            for (coefficient, r) in self.half_squares[e].iter().rev() {
                length = length * t + *coefficient;
                size = size * size_of_t + coefficient.size();
                radius = radius * size_of_t + r;
            }
            (out[e], error[e]) = equation(equations, (z, low), e, length, size, radius);
        }
        refuse_overlap((z, low), error);
    }

    /// The same with the target lengths, those of t = 1, whatever z has for t.
    pub fn residual_at_target<const D: usize>(
        &self,
        equations: &Equations<D>,
        (z, low): (&[f64], &[f64]),
        out: &mut Vector,
        error: &mut Vector,
    ) {
        for e in 0..equations.m {
            let (length, radius) = self.targets[e];
            (out[e], error[e]) = equation(equations, (z, low), e, length, length.size(), radius);
        }
        refuse_overlap((z, low), error);
    }
}

#[cfg(test)]
impl Extended {
    /// Moves the constant term of E(t) of each distance, and E(1), and says that it is known only up to
    /// that much: the exact ones are still within the stated radius.
    pub fn blur(&mut self, mut by: impl FnMut(usize) -> f64) {
        let coefficients = self.half_squares.iter_mut().map(|e| &mut e[0]);
        for (e, ((value, radius), target)) in coefficients.zip(&mut self.targets).enumerate() {
            let by = by(e);
            for (value, radius) in [(value, radius), (&mut target.0, &mut target.1)] {
                *value = *value + DoubleDouble::from(by);
                *radius += by.abs() * (1.0 + 1e-10);
            }
        }
    }
}

/// The bounds hold for double-doubles: where the low word is not below half a digit of the high one
/// nothing is known.
fn refuse_overlap((z, low): (&[f64], &[f64]), error: &mut Vector) {
    if z.iter().zip(low).any(|(z, low)| z + low != *z) {
        error.fill(f64::INFINITY);
    }
}

fn difference((z, low): (&[f64], &[f64]), ends: [usize; 2]) -> DoubleDouble {
    let [i, j] = ends.map(|end| DoubleDouble {
        hi: z[end],
        lo: low[end],
    });
    i - j
}

fn form_value<const D: usize>(
    equations: &Equations<D>,
    z: (&[f64], &[f64]),
    form: usize,
) -> DoubleDouble {
    match form {
        Tail::ONE => DoubleDouble::from(1.0),
        _ => difference(z, equations.tail.ends(form)),
    }
}

/// q_e(z) − E, as a float, and how far the exact value may be away: E has been computed
/// from terms of that `size` in sum, whose coefficients are known up to what adds up to `radius`.
///
/// No term of a distance passes through more than 20 operations: a difference is relatively exact, twice in
/// a square; D sums; ten in Horner's rule; the last subtraction. A product of the tail passes through one
/// multiplication more, by half a small whole number.
fn equation<const D: usize>(
    equations: &Equations<D>,
    z: (&[f64], &[f64]),
    e: usize,
    length: DoubleDouble,
    size: f64,
    radius: f64,
) -> (f64, f64) {
    let squared = (0..D).fold(DoubleDouble::default(), |sum, axis| {
        let d = difference(z, equations.ends[axis][e].map(|end| end as usize));
        sum + d * d
    });
    let half = squared.half();
    let (half, products) = add_tail(equations, z, e, half);
    let f = half - length;
    let size = squared.half().size() + products + size;
    let rounding = gamma_double(equations.roundings(20)) * size + f.lo.abs();
    // The bound's own roundings: two for every step of Horner's rule, and sizes rounded to floats.
    (f.hi, round_up(rounding + radius, equations.roundings(40)))
}

/// Adds what the tail has to the left-hand side of an equation, and tells the size of that.
fn add_tail<const D: usize>(
    equations: &Equations<D>,
    z: (&[f64], &[f64]),
    e: usize,
    mut sum: DoubleDouble,
) -> (DoubleDouble, f64) {
    let mut size = 0.0;
    for (half, forms) in equations.tail.products(e) {
        let [left, right] = forms.map(|form| form_value(equations, z, form));
        let product = DoubleDouble::from(half) * left * right;
        sum = sum + product;
        size += product.size();
    }
    (sum, size)
}

/// `z += change`, entry by entry, z being a pair of vectors.
pub fn shift(z: &mut [f64], low: &mut [f64], change: impl Fn(usize) -> f64) {
    for (i, (z, low)) in z.iter_mut().zip(low).enumerate() {
        let sum = DoubleDouble { hi: *z, lo: *low } + DoubleDouble::from(change(i));
        (*z, *low) = (sum.hi, sum.lo);
    }
}

impl<const D: usize, const N: usize, Y: Preconditioner<D>> Local<D, N, Y> {
    /// [`Local::refine`] in extended precision, as far as that goes; the preconditioner is made anew at
    /// the refined point.
    pub fn refine_extended(
        &mut self,
        equations: &Equations<D>,
        maker: &mut Y::Maker,
    ) -> Result<(), RefineError> {
        self.is_extended = true;
        self.low.fill(0.0);
        for _ in 0..2 {
            self.precondition(equations, maker)?;
            self.chord_extended(equations)?;
        }
        self.precondition(equations, maker)
    }

    /// Corrections of `z[0]` and `low` until they stop shrinking.
    fn chord_extended(&mut self, equations: &Equations<D>) -> Result<(), RefineError> {
        /// A first correction that shrank by so much is as good as rounding lets it be.
        const SHRUNK: f64 = 1e-6;
        /// Nor do corrections below this have to shrink any more: the proof tells what they are worth.
        const NEAR: f64 = 1e-18;
        /// Corrections below this are far below all radii.
        const SMALLEST: f64 = 1e-26;
        let n = equations.n();
        let mut error = equations.per_edge();
        let mut last = f64::INFINITY;
        self.contraction = 0.0;
        for iteration in 0..100 {
            let size = self.find_correction(equations, &mut error);
            match iteration {
                0 => self.first_correction = size,
                1 => self.contraction = size / last,
                _ => {}
            }
            // A NaN is no less.
            let shrinks = size <= 0.25 * last;
            if !shrinks {
                let done = last <= SHRUNK * self.first_correction || last <= NEAR;
                return if done {
                    Ok(())
                } else {
                    Err(RefineError::Diverged)
                };
            }
            let delta = &self.delta;
            shift(&mut self.z[0][..n], &mut self.low[..n], |i| -delta[i]);
            if size <= SMALLEST {
                return Ok(());
            }
            last = size;
        }
        Err(RefineError::Diverged)
    }

    /// Computes the next correction of `z[0]` and `low`, without making it. Returns its size; `error` is
    /// overwritten.
    fn find_correction(&mut self, equations: &Equations<D>, error: &mut Vector) -> f64 {
        let (m, n) = (equations.m, equations.n());
        let (extended, z) = (equations.in_extended(), (&self.z[0][..], &self.low[..]));
        extended.residual(equations, z, &mut self.f, error);
        self.y.solve(equations, &self.f[..m], &mut self.delta);
        let sizes = self.delta[..n].iter();
        sizes.fold(0.0, |size, x| largest(size, x.abs()))
    }

    /// The size of the next correction, where the last ones did not shrink.
    pub fn correction_extended(&mut self, equations: &Equations<D>) -> f64 {
        self.find_correction(equations, &mut equations.per_edge())
    }

    /// [`Local::polish_at`] t = 1 in extended precision, by Newton's method.
    pub fn polish_extended(
        &mut self,
        equations: &Equations<D>,
        maker: &mut Y::Maker,
    ) -> Option<()> {
        let m = equations.m;
        self.normal.fill(0.0);
        self.normal[m] = 1.0;
        self.is_extended = true;
        (self.z[0][m], self.low[m]) = (1.0, 0.0);
        let mut error = equations.per_edge();
        let mut last = f64::INFINITY;
        // Near a double zero Newton's method needs one step for every halving of the distance.
        for iteration in 0..60 {
            self.precondition(equations, maker).ok()?;
            let z = (&self.z[0][..], &self.low[..]);
            let extended = equations.in_extended();
            extended.residual_at_target(equations, z, &mut self.f, &mut error);
            self.y.solve(equations, &self.f[..m], &mut self.delta);
            let sizes = self.delta[..m].iter();
            let size = sizes.fold(0.0, |size, x| largest(size, x.abs()));
            if iteration == 0 {
                self.first_correction = size;
            }
            if size.is_nan() || size > 1.0 {
                return None;
            }
            let delta = &self.delta;
            shift(&mut self.z[0][..m], &mut self.low[..m], |i| -delta[i]);
            // The box tells whether that is good enough.
            if size <= 1e-18 && size > 0.25 * last || size <= 1e-28 {
                break;
            }
            last = size;
        }
        self.precondition(equations, maker).ok()
    }
}
