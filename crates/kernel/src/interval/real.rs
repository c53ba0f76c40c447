//! Exact real numbers: what the decimals of a problem denote, with roots and with cosines of angles.

use super::{DoubleDouble, Interval, at_least, enclose_rational};
use crate::rational::Rational;
use num_bigint::BigInt;
use num_traits::{One, ToPrimitive, Zero};
use std::borrow::Cow;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::{Arc, OnceLock};

/// An exact real number, kept as an expression. Enclosures of it are computed with some 250 bits and
/// rounded outwards, so that each of its views ([`Real::enclose`], [`Real::double`]) is nearly as
/// tight as its format allows. A copy shares the expression, and what was computed of it once is kept.
///
/// ```
/// use krawl::interval::Real;
/// let half = Real::cosine_of_degrees(krawl::rational::Rational::from_integer(60.into()));
/// assert!(half.enclose().contains(0.5));
/// let two = Real::whole(2);
/// let root = two.clone().sqrt();
/// assert!((&(&root * &root) - &two).enclose().mag() < 1e-60);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Real {
    /// A ratio of whole numbers.
    Rational(Rational),
    /// The root of a number that is not negative.
    Root(Shared<Real>),
    /// The cosine of an angle in degrees.
    Cosine(Shared<Rational>),
    /// A sum.
    Sum(Shared<[Real; 2]>),
    /// A product.
    Product(Shared<[Real; 2]>),
    /// The first divided by the second, which is not zero.
    Quotient(Shared<[Real; 2]>),
    /// One number of this ball, of which no more is known: what is proved with it holds for each of them.
    Within(Box<Ball>),
}

/// What a number is made of, and a ball that holds the number once one was computed. Only [`Real`] looks into it.
pub struct Shared<T>(Arc<(T, OnceLock<Ball>)>);

impl<T> Shared<T> {
    fn new(of: T) -> Self {
        Shared(Arc::new((of, OnceLock::new())))
    }

    /// What the number is made of.
    fn of(&self) -> &T {
        &self.0.0
    }

    /// The ball, which is computed and rounded where there is none.
    fn ball(&self, of: impl FnOnce(&T) -> Ball) -> &Ball {
        let (what, ball) = &*self.0;
        ball.get_or_init(|| of(what).rounded())
    }
}

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Self {
        Shared(self.0.clone())
    }
}

impl<T: std::fmt::Debug> std::fmt::Debug for Shared<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        self.of().fmt(f)
    }
}

/// By what numbers are made of, not by whether they share it: a sum with a number of which only a range is known may not be
/// itself, as copies of that number need not be the same.
impl<T: PartialEq> PartialEq for Shared<T> {
    fn eq(&self, other: &Self) -> bool {
        self.of() == other.of()
    }
}

impl From<Rational> for Real {
    fn from(value: Rational) -> Self {
        Real::Rational(value)
    }
}

impl From<BigInt> for Real {
    fn from(value: BigInt) -> Self {
        Real::Rational(value.into())
    }
}

impl Real {
    /// Zero.
    pub fn zero() -> Self {
        Real::Rational(Rational::zero())
    }

    /// A number of which only an enclosure is known.
    ///
    /// # Panics
    /// If a bound is not finite.
    pub fn within(interval: Interval) -> Self {
        let ratio = |x: f64| Rational::from_float(x).expect("a bound is finite");
        let (low, high) = (ratio(interval.inf()), ratio(interval.sup()));
        let half = Rational::new(1.into(), 2.into());
        Real::Within(Box::new(Ball {
            middle: (&low + &high) * &half,
            radius: (high - low) * half,
        }))
    }

    /// The whole number `value`.
    pub fn whole(value: i64) -> Self {
        Real::Rational(Rational::from_integer(value.into()))
    }

    /// The cosine of an angle in degrees; exact where it is a multiple of one half.
    pub fn cosine_of_degrees(degrees: Rational) -> Self {
        let full = Rational::from_integer(360.into());
        let mut angle = &degrees - (&degrees / &full).floor() * &full;
        if angle > Rational::from_integer(180.into()) {
            angle = full - angle;
        }
        // 0 ≤ angle ≤ 180.
        let whole = angle.is_integer().then(|| angle.to_integer().to_i64());
        let (above, below) = match whole.flatten() {
            Some(0) => (1, 1),
            Some(60) => (1, 2),
            Some(90) => (0, 1),
            Some(120) => (-1, 2),
            Some(180) => (-1, 1),
            _ => return Real::Cosine(Shared::new(angle)),
        };
        Real::Rational(Rational::new(above.into(), below.into()))
    }

