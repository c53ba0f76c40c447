//! A square system, cut into blocks.

use crate::order::each_once;
use petgraph::algo::{maximum_matching, tarjan_scc};
use petgraph::graph::{DiGraph, NodeIndex, UnGraph};
use std::ops::Range;

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

/// What a maximum matching of equations with unknowns leaves over.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOver {
    /// Equations.
    pub equations: Vec<usize>,
    /// Unknowns.
    pub unknowns: Vec<usize>,
}

impl Blocks {
    /// Cuts the system whose equations have these unknowns. The error: no unknown can be found for every equation,
    /// and the other way round.
    ///
    /// The blocks are the strongly connected components of the graph in which an equation points to those that a perfect
    /// matching solves for its other unknowns; they do not depend on the matching.
    pub fn new(equations: &[Vec<usize>], unknowns: usize) -> Result<Self, LeftOver> {
        let n = equations.len();
        let ends = |e: usize| {
            equations[e]
                .iter()
                .map(move |&u| (e as u32, (n + u) as u32))
        };
        let mut graph = UnGraph::<(), ()>::from_edges((0..n).flat_map(ends));
        while graph.node_count() < n + unknowns {
            graph.add_node(());
        }
        let matching = maximum_matching(&graph);
        let mate = |node: usize| Some(matching.mate(NodeIndex::new(node))?.index());
        if n != unknowns || matching.len() != n {
            let left = |of: Range<usize>| of.filter(|&node| mate(node).is_none());
            return Err(LeftOver {
                equations: left(0..n).collect(),
                unknowns: left(n..n + unknowns).map(|node| node - n).collect(),
            });
        }
        let equation_of: Vec<usize> = (n..2 * n).filter_map(mate).collect();
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
            let mut own: Vec<usize> = members
                .iter()
                .filter_map(|&e| mate(e))
                .map(|u| u - n)
                .collect();
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
        Ok(out)
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
        assert!(Blocks::new(&[vec![0], vec![0]], 2).is_err());
        assert!(Blocks::new(&[vec![0]], 2).is_err());
    }
}
