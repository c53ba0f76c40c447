//! FreeCAD's expressions, as its grammar (`src/App/Expression.y`) reads them: a minus binds closer than a power, so that `-2^2` is 4;
//! powers go from the left, `2^3^2` is 64; a unit behind a number binds closer than both; numbers have a point, and arguments of functions
//! have `;` or `,` between them. What else that grammar has (choices, texts, ranges, lists, vectors) is refused.

use super::quantity::{Quantity, call, operate};

/// Parentheses in one another.
const DEPTH: usize = 20;

/// A number, or why there is none.
pub type Found = Result<Quantity, String>;

/// A name, `Sketch.Constraints.width` or `B1`.
pub struct Path<'a> {
    /// As it is written.
    pub text: &'a str,
    /// Whether it begins with a point, so that it is of the object that has the expression.
    pub is_own: bool,
    pub parts: Vec<Part<'a>>,
}

/// A part of a path.
pub enum Part<'a> {
    Name(&'a str),
    /// As in `<<width of all>>`.
    Label(&'a str),
    /// A number in brackets.
    Index(usize),
}

impl<'a> Path<'a> {
    /// A path alone.
    pub fn read(text: &'a str) -> Result<Self, String> {
        let mut nothing = |_: &Path| Err(String::new());
        let mut reader = Reader::new(text, &mut nothing);
        let path = reader.path()?;
        reader.end().map(|()| path)
    }
}

/// What an expression comes to, where names have these numbers. It asks for all names.
pub fn evaluate(text: &str, named: &mut dyn FnMut(&Path) -> Found) -> Found {
    let mut reader = Reader::new(text, named);
    let value = reader.sum()?;
    reader.end()?;
    reader.fault.map_or(Ok(value), Err)
}

/// What is left of a text, and how deep in it this is.
struct Reader<'a, 'n> {
    rest: &'a str,
    depth: usize,
    /// The first reason why there is no value, though the text can be read.
    fault: Option<String>,
    named: &'n mut dyn FnMut(&Path) -> Found,
}

fn is_letter(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | '@' | '$')
}

fn begins_with_digit(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit())
}

impl<'a, 'n> Reader<'a, 'n> {
    fn new(text: &'a str, named: &'n mut dyn FnMut(&Path) -> Found) -> Self {
        Reader {
            rest: text.trim(),
            depth: 0,
            fault: None,
            named,
        }
    }

    /// A number that goes on as no number where there is none, so that the rest is read, too.
    fn noted(&mut self, found: Found) -> Quantity {
        found.unwrap_or_else(|why| {
            self.fault.get_or_insert(why);
            Quantity::plain(f64::NAN)
        })
    }

    fn wrong<T>(&self, what: &str) -> Result<T, String> {
        let near: String = self.rest.chars().take(20).collect();
        match near.is_empty() {
            true => Err(format!("{what} at its end")),
            false => Err(format!("{what} at `{near}`")),
        }
    }

    fn end(&self) -> Result<(), String> {
        match self.rest.is_empty() {
            true => Ok(()),
            false => self.wrong("it cannot be read"),
        }
    }

