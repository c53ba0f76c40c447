//! Files of the Protein Data Bank (`.pdb`, `.ent`): the atoms of the first model, each chain a molecule.
//!
//! Columns are those of version 3.3 of the format. Water is left out; where a residue has several places (alternate locations) the first one counts. Both are told
//! ([`Molecule::notes`]). Bonds are those of the CONECT records where each atom of the chain has one, and are told by covalent radii otherwise.

use super::{Molecule, known};
use crate::order::each_once;
use std::collections::{HashMap, HashSet};

/// What water is called.
const WATER: [&str; 3] = ["HOH", "WAT", "DOD"];

/// The residues of proteins: their atoms have names of which the first letter is the element.
const AMINO_ACIDS: [&str; 20] = [
    "ALA", "ARG", "ASN", "ASP", "CYS", "GLN", "GLU", "GLY", "HIS", "ILE", "LEU", "LYS", "MET",
    "PHE", "PRO", "SER", "THR", "TRP", "TYR", "VAL",
];

pub fn chains<'a>(lines: &[&'a str]) -> Result<Vec<Molecule<'a>>, String> {
    let models = lines
        .iter()
        .filter(|line| line.starts_with("ENDMDL"))
        .count();
    let first = lines.iter().position(|line| line.starts_with("ENDMDL"));
    let mut all: Vec<Chain> = Vec::new();
    let (mut serials, mut are_unique) = (HashSet::new(), true);
    for (at, line) in lines[..first.unwrap_or(lines.len())].iter().enumerate() {
        if line.starts_with("ATOM") || line.starts_with("HETATM") {
            let atom = Atom::read(line, at).ok_or_else(|| {
                format!(
                    "line {}: an atom's name or coordinates are not in the columns of a PDB file",
                    at + 1
                )
            })?;
            are_unique &= serials.insert(atom.serial);
            let name = line.get(20..22).unwrap_or("").trim();
            let known = all.iter().position(|known| known.name == name);
            let known = known.unwrap_or_else(|| {
                all.push(Chain {
                    name,
                    ..Chain::default()
                });
                all.len() - 1
            });
            all[known].take(atom);
        }
    }
    // Serial numbers that stand twice, as in large files, tell no bonds.
    let bonds: Vec<[&str; 2]> = match are_unique {
        true => lines.iter().flat_map(|line| bonds(line)).collect(),
        false => Vec::new(),
    };
    let chains = all.into_iter().filter(|chain| !chain.atoms.is_empty());
    Ok(chains
        .map(|chain| chain.molecule(&bonds, models > 1))
        .collect())
}

/// What a line has of an atom.
struct Atom<'a> {
    serial: &'a str,
    /// Three letters, for what is common.
    residue: &'a str,
    /// The number of the residue, with its insertion code.
    number: &'a str,
    /// Which of several places of the residue this is in; empty where there is but one.
    location: &'a str,
    element: &'a str,
    /// Whether the file has a column for that.
    has_element: bool,
    coordinates: [&'a str; 3],
    line: usize,
}

impl<'a> Atom<'a> {
    fn read(text: &'a str, line: usize) -> Option<Self> {
        let field =
            |from: usize, to: usize| text.get(from..to.min(text.len())).map_or("", str::trim);
        let (name, residue) = (text.get(12..16)?, field(17, 20));
        let coordinates = [field(30, 38), field(38, 46), field(46, 54)];
        let are_numbers = coordinates.iter().all(|text| super::number(text).is_some());
        // Old files have other things in these columns.
        let symbol = Some(field(76, 78)).filter(|symbol| is_an_element(symbol));
        let is_of_a_protein = text.starts_with("ATOM") && AMINO_ACIDS.contains(&residue);
        are_numbers.then(|| Atom {
            serial: field(6, 11),
            residue,
            number: field(22, 27),
            location: field(16, 17),
            element: symbol.unwrap_or_else(|| element(name, is_of_a_protein)),
            has_element: symbol.is_some(),
            coordinates,
            line,
        })
    }
}

fn is_an_element(symbol: &str) -> bool {
    let mut all = known().map(|(symbol, _)| symbol).chain(["D", "T"]);
    all.any(|known| known.eq_ignore_ascii_case(symbol))
}

/// The element that the four columns of an atom's name tell: its symbol ends with the second one. But in proteins it has one letter, and so it has in names of
/// four letters that begin with that of hydrogen.
fn element(columns: &str, is_of_a_protein: bool) -> &str {
    let symbol = columns.get(..2).unwrap_or("").trim();
    let is_hydrogen = columns.starts_with('H') && !columns.ends_with(' ');
    let letter = columns.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(0);
    match is_an_element(symbol) && !is_of_a_protein && !is_hydrogen {
        true => symbol,
        false => columns.get(letter..letter + 1).unwrap_or(columns),
    }
}

