//! The first solution alone: that of the whole path, and nothing where the path turns back before.

use crate::common::edits::{Random, case};
use assert_cmd::Command;
use krawl::problem::{Problem, Target};
use krawl::track::{Control, Options, Space, Status, first, prove};

/// The whole path's solution without a fold, and the first arc's, must be one and the same.
fn compare(problem: &Problem, space: Option<Space>) -> bool {
    let whole = prove(problem).unwrap();
    let found = first(
        problem,
        space,
        &Options::certified(),
        &mut Control::default(),
    )
    .unwrap();
    let solutions = &found.outcome.solutions;
    // Where folds may hide, the whole path does not tell which solution is the first.
    if whole
        .solutions
        .iter()
        .any(|s| s.place.unwrap().folds.is_none())
    {
        return found.turns_at.is_none();
    }
    let of_whole = whole.solutions.iter();
    let of_whole = of_whole.filter(|s| s.place.unwrap().folds == Some(0));
    let of_whole: Vec<_> = of_whole.collect();
    let name = &problem.name;
    assert_eq!(solutions.len(), of_whole.len(), "{name}");
    assert_eq!(
        found.turns_at.is_some(),
        solutions.is_empty(),
        "{name}: {found:?}"
    );
    if let Some((low, high)) = found.turns_at {
        assert!(0.0 < low && low <= high && high <= 1.0 + 1e-12, "{name}");
        assert!(high - low < 1e-9, "{name}");
        return false;
    }
    let pairs = solutions[0].points.iter().flatten();
    for (a, b) in pairs.zip(of_whole[0].points.iter().flatten()) {
        assert!(
            a.inf() <= b.sup() && b.inf() <= a.sup(),
            "{name}: {a:?} {b:?}"
        );
    }
    assert!(found.outcome.steps <= whole.steps + 1, "{name}");
    true
}

#[test]
fn the_first_arc_ends_at_the_whole_paths_first_solution() {
    for name in [
        "octahedron",
        "k33",
        "prism",
        "disulfide",
        "dodecagon",
        "constraints/pentahedron",
    ] {
        let problem = Problem::read(format!("problems/{name}.toml")).unwrap();
        compare(&problem, None);
    }
}

#[test]
fn random_targets_are_reached_or_the_path_turns_back() {
    let (mut random, mut reached, mut turned) = (Random(14), 0, 0);
    for k in 0..60 {
        let mut case = case(&mut random, 2 + k % 2, 5, (0.6, 1.6));
        let length = case.length.parse().unwrap();
        case.problem.distances[case.index].target = Target::Length(length);
        let Ok(run) = prove(&case.problem) else {
            continue;
        };
        if run.status != Status::Closed {
            continue;
        }
        let space = (k % 3 == 0).then_some(Space::Reduced);
        match compare(&case.problem, space) {
            true => reached += 1,
            false => turned += 1,
        }
    }
    assert!(reached > 15 && turned > 5, "{reached} {turned}");
}

#[test]
fn the_program_ends_there() {
    let run = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
        let output = command.args(arguments).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        (output.status.code(), text)
    };
    let (code, text) = run(&["solve", "problems/icosahedron.toml", "--first"]);
    assert!(code == Some(0) || code == Some(3), "{text}");
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    let triangle = "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [0, 3]\n[constraints]\n\
                    distances = [[\"a\", \"b\", 9], [\"b\", \"c\", 5], [\"c\", \"a\", 3]]\n\
                    [homotopy]\nbend_coefficient = 0\n";
    std::fs::write(file.path(), triangle).unwrap();
    let path = file.path().display().to_string();
    let (code, text) = run(&["solve", &path, "--first"]);
    assert_eq!(code, Some(3), "{text}");
    // 4 + 5 t = 8.
    assert!(
        text.contains("No solution without a fold, proved") && text.contains("t = 0.8"),
        "{text}"
    );
    std::fs::write(file.path(), triangle.replace(" 9]", " 7]")).unwrap();
    let (code, text) = run(&["solve", &path, "--first", "--json", "-"]);
    assert_eq!(code, Some(0), "{text}");
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["solutions"].as_array().unwrap().len(), 1);
    assert_eq!(json["solutions"][0]["folds"], 0);
    assert_eq!(json["solutions"][0]["signs"], serde_json::json!([1]));
    // The sketch moves to a figure with its own sign, and never to the mirror image.
    let signed = |sign: &str| {
        let asked = format!("orientation = [[\"a\", \"b\", \"c\", \"{sign}\"]]\n[homotopy]");
        let text = triangle.replace(" 9]", " 7]").replace("[homotopy]", &asked);
        std::fs::write(file.path(), text).unwrap();
        [run(&["solve", &path, "--first"]), run(&["solve", &path])]
    };
    let [(code, first), (_, all)] = signed("+");
    assert!(
        code == Some(0) && first.contains("First, proved"),
        "{first}"
    );
    assert!(all.contains("reached without a fold"), "{all}");
    let [(code, first), (whole, all)] = signed("-");
    assert_eq!((code, whole), (Some(3), Some(0)), "{first}{all}");
    assert!(
        first.contains("No solution is reached without a fold"),
        "{first}"
    );
    assert!(all.contains("Solution 1"), "{all}");
    assert!(!(first + &all).contains("reached without a fold,"), "{all}");
    // Floats know no folds, and say what does.
    let (code, text) = run(&["solve", "problems/k33.toml", "--first", "--mode", "float"]);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("leave out `--mode float`"), "{text}");
    assert!(!text.contains("turns back"), "{text}");
}
