//! The lines of text that the record of a cover begins with.

use super::CoverError;
use crate::certificate::head::Head;

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
    /// Of the record with this tag, and what stands before it.
    pub fn new(bytes: &'a [u8], tag: u8) -> Result<(Head, Self), CoverError> {
        let opened = Head::of_one_record(bytes, tag);
        let (head, rest) = opened.map_err(|what| error(&what.to_string()))?;
        Ok((head, Lines { rest }))
    }

    /// The next line.
    pub fn line(&mut self) -> Result<&'a str, CoverError> {
        let end = self.rest.iter().position(|&b| b == b'\n');
        let end = end.ok_or_else(|| error("it ends early"))?;
        let text = std::str::from_utf8(&self.rest[..end]);
        self.rest = &self.rest[end + 1..];
        text.map_err(|_| error("a line is not text"))
    }

    /// The bytes behind the last line, which said how many they are.
    pub fn marks(&self, length: Option<&str>) -> Result<&'a [u8], CoverError> {
        match self.rest.len() == number(length)? {
            true => Ok(self.rest),
            false => Err(error("the length of the marks")),
        }
    }
}
