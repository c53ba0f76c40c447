//! `krawl motion` as people and programs use it.

use crate::krawl;
use serde_json::Value;
use std::fs;

const CRANK: &str = "problems/mechanisms/crank.toml";

/// A certificate of a motion is of the figure of the file, of which nothing is held, or of none.
#[test]
fn the_proof_of_a_motion_is_about_the_figure_that_moves() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (file, proof) = (at("parallelogram.toml"), at("motion.krawl"));
    let text = "name = \"parallelogram\"\ndimension = 2\n[points]\nA = [0, 0]\nD = [2.5, 0]\nB = [0.81045345880221, 1.2622064772118448]\n\
                C = [3.31045345880221, 1.2622064772118448]\n[constraints]\ndistances = [[\"A\", \"D\", 2.5], [\"A\", \"B\", 1.5], \
                [\"B\", \"C\", 2.5], [\"C\", \"D\", 1.5]]\n";
    fs::write(&file, text).unwrap();
    let (code, _, error) = krawl(&["motion", &file, "--cert", &proof]);
    assert_eq!(code, Some(5), "{error}");
    let (code, said, error) = krawl(&["verify", &proof, &file]);
    assert_eq!(code, Some(0), "{error}");
    assert!(
        said.contains("hold an arc of these figures") && said.contains("are those in"),
        "{said}"
    );
    assert!(
        !said.contains(" held ") && !said.contains("leaves out"),
        "{said}"
    );
    let (code, said, _) = krawl(&["verify", &proof, CRANK]);
    assert_eq!(code, Some(1));
    assert!(
        said.contains("or of that one drawn or written otherwise"),
        "{said}"
    );
}

#[test]
fn a_crank_turns_all_the_way_round() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (json, csv, page) = (at("m.json"), at("m.csv"), at("m.html"));
    let (code, text, error) = krawl(&[
        "motion",
        CRANK,
        "--free",
        "turns:D-A-B",
        "--measure",
        "angle A D C",
        "--measure",
        "turn D A B",
        "--json",
        &json,
        "--csv",
        &csv,
        "--html",
        &page,
    ]);
    assert_eq!(code, Some(0), "{error}");
    for words in [
        "turns:D-A-B set free",
        "comes back to the first, proved in",
        "a full turn",
        "38.6248",
        "78.5848",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let result: Value = serde_json::from_str(&fs::read_to_string(&json).unwrap()).unwrap();
    assert_eq!(result["status"], "closed");
    assert_eq!(result["measured"][1]["turns"], 1);
    // The figure at the end of the rocker's way reaches into the bound.
    let points = &result["measured"][0]["least"]["points"];
    let middle = |name: &str, axis: usize| {
        let bounds = &points[name][axis];
        0.5 * (bounds[0].as_f64().unwrap() + bounds[1].as_f64().unwrap())
    };
    let (x, y) = (
        middle("C", 0) - middle("D", 0),
        middle("C", 1) - middle("D", 1),
    );
    let angle = y.atan2(x).to_degrees();
    assert!((180.0 - angle.abs() - 38.6248).abs() < 1e-3, "{angle}");
    let rows = fs::read_to_string(&csv).unwrap();
    assert!(rows.starts_with("way,A.x,A.y,"), "{rows}");
    assert_eq!(rows.lines().count(), 182);
    let html = fs::read_to_string(&page).unwrap();
    assert!(
        html.contains("angle A D C from 38.6248"),
        "{}",
        &html[..2000]
    );
    // Standard output in place of the table.
    let (code, text, error) = krawl(&["motion", CRANK, "--free", "turns:D-A-B", "--json", "-"]);
    assert!(
        code == Some(0)
            && serde_json::from_str::<Value>(&text).is_ok()
            && error.contains("a loop of figures"),
        "{error}"
    );
    let (code, text, _) = krawl(&["show", &json]);
    assert_eq!(code, Some(0), "{text}");
}

#[test]
fn what_cannot_be_moved_is_refused_with_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let bodies = folder.path().join("bodies.toml");
    fs::write(
        &bodies,
        "name = \"arm\"\ndimension = 2\n[points]\nA = [0, 0]\nB = [1, 0.1]\nC = [2, 0.5]\nD = [3, 0]\n[constraints]\n\
         distances = [[\"A\", \"B\", 1], [\"B\", \"C\", 1], [\"C\", \"D\", 1]]\n",
    )
    .unwrap();
    let bodies = bodies.to_str().unwrap();
    for (arguments, why) in [
        (
            &["motion", CRANK][..],
            "set one more free with `--free NAME`",
        ),
        (
            &["motion", CRANK, "--free", "A-Z"],
            "there is no dimension `A-Z`",
        ),
        (
            &["motion", CRANK, "--free", "turns:D-A-B", "--measure", "A-Z"],
            "--measure",
        ),
        (&["motion", bodies], "in 2 ways: give 1 dimension more"),
        (&["motion", "nowhere.toml"], "nowhere.toml"),
    ] {
        let (code, text, error) = krawl(arguments);
        assert!(
            code == Some(2) && text.is_empty() && error.contains(why),
            "{arguments:?}: {error}"
        );
    }
}

#[test]
fn time_that_is_over_is_no_fault_of_the_file() {
    let (code, _, error) = krawl(&["motion", CRANK, "--free", "turns:D-A-B", "--time", "1e-9"]);
    assert!(
        code == Some(1) && error.contains("interrupted"),
        "{code:?} {error}"
    );
}

/// Where a bound is not sharp it is not said that a figure reaches it: the angle is not defined where D comes to A, and 150.26 is its
/// supremum.
#[test]
fn what_is_reached_by_no_figure_is_not_said_to_be() {
    let text = "dimension = 2\n[points]\nA = [4, 4]\nB = [3, 6]\nC = [2, 1]\nD = [0, 4]\n[constraints]\nfixed = [\"A\", \"B\"]\n\
                squared_distances = [[\"A\", \"C\", 13], [\"B\", \"C\", 26], [\"C\", \"D\", 13]]\n";
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("a.toml");
    std::fs::write(&file, text).unwrap();
    let file = file.to_str().unwrap();
    let (_, text, error) = krawl(&["motion", file, "--measure", "angle B D A"]);
    assert!(text.contains("at most 180.0"), "{text}{error}");
    assert!(
        text.contains("Where it says at least or at most, figures may come less near to the value"),
        "{text}"
    );
    let (_, text, error) = krawl(&["motion", file, "--measure", "B-D"]);
    assert!(
        text.contains("come as near to each as its digits tell, proved"),
        "{text}{error}"
    );
}
