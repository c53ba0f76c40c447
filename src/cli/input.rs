//! Reading problems from files and from standard input.

use krawl::problem::{MAX_FILE_SIZE, Problem};
use std::io::{self, Read};
use std::path::Path;

/// What `-` stands for, in messages.
const STANDARD_INPUT: &str = "standard input";

/// Reads a problem file, or standard input for `-`. The text of the error says what is wrong, and where.
pub fn read(file: &Path) -> Result<Problem, String> {
    if file != Path::new("-") {
        return Problem::read(file).map_err(|error| error.to_string());
    }
    let mut text = String::new();
    io::stdin()
        .lock()
        // One byte more than allowed tells that there is too much.
        .take(MAX_FILE_SIZE + 1)
        .read_to_string(&mut text)
        .map_err(|error| format!("{STANDARD_INPUT}: cannot be read: {error}"))?;
    if text.len() as u64 > MAX_FILE_SIZE {
        return Err(format!(
            "{STANDARD_INPUT}: is larger than the {} KiB that are read",
            MAX_FILE_SIZE >> 10
        ));
    }
    Problem::parse(&text, STANDARD_INPUT).map_err(|error| error.to_string())
}

/// What a problem file is called in messages.
pub fn name(file: &Path) -> String {
    match file == Path::new("-") {
        true => STANDARD_INPUT.to_owned(),
        false => file.display().to_string(),
    }
}

/// Refuses `-` twice: standard input can be read once.
pub fn only_one_standard_input<'a>(
    files: impl IntoIterator<Item = &'a Path>,
) -> Result<(), String> {
    let dashes = files.into_iter().filter(|&file| file == Path::new("-"));
    match dashes.count() {
        0 | 1 => Ok(()),
        _ => Err(format!(
            "`-`, {STANDARD_INPUT}, is named twice: it can be read once"
        )),
    }
}
