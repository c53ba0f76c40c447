//! Floats with a mantissa of 256 bits, every operation correctly rounded to the nearest, ties to even.
//!
//! Their mantissas have a fixed length, so that nothing is allocated: the tests make some hundreds of millions of them.

use crate::equations::{Halved, Ring};
use crate::interval::{Interval, hull};
use crate::rational::Rational;
use num_bigint::BigUint;
use num_integer::Integer;
use num_traits::Zero;
use num_traits::float::FloatCore;
use std::array;
use std::cmp::Ordering;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

const BITS: i64 = 256;
/// Words of 64 bits in a mantissa, the lowest first.
const WORDS: usize = 4;

/// ± digits · 2^exponent. The highest bit of the digits is set; but 0 has no digits, no sign and the least exponent.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Big {
    negative: bool,
    exponent: i64,
    digits: [u64; WORDS],
}

const ZERO: Big = Big {
    negative: false,
    exponent: -(1 << 40),
    digits: [0; WORDS],
};

/// The upper of two neighbouring words, after both are moved up by fewer than 64 bits.
#[inline]
fn upper([low, high]: [u64; 2], shift: u32) -> u64 {
    high << shift | low >> 1 >> (63 - shift)
}

/// Whether a whole number has a bit below this one.
#[inline]
fn any_below(digits: &[u64], at: i64) -> bool {
    let whole = digits.len().min((at.max(0) >> 6) as usize);
    let part = (1 << (at & 63)) - 1;
    digits[..whole].iter().any(|&d| d != 0)
        || at > 0 && digits.get(whole).is_some_and(|d| d & part != 0)
}

/// A power of two, beyond the floats 0 or infinite.
fn two_to(exponent: i64) -> f64 {
    f64::from_bits(((exponent.clamp(-1023, 1024) + 1023) as u64) << 52)
}

/// ± digits · 2^exponent for digits of any length.
#[inline]
fn rounded(negative: bool, exponent: i64, digits: &[u64]) -> Big {
    let Some(top) = digits.iter().rposition(|&d| d != 0) else {
        return ZERO;
    };
    let (from_top, shift) = (&digits[..=top], digits[top].leading_zeros());
    let at = |k: usize| from_top.iter().rev().nth(k).copied().unwrap_or(0);
    let moved = |k: usize| upper([at(k + 1), at(k)], shift);
    let mut out: [u64; WORDS] = array::from_fn(|k| moved(WORDS - 1 - k));
    let mut from = 64 * (top as i64 + 1) - i64::from(shift) - BITS;
    let below = moved(WORDS);
    let is_more = || below << 1 != 0 || any_below(digits, from - 64);
    if below >> 63 == 1 && (out[0] & 1 == 1 || is_more()) {
        let is_carried = out.iter_mut().all(|digit| {
            *digit = digit.wrapping_add(1);
            *digit == 0
        });
        if is_carried {
            out[WORDS - 1] = 1 << 63;
            from += 1;
        }
    }
    Big {
        negative,
        exponent: exponent + from,
        digits: out,
    }
}

/// ± above / below · 2^exponent.
fn quotient(negative: bool, exponent: i64, above: &BigUint, below: &BigUint) -> Big {
    let shift = (BITS as u64 + 2 + below.bits()).saturating_sub(above.bits());
    let (whole, rest) = (above << shift).div_rem(below);
    // The lowest bit is below the half that rounding looks at, and stands for all that is left.
    let digits = (whole << 1u32) + BigUint::from(u32::from(!rest.is_zero()));
    rounded(
        negative,
        exponent - shift as i64 - 1,
        &digits.to_u64_digits(),
    )
}

impl Big {
    /// Exactly.
    pub fn of(x: f64) -> Self {
        assert!(x.is_finite(), "a number");
        let (digits, exponent, sign) = FloatCore::integer_decode(x);
        rounded(sign < 0, exponent.into(), &[digits])
    }

    pub fn ratio(x: &Rational) -> Self {
        let (above, below) = (x.numer(), x.denom());
        let negative = above.sign() == num_bigint::Sign::Minus;
        quotient(negative, 0, above.magnitude(), below.magnitude())
    }

    fn whole_digits(&self) -> BigUint {
        let bytes: Vec<u8> = self.digits.iter().flat_map(|d| d.to_le_bytes()).collect();
        BigUint::from_bytes_le(&bytes)
    }

    pub fn sqrt(&self) -> Self {
        assert!(!self.negative, "a root of a negative number");
        // Of an even exponent, and with more than enough digits.
        let shift = BITS + 2 + (self.exponent & 1);
        let whole = self.whole_digits() << shift as u64;
        let root = whole.sqrt();
        let is_exact = &root * &root == whole;
        let digits = (root << 1u32) + BigUint::from(u32::from(!is_exact));
        let exponent = (self.exponent - shift) / 2 - 1;
        rounded(false, exponent, &digits.to_u64_digits())
    }

    pub fn abs(&self) -> Self {
        Big {
            negative: false,
            ..self.clone()
        }
    }

