//! Numbers that are known exactly as long as they are ratios, and otherwise between two floats.

use crate::equations::ring;
use crate::interval::{Interval, Real, enclose_rational};
use crate::rational::Rational;

/// Ratios with longer numerators or denominators are not kept.
const MOST_BITS: u64 = 512;

/// Ratios of two to the power of more than this are beyond floats, or nearly so.
const LARGEST: u64 = 1000;

/// A number: where it is, and what it is if that is a ratio of moderate size.
#[derive(Debug, Clone)]
pub struct Number {
    exact: Option<Rational>,
    within: Interval,
}

ring!(Number, |number: i64| Number::halves(2 * number));

impl Number {
    /// A ratio.
    pub fn exactly(value: Rational) -> Self {
        let (above, below) = (value.numer().bits(), value.denom().bits());
        Number {
            within: match above > below + LARGEST {
                true => Interval::ENTIRE,
                false => enclose_rational(&value),
            },
            exact: (above.max(below) <= MOST_BITS).then_some(value),
        }
    }

    /// A whole number or a half of one.
    pub fn halves(count: i64) -> Self {
        Self::exactly(Rational::new(count.into(), 2.into()))
    }

    /// One number of an interval.
    pub fn within(interval: Interval) -> Self {
        Number {
            exact: None,
            within: interval,
        }
    }

    /// An exact number.
    pub fn of(real: &Real) -> Self {
        match real.as_rational() {
            Some(value) => Self::exactly(value.clone()),
            None => Self::within(real.enclose()),
        }
    }

    /// The number for exact arithmetic: a ratio where it is exact, otherwise a number within its interval; `None`
    /// if nothing is known of it.
    pub fn to_real(&self) -> Option<Real> {
        match &self.exact {
            Some(value) => Some(Real::from(value.clone())),
            None => self
                .within
                .is_common_interval()
                .then(|| Real::within(self.within)),
        }
    }

    /// Where it is.
    pub fn enclosure(&self) -> Interval {
        self.within
    }

    /// Whether it is kept as a ratio.
    pub fn is_exact(&self) -> bool {
        self.exact.is_some()
    }

    /// Whether it is known to be zero.
    pub fn is_zero(&self) -> bool {
        self.exact.as_ref().is_some_and(Rational::is_zero)
    }

    /// −1, 0 or 1; `None` where that is not known.
    pub fn sign(&self) -> Option<i8> {
        match &self.exact {
            Some(value) if value.is_zero() => Some(0),
            Some(value) => Some(if value.is_positive() { 1 } else { -1 }),
            None if self.within.inf() > 0.0 => Some(1),
            None if self.within.sup() < 0.0 => Some(-1),
            None => None,
        }
    }

    fn combine(
        &self,
        other: &Self,
        exact: impl Fn(&Rational, &Rational) -> Rational,
        within: impl Fn(Interval, Interval) -> Interval,
    ) -> Self {
        match (&self.exact, &other.exact) {
            (Some(a), Some(b)) => Self::exactly(exact(a, b)),
            _ => Self::within(within(self.within, other.within)),
        }
    }

    /// The sum.
    pub fn plus(&self, other: &Self) -> Self {
        self.combine(other, |a, b| a + b, |a, b| a + b)
    }

    /// The difference.
    pub fn minus(&self, other: &Self) -> Self {
        self.combine(other, |a, b| a - b, |a, b| a - b)
    }

    /// The product.
    pub fn times(&self, other: &Self) -> Self {
        match self.is_zero() || other.is_zero() {
            true => Self::halves(0),
            false => self.combine(other, |a, b| a * b, |a, b| a * b),
        }
    }

    /// The quotient; `None` if the divisor may be zero.
    pub fn over(&self, other: &Self) -> Option<Self> {
        let is_nonzero = other.sign().is_some_and(|sign| sign != 0);
        is_nonzero.then(|| self.combine(other, |a, b| a / b, |a, b| a / b))
    }

    /// The root that is not negative; `None` if the number may be negative.
    pub fn sqrt(&self) -> Option<Self> {
        let Some(value) = &self.exact else {
            return (self.within.inf() >= 0.0).then(|| Self::within(self.within.sqrt()));
        };
        if value.is_negative() {
            return None;
        }
        Some(match value.sqrt() {
            Some(root) => Self::exactly(root),
            None => Self::within(Real::from(value.clone()).sqrt().enclose()),
        })
    }

    /// The number, which is known to be in the interval `to` too: an exact one stays as it is, any other is within
    /// both intervals.
    pub fn narrowed(&self, to: Interval) -> Self {
        match self.is_exact() {
            true => self.clone(),
            false => Self::within(self.within.intersection(to)),
        }
    }
}