    /// The sine of an angle in degrees.
    pub fn sine_of_degrees(degrees: Rational) -> Self {
        Self::cosine_of_degrees(Rational::from_integer(90.into()) - degrees)
    }

    /// The root. Where this number is a ratio of squares, it is exact.
    ///
    /// # Panics
    /// If this is a negative ratio.
    pub fn sqrt(self) -> Self {
        if let Real::Rational(value) = &self {
            assert!(!value.is_negative(), "the root of a negative number");
            if let Some(root) = value.sqrt() {
                return Real::Rational(root);
            }
        }
        Real::Root(Shared::new(self))
    }

    /// The number as a ratio, where it is kept as one.
    pub fn as_rational(&self) -> Option<&Rational> {
        match self {
            Real::Rational(value) => Some(value),
            _ => None,
        }
    }

    /// Whether the number is known to be zero without any computation.
    pub fn is_zero(&self) -> bool {
        self.as_rational().is_some_and(Rational::is_zero)
    }

    /// Whether this is written as −1 times the other number.
    fn is_opposite(&self, other: &Real) -> bool {
        let Real::Product(parts) = self else {
            return false;
        };
        let [a, b] = parts.of();
        let minus_one = |x: &Real| x.as_rational().is_some_and(|x| (-x).is_one());
        (minus_one(a) && b == other || minus_one(b) && a == other) && other.is_one_number()
    }

    /// Whether what is written is always the same number: two numbers that are only known to be in a range may
    /// differ, though the ranges are the same.
    fn is_one_number(&self) -> bool {
        match self {
            Real::Rational(_) | Real::Cosine(_) => true,
            Real::Root(root) => root.of().is_one_number(),
            Real::Sum(parts) | Real::Product(parts) | Real::Quotient(parts) => {
                parts.of().iter().all(Real::is_one_number)
            }
            Real::Within(_) => false,
        }
    }

    /// An enclosure in floats.
    ///
    /// # Panics
    /// If the number is beyond the range of floats.
    pub fn enclose(&self) -> Interval {
        let ball = self.seen();
        if ball.radius.is_zero() {
            return enclose_rational(&ball.middle);
        }
        let low = enclose_rational(&(&ball.middle - &ball.radius));
        let high = enclose_rational(&(&ball.middle + &ball.radius));
        low.convex_hull(high)
    }

    /// The nearest double-double, and how far the number may be from it.
    pub fn double(&self) -> (DoubleDouble, f64) {
        self.seen().double()
    }

    /// A ball of ratios that holds the number.
    pub fn ball(&self) -> Ball {
        self.seen().into_owned()
    }

    /// The ball, which is kept but for ratios and for balls that were given.
    fn seen(&self) -> Cow<'_, Ball> {
        let two = |[a, b]: &[Real; 2], of: fn(&Ball, &Ball) -> Ball| of(&a.seen(), &b.seen());
        Cow::Borrowed(match self {
            Real::Rational(value) => return Cow::Owned(Ball::exactly(value.clone())),
            Real::Within(ball) => return Cow::Owned((**ball).clone().rounded()),
            Real::Root(root) => root.ball(|of| of.seen().sqrt()),
            Real::Cosine(angle) => angle.ball(cosine),
            Real::Sum(parts) => parts.ball(|parts| two(parts, Ball::plus)),
            Real::Product(parts) => parts.ball(|parts| two(parts, Ball::times)),
            Real::Quotient(parts) => parts.ball(|parts| two(parts, |a, b| a.times(&b.inverse()))),
        })
    }
}

impl<'a> Add<&'a Real> for &'a Real {
    type Output = Real;
    fn add(self, other: &Real) -> Real {
        match (self, other) {
            (Real::Rational(a), Real::Rational(b)) => Real::Rational(a + b),
            (a, b) if a.is_zero() => b.clone(),
            (a, b) if b.is_zero() => a.clone(),
            (a, b) if a.is_opposite(b) || b.is_opposite(a) => Real::zero(),
            (a, b) => Real::Sum(Shared::new([a.clone(), b.clone()])),
        }
    }
}

impl Neg for &Real {
    type Output = Real;
    fn neg(self) -> Real {
        self * &Real::whole(-1)
    }
}

impl<'a> Sub<&'a Real> for &'a Real {
    type Output = Real;
    fn sub(self, other: &Real) -> Real {
        self + &-other
    }
}

