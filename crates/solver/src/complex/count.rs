//! How many solutions there are: in the gauge, up to rotation, up to isometry.

use super::Same;
use super::boxes::{SolutionBox, SolutionSet};
use super::system::{Signs, System};
use serde::{Deserialize, Serialize};

/// The number of solutions, counted in three ways. In a frame of the problem's own there is no motion to divide by: the last
/// two numbers are that of solutions, and the first is that with directions of lines and normals of planes reversed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Counts {
    /// In the gauge: every solution of the equations.
    pub gauge: usize,
    /// Up to rotations: those of one figure in different positions are counted once.
    pub rotation: usize,
    /// Up to rotations and reflections.
    pub isometry: usize,
    /// Whether all counts are proved; otherwise it could not be told of some solution which changes of signs leave
    /// it as it is, and it was counted as if none did.
    pub certain: bool,
}

/// Counts solutions of an instance, of which a set has one for each orbit.
///
/// A solution that some change of signs leaves as it is has fewer images.
pub fn count(set: &SolutionSet, system: &System) -> Counts {
    counted(set, &system.group_of_instance, system.positions)
}

/// Counts solutions of a generic instance, of which a set has one for each orbit under the changes of sign that
/// take the solutions of every instance to solutions.
pub fn count_generic(set: &SolutionSet, system: &System) -> Counts {
    counted(set, &system.group, system.positions)
}

fn counted(set: &SolutionSet, group: &[Signs], positions: usize) -> Counts {
    let mut counts = Counts {
        certain: true,
        ..Counts::default()
    };
    for one in set.boxes() {
        let (kept, rotations, certain) = stabiliser(one, group);
        counts.certain &= certain;
        counts.gauge += positions * (group.len() / kept);
        counts.isometry += 1;
        // The orbit falls into as many orbits of rotations as these are fewer.
        let moves = group.iter().filter(|s| !s.mirrors).count();
        counts.rotation += (group.len() / kept) / (moves / rotations);
    }
    counts
}

/// How many changes of signs leave a solution as it is, how many of them are rotations, and whether that is certain.
fn stabiliser(one: &SolutionBox, group: &[Signs]) -> (usize, usize, bool) {
    let (mut kept, mut rotations, mut certain) = (0, 0, true);
    for signs in group {
        match one.is_same(one, signs, false) {
            Same::Yes => {
                kept += 1;
                rotations += usize::from(!signs.mirrors);
            }
            Same::No => {}
            Same::Unknown => certain = false,
        }
    }
    // The one that changes nothing is among them always; should that not be told, `certain` is false.
    (kept.max(1), rotations.max(1), certain)
}
