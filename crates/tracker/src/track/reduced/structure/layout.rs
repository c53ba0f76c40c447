//! Which unknowns are key and which equations ignored at a point of the path.

use super::groups::Groups;
use super::pivots::{Candidate, dot, take_best};
use super::sequence::{Group, groups_in_order};
use crate::linalg::rstructure::MAX_KEYS;
use crate::places::array;
use crate::plan::Plan;
use crate::system::{Edge, Homotopy};
use crate::track::full::{Differences, Equations};

/// The points in the order of a construction plan, each with its coordinates and the distances to
/// points before it.
#[derive(Debug, Clone)]
pub struct Order {
    points: Vec<Placed>,
    /// Equations without any unknown.
    left: Vec<u32>,
    t: u32,
    /// Work space.
    rows: Vec<Candidate>,
    /// Groups of unknowns in the place of points, where there are other equations than distances.
    groups: Groups,
}

#[derive(Debug, Clone)]
struct Placed {
    /// Its unknowns per axis; fixed coordinates are the spare entry.
    unknowns: Vec<u32>,
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

impl Order {
    /// The order of the plan that is derived for a problem of distances, or one like it for others.
    pub fn new(homotopy: &Homotopy, equations: &Equations) -> Self {
        if equations.tail.is_empty() {
            Self::of_plan(homotopy, equations)
        } else {
            Self::of_groups(&groups_in_order(homotopy, equations), equations)
        }
    }

    fn of_groups(groups: &[Group], equations: &Equations) -> Self {
        let (groups, left) = Groups::new(groups, equations);
        Order {
            points: Vec::new(),
            left,
            t: equations.m as u32,
            rows: Vec::new(),
            groups,
        }
    }

    fn of_plan(homotopy: &Homotopy, equations: &Equations) -> Self {
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
        let unknown = |point, axis| {
            homotopy
                .coordinate(point, axis)
                .map_or(spare, |free| free as u32)
        };
        let axes = 0..homotopy.dimension;
        let placed = |&point: &usize| Placed {
            unknowns: axes.clone().map(|axis| unknown(point, axis)).collect(),
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
        equations: &Equations,
        d: &Differences,
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
            let mut open = [false; WIDEST];
            for (open, &unknown) in open.iter_mut().zip(&point.unknowns) {
                *open = unknown <= self.t;
            }
            rows.clear();
            rows.extend(point.distances.iter().map(|&(edge, _)| {
                let mut row = [0.0; WIDEST];
                for (axis, d) in d.iter().enumerate().filter(|(axis, _)| open[*axis]) {
                    row[axis] = d[edge as usize];
                }
                Candidate::new(row, dot(&row, &row).sqrt())
            }));
            let mut block = Block::empty(layout.order);
            while let Some((best, axis, _)) =
                take_best(rows, &mut open, point.unknowns.len(), alpha * alpha)
            {
                block.insert((axis as u8, point.unknowns[axis]), point.distances[best]);
            }
            for (candidate, distance) in rows.iter().zip(&point.distances) {
                if !candidate.taken {
                    layout.ignored.push(distance.0);
                }
            }
            let left = point.unknowns.iter().zip(open).filter(|(_, open)| *open);
            layout.keys.extend(left.map(|(unknown, _)| unknown));
            layout.order += block.size;
            if block.size > 0 {
                layout.blocks.push(block);
            }
        }
        layout.keys.push(self.t);
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
        array(|l| self.ignored.get(l).map_or(m, |&e| e as usize))
    }

    /// Whether there are as many ignored equations as key unknowns: always, where no distance is
    /// between two fixed coordinates.
    pub fn is_square(&self) -> bool {
        self.ignored.len() + 1 == self.keys.len()
    }
}
