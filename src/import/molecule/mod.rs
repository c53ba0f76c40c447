//! Molecules: XYZ (`.xyz`), MDL's molfiles (`.mol`, `.sdf`, version V2000), and the Protein Data Bank's files (`.pdb`, `.ent`).
//!
//! Atoms are points, and what is known of their distances from bonds, bond angles and rings are distances: of atoms that
//! are bonded (1-2), that are bonded to the same one (1-3), and at the ends of three bonds of rings in a row (1-4), as the
//! file has them, rounded to six digits behind the point. Of these, in this order, those are taken that do not follow
//! from the ones before by rigidity; where that is not enough to hold the molecule, distances further along its bonds
//! come after them. So the problem has as many distances as free coordinates, and its figures are conformers.
//!
//! Where the molecule has straight or flat parts (nitriles, alkynes, aromatic rings), distances do not hold it: bonds that go
//! straight on are `collinear` then, and atoms in one plane `coplanar` ([`hold`]).
//!
//! Figures keep the side of stereocentres ([`chirality`]), which are named R and S where the file has orders of bonds ([`cip`]).
//!
//! Files in XYZ have no bonds: atoms are taken for bonded that are not further apart than their covalent radii (Cordero
//! and others, Dalton Transactions 2008) and 0.45 Å, as Open Babel does.

mod chirality;
mod cip;
mod hold;
mod hydrogens;
mod pdb;
mod skeleton;
mod structure;

use super::{Figure, Format, Imported, Listed, Places as AllPlaces};
use crate::complete::{Spare, Surplus};
use crate::interval::vector::{length, minus};
use crate::problem::{Decimal, Distance, Orientation, Problem, Target, counted};
pub use chirality::Letter;
use chirality::{Stereocentre, stereocentres};
use hold::{Held, hold};
use hydrogens::Hydrogens;
pub use skeleton::{Conformer, Skeleton};
use std::borrow::Cow;
use std::collections::BTreeMap;
use structure::{Detail, Structure};

/// More atoms are not read: the choice of distances takes time like the fourth power of their number.
const MOST_ATOMS: usize = 150;

/// Coordinates are no larger than this, in ångström.
const LARGEST: f64 = 1e6;

/// Where the coordinates stand.
#[derive(Debug, Clone)]
pub struct Places {
    format: Format,
    /// The line of each atom.
    lines: Vec<usize>,
    /// Atoms that were left out.
    hydrogens: Hydrogens,
}

/// A molecule as it is read.
#[derive(Default)]
struct Molecule<'a> {
    name: String,
    atoms: Vec<(&'a str, [&'a str; 3], usize)>,
    bonds: Option<Vec<[usize; 2]>>,
    /// The orders of these ([`Structure::near`]), and details of atoms; none where there are no such in the format.
    orders: Vec<u8>,
    details: Vec<Detail>,
    /// See [`Imported::notes`].
    notes: Vec<String>,
}

/// The text of a file. Comments that are no UTF-8 are taken for Latin-1; so the second is whether they were.
fn text(bytes: &[u8]) -> (Cow<'_, str>, bool) {
    match std::str::from_utf8(bytes) {
        Ok(text) => (Cow::Borrowed(text), false),
        Err(_) => (bytes.iter().map(|&b| char::from(b)).collect(), true),
    }
}

