//! Molecules: XYZ (`.xyz`) and MDL's molfiles (`.mol`, `.sdf`, version V2000).
//!
//! Atoms are points, and what is known of their distances from bonds, bond angles and rings are distances: of atoms that
//! are bonded (1-2), that are bonded to the same one (1-3), and at the ends of three bonds of rings in a row (1-4), as the
//! file has them, rounded to six digits behind the point. Of these, in this order, those are taken that do not follow
//! from the ones before by rigidity; where that is not enough to hold the molecule, distances further along its bonds
//! come after them. So the problem has as many distances as free coordinates, and its figures are conformers.
//!
//! Files in XYZ have no bonds: atoms are taken for bonded that are not further apart than their covalent radii (Cordero
//! and others, Dalton Transactions 2008) and 0.45 Å, as Open Babel does.

use super::{Figure, Format, Imported, Listed, Places as AllPlaces};
use crate::problem::{Decimal, Problem, rigidity};
use std::collections::{BTreeMap, BTreeSet};

/// More atoms are not read: the choice of distances takes time like the fourth power of their number.
const MOST_ATOMS: usize = 150;

/// Where the coordinates stand.
#[derive(Debug, Clone)]
pub struct Places {
    format: Format,
    /// The line of each atom.
    lines: Vec<usize>,
}

/// A molecule as it is read.
struct Molecule<'a> {
    name: String,
    atoms: Vec<(&'a str, [&'a str; 3], usize)>,
    bonds: Option<Vec<[usize; 2]>>,
}

fn text(bytes: &[u8]) -> Result<&str, String> {
    std::str::from_utf8(bytes).map_err(|_| "is not a text in UTF-8".to_owned())
}

fn molecules(bytes: &[u8], format: Format) -> Result<Vec<Molecule<'_>>, String> {
    let text = text(bytes)?;
    let lines: Vec<&str> = text
        .split('\n')
        .map(|line| line.trim_end_matches('\r'))
        .collect();
    let mut all = match format {
        Format::Xyz => xyz(&lines)?,
        _ => molfiles(&lines)?,
    };
    let names: Vec<String> = all.iter().map(|m| m.name.clone()).collect();
    for (k, molecule) in all.iter_mut().enumerate() {
        if names.iter().filter(|name| **name == molecule.name).count() > 1 {
            molecule.name = format!("{}#{}", molecule.name, k + 1);
        }
    }
    Ok(all)
}

fn xyz<'a>(lines: &[&'a str]) -> Result<Vec<Molecule<'a>>, String> {
    let mut all = Vec::new();
    let mut at = 0;
    while at < lines.len() {
        if lines[at].trim().is_empty() {
            at += 1;
            continue;
        }
        let count: usize = lines[at]
            .trim()
            .parse()
            .map_err(|_| format!("line {}: there is no number of atoms", at + 1))?;
        let name = lines.get(at + 1).map_or("", |line| line.trim());
        let mut atoms = Vec::new();
        for line in at + 2..at.saturating_add(2).saturating_add(count) {
            let mut fields = lines.get(line).map_or("", |line| *line).split_whitespace();
            let mut field = || fields.next();
            match (field(), field(), field(), field()) {
                (Some(element), Some(x), Some(y), Some(z)) => {
                    atoms.push((element, [x, y, z], line));
                }
                _ => {
                    return Err(format!(
                        "line {}: an atom is missing, or its coordinates",
                        line + 1
                    ));
                }
            }
        }
        at += 2 + count;
        all.push(Molecule {
            name: if name.is_empty() { "molecule" } else { name }.to_owned(),
            atoms,
            bonds: None,
        });
    }
    Ok(all)
}

