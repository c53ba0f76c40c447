//! Bounds of the distances of all pairs of points, by the problem's distances alone.

use super::construct::not_negative;
use crate::interval::{Interval, checked, hull, point};

/// The bounds, of distances.
#[derive(Debug, Clone)]
pub struct Pairs {
    points: usize,
    lengths: Vec<Interval>,
}

/// How often the triangles are gone through at most. Each time all bounds are right: more would only be closer.
const ROUNDS: usize = 8;
/// In place of a bound where none is known. It holds for every figure: lengths and parameters in a cover are below
/// 1e60 (`geometry`, `format`), so that no plan of fewer than 1e30 steps places a point this far away.
const FAR: f64 = 1e100;

impl Pairs {
    /// For points with these squared distances.
    ///
    /// Two points joined to both ends of a bar, at x and y along it and h and k from its line, are
    /// √((x − y)² + h² + k² − 2hk cos θ) apart, θ being the angle between their half planes. All else follows from
    /// the triangle inequality |ak| − |kb| ≤ |ab| ≤ |ak| + |kb|, which is used often enough: every bound on the way
    /// holds.
    pub fn new(points: usize, edges: &[[usize; 2]], squares: &[Interval]) -> Pairs {
        let mut pairs = Pairs {
            points,
            lengths: vec![hull(0.0, FAR); points * points],
        };
        let mut given = vec![None; points * points];
        for (&[a, b], &square) in edges.iter().zip(squares) {
            given[a * points + b] = Some(square);
            given[b * points + a] = Some(square);
            pairs.narrow(a, b, square.sqrt());
        }
        for (&[c, d], &bar) in edges.iter().zip(squares) {
            let placed = |p: usize| {
                let (r, s) = (given[c * points + p]?, given[d * points + p]?);
                let x = (r - s + bar) / (point(2.0) * bar.sqrt());
                let height = r - x.sqr();
                Some((p, x, not_negative(height).sqrt()))
            };
            let beside: Vec<_> = (0..points).filter_map(placed).collect();
            for &(p, x, h) in &beside {
                for &(q, y, k) in beside.iter().filter(|other| other.0 < p) {
                    let (near, far) =
                        ((x - y).sqr() + (h - k).sqr(), (x - y).sqr() + (h + k).sqr());
                    if let Some(square) = checked(near.inf(), far.sup()) {
                        pairs.narrow(p, q, square.sqrt());
                    }
                }
            }
        }
        for _ in 0..ROUNDS {
            let mut changed = false;
            for k in 0..points {
                for a in (0..points).filter(|&a| a != k) {
                    for b in (0..a).filter(|&b| b != k) {
                        let (ak, kb) = (pairs.length(a, k), pairs.length(k, b));
                        let least = (ak - kb).inf().max((kb - ak).inf()).max(0.0);
                        let most = (ak + kb).sup();
                        if least <= most {
                            changed |= pairs.narrow(a, b, hull(least, most));
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

    fn length(&self, a: usize, b: usize) -> Interval {
        self.lengths[a * self.points + b]
    }

    /// Whether the bounds of a pair became closer by something that matters.
    fn narrow(&mut self, a: usize, b: usize, to: Interval) -> bool {
        let old = self.length(a, b);
        let new = old.intersection(to);
        // Where nothing is left there is no figure. What is left out then is proof of that, and nothing else.
        if new.is_empty() {
            return false;
        }
        self.lengths[a * self.points + b] = new;
        self.lengths[b * self.points + a] = new;
        let enough = 1e-9 * new.sup();
        new.inf() > old.inf() + enough || new.sup() < old.sup() - enough
    }

    /// The ends of the bounds of a squared distance.
    pub fn squares(&self, a: usize, b: usize) -> [f64; 2] {
        let square = self.square(a, b);
        [square.inf(), square.sup()]
    }

    /// Of a squared distance.
    pub fn square(&self, a: usize, b: usize) -> Interval {
        self.length(a, b).sqr()
    }
}
