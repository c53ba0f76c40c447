//! Which distances depend on each other, and which points they leave free to move.
//!
//! At generic coordinates the rows of the rigidity matrix, `(p_i − p_j)` in i's columns and
//! `(p_j − p_i)` in j's, are independent exactly if the distances are, and its null space is the
//! infinitesimal motions (Asimow, Roth, *The rigidity of graphs*, 1978). Coordinates drawn
//! modulo a prime of 61 bits are as good as generic: where the matrix has full rank the graph
//! *is* rigid, and a rank that is too small by bad luck has a probability below m / 2⁶⁰ for m
//! rows (Schwartz, Zippel). One method serves the plane and space alike.

use crate::elimination::Echelon;
use crate::equations::Ring;
use crate::order::{InOrder, each_once};
use crate::residues::{Residue, Residues};
use crate::statement::neighbours;

/// What the graph of the distances fixes and what not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rigidity {
    /// Distances that add something to those before them.
    pub rank: usize,
    /// A smallest set of distances that depend on each other (each one follows from the others),
    /// if there is one. The last of them is the first that adds nothing to those before it.
    pub circuit: Vec<usize>,
    /// The rigid parts with more points than dimensions, the one with most points first. Empty
    /// where the whole is rigid: then there is nothing to tell apart.
    pub bodies: Vec<Vec<usize>>,
}

/// Analyses the graph on `points` points with the given `edges`, which join different points.
pub fn rigidity(dimension: usize, points: usize, edges: &[[usize; 2]]) -> Rigidity {
    let matrix = Matrix::generic(dimension, points, edges);
    let (rows, circuit) = matrix.eliminate();
    let flexible = rows.rank < super::super::free_coordinates(dimension, points);
    let bodies = if flexible {
        matrix.bodies(&matrix.random_motion(&rows))
    } else {
        Vec::new()
    };
    Rigidity {
        rank: rows.rank,
        circuit: circuit.unwrap_or_default(),
        bodies,
    }
}

/// The row of the rigidity matrix for the distance of two points, in floats, where points have these places.
pub fn rigidity_row(dimension: usize, places: &[[f64; 3]], [i, j]: [usize; 2]) -> Vec<f64> {
    let mut row = vec![0.0; dimension * places.len()];
    for k in 0..dimension {
        let along = places[i][k] - places[j][k];
        (row[dimension * i + k], row[dimension * j + k]) = (along, -along);
    }
    row
}

/// The rigidity matrix at random coordinates modulo a prime.
struct Matrix<'a> {
    dimension: usize,
    edges: &'a [[usize; 2]],
    /// Coordinates, point by point.
    coordinates: Vec<Residue>,
    /// For each point the place at which its columns are eliminated.
    place: Vec<usize>,
}

impl<'a> Matrix<'a> {
    fn generic(dimension: usize, points: usize, edges: &'a [[usize; 2]]) -> Self {
        let mut residues = Residues::new(0x6b72_6177_6c00_0001);
        Matrix {
            dimension,
            edges,
            coordinates: (0..points * dimension).map(|_| residues.draw()).collect(),
            place: elimination_order(points, edges),
        }
    }

    /// Eliminates row by row, in the order of the edges.
    fn eliminate(&self) -> (Echelon<Residue>, Option<Vec<usize>>) {
        let size = (self.edges.len(), self.coordinates.len());
        Echelon::of(size, |index, row| {
            let [a, b] = self.edges[index];
            for k in 0..self.dimension {
                let difference = self.coordinate(a, k) - self.coordinate(b, k);
                row[self.place[a] * self.dimension + k] = difference;
                row[self.place[b] * self.dimension + k] = Residue::whole(0) - difference;
            }
        })
    }

    fn coordinate(&self, point: usize, axis: usize) -> Residue {
        self.coordinates[point * self.dimension + axis]
    }

    /// A random element of the null space, point by point.
    fn random_motion(&self, rows: &Echelon<Residue>) -> Vec<Residue> {
        let mut residues = Residues::new(0x6b72_6177_6c00_0002);
        let eliminated = rows.null_vector(|_| residues.draw());
        let d = self.dimension;
        self.place
            .iter()
            .flat_map(|&place| eliminated[place * d..(place + 1) * d].iter().copied())
            .collect()
    }

