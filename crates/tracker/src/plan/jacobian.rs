//! The Jacobian of a problem, seen through a construction plan.

use super::{Instruction, Plan};
use crate::linalg::rstructure::Ordering;
use crate::places::array;
use crate::system::Homotopy;

/// Where the Jacobian F_X has entries, and which of its columns and rows a plan sets apart: the
/// *R-structure* of 002 (sections 2 and 5) in full coordinates.
///
/// The plan's driving parameters are not among the coordinates, and need not be: "u and its
/// defining equation are useless, x_A can be used as key unknown" (002, remark 1). For each
/// driving parameter of an instruction one coordinate of the point constructed is a key unknown;
/// the plan's removed constraints are the ignored equations.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Jacobian {
    /// For each distance the free coordinates that occur in it.
    pub equations: Vec<Vec<usize>>,
    /// The key unknowns: free coordinates, as many as there are driving parameters.
    pub keys: Vec<usize>,
    /// The ignored equations: the removed constraints.
    pub ignored: Vec<usize>,
}

impl Plan {
    /// The pattern of the Jacobian under this plan.
    ///
    /// Of a point with driving parameters, those coordinates are key unknowns that leave, in the
    /// figure given (places, as in [`Homotopy::sketch`]), the diagonal block with the largest
    /// determinant.
    ///
    /// ```
    /// # use krawl::problem::Problem;
    /// # use krawl::{plan::Plan, system::Homotopy};
    /// # let problem = Problem::read("../../problems/k33.toml").unwrap();
    /// let homotopy = Homotopy::new(&problem).unwrap();
    /// let plan = Plan::derive(&homotopy);
    /// let jacobian = plan.jacobian(&homotopy, &homotopy.sketch);
    /// assert_eq!(jacobian.keys.len(), plan.driving());
    /// // No block is larger than a point.
    /// assert!(jacobian.ordering().block_sizes().iter().all(|&size| size <= 2));
    /// ```
    pub fn jacobian(&self, homotopy: &Homotopy, figure: &[f64]) -> Jacobian {
        let d = homotopy.dimension;
        let free = |place: usize| {
            let variable = homotopy.gauge.variable[place];
            (variable < homotopy.equations).then_some(variable)
        };
        let equations = homotopy
            .edges
            .iter()
            .map(|edge| {
                let places = edge.points.into_iter().flat_map(|p| p * d..(p + 1) * d);
                places.filter_map(free).collect()
            })
            .collect();
        let keys = self.instructions.iter().flat_map(|instruction| {
            key_axes(instruction, figure, d)
                .filter_map(move |axis| free(instruction.point * d + axis))
        });
        Jacobian {
            equations,
            keys: keys.collect(),
            ignored: self.removed(),
        }
    }
}

impl Jacobian {
    /// The order of rows and columns in which it has R-structure: one block per point that has
    /// coordinates left, or smaller ones where the reference's fixed coordinates allow.
    pub fn ordering(&self) -> Ordering {
        Ordering::new(
            self.equations.len(),
            &self.equations,
            &self.keys,
            &self.ignored,
        )
        .expect("each point has as many distances as coordinates that are not key unknowns")
    }
}

/// The axes of an instruction's key unknowns: those that leave the largest minor of the rows
/// that its distances have in the Jacobian, which are the directions to its centres.
fn key_axes(
    instruction: &Instruction,
    figure: &[f64],
    d: usize,
) -> impl Iterator<Item = usize> + use<> {
    let free = instruction.arity;
    let place = instruction.point * d;
    let rows: Vec<[f64; 3]> = instruction
        .arms()
        .iter()
        .filter_map(|arm| match arm {
            super::Arm::Edge { centre, .. } => {
                let mut row = [0.0; 3];
                for axis in 0..free {
                    row[axis] = figure[place + axis] - figure[centre * d + axis];
                }
                Some(row)
            }
            super::Arm::Driving { .. } => None,
        })
        .collect();
    let mut keys = [false; 3];
    keys[..free].fill(true);
    match rows.as_slice() {
        [] => {}
        [row] => {
            // One coordinate stays.
            let largest = (0..free).max_by(|&a, &b| row[a].abs().total_cmp(&row[b].abs()));
            largest.into_iter().for_each(|axis| keys[axis] = false);
        }
        [a, b] if free == 3 => {
            let minor = |out: usize| {
                let (i, j) = ((out + 1) % 3, (out + 2) % 3);
                (a[i] * b[j] - a[j] * b[i]).abs()
            };
            let out = (0..3).max_by(|&i, &j| minor(i).total_cmp(&minor(j)));
            keys = array(|axis| Some(axis) == out);
        }
        _ => keys = [false; 3],
    }
    (0..3).filter(move |&axis| keys[axis])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::testing::{rigid, shipped};
    use proptest::prelude::*;

    #[test]
    fn shipped_problems_fall_into_points() {
        for name in [
            "octahedron",
            "disulfide",
            "dodecagon",
            "icosahedron",
            "prism",
        ] {
            let homotopy = Homotopy::new(&shipped(name)).unwrap();
            let plan = Plan::derive(&homotopy);
            let jacobian = plan.jacobian(&homotopy, &homotopy.sketch);
            let ordering = jacobian.ordering();
            assert_eq!(ordering.keys(), plan.driving());
            assert!(
                ordering
                    .block_sizes()
                    .iter()
                    .all(|&size| size <= homotopy.dimension)
            );
        }
    }

    proptest! {
        #[test]
        fn random_problems_fall_into_points(problem in prop_oneof![rigid(2, 4..9), rigid(3, 4..9)]) {
            let Ok(homotopy) = Homotopy::new(&problem) else { return Ok(()) };
            let plan = Plan::derive(&homotopy);
            let jacobian = plan.jacobian(&homotopy, &homotopy.sketch);
            let ordering = jacobian.ordering();
            prop_assert_eq!(ordering.keys(), plan.driving());
            prop_assert!(ordering.block_sizes().iter().all(|&size| size <= homotopy.dimension));
            // No entries above the diagonal blocks; the ignored equations are the last ones.
            let mut end = ordering.keys();
            let sizes = ordering.block_sizes().iter();
            let ends = sizes.flat_map(|&size| { end += size; vec![end; size] });
            let ends: Vec<usize> = ends.collect();
            for (e, unknowns) in jacobian.equations.iter().enumerate() {
                let end = ends.get(ordering.row_of(e)).copied().unwrap_or(usize::MAX);
                prop_assert!(unknowns.iter().all(|&u| ordering.column_of(u) < end));
            }
        }
    }
}