/// The pairs of serial numbers in a CONECT record.
fn bonds(line: &str) -> Vec<[&str; 2]> {
    let field = |from: usize| {
        line.get(from..(from + 5).min(line.len()))
            .map_or("", str::trim)
    };
    let all = (1..5).map(|k| [field(6), field(6 + 5 * k)]);
    let is_record = line.starts_with("CONECT");
    all.filter(|[_, to]| is_record && !to.is_empty()).collect()
}

/// The atoms of a chain.
#[derive(Default)]
struct Chain<'a> {
    name: &'a str,
    atoms: Vec<Atom<'a>>,
    /// How many molecules of water there are: their oxygens.
    water: usize,
    /// The first place of each residue that has several.
    locations: HashMap<&'a str, &'a str>,
    /// Residues that are somewhere else, too.
    alternate: Vec<String>,
}

impl<'a> Chain<'a> {
    fn take(&mut self, atom: Atom<'a>) {
        if WATER.contains(&atom.residue) {
            self.water += usize::from(atom.element == "O");
        } else if !atom.location.is_empty()
            && *self.locations.entry(atom.number).or_insert(atom.location) != atom.location
        {
            let name = format!("{} {}", atom.residue, atom.number);
            if self.alternate.last() != Some(&name) {
                self.alternate.push(name);
            }
        } else {
            self.atoms.push(atom);
        }
    }

    fn molecule(self, bonds: &[[&str; 2]], has_models: bool) -> Molecule<'a> {
        let serials = self
            .atoms
            .iter()
            .enumerate()
            .map(|(k, atom)| (atom.serial, k));
        let serials: HashMap<&str, usize> = serials.collect();
        let both = |ends: &[&str; 2]| Some([*serials.get(ends[0])?, *serials.get(ends[1])?]);
        let pairs = bonds.iter().filter_map(both).filter(|[a, b]| a != b);
        let own = each_once(pairs.map(|[a, b]| [a.min(b), a.max(b)]));
        let bonded: HashSet<usize> = own.iter().flatten().copied().collect();
        let mut notes = Vec::new();
        if has_models {
            notes.push("from the first model".to_owned());
        }
        if self.water > 0 {
            notes.push(format!("without its water ({})", self.water));
        }
        if !self.alternate.is_empty() {
            notes.push(format!(
                "without the other locations of {}",
                self.alternate.join(", ")
            ));
        }
        if self.atoms.iter().any(|atom| !atom.has_element) {
            notes.push("with elements told by the names of atoms".to_owned());
        }
        Molecule {
            name: if self.name.is_empty() {
                "molecule"
            } else {
                self.name
            }
            .to_owned(),
            bonds: (bonded.len() == self.atoms.len()).then_some(own),
            atoms: self
                .atoms
                .iter()
                .map(|atom| (atom.element, atom.coordinates, atom.line))
                .collect(),
            notes,
            ..Molecule::default()
        }
    }
}

/// Whether the columns have this place.
pub fn is_at(line: &str, place: &[f64; 3]) -> bool {
    let has = |axis: usize| {
        line.get(30 + 8 * axis..38 + 8 * axis)
            .and_then(|text| super::number(text.trim()))
    };
    (0..3).all(|axis| has(axis) == Some(place[axis]))
}

/// A line with another place in the columns of an atom's coordinates, or nothing where it has no room for them.
pub fn with_place(line: &str, place: &[f64; 3]) -> Option<String> {
    let ends = [line.get(..30).unwrap_or(line), line.get(54..).unwrap_or("")];
    super::columns(place, 8, 3).map(|new| ends.join(&new))
}

#[cfg(test)]
mod tests {
    use super::super::tests::written;
    use super::super::{Figure, read};
    use super::*;
    use crate::import::{Format, Imported, list};

    fn peptide() -> String {
        let mut text = "HEADER    A TEST\nMODEL        1\n".to_owned();
        let atoms = [
            ("ATOM  ", " N  ", " ", "GLY", "A", [-0.966, 0.493, 1.500]),
            ("ATOM  ", " CA ", "A", "GLY", "A", [0.257, 0.418, 0.692]),
            ("ATOM  ", " CA ", "B", "GLY", "A", [0.357, 0.518, 0.792]),
            ("ATOM  ", " C  ", " ", "GLY", "A", [-0.094, 0.017, -0.716]),
            ("ATOM  ", " O  ", " ", "GLY", "A", [-1.056, -0.682, -0.923]),
            ("ATOM  ", " N  ", " ", "GLY", "B", [5.0, 0.0, 0.0]),
            ("HETATM", " O  ", " ", "HOH", "A", [9.0, 9.0, 9.0]),
            ("HETATM", "CL  ", " ", " CL", "B", [5.0, 1.7, 0.0]),
        ];
        for (k, (record, name, place, residue, chain, [x, y, z])) in atoms.iter().enumerate() {
            text += &format!(
                "{record}{:5} {name}{place}{residue:>3} {chain}   1    {x:8.3}{y:8.3}{z:8.3}  1.00  0.00\n",
                k + 1
            );
        }
        text + "ENDMDL\nMODEL        2\nATOM      1  N   GLY A   1       0.000   0.000   0.000\nENDMDL\n"
    }

