//! What holds a molecule: as many constraints as it has free coordinates, those of bonds first.

use super::skeleton::{neighbours, steps};
use crate::interval::vector::{cross, dot, length, minus};
use crate::linalg::Span;
use crate::order::InOrder;
use crate::places::array;
use crate::problem::rigidity;
use std::collections::BTreeSet;

/// A thing that is held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Held {
    /// Two atoms at a distance.
    Distance([usize; 2]),
    /// Three atoms on one line, the middle one in the middle.
    Straight([usize; 3]),
    /// Four atoms in one plane.
    Flat([usize; 4]),
}

/// Bonds go straight on where the sine of the angle is less than this.
const STRAIGHT: f64 = 0.01;
/// Four atoms are in one plane if each is nearer than this to that of the others, in ångström.
const FLAT: f64 = 0.01;

type Place = [f64; 3];

/// What holds a molecule with atoms at these places, without one to spare: distances, and where these cannot hold what is
/// straight or flat, that it is so; and the pairs of atoms that bonds and bond angles tell the distances of, whether they are among that or not. `None`: all atoms are on
/// one line, or so nearly that nothing holds them.
pub fn hold(places: &[Place], bonds: &[[usize; 2]]) -> Option<(Vec<Held>, Vec<[usize; 2]>)> {
    let candidates = Candidates::new(places, bonds);
    let told = candidates.pairs.iter().filter(|(rank, _)| *rank < 2);
    let told = told.map(|(_, pair)| *pair).collect();
    Some((held(places, &candidates)?, told))
}

fn held(places: &[Place], candidates: &Candidates) -> Option<Vec<Held>> {
    let distances = candidates.chosen_by_rigidity(places.len());
    let needed = 3 * places.len() - 6;
    if let Some(edges) = distances {
        let mut rank = Rank::new(places);
        let all: Vec<Held> = edges.into_iter().map(Held::Distance).collect();
        if all.iter().all(|held| rank.take(held)) {
            return Some(all);
        }
    }
    let mut rank = Rank::new(places);
    let mut out = Vec::new();
    for held in candidates.with_shapes(places) {
        if rank.rank() == needed {
            break;
        }
        if rank.take(&held) {
            out.push(held);
        }
    }
    (rank.rank() == needed).then_some(out)
}

/// Pairs of atoms in the order in which their distances are wanted.
struct Candidates {
    near: Vec<BTreeSet<usize>>,
    /// Steps along bonds between (with those of rings before others), and the atoms.
    pairs: Vec<(usize, [usize; 2])>,
    /// Three bonds of rings in a row.
    torsions: Vec<[usize; 4]>,
}

impl Candidates {
    fn new(places: &[Place], bonds: &[[usize; 2]]) -> Self {
        let n = places.len();
        let apart = |a: usize, b: usize| length(minus(places[a], places[b]));
        let near = neighbours(n, bonds);
        let in_ring: BTreeSet<[usize; 2]> = bonds
            .iter()
            .filter(|&&[a, b]| {
                steps(&near, a, |way| way == [a, b] || way == [b, a])[b] != usize::MAX
            })
            .map(|&[a, b]| [a.min(b), a.max(b)])
            .collect();
        let is_ring = |a: usize, b: usize| in_ring.contains(&[a.min(b), a.max(b)]);
        let mut torsions: Vec<[usize; 4]> = Vec::new();
        let mut of_rings: BTreeSet<[usize; 2]> = BTreeSet::new();
        for &[b, c] in &in_ring {
            for &a in near[b].iter().filter(|&&a| a != c && is_ring(a, b)) {
                for &d in near[c]
                    .iter()
                    .filter(|&&d| d != b && d != a && is_ring(c, d))
                {
                    of_rings.insert([a.min(d), a.max(d)]);
                    torsions.push([a, b, c, d]);
                }
            }
        }
        let mut candidates: Vec<(usize, f64, [usize; 2])> = Vec::new();
        for a in 0..n {
            let steps = steps(&near, a, |_| false);
            for b in a + 1..n {
                let rank = match steps[b] {
                    1 => 0,
                    2 => 1,
                    _ if of_rings.contains(&[a, b]) => 2,
                    far => far.saturating_add(1).max(3),
                };
                candidates.push((rank, apart(a, b), [a, b]));
            }
        }
        candidates.order_by(|x, y| x.0.cmp(&y.0).then(x.1.total_cmp(&y.1)));
        Candidates {
            near,
            pairs: candidates.into_iter().map(|c| (c.0, c.2)).collect(),
            torsions,
        }
    }

    /// Distances that hold a molecule of which no part is straight or flat.
    fn chosen_by_rigidity(&self, n: usize) -> Option<Vec<[usize; 2]>> {
        // As few at a time as can be enough: each dependent one is found and left out.
        let needed = 3 * n - 6;
        let mut edges: Vec<[usize; 2]> = Vec::new();
        let mut rest = self.pairs.iter().map(|pair| pair.1);
        while edges.len() < needed {
            edges.extend(rest.by_ref().take(needed - edges.len()));
            let found = rigidity(3, n, &edges);
            let mut circuit = found.circuit;
            while let Some(&last) = circuit.last() {
                edges.remove(last);
                circuit = rigidity(3, n, &edges).circuit;
            }
            if edges.len() < needed && rest.len() == 0 {
                return None;
            }
        }
        Some(edges)
    }