impl<'a> Mul<&'a Real> for &'a Real {
    type Output = Real;
    fn mul(self, other: &Real) -> Real {
        match (self, other) {
            (Real::Rational(a), Real::Rational(b)) => Real::Rational(a * b),
            (a, b) if a.is_zero() || b.is_zero() => Real::zero(),
            (Real::Rational(one), x) | (x, Real::Rational(one)) if one.is_one() => x.clone(),
            (a, b) => Real::Product(Shared::new([a.clone(), b.clone()])),
        }
    }
}

impl<'a> Div<&'a Real> for &'a Real {
    type Output = Real;
    fn div(self, other: &Real) -> Real {
        match (self, other) {
            (Real::Rational(a), Real::Rational(b)) => Real::Rational(a / b),
            (a, b) => Real::Quotient(Shared::new([a.clone(), b.clone()])),
        }
    }
}

/// Numbers are kept to 2 to minus this.
const BITS: u64 = 320;

/// A ratio and how far the exact number may be from it.
#[derive(Debug, Clone)]
pub struct Ball {
    /// The ratio.
    pub middle: Rational,
    /// How far the number may be away.
    pub radius: Rational,
}

/// Whether two balls' numbers are known to be the same one.
impl PartialEq for Ball {
    fn eq(&self, other: &Self) -> bool {
        self.radius.is_zero() && other.radius.is_zero() && self.middle == other.middle
    }
}

impl Ball {
    /// Just this ratio.
    pub fn exactly(middle: Rational) -> Self {
        Ball {
            middle,
            radius: Rational::zero(),
        }
    }

    /// The sums of two balls' numbers.
    pub fn plus(&self, other: &Self) -> Self {
        if self.radius.is_zero() && other.radius.is_zero() {
            return Self::exactly(&self.middle + &other.middle);
        }
        Ball {
            middle: &self.middle + &other.middle,
            radius: &self.radius + &other.radius,
        }
    }

    /// The products of two balls' numbers.
    pub fn times(&self, other: &Self) -> Self {
        if self.radius.is_zero() && other.radius.is_zero() {
            return Self::exactly(&self.middle * &other.middle);
        }
        let most = other.middle.abs() + &other.radius;
        Ball {
            middle: &self.middle * &other.middle,
            radius: self.middle.abs() * &other.radius + &self.radius * most,
        }
    }

    /// The numbers with the other sign.
    pub fn negated(&self) -> Self {
        Ball {
            middle: -&self.middle,
            radius: self.radius.clone(),
        }
    }

    /// The inverses of a ball's numbers.
    ///
    /// # Panics
    /// If zero is one of them.
    pub fn inverse(&self) -> Self {
        let least = self.middle.abs() - &self.radius;
        assert!(least.is_positive(), "division by what may be zero");
        // |1/x − 1/m| = |m − x| / |x m|.
        Ball {
            middle: self.middle.recip(),
            radius: &self.radius / (least * self.middle.abs()),
        }
    }

    /// The roots of a ball's numbers, those below zero being none.
    pub fn sqrt(&self) -> Self {
        let middle = if self.middle.is_negative() {
            Rational::zero()
        } else {
            self.middle.clone()
        };
        if middle.is_zero() {
            let top = root(&self.radius);
            return Ball {
                middle: Rational::zero(),
                radius: top.middle + top.radius,
            };
        }
        let near = root(&middle);
        if self.radius.is_zero() {
            return near;
        }
        // |√x − √m| = |x − m| / (√x + √m).
        let least = &near.middle - &near.radius;
        let radius = near.radius + &self.radius / least;
        Ball {
            middle: near.middle,
            radius,
        }
    }

    /// The nearest double-double, and how far the number may be from it.
    pub fn double(&self) -> (DoubleDouble, f64) {
        let (near, left) = DoubleDouble::near(&self.middle);
        // One rounding more.
        let radius = (left + at_least(&self.radius)) * (1.0 + 1e-10);
        (near, radius)
    }

    /// A ball around the same number whose middle has about [`BITS`] bits; a ball of radius zero stays as it is.
    fn rounded(self) -> Self {
        if self.radius.is_zero() {
            return self;
        }
        // Relative to the middle's size, a power of two.
        let size = self.middle.numer().bits() as i64 - self.middle.denom().bits() as i64;
        let shift = BITS as i64 - size;
        let middle = self.middle.shifted(shift);
        let near = (&middle + Rational::new(1.into(), 2.into())).floor();
        // How far that is, in units of 2 to minus `shift`; a radius of few digits, not smaller.
        let radius = self.radius.shifted(shift) + (&near - middle).abs();
        let radius = radius.shifted(64).ceil().shifted(-shift - 64);
        let middle = near.shifted(-shift);
        Ball { middle, radius }
    }
}

