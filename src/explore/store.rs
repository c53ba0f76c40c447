//! What is kept between runs: a [journal](crate::journal) in the store's folder.
//!
//! Every change is one line, on disk before it counts: a process that is killed at any moment leaves the store as it was
//! after the last one. The file is locked while a process has it open.

use super::record::{Class, PathRecord, Sketch};
use crate::journal::{Journal, Kind, Whole};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

const KIND: Kind = Kind {
    name: "store of krawl explore",
    version: 2,
};

#[derive(Debug, Serialize, Deserialize)]
struct About {
    /// The text of the problem's file.
    problem: String,
}

#[derive(Debug, Serialize, Deserialize)]
struct Line {
    change: Change,
    state: State,
}

/// Why a store cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// Another process has it.
    #[error(
        "{0}: another krawl process has this store open; wait for it to end, or share the work with it by work units \
         (`krawl explore --shard`)"
    )]
    Busy(PathBuf),
    /// It is about something else.
    #[error(
        "{0}: this store is about another problem ({1}), or the problem file was changed since; name another folder"
    )]
    OtherProblem(PathBuf, String),
    /// There is none.
    #[error("{0}: there is no store here; `krawl explore FILE --store {0}` makes one")]
    Missing(PathBuf),
    /// The file system, or what is in the file.
    #[error("{0}: {1}")]
    Failed(PathBuf, String),
}

/// All that a store holds.
#[derive(Debug, Default)]
pub struct Contents {
    /// The sketches, followed or not.
    pub sketches: BTreeMap<u64, Sketch>,
    /// What came of those that are done.
    pub paths: BTreeMap<u64, PathRecord>,
    /// The solutions.
    pub classes: Vec<Class>,
    /// Sketches in work units, with the units' numbers.
    pub out: BTreeMap<u64, u64>,
    /// Where the process is.
    pub state: State,
}

impl Contents {
    /// Sketches that wait.
    pub fn queue(&self) -> BTreeSet<u64> {
        let waiting = self.sketches.keys().copied();
        waiting
            .filter(|id| !self.paths.contains_key(id) && !self.out.contains_key(id))
            .collect()
    }

    /// Takes in what a line of the journal changes.
    fn take(&mut self, Line { change, state }: Line) {
        let sketches = change.sketches.into_iter();
        self.sketches
            .extend(sketches.map(|sketch| (sketch.id, sketch)));
        self.classes.extend(change.classes);
        self.out.extend(change.out);
        for id in change.back {
            self.out.remove(&id);
        }
        for path in change.paths {
            self.out.remove(&path.id);
            self.paths.insert(path.id, path);
        }
        self.state = state;
    }
}

/// Where the process is, beside what it found.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct State {
    /// Ways opened so far: 0 before the first sketch.
    pub ways: usize,
    /// How many of them in a row found nothing new.
    pub idle: usize,
    /// Solutions when the last way was opened.
    pub known_before: usize,
    /// Sketches that were not taken as they had been drawn before in the same way.
    pub repeated: u64,
    /// Work units made.
    pub units: u64,
    /// Solutions of paths that could not be told from others, or whose equations have another form.
    pub undecided: u64,
    /// Seconds of all runs together.
    pub seconds: f64,
}

/// What one line of the journal changes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Change {
    /// New sketches.
    pub sketches: Vec<Sketch>,
    /// What came of some.
    pub paths: Vec<PathRecord>,
    /// New solutions.
    pub classes: Vec<Class>,
    /// Sketches that go into a unit.
    pub out: Vec<(u64, u64)>,
    /// Sketches that are taken back from units.
    pub back: Vec<u64>,
}

impl Change {
    /// Whether there is nothing to do.
    pub fn is_empty(&self) -> bool {
        *self == Change::default()
    }
}

/// An open store.
#[derive(Debug)]
pub struct Store {
    journal: Journal,
    folder: PathBuf,
}

impl Store {
    /// Opens the store in a folder for a problem, given as the text of its file, or makes it; and what is in it.
    pub fn open(folder: &Path, problem: &str) -> Result<(Self, Contents), StoreError> {
        std::fs::create_dir_all(folder).map_err(|e| failed(folder, e))?;
        let (mut store, whole) = Self::at(folder)?;
        let Some(whole) = whole else {
            let problem = problem.to_owned();
            let begun = store.journal.begin(&KIND, &About { problem });
            begun.map_err(|e| failed(folder, e))?;
            return Ok((store, Contents::default()));
        };
        let known = &whole.about.problem;
        if known != problem {
            let first = known.lines().next().unwrap_or_default().to_owned();
            return Err(StoreError::OtherProblem(folder.to_owned(), first));
        }
        Ok((store, contents(whole)))
    }

    /// Opens the store in a folder that has one, and hands out its problem and what is in it.
    pub fn existing(folder: &Path) -> Result<(Self, String, Contents), StoreError> {
        let missing = || StoreError::Missing(folder.to_owned());
        if !file(folder).is_file() && !database(folder).exists() {
            return Err(missing());
        }
        let (store, whole) = Self::at(folder)?;
        let whole = whole.ok_or_else(missing)?;
        Ok((store, whole.about.problem.clone(), contents(whole)))
    }

