//! Reading certificates, record by record.

use super::format::{
    ArcClaim, EndClaim, Ending, FoldClaim, FormatError, Header, MAX_DECIMAL, MAX_FREE_COORDINATES,
    MAX_LISTED, MAX_NUMBER, MAX_SOLUTIONS, MAX_TEXT, Record, SolutionClaim, TAG_ARC,
    TAG_ARC_OF_DIMENSIONS, TAG_DIVIDE, TAG_END, TAG_EXTENDED, TAG_FOLD, TAG_MOTION, TAG_REACHED,
    TAG_RETURN, TAG_SOLUTION, TAG_TUBE, TAG_TURN, TubeClaim,
};
use super::head::{Head, array, fill, malformed, text};
use crate::constraint;
use crate::problem::{Decimal, Problem};
use crate::system::Heights;
use std::io::Read;

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
    /// The number m of unknowns without t, of the equations that the next tube is about.
    unknowns: usize,
    /// The same of the other equations, given or divided, once there were tubes of those.
    others: Option<usize>,
    tubes: u64,
    solutions: usize,
    stage: Stage,
    /// Whether an arc led a dimension, and whether what follows is a motion.
    has_led: bool,
    is_motion: bool,
}

/// What may stand next.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stage {
    /// The first record.
    Begun,
    /// Tubes and solutions of a path; after the turn if so, and with heights divided by 1 − t if so.
    Path { turned: bool, divided: bool },
    /// The first tube behind the turn, or of other equations.
    Changed { turned: bool, divided: bool },
    /// The first tube of an arc.
    Arc,
    /// Tubes of an arc, or its end.
    Along,
    /// The next arc, or the end.
    Reached,
    /// The end.
    Fold,
    /// Nothing.
    Ended,
}

type Result<T> = std::result::Result<T, FormatError>;

impl<R: Read> Reader<R> {
    /// Reads the header.
    pub fn new(mut input: R) -> Result<Self> {
        let head = Head::read(&mut input)?;
        let problem = Problem::parse(&head.problem, "the problem in the certificate")
            .map_err(|error| FormatError::Malformed(error.to_string()))?;
        let free = problem.free_coordinates();
        let unknowns = match problem.constraints.is_empty() && problem.objects.is_empty() {
            true => free,
            false => constraint::size(&problem).0,
        };
        check_size(free.max(unknowns))?;
        Ok(Reader {
            input,
            header: Header {
                program: head.program,
                problem,
                hash: head.hash,
                unit_exponent: head.unit_exponent,
            },
            unknowns,
            others: None,
            tubes: 0,
            solutions: 0,
            stage: Stage::Begun,
            has_led: false,
            is_motion: false,
        })
    }

    /// What stands before the records.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The next record; `None` after the end.
    pub fn next_record(&mut self) -> Result<Option<Record>> {
        if self.stage == Stage::Ended {
            return Ok(None);
        }
        let [tag] = array(&mut self.input, "the chain of tubes")?;
        let path = |turned, divided| Stage::Path { turned, divided };
        let changed = |turned, divided| Stage::Changed { turned, divided };
        self.stage = match (tag, self.stage) {
            (TAG_TUBE | TAG_EXTENDED, Stage::Begun) => path(false, false),
            (TAG_TUBE | TAG_EXTENDED, Stage::Changed { turned, divided }) => path(turned, divided),
            (TAG_TUBE | TAG_EXTENDED, Stage::Arc) => Stage::Along,
            (TAG_TUBE | TAG_EXTENDED, stage @ (Stage::Path { .. } | Stage::Along)) => stage,
            (TAG_SOLUTION, stage @ Stage::Path { .. }) => stage,
            (TAG_TURN, stage) if stage == path(false, false) => changed(true, false),
            (TAG_DIVIDE, Stage::Path { turned, divided }) if !divided && !self.is_motion => {
                changed(turned, true)
            }
            (TAG_RETURN, Stage::Path { turned, divided }) if divided => changed(turned, false),
            (TAG_ARC | TAG_ARC_OF_DIMENSIONS, Stage::Begun | Stage::Reached) => Stage::Arc,
            (TAG_REACHED, Stage::Along) => Stage::Reached,
            (TAG_FOLD, Stage::Along) => Stage::Fold,
            (TAG_MOTION, Stage::Begun | Stage::Reached) if !self.has_led => changed(false, false),
            (TAG_END, stage) => stage,
            (1..=TAG_MOTION, _) => {
                return Err(self.fault(&format!("a record of kind {tag} may not stand here")));
            }
            _ => return Err(self.fault(&format!("there is no kind {tag} of record"))),
        };
        let is_of_distances = self.header.problem.is_distances_only();
        let record = match tag {
            TAG_SOLUTION => Record::Solution(self.solution()?),
            TAG_TURN => Record::Turn,
            TAG_DIVIDE => self.change(Record::Divide)?,
            TAG_RETURN => self.change(Record::Return)?,
            TAG_ARC | TAG_ARC_OF_DIMENSIONS => {
                let claim = self.arc(tag == TAG_ARC_OF_DIMENSIONS)?;
                self.has_led |= !claim.dimensions.is_empty();
                Record::Arc(claim)
            }
            TAG_MOTION => {
                let claim = self.arc(!is_of_distances)?;
                if claim.dimensions.len() != 1 || !claim.kept.is_empty() {
                    return Err(malformed(
                        "a motion leads one dimension, and claims no signs",
                    ));
                }
                self.is_motion = true;
                Record::Motion(claim)
            }
            TAG_REACHED => Record::Reached(self.figure()?),
            TAG_FOLD => Record::Fold(self.fold()?),
            TAG_END => Record::End(self.end()?),
            _ => Record::Tube(self.tube(tag == TAG_EXTENDED)?),
        };
        Ok(Some(record))
    }

