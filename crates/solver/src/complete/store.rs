//! Finished parts of a search on disk, so that a search that is ended at any moment goes on where it was, and machines
//! that share a search can bring together what each has done.
//!
//! One [journal](crate::journal) in the store's folder: its first line says of what search it is (problem, plan if there is
//! one, and a digest of what the search begins with), and there is a line for every piece that is done.

use super::plan::Plan;
use crate::journal::{Journal, Kind};
use crate::problem::Problem;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The name of the file in the folder.
const NAME: &str = "parts.krawl-all";
/// Its format is that of the file, and of what its parts rest on: to be raised with every change of what a search proves,
/// as parts that were done before are believed.
const KIND: Kind = Kind {
    name: "parts of a search for all solutions",
    version: 12,
};

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

/// An open store.
pub(super) struct Store<F: Piece> {
    journal: Journal,
    path: PathBuf,
    /// What search it is about, once that is known.
    pub(super) head: Option<Head>,
    /// The pieces that are done.
    pub(super) done: BTreeMap<F::Name, F>,
}

impl Head {
    /// Of a search, cut into pieces with this digest.
    pub(super) fn new(problem: &Problem, plan: Option<&Plan>, cover: bool, pieces: String) -> Head {
        Head {
            problem: problem.without_limits().to_toml(),
            plan: plan.cloned(),
            cover,
            pieces,
        }
    }

    fn is_of(&self, problem: &Problem, cover: bool) -> Result<(), &'static str> {
        if self.problem != problem.without_limits().to_toml() {
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

/// The pieces that are done, by their names.
fn done<F: Piece>(lines: Vec<Line<F::Name, F>>) -> BTreeMap<F::Name, F> {
    let done = lines.into_iter().filter(|line| line.found.is_done());
    done.map(|line| (line.piece, line.found)).collect()
}

impl<F: Piece> Store<F> {
    /// Opens a store, or makes one, and takes what is whole in it.
    pub(super) fn open(keep: &Keep, problem: &Problem, cover: bool) -> Result<Self, String> {
        let path = keep.folder.join(NAME);
        let at = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        std::fs::create_dir_all(&keep.folder).map_err(|e| at(&e))?;
        let (journal, known) = KIND.open::<Head, Line<F::Name, F>>(&path).map_err(|error| {
            match error.kind() {
                ErrorKind::WouldBlock => at(
                    &"another krawl process has this store open; wait for it to end, or share the work by --share with \
                      a folder for each process",
                ),
                ErrorKind::InvalidData => at(&format!("{error}; name another folder")),
                _ => at(&error),
            }
        })?;
        let known = known.map(|known| (known.about, known.lines));
        let (head, lines): (Option<Head>, _) = known.unzip();
        if let Some(head) = &head {
            head.is_of(problem, cover).map_err(|what| at(&what))?;
        }
        Ok(Store {
            journal,
            path,
            head,
            done: done(lines.unwrap_or_default()),
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
                let begun = self.journal.begin(&KIND, &head);
                begun.map_err(|e| self.at(&e.to_string()))?;
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
        let bytes = std::fs::read(&path).map_err(|e| at(&e))?;
        let whole = KIND.read::<Head, Line<F::Name, F>>(&bytes);
        let other = whole.map_err(|e| at(&e))?;
        let other = other.ok_or_else(|| at(&"nothing is in this store"))?;
        if Some(&other.about) != self.head.as_ref() {
            return Err(at(
                &"it is of another search: of another problem, by another plan, with or without --cert where this one is not, \
                  or by another version of krawl or on another kind of processor",
            ));
        }
        for (piece, found) in done(other.lines) {
            if !self.done.contains_key(&piece) {
                self.put(&piece, &found)?;
                self.done.insert(piece, found);
            }
        }
        Ok(())
    }

    /// Writes what was found in a piece that is done.
    pub(super) fn put(&mut self, piece: &F::Name, found: &F) -> Result<(), String> {
        let put = self.journal.put(&Line { piece, found });
        put.map_err(|e| self.at(&e.to_string()))
    }
}
