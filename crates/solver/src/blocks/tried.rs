//! Whether a constraint holds wherever others do: tried at figures near one, in floats.
//!
//! That its gradient at a figure is a combination of those of others says so of that figure, to first order: a tangent at the top
//! of an arc has no part in such a combination. So the figure is moved along directions that the others leave free, back to
//! where they are met, and what the constraint measures has to be there what it was. If it is not, others are needed, among
//! those that are not met there.

use super::drawn::{Floats, MET, MOVED};
use crate::linalg::{decomposed, shortest};
use crate::order::each_once;
use crate::random::Random;
use nalgebra::DVector;

/// Figures at which it is tried, each further away than the one before.
const TRIES: u64 = 3;
/// A direction of a smaller part is none.
const NONE: f64 = 1e-7;

/// What was seen of a row at figures that meet others.
pub(super) enum Tried {
    /// It measures the same at all of them.
    Holds,
    /// It measures something else at this one.
    Fails(Vec<f64>),
    /// No figure was found.
    Open,
}

impl Floats<'_> {
    /// Whether a row measures the same at all figures near one that meet a set of others, as that one does.
    pub(super) fn tried(&self, row: usize, set: &[usize], at: &[f64]) -> Tried {
        let rows = set.iter().chain([&row]);
        let unknowns = each_once(rows.flat_map(|&r| self.unknowns_of(r).iter().copied()));
        // Of the unknowns that matter alone.
        let decomposed = (!set.is_empty()).then(|| {
            let jacobian = self.linearise_in(set, &unknowns, at).0;
            (jacobian.clone(), decomposed(jacobian, [true, true]))
        });
        let (value, most) = (self.value(row, at), MET * self.steepness(row, at).max(1.0));
        let mut is_seen = false;
        for seed in 0..TRIES {
            let mut random = Random::new(seed + 1);
            let any = DVector::from_fn(unknowns.len(), |_, _| random.symmetric());
            let held = decomposed
                .as_ref()
                .and_then(|(jacobian, svd)| shortest(svd, &(jacobian * &any), 1e-9));
            let free = held.map_or_else(|| any.clone(), |held| &any - held);
            if free.amax() < NONE {
                return Tried::Holds;
            }
            let step = MOVED * (seed + 1) as f64 / free.amax();
            let mut beside = at.to_vec();
            let moves = unknowns.iter().zip(free.iter());
            moves.for_each(|(&u, v)| beside[u] += step * v);
            let Some(there) = self.meet_in(set, &unknowns, beside) else {
                continue;
            };
            if (self.value(row, &there) - value).abs() > most {
                return Tried::Fails(there);
            }
            is_seen = true;
        }
        match is_seen {
            true => Tried::Holds,
            false => Tried::Open,
        }
    }

    /// A set of rows with which one holds at figures near this one: the first ones given, and of each `wider` set in turn those that are
    /// needed besides. `None`: it does not hold with all of these, or that is not seen.
    pub(super) fn holds_with(
        &self,
        row: usize,
        first: &[usize],
        wider: [&[usize]; 2],
        at: &[f64],
    ) -> Option<Vec<usize>> {
        let (mut set, known) = (first.to_vec(), first.len());
        loop {
            let there = match self.tried(row, &set, at) {
                Tried::Holds => break,
                Tried::Fails(there) => there,
                Tried::Open => return None,
            };
            let more = wider.iter().find_map(|wider| {
                let missed = |&&r: &&usize| r != row && !set.contains(&r) && self.misses(r, &there);
                let more: Vec<usize> = wider.iter().filter(missed).copied().collect();
                (!more.is_empty()).then_some(more)
            });
            set.extend(more?);
        }
        // Made small again, by half of what was added at a time, a quarter, and so on.
        let mut part = (set.len() - known).div_ceil(2);
        while part > 0 {
            let mut from = known;
            while from < set.len() {
                let mut without = set.clone();
                without.drain(from..(from + part).min(set.len()));
                match self.tried(row, &without, at) {
                    Tried::Holds => set = without,
                    _ => from += part,
                }
            }
            part = if part == 1 { 0 } else { part.div_ceil(2) };
        }
        Some(set)
    }
}
