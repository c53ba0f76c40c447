//! The lines of text that a cover begins with.

use super::CoverError;

/// What is left of a file.
pub struct Lines<'a> {
    rest: &'a [u8],
}

/// That a file is no cover.
pub fn error(what: &str) -> CoverError {
    CoverError(what.to_owned())
}

/// A whole number.
pub fn number(text: Option<&str>) -> Result<usize, CoverError> {
    text.and_then(|t| t.parse().ok())
        .ok_or_else(|| error("a whole number is missing"))
}

/// A number that is not too large to reckon with.
pub fn float(text: &str) -> Result<f64, CoverError> {
    let x: f64 = text.parse().map_err(|_| error("a number is missing"))?;
    match x.abs() <= 1e60 {
        true => Ok(x),
        false => Err(error("a number is out of range")),
    }
}

impl<'a> Lines<'a> {
    /// Of a file that begins with this line and this version.
    pub fn new(bytes: &'a [u8], first: &str, version: u32) -> Result<Self, CoverError> {
        let mut lines = Lines { rest: bytes };
        match lines.line()? == first && lines.line()? == format!("version {version}") {
            true => Ok(lines),
            false => Err(error("another format or version")),
        }
    }

    /// The next line.
    pub fn line(&mut self) -> Result<&'a str, CoverError> {
        let end = self.rest.iter().position(|&b| b == b'\n');
        self.take(end.ok_or_else(|| error("it ends early"))?)
    }

    /// So many bytes of text, and the end of the line behind them.
    fn take(&mut self, length: usize) -> Result<&'a str, CoverError> {
        match self.rest.get(length) {
            Some(b'\n') => {}
            _ => return Err(error("it ends early, or a length is wrong")),
        }
        let text = std::str::from_utf8(&self.rest[..length]);
        self.rest = &self.rest[length + 1..];
        text.map_err(|_| error("a line is not text"))
    }

    /// The power of two that is the unit of length.
    pub fn unit(&mut self) -> Result<i32, CoverError> {
        let exponent = self.line()?.strip_prefix("unit ");
        let exponent = exponent.and_then(|t| t.parse().ok());
        exponent
            .filter(|e: &i32| (-220..=220).contains(e))
            .ok_or_else(|| error("the unit"))
    }

    /// The problem: a line that says how long its text is, and the text.
    pub fn problem(&mut self) -> Result<String, CoverError> {
        let length = number(self.line()?.strip_prefix("problem "))?;
        Ok(self.take(length)?.to_owned())
    }

    /// The bytes behind the last line, which said how many they are.
    pub fn marks(&self, length: Option<&str>) -> Result<&'a [u8], CoverError> {
        match self.rest.len() == number(length)? {
            true => Ok(self.rest),
            false => Err(error("the length of the marks")),
        }
    }
}
