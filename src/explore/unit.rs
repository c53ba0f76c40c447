//! Work units: files that a machine without the store can work off, and the files of what came of them.
//!
//! Both are [journals](crate::journal). A unit is about the problem, and has a line for each sketch. A result is about
//! the unit, and has a line for each path, written when it is done.

use super::follow::{Job, Limits};
use super::record::{PathRecord, Sketch};
use super::way::bent;
use super::{ExploreError, Share};
use crate::journal::{Kind, Whole};
use crate::problem::{Decimal, Problem};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::io::ErrorKind;
use std::path::Path;
use std::sync::Mutex;

const UNIT: Kind = Kind {
    name: "work unit",
    version: 2,
};
const RESULT: Kind = Kind {
    name: "work result",
    version: 2,
};

#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct About {
    /// The text of the problem's file.
    problem: String,
    /// How many sketches the unit has.
    sketches: usize,
}

#[derive(Debug, Serialize, Deserialize)]
struct Line {
    sketch: Sketch,
    bend: usize,
    coefficient: String,
}

impl Share {
    fn about(&self) -> About {
        About {
            problem: self.problem.clone(),
            sketches: self.sketches.len(),
        }
    }

    /// The text of a unit's file.
    pub fn write(&self) -> String {
        let lines = self
            .sketches
            .iter()
            .map(|(sketch, bend, coefficient)| Line {
                sketch: sketch.clone(),
                bend: *bend,
                coefficient: coefficient.to_string(),
            });
        UNIT.text(&self.about(), &lines.collect::<Vec<_>>())
    }

    /// Reads a unit's file.
    pub fn read(text: &str) -> Result<Self, String> {
        let Whole { about, lines, .. } = whole::<Line>(&UNIT, text)?;
        if lines.len() != about.sketches {
            return Err(format!(
                "the unit is cut short: it has {} of {} sketches",
                lines.len(),
                about.sketches
            ));
        }
        let sketches = lines.into_iter().enumerate().map(|(k, line)| {
            let coefficient = line.coefficient.parse::<Decimal>();
            let coefficient = coefficient.map_err(|e| format!("line {}: {e}", k + 2))?;
            Ok((line.sketch, line.bend, coefficient))
        });
        Ok(Share {
            sketches: sketches.collect::<Result<_, String>>()?,
            problem: about.problem,
        })
    }
}

/// Where the work on a unit is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Worked {
    /// Paths done, earlier runs' among them.
    pub done: usize,
    /// Of how many.
    pub of: usize,
}

/// Follows the sketches of a unit and writes what comes of them to a file, one by one; those that the file has are
/// not followed again.
pub fn work(
    share: &Share,
    out: &Path,
    jobs: usize,
    limits: &Limits,
    progress: &(dyn Fn(Worked) + Sync),
) -> Result<Worked, ExploreError> {
    let at = |error: String| ExploreError::File(out.to_owned(), error);
    let problem = Problem::parse(&share.problem, "the unit's problem")
        .map_err(|e| ExploreError::Problem(e.to_string()))?;
    let (mut journal, known) =
        RESULT
            .open::<About, PathRecord>(out)
            .map_err(|error| match error.kind() {
                ErrorKind::WouldBlock => at(
                    "another krawl process writes to it; name another file by `--out`, or wait"
                        .to_owned(),
                ),
                ErrorKind::InvalidData => at(format!("{error}; name another file by `--out`")),
                _ => at(error.to_string()),
            })?;
    let about = share.about();
    let known = match known {
        None => {
            let begun = journal.begin(&RESULT, &about);
            begun.map_err(|e| at(e.to_string()))?;
            BTreeSet::new()
        }
        Some(whole) if whole.about == about => {
            let whole = undamaged(whole).map_err(at)?;
            whole.lines.iter().map(|record| record.id).collect()
        }
        Some(_) => return Err(at("these are results of another unit".to_owned())),
    };
    let of = share.sketches.len();
    let done = Mutex::new((journal, known.len()));
    let pool = super::pool(jobs)?;
    let (problem, known) = (&problem, &known);
    let result: Result<(), String> = pool.install(|| {
        use rayon::prelude::*;
        share
            .sketches
            .par_iter()
            .with_max_len(1)
            .filter(|(sketch, ..)| !known.contains(&sketch.id))
            .try_for_each(|(sketch, bend, coefficient)| {
                let job = Job {
                    sketch: sketch.clone(),
                    problem: bent(problem, sketch.places(), (*bend, coefficient)),
                    candidates: Vec::new(),
                };
                let Some(record) = job.run(limits) else {
                    return Ok(());
                };
                let mut guard = done.lock().expect("no thread panics with it");
                let (journal, count) = &mut *guard;
                let put = journal.put(&record).and_then(|()| journal.sync());
                put.map_err(|e| e.to_string())?;
                *count += 1;
                progress(Worked { done: *count, of });
                Ok(())
            })
    });
    result.map_err(at)?;
    let (_, count) = done.into_inner().expect("no thread panics with it");
    Ok(Worked { done: count, of })
}

/// The paths in the file of a result, which must be about this problem.
pub fn read_result(text: &str, problem: &str) -> Result<Vec<PathRecord>, String> {
    let read = whole::<PathRecord>(&RESULT, text)?;
    match read.about.problem == problem {
        true => Ok(read.lines),
        false => Err("these are results about another problem".to_owned()),
    }
}

fn whole<L: DeserializeOwned>(kind: &Kind, text: &str) -> Result<Whole<About, L>, String> {
    let read = kind.read(text.as_bytes()).map_err(|e| e.to_string())?;
    undamaged(read.ok_or_else(|| format!("it is empty, and no {} of krawl", kind.name))?)
}

fn undamaged<L>(whole: Whole<About, L>) -> Result<Whole<About, L>, String> {
    match whole.damaged {
        None => Ok(whole),
        Some(line) => Err(format!("line {line} is damaged")),
    }
}