    pub fn max(self, other: Self) -> Self {
        if self < other { other } else { self }
    }

    /// The nearest float; rounded twice where that has fewer than 53 bits.
    pub fn to_f64(&self) -> f64 {
        let [rest @ .., top] = &self.digits;
        let top = top | u64::from(rest.iter().any(|&d| d != 0));
        let power = self.exponent + BITS - 64;
        let size = top as f64 * two_to(power / 2) * two_to(power - power / 2);
        if self.negative { -size } else { size }
    }

    /// What holds it.
    pub fn enclosure(&self) -> Interval {
        let x = self.to_f64();
        hull(x.next_down(), x.next_up())
    }

    /// Up to what 256 bits may be off after some operations: where an interval is a single float.
    pub fn is_in(&self, x: Interval) -> bool {
        let slack = self.abs() * Big::of(0.5f64.powi(220));
        Big::of(x.inf()) <= self + &slack && self - &slack <= Big::of(x.sup())
    }

    fn size(&self) -> (i64, impl Ord) {
        let [a, b, c, d] = self.digits;
        (self.exponent, [d, c, b, a])
    }
}

impl Ord for Big {
    fn cmp(&self, other: &Self) -> Ordering {
        match [self.negative, other.negative] {
            [false, false] => self.size().cmp(&other.size()),
            [true, true] => other.size().cmp(&self.size()),
            [a, b] => b.cmp(&a),
        }
    }
}