    /// What follows is about the other equations.
    fn change(&mut self, record: Record) -> Result<Record> {
        let divided = || Heights::size(&self.header.problem);
        let others = self.others.or_else(divided).ok_or(malformed(
            "its problem has no equations with heights divided by 1 − t",
        ))?;
        check_size(others)?;
        self.others = Some(std::mem::replace(&mut self.unknowns, others));
        Ok(record)
    }

    fn tube(&mut self, extended: bool) -> Result<TubeClaim> {
        const WHAT: &str = "a tube";
        let n = self.unknowns + 1;
        let input = &mut self.input;
        let tube = TubeClaim {
            centre: numbers(input, n, f64::from_le_bytes, WHAT)?,
            low: numbers(
                input,
                if extended { n } else { 0 },
                f64::from_le_bytes,
                WHAT,
            )?,
            normal: numbers(input, n, f32::from_le_bytes, WHAT)?,
            weights: numbers(input, n, u16::from_le_bytes, WHAT)?,
            h: f64::from_le_bytes(array(input, WHAT)?),
            r: f32::from_le_bytes(array(input, WHAT)?),
            exit: f64::from_le_bytes(array(input, WHAT)?),
        };
        let centre = tube.centre.iter().chain(&tube.low).all(|&x| in_range(x));
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
        self.solutions += 1;
        if self.solutions > MAX_SOLUTIONS {
            return Err(self.fault("there are too many solutions"));
        }
        self.figure()
    }

    fn figure(&mut self) -> Result<SolutionClaim> {
        const WHAT: &str = "a solution";
        let figure = SolutionClaim {
            centre: numbers(&mut self.input, self.unknowns, f64::from_le_bytes, WHAT)?,
            radius: f32::from_le_bytes(array(&mut self.input, WHAT)?),
        };
        let numbers = figure.centre.iter().all(|&x| in_range(x));
        if !(numbers && is_radius(figure.radius)) {
            return Err(self.fault("a coordinate of a solution is out of range"));
        }
        Ok(figure)
    }

    fn fold(&mut self) -> Result<FoldClaim> {
        const WHAT: &str = "a fold";
        let fold = FoldClaim {
            figure: self.figure()?,
            t: f64::from_le_bytes(array(&mut self.input, WHAT)?),
            t_radius: f32::from_le_bytes(array(&mut self.input, WHAT)?),
        };
        if !(in_range(fold.t) && is_radius(fold.t_radius)) {
            return Err(self.fault("the t of a fold is out of range"));
        }
        Ok(fold)
    }

