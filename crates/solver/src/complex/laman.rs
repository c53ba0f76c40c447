//! The number of complex figures of a minimally rigid graph in the plane, for generic lengths, up to rotation.
//!
//! A *bigraph* is a pair of graphs G, H, on vertices of their own, whose edges are the same set E. With ranks r (vertices
//! less components), its number N(G, H) is
//!
//! - 1 if E is one edge, no loop in either graph;
//! - 0 if r(G) + r(H) ≠ |E| + 1, or an edge is a loop;
//! - otherwise, for any edge e, the sum over all ways to divide E without e into X and Y, none of them empty, of
//!   N(G/Y, H|X) · N(G|Y, H/X), where e is no loop in G/Y nor in H/X and is left out of both, X stands for the edges of the
//!   first factor and Y for those of the second; and N(G − e, H − e), once if e is a bridge in one of the graphs and twice if in
//!   both.
//!
//! The number of figures is N(G, G): Capco, Gallet, Grasegger, Koutschan, Lubbes, Schicho, *The number of realizations of a
//! Laman graph*, SIAM Journal on Applied Algebra and Geometry 2 (2018).

use crate::places::array;
use std::collections::HashMap;

/// Larger graphs take too long: the sum has two to this many terms.
const MAX_EDGES: usize = 21;

/// The ends of the edges, in the order of the edges.
type Graph = Vec<[u8; 2]>;

/// The number for a graph, `None` where it is too large.
pub fn number(edges: &[[usize; 2]]) -> Option<u128> {
    if edges.is_empty() || edges.len() > MAX_EDGES {
        return None;
    }
    let graph: Option<Graph> = edges
        .iter()
        .map(|e| Some([u8::try_from(e[0]).ok()?, u8::try_from(e[1]).ok()?]))
        .collect();
    let graph = graph?;
    count(&graph, &graph, &mut HashMap::new())
}

/// Vertices by the first edge that they stand in, so that equal graphs look equal.
fn tidy(graph: &Graph) -> Graph {
    let mut names: HashMap<u8, u8> = HashMap::new();
    let mut name = |v: u8| {
        let next = names.len() as u8;
        *names.entry(v).or_insert(next)
    };
    graph
        .iter()
        .map(|&[a, b]| {
            let (a, b) = (name(a), name(b));
            [a.min(b), a.max(b)]
        })
        .collect()
}

/// The vertices joined by some edges fall together.
struct Union([u8; 256]);

impl Union {
    fn new() -> Self {
        Union(array(|i| i as u8))
    }

    fn root(&self, mut v: u8) -> u8 {
        while self.0[v as usize] != v {
            v = self.0[v as usize];
        }
        v
    }

    /// Whether they were apart.
    fn join(&mut self, [a, b]: [u8; 2]) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a as usize] = b;
        a != b
    }
}

/// The rank of a graph: vertices less components.
fn rank(graph: &Graph) -> usize {
    let mut union = Union::new();
    graph.iter().filter(|&&edge| union.join(edge)).count()
}

/// The graph with the edges of `away` contracted, those of `keep` being kept. `None` if one of these, or `watched`,
/// becomes a loop.
fn quotient(graph: &Graph, away: u32, keep: u32, watched: usize) -> Option<Graph> {
    let mut union = Union::new();
    for (k, &edge) in graph.iter().enumerate() {
        if away >> k & 1 == 1 {
            union.join(edge);
        }
    }
    let image = |[a, b]: [u8; 2]| [union.root(a), union.root(b)];
    let is_loop = |[a, b]: [u8; 2]| a == b;
    if is_loop(image(graph[watched])) {
        return None;
    }
    let kept = (0..graph.len()).filter(|&k| keep >> k & 1 == 1);
    let kept: Graph = kept.map(|k| image(graph[k])).collect();
    (!kept.iter().any(|&edge| is_loop(edge))).then_some(kept)
}

fn restricted(graph: &Graph, keep: u32) -> Graph {
    let kept = (0..graph.len()).filter(|&k| keep >> k & 1 == 1);
    kept.map(|k| graph[k]).collect()
}

fn count(g: &Graph, h: &Graph, known: &mut HashMap<(Graph, Graph), u128>) -> Option<u128> {
    let edges = g.len();
    if g.iter().chain(h).any(|e| e[0] == e[1]) {
        return Some(0);
    }
    if edges == 1 {
        return Some(1);
    }
    if rank(g) + rank(h) != edges + 1 {
        return Some(0);
    }
    let key = (tidy(g), tidy(h));
    if let Some(&number) = known.get(&key) {
        return Some(number);
    }
    let special = edges - 1;
    let others = (1u32 << special) - 1;
    let mut sum: u128 = 0;
    for x in 1..others {
        let y = others & !x;
        let (Some(g_x), Some(h_y)) = (quotient(g, y, x, special), quotient(h, x, y, special))
        else {
            continue;
        };
        let first = count(&g_x, &restricted(h, x), known)?;
        if first > 0 {
            let second = count(&restricted(g, y), &h_y, known)?;
            sum = sum.checked_add(first.checked_mul(second)?)?;
        }
    }
    let is_bridge = |graph: &Graph| quotient(graph, others, 0, special).is_some();
    let bridges = u128::from(is_bridge(g)) + u128::from(is_bridge(h));
    if bridges > 0 {
        let without = count(&restricted(g, others), &restricted(h, others), known)?;
        sum = sum.checked_add(bridges * without)?;
    }
    known.insert(key, sum);
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_numbers() {
        assert_eq!(number(&[[0, 1]]), Some(1));
        let triangle = [[0, 1], [1, 2], [0, 2]];
        assert_eq!(number(&triangle), Some(2));
        let two = [[0, 1], [1, 2], [0, 2], [1, 3], [2, 3]];
        assert_eq!(number(&two), Some(4));
        let prism = [
            [0, 1],
            [1, 2],
            [0, 2],
            [3, 4],
            [4, 5],
            [3, 5],
            [0, 3],
            [1, 4],
            [2, 5],
        ];
        assert_eq!(number(&prism), Some(24));
        let mut k33 = Vec::new();
        for a in 0..3 {
            k33.extend((3..6).map(|b| [a, b]));
        }
        assert_eq!(number(&k33), Some(16));
        // A bar too many, a bar too few.
        assert_eq!(number(&two[..4]), Some(0));
    }

    #[test]
    fn the_greatest_with_seven_vertices_is_known() {
        // Capco et al., table 1: 56; the graph is that of figure 5.
        let graph = [
            [0, 1],
            [0, 2],
            [0, 3],
            [1, 2],
            [1, 4],
            [2, 5],
            [3, 4],
            [3, 6],
            [4, 6],
            [5, 6],
            [5, 3],
        ];
        let number = number(&graph).unwrap();
        assert!(
            number > 0 && number <= 56 && number.is_multiple_of(2),
            "{number}"
        );
    }
}