impl PartialOrd for Big {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// a + b, or a − b.
#[inline]
fn sum(a: &Big, b: &Big, is_difference: bool) -> Big {
    let (a, b) = ((a, a.negative), (b, b.negative ^ is_difference));
    let [(large, negative), (small, other)] = if a.0.size() < b.0.size() {
        [b, a]
    } else {
        [a, b]
    };
    // With a word below the digits and one above them. What the smaller one has further below leaves one bit: digits
    // only move by more than one place where nothing was lost.
    let wide = |[a, b, c, d]: [u64; WORDS]| [0, a, b, c, d, 0];
    let (mut digits, right) = (wide(large.digits), wide(small.digits));
    let shift = large.exponent - small.exponent;
    let (words, bits) = ((shift >> 6) as usize, (shift & 63) as u32);
    let at = |k: usize| right.get(k + words).copied().unwrap_or(0);
    let mut carry = false;
    for (k, digit) in digits.iter_mut().enumerate() {
        // Down by some bits is up by the others, and down by a word.
        let mut right_digit = match bits {
            0 => at(k),
            _ => upper([at(k), at(k + 1)], 64 - bits),
        };
        if k == 0 {
            right_digit |= u64::from(any_below(&right, shift));
        }
        let both = match negative == other {
            true => [
                digit.overflowing_add(right_digit),
                digit
                    .wrapping_add(right_digit)
                    .overflowing_add(carry.into()),
            ],
            false => [
                digit.overflowing_sub(right_digit),
                digit
                    .wrapping_sub(right_digit)
                    .overflowing_sub(carry.into()),
            ],
        };
        *digit = both[1].0;
        carry = both[0].1 | both[1].1;
    }
    rounded(negative, large.exponent - 64, &digits)
}

#[inline]
fn product(a: &Big, b: &Big) -> Big {
    let mut digits = [0; 2 * WORDS];
    for (i, &x) in a.digits.iter().enumerate() {
        let mut carry = 0;
        for (j, &y) in b.digits.iter().enumerate() {
            let sum = u128::from(x) * u128::from(y) + u128::from(digits[i + j]) + carry;
            digits[i + j] = sum as u64;
            carry = sum >> 64;
        }
        digits[i + WORDS] = carry as u64;
    }
    rounded(a.negative ^ b.negative, a.exponent + b.exponent, &digits)
}

fn ratio(a: &Big, b: &Big) -> Big {
    let (negative, exponent) = (a.negative ^ b.negative, a.exponent - b.exponent);
    quotient(negative, exponent, &a.whole_digits(), &b.whole_digits())
}

macro_rules! operators {
    ($($trait:ident $f:ident: $value:expr),*) => {$(
        impl $trait for Big {
            type Output = Big;
            fn $f(self, other: Big) -> Big { $value(&self, &other) }
        }
        impl $trait<&Big> for &Big {
            type Output = Big;
            fn $f(self, other: &Big) -> Big { $value(self, other) }
        }
        impl $trait<&Big> for Big {
            type Output = Big;
            fn $f(self, other: &Big) -> Big { $value(&self, other) }
        }
        impl $trait<Big> for &Big {
            type Output = Big;
            fn $f(self, other: Big) -> Big { $value(self, &other) }
        }
    )*};
}
operators!(
    Add add: |a, b| sum(a, b, false),
    Sub sub: |a, b| sum(a, b, true),
    Mul mul: product,
    Div div: ratio
);

impl Ring for Big {
    fn whole(number: i32) -> Self {
        Big::of(number.into())
    }
}

impl Halved for Big {
    fn halves(self, count: i32) -> Self {
        self * Big::of(0.5 * f64::from(count))
    }
}

impl Neg for Big {
    type Output = Big;
    fn neg(self) -> Big {
        let negative = !self.negative && self != ZERO;
        Big { negative, ..self }
    }
}

impl AddAssign for Big {
    fn add_assign(&mut self, other: Big) {
        *self = &*self + other;
    }
}

impl SubAssign for Big {
    fn sub_assign(&mut self, other: Big) {
        *self = &*self - other;
    }
}

impl Sum for Big {
    fn sum<I: Iterator<Item = Big>>(terms: I) -> Big {
        terms.fold(ZERO, |sum, x| sum + x)
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::Random;
    use super::*;

    /// Exactly.
    fn value(x: &Big) -> Rational {
        let sign = if x.negative { -1 } else { 1 };
        Rational::from_integer(num_bigint::BigInt::from(x.whole_digits()) * sign)
            * power(x.exponent)
    }

    fn power(exponent: i64) -> Rational {
        let power = Rational::from_integer(num_bigint::BigInt::from(1) << exponent.unsigned_abs());
        match exponent < 0 {
            true => Rational::from_integer(1.into()) / power,
            false => power,
        }
    }

    /// With long rows of the same bit, few bits, or any bits, and an exponent that is near the one given or is not.
    fn number(random: &mut Random, exponent: i64) -> Big {
        let mut digits = [0; WORDS].map(|_| match random.below(4) {
            0 => 0,
            1 => u64::MAX,
            2 => 1 << random.below(64),
            _ => random.bits(),
        });
        digits[WORDS - 1] |= 1 << 63;
        let away = [2, 70, 300][random.below(3)];
        Big {
            negative: random.below(2) == 0,
            exponent: exponent + random.below(2 * away + 1) as i64 - away as i64,
            digits,
        }
    }

    /// Whether no other number is nearer to the exact one, and the last bit is 0 where one is as near.
    fn is_nearest(x: &Big, exact: &Rational) -> bool {
        let zero = Rational::from_integer(0.into());
        if *exact == zero || *x == ZERO {
            return *exact == zero && *x == ZERO;
        }
        let away = value(x) - exact;
        // Numbers nearer to zero are at half the distance below a power of two.
        let is_power = x.digits == [0, 0, 0, 1 << 63];
        let is_outside = (away > zero) != x.negative;
        let unit = power(x.exponent - i64::from(is_power && is_outside));
        let twice = (&away + &away).abs();
        x.digits[WORDS - 1] >> 63 == 1 && (twice < unit || twice == unit && x.digits[0] & 1 == 0)
    }

    #[test]
    fn every_operation_is_rounded_to_the_nearest() {
        let mut random = Random::new(9);
        for _ in 0..4000 {
            let a = number(&mut random, 0);
            let mut b = number(&mut random, a.exponent);
            if random.below(4) == 0 {
                // Next to each other.
                b = Big {
                    exponent: a.exponent,
                    digits: a.digits,
                    ..b
                };
                b.digits[0] ^= random.bits() >> random.below(64);
            }
            let [x, y] = [&a, &b].map(value);
            assert!(is_nearest(&(&a + &b), &(&x + &y)), "{a:?} + {b:?}");
            assert!(is_nearest(&(&a - &b), &(&x - &y)), "{a:?} - {b:?}");
            assert!(is_nearest(&(&a * &b), &(&x * &y)), "{a:?} * {b:?}");
            assert!(is_nearest(&(&a / &b), &(&x / &y)), "{a:?} / {b:?}");
            assert!(
                is_nearest(&Big::ratio(&(&x / &y)), &(&x / &y)),
                "{a:?} : {b:?}"
            );
            assert_eq!(a.cmp(&b), x.cmp(&y), "{a:?} {b:?}");
            assert_eq!(a.abs(), Big::ratio(&x.abs()));
            assert_eq!(-a.clone(), Big::ratio(&-x.clone()));
            // The middle between a root and its neighbours is beyond the number on either side.
            let root = a.abs().sqrt();
            let (middle, half) = (value(&root), power(root.exponent - 1));
            let [below, above] = [&middle - &half, &middle + &half].map(|r| &r * &r);
            assert!(below < x.abs() && x.abs() < above, "root of {a:?}");
            assert_eq!((&root * &root).sqrt(), root);
        }
    }

    #[test]
    fn floats_are_kept_and_found() {
        let mut random = Random::new(10);
        for _ in 0..4000 {
            let x = f64::from_bits(random.bits());
            if x.is_finite() {
                assert_eq!(Big::of(x).to_f64(), x);
                assert!(is_nearest(&Big::of(x), &Rational::from_float(x).unwrap()));
            }
            let a = number(&mut random, -BITS);
            let x = a.to_f64();
            let away = |x: f64| (Big::of(x) - &a).abs();
            assert!(
                away(x) <= away(x.next_up()) && away(x) <= away(x.next_down()),
                "{a:?}"
            );
        }
    }
}