/// The root of a ratio that is not negative, to a relative 2⁻²⁵⁰.
pub fn root(squared: &Rational) -> Ball {
    if squared.is_zero() {
        return Ball::exactly(Rational::zero());
    }
    let (above, below) = (squared.numer(), squared.denom());
    // ⌊√⌊x 4ᵏ⌋⌋ ≤ 2ᵏ √x < that + 1.
    let wanted = 2 * 256 + below.bits();
    let k = wanted.saturating_sub(above.bits()) / 2 + 1;
    let scaled: BigInt = (above << (2 * k)) / below;
    let k = i64::try_from(k).expect("a number of bits");
    Ball {
        middle: Rational::from(scaled.sqrt()).shifted(-k),
        radius: Rational::one().shifted(-k),
    }
}

/// The cosine of an angle from 0 to 180 degrees.
fn cosine(degrees: &Rational) -> Ball {
    static PI: OnceLock<Ball> = OnceLock::new();
    let pi = PI.get_or_init(pi);
    // All in units of 2⁻⁴⁰⁰, quotients rounded down, errors counted in units and rounded up.
    let one = BigInt::one() << 400u32;
    let part = degrees / Rational::from_integer(180.into());
    let units = |of: &Rational| (of * &part).shifted(400);
    let x = units(&pi.middle).floor().to_integer();
    // |x| ≤ π < 4: the square is off by less than 8 times what x is, and by one for rounding.
    let x_error = units(&pi.radius).ceil().to_integer() + 1;
    let square: BigInt = (&x * &x) >> 400u32;
    let square_error = x_error * 8 + 2;
    // Σ (−x²)ᵏ/(2k)!; with |x| ≤ π what comes after 70 terms is below π¹⁴⁰/140! < 2⁻⁵⁰⁰.
    let (mut term, mut term_error) = (one.clone(), BigInt::zero());
    let (mut sum, mut error) = (one.clone(), BigInt::one());
    for k in 1..70u32 {
        let divisor = BigInt::from((2 * k - 1) * (2 * k));
        // |term · square − their exact product| ≤ |term| δ + ε (|square| + δ).
        let product_error = &term * &square_error + &term_error * (&square + &square_error);
        // All are positive: one quotient rounded down after the other is that of both.
        term = ((&term * &square) >> 400u32) / &divisor;
        term_error = (product_error >> 400u32) / &divisor + 2;
        if k % 2 == 1 {
            sum -= &term;
        } else {
            sum += &term;
        }
        error += &term_error;
    }
    Ball {
        middle: Rational::from(sum).shifted(-400),
        radius: Rational::from(error).shifted(-400),
    }
}

