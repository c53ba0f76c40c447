//! Exact ratios of whole numbers.
//!
//! A ratio is always in lowest terms. The floats and decimals that ratios come from here have powers of 2 and 5 below the line, and the greatest common
//! divisor of a power of 2 and an odd number is what binary algorithms are slowest at: they take away one bit after the other of a number
//! of thousands. So twos are shifted away, and what is above the line is divided by what is left below it first.

use crate::equations::Ring;
use num_bigint::{BigInt, BigUint, Sign};
use num_integer::Integer;
use num_rational::Ratio;
use num_traits::float::FloatCore;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;
use std::fmt;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A ratio of two whole numbers, in lowest terms; the one below the line is positive.
///
/// ```
/// use krawl::rational::Rational;
/// let third = Rational::new(2.into(), 6.into());
/// assert_eq!(third.to_string(), "1/3");
/// assert_eq!(&third + &third, Rational::new(2.into(), 3.into()));
/// assert_eq!(Rational::from_float(0.5).unwrap() * &third, Rational::new(1.into(), 6.into()));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Rational {
    above: BigInt,
    below: BigInt,
}

/// The exponent of the power of 2 in a number; none in 0.
fn twos(x: &BigInt) -> u64 {
    x.trailing_zeros().unwrap_or(0)
}

/// The greatest common divisor of a number and an odd one.
fn common(x: &BigUint, odd: &BigUint) -> BigUint {
    let rest = x % odd;
    match (rest.to_u64(), odd.to_u64()) {
        (Some(0), _) => odd.clone(),
        (Some(rest), Some(odd)) => rest.gcd(&odd).into(),
        _ => rest.gcd(odd),
    }
}

/// The ratio of two numbers, the second of which is positive.
fn lowest(mut above: BigInt, mut below: BigInt) -> Rational {
    if above.is_zero() {
        return Rational::zero();
    }
    if let (Some(size), Some(under)) = (above.magnitude().to_u64(), below.to_u64()) {
        let common = size.gcd(&under);
        return Rational {
            above: BigInt::from(size / common) * above.signum(),
            below: (under / common).into(),
        };
    }
    let both = twos(&above).min(twos(&below));
    if both > 0 {
        above >>= both;
        below >>= both;
    }
    let even = twos(&below);
    if below.bits() > even + 1 {
        let odd = below.magnitude() >> even;
        let common = common(above.magnitude(), &odd);
        if !common.is_one() {
            let common = BigInt::from(common);
            above /= &common;
            below /= common;
        }
    }
    Rational { above, below }
}

/// By what the numbers above the line are multiplied where two ratios are brought to one number below it: that of the other one, without the twos that both have.
fn apart(a: &Rational, b: &Rational) -> (BigInt, BigInt) {
    let both = twos(&a.below).min(twos(&b.below));
    (&b.below >> both, &a.below >> both)
}

impl Rational {
    /// The ratio of two numbers, the second of which is not 0.
    pub fn new(above: BigInt, below: BigInt) -> Self {
        assert!(!below.is_zero(), "a division by zero");
        match below.is_negative() {
            true => lowest(-above, -below),
            false => lowest(above, below),
        }
    }

    /// A whole number.
    pub fn from_integer(above: BigInt) -> Self {
        let below = BigInt::one();
        Rational { above, below }
    }

    /// The number that a float is, unless it is infinite or no number.
    pub fn from_float(x: f64) -> Option<Self> {
        if !x.is_finite() {
            return None;
        }
        let (mantissa, exponent, sign) = FloatCore::integer_decode(x);
        let whole = Rational::from_integer(BigInt::from(mantissa) * sign);
        Some(whole.shifted(exponent.into()))
    }

    /// 0.
    pub fn zero() -> Self {
        Rational::from_integer(BigInt::ZERO)
    }

    /// 1.
    pub fn one() -> Self {
        Rational::from_integer(BigInt::one())
    }

    /// What is above the line, with the sign.
    pub fn numer(&self) -> &BigInt {
        &self.above
    }

    /// What is below the line: positive.
    pub fn denom(&self) -> &BigInt {
        &self.below
    }

