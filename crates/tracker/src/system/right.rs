//! The right-hand side E(t) of an equation: one exact polynomial, and the forms in which it is used.

use super::{ExactLength, Length};
use crate::constraint::MAX_DEGREE;
use crate::interval::{Ball, DoubleDouble, Interval, Real, point};
use crate::places::{Each as _, array};
use crate::rational::Rational;

/// E(t), a polynomial of degree at most 4 with exact coefficients, in the homotopy's unit: half the
/// square of a length (RR 8705, section 3.1), or what a constraint says.
///
/// It hands out enclosures in intervals, floats with radii, double-doubles with errors, and ratios.
#[derive(Debug, Clone)]
pub struct Right {
    enclosures: [Interval; MAX_DEGREE + 1],
    target: Interval,
    exact: Exact,
    /// The middles of the coefficients.
    pub e: [f64; MAX_DEGREE + 1],
    /// How far the exact coefficients may be from `e`.
    pub e_radius: [f64; MAX_DEGREE + 1],
    /// The degree: 2 where it is less.
    pub degree: usize,
}

/// What it is exactly.
#[derive(Debug, Clone)]
enum Exact {
    /// Half the square of a length.
    HalfSquare(ExactLength),
    /// A polynomial, divided by a power of two.
    Polynomial(Vec<Real>, Rational),
    /// Any number of a range.
    Anywhere(Interval),
}

/// A number and how far the exact one may be from it.
type Approximate = (DoubleDouble, f64);

impl Right {
    /// Half the square of a length.
    pub fn half_square(length: &Length, exact: ExactLength) -> Self {
        Self::new(
            length.half_square(),
            length.target_half_square(),
            Exact::HalfSquare(exact),
            length.degree_of_square(),
        )
    }

    /// The polynomial with these coefficients, t⁰ first, divided by `unit`, a power of two.
    ///
    /// # Panics
    /// If there are more than five coefficients.
    pub fn polynomial(coefficients: &[Real], unit: f64) -> Self {
        assert!(
            coefficients.len() <= MAX_DEGREE + 1,
            "right-hand sides have a degree of at most {MAX_DEGREE}"
        );
        let per_unit = point(1.0 / unit);
        let mut enclosures = [point(0.0); MAX_DEGREE + 1];
        for (out, coefficient) in enclosures.iter_mut().zip(coefficients) {
            *out = coefficient.enclose() * per_unit;
        }
        let target = sum(coefficients).enclose() * per_unit;
        let high = coefficients.iter().skip(3).any(|c| !c.is_zero());
        let unit = Rational::from_float(unit).expect("a unit is a power of two");
        let exact = Exact::Polynomial(coefficients.to_vec(), unit);
        Self::new(enclosures, target, exact, if high { MAX_DEGREE } else { 2 })
    }

    /// A number that is anywhere in a bounded range, whatever t is: what is proved with it holds for each of them.
    pub fn anywhere(range: Interval) -> Self {
        let mut enclosures = [point(0.0); MAX_DEGREE + 1];
        enclosures[0] = range;
        Self::new(enclosures, range, Exact::Anywhere(range), 2)
    }

    fn new(
        enclosures: [Interval; MAX_DEGREE + 1],
        target: Interval,
        exact: Exact,
        degree: usize,
    ) -> Self {
        Right {
            e: enclosures.each(|x| x.mid()),
            e_radius: enclosures.each(|x| x.rad()),
            enclosures,
            target,
            exact,
            degree,
        }
    }

    /// Enclosures of the coefficients.
    pub fn enclosures(&self) -> &[Interval; MAX_DEGREE + 1] {
        &self.enclosures
    }

    /// An enclosure of E on a set of t.
    pub fn enclose(&self, t: Interval) -> Interval {
        let e = &self.enclosures;
        e[0] + t * (e[1] + t * (e[2] + t * (e[3] + t * e[4])))
    }

