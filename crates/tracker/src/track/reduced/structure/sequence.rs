//! The order in which unknowns are computed one group after the other, where there are other equations than
//! distances: what a construction plan is for distances alone.

use super::layout::WIDEST;
use crate::order::each_once;
use crate::system::Homotopy;
use crate::track::full::Equations;

/// So many groups are tried for the first.
const STARTS: usize = 40;
/// Fewer where there are many groups: so many steps in all.
const WORK: usize = 4_000_000;

/// Unknowns that are found together.
#[derive(Debug, Clone)]
pub struct Group {
    /// At most [`WIDEST`].
    pub unknowns: Vec<u32>,
    /// Where these are coordinates of one point: which ones. Otherwise none.
    pub axes: Vec<u8>,
}

/// Groups of unknowns in an order in which few of them have fewer equations with groups before them than they
/// have unknowns. A group is the free coordinates of a point, or an auxiliary vector, or another auxiliary
/// unknown, or several of these that are found together but not one after the other.
pub fn groups_in_order(homotopy: &Homotopy, equations: &Equations) -> Vec<Group> {
    let groups = groups(homotopy, equations);
    let mut group_of = vec![usize::MAX; equations.m];
    for (g, group) in groups.iter().enumerate() {
        for &unknown in &group.unknowns {
            group_of[unknown as usize] = g;
        }
    }
    let rows = rows(equations, &group_of);
    let mut rows_of = vec![Vec::new(); groups.len()];
    for (e, row) in rows.iter().enumerate() {
        row.iter().for_each(|&g| rows_of[g].push(e));
    }
    let sizes: Vec<usize> = groups.iter().map(|g| g.unknowns.len()).collect();
    let search = Search {
        sizes: &sizes,
        rows: &rows,
        rows_of: &rows_of,
    };
    // Each search goes through all groups for each group.
    let count = (WORK / groups.len().pow(2).max(1)).clamp(1, STARTS);
    let starts = (0..groups.len()).take(count).map(Some);
    let (mut missing, mut order) = search
        .order(None, usize::MAX)
        .expect("nothing is too much for the first");
    for start in starts {
        if let Some(better) = search.order(start, missing) {
            (missing, order) = better;
        }
    }
    let together = |members: Vec<usize>| match members[..] {
        [one] => groups[one].clone(),
        _ => Group {
            unknowns: members
                .iter()
                .flat_map(|&g| groups[g].unknowns.iter().copied())
                .collect(),
            axes: Vec::new(),
        },
    };
    order.into_iter().map(together).collect()
}

/// The groups, in the order of their unknowns.
fn groups(homotopy: &Homotopy, equations: &Equations) -> Vec<Group> {
    let m = equations.m;
    let of_point = |point: usize| {
        let free = (0..homotopy.dimension).filter_map(|axis| {
            let unknown = homotopy.coordinate(point, axis)?;
            Some((unknown as u32, axis as u8))
        });
        let (unknowns, axes) = free.unzip();
        Group { unknowns, axes }
    };
    let points = (0..homotopy.points).map(of_point);
    let mut groups: Vec<Group> = points.filter(|group| !group.unknowns.is_empty()).collect();
    let mut next = m - homotopy.tail.unknowns.len();
    while next < m {
        // A vector's entries change their signs with one axis each, or each with all others.
        let dimension = homotopy.dimension;
        let is_vector = next + dimension <= m
            && [false, true].into_iter().any(|others| {
                let flips = |k, axis| homotopy.flips(next + k, axis) == ((k == axis) != others);
                (0..dimension).all(|k| (0..dimension).all(|axis| flips(k, axis)))
            });
        let size = if is_vector { dimension } else { 1 };
        groups.push(Group {
            unknowns: (next..next + size).map(|unknown| unknown as u32).collect(),
            axes: Vec::new(),
        });
        next += size;
    }
    groups
}

