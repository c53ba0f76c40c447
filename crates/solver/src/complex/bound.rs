//! Proved bounds on the number of complex figures with given distances.
//!
//! # Multi-homogeneous Bézout bound
//! Fix an edge (in the plane) or a triangle (in space): that takes out all motions, and of the reflections those
//! that leave it as it is stay. Give every other point v its coordinates and s_v = |v|² for unknowns, D + 1 in
//! all, with the equations s_v = |v|², of degree 2 in the unknowns of v; s_v − 2 p·v = d² − |p|² for a distance to a
//! fixed point p; and s_u + s_v − 2 u·v = d² otherwise, of degree 1 in the unknowns of u and of v. The number of isolated
//! solutions, each with its multiplicity, is at most the coefficient of Π X_v^{D+1} in the product of the degrees,
//! Π 2 X_v · Π X_v · Π (X_u + X_v): two to the number of points that are not fixed, times the number of ways to give
//! every edge to one of its ends so that each such point has D (Bartzos, Emiris, Schicho, *On the multihomogeneous
//! Bézout bound on the number of embeddings of minimally rigid graphs*, 2020). Counted are figures up to rotation.
//!
//! # Numbers of realisations in the plane
//! For a minimally rigid graph in the plane the number of complex figures up to rotation with generic lengths is
//! known exactly, by a recursion (Capco, Gallet, Grasegger, Koutschan, Lubbes, Schicho, *The number of realizations of a Laman
//! graph*, 2018): see `laman`. It is the degree of the map from figures to squared lengths, so no choice of lengths has
//! more isolated figures.

use super::laman;
use super::system::System;
use super::total_degree::Degrees;
use std::collections::HashMap;

/// A bound on the number of isolated complex solutions up to rotation.
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    /// The bound.
    pub count: u128,
    /// Where it comes from, in words.
    pub source: String,
    /// Whether curves and surfaces of solutions count, too, each at least once: with as many isolated solutions there are none.
    pub counts_curves: bool,
    /// Whether somebody cites it: then it is not proved here, and what rests on it holds if it does.
    pub is_cited: bool,
    /// The points that it holds fixed: their distances must not make them isotropic.
    pub fixed: Vec<usize>,
}

/// The bound of equations in unknown numbers that are not coordinates of points: the least multi-homogeneous Bézout number that is found
/// for groups of unknowns ([`groups`]).
///
/// [`groups`]: super::groups
pub fn of_equations(system: &System) -> Option<Bound> {
    let groups = Degrees::of(system)?.groups;
    let last = groups.of.iter().max().copied().unwrap_or(0);
    Some(Bound {
        count: groups.count,
        source: match last {
            0 => "Bézout's bound, the product of the degrees of the equations".to_owned(),
            _ => format!(
                "the multi-homogeneous Bézout bound of the equations (unknowns in {} groups)",
                last + 1
            ),
        },
        counts_curves: last == 0,
        is_cited: false,
        fixed: Vec::new(),
    })
}

/// The least bound that is known for a graph, all of whose edges are distances.
///
/// `None` where the graph has no edge, or no triangle in space.
pub fn bound(dimension: usize, points: usize, edges: &[[usize; 2]]) -> Option<Bound> {
    let bezout = fixed_sets(dimension, points, edges)
        .into_iter()
        .filter_map(|fixed| Some((bezout(dimension, points, edges, &fixed)?, fixed)))
        .min_by_key(|(count, _)| *count)?;
    let (count, fixed) = bezout;
    let number = (dimension == 2).then(|| laman::number(edges)).flatten();
    let (count, source) = match number.filter(|number| *number <= count) {
        Some(number) => (
            number,
            "the number of realisations of a minimally rigid graph in the plane (Capco et al. 2018)",
        ),
        None => (
            count,
            "the multi-homogeneous Bézout bound of the graph (Bartzos, Emiris, Schicho 2020)",
        ),
    };
    Some(Bound {
        count,
        source: source.to_owned(),
        counts_curves: false,
        is_cited: false,
        fixed,
    })
}

/// The edges, or the triangles, of a graph.
pub fn fixed_sets(dimension: usize, points: usize, edges: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let mut joined = vec![vec![false; points]; points];
    for &[a, b] in edges {
        joined[a][b] = true;
        joined[b][a] = true;
    }
    let mut sets = Vec::new();
    for a in 0..points {
        for b in (a + 1..points).filter(|&b| joined[a][b]) {
            if dimension == 2 {
                sets.push(vec![a, b]);
                continue;
            }
            let third = (b + 1..points).filter(|&c| joined[a][c] && joined[b][c]);
            sets.extend(third.map(|c| vec![a, b, c]));
        }
    }
    sets
}

