//! Molecules: their chirality, and their figures as a chemist wants to see them.

use super::krawl;
use serde_json::Value;

/// Bromochlorofluoromethane, or its mirror image.
fn methane(side: f64) -> String {
    let atoms = [
        ("C", [0.0, 0.0, 0.0]),
        ("H", [0.0, 0.0, 1.09]),
        ("F", [1.2728, 0.0, -0.45]),
        ("Cl", [-0.8300, 1.4376, -0.5869]),
        ("Br", [-0.9145, -1.5840, -0.6467]),
    ];
    let mut text = "5\nmethane\n".to_owned();
    for (symbol, [x, y, z]) in atoms {
        text += &format!("{symbol} {x:.4} {:.4} {z:.4}\n", side * y);
    }
    text
}

/// Butane's four carbons and the oxygen of an alcohol's, without hydrogens: R or S at the second carbon.
const BUTANOL: &str = "5\nbutanol\nC 1.98 0.62 0.14\nC 0.60 0.03 0.35\nC -0.50 0.93 -0.20\nC -1.87 0.26 -0.05\n\
                       O 0.55 -1.25 -0.28\n";

fn all(text: &str, more: &[&str]) -> (Value, String) {
    all_of("m.xyz", text, more)
}

fn all_of(name: &str, text: &str, more: &[&str]) -> (Value, String) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name).to_string_lossy().into_owned();
    let json = folder.path().join("m.json").to_string_lossy().into_owned();
    std::fs::write(&file, text).unwrap();
    let arguments = [&["all", &file, "--json", &json], more].concat();
    let (code, table, error) = krawl(&arguments);
    assert_eq!(code, Some(0), "{table}{error}");
    let value = serde_json::from_str(&std::fs::read_to_string(&json).unwrap()).unwrap();
    (value, table)
}

/// The sign of det(b − a, c − a, d − a) of the carbon, the hydrogen, the fluorine and the chlorine of the first solution.
fn side(of: &Value) -> f64 {
    let at = |name: &str| -> Vec<f64> {
        let boxes = of["solutions"][0]["points"][name].as_array().unwrap();
        boxes.iter().map(|b| b[0].as_f64().unwrap()).collect()
    };
    let [u, v, w] = ["H2", "F3", "Cl4"].map(|name| {
        let (p, q) = (at(name), at("C1"));
        [0, 1, 2].map(|axis| p[axis] - q[axis])
    });
    let determinant = u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
        + u[2] * (v[0] * w[1] - v[1] * w[0]);
    assert!(determinant.abs() > 0.5, "{determinant}");
    determinant.signum()
}

#[test]
fn a_molecule_keeps_its_side() {
    for hand in [1.0, -1.0] {
        let (value, table) = all(&methane(hand), &[]);
        assert_eq!(value["solutions"].as_array().unwrap().len(), 1, "{table}");
        assert_eq!(side(&value), hand, "{table}");
        let one = &value["conformers"][0];
        assert!(one["rmsd"].as_f64().unwrap() < 1e-5, "{one}");
        assert_eq!(one["mirrored"], false);
        let head = table.lines().next().unwrap();
        assert!(!head.contains("reflections"), "{table}");
        // Without its side it is listed once for both.
        let (value, table) = all(&methane(hand), &["--any-signs"]);
        assert_eq!(value["solutions"].as_array().unwrap().len(), 1, "{table}");
        assert!(table.lines().next().unwrap().contains("reflections"));
        assert!(value["conformers"][0]["rmsd"].as_f64().unwrap() < 1e-5);
    }
    // Two hydrogens are the same.
    let (_, table) = all(&methane(1.0).replace("Br", "H"), &[]);
    assert!(table.lines().next().unwrap().contains("reflections"));
}