/// The groups in each equation, each once.
fn rows(equations: &Equations, group_of: &[usize]) -> Vec<Vec<usize>> {
    let of_row = |e: usize| {
        let head = equations.ends.iter().flat_map(|ends| ends[e]);
        let tail = equations.tail.row(e);
        let unknowns = head
            .map(|end| end as usize)
            .chain(tail.map(|entry| equations.tail.unknown(entry)));
        each_once(unknowns.filter_map(|i| group_of.get(i).copied()))
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
    /// An order, always going on with the groups that lack fewest equations, among those with the one that is
    /// in most equations with groups before it; and how many are missing in all. `None`: as many as are `too_many`.
    fn order(&self, start: Option<usize>, too_many: usize) -> Option<(usize, Vec<Vec<usize>>)> {
        let mut at = State::new(self);
        let (mut missing, mut order) = (0, Vec::with_capacity(self.sizes.len()));
        while let Some(best) = at.next() {
            let first = start.filter(|_| order.is_empty()).unwrap_or(best);
            let mut next = vec![first];
            let mut lacks = at.lacks(first);
            if lacks > 0 && !order.is_empty() {
                let left = (0..self.sizes.len()).filter(|&g| !at.is_placed[g]);
                for g in left {
                    let (together, lacking) = at.with_others(g);
                    if lacking < lacks {
                        (next, lacks) = (together, lacking);
                    }
                }
            }
            missing += lacks;
            if missing >= too_many {
                return None;
            }
            next.iter().for_each(|&g| at.place(g));
            order.push(next);
        }
        Some((missing, order))
    }
}

/// An order in the making.
struct State<'a> {
    search: &'a Search<'a>,
    is_placed: Vec<bool>,
    /// By equation: how many of its groups are not placed.
    open: Vec<usize>,
    /// By group: how many equations have no other that is not placed, and how many have some that is.
    complete: Vec<usize>,
    joined: Vec<usize>,
}

impl<'a> State<'a> {
    fn new(search: &'a Search<'a>) -> Self {
        let count = search.sizes.len();
        let mut complete = vec![0; count];
        let alone = search.rows.iter().filter(|row| row.len() == 1);
        alone.for_each(|row| complete[row[0]] += 1);
        State {
            search,
            is_placed: vec![false; count],
            open: search.rows.iter().map(Vec::len).collect(),
            complete,
            joined: vec![0; count],
        }
    }

    /// How many equations a group lacks.
    fn lacks(&self, g: usize) -> usize {
        self.search.sizes[g].saturating_sub(self.complete[g])
    }

    /// The group that lacks fewest.
    fn next(&self) -> Option<usize> {
        let left = (0..self.is_placed.len()).filter(|&g| !self.is_placed[g]);
        left.min_by_key(|&g| (self.lacks(g), std::cmp::Reverse(self.joined[g])))
    }

    /// A group and others that bring more equations with it than they have unknowns, as far as they are of use and there is
    /// room in a block; and how many equations they lack together.
    fn with_others(&self, g: usize) -> (Vec<usize>, usize) {
        let search = self.search;
        let mut shared: Vec<(usize, usize)> = Vec::new();
        for &e in search.rows_of[g].iter().filter(|&&e| self.open[e] == 2) {
            let mut row = search.rows[e].iter().copied();
            let other = row.find(|&h| h != g && !self.is_placed[h]);
            let other = other.expect("two groups are open");
            match shared.iter_mut().find(|(h, _)| *h == other) {
                Some((_, count)) => *count += 1,
                None => shared.push((other, 1)),
            }
        }
        let mut gains: Vec<(usize, usize)> = (shared.into_iter())
            .filter_map(|(h, count)| Some((h, count.checked_sub(self.lacks(h))?)))
            .filter(|&(_, gain)| gain > 0)
            .collect();
        gains.sort_by_key(|&(h, gain)| (std::cmp::Reverse(gain), search.sizes[h], h));
        let (mut together, mut size) = (vec![g], search.sizes[g]);
        let mut lacks = self.lacks(g);
        for (h, gain) in gains {
            if lacks == 0 {
                break;
            }
            if size + search.sizes[h] <= WIDEST {
                together.push(h);
                size += search.sizes[h];
                lacks = lacks.saturating_sub(gain);
            }
        }
        (together, lacks)
    }

    fn place(&mut self, g: usize) {
        self.is_placed[g] = true;
        for &e in &self.search.rows_of[g] {
            self.open[e] -= 1;
            for &h in &self.search.rows[e] {
                if !self.is_placed[h] {
                    self.joined[h] += 1;
                    if self.open[e] == 1 {
                        self.complete[h] += 1;
                    }
                }
            }
        }
    }
}