    fn chain(text: &str, index: usize) -> Result<Imported, String> {
        read(text.as_bytes(), (Format::Pdb, index), false)
    }

    fn names(of: &Imported) -> Vec<&str> {
        let points = of.problem.points.iter();
        points.map(|point| point.name.as_str()).collect()
    }

    #[test]
    fn chains_of_the_first_model_are_read() {
        let text = peptide();
        let listed = list("peptide.pdb", text.as_bytes()).unwrap();
        let chains: Vec<(&str, usize)> = listed
            .iter()
            .map(|one| (one.name.as_str(), one.drawn))
            .collect();
        assert_eq!(chains, [("A", 4), ("B", 2)]);
        let found = chain(&text, 0).unwrap();
        assert_eq!(names(&found), ["N1", "C2", "C3", "O4"]);
        let source = &found.problem.source;
        assert_eq!(
            found.notes,
            [
                "from the first model",
                "without its water (1)",
                "without the other locations of GLY 1",
                "with elements told by the names of atoms"
            ]
        );
        assert!(found.notes.iter().all(|note| source.contains(note)));
        let few = chain(&text, 1).unwrap_err();
        assert!(few.contains("B has 2 atoms"), "{few}");
    }

    #[test]
    fn elements_are_told_by_names_where_there_is_no_column() {
        for (columns, of_others, of_a_protein) in [
            ("CL  ", "CL", "C"),
            (" CA ", "C", "C"),
            ("CA  ", "CA", "C"),
            ("HE21", "H", "H"),
            ("HG  ", "H", "H"),
            ("1HB ", "H", "H"),
            (" N  ", "N", "N"),
        ] {
            assert_eq!(element(columns, true), of_a_protein, "{columns}");
            assert_eq!(element(columns, false), of_others, "{columns}");
        }
        // The identifier and the line of an old file.
        let line =
            "ATOM      1  N   THR A   1      17.047  14.099   3.625  1.00 13.79      1CRN  70";
        assert_eq!(Atom::read(line, 0).unwrap().element, "N");
    }

    /// Two residues in one place, as in crambin.
    #[test]
    fn one_location_of_a_residue_is_read() {
        let mut text = String::new();
        for (k, (name, place, residue, x)) in [
            (" N  ", " ", "PRO", 0.0),
            (" CA ", "A", "PRO", 1.5),
            (" CA ", "B", "SER", 1.6),
            (" OG ", "B", "SER", 2.9),
            (" CB ", "A", "PRO", 3.0),
            (" C  ", " ", "PRO", 1.5),
        ]
        .into_iter()
        .enumerate()
        {
            let y = if k == 5 { 1.5 } else { 0.1 * k as f64 };
            text += &format!(
                "ATOM  {k:5} {name}{place}{residue} A  22    {x:8.3}{y:8.3}{:8.3}\n",
                0.3 * k as f64
            );
        }
        let found = chain(&text, 0).unwrap();
        assert_eq!(names(&found), ["N1", "C2", "C3", "C4"]);
        assert!(found.notes[0].contains("SER 22"));
    }

    #[test]
    fn coordinates_are_written_in_their_columns() {
        let text = peptide();
        let found = chain(&text, 0).unwrap();
        let mut points = found.problem.places();
        let rewritten =
            |points: &[[f64; 3]]| written(&found, text.as_bytes(), &Figure { points, radii: &[] });
        let same = rewritten(&points).unwrap();
        assert_eq!(String::from_utf8(same).unwrap(), text);
        points[3] = [-12.5, 0.0001, 7.25];
        let out = String::from_utf8(rewritten(&points).unwrap()).unwrap();
        assert!(
            out.contains(" O   GLY A   1     -12.500   0.000   7.250  1.00"),
            "{out}"
        );
        points[3][0] = 1e7;
        assert!(rewritten(&points).is_err());
    }

    #[test]
    fn bonds_are_those_of_the_file_where_it_has_all() {
        // N-CA, CA-C, C-O as radii tell them; and N-O, which they do not.
        let records = |ends: &[&str]| -> String {
            ends.iter()
                .map(|ends| format!("CONECT    {ends}\n"))
                .collect()
        };
        let first = |text: &str| {
            let molecules = super::super::molecules(text, Format::Pdb).unwrap();
            molecules.into_iter().next().unwrap().bonds
        };
        let all = ["1    2    5", "2    1    4", "4    2    5", "5    4"];
        let wanted = vec![[0, 1], [0, 3], [1, 2], [2, 3]];
        assert_eq!(first(&(peptide() + &records(&all))), Some(wanted));
        // Not of all atoms.
        assert_eq!(first(&(peptide() + &records(&all[1..2]))), None);
        // Numbers that stand twice.
        let twice = peptide().replace("ATOM      6", "ATOM      5");
        assert_eq!(first(&(twice + &records(&all))), None);
        let cut = peptide().replace("   0.418", "        ");
        assert!(
            chain(&cut, 0)
                .unwrap_err()
                .contains("line 4: an atom's name or coordinates")
        );
    }
}
