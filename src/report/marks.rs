//! Which triangles (in space: tetrahedra) of joined points a solution has turned over, beside the sketch.

use crate::interval::enclose;
use crate::places::Each as _;
use crate::problem::Problem;
use crate::system::{orientation, simplices};
use crate::track::Solution;

/// With more sets than this nothing is said of them.
const MOST: usize = 5000;

/// Sets of joined points and their signs in the sketch.
#[derive(Debug)]
pub struct Marks {
    /// Three points in the plane, four in space.
    pub sets: Vec<Vec<usize>>,
    /// The signs of their orientations in the sketch; 0: flat, or too near to it to tell.
    pub signs: Vec<i8>,
}

impl Marks {
    /// The sets of a problem, and their signs in its sketch; none where there are too many.
    pub fn new(problem: &Problem) -> Self {
        let pairs: Vec<[usize; 2]> = problem.distances.iter().map(|d| d.points).collect();
        let mut sets = simplices(problem.dimension, problem.points.len(), &pairs);
        if sets.len() > MOST {
            sets.clear();
        }
        let points = problem.points.iter();
        let sketch: Vec<_> = points.map(|p| p.sketch.each_ref().each(enclose)).collect();
        let signs = sets.iter().map(|set| orientation(&sketch, set)).collect();
        Marks { sets, signs }
    }

    /// The signs in a solution. The coordinates of results are those of the problem moved, never mirrored.
    pub fn of(&self, solution: &Solution) -> Vec<i8> {
        let signs = self.sets.iter();
        signs
            .map(|set| orientation(&solution.points, set))
            .collect()
    }

    /// The sets that a solution has turned over, those that are flat in it or too near to it to tell, and the number of
    /// those that have a sign in the sketch.
    pub fn turned(&self, solution: &Solution) -> (Vec<&[usize]>, Vec<&[usize]>, usize) {
        let (mut turned, mut flat, mut all) = (Vec::new(), Vec::new(), 0);
        for ((set, before), now) in self.sets.iter().zip(&self.signs).zip(self.of(solution)) {
            match before * now {
                _ if *before == 0 => continue,
                0 => flat.push(set.as_slice()),
                -1 => turned.push(set.as_slice()),
                _ => {}
            }
            all += 1;
        }
        (turned, flat, all)
    }
}
