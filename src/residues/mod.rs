//! Arithmetic and elimination modulo the prime 2⁶¹ − 1.

mod echelon;

pub use echelon::Echelon;

use crate::random::Random;

/// The Mersenne prime 2⁶¹ − 1.
pub const PRIME: u64 = (1 << 61) - 1;

/// a + b for residues.
pub fn add(a: u64, b: u64) -> u64 {
    let sum = a + b;
    if sum >= PRIME { sum - PRIME } else { sum }
}

/// a − b for residues.
pub fn sub(a: u64, b: u64) -> u64 {
    if a >= b { a - b } else { a + PRIME - b }
}

/// a b for residues.
pub fn mul(a: u64, b: u64) -> u64 {
    // 2⁶¹ ≡ 1, so the product's upper bits are added to its lower ones.
    let product = u128::from(a) * u128::from(b);
    add((product as u64) & PRIME, (product >> 61) as u64)
}

/// 1 / a for a residue other than 0, by Fermat's little theorem.
pub fn invert(a: u64) -> u64 {
    let (mut result, mut base, mut exponent) = (1, a, PRIME - 2);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = mul(result, base);
        }
        base = mul(base, base);
        exponent >>= 1;
    }
    result
}

/// Residues that look random and are the same in every run.
pub struct Residues(Random);

impl Residues {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Residues(Random::new(seed))
    }

    /// The next residue, never 0.
    pub fn next(&mut self) -> u64 {
        1 + self.0.bits() % (PRIME - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_a_field() {
        let mut residues = Residues::new(1);
        for _ in 0..100 {
            let (a, b) = (residues.next(), residues.next());
            assert_eq!(mul(a, invert(a)), 1);
            assert_eq!(add(sub(a, b), b), a);
            let exact = u128::from(a) * u128::from(b) % u128::from(PRIME);
            assert_eq!(u128::from(mul(a, b)), exact);
        }
        assert_eq!(mul(PRIME - 1, PRIME - 1), 1);
    }
}
