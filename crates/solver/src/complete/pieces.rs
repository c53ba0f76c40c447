//! A search cut into pieces that can be worked on in any order, at any time and on any machine.
//!
//! The cut is always the same: parts are parted, the one made longest ago first, until there are so many. What was
//! found is put together in the order of the search, so that the answer and the cover are those of one run.

use super::node::Node;
use super::outcome::{is_open, open_share};
use super::search::{Run, Search};
use super::store::{Keep, Piece, Store};
use super::visit::Found;
use crate::hexadecimal::hexadecimal;
use rayon::prelude::*;
use sha2::{Digest, Sha256};
use std::collections::VecDeque;
use std::sync::Mutex;
use std::sync::atomic::Ordering;

/// How many pieces there are, about.
const PIECES: usize = 2048;
/// How many parts are looked at to make them: each process that shares a search looks at these again.
const LOOKED: usize = 1000;

/// A part that was looked at to make the pieces, or a piece.
enum Entry {
    Looked { own: Found, below: Vec<usize> },
    Piece(Node),
}

/// The top of a search, and the pieces below.
pub(super) struct Outline {
    entries: Vec<Entry>,
    roots: usize,
    pieces: Vec<usize>,
}

impl Outline {
    /// Of a search.
    pub(super) fn new(search: &Search, run: &Run) -> Outline {
        let mut entries: Vec<Entry> = Node::roots(&search.plan)
            .into_iter()
            .map(Entry::Piece)
            .collect();
        let roots = entries.len();
        let mut waiting: VecDeque<usize> = (0..roots).collect();
        let mut looked = 0;
        while waiting.len() < PIECES && looked < LOOKED {
            looked += 1;
            let Some(which) = waiting.pop_front() else {
                break;
            };
            let Entry::Piece(node) = &entries[which] else {
                continue;
            };
            let (own, children) = search.one(run, node.clone());
            let below = entries.len()..entries.len() + children.len();
            waiting.extend(below.clone());
            entries.extend(children.into_iter().map(Entry::Piece));
            let below = below.collect();
            entries[which] = Entry::Looked { own, below };
        }
        Outline {
            entries,
            roots,
            pieces: waiting.into(),
        }
    }

    /// A digest of what the space is cut into: equal digests, equal pieces.
    pub(super) fn digest(&self) -> String {
        let mut digest = Sha256::new();
        for entry in &self.entries {
            // Numbers are written such that reading them gives the same floats.
            digest.update(match entry {
                Entry::Looked { below, .. } => format!("looked {below:?}\n"),
                Entry::Piece(node) => format!("{node:?}\n"),
            });
        }
        digest.update(format!("{} {:?}", self.roots, self.pieces));
        hexadecimal(&digest.finalize())
    }

    /// All that was found, in the order of the search; with marks, if a cover is wanted.
    fn together(self, cover: bool, mut found_in: impl FnMut(usize) -> Option<Found>) -> Found {
        let mut piece_of = vec![usize::MAX; self.entries.len()];
        for (piece, &entry) in self.pieces.iter().enumerate() {
            piece_of[entry] = piece;
        }
        let mut entries: Vec<Option<Entry>> = self.entries.into_iter().map(Some).collect();
        let mut stack: Vec<usize> = (0..self.roots).rev().collect();
        let mut parts = Vec::new();
        while let Some(which) = stack.pop() {
            match entries[which].take() {
                Some(Entry::Looked { own, below }) => {
                    parts.push(own);
                    stack.extend(below.into_iter().rev());
                }
                Some(Entry::Piece(node)) => {
                    let found = found_in(piece_of[which]);
                    parts.push(found.unwrap_or_else(|| Found::missing(cover, node.share)));
                }
                None => {}
            }
        }
        Found::together(parts)
    }
}

impl Piece for Found {
    /// Its place in the order of the search.
    type Name = usize;

    fn is_done(&self) -> bool {
        !is_open(&self.undecided)
    }
}

impl Search {
    /// Searches what a store does not have yet, and puts each piece into it as soon as it is done.
    pub(super) fn kept(
        &self,
        run: &Run,
        outline: Outline,
        keep: &Keep,
        mut store: Store<Found>,
    ) -> Result<Found, String> {
        let known = std::mem::take(&mut store.done);
        let mut todo = Vec::new();
        for (piece, &entry) in outline.pieces.iter().enumerate() {
            let Entry::Piece(node) = &outline.entries[entry] else {
                continue;
            };
            if known.contains_key(&piece) {
                run.add_done(node.share);
            } else if keep.is_mine(piece) {
                todo.push((piece, node));
            }
        }
        run.all_before();
        let store = Mutex::new(store);
        let worked: Vec<(usize, Result<Found, String>)> = todo
            .into_par_iter()
            .map(|(piece, node)| {
                let found = self.descend(run, node.clone(), 0);
                if !found.is_done() {
                    run.add_lost(node.share - open_share(&found.undecided));
                }
                let put = match (found.is_done(), store.lock()) {
                    (true, Ok(mut store)) => store.put(&piece, &found),
                    _ => Ok(()),
                };
                // A disk that is full ends the search.
                if put.is_err() {
                    run.stop.store(true, Ordering::Relaxed);
                }
                (piece, put.map(|()| found))
            })
            .collect();
        let mut all = known;
        for (piece, found) in worked {
            all.insert(piece, found?);
        }
        Ok(outline.together(run.cover, |piece| all.remove(&piece)))
    }
}
