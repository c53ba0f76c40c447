//! Finished parts of a search on disk, so that a search that is ended at any moment goes on where it was, and machines
//! that share a search can bring together what each has done.
//!
//! One file in the store's folder: a line that says of what search it is (problem, plan if there is one, and a digest of what
//! the search begins with), and a line for every piece that is done, each with a checksum. Lines are only
//! ever appended, each at once: a process that is killed leaves at most one line that is cut off, which is no line.

use super::plan::Plan;
use crate::hexadecimal::hexadecimal;
use crate::problem::Problem;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The name of the file in the folder.
const NAME: &str = "parts.krawl-all";
/// What the first line begins with.
const KIND: &str = "parts of a search for all solutions";
/// The format of the file, and of what its parts rest on: to be raised with every change of what a search proves, as
/// parts that were done before are believed.
const VERSION: u32 = 11;

/// Where parts of a search are kept, and which this process works on.
#[derive(Debug, Clone, Default)]
pub struct Keep {
    /// The folder; it is made where there is none.
    pub folder: PathBuf,
    /// `Some([k, n])`: the k-th of n shares alone, counted from 1.
    pub share: Option<[usize; 2]>,
    /// Other stores of the same search, folders or the files in them, whose parts are taken over first.
    pub merge: Vec<PathBuf>,
}

/// What search a store is about.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Head {
    krawl: String,
    version: u32,
    problem: String,
    /// By which plan; `None` where it goes over all coordinates.
    pub(super) plan: Option<Plan>,
    cover: bool,
    /// A digest of the pieces, which lines may know by number alone, or of the space that is searched: another processor or
    /// build of krawl may round otherwise, and so cut the space otherwise.
    pub(super) pieces: String,
}

/// What was found in a piece, as a store keeps it.
pub(super) trait Piece: Serialize + DeserializeOwned {
    /// What tells the pieces of a search apart.
    type Name: Serialize + DeserializeOwned + Ord + Clone;

    /// Whether the piece was searched to its end.
    fn is_done(&self) -> bool;
}

impl Keep {
    /// Whether a piece, by number, is of the share that is worked on.
    pub(super) fn is_mine(&self, piece: usize) -> bool {
        let [which, of] = self.share.unwrap_or([1, 1]);
        piece % of + 1 == which
    }

    /// Whether all pieces are of it.
    pub(super) fn is_all(&self) -> bool {
        self.share.is_none_or(|share| share == [1, 1])
    }
}

#[derive(Serialize, Deserialize)]
struct Line<N, F> {
    piece: N,
    found: F,
}

/// What is whole in a file: the first line, the pieces, and how long all that is.
type Whole<F> = (Head, BTreeMap<<F as Piece>::Name, F>, u64);

/// An open store.
pub(super) struct Store<F: Piece> {
    file: File,
    path: PathBuf,
    /// How much of the file is whole. What is behind is cut off when the first line is written, not before: what is refused
    /// later is left as it is.
    whole: Option<u64>,
    /// What search it is about, once that is known.
    pub(super) head: Option<Head>,
    /// The pieces that are done.
    pub(super) done: BTreeMap<F::Name, F>,
}

impl Head {
    /// Of a search, cut into pieces with this digest.
    pub(super) fn new(problem: &Problem, plan: Option<&Plan>, cover: bool, pieces: String) -> Head {
        Head {
            krawl: KIND.to_owned(),
            version: VERSION,
            problem: problem.to_toml(),
            plan: plan.cloned(),
            cover,
            pieces,
        }
    }

    fn is_of(&self, problem: &Problem, cover: bool) -> Result<(), &'static str> {
        if self.krawl != KIND || self.version != VERSION {
            Err("another version of krawl wrote it; name another folder")
        } else if self.problem != problem.to_toml() {
            Err(
                "it is about another problem, or the problem file was changed since; name another folder",
            )
        } else if self.cover != cover {
            Err(match cover {
                true => "it was begun without --cert and has no cover; name another folder",
                false => "it was begun with --cert; give --cert again, or name another folder",
            })
        } else {
            Ok(())
        }
    }
}

fn json<T: Serialize>(what: &T) -> String {
    serde_json::to_string(what).expect("strings, numbers and lists have a form in JSON")
}

/// The checksum of a line: of its text and of the first line's, so that no line passes into another search's file.
fn checksum(head: &str, text: &str) -> String {
    let digest = Sha256::new().chain_update(head).chain_update(text);
    hexadecimal(&digest.finalize())
}

