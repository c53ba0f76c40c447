//! Which unknowns are key and which equations ignored, where there are other equations than distances: what `layout`
//! does point by point, for any groups of unknowns.

use super::layout::{Block, Layout, WIDEST};
use super::sequence::Group;
use crate::track::full::{Differences, Equations, Tail};

/// One number for each unknown of a group.
type Wide = [f64; WIDEST];

/// Groups in an order, each with the equations that have others only from groups before it.
#[derive(Debug, Clone, Default)]
pub struct Groups {
    list: Vec<Placed>,
    /// Work space: rows, and values of the tail's entries.
    rows: Vec<Candidate>,
    entries: Vec<f64>,
}

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

#[derive(Debug, Clone)]
struct Candidate {
    row: Wide,
    taken: bool,
}

/// Calls a function with the unknowns of an equation's row of the Jacobian and their entries, t left out: a distance
/// has `d` for one end and `second` times that for the other, other equations have `entries`.
#[inline(always)]
pub fn each_entry<const D: usize>(
    (ends, tail): (&[Vec<[u32; 2]>; D], &Tail),
    e: usize,
    (d, entries): ([&[f64]; D], &[f64]),
    second: f64,
    mut to: impl FnMut(usize, f64),
) {
    if e < tail.first() {
        for axis in 0..D {
            let ([i, j], d) = (ends[axis][e], d[axis][e]);
            to(i as usize, d);
            to(j as usize, second * d);
        }
    } else {
        for (unknown, entry) in tail.row_with(e, entries) {
            to(unknown, entry);
        }
    }
}

impl Groups {
    /// Each equation goes to the last group that it has unknowns of; also returns those without any.
    pub fn new<const D: usize>(groups: &[Group], equations: &Equations<D>) -> (Self, Vec<u32>) {
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
            list,
            rows: Vec::new(),
            entries: vec![0.0; equations.tail.entries()],
        };
        (groups, left)
    }

    /// Splits unknowns and equations at a point with the differences `d`: see `Order::choose`.
    pub fn choose<const D: usize>(
        &mut self,
        equations: &Equations<D>,
        d: &Differences<D>,
        alpha: f64,
        layout: &mut Layout,
    ) {
        let tail = &equations.tail;
        tail.row_values(&d.forms, &mut self.entries);
        let (rows, entries) = (&mut self.rows, &self.entries);
        let mut listed = 0;
        for Placed {
            group,
            rows: equations,
        } in &self.list
        {
            let size = group.unknowns.len();
            rows.clear();
            rows.extend(equations.iter().map(|row| {
                let value = |entry: Entry| match entry {
                    Entry::Distance(axis, sign) => sign * d[axis][row.equation as usize],
                    Entry::Tail(entry) => entries[entry],
                };
                let mut own = [0.0; WIDEST];
                row.own
                    .iter()
                    .for_each(|&(place, entry)| own[place] = value(entry));
                let others: f64 = row.others.iter().map(|&entry| value(entry).powi(2)).sum();
                let long = dot(&own, &own).max(others).sqrt();
                Candidate {
                    row: divided(own, long),
                    taken: false,
                }
            }));
            let mut open = [false; WIDEST];
            open[..size].fill(true);
            let mut block = Block::empty(layout.order);
            while block.size < size {
                let (mut best, mut most) = (None, alpha * alpha);
                for (r, candidate) in rows.iter().enumerate() {
                    let (worth, place) = candidate.worth(&open, size);
                    if worth >= most {
                        (best, most) = (Some((r, place)), worth);
                    }
                }
                let Some((best, place)) = best else {
                    break;
                };
                let direction = rows[best].row;
                let direction = divided(direction, dot(&direction, &direction).sqrt());
                rows[best].taken = true;
                open[place] = false;
                let axis = group.axes.get(place).map_or(place as u8, |&axis| axis);
                let Row { equation, sign, .. } = equations[best];
                block.insert((axis, group.unknowns[place]), (equation, sign));
                for Candidate { row, .. } in rows.iter_mut() {
                    let along = dot(row, &direction);
                    for k in 0..size {
                        row[k] -= along * direction[k];
                    }
                }
            }
            let ignored = equations.iter().zip(rows.iter());
            let ignored = ignored.filter(|(_, candidate)| !candidate.taken);
            layout.ignored.extend(ignored.map(|(row, _)| row.equation));
            let keys = group.unknowns.iter().zip(open);
            layout
                .keys
                .extend(keys.filter(|(_, open)| *open).map(|(&key, _)| key));
            layout.order += block.size;
            if block.size > 0 {
                let is_last = |&e: &u32| e as usize >= tail.first();
                if group.axes.is_empty() || block.rows[..block.size].iter().any(is_last) {
                    block.listed = Some(listed);
                    listed += 1;
                }
                layout.blocks.push(block);
            }
        }
    }
}

/// The free unknowns of an equation's row of the Jacobian, with their entries, t left out.
fn entries_of<const D: usize>(equations: &Equations<D>, e: usize) -> Vec<(usize, Entry)> {
    let tail = &equations.tail;
    if e >= tail.first() {
        let row = tail.row(e);
        return row
            .map(|entry| (tail.unknown(entry), Entry::Tail(entry)))
            .collect();
    }
    let ends = equations.ends.iter().enumerate();
    let entries = ends.flat_map(|(axis, ends)| {
        let [i, j] = ends[e].map(|end| end as usize);
        [
            (i, Entry::Distance(axis, 1.0)),
            (j, Entry::Distance(axis, -1.0)),
        ]
    });
    entries
        .filter(|&(unknown, _)| unknown < equations.m)
        .collect()
}

impl Candidate {
    /// The square of what is left of it, and the place of the pivot, of which it has at most √size times as much: where
    /// the pivot is small it counts. Negative if there is nothing to be had.
    fn worth(&self, open: &[bool; WIDEST], size: usize) -> (f64, usize) {
        let (mut pivot, mut at) = (-1.0, 0);
        for place in 0..size {
            if open[place] && self.row[place].abs() >= pivot {
                (pivot, at) = (self.row[place].abs(), place);
            }
        }
        if self.taken || pivot < 0.0 {
            return (-1.0, at);
        }
        let worth = dot(&self.row, &self.row).min(size as f64 * pivot * pivot);
        (worth, at)
    }
}

fn dot(a: &Wide, b: &Wide) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn divided(row: Wide, by: f64) -> Wide {
    if by > 0.0 { row.map(|x| x / by) } else { row }
}
