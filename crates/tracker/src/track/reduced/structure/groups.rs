//! Which unknowns are key and which equations ignored, where there are other equations than distances: what `layout`
//! does point by point, for any groups of unknowns.

use super::layout::{Block, Kind, Layout, WIDEST};
use super::pivots::{Candidate, dot, take_best};
use super::sequence::Group;
use crate::linalg::LANE;
use crate::linalg::rstructure::width_for;
use crate::places::Each as _;
use crate::track::full::{Differences, Equations};

/// Groups in an order, each with the equations that have others only from groups before it.
#[derive(Debug, Clone, Default)]
pub struct Groups {
    list: Vec<Placed>,
    /// By group the pivots at a point, in the order in which they were found.
    pivots: Vec<Vec<Pivot>>,
    /// Work space: rows, values of the tail's entries, and the worth of pivots that are worth less than is asked.
    rows: Vec<Candidate>,
    entries: Vec<f64>,
    refused: Vec<f64>,
}

#[derive(Debug, Clone, Copy)]
struct Pivot {
    /// Its row's place among the group's rows, and its unknown's in the group.
    row: usize,
    place: usize,
    /// The square of what is left of the row, or of one before it in the group if that is less.
    worth: f64,
}

/// Pivots may be worth this part of what is asked where rows of key unknowns have fewer lanes then: measured, see
/// docs/how/tubes.md.
const LEAST: f64 = 0.6;

#[derive(Debug, Clone)]
struct Placed {
    group: Group,
    rows: Vec<Row>,
}

/// An equation.
#[derive(Debug, Clone)]
struct Row {
    equation: u32,
    /// For a distance: on which end the group is if it is a point, 1 for the first, −1 for the second.
    sign: f64,
    /// The entries of the group's unknowns, by place in it.
    own: Vec<(usize, Entry)>,
    /// The other unknowns' entries.
    others: Vec<Entry>,
}

/// An entry of the Jacobian's row.
#[derive(Debug, Clone, Copy)]
enum Entry {
    /// A distance's along an axis, with a sign.
    Distance(usize, f64),
    /// One of the tail's.
    Tail(usize),
}

impl Groups {
    /// Each equation goes to the last group that it has unknowns of; also returns those without any.
    pub fn new(groups: &[Group], equations: &Equations) -> (Self, Vec<u32>) {
        // By unknown: the group, from 1 on, and the place in it.
        let mut rank = vec![(0, 0); equations.n() + 1];
        for (k, group) in groups.iter().enumerate() {
            for (place, &unknown) in group.unknowns.iter().enumerate() {
                rank[unknown as usize] = (k + 1, place);
            }
        }
        let mut list: Vec<Placed> = (groups.iter().cloned())
            .map(|group| Placed {
                group,
                rows: Vec::new(),
            })
            .collect();
        let mut left = Vec::new();
        for e in 0..equations.m {
            let entries = entries_of(equations, e);
            let last = entries.iter().map(|&(unknown, _)| rank[unknown].0).max();
            let Some(last) = last.filter(|&last| last > 0) else {
                left.push(e as u32);
                continue;
            };
            let is_own = |&(unknown, _): &(usize, Entry)| rank[unknown].0 == last;
            let (own, others): (Vec<_>, Vec<_>) = entries.into_iter().partition(is_own);
            let sign = match own[0].1 {
                Entry::Distance(_, sign) => sign,
                Entry::Tail(_) => 1.0,
            };
            list[last - 1].rows.push(Row {
                equation: e as u32,
                sign,
                own: own.iter().map(|&(u, entry)| (rank[u].1, entry)).collect(),
                others: others.into_iter().map(|(_, entry)| entry).collect(),
            });
        }
        let groups = Groups {
            pivots: vec![Vec::new(); list.len()],
            list,
            rows: Vec::new(),
            entries: vec![0.0; equations.tail.entries()],
            refused: Vec::new(),
        };
        (groups, left)
    }

    /// Splits unknowns and equations at a point with the differences `d`: see `Order::choose`, which leaves the
    /// equations without unknowns in `layout` and puts t there.
    pub fn choose(
        &mut self,
        equations: &Equations,
        d: &Differences,
        alpha: f64,
        layout: &mut Layout,
    ) {
        equations.tail.row_values(&d.forms, &mut self.entries);
        self.find_pivots(d, LEAST * alpha);
        let asked = self.asked(alpha);
        self.lay_out(equations.tail.first(), asked, layout);
    }

