//! Polynomials in exact arithmetic, and their real roots by Sturm's theorem.

use krawl::rational::Rational;
use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// Coefficients, the constant first.
#[derive(Debug, Clone, PartialEq)]
pub struct Polynomial(pub Vec<Rational>);

/// A power of two.
pub fn two_to(exponent: i32) -> Rational {
    let power = Rational::from(BigInt::one() << exponent.unsigned_abs());
    if exponent < 0 { power.recip() } else { power }
}

/// √x, from below, to so many binary digits behind the point.
pub fn root_to(bits: i32, x: &Rational) -> Rational {
    let scaled = (x * two_to(2 * bits)).floor().to_integer();
    Rational::from(scaled.sqrt()) * two_to(-bits)
}

/// √x, from below, to 250 binary digits behind the point.
pub fn root(x: &Rational) -> Rational {
    root_to(250, x)
}

impl Polynomial {
    pub fn constant(x: Rational) -> Self {
        Polynomial(vec![x]).trimmed()
    }

    fn trimmed(mut self) -> Self {
        while self.0.last().is_some_and(Rational::is_zero) {
            self.0.pop();
        }
        self
    }

    pub fn plus(&self, other: &Self) -> Self {
        let zero = Rational::zero();
        let at = |p: &Self, k: usize| p.0.get(k).unwrap_or(&zero).clone();
        let terms = self.0.len().max(other.0.len());
        Polynomial((0..terms).map(|k| at(self, k) + at(other, k)).collect()).trimmed()
    }

    pub fn scaled(&self, factor: &Rational) -> Self {
        Polynomial(self.0.iter().map(|c| c * factor).collect()).trimmed()
    }

    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.scaled(&-Rational::one()))
    }

    pub fn times(&self, other: &Self) -> Self {
        let mut out = vec![Rational::zero(); self.0.len() + other.0.len()];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                out[i + j] += a * b;
            }
        }
        Polynomial(out).trimmed()
    }

    pub fn value(&self, x: &Rational) -> Rational {
        let zero = Rational::zero();
        self.0.iter().rev().fold(zero, |sum, c| sum * x + c)
    }

    pub fn derivative(&self) -> Self {
        let terms = self.0.iter().enumerate().skip(1);
        Polynomial(
            terms
                .map(|(k, c)| c * Rational::from_integer(k.into()))
                .collect(),
        )
    }

    /// A bound on the size of all roots (Cauchy), a power of two.
    fn bound(&self) -> Rational {
        let leading = self.0.last().expect("not the zero polynomial");
        let largest = self.0.iter().map(|c| (c / leading).abs()).max();
        let wanted = largest.expect("a coefficient") + Rational::one();
        let mut bound = Rational::one();
        while bound <= wanted {
            bound *= Rational::from_integer(2.into());
        }
        bound
    }
}

/// m / 2^e.
#[derive(Debug, Clone)]
struct Dyadic(BigInt, u32);

/// Whole coefficients, in the same proportions.
fn whole(p: &Polynomial) -> Vec<BigInt> {
    let one = Rational::one();
    let common = p.0.iter().fold(one, |common, c| {
        let rest = Rational::from((c * &common).denom().clone());
        common * rest
    });
    p.0.iter().map(|c| (c * &common).to_integer()).collect()
}

/// The sign of a polynomial, from Σ c_k m^k 2^(e (n − k)).
fn sign(p: &[BigInt], x: &Dyadic) -> Sign {
    let mut sum = BigInt::zero();
    for (j, c) in p.iter().rev().enumerate() {
        sum = sum * &x.0 + (c << (x.1 as usize * j));
    }
    sum.sign()
}

/// The same without a common factor.
fn reduced(p: Vec<BigInt>) -> Vec<BigInt> {
    // Most often the first two coefficients have no other.
    let common = p.iter().fold(BigInt::zero(), |common, c| {
        let is_none = common.is_zero();
        common.gcd(&if is_none { c.clone() } else { c % &common })
    });
    p.iter().map(|c| c / &common).collect()
}