fn molfiles<'a>(lines: &[&'a str]) -> Result<Vec<Molecule<'a>>, String> {
    let mut all = Vec::new();
    let mut begin = 0;
    while begin < lines.len() {
        let end = lines[begin..]
            .iter()
            .position(|line| line.starts_with("$$$$"));
        let end = end.map_or(lines.len(), |k| begin + k);
        if lines[begin..end].iter().all(|line| line.trim().is_empty()) {
            begin = end + 1;
            continue;
        }
        let counts = lines[begin..end].get(3).copied().unwrap_or("");
        let number = |text: &str, from: usize| -> Option<usize> {
            text.get(from..from + 3)?.trim().parse().ok()
        };
        let here = format!("line {}", begin + 4);
        if counts.contains("V3000") {
            return Err(format!(
                "{here}: version V3000 of molfiles is not read, V2000 is"
            ));
        }
        let both = (number(counts, 0), number(counts, 3));
        let (Some(atoms), Some(bonds)) = both else {
            return Err(format!("{here}: there are no numbers of atoms and bonds"));
        };
        let line = |k: usize| {
            (
                begin + 4 + k,
                lines[begin..end].get(4 + k).copied().unwrap_or(""),
            )
        };
        let mut out = Molecule {
            name: lines[begin].trim().to_owned(),
            atoms: Vec::new(),
            bonds: Some(Vec::new()),
        };
        if out.name.is_empty() {
            out.name = "molecule".to_owned();
        }
        for k in 0..atoms {
            let (at, text) = line(k);
            let field = |from: usize| text.get(from..from + 10).map(str::trim);
            let element = text
                .get(31..)
                .map(|rest| rest.split_whitespace().next().unwrap_or(""));
            match (field(0), field(10), field(20), element) {
                (Some(x), Some(y), Some(z), Some(element)) => {
                    out.atoms.push((element, [x, y, z], at))
                }
                _ => {
                    return Err(format!(
                        "line {}: an atom is missing, or its coordinates",
                        at + 1
                    ));
                }
            }
        }
        for k in 0..bonds {
            let (at, text) = line(atoms + k);
            let ends = [number(text, 0), number(text, 3)];
            match ends {
                [Some(a), Some(b)]
                    if (1..=atoms).contains(&a) && (1..=atoms).contains(&b) && a != b =>
                {
                    out.bonds.get_or_insert_default().push([a - 1, b - 1]);
                }
                _ => {
                    return Err(format!(
                        "line {}: a bond between two atoms is missing",
                        at + 1
                    ));
                }
            }
        }
        all.push(out);
        begin = end + 1;
    }
    Ok(all)
}

pub fn list(bytes: &[u8], format: Format) -> Result<Vec<Listed>, String> {
    let listed = molecules(bytes, format)?
        .into_iter()
        .map(|molecule| Listed {
            drawn: molecule.atoms.len(),
            constraints: molecule.bonds.map_or(0, |bonds| bonds.len()),
            name: molecule.name,
        });
    Ok(listed.collect())
}

/// Covalent radii in ångström.
fn radius(element: &str) -> Option<f64> {
    Some(match element {
        "H" | "D" => 0.31,
        "B" => 0.84,
        "C" => 0.76,
        "N" => 0.71,
        "O" => 0.66,
        "F" => 0.57,
        "Si" => 1.11,
        "P" => 1.07,
        "S" => 1.05,
        "Cl" => 1.02,
        "Se" => 1.20,
        "Br" => 1.20,
        "I" => 1.39,
        _ => return None,
    })
}

