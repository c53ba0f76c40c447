//! What a chemist wants to see of a molecule's figures: torsions, contacts, and how far they are from the file's.

use super::chirality::{Letter, Stereocentre};
use super::element;
use crate::interval::point;
use crate::interval::vector::{Vector, cross, dot, length, minus};
use crate::nalgebra::Matrix3;
use crate::order::InOrder;
use std::collections::{BTreeSet, VecDeque};

/// The atoms and bonds of a molecule.
#[derive(Debug, Clone, PartialEq)]
pub struct Skeleton {
    /// The element of each atom.
    pub(super) elements: Vec<String>,
    /// Where the file has it, in ångström.
    pub(super) places: Vec<[f64; 3]>,
    /// Indices of atoms.
    pub(super) bonds: Vec<[usize; 2]>,
    stereocentres: Vec<Stereocentre>,
}

/// A figure of a molecule. All numbers are floats, computed from the middles of the boxes that it is given by.
#[derive(Debug, Clone, PartialEq)]
pub struct Conformer {
    /// The root of the mean square of how far its atoms are from those of the file where it lies on these as well as it can, in ångström.
    pub rmsd: f64,
    /// Whether that is so of its mirror image, where this is a figure as well; what follows is of that then.
    pub is_mirrored: bool,
    /// The torsions of [`Skeleton::torsions`], in degrees from −180 to 180.
    pub torsions: Vec<f64>,
    /// Of atoms that are three bonds apart or more those that are nearest, measured by their van der Waals radii, how far they are
    /// apart, and by how much that is more than the sum of these; `None`: there are no such atoms.
    pub contact: Option<([usize; 2], f64, f64)>,
    /// The stereocentres, each with R or S, by the sign that is certain of the boxes, or why it has no letter, in words that follow *as*.
    pub letters: Vec<(usize, Letter)>,
}

/// Bonds go straight on where the sine of the angle is less than this.
const STRAIGHT: f64 = 0.1;
/// Van der Waals radii in ångström (Bondi, J. Phys. Chem. 68, 1964; of hydrogen as there).
const VAN_DER_WAALS: [(&str, f64); 15] = [
    ("H", 1.20),
    ("C", 1.70),
    ("N", 1.55),
    ("O", 1.52),
    ("F", 1.47),
    ("Si", 2.10),
    ("P", 1.80),
    ("S", 1.80),
    ("Cl", 1.75),
    ("As", 1.85),
    ("Se", 1.90),
    ("Br", 1.85),
    ("Te", 2.06),
    ("I", 1.98),
    ("Xe", 2.16),
];

impl Skeleton {
    pub(super) fn new(
        symbols: &[&str],
        places: &[[f64; 3]],
        bonds: &[[usize; 2]],
        stereocentres: Vec<Stereocentre>,
    ) -> Self {
        let elements = symbols.iter().map(|symbol| element(symbol).to_owned());
        Skeleton {
            elements: elements.collect(),
            places: places.to_vec(),
            bonds: bonds.to_vec(),
            stereocentres,
        }
    }

    /// The stereocentres with their letters as the file has them, as [`Conformer::letters`] are.
    pub fn letters(&self) -> Vec<(usize, Letter)> {
        let drawn: Vec<Vector> = self.places.iter().map(|place| place.map(point)).collect();
        self.letters_of(&drawn, false)
    }

    fn letters_of(&self, figure: &[Vector], is_mirrored: bool) -> Vec<(usize, Letter)> {
        let all = self.stereocentres.iter();
        all.map(|one| one.letter(figure, is_mirrored)).collect()
    }

    /// Four atoms in a row for each bond about which something turns: of a bond in a ring those of the smallest ring, otherwise heavy
    /// ones first. What turns hydrogens of carbon alone is left out, and a bond on a straight part, about which nothing turns.
    pub fn torsions(&self) -> Vec<[usize; 4]> {
        let near = neighbours(self.places.len(), &self.bonds);
        let is_hydrogen = |a: usize| self.elements[a] == "H";
        let of = |&[b, c]: &[usize; 2]| {
            let ends =
                |at: usize, other: usize| near[at].iter().copied().filter(move |&a| a != other);
            let pairs = ends(b, c).flat_map(|a| ends(c, b).map(move |d| [a, d]));
            let hydrogens = |ends: [usize; 2]| ends.into_iter().filter(|&a| is_hydrogen(a)).count();
            let best = pairs.filter(|[a, d]| a != d).min_by_key(|&[a, d]| {
                (
                    steps(&near, a, |[_, to]| [b, c].contains(&to))[d],
                    hydrogens([a, d]),
                    a,
                    d,
                )
            })?;
            let turns_hydrogens =
                |end: usize, at: usize| is_hydrogen(end) && self.elements[at] == "C";
            let [a, d] = best;
            let is_bent = |ends: [usize; 3]| {
                let [p, q, r] = ends.map(|a| self.places[a]);
                let (one, other) = (minus(p, q), minus(r, q));
                length(cross(one, other)) > STRAIGHT * length(one) * length(other)
            };
            let is_one = is_bent([a, b, c]) && is_bent([b, c, d]);
            (is_one && !turns_hydrogens(a, b) && !turns_hydrogens(d, c)).then_some([a, b, c, d])
        };
        self.bonds.iter().filter_map(of).collect()
    }