/// What a division leaves, turned round, times a positive number.
fn turned_rest(p: &[BigInt], divisor: &[BigInt]) -> Vec<BigInt> {
    let (leading, others) = divisor.split_last().expect("not the zero polynomial");
    let mut rest = p.to_vec();
    while rest.len() >= divisor.len()
        && let Some(top) = rest.pop()
    {
        let (factor, shift) = (top * leading.signum(), rest.len() - others.len());
        rest.iter_mut().for_each(|c| *c *= leading.abs());
        for (c, other) in rest[shift..].iter_mut().zip(others) {
            *c -= &factor * other;
        }
    }
    while rest.last().is_some_and(BigInt::is_zero) {
        rest.pop();
    }
    rest.into_iter().map(|c| -c).collect()
}

/// Sturm's sequence of a polynomial, each with whole coefficients in the right proportions. The last is the common factor
/// of the polynomial and its derivative, which has the multiple roots.
struct Sturm(Vec<Vec<BigInt>>);

impl Sturm {
    fn new(p: Vec<BigInt>) -> Self {
        let slopes = p.iter().enumerate().skip(1);
        let derivative = slopes.map(|(k, c)| c * BigInt::from(k)).collect();
        let mut sequence = vec![reduced(p), reduced(derivative)];
        loop {
            let k = sequence.len();
            let rest = turned_rest(&sequence[k - 2], &sequence[k - 1]);
            if rest.is_empty() {
                return Sturm(sequence);
            }
            sequence.push(reduced(rest));
        }
    }

    fn multiple(&self) -> &Vec<BigInt> {
        &self.0[self.0.len() - 1]
    }

    fn changes(&self, x: &Dyadic) -> usize {
        let signs = self.0.iter().map(|q| sign(q, x));
        let signs: Vec<Sign> = signs.filter(|s| *s != Sign::NoSign).collect();
        signs.windows(2).filter(|w| w[0] != w[1]).count()
    }

    /// The number of different roots in (a, b].
    fn roots(&self, a: &Dyadic, b: &Dyadic) -> usize {
        self.changes(a) - self.changes(b)
    }
}

/// A root, and whether it is a simple one.
#[derive(Debug, Clone, PartialEq)]
pub struct Root {
    pub at: Rational,
    pub simple: bool,
}

/// The least root above 0, to 2⁻¹⁶⁰ times a bound on all roots.
pub fn first_positive(p: &Polynomial) -> Option<Root> {
    if p.0.len() < 2 {
        return None;
    }
    let sturm = Sturm::new(whole(p));
    let (mut lo, mut hi) = (Dyadic(BigInt::zero(), 0), Dyadic(p.bound().to_integer(), 0));
    if sturm.roots(&lo, &hi) == 0 {
        return None;
    }
    let has_multiple = sturm.multiple().len() > 1;
    let mut alone = false;
    for _ in 0..160 {
        let middle = Dyadic((&lo.0 << (hi.1 - lo.1)) + &hi.0, hi.1 + 1);
        // Once a simple root is alone a change of sign tells where it is.
        let below = if alone {
            sign(&sturm.0[0], &middle) != sign(&sturm.0[0], &lo)
        } else {
            sturm.roots(&lo, &middle) > 0
        };
        if below {
            lo = Dyadic(&lo.0 << (middle.1 - lo.1), middle.1);
            hi = middle;
        } else {
            hi = Dyadic(&hi.0 << 1, middle.1);
            lo = middle;
        }
        alone = alone
            || !has_multiple
                && sign(&sturm.0[0], &lo) != Sign::NoSign
                && sturm.roots(&lo, &hi) == 1;
    }
    let simple = !has_multiple || Sturm::new(sturm.multiple().clone()).roots(&lo, &hi) == 0;
    let at = Rational::from(hi.0) * two_to(-(hi.1 as i32));
    Some(Root { at, simple })
}

/// The largest root below 0.
pub fn first_negative(p: &Polynomial) -> Option<Root> {
    let turned = p.0.iter().enumerate();
    let turned = Polynomial(
        turned
            .map(|(k, c)| if k % 2 == 1 { -c } else { c.clone() })
            .collect(),
    );
    first_positive(&turned).map(|root| Root {
        at: -root.at,
        ..root
    })
}