    /// All that may be held: bonds, what is straight, bond angles, what is flat, torsions of rings, and what is further apart.
    fn with_shapes(&self, places: &[Place]) -> Vec<Held> {
        let of_rank = |low: usize, high: usize| {
            let pairs = self.pairs.iter();
            pairs
                .filter(move |(rank, _)| (low..high).contains(rank) || low == *rank)
                .map(|(_, pair)| Held::Distance(*pair))
        };
        let mut out: Vec<Held> = of_rank(0, 1).collect();
        for (b, near) in self.near.iter().enumerate() {
            for &a in near {
                for &c in near.range(a + 1..) {
                    let (u, v) = (minus(places[a], places[b]), minus(places[c], places[b]));
                    if length(cross(u, v)) < STRAIGHT * length(u) * length(v) && dot(u, v) < 0.0 {
                        out.push(Held::Straight([a, b, c]));
                    }
                }
            }
        }
        out.extend(of_rank(1, 2));
        let mut flat: Vec<[usize; 4]> = Vec::new();
        for (b, near) in self.near.iter().enumerate() {
            let near: Vec<usize> = near.iter().copied().collect();
            for (k, &a) in near.iter().enumerate() {
                for (l, &c) in near.iter().enumerate().skip(k + 1) {
                    flat.extend(near[l + 1..].iter().map(|&d| [a, b, c, d]));
                }
            }
        }
        flat.extend(&self.torsions);
        let shapes = |flat: Vec<[usize; 4]>| -> Vec<Held> {
            let ordered = flat.into_iter().filter_map(|four| ordered(places, four));
            ordered.map(Held::Flat).collect()
        };
        out.extend(shapes(flat));
        out.extend(of_rank(2, usize::MAX));
        out.extend(of_rank(usize::MAX, usize::MAX));
        // Bonds in a row outside rings that are flat: double bonds, and what hangs on them.
        let mut flat: Vec<[usize; 4]> = Vec::new();
        for (b, near) in self.near.iter().enumerate() {
            for &c in near.range(b + 1..) {
                for &a in near.iter().filter(|&&a| a != c) {
                    let ends = self.near[c].iter().filter(|&&d| d != b && d != a);
                    flat.extend(ends.map(|&d| [a, b, c, d]));
                }
            }
        }
        // And any others, where bonds do not say enough.
        let n = places.len();
        let third = (2..n).max_by(|&p, &q| {
            let area = |k: usize| area(places, [0, 1, k]);
            area(p).total_cmp(&area(q))
        });
        if let Some(third) = third {
            flat.extend((2..n).filter(|&p| p != third).map(|p| [0, 1, third, p]));
        }
        out.extend(shapes(flat));
        out
    }
}

/// Four atoms in one plane, if they are, the three of the largest triangle first.
fn ordered(places: &[Place], four: [usize; 4]) -> Option<[usize; 4]> {
    let without = |k: usize| -> [usize; 3] { array(|i| four[(k + 1 + i) % 4]) };
    let last = (0..4).max_by(|&k, &l| {
        let area = |k: usize| area(places, without(k));
        area(k).total_cmp(&area(l))
    })?;
    let [a, b, c] = without(last);
    let normal = cross(minus(places[b], places[a]), minus(places[c], places[a]));
    let size = length(normal);
    let height = dot(normal, minus(places[four[last]], places[a])).abs();
    (size > 1e-3 && height < FLAT * size).then_some([a, b, c, four[last]])
}

/// Twice the area of a triangle.
fn area(places: &[Place], [a, b, c]: [usize; 3]) -> f64 {
    length(cross(
        minus(places[b], places[a]),
        minus(places[c], places[a]),
    ))
}

/// The directions in which what is held so far may not move, in floats.
struct Rank<'a> {
    places: &'a [Place],
    span: Span,
}

impl<'a> Rank<'a> {
    fn new(places: &'a [Place]) -> Self {
        Rank {
            places,
            span: Span::default(),
        }
    }

    fn rank(&self) -> usize {
        self.span.rank()
    }

    /// Takes a thing if it says something new, and nothing twice.
    fn take(&mut self, held: &Held) -> bool {
        let rows = self.rows(held);
        self.span.take(rows)
    }

    fn rows(&self, held: &Held) -> Vec<Vec<f64>> {
        let places = self.places;
        let row = |parts: &[(usize, Place, f64)]| -> Vec<f64> {
            let mut row = vec![0.0; 3 * places.len()];
            for (point, direction, factor) in parts {
                for k in 0..3 {
                    row[3 * point + k] += factor * direction[k];
                }
            }
            row
        };
        match *held {
            Held::Distance([a, b]) => {
                let along = minus(places[b], places[a]);
                vec![row(&[(a, along, -1.0), (b, along, 1.0)])]
            }
            Held::Straight([a, b, c]) => {
                let along = minus(places[c], places[a]);
                let s = dot(minus(places[b], places[a]), along) / dot(along, along);
                let least = (0..3).min_by(|&i, &j| along[i].abs().total_cmp(&along[j].abs()));
                let mut axis = [0.0; 3];
                axis[least.unwrap_or(0)] = 1.0;
                let across = cross(along, axis);
                [across, cross(along, across)]
                    .map(|e| row(&[(b, e, 1.0), (a, e, s - 1.0), (c, e, -s)]))
                    .to_vec()
            }
            Held::Flat([a, b, c, d]) => {
                let (u, v, w) = (
                    minus(places[b], places[a]),
                    minus(places[c], places[a]),
                    minus(places[d], places[a]),
                );
                let normal = cross(u, v);
                let size = dot(normal, normal);
                let s = dot(cross(w, v), normal) / size;
                let t = dot(cross(u, w), normal) / size;
                vec![row(&[
                    (d, normal, 1.0),
                    (a, normal, s + t - 1.0),
                    (b, normal, -s),
                    (c, normal, -t),
                ])]
            }
        }
    }
}
