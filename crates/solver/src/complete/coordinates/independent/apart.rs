//! How equations fall apart, whatever their zeros are.

use super::super::{Cut, Figures, State};
use super::forms;
use crate::places::Each as _;
use crate::sets::Joined;

/// How the equations fall apart, whatever their zeros are.
pub struct Apart {
    /// For each block its part; of the base none.
    pub part: Vec<Option<usize>>,
    /// For each block its unknowns in the order in which they hang on the tree.
    pub order: Vec<Vec<usize>>,
    /// For each unknown what it hangs on in the tree: another one, or the number 0 and the base.
    pub parent: Vec<usize>,
    /// How many parts there are.
    pub parts: usize,
    /// What has to hold in figures: the unknowns whose vector does not vanish, or one unknown whose sign is known, and the part.
    pub conditions: Vec<(Vec<[usize; 2]>, usize)>,
}

impl Apart {
    /// Of the blocks of a system, some of which are the base, and of conditions on figures: each the differences that are not all 0. `None`: a block's own equations do
    /// not say what all of its unknowns hang on.
    pub fn new(
        figures: &Figures,
        in_base: &[bool],
        conditions: Vec<Vec<[usize; 2]>>,
    ) -> Option<Self> {
        let (homotopy, m) = (figures.homotopy, figures.system.unknowns);
        let mut node: Vec<usize> = (0..m).collect();
        for (block, _) in figures.blocks.iter().zip(in_base).filter(|(_, is)| **is) {
            block.unknowns.iter().for_each(|&u| node[u] = m);
        }
        let node = |i: usize| node.get(i).copied().unwrap_or(m);
        let edges = |e: usize| {
            let edges = forms(homotopy, e).into_iter();
            let edges = edges.map(|entries| entries.each(node));
            edges.filter(|[a, b]| a != b).collect::<Vec<_>>()
        };
        // The tree, block by block: what hangs on what, and how far down.
        let mut parent = vec![m; m];
        let mut depth: Vec<Option<usize>> = vec![None; m];
        depth.push(Some(0));
        let mut order = Vec::new();
        for (block, _) in figures.blocks.iter().zip(in_base) {
            let mut placed = Vec::new();
            let all: Vec<[usize; 2]> = block.equations.iter().flat_map(|&e| edges(e)).collect();
            let mut next = true;
            while std::mem::take(&mut next) {
                for &[a, b] in &all {
                    for [at, new] in [[a, b], [b, a]] {
                        if let (Some(down), None) = (depth[at], depth[new]) {
                            (parent[new], depth[new]) = (at, Some(down + 1));
                            placed.push(new);
                            next = true;
                        }
                    }
                }
            }
            order.push(placed);
        }
        let blocks = || figures.blocks.iter().zip(in_base).zip(&order);
        let is_own = |((block, is_base), placed): ((&Cut, &bool), &Vec<usize>)| {
            let own = block.unknowns.iter().all(|u| placed.contains(u));
            !*is_base && own && placed.len() == block.unknowns.len()
                || *is_base && placed.is_empty()
        };
        if !blocks().all(is_own) {
            return None;
        }
        let mut groups = Joined::new(m);
        // The tree edges between two nodes, each by its lower end.
        let way = |[mut a, mut b]: [usize; 2]| {
            let mut way = Vec::new();
            while a != b {
                let lower = if depth[a] > depth[b] { &mut a } else { &mut b };
                way.push(*lower);
                *lower = parent[*lower];
            }
            way
        };
        for (block, _) in figures.blocks.iter().zip(in_base).filter(|(_, is)| !**is) {
            let ways = block.equations.iter().flat_map(|&e| edges(e)).flat_map(way);
            let all = ways.chain(block.unknowns.iter().copied());
            let all: Vec<usize> = all.collect();
            groups.join_all(&all);
        }
        let of_conditions = conditions.iter().map(|condition| {
            let edges = condition.iter().map(|entries| entries.each(node));
            edges.flat_map(way).collect::<Vec<usize>>()
        });
        let of_conditions: Vec<Vec<usize>> = of_conditions.collect();
        for all in &of_conditions {
            groups.join_all(all);
        }
        let mut parts: Vec<usize> = Vec::new();
        let part = blocks().map(|((block, is_base), _)| {
            let first = groups.of(block.unknowns[0]);
            (!is_base).then(|| {
                let known = parts.iter().position(|&part| part == first);
                known.unwrap_or_else(|| {
                    parts.push(first);
                    parts.len() - 1
                })
            })
        });
        let part: Vec<Option<usize>> = part.collect();
        let all = conditions.into_iter().zip(of_conditions);
        let conditions = all.filter_map(|(condition, way)| {
            let group = groups.of(*way.first()?);
            let part = parts.iter().position(|&part| part == group);
            Some((condition, part?))
        });
        Some(Apart {
            conditions: conditions.collect(),
            part,
            order,
            parent,
            parts: parts.len(),
        })
    }

    /// Moves the unknowns of a block of another part along with what they hang on.
    pub fn move_along(&self, b: usize, reference: &State, state: &mut State) {
        let m = self.parent.len();
        let mut values = Vec::new();
        for &u in &self.order[b] {
            let on = self.parent[u];
            if on == m {
                state.x[u] = reference.x[u];
                values.extend(reference.told.value(u).map(|x| (u, x.clone())));
                continue;
            }
            state.x[u] = state.x[on] + (reference.x[u] - reference.x[on]);
            let told = [&reference.told, &reference.told, &state.told];
            if let [Some(x), Some(y), Some(z)] = [(0, u), (1, on), (2, on)].each(|(k, i)| {
                let learnt = values.iter().find(|(known, _)| k == 2 && *known == i);
                learnt.map(|(_, value)| value).or(told[k].value(i))
            }) {
                let value = x - y + z;
                values.push((u, value));
            }
        }
        state.told.learn(values);
    }
}
