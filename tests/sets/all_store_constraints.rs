//! `krawl all` with a store where the search goes over all coordinates, block after block: ended at any moment, shared and
//! merged, the answer and the cover are those of one run.

use super::all_store::{NAME, answer, complaint, killed, lines, text};
use std::path::{Path, PathBuf};

const PENTAHEDRON: &str = "problems/constraints/pentahedron.toml";

/// A double butterfly on four fixed points, and another one on the first: its second mechanism is searched for each figure of the
/// first.
const TWO: &str = r#"
name = "two-butterflies"
dimension = 2

[points]
G1 = [0.0, 0.0]
G2 = [-13.0, 0.0]
G3 = [-4.861545315265993, 7.107694048312924]
G4 = [-6.369235120800366, 6.046152032993828]
P = [-3.0, 10.0]
Q = [-5.0, 12.0]
R = [-7.0, 9.0]
S = [-10.0, 10.0]
T = [-12.0, 11.0]

p = [-4.0, 20.0]
q = [-6.0, 22.0]
r = [-8.0, 19.0]
s = [-11.0, 20.0]
t = [-13.0, 21.0]

[bodies]
pqr = { P = [0, 0], Q = [-3, 0], R = [-3, 4] }
rst = { R = [0, 0], S = [-6, 0], T = [-6.46, 2.69] }

second = { p = [0, 0], q = [-3, 0], r = [-3, 4] }
third = { r = [0, 0], s = [-6, 0], t = [-6.46, 2.69] }

[constraints]
fixed = [["G1"], ["G2"], ["G3"], ["G4"]]
distances = [
    ["G1", "P", 11.0],
    ["G3", "Q", 9.0],
    ["G4", "S", 7.0],
    ["G2", "T", 12.0],
    ["P", "p", 11.0],
    ["Q", "q", 9.0],
    ["S", "s", 9.0],
    ["T", "t", 10.0],
]
"#;

fn written(folder: &Path) -> PathBuf {
    let file = folder.join("two-butterflies.toml");
    std::fs::write(&file, TWO).unwrap();
    file
}

#[test]
fn cut_off_anywhere_it_goes_on_to_the_same_answer() {
    let folder = tempfile::tempdir().unwrap();
    let two = written(folder.path());
    for (problem, many) in [(PENTAHEDRON, 20), (text(&two), 100)] {
        let store = folder.path().join(format!("of {}", problem.len()));
        let once = answer(&[problem], 0);
        assert_eq!(once["method"], "coordinates");
        assert_eq!(answer(&[problem, "--store", text(&store)], 0), once);
        let file = store.join(NAME);
        let whole = std::fs::read(&file).unwrap();
        let count = lines(&store);
        assert!(count > many, "{count}");
        let first = whole.iter().position(|&b| b == b'\n').unwrap();
        for length in [0, first / 2, first + 1, whole.len() / 3, whole.len() - 1] {
            std::fs::write(&file, &whole[..length]).unwrap();
            let again = answer(&[problem, "--store", text(&store), "--threads", "1"], 0);
            assert_eq!(again, once, "cut off after {length} bytes");
            assert_eq!(lines(&store), count);
        }
        // A line that is damaged is not believed, nor are those behind.
        let mut damaged = whole.clone();
        damaged[whole.len() / 2] ^= 1;
        std::fs::write(&file, &damaged).unwrap();
        assert_eq!(answer(&[problem, "--store", text(&store)], 0), once);
        // What is done is not done again, with a certificate or without.
        let whole = std::fs::read(&file).unwrap();
        let [plain, kept] = ["plain.cover", "kept.cover"].map(|name| folder.path().join(name));
        let with = |cover: &Path, more: &[&str]| {
            let arguments = [&[problem, "--cert", text(cover)], more].concat();
            assert_eq!(answer(&arguments, 0), once);
        };
        with(&plain, &[]);
        with(&kept, &["--store", text(&store)]);
        assert_eq!(
            std::fs::read(&plain).unwrap(),
            std::fs::read(&kept).unwrap()
        );
        assert_eq!(std::fs::read(&file).unwrap(), whole);
    }
}

#[test]
fn a_killed_process_loses_nothing_that_was_done() {
    let folder = tempfile::tempdir().unwrap();
    let two = written(folder.path());
    let store = folder.path().join("store");
    let once = answer(&[text(&two)], 0);
    killed(10, &[text(&two)], &store);
    assert_eq!(answer(&[text(&two), "--store", text(&store)], 0), once);
}

#[test]
fn shares_are_merged_to_the_same_answer() {
    let folder = tempfile::tempdir().unwrap();
    let two = written(folder.path());
    let at = |name: &str| folder.path().join(name);
    let once = answer(&[text(&two)], 0);
    let whole = at("whole");
    answer(&[text(&two), "--store", text(&whole)], 0);
    let stores = [at("a"), at("b"), at("c")];
    for (k, store) in stores.iter().enumerate() {
        let share = format!("{}/3", k + 1);
        let one = answer(&[text(&two), "--store", text(store), "--share", &share], 1);
        assert_eq!(one["status"], "partial");
        let share = one["undecided"][0]["share"].as_f64().unwrap();
        assert!(share > 0.0 && share <= 1.0, "{share}");
    }
    // Each has searched the second block for the figures that it found: next to nothing is left.
    let mut arguments = vec![text(&two), "--store", text(&stores[2])];
    for other in &stores[..2] {
        arguments.extend(["--merge", text(other)]);
    }
    let parts: usize = stores.iter().map(|store| lines(store) - 1).sum();
    assert_eq!(answer(&arguments, 0), once);
    assert_eq!(lines(&stores[2]), lines(&whole));
    let fresh = (lines(&whole) - 1).saturating_sub(parts);
    assert!(20 * fresh < lines(&whole), "{fresh} of {}", lines(&whole));
    // Of another problem, or of a search by plan.
    let said = complaint(&[PENTAHEDRON, "--store", text(&whole)]);
    assert!(said.contains("another problem"), "{said}");
    let plan = at("plan");
    answer(&["problems/prism.toml", "--store", text(&plan)], 0);
    let merge = [text(&two), "--store", text(&whole), "--merge", text(&plan)];
    let said = complaint(&merge);
    assert!(said.contains("another search"), "{said}");
}