    /// The positive number by which all of these are multiplied to be whole numbers without a common factor; 1 if all are 0.
    pub fn to_coprime<'a>(numbers: impl Iterator<Item = &'a Rational> + Clone) -> Self {
        let below = numbers
            .clone()
            .fold(BigInt::one(), |all, x| all.lcm(&x.below));
        let above = numbers.map(|x| &x.above * (&below / &x.below));
        let above = above.fold(BigInt::ZERO, |all, x| all.gcd(&x));
        match above.is_zero() {
            true => Rational::one(),
            false => Rational::new(below, above),
        }
    }

    /// Whether it is 0.
    pub fn is_zero(&self) -> bool {
        self.above.is_zero()
    }

    /// Whether it is 1.
    pub fn is_one(&self) -> bool {
        self.above.is_one() && self.is_integer()
    }

    /// Whether it is a whole number.
    pub fn is_integer(&self) -> bool {
        self.below.is_one()
    }

    /// Whether it is above 0.
    pub fn is_positive(&self) -> bool {
        self.above.sign() == Sign::Plus
    }

    /// Whether it is below 0.
    pub fn is_negative(&self) -> bool {
        self.above.sign() == Sign::Minus
    }

    /// Without its sign.
    pub fn abs(&self) -> Self {
        Rational {
            above: self.above.abs(),
            below: self.below.clone(),
        }
    }

    /// 1, −1 or 0, whichever has its sign.
    pub fn signum(&self) -> Self {
        Rational::from_integer(self.above.signum())
    }

    /// One over it: it is not 0.
    pub fn recip(&self) -> Self {
        assert!(!self.is_zero(), "a division by zero");
        let (below, sign) = (self.above.abs(), self.above.signum());
        let above = &self.below * sign;
        Rational { above, below }
    }

    /// A power of it, for a negative exponent of one over it.
    pub fn pow(&self, exponent: i32) -> Self {
        let to = |x: &BigInt| x.pow(exponent.unsigned_abs());
        let power = Rational {
            above: to(&self.above),
            below: to(&self.below),
        };
        match exponent < 0 {
            true => power.recip(),
            false => power,
        }
    }

    /// The root that is not negative, if that is a ratio.
    pub fn sqrt(&self) -> Option<Self> {
        let root = |x: &BigInt| Some(x.sqrt()).filter(|root| root * root == *x);
        let is_served = !self.is_negative();
        is_served.then(|| Some(Rational::new(root(&self.above)?, root(&self.below)?)))?
    }

    /// The largest whole number that is not above it.
    pub fn floor(&self) -> Self {
        Rational::from_integer(self.above.div_floor(&self.below))
    }

    /// The least whole number that is not below it.
    pub fn ceil(&self) -> Self {
        -(-self).floor()
    }

    /// The whole number that is nearest, of two the one farther from 0.
    pub fn round(&self) -> Self {
        let (two, whole) = (BigInt::from(2), self.above.abs());
        let nearest = (whole * &two + &self.below).div_floor(&(&self.below * two));
        Rational::from_integer(nearest * self.above.signum())
    }

    /// The whole number between it and 0 that is nearest.
    pub fn to_integer(&self) -> BigInt {
        &self.above / &self.below
    }

    /// The nearest float, infinite where it is beyond all floats.
    pub fn to_f64(&self) -> f64 {
        let exactly = |x: &BigInt| x.to_i64().filter(|x| x.unsigned_abs() <= 1 << 53);
        if let (Some(above), Some(below)) = (exactly(&self.above), exactly(&self.below)) {
            return above as f64 / below as f64;
        }
        let ratio = Ratio::new_raw(self.above.clone(), self.below.clone());
        ratio.to_f64().expect("every ratio has a nearest float")
    }

    /// It times 2 to this.
    pub fn shifted(&self, exponent: i64) -> Self {
        let power = exponent.unsigned_abs();
        let (above, below) = (&self.above, &self.below);
        // Of twos alone there can be too many.
        let (above, below) = match exponent >= 0 {
            true => {
                let common = twos(below).min(power);
                (above << (power - common), below >> common)
            }
            false if above.is_zero() => (BigInt::ZERO, BigInt::one()),
            false => {
                let common = twos(above).min(power);
                (above >> common, below << (power - common))
            }
        };
        Rational { above, below }
    }

    fn plus(&self, other: &Self) -> Self {
        if self.below == other.below {
            return lowest(&self.above + &other.above, self.below.clone());
        }
        let (own, others) = apart(self, other);
        let above = &self.above * &own + &other.above * others;
        lowest(above, &self.below * own)
    }

    fn times(&self, other: &Self) -> Self {
        lowest(&self.above * &other.above, &self.below * &other.below)
    }

    fn over(&self, other: &Self) -> Self {
        Rational::new(&self.above * &other.below, &self.below * &other.above)
    }
}

