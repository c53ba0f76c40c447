//! Complex numbers that are exact, and random ones.

use crate::equations::ring;
use crate::interval::Real;
use crate::rational::Rational;
use num_bigint::BigInt;

/// A complex number whose parts are ratios.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exact {
    /// The real part.
    pub re: Rational,
    /// The imaginary part.
    pub im: Rational,
}

ring!(Exact, Exact::whole);

impl Exact {
    /// Zero.
    pub fn zero() -> Self {
        Exact::real(Rational::zero())
    }

    /// A whole number.
    pub fn whole(value: i64) -> Self {
        Exact::real(Rational::from_integer(BigInt::from(value)))
    }

    /// A real number.
    pub fn real(re: Rational) -> Self {
        let im = Rational::zero();
        Exact { re, im }
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero()
    }

    /// The sum.
    pub fn plus(&self, other: &Self) -> Self {
        Exact {
            re: &self.re + &other.re,
            im: &self.im + &other.im,
        }
    }

    /// The difference.
    pub fn minus(&self, other: &Self) -> Self {
        Exact {
            re: &self.re - &other.re,
            im: &self.im - &other.im,
        }
    }

    /// The product.
    pub fn times(&self, other: &Self) -> Self {
        Exact {
            re: &self.re * &other.re - &self.im * &other.im,
            im: &self.re * &other.im + &self.im * &other.re,
        }
    }

    /// The quotient; `None` where the other is zero.
    pub fn over(&self, other: &Self) -> Option<Self> {
        let size = &other.re * &other.re + &other.im * &other.im;
        if size.is_zero() {
            return None;
        }
        let conjugate = Exact {
            re: other.re.clone(),
            im: -&other.im,
        };
        let above = self.times(&conjugate);
        Some(Exact {
            re: above.re / &size,
            im: above.im / &size,
        })
    }

    /// Bits of the longest number in it.
    pub fn bits(&self) -> u64 {
        let parts = [&self.re, &self.im];
        let numbers = parts.into_iter().flat_map(|x| [x.numer(), x.denom()]);
        numbers.map(BigInt::bits).max().unwrap_or(0)
    }

    /// Itself, or where that is a long ratio the nearest number whose parts are multiples of 2⁻¹⁰⁰.
    pub fn shortened(self) -> Self {
        if self.bits() <= SHORT {
            return self;
        }
        let scale = Rational::from_integer(BigInt::from(1u128 << 100));
        let round = |x: Rational| (x * &scale).round() / &scale;
        Exact {
            re: round(self.re),
            im: round(self.im),
        }
    }

    /// The parts as exact reals.
    pub fn parts(&self) -> Parameter {
        [self.re.clone().into(), self.im.clone().into()]
    }
}

/// Numbers of so many bits are short.
const SHORT: u64 = 256;

/// The right-hand side of a complex equation: real part, imaginary part.
pub type Parameter = [Real; 2];

/// A parameter that is zero.
pub fn zero() -> Parameter {
    [Real::zero(), Real::zero()]
}

/// Complex numbers that look random and are the same everywhere.
#[derive(Debug, Clone)]
pub struct Random(crate::random::Random);

/// Random numbers are whole multiples of 2 to minus this.
const BITS: u32 = 10;

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Random(crate::random::Random::new(seed))
    }

    /// 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0.bits()
    }

    /// Between −1 and 1.
    fn ratio(&mut self) -> Rational {
        let range = 1u64 << (BITS + 1);
        let drawn = (self.bits() % (range + 1)) as i64 - (1 << BITS);
        Rational::new(drawn.into(), BigInt::from(1u64 << BITS))
    }

    /// A complex number, both parts between −1 and 1.
    pub fn complex(&mut self) -> Exact {
        Exact {
            re: self.ratio(),
            im: self.ratio(),
        }
    }

    /// A complex number like [`Random::complex`] with an absolute value of at least ½.
    pub fn apart_from_zero(&mut self) -> Exact {
        let quarter = Rational::new(1.into(), 4.into());
        loop {
            let drawn = self.complex();
            if &drawn.re * &drawn.re + &drawn.im * &drawn.im >= quarter {
                return drawn;
            }
        }
    }

    /// A real number between −¼ and ¼.
    pub fn nearly_whole(&mut self) -> Exact {
        Exact::real(self.ratio() / Rational::from_integer(4.into()))
    }

    /// A complex number like [`Random::complex`] with an imaginary part between −½ and ½: squares of such numbers are seldom near zero.
    pub fn nearly_real(&mut self) -> Exact {
        let Exact { re, im } = self.complex();
        Exact {
            re,
            im: im / Rational::from_integer(2.into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_is_that_of_complex_numbers() {
        let mut random = Random::new(3);
        for _ in 0..50 {
            let (a, b) = (random.complex(), random.complex());
            if b.is_zero() {
                continue;
            }
            assert_eq!(a.times(&b).over(&b).unwrap(), a);
            assert_eq!(a.plus(&b).minus(&b), a);
        }
        let i = Exact {
            re: Rational::zero(),
            im: Rational::from_integer(1.into()),
        };
        assert_eq!(i.times(&i), Exact::whole(-1));
        assert!(i.over(&Exact::zero()).is_none());
    }
}