    /// An enclosure of E'' on a set of t.
    pub fn enclose_curvature(&self, t: Interval) -> Interval {
        let [_, _, e2, e3, e4] = self.enclosures;
        point(2.0) * e2 + t * (point(6.0) * e3 + t * (point(12.0) * e4))
    }

    /// An enclosure of E(1), straight from the target.
    pub fn at_target(&self) -> Interval {
        self.target
    }

    /// The coefficients in double-doubles, with their errors.
    pub fn doubles(&self) -> [Approximate; MAX_DEGREE + 1] {
        match &self.exact {
            Exact::HalfSquare(length) => length.half_square(),
            Exact::Polynomial(coefficients, unit) => array(|k| {
                let coefficient = coefficients.get(k).cloned().unwrap_or_else(Real::zero);
                divided(coefficient, unit).double()
            }),
            Exact::Anywhere(range) => {
                let zero = (DoubleDouble::default(), 0.0);
                array(|k| if k == 0 { ball(*range).double() } else { zero })
            }
        }
    }

    /// E(1) in double-doubles, straight from the target, with its error.
    pub fn double_at_target(&self) -> Approximate {
        self.ball_at_target().double()
    }

    /// E(1) in ratios, straight from the target.
    pub fn ball_at_target(&self) -> Ball {
        match &self.exact {
            Exact::HalfSquare(length) => length.target_half_square(),
            Exact::Polynomial(coefficients, unit) => divided(sum(coefficients), unit),
            Exact::Anywhere(range) => ball(*range),
        }
    }
}

/// A bounded range as a ball.
fn ball(range: Interval) -> Ball {
    let ends = [range.inf(), range.sup()].map(|end| Rational::from_float(end).expect("a number"));
    let [low, high] = &ends;
    let half = Rational::new(1.into(), 2.into());
    Ball {
        middle: (low + high) * &half,
        radius: (high - low) * &half,
    }
}

fn sum(coefficients: &[Real]) -> Real {
    coefficients.iter().fold(Real::zero(), |sum, c| &sum + c)
}

fn divided(number: Real, unit: &Rational) -> Ball {
    (&number * &Real::from(unit.recip())).ball()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_of_a_polynomial_is_the_same() {
        let third = &Real::whole(1) / &Real::whole(3);
        let coefficients = [third, Real::whole(2).sqrt(), Real::zero(), Real::whole(-5)];
        let right = Right::polynomial(&coefficients, 4.0);
        assert_eq!(right.degree, 4);
        let value = |t: f64| (1.0 / 3.0 + t * 2f64.sqrt() - 5.0 * t.powi(3)) / 4.0;
        for t in [0.0, 0.5, 1.0, -2.0] {
            let box_ = right.enclose(point(t));
            assert!((box_.mid() - value(t)).abs() < 1e-14 && box_.wid() < 1e-14);
        }
        for (k, (near, radius)) in right.doubles().into_iter().enumerate() {
            assert!(right.enclosures()[k].contains(near.hi) && radius < 1e-30);
            assert!((right.e[k] - near.hi).abs() <= right.e_radius[k]);
        }
        assert!(right.at_target().contains(right.double_at_target().0.hi));
        assert!((right.at_target().mid() - value(1.0)).abs() < 1e-14);
        assert_eq!(Right::polynomial(&[Real::whole(3)], 1.0).degree, 2);
    }

    /// Two numbers of one range are not known to be the same, as equations with one right-hand side would have them.
    #[test]
    fn what_is_anywhere_is_not_the_same_as_another() {
        let range = point(0.75).convex_hull(point(1.5));
        let [one, other] = [Right::anywhere(range), Right::anywhere(range)];
        assert_eq!(one.at_target(), range);
        assert_ne!(one.ball_at_target(), other.ball_at_target());
        let (near, radius) = one.double_at_target();
        assert!(near.hi - radius <= 0.75 && near.hi + radius >= 1.5);
        let exact = [0, 1].map(|_| Right::anywhere(point(0.75)).ball_at_target());
        assert_eq!(exact[0], exact[1]);
    }
}