    /// The rigid parts under a random motion that keeps all distances: two points belong together
    /// if the motion keeps their distance too.
    fn bodies(&self, motion: &[Residue]) -> Vec<Vec<usize>> {
        let d = self.dimension;
        let points = self.place.len();
        let keeps = |a: usize, b: usize| {
            let along = |k: usize| {
                let apart = self.coordinate(a, k) - self.coordinate(b, k);
                apart * (motion[a * d + k] - motion[b * d + k])
            };
            let sum = (0..d).fold(Residue::whole(0), |sum, k| sum + along(k));
            sum == Residue::whole(0)
        };
        // A frame, d points that keep their distances, spans a body: the points that keep their
        // distances to all of the frame.
        let mut bodies: Vec<Vec<bool>> = Vec::new();
        let mut add_frame = |frame: &[usize]| {
            let known = bodies
                .iter()
                .any(|body| frame.iter().all(|&point| body[point]));
            if !known {
                let body = (0..points).map(|q| frame.iter().all(|&f| f == q || keeps(q, f)));
                bodies.push(body.collect());
            }
        };
        if d == 2 {
            for edge in self.edges {
                add_frame(edge);
            }
        } else {
            let joined = neighbours(points, self.edges.iter().copied());
            for (middle, ends) in joined.iter().enumerate() {
                for (i, &(a, _)) in ends.iter().enumerate() {
                    for &(b, _) in &ends[i + 1..] {
                        if a != b && keeps(a, b) {
                            add_frame(&[middle, a, b]);
                        }
                    }
                }
            }
        }
        let mut bodies: Vec<Vec<usize>> = bodies
            .into_iter()
            .map(|body| (0..points).filter(|&q| body[q]).collect())
            .filter(|body: &Vec<usize>| body.len() > d)
            .collect();
        bodies.order_by_key(|body| std::cmp::Reverse(body.len()));
        bodies
    }
}