/// A chain held as it is drawn, by bonds, bond angles and one torsion: of the four figures up to motions those with the side of the file
/// are kept, and one of them is the file's.
#[test]
fn a_hydrogen_that_is_not_in_the_file_counts() {
    let (value, table) = all(BUTANOL, &[]);
    let figures = value["conformers"].as_array().unwrap();
    assert_eq!(figures.len(), 2, "{table}");
    let (other, _) = all(BUTANOL, &["--any-signs"]);
    assert_eq!(other["conformers"].as_array().unwrap().len(), 2);
    let rmsd = |one: &Value| one["rmsd"].as_f64().unwrap();
    let nearest = figures.iter().min_by(|a, b| rmsd(a).total_cmp(&rmsd(b)));
    let nearest = nearest.unwrap();
    assert!(rmsd(nearest) < 1e-5, "{table}");
    let torsions = nearest["torsions"].as_array().unwrap();
    let [one] = &torsions[..] else {
        panic!("{table}")
    };
    assert_eq!(one["atoms"], serde_json::json!(["C1", "C2", "C3", "C4"]));
    // Computed from the file with a calculator: atan2(|q| p·(q × r), (p × q)·(q × r)).
    let degrees = one["degrees"].as_f64().unwrap();
    assert!((degrees - TORSION).abs() < 0.01, "{degrees}");
    assert!(
        table.contains("Conformers, the nearest to the file first"),
        "{table}"
    );
}

/// About what is straight nothing turns.
#[test]
fn a_straight_part_has_no_torsion() {
    let (value, _) = all(
        "5\nalkyne\nO 1.9 1.2 0.3\nC 1.46 0 0\nC 0 0 0\nC -1.2 0 0\nC -2.66 0 0\n",
        &[],
    );
    for one in value["conformers"].as_array().unwrap() {
        assert_eq!(one["torsions"], serde_json::json!([]));
    }
}

const TORSION: f64 = 176.3743;

/// Without its hydrogens a molecule keeps the numbers of its atoms and its side; files that are written have them, as they stand to the
/// others.
#[test]
fn hydrogens_are_left_out_and_put_back() {
    let text = "6\nbromochlorofluoromethanol\nC 0 0 0\nH -0.6 -0.62 -0.66\nF 0.8 0.75 -0.79\nCl -1.02 1.0 1.03\nO 0.9 -0.8 0.83\nH 1.7 -0.5 1.1\n";
    let directory = tempfile::tempdir().unwrap();
    let [file, out] = ["a.xyz", "b.xyz"].map(|name| directory.path().join(name));
    std::fs::write(&file, text).unwrap();
    let run = |arguments: &[&str]| -> String {
        let file = file.to_str().unwrap();
        let (code, said, error) = krawl(&[&[arguments[0], file], &arguments[1..]].concat());
        assert_eq!(code, Some(0), "{said}{error}");
        said + &error
    };
    let written = ["--out", out.to_str().unwrap()];
    let places = |text: &str| -> Vec<[f64; 3]> {
        let line = |line: &str| {
            let mut numbers = line.split_whitespace().skip(1).map(|x| x.parse().unwrap());
            [0, 1, 2].map(|_| numbers.next().unwrap())
        };
        text.lines().skip(2).map(line).collect()
    };
    let apart = |p: &[[f64; 3]], a: usize, b: usize| -> f64 {
        let square = |k: usize| (p[a][k] - p[b][k]).powi(2);
        (0..3).map(square).sum::<f64>().sqrt()
    };
    let volume = |p: &[[f64; 3]], [a, b, c]: [usize; 3]| -> f64 {
        let [u, v, w] = [a, b, c].map(|q| [0, 1, 2].map(|k| p[q][k] - p[0][k]));
        u[0] * (v[1] * w[2] - v[2] * w[1])
            + u[1] * (v[2] * w[0] - v[0] * w[2])
            + u[2] * (v[0] * w[1] - v[1] * w[0])
    };
    let before = places(text);
    // Every hydrogen is as far from the others as it was, on the same side.
    let said = run(&["all", "--heavy", written[0], written[1]]);
    assert!(
        said.contains("was read without its hydrogens (2)"),
        "{said}"
    );
    assert!(
        said.contains("Complete, proved: 1 solution") && !said.contains("H2"),
        "{said}"
    );
    let back = places(&std::fs::read_to_string(&out).unwrap());
    for (a, b) in [(0, 1), (1, 2), (1, 3), (1, 4), (5, 4), (5, 0), (5, 3)] {
        let (old, new) = (apart(&before, a, b), apart(&back, a, b));
        assert!((old - new).abs() < 1e-5, "{a} {b}: {old} {new}");
    }
    for three in [[1, 2, 3], [2, 3, 4], [5, 3, 4]] {
        let (old, new) = (volume(&before, three), volume(&back, three));
        assert!((old - new).abs() < 1e-4, "{three:?}: {old} {new}");
    }
    // A longer bond: each stays as far from the atom that it is bonded to.
    run(&[
        "edit",
        "--heavy",
        "--set",
        "C1-O5=1.7",
        written[0],
        written[1],
    ]);
    let longer = places(&std::fs::read_to_string(&out).unwrap());
    assert!((apart(&longer, 0, 4) - 1.7).abs() < 1e-6);
    for (a, b) in [(0, 1), (4, 5)] {
        let (old, new) = (apart(&before, a, b), apart(&longer, a, b));
        assert!((old - new).abs() < 1e-6, "{a} {b}: {old} {new}");
    }
    let (code, _, error) = krawl(&["all", "problems/k33.toml", "--heavy"]);
    assert!(
        code == Some(2) && error.contains("--heavy is for molecules"),
        "{error}"
    );
}

