//! Numbers that are computed from parameters: `width/2 + 3`, exactly.

use super::{Decimal, DecimalError};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// A number that has no end as a decimal, as a third, is taken to so many digits.
const DIGITS: i32 = 30;
/// Powers go up to this.
const MOST_POWER: u32 = 20;
/// No number on the way has more bits than this, above or below.
const MOST_BITS: u64 = 20_000;
/// Parentheses and signs in one another.
const DEPTH: usize = 50;

/// The value of an expression of numbers and parameters with `+ - * / ^` and parentheses, where the power of `^` is a whole number.
///
/// # Errors
/// What is wrong with it, in words, and where.
pub(crate) fn evaluate(text: &str, parameters: &[(String, Decimal)]) -> Result<Decimal, String> {
    let mut reader = Reader {
        text,
        at: 0,
        parameters,
        depth: 0,
    };
    let value = reader.sum()?;
    match reader.peek() {
        None => Ok(decimal(&value)
            .map_err(|error| error.to_string())?
            .computed_by(text)),
        Some(_) => Err(reader.wrong("an operator was expected")),
    }
}

/// Whether this can be the name of a parameter: letters, digits and underscores, a letter first.
pub(crate) fn is_name(name: &str) -> bool {
    let mut letters = name.chars();
    letters
        .next()
        .is_some_and(|c| c.is_alphabetic() || c == '_')
        && letters.all(|c| c.is_alphanumeric() || c == '_')
}

/// The parameters with some of them set: those that are computed from others follow.
///
/// # Errors
/// One cannot be computed: its name, and why.
pub(crate) fn with_set(
    parameters: &[(String, Decimal)],
    set: &[(String, Decimal)],
) -> Result<Vec<(String, Decimal)>, (String, String)> {
    let mut out: Vec<(String, Decimal)> = Vec::with_capacity(parameters.len());
    for (name, old) in parameters {
        let given = set.iter().find(|(other, _)| other == name);
        let value = match (given, old.expression()) {
            (Some((_, value)), _) => value.clone(),
            (None, Some(expression)) => {
                evaluate(expression, &out).map_err(|why| (name.clone(), why))?
            }
            (None, None) => old.clone(),
        };
        out.push((name.clone(), value));
    }
    Ok(out)
}

/// The decimal that a ratio is, or the nearest with so many digits.
fn decimal(value: &BigRational) -> Result<Decimal, DecimalError> {
    let ten = BigRational::from_integer(BigInt::from(10));
    // A ratio with an end has only twos and fives in its denominator, and no more of them than this.
    let exact = (0..=60).find(|&places| (value * ten.pow(places)).is_integer());
    let places = exact.unwrap_or_else(|| {
        let digits = |number: &BigInt| number.magnitude().to_string().len() as i32;
        DIGITS - (digits(value.numer()) - digits(value.denom()))
    });
    let scaled = (value * ten.pow(places)).round().to_integer();
    let places = usize::try_from(places);
    match places {
        Ok(0) => scaled.to_string().parse(),
        Ok(places) => {
            let sign = if scaled.is_negative() { "-" } else { "" };
            let digits = format!(
                "{:0>width$}",
                scaled.magnitude().to_string(),
                width = places + 1
            );
            let (whole, parts) = digits.split_at(digits.len() - places);
            format!("{sign}{whole}.{parts}").parse()
        }
        Err(_) => value.round().to_integer().to_string().parse(),
    }
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
    parameters: &'a [(String, Decimal)],
    depth: usize,
}