    /// Goes on by so many bytes, and past spaces.
    fn skip(&mut self, bytes: usize) -> &'a str {
        let (skipped, rest) = self.rest.split_at(bytes);
        self.rest = rest.trim_start();
        skipped
    }

    fn one_of(&mut self, all: &[&'static str]) -> Option<&'static str> {
        let next = all
            .iter()
            .copied()
            .find(|next| self.rest.starts_with(next))?;
        self.skip(next.len());
        Some(next)
    }

    fn expect(&mut self, wanted: &'static str) -> Result<(), String> {
        match self.one_of(&[wanted]) {
            Some(_) => Ok(()),
            None => self.wrong(&format!("`{wanted}` is expected")),
        }
    }

    /// The letters and digits that come next.
    fn word(&self) -> &'a str {
        let end = self.rest.find(|c| !is_letter(c));
        &self.rest[..end.unwrap_or(self.rest.len())]
    }

    /// Operands with operators between them, from the left.
    fn chain(&mut self, operators: &[&'static str], operand: fn(&mut Self) -> Found) -> Found {
        let mut value = operand(self)?;
        while let Some(operator) = self.one_of(operators) {
            let by = match operator == "/" && Quantity::unit(self.word()).is_some() {
                true => self.unit()?,
                false => operand(self)?,
            };
            value = self.noted(operate(operator, value, by));
        }
        Ok(value)
    }

    fn sum(&mut self) -> Found {
        self.depth += 1;
        if self.depth > DEPTH {
            return self.wrong("too much is in one another");
        }
        let value = self.chain(&["+", "-"], Self::product)?;
        self.depth -= 1;
        Ok(value)
    }

    fn product(&mut self) -> Found {
        self.chain(&["*", "/"], Self::power)
    }

    fn power(&mut self) -> Found {
        self.chain(&["^"], Self::signed)
    }

    fn signed(&mut self) -> Found {
        let mut is_negative = false;
        while let Some(sign) = self.one_of(&["-", "+"]) {
            is_negative ^= sign == "-";
        }
        let value = self.atom()?;
        Ok(if is_negative { value.negative() } else { value })
    }

    fn atom(&mut self) -> Found {
        let word = self.word();
        let value = if self.one_of(&["("]).is_some() {
            let inner = self.sum()?;
            self.expect(")")?;
            inner
        } else if begins_with_digit(self.rest.strip_prefix('.').unwrap_or(self.rest)) {
            Quantity::plain(self.number()?)
        } else if let Some(constant) = Quantity::constant(word) {
            self.skip(word.len());
            constant
        } else if !word.is_empty() && self.rest[word.len()..].starts_with('(') {
            return self.function(word);
        } else {
            let path = self.path()?;
            let found = (self.named)(&path);
            return Ok(self.noted(found));
        };
        match self
            .rest
            .starts_with(|c| is_letter(c) || "'\"°".contains(c))
        {
            true => {
                let unit = self.unit()?;
                Ok(self.noted(operate("*", value, unit)))
            }
            false => Ok(value),
        }
    }

    fn number(&mut self) -> Result<f64, String> {
        let rest = self.rest;
        let digits = |from: usize| {
            let others = rest[from..].trim_start_matches(|c: char| c.is_ascii_digit());
            rest.len() - others.len()
        };
        let mut end = digits(0);
        if rest[end..].starts_with('.') {
            end = digits(end + 1);
        }
        if rest[end..].starts_with(['e', 'E']) {
            let sign = usize::from(rest[end + 1..].starts_with(['+', '-']));
            let exponent = end + 1 + sign;
            if begins_with_digit(&rest[exponent..]) {
                end = digits(exponent);
            }
        }
        match rest[..end].parse() {
            Ok(number) if !rest[..end].ends_with('.') => {
                self.skip(end);
                Ok(number)
            }
            _ => self.wrong("a number is expected"),
        }
    }

    /// A unit, to a power or not.
    fn unit(&mut self) -> Found {
        let word = match self.rest.chars().next() {
            Some(c) if !is_letter(c) => &self.rest[..c.len_utf8()],
            _ => self.word(),
        };
        let Some(unit) = Quantity::unit(word) else {
            return self.wrong("there is no unit of lengths or angles that is known");
        };
        self.skip(word.len());
        if self.one_of(&["^"]).is_none() {
            return Ok(unit);
        }
        let is_negative = self.one_of(&["-"]).is_some();
        let power = Quantity::plain(self.number()?);
        let power = if is_negative { power.negative() } else { power };
        Ok(self.noted(operate("^", unit, power)))
    }

    fn function(&mut self, name: &str) -> Found {
        self.skip(name.len() + 1);
        let mut of = Vec::new();
        loop {
            of.push(self.sum()?);
            if self.one_of(&[")"]).is_some() {
                return Ok(self.noted(call(name, &of)));
            }
            if self.rest.strip_prefix(',').is_some_and(begins_with_digit) {
                return self.wrong("a comma before a digit is read as a point");
            }
            if self.one_of(&[";", ","]).is_none() {
                return self.wrong("`;` or `)` is expected");
            }
        }
    }

    fn path(&mut self) -> Result<Path<'a>, String> {
        let begin = self.rest;
        let is_own = self.one_of(&["."]).is_some();
        let mut parts = vec![self.part()?];
        while let Some(next) = self.one_of(&[".", "["]) {
            if next == "." {
                parts.push(self.part()?);
                continue;
            }
            let digits = self.word();
            let Ok(index) = digits.parse() else {
                return self.wrong("a number is expected in brackets");
            };
            parts.push(Part::Index(index));
            self.skip(digits.len());
            self.expect("]")?;
        }
        if self.rest.starts_with(['#', '(']) {
            return self.wrong("there is another document, or what is no function,");
        }
        Ok(Path {
            text: begin[..begin.len() - self.rest.len()].trim_end(),
            is_own,
            parts,
        })
    }

    fn part(&mut self) -> Result<Part<'a>, String> {
        if let Some(inner) = self.rest.strip_prefix("<<") {
            let inner = inner.split_once(">>").map(|(inner, _)| inner);
            return match inner.filter(|inner| !inner.contains('\\')) {
                Some(inner) => {
                    self.skip(inner.len() + 4);
                    Ok(Part::Label(inner))
                }
                None => self.wrong("there is a label that is not read"),
            };
        }
        let word = self.word();
        match word.is_empty() || begins_with_digit(word) {
            true => self.wrong("a number or a name is expected"),
            false => Ok(Part::Name(self.skip(word.len()))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The value of an expression where `a` is 20 mm, `Constraints.b` 30 degrees and `<<a sheet>>.n` 7.
    fn value(text: &str) -> Result<Quantity, String> {
        evaluate(text, &mut |path| match path.text {
            "a" => Ok(Quantity::length(20.0)),
            "Constraints.b" | ".Constraints.b" | "Constraints[3]" => Ok(Quantity::angle(30.0)),
            "<<a sheet>>.n" => Ok(Quantity::plain(7.0)),
            other => Err(format!("there is no `{other}`")),
        })
    }

    #[test]
    fn expressions_are_read_as_freecad_reads_them() {
        for (text, wanted) in [
            // `%left '^'` stands before `%precedence NEG`: a sign binds closer, and powers go from the left.
            ("-2 ^ 2", "4"),
            ("2 ^ 3 ^ 2", "64"),
            ("2 ^ -1", "0.5"),
            ("-(2 ^ 2)", "-4"),
            ("2 + 3 * 4 - 6 / 3", "12"),
            ("8 / 4 / 2", "1"),
            ("--3", "3"),
            // Units bind closer than operators, and stand behind a division, too.
            ("2 mm ^ 2", "2 mm^2"),
            ("10 mm / 4 mm", "2.5"),
            ("a / mm + 1", "21"),
            ("a / 1 mm", "20"),
            ("1 in + 1 cm", "35.4 mm"),
            ("1' + 2\"", "355.6 mm"),
            ("2 m", "2000 mm"),
            ("(2 + 3) mm", "5 mm"),
            ("pi rad", "180 deg"),
            ("0.5 rad * 2 / rad", "1"),
            (".5 + 1e1", "10.5"),
            ("a / 2 + 2 mm", "12 mm"),
            ("a*sin(.Constraints.b)", "9.999999999999998 mm"),
            ("sin(30)", "0.49999999999999994"),
            ("Constraints[3] / 2", "15 deg"),
            ("<<a sheet>>.n * a", "140 mm"),
            ("atan2(1 mm; 1 mm)", "45 deg"),
            ("hypot(3 mm; 4 mm)", "5 mm"),
            ("sqrt(16 mm^2)", "4 mm"),
            ("pow(a; 2) / a", "20 mm"),
            ("min(3; 2; 5) + max(1, a / mm)", "22"),
            ("abs(-a)", "20 mm"),
        ] {
            assert_eq!(
                value(text).map(|q| q.to_string()),
                Ok(wanted.to_owned()),
                "{text}"
            );
        }
    }

    #[test]
    fn what_has_no_value_says_why() {
        for (text, words) in [
            ("a + 1", "units of 20 mm and 1 do not fit"),
            ("a * Constraints.b + a", "do not fit"),
            ("2 kg", "no unit of lengths or angles"),
            ("a mm", "cannot be read at `mm`"),
            ("sin(a)", "takes an angle"),
            ("asin(a)", "no number with a unit"),
            ("asin(2)", "no such number"),
            ("sqrt(a)", "no root with a unit"),
            ("sqrt(-1)", "no such number"),
            ("a ^ 0.5", "power of 0.5"),
            ("2 ^ a", "power of 20 mm"),
            ("1 / 0", "divides by zero"),
            // What rounding decides is not read.
            ("floor(Constraints.b / 10 deg)", "no function `floor`"),
            ("7 % 4", "cannot be read at `% 4`"),
            ("a > 15 mm ? 1 mm : 2 mm", "cannot be read at `> 15"),
            ("hypot(3)", "no function `hypot` of 1 number"),
            ("vector(1; 2; 3)", "no function `vector`"),
            ("Pad.Length", "there is no `Pad.Length`"),
            ("Other#Sketch.Constraints.b", "another document"),
            ("max(1,2)", "comma"),
            ("3 ? 1 : 2", "cannot be read at `? 1 : 2`"),
            ("<<text>>.n.", "a number or a name is expected at its end"),
            ("(1 + 2", "`)` is expected at its end"),
            ("", "expected at its end"),
            ("5. + 1", "number is expected"),
        ] {
            let error = value(text).unwrap_err();
            assert!(error.contains(words), "{text}: {error}");
        }
        assert!(value(&"(".repeat(2000)).is_err());
        assert!(value(&"-".repeat(200_000)).is_err());
        assert!(value(&format!("1{}", "+1".repeat(200_000))).is_ok());
    }

    proptest! {
        /// No text makes it panic.
        #[test]
        fn no_text_panics(text in "[-+*/^%().;,<>=?:#|0-9a-eimnpt\\[\\]\"' °µ]{0,30}") {
            let _ = value(&text);
        }
    }
}
