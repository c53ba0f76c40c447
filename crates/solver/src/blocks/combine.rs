//! Figures of a whole that falls apart into blocks, made of figures of the blocks.

use crate::interval::point;
use crate::interval::vector::Vector;
use crate::map::Map;
use crate::problem::Problem;
use crate::system::{Placement, orientation, simplices};
use crate::track::Solution;
use std::collections::HashMap;

/// A figure of a block that takes part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Choice {
    /// The block, by its place among the blocks given.
    pub block: usize,
    /// The solution, by its place among the block's.
    pub solution: usize,
    /// Whether it is mirrored: in the line through the side (in space: the plane through the triangle) by which it hangs
    /// on those before it.
    pub mirrored: bool,
}

/// A block and how it hangs on those before it.
#[derive(Debug)]
struct Joint {
    block: usize,
    /// For each of the block's points its number in the whole.
    points: Vec<usize>,
    /// The block's points that stand already, as many as there are dimensions; none of the first block.
    shared: Vec<usize>,
    /// One solution of each class, as it is, and mirrored where that is another figure; of a block with signs of its own as it is alone.
    choices: Vec<Choice>,
    /// Whether it has signs of its own, which say which of a figure and its mirror image is meant.
    is_signed: bool,
}

/// All figures of a whole that consist of the solutions found for its [`clusters`](super::clusters), one of each, as they
/// are or mirrored: listed one at a time, as there may be very many.
///
/// The blocks share sides (in space triangles) of exact lengths, so that a figure of one fits to one of the other by a motion,
/// or by a motion and a reflection. A box of a combined figure holds the figure whose blocks are congruent to the exact figures
/// in the boxes of the solutions taken: it meets all dimensions of the whole.
#[derive(Debug)]
pub struct Combined<'s> {
    problem: &'s Problem,
    solutions: Vec<&'s [Solution]>,
    joints: Vec<Joint>,
    /// The joint whose mirror images are left out, so that the figures come without theirs.
    halved: Option<usize>,
}

impl<'s> Combined<'s> {
    /// From the blocks of a problem and the solutions of each. `None`: the blocks do not hang together.
    pub fn new(
        problem: &'s Problem,
        blocks: &[Problem],
        solutions: Vec<&'s [Solution]>,
    ) -> Option<Self> {
        let names: HashMap<&str, usize> = problem
            .points
            .iter()
            .enumerate()
            .map(|(p, point)| (point.name.as_str(), p))
            .collect();
        let of_whole = |block: &Problem| -> Option<Vec<usize>> {
            let points = block.points.iter();
            points
                .map(|p| names.get(p.name.as_str()).copied())
                .collect()
        };
        let points = blocks.iter().map(of_whole).collect::<Option<Vec<_>>>()?;
        let d = problem.dimension;
        let mut joints: Vec<Joint> = Vec::new();
        let mut stands = vec![false; problem.points.len()];
        let mut left: Vec<usize> = (0..blocks.len()).collect();
        while !left.is_empty() {
            let shared = |b: usize| -> Vec<usize> {
                let of = points[b].iter().enumerate();
                of.filter(|(_, p)| stands[**p]).map(|(k, _)| k).collect()
            };
            let next = left
                .iter()
                .position(|&b| joints.is_empty() || shared(b).len() == d)?;
            let b = left.remove(next);
            let shared = shared(b);
            points[b].iter().for_each(|&p| stands[p] = true);
            joints.push(Joint {
                block: b,
                choices: choices(&blocks[b], b, solutions[b], &shared),
                points: points[b].clone(),
                shared,
                is_signed: !blocks[b].orientations.is_empty(),
            });
        }
        let mut out = Combined {
            problem,
            solutions,
            joints,
            halved: None,
        };
        out.halve();
        Some(out)
    }

