//! Which unknowns are key and which equations ignored at a point of the path.

use crate::linalg::Vector;
use crate::plan::Plan;
use crate::system::Homotopy;
use crate::track::full::Equations;

/// The points in the order of a construction plan, each with its coordinates and the distances to
/// points before it.
#[derive(Debug, Clone)]
pub struct Order<const D: usize> {
    points: Vec<Placed<D>>,
    t: u32,
}

#[derive(Debug, Clone)]
struct Placed<const D: usize> {
    /// Its unknowns per axis; fixed coordinates are the spare entry.
    unknowns: [u32; D],
    /// Distances to points before it, and on which end it is: 1 for the first, −1 for the second.
    distances: Vec<(u32, f64)>,
}

/// One diagonal block of A: the coordinates of a point that are not key, and as many distances.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// The position of its first row and column in A, and how many there are.
    pub start: usize,
    pub size: usize,
    /// Its columns: unknowns and their axes.
    pub unknowns: [u32; 3],
    pub axes: [u8; 3],
    /// Its rows: distances, with the sign that the point's coordinates have in them.
    pub rows: [u32; 3],
    pub signs: [f64; 3],
}

/// The R-structure [[A, H], [L, C]] of the Jacobian with the normal for a last row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Layout {
    pub blocks: Vec<Block>,
    /// The order of A.
    pub order: usize,
    /// The key unknowns; t, the last, is one of them.
    pub keys: Vec<u32>,
    /// The ignored distances.
    pub ignored: Vec<u32>,
}

impl<const D: usize> Order<D> {
    /// The order of the plan that is derived for a problem.
    pub fn new(homotopy: &Homotopy, equations: &Equations<D>) -> Self {
        let plan = Plan::derive(homotopy);
        let constructed: Vec<usize> = plan.instructions.iter().map(|i| i.point).collect();
        let mut rank = vec![0; homotopy.points];
        for (at, &point) in constructed.iter().enumerate() {
            rank[point] = at + 1;
        }
        let mut distances = vec![Vec::new(); homotopy.points];
        for (edge, distance) in homotopy.edges.iter().enumerate() {
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
            t: equations.m as u32,
        }
    }

    /// The structure at a point of the path with the differences `d`: each point keeps the
    /// distances whose directions are farthest from depending on each other, by the sine of the
    /// angle between each and those taken before it, as long as that is at least `alpha`; for what
    /// is missing then, coordinates become key.
    pub fn layout(&self, d: &[Vector; D], alpha: f64) -> Layout {
        let mut layout = Layout::default();
        for point in &self.points {
            let free: Vec<usize> = (0..D)
                .filter(|&axis| point.unknowns[axis] <= self.t)
                .collect();
            let mut rows: Vec<[f64; D]> = point
                .distances
                .iter()
                .map(|&(edge, _)| {
                    let mut row = [0.0; D];
                    for &axis in &free {
                        row[axis] = d[axis][edge as usize];
                    }
                    scaled(row)
                })
                .collect();
            let mut taken = vec![false; rows.len()];
            let mut used = [false; D];
            let mut block = Block {
                start: layout.order,
                size: 0,
                unknowns: [0; 3],
                axes: [0; 3],
                rows: [0; 3],
                signs: [0.0; 3],
            };
            while block.size < free.len() {
                let pivot = |row: &[f64; D]| {
                    let axes = free.iter().copied().filter(|&axis| !used[axis]);
                    axes.max_by(|&a, &b| row[a].abs().total_cmp(&row[b].abs()))
                };
                // The pivot counts as well, with the most that it can be of a direction.
                let worth = |row: &[f64; D]| {
                    pivot(row).map_or(0.0, |axis| {
                        norm(row).min((D as f64).sqrt() * row[axis].abs())
                    })
                };
                let best = (0..rows.len())
                    .filter(|&r| !taken[r])
                    .max_by(|&a, &b| worth(&rows[a]).total_cmp(&worth(&rows[b])));
                let Some(best) = best.filter(|&r| worth(&rows[r]) >= alpha) else {
                    break;
                };
                let axis = pivot(&rows[best]).expect("a row that is worth something has a pivot");
                let direction = scaled(rows[best]);
                taken[best] = true;
                used[axis] = true;
                let (edge, sign) = point.distances[best];
                block.unknowns[block.size] = point.unknowns[axis];
                block.axes[block.size] = axis as u8;
                block.rows[block.size] = edge;
                block.signs[block.size] = sign;
                block.size += 1;
                for row in rows.iter_mut() {
                    let along: f64 = (0..D).map(|k| row[k] * direction[k]).sum();
                    for k in 0..D {
                        row[k] -= along * direction[k];
                    }
                }
            }
            // In the order of the axes and of the distances: which pivot came first does not matter.
            block.sort();
            let left = point
                .distances
                .iter()
                .zip(&taken)
                .filter(|(_, taken)| !**taken);
            layout.ignored.extend(left.map(|((edge, _), _)| edge));
            let keys = free.iter().filter(|&&axis| !used[axis]);
            layout.keys.extend(keys.map(|&axis| point.unknowns[axis]));
            layout.order += block.size;
            if block.size > 0 {
                layout.blocks.push(block);
            }
        }
        layout.keys.push(self.t);
        layout
    }
}

impl Block {
    fn sort(&mut self) {
        let size = self.size;
        let mut columns: Vec<_> = (0..size)
            .map(|c| (self.axes[c], self.unknowns[c]))
            .collect();
        columns.sort_unstable();
        let mut rows: Vec<_> = (0..size).map(|r| (self.rows[r], self.signs[r])).collect();
        rows.sort_unstable_by_key(|row| row.0);
        for k in 0..size {
            (self.axes[k], self.unknowns[k]) = columns[k];
            (self.rows[k], self.signs[k]) = rows[k];
        }
    }
}

impl Layout {
    /// The number of key unknowns, t included, and of ignored equations, the normal's included.
    pub fn keys(&self) -> usize {
        self.keys.len()
    }

    /// Whether there are as many ignored equations as key unknowns: always, where no distance is
    /// between two fixed coordinates.
    pub fn is_square(&self) -> bool {
        self.ignored.len() + 1 == self.keys.len()
    }
}

fn norm<const D: usize>(row: &[f64; D]) -> f64 {
    row.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn scaled<const D: usize>(row: [f64; D]) -> [f64; D] {
    let size = norm(&row);
    if size > 0.0 {
        row.map(|x| x / size)
    } else {
        row
    }
}
