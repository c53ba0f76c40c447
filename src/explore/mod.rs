//! The whole process of Imbach, Schreck, Mathis 2014 (section 6.1): solutions give new sketches, whose paths give
//! more solutions.
//!
//! From every solution found, the branches of a construction plan give figures that keep all its lengths but a few:
//! new sketches. Each is followed with proof, unless a path that is proved already passes through it at t = 0. Then
//! the same again with other plans, and with other lengths that bend. That there are no other solutions is never
//! claimed.
//!
//! ```
//! use krawl::explore::{Explorer, Finish, Options};
//! use krawl::problem::Problem;
//! let problem = Problem::read("problems/octahedron.toml")?;
//! let folder = std::env::temp_dir().join(format!("krawl-explore-{}", std::process::id()));
//! let mut explorer = Explorer::open(&problem, &folder)?;
//! let options = Options { patience: 1, ..Options::default() };
//! assert_eq!(explorer.run(&options)?, Finish::Ended);
//! assert_eq!(explorer.contents().classes.len(), 4);
//! # drop(explorer);
//! # std::fs::remove_dir_all(&folder)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! - `construction`: plans, and the figures on their branches
//! - `way`: which plan, which bend
//! - `follow`: one sketch, recognised or followed
//! - `record`: what is kept of sketches, paths, solutions
//! - `store`: where it is kept
//! - `index`: finding sketches again
//! - `process`: the queue
//! - `unit`: work for other machines

mod construction;
mod follow;
mod index;
mod process;
mod record;
mod store;
mod unit;
mod way;

pub use construction::{Construction, Locus, Step};
pub use follow::Limits;
pub use process::{Explorer, look};
pub use record::{Bounds, BoxRecord, Class, End, Met, PathRecord, Sketch, intervals};
pub use store::{Contents, State, StoreError};
pub use unit::{Worked, read_result, work};
pub use way::Way;

use crate::problem::Decimal;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// What a run may take, and whom it tells.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// It ends after so long; paths that are not done are followed by the next run.
    pub time: Option<Duration>,
    /// It ends when so many paths were followed.
    pub paths: Option<u64>,
    /// Threads; 0 is one per processor.
    pub jobs: usize,
    /// The process ends when so many ways in a row gave no new solution.
    pub patience: usize,
    /// A path that takes more tubes is given up.
    pub most_tubes: usize,
    /// Sketches that are in work units are followed here, too.
    pub take_back: bool,
    /// Set from outside to end the run.
    pub cancel: Option<&'a AtomicBool>,
    /// Called now and then, by time.
    pub progress: Option<&'a (dyn Fn(Progress) + Sync)>,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Options {
            time: None,
            paths: None,
            jobs: 0,
            patience: 3,
            most_tubes: 100_000,
            take_back: false,
            cancel: None,
            progress: None,
        }
    }
}

/// Where a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Paths followed by this run.
    pub paths: u64,
    /// Solutions of all runs, up to congruence.
    pub solutions: usize,
    /// Sketches that wait.
    pub queue: usize,
    /// The way opened last.
    pub way: usize,
    /// Paths per second of this run.
    pub rate: f64,
}

crate::named! {
    /// How a run ended.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Finish {
        /// Nothing new came.
        Ended = "ended",
        /// The time is over, or so many paths were followed.
        Budget = "budget",
        /// Somebody asked it to stop.
        Interrupted = "interrupted",
        /// So many sketches are in work units, and no others are left.
        Shared(usize) = "shared",
    }
}

/// A part of the queue, for another machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
    /// The text of the problem's file.
    pub problem: String,
    /// Sketches, and of each which distance bends by how much.
    pub sketches: Vec<(Sketch, usize, Decimal)>,
}

/// So many threads; 0 is one per processor.
fn pool(jobs: usize) -> Result<rayon::ThreadPool, ExploreError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs).build();
    pool.map_err(|e| ExploreError::Threads(e.to_string()))
}

/// Why a process could not go on.
#[derive(Debug, thiserror::Error)]
pub enum ExploreError {
    /// The store.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The problem.
    #[error("{0}")]
    Problem(String),
    /// Sketches cannot be made for it.
    #[error("not served yet: {0}")]
    Unserved(String),
    /// A work unit's file or that of its results.
    #[error("{0}: {1}")]
    File(PathBuf, String),
    /// No threads.
    #[error("threads cannot be started: {0}")]
    Threads(String),
}