fn molecules(text: &str, format: Format) -> Result<Vec<Molecule<'_>>, String> {
    if text.contains('\0') {
        return Err("is no text".to_owned());
    }
    let text = text.trim_start_matches('\u{feff}');
    let lines: Vec<&str> = text
        .split('\n')
        .map(|line| line.trim_end_matches('\r'))
        .collect();
    let mut all = match format {
        Format::Xyz => xyz(&lines)?,
        Format::Pdb => pdb::chains(&lines)?,
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

/// What is wrong with a line, by index, on which an atom was expected.
fn no_atom(line: usize) -> String {
    format!("line {}: an atom is missing, or its coordinates", line + 1)
}

fn xyz<'a>(lines: &[&'a str]) -> Result<Vec<Molecule<'a>>, String> {
    let mut all = Vec::new();
    let mut at = 0;
    while at < lines.len() {
        if lines[at].trim().is_empty() {
            at += 1;
            continue;
        }
        let count = lines[at].split_whitespace().next();
        let count: usize = count
            .and_then(|count| count.parse().ok())
            .ok_or_else(|| format!("line {}: there is no number of atoms", at + 1))?;
        let name = lines.get(at + 1).map_or("", |line| line.trim());
        let mut atoms = Vec::new();
        for line in at + 2..at.saturating_add(2).saturating_add(count) {
            let mut fields = lines.get(line).map_or("", |line| *line).split_whitespace();
            let mut field = || fields.next();
            match (field(), field(), field(), field()) {
                (Some(element), Some(x), Some(y), Some(z)) => {
                    atoms.push((element, [x, y, z], line));
                }
                _ => return Err(no_atom(line)),
            }
        }
        at += 2 + count;
        all.push(Molecule {
            name: if name.is_empty() { "molecule" } else { name }.to_owned(),
            atoms,
            ..Molecule::default()
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
        // In columns of three characters, or with blanks between where that is not so.
        let numbers = |text: &str| -> Option<([usize; 2], Option<usize>)> {
            let column = |from: usize| {
                let to = text.len().min(from + 3);
                text.get(from..to)?.trim().parse().ok()
            };
            let mut fields = text.split_whitespace();
            let mut field = || fields.next()?.parse().ok();
            match (column(0), column(3)) {
                (Some(a), Some(b)) => Some(([a, b], column(6))),
                _ => Some(([field()?, field()?], field())),
            }
        };
        let here = format!("line {}", begin + 4);
        if counts.contains("V3000") {
            return Err(format!(
                "{here}: version V3000 of molfiles is not read, V2000 is"
            ));
        }
        let Some(([atoms, bonds], _)) = numbers(counts) else {
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
            bonds: Some(Vec::new()),
            ..Molecule::default()
        };
        if out.name.is_empty() {
            out.name = "molecule".to_owned();
        }
        for k in 0..atoms {
            let (at, text) = line(k);
            match in_columns(text).or_else(|| with_blanks(text)) {
                Some((element, coordinates)) => {
                    out.atoms.push((element, coordinates, at));
                    out.details.push(detail(text));
                }
                None => return Err(no_atom(at)),
            }
        }
        for k in 0..bonds {
            let (at, text) = line(atoms + k);
            let is_one = |k: usize| (1..=atoms).contains(&k);
            match numbers(text) {
                Some(([a, b], order)) if is_one(a) && is_one(b) && a != b => {
                    out.bonds.get_or_insert_default().push([a - 1, b - 1]);
                    let order = order.and_then(|order| u8::try_from(order).ok());
                    out.orders.push(order.unwrap_or(0));
                }
                _ => {
                    return Err(format!(
                        "line {}: a bond between two atoms is missing",
                        at + 1
                    ));
                }
            }
        }
        let properties = begin + 4 + atoms + bonds;
        properties_into(&mut out, &lines[..end], properties)?;
        all.push(out);
        begin = end + 1;
    }
    Ok(all)
}

/// What the line of an atom in a molfile has behind its element.
fn detail(line: &str) -> Detail {
    let (from, before) = if in_columns(line).is_some() {
        (31, 1)
    } else {
        (0, 4)
    };
    let fields = line.get(from..).unwrap_or("").split_whitespace();
    let numbers: Vec<i32> = fields
        .skip(before)
        .map_while(|field| field.parse().ok())
        .collect();
    let number = |k: usize| numbers.get(k).copied().unwrap_or(0);
    Detail {
        isotope: number(0),
        is_odd: number(1) != 0 || number(5) != 0,
    }
}

/// Takes over what the lines of properties, from one on, say of isotopes, charges and unpaired electrons.
fn properties_into(out: &mut Molecule, lines: &[&str], from: usize) -> Result<(), String> {
    let all = lines.iter().enumerate().skip(from);
    let all = all.take_while(|(_, line)| !line.starts_with("M  END"));
    let all = all.filter(|(_, line)| {
        ["M  ISO", "M  CHG", "M  RAD"]
            .iter()
            .any(|kind| line.starts_with(kind))
    });
    let mut are_replaced = false;
    for (at, line) in all {
        let is_isotope = line.starts_with("M  ISO");
        if is_isotope && !are_replaced {
            are_replaced = true;
            out.details.iter_mut().for_each(|detail| detail.isotope = 0);
        }
        // Behind how many there are: an atom and a number, and so on.
        let fields = line.get(9..).unwrap_or("").split_whitespace();
        let numbers: Option<Vec<i32>> = fields.map(|field| field.parse().ok()).collect();
        for pair in numbers.unwrap_or_else(|| vec![0]).chunks(2) {
            let atom = usize::try_from(pair[0])
                .ok()
                .and_then(|atom| atom.checked_sub(1));
            let (Some(atom), Some(&number)) = (atom.filter(|&a| a < out.atoms.len()), pair.get(1))
            else {
                return Err(format!(
                    "line {}: an atom, or a number for it, is missing",
                    at + 1
                ));
            };
            match is_isotope {
                true => out.details[atom].isotope = isotope(element(out.atoms[atom].0), number),
                false => out.details[atom].is_odd |= number != 0,
            }
        }
    }
    Ok(())
}

/// An atom's element and coordinates in the columns of a molfile.
fn in_columns(line: &str) -> Option<(&str, [&str; 3])> {
    let field = |from: usize| line.get(from..from + 10).map(str::trim);
    let coordinates = [field(0)?, field(10)?, field(20)?];
    let element = line.get(31..)?.split_whitespace().next()?;
    let are_numbers = coordinates.iter().all(|text| number(text).is_some());
    are_numbers.then_some((element, coordinates))
}

/// An atom's element and coordinates in a line of a molfile whose fields have blanks between, as some programs
/// write them.
fn with_blanks(line: &str) -> Option<(&str, [&str; 3])> {
    let mut fields = line.split_whitespace();
    let coordinates = [fields.next()?, fields.next()?, fields.next()?];
    let are_numbers = coordinates.iter().all(|text| number(text).is_some());
    are_numbers.then_some((fields.next()?, coordinates))
}

/// A coordinate, also with the exponents of Fortran (`1.2D-05`) and Mathematica (`1.2*^-5`).
fn number(text: &str) -> Option<f64> {
    let plain = text.replace("*^", "e").replace(['D', 'd'], "e");
    let is_plain = plain
        .bytes()
        .all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
    plain
        .parse()
        .ok()
        .filter(|x: &f64| is_plain && x.is_finite())
}

pub fn list(bytes: &[u8], format: Format) -> Result<Vec<Listed>, String> {
    let (text, _) = text(bytes);
    let listed = molecules(&text, format)?
        .into_iter()
        .map(|molecule| Listed {
            label: None,
            drawn: molecule.atoms.len(),
            constraints: molecule.bonds.map_or(0, |bonds| bonds.len()),
            name: molecule.name,
        });
    Ok(listed.collect())
}

/// The symbols of the elements, by atomic number.
pub(crate) const ELEMENTS: &str = "H He Li Be B C N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga \
    Ge As Se Br Kr Rb Sr Y Zr Nb Mo Tc Ru Rh Pd Ag Cd In Sn Sb Te I Xe Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb Dy Ho Er Tm Yb \
    Lu Hf Ta W Re Os Ir Pt Au Hg Tl Pb Bi Po At Rn Fr Ra Ac Th Pa U Np Pu Am Cm Bk Cf Es Fm Md No Lr Rf Db Sg Bh Hs Mt \
    Ds Rg Cn Nh Fl Mc Lv Ts Og";
/// Covalent radii of the first of them in ångström (of Mn, Fe, Co those of low spin).
const RADII: [f64; 54] = [
    0.31, 0.28, 1.28, 0.96, 0.84, 0.76, 0.71, 0.66, 0.57, 0.58, 1.66, 1.41, 1.21, 1.11, 1.07, 1.05,
    1.02, 1.06, 2.03, 1.76, 1.70, 1.60, 1.53, 1.39, 1.39, 1.32, 1.26, 1.24, 1.32, 1.22, 1.22, 1.20,
    1.19, 1.20, 1.20, 1.16, 2.20, 1.95, 1.90, 1.75, 1.64, 1.54, 1.47, 1.46, 1.42, 1.39, 1.45, 1.44,
    1.42, 1.39, 1.39, 1.38, 1.39, 1.40,
];

/// Standard atomic weights of the same (IUPAC 2021, abridged).
const WEIGHTS: [f64; 54] = [
    1.008, 4.0026, 6.94, 9.0122, 10.81, 12.011, 14.007, 15.999, 18.998, 20.180, 22.990, 24.305,
    26.982, 28.085, 30.974, 32.06, 35.45, 39.95, 39.098, 40.078, 44.956, 47.867, 50.942, 51.996,
    54.938, 55.845, 58.933, 58.693, 63.546, 65.38, 69.723, 72.630, 74.922, 78.971, 79.904, 83.798,
    85.468, 87.62, 88.906, 91.224, 92.906, 95.95, 97.0, 101.07, 102.91, 106.42, 107.87, 112.41,
    114.82, 118.71, 121.76, 127.60, 126.90, 131.29,
];

/// [`Detail::isotope`] of a mass number; 0 as well of an element of which no weight is known.
fn isotope(symbol: &str, mass: i32) -> i32 {
    let weight = known()
        .zip(WEIGHTS)
        .find(|((known, _), _)| *known == symbol);
    weight.map_or(0, |(_, weight)| (f64::from(mass) - weight).round() as i32)
}

/// The elements whose radii are known, with these.
fn known() -> impl Iterator<Item = (&'static str, f64)> {
    ELEMENTS.split_whitespace().zip(RADII)
}

/// The element that a file means: by its symbol, in letters of either case and with a number behind it (`CL`, `C12`), or
/// by its atomic number.
fn element(text: &str) -> &str {
    if let Ok(number) = text.parse::<usize>() {
        let found = number.checked_sub(1).and_then(|k| known().nth(k));
        return found.map_or(text, |(symbol, _)| symbol);
    }
    let letters = text.trim_end_matches(|c: char| c.is_ascii_digit());
    if letters.eq_ignore_ascii_case("D") || letters.eq_ignore_ascii_case("T") {
        return "H";
    }
    known()
        .find(|(symbol, _)| symbol.eq_ignore_ascii_case(letters))
        .map_or(text, |(symbol, _)| symbol)
}

/// Its covalent radius.
fn radius(symbol: &str) -> Option<f64> {
    known()
        .find(|(known, _)| *known == symbol)
        .map(|(_, radius)| radius)
}

/// Reads a molecule, by its place in the file; with `heavy` without its hydrogens.
pub fn read(
    bytes: &[u8],
    (format, index): (Format, usize),
    heavy: bool,
) -> Result<Imported, String> {
    let (text, _) = text(bytes);
    let mut molecule = molecules(&text, format)?.swap_remove(index);
    let mut places = Vec::with_capacity(molecule.atoms.len());
    for (_, coordinates, line) in &molecule.atoms {
        let mut place = [0.0f64; 3];
        for (out, text) in place.iter_mut().zip(coordinates) {
            *out = number(text)
                .filter(|x| x.abs() <= LARGEST)
                .ok_or_else(|| format!("line {}: `{text}` is no coordinate", line + 1))?;
        }
        places.push(place);
    }
    let all = places.len();
    let stays = |a: &usize| !heavy || element(molecule.atoms[*a].0) != "H";
    let kept: Vec<usize> = (0..all).filter(stays).collect();
    let n = kept.len();
    if !(3..=MOST_ATOMS).contains(&n) || all > 10 * MOST_ATOMS {
        let besides = match all - n {
            0 => String::new(),
            hydrogens => format!(" and {}", counted(hydrogens, "hydrogen")),
        };
        return Err(format!(
            "{} has {}{besides}; 3 to {MOST_ATOMS} atoms are read",
            molecule.name,
            counted(n, "atom")
        ));
    }
    let apart = |a: usize, b: usize| length(minus(places[a], places[b]));
    let bonds = match molecule.bonds {
        Some(bonds) => bonds,
        None => {
            let mut radii = Vec::with_capacity(all);
            for (atom, _, line) in &molecule.atoms {
                let radius = radius(element(atom));
                radii.push(radius.ok_or_else(|| {
                    format!(
                        "line {}: no covalent radius of `{atom}` is known, so bonds cannot be told",
                        line + 1
                    )
                })?);
            }
            let pairs = (0..all).flat_map(|b| (0..b).map(move |a| [a, b]));
            pairs
                .filter(|&[a, b]| apart(a, b) <= radii[a] + radii[b] + 0.45)
                .collect()
        }
    };
    if let Some((a, b)) = (0..all)
        .flat_map(|b| (0..b).map(move |a| (a, b)))
        .find(|&(a, b)| apart(a, b) < 1e-3)
    {
        return Err(format!("atoms {} and {} are in one place", a + 1, b + 1));
    }
    let symbols: Vec<&str> = molecule.atoms.iter().map(|atom| atom.0).collect();
    // Hydrogens that are left out tell sides as well.
    let structure = Structure::new(&symbols, &bonds, &molecule.orders, &molecule.details);
    let signed = stereocentres(&structure, &places, stays);
    let new = |a: usize| kept.partition_point(|&b| b < a);
    let number = |a: usize| stays(&a).then(|| new(a));
    let centres = signed
        .iter()
        .map(|(points, _)| Stereocentre::new(&structure, points[0], number));
    let centres = centres.collect();
    let orientations = signed.into_iter().map(|(points, is_positive)| Orientation {
        points: points.map(new).to_vec(),
        is_positive,
    });
    let orientations = orientations.collect();
    let left = (0..all).filter(|a| !stays(a));
    let left: Vec<_> = left.map(|a| (molecule.atoms[a].2, places[a])).collect();
    if !left.is_empty() {
        molecule
            .notes
            .push(format!("without its hydrogens ({})", left.len()));
    }
    let bonds = bonds.into_iter().filter(|ends| ends.iter().all(stays));
    let bonds: Vec<[usize; 2]> = bonds.map(|ends| ends.map(new)).collect();
    let names: Vec<String> = kept
        .iter()
        .map(|&a| format!("{}{}", element(symbols[a]), a + 1))
        .collect();
    let atoms: Vec<_> = kept.iter().map(|&a| molecule.atoms[a]).collect();
    let places: Vec<[f64; 3]> = kept.iter().map(|&a| places[a]).collect();
    let hydrogens = Hydrogens::new(left, &places, &bonds);
    let apart = |a: usize, b: usize| length(minus(places[a], places[b]));
    let (held, told) = hold(&places, &bonds).ok_or_else(|| {
        format!(
            "{} cannot be held by distances: are all its atoms on one line?",
            molecule.name
        )
    })?;
    let written = |[a, b]: [usize; 2]| format!("{:.6}", apart(a, b));
    let reading = Reading::new(&held, &told, &names);
    let notes = molecule.notes.iter().map(|note| format!(", {note}"));
    let source = reading.in_words() + &notes.collect::<String>();
    let mut builder = Problem::build(&molecule.name, 3).source(&source);
    for (name, place) in names.iter().zip(&places) {
        let coordinates =
            place.map(|x| super::drawing::decimal(x).unwrap_or_else(|| Decimal::from(0)));
        builder = builder.point(name, coordinates);
    }
    for one in held {
        let of =
            |points: &[usize]| -> Vec<&str> { points.iter().map(|&p| names[p].as_str()).collect() };
        builder = match one {
            Held::Distance([a, b]) => {
                builder.distance(&names[a], &names[b], written([a, b]).as_str())
            }
            Held::Straight(points) => builder.constraint("collinear", of(&points)),
            Held::Flat(points) => builder.constraint("coplanar", of(&points)),
        };
    }
    let mut problem = builder.finish().map_err(|error| error.to_string())?;
    if let Some(bend) = bend(&problem) {
        problem.homotopy.bend = bend;
    }
    problem.orientations = orientations;
    let symbols: Vec<&str> = atoms.iter().map(|atom| atom.0).collect();
    let texts = atoms.iter().flat_map(|atom| atom.1);
    let epsilon = tolerance(texts);
    let spare = reading.left_out.iter().map(|&[a, b]| {
        let length: Decimal = written([a, b]).parse().map_err(|e| format!("{e:?}"))?;
        Ok(Spare {
            name: format!("{}-{}", names[a], names[b]),
            distance: Distance {
                points: [a, b],
                target: Target::Length(length),
            },
            epsilon,
        })
    });
    let spare = spare.collect::<Result<Vec<Spare>, String>>()?;
    let surplus = (!spare.is_empty() || !reading.added.is_empty()).then(|| Surplus {
        problem: problem.clone(),
        spare,
        added: reading.added,
    });
    Ok(Imported {
        notes: molecule.notes,
        tied: Vec::new(),
        problem,
        surplus,
        skeleton: Some(Skeleton::new(&symbols, &places, &bonds, centres)),
        places: AllPlaces::Molecule(Places {
            format,
            lines: atoms.iter().map(|atom| atom.2).collect(),
            hydrogens,
        }),
        sources: Vec::new(),
    })
}

/// How a molecule was read.
struct Reading {
    /// How many distances bonds and bond angles tell, and how many of these are used.
    told: [usize; 2],
    /// The others.
    left_out: Vec<[usize; 2]>,
    /// What holds it beside: flat and straight parts, torsions, in words.
    added: Vec<String>,
}

impl Reading {
    fn new(held: &[Held], told: &[[usize; 2]], names: &[String]) -> Self {
        let is_used = |pair: &&[usize; 2]| held.contains(&Held::Distance(**pair));
        let list = |points: &[usize]| {
            let names: Vec<&str> = points.iter().map(|&p| names[p].as_str()).collect();
            names.join(", ")
        };
        let added = held.iter().filter_map(|one| match one {
            Held::Distance(pair) if told.contains(pair) => None,
            Held::Distance([a, b]) => {
                Some(format!("{}-{} as drawn (a torsion)", names[*a], names[*b]))
            }
            Held::Straight(points) => Some(format!("{} on one line as drawn", list(points))),
            Held::Flat(points) => Some(format!("{} in one plane as drawn", list(points))),
        });
        Reading {
            told: [told.len(), told.iter().filter(is_used).count()],
            left_out: told.iter().filter(|pair| !is_used(pair)).copied().collect(),
            added: added.collect(),
        }
    }

    fn in_words(&self) -> String {
        let [all, used] = self.told;
        let mut text = "a molecule".to_owned();
        if used < all {
            text += &format!(", by {used} of its {all} distances of bonds and bond angles");
        }
        if !self.added.is_empty() {
            text += &format!(", beside which it has {}", self.added.join("; "));
        }
        text
    }
}

/// Within what a distance that was left out counts as met, in ångström: what the digits of coordinates leave open, but no less than
/// this, as no molecule is known better.
fn tolerance<'a>(coordinates: impl Iterator<Item = &'a str>) -> f64 {
    const LEAST: f64 = 1e-4;
    let last = coordinates.filter_map(|text| text.parse::<Decimal>().ok());
    let finest = last.map(|x| x.last_digit()).min().unwrap_or(0);
    // Each of two ends is off by half a unit of the last digit along each of three axes.
    LEAST.max(3f64.sqrt() * 10f64.powi(finest))
}