    /// Where every figure of a block differs from its mirror image, it is taken as it is: the other half are mirror images of
    /// the whole. (Whether a block is mirrored is told by the orientation of what it hangs on, so that the mirror image of the whole is that of
    /// every block.)
    fn halve(&mut self) {
        if self.is_signed() {
            return;
        }
        let has_all_images = |joint: &Joint| {
            let of = Map::sums(joint.choices.iter().map(|choice| (choice.solution, 1)));
            of.iter().all(|(_, &count)| count == 2)
        };
        self.halved = self.joints.iter().position(has_all_images);
        if let Some(k) = self.halved {
            self.joints[k].choices.retain(|choice| !choice.mirrored);
        }
    }

    /// The number of figures; `None` where it has no place in 64 bits.
    pub fn count(&self) -> Option<u64> {
        let numbers = self.joints.iter().map(|joint| joint.choices.len() as u64);
        numbers
            .into_iter()
            .try_fold(1u64, |product, n| product.checked_mul(n))
    }

    /// Whether mirror images are left out: every figure has one besides.
    pub fn without_mirror_images(&self) -> bool {
        self.halved.is_some()
    }

    /// Whether a block has signs of its own, so that no figure's mirror image is counted as the same.
    pub fn is_signed(&self) -> bool {
        self.joints.iter().any(|joint| joint.is_signed)
    }

    /// Whether every solution of a block was proved to differ from its mirror image, or to be it as it is flat, so that no two
    /// combinations are the same figure, and none is missing.
    pub fn has_all_mirror_images(&self) -> bool {
        let is_flat = |joint: &Joint| {
            let mut solutions = self.solutions[joint.block].iter();
            solutions.all(|solution| solution.is_degenerate)
        };
        let mut joints = self.joints.iter().enumerate();
        joints.all(|(k, joint)| {
            let images = match is_flat(joint) || joint.is_signed || self.halved == Some(k) {
                true => 1,
                false => 2,
            };
            joint.choices.len() == images * self.solutions[joint.block].len()
        }) && (self.halved.is_some() || self.is_signed() || self.joints.iter().all(is_flat))
    }

    /// What the figure of this number is made of, block by block in the order in which they hang together. Numbers begin
    /// with 0; the choice for the last block changes first.
    pub fn choices(&self, mut number: u64) -> Vec<Choice> {
        let mut out: Vec<Choice> = Vec::with_capacity(self.joints.len());
        for joint in self.joints.iter().rev() {
            let n = joint.choices.len() as u64;
            out.push(joint.choices[(number % n) as usize]);
            number /= n;
        }
        out.reverse();
        out
    }

    /// The boxes of all points of a figure, in coordinates in which the problem's reference points are the first at the
    /// origin, the second on the x axis, the third (in space) in the xy plane. `None`: the boxes of a side that blocks share
    /// are too wide to tell a direction.
    pub fn figure(&self, choices: &[Choice]) -> Option<Vec<Vector>> {
        let d = self.problem.dimension;
        let mut places: Vec<Option<Vector>> = vec![None; self.problem.points.len()];
        for (joint, choice) in self.joints.iter().zip(choices) {
            let own = &self.solutions[joint.block][choice.solution].points;
            let flipped = |mut inside: Vector| {
                if choice.mirrored {
                    inside[d - 1] = -inside[d - 1];
                }
                inside
            };
            if joint.shared.is_empty() {
                for (k, &p) in joint.points.iter().enumerate() {
                    places[p] = Some(flipped(own[k]));
                }
                continue;
            }
            let here: Vec<Vector> = joint.shared.iter().map(|&k| own[k]).collect();
            let there = joint.shared.iter().map(|&k| places[joint.points[k]]);
            let there = there.collect::<Option<Vec<Vector>>>()?;
            let from = Placement::through(d, &here)?;
            let to = Placement::through(d, &there)?;
            for (k, &p) in joint.points.iter().enumerate() {
                if places[p].is_none() {
                    places[p] = Some(to.to_problem(&flipped(from.seen(&own[k]))));
                }
            }
        }
        let places = places.into_iter().collect::<Option<Vec<Vector>>>()?;
        seen(self.problem, &places)
    }
}

