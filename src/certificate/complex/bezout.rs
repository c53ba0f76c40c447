//! The multi-homogeneous Bézout bound, counted edge by edge.
//!
//! With some points fixed and s_v = |p_v|² as one more unknown for each other point v, every equation is linear in
//! (p_v, s_v) for each of its points, and |p_v|² = s_v is quadratic: the number of isolated solutions is at most 2 for
//! each free point times the number of ways to give every edge to one of its free ends so that each gets as many as there
//! are dimensions (Bartzos, Emiris, Schicho, *On the multihomogeneous Bézout bound on the number of embeddings of
//! minimally rigid graphs*, 2020).

use crate::problem::Problem;
use std::collections::HashMap;

/// The bound; `None`: it is beyond all numbers.
pub fn bound(problem: &Problem, fixed: &[usize]) -> Option<u128> {
    let is_free = |p: usize| !fixed.contains(&p);
    let mut edges: Vec<Vec<usize>> = problem
        .distances
        .iter()
        .map(|d| d.points.into_iter().filter(|&p| is_free(p)).collect())
        .collect();
    edges.retain(|ends: &Vec<usize>| !ends.is_empty());
    edges.sort();
    // Per point how many edges it has been given.
    let none = vec![0usize; problem.points.len()];
    let mut ways: HashMap<Vec<usize>, u128> = HashMap::from([(none, 1)]);
    for ends in &edges {
        let mut next: HashMap<Vec<usize>, u128> = HashMap::new();
        for (given, count) in &ways {
            for &end in ends {
                if given[end] < problem.dimension {
                    let mut given = given.clone();
                    given[end] += 1;
                    let sum = next.entry(given).or_insert(0);
                    *sum = sum.checked_add(*count)?;
                }
            }
        }
        ways = next;
    }
    let free = (0..problem.points.len()).filter(|&p| is_free(p));
    let full: Vec<usize> = (0..problem.points.len())
        .map(|p| if is_free(p) { problem.dimension } else { 0 })
        .collect();
    let ways = ways.get(&full).copied().unwrap_or(0);
    free.fold(Some(ways), |product, _| product?.checked_mul(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_count_point_by_point() {
        for (name, count) in [("octahedron", 16), ("disulfide", 128)] {
            let problem = Problem::read(format!("problems/{name}.toml")).unwrap();
            let edges: Vec<[usize; 2]> = problem.distances.iter().map(|d| d.points).collect();
            let mut least = u128::MAX;
            for fixed in crate::complex::bound::fixed_sets(3, problem.points.len(), &edges) {
                let here = bound(&problem, &fixed).unwrap();
                let other = crate::complex::bound::bezout(3, problem.points.len(), &edges, &fixed);
                assert_eq!(Some(here), other, "{name} {fixed:?}");
                least = least.min(here);
            }
            assert_eq!(least, count, "{name}");
        }
    }
}