    fn at(folder: &Path) -> Result<(Self, Option<Whole<About, Line>>), StoreError> {
        if database(folder).exists() {
            let what = "another version of krawl wrote this store; name another folder";
            return Err(StoreError::Failed(folder.to_owned(), what.to_owned()));
        }
        let opened = KIND.open::<About, Line>(&file(folder));
        let (journal, whole) = opened.map_err(|error| match error.kind() {
            ErrorKind::WouldBlock => StoreError::Busy(folder.to_owned()),
            ErrorKind::InvalidData => {
                StoreError::Failed(file(folder), format!("{error}; name another folder"))
            }
            _ => failed(&file(folder), error),
        })?;
        if let Some(line) = whole.as_ref().and_then(|whole| whole.damaged) {
            let what = format!(
                "line {line} of {} is damaged: where the lines from there on are cut off, what they were about is followed again",
                file(folder).display()
            );
            return Err(StoreError::Failed(folder.to_owned(), what));
        }
        let folder = folder.to_owned();
        Ok((Store { journal, folder }, whole))
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Writes a change. It is on disk when this returns.
    pub fn commit(&mut self, change: Change, state: &State) -> Result<(), StoreError> {
        let state = state.clone();
        let put = self.journal.put(&Line { change, state });
        let on_disk = put.and_then(|()| self.journal.sync());
        on_disk.map_err(|e| failed(&self.folder, e))
    }
}

fn contents(whole: Whole<About, Line>) -> Contents {
    let mut contents = Contents::default();
    whole.lines.into_iter().for_each(|line| contents.take(line));
    contents
}

fn failed(folder: &Path, error: Error) -> StoreError {
    StoreError::Failed(folder.to_owned(), error.to_string())
}

/// What krawl kept before December 2026.
fn database(folder: &Path) -> PathBuf {
    folder.join("explore.redb")
}

fn file(folder: &Path) -> PathBuf {
    folder.join("explored.krawl-store")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explore::record::End;

    fn sketch(id: u64) -> Sketch {
        Sketch {
            id,
            way: 0,
            from: Some((1, 2)),
            points: vec![[0.1, 1.0 / 3.0, 0.0]],
            look: vec![1.0],
        }
    }

    #[test]
    fn keeps_what_was_committed_and_is_for_one_process_and_problem() {
        let folder = tempfile::tempdir().unwrap();
        let (mut store, _) = Store::open(folder.path(), "name = \"one\"").unwrap();
        let path = PathRecord {
            tubes: 3,
            seconds: 0.1,
            ..PathRecord::new(4, End::Closed, None)
        };
        let change = Change {
            sketches: vec![sketch(3), sketch(4), sketch(5)],
            paths: vec![path.clone()],
            out: vec![(5, 1)],
            ..Change::default()
        };
        let state = State {
            ways: 2,
            ..State::default()
        };
        store.commit(change, &state).unwrap();
        assert!(matches!(
            Store::open(folder.path(), "name = \"one\""),
            Err(StoreError::Busy(_))
        ));
        drop(store);
        assert!(matches!(
            Store::open(folder.path(), "name = \"two\""),
            Err(StoreError::OtherProblem(..))
        ));
        let (mut store, problem, contents) = Store::existing(folder.path()).unwrap();
        assert_eq!(problem, "name = \"one\"");
        assert_eq!(contents.sketches[&3], sketch(3));
        assert_eq!(contents.paths[&4], path);
        assert_eq!(contents.queue(), BTreeSet::from([3]));
        assert_eq!(contents.state, state);
        let change = Change {
            back: vec![5],
            ..Change::default()
        };
        store.commit(change, &state).unwrap();
        drop(store);
        let text = std::fs::read(file(folder.path())).unwrap();
        let (_, _, contents) = Store::existing(folder.path()).unwrap();
        assert_eq!(contents.queue(), BTreeSet::from([3, 5]));
        // A line that was cut off is no line; one that is damaged is an error, and stays as it is.
        std::fs::write(file(folder.path()), &text[..text.len() - 3]).unwrap();
        let (_, _, contents) = Store::existing(folder.path()).unwrap();
        assert_eq!(contents.queue(), BTreeSet::from([3]));
        // Nor can a line come twice or be left out.
        let lines: Vec<&[u8]> = text.split_inclusive(|&b| b == b'\n').collect();
        for (other, number) in [
            ([&text[..], lines[1]].concat(), 4),
            ([lines[0], lines[2]].concat(), 2),
        ] {
            std::fs::write(file(folder.path()), &other).unwrap();
            let error = Store::existing(folder.path()).unwrap_err().to_string();
            assert!(error.contains(&format!("line {number} of")), "{error}");
        }
        let mut damaged = text.clone();
        damaged[text.len() - 3] ^= 1;
        std::fs::write(file(folder.path()), &damaged).unwrap();
        let error = Store::existing(folder.path()).unwrap_err().to_string();
        assert!(
            error.contains("line 3 of") && error.contains("is damaged"),
            "{error}"
        );
        assert_eq!(std::fs::read(file(folder.path())).unwrap(), damaged);
        let empty = tempfile::tempdir().unwrap();
        assert!(matches!(
            Store::existing(empty.path()),
            Err(StoreError::Missing(_))
        ));
    }
}