pub fn read(bytes: &[u8], format: Format, index: usize) -> Result<Imported, String> {
    let molecule = molecules(bytes, format)?.swap_remove(index);
    let n = molecule.atoms.len();
    if !(3..=MOST_ATOMS).contains(&n) {
        return Err(format!(
            "{} has {n} atoms; 3 to {MOST_ATOMS} are read",
            molecule.name
        ));
    }
    let mut places = Vec::with_capacity(n);
    for (_, coordinates, line) in &molecule.atoms {
        let mut place = [0.0f64; 3];
        for (out, text) in place.iter_mut().zip(coordinates) {
            let number = text.parse().ok().filter(|x: &f64| x.is_finite());
            *out = number.ok_or_else(|| format!("line {}: `{text}` is no coordinate", line + 1))?;
        }
        places.push(place);
    }
    let apart = |a: usize, b: usize| -> f64 {
        let square: f64 = (0..3).map(|k| (places[a][k] - places[b][k]).powi(2)).sum();
        square.sqrt()
    };
    let bonds = match molecule.bonds {
        Some(bonds) => bonds,
        None => {
            let mut radii = Vec::with_capacity(n);
            for (element, _, line) in &molecule.atoms {
                let radius = radius(element);
                radii.push(radius.ok_or_else(|| {
                    format!("line {}: no covalent radius of `{element}` is known, so bonds cannot be told", line + 1)
                })?);
            }
            let pairs = (0..n).flat_map(|b| (0..b).map(move |a| [a, b]));
            pairs
                .filter(|&[a, b]| apart(a, b) <= radii[a] + radii[b] + 0.45)
                .collect()
        }
    };
    let chosen = choose(n, &bonds, &apart).ok_or_else(|| {
        format!(
            "{} cannot be held by distances: is it in one plane or in pieces that touch nowhere?",
            molecule.name
        )
    })?;
    let names: Vec<String> = (0..n)
        .map(|k| format!("{}{}", molecule.atoms[k].0, k + 1))
        .collect();
    let mut builder = Problem::build(&molecule.name, 3).source("a molecule");
    for (name, place) in names.iter().zip(&places) {
        let coordinates =
            place.map(|x| super::drawing::decimal(x).unwrap_or_else(|| Decimal::from(0)));
        builder = builder.point(name, coordinates);
    }
    for [a, b] in chosen {
        builder = builder.distance(&names[a], &names[b], format!("{:.6}", apart(a, b)).as_str());
    }
    let problem = builder.finish().map_err(|error| error.to_string())?;
    Ok(Imported {
        problem,
        unsupported: BTreeMap::new(),
        places: AllPlaces::Molecule(Places {
            format,
            lines: molecule.atoms.iter().map(|atom| atom.2).collect(),
        }),
    })
}

/// Distances that hold the molecule without one to spare, those of bonds first.
fn choose(
    n: usize,
    bonds: &[[usize; 2]],
    apart: &impl Fn(usize, usize) -> f64,
) -> Option<Vec<[usize; 2]>> {
    let mut near = vec![BTreeSet::new(); n];
    for &[a, b] in bonds {
        near[a].insert(b);
        near[b].insert(a);
    }
    // Steps along bonds from each atom, without one bond.
    let steps = |from: usize, without: Option<[usize; 2]>| -> Vec<usize> {
        let mut steps = vec![usize::MAX; n];
        steps[from] = 0;
        let mut next = std::collections::VecDeque::from([from]);
        while let Some(a) = next.pop_front() {
            for &b in &near[a] {
                let skip = without.is_some_and(|[x, y]| [a, b] == [x, y] || [a, b] == [y, x]);
                if !skip && steps[b] == usize::MAX {
                    steps[b] = steps[a] + 1;
                    next.push_back(b);
                }
            }
        }
        steps
    };
    let in_ring: BTreeSet<[usize; 2]> = bonds
        .iter()
        .filter(|&&[a, b]| steps(a, Some([a, b]))[b] != usize::MAX)
        .map(|&[a, b]| [a.min(b), a.max(b)])
        .collect();
    let is_ring = |a: usize, b: usize| in_ring.contains(&[a.min(b), a.max(b)]);
    let mut of_rings: BTreeSet<[usize; 2]> = BTreeSet::new();
    for &[b, c] in &in_ring {
        for &a in near[b].iter().filter(|&&a| a != c && is_ring(a, b)) {
            for &d in near[c]
                .iter()
                .filter(|&&d| d != b && d != a && is_ring(c, d))
            {
                of_rings.insert([a.min(d), a.max(d)]);
            }
        }
    }
    let mut candidates: Vec<(usize, f64, [usize; 2])> = Vec::new();
    for a in 0..n {
        let steps = steps(a, None);
        for b in a + 1..n {
            let rank = match steps[b] {
                1 => 0,
                2 => 1,
                _ if of_rings.contains(&[a, b]) => 2,
                far => far.saturating_add(1).max(3),
            };
            candidates.push((rank, apart(a, b), [a, b]));
        }
    }
    candidates.sort_by(|x, y| x.0.cmp(&y.0).then(x.1.total_cmp(&y.1)));
    // As few at a time as can be enough: each dependent one is found and left out.
    let needed = 3 * n - 6;
    let mut edges: Vec<[usize; 2]> = Vec::new();
    let mut rest = candidates.into_iter().map(|c| c.2);
    while edges.len() < needed {
        edges.extend(rest.by_ref().take(needed - edges.len()));
        let found = rigidity(3, n, &edges);
        let mut circuit = found.circuit;
        while let Some(&last) = circuit.last() {
            edges.remove(last);
            circuit = rigidity(3, n, &edges).circuit;
        }
        if edges.len() < needed && rest.len() == 0 {
            return None;
        }
    }
    Some(edges)
}