/// Molecules with the letters of their stereocentres on the third line. Their names are those of the literature.
const NAMED: &str = include_str!("../data/stereocentres.sdf");

/// The molecules of that file: the name, the lines, and the letters that are known.
fn named() -> Vec<(String, Vec<String>, Vec<(usize, char)>)> {
    let known = |text: &str| -> (usize, char) {
        let (atom, letter) = text.split_once(' ').unwrap();
        let number = atom.trim_start_matches(char::is_alphabetic);
        (
            number.parse::<usize>().unwrap() - 1,
            letter.parse().unwrap(),
        )
    };
    let all = NAMED.split("$$$$\n").filter(|text| !text.is_empty());
    let read = all.map(|text| {
        let lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let letters = lines[2].split(", ").map(known).collect();
        (lines[0].clone(), lines, letters)
    });
    read.collect()
}

/// The letters that krawl has for a molecule as it is drawn, or why it has none.
fn letters(lines: &[String]) -> Vec<(usize, Result<char, &'static str>)> {
    let text = lines.join("\n");
    let read = krawl::import::read("m.mol", text.as_bytes(), None).unwrap();
    read.skeleton.unwrap().letters()
}

fn known(letters: &[(usize, char)]) -> Vec<(usize, Result<char, &'static str>)> {
    letters
        .iter()
        .map(|&(atom, letter)| (atom, Ok(letter)))
        .collect()
}

/// How many atoms and bonds there are.
fn counts(lines: &[String]) -> [usize; 2] {
    [0, 3].map(|from| lines[3][from..from + 3].trim().parse().unwrap())
}

/// The molecule with numbers for its atoms that `new` gives for the old ones, from 0 on.
fn renumbered(lines: &[String], new: impl Fn(usize) -> usize) -> Vec<String> {
    let [atoms, bonds] = counts(lines);
    let mut out = lines.to_vec();
    for a in 0..atoms {
        out[4 + new(a)].clone_from(&lines[4 + a]);
    }
    let number = |text: &str| new(text.trim().parse::<usize>().unwrap() - 1) + 1;
    for line in &mut out[4 + atoms..4 + atoms + bonds] {
        let [a, b] = [&line[..3], &line[3..6]].map(number);
        *line = format!("{a:3}{b:3}{}", &line[6..]);
    }
    for line in out.iter_mut().filter(|line| line.starts_with("M  ISO")) {
        *line = format!("{}{:4}{}", &line[..9], number(&line[9..13]), &line[13..]);
    }
    out
}

#[test]
fn stereocentres_have_the_letters_that_are_known() {
    let all = named();
    assert_eq!(all.len(), 15);
    for (name, lines, wanted) in &all {
        assert_eq!(letters(lines), known(wanted), "{name}");
        let [atoms, _] = counts(lines);
        let mut mirrored = lines.clone();
        for line in &mut mirrored[4..4 + atoms] {
            let z: f64 = line[20..30].trim().parse().unwrap();
            line.replace_range(20..30, &format!("{:10.4}", -z));
        }
        let other = |&(atom, letter): &(usize, char)| (atom, if letter == 'R' { 'S' } else { 'R' });
        let others: Vec<(usize, char)> = wanted.iter().map(other).collect();
        assert_eq!(letters(&mirrored), known(&others), "{name}, mirrored");
        // Numbers of atoms play no part: all turned round by some, and backwards.
        for shift in [1, 3, atoms / 2] {
            let new = |a: usize| atoms - 1 - (a + shift) % atoms;
            let mut moved: Vec<(usize, char)> = wanted.iter().map(|&(a, l)| (new(a), l)).collect();
            moved.sort_unstable();
            assert_eq!(
                letters(&renumbered(lines, new)),
                known(&moved),
                "{name}, {shift}"
            );
        }
    }
}

