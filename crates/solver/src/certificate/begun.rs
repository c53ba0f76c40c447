//! Writing what every certificate begins with.

use super::format::{MAGIC, VERSION};
use sha2::{Digest, Sha256};
use std::io::{self, Write};

/// This program, as it stands in what it writes.
pub(super) const PROGRAM: &str = concat!("krawl ", env!("CARGO_PKG_VERSION"));

/// Writes what stands before the records: the problem as the text of a problem file.
pub fn write_header(
    out: &mut impl Write,
    program: &str,
    problem: &str,
    unit_exponent: i16,
) -> io::Result<()> {
    out.write_all(MAGIC)?;
    out.write_all(&VERSION.to_le_bytes())?;
    write_text(out, program)?;
    out.write_all(&Sha256::digest(problem.as_bytes()))?;
    write_text(out, problem)?;
    out.write_all(&unit_exponent.to_le_bytes())
}

/// The bytes up to a record that is all there is, of this build.
pub(super) fn before_one_record(problem: &str, unit_exponent: i16, tag: u8) -> Vec<u8> {
    let mut out = Vec::new();
    write_header(&mut out, PROGRAM, problem, unit_exponent).expect("a vector takes all bytes");
    out.push(tag);
    out
}

/// A text behind its length.
pub(super) fn write_text(out: &mut impl Write, text: &str) -> io::Result<()> {
    out.write_all(&(text.len() as u32).to_le_bytes())?;
    out.write_all(text.as_bytes())
}
