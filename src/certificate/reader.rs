//! Reading certificates, record by record.

use super::format::{
    EndClaim, FormatError, Header, MAGIC, MAX_FREE_COORDINATES, MAX_NUMBER, MAX_PROBLEM,
    MAX_SOLUTIONS, MAX_TEXT, MAX_UNIT_EXPONENT, Record, SolutionClaim, TAG_END,
    TAG_MOVING_KRAWCZYK, TAG_SOLUTION, TubeClaim, VERSION,
};
use crate::constraint;
use crate::problem::Problem;
use sha2::{Digest, Sha256};
use std::io::{ErrorKind, Read};

/// Reads a certificate from a stream. Memory is bounded by one record, whatever the file says.
///
/// ```
/// use krawl::certificate::{FormatError, Reader};
/// assert!(matches!(Reader::new(&b"something else"[..]), Err(FormatError::NotACertificate)));
/// ```
#[derive(Debug)]
pub struct Reader<R> {
    input: R,
    header: Header,
    /// The number m of unknowns without t.
    unknowns: usize,
    tubes: u64,
    solutions: usize,
    ended: bool,
}

type Result<T> = std::result::Result<T, FormatError>;

impl<R: Read> Reader<R> {
    /// Reads the header.
    pub fn new(mut input: R) -> Result<Self> {
        let mut magic = [0; MAGIC.len()];
        match fill(&mut input, &mut magic, "its first line") {
            Err(FormatError::Truncated(_)) => return Err(FormatError::NotACertificate),
            other => other?,
        }
        if &magic != MAGIC {
            return Err(FormatError::NotACertificate);
        }
        let version = u32::from_le_bytes(array(&mut input, "its version")?);
        if version != VERSION {
            return Err(FormatError::Version(version));
        }
        let program = text(&mut input, MAX_TEXT, "the name of the program")?;
        let hash = array(&mut input, "the hash")?;
        let source = text(&mut input, MAX_PROBLEM, "the problem")?;
        if hash != <[u8; 32]>::from(Sha256::digest(source.as_bytes())) {
            return Err(malformed("the hash is not that of the problem"));
        }
        let problem = Problem::parse(&source, "the problem in the certificate")
            .map_err(|error| FormatError::Malformed(error.to_string()))?;
        let free = problem.free_coordinates();
        let unknowns = match problem.constraints.is_empty() && problem.objects.is_empty() {
            true => free,
            false => constraint::size(&problem).0,
        };
        if free.max(unknowns) > MAX_FREE_COORDINATES {
            return Err(FormatError::Malformed(format!(
                "the problem has {unknowns} free coordinates, more than the {MAX_FREE_COORDINATES} that are read"
            )));
        }
        let unit_exponent = i16::from_le_bytes(array(&mut input, "the unit")?);
        if unit_exponent.abs() > MAX_UNIT_EXPONENT {
            return Err(malformed("the unit is out of range"));
        }
        Ok(Reader {
            input,
            header: Header {
                program,
                problem,
                hash,
                unit_exponent,
            },
            unknowns,
            tubes: 0,
            solutions: 0,
            ended: false,
        })
    }

    /// What stands before the records.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The next record; `None` after the end.
    pub fn next_record(&mut self) -> Result<Option<Record>> {
        if self.ended {
            return Ok(None);
        }
        let [tag] = array(&mut self.input, "the chain of tubes")?;
        let record = match tag {
            TAG_MOVING_KRAWCZYK => Record::Tube(self.tube()?),
            TAG_SOLUTION => Record::Solution(self.solution()?),
            TAG_END => Record::End(self.end()?),
            _ => return Err(self.fault(&format!("there is no kind {tag} of record"))),
        };
        Ok(Some(record))
    }

