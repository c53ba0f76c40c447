//! What of a problem a set of all solutions is held against.

use crate::problem::Problem;

/// What is compared where a set of all solutions is held against a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Compared {
    /// The names of the points and the distances: the set does not depend on where the sketch has the points.
    Distances,
    /// The points, where the sketch has them, the objects and all constraints, as these may mean what the sketch shows.
    All,
}

impl Compared {
    /// Of a set about this problem.
    pub(super) fn of(own: &Problem) -> Self {
        match own.is_distances_only() {
            true => Compared::Distances,
            false => Compared::All,
        }
    }
}