    fn arc(&mut self, is_general: bool) -> Result<ArcClaim> {
        const WHAT: &str = "an arc";
        let (dimensions, kept) = (Vec::new(), Vec::new());
        let mut claim = ArcClaim {
            is_general,
            dimensions,
            kept,
        };
        let (problem, input) = (&self.header.problem, &mut self.input);
        if is_general == problem.is_distances_only() {
            return Err(malformed(match is_general {
                true => "an arc of any dimensions is one of a problem with more than distances",
                false => {
                    "its problem has more than distances, and arcs of such problems are written otherwise now"
                }
            }));
        }
        if is_general && self.tubes == 0 {
            self.unknowns = constraint::size_in_edits(problem);
            check_size(self.unknowns)?;
        }
        let (distances, points) = (problem.distances.len(), problem.points.len());
        let all = distances + problem.constraints.len();
        for _ in 0..count(input, all)? {
            let index = count(input, all.saturating_sub(1))?;
            let value = text(input, MAX_DECIMAL, "a dimension")?.parse::<Decimal>();
            let value =
                value.map_err(|error| malformed(&format!("an arc's dimension: {error}")))?;
            if !problem.dimensions().any(|d| d == index as usize) {
                return Err(malformed("an arc leads what is no dimension"));
            }
            if (index as usize) < distances && !value.is_positive() {
                return Err(malformed("an arc's length is not positive"));
            }
            if claim.dimensions.iter().any(|(other, _)| *other == index) {
                return Err(malformed("an arc leads a dimension twice"));
            }
            claim.dimensions.push((index, value));
        }
        for _ in 0..count(input, MAX_LISTED)? {
            let corners = 0..=problem.dimension;
            let corners = corners.map(|_| count(input, points.saturating_sub(1)));
            let corners = corners.collect::<Result<_>>()?;
            match array(input, WHAT)? {
                [sign @ (0 | 1)] => claim.kept.push((corners, sign == 1)),
                _ => return Err(malformed("a sign in an arc is neither 0 nor 1")),
            }
        }
        Ok(claim)
    }

    fn end(&mut self) -> Result<EndClaim> {
        const WHAT: &str = "its end";
        let input = &mut self.input;
        let ending = match array(input, WHAT)? {
            [0] => Ending::Complete,
            [1] => Ending::Stopped(text(input, MAX_TEXT, WHAT)?),
            [2] => Ending::Open([text(input, MAX_TEXT, WHAT)?, text(input, MAX_TEXT, WHAT)?]),
            _ => return Err(malformed("there is no such way to end")),
        };
        let tubes = u64::from_le_bytes(array(input, WHAT)?);
        let count = u32::from_le_bytes(array(input, WHAT)?);
        if tubes != self.tubes || count as usize != self.solutions {
            return Err(malformed(&format!(
                "its end counts {tubes} tubes and {count} solutions, and there are {} and {}",
                self.tubes, self.solutions
            )));
        }
        let classes = numbers(input, count as usize, u32::from_le_bytes, WHAT)?;
        match fill(input, &mut [0], WHAT) {
            Err(FormatError::Truncated(_)) => {}
            Err(error) => return Err(error),
            Ok(()) => return Err(malformed("something stands behind its end")),
        }
        let divided = false;
        let path = |turned| self.stage == Stage::Path { turned, divided };
        let fits = match &ending {
            Ending::Complete => {
                path(false) || matches!(self.stage, Stage::Begun | Stage::Reached | Stage::Fold)
            }
            Ending::Stopped(_) => true,
            Ending::Open(_) => path(true),
        };
        if !fits {
            return Err(malformed("it cannot end so: its last tubes lead elsewhere"));
        }
        self.stage = Stage::Ended;
        Ok(EndClaim {
            ending,
            tubes,
            classes,
        })
    }

    fn fault(&self, what: &str) -> FormatError {
        malformed(&format!("after {} tubes: {what}", self.tubes))
    }
}

fn check_size(unknowns: usize) -> Result<()> {
    match unknowns > MAX_FREE_COORDINATES {
        true => Err(FormatError::Malformed(format!(
            "the problem has {unknowns} free coordinates, more than the {MAX_FREE_COORDINATES} that are read"
        ))),
        false => Ok(()),
    }
}

/// False for a NaN.
fn in_range(x: f64) -> bool {
    x.abs() <= MAX_NUMBER
}

fn is_radius(x: f32) -> bool {
    x > 0.0 && in_range(x.into())
}

/// A whole number that is not larger.
fn count(input: &mut impl Read, most: usize) -> Result<u32> {
    let count = u32::from_le_bytes(array(input, "an arc")?);
    match count as usize <= most {
        true => Ok(count),
        false => Err(malformed("a number in an arc is too large")),
    }
}

/// So many numbers, each of these bytes.
fn numbers<T, const N: usize>(
    input: &mut impl Read,
    count: usize,
    of: impl Fn([u8; N]) -> T,
    what: &'static str,
) -> Result<Vec<T>> {
    (0..count).map(|_| Ok(of(array(input, what)?))).collect()
}
