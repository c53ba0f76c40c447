//! Numbers that look random and are the same everywhere.

use crate::places::array;

/// A sequence of a seed (Steele, Lea, Flood, *Fast splittable pseudorandom number generators*,
/// 2014).
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Between −1 and 1.
    pub fn symmetric(&mut self) -> f64 {
        // 53 bits, exactly.
        (self.bits() >> 11) as f64 * 2f64.powi(-52) - 1.0
    }

    /// Three of them, or two and zero in the plane.
    pub fn jitter(&mut self, dimension: usize, size: f64) -> [f64; 3] {
        array(|axis| {
            if axis < dimension {
                size * self.symmetric()
            } else {
                0.0
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fills_the_range() {
        let mut random = Random::new(7);
        let drawn: Vec<f64> = (0..10_000).map(|_| random.symmetric()).collect();
        assert!(drawn.iter().all(|x| (-1.0..1.0).contains(x)));
        let mean = drawn.iter().sum::<f64>() / 1e4;
        let square = drawn.iter().map(|x| x * x).sum::<f64>() / 1e4;
        assert!(mean.abs() < 0.03 && (square - 1.0 / 3.0).abs() < 0.02);
    }
}
