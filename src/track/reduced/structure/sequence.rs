//! The order in which unknowns are computed one group after the other, where there are other equations than
//! distances: what a construction plan is for distances alone.

use crate::system::Homotopy;
use crate::track::full::Equations;

/// So many groups are tried for the first.
const STARTS: usize = 40;
/// Fewer where there are many groups: so many steps in all.
const WORK: usize = 4_000_000;

/// Groups of unknowns in an order in which few of them have fewer equations with groups before them than they
/// have unknowns. A group is the free coordinates of a point, or an auxiliary vector, or another auxiliary
/// unknown; entries that are not there are the spare one.
pub fn groups_in_order<const D: usize>(
    homotopy: &Homotopy,
    equations: &Equations<D>,
) -> Vec<[u32; D]> {
    let groups = groups(homotopy, equations);
    let mut group_of = vec![usize::MAX; equations.m];
    for (g, group) in groups.iter().enumerate() {
        for &unknown in group.iter().filter(|&&i| (i as usize) < equations.m) {
            group_of[unknown as usize] = g;
        }
    }
    let rows = rows(equations, &group_of);
    let mut rows_of = vec![Vec::new(); groups.len()];
    for (e, row) in rows.iter().enumerate() {
        row.iter().for_each(|&g| rows_of[g].push(e));
    }
    let sizes: Vec<usize> = groups
        .iter()
        .map(|group| {
            group
                .iter()
                .filter(|&&i| (i as usize) < equations.m)
                .count()
        })
        .collect();
    let search = Search {
        sizes: &sizes,
        rows: &rows,
        rows_of: &rows_of,
    };
    // Each search goes through all groups for each group.
    let count = (WORK / groups.len().pow(2).max(1)).clamp(1, STARTS);
    let starts = (0..groups.len()).take(count).map(Some);
    let orders = std::iter::once(None)
        .chain(starts)
        .map(|start| search.order(start));
    let best = orders.min_by_key(|(missing, _)| *missing);
    let (_, order) = best.expect("the order without a start of its own");
    order.into_iter().map(|g| groups[g]).collect()
}

/// The groups, in the order of their unknowns.
fn groups<const D: usize>(homotopy: &Homotopy, equations: &Equations<D>) -> Vec<[u32; D]> {
    let (m, spare) = (equations.m, equations.n() as u32);
    let of_point = |point: usize| -> [u32; D] {
        std::array::from_fn(|axis| match homotopy.coordinate(point, axis) {
            Some(free) => free as u32,
            None => spare,
        })
    };
    let points = (0..homotopy.points).map(of_point);
    let mut groups: Vec<[u32; D]> = points
        .filter(|group| group.iter().any(|&i| i != spare))
        .collect();
    let mut next = m - homotopy.tail.unknowns.len();
    while next < m {
        // A vector's entries change their signs with one axis each, or each with all others.
        let is_vector = next + D <= m
            && [false, true].into_iter().any(|others| {
                (0..D).all(|k| {
                    (0..D).all(|axis| homotopy.flips(next + k, axis) == ((k == axis) != others))
                })
            });
        let size = if is_vector { D } else { 1 };
        groups.push(std::array::from_fn(|k| match k < size {
            true => (next + k) as u32,
            false => spare,
        }));
        next += size;
    }
    groups
}

/// The groups in each equation, each once.
fn rows<const D: usize>(equations: &Equations<D>, group_of: &[usize]) -> Vec<Vec<usize>> {
    let of_row = |e: usize| {
        let head = equations.ends.iter().flat_map(|ends| ends[e]);
        let tail = equations.tail.row(e);
        let unknowns = head
            .map(|end| end as usize)
            .chain(tail.map(|entry| equations.tail.unknown(entry)));
        let mut groups: Vec<usize> = unknowns
            .filter(|&i| i < group_of.len())
            .map(|i| group_of[i])
            .collect();
        groups.sort_unstable();
        groups.dedup();
        groups
    };
    (0..equations.m).map(of_row).collect()
}

struct Search<'a> {
    /// The number of unknowns of each group.
    sizes: &'a [usize],
    /// The groups of each equation.
    rows: &'a [Vec<usize>],
    /// The equations of each group.
    rows_of: &'a [Vec<usize>],
}

impl Search<'_> {
    /// An order, always going on with the group that lacks fewest equations, among those with the one that is
    /// in most equations with groups before it; and how many are missing in all.
    fn order(&self, start: Option<usize>) -> (usize, Vec<usize>) {
        let count = self.sizes.len();
        let mut open: Vec<usize> = self.rows.iter().map(Vec::len).collect();
        let mut is_placed = vec![false; count];
        let mut complete = vec![0usize; count];
        let mut joined = vec![0usize; count];
        for (e, row) in self.rows.iter().enumerate() {
            if open[e] == 1 {
                complete[row[0]] += 1;
            }
        }
        let (mut missing, mut order) = (0, Vec::with_capacity(count));
        while order.len() < count {
            let lacks = |g: usize| self.sizes[g].saturating_sub(complete[g]);
            let next = start.filter(|_| order.is_empty()).unwrap_or_else(|| {
                let left = (0..count).filter(|&g| !is_placed[g]);
                let best = left.min_by_key(|&g| (lacks(g), std::cmp::Reverse(joined[g])));
                best.expect("a group that is left")
            });
            missing += lacks(next);
            is_placed[next] = true;
            order.push(next);
            for &e in &self.rows_of[next] {
                open[e] -= 1;
                for &g in self.rows[e].iter().filter(|&&g| !is_placed[g]) {
                    joined[g] += 1;
                    if open[e] == 1 {
                        complete[g] += 1;
                    }
                }
            }
        }
        (missing, order)
    }
}
