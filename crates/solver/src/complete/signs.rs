//! The figures of a search that have the signs that the problem asks for.

use super::coordinates::leave;
use super::outcome::are_apart;
use super::{Complete, Status, Why};
use crate::constraint::Symmetry;
use crate::order::InOrder;
use crate::problem::Problem;
use crate::track::{Signed, Signs};

impl Complete {
    /// Takes the figures out that have a wrong sign, and those of which that cannot be told, which stay undecided; mirror images stand in the place of
    /// figures that have all signs reversed. Nothing, where that was done before, or the problem asks for no signs. For each figure whether it is
    /// still there.
    pub(super) fn choose_signed(&mut self, problem: &Problem) -> Vec<bool> {
        let all = vec![true; self.solutions.len()];
        if problem.orientations.is_empty() {
            return all;
        }
        let signs = Signs {
            all: problem.orientations.clone(),
            mirrors: self.symmetry == Symmetry::Isometries,
        };
        if signs.mirrors {
            self.symmetry = Symmetry::Motions;
        }
        if self.signed.is_some_and(|signed| signed.asked > 0) {
            return all;
        }
        let listed = self.solutions.len() as u64;
        let mut signed = Signed {
            asked: signs.all.len(),
            found: self.count.unwrap_or(u64::MAX),
            ..self.signed.unwrap_or_default()
        };
        let is_kept = signs.choose(&mut self.solutions, problem.dimension, &mut signed);
        // Those that are not listed were not looked at.
        signed.undecided += signed.found.saturating_sub(listed);
        self.count = Some(self.solutions.len() as u64);
        for (class, solution) in self.solutions.iter_mut().enumerate() {
            solution.class = class;
        }
        self.signed = Some(signed);
        if signed.undecided > 0 {
            self.leave(Why::Sign, signed.undecided);
        }
        let figures = &self.solutions;
        let is_apart = |k: usize| figures[..k].iter().all(|one| are_apart(one, &figures[k]));
        if signed.mirrored > 0 && !(0..figures.len()).all(is_apart) {
            self.leave(Why::Apart, 1);
            self.reason =
                Some("two solutions are too close to each other to be told apart".to_owned());
        }
        if self.status == Status::Complete
            && self.solutions.is_empty()
            && signed.cut + signed.wrong > 0
        {
            self.reason =
                Some("no figure that meets the constraints has the signs asked for".to_owned());
        }
        is_kept
    }

    /// Leaves figures undecided.
    pub(super) fn leave(&mut self, why: Why, count: u64) {
        if self.status == Status::Complete {
            self.status = Status::Partial;
        }
        leave(&mut self.undecided, why, count, 0.0);
        self.undecided.order_by_key(|part| part.why);
    }
}
