//! What of a problem a certificate is held against.

use super::verdict::Verdict;
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

impl Verdict {
    /// Whether the motion proved is one of this problem, in which some length changes: the same points and objects, and no dimension or constraint
    /// but those of the problem, exactly. Then the names of those that are not in the proof, and whether the sketches have the points in the
    /// same places.
    pub fn is_motion_of(&self, problem: &Problem) -> Option<(Vec<String>, bool)> {
        let b = Problem::parse(&problem.to_toml(), "").unwrap_or_else(|_| problem.clone());
        let led = &self.motion.as_ref()?.dimensions;
        let led = |index: usize| led.iter().any(|(other, _)| *other as usize == index);
        let a = &self.problem;
        let names = |p: &Problem| p.points.iter().map(|p| p.name.clone()).collect::<Vec<_>>();
        let mut missing: Vec<String> = Vec::new();
        let mut left: Vec<usize> = (0..a.distances.len() + a.constraints.len()).collect();
        left.retain(|&k| !led(k));
        for k in 0..b.distances.len() + b.constraints.len() {
            let is_it = |&other: &usize| match k.checked_sub(b.distances.len()) {
                None => a.distances.get(other) == Some(&b.distances[k]),
                Some(k) => {
                    let other = other.checked_sub(a.distances.len());
                    other.is_some_and(|other| a.constraints[other] == b.constraints[k])
                }
            };
            match left.iter().position(is_it) {
                Some(place) => _ = left.remove(place),
                None => missing.push(b.dimension_name(k)),
            }
        }
        let is_same = a.dimension == b.dimension && a.objects == b.objects;
        let is_it = is_same && names(a) == names(&b) && left.is_empty();
        is_it.then(|| (missing, a.points == b.points))
    }
}
