//! Bounds of the distances between all pairs of points, from the distances wanted alone.
//!
//! No figure has a distance outside of them, whatever the plan: a part in which two points that stand have such a
//! distance holds no figure, though no distance of the problem is between them.

use super::targets::{Targets, not_negative};
use crate::interval::{Interval, hull, point};

/// The bounds.
#[derive(Debug, Clone)]
pub struct Pairs {
    points: usize,
    lengths: Vec<Interval>,
}

/// In place of a bound: the search's unit is near the typical length, and a plan places no point as far as this.
const FAR: f64 = 1e100;
/// How often the triangles are gone through at most. Each time all bounds are right: more would only be closer.
const ROUNDS: usize = 6;

impl Pairs {
    /// Of a problem's points.
    ///
    /// Two points joined to both ends of a bar are nearest to each other, and farthest, where all four lie in a
    /// plane. The rest is the triangle inequality: |ak| − |kb| ≤ |ab| ≤ |ak| + |kb|.
    pub fn new(targets: &Targets) -> Self {
        let n = targets.points;
        let mut pairs = Pairs {
            points: n,
            lengths: vec![hull(0.0, FAR); n * n],
        };
        for p in 0..n {
            pairs.lengths[p * n + p] = point(0.0);
        }
        for (&[a, b], &length) in targets.edges.iter().zip(&targets.lengths) {
            pairs.narrow(a, b, length);
        }
        for &[c1, c2] in &targets.edges {
            pairs.turn(targets, c1, c2);
        }
        for _ in 0..ROUNDS {
            let mut changed = false;
            for k in 0..n {
                for a in 0..n {
                    for b in 0..a {
                        let (ak, kb) = (pairs.lengths[a * n + k], pairs.lengths[k * n + b]);
                        let (sum, difference) = (ak + kb, ak - kb);
                        let least = difference.inf().max(-difference.sup()).max(0.0);
                        if sum.sup() >= least {
                            changed |= pairs.narrow(a, b, hull(least, sum.sup()));
                        }
                    }
                }
            }
            if !changed {
                break;
            }
        }
        pairs
    }

    /// Bounds for the points joined to both ends of a bar.
    fn turn(&mut self, targets: &Targets, c1: usize, c2: usize) {
        let Some(bar) = targets.square(c1, c2) else {
            return;
        };
        // Where on the line of the bar, and how far from it.
        let placed = |p: usize| {
            let (r1, r2) = (targets.square(c1, p)?, targets.square(c2, p)?);
            let along = (r1 - r2 + bar) / (point(2.0) * bar.sqrt());
            Some((p, along, not_negative(r1 - along.sqr()).sqrt()))
        };
        let all: Vec<_> = (0..self.points).filter_map(placed).collect();
        for (i, &(p, x, h)) in all.iter().enumerate() {
            for &(q, y, k) in &all[..i] {
                let along = (x - y).sqr();
                let least = along + (h - k).sqr();
                let most = along + (h + k).sqr();
                self.narrow(p, q, hull(least.inf(), most.sup()).sqrt());
            }
        }
    }

    /// Whether the bounds of a pair became closer by something that matters.
    fn narrow(&mut self, a: usize, b: usize, to: Interval) -> bool {
        let old = self.lengths[a * self.points + b];
        let new = old.intersection(to);
        // Nothing left: no figure exists, and the search will say where.
        if new.is_empty() {
            return false;
        }
        self.lengths[a * self.points + b] = new;
        self.lengths[b * self.points + a] = new;
        let enough = 1e-9 * new.sup();
        new.inf() > old.inf() + enough || new.sup() < old.sup() - enough
    }

    /// Bounds of the squared distance of two points.
    pub fn squares(&self, a: usize, b: usize) -> [f64; 2] {
        let square = self.lengths[a * self.points + b].sqr();
        [square.inf(), square.sup()]
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
        let pairs = Pairs::new(&targets);
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