pub fn rewrite(places: &Places, bytes: &[u8], figure: &Figure) -> Result<Vec<u8>, String> {
    let text = text(bytes)?;
    let mut lines: Vec<String> = text.split('\n').map(str::to_owned).collect();
    for (&line, place) in places.lines.iter().zip(figure.points) {
        let old = lines
            .get_mut(line)
            .ok_or("an atom is missing: this is another file")?;
        *old = match places.format {
            Format::Xyz => {
                let [x, y, z] = place;
                let mut fields = old.split_whitespace();
                let element = fields.next().unwrap_or("");
                let rest: Vec<&str> = fields.skip(3).collect();
                let end = if old.ends_with('\r') { "\r" } else { "" };
                let more = if rest.is_empty() {
                    String::new()
                } else {
                    format!(" {}", rest.join(" "))
                };
                format!("{element} {x:.10} {y:.10} {z:.10}{more}{end}")
            }
            _ => {
                let [x, y, z] = place;
                let rest = old.get(30..).unwrap_or("").to_owned();
                format!("{x:10.4}{y:10.4}{z:10.4}{rest}")
            }
        };
    }
    Ok(lines.join("\n").into_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHAIR: &str = "6\ncyclohexane, carbon only\nC 1.45 0.0 0.25\nC 0.73 1.26 -0.25\nC -0.73 1.26 0.25\n\
                         C -1.45 0.0 -0.25\nC -0.73 -1.26 0.25\nC 0.73 -1.26 -0.25\n";

    #[test]
    fn a_ring_is_held_by_its_bonds_angles_and_torsions() {
        let ring = read(CHAIR.as_bytes(), Format::Xyz, 0).unwrap();
        // 6 bonds and 6 angles are just enough.
        assert_eq!(ring.problem.distances.len(), 12);
        assert_eq!(ring.problem.distance_name(0).len(), "C1-C2".len());
        let mut places: Vec<[f64; 3]> = vec![[0.0; 3]; 6];
        places[2] = [1.0, 2.0, 3.0];
        let figure = Figure {
            points: &places,
            radii: &[],
        };
        let AllPlaces::Molecule(of) = &ring.places else {
            panic!()
        };
        let out = String::from_utf8(rewrite(of, CHAIR.as_bytes(), &figure).unwrap()).unwrap();
        assert!(
            out.contains("\nC 1.0000000000 2.0000000000 3.0000000000\n"),
            "{out}"
        );
    }

    #[test]
    fn a_molfile_has_bonds_of_its_own() {
        let mut text = "ring\n  x\n\n  6  6  0  0  0  0  0  0  0  0999 V2000\n".to_owned();
        for line in CHAIR.lines().skip(2) {
            let x: Vec<f64> = line
                .split(' ')
                .skip(1)
                .map(|x| x.parse().unwrap())
                .collect();
            text += &format!("{:10.4}{:10.4}{:10.4} C   0  0\n", x[0], x[1], x[2]);
        }
        for k in 0..6 {
            text += &format!("{:3}{:3}  1  0\n", k + 1, (k + 1) % 6 + 1);
        }
        text += "M  END\n$$$$\n";
        let listed = list(text.as_bytes(), Format::Sdf).unwrap();
        assert_eq!((listed[0].drawn, listed[0].constraints), (6, 6));
        let ring = read(text.as_bytes(), Format::Sdf, 0).unwrap();
        assert_eq!(ring.problem.name, "ring");
        assert_eq!(ring.problem.distances.len(), 12);
        assert!(read(b"x\n\n\nnothing", Format::Sdf, 0).is_err());
    }
}
