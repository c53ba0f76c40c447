//! What is kept between runs: an embedded database (redb), one file in the store's folder.
//!
//! Every change is one transaction, on disk before it counts: a process that is killed at any moment leaves the
//! store as it was after the last one. The file is locked while a process has it open.

use super::record::{Class, PathRecord, Sketch};
use redb::{Database, DatabaseError, ReadableDatabase, ReadableTable, TableDefinition};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The format of what is in it.
const VERSION: u64 = 1;

const META: TableDefinition<&str, &str> = TableDefinition::new("meta");
const SKETCHES: TableDefinition<u64, &[u8]> = TableDefinition::new("sketches");
const PATHS: TableDefinition<u64, &[u8]> = TableDefinition::new("paths");
const CLASSES: TableDefinition<u64, &[u8]> = TableDefinition::new("classes");
/// Sketches that are in work units, with the unit's number.
const OUT: TableDefinition<u64, u64> = TableDefinition::new("out");

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
    /// It was made by another version of this program.
    #[error("{0}: this store has format {1}, and this krawl reads format {version}", version = VERSION)]
    OtherVersion(PathBuf, String),
    /// There is none.
    #[error("{0}: there is no store here; `krawl explore FILE --store {0}` makes one")]
    Missing(PathBuf),
    /// The file system or the database.
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
}

/// Where the process is, beside what it found.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
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

/// What one transaction changes.
#[derive(Debug, Default)]
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
        self.sketches.is_empty()
            && self.paths.is_empty()
            && self.classes.is_empty()
            && self.out.is_empty()
            && self.back.is_empty()
    }
}

/// An open store.
#[derive(Debug)]
pub struct Store {
    database: Database,
    folder: PathBuf,
}

impl Store {
    /// Opens the store in a folder for a problem, given as the text of its file, or makes it.
    pub fn open(folder: &Path, problem: &str) -> Result<Self, StoreError> {
        std::fs::create_dir_all(folder)
            .map_err(|e| StoreError::Failed(folder.to_owned(), e.to_string()))?;
        let store = Self::at(folder, Database::create(file(folder)))?;
        store.check(problem)?;
        Ok(store)
    }

    /// Opens the store in a folder that has one, and hands out its problem.
    pub fn existing(folder: &Path) -> Result<(Self, String), StoreError> {
        if !file(folder).is_file() {
            return Err(StoreError::Missing(folder.to_owned()));
        }
        let store = Self::at(folder, Database::open(file(folder)))?;
        let problem = store.meta("problem")?;
        let problem = problem.ok_or_else(|| StoreError::Missing(folder.to_owned()))?;
        store.check(&problem)?;
        Ok((store, problem))
    }

