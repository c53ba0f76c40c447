//! What bounds the inverse of one diagonal block of A(s) X.

use crate::interval::rounding::round_up;
use crate::track::reduced::structure::layout::WIDEST;
use crate::track::reduced::structure::passes::{WideInverse, by_adjugate, invert_wide};

/// R is made larger by this factor than I + B R asks for: far above rounding where R is at most [`LARGEST`].
const MORE: f64 = 1e-9;
/// A larger R is of no use.
const LARGEST: f64 = 1e4;

/// R ≥ (I − B)⁻¹ for B ≥ 0 of the given size: R ≥ I + B R, verified. `None`: there is none, or it
/// is of no use.
pub fn bound_on_inverse(b: &[[f64; 3]; 3], size: usize) -> Option<[[f64; 3]; 3]> {
    // I − B, completed by the identity.
    let mut a = [[0.0; 3]; 3];
    for r in 0..3 {
        for c in 0..3 {
            let entry = if r < size && c < size { b[r][c] } else { 0.0 };
            a[r][c] = if r == c { 1.0 - entry } else { -entry };
        }
    }
    let mut bound = by_adjugate(&a);
    // A little more than the inverse: with x = (I − B)⁻¹ 1, x − B x = 1.
    for row in &mut bound {
        let sum: f64 = row.iter().sum();
        for entry in row {
            *entry += MORE * (*entry + sum);
        }
    }
    let mut holds = true;
    for r in 0..size {
        for c in 0..size {
            let one = if r == c { 1.0 } else { 0.0 };
            let sum: f64 = (0..size).map(|k| b[r][k] * bound[k][c]).sum();
            let x = bound[r][c];
            holds &= (0.0..LARGEST).contains(&x) && round_up(one + sum, 8) <= x;
        }
    }
    holds.then_some(bound)
}

/// The same for blocks of any size up to [`WIDEST`], into `bound`. False: there is none.
pub fn bound_on_wide_inverse(b: &WideInverse, size: usize, bound: &mut WideInverse) -> bool {
    let mut a = [[0.0; WIDEST]; WIDEST];
    for r in 0..size {
        for c in 0..size {
            a[r][c] = if r == c { 1.0 - b[r][c] } else { -b[r][c] };
        }
    }
    invert_wide(&a, size, bound);
    for row in &mut bound[..size] {
        let sum: f64 = row[..size].iter().sum();
        for entry in &mut row[..size] {
            *entry += MORE * (*entry + sum);
        }
    }
    let mut holds = true;
    for r in 0..size {
        // A row of I + B R, all of it at once: what is beyond the block is not looked at.
        let mut row = [0.0; WIDEST];
        row[r] = 1.0;
        for (b, bound) in b[r][..size].iter().zip(bound.iter()) {
            for (sum, x) in row.iter_mut().zip(bound) {
                *sum += b * x;
            }
        }
        for (sum, &x) in row.into_iter().zip(&bound[r]).take(size) {
            // At most WIDEST products, their sum, and the 1.
            holds &= (0.0..LARGEST).contains(&x) & (round_up(sum, WIDEST + 2) <= x);
        }
    }
    holds
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// (I − B)⁻¹ = I + B + B² + …, of which all terms are ≥ 0: a bound is no less than any sum of the first ones.
    #[test]
    fn bounds_are_no_less_than_neumann_s_sums_and_not_much_more() {
        let mut random = Random::new(17);
        let mut found = [0; WIDEST + 1];
        for round in 0..3000 {
            let size = 1 + round % WIDEST;
            let largest = 1.6 / size as f64;
            let b: WideInverse = std::array::from_fn(|_| {
                std::array::from_fn(|_| 0.5 * largest * (1.0 + random.symmetric()))
            });
            let mut bound = [[0.0; WIDEST]; WIDEST];
            if !bound_on_wide_inverse(&b, size, &mut bound) {
                continue;
            }
            found[size] += 1;
            let mut power = [[0.0; WIDEST]; WIDEST];
            (0..size).for_each(|k| power[k][k] = 1.0);
            let mut sums = power;
            for _ in 0..2000 {
                let last = power;
                for r in 0..size {
                    for c in 0..size {
                        power[r][c] = (0..size).map(|k| b[r][k] * last[k][c]).sum();
                        sums[r][c] += power[r][c];
                    }
                }
            }
            for r in 0..size {
                for c in 0..size {
                    // The sums are of 2000 terms, rounded to nearest.
                    assert!(
                        sums[r][c] <= bound[r][c] * (1.0 + 1e-12),
                        "{} > {}",
                        sums[r][c],
                        bound[r][c]
                    );
                }
            }
            if size <= 3 {
                let small = std::array::from_fn(|r| std::array::from_fn(|c| b[r][c]));
                let other = bound_on_inverse(&small, size).expect("as the other one");
                for r in 0..size {
                    for c in 0..size {
                        assert!((other[r][c] - bound[r][c]).abs() <= 1e-6 * bound[r][c]);
                    }
                }
            }
        }
        assert!(found[1..].iter().all(|&found| found > 100), "{found:?}");
    }

    #[test]
    fn what_does_not_contract_has_no_bound() {
        let mut b = [[0.0; WIDEST]; WIDEST];
        b[2][5] = 2.0;
        b[5][2] = 0.5;
        let mut bound = [[0.0; WIDEST]; WIDEST];
        assert!(!bound_on_wide_inverse(&b, WIDEST, &mut bound));
        b[5][2] = 0.4;
        assert!(bound_on_wide_inverse(&b, WIDEST, &mut bound));
        assert!(bound[2][2] >= 5.0 && bound[2][2] < 5.0 + 1e-6);
    }
}
