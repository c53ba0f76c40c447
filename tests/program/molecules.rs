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
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("m.xyz").to_string_lossy().into_owned();
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
