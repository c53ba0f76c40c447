//! Finding a plan with few driving parameters in the constraint graph.

use super::Plan;
use crate::order::InOrder;
use crate::places::Each as _;
use crate::statement::neighbours;
use crate::system::{Edge, Homotopy};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashSet};

/// Bounds the search: `SEARCH / n²` sets of points are kept for each number of driving
/// parameters. For a dozen points those are nearly all that matter and the number found is the
/// least possible; for a hundred it is a beam of twenty.
const SEARCH: usize = 200_000;

impl Plan {
    /// Derives a plan from the reference and the distances of the problem.
    ///
    /// Points are put in an order in which few of them have less than `dimension` distances to
    /// earlier ones: each that is missing costs a driving parameter. Where a point has more than
    /// it needs, those are used that are farthest from a boundary configuration in the sketch,
    /// and the reference points of driving parameters are placed to suit the sketch.
    pub fn derive(homotopy: &Homotopy) -> Plan {
        Self::derive_for(homotopy, &homotopy.edges)
    }

    /// Likewise from other distances, where more equations than the problem's distances are of their form.
    pub fn derive_for(homotopy: &Homotopy, edges: &[Edge]) -> Plan {
        let graph = Graph::new(homotopy, edges);
        let order = graph.order();
        let plan = graph.plan(homotopy, &order);
        graph.with_shorter_arms(homotopy, &order, plan)
    }
}

/// A set of points.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Set(Vec<u64>);

impl Set {
    fn has(&self, p: usize) -> bool {
        self.0[p / 64] >> (p % 64) & 1 == 1
    }

    fn add(&mut self, p: usize) {
        self.0[p / 64] |= 1 << (p % 64);
    }
}

/// A partial order of construction.
#[derive(Clone)]
struct Partial {
    placed: Set,
    order: Vec<usize>,
}

/// A point to be constructed, the number of its arms, and its neighbours among the earlier
/// points with the distances to them.
pub(super) type Placed = (usize, usize, Vec<(usize, usize)>);

pub(super) struct Graph {
    pub(super) dimension: usize,
    /// For each point its neighbours and the distances to them.
    neighbours: Vec<Vec<(usize, usize)>>,
    reference: Vec<usize>,
    /// The lengths of all distances in the sketch.
    pub(super) lengths: Vec<f64>,
}

impl Graph {
    fn new(homotopy: &Homotopy, edges: &[Edge]) -> Self {
        let in_sketch = |(e, edge): (usize, &Edge)| match homotopy.lengths.get(e) {
            Some(length) => length.value(0.0),
            None => {
                let [a, b] = edge.points.each(|p| p * homotopy.dimension);
                let of_axis = |k: usize| (homotopy.sketch[a + k] - homotopy.sketch[b + k]).powi(2);
                (0..homotopy.dimension).map(of_axis).sum::<f64>().sqrt()
            }
        };
        Graph {
            dimension: homotopy.dimension,
            lengths: edges.iter().enumerate().map(in_sketch).collect(),
            neighbours: neighbours(homotopy.points, edges.iter().map(|edge| edge.points)),
            reference: homotopy.gauge.reference.clone(),
        }
    }

    /// How many distances a point lacks to be constructed from the points placed.
    fn missing(&self, placed: &Set, p: usize) -> usize {
        let known = self.neighbours[p]
            .iter()
            .filter(|(q, _)| placed.has(*q))
            .count();
        self.dimension.saturating_sub(known)
    }

    /// Adds a point, and then all that can be constructed without driving parameters: to place
    /// them at once never does harm.
    fn extend(&self, partial: &mut Partial, p: usize) {
        let mut waiting = vec![p];
        while let Some(p) = waiting.pop() {
            if partial.placed.has(p) {
                continue;
            }
            partial.placed.add(p);
            partial.order.push(p);
            for &(q, _) in &self.neighbours[p] {
                if !partial.placed.has(q) && self.missing(&partial.placed, q) == 0 {
                    waiting.push(q);
                }
            }
        }
    }

