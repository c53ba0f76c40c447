//! Hydrogens that are left out of a molecule as it is read, and stand in the file that is written as they did to the bonds of their atoms.

use super::skeleton::neighbours;
use crate::interval::vector::{length, minus};
use crate::nalgebra::{Matrix3, Rotation3, Vector3};
use std::collections::BTreeSet;

/// Directions are taken for one where the sine of the angle between them is less than this.
const SAME: f64 = 1e-2;

/// The hydrogens of a molecule, without which it was read.
#[derive(Debug, Clone, Default)]
pub struct Hydrogens {
    /// The line and the place of each.
    all: Vec<(usize, [f64; 3])>,
    /// The places of all other atoms.
    others: Vec<[f64; 3]>,
    /// For each of these the others that are bonded to it.
    bonded: Vec<BTreeSet<usize>>,
}

impl Hydrogens {
    pub fn new(all: Vec<(usize, [f64; 3])>, others: &[[f64; 3]], bonds: &[[usize; 2]]) -> Self {
        Hydrogens {
            all,
            others: others.to_vec(),
            bonded: neighbours(others.len(), bonds),
        }
    }

    /// Their lines, and where they are in a figure of the other atoms: all that are bonded to an atom go along with it, turned as its other
    /// bonds are, and never to a mirror image.
    pub fn placed(&self, figure: &[[f64; 3]]) -> impl Iterator<Item = (usize, [f64; 3])> {
        self.all.iter().map(move |&(line, place)| {
            let far = |a: usize| length(minus(self.others[a], place));
            let all = 0..self.others.len();
            let of = all.min_by(|&a, &b| far(a).total_cmp(&far(b))).unwrap_or(0);
            let near = self.bonded[of].iter();
            let behind = near.flat_map(|&b| self.bonded[b].iter().copied().chain([b]));
            if behind.chain([of]).all(|a| figure[a] == self.others[a]) {
                return (line, place);
            }
            let from = Vector3::from(minus(place, self.others[of]));
            let there = Vector3::from(figure[of]) + self.turn(of, figure) * from;
            (line, there.into())
        })
    }

    fn turn(&self, of: usize, figure: &[[f64; 3]]) -> Matrix3<f64> {
        let old = self.directions(of, &self.others);
        let new = self.directions(of, figure);
        let turns = old.iter().zip(&new);
        let mut turns = turns.filter_map(|(old, new)| Some(frame(new)? * frame(old)?.transpose()));
        turns.next().unwrap_or_else(|| {
            let ends = [old, new].map(|all| all.first().map_or(Vector3::x(), |[u, _]| *u));
            Rotation3::rotation_between(&ends[0], &ends[1])
                .map_or_else(Matrix3::identity, Into::into)
        })
    }

    /// Pairs of directions at an atom, each by itself telling how its bonds have turned where it is no line: the sum of its bonds and a
    /// difference of two, then a bond and the next one behind it.
    fn directions(&self, of: usize, places: &[[f64; 3]]) -> Vec<[Vector3<f64>; 2]> {
        let to = |a: usize, b: usize| {
            let along = Vector3::from(minus(places[b], places[a]));
            along / along.norm()
        };
        let bonds: Vec<Vector3<f64>> = self.bonded[of].iter().map(|&b| to(of, b)).collect();
        let pair = match bonds[..] {
            [u, v, ..] => Some([bonds.iter().sum(), u - v]),
            _ => None,
        };
        let behind = self.bonded[of].iter().flat_map(|&b| {
            let ends = self.bonded[b].iter().filter(move |&&c| c != of);
            ends.map(move |&c| [to(of, b), to(b, c)])
        });
        pair.into_iter().chain(behind).collect()
    }
}

/// Three directions at right angles, the first along the first of these and the second in the plane of both. `None`: they are on a line.
fn frame([u, v]: &[Vector3<f64>; 2]) -> Option<Matrix3<f64>> {
    let normal = u.cross(v);
    (normal.norm() > SAME * u.norm() * v.norm() && u.norm() > SAME).then(|| {
        let (x, z) = (u.normalize(), normal.normalize());
        Matrix3::from_columns(&[x, z.cross(&x), z])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Butane's carbons with the hydrogens of the second and the last, and other torsions: hydrogens of one atom stay as far from each other
    /// and from it, and as far from both neighbours.
    #[test]
    fn hydrogens_go_along_with_the_bonds_of_their_atom() {
        let others = [
            [0.0, 0.0, 0.0],
            [1.5, 0.0, 0.0],
            [2.0, 1.4, 0.0],
            [3.5, 1.4, 0.1],
        ];
        let bonds = [[0, 1], [1, 2], [2, 3]];
        let all = vec![
            (7, [1.9, -0.5, 0.9]),
            (8, [1.9, -0.5, -0.9]),
            (9, [3.9, 0.9, 1.0]),
            (10, [3.9, 0.9, -0.8]),
        ];
        let hydrogens = Hydrogens::new(all.clone(), &others, &bonds);
        let same: Vec<_> = hydrogens.placed(&others).collect();
        assert_eq!(same, all);
        let far = |p: [f64; 3], q: [f64; 3]| length(minus(p, q));
        for torsion in [0.3f64, 1.2, 2.5, -0.8, -2.9] {
            // About the middle bond, and both mirrored and moved.
            let (sin, cos) = torsion.sin_cos();
            let axis = Vector3::new(0.5, 1.4, 0.0).normalize();
            let end = Vector3::new(1.5, 0.0, 0.1);
            let along = axis * axis.dot(&end);
            let end = along + (end - along) * cos + axis.cross(&end) * sin;
            let last = [2.0 + end.x, 1.4 + end.y, end.z];
            let figure =
                [others[0], others[1], others[2], last].map(|[x, y, z]| [y + 5.0, x, z - 2.0]);
            let there: Vec<[f64; 3]> = hydrogens.placed(&figure).map(|(_, place)| place).collect();
            for (k, atom) in [(0, 1), (1, 1), (2, 3), (3, 3)] {
                let (old, new) = (far(all[k].1, others[atom]), far(there[k], figure[atom]));
                assert!((old - new).abs() < 1e-12, "{torsion}: {old} {new}");
                for near in [atom - 1, atom + 1].into_iter().filter(|&a| a < 4) {
                    let (old, new) = (far(all[k].1, others[near]), far(there[k], figure[near]));
                    assert!((old - new).abs() < 1e-9, "{torsion}: {old} {new}");
                }
            }
            for [a, b] in [[0, 1], [2, 3]] {
                let (old, new) = (far(all[a].1, all[b].1), far(there[a], there[b]));
                assert!((old - new).abs() < 1e-12, "{torsion}: {old} {new}");
            }
        }
    }
}
