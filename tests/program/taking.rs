//! `--out` of `solve` and `all`: a figure in the file that it is of. The file taken is read again by another verb.

use crate::krawl;
use krawl::problem::Problem;
use std::path::Path;

fn sketch(file: &Path) -> Vec<[f64; 3]> {
    let problem = Problem::parse_loosely(&std::fs::read_to_string(file).unwrap(), "taken").unwrap();
    let points = problem.points.iter();
    points
        .map(|p| p.sketch.each_ref().map(|x| x.to_f64()))
        .collect()
}

/// How far distances in a file are from what they are to be, at most.
fn off(file: &Path) -> f64 {
    let problem = Problem::read(file).unwrap();
    let at = sketch(file);
    let off = problem.distances.iter().map(|d| {
        let [a, b] = d.points.map(|p| at[p]);
        let square: f64 = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum();
        let wanted = d.target.squared().to_f64();
        (square.sqrt() - wanted.sqrt()).abs()
    });
    off.fold(0.0, f64::max)
}

#[test]
fn the_figure_that_was_picked_meets_the_dimensions() {
    let folder = tempfile::tempdir().unwrap();
    let mut all: Vec<Vec<[f64; 3]>> = Vec::new();
    for verb in ["solve", "all"] {
        for k in ["1", "2", "3", "4"] {
            let out = folder.path().join(format!("{verb}{k}.toml"));
            let name = out.to_str().unwrap();
            let (code, _, error) =
                krawl(&[verb, "problems/octahedron.toml", "--pick", k, "--out", name]);
            assert_eq!((code, error.as_str()), (Some(0), ""));
            assert!(off(&out) < 1e-12, "{verb} {k}");
            // Nothing moves any more.
            let (_, text, _) = krawl(&["solve", name, "--first"]);
            assert!(text.contains("without a fold"), "{text}");
            all.push(sketch(&out));
        }
    }
    for (i, one) in all.iter().enumerate().take(4) {
        assert!(
            all[..i].iter().all(|other| other != one),
            "{i} is there twice"
        );
    }
}

#[test]
fn one_has_to_be_said_where_there_are_several() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("taken.toml");
    let out = out.to_str().unwrap();
    let file = "problems/octahedron.toml";
    let (code, table, error) = krawl(&["solve", file, "--out", out]);
    assert_eq!(code, Some(2));
    assert!(
        table.contains("Solution 4"),
        "what was found is there: {table}"
    );
    assert!(
        error.contains("there are several solutions: add `--pick K`"),
        "{error}"
    );
    let (code, _, error) = krawl(&["all", file, "--pick", "9", "--out", out]);
    assert_eq!(code, Some(2));
    assert!(error.contains("there is no solution 9"), "{error}");
    assert!(!Path::new(out).exists());
    let (code, _, error) = krawl(&["all", file, "--nearest", "--out", "taken.FCStd"]);
    assert_eq!(code, Some(2));
    assert!(error.contains("give it the ending .toml"), "{error}");
    let (code, _, _) = krawl(&["solve", file, "--first", "--out", out]);
    assert_eq!(code, Some(0));
}

#[test]
fn sketches_of_other_programs_keep_all_else() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("taken.slvs");
    let name = out.to_str().unwrap();
    let file = "problems/sketches/bracket.slvs";
    let (code, _, error) = krawl(&["solve", file, "--first", "--out", name]);
    assert_eq!((code, error.as_str()), (Some(0), ""));
    // It meets its dimensions as it is drawn, so that the figure nearest to it is itself.
    let lines = |file: &str| -> Vec<String> {
        let bytes = std::fs::read(file).unwrap();
        String::from_utf8_lossy(&bytes)
            .lines()
            .map(str::to_owned)
            .collect()
    };
    let (before, after) = (lines(file), lines(name));
    assert_eq!(before.len(), after.len());
    for (was, is) in before.iter().zip(&after).filter(|(was, is)| was != is) {
        let numbers =
            [was, is].map(|line| line.rsplit('=').next().unwrap().parse::<f64>().unwrap());
        assert!((numbers[0] - numbers[1]).abs() < 1e-9, "{was} is {is}");
    }
    let (code, text, _) = krawl(&["solve", name, "--first"]);
    assert_eq!(code, Some(0), "{text}");
}