    /// Finds the pivots of all groups, as long as their worth is at least the square of `alpha`.
    fn find_pivots(&mut self, d: &Differences, alpha: f64) {
        for (Placed { group, rows }, pivots) in self.list.iter().zip(&mut self.pivots) {
            pivots.clear();
            let mut least = f64::INFINITY;
            let size = group.unknowns.len();
            self.rows.clear();
            self.rows.extend(rows.iter().map(|row| {
                let value = |entry: Entry| match entry {
                    Entry::Distance(axis, sign) => sign * d[axis][row.equation as usize],
                    Entry::Tail(entry) => self.entries[entry],
                };
                let mut own = [0.0; WIDEST];
                row.own
                    .iter()
                    .for_each(|&(place, entry)| own[place] = value(entry));
                let others: f64 = row.others.iter().map(|&entry| value(entry).powi(2)).sum();
                let long = dot(&own, &own).max(others).sqrt();
                Candidate::new(own, long)
            }));
            let mut open = [false; WIDEST];
            open[..size].fill(true);
            for _ in 0..size {
                let best = take_best(&mut self.rows, &mut open, size, alpha * alpha);
                let Some((row, place, worth)) = best else {
                    break;
                };
                least = least.min(worth);
                pivots.push(Pivot {
                    worth: least,
                    row,
                    place,
                });
            }
        }
    }

    /// The square of what is asked of pivots: that of `alpha`, or the most with which rows of key unknowns have as few lanes as if
    /// all that were found were taken.
    fn asked(&mut self, alpha: f64) -> f64 {
        let full = alpha * alpha;
        let unknowns: usize = self.list.iter().map(|g| g.group.unknowns.len()).sum();
        let pivots = self.pivots.iter().flatten();
        self.refused.clear();
        self.refused.extend(
            pivots
                .map(|pivot| pivot.worth)
                .filter(|&worth| worth < full),
        );
        // With t, if all pivots are taken.
        let all: usize = self.pivots.iter().map(Vec::len).sum();
        let fewest = unknowns + 1 - all;
        let Some(lanes) = width_for(fewest) else {
            return full;
        };
        let keys = fewest + self.refused.len();
        match keys.checked_sub(lanes * LANE + 1) {
            None => full,
            Some(last) => {
                self.refused.sort_unstable_by(|a, b| b.total_cmp(a));
                self.refused[last]
            }
        }
    }

    /// Makes blocks of the pivots that are worth what is asked; the first that is not ends its group's.
    fn lay_out(&self, first: usize, asked: f64, layout: &mut Layout) {
        let mut wide = 0;
        for (Placed { group, rows }, pivots) in self.list.iter().zip(&self.pivots) {
            let size = group.unknowns.len();
            let pivots = pivots.iter().take_while(|pivot| pivot.worth >= asked);
            let mut block = Block::empty(layout.order);
            let mut open = [true; WIDEST];
            for pivot in pivots.clone() {
                let axes = group.axes.get(pivot.place);
                let axis = axes.map_or(pivot.place as u8, |&axis| axis);
                let Row { equation, sign, .. } = rows[pivot.row];
                block.insert((axis, group.unknowns[pivot.place]), (equation, sign));
                open[pivot.place] = false;
            }
            let is_ignored = |row: &usize| pivots.clone().all(|pivot| pivot.row != *row);
            let ignored = (0..rows.len()).filter(is_ignored);
            layout.ignored.extend(ignored.map(|row| rows[row].equation));
            let keys = (0..size).filter(|&place| open[place]);
            layout.keys.extend(keys.map(|place| group.unknowns[place]));
            layout.order += block.size;
            if block.size > 0 {
                let is_last = |&e: &u32| e as usize >= first;
                if group.axes.is_empty() || block.rows[..block.size].iter().any(is_last) {
                    block.kind = Kind::Listed;
                    if block.size > 3 {
                        block.kind = Kind::Wide(wide);
                        wide += 1;
                    }
                }
                layout.blocks.push(block);
            }
        }
    }
}

/// The free unknowns of an equation's row of the Jacobian, with their entries, t left out.
fn entries_of(equations: &Equations, e: usize) -> Vec<(usize, Entry)> {
    let tail = &equations.tail;
    if e >= tail.first() {
        let row = tail.row(e);
        return row
            .map(|entry| (tail.unknown(entry), Entry::Tail(entry)))
            .collect();
    }
    let ends = equations.ends.iter().enumerate();
    let entries = ends.flat_map(|(axis, ends)| {
        let [i, j] = ends[e].each(|end| end as usize);
        [
            (i, Entry::Distance(axis, 1.0)),
            (j, Entry::Distance(axis, -1.0)),
        ]
    });
    entries
        .filter(|&(unknown, _)| unknown < equations.m)
        .collect()
}
