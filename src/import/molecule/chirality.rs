//! Stereocentres: atoms that differ from their mirror images by how what is bonded to them is arranged.

use super::element;
use super::skeleton::neighbours;
use crate::interval::vector::{cross, dot, length, minus};
use std::collections::BTreeMap;

/// An atom is drawn as a pyramid where the triple product of the directions of three of its bonds is at least this: it is 0.77 where the
/// bonds are those of a tetrahedron, and 0 in a plane.
const PYRAMID: f64 = 0.3;

/// The stereocentres of a molecule, each with three of its neighbours, and whether these are drawn so that det(b − a, c − a, d − a) is
/// greater than 0. An atom is one if it is drawn as a pyramid and whatever is bonded to it is different: other elements, or others
/// further along the bonds. Of three neighbours that is so for elements that keep their side: those of carbon's group, which have a
/// hydrogen that is not in the file, and those below nitrogen and oxygen, which have a pair of electrons. It is by neighbours that are told
/// that the side is.
pub fn stereocentres(
    symbols: &[&str],
    places: &[[f64; 3]],
    bonds: &[[usize; 2]],
    is_told: impl Fn(&usize) -> bool,
) -> Vec<([usize; 4], bool)> {
    let near = neighbours(symbols.len(), bonds);
    let near: Vec<Vec<usize>> = near.into_iter().map(Vec::from_iter).collect();
    let classes = classes(symbols, &near);
    let is_one = |&a: &usize| {
        let around = &near[a];
        let is_kept = match element(symbols[a]) {
            _ if around.len() == 4 => true,
            "C" | "Si" | "Ge" | "Sn" => {
                around.len() == 3 && around.iter().all(|&b| element(symbols[b]) != "H")
            }
            "P" | "As" | "Sb" | "S" | "Se" | "Te" => around.len() == 3,
            _ => false,
        };
        let differ =
            |(k, &b): (usize, &usize)| around[..k].iter().all(|&c| classes[b] != classes[c]);
        is_kept && around.iter().enumerate().all(differ)
    };
    let all = (0..symbols.len()).filter(is_one);
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

/// Classes of atoms that bonds and elements tell apart: refined by the classes of their neighbours until there are no more (Morgan, J.
/// Chem. Doc. 5, 1965).
fn classes(symbols: &[&str], near: &[Vec<usize>]) -> Vec<usize> {
    fn numbered<T: Ord + Clone>(all: &[T]) -> (Vec<usize>, usize) {
        let mut numbers: BTreeMap<T, usize> = all.iter().map(|one| (one.clone(), 0)).collect();
        for (k, number) in numbers.values_mut().enumerate() {
            *number = k;
        }
        let of = all.iter().map(|one| numbers[one]).collect();
        (of, numbers.len())
    }
    let elements: Vec<&str> = symbols.iter().map(|symbol| element(symbol)).collect();
    let (mut classes, mut count) = numbered(&elements);
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