#[test]
fn mirror_images_are_taken_as_they_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("below.toml");
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [3.9, -3.1]\nd = [0.2, -2.8]\n[constraints]\n\
                distances = [[\"a\", \"b\", 4], [\"b\", \"c\", 3], [\"a\", \"c\", 5], [\"c\", \"d\", 4], [\"a\", \"d\", 3]]\n";
    std::fs::write(&file, text).unwrap();
    let out = folder.path().join("taken.toml");
    let (file, name) = (file.to_str().unwrap(), out.to_str().unwrap());
    let (code, _, error) = krawl(&["all", file, "--nearest", "--out", name]);
    assert_eq!((code, error.as_str()), (Some(0), ""));
    let at = sketch(&out);
    // Seen from a and c, the reference, b and d are on the sides where they are drawn, and a rectangle is nearer than a kite.
    let side = |p: usize| at[2][0] * at[p][1] - at[2][1] * at[p][0];
    assert!(side(1) > 0.0 && side(3) < 0.0, "{at:?}");
    assert!(((at[1][0] - at[3][0]).hypot(at[1][1] - at[3][1]) - 5.0).abs() < 1e-9);
    assert!(off(&out) < 1e-12);
}

#[test]
fn a_certificate_of_turns_is_about_the_file_with_angles() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("crank.toml");
    let text = std::fs::read_to_string("problems/mechanisms/crank.toml").unwrap();
    std::fs::write(&file, text.replace("turns =", "angles =")).unwrap();
    let cert = folder.path().join("crank.krawl");
    let (file, cert) = (file.to_str().unwrap(), cert.to_str().unwrap());
    let (code, text, _) = krawl(&["edit", file, "--set", "angles:D-A-B=250", "--cert", cert]);
    assert_eq!(code, Some(0));
    assert!(text.contains("and so as turns:D-A-B"), "{text}");
    let (code, text, _) = krawl(&["verify", cert, file]);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("are `turns` in the certificate"), "{text}");
    let (code, ..) = krawl(&["verify", cert, "problems/mechanisms/four-bar.toml"]);
    assert_ne!(code, Some(0));
    let (code, text, error) = krawl(&[
        "edit",
        file,
        "--set",
        "angles:D-A-B=360",
        "--out",
        "no.toml",
    ]);
    assert_eq!((code, text.as_str()), (Some(2), ""));
    assert!(error.contains("say `turns`"), "{error}");
}

