//! Which points go to infinity, and the signs with which lengths add up to zero among their neighbours.

use crate::rational::Rational;

/// A distance.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// Between these points.
    pub points: [usize; 2],
    /// Its square.
    pub squared: Rational,
    /// Itself, if it is a ratio.
    pub length: Option<Rational>,
}

/// How points go to infinity. Two of the same problem are equal if the same points go with the same signs of lengths: points stand
/// in the problem's order, and the first ν that is not zero is positive.
#[derive(Debug, Clone, PartialEq)]
pub struct Split {
    /// The points that go.
    pub inside: Vec<usize>,
    /// Their neighbours.
    pub link: Vec<usize>,
    /// All others.
    pub outside: Vec<usize>,
    /// For each neighbour its ν: the coordinate in the isotropic plane of which distances there are differences.
    pub heights: Vec<Rational>,
    /// The points of the one cycle among the neighbours, in order.
    pub cycle: Vec<usize>,
}

/// The points that go, their neighbours, all others.
pub type Parts = [Vec<usize>; 3];

/// The parts, by which points go. `None` where one is empty.
pub fn parts(points: usize, edges: &[Edge], goes: &[bool]) -> Option<Parts> {
    let mut is_neighbour = vec![false; points];
    for edge in edges {
        let [a, b] = edge.points;
        is_neighbour[a] |= goes[b] && !goes[a];
        is_neighbour[b] |= goes[a] && !goes[b];
    }
    let those = |which: &dyn Fn(usize) -> bool| (0..points).filter(|&p| which(p)).collect();
    let parts: Parts = [
        those(&|p| goes[p]),
        those(&|p| is_neighbour[p]),
        those(&|p| !goes[p] && !is_neighbour[p]),
    ];
    parts
        .iter()
        .all(|part: &Vec<usize>| !part.is_empty())
        .then_some(parts)
}

impl Split {
    /// Finds the signs that ν, which is known roughly, has along edges, and proves that lengths add up to zero with them.
    /// `None` where they do not, or where the neighbours' edges are no connected graph with one cycle.
    pub fn new(
        [inside, link, outside]: Parts,
        edges: &[Edge],
        nu: impl Fn(usize) -> f64,
    ) -> Option<Self> {
        let place = |p: usize| link.iter().position(|&q| q == p);
        let among: Vec<([usize; 2], &Rational)> = edges
            .iter()
            .filter_map(|edge| {
                let [a, b] = edge.points;
                Some(([place(a)?, place(b)?], edge.length.as_ref()))
            })
            .map(|(ends, length)| Some((ends, length?)))
            .collect::<Option<_>>()?;
        if among.len() != link.len() || among.iter().any(|(_, length)| length.is_zero()) {
            return None;
        }
        let mut heights: Vec<Option<Rational>> = vec![None; link.len()];
        heights[0] = Some(Rational::zero());
        // Each round reaches the neighbours of what was reached.
        for _ in 0..link.len() {
            for &([a, b], length) in &among {
                for [from, to] in [[a, b], [b, a]] {
                    if let (Some(height), None) = (&heights[from], &heights[to]) {
                        let rises = nu(link[to]) > nu(link[from]);
                        let next = if rises {
                            height + length
                        } else {
                            height - length
                        };
                        heights[to] = Some(next);
                    }
                }
            }
        }
        let mut heights: Vec<Rational> = heights.into_iter().collect::<Option<_>>()?;
        let is_kept = |&([a, b], length): &([usize; 2], &Rational)| {
            (&heights[a] - &heights[b]).abs() == *length
        };
        if !among.iter().all(is_kept) {
            return None;
        }
        // The mirror image has the other sign.
        if heights.iter().find(|h| !h.is_zero())?.is_negative() {
            heights = heights.into_iter().map(|h| -h).collect();
        }
        let cycle = cycle(link.len(), among.iter().map(|(ends, _)| *ends).collect())?;
        let cycle = cycle.into_iter().map(|k| link[k]).collect();
        Some(Split {
            inside,
            link,
            outside,
            heights,
            cycle,
        })
    }

