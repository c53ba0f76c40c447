//! Finding a plan with few driving parameters in the constraint graph.

use super::boundary::{gamma_three, gamma_two};
use super::change::place;
use super::{Arm, Instruction, Plan};
use crate::system::Homotopy;
use std::collections::HashSet;

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
        let graph = Graph::new(homotopy);
        let instructions = graph
            .order()
            .into_iter()
            .map(|(point, arity, earlier)| graph.instruction(homotopy, point, arity, &earlier));
        let mut plan = Plan {
            dimension: homotopy.dimension,
            points: homotopy.points,
            edges: homotopy.edges.len(),
            instructions: instructions.collect(),
        };
        plan.place_references(&homotopy.sketch);
        plan
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
type Placed = (usize, usize, Vec<(usize, usize)>);

struct Graph {
    dimension: usize,
    /// For each point its neighbours and the distances to them.
    neighbours: Vec<Vec<(usize, usize)>>,
    reference: Vec<usize>,
}

impl Graph {
    fn new(homotopy: &Homotopy) -> Self {
        let mut neighbours = vec![Vec::new(); homotopy.points];
        for (e, edge) in homotopy.edges.iter().enumerate() {
            let [a, b] = edge.points;
            neighbours[a].push((b, e));
            neighbours[b].push((a, e));
        }
        Graph {
            dimension: homotopy.dimension,
            neighbours,
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

    /// The points in an order of construction, each with the number of its arms and its
    /// neighbours among the earlier ones. The first reference point needs no construction.
    fn order(&self) -> Vec<Placed> {
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
        let order = 'search: loop {
            let mut level = std::mem::take(&mut levels[cost]);
            level.retain(|partial| seen.insert(partial.placed.clone()));
            level.sort_by_key(|partial| std::cmp::Reverse(partial.order.len()));
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
        };

        let mut rank = vec![0; n];
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

    /// The instruction for a point with its neighbours among the earlier points: among all
    /// choices of arms the one with the largest γ in the sketch.
    fn instruction(
        &self,
        homotopy: &Homotopy,
        point: usize,
        arity: usize,
        earlier: &[(usize, usize)],
    ) -> Instruction {
        let at = |p: usize| place(&homotopy.sketch, self.dimension, p);
        let p = at(point);
        let mut best = earlier.iter().copied().take(arity).collect::<Vec<_>>();
        let mut best_gamma = -1.0;
        let mut consider = |choice: &[(usize, usize)]| {
            let c = |k: usize| at(choice[k].0);
            let mut gamma = gamma_two(p, c(0), c(1));
            if choice.len() == 3 {
                gamma = gamma.min(gamma_three(p, c(0), c(1), c(2)));
            }
            if gamma > best_gamma {
                best_gamma = gamma;
                best = choice.to_vec();
            }
        };
        if arity >= 2 && earlier.len() >= 2 {
            for (i, &a) in earlier.iter().enumerate() {
                for (j, &b) in earlier.iter().enumerate().skip(i + 1) {
                    if arity == 2 || earlier.len() == 2 {
                        consider(&[a, b]);
                        continue;
                    }
                    for (k, &c) in earlier.iter().enumerate() {
                        if k != i && k != j {
                            consider(&[a, b, c]);
                        }
                    }
                }
            }
        }
        let mut arms = [Arm::Driving { place: [0.0; 3] }; 3];
        for (arm, &(centre, edge)) in arms.iter_mut().zip(&best) {
            *arm = Arm::Edge { centre, edge };
        }
        Instruction {
            point,
            arity,
            arms,
            original: [None; 2],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