/// π by Machin's formula: 16 arctan(1/5) − 4 arctan(1/239).
fn pi() -> Ball {
    // In units of 2⁻⁴⁰⁰. Each quotient is rounded down by less than one; what is left out is below
    // the last term, which is zero.
    let one = BigInt::one() << 400u32;
    let mut errors = 0u32;
    let mut arctan = |x: u32| {
        let mut power = &one / x;
        let (mut sum, mut k) = (BigInt::zero(), 0u32);
        while !power.is_zero() {
            let term = &power / (2 * k + 1);
            if k % 2 == 0 {
                sum += term
            } else {
                sum -= term
            }
            power /= x * x;
            k += 1;
            errors += 3;
        }
        sum
    };
    let middle = arctan(5) * 16 - arctan(239) * 4;
    Ball {
        middle: Rational::new(middle, one.clone()),
        // Every error at most 16-fold, and the end of both series.
        radius: Rational::new(BigInt::from(16 * (errors + 2)), one),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::exact;

    /// What vanishes in the end vanishes exactly.
    #[test]
    fn a_number_less_itself_is_zero() {
        let root = &Real::whole(2).sqrt() + &(&Real::whole(1) / &Real::whole(3)).sqrt();
        assert!((&root - &root).is_zero() && (&-&root + &root).is_zero());
        assert!(!(&root - &Real::whole(3).sqrt()).is_zero());
        assert!(!(&-&root - &root).is_zero());
        // Two numbers in the same range need not be the same, nor what is made of them.
        let range = || Real::within(crate::interval::hull(1.0, 2.0));
        assert!(!(&range() - &range()).is_zero());
        let sum = &range() + &root;
        assert!(!(&sum - &sum.clone()).is_zero() && sum != sum.clone());
    }

    #[test]
    fn roots_are_enclosed() {
        for x in [2.0, 1e-30, 1e30, 0.25, 1.0 + f64::EPSILON] {
            let root = root(&exact(x));
            let (lo, hi) = (&root.middle - &root.radius, &root.middle + &root.radius);
            assert!(&lo * &lo <= exact(x) && exact(x) <= &hi * &hi);
            assert!(root.radius * exact(2f64.powi(200)) < root.middle);
        }
    }

    #[test]
    fn a_rounded_ball_holds_the_one_before() {
        let ratio = |above: i64, below: i64| Rational::new(above.into(), below.into());
        let tiny = exact(2f64.powi(-400));
        for middle in [
            ratio(1, 3),
            ratio(-22, 7),
            ratio(5, 8),
            ratio(0, 1),
            ratio(1 << 60, 3) * exact(2f64.powi(900)),
            ratio(1, 7) * exact(2f64.powi(-900)),
        ] {
            for radius in [tiny.clone(), ratio(1, 3), ratio(1, 1 << 40)] {
                let ball = Ball {
                    middle: middle.clone(),
                    radius: radius.clone(),
                };
                let ball = ball.rounded();
                let moved = (&ball.middle - &middle).abs();
                assert!(&moved + &radius <= ball.radius);
                let most = (&middle * exact(2f64.powi(-319))).abs();
                assert!(moved <= most);
                // By few digits more; about zero by a number that is tiny.
                let more = most + exact(2f64.powi(-380));
                assert!(ball.radius <= (radius + more) * exact(1.0 + 1e-9));
            }
        }
    }

    #[test]
    fn pi_is_enclosed() {
        let pi = pi();
        // 40 digits, cut off.
        let digits: BigInt = "31415926535897932384626433832795028841971".parse().unwrap();
        let unit = BigInt::from(10).pow(40);
        assert!(Rational::new(digits.clone(), unit.clone()) < &pi.middle - &pi.radius);
        assert!(&pi.middle + &pi.radius < Rational::new(digits + 1, unit));
    }

    #[test]
    fn cosines_are_enclosed_and_tight() {
        for degrees in [
            0.5, 1.0, 30.0, 45.0, 72.0, 89.5, 150.0, 179.0, -30.0, 390.0, 1000.25,
        ] {
            let ball = Real::cosine_of_degrees(exact(degrees)).ball();
            let near = degrees.to_radians().cos();
            assert!((ball.middle.to_f64() - near).abs() < 1e-13, "{degrees}");
            assert!(ball.radius < exact(2f64.powi(-240)));
        }
        // cos 30° squared is 3/4, cos 45° squared 1/2, and cos 72° is (√5 − 1)/4.
        let square = |degrees: i64| {
            let c = Real::cosine_of_degrees(Rational::from_integer(degrees.into()));
            &c * &c
        };
        let holds = |ball: Ball, value: Rational| (ball.middle - value).abs() <= ball.radius;
        assert!(holds(square(30).ball(), exact(0.75)));
        assert!(holds(square(45).ball(), exact(0.5)));
        let golden = &(&Real::whole(5).sqrt() - &Real::whole(1)) / &Real::whole(4);
        let off = &Real::cosine_of_degrees(Rational::from_integer(72.into())) - &golden;
        assert!(holds(off.ball(), Rational::zero()));
        // The addition theorem at 17.3° and 41.9°.
        let [a, b] = [173, 419].map(|tenths| Rational::new(tenths.into(), 10.into()));
        let (cos, sin) = (Real::cosine_of_degrees, Real::sine_of_degrees);
        let product = &(&cos(a.clone()) * &cos(b.clone())) - &(&sin(a.clone()) * &sin(b.clone()));
        assert!(holds((&product - &cos(a + b)).ball(), Rational::zero()));
    }

    #[test]
    fn every_view_holds_the_number() {
        let x = &(&Real::whole(2).sqrt() / &Real::whole(3)) - &Real::whole(7).sqrt();
        let ball = x.ball();
        let inside = |low: f64, high: f64| {
            exact(low) <= &ball.middle - &ball.radius && &ball.middle + &ball.radius <= exact(high)
        };
        let interval = x.enclose();
        assert!(inside(interval.inf(), interval.sup()) && interval.wid() < 1e-15);
        let (near, radius) = x.double();
        let off = (exact(near.hi) + exact(near.lo) - &ball.middle).abs() + &ball.radius;
        assert!(off <= exact(radius) && radius < 1e-30);
    }
}
