//! `krawl tolerance` as people and programs use it: pages, pictures and tables.

use crate::krawl;
use serde_json::Value;
use std::fs;

#[test]
fn bands_are_drawn_and_measures_are_tabled() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (json, csv, page, picture) = (at("t.json"), at("t.csv"), at("t.html"), at("t.svg"));
    let (code, _, error) = krawl(&[
        "tolerance",
        "docs/examples/plate.toml",
        "--default",
        "0.1",
        "--measure",
        "C-E",
        "--measure",
        "angle B C D",
        "--json",
        &json,
        "--csv",
        &csv,
        "--html",
        &page,
        "--svg",
        &picture,
    ]);
    assert_eq!(code, Some(0), "{error}");
    let result: Value = serde_json::from_str(&fs::read_to_string(&json).unwrap()).unwrap();
    let rows = fs::read_to_string(&csv).unwrap();
    let rows: Vec<Vec<&str>> = rows.lines().map(|row| row.split(',').collect()).collect();
    assert_eq!(rows[0][..3], ["measure", "unit", "nominal"]);
    assert_eq!(
        rows[0][6..],
        ["A-B", "B-C", "C-D", "D-E", "E-A", "A-C", "B-E"]
    );
    assert_eq!(rows.len(), 3);
    for (row, measured) in rows[1..].iter().zip(result["measured"].as_array().unwrap()) {
        assert_eq!(row[0].trim_matches('"'), measured["name"]);
        let numbers: Vec<f64> = row[2..].iter().map(|x| x.parse().unwrap()).collect();
        assert_eq!(Some(numbers[1]), measured["least"][0].as_f64());
        assert_eq!(Some(numbers[2]), measured["greatest"][1].as_f64());
        assert!(numbers[1] < numbers[0] && numbers[0] < numbers[2]);
        for (effect, of_json) in numbers[4..]
            .iter()
            .zip(measured["effects"].as_array().unwrap())
        {
            assert!((effect - of_json.as_f64().unwrap()).abs() < 1e-5);
        }
    }
    // A is where the coordinates begin; the four other points have bands, each drawn about its point, and D's is the tallest.
    let picture = fs::read_to_string(&picture).unwrap();
    let bands: Vec<Vec<f64>> = picture
        .lines()
        .filter(|line| line.contains("fill-opacity=\"0.08\""))
        .map(|line| {
            let path = line.split('"').nth(1).unwrap();
            let numbers = path.split(|c: char| !c.is_ascii_digit() && c != '.');
            numbers.filter_map(|x| x.parse().ok()).collect()
        })
        .collect();
    assert_eq!(bands.len(), 4, "{picture}");
    let height = |band: &[f64]| (band[1] - band[5]).abs();
    let tallest = bands.iter().max_by(|a, b| height(a).total_cmp(&height(b)));
    assert_eq!(tallest, Some(&bands[2]));
    let html = fs::read_to_string(&page).unwrap();
    let (code, shown, _) = krawl(&["show", &json, "--html", "-"]);
    assert_eq!((code, &shown), (Some(0), &html));
    for words in ["times as wide", "at worst from", "B-E 27 %"] {
        assert!(html.contains(words), "{words}");
    }
}

/// In space the band of a point is a box.
#[test]
fn bands_in_space_are_boxes() {
    let (code, text, _) = krawl(&[
        "tolerance",
        "docs/examples/platform.toml",
        "--default",
        "0.1",
        "--svg",
        "-",
        "--quiet",
    ]);
    assert_eq!(code, Some(0));
    let sides = text.matches("fill-opacity=\"0.08\"").count();
    assert!(sides > 0 && sides.is_multiple_of(6), "{sides}");
}