    fn at(folder: &Path, opened: Result<Database, DatabaseError>) -> Result<Self, StoreError> {
        match opened {
            Ok(database) => Ok(Store {
                database,
                folder: folder.to_owned(),
            }),
            Err(DatabaseError::DatabaseAlreadyOpen) => Err(StoreError::Busy(folder.to_owned())),
            Err(error) => Err(StoreError::Failed(folder.to_owned(), error.to_string())),
        }
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    fn failed(&self, error: impl std::fmt::Display) -> StoreError {
        StoreError::Failed(self.folder.clone(), error.to_string())
    }

    fn meta(&self, key: &str) -> Result<Option<String>, StoreError> {
        let read = self.database.begin_read().map_err(|e| self.failed(e))?;
        let table = match read.open_table(META) {
            Ok(table) => table,
            Err(redb::TableError::TableDoesNotExist(_)) => return Ok(None),
            Err(error) => return Err(self.failed(error)),
        };
        let value = table.get(key).map_err(|e| self.failed(e))?;
        Ok(value.map(|value| value.value().to_owned()))
    }

    /// That it is about this problem, in this format; a new one becomes so.
    fn check(&self, problem: &str) -> Result<(), StoreError> {
        let Some(version) = self.meta("version")? else {
            let write = self.database.begin_write().map_err(|e| self.failed(e))?;
            {
                let mut meta = write.open_table(META).map_err(|e| self.failed(e))?;
                let version = VERSION.to_string();
                for (key, value) in [("version", &*version), ("problem", problem)] {
                    meta.insert(key, value).map_err(|e| self.failed(e))?;
                }
                write.open_table(SKETCHES).map_err(|e| self.failed(e))?;
                write.open_table(PATHS).map_err(|e| self.failed(e))?;
                write.open_table(CLASSES).map_err(|e| self.failed(e))?;
                write.open_table(OUT).map_err(|e| self.failed(e))?;
            }
            return write.commit().map_err(|e| self.failed(e));
        };
        if version != VERSION.to_string() {
            return Err(StoreError::OtherVersion(self.folder.clone(), version));
        }
        match self.meta("problem")? {
            Some(known) if known == problem => Ok(()),
            known => {
                let known = known.unwrap_or_default();
                let first = known.lines().next().unwrap_or_default().to_owned();
                Err(StoreError::OtherProblem(self.folder.clone(), first))
            }
        }
    }

    /// Reads all of it.
    pub fn load(&self) -> Result<Contents, StoreError> {
        let read = self.database.begin_read().map_err(|e| self.failed(e))?;
        let state = match self.meta("state")? {
            Some(text) => serde_json::from_str(&text).map_err(|e| self.failed(e))?,
            None => State::default(),
        };
        let mut contents = Contents {
            state,
            ..Contents::default()
        };
        let rows = |table| -> Result<Vec<(u64, Vec<u8>)>, StoreError> {
            let table: redb::ReadOnlyTable<u64, &[u8]> =
                read.open_table(table).map_err(|e| self.failed(e))?;
            let rows = table.iter().map_err(|e| self.failed(e))?;
            rows.map(|row| {
                let (key, value) = row.map_err(|e| self.failed(e))?;
                Ok((key.value(), value.value().to_vec()))
            })
            .collect()
        };
        for (id, bytes) in rows(SKETCHES)? {
            contents.sketches.insert(id, self.read(&bytes)?);
        }
        for (id, bytes) in rows(PATHS)? {
            contents.paths.insert(id, self.read(&bytes)?);
        }
        for (_, bytes) in rows(CLASSES)? {
            contents.classes.push(self.read(&bytes)?);
        }
        let out = read.open_table(OUT).map_err(|e| self.failed(e))?;
        for row in out.iter().map_err(|e| self.failed(e))? {
            let (id, unit) = row.map_err(|e| self.failed(e))?;
            contents.out.insert(id.value(), unit.value());
        }
        Ok(contents)
    }

    fn read<T: DeserializeOwned>(&self, bytes: &[u8]) -> Result<T, StoreError> {
        serde_json::from_slice(bytes).map_err(|e| self.failed(format!("damaged: {e}")))
    }

    /// Writes a change, all of it or nothing. It is on disk when this returns.
    pub fn commit(&self, change: &Change, state: &State) -> Result<(), StoreError> {
        let write = self.database.begin_write().map_err(|e| self.failed(e))?;
        {
            let put = |table, entries: Vec<(u64, Vec<u8>)>| -> Result<(), StoreError> {
                let mut table: redb::Table<u64, &[u8]> =
                    write.open_table(table).map_err(|e| self.failed(e))?;
                for (id, bytes) in entries {
                    table.insert(id, &bytes[..]).map_err(|e| self.failed(e))?;
                }
                Ok(())
            };
            put(SKETCHES, bytes(&change.sketches, |s| s.id))?;
            put(PATHS, bytes(&change.paths, |p| p.id))?;
            put(CLASSES, bytes(&change.classes, |c| c.id))?;
            let mut out = write.open_table(OUT).map_err(|e| self.failed(e))?;
            for &(id, unit) in &change.out {
                out.insert(id, unit).map_err(|e| self.failed(e))?;
            }
            let done = change.paths.iter().map(|path| path.id);
            for id in done.chain(change.back.iter().copied()) {
                out.remove(id).map_err(|e| self.failed(e))?;
            }
            let mut meta = write.open_table(META).map_err(|e| self.failed(e))?;
            let text = serde_json::to_string(state).map_err(|e| self.failed(e))?;
            meta.insert("state", &*text).map_err(|e| self.failed(e))?;
        }
        write.commit().map_err(|e| self.failed(e))
    }
}

fn bytes<T: Serialize>(of: &[T], id: impl Fn(&T) -> u64) -> Vec<(u64, Vec<u8>)> {
    let text = |x: &T| serde_json::to_vec(x).expect("records have a form in JSON");
    of.iter().map(|x| (id(x), text(x))).collect()
}

fn file(folder: &Path) -> PathBuf {
    folder.join("explore.redb")
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
        let store = Store::open(folder.path(), "name = \"one\"").unwrap();
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
        store.commit(&change, &state).unwrap();
        assert!(matches!(
            Store::open(folder.path(), "name = \"one\""),
            Err(StoreError::Busy(_))
        ));
        drop(store);
        assert!(matches!(
            Store::open(folder.path(), "name = \"two\""),
            Err(StoreError::OtherProblem(..))
        ));
        let (store, problem) = Store::existing(folder.path()).unwrap();
        assert_eq!(problem, "name = \"one\"");
        let contents = store.load().unwrap();
        assert_eq!(contents.sketches[&3], sketch(3));
        assert_eq!(contents.paths[&4], path);
        assert_eq!(contents.queue(), BTreeSet::from([3]));
        assert_eq!(contents.state, state);
        let change = Change {
            back: vec![5],
            ..Change::default()
        };
        store.commit(&change, &state).unwrap();
        assert_eq!(store.load().unwrap().queue(), BTreeSet::from([3, 5]));
        let empty = tempfile::tempdir().unwrap();
        assert!(matches!(
            Store::existing(empty.path()),
            Err(StoreError::Missing(_))
        ));
    }
}