/// For each point the place at which it is eliminated: always the one with fewest neighbours
/// next, which are then joined with each other as the elimination joins them. Keeps the rows
/// short.
fn elimination_order(points: usize, edges: &[[usize; 2]]) -> Vec<usize> {
    let neighbours = neighbours(points, edges.iter().copied()).into_iter();
    let neighbours = neighbours.map(|all| each_once(all.into_iter().map(|(p, _)| p)));
    let mut neighbours: Vec<Vec<usize>> = neighbours.collect();
    let mut place = vec![usize::MAX; points];
    for turn in 0..points {
        let Some(next) = (0..points)
            .filter(|&p| place[p] == usize::MAX)
            .min_by_key(|&p| neighbours[p].len())
        else {
            break;
        };
        place[next] = turn;
        let around = std::mem::take(&mut neighbours[next]);
        for &a in &around {
            let all = std::mem::take(&mut neighbours[a]).into_iter();
            let all = all.chain(around.iter().copied());
            neighbours[a] = each_once(all.filter(|&b| b != a && b != next));
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::free_coordinates;
    use proptest::prelude::*;

    /// The pebble game of Jacobs and Hendrickson (k = 2, l = 3), after Lee and Streinu: an exact
    /// count for the plane, by another route.
    fn pebble_rank(points: usize, edges: &[[usize; 2]]) -> usize {
        let mut out: Vec<Vec<usize>> = vec![Vec::new(); points];
        fn gather(
            out: &mut [Vec<usize>],
            from: usize,
            fixed: [usize; 2],
            seen: &mut [bool],
        ) -> bool {
            for i in 0..out[from].len() {
                let to = out[from][i];
                if seen[to] {
                    continue;
                }
                seen[to] = true;
                let free = !fixed.contains(&to) && out[to].len() < 2;
                if free || gather(out, to, fixed, seen) {
                    // The pebble on `to` takes over this edge.
                    out[from].swap_remove(i);
                    out[to].push(from);
                    return true;
                }
            }
            false
        }
        let mut rank = 0;
        for &[a, b] in edges {
            // Gather l + 1 = 4 pebbles on the ends of the edge.
            while out[a].len() + out[b].len() > 0 {
                let mut moved = false;
                for end in [a, b] {
                    let mut seen = vec![false; points];
                    (seen[a], seen[b]) = (true, true);
                    if !out[end].is_empty() && gather(&mut out, end, [a, b], &mut seen) {
                        moved = true;
                        break;
                    }
                }
                if !moved {
                    break;
                }
            }
            if out[a].is_empty() && out[b].is_empty() {
                out[a].push(b);
                rank += 1;
            }
        }
        rank
    }

    fn graph() -> impl Strategy<Value = (usize, Vec<[usize; 2]>)> {
        (2usize..12).prop_flat_map(|n| {
            let pairs: Vec<[usize; 2]> = (0..n)
                .flat_map(|a| (a + 1..n).map(move |b| [a, b]))
                .collect();
            let most = pairs.len().min(2 * n);
            (
                Just(n),
                prop::sample::subsequence(pairs, 0..=most).prop_shuffle(),
            )
        })
    }

    proptest! {
        #[test]
        fn agrees_with_the_pebble_game((n, edges) in graph()) {
            prop_assert_eq!(rigidity(2, n, &edges).rank, pebble_rank(n, &edges));
        }

        #[test]
        fn circuits_are_minimal((n, edges) in graph(), dimension in 2usize..4) {
            let found = rigidity(dimension, n, &edges);
            prop_assert_eq!(found.circuit.is_empty(), found.rank == edges.len());
            let circuit: Vec<[usize; 2]> = found.circuit.iter().map(|&e| edges[e]).collect();
            if !circuit.is_empty() {
                prop_assert_eq!(rigidity(dimension, n, &circuit).rank, circuit.len() - 1);
            }
            for left_out in 0..circuit.len() {
                let mut rest = circuit.clone();
                rest.remove(left_out);
                prop_assert_eq!(rigidity(dimension, n, &rest).rank, rest.len());
            }
        }

        #[test]
        fn bodies_are_rigid_and_maximal((n, edges) in graph()) {
            // A pair is rigid if its distance, added, raises no rank.
            let found = rigidity(2, n, &edges);
            let rigid = |a: usize, b: usize| {
                let more: Vec<[usize; 2]> = edges.iter().copied().chain([[a, b]]).collect();
                rigidity(2, n, &more).rank == found.rank
            };
            for body in &found.bodies {
                for q in 0..n {
                    let all = body.iter().all(|&p| p == q || rigid(p, q));
                    prop_assert_eq!(all, body.contains(&q));
                }
            }
        }
    }

    #[test]
    fn knows_the_octahedron() {
        let edges: Vec<[usize; 2]> = (0..6)
            .flat_map(|a| (a + 1..6).map(move |b| [a, b]))
            .filter(|&[a, b]| a + 3 != b)
            .collect();
        let found = rigidity(3, 6, &edges);
        assert_eq!(found.rank, free_coordinates(3, 6));
        assert_eq!((found.circuit.len(), found.bodies.len()), (0, 0));
    }

    #[test]
    fn sees_through_the_double_banana() {
        // Two K5 less an edge on the common, unjoined points 0 and 1: 18 distances, as many as
        // free coordinates, every count right, and yet it turns on the hinge 0-1.
        let mut edges = Vec::new();
        for banana in [[2, 3, 4], [5, 6, 7]] {
            for (i, &a) in banana.iter().enumerate() {
                edges.push([0, a]);
                edges.push([1, a]);
                edges.extend(banana[i + 1..].iter().map(|&b| [a, b]));
            }
        }
        let found = rigidity(3, 8, &edges);
        assert_eq!(found.rank, 17);
        assert_eq!(found.circuit.len(), 18);
        assert_eq!(found.bodies, [vec![0, 1, 2, 3, 4], vec![0, 1, 5, 6, 7]]);
    }

    #[test]
    fn a_thousand_points_take_no_time() {
        // A strip of triangles, and a sphere-like stack of tetrahedra.
        let strip = |d: usize| -> Vec<[usize; 2]> {
            (0..1000usize)
                .flat_map(|p| (p.saturating_sub(d)..p).map(move |q| [q, p]))
                .collect()
        };
        assert_eq!(rigidity(2, 1000, &strip(2)).rank, 1997);
        assert_eq!(rigidity(3, 1000, &strip(3)).rank, 2994);
    }
}
