//! What is counted in a part of a search that goes on by itself, whatever its own parts are.

use super::newton::Square;
use super::search::{COARSE, FEW, Found, MANY, Run, SMALL, TOO_MANY, add, leave};
use crate::complete::Why;
use crate::interval::Interval;
use std::sync::atomic::Ordering;

/// What was found in a part of a search, and how many of its own parts stay undecided.
pub struct Tally<'s> {
    run: &'s Run<'s>,
    /// Whether numbers are anywhere in ranges: what is undecided is so however small it is.
    has_ranges: bool,
    /// What was found.
    pub found: Found,
    /// The parts that stay undecided.
    pub left: usize,
    /// Whether a curve of figures was seen: then no set is complete, and it is not worth much to leave few parts of it.
    pub is_flexible: bool,
}

impl<'s> Tally<'s> {
    /// Nothing was looked at.
    pub fn new(run: &'s Run<'s>, has_ranges: bool) -> Self {
        Tally {
            run,
            has_ranges,
            found: Found::default(),
            left: 0,
            is_flexible: false,
        }
    }

    /// Counts a part that is to be looked at, of this share. False: it is not any more, and was left undecided.
    pub fn begin(&mut self, share: f64) -> bool {
        let watched = self.run.watched;
        self.found.boxes += 1;
        if watched.stop.load(Ordering::Relaxed)
            || watched.boxes.fetch_add(1, Ordering::Relaxed) >= watched.most_boxes
        {
            self.found.is_broken_off = true;
            self.leave(Why::Unfinished, share);
            return false;
        }
        let most = match (self.is_flexible, self.has_ranges) {
            (true, _) => FEW,
            (_, true) => MANY,
            _ => TOO_MANY,
        };
        if self.left > most {
            self.leave(Why::GivenUp, share);
            return false;
        }
        true
    }

    /// Leaves a part undecided.
    pub fn leave(&mut self, why: Why, share: f64) {
        self.left += 1;
        if why != Why::Unfinished {
            self.done(share);
        }
        leave(&mut self.found.undecided, why, 1, share);
    }

    /// Notes that a part is not looked at any more.
    pub fn done(&self, share: f64) {
        self.run.watched.add_done(self.run.weight * share);
    }

    /// How narrow a part has to be to stay undecided: less so where many do, or where a curve of zeros was seen.
    pub fn least(&self, is_flexible: bool) -> f64 {
        match self.left > MANY || is_flexible || self.has_ranges {
            true => COARSE,
            false => SMALL,
        }
    }

    /// Whether the only zero that a box may hold is one that was found.
    pub fn is_known(&self, square: &Square, x: &[Interval]) -> bool {
        let mut zeros = self.found.zeros.iter();
        zeros.any(|zero| square.is_alone(zero, x))
    }

    /// Proves a zero in a box, if it can, and keeps it. Whether it is the only one that the box may hold.
    pub fn prove(&mut self, square: &Square, x: &[Interval]) -> bool {
        let Some(zero) = square.prove(x) else {
            return false;
        };
        let is_it = square.is_alone(&zero, x);
        add(&mut self.found.zeros, zero);
        is_it
    }
}
