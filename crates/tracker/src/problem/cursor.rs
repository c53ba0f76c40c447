//! A way through the values of a problem file, each of which knows its line and its key.

use super::error::did_you_mean;
use super::file::FileError;
use super::{Decimal, ProblemError};
use crate::constraint::{EQUATIONS, KINDS};
use crate::statement::nearest;
use std::fmt::Display;
use std::ops::Range;
use toml_edit::{Item, Key, TomlError, Value};

pub(super) type Line = Option<usize>;

/// What belongs where most texts stand.
pub(super) const TEXT: &str = "a text in quotes";

/// A text and its name.
pub(super) struct Source<'a> {
    text: &'a str,
    file: &'a str,
    /// Where the lines end.
    line_ends: Vec<usize>,
}

impl<'a> Source<'a> {
    pub(super) fn new(text: &'a str, file: &'a str) -> Self {
        let bytes = text.bytes().enumerate();
        let line_ends = bytes.filter(|&(_, byte)| byte == b'\n').map(|(at, _)| at);
        Source {
            text,
            file,
            line_ends: line_ends.collect(),
        }
    }

    /// The line on which a span begins.
    fn line(&self, span: Option<Range<usize>>) -> Line {
        let start = span?.start;
        Some(1 + self.line_ends.partition_point(|&end| end < start))
    }

    pub(super) fn syntax(&self, error: &TomlError) -> FileError {
        let at = error
            .span()
            .and_then(|span| self.text.get(span))
            .unwrap_or("");
        let at: String = at.trim().chars().take(40).collect();
        let message = match error.message().trim() {
            "duplicate key" => format!("`{at}` is there twice: rename or remove one"),
            // Whole numbers beyond 64 bits; with a point they are read, exactly.
            "integer number overflowed" => {
                format!("`{at}` is too large without a decimal point: write {at}.0")
            }
            // Some of the parser's messages have two lines; krawl's have one.
            message if at.is_empty() => message.replace('\n', ", "),
            message => format!(
                "{} at `{}`",
                message.replace('\n', ", "),
                at.replace('\n', " ")
            ),
        };
        FileError::new(self.file, self.line(error.span()), message)
    }
}

/// A value of a file.
#[derive(Clone)]
pub(super) struct At<'a> {
    source: &'a Source<'a>,
    pub(super) line: Line,
    /// The whole key, with the tables it is in; entries of a list have that of the list.
    pub(super) key: String,
    pub(super) item: &'a Item,
}

impl<'a> At<'a> {
    /// The whole of a file, which has no key.
    pub(super) fn root(source: &'a Source<'a>, item: &'a Item) -> Self {
        At {
            source,
            line: None,
            key: String::new(),
            item,
        }
    }

    /// The same with another key.
    pub(super) fn named(&self, key: impl Into<String>) -> Self {
        let key = key.into();
        At { key, ..*self }
    }

    fn key_of(&self, name: &str) -> String {
        let dot = if self.key.is_empty() { "" } else { "." };
        let shown: String = name.chars().take(60).collect();
        format!("{}{dot}{shown}", self.key)
    }

    /// The value of this name, if it is a table that has one.
    pub(super) fn get(&self, name: &str) -> Option<Self> {
        let (key, item) = self.item.as_table_like()?.get_key_value(name)?;
        Some(At {
            line: self.source.line(Key::span(key)).or(self.line),
            key: self.key_of(name),
            item,
            ..*self
        })
    }

    /// The value of this name, which has to be there.
    pub(super) fn need(&self, name: &str, example: &str) -> Result<Self, FileError> {
        self.get(name).ok_or_else(|| {
            let text = format!("{}: is missing; write {example}", self.key_of(name));
            FileError::new(self.source.file, None, text)
        })
    }

    /// All values of a table, with their names.
    pub(super) fn entries(&self) -> Result<Vec<(&'a str, Self)>, FileError> {
        let wrong = || self.wrong(&format!("a table, [{}]", self.key));
        let table = self.item.as_table_like().ok_or_else(wrong)?;
        let entries = table.iter().map(|(name, _)| Some((name, self.get(name)?)));
        Ok(entries.flatten().collect())
    }

    /// The values of a list, or the tables of several with one heading.
    pub(super) fn values(&self) -> impl Iterator<Item = Self> {
        let all = (0..).map_while(|k| self.item.get(k));
        all.map(|item| At {
            line: self.source.line(item.span()).or(self.line),
            key: self.key.clone(),
            item,
            ..*self
        })
    }