/// Reads what is whole.
fn read<F: Piece>(file: &mut File) -> std::io::Result<Option<Whole<F>>> {
    let mut bytes = Vec::new();
    file.seek(SeekFrom::Start(0))?;
    file.read_to_end(&mut bytes)?;
    let mut lines = bytes.split_inclusive(|&b| b == b'\n');
    let whole = |line: &[u8]| -> Option<String> {
        let text = line.strip_suffix(b"\n")?;
        String::from_utf8(text.to_vec()).ok()
    };
    let Some(first) = lines.next() else {
        return Ok(None);
    };
    let broken = |what: &str| std::io::Error::new(std::io::ErrorKind::InvalidData, what);
    let Some(text) = whole(first) else {
        // Cut off while the store was being made, or another file altogether.
        return match first.starts_with(br#"{"krawl":"parts of"#) {
            true => Ok(None),
            false => Err(broken("it is not a store of `krawl all`")),
        };
    };
    if !text.starts_with(r#"{"krawl":"parts of"#) {
        return Err(broken("it is not a store of `krawl all`"));
    }
    let damaged = || {
        broken(
            "its first line is damaged, or another version of krawl wrote it; name another folder",
        )
    };
    let (first_text, sum) = text.rsplit_once(' ').ok_or_else(damaged)?;
    if checksum("", first_text) != sum {
        return Err(damaged());
    }
    let head: Head = serde_json::from_str(first_text).map_err(|_| damaged())?;
    let (mut done, mut length) = (BTreeMap::new(), first.len());
    // What lines were written behind, however the first one is spelled.
    let bound = json(&head);
    let line_of = |line: &[u8]| -> Option<Line<F::Name, F>> {
        let text = whole(line)?;
        let (sum, rest) = text.split_once(' ')?;
        let right = checksum(&bound, rest) == sum;
        right.then(|| serde_json::from_str(rest).ok()).flatten()
    };
    for line in lines {
        // From a line on that is damaged nothing is taken: what it was about is searched again.
        let Some(one) = line_of(line) else { break };
        length += line.len();
        if one.found.is_done() {
            done.insert(one.piece, one.found);
        }
    }
    Ok(Some((head, done, length as u64)))
}

impl<F: Piece> Store<F> {
    /// Opens a store, or makes one, and takes what is whole in it.
    pub(super) fn open(keep: &Keep, problem: &Problem, cover: bool) -> Result<Self, String> {
        let path = keep.folder.join(NAME);
        let at = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        std::fs::create_dir_all(&keep.folder).map_err(|e| at(&e))?;
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(&path)
            .map_err(|e| at(&e))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(at(
                    &"another krawl process has this store open; wait for it to end, or share the work by \
                      --share with a folder for each process",
                ));
            }
            Err(TryLockError::Error(error)) => return Err(at(&error)),
        }
        let known = read::<F>(&mut file).map_err(|e| at(&e))?;
        let (head, done, length) = match known {
            Some((head, done, length)) => (Some(head), done, length),
            None => (None, BTreeMap::new(), 0),
        };
        if let Some(head) = &head {
            head.is_of(problem, cover).map_err(|what| at(&what))?;
        }
        Ok(Store {
            file,
            path,
            whole: Some(length),
            head,
            done,
        })
    }

    /// A complaint about it.
    pub(super) fn at(&self, what: &str) -> String {
        format!("{}: {what}", self.path.display())
    }

    /// Says what search it is about: that is written if the store is new, and has to agree if it is not. Then takes over what others have.
    pub(super) fn begin(&mut self, head: Head, keep: &Keep) -> Result<(), String> {
        match &self.head {
            Some(known) if *known == head => {}
            Some(_) => {
                return Err(self.at(
                    "it was begun by another version of krawl or on another kind of processor, which parts the search \
                     otherwise; name another folder",
                ));
            }
            None => {
                let text = json(&head);
                self.append(&format!("{text} {}", checksum("", &text)))?;
                self.head = Some(head);
            }
        }
        keep.merge.iter().try_for_each(|other| self.merge(other))
    }

    /// Takes over what another store of the same search has. Begun must be both.
    fn merge(&mut self, other: &Path) -> Result<(), String> {
        let path = match other.is_dir() {
            true => other.join(NAME),
            false => other.to_owned(),
        };
        let at = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let mut file = File::open(&path).map_err(|e| at(&e))?;
        let (head, done, _) = read::<F>(&mut file)
            .map_err(|e| at(&e))?
            .ok_or_else(|| at(&"nothing is in this store"))?;
        if Some(&head) != self.head.as_ref() {
            return Err(at(
                &"it is of another search: of another problem, by another plan, with or without --cert where this one is not, \
                  or by another version of krawl or on another kind of processor",
            ));
        }
        for (piece, found) in done {
            if !self.done.contains_key(&piece) {
                self.put(&piece, &found)?;
                self.done.insert(piece, found);
            }
        }
        Ok(())
    }

    /// Writes what was found in a piece that is done.
    pub(super) fn put(&mut self, piece: &F::Name, found: &F) -> Result<(), String> {
        let head = self
            .head
            .as_ref()
            .expect("a store is begun before it is filled");
        let text = json(&Line { piece, found });
        let sum = checksum(&json(head), &text);
        self.append(&format!("{sum} {text}"))
    }

    fn append(&mut self, line: &str) -> Result<(), String> {
        let text = format!("{line}\n");
        self.write(&text).map_err(|e| self.at(&e.to_string()))
    }

    fn write(&mut self, text: &str) -> std::io::Result<()> {
        if let Some(length) = self.whole.take() {
            self.file.set_len(length)?;
            self.file.seek(SeekFrom::Start(length))?;
        }
        self.file.write_all(text.as_bytes())
    }
}
