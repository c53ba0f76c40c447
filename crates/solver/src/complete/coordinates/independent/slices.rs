//! A figure of all parts, the reference, and the zeros of each part where the others are as in that one.

use super::super::{Figures, MOST_FIGURES, State, leave, leave_all};
use super::apart::Apart;
use crate::complete::Why;
use std::sync::atomic::Ordering;

/// A reference is looked for in so many steps at most, beside one for each block.
const MOST_STEPS: usize = 2000;

/// How the look for a reference ended.
pub enum Sought {
    /// Where all blocks are, and the zero that each has.
    Found(Box<State>, Vec<usize>),
    /// A part has no zero.
    Nothing(usize),
    /// It took too long.
    Unknown,
}

impl Figures<'_> {
    /// Looks for a zero of all blocks, from given ones on; those of the base stay as they are. `share`: of what is searched, for
    /// the blocks of parts.
    pub(super) fn reference(
        &mut self,
        apart: &Apart,
        zeros: &mut [usize],
        steps: &mut usize,
        (begin, share): (&State, f64),
    ) -> Sought {
        let mut states = vec![begin.clone()];
        while states.len() <= self.blocks.len() {
            *steps += 1;
            if *steps > MOST_STEPS + self.blocks.len() || self.run.stop.load(Ordering::Relaxed) {
                return Sought::Unknown;
            }
            let b = states.len() - 1;
            let state = &states[b];
            let share = apart.part[b].map_or(0.0, |_| share);
            let found = self.solve(b, state, share);
            if zeros[b] < found.zeros.len() {
                let mut state = state.clone();
                self.take(b, (&found, zeros[b]), &mut state);
                states.push(state);
                continue;
            }
            // Back to the last block before of the same part: others have nothing to do with it.
            zeros[b] = 0;
            let before = (0..b).rfind(|&c| apart.part[c] == apart.part[b]);
            let (Some(before), Some(part)) = (before, apart.part[b]) else {
                return match apart.part[b] {
                    Some(part) => Sought::Nothing(part),
                    None => Sought::Unknown,
                };
            };
            let later = before + 1..zeros.len();
            later
                .filter(|&c| apart.part[c] == Some(part))
                .for_each(|c| zeros[c] = 0);
            zeros[before] += 1;
            states.truncate(before + 1);
        }
        match states.pop() {
            Some(state) => Sought::Found(Box::new(state), zeros.to_vec()),
            None => Sought::Unknown,
        }
    }

    /// How many parts have a block with more than one zero.
    pub(super) fn branching(&mut self, apart: &Apart, state: &State) -> usize {
        let mut many = vec![false; apart.parts];
        for b in 0..self.blocks.len() {
            let found = self.solve(b, state, 0.0);
            if let Some(part) = apart.part[b] {
                many[part] |= found.zeros.len() > 1;
            }
        }
        many.into_iter().filter(|many| *many).count()
    }

    /// Leaves open what blocks of a part have left so.
    pub(super) fn leave_of(&mut self, apart: &Apart, part: usize) {
        let known = self.known.iter();
        for (_, found) in known.filter(|((b, _), _)| apart.part[*b] == Some(part)) {
            leave_all(&mut self.undecided, &found.undecided, 1.0);
        }
    }

    /// The zeros of a part's blocks, all others having the reference's.
    pub(super) fn slice(
        &mut self,
        (apart, k): (&Apart, usize),
        (reference, zeros): (&State, &[usize]),
        (b, mut state): (usize, State),
        share: f64,
        out: &mut Vec<(State, f64)>,
    ) {
        if self.run.stop.load(Ordering::Relaxed) {
            return leave(&mut self.undecided, Why::Unfinished, 1, share);
        }
        if out.len() >= MOST_FIGURES {
            return leave(&mut self.undecided, Why::GivenUp, 1, share);
        }
        let mut b = b;
        while b < self.blocks.len() && apart.part[b] != Some(k) {
            match apart.part[b] {
                None => {
                    let found = self.solve(b, &state, 0.0);
                    self.take(b, (&found, zeros[b]), &mut state);
                }
                Some(_) => {
                    apart.move_along(b, reference, &mut state);
                    state.chosen.push((b, zeros[b]));
                }
            }
            b += 1;
        }
        if b == self.blocks.len() {
            return out.push((state, share));
        }
        let found = self.solve(b, &state, 0.5 * share);
        let each = self.share_out(&found, share);
        for zero in 0..found.zeros.len() {
            let mut state = state.clone();
            self.take(b, (&found, zero), &mut state);
            self.slice((apart, k), (reference, zeros), (b + 1, state), each, out);
        }
    }
}