impl Reader<'_> {
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        let next = rest.trim_start();
        self.at += rest.len() - next.len();
        next.chars().next()
    }

    fn take(&mut self, wanted: char) -> bool {
        let is_next = self.peek() == Some(wanted);
        if is_next {
            self.at += wanted.len_utf8();
        }
        is_next
    }

    fn wrong(&mut self, what: &str) -> String {
        match self.peek() {
            None => format!("`{}` ends where {what}", self.text),
            Some(_) => format!("`{}`: {what} at `{}`", self.text, &self.text[self.at..]),
        }
    }

    fn sum(&mut self) -> Result<BigRational, String> {
        let mut sum = self.product()?;
        loop {
            if self.take('+') {
                let by = self.product()?;
                sum = self.checked(sum + by)?;
            } else if self.take('-') {
                let by = self.product()?;
                sum = self.checked(sum - by)?;
            } else {
                return Ok(sum);
            }
        }
    }

    fn product(&mut self) -> Result<BigRational, String> {
        let mut product = self.signed()?;
        loop {
            if self.take('*') {
                let by = self.signed()?;
                product = self.checked(product * by)?;
            } else if self.take('/') {
                let by = self.signed()?;
                if by.is_zero() {
                    return Err(format!("`{}` divides by zero", self.text));
                }
                product = self.checked(product / by)?;
            } else {
                return Ok(product);
            }
        }
    }

    fn signed(&mut self) -> Result<BigRational, String> {
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(format!(
                "`{}` has too many parentheses or signs in one another",
                self.text
            ));
        }
        let value = match (self.take('-'), self.peek()) {
            (true, _) => -self.signed()?,
            (false, Some('+')) => {
                self.at += 1;
                self.signed()?
            }
            _ => self.power()?,
        };
        self.depth -= 1;
        Ok(value)
    }

    /// A number, if it is no larger than numbers may be.
    fn checked(&self, number: BigRational) -> Result<BigRational, String> {
        self.fits(&number, 1).map(|()| number)
    }

    /// Whether so many factors like this one are no larger than numbers may be.
    fn fits(&self, number: &BigRational, times: u32) -> Result<(), String> {
        let bits = number.numer().bits().max(number.denom().bits());
        match bits * u64::from(times) <= MOST_BITS {
            true => Ok(()),
            false => Err(format!(
                "`{}` has a number that is too large on the way",
                self.text
            )),
        }
    }

    fn power(&mut self) -> Result<BigRational, String> {
        let base = self.atom()?;
        if !self.take('^') {
            return Ok(base);
        }
        let power = self.atom()?;
        let whole = power.is_integer().then(|| power.to_integer());
        match whole.and_then(|power| u32::try_from(power).ok()) {
            Some(power) if power <= MOST_POWER => self.fits(&base, power).map(|()| match power {
                0 => BigRational::one(),
                power => base.pow(power as i32),
            }),
            _ => Err(format!(
                "`{}`: a power is a whole number from 0 to {MOST_POWER}",
                self.text
            )),
        }
    }

    fn atom(&mut self) -> Result<BigRational, String> {
        if self.take('(') {
            let value = self.sum()?;
            return match self.take(')') {
                true => Ok(value),
                false => Err(self.wrong("`)` was expected")),
            };
        }
        let first = self.peek();
        let rest = &self.text[self.at..];
        match first {
            Some(c) if c.is_ascii_digit() || c == '.' => {
                let exponent = |at: usize| {
                    let before = rest[..at].chars().next_back();
                    before.is_some_and(|c| c == 'e' || c == 'E')
                };
                let ends = |(at, c): (usize, char)| {
                    let is_part = c.is_ascii_digit()
                        || matches!(c, '.' | 'e' | 'E')
                        || matches!(c, '+' | '-') && exponent(at);
                    (!is_part).then_some(at)
                };
                let end = rest.char_indices().find_map(ends).unwrap_or(rest.len());
                let number: Decimal = rest[..end]
                    .parse()
                    .map_err(|error: DecimalError| format!("`{}`: {error}", self.text))?;
                self.at += end;
                Ok(number.value().clone())
            }
            Some(c) if c.is_alphabetic() || c == '_' => {
                let is_part = |c: char| c.is_alphanumeric() || c == '_';
                let end = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
                let name = &rest[..end];
                let found = self.parameters.iter().find(|(other, _)| other == name);
                let (_, value) = found.ok_or_else(|| {
                    let names = self.parameters.iter().map(|(name, _)| name.as_str());
                    match crate::statement::nearest(name, names) {
                        Some(near) => format!("`{}`: `{name}` is no parameter that stands before; did you mean `{near}`?", self.text),
                        None => format!("`{}`: `{name}` is no parameter that stands before", self.text),
                    }
                })?;
                self.at += end;
                Ok(value.value().clone())
            }
            _ => Err(self.wrong("a number or a parameter was expected")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn parameters() -> Vec<(String, Decimal)> {
        [("width", "80"), ("a_1", "0.1"), ("Höhe", "-2")]
            .map(|(name, value)| (name.to_owned(), value.parse().unwrap()))
            .to_vec()
    }

    #[test]
    fn expressions_are_exact() {
        for (text, value) in [
            ("width/2 + 3", "43"),
            ("2*width - (3 - 1)^3", "152"),
            ("-a_1 * 3", "-0.3"),
            ("1e-3*width", "0.08"),
            ("2 - -Höhe^2", "6"),
            ("width / 64", "1.25"),
            ("1/3", "0.333333333333333333333333333333"),
            ("-200/3", "-66.6666666666666666666666666667"),
            (".5+1.e1", "10.5"),
            ("a_1^0", "1"),
        ] {
            let found = evaluate(text, &parameters()).unwrap();
            assert_eq!(found, value.parse().unwrap(), "{text}: {found}");
            assert_eq!(found.expression(), Some(text));
        }
    }

    #[test]
    fn what_is_wrong_is_said() {
        let deep = "(".repeat(1000);
        for (text, words) in [
            ("widht/2", "did you mean `width`?"),
            ("width/(a_1*10-1)", "divides by zero"),
            ("width +", "ends where"),
            ("(width", "`)` was expected"),
            ("width 2", "an operator was expected"),
            ("width^0.5", "a whole number"),
            ("", "a number or a parameter"),
            ("1e50*1e50", "out of range"),
            ("((((9^20)^20)^20)^20)^20", "too large on the way"),
            (&deep, "in one another"),
        ] {
            let error = evaluate(text, &parameters()).unwrap_err();
            assert!(error.contains(words), "{text}: {error}");
        }
    }

    proptest! {
        /// As floats have it, for whatever is nested.
        #[test]
        fn sums_and_products_are_as_in_floats(a in 1..50i32, b in 1..50i32, c in 1..50i32, d in 1..50i32) {
            let text = format!("({a} - {b}*{c})^2/{d} + -{a}*({b}+{c})");
            let [a, b, c, d] = [a, b, c, d].map(f64::from);
            let wanted = (a - b * c).powi(2) / d - a * (b + c);
            let found = evaluate(&text, &[]).unwrap().to_f64();
            prop_assert!((found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0));
        }

        /// No text makes it panic.
        #[test]
        fn no_text_panics(text in "[-+*/^().0-9a-zé ]{0,30}") {
            let _ = evaluate(&text, &parameters());
        }
    }
}
