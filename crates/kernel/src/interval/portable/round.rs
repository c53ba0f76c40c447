//! The four operations and the square root, rounded upwards and downwards with nothing but
//! operations that round to nearest.
//!
//! The rounding error of a sum is a float that six operations find exactly (TwoSum: Knuth; Boldo, Graillat
//! and Muller 2017 for what happens near overflow), and the sign of the error of a product, a quotient or
//! a root is that of one fused multiply-add, as long as nothing underflows (Muller et al., Handbook of
//! Floating-Point Arithmetic, 2nd edition, sections 4.4, 4.8 and 4.9). So the results are those of hardware
//! that rounds upwards. Only below [`TINY`], where those errors may themselves be too small for a float,
//! they are one float further out: an enclosure all the same.

/// 2⁻⁹⁰⁰. Errors of operations on floats beyond it, and with results beyond it, are floats or have at
/// least their sign as a float: they are no smaller than 2⁻⁹⁰⁰ · 2⁻¹⁰⁶, and the smallest normal float
/// is 2⁻¹⁰²².
const TINY: f64 = f64::from_bits((1023 - 900) << 52);

/// The smallest float that is not below a number x, from x rounded to nearest and the sign of the error
/// x − `nearest`; NaN for an unknown sign.
fn outwards(nearest: f64, error: f64) -> f64 {
    if error <= 0.0 {
        nearest
    } else {
        nearest.next_up()
    }
}

/// a + b rounded upwards. Not both infinite with different signs.
pub fn add_up(a: f64, b: f64) -> f64 {
    let sum = a + b;
    if sum.is_infinite() {
        // −∞ from finite numbers is an overflow, and the number is above it.
        let overflow = a.is_finite() && b.is_finite();
        return if overflow {
            outwards(sum, f64::NAN)
        } else {
            sum
        };
    }
    let of_b = sum - a;
    let error = (a - (sum - of_b)) + (b - of_b);
    outwards(sum, error)
}

/// a · b rounded upwards, where 0 · ∞ is 0.
pub fn mul_up(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 {
        return 0.0;
    }
    let product = a * b;
    if product.is_infinite() {
        let overflow = a.is_finite() && b.is_finite();
        return if overflow {
            outwards(product, f64::NAN)
        } else {
            product
        };
    }
    if product.abs() < TINY {
        return product.next_up();
    }
    outwards(product, a.mul_add(b, -product))
}

/// a / b rounded upwards, for b ≠ 0, where a or b may be infinite, but not both.
pub fn div_up(a: f64, b: f64) -> f64 {
    if a == 0.0 {
        return 0.0;
    }
    let quotient = a / b;
    if quotient.is_infinite() {
        let overflow = a.is_finite();
        return if overflow {
            outwards(quotient, f64::NAN)
        } else {
            quotient
        };
    }
    if quotient.abs() < TINY || a.abs() < TINY {
        return quotient.next_up();
    }
    // The remainder a − quotient · b has the sign of the error where b is positive.
    let remainder = (-quotient).mul_add(b, a);
    outwards(quotient, if b > 0.0 { remainder } else { -remainder })
}

/// √a rounded upwards, for a ≥ 0.
pub fn sqrt_up(a: f64) -> f64 {
    let root = a.sqrt();
    if a == 0.0 || a.is_infinite() {
        return root;
    }
    if a < TINY {
        return root.next_up();
    }
    outwards(root, (-root).mul_add(root, a))
}

/// √a rounded downwards, for a ≥ 0.
pub fn sqrt_down(a: f64) -> f64 {
    let root = a.sqrt();
    if a == 0.0 || a.is_infinite() {
        return root;
    }
    if a < TINY || root.mul_add(root, -a) > 0.0 {
        return root.next_down();
    }
    root
}

/// a + b rounded downwards. Not both infinite with different signs.
pub fn add_down(a: f64, b: f64) -> f64 {
    -add_up(-a, -b)
}

/// a · b rounded downwards, where 0 · ∞ is 0.
pub fn mul_down(a: f64, b: f64) -> f64 {
    -mul_up(-a, b)
}

/// a / b rounded downwards, for b ≠ 0, where a or b may be infinite, but not both.
pub fn div_down(a: f64, b: f64) -> f64 {
    -div_up(-a, b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::{Rational, exact};
    use proptest::prelude::*;

    /// `down` and `up` enclose the number, with nothing but the number between them: its neighbours, or
    /// itself twice.
    fn encloses(number: &Rational, down: f64, up: f64, tiny: bool) {
        assert!(
            exact(down) <= *number && *number <= exact(up),
            "{down:e} {up:e}"
        );
        if tiny {
            assert!(up <= down.next_up().next_up());
        } else if exact(down) == *number {
            assert_eq!(down, up);
        } else {
            assert_eq!(up, down.next_up());
        }
    }

    /// Floats of all sizes, with short ones, whose results are often exact, among them.
    fn float() -> impl Strategy<Value = f64> {
        let long =
            (any::<i64>(), -300i32..300).prop_map(|(digits, e)| digits as f64 * 2f64.powi(e));
        let short =
            (-40i32..40, -20i32..20).prop_map(|(digits, e)| f64::from(digits) * 2f64.powi(e));
        let tiny = (any::<i64>(), -1090i32..-1000)
            .prop_map(|(digits, e)| digits as f64 * 2f64.powi(e / 2) * 2f64.powi(e - e / 2));
        prop_oneof![4 => long, 2 => short, 1 => tiny]
    }

    proptest! {
        #[test]
        fn operations_are_rounded_outwards_and_no_further(a in float(), b in float()) {
            let (x, y) = (exact(a), exact(b));
            encloses(&(&x + &y), add_down(a, b), add_up(a, b), false);
            let tiny = |z: f64| z != 0.0 && z.abs() < TINY;
            encloses(&(&x * &y), mul_down(a, b), mul_up(a, b), tiny(a * b) || (a * b == 0.0 && a != 0.0 && b != 0.0));
            if b != 0.0 && (a / b).is_finite() {
                encloses(&(&x / &y), div_down(a, b), div_up(a, b), tiny(a / b) || tiny(a));
            }
            let (down, up) = (sqrt_down(a.abs()), sqrt_up(a.abs()));
            let square = |r: f64| exact(r) * exact(r);
            prop_assert!(square(down) <= exact(a.abs()) && exact(a.abs()) <= square(up));
            prop_assert!(up <= down.next_up() || tiny(a));
            if square(down) == exact(a.abs()) && !tiny(a) {
                prop_assert_eq!(down, up);
            }
        }
    }

    #[test]
    fn what_overflows_is_enclosed() {
        assert_eq!(add_up(f64::MAX, f64::MAX), f64::INFINITY);
        assert_eq!(add_down(f64::MAX, f64::MAX), f64::MAX);
        assert_eq!(add_up(f64::MIN, f64::MIN), f64::MIN);
        assert_eq!(mul_down(f64::MAX, 2.0), f64::MAX);
        assert_eq!(mul_up(f64::MAX, -2.0), f64::MIN);
        assert_eq!(div_down(f64::MAX, 0.5), f64::MAX);
        assert_eq!(mul_up(f64::INFINITY, 0.0), 0.0);
        assert_eq!(mul_up(f64::INFINITY, 2.0), f64::INFINITY);
        assert_eq!(add_down(f64::NEG_INFINITY, 1.0), f64::NEG_INFINITY);
    }
}
