//! Pieces of blocks that are done, kept in a store.
//!
//! What is found in a piece depends on its block, on the ranges that it begins with and on the zeros found before the block was
//! cut into pieces, and on nothing else: a digest of these is the name of a piece. So a search that is ended at any
//! moment goes on where it was, with as many blocks as there are.

use super::newton::Zero;
use super::search::Found;
use crate::complete::store::{Head, Keep, Piece, Store};
use crate::hexadecimal::hexadecimal;
use crate::interval::Interval;
use crate::problem::Problem;
use sha2::{Digest, Sha256};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

impl Piece for Found {
    /// A digest of all that it depends on.
    type Name = String;

    fn is_done(&self) -> bool {
        !self.is_broken_off
    }
}

/// A store in use.
pub struct Kept<'a> {
    store: Mutex<Store<Found>>,
    /// Which pieces this process works on.
    pub keep: &'a Keep,
    stop: &'a AtomicBool,
    /// Why the store could not be written.
    failed: Mutex<Option<String>>,
}

impl<'a> Kept<'a> {
    /// Uses an open store, with what others have, for the search of a space. `stop` is set where the disk is full.
    pub fn new(
        mut store: Store<Found>,
        keep: &'a Keep,
        (problem, space): (&Problem, &[Interval]),
        stop: &'a AtomicBool,
    ) -> Result<Self, String> {
        // The cover is made after the search, so that the pieces are the same with and without.
        let head = Head::new(problem, None, false, digest([], space, &[]));
        store.begin(head, keep)?;
        Ok(Kept {
            store: Mutex::new(store),
            keep,
            stop,
            failed: Mutex::new(None),
        })
    }

    /// What was found in a piece before.
    pub fn known(&self, name: &str) -> Option<Found> {
        self.store.lock().ok()?.done.get(name).cloned()
    }

    /// Keeps what was found in a piece, if that is done.
    pub fn put(&self, name: &String, found: &Found) {
        if !found.is_done() {
            return;
        }
        let Ok(mut store) = self.store.lock() else {
            return;
        };
        let put = store.put(name, found);
        store.done.insert(name.clone(), found.clone());
        if let Err(what) = put {
            // A disk that is full ends the search.
            self.stop.store(true, Ordering::Relaxed);
            if let Ok(mut failed) = self.failed.lock() {
                failed.get_or_insert(what);
            }
        }
    }

    /// Whether everything could be written.
    pub fn end(self) -> Result<(), String> {
        let failed = self.failed.into_inner().unwrap_or_else(|e| e.into_inner());
        failed.map_or(Ok(()), Err)
    }
}

/// A digest of unknowns, ranges and zeros, to the last bit.
pub fn digest(
    unknowns: impl IntoIterator<Item = usize>,
    ranges: impl IntoIterator<Item = impl std::borrow::Borrow<Interval>>,
    zeros: &[Zero],
) -> String {
    let mut digest = Sha256::new();
    for unknown in unknowns {
        digest.update((unknown as u64).to_le_bytes());
    }
    // What follows is no unknown.
    digest.update(u64::MAX.to_le_bytes());
    for range in ranges {
        let range = range.borrow();
        for end in [range.inf(), range.sup()] {
            digest.update(end.to_bits().to_le_bytes());
        }
    }
    for zero in zeros {
        for x in zero.centre.iter().chain([&zero.radius, &zero.alone]) {
            digest.update(x.to_bits().to_le_bytes());
        }
    }
    hexadecimal(&digest.finalize())
}
