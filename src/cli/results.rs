//! Where the results of a run go.

use super::output::{self, Destination, beside};
use super::pictures::{Pictures, Places};
use krawl::report::Document;
use krawl::report::page::Page;
use std::path::{Path, PathBuf};

/// The places that are named for results, looked for before a run begins, and whether all could be written so far.
pub struct Results<'a> {
    json: Option<Destination>,
    csv: Option<Destination>,
    /// For pages and pictures.
    pub pictures: Places<'a>,
    quiet: bool,
    is_written: bool,
}

impl<'a> Results<'a> {
    /// Says early that something cannot be written where it is wanted: where it is not possible, or where one of the files is that are read.
    pub fn open<'f>(
        read: impl IntoIterator<Item = &'f PathBuf> + Clone,
        [json, csv]: [Option<&Path>; 2],
        pictures: impl Into<Option<&'a Pictures>>,
        quiet: bool,
    ) -> Result<Self, String> {
        let pictures = pictures
            .into()
            .map(|pictures| pictures.places(read.clone()));
        let results = Results {
            json: beside(read.clone(), json)?,
            csv: beside(read, csv)?,
            pictures: pictures.transpose()?.unwrap_or_default(),
            quiet,
            is_written: true,
        };
        match results.on_standard_output() {
            0 | 1 => Ok(results),
            _ => Err(
                "only one result can go to standard output, `-`: name files for the others"
                    .to_owned(),
            ),
        }
    }

    /// How many results go to standard output.
    pub fn on_standard_output(&self) -> usize {
        let named = [&self.json, &self.csv].into_iter().flatten();
        let named = named.filter(|one| **one == Destination::StandardOutput);
        named.count() + usize::from(self.pictures.use_standard_output())
    }

    /// Whether people are told: they want to be, and no result goes to standard output.
    pub fn is_told(&self) -> bool {
        !self.quiet && self.on_standard_output() == 0
    }

    /// Whether JSON is wanted.
    pub fn has_json(&self) -> bool {
        self.json.is_some()
    }

    /// Whether results are written, as JSON or as pictures.
    pub fn are_written(&self) -> bool {
        self.has_json() || !self.pictures.is_empty()
    }

    /// Whether people are told, or programs.
    pub fn are_read(&self) -> bool {
        self.is_told() || self.has_json()
    }

    /// Takes note whether something else could be written.
    pub fn note(&mut self, is_written: bool) {
        self.is_written &= is_written;
    }

    /// Writes a result, which is made where it is wanted, as JSON and as pictures.
    pub fn write(&mut self, result: impl FnOnce() -> Document) -> Result<(), String> {
        if !self.are_written() {
            return Ok(());
        }
        let result = result();
        self.write_json(|| result.to_json() + "\n");
        self.write_page(&result)
    }

    /// Writes JSON that is made where it is wanted.
    pub fn write_json(&mut self, text: impl FnOnce() -> String) {
        let json = self.json.as_ref();
        self.is_written &= json.is_none_or(|json| json.write(&text()));
    }

    /// Writes CSV that is made where it is wanted.
    pub fn write_csv(&mut self, text: impl FnOnce() -> String) {
        let csv = self.csv.as_ref();
        self.is_written &= csv.is_none_or(|csv| csv.write(&text()));
    }

    /// Writes a result as pictures alone.
    pub fn write_page(&mut self, result: &Document) -> Result<(), String> {
        if !self.pictures.is_empty() {
            let page = Page::of(result).map_err(|error| error.to_string())?;
            self.is_written &= self.pictures.write(&page);
        }
        Ok(())
    }

    /// Prints what people are told.
    pub fn print(&mut self, text: impl FnOnce() -> String) {
        if self.is_told() {
            self.is_written &= output::print(&text());
        }
    }

    /// Prints a table, or where a result goes to standard output says on standard error in a sentence what is proved.
    pub fn print_or_say(&mut self, table: impl FnOnce() -> String, words: impl FnOnce() -> String) {
        match self.on_standard_output() {
            0 => self.print(table),
            _ if self.quiet => {}
            _ => output::complain(&words()),
        }
    }

    /// The exit code of a run that came to this one, if all could be written.
    pub fn code(&self, code: u8) -> u8 {
        output::code(self.is_written, code)
    }
}
