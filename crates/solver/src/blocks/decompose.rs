//! A square system, cut into blocks.

use crate::order::each_once;
use petgraph::algo::{maximum_matching, tarjan_scc};
use petgraph::graph::{DiGraph, NodeIndex, UnGraph};

/// Equations and as many unknowns that can be solved for once all blocks that are needed have been.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// The equations, by position among those that were cut.
    pub equations: Vec<usize>,
    /// The unknowns.
    pub unknowns: Vec<usize>,
    /// The blocks before whose unknowns are in its equations.
    pub needs: Vec<usize>,
}

/// The blocks of a square system, each after all that it needs.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Blocks {
    /// They.
    pub blocks: Vec<Block>,
    /// For each unknown its block.
    pub of_unknown: Vec<usize>,
}

impl Blocks {
    /// Cuts the system whose equations have these unknowns. `None` if no unknown can be found for every equation,
    /// and the other way round.
    pub fn new(equations: &[Vec<usize>], unknowns: usize) -> Option<Self> {
        let n = equations.len();
        if n != unknowns {
            return None;
        }
        let mut graph = UnGraph::<(), ()>::with_capacity(2 * n, 4 * n);
        for _ in 0..2 * n {
            graph.add_node(());
        }
        for (e, of) in equations.iter().enumerate() {
            for &u in of {
                graph.add_edge(NodeIndex::new(e), NodeIndex::new(n + u), ());
            }
        }
        let matching = maximum_matching(&graph);
        if matching.len() != n {
            return None;
        }
        let mut equation_of = vec![0; n];
        let mut unknown_of = vec![0; n];
        for (a, b) in matching.edges() {
            let (e, u) = (a.index().min(b.index()), a.index().max(b.index()) - n);
            equation_of[u] = e;
            unknown_of[e] = u;
        }
        let mut needs = DiGraph::<(), ()>::with_capacity(n, 4 * n);
        for _ in 0..n {
            needs.add_node(());
        }
        for (e, of) in equations.iter().enumerate() {
            for &u in of {
                if equation_of[u] != e {
                    needs.add_edge(NodeIndex::new(e), NodeIndex::new(equation_of[u]), ());
                }
            }
        }
        // What is needed comes first.
        let mut out = Blocks {
            blocks: Vec::new(),
            of_unknown: vec![0; n],
        };
        for component in tarjan_scc(&needs) {
            let mut members: Vec<usize> = component.iter().map(|node| node.index()).collect();
            members.sort_unstable();
            let index = out.blocks.len();
            let mut own: Vec<usize> = members.iter().map(|&e| unknown_of[e]).collect();
            own.sort_unstable();
            for &u in &own {
                out.of_unknown[u] = index;
            }
            let before = members.iter().flat_map(|&e| &equations[e]);
            let before = before.filter(|u| !own.contains(u));
            let needs = each_once(before.map(|&u| out.of_unknown[u]));
            out.blocks.push(Block {
                equations: members,
                unknowns: own,
                needs,
            });
        }
        Some(out)
    }

    /// Some blocks with all that they need.
    pub fn with_needs(&self, blocks: impl IntoIterator<Item = usize>) -> Vec<usize> {
        let mut taken = vec![false; self.blocks.len()];
        blocks.into_iter().for_each(|b| taken[b] = true);
        for b in (0..self.blocks.len()).rev() {
            if taken[b] {
                self.blocks[b]
                    .needs
                    .iter()
                    .for_each(|&need| taken[need] = true);
            }
        }
        (0..taken.len()).filter(|&b| taken[b]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_come_after_what_they_need() {
        // x; then y and z together, with x; and w by itself.
        let equations = [vec![1, 2, 0], vec![0], vec![1, 2], vec![3]];
        let cut = Blocks::new(&equations, 4).unwrap();
        assert_eq!(cut.blocks.len(), 3);
        let of_y = &cut.blocks[cut.of_unknown[1]];
        assert_eq!(
            (of_y.equations.clone(), of_y.unknowns.clone()),
            (vec![0, 2], vec![1, 2])
        );
        assert_eq!(of_y.needs, [cut.of_unknown[0]]);
        assert!(cut.of_unknown[0] < cut.of_unknown[1]);
        assert_eq!(cut.with_needs([cut.of_unknown[1]]).len(), 2);
        assert_eq!(cut.with_needs([cut.of_unknown[3]]), [cut.of_unknown[3]]);
    }

    #[test]
    fn what_is_singular_by_its_pattern_is_not_cut() {
        assert_eq!(Blocks::new(&[vec![0], vec![0]], 2), None);
        assert_eq!(Blocks::new(&[vec![0]], 2), None);
    }
}
