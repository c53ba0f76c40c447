//! F to more than a float's precision: what tubes rest on where 53 bits do not suffice.
//!
//! Points are pairs of vectors, z = high + low, each pair of entries a double-double. Only F itself
//! is evaluated so: everything else in a proof tolerates relative errors of 2⁻⁵³.

use super::equations::{Differences, Equations};
use super::local::Local;
use super::newton::{End, UNTIL, Until};
use super::preconditioner::Preconditioner;
use super::refine::{RefineError, SHRINKS};
use super::tail::Tail;
use crate::interval::rounding::{greatest, round_up};
use crate::interval::{DoubleDouble, gamma_double};
use crate::linalg::Vector;
use crate::places::Each as _;
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
    pub fn differences(
        &self,
        equations: &Equations,
        (z, low): (&[f64], &[f64]),
        out: &mut Differences,
    ) {
        for (axis, out) in out.iter_mut().enumerate() {
            for (e, out) in out[..equations.m].iter_mut().enumerate() {
                // The float nearest to it.
                *out = difference((z, low), equations.ends[axis][e].each(|end| end as usize)).hi;
            }
        }
        let value = |form: usize| form_value(equations, (z, low), form).hi;
        out.forms.set(&equations.tail, value);
    }

    /// F(z) rounded to floats, and if wanted how far the exact value may be from that.
    pub fn residual(
        &self,
        equations: &Equations,
        (z, low): (&[f64], &[f64]),
        out: &mut Vector,
        error: Option<&mut Vector>,
    ) {
        let m = equations.m;
        let t = DoubleDouble {
            hi: z[m],
            lo: low[m],
        };
        let size_of_t = t.size();
        residual(equations, (z, low), (out, error), |e| {
            let mut length = DoubleDouble::default();
            let (mut size, mut radius) = (0.0, 0.0);
            for (coefficient, r) in self.half_squares[e].iter().rev() {
                length = length * t + *coefficient;
                size = size * size_of_t + coefficient.size();
                radius = radius * size_of_t + r;
            }
            (length, size, radius)
        })
    }

    /// F(z) with the target lengths, those of t = 1, whatever z has for t, rounded to floats, and if wanted how
    /// far the exact value may be from that.
    pub fn residual_at_target(
        &self,
        equations: &Equations,
        z: (&[f64], &[f64]),
        out: &mut Vector,
        error: Option<&mut Vector>,
    ) {
        residual(equations, z, (out, error), |e| {
            let (length, radius) = self.targets[e];
            (length, length.size(), radius)
        })
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

/// F(z) rounded to floats, and if wanted how far the exact value may be from that: `right` tells what [`equation`] is to know
/// of a right-hand side. The bounds hold for double-doubles: where the low word is not below half a digit of the high one
/// nothing is known.
#[inline(always)]
fn residual(
    equations: &Equations,
    (z, low): (&[f64], &[f64]),
    (out, mut error): (&mut Vector, Option<&mut Vector>),
    right: impl Fn(usize) -> (DoubleDouble, f64, f64),
) {
    for e in 0..equations.m {
        let (f, bound) = equation(equations, (z, low), e, right(e));
        out[e] = f;
        if let Some(error) = &mut error {
            error[e] = bound;
        }
    }
    if let Some(error) = error
        && z.iter().zip(low).any(|(z, low)| z + low != *z)
    {
        error.fill(f64::INFINITY);
    }
}

fn difference((z, low): (&[f64], &[f64]), ends: [usize; 2]) -> DoubleDouble {
    let [i, j] = ends.each(|end| DoubleDouble {
        hi: z[end],
        lo: low[end],
    });
    i - j
}

fn form_value(equations: &Equations, z: (&[f64], &[f64]), form: usize) -> DoubleDouble {
    match form {
        Tail::ONE => DoubleDouble::from(1.0),
        _ => difference(z, equations.tail.ends(form)),
    }
}

/// q_e(z) − E, as a float, and how far the exact value may be away: E has been computed
/// from terms of that `size` in sum, whose coefficients are known up to what adds up to `radius`.
fn equation(
    equations: &Equations,
    z: (&[f64], &[f64]),
    e: usize,
    (length, size, radius): (DoubleDouble, f64, f64),
) -> (f64, f64) {
    let ends = equations.ends.iter();
    let squared = ends.fold(DoubleDouble::default(), |sum, ends| {
        let d = difference(z, ends[e].each(|end| end as usize));
        sum + d * d
    });
    let half = squared.half();
    let (half, products) = add_tail(equations, z, e, half);
    let f = half - length;
    let size = squared.half().size() + products + size;
    let rounding = gamma_double(equations.roundings().of_residual()) * size + f.lo.abs();
    let bound = equations.roundings().of_extended_bound();
    (f.hi, round_up(rounding + radius, bound))
}

/// Adds what the tail has to the left-hand side of an equation, and tells the size of that.
fn add_tail(
    equations: &Equations,
    z: (&[f64], &[f64]),
    e: usize,
    mut sum: DoubleDouble,
) -> (DoubleDouble, f64) {
    let mut size = 0.0;
    for (half, forms) in equations.tail.products(e) {
        let [left, right] = forms.each(|form| form_value(equations, z, form));
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

impl<const N: usize, Y: Preconditioner> Local<N, Y> {
    /// [`Local::refine`] in extended precision, as far as that goes; the preconditioner is made anew at
    /// the refined point.
    pub fn refine_extended(
        &mut self,
        equations: &Equations,
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
    fn chord_extended(&mut self, equations: &Equations) -> Result<(), RefineError> {
        /// A first correction that shrank by so much is as good as rounding lets it be.
        const SHRUNK: f64 = 1e-6;
        /// Corrections below this need not shrink any more: the proof tells what they are worth.
        const NEAR: f64 = 1e-18;
        let until = Until {
            // Far below all radii.
            goal: 1e-26,
            ratio: SHRINKS,
            makes_last: false,
            ..UNTIL
        };
        let find = |local: &mut Self| local.find_correction(equations);
        let seen = until.correct(self, find, |local, _| local.shift_by(equations.n()));
        (self.first_correction, self.contraction) = (seen.first, seen.contraction);
        let is_done = match seen.end {
            End::Reached => true,
            End::Stagnated | End::Away => seen.last <= SHRUNK * seen.first || seen.last <= NEAR,
            End::Steps => false,
        };
        is_done.then_some(()).ok_or(RefineError::Diverged)
    }

    /// Computes the next correction of `z[0]` and `low`, without making it. Returns its size.
    pub fn find_correction(&mut self, equations: &Equations) -> f64 {
        let z = (&self.z[0][..], &self.low[..]);
        let extended = equations.in_extended();
        extended.residual(equations, z, &mut self.f, None);
        self.solve_for_correction(equations, equations.n())
    }

    /// The correction for what F is, and the size of its first `entries`.
    fn solve_for_correction(&mut self, equations: &Equations, entries: usize) -> f64 {
        self.y
            .solve(equations, &self.f[..equations.m], &mut self.delta);
        greatest(&self.delta[..entries])
    }

    /// Makes the correction in the first `entries`.
    fn shift_by(&mut self, entries: usize) {
        let delta = &self.delta;
        shift(&mut self.z[0][..entries], &mut self.low[..entries], |i| {
            -delta[i]
        });
    }

    /// [`Local::refine_at`] t = 1 in extended precision, by Newton's method.
    pub fn refine_at_target(&mut self, equations: &Equations, maker: &mut Y::Maker) -> Option<()> {
        let m = equations.m;
        self.normal.fill(0.0);
        self.normal[m] = 1.0;
        self.is_extended = true;
        (self.z[0][m], self.low[m]) = (1.0, 0.0);
        let until = Until {
            goal: 1e-28,
            ratio: SHRINKS,
            // The box tells whether that is good enough.
            settled: 1e-18,
            largest: 1.0,
            // Near a double zero Newton's method needs one step for every halving of the distance.
            steps: 60,
            ..UNTIL
        };
        let find = |local: &mut Self| {
            if local.precondition(equations, maker).is_err() {
                return f64::NAN;
            }
            let z = (&local.z[0][..], &local.low[..]);
            let extended = equations.in_extended();
            extended.residual_at_target(equations, z, &mut local.f, None);
            local.solve_for_correction(equations, m)
        };
        let seen = until.correct(self, find, |local, _| local.shift_by(m));
        if seen.first.is_finite() {
            self.first_correction = seen.first;
        }
        if seen.end == End::Away {
            return None;
        }
        self.precondition(equations, maker).ok()
    }
}
