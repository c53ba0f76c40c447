//! Expressions as people write them, `width/2 + 3`: read once, for numbers that are computed from parameters, exactly, and for
//! the polynomials of [equations](super::formula).

use super::error::did_you_mean;
use super::{Decimal, DecimalError};
use crate::rational::Rational;
use crate::statement::nearest;
use num_bigint::BigInt;
use num_traits::Signed;
use std::borrow::Cow;

/// A number that has no end as a decimal, as a third, is taken to so many digits.
const DIGITS: i32 = 30;
/// Powers go up to this.
pub(super) const MOST_POWER: u32 = 20;
/// No number on the way has more bits than this, above or below.
const MOST_BITS: u64 = 20_000;
/// So many letters of an expression stand in a message.
const MOST_SHOWN: usize = 200;
/// Parentheses and signs in one another.
const DEPTH: usize = 50;

/// A text that is short enough to stand in a message, or how it begins.
fn beginning(text: &str) -> Cow<'_, str> {
    match text.char_indices().nth(MOST_SHOWN) {
        None => text.into(),
        Some((end, _)) => format!("{}…", &text[..end]).into(),
    }
}

/// The value of an expression of numbers and parameters with `+ - * / ^` and parentheses, where the power of `^` is a whole number.
///
/// # Errors
/// What is wrong with it, in words, and where.
pub fn evaluate(text: &str, parameters: &[(String, Decimal)]) -> Result<Decimal, String> {
    let mut reader = Reader::new(text, Numbers(parameters));
    let value = reader.sum()?;
    match reader.peek() {
        None => Ok(decimal(&value)
            .map_err(|error| error.to_string())?
            .computed_by(text)),
        Some(_) => Err(reader.wrong("an operator was expected")),
    }
}

/// The names in an expression or equation, without those of points, in `A.x` and `|A-B|`.
pub fn names(text: &str) -> impl Iterator<Item = &str> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let outside = text.split('|').step_by(2);
    outside
        .flat_map(move |text| text.split(move |c| !is_part(c)))
        .filter(|name| is_name(name))
}

/// Whether this can be the name of a parameter: letters, digits and underscores, a letter first.
pub fn is_name(name: &str) -> bool {
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
pub fn with_set(
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
pub(super) fn decimal(value: &Rational) -> Result<Decimal, DecimalError> {
    let ten = Rational::from_integer(BigInt::from(10));
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

/// What expressions are made of: how numbers and names are read, and what becomes of them.
///
/// Each error is what follows the expression in its message, with what stands between the two: `: a power is …`.
pub(super) trait Algebra {
    /// What an expression is.
    type Value;
    /// A number.
    fn number(&self, number: Decimal) -> Result<Self::Value, String>;
    /// What a name stands for, with what may stand right behind it, as a coordinate does: how long that is.
    fn name(&mut self, name: &str, rest: &str) -> Result<(Self::Value, usize), String>;
    /// What stands between two bars, `|a-b|`, if anything may.
    fn bars(&mut self, inner: &str) -> Result<Self::Value, String>;
    /// The root.
    fn root(&mut self, of: Self::Value) -> Result<Self::Value, String>;
    fn sum(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, String>;
    fn negative(&self, a: Self::Value) -> Self::Value;
    fn product(&self, a: &Self::Value, b: &Self::Value) -> Result<Self::Value, String>;
    fn quotient(&mut self, a: Self::Value, b: Self::Value) -> Result<Self::Value, String>;
    /// Its value, if it is a whole number that is not negative.
    fn whole(&self, a: &Self::Value) -> Option<u32>;
}

/// Exact numbers, by the parameters before.
struct Numbers<'a>(&'a [(String, Decimal)]);

impl Numbers<'_> {
    /// A number, if it is no larger than numbers may be.
    fn checked(number: Rational) -> Result<Rational, String> {
        match number.numer().bits().max(number.denom().bits()) <= MOST_BITS {
            true => Ok(number),
            false => Err(" has a number that is too large on the way".to_owned()),
        }
    }
}

impl Algebra for Numbers<'_> {
    type Value = Rational;

    fn number(&self, number: Decimal) -> Result<Rational, String> {
        Ok(number.value().clone())
    }

    fn name(&mut self, name: &str, _rest: &str) -> Result<(Rational, usize), String> {
        let found = self.0.iter().find(|(other, _)| other == name);
        let (_, value) = found.ok_or_else(|| {
            let mut names = self.0.iter().map(|(name, _)| name.as_str());
            let meant = did_you_mean(nearest(name, &mut names));
            format!(": `{name}` is no parameter that stands before{meant}")
        })?;
        Ok((value.value().clone(), 0))
    }

    fn bars(&mut self, inner: &str) -> Result<Rational, String> {
        Err(format!(
            ": a length, `|{inner}|`, can stand in equations only"
        ))
    }

    fn root(&mut self, _of: Rational) -> Result<Rational, String> {
        Err(": a root can stand in equations only".to_owned())
    }

    fn sum(&self, a: Rational, b: Rational) -> Result<Rational, String> {
        Self::checked(a + b)
    }

    fn negative(&self, a: Rational) -> Rational {
        -a
    }

    fn product(&self, a: &Rational, b: &Rational) -> Result<Rational, String> {
        Self::checked(a * b)
    }

    fn quotient(&mut self, a: Rational, b: Rational) -> Result<Rational, String> {
        match b.is_zero() {
            true => Err(" divides by zero".to_owned()),
            false => Self::checked(a / b),
        }
    }

    fn whole(&self, a: &Rational) -> Option<u32> {
        let whole = a.is_integer().then(|| a.to_integer());
        whole.and_then(|whole| u32::try_from(whole).ok())
    }
}

/// A text, and how far it was read.
pub(super) struct Reader<'a, A> {
    text: &'a str,
    at: usize,
    depth: usize,
    algebra: A,
}