/// What a letter rests on is in the file: aromatic bonds of a benzene ring leave nothing open, those of a pyridine ring do; and without
/// bond orders there is no letter, which is said.
#[test]
fn no_letter_is_a_guess() {
    let all = named();
    let of = |name: &str| all.iter().find(|(own, ..)| own == name).unwrap();
    let (_, sulfoxide, wanted) = of("(R)-methyl phenyl sulfoxide");
    let with_orders = |lines: &[String], ring: &[[usize; 2]], order: usize| -> Vec<String> {
        let [atoms, bonds] = counts(lines);
        let mut out = lines.to_vec();
        for line in &mut out[4 + atoms..4 + atoms + bonds] {
            let ends = [&line[..3], &line[3..6]].map(|text| text.trim().parse().unwrap());
            if ring.is_empty() || ring.contains(&ends) {
                *line = format!("{:3}{:3}{order:3}  0", ends[0], ends[1]);
            }
        }
        out
    };
    let ring = [[4, 5], [5, 6], [6, 7], [7, 8], [8, 9], [9, 4]];
    let aromatic = with_orders(sulfoxide, &ring, 4);
    assert_ne!(&aromatic, sulfoxide);
    assert_eq!(letters(&aromatic), known(wanted));
    // Which the bonds are is not said: alanine's neighbours differ by their own and the next elements alone.
    let (_, alanine, wanted) = of("L-alanine");
    let unknown = letters(&with_orders(alanine, &[], 8));
    let [(1, Err(why))] = unknown[..] else {
        panic!("{unknown:?}")
    };
    assert!(why.contains("double bonds the file leaves open"), "{why}");
    // A charge at the end of what decides is none of its business.
    let mut charged = alanine.clone();
    let end = charged.iter().position(|line| line == "M  END").unwrap();
    charged.insert(end, "M  CHG  2   5  -1   6   1".to_owned());
    assert_eq!(letters(&charged), known(wanted));
    charged[end] = "M  CHG  1  99   1".to_owned();
    let read = krawl::import::read("m.mol", charged.join("\n").as_bytes(), None);
    let error = read.unwrap_err().to_string();
    assert!(error.contains(&format!("line {}", end + 1)), "{error}");
    // Without bonds in the file.
    let (value, table) = all_of("m.xyz", &methane(1.0), &[]);
    let one = &value["conformers"][0]["stereocentres"][0];
    assert_eq!(one["atom"], "C1");
    assert!(one["letter"].is_null(), "{one}");
    let why = "Neither R nor S is said of C1, as the file has no bond orders.";
    assert!(table.contains(why), "{table}");
}

/// Of each figure the letter is its own, whatever the file's is.
#[test]
fn figures_have_letters() {
    let all = named();
    let of = |name: &str| all.iter().find(|(own, ..)| own == name).unwrap();
    let (_, lines, _) = of("(R)-bromochlorofluoromethane");
    let text = lines.join("\n");
    let letter = |value: &Value, k: usize| value["conformers"][k]["stereocentres"][0].clone();
    let r = serde_json::json!({"atom": "C1", "letter": "R"});
    let (value, table) = all_of("m.mol", &text, &[]);
    assert_eq!(letter(&value, 0), r);
    assert!(
        table.contains("R, S") && table.contains("  C1 R"),
        "{table}"
    );
    // Each stands for its mirror image, and is shown as the one that is nearer to the file.
    let (value, _) = all_of("m.mol", &text, &["--any-signs"]);
    assert_eq!(letter(&value, 0), r);
    let (_, lines, _) = of("D-glyceraldehyde without hydrogens");
    let (value, table) = all_of("m.mol", &lines.join("\n"), &[]);
    let figures = value["conformers"].as_array().unwrap();
    assert!(!figures.is_empty());
    for k in 0..figures.len() {
        assert_eq!(
            letter(&value, k),
            serde_json::json!({"atom": "C2", "letter": "R"}),
            "{table}"
        );
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("m.mol").to_string_lossy().into_owned();
    std::fs::write(&file, lines.join("\n")).unwrap();
    let (code, text, _) = krawl(&["check", &file]);
    assert_eq!(code, Some(0), "{text}");
    assert!(
        text.contains("stereocentre        C2, R in the file"),
        "{text}"
    );
}
