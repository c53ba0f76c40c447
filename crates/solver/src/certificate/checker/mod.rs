//! Proves a certificate's claims again, each tube on its own and then the chain.

// Comparisons are written so that a NaN fails them.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod arc;
mod chain;
mod degenerate;
pub(super) mod equations;
mod extended;
pub(super) mod guess;
mod krawczyk;
pub(super) mod matrix;
pub(super) mod place;
mod refute;
mod sparse;
mod structure;
mod trial;
mod tube;

use super::format::{Ending, FormatError, Record, SolutionClaim, TubeClaim};
use super::reader::Reader;
use super::verdict::{Flaw, Outcome, Verdict};
use crate::system::Homotopy;
use chain::Chain;
use equations::Equations;
use std::io::Read;

pub use trial::Trial;

/// How to check.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Settings {
    /// Threads to use; 0 for one per processor. The verdict does not depend on it.
    pub threads: usize,
}

/// Where a check is: tubes checked so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stage {
    /// Tubes proved and linked.
    pub tubes: u64,
    /// Solutions proved.
    pub solutions: usize,
}

/// Tubes that are checked at a time. All that is kept of one chunk for the next is its last tube.
const CHUNK: usize = 64;

/// Checks a certificate, read from a stream, in memory that does not grow with the chain.
///
/// Fails where the stream is not a certificate; whether its claims hold is in the verdict.
pub fn verify(
    input: impl Read,
    settings: &Settings,
    progress: &mut dyn FnMut(Stage),
) -> Result<Verdict, FormatError> {
    let mut reader = Reader::new(input)?;
    let header = reader.header();
    let mut verdict = Verdict {
        outcome: Outcome::Verified,
        problem: header.problem.clone(),
        program: header.program.clone(),
        tubes: 0,
        solutions: Vec::new(),
        degenerate: Vec::new(),
        is_edit: false,
        arcs: Vec::new(),
        motion: None,
        is_open: false,
        classes: Vec::new(),
        margin: 1.0,
        t_range: (f64::INFINITY, f64::NEG_INFINITY),
    };
    let unit = 2f64.powi(header.unit_exponent.into());
    let homotopy = match Homotopy::with_unit(&header.problem, unit) {
        Ok(homotopy) => homotopy,
        Err(error) => {
            verdict.outcome = Outcome::NotProved(Flaw::Sketch(error.to_string()));
            return Ok(verdict);
        }
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(settings.threads)
        .build();
    let pool = pool.map_err(|e| FormatError::Unreadable(std::io::Error::other(e)))?;
    let mut chain = Chain::new(Equations::new(homotopy), &header.problem);
    let mut proved = Ok(());
    let mut ahead = None;
    let end = loop {
        let (chunk, mark) = read_chunk(&mut reader, &mut ahead)?;
        if proved.is_ok() {
            proved = pool.install(|| chain.add(&chunk, mark.as_ref(), &mut verdict));
            progress(Stage {
                tubes: verdict.tubes,
                solutions: chain.solutions.len(),
            });
        }
        if let Some(Record::End(end)) = mark {
            break end;
        }
    };
    let solutions = chain.solutions.iter();
    verdict.solutions = solutions.map(|s| chain.points(&s.claimed)).collect();
    let numbers = 0..chain.solutions.len();
    verdict.degenerate = numbers.map(|k| chain.flat.contains_key(&k)).collect();
    verdict.is_open = matches!(end.ending, Ending::Open(_));
    verdict.outcome = match proved.and_then(|()| chain.conclude(&end, &mut verdict)) {
        Err(outcome) => outcome,
        Ok(()) => match end.ending {
            Ending::Stopped(reason) => Outcome::Partial(reason),
            Ending::Complete | Ending::Open(_) => Outcome::Verified,
        },
    };
    Ok(verdict)
}

type Chunk = Vec<(TubeClaim, Vec<SolutionClaim>)>;

/// Reads tubes, each with the solutions that follow it, and the record of another kind behind them, if that is reached.
fn read_chunk<R: Read>(
    reader: &mut Reader<R>,
    ahead: &mut Option<TubeClaim>,
) -> Result<(Chunk, Option<Record>), FormatError> {
    let mut chunk: Chunk = ahead
        .take()
        .into_iter()
        .map(|tube| (tube, Vec::new()))
        .collect();
    loop {
        match reader.next_record()? {
            Some(Record::Tube(tube)) if chunk.len() == CHUNK => {
                *ahead = Some(tube);
                return Ok((chunk, None));
            }
            Some(Record::Tube(tube)) => chunk.push((tube, Vec::new())),
            Some(Record::Solution(solution)) => {
                // The reader has seen to it that there is a tube before.
                let last = chunk.last_mut();
                last.into_iter()
                    .for_each(|(_, solutions)| solutions.push(solution.clone()));
            }
            Some(mark) => return Ok((chunk, Some(mark))),
            None => return Err(FormatError::Truncated("the chain of tubes")),
        }
    }
}