/// The number that a finite float is.
///
/// # Panics
/// If it is infinite or no number.
#[doc(hidden)]
pub fn exact(x: f64) -> Rational {
    Rational::from_float(x).expect("a finite float")
}

impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_sign = self.above.sign().cmp(&other.above.sign());
        by_sign.then_with(|| match self.below == other.below {
            true => self.above.cmp(&other.above),
            false => {
                let (own, others) = apart(self, other);
                (&self.above * own).cmp(&(&other.above * others))
            }
        })
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Default for Rational {
    fn default() -> Self {
        Rational::zero()
    }
}

impl From<BigInt> for Rational {
    fn from(x: BigInt) -> Self {
        Rational::from_integer(x)
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.is_integer() {
            true => self.above.fmt(f),
            false => write!(f, "{}/{}", self.above, self.below),
        }
    }
}

impl Neg for Rational {
    type Output = Rational;
    fn neg(mut self) -> Rational {
        self.above = -self.above;
        self
    }
}

impl Neg for &Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        -self.clone()
    }
}

/// An operation for values and references, and in place.
macro_rules! operation {
    ($trait:ident, $method:ident, $in_place:ident, $assign:ident, |$a:ident, $b:ident| $result:expr) => {
        impl $trait<&Rational> for &Rational {
            type Output = Rational;
            fn $method(self, other: &Rational) -> Rational {
                let ($a, $b) = (self, other);
                $result
            }
        }
        impl $trait<Rational> for &Rational {
            type Output = Rational;
            fn $method(self, other: Rational) -> Rational {
                self.$method(&other)
            }
        }
        impl $trait<&Rational> for Rational {
            type Output = Rational;
            fn $method(self, other: &Rational) -> Rational {
                (&self).$method(other)
            }
        }
        impl $trait<Rational> for Rational {
            type Output = Rational;
            fn $method(self, other: Rational) -> Rational {
                (&self).$method(&other)
            }
        }
        impl $in_place<&Rational> for Rational {
            fn $assign(&mut self, other: &Rational) {
                *self = (&*self).$method(other);
            }
        }
        impl $in_place<Rational> for Rational {
            fn $assign(&mut self, other: Rational) {
                *self = (&*self).$method(&other);
            }
        }
    };
}

operation!(Add, add, AddAssign, add_assign, |a, b| a.plus(b));
operation!(Sub, sub, SubAssign, sub_assign, |a, b| a.plus(&-b));
operation!(Mul, mul, MulAssign, mul_assign, |a, b| a.times(b));
operation!(Div, div, DivAssign, div_assign, |a, b| a.over(b));

impl<'a> Sum<&'a Rational> for Rational {
    fn sum<I: Iterator<Item = &'a Rational>>(all: I) -> Self {
        all.fold(Rational::zero(), |sum, x| sum + x)
    }
}

impl Sum for Rational {
    fn sum<I: Iterator<Item = Rational>>(all: I) -> Self {
        all.fold(Rational::zero(), |sum, x| sum + x)
    }
}

