//! Stepping as in RR 8705, section 7.

use super::Tracker;
use crate::track::{Control, Status};

impl<const D: usize> Tracker<'_, D> {
    pub(super) fn follow_as_in_the_paper(&mut self, control: &mut Control) -> Status {
        self.follow(control)
    }
}