    fn tube(&mut self) -> Result<TubeClaim> {
        const WHAT: &str = "a tube";
        let n = self.unknowns + 1;
        let input = &mut self.input;
        let tube = TubeClaim {
            centre: floats(input, n, WHAT)?,
            normal: (0..n)
                .map(|_| Ok(f32::from_le_bytes(array(input, WHAT)?)))
                .collect::<Result<_>>()?,
            weights: (0..n)
                .map(|_| Ok(u16::from_le_bytes(array(input, WHAT)?)))
                .collect::<Result<_>>()?,
            h: f64::from_le_bytes(array(input, WHAT)?),
            r: f32::from_le_bytes(array(input, WHAT)?),
            exit: f64::from_le_bytes(array(input, WHAT)?),
        };
        let centre = tube.centre.iter().all(|&x| in_range(x));
        let normal = tube.normal.iter().all(|&x| in_range(x.into()));
        if !(centre && normal) {
            return Err(self.fault("a coordinate is out of range"));
        }
        if tube.weights.contains(&0) {
            return Err(self.fault("a weight is zero"));
        }
        let positive = |x: f64| x > 0.0 && in_range(x);
        if !(positive(tube.h) && positive(tube.r.into())) {
            return Err(self.fault("its length or its radius is not positive"));
        }
        if tube.exit.is_nan() || tube.exit.abs() > tube.h {
            return Err(self.fault("its exit is beyond its end"));
        }
        self.tubes += 1;
        Ok(tube)
    }

    fn solution(&mut self) -> Result<SolutionClaim> {
        const WHAT: &str = "a solution";
        let m = self.unknowns;
        let solution = SolutionClaim {
            centre: floats(&mut self.input, m, WHAT)?,
            radius: f32::from_le_bytes(array(&mut self.input, WHAT)?),
        };
        let numbers = solution.centre.iter().all(|&x| in_range(x));
        let radius = f64::from(solution.radius);
        if !(numbers && radius > 0.0 && in_range(radius)) {
            return Err(self.fault("a coordinate of a solution is out of range"));
        }
        if self.tubes == 0 {
            return Err(self.fault("a solution stands before the first tube"));
        }
        self.solutions += 1;
        if self.solutions > MAX_SOLUTIONS {
            return Err(self.fault("there are too many solutions"));
        }
        Ok(solution)
    }

    fn end(&mut self) -> Result<EndClaim> {
        const WHAT: &str = "its end";
        let input = &mut self.input;
        let stopped = match array(input, WHAT)? {
            [0] => None,
            [1] => Some(text(input, MAX_TEXT, WHAT)?),
            _ => return Err(malformed("its end is neither closed nor stopped")),
        };
        let tubes = u64::from_le_bytes(array(input, WHAT)?);
        let count = u32::from_le_bytes(array(input, WHAT)?);
        if tubes != self.tubes || count as usize != self.solutions {
            return Err(malformed(&format!(
                "its end counts {tubes} tubes and {count} solutions, and there are {} and {}",
                self.tubes, self.solutions
            )));
        }
        let classes = (0..count)
            .map(|_| Ok(u32::from_le_bytes(array(input, WHAT)?)))
            .collect::<Result<_>>()?;
        match fill(input, &mut [0], WHAT) {
            Err(FormatError::Truncated(_)) => {}
            Err(error) => return Err(error),
            Ok(()) => return Err(malformed("something stands behind its end")),
        }
        self.ended = true;
        Ok(EndClaim {
            stopped,
            tubes,
            classes,
        })
    }

    fn fault(&self, what: &str) -> FormatError {
        malformed(&format!("after {} tubes: {what}", self.tubes))
    }
}

fn malformed(what: &str) -> FormatError {
    FormatError::Malformed(what.to_owned())
}

/// False for a NaN.
fn in_range(x: f64) -> bool {
    x.abs() <= MAX_NUMBER
}

fn fill(input: &mut impl Read, buffer: &mut [u8], what: &'static str) -> Result<()> {
    input
        .read_exact(buffer)
        .map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof => FormatError::Truncated(what),
            _ => FormatError::Unreadable(error),
        })
}

fn array<const N: usize>(input: &mut impl Read, what: &'static str) -> Result<[u8; N]> {
    let mut bytes = [0; N];
    fill(input, &mut bytes, what)?;
    Ok(bytes)
}

fn floats(input: &mut impl Read, count: usize, what: &'static str) -> Result<Vec<f64>> {
    (0..count)
        .map(|_| Ok(f64::from_le_bytes(array(input, what)?)))
        .collect()
}

fn text(input: &mut impl Read, longest: usize, what: &'static str) -> Result<String> {
    let length = u32::from_le_bytes(array(input, what)?) as usize;
    if length > longest {
        return Err(malformed(&format!("{what} is too long: {length} bytes")));
    }
    let mut bytes = vec![0; length];
    fill(input, &mut bytes, what)?;
    String::from_utf8(bytes).map_err(|_| malformed(&format!("{what} is not a text in UTF-8")))
}
