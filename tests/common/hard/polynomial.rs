//! Polynomials in exact arithmetic, and their real roots by Sturm's theorem.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// Coefficients, the constant first.
#[derive(Debug, Clone, PartialEq)]
pub struct Polynomial(pub Vec<BigRational>);

/// A power of two.
pub fn two_to(exponent: i32) -> BigRational {
    let power = BigRational::from(BigInt::one() << exponent.unsigned_abs());
    if exponent < 0 { power.recip() } else { power }
}

/// √x, from below, to 300 binary digits behind the point.
pub fn root(x: &BigRational) -> BigRational {
    let scaled = (x * two_to(600)).floor().to_integer();
    BigRational::from(scaled.sqrt()) * two_to(-300)
}

impl Polynomial {
    pub fn constant(x: BigRational) -> Self {
        Polynomial(vec![x]).trimmed()
    }

    fn trimmed(mut self) -> Self {
        while self.0.last().is_some_and(Zero::is_zero) {
            self.0.pop();
        }
        self
    }

    pub fn plus(&self, other: &Self) -> Self {
        let zero = BigRational::zero();
        let at = |p: &Self, k: usize| p.0.get(k).unwrap_or(&zero).clone();
        let terms = self.0.len().max(other.0.len());
        Polynomial((0..terms).map(|k| at(self, k) + at(other, k)).collect()).trimmed()
    }

    pub fn scaled(&self, factor: &BigRational) -> Self {
        Polynomial(self.0.iter().map(|c| c * factor).collect()).trimmed()
    }

    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.scaled(&-BigRational::one()))
    }

    pub fn times(&self, other: &Self) -> Self {
        let mut out = vec![BigRational::zero(); self.0.len() + other.0.len()];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                out[i + j] += a * b;
            }
        }
        Polynomial(out).trimmed()
    }

    pub fn value(&self, x: &BigRational) -> BigRational {
        let zero = BigRational::zero();
        self.0.iter().rev().fold(zero, |sum, c| sum * x + c)
    }

    pub fn derivative(&self) -> Self {
        let terms = self.0.iter().enumerate().skip(1);
        Polynomial(
            terms
                .map(|(k, c)| c * BigRational::from_integer(k.into()))
                .collect(),
        )
    }

    /// What a division leaves.
    fn rest(&self, divisor: &Self) -> Self {
        let mut rest = self.0.clone();
        let b = &divisor.0;
        while rest.len() >= b.len() {
            let factor = &rest[rest.len() - 1] / &b[b.len() - 1];
            let shift = rest.len() - b.len();
            for (k, c) in b.iter().enumerate() {
                rest[k + shift] = &rest[k + shift] - &factor * c;
            }
            rest.pop();
        }
        Polynomial(rest).trimmed()
    }

    /// Scaled to a leading coefficient ±1.
    fn normed(self) -> Self {
        match self.0.last().cloned() {
            Some(leading) => self.scaled(&leading.abs().recip()),
            None => self,
        }
    }

    /// A bound on the size of all roots (Cauchy), a power of two.
    fn bound(&self) -> BigRational {
        let leading = self.0.last().expect("not the zero polynomial");
        let largest = self.0.iter().map(|c| (c / leading).abs()).max();
        let wanted = largest.expect("a coefficient") + BigRational::one();
        let mut bound = BigRational::one();
        while bound <= wanted {
            bound *= BigRational::from_integer(2.into());
        }
        bound
    }
}

/// Sturm's sequence of a polynomial.
pub struct Sturm(Vec<Polynomial>);

impl Sturm {
    pub fn new(p: &Polynomial) -> Self {
        let mut sequence = vec![p.clone().normed(), p.derivative().normed()];
        while !sequence[sequence.len() - 1].0.is_empty() {
            let k = sequence.len();
            let rest = sequence[k - 2].rest(&sequence[k - 1]);
            sequence.push(rest.scaled(&-BigRational::one()).normed());
        }
        sequence.pop();
        Sturm(sequence)
    }

    fn changes(&self, x: &BigRational) -> usize {
        let values = self.0.iter().map(|q| q.value(x)).filter(|v| !v.is_zero());
        let signs: Vec<bool> = values.map(|v| v.is_positive()).collect();
        signs.windows(2).filter(|w| w[0] != w[1]).count()
    }

    /// The number of different roots in (a, b].
    pub fn roots(&self, a: &BigRational, b: &BigRational) -> usize {
        self.changes(a) - self.changes(b)
    }

    /// The common factor of the polynomial and its derivative, which has the multiple roots.
    fn multiple(&self) -> &Polynomial {
        &self.0[self.0.len() - 1]
    }
}

/// A root, and whether it is a simple one.
#[derive(Debug, Clone, PartialEq)]
pub struct Root {
    pub at: BigRational,
    pub simple: bool,
}

/// The least root above 0, to 260 binary digits beside the bound on all roots.
pub fn first_positive(p: &Polynomial) -> Option<Root> {
    if p.0.len() < 2 {
        return None;
    }
    let sturm = Sturm::new(p);
    let (mut lo, mut hi) = (BigRational::zero(), p.bound());
    if sturm.roots(&lo, &hi) == 0 {
        return None;
    }
    let half = BigRational::new(1.into(), 2.into());
    let multiple = Sturm::new(sturm.multiple());
    let mut alone = false;
    for _ in 0..260 {
        let middle = (&lo + &hi) * &half;
        // Once the root is alone a change of sign would do, but for those of even order.
        let below = if alone && !p.value(&hi).is_zero() && sturm.multiple().0.len() == 1 {
            p.value(&middle).is_positive() != p.value(&lo).is_positive()
                || p.value(&middle).is_zero()
        } else {
            sturm.roots(&lo, &middle) > 0
        };
        if below {
            hi = middle;
        } else {
            lo = middle;
        }
        alone = alone || sturm.roots(&lo, &hi) == 1 && !p.value(&lo).is_zero();
    }
    let simple = sturm.multiple().0.len() < 2 || multiple.roots(&lo, &hi) == 0;
    Some(Root { at: hi, simple })
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