    /// The edges of the cycle, one after the other: from a point to the next.
    pub fn around(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let last = self.cycle.len().saturating_sub(1);
        let before = self.cycle[last..].iter().chain(&self.cycle);
        before.zip(&self.cycle).map(|(&from, &to)| [from, to])
    }

    /// ν of a neighbour.
    pub fn height(&self, point: usize) -> Option<&Rational> {
        let place = self.link.iter().position(|&p| p == point)?;
        Some(&self.heights[place])
    }
}

/// The cycle of a connected graph with one: its vertices in order.
fn cycle(n: usize, mut edges: Vec<[usize; 2]>) -> Option<Vec<usize>> {
    // Leaves are cut off until there are none.
    loop {
        let degree = |v: usize| edges.iter().filter(|ends| ends.contains(&v)).count();
        let Some(leaf) = (0..n).find(|&v| degree(v) == 1) else {
            break;
        };
        edges.retain(|ends| !ends.contains(&leaf));
    }
    let first = *edges.first()?;
    let mut cycle = first.to_vec();
    edges.remove(0);
    while let Some(k) = edges
        .iter()
        .position(|ends| ends.contains(cycle.last().expect("two at least")))
    {
        let [a, b] = edges.remove(k);
        let last = *cycle.last().expect("two at least");
        cycle.push(if a == last { b } else { a });
    }
    // Back where it began, and through every edge.
    (edges.is_empty() && cycle.len() > 3 && cycle.pop() == Some(first[0])).then_some(cycle)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(points: [usize; 2], length: i64) -> Edge {
        let length = Rational::from_integer(length.into());
        Edge {
            points,
            squared: &length * &length,
            length: Some(length),
        }
    }

    #[test]
    fn a_cycle_is_found_in_order_without_what_hangs_on_it() {
        let found = cycle(6, vec![[0, 1], [2, 3], [1, 2], [4, 5], [3, 0], [4, 0]]).unwrap();
        assert_eq!(found, [0, 1, 2, 3]);
        assert!(cycle(3, vec![[0, 1], [1, 2]]).is_none());
    }

    #[test]
    fn signs_are_taken_from_a_rough_figure_and_sums_are_exact() {
        // Point 0 goes; 1, 2, 3, 4 are its neighbours, in a cycle with lengths 1 + 4 = 2 + 3.
        let mut edges = vec![
            edge([1, 2], 1),
            edge([2, 3], 4),
            edge([3, 4], 2),
            edge([4, 1], 3),
        ];
        edges.extend((1..5).map(|p| edge([0, p], 7)));
        edges.extend((1..5).map(|p| edge([5, p], 7)));
        let goes = [true, false, false, false, false, false];
        let rough = |p: usize| [0.0, 0.0, 1.1, 4.9, 3.2, 0.0][p];
        let [inside, link, outside] = parts(6, &edges, &goes).unwrap();
        assert_eq!(
            (&inside[..], &link[..], &outside[..]),
            (&[0][..], &[1, 2, 3, 4][..], &[5][..])
        );
        let parts = [inside, link, outside];
        let split = Split::new(parts.clone(), &edges, rough).unwrap();
        let whole = |h: &Rational| h.to_integer().try_into().unwrap();
        let heights: Vec<i64> = split.heights.iter().map(whole).collect();
        assert_eq!(heights, [0, 1, 5, 3]);
        // The mirror image is the same.
        assert_eq!(
            Split::new(parts.clone(), &edges, |p| -rough(p)).unwrap(),
            split
        );
        // Signs that do not add up to zero, and lengths that do not.
        let others = |p: usize| if p == 3 { -5.0 } else { rough(p) };
        assert!(Split::new(parts.clone(), &edges, others).is_none());
        edges[0] = edge([1, 2], 2);
        assert!(Split::new(parts, &edges, rough).is_none());
    }
}
