//! A base with several zeros, beside each of which more falls apart.
//!
//! Where all gaps of a row are as long as a first one that is sought, they hang on it, and so does all that hangs on one of them; with that one decided
//! they have nothing to do with each other. Which blocks are decided first is found by trying: those that leave the fewest zeros to be put together.

use super::super::{Figures, MOST_FIGURES, State};
use super::apart::Apart;
use super::slices::Sought;
use std::sync::atomic::Ordering;

/// Where no more zeros are to be put together than this, nothing more is decided first.
const ENOUGH: f64 = 1000.0;
/// The greatest number of zeros of a base.
const MOST_CASES: usize = 256;
/// So many blocks are taken into the base at most, one after the other.
const MOST_BLOCKS: usize = 24;

/// A base, how the equations fall apart beside it, and how many zeros are to be put together then.
struct Base {
    is_in: Vec<bool>,
    apart: Apart,
    cost: f64,
}

impl Figures<'_> {
    /// A base that leaves fewer zeros to be put together than this one, which has one zero; and its zeros, of each those of its blocks. `None`: none is known, or none is
    /// needed.
    pub(super) fn wider_base(
        &mut self,
        (is_in, apart): (&[bool], &Apart),
        conditions: &[Vec<[usize; 2]>],
        begin: &State,
    ) -> Option<(Vec<bool>, Apart, Vec<Vec<usize>>)> {
        let (mut zeros, mut steps) = (vec![0; self.blocks.len()], 0);
        // Of parts half of the work is counted here, and half in their slices; references of cases are mostly known then.
        let share = if apart.parts < 2 { 1.0 } else { 0.5 };
        let sought = self.reference(apart, &mut zeros, &mut steps, (begin, share));
        let Sought::Found(state, _) = sought else {
            return None;
        };
        let counts = 0..self.blocks.len();
        let counts = counts.map(|b| self.solve(b, &state, 0.0).zeros.len() as f64);
        let counts: Vec<f64> = counts.collect();
        if cost(&counts, is_in, apart) <= ENOUGH {
            return None;
        }
        let mut bases: Vec<Base> = Vec::new();
        while bases.len() < MOST_BLOCKS {
            let (is_in, apart) = match bases.last() {
                Some(base) => (&base.is_in[..], &base.apart),
                None => (is_in, apart),
            };
            match self.next_base(&counts, (is_in, apart), conditions) {
                Some(base) => bases.push(base),
                None => break,
            }
        }
        let best = bases.into_iter().min_by(|a, b| a.cost.total_cmp(&b.cost))?;
        if best.cost > MOST_FIGURES as f64 {
            return None;
        }
        let mut all = Vec::new();
        let none = vec![0; self.blocks.len()];
        self.zeros_of_base(&best.is_in, (0, begin.clone()), none, &mut all)?;
        Some((best.is_in, best.apart, all))
    }

    /// The base with one more block, of the part that has most to be put together: the one that leaves the least.
    fn next_base(
        &self,
        counts: &[f64],
        (is_in, apart): (&[bool], &Apart),
        conditions: &[Vec<[usize; 2]>],
    ) -> Option<Base> {
        let has = |k: usize| product(counts, |b| apart.part[b] == Some(k));
        let largest = (0..apart.parts).max_by(|&k, &l| has(k).total_cmp(&has(l)))?;
        let cases = product(counts, |b| is_in[b]);
        if has(largest) <= 2.0 || cases >= MOST_CASES as f64 {
            return None;
        }
        let is_next = |&b: &usize| {
            let mut needs = self.blocks[b].needs.iter();
            apart.part[b] == Some(largest) && counts[b] > 1.0 && needs.all(|&need| is_in[need])
        };
        let tried = (0..self.blocks.len()).filter(is_next).filter_map(|b| {
            let mut wider = is_in.to_vec();
            wider[b] = true;
            // What has one zero costs nothing.
            for c in 0..wider.len() {
                let mut needs = self.blocks[c].needs.iter();
                wider[c] |= counts[c] == 1.0 && needs.all(|&need| wider[need]);
            }
            let apart = Apart::new(self, &wider, conditions.to_vec())?;
            Some(Base {
                cost: cost(counts, &wider, &apart),
                is_in: wider,
                apart,
            })
        });
        tried.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// The zeros of the base's blocks, from one of them on. `None`: some parts are undecided, or there are too many.
    fn zeros_of_base(
        &mut self,
        is_in: &[bool],
        (b, state): (usize, State),
        zeros: Vec<usize>,
        out: &mut Vec<Vec<usize>>,
    ) -> Option<()> {
        let Some(b) = (b..is_in.len()).find(|&b| is_in[b]) else {
            out.push(zeros);
            return (out.len() <= MOST_CASES).then_some(());
        };
        let found = self.solve(b, &state, 0.0);
        if !found.undecided.is_empty() || self.run.stop.load(Ordering::Relaxed) {
            return None;
        }
        for zero in 0..found.zeros.len() {
            let (mut state, mut zeros) = (state.clone(), zeros.clone());
            self.take(b, (&found, zero), &mut state);
            zeros[b] = zero;
            self.zeros_of_base(is_in, (b + 1, state), zeros, out)?;
        }
        Some(())
    }
}

/// How many zeros are to be put together: of each part, for each zero of the base.
fn cost(counts: &[f64], is_in: &[bool], apart: &Apart) -> f64 {
    let parts = 0..apart.parts;
    let all: f64 = parts
        .map(|k| product(counts, |b| apart.part[b] == Some(k)))
        .sum();
    product(counts, |b| is_in[b]) * all
}

/// The product of the numbers of zeros of some blocks.
fn product(counts: &[f64], is_one: impl Fn(usize) -> bool) -> f64 {
    let blocks = (0..counts.len()).filter(|&b| is_one(b));
    blocks.map(|b| counts[b]).product()
}
