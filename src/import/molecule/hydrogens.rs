//! Hydrogens that are left out of a molecule as it is read, and stand in the file that is written as they did to the atoms near them.

use crate::interval::vector::{length, minus};
use crate::nalgebra::{Matrix3, Vector3};
use crate::order::InOrder;

/// So many atoms near a hydrogen tell where it is.
const NEAR: usize = 5;
/// Atoms are taken for flat where they are off a plane by less than this part of how far they are apart.
const FLAT: f64 = 1e-3;

/// The hydrogens of a molecule, without which it was read.
#[derive(Debug, Clone, Default)]
pub struct Hydrogens {
    /// The line and the place of each.
    all: Vec<(usize, [f64; 3])>,
    /// The places of all other atoms.
    others: Vec<[f64; 3]>,
}

impl Hydrogens {
    pub fn new(all: Vec<(usize, [f64; 3])>, others: Vec<[f64; 3]>) -> Self {
        Hydrogens { all, others }
    }

    /// Their lines, and where they are in a figure of the other atoms: each goes along with the nearest of these, turned, or turned and
    /// mirrored, as those around are, the nearer ones counting more (Kabsch, Acta Cryst. A 32, 1976, with weights).
    pub fn placed(&self, figure: &[[f64; 3]]) -> impl Iterator<Item = (usize, [f64; 3])> {
        self.all.iter().map(move |&(line, place)| {
            let mut near: Vec<usize> = (0..self.others.len()).collect();
            let far = |a: usize| length(minus(self.others[a], place));
            near.order_by(|&a, &b| far(a).total_cmp(&far(b)));
            near.truncate(NEAR);
            let is_moved = near.iter().any(|&a| figure[a] != self.others[a]);
            (
                line,
                if is_moved {
                    self.moved(place, &near, figure)
                } else {
                    place
                },
            )
        })
    }

    fn moved(&self, place: [f64; 3], near: &[usize], figure: &[[f64; 3]]) -> [f64; 3] {
        let from = |a: usize| Vector3::from(minus(self.others[a], self.others[near[0]]));
        let to = |a: usize| Vector3::from(minus(figure[a], figure[near[0]]));
        let around = near[1..].iter().map(|&a| {
            let weight = from(a).norm_squared().powi(-2);
            weight * to(a) * from(a).transpose()
        });
        let svd = around.sum::<Matrix3<f64>>().svd(true, true);
        let (Some(u), Some(v)) = (svd.u, svd.v_t) else {
            return place;
        };
        // In a plane either side is as good: that is taken which keeps it unmirrored.
        let sign = match svd.singular_values[2] < FLAT * FLAT * svd.singular_values[0] {
            true => (u * v).determinant().signum(),
            false => 1.0,
        };
        let turn = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * v;
        let moved = turn * Vector3::from(minus(place, self.others[near[0]]))
            + Vector3::from(figure[near[0]]);
        moved.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hydrogens_go_along_with_what_is_turned_or_mirrored() {
        let others = vec![
            [0.0, 0.0, 0.0],
            [1.4, 0.2, -0.1],
            [-0.6, 1.3, 0.3],
            [-0.5, -0.7, 1.2],
            [2.1, 1.4, 0.6],
            [3.5, 1.3, -0.4],
        ];
        let place = [-0.3, -0.5, -0.9];
        let hydrogens = Hydrogens::new(vec![(7, place)], others.clone());
        for mirrored in [1.0, -1.0] {
            let moved = |[x, y, z]: [f64; 3]| {
                [
                    0.6 * x - 0.8 * z + 5.0,
                    0.8 * x + 0.6 * z,
                    mirrored * y - 3.0,
                ]
            };
            let figure: Vec<[f64; 3]> = others.iter().map(|&p| moved(p)).collect();
            let [(line, there)] = hydrogens.placed(&figure).collect::<Vec<_>>()[..] else {
                panic!("it is one");
            };
            assert!(
                line == 7 && length(minus(there, moved(place))) < 1e-12,
                "{there:?}"
            );
        }
        assert_eq!(hydrogens.placed(&others).next(), Some((7, place)));
    }
}