/// The multi-homogeneous Bézout bound with some points fixed; `None` if it is beyond all numbers.
pub fn bezout(
    dimension: usize,
    points: usize,
    edges: &[[usize; 2]],
    fixed: &[usize],
) -> Option<u128> {
    let is_fixed = |p: usize| fixed.contains(&p);
    // What every point still has to be given, as edges are given one after the other.
    let mut left = vec![dimension as u8; points];
    let mut open = Vec::new();
    for &[a, b] in edges {
        match (is_fixed(a), is_fixed(b)) {
            (true, true) => {}
            (true, false) | (false, true) => {
                let free = if is_fixed(a) { b } else { a };
                match left[free].checked_sub(1) {
                    Some(less) => left[free] = less,
                    // More than it can take: there is no way at all.
                    None => return Some(0),
                }
            }
            (false, false) => open.push([a, b]),
        }
    }
    let free: Vec<usize> = (0..points).filter(|&p| !is_fixed(p)).collect();
    let ways = orientations(&mut left, &open, &free)?;
    (0..free.len()).try_fold(ways, |product, _| product.checked_mul(2))
}

/// The number of ways to give every edge to one of its ends so that each point gets what it has left.
///
/// Points are taken away one after the other, each with all of its edges; what matters of a partial choice is
/// what the points still there have left.
fn orientations(left: &mut [u8], edges: &[[usize; 2]], free: &[usize]) -> Option<u128> {
    let mut remaining: Vec<[usize; 2]> = edges.to_vec();
    let mut rest: Vec<usize> = free.to_vec();
    let mut states: HashMap<Vec<u8>, u128> = HashMap::from([(left.to_vec(), 1)]);
    while !rest.is_empty() {
        // The point with the fewest edges keeps the number of states low.
        let degree = |p: usize| remaining.iter().filter(|e| e.contains(&p)).count();
        let at = (0..rest.len()).min_by_key(|&k| degree(rest[k]))?;
        let point = rest.swap_remove(at);
        let (its, others): (Vec<_>, Vec<_>) =
            remaining.into_iter().partition(|e| e.contains(&point));
        remaining = others;
        for edge in its {
            let mut next: HashMap<Vec<u8>, u128> = HashMap::new();
            for (state, count) in &states {
                for end in edge {
                    if state[end] > 0 {
                        let mut state = state.clone();
                        state[end] -= 1;
                        let sum = next.entry(state).or_default();
                        *sum = sum.checked_add(*count)?;
                    }
                }
            }
            states = next;
        }
        states.retain(|state, _| state[point] == 0);
    }
    // All edges are given, and nothing is left to any point.
    Some(states.values().copied().sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Problem;

    fn of(problem: &Problem) -> u128 {
        let edges: Vec<[usize; 2]> = problem.distances.iter().map(|d| d.points).collect();
        bound(problem.dimension, problem.points.len(), &edges)
            .unwrap()
            .count
    }

    fn shipped(name: &str) -> Problem {
        Problem::read(format!(
            "{}/../../problems/{name}.toml",
            env!("CARGO_MANIFEST_DIR")
        ))
        .unwrap()
    }

    #[test]
    fn known_bounds() {
        assert_eq!(of(&shipped("octahedron")), 16);
        assert_eq!(of(&shipped("k33")), 16);
        assert_eq!(of(&shipped("prism")), 24);
        // A triangle, a tetrahedron.
        assert_eq!(bound(2, 3, &[[0, 1], [1, 2], [0, 2]]).unwrap().count, 2);
        let six = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
        assert_eq!(bound(3, 4, &six).unwrap().count, 2);
        // K3,3 on the sphere, which the Bézout bound is about as well, has 32.
        let edges: Vec<[usize; 2]> = shipped("k33").distances.iter().map(|d| d.points).collect();
        assert_eq!(bezout(2, 6, &edges, &edges[0]).unwrap(), 32);
    }

    #[test]
    fn the_true_icosahedron() {
        let problem = shipped("icosahedron");
        let mut edges: Vec<[usize; 2]> = problem.distances.iter().map(|d| d.points).collect();
        for edge in &mut edges {
            // As printed 8-11 stands in the place of 10-11.
            if *edge == [7, 10] || *edge == [10, 7] {
                *edge = [9, 10];
            }
        }
        let bound = bound(3, 12, &edges).unwrap();
        assert_eq!(bound.count, 512 * 106);
    }
}