/// Places as the problem's reference sees them; `None`: it has no frame there that can be enclosed.
pub(crate) fn seen(problem: &Problem, places: &[Vector]) -> Option<Vec<Vector>> {
    let reference = &problem.homotopy.reference;
    let here: Vec<Vector> = reference.iter().map(|&p| places[p]).collect();
    let frame = Placement::through(problem.dimension, &here)?;
    let mut seen: Vec<Vector> = places.iter().map(|p| frame.seen(p)).collect();
    // Exactly where they are by choice.
    for (k, &p) in reference.iter().enumerate() {
        seen[p][k..].fill(point(0.0));
    }
    Some(seen)
}

/// One solution of each class, and its mirror image where some point is off the line (in space: the plane) of the mirror.
fn choices(block: &Problem, index: usize, solutions: &[Solution], shared: &[usize]) -> Vec<Choice> {
    let pairs: Vec<[usize; 2]> = block.distances.iter().map(|d| d.points).collect();
    let all = simplices(block.dimension, block.points.len(), &pairs);
    let on_hinge = (0..block.points.len()).map(|p| [shared, &[p]].concat());
    // Any sign does for the first block, which is mirrored as a whole.
    let sets: Vec<Vec<usize>> = match shared.is_empty() {
        true => all,
        false => on_hinge
            .filter(|set| !shared.contains(&set[shared.len()]))
            .collect(),
    };
    let mut out: Vec<Choice> = Vec::new();
    let mut classes: Vec<usize> = Vec::new();
    for (solution, found) in solutions.iter().enumerate() {
        if classes.contains(&found.class) {
            continue;
        }
        classes.push(found.class);
        let differs = block.orientations.is_empty()
            && sets.iter().any(|set| orientation(&found.points, set) != 0);
        for mirrored in [false, true] {
            if !mirrored || differs {
                out.push(Choice {
                    block: index,
                    solution,
                    mirrored,
                });
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::clusters;
    use crate::track::prove;

    /// A strip of triangles on a common side each with the next: all figures are known.
    #[test]
    fn a_strip_of_triangles_has_all_its_foldings() {
        let mut build = Problem::build("strip", 2);
        for (name, at) in [
            ("a", [0, 0]),
            ("b", [4, 0]),
            ("c", [4, 3]),
            ("d", [0, 3]),
            ("e", [-3, 1]),
        ] {
            build = build.point(name, at);
        }
        let lengths = [
            ("a", "b", 5),
            ("b", "c", 3),
            ("c", "d", 5),
            ("d", "a", 3),
            ("a", "e", 4),
            ("d", "e", 4),
        ];
        for (a, b, length) in lengths {
            build = build.distance(a, b, length);
        }
        let problem = build.squared_distance("a", "c", 34).finish().unwrap();
        let blocks = clusters(&problem);
        assert_eq!(blocks.len(), 3);
        let outcomes: Vec<_> = blocks.iter().map(|b| prove(b).unwrap()).collect();
        let solutions = outcomes.iter().map(|o| o.solutions.as_slice());
        let combined = Combined::new(&problem, &blocks, solutions.collect()).unwrap();
        assert_eq!(combined.count(), Some(4));
        assert!(combined.without_mirror_images());
        let mut seen: Vec<Vec<f64>> = Vec::new();
        for number in 0..4 {
            let figure = combined.figure(&combined.choices(number)).unwrap();
            for distance in &problem.distances {
                let [a, b] = distance.points.map(|p| figure[p]);
                let squared = (0..3).fold(point(0.0), |sum, k| sum + (a[k] - b[k]).sqr());
                let target = distance.target.enclose_squared();
                assert!(squared.inf() <= target.sup() && target.inf() <= squared.sup());
                assert!(squared.wid() < 1e-9);
            }
            let all: Vec<f64> = figure.iter().flatten().map(|x| x.mid()).collect();
            let apart = |other: &Vec<f64>| all.iter().zip(other).any(|(x, y)| (x - y).abs() > 0.1);
            assert!(seen.iter().all(apart), "{all:?}");
            seen.push(all);
        }
    }
}
