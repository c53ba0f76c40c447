//! The multi-homogeneous Bézout bound, counted edge by edge.
//!
//! With some points fixed and s_v = |p_v|² as one more unknown for each other point v, every equation is linear in
//! (p_v, s_v) for each of its points, and |p_v|² = s_v is quadratic: the number of isolated solutions is at most 2 for
//! each free point times the number of ways to give every edge to one of its free ends so that each gets as many as there
//! are dimensions (Bartzos, Emiris, Schicho, *On the multihomogeneous Bézout bound on the number of embeddings of
//! minimally rigid graphs*, 2020).

use crate::problem::Problem;
use std::collections::{BTreeMap, HashMap};

/// As many ways to have given edges to points are looked at, at a time.
const MOST: usize = 1 << 18;

/// The edges, point after point: next is always a point that needs the fewest edges more, so that few points have got
/// some of their edges and wait for others. The order changes nothing but the work.
fn ordered(mut edges: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
    edges.sort();
    let mut out: Vec<Vec<usize>> = Vec::with_capacity(edges.len());
    while !edges.is_empty() {
        let mut left: BTreeMap<usize, usize> = BTreeMap::new();
        for &end in edges.iter().flatten() {
            *left.entry(end).or_default() += 1;
        }
        let begun = |end: usize| out.iter().flatten().any(|&other| other == end);
        let next = left
            .iter()
            .min_by_key(|&(&end, &count)| (count, !begun(end)));
        let next = next.map(|(&end, _)| end);
        let (own, others) = edges
            .into_iter()
            .partition(|ends| ends.iter().any(|&end| Some(end) == next));
        edges = others;
        let own: Vec<Vec<usize>> = own;
        out.extend(own);
    }
    out
}

/// The bound; `None`: it is beyond all numbers, or too much work.
pub fn bound(problem: &Problem, fixed: &[usize]) -> Option<u128> {
    let is_free = |p: usize| !fixed.contains(&p);
    let mut edges: Vec<Vec<usize>> = problem
        .distances
        .iter()
        .map(|d| d.points.into_iter().filter(|&p| is_free(p)).collect())
        .collect();
    edges.retain(|ends: &Vec<usize>| !ends.is_empty());
    let edges = ordered(edges);
    // Per point how many edges it has been given.
    let none = vec![0usize; problem.points.len()];
    let mut ways: HashMap<Vec<usize>, u128> = HashMap::from([(none, 1)]);
    for (e, ends) in edges.iter().enumerate() {
        // A point of which this is the last edge has to have as many as there are dimensions.
        let is_last = |end: usize| !edges[e + 1..].iter().flatten().any(|&other| other == end);
        let last: Vec<usize> = ends.iter().copied().filter(|&end| is_last(end)).collect();
        let mut next: HashMap<Vec<usize>, u128> = HashMap::new();
        for (given, count) in &ways {
            for &end in ends {
                if given[end] < problem.dimension {
                    let mut given = given.clone();
                    given[end] += 1;
                    if last.iter().any(|&end| given[end] != problem.dimension) {
                        continue;
                    }
                    let sum = next.entry(given).or_insert(0);
                    *sum = sum.checked_add(*count)?;
                }
            }
        }
        if next.len() > MOST {
            return None;
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

    /// Each new point joined to three earlier ones, in an order of points that has nothing to do with that: 2 for each.
    #[test]
    fn many_points_are_no_work() {
        let count = 60;
        let name = |p: usize| format!("p{}", (p * 37) % 61);
        let mut problem = Problem::build("chain", 3);
        for p in 0..count {
            let at = [p as f64, (p * p % 7) as f64, (p * p % 5) as f64].map(|x| x.to_string());
            problem = problem.point(&name(p), [&*at[0], &*at[1], &*at[2]]);
        }
        for p in 1..count {
            let mut earlier = vec![p - 1];
            if p > 1 {
                earlier.push(p - 2);
            }
            if p > 2 {
                earlier.push((p - 3) / 2);
            }
            for q in earlier {
                problem = problem.distance(&name(p), &name(q), "40");
            }
        }
        let problem = problem.finish().unwrap();
        let fixed = [0, 1, 2].map(|p| {
            let points = &problem.points;
            points
                .iter()
                .position(|point| point.name == name(p))
                .unwrap()
        });
        assert_eq!(bound(&problem, &fixed), Some(1 << (count - 3)));
    }

    #[test]
    fn agrees_with_the_count_point_by_point() {
        for (name, count) in [("octahedron", 16), ("disulfide", 128)] {
            let problem = Problem::read(format!("../../problems/{name}.toml")).unwrap();
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
