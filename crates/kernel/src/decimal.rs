//! Decimals, kept exactly as they are written.

use crate::rational::Rational;
use num_bigint::BigInt;
use num_traits::Zero;
use std::fmt;
use std::str::FromStr;

/// An exact decimal number: 1.12 is 112/100, not the nearest float.
///
/// ```
/// use krawl::problem::Decimal;
/// let a: Decimal = "1.12".parse().unwrap();
/// assert_eq!(a, "112e-2".parse().unwrap());
/// assert_eq!(a.to_f64(), 1.12);
/// ```
#[derive(Debug, Clone)]
pub struct Decimal {
    text: String,
    value: Rational,
    /// What else was said of it, if anything was.
    said: Option<Box<Said>>,
}

/// What is said of few numbers.
#[derive(Debug, Clone, Default)]
struct Said {
    /// What it was computed by, if it was.
    expression: Option<Box<str>>,
    /// How far down and up it may be, if that was written with it.
    tolerance: Option<[Decimal; 2]>,
}

/// Why a text is not a decimal that krawl takes.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
pub enum DecimalError {
    /// Not a decimal at all.
    #[error("`{0}` is not a decimal number")]
    NotANumber(String),
    /// An infinity or a NaN.
    #[error("`{0}` is not a finite number")]
    NotFinite(String),
    /// More digits than any measured dimension has.
    #[error("the number has {0} digits, more than the {MAX_DIGITS} that are read")]
    TooLong(usize),
    /// Too large or too small in size for the arithmetic.
    #[error("`{0}` is out of range: sizes from 1e-60 to 1e60, and zero, are accepted")]
    OutOfRange(String),
}

crate::debug_in_words!(DecimalError);

const MAX_DIGITS: usize = 200;
/// Largest power of ten accepted. Far from overflow and underflow, so that the error bounds of
/// the certified mode, which multiply up to four lengths with each other, need no special cases.
const MAX_EXPONENT: i64 = 60;

impl Decimal {
    /// The text it was read from.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The expression of parameters that it was computed by, if it was.
    pub fn expression(&self) -> Option<&str> {
        self.said.as_ref()?.expression.as_deref()
    }

    /// The same number as that of an expression.
    #[doc(hidden)]
    pub fn computed_by(mut self, expression: &str) -> Self {
        self.said.get_or_insert_default().expression = Some(expression.into());
        self
    }

    /// How far down (a number that is mostly less than 0) and up it may be, if that was said with it, as in `4.2 ± 0.05`.
    pub fn tolerance(&self) -> Option<&[Decimal; 2]> {
        self.said.as_ref()?.tolerance.as_ref()
    }

    /// The same number, with a tolerance or without.
    pub fn with_tolerance(mut self, tolerance: Option<&[Decimal; 2]>) -> Self {
        if tolerance.is_some() || self.said.is_some() {
            self.said.get_or_insert_default().tolerance = tolerance.cloned();
        }
        self
    }

    /// The least and the greatest number that its own tolerance allows.
    pub fn limits(&self) -> Option<[Decimal; 2]> {
        // What is out of range was refused as it was read.
        self.within(self.tolerance()?).ok()
    }

    /// The least and the greatest number that a tolerance allows. An error: one is out of the range of numbers.
    pub fn within(&self, [down, up]: &[Decimal; 2]) -> Result<[Decimal; 2], DecimalError> {
        Ok([self.plus(down)?, self.plus(up)?])
    }

    /// The exact value.
    pub fn value(&self) -> &Rational {
        &self.value
    }

    /// The nearest float (`str::parse` rounds correctly).
    pub fn to_f64(&self) -> f64 {
        self.text.parse().expect("checked when it was read")
    }

    /// The power of ten that its last digit stands for: -3 for 1.120, 0 for 5, 1 for 5e1.
    pub fn last_digit(&self) -> i32 {
        let (mantissa, exponent) = match self.text.find(['e', 'E']) {
            Some(at) => (&self.text[..at], &self.text[at + 1..]),
            None => (self.text.as_str(), "0"),
        };
        let behind = mantissa
            .split_once('.')
            .map_or(0, |(_, fraction)| fraction.len());
        // Exponents and numbers of digits are small in numbers that were read.
        exponent.parse::<i32>().unwrap_or(0) - behind as i32
    }

    /// Whether the number is greater than zero.
    pub fn is_positive(&self) -> bool {
        self.value.is_positive()
    }

    /// The sum of two, exactly. An error: it is out of the range of numbers.
    pub fn plus(&self, other: &Decimal) -> Result<Decimal, DecimalError> {
        let place = self.last_digit().min(other.last_digit()).min(0);
        let places = place.unsigned_abs() as usize;
        let scale = Rational::from_integer(num_bigint::BigInt::from(10).pow(place.unsigned_abs()));
        let sum = ((&self.value + &other.value) * scale).to_integer();
        let digits = format!(
            "{:0>width$}",
            sum.magnitude().to_string(),
            width = places + 1
        );
        let (whole, parts) = digits.split_at(digits.len() - places);
        let sign = if sum.sign() == num_bigint::Sign::Minus {
            "-"
        } else {
            ""
        };
        match parts {
            "" => format!("{sign}{whole}").parse(),
            parts => format!("{sign}{whole}.{parts}").parse(),
        }
    }

    /// The number with the other sign.
    pub fn negative(&self) -> Decimal {
        let text = self.text.strip_prefix('-');
        let text = text.map_or_else(
            || format!("-{}", self.text.trim_start_matches('+')),
            str::to_owned,
        );
        Decimal {
            value: -self.value.clone(),
            text,
            said: None,
        }
    }
}

