//! Which unknowns are key and which equations ignored at a point of the path.

use super::groups::Groups;
use super::sequence::{Group, groups_in_order};
use crate::linalg::rstructure::MAX_KEYS;
use crate::plan::Plan;
use crate::system::{Edge, Homotopy};
use crate::track::full::{Differences, Equations};

/// The points in the order of a construction plan, each with its coordinates and the distances to
/// points before it.
#[derive(Debug, Clone)]
pub struct Order<const D: usize> {
    points: Vec<Placed<D>>,
    /// Equations without any unknown.
    left: Vec<u32>,
    t: u32,
    /// Work space.
    rows: Vec<Candidate<D>>,
    /// Groups of unknowns in the place of points, where there are other equations than distances.
    groups: Groups,
}

#[derive(Debug, Clone)]
struct Placed<const D: usize> {
    /// Its unknowns per axis; fixed coordinates are the spare entry.
    unknowns: [u32; D],
    /// Distances to points before it, and on which end it is: 1 for the first, −1 for the second.
    distances: Vec<(u32, f64)>,
}

/// A block has at most so many rows and columns. Those of a point have three at most.
pub const WIDEST: usize = 6;

/// One diagonal block of A: the coordinates of a point that are not key, and as many distances (or
/// unknowns and equations of other kinds).
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// The position of its first row and column in A, and how many there are.
    pub start: usize,
    pub size: usize,
    /// Its columns: unknowns and their axes (places in their group).
    pub unknowns: [u32; WIDEST],
    pub axes: [u8; WIDEST],
    /// Its rows: equations, with the sign that the point's coordinates have in distances.
    pub rows: [u32; WIDEST],
    pub signs: [f64; WIDEST],
    pub kind: Kind,
}

/// What the rows of a diagonal block are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Distances from one point to points before it.
    Point,
    /// Lists of entries, three rows at most.
    Listed,
    /// Lists of entries, from four rows up to [`WIDEST`]; the block's number among such blocks.
    Wide(u32),
}

/// The R-structure [[A, H], [L, C]] of the Jacobian with the normal for a last row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Layout {
    pub blocks: Vec<Block>,
    /// The order of A.
    pub order: usize,
    /// The key unknowns; t, the last, is one of them.
    pub keys: Vec<u32>,
    /// The ignored equations.
    pub ignored: Vec<u32>,
}

impl<const D: usize> Order<D> {
    /// The order of the plan that is derived for a problem of distances, or one like it for others.
    pub fn new(homotopy: &Homotopy, equations: &Equations<D>) -> Self {
        if equations.tail.is_empty() {
            Self::of_plan(homotopy, equations)
        } else {
            Self::of_groups(&groups_in_order(homotopy, equations), equations)
        }
    }

    fn of_groups(groups: &[Group], equations: &Equations<D>) -> Self {
        let (groups, left) = Groups::new(groups, equations);
        Order {
            points: Vec::new(),
            left,
            t: equations.m as u32,
            rows: Vec::new(),
            groups,
        }
    }

    fn of_plan(homotopy: &Homotopy, equations: &Equations<D>) -> Self {
        let edges: Vec<Edge> = homotopy.half_squares().collect();
        let plan = Plan::derive_for(homotopy, &edges);
        let constructed: Vec<usize> = plan.instructions.iter().map(|i| i.point).collect();
        let mut rank = vec![0; homotopy.points];
        for (at, &point) in constructed.iter().enumerate() {
            rank[point] = at + 1;
        }
        let mut distances = vec![Vec::new(); homotopy.points];
        for (edge, distance) in edges.iter().enumerate() {
            let [i, j] = distance.points;
            let (later, sign) = if rank[i] > rank[j] {
                (i, 1.0)
            } else {
                (j, -1.0)
            };
            distances[later].push((edge as u32, sign));
        }
        let spare = equations.n() as u32;
        let placed = |&point: &usize| Placed {
            unknowns: std::array::from_fn(|axis| match homotopy.gauge.variable[point * D + axis] {
                fixed if fixed == equations.m => spare,
                free => free as u32,
            }),
            distances: std::mem::take(&mut distances[point]),
        };
        Order {
            points: constructed.iter().map(placed).collect(),
            left: Vec::new(),
            t: equations.m as u32,
            rows: Vec::new(),
            groups: Groups::default(),
        }
    }

