//! What every certificate begins with, and what it holds behind that.

use super::format::{
    FormatError, MAGIC, MAX_PROBLEM, MAX_TEXT, MAX_UNIT_EXPONENT, TAG_COMPLEX_SET, TAG_COVER,
    TAG_COVER_OF_COORDINATES, VERSION,
};
use sha2::{Digest, Sha256};
use std::io::{self, Chain, Cursor, ErrorKind, Read};

type Result<T> = std::result::Result<T, FormatError>;

/// The beginning of a certificate, of which nothing is checked but the hash.
pub(super) struct Head {
    /// The program that wrote the certificate, with its version.
    pub program: String,
    /// SHA-256 of the problem's text.
    pub hash: [u8; 32],
    /// The problem's text.
    pub problem: String,
    /// Lengths in the records are divided by 2 to this power.
    pub unit_exponent: i16,
}

impl Head {
    /// Reads it.
    pub fn read(input: &mut impl Read) -> Result<Head> {
        let mut magic = [0; MAGIC.len()];
        match fill(input, &mut magic, "its first line") {
            Err(FormatError::Truncated(_)) => return Err(FormatError::NotACertificate),
            other => other?,
        }
        if &magic != MAGIC {
            return Err(FormatError::NotACertificate);
        }
        let version = u32::from_le_bytes(array(input, "its version")?);
        if version != VERSION {
            return Err(FormatError::Version(version));
        }
        let program = text(input, MAX_TEXT, "the name of the program")?;
        let hash = array(input, "the hash")?;
        let problem = text(input, MAX_PROBLEM, "the problem")?;
        if hash != <[u8; 32]>::from(Sha256::digest(problem.as_bytes())) {
            return Err(malformed("the hash is not that of the problem"));
        }
        let unit_exponent = i16::from_le_bytes(array(input, "the unit")?);
        if unit_exponent.abs() > MAX_UNIT_EXPONENT {
            return Err(malformed("the unit is out of range"));
        }
        Ok(Head {
            program,
            hash,
            problem,
            unit_exponent,
        })
    }

    /// Reads it from bytes that have a record of one kind behind it, which is all that is left.
    pub fn of_one_record(mut bytes: &[u8], tag: u8) -> Result<(Head, &[u8])> {
        let head = Head::read(&mut bytes)?;
        match bytes.split_first() {
            Some((&first, record)) if first == tag => Ok((head, record)),
            _ => Err(malformed("it is a certificate of another kind")),
        }
    }
}

/// What a certificate claims something about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contents {
    /// A path, or edits: to be checked by [`super::verify`].
    Path,
    /// All figures of a problem: by [`super::cover::verify_cover`].
    Cover,
    /// Complex solutions: by [`super::complex::verify_complex_set`].
    ComplexSet,
}

/// What a certificate is about, and the whole of it to be read (again).
///
/// ```
/// use krawl::certificate::{Contents, Writer, contents};
/// use krawl::complete::{Options, all};
/// use krawl::problem::Problem;
///
/// let triangle = Problem::build("triangle", 2)
///     .point("a", ["0", "0"]).point("b", ["1", "0"]).point("c", ["0.4", "1.1"])
///     .distance("a", "b", "1").distance("b", "c", "1.2").distance("c", "a", "1.3")
///     .finish().unwrap();
/// let result = all(&triangle, &Options { cover: true, ..Options::default() }).unwrap();
/// let cover = result.cover.unwrap();
/// assert_eq!(contents(&cover[..]).unwrap().0, Contents::Cover);
/// assert!(contents(&b"something else"[..]).is_err());
/// ```
pub fn contents<R: Read>(input: R) -> Result<(Contents, Chain<Cursor<Vec<u8>>, R>)> {
    let mut seen = Seen {
        input,
        bytes: Vec::new(),
    };
    Head::read(&mut seen)?;
    // A certificate without any record is that of a path, and refused as such.
    let tag = array(&mut seen, "its first record").map_or(0, |[tag]| tag);
    let contents = match tag {
        TAG_COVER | TAG_COVER_OF_COORDINATES => Contents::Cover,
        TAG_COMPLEX_SET => Contents::ComplexSet,
        _ => Contents::Path,
    };
    Ok((contents, Cursor::new(seen.bytes).chain(seen.input)))
}

/// What is read, and all that was read of it.
struct Seen<R> {
    input: R,
    bytes: Vec<u8>,
}

impl<R: Read> Read for Seen<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.input.read(buffer)?;
        self.bytes.extend(&buffer[..count]);
        Ok(count)
    }
}

pub(super) fn malformed(what: &str) -> FormatError {
    FormatError::Malformed(what.to_owned())
}

pub(super) fn fill(input: &mut impl Read, buffer: &mut [u8], what: &'static str) -> Result<()> {
    input
        .read_exact(buffer)
        .map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof => FormatError::Truncated(what),
            _ => FormatError::Unreadable(error),
        })
}

pub(super) fn array<const N: usize>(input: &mut impl Read, what: &'static str) -> Result<[u8; N]> {
    let mut bytes = [0; N];
    fill(input, &mut bytes, what)?;
    Ok(bytes)
}

pub(super) fn text(input: &mut impl Read, longest: usize, what: &'static str) -> Result<String> {
    let length = u32::from_le_bytes(array(input, what)?) as usize;
    if length > longest {
        return Err(malformed(&format!("{what} is too long: {length} bytes")));
    }
    let mut bytes = vec![0; length];
    fill(input, &mut bytes, what)?;
    String::from_utf8(bytes).map_err(|_| malformed(&format!("{what} is not a text in UTF-8")))
}
