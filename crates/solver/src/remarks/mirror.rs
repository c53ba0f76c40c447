//! Parts that can be mirrored without changing a distance.

use super::{Remark, joined};
use crate::order::InOrder;
use crate::problem::Problem;

/// Most sets of points that are tried for a hinge.
const MOST: usize = 20_000;

/// Two points in the plane, three in space, without which the others fall apart: each part but the largest can
/// be mirrored.
pub(super) fn parts(problem: &Problem) -> Vec<Remark> {
    let n = problem.points.len();
    let neighbours = joined(problem).into_iter();
    let neighbours: Vec<Vec<usize>> = neighbours
        .map(|all| all.into_iter().map(|(p, _)| p).collect())
        .collect();
    let mut found: Vec<Remark> = Vec::new();
    for hinge in hinges(n, problem.dimension).take(MOST) {
        let mut parts = components(&neighbours, &hinge);
        if parts.len() < 2 {
            continue;
        }
        parts.order_by_key(Vec::len);
        // The largest stays; of two of the same size the one with the first points.
        parts.pop();
        for part in parts {
            let known = found.iter().any(
                |remark| matches!(remark, Remark::Mirrored { part: other, .. } if *other == part),
            );
            // Where part of the hinge is of no use to it, another hinge tells.
            let holds = |h: &usize| part.iter().any(|p| neighbours[*p].contains(h));
            if !known && hinge.iter().all(holds) {
                let hinge = hinge.clone();
                found.push(Remark::Mirrored { part, hinge });
            }
        }
    }
    found
}

/// All sets of so many points.
fn hinges(n: usize, count: usize) -> impl Iterator<Item = Vec<usize>> {
    let pairs = (0..n).flat_map(move |a| (a + 1..n).map(move |b| vec![a, b]));
    pairs.flat_map(move |pair| -> Box<dyn Iterator<Item = Vec<usize>>> {
        if count == 2 {
            return Box::new(std::iter::once(pair));
        }
        let last = pair[1];
        Box::new((last + 1..n).map(move |c| [pair.as_slice(), &[c]].concat()))
    })
}

/// What is joined without some points.
fn components(neighbours: &[Vec<usize>], without: &[usize]) -> Vec<Vec<usize>> {
    let mut seen = vec![false; neighbours.len()];
    without.iter().for_each(|&p| seen[p] = true);
    let mut all = Vec::new();
    for start in 0..neighbours.len() {
        if seen[start] {
            continue;
        }
        seen[start] = true;
        let mut part = vec![start];
        let mut at = 0;
        while at < part.len() {
            for &next in &neighbours[part[at]] {
                if !std::mem::replace(&mut seen[next], true) {
                    part.push(next);
                }
            }
            at += 1;
        }
        part.sort_unstable();
        all.push(part);
    }
    all
}
