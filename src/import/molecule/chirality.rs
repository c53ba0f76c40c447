//! Stereocentres: atoms that differ from their mirror images by how what is bonded to them is arranged.

use super::cip::{Ranked, ranked};
use super::structure::Structure;
use crate::interval::vector::{Vector, cross, dot, length, minus};
use crate::system::orientation;
use std::collections::BTreeMap;

/// An atom is drawn as a pyramid where the triple product of the directions of three of its bonds is at least this: it is 0.77 where the
/// bonds are those of a tetrahedron, and 0 in a plane.
const PYRAMID: f64 = 0.3;

/// The stereocentres of a molecule, each with three of its neighbours, and whether these are drawn so that det(b − a, c − a, d − a) is
/// greater than 0. An atom is one if it is drawn as a pyramid, has no multiple bond if it is carbon, and whatever is bonded to it is
/// different: other elements or isotopes, carbon with more or fewer multiple bonds, or so further along the bonds. Of three neighbours that is so for elements that keep their side: those of carbon's group, which have a
/// hydrogen that is not in the file, and those below nitrogen and oxygen, which have a pair of electrons. It is by neighbours that are told
/// that the side is.
pub fn stereocentres(
    of: &Structure,
    places: &[[f64; 3]],
    is_told: impl Fn(&usize) -> bool,
) -> Vec<([usize; 4], bool)> {
    let near: Vec<Vec<usize>> = of
        .near
        .iter()
        .map(|b| b.keys().copied().collect())
        .collect();
    let classes = classes(of, &near);
    let is_one = |&a: &usize| {
        let around = &near[a];
        let is_kept = match of.elements[a] {
            _ if of.excess(a) > 0 => false,
            _ if around.len() == 4 => true,
            "C" | "Si" | "Ge" | "Sn" => {
                let is_plain = |b: &usize| of.elements[*b] == "H" && of.details[*b].isotope == 0;
                around.len() == 3 && !around.iter().any(is_plain)
            }
            "P" | "As" | "Sb" | "S" | "Se" | "Te" => around.len() == 3,
            _ => false,
        };
        let differ =
            |(k, &b): (usize, &usize)| around[..k].iter().all(|&c| classes[b] != classes[c]);
        is_kept && around.iter().enumerate().all(differ)
    };
    let all = (0..near.len()).filter(is_one);
    let signed = all.filter(&is_told).filter_map(|a| {
        let mut told = near[a].iter().copied().filter(&is_told);
        let points = [a, told.next()?, told.next()?, told.next()?];
        let [u, v, w] = [1, 2, 3].map(|k| {
            let bond = minus(places[points[k]], places[a]);
            bond.map(|x| x / length(bond))
        });
        let triple = dot(u, cross(v, w));
        (triple.abs() >= PYRAMID).then_some((points, triple > 0.0))
    });
    signed.collect()
}

/// A stereocentre, and how its neighbours rank.
#[derive(Debug, Clone, PartialEq)]
pub struct Stereocentre {
    atom: usize,
    ranked: Ranked,
}

impl Stereocentre {
    /// With the numbers that atoms have where some are left out, which have none.
    pub fn new(of: &Structure, atom: usize, number: impl Fn(usize) -> Option<usize>) -> Self {
        let ranked = ranked(of, atom).map(|all| all.map(|one| one.and_then(&number)));
        Stereocentre {
            atom: number(atom).unwrap_or(atom),
            ranked,
        }
    }

    /// The atom, and R or S as a figure, or its mirror image, has it, or why there is no letter. Each three of the neighbours tell the
    /// side of the fourth.
    pub fn letter(&self, figure: &[Vector], is_mirrored: bool) -> (usize, Letter) {
        let side = |ranked: [Option<usize>; 4]| {
            let without = |k: usize| -> Option<i8> {
                let [b, c, d] = [0, 1, 2].map(|i| ranked[if i < k { i } else { i + 1 }]);
                let sign = orientation(figure, &[self.atom, b?, c?, d?]);
                Some(if (k % 2 == 1) == is_mirrored {
                    -sign
                } else {
                    sign
                })
            };
            let sides: Vec<i8> = (0..4).filter_map(without).collect();
            let first = sides.first().copied().unwrap_or(0);
            match sides.iter().all(|one| *one == first) {
                // Seen from where the lowest one is not, the others go against the clock where the determinant is greater than 0.
                true if first > 0 => Ok('S'),
                true if first < 0 => Ok('R'),
                _ => Err("on which side its neighbours are is not certain"),
            }
        };
        (self.atom, self.ranked.and_then(side))
    }
}

/// R or S, or why it is neither, in words that follow *as*.
pub type Letter = Result<char, &'static str>;

/// Classes of atoms that elements, isotopes and bonds tell apart: refined by the classes of their neighbours until there are no more (Morgan, J.
/// Chem. Doc. 5, 1965).
fn classes(of: &Structure, near: &[Vec<usize>]) -> Vec<usize> {
    fn numbered<T: Ord + Clone>(all: &[T]) -> (Vec<usize>, usize) {
        let mut numbers: BTreeMap<T, usize> = all.iter().map(|one| (one.clone(), 0)).collect();
        for (k, number) in numbers.values_mut().enumerate() {
            *number = k;
        }
        let of = all.iter().map(|one| numbers[one]).collect();
        (of, numbers.len())
    }
    let own = |a: usize| (of.elements[a], of.details[a].isotope, of.excess(a));
    let (mut classes, mut count) = numbered(&(0..near.len()).map(own).collect::<Vec<_>>());
    loop {
        let refined: Vec<(usize, Vec<usize>)> = near
            .iter()
            .enumerate()
            .map(|(a, around)| {
                let mut others: Vec<usize> = around.iter().map(|&b| classes[b]).collect();
                others.sort_unstable();
                (classes[a], others)
            })
            .collect();
        let (next, more) = numbered(&refined);
        classes = next;
        if more == count {
            return classes;
        }
        count = more;
    }
}
