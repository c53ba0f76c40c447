//! What of a problem a certificate is held against.

use super::verdict::Verdict;
use crate::interval::vector::distance;
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
    /// but those of the problem, exactly; the points drawn in the same places, unless there are distances alone, as other constraints may mean
    /// what the sketch shows. Then the names of those of the problem that are not in the proof, and how far points are drawn from where the
    /// problem has them, at most, in floats.
    pub fn is_motion_of(&self, problem: &Problem) -> Option<(Vec<String>, f64)> {
        let b = Problem::parse(&problem.to_toml(), "").unwrap_or_else(|_| problem.clone());
        let (led, _) = self.motion.as_ref()?.dimensions.first()?;
        let a = &self.problem;
        let names = |p: &Problem| p.points.iter().map(|p| p.name.clone()).collect::<Vec<_>>();
        let mut missing: Vec<String> = Vec::new();
        let mut left: Vec<usize> = (0..a.distances.len() + a.constraints.len()).collect();
        left.retain(|&k| k != *led as usize);
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
        let means_so = a.is_distances_only() || a.points == b.points;
        let is_it = is_same && names(a) == names(&b) && left.is_empty() && means_so;
        is_it.then(|| {
            let pairs = a.points.iter().zip(&b.points);
            let off = pairs.map(|(a, b)| distance(a.place(), b.place()));
            (missing, off.fold(0.0, f64::max))
        })
    }
}
