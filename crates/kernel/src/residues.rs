//! Residues modulo a prime.

use crate::elimination::Field;
use crate::equations::Ring;
use crate::random::Random;
use std::ops::{Add, Div, Mul, Sub};

/// The Mersenne prime 2⁶¹ − 1.
const PRIME: u64 = (1 << 61) - 1;

/// A residue modulo a prime below 2⁶³.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Residue<const P: u64 = PRIME>(u64);

impl<const P: u64> Add for Residue<P> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        Residue(if sum >= P { sum - P } else { sum })
    }
}

impl<const P: u64> Sub for Residue<P> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + Residue(P - other.0)
    }
}

impl<const P: u64> Mul for Residue<P> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = u128::from(self.0) * u128::from(other.0);
        match P {
            // 2⁶¹ ≡ 1, so the product's upper bits are added to its lower ones.
            PRIME => Residue((product as u64) & PRIME) + Residue((product >> 61) as u64),
            _ => Residue((product % u128::from(P)) as u64),
        }
    }
}

impl<const P: u64> Div for Residue<P> {
    type Output = Self;
    /// By Fermat's little theorem: the divisor must not be 0.
    fn div(self, mut power: Self) -> Self {
        let (mut result, mut exponent) = (self, P - 2);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = result * power;
            }
            power = power * power;
            exponent >>= 1;
        }
        result
    }
}

impl<const P: u64> Ring for Residue<P> {
    fn whole(number: i32) -> Self {
        Residue(i64::from(number).rem_euclid(P as i64) as u64)
    }
}

impl<const P: u64> Field for Residue<P> {
    fn size(&self) -> f64 {
        self.0 as f64
    }
}

/// Residues that look random and are the same in every run.
pub struct Residues(Random);

impl Residues {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Residues(Random::new(seed))
    }

    /// The next residue, never 0.
    pub fn draw(&mut self) -> Residue {
        Residue(1 + self.0.bits() % (PRIME - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_a_field() {
        let mut residues = Residues::new(1);
        for _ in 0..100 {
            let (a, b) = (residues.draw(), residues.draw());
            assert_eq!(a / b * b, a);
            assert_eq!(a - b + b, a);
            let exact = u128::from(a.0) * u128::from(b.0) % u128::from(PRIME);
            assert_eq!(u128::from((a * b).0), exact);
        }
        assert_eq!(Residue(PRIME - 1) * Residue(PRIME - 1), Residue::<PRIME>(1));
        assert_eq!(Residue::<7>(3) / Residue(5), Residue(2));
    }
}