    /// The values of a list in brackets.
    pub(super) fn list(&self, wanted: &str) -> Result<Vec<Self>, FileError> {
        match self.item.is_array() {
            true => Ok(self.values().collect()),
            false => Err(self.wrong(wanted)),
        }
    }

    pub(super) fn text(&self, wanted: &str) -> Result<&'a str, FileError> {
        self.item.as_str().ok_or_else(|| self.wrong(wanted))
    }

    /// The texts of a list.
    pub(super) fn texts(&self, wanted: &str) -> Result<Vec<&'a str>, FileError> {
        let list = self.list(wanted)?;
        list.iter().map(|at| at.text(wanted)).collect()
    }

    pub(super) fn is_number(&self) -> bool {
        self.item.is_integer() || self.item.is_float()
    }

    /// The exact number that the text of the file says.
    pub(super) fn number(&self) -> Result<Decimal, FileError> {
        let span = self.item.span().filter(|_| self.is_number());
        let Some(text) = span.and_then(|span| self.source.text.get(span)) else {
            return Err(self.wrong(match self.item.as_str() {
                Some(text) if text.parse::<Decimal>().is_ok() => "a number without quotes",
                _ => "a number",
            }));
        };
        if text.starts_with("0x") || text.starts_with("0o") || text.starts_with("0b") {
            return Err(self.is_wrong("a decimal number", &format!("`{text}`")));
        }
        // TOML allows underscores between digits, and has checked that they are.
        let number = text.replace('_', "").parse();
        number.map_err(|error| self.fault(error))
    }

    /// Whether it is a table in which all keys have a meaning.
    pub(super) fn known_keys(&self, known: &[&str]) -> Result<(), FileError> {
        for (name, at) in self.entries()? {
            if !known.contains(&name) {
                // A constraint outside of the table where it belongs.
                let is_constraint = ["distances", "squared_distances", "orientation"]
                    .contains(&name)
                    || KINDS.iter().any(|kind| kind.key == name);
                let nearest = match self.key.is_empty() && is_constraint {
                    true => Some(format!("constraints.{name}")),
                    false => nearest(name, &mut known.iter().copied()),
                };
                return Err(at.fault(format!("there is no such key{}", did_you_mean(nearest))));
            }
        }
        Ok(())
    }

    /// Whether it is no list of equations in a table of something else, where everything below a table's heading is.
    pub(super) fn is_in_place(&self, table: &str) -> Result<(), FileError> {
        let mut list = self.item.as_array().into_iter().flatten();
        let is_list = self.item.is_array() && list.all(Value::is_str);
        if self.key != format!("{table}.{EQUATIONS}") || !is_list {
            return Ok(());
        }
        let wanted = "before the first [table] of the file, or under [constraints]";
        let found = format!("in [{table}], as all that follows its heading");
        Err(self.named(EQUATIONS).is_wrong(wanted, &found))
    }

    /// A value that is not what is wanted.
    pub(super) fn wrong(&self, wanted: &str) -> FileError {
        let span = self.item.span();
        let text = span.and_then(|span| self.source.text.get(span));
        let text: String = text.unwrap_or("").chars().take(41).collect();
        let found = match text.as_str() {
            _ if !self.item.is_value() => format!("a {}", self.item.type_name()),
            text if (1..=40).contains(&text.len()) && !text.contains('\n') => format!("`{text}`"),
            _ => format!("a value of type {}", self.item.type_name()),
        };
        self.is_wrong(wanted, &found)
    }

    /// The same where it is said what was found.
    pub(super) fn is_wrong(&self, wanted: &str, found: &str) -> FileError {
        self.fault(format!("must be {wanted}, and is {found}"))
    }

    /// What is wrong here.
    pub(super) fn fault(&self, why: impl Display) -> FileError {
        let text = format!("{}: {why}", self.key);
        FileError::new(self.source.file, self.line, text)
    }

    /// What is wrong with the problem, which is said here.
    pub(super) fn refused(&self, error: ProblemError) -> FileError {
        let mut fault = self.fault(&error);
        if self.key.is_empty() {
            fault.text = error.to_string();
        }
        fault.problem = Some(error);
        fault
    }
}
