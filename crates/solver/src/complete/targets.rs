//! What the search is about: points, and the squares of the distances wanted.

use crate::certificate::cover::{Frame, Pairs};
use crate::interval::{Interval, point};
use crate::problem::Problem;
use crate::track::Signs;

/// The points and distances of a problem, in a unit near the typical length.
#[derive(Debug, Clone)]
pub struct Targets {
    /// 2 or 3.
    pub dimension: usize,
    /// The number of points.
    pub points: usize,
    /// The length that 1 stands for in here: a power of two, so that divisions by it are exact.
    pub unit: f64,
    /// The distances, in the problem's order.
    pub edges: Vec<[usize; 2]>,
    /// The squares of their lengths.
    pub squares: Vec<Interval>,
    /// Their lengths.
    pub lengths: Vec<Interval>,
    /// The signs that are asked for.
    pub signs: Signs,
    /// The distance between two points, at `a * points + b`.
    table: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Targets {
    /// Of a problem.
    pub fn new(problem: &Problem) -> Self {
        let targets = problem.distances.iter().map(|d| &d.target);
        let wanted = targets.map(|target| [target.enclose(), target.enclose_squared()]);
        let wanted: Vec<[Interval; 2]> = wanted.collect();
        let count = wanted.len().max(1) as f64;
        let mean = wanted.iter().map(|[length, _]| length.mid()).sum::<f64>() / count;
        let unit = 2f64.powi(mean.log2().round() as i32);
        let per_unit = point(1.0 / unit);
        let points = problem.points.len();
        let mut table = vec![NONE; points * points];
        for (index, distance) in problem.distances.iter().enumerate() {
            let [a, b] = distance.points;
            table[a * points + b] = index as u32;
            table[b * points + a] = index as u32;
        }
        let squares = wanted
            .iter()
            .map(|[_, square]| *square * per_unit * per_unit);
        Targets {
            dimension: problem.dimension,
            points,
            unit,
            edges: problem.distances.iter().map(|d| d.points).collect(),
            squares: squares.collect(),
            lengths: wanted
                .iter()
                .map(|[length, _]| *length * per_unit)
                .collect(),
            signs: Signs::of(problem),
            table,
        }
    }

    /// The distance between two points, if one is wanted.
    pub fn edge(&self, a: usize, b: usize) -> Option<usize> {
        let index = self.table[a * self.points + b];
        (index != NONE).then_some(index as usize)
    }

    /// The square of the distance between two points, if one is wanted.
    pub fn square(&self, a: usize, b: usize) -> Option<Interval> {
        Some(self.squares[self.edge(a, b)?])
    }

    /// Bounds of all distances, from those wanted alone.
    ///
    /// No figure has a distance outside of them, whatever the plan: a part in which two points that stand have such a
    /// distance holds no figure, though no distance of the problem is between them.
    pub fn pairs(&self) -> Pairs {
        Pairs::new(self.points, &self.edges, &self.squares)
    }

    /// The equations of all coordinates that are free in a base.
    pub fn frame(&self, base: &[usize]) -> Frame {
        let size = (self.dimension, self.points);
        Frame::new(size, &self.edges, &self.squares, base)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Problem;

    #[test]
    fn two_corners_of_a_kite_are_between_its_flat_shapes() {
        let at = [
            [0.0, 0.0],
            [2.0, 0.0],
            [1.0, 1.0],
            [1.0, -2.0],
            [1.0, -2.25],
        ];
        let names = ["a", "b", "c", "d", "e"];
        let mut kite = Problem::build("kite", 2);
        for (name, place) in names.iter().zip(at) {
            kite = kite.point(name, place);
        }
        let kite = kite
            .distance("a", "b", "2")
            .squared_distance("a", "c", "2")
            .squared_distance("b", "c", "2")
            .squared_distance("a", "d", "5")
            .squared_distance("b", "d", "5")
            .distance("d", "e", "0.25")
            .squared_distance("a", "e", "6.0625")
            .finish()
            .unwrap();
        let targets = Targets::new(&kite);
        let pairs = targets.pairs();
        let (unit, root) = (targets.unit, 5f64.sqrt());
        // c is 1 from the bar a-b and d is 2, on the same perpendicular; e is 0.25 from d.
        for (p, q, least, most) in [
            (2, 3, 1.0, 3.0),
            (1, 4, root - 0.25, root + 0.25),
            (2, 4, 0.75, 3.25),
        ] {
            let [lo, hi] = pairs.squares(p, q).map(|x| x.sqrt() * unit);
            let [x, y] = [0, 1].map(|k: usize| at[p][k] - at[q][k]);
            assert!(
                lo <= x.hypot(y) + 1e-12 && x.hypot(y) - 1e-12 <= hi,
                "{lo} {hi}"
            );
            assert!(least - 1e-9 < lo && hi < most + 1e-9, "{p} {q}: {lo} {hi}");
        }
    }
}