impl Ring for Rational {
    fn whole(number: i32) -> Self {
        Rational::from_integer(number.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use proptest::prelude::*;

    /// Ratios that floats, decimals and quotients of such are.
    fn ratios() -> impl Strategy<Value = Rational> {
        let whole = prop_oneof![-9i64..10, any::<i64>()];
        (whole, 1i64.., 0..3, -200i64..200).prop_map(|(above, below, kind, power)| {
            let below = match kind {
                0 => 1.into(),
                1 => BigInt::from(10).pow((below % 40) as u32),
                _ => below.into(),
            };
            Rational::new(above.into(), below).shifted(power)
        })
    }

    fn other(x: &Rational) -> BigRational {
        BigRational::new(x.numer().clone(), x.denom().clone())
    }

    /// In lowest terms, and the number that another implementation finds.
    fn same(x: &Rational, y: &BigRational) -> bool {
        (x.numer(), x.denom()) == (y.numer(), y.denom())
    }

    proptest! {
        #[test]
        fn ratios_are_those_of_another_implementation(above: i64, below: i64, ten in 0u32..40, power in -200i32..200) {
            prop_assume!(below != 0);
            let (above, below) = (BigInt::from(above), BigInt::from(below) * BigInt::from(10).pow(ten));
            let ratio = Rational::new(above.clone(), below.clone());
            let wanted = BigRational::new(above.clone(), below);
            prop_assert!(same(&ratio, &wanted));
            let two = BigRational::from_integer(2.into());
            prop_assert!(same(&ratio.shifted(power.into()), &(wanted * two.pow(power))));
            prop_assert!(same(&above.clone().into(), &BigRational::from_integer(above)));
        }

        #[test]
        fn operations_are_those_of_another_implementation(a in ratios(), b in ratios(), alike: bool) {
            // Those with the same number below the line are treated by themselves.
            let b = if alike { &a + Rational::from_integer(b.numer().clone()) } else { b };
            let (c, d) = (other(&a), other(&b));
            prop_assert!(same(&(&a + &b), &(&c + &d)));
            prop_assert!(same(&(&a - &b), &(&c - &d)));
            prop_assert!(same(&(&a * &b), &(&c * &d)));
            if !b.is_zero() {
                prop_assert!(same(&(&a / &b), &(&c / &d)));
                prop_assert!(same(&b.pow(-3), &d.pow(-3)));
            }
            prop_assert!(same(&a.pow(3), &c.pow(3)));
            prop_assert_eq!(a.cmp(&b), c.cmp(&d));
            prop_assert_eq!(a.cmp(&a.clone()), Ordering::Equal);
            prop_assert_eq!(a.is_negative(), c.is_negative());
            prop_assert_eq!(a.is_positive(), c.is_positive());
            prop_assert!(same(&a.abs(), &c.abs()) && same(&a.signum(), &c.signum()));
            for (own, others) in [
                (a.floor(), c.floor()),
                (a.ceil(), c.ceil()),
                (a.round(), c.round()),
                (a.to_integer().into(), c.to_integer().into()),
            ] {
                prop_assert!(same(&own, &others), "{a}: {own}, {others}");
            }
            prop_assert_eq!(a.to_string(), c.to_string());
            prop_assert_eq!(Some(a.to_f64()), c.to_f64());
        }

        #[test]
        fn floats_come_back(bits in any::<u64>()) {
            let x = f64::from_bits(bits);
            match Rational::from_float(x) {
                None => prop_assert!(!x.is_finite()),
                Some(ratio) => {
                    prop_assert_eq!(ratio.to_f64(), x);
                    prop_assert!(same(&ratio, &BigRational::from_float(x).unwrap()));
                }
            }
        }
    }

    #[test]
    fn roots_are_those_of_squares_of_ratios() {
        let ratio = |above: i64, below: i64| Rational::new(above.into(), below.into());
        assert_eq!(ratio(49, 100).sqrt(), Some(ratio(7, 10)));
        assert_eq!(ratio(0, 1).sqrt(), Some(ratio(0, 1)));
        assert_eq!(ratio(1, 2).sqrt(), None);
        assert_eq!(ratio(-1, 4).sqrt(), None);
    }

    #[test]
    fn what_is_beyond_floats_is_infinite() {
        assert_eq!(Rational::one().shifted(2000).to_f64(), f64::INFINITY);
        assert_eq!((-Rational::one()).shifted(2000).to_f64(), f64::NEG_INFINITY);
        assert_eq!(Rational::one().shifted(-2000).to_f64(), 0.0);
    }
}