impl<'a, A: Algebra> Reader<'a, A> {
    /// Nothing is read yet.
    pub(super) fn new(text: &'a str, algebra: A) -> Self {
        Reader {
            text,
            at: 0,
            depth: 0,
            algebra,
        }
    }

    /// What it is read into.
    pub(super) fn algebra(&mut self) -> &mut A {
        &mut self.algebra
    }

    /// What comes next that is no space.
    pub(super) fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        let next = rest.trim_start();
        self.at += rest.len() - next.len();
        next.chars().next()
    }

    /// Takes this, if it comes next.
    pub(super) fn take(&mut self, wanted: char) -> bool {
        let is_next = self.peek() == Some(wanted);
        if is_next {
            self.at += wanted.len_utf8();
        }
        is_next
    }

    /// The message that something else was expected.
    pub(super) fn wrong(&mut self, what: &str) -> String {
        match self.peek() {
            None => format!("`{}` ends where {what}", self.shown()),
            Some(_) => {
                let rest = beginning(&self.text[self.at..]);
                format!("`{}`: {what} at `{rest}`", self.shown())
            }
        }
    }

    /// The text, or how it begins, for messages.
    fn shown(&self) -> Cow<'_, str> {
        beginning(self.text)
    }

    fn named<T>(&self, result: Result<T, String>) -> Result<T, String> {
        result.map_err(|why| format!("`{}`{why}", self.shown()))
    }

    /// A sum, up to what can be no part of it.
    pub(super) fn sum(&mut self) -> Result<A::Value, String> {
        let mut sum = self.product()?;
        loop {
            let is_plus = self.take('+');
            if !is_plus && !self.take('-') {
                return Ok(sum);
            }
            let by = self.product()?;
            let by = if is_plus {
                by
            } else {
                self.algebra.negative(by)
            };
            let next = self.algebra.sum(sum, by);
            sum = self.named(next)?;
        }
    }

    fn product(&mut self) -> Result<A::Value, String> {
        let mut product = self.signed()?;
        loop {
            let next = if self.take('*') {
                let by = self.signed()?;
                self.algebra.product(&product, &by)
            } else if self.take('/') {
                let by = self.signed()?;
                self.algebra.quotient(product, by)
            } else {
                return Ok(product);
            };
            product = self.named(next)?;
        }
    }

    fn signed(&mut self) -> Result<A::Value, String> {
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(format!(
                "`{}` has too many parentheses or signs in one another",
                self.shown()
            ));
        }
        let value = match (self.take('-'), self.peek()) {
            (true, _) => {
                let value = self.signed()?;
                self.algebra.negative(value)
            }
            (false, Some('+')) => {
                self.at += 1;
                self.signed()?
            }
            _ => self.power()?,
        };
        self.depth -= 1;
        Ok(value)
    }

    /// `x^2`, or `x**2`.
    fn power(&mut self) -> Result<A::Value, String> {
        let base = self.atom()?;
        let is_double = self.peek() == Some('*') && self.text[self.at..].starts_with("**");
        self.at += if is_double { 2 } else { 0 };
        if !is_double && !self.take('^') {
            return Ok(base);
        }
        let power = self.atom()?;
        let power = self.algebra.whole(&power).filter(|&n| n <= MOST_POWER);
        let power = power.ok_or_else(|| {
            format!(
                "`{}`: a power is a whole number from 0 to {MOST_POWER}",
                self.shown()
            )
        })?;
        let one = self.algebra.number(Decimal::from(1));
        let mut value = self.named(one)?;
        for _ in 0..power {
            let next = self.algebra.product(&value, &base);
            value = self.named(next)?;
        }
        Ok(value)
    }

    fn in_parentheses(&mut self) -> Result<A::Value, String> {
        let value = self.sum()?;
        match self.take(')') {
            true => Ok(value),
            false => Err(self.wrong("`)` was expected")),
        }
    }

    fn atom(&mut self) -> Result<A::Value, String> {
        if self.take('(') {
            return self.in_parentheses();
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
                    .map_err(|error: DecimalError| format!("`{}`: {error}", self.shown()))?;
                self.at += end;
                let value = self.algebra.number(number);
                self.named(value)
            }
            Some('|') => {
                let inner = rest[1..].split('|').next().unwrap_or_default();
                if rest.len() < inner.len() + 2 {
                    return Err(format!("`{}`: a second `|` was expected", self.shown()));
                }
                self.at += inner.len() + 2;
                let value = self.algebra.bars(inner.trim());
                self.named(value)
            }
            Some(c) if c.is_alphabetic() || c == '_' => {
                let is_part = |c: char| c.is_alphanumeric() || c == '_';
                let end = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
                let name = &rest[..end];
                self.at += end;
                if name == "sqrt" && self.take('(') {
                    let of = self.in_parentheses()?;
                    let root = self.algebra.root(of);
                    return self.named(root);
                }
                let found = self.algebra.name(name, &self.text[self.at..]);
                let (value, behind) = self.named(found)?;
                self.at += behind;
                Ok(value)
            }
            _ => Err(self.wrong("a number or a name was expected")),
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
            ("width**2/10", "640"),
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
            ("", "a number or a name"),
            ("1e50*1e50", "out of range"),
            ("((((9^20)^20)^20)^20)^20", "too large on the way"),
            (&deep, "in one another"),
            ("sqrt(width)", "in equations only"),
            ("|a-b|", "in equations only"),
            ("|a-b", "a second `|`"),
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