/// A distance to bend, by index: the last one that cannot vanish on the way, because a third atom is at fixed distances from
/// both that are not about equal. (Where the two hydrogens of water meet, the path of a bent distance between them ends.)
/// `None`: there is none such, and the last one bends. Any choice gives a path with a proof of its own.
fn bend(problem: &Problem) -> Option<usize> {
    // A difference of so small a part keeps atoms no further apart than paths go in any case.
    const UNEQUAL: f64 = 0.01;
    let mut near: Vec<BTreeMap<usize, f64>> = vec![BTreeMap::new(); problem.points.len()];
    for distance in &problem.distances {
        let length = distance.target.to_f64();
        let [a, b] = distance.points;
        near[a].insert(b, length);
        near[b].insert(a, length);
    }
    let is_kept_apart = |[a, b]: [usize; 2]| {
        let mut third = near[a].iter();
        third.any(|(w, one)| {
            let other = near[b].get(w);
            other.is_some_and(|other| (one - other).abs() > UNEQUAL * one.max(*other))
        })
    };
    problem
        .distances
        .iter()
        .rposition(|distance| is_kept_apart(distance.points))
}

/// The file with new coordinates, all other characters as they were.
pub fn rewrite(places: &Places, bytes: &[u8], figure: &Figure) -> Result<Vec<u8>, String> {
    let too_large = |line: usize, file: &str| {
        let line = line + 1;
        format!("line {line}: a coordinate is too large for the columns of a {file}")
    };
    let (text, is_latin) = text(bytes);
    let body = text.trim_start_matches('\u{feff}');
    let mark = &text[..text.len() - body.len()];
    let mut lines: Vec<String> = body.split('\n').map(str::to_owned).collect();
    let atoms = places
        .lines
        .iter()
        .copied()
        .zip(figure.points.iter().copied());
    for (line, place) in atoms.chain(places.hydrogens.placed(figure.points)) {
        let place = &place;
        let old = lines
            .get_mut(line)
            .ok_or("an atom is missing: this is another file")?;
        *old = match places.format {
            Format::Xyz => with_fields(old, 1, place, 10),
            Format::Pdb if pdb::is_at(old, place) => old.clone(),
            Format::Pdb => {
                pdb::with_place(old, place).ok_or_else(|| too_large(line, "PDB file"))?
            }
            _ if in_columns(old).is_some() => {
                let new = columns(place, 10, 4).ok_or_else(|| too_large(line, "molfile"))?;
                new + old.get(30..).unwrap_or("")
            }
            _ => with_fields(old, 0, place, 4),
        };
    }
    let text = mark.to_owned() + &lines.join("\n");
    Ok(match is_latin {
        // Every character was a byte.
        true => text.chars().map(|c| c as u8).collect(),
        false => text.into_bytes(),
    })
}

