//! Work units: files that a machine without the store can work off, and the files of what came of them.
//!
//! Both are lines of JSON. A unit: one line with the problem, then one for each sketch. A result: one line that names the
//! unit's problem, then one for each path, written when it is done; a line that was cut off is no line.

use super::follow::{Job, Limits};
use super::record::{PathRecord, Sketch};
use super::way::bent;
use super::{ExploreError, Share};
use crate::hexadecimal::hexadecimal;
use crate::problem::{Decimal, Problem};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::sync::Mutex;

/// The format of both kinds of files.
const VERSION: u32 = 1;

#[derive(Debug, Serialize, Deserialize)]
struct Head {
    /// `work unit` or `work result`.
    krawl: String,
    version: u32,
    /// The text of the problem's file, in a unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    problem: Option<String>,
    /// Of that text.
    sha256: String,
    /// How many sketches the unit has.
    sketches: usize,
}

#[derive(Debug, Serialize, Deserialize)]
struct Line {
    sketch: Sketch,
    bend: usize,
    coefficient: String,
}

fn hash(text: &str) -> String {
    hexadecimal(&Sha256::digest(text.as_bytes()))
}

const UNIT: &str = "work unit";
const RESULT: &str = "work result";

impl Head {
    /// Of a file of this kind about a share, without its problem.
    fn of(share: &Share, kind: &str) -> Self {
        Head {
            krawl: kind.to_owned(),
            version: VERSION,
            problem: None,
            sha256: hash(&share.problem),
            sketches: share.sketches.len(),
        }
    }
}

impl Share {
    /// The text of a unit's file.
    pub fn write(&self) -> String {
        let head = Head {
            problem: Some(self.problem.clone()),
            ..Head::of(self, UNIT)
        };
        let mut text = json(&head);
        for (sketch, bend, coefficient) in &self.sketches {
            text += &json(&Line {
                sketch: sketch.clone(),
                bend: *bend,
                coefficient: coefficient.to_string(),
            });
        }
        text
    }

    /// Reads a unit's file.
    pub fn read(text: &str) -> Result<Self, String> {
        let mut lines = text.lines();
        let head = head(lines.next(), UNIT)?;
        let problem = head.problem.ok_or("the unit has no problem")?;
        if hash(&problem) != head.sha256 {
            return Err("the unit is damaged: its problem has another checksum".to_owned());
        }
        let sketches = lines.enumerate().map(|(k, line)| {
            let at = |error: &dyn std::fmt::Display| format!("line {}: {error}", k + 2);
            let line: Line = serde_json::from_str(line).map_err(|e| at(&e))?;
            let coefficient: Decimal = line.coefficient.parse::<Decimal>().map_err(|e| at(&e))?;
            Ok((line.sketch, line.bend, coefficient))
        });
        let sketches = sketches.collect::<Result<Vec<_>, String>>()?;
        if sketches.len() != head.sketches {
            return Err(format!(
                "the unit is cut short: it has {} of {} sketches",
                sketches.len(),
                head.sketches
            ));
        }
        Ok(Share { problem, sketches })
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
    let mut file = OpenOptions::new()
        .read(true)
        .write(true)
        .create(true)
        .truncate(false)
        .open(out)
        .map_err(|e| at(e.to_string()))?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => {
            let busy = "another krawl process writes to it; name another file by `--out`, or wait";
            return Err(at(busy.to_owned()));
        }
        Err(TryLockError::Error(error)) => return Err(at(error.to_string())),
    }
    let known = go_on(&mut file, share).map_err(at)?;
    let of = share.sketches.len();
    let done = Mutex::new((file, known.len()));
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
                let (file, count) = &mut *guard;
                file.write_all(json(&record).as_bytes())
                    .and_then(|()| file.sync_data())
                    .map_err(|e| e.to_string())?;
                *count += 1;
                progress(Worked { done: *count, of });
                Ok(())
            })
    });
    result.map_err(at)?;
    let (_, count) = done.into_inner().expect("no thread panics with it");
    Ok(Worked { done: count, of })
}

/// Reads what a result has of a unit already, cuts off a line that is not whole, and writes the head of a new one.
fn go_on(file: &mut File, share: &Share) -> Result<BTreeSet<u64>, String> {
    let mut text = Vec::new();
    file.read_to_end(&mut text).map_err(|e| e.to_string())?;
    let whole = text.iter().rposition(|&b| b == b'\n').map_or(0, |k| k + 1);
    let text = String::from_utf8(text[..whole].to_vec()).map_err(|e| e.to_string())?;
    file.set_len(whole as u64)
        .and_then(|()| file.seek(SeekFrom::End(0)))
        .map_err(|e| e.to_string())?;
    if text.is_empty() {
        file.write_all(json(&Head::of(share, RESULT)).as_bytes())
            .map_err(|e| e.to_string())?;
        return Ok(BTreeSet::new());
    }
    let records = read_result(&text, &share.problem)?;
    Ok(records.into_iter().map(|record| record.id).collect())
}

/// The paths in the file of a result, which must be about this problem.
pub fn read_result(text: &str, problem: &str) -> Result<Vec<PathRecord>, String> {
    let whole = text.rfind('\n').map_or("", |k| &text[..k + 1]);
    let mut lines = whole.lines();
    let head = head(lines.next(), RESULT)?;
    if head.sha256 != hash(problem) {
        return Err("these are results about another problem".to_owned());
    }
    let records = lines.enumerate().map(|(k, line)| {
        serde_json::from_str(line).map_err(|error| format!("line {}: {error}", k + 2))
    });
    records.collect()
}

fn head(line: Option<&str>, kind: &str) -> Result<Head, String> {
    let line = line.ok_or_else(|| format!("it is empty, and no {kind} of krawl"))?;
    let head: Head = serde_json::from_str(line).map_err(|_| format!("it is no {kind} of krawl"))?;
    if head.krawl != kind {
        return Err(format!("it is a {}, not a {kind}", head.krawl));
    }
    if head.version != VERSION {
        return Err(format!(
            "it has format {}, and this krawl reads format {VERSION}",
            head.version
        ));
    }
    Ok(head)
}

fn json<T: Serialize>(of: &T) -> String {
    serde_json::to_string(of).expect("records have a form in JSON") + "\n"
}