impl FromStr for Decimal {
    type Err = DecimalError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let shown = || text.chars().take(40).collect::<String>();
        let not_a_number = || DecimalError::NotANumber(shown());
        let text = text.trim();
        let (negative, unsigned) = match text.as_bytes().first() {
            Some(b'-') => (true, &text[1..]),
            Some(b'+') => (false, &text[1..]),
            _ => (false, text),
        };
        if matches!(
            unsigned.to_ascii_lowercase().as_str(),
            "inf" | "infinity" | "nan"
        ) {
            return Err(DecimalError::NotFinite(shown()));
        }
        let (mantissa, exponent) = match unsigned.find(['e', 'E']) {
            Some(at) => (&unsigned[..at], &unsigned[at + 1..]),
            None => (unsigned, "0"),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let all_digits = |s: &str| s.bytes().all(|b| b.is_ascii_digit());
        if whole.is_empty() && fraction.is_empty() || !all_digits(whole) || !all_digits(fraction) {
            return Err(not_a_number());
        }
        let exponent_digits = exponent.strip_prefix(['-', '+']).unwrap_or(exponent);
        if exponent_digits.is_empty() || !all_digits(exponent_digits) {
            return Err(not_a_number());
        }
        if whole.len() + fraction.len() > MAX_DIGITS {
            return Err(DecimalError::TooLong(whole.len() + fraction.len()));
        }
        let digits: BigInt = format!("{whole}{fraction}")
            .parse()
            .map_err(|_| not_a_number())?;
        let value = if digits.is_zero() {
            Rational::zero()
        } else {
            let exponent: i64 = exponent
                .parse()
                .map_err(|_| DecimalError::OutOfRange(shown()))?;
            if exponent.abs() > MAX_EXPONENT + MAX_DIGITS as i64 {
                return Err(DecimalError::OutOfRange(shown()));
            }
            let shift = exponent - fraction.len() as i64;
            let power = BigInt::from(10).pow(shift.unsigned_abs() as u32);
            let size = if shift >= 0 {
                Rational::from(digits * power)
            } else {
                Rational::new(digits, power)
            };
            let limit = Rational::from(BigInt::from(10).pow(MAX_EXPONENT as u32));
            if size > limit || size < limit.recip() {
                return Err(DecimalError::OutOfRange(shown()));
            }
            if negative { -size } else { size }
        };
        let text = if value.is_zero() {
            "0".to_owned()
        } else {
            text.to_owned()
        };
        Ok(Decimal {
            text,
            value,
            said: None,
        })
    }
}

impl PartialEq for Decimal {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl From<i32> for Decimal {
    fn from(value: i32) -> Self {
        Decimal {
            text: value.to_string(),
            value: Rational::from(BigInt::from(value)),
            said: None,
        }
    }
}

impl TryFrom<&str> for Decimal {
    type Error = DecimalError;

    /// Exactly what the text says.
    fn try_from(text: &str) -> Result<Self, DecimalError> {
        text.parse()
    }
}

impl TryFrom<f64> for Decimal {
    type Error = DecimalError;

    /// The shortest decimal that reads as the float.
    ///
    /// ```
    /// use krawl::problem::Decimal;
    /// assert_eq!(Decimal::try_from(0.1).unwrap(), "0.1".parse().unwrap());
    /// assert!(Decimal::try_from(f64::NAN).is_err());
    /// ```
    fn try_from(value: f64) -> Result<Self, DecimalError> {
        format!("{value:e}").parse()
    }
}

impl From<std::convert::Infallible> for DecimalError {
    fn from(never: std::convert::Infallible) -> Self {
        match never {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Decimal, DecimalError> {
        text.parse()
    }

    #[test]
    fn keeps_the_exact_value() {
        let ratio = |n: i64, d: i64| Rational::new(n.into(), d.into());
        assert_eq!(*read("1.12").unwrap().value(), ratio(112, 100));
        assert_eq!(*read("-0.5e1").unwrap().value(), ratio(-5, 1));
        assert_eq!(*read("+.25").unwrap().value(), ratio(1, 4));
        assert_eq!(*read("3.").unwrap().value(), ratio(3, 1));
        assert_eq!(
            *read("0e999999999999999999999").unwrap().value(),
            ratio(0, 1)
        );
    }

    #[test]
    fn knows_its_last_digit() {
        for (text, place) in [
            ("1.120", -3),
            ("5", 0),
            ("5e1", 1),
            ("-0.5e1", 0),
            ("2.5e-3", -4),
        ] {
            assert_eq!(read(text).unwrap().last_digit(), place, "{text}");
        }
    }

    #[test]
    fn says_what_is_wrong() {
        for text in [
            "", "-", ".", "1e", "1e+", "0x10", "1..2", "1_0", "one", "1.2.3", "--1",
        ] {
            assert!(
                matches!(read(text), Err(DecimalError::NotANumber(_))),
                "{text}"
            );
        }
        for text in ["inf", "-inf", "nan", "NaN", "+Infinity"] {
            assert!(
                matches!(read(text), Err(DecimalError::NotFinite(_))),
                "{text}"
            );
        }
        for text in ["1e61", "1e-61", "1e400", "1e-400", "1e99999999999999999999"] {
            assert!(
                matches!(read(text), Err(DecimalError::OutOfRange(_))),
                "{text}"
            );
        }
        assert!(matches!(
            read(&"1".repeat(201)),
            Err(DecimalError::TooLong(201))
        ));
    }
}