/// What a file wants measured is measured by every verb, by the file's names; numbers of objects where the verb measures them.
#[test]
fn measures_of_a_file_have_names() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (file, json, csv) = (at("m.toml"), at("m.json"), at("m.csv"));
    let plate = fs::read_to_string("docs/examples/bracket.toml").unwrap();
    let measures =
        "[measures]\n\"to the hole\" = \"B-H\"\nouter = \"area A B C D\"\nbore = \"radius hole\"\n";
    fs::write(&file, format!("{plate}{measures}")).unwrap();
    let (code, text, error) = krawl(&[
        "edit",
        &file,
        "--set",
        "width=60",
        "--measure",
        "slope = angle B A H",
        "--json",
        &json,
    ]);
    assert_eq!(code, Some(0), "{error}");
    let result: Value = serde_json::from_str(&fs::read_to_string(&json).unwrap()).unwrap();
    let written = result["measures"].to_string();
    for (name, value) in [
        ("to the hole", (30.0f64 * 30.0 + 625.0).sqrt()),
        ("outer", 3000.0),
        ("bore", 4.5),
        ("slope", (25.0f64 / 30.0).atan().to_degrees()),
    ] {
        assert!(
            text.contains(name) && written.contains(&format!("\"{name}\"")),
            "{text}{written}"
        );
        let digits = format!("{value:.6}");
        assert!(text.contains(&digits[..3]), "{name} {value}: {text}");
    }
    let (code, _, error) = krawl(&[
        "tolerance",
        &file,
        "--tolerance",
        "dx:D-C=0",
        "--csv",
        &csv,
        "--quiet",
    ]);
    assert_eq!(code, Some(0), "{error}");
    let rows = fs::read_to_string(&csv).unwrap();
    let names: Vec<&str> = rows
        .lines()
        .skip(1)
        .map(|row| row.split(',').next().unwrap())
        .collect();
    assert_eq!(names, ["\"to the hole\"", "outer", "bore"]);
    // What is none is said with its name.
    fs::write(&file, format!("{plate}[measures]\ngap = \"A-Z\"\n")).unwrap();
    let (code, _, error) = krawl(&["edit", &file, "--set", "width=60"]);
    assert!(code == Some(2) && error.contains("A-Z"), "{error}");
    fs::write(&file, format!("{plate}[measures]\ngap = 5\n")).unwrap();
    let (code, _, error) = krawl(&["check", &file]);
    assert!(code == Some(2) && error.contains("measures.gap"), "{error}");
}

/// Limits are not taken of all lengths: which of them a default leaves exact is said.
#[test]
fn what_a_default_leaves_exact_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("t.toml");
    let text = "name = \"t\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [2, 3]\n[lines]\nl = [\"a\", \"b\"]\n[constraints]\n\
                distances = [[\"a\", \"b\", 4], [\"a\", \"c\", 3.6], [\"c\", \"l\", 3]]\n";
    fs::write(&file, text).unwrap();
    let (code, text, error) = krawl(&["tolerance", file.to_str().unwrap(), "--default", "0.01"]);
    assert_eq!(code, Some(0), "{text}{error}");
    let words =
        "exact, as the default is for distances between points and radii alone: distances:c-l";
    assert!(error.contains(words), "{text}{error}");
}

/// Limits with a number count before a default; two for one dimension are refused.
#[test]
fn limits_stand_with_a_number() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("t.toml");
    let file = file.to_str().unwrap();
    let text = "name = \"t\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [0, 3]\n[constraints]\n\
                distances = [[\"a\", \"b\", [3.9, 4.1]], [\"a\", \"c\", 3]]\nangles = [[\"b\", \"a\", \"c\", \"90 +0 -1\"]]\n\
                [tolerances]\ndefault = 0.01\n";
    fs::write(file, text).unwrap();
    let (code, shown, error) = krawl(&["tolerance", file, "--measure", "b-c"]);
    assert_eq!(code, Some(0), "{error}");
    for part in [
        "a-b           from 3.9 to 4.1",
        "a-c           from 2.99 to 3.01",
        "angles:b-a-c  from 89 to 90",
    ] {
        assert!(shown.contains(part), "{shown}");
    }
    let (code, shown, _) = krawl(&[
        "tolerance",
        file,
        "--tolerance",
        "a-b=0.2",
        "--measure",
        "b-c",
    ]);
    assert!(
        code == Some(0) && shown.contains("from 3.8 to 4.2"),
        "{shown}"
    );
    fs::write(file, format!("{text}\"b-a\" = 0.1\n")).unwrap();
    let (code, _, error) = krawl(&["tolerance", file]);
    assert!(
        code == Some(2) && error.contains("b-a has a tolerance with its number"),
        "{error}"
    );
}