    /// Figures, given by boxes of all atoms, as a chemist wants to see them; with `either` each stands for its mirror image as well.
    pub fn conformers(&self, figures: &[&[Vector]], either: bool) -> Vec<Conformer> {
        let n = self.places.len();
        let (torsions, near) = (self.torsions(), neighbours(n, &self.bonds));
        let radius = |a: usize| {
            let mut known = VAN_DER_WAALS.iter();
            known.find(|(symbol, _)| self.elements[a] == *symbol)
        };
        let apart: Vec<Vec<usize>> = (0..n).map(|a| steps(&near, a, |_| false)).collect();
        let pairs = (0..n).flat_map(|b| (0..b).map(move |a| [a, b]));
        let pairs = pairs.filter(|&[a, b]| apart[a][b] > 2);
        let pairs: Vec<([usize; 2], f64)> = pairs
            .filter_map(|[a, b]| Some(([a, b], radius(a)?.1 + radius(b)?.1)))
            .collect();
        let seen = figures.iter().map(|boxes| {
            let figure: Vec<[f64; 3]> = boxes.iter().map(|p| p.map(|x| x.mid())).collect();
            let (rmsd, is_mirrored) = self.rmsd(&figure, either);
            let sign = if is_mirrored { -1.0 } else { 1.0 };
            let torsion = |four: &[usize; 4]| sign * torsion(four.map(|a| figure[a]));
            let contacts = pairs.iter().map(|&([a, b], radii)| {
                let far = length(minus(figure[a], figure[b]));
                ([a, b], far, far - radii)
            });
            Conformer {
                rmsd,
                is_mirrored,
                torsions: torsions.iter().map(torsion).collect(),
                contact: contacts.min_by(|a, b| a.2.total_cmp(&b.2)),
                letters: self.letters_of(boxes, is_mirrored),
            }
        });
        seen.collect()
    }

    /// How far a figure, or with `either` its mirror image, is from the file's where it lies on it as well as it can (Kabsch, Acta
    /// Cryst. A 32, 1976), and whether it is the mirror image that is nearer.
    fn rmsd(&self, figure: &[[f64; 3]], either: bool) -> (f64, bool) {
        let n = figure.len() as f64;
        let centred = |points: &[[f64; 3]]| -> Vec<[f64; 3]> {
            let middle = [0, 1, 2].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
            points.iter().map(|&p| minus(p, middle)).collect()
        };
        let (one, other) = (centred(&self.places), centred(figure));
        let entry = |i: usize, j: usize| {
            one.iter()
                .zip(&other)
                .map(|(p, q)| p[i] * q[j])
                .sum::<f64>()
        };
        let products = Matrix3::from_fn(entry);
        let mut sizes: Vec<f64> = products.singular_values().iter().copied().collect();
        sizes.order_by(|a, b| b.total_cmp(a));
        let last = sizes[2] * products.determinant().signum();
        let is_mirrored = either && last < 0.0;
        let overlap = sizes[0] + sizes[1] + if either { last.abs() } else { last };
        let squares = one.iter().chain(&other).map(|&p| dot(p, p)).sum::<f64>();
        (((squares - 2.0 * overlap).max(0.0) / n).sqrt(), is_mirrored)
    }
}

/// For each atom those that are bonded to it.
pub(super) fn neighbours(atoms: usize, bonds: &[[usize; 2]]) -> Vec<BTreeSet<usize>> {
    let mut near = vec![BTreeSet::new(); atoms];
    for &[a, b] in bonds {
        near[a].insert(b);
        near[b].insert(a);
    }
    near
}

/// How many bonds from one atom to each other, where `skip` says from where to where none is gone; `usize::MAX`: there is no way.
pub(super) fn steps(
    near: &[BTreeSet<usize>],
    from: usize,
    skip: impl Fn([usize; 2]) -> bool,
) -> Vec<usize> {
    let mut steps = vec![usize::MAX; near.len()];
    steps[from] = 0;
    let mut next = VecDeque::from([from]);
    while let Some(a) = next.pop_front() {
        for &b in &near[a] {
            if !skip([a, b]) && steps[b] == usize::MAX {
                steps[b] = steps[a] + 1;
                next.push_back(b);
            }
        }
    }
    steps
}

/// The torsion of four points in a row, in degrees, with IUPAC's sign.
fn torsion([a, b, c, d]: [[f64; 3]; 4]) -> f64 {
    let (p, q, r) = (minus(b, a), minus(c, b), minus(d, c));
    let (m, n) = (cross(p, q), cross(q, r));
    (length(q) * dot(p, n)).atan2(dot(m, n)).to_degrees()
}