#[test]
fn tables_drive_several_dimensions() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (table, csv, out) = (place("rows.csv"), place("frames.csv"), place("variants"));
    std::fs::write(&table, "B-D, A-D\n4.2, 5.1\n4.6, 5.3\n5, 5\n").unwrap();
    let bar = "problems/mechanisms/four-bar.toml";
    let (code, text, error) = krawl(&[
        "sweep",
        bar,
        "--table",
        &table,
        "--csv",
        &csv,
        "--out-folder",
        &out,
        "--measure",
        "A-P",
    ]);
    assert_eq!((code, error.as_str()), (Some(0), ""));
    assert!(text.contains("3 of 3 rows, each figure proved"), "{text}");
    let frames = std::fs::read_to_string(&csv).unwrap();
    let rows: Vec<Vec<f64>> = frames
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    assert!(frames.starts_with("B-D,A-D,A.x,A.y,"));
    assert!(frames.lines().next().unwrap().ends_with(",A-P"));
    for (k, row) in rows.iter().enumerate() {
        // A, D, B, C, P.
        let point = |p: usize| [row[2 + 2 * p], row[3 + 2 * p]];
        let apart =
            |p: usize, q: usize| (point(p)[0] - point(q)[0]).hypot(point(p)[1] - point(q)[1]);
        assert!((apart(2, 1) - row[0]).abs() < 1e-9 && (apart(0, 1) - row[1]).abs() < 1e-9);
        assert!((apart(0, 4) - row[12]).abs() < 1e-9, "{row:?}");
        let file = Path::new(&out).join(format!("four-bar-{}.toml", k + 1));
        assert!(off(&file) < 1e-9);
    }
    // Beyond its limit: the rows before are there.
    std::fs::write(&table, "B-D\n4.2\n6.5\n5\n").unwrap();
    let (code, text, _) = krawl(&["sweep", bar, "--table", &table, "--csv", &csv]);
    assert_eq!(code, Some(3), "{text}");
    assert!(
        text.contains("1 of 3 rows") && text.contains("Row 2: Limit, proved: B-D can grow to 6.0"),
        "{text}"
    );
    assert_eq!(std::fs::read_to_string(&csv).unwrap().lines().count(), 2);
    // At a dead centre either of two figures goes on, so that none of them is the one continuation.
    let slider = place("slider.toml");
    let text = "dimension = 2\n[points]\nO = [0,0]\nB = [25,0]\nS = [95,0]\n[constraints]\nfixed = [\"O\"]\n\
                y = [[\"S\",0]]\nx = [[\"S\",95]]\ndistances = [[\"O\",\"B\",25],[\"B\",\"S\",70]]\n";
    std::fs::write(&slider, text).unwrap();
    std::fs::write(&table, "x:S\n90\n").unwrap();
    let (code, text, _) = krawl(&["sweep", &slider, "--table", &table]);
    assert!(code != Some(0) && !text.contains("1 of 1 rows"), "{text}");
    for (wrong, why) in [
        ("", "there is no row"),
        ("B-D,B-D\n1,2\n", "two columns"),
        ("B-Q\n1\n", "no dimension"),
        ("B-D\nx\n", "row 1, B-D"),
    ] {
        std::fs::write(&table, wrong).unwrap();
        let (code, _, error) = krawl(&["sweep", bar, "--table", &table]);
        assert_eq!(code, Some(2));
        assert!(error.contains(why), "{wrong}: {error}");
    }
}

/// Molecules go into files of the kind that they were read from; a system of polynomials becomes a problem file.
#[test]
fn what_is_taken_is_of_the_kind_of_its_file() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name).to_string_lossy().into_owned();
    let water = [
        ("O", [0.0, 0.0, 0.117]),
        ("H", [0.757, 0.0, -0.471]),
        ("H", [-0.757, 0.0, -0.47]),
    ];
    let (mut xyz, mut pdb) = ("3\nwater\n".to_owned(), String::new());
    for (k, (element, [x, y, z])) in water.iter().enumerate() {
        xyz += &format!("{element} {x} {y} {z}\n");
        pdb += &format!(
            "HETATM{k:5}  {element}   LIG A   1    {x:8.3}{y:8.3}{z:8.3}  1.00  0.00           {element}  \n"
        );
    }
    let curves = "x, y\n0\nx^2+y^2-4,\nx*y-1\n".to_owned();
    for (ending, text, out) in [
        ("xyz", xyz, "xyz"),
        ("pdb", pdb, "pdb"),
        ("txt", curves, "toml"),
    ] {
        let (file, taken) = (
            path(&format!("read.{ending}")),
            path(&format!("taken.{out}")),
        );
        std::fs::write(&file, text).unwrap();
        let (code, _, error) = krawl(&["all", &file, "--pick", "1", "--out", &taken]);
        assert_eq!(code, Some(0), "{ending}: {error}");
        let (code, table, error) = krawl(&["all", &taken]);
        assert_eq!(code, Some(0), "{ending}: {error}");
        assert!(table.contains("Complete, proved"), "{table}");
        if ending != out {
            let wrong = path("taken.txt");
            let (code, _, error) = krawl(&["all", &file, "--pick", "1", "--out", &wrong]);
            assert_eq!(code, Some(2), "{error}");
            assert!(error.contains("give it the ending .toml"), "{error}");
        }
    }
    // What would leave parts of a molecule out is refused.
    let (code, _, error) = krawl(&["complex", &path("read.xyz")]);
    assert_eq!(code, Some(2), "{error}");
}