    /// The structure at a point of the path with the differences `d`, into `layout`: each point keeps
    /// the distances whose directions are farthest from depending on each other, by the sine of the
    /// angle between each and those taken before it, as long as that is at least `alpha`; for what
    /// is missing then, coordinates become key. Rows of other equations are as long as what they have
    /// before their group, if that is more: unknowns that hardly matter in them are not found by them. Of groups with such rows
    /// less is asked where that saves lanes (`groups.rs`).
    pub fn choose(
        &mut self,
        equations: &Equations<D>,
        d: &Differences<D>,
        alpha: f64,
        layout: &mut Layout,
    ) {
        layout.blocks.clear();
        layout.keys.clear();
        layout.ignored.clear();
        layout.ignored.extend(&self.left);
        layout.order = 0;
        if !equations.tail.is_empty() {
            self.groups.choose(equations, d, alpha, layout);
            layout.keys.push(self.t);
            return;
        }
        let rows = &mut self.rows;
        for point in &self.points {
            let free = point.unknowns.map(|unknown| unknown <= self.t);
            rows.clear();
            rows.extend(point.distances.iter().map(|&(edge, _)| {
                let row = std::array::from_fn(|axis| match free[axis] {
                    true => d[axis][edge as usize],
                    false => 0.0,
                });
                Candidate {
                    row: scaled(row),
                    taken: false,
                }
            }));
            let mut open = free;
            let mut block = Block::empty(layout.order);
            while block.size < free.iter().filter(|free| **free).count() {
                let (mut best, mut most) = (None, alpha * alpha);
                for (r, candidate) in rows.iter().enumerate() {
                    let (worth, axis) = candidate.worth(&open);
                    if worth >= most {
                        (best, most) = (Some((r, axis)), worth);
                    }
                }
                let Some((best, axis)) = best else {
                    break;
                };
                let direction = scaled(rows[best].row);
                rows[best].taken = true;
                open[axis] = false;
                block.insert((axis as u8, point.unknowns[axis]), point.distances[best]);
                for Candidate { row, .. } in rows.iter_mut() {
                    let along = dot(row, &direction);
                    for k in 0..D {
                        row[k] -= along * direction[k];
                    }
                }
            }
            for (index, candidate) in rows.iter().enumerate() {
                if !candidate.taken {
                    layout.ignored.push(point.distances[index].0);
                }
            }
            for axis in (0..D).filter(|&axis| open[axis]) {
                layout.keys.push(point.unknowns[axis]);
            }
            layout.order += block.size;
            if block.size > 0 {
                layout.blocks.push(block);
            }
        }
        layout.keys.push(self.t);
    }
}

/// What is left of a distance's direction, and whether the distance was taken.
#[derive(Debug, Clone)]
struct Candidate<const D: usize> {
    row: [f64; D],
    taken: bool,
}

impl<const D: usize> Candidate<D> {
    /// The square of its length, and the axis of the pivot, of which a direction has at most √D times
    /// as much: where the pivot is small it counts. Negative if there is nothing to be had.
    fn worth(&self, open: &[bool; D]) -> (f64, usize) {
        let (mut pivot, mut at) = (-1.0, 0);
        for axis in 0..D {
            if open[axis] && self.row[axis].abs() >= pivot {
                (pivot, at) = (self.row[axis].abs(), axis);
            }
        }
        if self.taken || pivot < 0.0 {
            return (-1.0, at);
        }
        let worth = dot(&self.row, &self.row).min(D as f64 * pivot * pivot);
        (worth, at)
    }
}

impl Block {
    /// None yet, at a place in A.
    pub(super) fn empty(start: usize) -> Self {
        Block {
            start,
            size: 0,
            unknowns: [0; WIDEST],
            axes: [0; WIDEST],
            rows: [0; WIDEST],
            signs: [0.0; WIDEST],
            kind: Kind::Point,
        }
    }

    /// Adds a column (axis and unknown) and a row (distance and sign): both are kept in the order of
    /// axes and distances, as it does not matter which pivot came first.
    pub(super) fn insert(&mut self, (axis, unknown): (u8, u32), (row, sign): (u32, f64)) {
        let (mut c, mut r) = (self.size, self.size);
        while c > 0 && self.axes[c - 1] > axis {
            (self.axes[c], self.unknowns[c]) = (self.axes[c - 1], self.unknowns[c - 1]);
            c -= 1;
        }
        while r > 0 && self.rows[r - 1] > row {
            (self.rows[r], self.signs[r]) = (self.rows[r - 1], self.signs[r - 1]);
            r -= 1;
        }
        (self.axes[c], self.unknowns[c]) = (axis, unknown);
        (self.rows[r], self.signs[r]) = (row, sign);
        self.size += 1;
    }
}

impl Layout {
    /// The number of key unknowns, t included, and of ignored equations, the normal's included.
    pub fn keys(&self) -> usize {
        self.keys.len()
    }

    /// The rows of S in matrices with a row per equation and the normal's, the `m`-th: the ignored
    /// equations, then the normal. What comes after [`Layout::keys`] of them is the normal again.
    pub fn rows_of_s(&self, m: usize) -> [usize; MAX_KEYS] {
        std::array::from_fn(|l| self.ignored.get(l).map_or(m, |&e| e as usize))
    }

    /// Whether there are as many ignored equations as key unknowns: always, where no distance is
    /// between two fixed coordinates.
    pub fn is_square(&self) -> bool {
        self.ignored.len() + 1 == self.keys.len()
    }
}

fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    (0..D).map(|k| a[k] * b[k]).sum()
}

fn scaled<const D: usize>(row: [f64; D]) -> [f64; D] {
    let size = dot(&row, &row).sqrt();
    if size > 0.0 {
        row.map(|x| x / size)
    } else {
        row
    }
}