    /// The points in an order of construction.
    fn order(&self) -> Vec<usize> {
        let n = self.neighbours.len();
        let beam = (SEARCH / (n * n)).max(10);
        let mut start = Partial {
            placed: Set(vec![0; n.div_ceil(64)]),
            order: Vec::new(),
        };
        for &p in &self.reference {
            start.placed.add(p);
            start.order.push(p);
        }
        // Points that the reference alone determines.
        let free = |partial: &Partial| {
            (0..n).find(|&p| !partial.placed.has(p) && self.missing(&partial.placed, p) == 0)
        };
        while let Some(p) = free(&start) {
            self.extend(&mut start, p);
        }

        // levels[c]: what is reached with c driving parameters beyond those of the reference.
        let mut levels: Vec<Vec<Partial>> = vec![vec![start]];
        let mut seen: HashSet<Set> = HashSet::new();
        let mut cost = 0;
        'search: loop {
            let mut level = std::mem::take(&mut levels[cost]);
            level.retain(|partial| seen.insert(partial.placed.clone()));
            level.order_by_key(|partial| std::cmp::Reverse(partial.order.len()));
            level.truncate(beam);
            for partial in level {
                if partial.order.len() == n {
                    break 'search partial.order;
                }
                // With a neighbour at least, so that no intersection is of added distances only
                // (definition 3, condition (i)); in a connected graph there always is one.
                let joined = |p: usize| {
                    self.neighbours[p]
                        .iter()
                        .any(|(q, _)| partial.placed.has(*q))
                };
                let any_joined = (0..n).any(|p| !partial.placed.has(p) && joined(p));
                for p in (0..n).filter(|&p| !partial.placed.has(p) && (!any_joined || joined(p))) {
                    let missing = self.missing(&partial.placed, p);
                    let mut next = partial.clone();
                    self.extend(&mut next, p);
                    if levels.len() <= cost + missing {
                        levels.resize(cost + missing + 1, Vec::new());
                    }
                    if !seen.contains(&next.placed) {
                        levels[cost + missing].push(next);
                    }
                }
            }
            cost += 1;
            if cost == levels.len() {
                // Cannot be: any state that is not complete has successors. As listed, then.
                let rest = (0..n).filter(|p| !self.reference.contains(p));
                break self.reference.iter().copied().chain(rest).collect();
            }
        }
    }

    /// For each point but the first, which needs no construction, the number of its arms and its
    /// neighbours among the earlier ones.
    pub(super) fn placed(&self, order: &[usize]) -> Vec<Placed> {
        let mut rank = vec![0; order.len()];
        for (k, &p) in order.iter().enumerate() {
            rank[p] = k;
        }
        order[1..]
            .iter()
            .map(|&p| {
                let earlier = self.neighbours[p]
                    .iter()
                    .copied()
                    .filter(|(q, _)| rank[*q] < rank[p])
                    .collect();
                (p, rank[p].min(self.dimension), earlier)
            })
            .collect()
    }

    /// An order that needs driving parameters where `order` does; what follows without is constructed from the latest
    /// points first.
    pub(super) fn latest_first(&self, order: &[usize]) -> Vec<usize> {
        let mut rank = vec![usize::MAX; order.len()];
        let mut new: Vec<usize> = Vec::with_capacity(order.len());
        let mut ready: BinaryHeap<(usize, Reverse<usize>)> = BinaryHeap::new();
        let mut given = self.reference.iter().chain(order);
        while new.len() < order.len() {
            let next = match ready.pop() {
                Some((_, Reverse(p))) => Some(p),
                // Only what needs a driving parameter is left.
                None => given.next().copied(),
            };
            let Some(p) = next else { break };
            if rank[p] != usize::MAX {
                continue;
            }
            rank[p] = new.len();
            new.push(p);
            if new.len() < self.reference.len() {
                continue;
            }
            let from: &[usize] = if new.len() == self.reference.len() {
                &new
            } else {
                &[p]
            };
            for &(q, _) in from.iter().flat_map(|&p| &self.neighbours[p]) {
                let mut known: Vec<usize> = self.neighbours[q]
                    .iter()
                    .map(|&(r, _)| rank[r])
                    .filter(|&rank| rank != usize::MAX)
                    .collect();
                if rank[q] == usize::MAX && known.len() >= self.dimension {
                    known.order_by_key(|&rank| Reverse(rank));
                    // Entries from when there were fewer neighbours come later, and are skipped.
                    ready.push((known[self.dimension - 1], Reverse(q)));
                }
            }
        }
        new
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Arm;
    use crate::plan::testing::{rigid, shipped};
    use proptest::prelude::*;

    fn check(plan: &Plan, homotopy: &Homotopy) {
        assert_eq!(plan.instructions.len(), homotopy.points - 1);
        assert_eq!(plan.driving(), plan.removed().len());
        let mut placed = vec![homotopy.gauge.reference[0]];
        let mut used = HashSet::new();
        for instruction in &plan.instructions {
            for arm in instruction.arms() {
                if let Arm::Edge { centre, edge } = *arm {
                    assert!(placed.contains(&centre) && used.insert(edge));
                    let mut ends = homotopy.edges[edge].points;
                    ends.sort_unstable();
                    let mut wanted = [centre, instruction.point];
                    wanted.sort_unstable();
                    assert_eq!(ends, wanted);
                }
            }
            // Definition 3, (i), where the reference is joined.
            assert!(!instruction.arms[0].is_driving());
            assert!(!placed.contains(&instruction.point));
            placed.push(instruction.point);
        }
    }

    #[test]
    fn the_shipped_problems_need_few_driving_parameters() {
        for (name, driving) in [
            ("octahedron", 1),
            ("disulfide", 1),
            ("dodecagon", 2),
            ("icosahedron", 3),
            ("icosahedron-c1", 3),
        ] {
            let homotopy = Homotopy::new(&shipped(name)).unwrap();
            let plan = Plan::derive(&homotopy);
            assert_eq!(plan.driving(), driving, "{name}");
            check(&plan, &homotopy);
        }
    }

    proptest! {
        #[test]
        fn any_rigid_graph_of_the_plane_has_a_plan(problem in rigid(2, 3..30)) {
            let homotopy = Homotopy::new(&problem).unwrap();
            check(&Plan::derive(&homotopy), &homotopy);
        }

        #[test]
        fn any_such_graph_of_space_has_a_plan(problem in rigid(3, 4..20)) {
            let homotopy = Homotopy::new(&problem).unwrap();
            check(&Plan::derive(&homotopy), &homotopy);
        }
    }
}