/// Coordinates in columns of so many characters, with so many digits behind the point, or nothing where one has no room.
fn columns(place: &[f64; 3], width: usize, digits: usize) -> Option<String> {
    // Without a sign of zero.
    let zero = format!("{:.digits$}", 0.0);
    let text =
        |x: f64| format!("{x:width$.digits$}").replace(&format!("-{zero}"), &format!(" {zero}"));
    let all = place.map(text);
    all.iter()
        .all(|text| text.len() <= width)
        .then(|| all.concat())
}

/// A line whose fields from the given one on are coordinates, with new ones: blanks and all other fields stay, but for
/// those in front of a number that takes more or less room, so that columns stay in line.
fn with_fields(line: &str, first: usize, place: &[f64; 3], digits: usize) -> String {
    let mut out = String::new();
    let mut rest = line;
    let mut field = 0usize;
    while let Some(begin) = rest.find(|c: char| !c.is_whitespace()) {
        let (blanks, from) = rest.split_at(begin);
        let end = from.find(char::is_whitespace).unwrap_or(from.len());
        let (old, after) = from.split_at(end);
        match field.checked_sub(first).and_then(|axis| place.get(axis)) {
            // What has not moved stays as it is written.
            Some(&x) if number(old) != Some(x) => {
                let new = format!("{:.digits$}", x + 0.0);
                let room = blanks.chars().count() + old.chars().count();
                let least = usize::from(!blanks.is_empty());
                let room = room.saturating_sub(new.len()).max(least);
                match blanks.contains('\t') {
                    true => out += blanks,
                    false => out.extend(std::iter::repeat_n(' ', room)),
                }
                out += &new;
            }
            _ => {
                out += blanks;
                out += old;
            }
        }
        field += 1;
        rest = after;
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import;

    /// The file of a molecule with another figure.
    pub fn written(of: &Imported, bytes: &[u8], figure: &Figure) -> Result<Vec<u8>, String> {
        import::rewrite(of, bytes, &of.problem, figure)
    }

    const CHAIR: &str = "6\ncyclohexane, carbon only\nC 1.45 0.0 0.25\nC 0.73 1.26 -0.25\nC -0.73 1.26 0.25\n\
                         C -1.45 0.0 -0.25\nC -0.73 -1.26 0.25\nC 0.73 -1.26 -0.25\n";

    #[test]
    fn a_ring_is_held_by_its_bonds_angles_and_torsions() {
        let ring = read(CHAIR.as_bytes(), (Format::Xyz, 0), false).unwrap();
        // 6 bonds and 6 angles are just enough.
        assert_eq!(ring.problem.distances.len(), 12);
        assert_eq!(ring.problem.distance_name(0).len(), "C1-C2".len());
        let mut places: Vec<[f64; 3]> = vec![[0.0; 3]; 6];
        places[2] = [1.0, 2.0, 3.0];
        let figure = Figure {
            points: &places,
            radii: &[],
        };
        let out = written(&ring, CHAIR.as_bytes(), &figure).unwrap();
        let out = String::from_utf8(out).unwrap();
        assert!(
            out.contains("\nC 1.0000000000 2.0000000000 3.0000000000\n"),
            "{out}"
        );
    }

    /// Benzene and propyne: distances alone do not hold what is flat or straight.
    #[test]
    fn flat_and_straight_parts_are_said_to_be_so() {
        let mut flat = "12\nbenzene\n".to_owned();
        for (element, radius) in [("C", 1.39f64), ("H", 2.48)] {
            for k in 0..6 {
                let angle = f64::from(k) * std::f64::consts::FRAC_PI_3;
                let (x, y) = (radius * angle.cos(), radius * angle.sin());
                flat += &format!("{element} {x:.6} {y:.6} 0\n");
            }
        }
        let ring = read(flat.as_bytes(), (Format::Xyz, 0), false)
            .unwrap()
            .problem;
        let kinds = |problem: &Problem, kind: &str| {
            let all = problem.constraints.iter();
            all.filter(|c| c.kind == kind).count()
        };
        // 2 n − 3 in the plane, n − 3 out of it.
        assert_eq!(ring.distances.len(), 21);
        assert_eq!(kinds(&ring, "coplanar"), 9);
        let straight = "7\npropyne\nC 0 0 0\nC 1.46 0 0\nC 2.67 0 0\nH 3.73 0 0\nH -0.37 1.02 0.1\n\
                        H -0.37 -0.6 0.83\nH -0.37 -0.42 -0.93\n";
        let chain = read(straight.as_bytes(), (Format::Xyz, 0), false)
            .unwrap()
            .problem;
        assert_eq!(kinds(&chain, "collinear"), 2);
        assert_eq!(chain.distances.len(), 3 * 7 - 6 - 4);
    }

    #[test]
    fn files_as_they_are_found() {
        let ammonia = "4\nammonia, \u{e5}ngstr\u{f6}m\n7\t0 0 1.0D-01\nH1 0.94 0 -2.8*^-1\nh -0.47 0.81 -0.28\nH -0.47 -0.81 -0.28";
        let latin: Vec<u8> = ammonia.chars().map(|c| c as u8).collect();
        let read_it = |bytes: &[u8]| read(bytes, (Format::Xyz, 0), false).unwrap();
        let found = read_it(&latin);
        assert_eq!(found.problem.points[0].name, "N1");
        assert_eq!(found.problem.distances.len(), 6);
        let old = [
            [0.0, 0.0, 0.1],
            [0.94, 0.0, -0.28],
            [-0.47, 0.81, -0.28],
            [-0.47, -0.81, -0.28],
        ];
        let figure = |points| Figure { points, radii: &[] };
        // What does not move is given back as it was.
        assert_eq!(written(&found, &latin, &figure(&old)).unwrap(), latin);
        let mut new = old;
        new[1][0] = 1.0;
        let out = written(&found, &latin, &figure(&new)).unwrap();
        let text: String = out.iter().map(|&b| char::from(b)).collect();
        assert!(text.contains("\nH1 1.0000000000 0 -2.8*^-1\n"), "{text}");
        let marked = [b"\xef\xbb\xbf", CHAIR.as_bytes()].concat();
        assert_eq!(read_it(&marked).problem.distances.len(), 12);
        // A molfile without columns and without an end.
        let loose = "x\n\n\n 4 3 0 V2000\n 0 0 0.1 N\n0.94 0 -0.28 H\n-0.47 0.81 -0.28 H\n-0.47 -0.81 -0.28 H\n\
                     1 2 1\n1 3 1\n1 4 1\n";
        let found = read(loose.as_bytes(), (Format::Sdf, 0), false).unwrap();
        assert_eq!(found.problem.distances.len(), 6);
        for bad in [
            "3\n\nC nan 0 0\nC 1 0 0\nC 0 1 0",
            "3\n\nC inf 0 0\nC 1 0 0\nC 0 1 0",
            "3\n\nC 0 0 0\nC 0 0 0\nC 0 1 0",
            "99999999999\n\nC",
        ] {
            assert!(
                read(bad.as_bytes(), (Format::Xyz, 0), false).is_err(),
                "{bad}"
            );
        }
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
        let ring = read(text.as_bytes(), (Format::Sdf, 0), false).unwrap();
        assert_eq!(ring.problem.name, "ring");
        assert_eq!(ring.problem.distances.len(), 12);
        assert!(read(b"x\n\n\nnothing", (Format::Sdf, 0), false).is_err());
    }
}
