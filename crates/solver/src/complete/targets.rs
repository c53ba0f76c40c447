//! What the search is about: points, and the squares of the distances wanted.

use crate::interval::{Interval, hull, point};
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
}

/// A lower bound of an interval that is known not to be negative, with the bound no lower than 0.
pub fn not_negative(x: Interval) -> Interval {
    hull(x.inf().max(0.0), x.sup().max(0.0))
}
