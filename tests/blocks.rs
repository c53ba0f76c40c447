//! Problems that fall apart into blocks: `solve` answers block by block and combines.

use assert_cmd::Command;
use serde_json::Value;

const RECTANGLE: &str = "name = \"rectangle\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [4, 3]\nd = [0, 3]\n\
    [constraints]\ndistances = [[\"a\", \"b\", 5], [\"b\", \"c\", 3], [\"c\", \"d\", 5], [\"d\", \"a\", 3]]\n\
    squared_distances = [[\"a\", \"c\", 34]]\n";

fn krawl(arguments: &[&str], input: &str) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
    let output = command.args(arguments).write_stdin(input).output().unwrap();
    (
        output.status.code(),
        String::from_utf8(output.stdout).unwrap(),
    )
}

#[test]
fn a_rectangle_is_solved_by_its_two_triangles() {
    let (code, text) = krawl(&["solve", "-"], RECTANGLE);
    assert_eq!(code, Some(0), "{text}");
    assert!(
        text.contains("rectangle, block 1 of 2 (a, b and c): Closed, proved"),
        "{text}"
    );
    assert!(
        text.contains("Combined, proved: 2 figures up to motions and reflections"),
        "{text}"
    );
    assert!(
        text.contains("Figure 2: block 1 solution 1, block 2 solution 1 mirrored"),
        "{text}"
    );
    let (code, text) = krawl(&["check", "-"], RECTANGLE);
    assert_eq!(code, Some(0), "{text}");
    assert!(
        text.contains("blocks\n  2, which share no more than a side\n  1: a, b, c\n  2: a, c, d\n"),
        "{text}"
    );
}

/// The combined figures meet all dimensions, and the rectangle is among them.
#[test]
fn combined_figures_are_in_the_result() {
    let (code, text) = krawl(&["solve", "-", "--json", "-"], RECTANGLE);
    assert_eq!(code, Some(0), "{text}");
    let result: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(result["status"], "stopped");
    let blocks = &result["blocks"];
    assert_eq!(blocks["proved"], true);
    assert_eq!(blocks["count"], 2);
    assert_eq!(blocks["without_mirror_images"], true);
    assert_eq!(blocks["runs"].as_array().unwrap().len(), 2);
    assert_eq!(blocks["runs"][0]["status"], "closed");
    let figures = blocks["figures"].as_array().unwrap();
    assert_eq!(figures.len(), 2);
    let mut rectangles = 0;
    for figure in figures {
        let at = |p: &str| [0, 1].map(|k| figure["points"][p][k][0].as_f64().unwrap());
        let squared = |p: &str, q: &str| {
            let (p, q) = (at(p), at(q));
            (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)
        };
        for (p, q, wanted) in [
            ("a", "b", 25.0),
            ("b", "c", 9.0),
            ("c", "d", 25.0),
            ("d", "a", 9.0),
            ("a", "c", 34.0),
        ] {
            assert!((squared(p, q) - wanted).abs() < 1e-12, "{figure}");
        }
        rectangles += usize::from((squared("b", "d") - 34.0).abs() < 1e-12);
    }
    assert_eq!(rectangles, 1);
}
